// Implements scene/wind.h.
#include "ringlet/scene/wind.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace ringlet {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kFrameCount = kWindModeCount / 3;  // of axes at right angles; three modes each
static_assert(kFrameCount * 3 == kWindModeCount);

// What numbers are drawn for, so that none of them is another's.
enum Stream : std::uint64_t { kGusts, kDirections, kPhases, kSigns };

// The finaliser of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Uniform in [0, 1), 53 bits: number `index` of a stream.
double uniformAt(std::uint32_t seed, Stream stream, std::int64_t index) {
  const std::uint64_t start = mixed((std::uint64_t{stream} << 32) | seed);
  return static_cast<double>(mixed(start ^ static_cast<std::uint64_t>(index)) >> 11) * 0x1p-53;
}

// A rotation, all equally likely, from three uniform numbers (Shoemake, "Uniform random rotations", 1992).
Quatd rotationOf(double a, double b, double c) {
  const double r = std::sqrt(1 - a), s = std::sqrt(a);
  return {r * std::sin(kTurn * b), r * std::cos(kTurn * b), s * std::sin(kTurn * c), s * std::cos(kTurn * c)};
}

}  // namespace

// Modes come in threes that share a frame of axes, turned at random: wave along one axis, amplitude along the
// next. The three amplitudes are equal and at right angles, so that the wind's mean square is the same in all
// directions exactly, which twelve free directions would give to a quarter only.
//
// Wave numbers k_j = 2 pi / L * 4^(j/11). Kolmogorov's spectrum E(k) ~ k^(-5/3), cut into equal shares of log
// k, gives a mode energy in proportion to k^(-2/3) and amplitude to k^(-1/3), k the middle of its three.
std::vector<WindMode> windModes(const AirSettings& air) {
  if (!(air.turbulence > 0)) return {};
  const auto share = [](double j) { return std::pow(4, j / (kWindModeCount - 1)); };  // k_j over the smallest
  // A cosine's mean square is 1/2, and a frame gives each direction one amplitude's.
  double meanSquare = 0;
  for (int frame = 0; frame < kFrameCount; ++frame)
    meanSquare += std::pow(share(3 * frame + 1), -2.0 / 3) / 2;
  const double unit = air.turbulence / std::sqrt(meanSquare);  // amplitude at the smallest wave number [m/s]

  const Vec3d axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<WindMode> modes;
  for (int j = 0; j < kWindModeCount; ++j) {
    const int frame = j / 3;
    const auto draw = [&](int i) { return uniformAt(air.seed, kDirections, 3 * frame + i); };
    const Quatd rotation = rotationOf(draw(0), draw(1), draw(2));
    const double k = kTurn / air.eddySize * share(j);
    const double sign = uniformAt(air.seed, kSigns, j) < 0.5 ? -1 : 1;
    modes.push_back(
        {.wave = k * rotate(rotation, axes[j % 3]),
         .amplitude = unit * std::pow(share(3 * frame + 1), -1.0 / 3) * rotate(rotation, axes[(j + 1) % 3]),
         .frequency = sign * k * air.turbulence,  // as the large eddies sweep the small ones along
         .phase = kTurn * uniformAt(air.seed, kPhases, j)});
  }
  return modes;
}

double phaseAt(const WindMode& mode, Vec3d origin, double t) {
  const double phase = dot(mode.wave, origin) + mode.frequency * t + mode.phase;
  const double folded = phase - kTurn * std::floor(phase / kTurn);
  return folded >= 0 && folded < kTurn ? folded : 0;  // rounding may leave it at either end
}

// Value noise: a uniform number at every third of gustSeconds, since one in three of such a row is greater
// than its two neighbours; between them a curve of fifth order (Perlin, "Improving noise", 2002), smooth to
// the second derivative and symmetric, which keeps the mean.
Vec3d evenWindAt(const AirSettings& air, double t) {
  if (air.gust == 0) return air.wind;
  const double place = t / (air.gustSeconds / 3), cell = std::floor(place), x = place - cell;
  const auto index = static_cast<std::int64_t>(cell);
  const double from = uniformAt(air.seed, kGusts, index), to = uniformAt(air.seed, kGusts, index + 1);
  const double swell = from + (to - from) * (x * x * x * (x * (6 * x - 15) + 10));
  return air.wind * (1 + air.gust * swell);
}

}  // namespace ringlet
