// Implements output/usd/usdc_reader.h. The layout is usdc_head.h's: all but the frames stands in front, and
// is read as any crate is (groom/usd/usdc_file.h); of the samples only where they are.
#include "ringlet/output/usd/usdc_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usdc_head.h"

namespace ringlet {
namespace {

using namespace usdc;

bool isMarked(std::span<const std::byte> begin) {
  return isUsdc(begin) && begin.size() >= kHeaderSize + kUsdcMark.size() &&
         std::ranges::equal(begin.subspan(kHeaderSize, kUsdcMark.size()),
                            std::as_bytes(std::span(kUsdcMark)));
}

const UsdAttribute* find(const UsdPrim& prim, std::string_view name) {
  const auto found = std::ranges::find(prim.attributes, name, &UsdAttribute::name);
  return found == prim.attributes.end() ? nullptr : &*found;
}

// The samples that have a value, up to the first that has none.
std::vector<std::uint64_t> valuesOf(const UsdAttribute* attribute) {
  std::vector<std::uint64_t> values;
  if (!attribute) return values;
  for (const UsdSamplePlace& place : attribute->places) {
    if (Rep{place.rep}.type() == kBlockType) break;
    values.push_back(place.rep);
  }
  return values;
}

}  // namespace

bool UsdcReader::isOurs(const std::filesystem::path& path) {
  auto file = ReadFile::open(path);
  std::vector<std::byte> begin;
  return file && file->readAt(0, kHeaderSize + kUsdcMark.size(), begin) && isMarked(begin);
}

Result<UsdcReader> UsdcReader::open(const std::filesystem::path& path) {
  auto file = ReadFile::open(path);
  if (!file) return file.error();
  UsdcReader reader(std::move(*file));
  if (Status read = reader.readHead(); !read) return read.error();
  return reader;
}

Status UsdcReader::readHead() {
  const std::uint64_t beginBytes = kHeaderSize + kUsdcMark.size();
  if (byteCount() < beginBytes) return wrong(fmt::format("has {} bytes", byteCount()));
  const auto begin = read(0, beginBytes);
  if (!begin) return begin.error();
  if (!isMarked(*begin)) return wrong("does not begin as a Ringlet crate does");

  // The table of contents ends it.
  const std::uint64_t table = readU64(*begin, kTableOffset), tableBytes = 8 + kSectionSize * kSections.size();
  if (table > byteCount() || tableBytes > byteCount() - table)
    return wrong(fmt::format("says its table of contents is at byte {}", table));
  const auto head = read(0, table + tableBytes);
  return head ? readLayer(*head) : Status{head.error()};
}

Status UsdcReader::readLayer(const std::vector<std::byte>& head) {
  const auto layer = readUsdc(head, path().string(), {.keepsPlaces = true});
  if (!layer) return layer.error();
  if (Status taken =
          takeMeasures(layer->timeCodesPerSecond.value_or(0), layer->metresPerUnit.value_or(0),
                       layer->upAxis == "Z" ? UpAxis::z : UpAxis::y, "timeCodesPerSecond and metersPerUnit");
      !taken)
    return taken;

  std::optional<double> diameter;
  std::size_t frames = std::numeric_limits<std::size_t>::max();
  for (const UsdPrim& prim : layer->prims) {
    if (prim.type != "BasisCurves") continue;
    const UsdAttribute *counts = find(prim, "curveVertexCounts"), *widths = find(prim, "widths");
    const std::uint32_t first = firstPoint().back();
    for (const double count : counts ? counts->value.numbers : std::vector<double>{}) {
      if (Status added = addStrand(count); !added) return added;
    }
    if (curves_.empty() && widths && !widths->value.numbers.empty()) diameter = widths->value.numbers.front();
    Curves curves{
        .pointCount = firstPoint().back() - first, .points = valuesOf(find(prim, kUsdPoints)), .heads = {}};
    frames = std::min(frames, curves.points.size());
    if (const UsdAttribute* headMotion = find(prim, kUsdHead)) {
      curves.heads = valuesOf(headMotion);
      frames = std::min(frames, curves.heads.size());
    }
    curves_.push_back(std::move(curves));
  }
  if (Status taken = takeDiameter(diameter); !taken) return taken;
  takeFrameCount(frames);
  return {};
}

Status UsdcReader::readFrame(int frame, std::vector<Vec3f>& points) {
  points.clear();
  for (const Curves& curves : curves_) {
    if (Status read = readPoints(curves, frame, points); !read) return read;
  }
  return {};
}

Status UsdcReader::readPoints(const Curves& curves, int frame, std::vector<Vec3f>& points) {
  const Rep rep{curves.points[static_cast<std::size_t>(frame) - 1]};
  if (!rep.isArray() || rep.isInline() || rep.isPacked() || !rep.isKnown() || rep.type() != kVec3fType)
    return damaged(frame, "its points are no array of points");
  const auto bytes = read(rep.payload(), 8 + kPointBytes * std::uint64_t{curves.pointCount});
  if (!bytes) return bytes.error();
  if (readU64(*bytes, 0) != curves.pointCount) return damaged(frame, "it has another number of points");

  std::optional<UsdTransform> head;
  if (!curves.heads.empty()) {
    const Rep matrix{curves.heads[static_cast<std::size_t>(frame) - 1]};
    if (matrix.isArray() || matrix.isInline() || !matrix.isKnown() || matrix.type() != kMatrix4dType)
      return damaged(frame, "its transform is no matrix");
    const auto numbers = read(matrix.payload(), kMatrixBytes);
    if (!numbers) return numbers.error();
    head = transformOf(*numbers);
  }
  return addPoints(frame, std::span(*bytes).subspan(8), head, points);
}

}  // namespace ringlet
