// Implements animation_source.h.
#include "program/animation_source.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include "ringlet/base/assert.h"
#include "ringlet/output/usd_writer.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

// ".usda" of hair.usda and of hair.usda.partial.
std::string formatOf(const fs::path& path) {
  return (path.extension() == ".partial" ? path.stem() : path).extension().string();
}

}  // namespace

std::vector<std::string> precisionNames() { return {"float32", "16bit"}; }

CachePrecision precisionByName(const std::string& name) {
  return name == "16bit" ? CachePrecision::bits16 : CachePrecision::float32;
}

std::string nameOf(CachePrecision precision) {
  return precision == CachePrecision::bits16 ? "16bit" : "float32";
}

bool isAnimation(const fs::path& path) { return formatOf(path) == ".usda" || formatOf(path) == ".rgc"; }

bool holdsAnimation(const fs::path& path) {
  if (!isAnimation(path) || path.extension() != ".usda") return isAnimation(path);
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return false;  // nor would a pipe ever be opened
  const std::string_view begin = UsdWriter::kBegin;
  std::string found(begin.size(), '\0');
  std::ifstream(path, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == begin;
}

Result<AnimationSource> AnimationSource::open(const fs::path& path) {
  if (!isAnimation(path))
    return Error{
        fmt::format("{}: cannot read an animation: its name must end in .usda or .rgc, or in one of "
                    "these and .partial",
                    path.string())};
  if (formatOf(path) == ".rgc") {
    auto reader = CacheReader::open(path);
    if (!reader) return reader.error();
    AnimationSource source(std::move(*reader));
    const auto& cache = std::get<CacheReader>(source.reader_);
    source.groom_.firstPoint = cache.firstPoint();
    source.header_ = cache.header();
    source.frameCount_ = cache.frameCount();
    source.isFinished_ = cache.isFinished();
    source.byteCount_ = cache.byteCount();
    source.warnings_ = cache.warnings();
    source.groom_.metresPerUnit = source.header_.metresPerUnit;
    return source;
  }
  auto reader = UsdReader::open(path);
  if (!reader) return reader.error();
  AnimationSource source(std::move(*reader));
  const auto& usd = std::get<UsdReader>(source.reader_);
  std::uint64_t total = 0;
  for (std::uint32_t count : usd.particleCounts()) {
    total += count;
    source.groom_.firstPoint.push_back(static_cast<std::uint32_t>(total));
  }
  if (total == 0 || total > std::numeric_limits<std::uint32_t>::max())
    return Error{fmt::format("{}: has {} particles; a groom has 1 to 2^32 - 1", path.string(), total)};
  source.header_ = {.precision = CachePrecision::float32,
                    .up = usd.up(),
                    .diameter = usd.diameter(),
                    .framesPerSecond = usd.framesPerSecond(),
                    .metresPerUnit = usd.metresPerUnit()};
  source.frameCount_ = usd.frameCount();
  source.warnings_ = usd.warnings();
  source.isFinished_ = path.extension() != ".partial";
  std::error_code code;
  source.byteCount_ = fs::file_size(path, code);
  source.groom_.metresPerUnit = source.header_.metresPerUnit;
  return source;
}

Status AnimationSource::readFrame(int frame) {
  RINGLET_ASSERT(frame > latest_ && frame <= frameCount_, "frames are read in order");
  if (auto* cache = std::get_if<CacheReader>(&reader_)) {
    latest_ = frame;
    return cache->readFrame(frame, groom_.points);
  }
  while (latest_ < frame) {
    auto more = std::get<UsdReader>(reader_).readFrame(groom_.points);
    if (!more) return more.error();
    RINGLET_ASSERT(*more, "the reader refuses files of fewer frames than they state");
    ++latest_;
  }
  return latest_ == frameCount_ ? checkEnd() : Status{};
}

// Text that was cut short after its last frame, or has more of them than it states, is refused.
Status AnimationSource::checkEnd() {
  std::vector<Vec3f> beyond;
  auto more = std::get<UsdReader>(reader_).readFrame(beyond);
  if (!more) return more.error();
  if (*more) return Error{fmt::format("it states {} frames and has more", frameCount_)};
  return {};
}

double AnimationSource::errorBound() const {
  const auto* cache = std::get_if<CacheReader>(&reader_);
  return cache ? cache->errorBound() : 0;
}

double AnimationSource::errorBound(int frame) const {
  const auto* cache = std::get_if<CacheReader>(&reader_);
  return cache ? cache->errorBound(frame) : 0;
}

}  // namespace ringlet::program
