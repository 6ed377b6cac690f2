// Implements follow/scalp_roots.h.
#include "ringlet/follow/scalp_roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/sample_elimination.h"
#include "ringlet/groom/seeded_random.h"

namespace ringlet {
namespace {

constexpr double kRootReach = 0.75;  // of a guide's part of the scalp, in the distance of its neighbours
constexpr double kLoneRootRadius = 0.0025;  // of a guide without neighbours [m]
constexpr double kFarthest = 0.01;          // of a guide's root from the mesh [m]
constexpr std::size_t kRootNeighbours = 8;
constexpr std::size_t kTries = 3;        // places of which one stays
constexpr std::size_t kMostLevels = 10;  // of ranks: 2^-10 is below the least density

// The part of the mesh that hair grows on.
class HairyScalp {
 public:
  HairyScalp(const TriangleMesh& mesh, std::span<const GuideRest> guides) : mesh_(mesh), near_(guides) {
    const TriangleTree tree(mesh);
    for (const GuideRest& guide : guides) {
      const auto nearest = tree.nearest(guide.root);
      farthest_ = std::max(farthest_, nearest.distance);
      normals_.push_back(normalOf(nearest.triangle));
      reaches_.push_back(reachOf(guide.root) + nearest.distance);
    }
    const double most = std::ranges::max(reaches_);
    double area = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!isNear(t, most)) continue;
      triangles_.push_back(t);
      areas_.push_back(area += length(normalOf(t)) / 2);
    }
  }

  double farthestGuide() const { return farthest_; }
  double area() const { return areas_.empty() ? 0 : areas_.back(); }  // of what may be hairy [m^2]

  /// Evenly by chance on what may be hairy; whether it is.
  bool place(SeededRandom& random, Vec3d& found) const {
    const double at = random.uniform() * area();
    const auto k = static_cast<std::size_t>(std::ranges::upper_bound(areas_, at) - areas_.begin());
    const std::uint32_t triangle = triangles_[std::min(k, triangles_.size() - 1)];
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const auto [a, b, c] = mesh_.triangles[triangle];
    found =
        mesh_.points[a] + (mesh_.points[b] - mesh_.points[a]) * u + (mesh_.points[c] - mesh_.points[a]) * v;
    const NearGuides::Near near = near_.at(found, 1).front();
    return near.distance <= reaches_[near.guide] && dot(normalOf(triangle), normals_[near.guide]) > 0;
  }

 private:
  Vec3d normalOf(std::uint32_t triangle) const {  // of twice the area's length
    const auto [a, b, c] = mesh_.triangles[triangle];
    return cross(mesh_.points[b] - mesh_.points[a], mesh_.points[c] - mesh_.points[a]);
  }
  double reachOf(Vec3d root) const {
    std::vector<double> apart;
    for (const auto& other : near_.at(root, kRootNeighbours + 1))
      if (other.distance > 0) apart.push_back(other.distance);
    return apart.empty() ? kLoneRootRadius : kRootReach * apart[apart.size() / 2];
  }
  // Within the sphere about its middle some place may be within reach of a guide.
  bool isNear(std::uint32_t triangle, double reach) const {
    Vec3d middle{};
    for (const std::uint32_t point : mesh_.triangles[triangle]) middle += mesh_.points[point] / 3.0;
    double radius = 0;
    for (const std::uint32_t point : mesh_.triangles[triangle])
      radius = std::max(radius, length(mesh_.points[point] - middle));
    return near_.at(middle, 1).front().distance <= radius + reach;
  }

  const TriangleMesh& mesh_;
  const NearGuides near_;
  std::vector<Vec3d> normals_;   // of each guide's triangle
  std::vector<double> reaches_;  // of each guide [m]
  std::vector<std::uint32_t> triangles_;
  std::vector<double> areas_;  // summed up
  double farthest_ = 0;
};

// Halves that are evenly spread themselves have ranks up to a half, and so on; by chance within each.
std::vector<float> ranksOf(const std::vector<Vec3d>& places, double area, std::uint64_t seed) {
  std::vector<float> ranks(places.size());
  std::vector<std::uint32_t> left(places.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  double high = 1;
  for (std::size_t level = 0; level < kMostLevels && left.size() > 1; ++level, high /= 2) {
    std::vector<Vec3d> rest;
    for (const std::uint32_t i : left) rest.push_back(places[i]);
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t i : left) ranks[i] = -1;
    for (const std::uint32_t k : eliminateSamples(rest, left.size() / 2, area)) kept.push_back(left[k]);
    for (const std::uint32_t i : kept) ranks[i] = 0;
    for (const std::uint32_t i : left)
      if (ranks[i] < 0) ranks[i] = static_cast<float>(high * (1 - 0.5 * SeededRandom(seed, i).uniform()));
    left = std::move(kept);
  }
  for (const std::uint32_t i : left)
    ranks[i] = static_cast<float>(high * (1 - SeededRandom(seed, i).uniform()));
  return ranks;
}

}  // namespace

Result<ScalpRoots> scatterRoots(const TriangleMesh& scalp, std::span<const GuideRest> guides, int count,
                                std::uint64_t seed) {
  if (guides.empty()) return Error{"there is no guide that hairs could follow"};
  if (Status checked = checkMesh(scalp); !checked) return checked.error();
  const HairyScalp ground(scalp, guides);
  if (!(ground.farthestGuide() <= kFarthest && ground.area() > 0))
    return Error{fmt::format(
        "a strand's root is {:.4g} m from the mesh that hairs grow on; expected at most {} m. Are unit, up "
        "axis and place those the groom was made for?",
        ground.farthestGuide(), kFarthest)};
  const auto wanted = kTries * static_cast<std::size_t>(count);
  std::vector<Vec3d> tried;
  SeededRandom random(seed, 0);
  std::size_t draws = 0;
  for (; tried.size() < wanted; ++draws) {
    if (draws == 1000 * wanted) return Error{"next to nothing of the mesh is where strands stand"};
    Vec3d place;
    if (ground.place(random, place)) tried.push_back(place);
  }
  const double area = ground.area() * static_cast<double>(tried.size()) / static_cast<double>(draws);
  ScalpRoots roots;
  for (const std::uint32_t i : eliminateSamples(tried, static_cast<std::size_t>(count), area))
    roots.places.push_back(tried[i]);
  roots.ranks = ranksOf(roots.places, area, seed);
  return roots;
}

}  // namespace ringlet
