// Implements measure/placement_check.h.
#include "ringlet/measure/placement_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ringlet/base/bounds.h"
#include "ringlet/bodies/body_distance.h"
#include "ringlet/measure/groom_inspection.h"
#include "ringlet/measure/length_text.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet {
namespace {

constexpr double kSmallBody = 0.05, kLargeBody = 20;  // relative to the groom's size
constexpr double kDeepRoots = 0.25;                   // relative to the body's size
constexpr double kOnShare = 0.2,
                 kNearEndShare = 0.1;  // of the mean length: an end on a body; how much farther the other is
constexpr double kLeastClear = 0.005;  // lower bound of both [m]

// The groom's placement in the world.
struct Stand {
  std::vector<Vec3d> roots;
  double meanLength = 0, size = 0;  // of strands; across all particles [m]
};

Stand standOf(const Groom& groom, const HeadPose& head) {
  Stand stand;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const Vec3d root = Vec3d(groom.strand(s).front()) * groom.metresPerUnit;
    stand.roots.push_back(head.position + rotate(head.rotation, root));
  }
  stand.meanLength = meanLength(groom);
  stand.size = boundsOf(groom.points).diagonal() * groom.metresPerUnit;
  return stand;
}

std::optional<std::string> doubtOfLength(double meanLength, double metresPerUnit) {
  if (meanLength >= kLeastMeanLength && meanLength <= kMostMeanLength) return std::nullopt;
  std::string sentence = fmt::format("strands are {} long on average", lengthText(meanLength));
  const std::vector<LikelyUnit> units = likelyUnits(meanLength / metresPerUnit);
  if (units.empty()) return sentence + ", which no head's hair is; is the unit right (--unit)?";
  for (std::size_t i = 0; i < units.size(); ++i) {
    sentence += fmt::format("{} {} with --unit {}", i > 0 ? " or" : "; they would be",
                            lengthText(units[i].meanLength), units[i].metresPerUnit);
  }
  return sentence;
}

// Diameter [m]; 0 for a plane.
double sizeOf(const Body& body) {
  const double reach = formOf(body.shape).reach(body);
  return std::isfinite(reach) ? 2 * reach : 0;
}

std::optional<std::string> doubtOfBody(const Body& body, const Stand& stand, const HeadPose& head) {
  const double size = sizeOf(body);
  if (body.motion || size == 0 || stand.size == 0) return std::nullopt;
  if (size < kSmallBody * stand.size || size > kLargeBody * stand.size) {
    return fmt::format(
        "the body {} is {} across and the groom {}; is its unit right (`unit` of its [[body]])?", body.name,
        lengthText(size), lengthText(stand.size));
  }
  std::vector<double> distances;
  const BodyPose pose = body.poseAt(0, head);
  for (const Vec3d& root : stand.roots) distances.push_back(distanceTo(body, pose, root));
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  const double nearest = *std::ranges::min_element(distances);
  if (nearest > stand.size) {
    return fmt::format(
        "no root is nearer to the body {} than {}, further than the groom's own size of {}; do the two stand "
        "in one place, and in one unit?",
        body.name, lengthText(nearest), lengthText(stand.size));
  }
  if (*middle < -kDeepRoots * size) {
    return fmt::format(
        "half of the roots are {} and more inside of the body {}, which is {} across; is it in its place?",
        lengthText(-*middle), body.name, lengthText(size));
  }
  return std::nullopt;
}

// The option that reverses these strands, as the end of a sentence.
std::string turnsRound(const RootEnds& byHead, std::size_t count) {
  const auto turned = static_cast<std::size_t>(std::ranges::count(byHead.isReversed, true));
  const bool isMost = 2 * count > byHead.isReversed.size();
  const bool headTells = turned > 0 && turned < byHead.isReversed.size();
  if (!headTells && !isMost)
    return "no option tells them from the others, whose roots are on no ball; turn them round where they "
           "were made";
  const char* end = headTells ? "head" : "last";
  return fmt::format(
      "root_end = \"{0}\" of [groom] (--root-end {0}) turns {1} round, and so does `ringlet info --fix` with "
      "it",
      end, headTells ? "those that end on the head" : "all");
}

std::optional<std::string> doubtOfRootEnds(const Groom& groom, const RootEnds& byHead,
                                           std::span<const EndDistances> ends, const std::string& what) {
  const double on = std::max(kLeastClear, kOnShare * meanLength(groom));
  const double clear = std::max(kLeastClear, kNearEndShare * meanLength(groom));
  if (std::ranges::count(reversedBy(ends, on, clear), true) == 0) return std::nullopt;
  const std::vector<bool> isReversed = reversedBy(ends, on, kLeastClear);
  const auto count = static_cast<std::size_t>(std::ranges::count(isReversed, true));
  const auto first = std::ranges::find(isReversed, true) - isReversed.begin();
  return fmt::format(
      "{} of {} strands have their last point on {} and their first away from it (the first is strand {}): "
      "they seem to run from tip to root; {}",
      count, ends.size(), what, first, turnsRound(byHead, count));
}

}  // namespace

double meanLength(const Groom& groom) {
  double sum = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = groom.strand(s);
    for (std::size_t i = 1; i < strand.size(); ++i)
      sum += length(static_cast<Vec3d>(strand[i] - strand[i - 1]));
  }
  return sum * groom.metresPerUnit / static_cast<double>(std::max<std::size_t>(1, groom.strandCount()));
}

std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const EndDistances> ends,
                                         const std::string& what) {
  return doubtOfRootEnds(groom, findRootEnds(groom), ends, what);
}

std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const Body> bodies,
                                         const HeadPose& head) {
  const StrandEnds ends = strandEnds(groom);
  std::vector<EndDistances> distances(ends.first.size(), {HUGE_VAL, HUGE_VAL});
  std::string names;
  for (const Body& body : bodies) {
    if (body.motion || sizeOf(body) == 0) continue;  // not carried by the head, or without a size
    names += (names.empty() ? "" : ", ") + body.name;
    const BodyPose pose = body.poseAt(0, head);
    const auto from = [&](Vec3d end) {
      const Vec3d place = head.position + rotate(head.rotation, end * groom.metresPerUnit);
      return std::abs(distanceTo(body, pose, place));
    };
    for (std::size_t s = 0; s < distances.size(); ++s) {
      distances[s].first = std::min(distances[s].first, from(ends.first[s]));
      distances[s].last = std::min(distances[s].last, from(ends.last[s]));
    }
  }
  if (names.empty() || distances.empty()) return std::nullopt;
  // Hair that lies on shoulders has its tips on a body, and its roots on a head that may be no body.
  const RootEnds byHead = findRootEnds(groom);
  if (byHead.head && std::ranges::count(byHead.isReversed, true) == 0) return std::nullopt;
  return doubtOfRootEnds(groom, byHead, distances, "the body " + names);
}

std::vector<std::string> checkPlacement(const Groom& groom, std::span<const Body> bodies,
                                        const HeadPose& head) {
  std::vector<std::string> doubts;
  const Stand stand = standOf(groom, head);
  if (stand.roots.empty()) return doubts;
  if (auto doubt = doubtOfLength(stand.meanLength, groom.metresPerUnit)) doubts.push_back(std::move(*doubt));
  for (const Body& body : bodies) {
    if (auto doubt = doubtOfBody(body, stand, head)) doubts.push_back(std::move(*doubt));
  }
  return doubts;
}

}  // namespace ringlet
