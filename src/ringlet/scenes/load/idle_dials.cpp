// Implements scenes/load/idle_dials.h.
#include "ringlet/scenes/load/idle_dials.h"

#include <cmath>

#include "ringlet/measure/groom_inspection.h"

namespace ringlet {
namespace {

constexpr double kTravels = 1e-6;  // a shorter way of the head is rounding [m]

// Whether the head is in another place at some frame than at the first.
bool travels(const Motion& motion, const Settings& settings, double seconds) {
  const Vec3d start = motion.poseAt(0).position;
  const auto frames = static_cast<int>(std::lround(seconds * settings.framesPerSecond));
  for (int f = 1; f <= frames; ++f) {
    if (length(motion.poseAt(f / settings.framesPerSecond).position - start) > kTravels) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> idleDials(const MaterialDials& dials, const Material& material, const Groom& groom,
                                   const Settings& settings, const Motion& motion, double seconds) {
  std::vector<std::string> sentences;
  if (dials.bounce != 1 && !travels(motion, settings, seconds)) {
    sentences.emplace_back(
        "the dial bounce changes nothing: the head does not travel in this run (turning alone does not "
        "count); spring_back and hold act in any motion");
  }
  if (dials.weight != 1 && length(settings.gravity) == 0)
    sentences.emplace_back("the dial weight changes nothing: there is no gravity");
  if (dials.curlKeep != 1) {
    if (material.coreStiffness == 0) {
      sentences.emplace_back(
          "the dial curl_keep changes nothing: the material has no core spring (core_stiffness is 0)");
    } else if (inspectShape(groom).curledCount == 0) {
      sentences.emplace_back("the dial curl_keep changes next to nothing: no strand of the groom is curled");
    }
  }
  return sentences;
}

}  // namespace ringlet
