// Implements output/alembic/abc_reader.h. The layout is abc_writer.h's: all but the frames stands in front,
// and is read as any archive is (groom/alembic/abc_archive.h); of the frames only where they are.
#include "ringlet/output/alembic/abc_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/text_of.h"
#include "ringlet/groom/alembic/abc_hair.h"
#include "ringlet/output/alembic/abc_stage.h"
#include "ringlet/output/alembic/abc_writer.h"

namespace ringlet {
namespace {

constexpr double kUsualAbcWidth = 0.0005;  // of strands whose file does not say it [m]
constexpr std::uint64_t kAbcPointBytes = 12, kAbcMatrixBytes = 8 * kAbcMatrixNumbers,
                        kMostAbcFrames = std::numeric_limits<std::int32_t>::max();
constexpr std::string_view kOgawa("Ogawa\xff", 6);

bool isAbcMarked(std::span<const std::byte> begin) {
  const std::string_view text = textOf(begin);
  return text.starts_with(kOgawa) && text.substr(kAbcMarkAt).starts_with(kAbcMark);
}

double abcNumberOf(std::string_view metadata, std::string_view key) {
  const std::string_view text = abcValueOf(metadata, key);
  double number = 0;
  const auto end = text.data() + text.size();
  return std::from_chars(text.data(), end, number).ptr == end ? number : 0;
}

}  // namespace

bool AbcReader::isOurs(const std::filesystem::path& path) {
  AbcReader reader;
  auto opened = openToRead(path);
  if (!opened) return false;
  reader.file_ = std::move(*opened);
  reader.size_ = kAbcFrontSizeAt;
  const auto begin = reader.read(0, kAbcFrontSizeAt);
  return begin && isAbcMarked(*begin);
}

Result<AbcReader> AbcReader::open(const std::filesystem::path& path) {
  AbcReader reader;
  reader.path_ = path;
  auto opened = openToRead(path);
  if (!opened) return opened.error();
  reader.file_ = std::move(*opened);
  std::error_code code;
  reader.size_ = std::filesystem::file_size(path, code);
  if (Status read = reader.readFront(); !read) return read.error();
  return reader;
}

Error AbcReader::wrong(const std::string& what) const {
  return Error{fmt::format("{}: {}; only animations that Ringlet wrote can be read", path_.string(), what)};
}

Result<std::vector<std::byte>> AbcReader::read(std::uint64_t at, std::uint64_t count) {
  std::vector<std::byte> bytes;
  if (at > size_ || count > size_ - at || at > std::uint64_t{std::numeric_limits<long>::max()})
    return wrong(fmt::format("has no bytes {} to {}", at, at + count));
  bytes.resize(count);
  if (std::fseek(file_.get(), static_cast<long>(at), SEEK_SET) != 0 ||
      std::fread(bytes.data(), 1, count, file_.get()) != count)
    return Error{fmt::format("cannot read bytes {} to {} of {}", at, at + count, path_.string()),
                 Fault::input};
  return bytes;
}

Status AbcReader::readFront() {
  if (size_ < kAbcFrontSizeAt + 8) return wrong(fmt::format("has {} bytes", size_));
  const auto begin = read(0, kAbcFrontSizeAt + 8);
  if (!begin) return begin.error();
  if (!isAbcMarked(*begin)) return wrong("does not begin as a Ringlet archive does");
  const auto front = read(0, readU64(*begin, kAbcFrontSizeAt));
  if (!front) return front.error();
  const auto archive = AbcArchive::of(*front, path_.string());
  if (!archive) return archive.error();
  if (Status read = readMeasures(*archive); !read) return read;
  std::vector<std::uint32_t> curves;
  for (std::uint32_t k = 0; k < archive->objects().size(); ++k) {
    if (abcValueOf(archive->objects()[k].metadata, "schema") == "AbcGeom_Curve_v2") curves.push_back(k);
  }
  if (curves.size() != 1) return wrong(fmt::format("has {} curves objects", curves.size()));
  if (Status read = readCurves(*archive, curves.front()); !read) return read;
  leaveTornOut();
  return {};
}

Status AbcReader::readMeasures(const AbcArchive& archive) {
  framesPerSecond_ = abcNumberOf(archive.metadata(), kAbcRate);
  metresPerUnit_ = abcNumberOf(archive.metadata(), kAbcUnit);
  if (!(framesPerSecond_ > 0) || !(metresPerUnit_ > 0) || !std::isfinite(framesPerSecond_ + metresPerUnit_))
    return wrong(fmt::format("has no {} and {} above 0", kAbcRate, kAbcUnit));
  up_ = abcValueOf(archive.metadata(), kAbcUp) == "Z" ? UpAxis::z : UpAxis::y;
  return {};
}

Status AbcReader::readCurves(const AbcArchive& archive, std::uint32_t object) {
  const auto own = archive.propertiesOf(object);
  if (!own) return own.error();
  const AbcProperty* compound = abcPropertyNamed(*own, ".geom");
  if (!compound) return wrong("has curves without .geom");
  const auto geometry = archive.propertiesOf(*compound);
  if (!geometry) return geometry.error();
  if (Status read = readStrands(archive, *geometry); !read) return read;
  auto points = placesOf(archive, abcPropertyNamed(*geometry, kAbcPoints), AbcType::f32, 3);
  if (!points) return points.error();
  points_ = std::move(*points);
  if (Status read = readHeads(archive, archive.objects()[object].parent); !read) return read;
  const std::size_t frames = heads_.empty() ? points_.size() : std::min(points_.size(), heads_.size());
  frameCount_ = static_cast<int>(std::min<std::uint64_t>(frames, kMostAbcFrames));
  return {};
}

// How long each is, and how thick.
Status AbcReader::readStrands(const AbcArchive& archive, const std::vector<AbcProperty>& geometry) {
  const AbcProperty *counts = abcPropertyNamed(geometry, "nVertices"),
                    *widths = abcPropertyNamed(geometry, "width");
  if (!counts || counts->kind == AbcKind::compound) return wrong("has no nVertices");
  const auto lengths = archive.stored(*counts, 0);
  if (!lengths) return lengths.error();
  for (std::size_t k = 0; k < lengths->numberCount(); ++k) {
    const double count = lengths->number(k);
    if (!(count >= 1 && count <= 1e9)) return wrong(fmt::format("has a strand of {} particles", count));
    const std::uint64_t total = firstPoint_.back() + static_cast<std::uint64_t>(count);
    if (total > std::numeric_limits<std::uint32_t>::max()) return wrong("has more than 2^32 - 1 particles");
    firstPoint_.push_back(static_cast<std::uint32_t>(total));
  }
  if (firstPoint_.size() == 1) return wrong("has no strands");
  diameter_ = static_cast<float>(kUsualAbcWidth / metresPerUnit_);
  if (widths && widths->kind == AbcKind::array) {
    const auto said = archive.stored(*widths, 0);
    if (!said) return said.error();
    if (said->numberCount() > 0) diameter_ = static_cast<float>(said->number(0));
  }
  if (!(diameter_ > 0) || !std::isfinite(diameter_)) return wrong("has no widths above 0");
  return {};
}

// A matrix a frame, where the head's motion is apart.
Status AbcReader::readHeads(const AbcArchive& archive, std::uint32_t transform) {
  const auto own = archive.propertiesOf(transform);
  if (!own) return own.error();
  const AbcProperty* compound = abcPropertyNamed(*own, ".xform");
  if (!compound) return {};
  const auto parts = archive.propertiesOf(*compound);
  if (!parts) return parts.error();
  const AbcProperty* values = abcPropertyNamed(*parts, ".vals");
  if (!values) return {};
  auto heads = placesOf(archive, values, AbcType::f64, kAbcMatrixNumbers);
  if (!heads) return heads.error();
  heads_ = std::move(*heads);
  if (heads_.empty()) points_.clear();
  return {};
}

Result<std::vector<std::uint64_t>> AbcReader::placesOf(const AbcArchive& archive, const AbcProperty* property,
                                                       AbcType type, unsigned width) const {
  std::vector<std::uint64_t> places;
  if (!property || property->kind == AbcKind::compound || property->type != type || property->width != width)
    return wrong("has no points of 3 floats, or a transform that is no matrix");
  const std::uint32_t count = property->storedCount();
  if (count != property->sampleCount) return wrong(fmt::format("has a {} that rests", property->path()));
  if (count == 0) return places;
  if (const auto last = archive.placeOfStored(*property, count - 1); !last) return last.error();
  for (std::uint32_t k = 0; k < count; ++k) places.push_back(archive.placeOfStored(*property, k)->place());
  return places;
}

// Of a frame whose bytes were lost, what is in front may know.
void AbcReader::leaveTornOut() {
  std::vector<Vec3f> points;
  const int stated = frameCount_;
  for (; frameCount_ > 0; --frameCount_) {
    if (readFrame(frameCount_, points)) break;
  }
  if (frameCount_ < stated)
    warnings_.push_back(
        fmt::format("its end is torn and left out, after {} whole frames of {}", frameCount_, stated));
}

// The values of a sample that has so many bytes of them.
Result<std::vector<std::byte>> AbcReader::readSample(std::uint64_t place, std::uint64_t count) {
  auto bytes = read(place, 8 + kAbcDigestBytes + count);
  if (!bytes) return bytes.error();
  if (readU64(*bytes, 0) != kAbcDigestBytes + count) return wrong("has a sample of another size");
  bytes->erase(bytes->begin(), bytes->begin() + 8 + kAbcDigestBytes);
  return bytes;
}

Status AbcReader::readFrame(int frame, std::vector<Vec3f>& points) {
  points.clear();
  const auto at = static_cast<std::size_t>(frame) - 1;
  const auto damaged = [&](const std::string& what) {
    return Error{fmt::format("{}: frame {} is damaged: {}", path_.string(), frame, what)};
  };
  const auto bytes = readSample(points_[at], kAbcPointBytes * firstPoint_.back());
  if (!bytes) return bytes.error();
  UsdTransform head;
  if (!heads_.empty()) {
    const auto numbers = readSample(heads_[at], kAbcMatrixBytes);
    if (!numbers) return numbers.error();
    const auto row = [&](std::size_t i) {
      return Vec3d{readF64(*numbers, 32 * i), readF64(*numbers, 32 * i + 8), readF64(*numbers, 32 * i + 16)};
    };
    head = {{row(0), row(1), row(2)}, row(3)};
  }
  for (std::size_t i = 0; i < firstPoint_.back(); ++i) {
    const auto number = [&](std::size_t axis) { return readF32(*bytes, kAbcPointBytes * i + 4 * axis); };
    Vec3f p{number(0), number(1), number(2)};
    if (!heads_.empty()) p = Vec3f(head(Vec3d(p)));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return damaged("a point is not finite");
    points.push_back(p);
  }
  return {};
}

}  // namespace ringlet
