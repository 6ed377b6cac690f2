// Implements output/cache_frame.h.
#include "ringlet/output/cache_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "ringlet/base/little_endian.h"

namespace ringlet::cache {
namespace {

constexpr double kMostSteps = 65535;
constexpr double kLargest = std::numeric_limits<float>::max();

// A signed number, its sign in the lowest bit.
std::uint32_t folded(std::uint32_t n) { return n << 1 ^ (n >> 31 ? ~0u : 0u); }
std::uint32_t unfolded(std::uint32_t n) { return n >> 1 ^ (n & 1 ? ~0u : 0u); }
// 16-bit steps are better off as they are.
std::uint16_t folded(std::uint16_t n) { return n; }
std::uint16_t unfolded(std::uint16_t n) { return n; }

// Leaves the differences in `words`.
template <class Word>
void putPlanes(std::span<Word> words, std::byte* at) {
  const std::size_t count = words.size();
  for (std::size_t i = count - 1; i > 0; --i) words[i] = folded(static_cast<Word>(words[i] - words[i - 1]));
  words[0] = folded(words[0]);
  for (int shift = 8 * (sizeof(Word) - 1); shift >= 0; shift -= 8, at += count) {
    for (std::size_t i = 0; i < count; ++i) at[i] = static_cast<std::byte>(words[i] >> shift);
  }
}

template <class Word>
std::vector<Word> takePlanes(std::span<const std::byte> bytes) {
  const std::size_t count = bytes.size() / sizeof(Word);
  std::vector<Word> words(count);
  for (std::size_t plane = 0; plane < sizeof(Word); ++plane) {
    const std::byte* at = bytes.data() + plane * count;
    for (std::size_t i = 0; i < count; ++i)
      words[i] = static_cast<Word>(words[i] << 8 | std::to_integer<Word>(at[i]));
  }
  Word last = 0;
  for (Word& word : words) word = last = static_cast<Word>(last + unfolded(word));
  return words;
}

struct Corners {
  Vec3f low, high;
};

Corners cornersOf(std::span<const Vec3f> points) {
  Corners box{points[0], points[0]};
  for (Vec3f p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

// The least step of which 65,535 reach across `side`.
float stepAcross(double side) {
  float step = static_cast<float>(side / kMostSteps);
  while (step * kMostSteps < side) step = std::nextafter(step, std::numeric_limits<float>::max());
  return step;
}

}  // namespace

std::uint64_t frameBytes(CachePrecision precision, std::uint64_t strandCount, std::uint64_t particleCount) {
  return precision == CachePrecision::float32 ? 12 * particleCount : 4 + 12 * strandCount + 6 * particleCount;
}

std::span<const std::byte> FrameEncoder::encode(CachePrecision precision,
                                                std::span<const std::uint32_t> firstPoint,
                                                std::span<const Vec3f> points) {
  errorBound_ = 0;
  const std::size_t count = points.size();
  if (precision == CachePrecision::bits16) {
    encodeSteps(firstPoint, points);
    return content_;
  }
  bits_.resize(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    bits_[i] = std::bit_cast<std::uint32_t>(points[i].x);
    bits_[count + i] = std::bit_cast<std::uint32_t>(points[i].y);
    bits_[2 * count + i] = std::bit_cast<std::uint32_t>(points[i].z);
  }
  content_.resize(frameBytes(precision, 0, count));
  putPlanes<std::uint32_t>(bits_, content_.data());
  return content_;
}

void FrameEncoder::encodeSteps(std::span<const std::uint32_t> firstPoint, std::span<const Vec3f> points) {
  // Each strand has a box of its own, all have one step: that across the longest side of any box.
  const std::size_t count = points.size(), strandCount = firstPoint.size() - 1;
  double side = 0, farthest = 0;
  std::vector<Vec3f> lows(strandCount);
  for (std::size_t s = 0; s < strandCount; ++s) {
    const Corners box = cornersOf(points.subspan(firstPoint[s], firstPoint[s + 1] - firstPoint[s]));
    const Vec3d low(box.low), high(box.high), size = high - low;
    side = std::max({side, size.x, size.y, size.z});
    for (double end : {low.x, low.y, low.z, high.x, high.y, high.z})
      farthest = std::max(farthest, std::abs(end));
    lows[s] = box.low;
  }
  const float step = stepAcross(side);

  // Half a step and what rounding to float adds, of every coordinate. The double's own rounding is far below
  // the thousandth.
  const double rounding = (farthest + step) * 0x1p-24 + std::numeric_limits<float>::denorm_min();
  errorBound_ = step > 0 ? std::sqrt(3.0) * (0.5 * step + rounding) * 1.001 : 0;

  // Positions as numbers of steps.
  steps_.resize(3 * count);
  std::uint16_t *x = steps_.data(), *y = x + count, *z = y + count;
  const double perStep = step > 0 ? 1.0 / step : 0;
  for (std::size_t s = 0; s < strandCount; ++s) {
    const Vec3d low(lows[s]);
    for (std::size_t i = firstPoint[s]; i < firstPoint[s + 1]; ++i) {
      x[i] = static_cast<std::uint16_t>(static_cast<int>((points[i].x - low.x) * perStep + 0.5));
      y[i] = static_cast<std::uint16_t>(static_cast<int>((points[i].y - low.y) * perStep + 0.5));
      z[i] = static_cast<std::uint16_t>(static_cast<int>((points[i].z - low.z) * perStep + 0.5));
    }
  }
  content_.clear();
  appendF32(content_, step);
  for (Vec3f low : lows) {
    for (float value : {low.x, low.y, low.z}) appendF32(content_, value);
  }
  const std::size_t planesAt = content_.size();
  content_.resize(frameBytes(CachePrecision::bits16, strandCount, count));
  putPlanes<std::uint16_t>(steps_, content_.data() + planesAt);
}

bool decodeFrame(CachePrecision precision, std::span<const std::uint32_t> firstPoint,
                 std::span<const std::byte> content, std::span<Vec3f> points) {
  const std::size_t count = points.size();
  bool isFinite = true;
  if (precision == CachePrecision::float32) {
    const auto bits = takePlanes<std::uint32_t>(content);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f p{std::bit_cast<float>(bits[i]), std::bit_cast<float>(bits[count + i]),
                    std::bit_cast<float>(bits[2 * count + i])};
      isFinite = isFinite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
      points[i] = p;
    }
    return isFinite;
  }
  const std::size_t strandCount = firstPoint.size() - 1;
  const auto steps = takePlanes<std::uint16_t>(content.subspan(4 + 12 * strandCount));
  const double step = readF32(content, 0);
  isFinite = std::isfinite(step);
  // The end of a box may be half a step beyond what a float holds.
  const auto placed = [&](double low, std::uint16_t n) {
    return static_cast<float>(std::clamp(low + n * step, -kLargest, kLargest));
  };
  for (std::size_t s = 0; isFinite && s < strandCount; ++s) {
    const std::size_t at = 4 + 12 * s;
    const double x = readF32(content, at), y = readF32(content, at + 4), z = readF32(content, at + 8);
    isFinite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    for (std::size_t i = firstPoint[s]; i < firstPoint[s + 1]; ++i)
      points[i] = {placed(x, steps[i]), placed(y, steps[count + i]), placed(z, steps[2 * count + i])};
  }
  return isFinite;
}

}  // namespace ringlet::cache
