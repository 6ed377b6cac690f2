// Implements render/look.h.
#include "ringlet/render/look.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace ringlet {
namespace {

struct Named {
  const char* name;
  Vec3d first, second;  // what a fibre lets through
};
constexpr Named kColours[] = {
    {"auburn", {0.30, 0.13, 0.05}, {0.17, 0.07, 0.028}},
    {"brown", {0.20, 0.12, 0.07}, {0.10, 0.055, 0.03}},
    {"black", {0.055, 0.032, 0.020}, {0.028, 0.016, 0.011}},
    {"blond", {0.62, 0.42, 0.22}, {0.42, 0.25, 0.11}},
    {"red", {0.55, 0.19, 0.06}, {0.35, 0.10, 0.03}},
    {"grey", {0.55, 0.55, 0.56}, {0.22, 0.21, 0.21}},
    {"white", {0.88, 0.87, 0.84}, {0.80, 0.78, 0.74}},
};

constexpr Vec3d kScale[] = {{0.10, 0.25, 0.75}, {0.12, 0.60, 0.30}, {0.85, 0.70, 0.08}, {0.85, 0.10, 0.04}};
constexpr Vec3d kRainbow[] = {{0.85, 0.10, 0.08}, {0.85, 0.42, 0.05}, {0.80, 0.72, 0.10}, {0.20, 0.62, 0.15},
                              {0.10, 0.60, 0.65}, {0.12, 0.25, 0.80}, {0.50, 0.18, 0.75}, {0.82, 0.20, 0.50}};

std::vector<Absorption> absorptionsOf(std::span<const Vec3d> colours) {
  std::vector<Absorption> absorptions;
  for (const Vec3d& colour : colours) absorptions.push_back(absorptionOfColour(colour));
  return absorptions;
}

}  // namespace

Absorption absorptionOfMelanin(double melanin, double redness) {
  const double amount = -std::log(std::max(1 - melanin, 1e-4));
  const Vec3d brown{0.506, 0.841, 1.653}, red{0.343, 0.733, 1.924};
  return (brown * (1 - redness) + red * redness) * amount;
}

Absorption absorptionOfColour(Vec3d colour) {
  const auto of = [](double kept) { return -std::log(std::clamp(kept, 1e-6, 1.0 - 1e-6)) / 4; };
  return {of(colour.x), of(colour.y), of(colour.z)};
}

std::string hairColourNames() {
  std::string names;
  for (const Named& colour : kColours) names += (names.empty() ? "" : ", ") + std::string(colour.name);
  return names;
}

std::optional<Look> lookByName(std::string_view name) {
  for (const Named& colour : kColours) {
    if (colour.name != name) continue;
    Look look;
    look.pigments = {absorptionOfColour(colour.first), absorptionOfColour(colour.second)};
    return look;
  }
  return std::nullopt;
}

std::vector<Vec3d> scaleColours() { return {std::begin(kScale), std::end(kScale)}; }
std::vector<Absorption> scalePigments() { return absorptionsOf(kScale); }
std::vector<Absorption> rainbowPigments() { return absorptionsOf(kRainbow); }

double widthOfHairs(double count) {
  return std::min(0.0015, 0.00018 * std::sqrt(30000 / std::max(count, 1.0)));
}

}  // namespace ringlet
