// Implements output/alembic/abc_reader.h. The layout is abc_writer.h's: all but the frames stands in front,
// and is read as any archive is (groom/alembic/abc_archive.h); of the frames only where they are.
#include "ringlet/output/alembic/abc_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/text_of.h"
#include "ringlet/groom/alembic/abc_hair.h"
#include "ringlet/output/alembic/abc_stage.h"
#include "ringlet/output/alembic/abc_writer.h"

namespace ringlet {
namespace {

constexpr std::string_view kOgawa("Ogawa\xff", 6);

bool isAbcMarked(std::span<const std::byte> begin) {
  const std::string_view text = textOf(begin);
  return text.starts_with(kOgawa) && text.substr(kAbcMarkAt).starts_with(kAbcMark);
}

}  // namespace

bool AbcReader::isOurs(const std::filesystem::path& path) {
  auto file = ReadFile::open(path);
  std::vector<std::byte> begin;
  return file && file->readAt(0, kAbcFrontSizeAt, begin) && isAbcMarked(begin);
}

Result<AbcReader> AbcReader::open(const std::filesystem::path& path) {
  auto file = ReadFile::open(path);
  if (!file) return file.error();
  AbcReader reader(std::move(*file));
  if (Status read = reader.readFront(); !read) return read.error();
  return reader;
}

Status AbcReader::readFront() {
  if (byteCount() < kAbcFrontSizeAt + 8) return wrong(fmt::format("has {} bytes", byteCount()));
  const auto begin = read(0, kAbcFrontSizeAt + 8);
  if (!begin) return begin.error();
  if (!isAbcMarked(*begin)) return wrong("does not begin as a Ringlet archive does");
  const auto front = read(0, readU64(*begin, kAbcFrontSizeAt));
  if (!front) return front.error();
  const auto archive = AbcArchive::of(*front, path().string());
  if (!archive) return archive.error();
  if (Status read = readMeasures(*archive); !read) return read;
  std::vector<std::uint32_t> curves;
  for (std::uint32_t k = 0; k < archive->objects().size(); ++k) {
    if (abcValueOf(archive->objects()[k].metadata, "schema") == "AbcGeom_Curve_v2") curves.push_back(k);
  }
  if (curves.size() != 1) return wrong(fmt::format("has {} curves objects", curves.size()));
  return readCurves(*archive, curves.front());
}

Status AbcReader::readMeasures(const AbcArchive& archive) {
  const std::string_view up = abcValueOf(archive.metadata(), kAbcUp);
  return takeMeasures(abcNumberOf(archive.metadata(), kAbcRate).value_or(0),
                      abcNumberOf(archive.metadata(), kAbcUnit).value_or(0),
                      up == "Z" ? UpAxis::z : UpAxis::y,
                      fmt::format("{} and {}", kAbcRate, kAbcUnit).c_str());
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
  takeFrameCount(heads_.empty() ? points_.size() : std::min(points_.size(), heads_.size()));
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
    if (Status added = addStrand(lengths->number(k)); !added) return added;
  }
  std::optional<double> diameter;
  if (widths && widths->kind == AbcKind::array) {
    const auto said = archive.stored(*widths, 0);
    if (!said) return said.error();
    if (said->numberCount() > 0) diameter = said->number(0);
  }
  return takeDiameter(diameter);
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
  const auto bytes = readSample(points_[at], kPointBytes * firstPoint().back());
  if (!bytes) return bytes.error();
  std::optional<UsdTransform> head;
  if (!heads_.empty()) {
    const auto numbers = readSample(heads_[at], kMatrixBytes);
    if (!numbers) return numbers.error();
    head = transformOf(*numbers);
  }
  return addPoints(frame, *bytes, head, points);
}

}  // namespace ringlet
