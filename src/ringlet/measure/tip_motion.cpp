// Implements measure/tip_motion.h.
#include "ringlet/measure/tip_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace ringlet {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kClosingSeconds = 1;
constexpr double kSettledShare = 0.01;  // relative to the greatest excursion
constexpr std::size_t kFewestFrames = 8;
constexpr std::size_t kPadding = 8;     // factor by which the frequency grid is finer than that of the path
constexpr double kLeastPower = 0.05;    // relative to the greatest power: 22 % of its amplitude
constexpr double kFewestPeriods = 1.5;  // with fewer, a slow creep looks like an oscillation

// The mean of the closing frames.
template <class T>
T closingMean(std::span<const T> values, double framesPerSecond) {
  const std::size_t count = closingFrameCount(values.size(), framesPerSecond);
  T sum{};
  for (T value : values.last(count)) sum += value;
  return sum / static_cast<double>(count);
}

// The direction in which displacements vary most, by power iteration on their covariance.
Vec3d dominantDirection(std::span<const Vec3d> displacements) {
  std::array<Vec3d, 3> rows{};
  for (Vec3d d : displacements) {
    rows[0] += d * d.x;
    rows[1] += d * d.y;
    rows[2] += d * d.z;
  }
  Vec3d direction = *std::ranges::max_element(rows, {}, [](Vec3d row) { return dot(row, row); });
  for (int i = 0; i < 64; ++i) {
    direction = normalizedOr(direction, Vec3d{0, 1, 0});
    direction = {dot(rows[0], direction), dot(rows[1], direction), dot(rows[2], direction)};
  }
  return normalizedOr(direction, Vec3d{0, 1, 0});
}

// Cooley and Tukey, in place; the size is a power of two.
void fourierTransform(std::vector<std::complex<double>>& values) {
  const std::size_t count = values.size();
  for (std::size_t i = 1, reversed = 0; i < count; ++i) {
    std::size_t bit = count / 2;
    for (; reversed & bit; bit /= 2) reversed ^= bit;
    reversed ^= bit;
    if (i < reversed) std::swap(values[i], values[reversed]);
  }
  for (std::size_t size = 2; size <= count; size *= 2) {
    for (std::size_t k = 0; k < size / 2; ++k) {
      const auto turn = std::polar(1.0, -2 * kPi * static_cast<double>(k) / static_cast<double>(size));
      for (std::size_t i = k; i < count; i += size) {
        const std::complex<double> odd = turn * values[i + size / 2];
        values[i + size / 2] = values[i] - odd;
        values[i] += odd;
      }
    }
  }
}

}  // namespace

std::size_t closingFrameCount(std::size_t frameCount, double framesPerSecond) {
  const auto second = static_cast<std::size_t>(std::max(1.0, std::round(kClosingSeconds * framesPerSecond)));
  return std::max<std::size_t>(1, std::min(second, frameCount / 2));
}

std::optional<double> strongestFrequency(std::span<const double> signal, double framesPerSecond) {
  if (signal.size() < kFewestFrames) return std::nullopt;

  // A window that fades the signal out towards its end, so that cutting it off causes no side lobes; its
  // start is a real start.
  std::size_t size = 1;
  while (size < kPadding * signal.size()) size *= 2;
  std::vector<std::complex<double>> values(size);
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double fade = std::cos(kPi / 2 * static_cast<double>(k) / static_cast<double>(signal.size()));
    values[k] = signal[k] * fade * fade;
  }
  fourierTransform(values);

  // The highest peak. A signal that only decays has its power at 0 and no peak.
  const double step = framesPerSecond / static_cast<double>(size);
  const double lowest = kFewestPeriods * framesPerSecond / static_cast<double>(signal.size());
  auto power = [&](std::size_t k) { return std::norm(values[k]); };
  double most = power(0);
  std::size_t highest = 0;
  for (std::size_t k = 1; k + 1 < size / 2; ++k) {
    most = std::max(most, power(k));
    if (static_cast<double>(k) * step < lowest || power(k) < power(k - 1) || power(k) <= power(k + 1))
      continue;
    if (highest == 0 || power(k) > power(highest)) highest = k;
  }
  if (highest == 0 || power(highest) < kLeastPower * most) return std::nullopt;

  // Its place between grid frequencies, by a parabola.
  const double before = power(highest - 1), after = power(highest + 1);
  const double curvature = before - 2 * power(highest) + after;
  const double shift = curvature < 0 ? (before - after) / (2 * curvature) : 0;
  return (static_cast<double>(highest) + shift) * step;
}

std::optional<double> bounceFrequency(std::span<const double> coreLengths, double framesPerSecond,
                                      double smallest) {
  if (coreLengths.empty()) return std::nullopt;
  const double final = closingMean(coreLengths, framesPerSecond);
  std::vector<double> signal;
  double greatest = 0;
  for (double coreLength : coreLengths) {
    signal.push_back(coreLength - final);
    greatest = std::max(greatest, std::abs(signal.back()));
  }
  if (!(greatest > smallest)) return std::nullopt;
  return strongestFrequency(signal, framesPerSecond);
}

std::optional<double> swayFrequency(std::span<const Vec3d> path, double framesPerSecond, double smallest) {
  if (path.empty()) return std::nullopt;
  const Vec3d final = closingMean(path, framesPerSecond);
  const Vec3d axis = normalizedOr(final, Vec3d{});
  std::vector<Vec3d> displacements;
  double greatest = 0;
  for (Vec3d p : path) {
    const Vec3d displacement = p - final;
    displacements.push_back(displacement - axis * dot(displacement, axis));
    greatest = std::max(greatest, length(displacements.back()));
  }
  if (!(greatest > smallest)) return std::nullopt;

  const Vec3d direction = dominantDirection(displacements);
  std::vector<double> signal;
  for (Vec3d displacement : displacements) signal.push_back(dot(displacement, direction));
  return strongestFrequency(signal, framesPerSecond);
}

std::optional<double> settleSeconds(std::span<const Vec3d> path, double framesPerSecond,
                                    std::size_t freeFrame, double smallest) {
  if (path.empty()) return std::nullopt;
  const std::size_t closing = path.size() - closingFrameCount(path.size(), framesPerSecond);
  if (freeFrame > closing) return std::nullopt;
  const Vec3d final = closingMean(path, framesPerSecond);
  double greatest = 0;
  for (Vec3d p : path) greatest = std::max(greatest, length(p - final));
  const double limit = std::max(kSettledShare * greatest, smallest);

  for (std::size_t k = path.size(); k-- > 0;) {
    const double distance = length(path[k] - final);
    if (distance <= limit) continue;
    if (k >= closing) return std::nullopt;
    // The time at which it went below the limit, between this frame and the next.
    const double crossing = (distance - limit) / (distance - length(path[k + 1] - final));
    const double frames = static_cast<double>(k) + crossing - static_cast<double>(freeFrame);
    return std::max(0.0, frames / framesPerSecond);
  }
  return 0;
}

}  // namespace ringlet
