// Implements scene/body.h.
#include "ringlet/scene/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scene/outside_numbers.h"
#include "ringlet/scene/setting_check.h"

namespace ringlet {

namespace {

Status checkBending(const BendingMesh& mesh, const std::string& owner) {
  const auto fail = [&](const char* what) { return Error{fmt::format("{} bends and {}", owner, what)}; };
  if (mesh.surface.triangles.empty()) return fail("has no triangles");
  if (!(mesh.cell > 0) || std::ranges::find(mesh.counts, 0u) != mesh.counts.end())
    return fail("has a grid without cells");
  for (const Vec3d p : mesh.points)
    if (!contains(kPosePlace, p)) return fail("has points that are no places");
  for (const std::uint32_t source : mesh.surface.sources)
    if (source >= mesh.points.size()) return fail("its surface names points that its mesh does not have");
  return {};
}

}  // namespace

Status checkBody(const Body& body) {
  const std::string owner = fmt::format("the body {}", body.name.empty() ? "without a name" : body.name);
  const auto fail = [&](const std::string& what) { return Error{fmt::format("{} {}", owner, what)}; };
  const std::vector<SettingField<Body>> numbers = bodyNumbersOf(formOf(body.shape));
  if (Status checked = checkRows<Body>(numbers, body, owner + ": "); !checked) return checked;
  if (!contains(kPosePlace, body.place.position))
    return fail(fmt::format("stands {} m away; it takes 1e9 along each axis", length(body.place.position)));
  if (body.shape != BodyShape::grid) return {};
  const DistanceGrid* grid = body.grid.get();
  if (!grid || grid->cellCount() == 0 || !(grid->cell > 0)) return fail("has no distance grid");
  const std::size_t corners = grid->cornerIndex(grid->counts[0], grid->counts[1], grid->counts[2]) + 1;
  if (grid->distances.size() != corners)
    return fail(
        fmt::format("has a distance grid of {} corners; its cells have {}", grid->distances.size(), corners));
  for (const float distance : grid->distances)
    if (!std::isfinite(distance)) return fail("has a distance grid with distances that are no numbers");
  return body.mesh ? checkBending(*body.mesh, owner) : Status{};
}

std::vector<std::size_t> bendingPointCounts(std::span<const Body> bodies) {
  std::vector<std::size_t> counts;
  for (const Body& body : bodies)
    if (body.bends()) counts.push_back(body.mesh->points.size());
  return counts;
}

Status checkBodyPoints(std::span<const std::size_t> pointCounts, BodyPoints points) {
  if (points.empty()) return {};
  if (points.size() != pointCounts.size())
    return Error{fmt::format("a frame has points of {} bodies, and {} of the bodies bend", points.size(),
                             pointCounts.size())};
  const std::size_t samples = points[0].size() / pointCounts[0];
  for (std::size_t b = 0; b < points.size(); ++b) {
    const std::size_t wanted = std::max<std::size_t>(samples, 1) * pointCounts[b];
    if (points[b].size() != wanted)
      return Error{fmt::format(
          "a frame has {} points of bending body {}; expected {}, {} samples of a mesh of {} points",
          points[b].size(), b, wanted, std::max<std::size_t>(samples, 1), pointCounts[b])};
    for (std::size_t i = 0; i < points[b].size(); ++i) {
      if (contains(kPosePlace, points[b][i])) continue;
      return Error{
          fmt::format("point {} in sample {} of bending body {} is not finite, or more than 1e9 m away",
                      i % pointCounts[b], i / pointCounts[b], b)};
    }
  }
  return {};
}

BodyPose Body::poseAt(double t, const HeadPose& head) const {
  const HeadPose carrier = motion ? motion->poseAt(t) : head;
  return {carrier.position + rotate(carrier.rotation, place.position),
          normalized(carrier.rotation * place.rotation)};
}

std::vector<BodyPose> bodyPosesOf(std::span<const Body> bodies, std::span<const HeadPose> stepPoses,
                                  std::span<const double> times) {
  RINGLET_ASSERT(stepPoses.size() == times.size(), "every step has a time");
  std::vector<BodyPose> poses;
  poses.reserve(bodies.size() * stepPoses.size());
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    for (const Body& body : bodies) poses.push_back(body.poseAt(times[k], stepPoses[k]));
  }
  return poses;
}

}  // namespace ringlet
