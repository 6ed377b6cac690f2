// Implements makeHead of groom/generate.h: helices about cores that leave the scalp and bend over to hang.
//
//            .-'''-.      core: along the normal at first, then combed back
//    brow  .'  ___  '.    and down, sliding over the scalp
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
#include "ringlet/groom/head_regions.h"
#include "ringlet/groom/sample_elimination.h"
#include "ringlet/groom/scalp_surface.h"
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

// A parting's comb to the side, where it is full; and what of the comb away from the face is left there.
constexpr double kPartingComb = 1.6, kLeftOfComb = 0.4;
// A fringe's comb over the face.
constexpr double kFringeComb = 0.12;

constexpr int kCandidates = 5;  // for each root on a mesh, as the paper of sample_elimination.h has them

constexpr int kMostOnCap = 30'000'000;  // places that are tried: 1.5 GB of them

constexpr double kShortestStrand = 0.005;  // [m], of what a level leaves

// Directions, evenly spread over the cap: Fibonacci's spiral about the cap's axis.
std::vector<Vec3d> spreadOverCap(const HeadParameters& parameters, int count) {
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

// At least so many above the hairline, evenly spread as seen from the origin, if there are any at all. What
// is not on the scalp is made up for by more on the cap.
struct Candidates {
  std::vector<ScalpRoot> roots;
  double area = 0;  // of the scalp they are on [m^2]
};
Candidates spreadCandidates(const HeadParameters& parameters, const ScalpSurface& scalp, int count) {
  const double lowest = std::sin((parameters.browElevation + parameters.napeElevation) / 2);
  Candidates candidates;
  for (int onCap = count, found = 0; found < count && onCap < std::min(100 * (count + 100), kMostOnCap);
       onCap += 2 * found < count ? onCap : 1 + (count - found) / 2) {
    candidates = {};
    for (const Vec3d direction : spreadOverCap(parameters, onCap)) {
      const auto root = scalp.rootAlong(direction);
      if (!root || !isAboveHairline(parameters, root->direction)) continue;
      candidates.roots.push_back(*root);
      const double slant = std::max(0.1, dot(root->direction, root->normal));
      candidates.area +=
          2 * std::numbers::pi * (1 - lowest) / onCap * dot(root->position, root->position) / slant;
    }
    found = static_cast<int>(candidates.roots.size());
  }
  return candidates;
}

// Evenly spread above the hairline. On a sphere what is too much is left out at the end of the spiral, low at
// the nape.
std::vector<ScalpRoot> spreadRoots(const HeadParameters& parameters, const ScalpSurface& scalp, int count) {
  if (!parameters.scalp) {
    std::vector<ScalpRoot> roots = spreadCandidates(parameters, scalp, count).roots;
    if (std::ssize(roots) > count) roots.resize(static_cast<std::size_t>(count));
    return roots;
  }
  const auto [all, area] = spreadCandidates(parameters, scalp, kCandidates * count);
  std::vector<Vec3d> places;
  for (const ScalpRoot& root : all) places.push_back(root.position);
  std::vector<ScalpRoot> roots;
  for (const std::uint32_t i : eliminateSamples(places, static_cast<std::size_t>(count), area))
    roots.push_back(all[i]);
  return roots;
}

// The curl of each strand, varied by its lock and within it; without locks each for itself.
class VariedCurls {
 public:
  VariedCurls(const HeadParameters& parameters, const ScalpSurface& scalp)
      : parameters_(parameters),
        locks_(spreadRoots(parameters, scalp, parameters.lockCount)),
        within_(parameters.variation) {
    for (double* share : {&within_.radius, &within_.length, &within_.phase}) *share *= kVariationInLock;
    within_.leftHandedShare = 0;
  }

  CurlParameters curlAt(const ScalpRoot& root, std::size_t strand) const {
    if (locks_.empty()) return varyCurl(parameters_.curl, parameters_.variation, strand);
    const CurlParameters curl = varyCurl(parameters_.curl, parameters_.variation, lockAt(root));
    return varyCurl(curl, within_, locks_.size() + strand);
  }

  /// The root of the lock's middle there; without locks the root itself.
  const ScalpRoot& middleOfLock(const ScalpRoot& root) const {
    return locks_.empty() ? root : locks_[lockAt(root)];
  }

 private:
  std::size_t lockAt(const ScalpRoot& root) const {
    const auto nearer = [&](const ScalpRoot& a, const ScalpRoot& b) {
      return dot(a.direction, root.direction) < dot(b.direction, root.direction);
    };
    return static_cast<std::size_t>(std::ranges::max_element(locks_, nearer) - locks_.begin());
  }

  const HeadParameters& parameters_;
  std::vector<ScalpRoot> locks_;
  Variation within_;
};

// How hair from a root is combed.
struct Comb {
  int side = 0;           // of the parting: +1 or -1
  bool isFringe = false;  // over the face
};

// Where hair wants to go at a place on or above the head: down, and in front also away from the face, or from
// the parting, or over the brow.
Vec3d fallDirection(Vec3d outward, const Comb& comb) {
  if (comb.isFringe) return normalizedOr(kDown + kFace * kFringeComb, kDown);
  const double facing = dot(outward, kFace);
  const Vec3d awayFromFace = normalizedOr(outward * facing - kFace, Vec3d{0, 1, 0});
  Vec3d fall = kDown;
  double back = kCombStrength * smoothstep(kCombGone, kCombFull, facing);
  if (comb.side != 0) {
    const double parted = smoothstep(0.3, 0.9, outward.y) * smoothstep(-0.7, 0.1, outward.z);
    fall += Vec3d{double(comb.side), 0, 0} * (kPartingComb * parted);
    back *= 1 - (1 - kLeftOfComb) * parted;
  }
  return normalizedOr(fall + awayFromFace * back, kDown);
}

Comb combAt(Vec3d rootDirection, const HeadParameters& parameters) {
  return {sideOfParting(parameters, rootDirection), isFringe(parameters, rootDirection)};
}

bool areCombedAlike(Vec3d a, Vec3d b, const HeadParameters& parameters) {
  const Comb x = combAt(a, parameters), y = combAt(b, parameters);
  return x.side == y.side && x.isFringe == y.isFringe;
}

// A point of the core with a frame that goes along without twist.
struct CorePoint {
  Vec3d position, direction, normal;
};

// One step along the core: it turns towards where hair falls, and slides over the scalp.
void advance(CorePoint& core, double step, double bendLength, double leastHeight, const Comb& comb,
             const ScalpSurface& scalp) {
  const Vec3d outward = normalizedOr(core.position, Vec3d{0, 1, 0});
  const double turn = std::min(1.0, step / bendLength);
  core.direction = normalizedOr(core.direction * (1 - turn) + fallDirection(outward, comb) * turn, kDown);
  core.position += core.direction * step;

  if (const auto [height, up] = scalp.heightOf(core.position); height < leastHeight) {
    core.position = scalp.raisedTo(core.position, leastHeight);
    core.direction = normalizedOr(core.direction - up * std::min(0.0, dot(core.direction, up)), kDown);
  }
  core.normal = core.normal - core.direction * dot(core.normal, core.direction);
  core.normal =
      normalizedOr(core.normal, normalizedOr(cross(core.direction, Vec3d{1, 0, 0}), Vec3d{0, 0, 1}));
}

// The radius of a curl along its strand, s from 0 to 1.
double radiusAlong(const CurlParameters& curl, const HeadParameters& parameters, double s) {
  const double straight = parameters.cut.straightRoot;
  return curl.radius * smoothstep(straight, straight + parameters.rampShare * (1 - straight), s);
}

// The core of a strand at its particles.
std::vector<CorePoint> coreOf(const ScalpRoot& root, const CurlParameters& curl,
                              const HeadParameters& parameters, const ScalpSurface& scalp) {
  const double edge = curl.length / (curl.particleCount - 1);
  const int stepCount = static_cast<int>(std::ceil(edge / kLongestStep));
  const Comb comb = combAt(root.direction, parameters);
  CorePoint core{root.position, root.normal, cross(root.normal, kFace)};
  core.normal = normalizedOr(core.normal, Vec3d{1, 0, 0});
  std::vector<CorePoint> points;
  points.reserve(static_cast<std::size_t>(curl.particleCount));
  for (int i = 0; i < curl.particleCount; ++i) {
    const double s = double(i) / (curl.particleCount - 1);
    points.push_back(core);
    for (int k = 1; k <= stepCount; ++k) {
      const double along = s * curl.length + edge * k / stepCount;
      const double gap = kGap * radiusAlong(curl, parameters, along / curl.length) +
                         kLift * std::min(along, parameters.scalpRadius);
      advance(core, edge / stepCount, parameters.bendLength, gap, comb, scalp);
    }
  }
  return points;
}

// A strand of another length has as many turns a metre.
CurlParameters ofLength(CurlParameters curl, double factor) {
  curl.length *= factor;
  curl.turns *= factor;
  return curl;
}

// As the cut leaves it.
CurlParameters cutCurl(const ScalpRoot& root, const CurlParameters& whole, const HeadParameters& parameters,
                       const ScalpSurface& scalp) {
  if (isFringe(parameters, root.direction)) return ofLength(whole, parameters.cut.fringe / whole.length);
  const CurlParameters curl = ofLength(whole, lengthFactor(parameters, root.direction));
  if (!parameters.cut.level) return curl;
  const std::vector<CorePoint> core = coreOf(root, curl, parameters, scalp);
  const auto below = [&](const CorePoint& point) { return point.position.y < -*parameters.cut.level; };
  const auto cut = std::ranges::find_if(core, below);
  if (cut == core.end()) return curl;
  if (cut == core.begin()) return ofLength(curl, kShortestStrand / curl.length);
  // Between the particle before and this one.
  const double above = (cut - 1)->position.y + *parameters.cut.level,
               edge = (cut - 1)->position.y - cut->position.y;
  const double share =
      (static_cast<double>(cut - 1 - core.begin()) + above / edge) / (curl.particleCount - 1);
  return ofLength(curl, std::max(share, kShortestStrand / curl.length));
}

// Towards the core of the lock, outside the head as before.
void clump(std::vector<CorePoint>& core, const std::vector<CorePoint>& lock, double share,
           const ScalpSurface& scalp) {
  for (std::size_t i = 1; i < core.size(); ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(core.size() - 1);
    const Vec3d between =
        core[i].position + (lock[i].position - core[i].position) * (share * smoothstep(0, 0.7, s));
    const double least =
        std::min(scalp.heightOf(core[i].position).height, scalp.heightOf(lock[i].position).height);
    core[i].position = scalp.heightOf(between).height < least ? scalp.raisedTo(between, least) : between;
  }
}

void addStrand(Groom& groom, const CurlParameters& curl, const std::vector<CorePoint>& cores,
               const HeadParameters& parameters) {
  std::vector<Vec3f> strand;
  strand.reserve(cores.size());
  for (int i = 0; i < curl.particleCount; ++i) {
    const CorePoint& core = cores[static_cast<std::size_t>(i)];
    const double s = double(i) / (curl.particleCount - 1);
    const double angle = curl.phase + 2 * std::numbers::pi * curl.turns * s * curl.handedness;
    const Vec3d binormal = cross(core.direction, core.normal);
    const Vec3d p = core.position + (core.normal * std::cos(angle) + binormal * std::sin(angle)) *
                                        radiusAlong(curl, parameters, s);
    strand.push_back(Vec3f(p / curl.metresPerUnit));
  }
  groom.addStrand(strand);
}

}  // namespace

Result<Groom> makeHead(const HeadParameters& parameters) {
  if (Status status = checkParameters(parameters); !status) return status.error();
  const SphereScalp sphere(parameters.scalpRadius);
  const ScalpSurface& scalp = parameters.scalp ? *parameters.scalp : sphere;
  const std::vector<ScalpRoot> roots = spreadRoots(parameters, scalp, parameters.strandCount);
  if (std::ssize(roots) < parameters.strandCount)
    return Error{
        "no hair grows there: expected a scalp about the origin, Y up and looking along +Z, that reaches "
        "above the hairline"};
  const VariedCurls curls(parameters, scalp);
  Groom groom;
  groom.metresPerUnit = parameters.curl.metresPerUnit;
  for (const ScalpRoot& root : roots) {
    const CurlParameters curl = cutCurl(root, curls.curlAt(root, groom.strandCount()), parameters, scalp);
    std::vector<CorePoint> core = coreOf(root, curl, parameters, scalp);
    const ScalpRoot& middle = curls.middleOfLock(root);
    if (parameters.cut.clump > 0 && areCombedAlike(middle.direction, root.direction, parameters))
      clump(core, coreOf(middle, curl, parameters, scalp), parameters.cut.clump, scalp);
    addStrand(groom, curl, core, parameters);
  }
  return groom;
}

}  // namespace ringlet
