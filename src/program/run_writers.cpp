// Implements run_writers.h.
#include "program/run_writers.h"

#include <utility>

#include "ringlet/groom/obj_file.h"

namespace ringlet::program {

Writers::Writers(const RunInput& input, const RunOptions& options, int frameCount)
    : input_(input), options_(options), frameCount_(frameCount) {
  if (options.writesSheet) sheet_.emplace(input.groom, options.frameCount, options.up);
}

Status Writers::open() {
  const double metresPerUnit = input_.groom.metresPerUnit;
  const auto diameter = static_cast<float>(options_.width / metresPerUnit);
  if (options_.writesUsd) {
    auto usd = UsdWriter::resume(options_.folder / "hair.usda", input_.groom,
                                 {.framesPerSecond = input_.settings.framesPerSecond,
                                  .metresPerUnit = metresPerUnit,
                                  .up = options_.up,
                                  .diameter = diameter,
                                  .frameCount = options_.frameCount},
                                 frameCount_);
    if (!usd) return usd.error();
    usd_.emplace(std::move(*usd));
  }
  if (options_.cache) {
    auto cache = CacheWriter::resume(options_.folder / "hair.rgc", input_.groom,
                                     {.precision = *options_.cache,
                                      .up = options_.up,
                                      .diameter = diameter,
                                      .framesPerSecond = input_.settings.framesPerSecond,
                                      .metresPerUnit = metresPerUnit},
                                     frameCount_);
    if (!cache) return cache.error();
    cache_.emplace(std::move(*cache));
  }
  isOpen_ = true;
  return {};
}

Status Writers::addFrame(int frame, std::vector<Vec3f> points) {
  if (!isOpen_) {
    if (Status opened = open(); !opened) return opened;
  }
  if (sheet_) sheet_->offer(frame, points);
  lastPoints_ = std::move(points);
  if (cache_) {
    if (Status added = cache_->addFrame(lastPoints_); !added) return added;
  }
  return usd_ ? usd_->addFrame(lastPoints_) : Status{};
}

Status Writers::sync() {
  if (usd_) {
    if (Status done = usd_->sync(); !done) return done;
  }
  return cache_ ? cache_->sync() : Status{};
}

void Writers::archive(Archive& archive) {
  if (sheet_) sheet_->archive(archive);
}

Result<std::vector<std::filesystem::path>> Writers::finish() {
  if (!isOpen_) {
    if (Status opened = open(); !opened) return opened.error();
  }
  if (usd_) {
    if (Status done = usd_->finish(); !done) return done.error();
  }
  if (cache_) {
    if (Status done = cache_->finish(); !done) return done.error();
  }
  if (options_.writesLast) {
    if (Status done = writeObj(options_.folder / "last.obj", input_.groom, lastPoints_); !done)
      return done.error();
  }
  if (sheet_) {
    if (Status done = sheet_->write(options_.folder / "sheet.png"); !done) return done.error();
  }
  return outputsOf(options_);
}

std::optional<double> Writers::cacheErrorBound() const {
  if (!cache_) return std::nullopt;
  return cache_->errorBound();
}

std::vector<std::filesystem::path> outputsOf(const RunOptions& options) {
  std::vector<std::filesystem::path> outputs;
  if (options.writesUsd) outputs.push_back(options.folder / "hair.usda");
  if (options.cache) outputs.push_back(options.folder / "hair.rgc");
  if (options.writesLast) outputs.push_back(options.folder / "last.obj");
  if (options.writesSheet) outputs.push_back(options.folder / "sheet.png");
  return outputs;
}

}  // namespace ringlet::program
