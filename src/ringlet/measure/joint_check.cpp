// Implements measure/joint_check.h.
#include "ringlet/measure/joint_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ringlet/base/bounds.h"
#include "ringlet/measure/length_text.h"

namespace ringlet {
namespace {

constexpr double kSteady = 0.7;            // a joint's up axis is steady if the mean direction is at least
                                           // this long
constexpr double kTilted = 60;             // more than a head is bent on average [degrees]
constexpr double kFarJoint = 0.5;          // distance of roots from the joint that is not plausible [m]
constexpr std::size_t kMostLooks = 1'000;  // number of keys that are sampled

double component(Vec3d v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// "+X": the axis closest to a direction.
std::string nearestAxis(Vec3d direction) {
  int nearest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(component(direction, axis)) > std::abs(component(direction, nearest))) nearest = axis;
  }
  return fmt::format("{}{}", component(direction, nearest) < 0 ? '-' : '+', "XYZ"[nearest]);
}

}  // namespace

std::optional<std::string> checkJointAxes(const Motion& motion, Vec3d up, const std::string& joint) {
  if (!motion.keyframes) return std::nullopt;
  const auto& poses = motion.keyframes->poses;
  const std::size_t step = (poses.size() + kMostLooks - 1) / kMostLooks;
  Vec3d sum;
  double count = 0;
  for (std::size_t k = 0; k < poses.size(); k += step, ++count)
    sum += rotate((poses[k].rotation * motion.axes).conjugate(), up);
  const Vec3d mean = sum / count;
  if (length(mean) < kSteady) return std::nullopt;
  const double tilt = std::acos(std::clamp(dot(mean, up) / length(mean), -1.0, 1.0)) * 180 / std::numbers::pi;
  if (tilt < kTilted) return std::nullopt;
  return fmt::format(
      "the joint {} has its {} axis up, where the groom has its {}, so the groom stands tilted by {:.0f} "
      "degrees; bind = \"world\" of [groom] (--bind world) keeps it as it was modelled, whatever axes the "
      "joint has",
      joint, nearestAxis(mean), nearestAxis(up), tilt);
}

std::optional<std::string> checkJointDistance(const Groom& groom, const HeadPose& head, bool isWorld,
                                              const std::string& joint) {
  if (groom.points.empty()) return std::nullopt;
  double nearest = HUGE_VAL;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    nearest = std::min(nearest, length(Vec3d(groom.strand(s).front()) * groom.metresPerUnit));
  const double size = boundsOf(groom.points).diagonal() * groom.metresPerUnit;
  if (nearest <= std::max(kFarJoint, size)) return std::nullopt;
  const std::string far =
      fmt::format("no root is nearer to the joint {} than {}, further than the groom's own size of {}; ",
                  joint, lengthText(nearest), lengthText(size));
  if (!isWorld) {
    return far +
           "a groom that was modelled where it stands in the world takes bind = \"world\" of [groom] (--bind "
           "world)";
  }
  const Vec3d at = head.position;
  return far + fmt::format(
                   "at its bind frame the joint is at ({:.3g}, {:.3g}, {:.3g}) m; are the units of the groom "
                   "(--unit) and of the motion (--motion-unit) right, and the bind frame (--bind-frame)?",
                   at.x, at.y, at.z);
}

}  // namespace ringlet
