// Implements measure/groom_doubts.h.
#include "ringlet/measure/groom_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "ringlet/base/bounds.h"
#include "ringlet/groom/ball.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/stray_points.h"
#include "ringlet/measure/groom_inspection.h"
#include "ringlet/measure/length_text.h"

namespace ringlet {
namespace {

constexpr double kFarRoots = 0.5;   // distance of roots from the head's pivot that is not plausible [m]
constexpr double kNoTurn = 0.9999;  // cosine of half an angle of 1.6 degrees

Vec3d meanOf(std::span<const Vec3d> points) {
  Vec3d sum;
  for (const Vec3d& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

// Diagonal of the box of all particles [m].
double sizeOf(const Groom& groom) { return boundsOf(groom.points).diagonal() * groom.metresPerUnit; }

double nearestRoot(const Groom& groom) {
  double nearest = HUGE_VAL;
  for (const Vec3d& root : rootPlaces(groom)) nearest = std::min(nearest, length(root));
  return nearest;
}

// Whether a built-in motion turns the groom about an axis that passes through it, as a spin does for a groom
// above the origin.
bool standsOnAxis(const Groom& groom, const Motion& motion) {
  const MotionKind kind = motion.kind;
  if (kind != MotionKind::nod && kind != MotionKind::spin && kind != MotionKind::turn &&
      kind != MotionKind::whip)
    return false;
  return std::ranges::any_of(rootPlaces(groom), [&](Vec3d root) {
    return length(root - motion.axis * dot(root, motion.axis)) <= std::max(kFarRoots, sizeOf(groom));
  });
}

bool turns(const Motion& motion) {
  if (motion.keyframes) {
    const auto& poses = motion.keyframes->poses;
    return std::ranges::any_of(poses, [&](const HeadPose& pose) {
      const Quatd turn = pose.rotation * poses.front().rotation.conjugate();
      return std::abs(turn.w) < kNoTurn;
    });
  }
  const MotionKind kind = motion.kind;
  return kind == MotionKind::nod || kind == MotionKind::spin || kind == MotionKind::turn ||
         kind == MotionKind::whip || kind == MotionKind::walk;
}

}  // namespace

std::vector<std::string> doubtsOfPlaces(const Groom& groom) {
  const std::vector<bool> isStray = strayPoints(groom);
  GroomFault strays, longEdges;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = groom.strand(s);
    const double longest = kLongEdge * medianEdge(strand);
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const std::size_t particle = groom.firstPoint[s] + i;
      strays.add(s, isStray[particle]);
      if (i == 0 || isStray[particle] || isStray[particle - 1]) continue;
      longEdges.add(s, length(Vec3d(strand[i]) - Vec3d(strand[i - 1])) > longest);
    }
  }
  std::vector<std::string> doubts;
  if (strays.count > 0) {
    doubts.push_back(fmt::format(
        "{} particle{} far off where no hair is (at the origin, in a place that several strands share, or a "
        "hundred edges away), as exporters write what they cannot place (the first in strand {}); `ringlet "
        "info FILE --fix OUT` takes such particles out",
        strays.count, strays.count == 1 ? " stands" : "s stand", strays.firstStrand));
  }
  if (longEdges.count > 0) {
    doubts.push_back(fmt::format(
        "{} edge{} more than {} times as long as the median of their strand (the first in strand {}), as "
        "where a particle is out of its place; `ringlet info FILE` counts them",
        longEdges.count, longEdges.count == 1 ? " is" : "s are", kLongEdge, longEdges.firstStrand));
  }
  return doubts;
}

std::optional<std::string> doubtOfRootEnds(const Groom& groom) {
  const RootEnds found = findRootEnds(groom);
  const auto count = static_cast<std::size_t>(std::ranges::count(found.isReversed, true));
  if (count == 0) return std::nullopt;
  const auto first = std::ranges::find(found.isReversed, true) - found.isReversed.begin();
  const char* end = count == groom.strandCount() ? "last" : "head";
  return fmt::format(
      "{0} of {1} strands end on the ball that is the head, and begin away from it (the first is strand "
      "{2}): they seem to run from tip to root; root_end = \"{3}\" of [groom] (--root-end {3}) turns them "
      "round, and so does `ringlet info --fix` with it",
      count, groom.strandCount(), first, end);
}

std::optional<std::string> doubtOfUp(const Groom& groom, bool upIsZ) {
  const char up = upIsZ ? 'Z' : 'Y', likely = likelyUpOf(groom);
  if (likely == 0 || likely == up) return std::nullopt;
  // Hair that is combed back still grows from the top of a head.
  const std::vector<Vec3d> roots = rootPlaces(groom);
  if (const auto head = headUnder(roots)) {
    const Vec3d top = meanOf(roots) - head->middle;
    if (upIsZ ? top.z > top.y : top.y > top.z) return std::nullopt;
  }
  return fmt::format(
      "the strands hang along -{0}, and {1} is up: a groom that lies on its side takes up = \"{0}\" of "
      "[groom] (--up {0})",
      likely, up);
}

std::vector<std::string> doubtsOf(const LoadedGroom& loaded, const GroomReading& reading) {
  std::vector<std::string> doubts = doubtsOfPlaces(loaded.groom);
  if (auto doubt = doubtOfRootEnds(loaded.groom)) doubts.push_back(std::move(*doubt));
  if (loaded.statesUp) return doubts;
  if (auto doubt = doubtOfUp(loaded.groom, reading.upIsZ)) doubts.push_back(std::move(*doubt));
  return doubts;
}

Vec3d headMiddle(const Groom& groom) {
  const std::vector<Vec3d> roots = rootPlaces(groom);
  if (const auto head = headUnder(roots)) return head->middle;
  return meanOf(roots);
}

bool standsFarOff(const Groom& groom) {
  return !groom.points.empty() && nearestRoot(groom) > std::max(kFarRoots, sizeOf(groom));
}

std::optional<std::string> doubtOfPivot(const Groom& groom, const Motion& motion) {
  if (!turns(motion) || !standsFarOff(groom) || standsOnAxis(groom, motion)) return std::nullopt;
  const Vec3d middle = headMiddle(groom);
  const std::string place = fmt::format("{:.3g}, {:.3g}, {:.3g}", middle.x, middle.y, middle.z);
  const std::string far =
      fmt::format("no root is nearer than {} to the origin, about which {} turn{} the head; ",
                  lengthText(nearestRoot(groom)), motion.keyframes ? "the keys" : motionName(motion.kind),
                  motion.keyframes ? "" : "s");
  if (motion.keyframes) {
    return far +
           fmt::format(
               "where the groom stands as it was modelled, start = [{}] of [motion], which keys are added "
               "to, and bind = \"world\" of [groom] make it turn about its own middle",
               place);
  }
  return far +
         fmt::format(
             "bind = \"world\" of [groom] (--bind world) makes a groom that stands as it was modelled turn "
             "about its own middle, ({}) m, and bind = \"world\" of a [[body]] takes that along",
             place);
}

}  // namespace ringlet
