// Implements output/usd/usdc_reader.h. The layout is usdc_head.h's: all but the frames stands in front, and
// is read as any crate is (groom/usd/usdc_file.h); of the samples only where they are.
#include "ringlet/output/usd/usdc_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

constexpr double kUsualWidth = 0.0005;  // of strands whose file does not say it [m]
constexpr std::size_t kPointBytes = 12, kMatrixBytes = 128;

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
  UsdcReader reader;
  auto opened = openToRead(path);
  if (!opened) return false;
  reader.file_ = std::move(*opened);
  reader.size_ = kHeaderSize + kUsdcMark.size();
  const auto begin = reader.read(0, reader.size_);
  return begin && isMarked(*begin);
}

Result<UsdcReader> UsdcReader::open(const std::filesystem::path& path) {
  UsdcReader reader;
  reader.path_ = path;
  auto opened = openToRead(path);
  if (!opened) return opened.error();
  reader.file_ = std::move(*opened);
  std::error_code code;
  reader.size_ = std::filesystem::file_size(path, code);
  if (Status read = reader.readHead(); !read) return read.error();
  return reader;
}

Error UsdcReader::wrong(const std::string& what) const {
  return Error{fmt::format("{}: {}; only animations that Ringlet wrote can be read", path_.string(), what)};
}

Result<std::vector<std::byte>> UsdcReader::read(std::uint64_t at, std::uint64_t count) {
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

Status UsdcReader::readHead() {
  const std::uint64_t beginBytes = kHeaderSize + kUsdcMark.size();
  if (size_ < beginBytes) return wrong(fmt::format("has {} bytes", size_));
  const auto begin = read(0, beginBytes);
  if (!begin) return begin.error();
  if (!isMarked(*begin)) return wrong("does not begin as a Ringlet crate does");

  // The table of contents ends it.
  const std::uint64_t table = readU64(*begin, kTableOffset), tableBytes = 8 + kSectionSize * kSections.size();
  if (table > size_ || tableBytes > size_ - table)
    return wrong(fmt::format("says its table of contents is at byte {}", table));
  const auto head = read(0, table + tableBytes);
  return head ? readLayer(*head) : Status{head.error()};
}

Status UsdcReader::readLayer(const std::vector<std::byte>& head) {
  const std::string name = path_.string();
  const auto layer = readUsdc(head, name, {.keepsPlaces = true});
  if (!layer) return layer.error();
  framesPerSecond_ = layer->timeCodesPerSecond.value_or(0);
  metresPerUnit_ = layer->metresPerUnit.value_or(0);
  if (!(framesPerSecond_ > 0) || !(metresPerUnit_ > 0) || !std::isfinite(framesPerSecond_ + metresPerUnit_))
    return wrong("has no timeCodesPerSecond and metersPerUnit above 0");
  up_ = layer->upAxis == "Z" ? UpAxis::z : UpAxis::y;

  std::size_t frames = std::numeric_limits<std::int32_t>::max();
  for (const UsdPrim& prim : layer->prims) {
    if (prim.type != "BasisCurves") continue;
    const UsdAttribute *counts = find(prim, "curveVertexCounts"), *widths = find(prim, "widths");
    const std::uint64_t first = firstPoint_.back();
    std::uint64_t total = first;
    for (const double count : counts ? counts->value.numbers : std::vector<double>{}) {
      if (!(count >= 1 && count <= 1e9)) return wrong(fmt::format("has a strand of {} particles", count));
      total += static_cast<std::uint64_t>(count);
      if (total > std::numeric_limits<std::uint32_t>::max()) return wrong("has more than 2^32 - 1 particles");
      firstPoint_.push_back(static_cast<std::uint32_t>(total));
    }
    if (curves_.empty())
      diameter_ = widths && !widths->value.numbers.empty() ? static_cast<float>(widths->value.numbers.front())
                                                           : static_cast<float>(kUsualWidth / metresPerUnit_);
    Curves curves{.pointCount = static_cast<std::uint32_t>(total - first),
                  .points = valuesOf(find(prim, kUsdPoints)),
                  .heads = {}};
    frames = std::min(frames, curves.points.size());
    if (const UsdAttribute* headMotion = find(prim, kUsdHead)) {
      curves.heads = valuesOf(headMotion);
      frames = std::min(frames, curves.heads.size());
    }
    curves_.push_back(std::move(curves));
  }
  if (firstPoint_.size() == 1) return wrong("has no strands");
  if (!(diameter_ > 0) || !std::isfinite(diameter_)) return wrong("has no widths above 0");
  frameCount_ = static_cast<int>(frames);

  // Of a frame whose bytes were lost, the head may know.
  std::vector<Vec3f> points;
  const int stated = frameCount_;
  for (; frameCount_ > 0; --frameCount_) {
    if (readFrame(frameCount_, points)) break;
  }
  if (frameCount_ < stated)
    warnings_.push_back(
        fmt::format("its end is torn and left out, after {} whole frames of {}", frameCount_, stated));
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
  const auto damaged = [&](const char* what) {
    return Error{fmt::format("{}: frame {} is damaged: {}", path_.string(), frame, what)};
  };
  const Rep rep{curves.points[static_cast<std::size_t>(frame) - 1]};
  if (!rep.isArray() || rep.isInline() || rep.isPacked() || !rep.isKnown() || rep.type() != kVec3fType)
    return damaged("its points are no array of points");
  const auto bytes = read(rep.payload(), 8 + kPointBytes * std::uint64_t{curves.pointCount});
  if (!bytes) return bytes.error();
  if (readU64(*bytes, 0) != curves.pointCount) return damaged("it has another number of points");

  UsdTransform head;
  if (!curves.heads.empty()) {
    const Rep matrix{curves.heads[static_cast<std::size_t>(frame) - 1]};
    if (matrix.isArray() || matrix.isInline() || !matrix.isKnown() || matrix.type() != kMatrix4dType)
      return damaged("its transform is no matrix");
    const auto numbers = read(matrix.payload(), kMatrixBytes);
    if (!numbers) return numbers.error();
    const auto row = [&](std::size_t i) {
      return Vec3d{readF64(*numbers, 32 * i), readF64(*numbers, 32 * i + 8), readF64(*numbers, 32 * i + 16)};
    };
    head = {{row(0), row(1), row(2)}, row(3)};
  }
  for (std::size_t i = 0; i < curves.pointCount; ++i) {
    const auto number = [&](std::size_t axis) { return readF32(*bytes, 8 + kPointBytes * i + 4 * axis); };
    Vec3f p{number(0), number(1), number(2)};
    if (!curves.heads.empty()) p = Vec3f(head(Vec3d(p)));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return damaged("a point is not finite");
    points.push_back(p);
  }
  return {};
}

}  // namespace ringlet
