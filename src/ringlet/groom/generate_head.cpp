// Implements makeHead of groom/generate.h: helices about cores that leave the scalp and bend over to hang.
//
//            .-'''-.      core: along the normal at first, then combed back
//    brow  .'  ___  '.    and down, sliding over the sphere
//     o---:  .'   '.  :
//         | hairline '.|
//    face :      o---' :  below the hairline nothing grows
//          '.  nape  .'|
//            '-....-'  v  hanging free
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/generate_check.h"
#include "ringlet/groom/vary_curl.h"

namespace ringlet {
namespace {

constexpr double kGoldenAngle = 2.399963229728653;  // pi (3 - sqrt 5) [rad]: no two roots line up

constexpr Vec3d kDown{0, -1, 0};
constexpr Vec3d kFace{0, 0, 1};  // where the face looks

// By eye: the comb beats gravity at the brow, fades over the crown and is gone behind. Full and gone are
// cosines of the angle between a place on the head and the face.
constexpr double kCombStrength = 1.6;
constexpr double kCombFull = 0.7, kCombGone = -0.4;

// A core's least distance from the sphere: in radii of the curl there, so that the curl stays outside, and
// what it rises beyond that per length, so that hair from above lies on hair from below.
constexpr double kGap = 1.2, kLift = 0.08;

// What strands of a lock differ by, as a share of what locks differ by.
constexpr double kVariationInLock = 0.1;

constexpr double kLongestStep = 5e-4;  // [m], of the core's integration: a 50th of the default bend

double smoothstep(double low, double high, double x) {
  const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

// Directions, evenly spread over the cap above the hairline: Fibonacci's spiral about the cap's axis.
std::vector<Vec3d> spreadRoots(const HeadParameters& parameters, int count) {
  // The plane of the hairline meets the sphere at the two elevations: tilted by half their difference.
  const double tilt = (parameters.browElevation - parameters.napeElevation) / 2;
  const double lowest = std::sin((parameters.browElevation + parameters.napeElevation) / 2);
  const Vec3d axis{0, std::cos(tilt), -std::sin(tilt)}, side{1, 0, 0}, front = cross(side, axis);

  std::vector<Vec3d> directions;
  for (int i = 0; i < count; ++i) {
    const double height = 1 - (1 - lowest) * (i + 0.5) / count;
    const double around = std::sqrt(std::max(0.0, 1 - height * height)), angle = kGoldenAngle * i;
    directions.push_back(axis * height + (side * std::cos(angle) + front * std::sin(angle)) * around);
  }
  return directions;
}

// The curl of each strand, varied by its lock and within it; without locks each for itself.
class VariedCurls {
 public:
  explicit VariedCurls(const HeadParameters& parameters)
      : parameters_(parameters),
        locks_(spreadRoots(parameters, parameters.lockCount)),
        within_(parameters.variation) {
    for (double* share : {&within_.radius, &within_.length, &within_.phase}) *share *= kVariationInLock;
    within_.leftHandedShare = 0;
  }

  CurlParameters curlAt(Vec3d rootDirection, std::size_t strand) const {
    if (locks_.empty()) return varyCurl(parameters_.curl, parameters_.variation, strand);
    const auto nearer = [&](Vec3d a, Vec3d b) { return dot(a, rootDirection) < dot(b, rootDirection); };
    const auto lock = std::ranges::max_element(locks_, nearer) - locks_.begin();
    const CurlParameters curl =
        varyCurl(parameters_.curl, parameters_.variation, static_cast<std::size_t>(lock));
    return varyCurl(curl, within_, locks_.size() + strand);
  }

 private:
  const HeadParameters& parameters_;
  std::vector<Vec3d> locks_;
  Variation within_;
};

// Where hair wants to go at a place on or above the head: down, and in front also away from the face.
Vec3d fallDirection(Vec3d outward) {
  const double facing = dot(outward, kFace);
  const Vec3d awayFromFace = normalizedOr(outward * facing - kFace, Vec3d{0, 1, 0});
  return normalizedOr(kDown + awayFromFace * (kCombStrength * smoothstep(kCombGone, kCombFull, facing)),
                      kDown);
}

// A point of the core with a frame that goes along without twist.
struct CorePoint {
  Vec3d position, direction, normal;
};

// One step along the core: it turns towards where hair falls, and slides over the sphere.
void advance(CorePoint& core, double step, double bendLength, double leastDistance) {
  const Vec3d outward = normalizedOr(core.position, Vec3d{0, 1, 0});
  const double turn = std::min(1.0, step / bendLength);
  core.direction = normalizedOr(core.direction * (1 - turn) + fallDirection(outward) * turn, kDown);
  core.position += core.direction * step;

  const double distance = length(core.position);
  if (distance < leastDistance) {
    const Vec3d up = normalizedOr(core.position, outward);
    core.position = up * leastDistance;
    core.direction = normalizedOr(core.direction - up * std::min(0.0, dot(core.direction, up)), kDown);
  }
  core.normal = core.normal - core.direction * dot(core.normal, core.direction);
  core.normal =
      normalizedOr(core.normal, normalizedOr(cross(core.direction, Vec3d{1, 0, 0}), Vec3d{0, 0, 1}));
}

void addStrand(Groom& groom, Vec3d rootDirection, const CurlParameters& curl,
               const HeadParameters& parameters) {
  const double edge = curl.length / (curl.particleCount - 1);
  const int stepCount = static_cast<int>(std::ceil(edge / kLongestStep));
  CorePoint core{rootDirection * parameters.scalpRadius, rootDirection, cross(rootDirection, kFace)};
  core.normal = normalizedOr(core.normal, Vec3d{1, 0, 0});
  auto radiusAt = [&](double s) { return curl.radius * smoothstep(0, parameters.rampShare, s); };

  std::vector<Vec3f> strand;
  strand.reserve(static_cast<std::size_t>(curl.particleCount));
  for (int i = 0; i < curl.particleCount; ++i) {
    const double s = double(i) / (curl.particleCount - 1);
    const double angle = curl.phase + 2 * std::numbers::pi * curl.turns * s * curl.handedness;
    const Vec3d binormal = cross(core.direction, core.normal);
    const Vec3d p =
        core.position + (core.normal * std::cos(angle) + binormal * std::sin(angle)) * radiusAt(s);
    strand.push_back(Vec3f(p / curl.metresPerUnit));
    for (int k = 1; k <= stepCount; ++k) {
      const double along = s * curl.length + edge * k / stepCount;
      const double gap =
          kGap * radiusAt(along / curl.length) + kLift * std::min(along, parameters.scalpRadius);
      advance(core, edge / stepCount, parameters.bendLength, parameters.scalpRadius + gap);
    }
  }
  groom.addStrand(strand);
}

}  // namespace

Result<Groom> makeHead(const HeadParameters& parameters) {
  if (Status status = checkParameters(parameters); !status) return status.error();
  Groom groom;
  groom.metresPerUnit = parameters.curl.metresPerUnit;
  const VariedCurls curls(parameters);
  for (const Vec3d& direction : spreadRoots(parameters, parameters.strandCount))
    addStrand(groom, direction, curls.curlAt(direction, groom.strandCount()), parameters);
  return groom;
}

}  // namespace ringlet
