// Implements scenes/scene_grooms.h.
#include "ringlet/scenes/scene_grooms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ringlet/bodies/bust_mesh.h"
#include "ringlet/bodies/mesh_scalp.h"

namespace ringlet {
namespace {

constexpr int kParticles = 64;  // eight a turn of the curl
constexpr int kSwatchColumns = 8, kSwatchRows = 4;
constexpr double kSpacing = 0.025;    // between the roots of copies [m]
constexpr double kCentimetre = 0.01;  // unit of the grooms' points [m]

// Copies of the strands of a groom, along X and then along Z.
Groom sideBySide(const Groom& groom, int count) {
  Groom copies;
  copies.metresPerUnit = groom.metresPerUnit;
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int k = 0; k < count; ++k) {
    const int row = k / columns;
    const Vec3f shift = Vec3f(Vec3d{double(k % columns), 0, double(row)} * (kSpacing / groom.metresPerUnit));
    std::vector<Vec3f> strand;
    for (Vec3f p : groom.strand(0)) strand.push_back(p + shift);
    copies.addStrand(strand);
  }
  return copies;
}

// Columns along X, rows along Z, hanging.
Result<Groom> hangingSwatch(const SceneOptions& options, int columns, int rows, std::uint64_t seed = 1) {
  SwatchParameters swatch;
  swatch.curl = sceneCurl(options);
  swatch.columnCount = columns;
  swatch.rowCount = options.strands ? (*options.strands + columns - 1) / columns : rows;
  swatch.variation.seed = seed;
  return makeSwatch(swatch);
}

// How a swatch that hangs comes to stand out from a wall, by where its hair then points; its rows are one
// above the other.
Vec3f hanging(Vec3f p) { return p; }
Vec3f alongZ(Vec3f p) { return {p.x, p.z, -p.y}; }
Vec3f againstZ(Vec3f p) { return {-p.x, p.z, p.y}; }
Vec3f alongX(Vec3f p) { return {-p.y, p.z, -p.x}; }

// Two grooms in one, the second after the first.
Groom joined(Groom first, const Groom& second) {
  for (std::size_t s = 0; s < second.strandCount(); ++s) first.addStrand(second.strand(s));
  return first;
}

void move(Groom& groom, Vec3d by) {
  for (Vec3f& p : groom.points) p += Vec3f(by / groom.metresPerUnit);
}

Result<Groom> headOf(const SceneOptions& options, int strands) {
  HeadParameters head;
  head.curl = sceneCurl(options);
  head.strandCount = options.strands.value_or(strands);
  return makeHead(head);
}

// A swatch of such a number of columns and rows, turned from hanging and then moved.
struct SwatchPlace {
  Vec3f (*turn)(Vec3f);
  Vec3d moved;  // [m]
};

// Two of them, the nearest cores of their rows `apart` along `across`, in which the second follows the first.
Result<Groom> twoSwatches(const SceneOptions& options, int columns, int rows, double apart, Vec3d across,
                          const SwatchPlace& firstPlace, const SwatchPlace& secondPlace) {
  auto first = hangingSwatch(options, columns, rows, 1), second = hangingSwatch(options, columns, rows, 2);
  if (!first || !second) return first ? second.error() : first.error();
  const double rowCount = static_cast<double>(first->strandCount()) / columns;
  const Vec3d middle = across * ((apart + (rowCount - 1) * kSpacing) / 2);
  for (Vec3f& p : first->points) p = firstPlace.turn(p);
  for (Vec3f& p : second->points) p = secondPlace.turn(p);
  move(*first, firstPlace.moved - middle);
  move(*second, secondPlace.moved + middle);
  return joined(std::move(*first), *second);
}

}  // namespace

CurlParameters sceneCurl(const SceneOptions& options) {
  CurlParameters curl;
  curl.particleCount = options.particles.value_or(kParticles);
  return curl;
}

Result<Groom> hangingCurls(const SceneOptions& options) {
  auto curl = makeCurl(sceneCurl(options));
  if (!curl) return curl.error();
  return sideBySide(*curl, options.strands.value_or(1));
}

Result<Groom> horizontalSwatch(const SceneOptions& options) {
  auto groom = hangingSwatch(options, kSwatchColumns, kSwatchRows);
  if (!groom) return groom.error();
  for (Vec3f& p : groom->points) p = alongZ(p);
  return groom;
}

// Two curls of one hand, half a turn about their cores from each other, 5 cm apart: pushed together they
// would cross twice a turn. (Of one phase they would lie in each other like spoons.) Their roots, which
// nothing stops, pass beside each other.
Result<Groom> twoCurls(const SceneOptions& options) {
  constexpr double kApart = 0.05;  // of their cores [m]
  if (options.strands) return Error{"two_curls has its two strands; leave the number of strands out"};
  CurlParameters curl = sceneCurl(options);
  curl.phase = -std::numbers::pi / 2;
  auto first = makeCurl(curl);
  if (!first) return first.error();
  curl.phase = std::numbers::pi / 2;
  auto second = makeCurl(curl);
  if (!second) return second.error();
  move(*first, {-kApart / 2, 0, 0});
  move(*second, {kApart / 2, 0, 0});
  return joined(std::move(*first), *second);
}

Result<Groom> curtain(const SceneOptions& options) {
  return twoSwatches(options, 10, 5, 0.1, {0, 0, 1}, {hanging, {}}, {hanging, {}});
}

//       | ======   second, along X
//             o o o    first, along Z
Result<Groom> pile(const SceneOptions& options) {
  return twoSwatches(options, 6, 2, 0.04, {0, 1, 0}, {alongZ, {0, 0, -0.125}}, {alongX, {-0.125, 0, 0}});
}

//       | ========      first
//           ======== |  second
Result<Groom> oneAboveTheOther(const SceneOptions& options) {
  return twoSwatches(options, 6, 2, 0.06, {0, -1, 0}, {alongZ, {0, 0, -0.15}}, {againstZ, {0, 0, 0.15}});
}

Result<Groom> wholeHead(const SceneOptions& options) { return headOf(options, 1500); }
Result<Groom> sparseHead(const SceneOptions& options) { return headOf(options, 100); }

Result<Groom> bustHair(const SceneOptions& options) {
  auto scalp = makeMeshScalp(makeBustMesh());
  if (!scalp) return scalp.error();
  HeadParameters head;
  head.curl = sceneCurl(options);
  head.curl.length = 0.33;
  head.curl.radius = 0.008;
  head.curl.turns = 5;
  head.strandCount = options.strands.value_or(500);
  head.lockCount = 150;
  head.bendLength = 0.02;
  head.cut = {.hairline = "natural", .parting = "middle", .layers = 0.1, .straightRoot = 0.25, .clump = 0.5};
  head.scalp = std::move(*scalp);
  return makeHead(head);
}

// A straight strand with one fold: two joints of nearly 180 degrees, a twentieth apart, that the smoothed
// curve glides over.
//
//      root o---->----->-----o       the fold's edges run back at an angle of kFoldTilt; drawn lying,
//                 o<----<---'        hangs along -Y
//                  `---->----->-----o tip
Result<Groom> foldedStrand(const SceneOptions& options) {
  constexpr double kLength = 0.25;    // along the strand [m]
  constexpr double kFoldTilt = 0.01;  // from folded flat [rad]
  const int particles = options.particles.value_or(kParticles);
  if (particles < 16 || particles > 65536) {
    return Error{
        fmt::format("twist_jump with {} particles: it takes 16 to 65536, to hold its fold", particles)};
  }
  const int edges = particles - 1, foldStart = edges / 3;
  const int foldEdges = std::max(2, static_cast<int>(std::lround(0.05 * edges)));
  const double edge = kLength / edges / kCentimetre;
  std::vector<Vec3f> strand;
  Vec3d p{};
  for (int i = 0; i < particles; ++i) {
    strand.push_back(Vec3f(p));
    const bool isFold = i >= foldStart && i < foldStart + foldEdges;
    p += isFold ? Vec3d{std::sin(kFoldTilt), std::cos(kFoldTilt), 0} * edge : Vec3d{0, -edge, 0};
  }
  Groom groom;
  groom.metresPerUnit = kCentimetre;
  groom.addStrand(strand);
  return sideBySide(groom, options.strands.value_or(1));
}

}  // namespace ringlet
