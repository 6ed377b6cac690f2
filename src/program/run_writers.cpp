// Implements run_writers.h.
#include "program/run_writers.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "ringlet/groom/obj_file.h"

namespace ringlet::program {

Status Writers::addFrame(int frame, std::vector<Vec3f> points) {
  if (sheet) sheet->offer(frame, points);
  lastPoints = std::move(points);
  if (cache) {
    if (Status added = cache->addFrame(lastPoints); !added) return added;
  }
  return usd ? usd->addFrame(lastPoints) : Status{};
}

Result<std::vector<std::filesystem::path>> Writers::finish(const std::filesystem::path& folder,
                                                           const Groom& groom) {
  std::vector<std::filesystem::path> written;
  if (usd) {
    if (Status done = usd->finish(); !done) return done.error();
    written.push_back(folder / "hair.usda");
  }
  if (cache) {
    if (Status done = cache->finish(); !done) return done.error();
    written.push_back(folder / "hair.rgc");
  }
  if (writesLast) {
    written.push_back(folder / "last.obj");
    if (Status done = writeObj(written.back(), groom, lastPoints); !done) return done.error();
  }
  if (sheet) {
    written.push_back(folder / "sheet.png");
    if (Status done = sheet->write(written.back()); !done) return done.error();
  }
  return written;
}

Result<Writers> openWriters(const RunInput& input, const RunOptions& options) {
  const double metresPerUnit = input.groom.metresPerUnit;
  std::error_code code;
  std::filesystem::create_directories(options.folder, code);
  if (code)
    return Error{fmt::format("cannot create the folder {}: {}", options.folder.string(), code.message())};
  Writers writers{{}, {}, {}, options.writesLast, {}};
  const auto diameter = static_cast<float>(options.width / metresPerUnit);
  if (options.writesUsd) {
    auto usd = UsdWriter::create(options.folder / "hair.usda", input.groom,
                                 {.framesPerSecond = input.settings.framesPerSecond,
                                  .metresPerUnit = metresPerUnit,
                                  .up = options.up,
                                  .diameter = diameter,
                                  .frameCount = options.frameCount});
    if (!usd) return usd.error();
    writers.usd.emplace(std::move(*usd));
  }
  if (options.cache) {
    auto cache = CacheWriter::create(options.folder / "hair.rgc", input.groom,
                                     {.precision = *options.cache,
                                      .up = options.up,
                                      .diameter = diameter,
                                      .framesPerSecond = input.settings.framesPerSecond,
                                      .metresPerUnit = metresPerUnit});
    if (!cache) return cache.error();
    writers.cache.emplace(std::move(*cache));
  }
  if (options.writesSheet) writers.sheet.emplace(input.groom, options.frameCount, options.up);
  return writers;
}

}  // namespace ringlet::program
