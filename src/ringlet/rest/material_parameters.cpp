// Implements rest/material_parameters.h.
#include "ringlet/rest/material_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace ringlet {
namespace {

constexpr std::size_t kMostProfilePoints = 256;  // as many as a long strand has particles
constexpr double kLeastElongationGap = 1e-6;     // between low and high, so that the smoothstep between them
                                                 // is defined

template <class Owner>
Status checkNumbers(std::span<const Parameter<Owner>> parameters, const Owner& owner, const char* table) {
  for (const Parameter<Owner>& parameter : parameters) {
    const std::optional<double> value = parameter.of(owner);
    if (!value || parameter.allowed.contains(*value)) continue;
    return Error{fmt::format("{}{} is {}; it must be {}", table, parameter.key, *value,
                             rangeText(parameter.allowed, parameter.unit))};
  }
  return {};
}

// Checks the product of all factors on each number. It changes only where a run of strands begins or ends.
Status checkFactors(const Material& material) {
  for (const Parameter<Material>& parameter : materialParameters()) {
    const auto* member = std::get_if<double Material::*>(&parameter.member);
    for (const StrandFactors& some : material.factors) {
      if (!member || some.number != *member) continue;
      for (const StrandRun& run : *some.runs) {
        for (const std::size_t strand : {std::size_t{run.first}, std::size_t{run.last} + 1}) {
          double value = material.**member;
          for (const StrandFactors& factors : material.factors)
            if (factors.number == *member) value *= factors.of(strand);
          const bool isFactor = run.factor >= kLeastStrandFactor && run.factor <= kMostStrandFactor;
          if (isFactor && parameter.allowed.contains(value)) continue;
          return Error{fmt::format("maps make {} of strand {} {}; it must be {}", parameter.key, strand,
                                   value, rangeText(parameter.allowed, parameter.unit))};
        }
      }
    }
  }
  return {};
}

template <class Owner>
void addUnusual(std::span<const Parameter<Owner>> parameters, const Owner& owner, const char* table,
                std::vector<std::string>& sentences) {
  for (const Parameter<Owner>& parameter : parameters) {
    const std::optional<double> value = parameter.of(owner);
    if (!value || parameter.usual.contains(*value)) continue;
    sentences.push_back(fmt::format("{}{} is {}; usual is {}. {}", table, parameter.key, *value,
                                    rangeText(parameter.usual, parameter.unit), parameter.effect));
  }
}

}  // namespace

std::span<const Parameter<Material>> materialParameters() {
  using M = Material;
  static const Parameter<M> all[] = {
      {{"line_density",
        "kg/m",
        "Mass per length of a strand. Stiffnesses scale with it, so hair without contacts, bodies and air "
        "moves the same at any density.",
        {1e-12, 1e6},
        {1e-7, 1e-2}},
       &M::lineDensity},
      {{"stretch_stiffness",
        "w",
        "Resistance to stretch. A strand that hangs straight becomes longer by a share of 0.5 / "
        "stretch_stiffness.",
        {1e-3, 1e6},
        {10, 1e4}},
       &M::stretchStiffness},
      {{"stretch_damping_time",
        "s",
        "Damping of stretch, divided by its stiffness. More of it calms oscillation along the strand.",
        {0, 10},
        {0.001, 0.1}},
       &M::stretchDampingTime},
      {{"bend_stiffness",
        "w",
        "Resistance to bending, which keeps the groomed shape. Stiffer hair droops less and bounces faster.",
        {1e-3, 1e6},
        {0.2, 200}},
       &M::bendStiffness},
      {{"bend_damping_ratio",
        "1",
        "Damping of bending: how fast a swing settles. Below 0.1 bending may gain energy and never come to "
        "rest.",
        {0, 100},
        {kLeastBendDampingRatio, 2}},
       &M::bendDampingRatio},
      {{"core_stiffness",
        "w",
        "Resistance of a curl to lengthening of its core, which keeps it from unwinding; 0: no core spring.",
        {0, 1e6},
        {0, 200}},
       &M::coreStiffness},
      {{"core_damping_ratio",
        "1",
        "Damping of the core spring: how fast a bounce along the curl's axis settles.",
        {0, 100},
        {0.05, 2}},
       &M::coreDampingRatio},
      {{"core_relaxed_share",
        "1",
        "Stiffness of the core spring at rest length, as a share of core_stiffness. A smaller share makes "
        "small bounces softer.",
        {0, 1},
        {0.05, 1}},
       &M::coreRelaxedShare},
      {{"core_elongation_low",
        "1",
        "Relative length of the curl's core at which the core spring begins to stiffen.",
        {0, 1e3},
        {0.8, 1.5}},
       &M::coreElongationLow},
      {{"core_elongation_high",
        "1",
        "Relative length of the curl's core at which the core spring has its full stiffness; above "
        "core_elongation_low.",
        {0, 1e3},
        {1.01, 3}},
       &M::coreElongationHigh},
      {{"gravity_factor",
        "1",
        "Factor on the gravity that acts on hair; what the preload balances stays. More than 1 sags.",
        {0, 100},
        {0.2, 5}},
       &M::gravityFactor},
      {{"inertia_factor",
        "1",
        "Factor on the inertial force that hair feels where its head travels, not where it turns. More "
        "swings and bounces farther.",
        {0, 100},
        {0.2, 5}},
       &M::inertiaFactor},
      {{"bend_smoothing_length",
        "m",
        "Smoothing length for the strand frames that steer bending. With a shorter one curls spin more.",
        {0, 1e3},
        {0, 0.5}},
       &M::bendSmoothingLength},
      {{"core_smoothing_length",
        "m",
        "Smoothing length by which the core of a curl is found.",
        {0, 1e3},
        {0, 0.5}},
       &M::coreSmoothingLength},
  };
  return all;
}

std::span<const Parameter<MaterialDials>> dialParameters() {
  using D = MaterialDials;
  static const Parameter<D> all[] = {
      {{"hold",
        "1",
        "Firmness: factor on bend_stiffness; bend_damping_ratio is divided by its root, so that hair settles "
        "as before.",
        {0.001, 1000},
        {0.1, 10}},
       &D::hold},
      {{"bounce",
        "1",
        "How far hair swings and bounces when its head travels: factor on inertia_factor.",
        {0, 100},
        {0.2, 5}},
       &D::bounce},
      {{"spring_back",
        "1",
        "How fast hair settles: factor on bend_damping_ratio and core_damping_ratio. Less than 1 is "
        "bouncier.",
        {0.001, 1000},
        {0.2, 5}},
       &D::springBack},
      {{"curl_keep", "1", "Resistance of curls to unwinding: factor on core_stiffness.", {0, 1000}, {0, 5}},
       &D::curlKeep},
      {{"weight", "1", "How far hair sags: factor on gravity_factor.", {0, 100}, {0.2, 5}}, &D::weight},
      {{"root_hold",
        "1",
        "Firmness at the root: factor on bend_stiffness there, fading to 1 at half the strand.",
        {0.001, 1000},
        {0.1, 10}},
       &D::rootHold},
      {{"tip_hold",
        "1",
        "Firmness at the tip: factor on bend_stiffness there, from 1 at half the strand.",
        {0.001, 1000},
        {0.1, 10}},
       &D::tipHold},
      {{"wet",
        "1",
        "How wet hair is, 0 dry, 1 soaked: softer, heavier and slower, its curls open.",
        {0, 1},
        {0, 1}},
       &D::wet},
  };
  return all;
}

std::span<const Parameter<MaterialVariation>> variationParameters() {
  using V = MaterialVariation;
  static const Parameter<V> all[] = {
      {{"bend_stiffness",
        "1",
        "Strands differ in bend_stiffness by up to this share, up or down.",
        {0, 0.9},
        {0, 0.5}},
       &V::bendStiffness},
      {{"core_stiffness",
        "1",
        "Strands differ in core_stiffness by up to this share, up or down.",
        {0, 0.9},
        {0, 0.5}},
       &V::coreStiffness},
      {{"bend_damping_ratio",
        "1",
        "Strands differ in bend_damping_ratio by up to this share, up or down.",
        {0, 0.9},
        {0, 0.5}},
       &V::bendDampingRatio},
      {{"seed", "1", "Seed of the variation, a whole number.", {0, 4294967295.0}, {0, 4294967295.0}},
       &V::seed},
  };
  return all;
}

std::span<const ProfileParameter> profileParameters() {
  static const ProfileParameter all[] = {
      {{"bend_stiffness",
        "1",
        "Factor on bend_stiffness from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::bendStiffnessProfile},
      {{"bend_damping_ratio",
        "1",
        "Factor on bend_damping_ratio from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::bendDampingRatioProfile},
      {{"stretch_stiffness",
        "1",
        "Factor on stretch_stiffness from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::stretchStiffnessProfile},
      {{"stretch_damping_time",
        "1",
        "Factor on stretch_damping_time from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::stretchDampingTimeProfile},
      {{"core_stiffness",
        "1",
        "Factor on core_stiffness from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::coreStiffnessProfile},
      {{"core_damping_ratio",
        "1",
        "Factor on core_damping_ratio from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::coreDampingRatioProfile},
      {{"line_density",
        "1",
        "Factor on line_density from root to tip: points [share of the arc length, factor].",
        {0.001, 1000},
        {0.05, 20}},
       &Material::lineDensityProfile},
  };
  return all;
}

Status checkProfile(const ProfileParameter& parameter, const Profile& profile) {
  if (profile.points.size() > kMostProfilePoints) {
    return Error{fmt::format("profile.{} has {} points; it may have {}", parameter.key, profile.points.size(),
                             kMostProfilePoints)};
  }
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Profile::Point& point = profile.points[i];
    const char* problem = nullptr;
    if (!NumberRange{0, 1}.contains(point.s)) problem = "its share of the arc length must be from 0 to 1";
    if (i > 0 && !(point.s > profile.points[i - 1].s)) problem = "points must go from root to tip";
    if (!problem && parameter.allowed.contains(point.factor)) continue;
    return Error{fmt::format(
        "profile.{}: point {} is [{}, {}]; {}", parameter.key, i + 1, point.s, point.factor,
        problem ? problem : "its factor must be " + rangeText(parameter.allowed, parameter.unit))};
  }
  return {};
}

Status checkMaterial(const Material& material) {
  if (Status status = checkNumbers(materialParameters(), material, ""); !status) return status;
  if (!(material.coreElongationHigh >= material.coreElongationLow + kLeastElongationGap)) {
    return Error{fmt::format(
        "core_elongation_high is {}; it must be above core_elongation_low, which is {}, by {} or more",
        material.coreElongationHigh, material.coreElongationLow, kLeastElongationGap)};
  }
  for (const ProfileParameter& parameter : profileParameters()) {
    if (Status status = checkProfile(parameter, material.*parameter.member); !status) return status;
  }
  if (Status status = checkFactors(material); !status) return status;
  return checkNumbers(variationParameters(), material.variation, "variation.");
}

Status checkDials(const MaterialDials& dials) { return checkNumbers(dialParameters(), dials, "dials."); }

std::string dialsText(const MaterialDials& dials) {
  std::string text;
  for (const Parameter<MaterialDials>& dial : dialParameters()) {
    if (dial.of(dials) == dial.defaultValue()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", dial.key, *dial.of(dials));
  }
  return text;
}

std::vector<std::string> unusualNumbers(const Material& material, const MaterialDials& dials) {
  std::vector<std::string> sentences;
  addUnusual(materialParameters(), material, "", sentences);
  addUnusual(dialParameters(), dials, "dials.", sentences);
  addUnusual(variationParameters(), material.variation, "variation.", sentences);
  for (const ProfileParameter& parameter : profileParameters()) {
    for (const Profile::Point& point : (material.*parameter.member).points) {
      if (parameter.usual.contains(point.factor)) continue;
      sentences.push_back(fmt::format("profile.{} has a factor of {}; usual is {}", parameter.key,
                                      point.factor, rangeText(parameter.usual, parameter.unit)));
      break;
    }
  }

  // With variation, the damping is lowest at the lower end of its range.
  const double varied = material.bendDampingRatio * (1 - material.variation.bendDampingRatio);
  if (varied < kLeastBendDampingRatio && material.bendDampingRatio >= kLeastBendDampingRatio) {
    sentences.push_back(fmt::format(
        "variation.bend_damping_ratio lowers bend_damping_ratio to {:.3g} in some strands; below {} bending "
        "can feed on itself",
        varied, kLeastBendDampingRatio));
  }
  return sentences;
}

std::string rangeText(const NumberRange& range, const char* unit) {
  const std::string_view name = unit;
  const bool isNone = name.empty() || name == "1";
  return fmt::format("from {} to {}{}{}", range.low, range.high, isNone ? "" : " ", isNone ? "" : name);
}

}  // namespace ringlet
