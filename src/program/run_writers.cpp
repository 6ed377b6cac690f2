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
  return usd ? usd->addFrame(lastPoints) : Status{};
}

Result<std::vector<std::filesystem::path>> Writers::finish(const std::filesystem::path& folder,
                                                           const Groom& groom) {
  std::vector<std::filesystem::path> written;
  if (usd) {
    if (Status done = usd->finish(); !done) return done.error();
    written.push_back(folder / "hair.usda");
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
  Writers writers{{}, {}, options.writesLast, {}};
  if (options.writesUsd) {
    auto usd = UsdWriter::create(options.folder / "hair.usda", input.groom,
                                 {.framesPerSecond = input.settings.framesPerSecond,
                                  .metresPerUnit = metresPerUnit,
                                  .up = options.up,
                                  .diameter = static_cast<float>(options.width / metresPerUnit),
                                  .frameCount = options.frameCount});
    if (!usd) return usd.error();
    writers.usd.emplace(std::move(*usd));
  }
  if (options.writesSheet) writers.sheet.emplace(input.groom, options.frameCount, options.up);
  return writers;
}

}  // namespace ringlet::program
