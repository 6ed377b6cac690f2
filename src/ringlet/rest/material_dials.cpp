// Implements rest/material_dials.h.
#include "ringlet/rest/material_dials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ringlet {
namespace {

constexpr double kMiddle = 0.5;  // share of the arc length at which the root's dial ends and the tip's begins

// The product of two profiles, with the points of both and one in the middle.
Profile product(const Profile& a, const Profile& b) {
  std::vector<double> places;
  for (const Profile* profile : {&a, &b})
    for (const Profile::Point& point : profile->points) places.push_back(point.s);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  Profile both;
  for (const double s : places) both.points.push_back({s, a.at(s) * b.at(s)});
  return both;
}

}  // namespace

std::optional<std::string> applyDials(const MaterialDials& dials, Material& material) {
  const double wetStiffness = std::pow(kWetStiffness, dials.wet),
               wetDamping = std::pow(kWetDamping, dials.wet);
  material.bendStiffness *= dials.hold * wetStiffness;
  material.coreStiffness *= dials.curlKeep * wetStiffness;
  material.coreDampingRatio *= dials.springBack * wetDamping;
  material.gravityFactor *= dials.weight * std::pow(kWetWeight, dials.wet);
  material.inertiaFactor *= dials.bounce;
  if (dials.rootHold != 1 || dials.tipHold != 1)
    material.bendStiffnessProfile =
        product(material.bendStiffnessProfile, {{{0, dials.rootHold}, {kMiddle, 1}, {1, dials.tipHold}}});

  const double own = material.bendDampingRatio, least = std::min(own, kLeastBendDampingRatio),
               asked = own * dials.springBack * wetDamping;
  material.bendDampingRatio = std::max(asked / std::sqrt(dials.hold), least);
  if (asked >= least) return std::nullopt;
  return fmt::format(
      "the dials ask for a bend damping ratio of {:.3g}, below {}, where bending can feed on itself: {:.3g} "
      "is used",
      asked, kLeastBendDampingRatio, material.bendDampingRatio);
}

}  // namespace ringlet
