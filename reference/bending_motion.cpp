// Implements reference/bending_motion.h.
#include "reference/bending_motion.h"

#include <algorithm>
#include <cmath>

namespace ringlet::reference {
namespace {

bool isNear(const BendingMesh& mesh, Vec3d p) {
  for (const auto& [place, count] : {std::pair((p.x - mesh.origin.x) / mesh.cell, mesh.counts[0]),
                                     {(p.y - mesh.origin.y) / mesh.cell, mesh.counts[1]},
                                     {(p.z - mesh.origin.z) / mesh.cell, mesh.counts[2]}})
    if (place < -kMeshBand || place > double(count) + kMeshBand) return false;
  return true;
}

}  // namespace

template <class Real>
BendingMotion<Real>::BendingMotion(std::span<const Body> bodies) : bodies_(bodies.begin(), bodies.end()) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b].bends()) continue;
    bending_.push_back(b);
    now_.push_back(bodies_[b].mesh->surface.pointsOf(bodies_[b].mesh->points));
  }
}

template <class Real>
auto BendingMotion<Real>::samples(std::span<const BodyPose> start, std::span<const BodyPose> ends,
                                  BodyPoints points) const -> std::vector<Surfaces> {
  if (points.empty() || bending_.empty()) return {};
  const std::size_t steps = ends.size() / bodies_.size();
  const std::size_t count = points[0].size() / bodies_[bending_[0]].mesh->points.size();
  std::vector<Surfaces> all(count);
  for (std::size_t s = 0; s < count; ++s) {
    const double step = double((s + 1) * steps) / double(count);
    const auto whole = std::min(static_cast<std::size_t>(step), steps - 1);
    for (std::size_t m = 0; m < bending_.size(); ++m) {
      const std::size_t b = bending_[m], size = bodies_[b].mesh->points.size();
      const BodyPose& from = whole == 0 ? start[b] : ends[(whole - 1) * bodies_.size() + b];
      const BodyPose carrier = interpolate(from, ends[whole * bodies_.size() + b], step - double(whole));
      std::vector<Vec3d> seen;
      for (const Vec3d p : points[m].subspan(s * size, size))
        seen.push_back(rotate(carrier.rotation.conjugate(), p - carrier.position));
      all[s].push_back(bodies_[b].mesh->surface.pointsOf(seen));
    }
  }
  return all;
}

template <class Real>
void BendingMotion<Real>::beginFrame(std::span<const BodyPose> start, std::span<const BodyPose> ends,
                                     BodyPoints points) {
  const std::size_t steps = bodies_.empty() ? 0 : ends.size() / bodies_.size();
  at_.assign(steps + 1, 0.0);
  if (bending_.empty()) return;
  std::vector<Surfaces> way = samples(start, ends, points);
  way.insert(way.begin(), now_);

  // The largest way of a point near a grid, in cells.
  double most = 0;
  for (const std::size_t b : bending_)
    if (bodies_[b].isCloth()) most = double(way.size() - 1);
  for (std::size_t m = 0; m < bending_.size(); ++m) {
    const BendingMesh& mesh = *bodies_[bending_[m]].mesh;
    for (std::size_t i = 0; i < now_[m].size(); ++i) {
      double along = 0;
      bool counts = false;
      for (std::size_t s = 1; s < way.size(); ++s) {
        along += length(way[s][m][i] - way[s - 1][m][i]) / mesh.cell;
        counts = counts || isNear(mesh, way[s][m][i]) || isNear(mesh, way[s - 1][m][i]);
      }
      if (counts) most = std::max(most, along);
    }
  }
  const auto builds = static_cast<std::size_t>(std::clamp(std::ceil(most), 1.0, double(steps)));

  std::vector<std::size_t> ofStep;
  for (std::size_t g = 0; g <= builds; ++g) ofStep.push_back((g * steps + builds / 2) / builds);
  std::vector<Surfaces> at;
  for (const std::size_t step : ofStep) {
    const double sample = double(step) / double(steps) * double(way.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(sample), way.size() < 2 ? 0 : way.size() - 2);
    Surfaces surfaces = way[before];
    for (std::size_t m = 0; way.size() > 1 && m < surfaces.size(); ++m)
      for (std::size_t i = 0; i < surfaces[m].size(); ++i)
        surfaces[m][i] += (way[before + 1][m][i] - surfaces[m][i]) * (sample - double(before));
    at.push_back(std::move(surfaces));
  }
  fields_.clear();
  for (std::size_t g = 0; g <= builds; ++g) {
    std::vector<BendingField<Real>>& made = fields_.emplace_back();
    for (std::size_t m = 0; m < bending_.size(); ++m)
      made.push_back(bendingField<Real>(*bodies_[bending_[m]].mesh, at[g][m], at[std::min(g + 1, builds)][m],
                                        static_cast<Real>(kMeshBand)));
  }
  for (std::size_t g = 0; g < builds; ++g)
    for (std::size_t k = ofStep[g]; k < ofStep[g + 1]; ++k)
      at_[k] = double(g) + double(k - ofStep[g]) / double(ofStep[g + 1] - ofStep[g]);
  at_[steps] = double(builds);
  now_ = way.back();
}

template <class Real>
void BendingMotion<Real>::jump(std::span<const BodyPose> ends, BodyPoints points) {
  std::vector<Surfaces> way = samples(ends, ends, points);
  if (!way.empty()) now_ = way.back();
}

template <class Real>
BodyShapeAt<Real> BendingMotion<Real>::shapeAt(std::size_t b, std::size_t k) const {
  const auto bending = std::ranges::find(bending_, b);
  if (bending == bending_.end()) return {&bodies_[b], nullptr, 0};
  const auto field = static_cast<std::size_t>(at_[k]);
  return {&bodies_[b], &fields_[field][std::size_t(bending - bending_.begin())],
          static_cast<Real>(at_[k] - double(field))};
}

template class BendingMotion<float>;
template class BendingMotion<double>;

}  // namespace ringlet::reference
