// Implements output/animation_reader.h.
#include "ringlet/output/animation_reader.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/usd/usd_writer.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// hair.usda of hair.usda and of hair.usda.partial.
fs::path finishedName(const fs::path& path) {
  return path.extension() == ".partial" ? path.parent_path() / path.stem() : path;
}

bool beginsAsText(const fs::path& path) {
  const std::string_view begin = UsdWriter::kBegin;
  std::string found(begin.size(), '\0');
  std::ifstream(path, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == begin;
}

}  // namespace

bool isAnimation(const fs::path& path) {
  const AnimationFormat* format = animationFormatOf(finishedName(path));
  return format && format->isRead;
}

namespace {

bool isOurs(const fs::path& path) {
  if (!isAnimation(path)) return false;
  if (path.extension() == ".partial" || path.extension() == ".rgc") return true;
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return false;  // nor would a pipe ever be opened
  if (path.extension() == ".abc") return AbcReader::isOurs(path);
  return path.extension() == ".usda" ? beginsAsText(path) : UsdcReader::isOurs(path);
}

}  // namespace

bool holdsAnimation(const fs::path& path) { return isOurs(path) || holdsForeignFrames(path); }

Result<fs::path> animationFileOf(const fs::path& path) {
  std::error_code code;
  if (!fs::is_directory(path, code)) return path;
  for (const char* suffix : {"", ".partial"}) {
    for (const AnimationFormat& format : animationFormats()) {
      fs::path file = path / fmt::format("hair{}{}", format.extension, suffix);
      if (fs::exists(file, code)) return file;
    }
  }
  return Error{fmt::format(
      "{} holds no hair.usda, hair.usdc, hair.abc or hair.rgc; is it a folder that `ringlet simulate` wrote?",
      path.string())};
}

Result<AnimationReader> AnimationReader::open(const fs::path& path, const ForeignReading& reading) {
  const std::string extension = finishedName(path).extension().string();
  const auto made = [&](auto reader) -> Result<AnimationReader> {
    if (!reader) return reader.error();
    AnimationReader source{Reader(std::move(*reader))};
    std::visit([&](const auto& opened) { source.take(opened); }, source.reader_);
    if (source.groom_.firstPoint.back() == 0)
      return Error{fmt::format("{}: has no particles; a groom has 1 to 2^32 - 1", path.string())};
    source.groom_.metresPerUnit = source.header_.metresPerUnit;
    if (!source.isCache()) source.isFinished_ = path.extension() != ".partial";
    std::error_code code;
    source.byteCount_ = fs::file_size(path, code);
    if (code) source.byteCount_ = 0;
    return source;
  };
  if (!isOurs(path)) return made(ForeignReader::open(path, reading));
  if (extension == ".rgc") return made(CacheReader::open(path));
  if (extension == ".abc") return made(AbcReader::open(path));
  return extension == ".usdc" ? made(UsdcReader::open(path)) : made(UsdReader::open(path));
}

void AnimationReader::takeHeader(const auto& reader) {
  header_ = {.precision = CachePrecision::float32,
             .up = reader.up(),
             .diameter = reader.diameter(),
             .framesPerSecond = reader.framesPerSecond(),
             .metresPerUnit = reader.metresPerUnit()};
  frameCount_ = reader.frameCount();
  warnings_ = reader.warnings();
}

void AnimationReader::take(const UsdReader& usd) {
  std::uint64_t total = 0;
  for (const std::uint32_t count : usd.particleCounts()) {
    total += count;
    groom_.firstPoint.push_back(static_cast<std::uint32_t>(total));
  }
  if (total > std::numeric_limits<std::uint32_t>::max()) groom_.firstPoint = {0};
  takeHeader(usd);
}

void AnimationReader::take(const FrameReader& frames) {
  groom_.firstPoint = frames.firstPoint();
  takeHeader(frames);
}

void AnimationReader::take(const CacheReader& cache) {
  groom_.firstPoint = cache.firstPoint();
  header_ = cache.header();
  frameCount_ = cache.frameCount();
  isFinished_ = cache.isFinished();
  warnings_ = cache.warnings();
}

void AnimationReader::take(const ForeignReader& foreign) {
  groom_.firstPoint = foreign.firstPoint();
  takeHeader(foreign);
}

const char* AnimationReader::formatName() const {
  if (const auto* foreign = std::get_if<ForeignReader>(&reader_)) return foreign->formatName();
  constexpr std::array<const char*, std::variant_size_v<Reader> - 1> kNames{"USD text", "USD crate",
                                                                            "Alembic", "cache"};
  return kNames[reader_.index()];
}

const char* AnimationReader::formatKey() const {
  if (const auto* foreign = std::get_if<ForeignReader>(&reader_)) return foreign->formatKey();
  constexpr std::array<const char*, std::variant_size_v<Reader> - 1> kKeys{"usd", "usdc", "abc", "cache"};
  return kKeys[reader_.index()];
}

Status AnimationReader::readFrame(int frame) {
  RINGLET_ASSERT(frame > latest_ && frame <= frameCount_, "frames are read in order");
  if (auto* usd = std::get_if<UsdReader>(&reader_)) {
    for (; latest_ < frame; ++latest_) {
      auto more = usd->readFrame(groom_.points);
      if (!more) return more.error();
      RINGLET_ASSERT(*more, "the reader refuses files of fewer frames than they state");
    }
    return latest_ == frameCount_ ? checkEnd(*usd) : Status{};
  }
  latest_ = frame;
  if (auto* foreign = std::get_if<ForeignReader>(&reader_)) return foreign->readFrame(frame, groom_.points);
  if (auto* crate = std::get_if<UsdcReader>(&reader_)) return crate->readFrame(frame, groom_.points);
  if (auto* archive = std::get_if<AbcReader>(&reader_)) return archive->readFrame(frame, groom_.points);
  return std::get<CacheReader>(reader_).readFrame(frame, groom_.points);
}

// Text that was cut short after its last frame, or has more of them than it states, is refused.
Status AnimationReader::checkEnd(UsdReader& usd) {
  std::vector<Vec3f> beyond;
  auto more = usd.readFrame(beyond);
  if (!more) return more.error();
  if (*more) return Error{fmt::format("it states {} frames and has more", frameCount_)};
  return {};
}

double AnimationReader::errorBound() const {
  const auto* cache = std::get_if<CacheReader>(&reader_);
  return cache ? cache->errorBound() : 0;
}

double AnimationReader::errorBound(int frame) const {
  const auto* cache = std::get_if<CacheReader>(&reader_);
  return cache ? cache->errorBound(frame) : 0;
}

}  // namespace ringlet
