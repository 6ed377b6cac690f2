// The tables every number of a material stands in: complete, consistent, and what refuses and warns.
#include "ringlet/rest/material_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "ringlet/rest/rest_state.h"

namespace ringlet::material_parameters_test {
namespace {

// What has to hold for any row: text a person can read, ranges within one another, a default that is usual.
template <class Owner>
void checkTable(std::span<const Parameter<Owner>> parameters) {
  std::set<std::string> keys;
  for (const Parameter<Owner>& parameter : parameters) {
    const std::string key = parameter.key, effect = parameter.effect;
    EXPECT_TRUE(keys.insert(key).second) << key << " stands there twice";
    EXPECT_EQ(key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << key;
    EXPECT_GT(std::string(parameter.unit).size(), 0u) << key;
    EXPECT_GT(effect.size(), 20u) << key;
    EXPECT_EQ(effect.back(), '.') << key;
    EXPECT_LT(parameter.allowed.low, parameter.allowed.high) << key;
    EXPECT_TRUE(parameter.allowed.contains(parameter.usual.low)) << key;
    EXPECT_TRUE(parameter.allowed.contains(parameter.usual.high)) << key;
    if (const auto value = parameter.defaultValue()) {
      EXPECT_TRUE(parameter.usual.contains(*value)) << key;
    }

    // A row reads and writes one number, and no other.
    Owner owner;
    parameter.set(owner, parameter.allowed.high);
    EXPECT_EQ(parameter.of(owner), parameter.allowed.high) << key;
    for (const Parameter<Owner>& other : parameters) {
      if (&other != &parameter) {
        EXPECT_EQ(other.of(owner), other.defaultValue()) << key << " changes " << other.key;
      }
    }
    EXPECT_FALSE(parameter.allowed.contains(NAN)) << key;
  }
}

TEST(MaterialParameters, TablesAreComplete) {
  checkTable(materialParameters());
  checkTable(dialParameters());
  checkTable(variationParameters());
  EXPECT_EQ(materialParameters().size(), 14u);
  EXPECT_EQ(dialParameters().size(), 8u);
  EXPECT_EQ(variationParameters().size(), 4u);
  EXPECT_EQ(profileParameters().size(), 7u);
}

// Each number beyond either end of its range is refused by buildRestState's own check, with key and range.
TEST(MaterialParameters, EveryRangeIsChecked) {
  EXPECT_TRUE(checkSettings({}, {}));
  for (const Parameter<Material>& parameter : materialParameters()) {
    for (const double value :
         {std::nextafter(parameter.allowed.low, -1.0), parameter.allowed.high * 1.001, double(NAN)}) {
      Material material;
      parameter.set(material, value);
      const Status status = checkSettings({}, material);
      ASSERT_FALSE(status) << parameter.key << " " << value;
      EXPECT_EQ(status.error().message.find(parameter.key), 0u) << status.error().message;
      EXPECT_NE(status.error().message.find("must be from"), std::string::npos) << status.error().message;
    }
  }
  for (const Parameter<MaterialVariation>& parameter : variationParameters()) {
    if (parameter.isWhole()) continue;  // its type holds nothing beyond its range
    Material material;
    parameter.set(material.variation, 1.5);
    const Status status = checkMaterial(material);
    ASSERT_FALSE(status) << parameter.key;
    EXPECT_EQ(status.error().message.find(std::string("variation.") + parameter.key), 0u);
  }
  for (const Parameter<MaterialDials>& parameter : dialParameters()) {
    MaterialDials dials;
    parameter.set(dials, parameter.allowed.high + 1);
    const Status status = checkDials(dials);
    ASSERT_FALSE(status) << parameter.key;
    EXPECT_EQ(status.error().message.find(std::string("dials.") + parameter.key), 0u);
  }
}

TEST(MaterialParameters, ElongationsStandInOrder) {
  Material material;
  material.coreElongationLow = 1.2;
  const Status status = checkMaterial(material);
  ASSERT_FALSE(status);
  EXPECT_EQ(
      status.error().message,
      "core_elongation_high is 1.1; it must be above core_elongation_low, which is 1.2, by 1e-06 or more");
}

TEST(MaterialParameters, ProfilesAreChecked) {
  const ProfileParameter& parameter = profileParameters().front();
  auto messageOf = [&](std::vector<Profile::Point> points) {
    const Status status = checkProfile(parameter, {std::move(points)});
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(messageOf({}), "");
  EXPECT_EQ(messageOf({{0.5, 2}}), "");
  EXPECT_EQ(messageOf({{0, 1}, {1, 0.5}}), "");
  EXPECT_EQ(messageOf({{0, 1}, {1.5, 1}}),
            "profile.bend_stiffness: point 2 is [1.5, 1]; its share of the arc length must be from 0 to 1");
  EXPECT_EQ(messageOf({{0.5, 1}, {0.5, 2}}),
            "profile.bend_stiffness: point 2 is [0.5, 2]; points must go from root to tip");
  EXPECT_EQ(messageOf({{0, 0}}),
            "profile.bend_stiffness: point 1 is [0, 0]; its factor must be from 0.001 to 1000");
  EXPECT_NE(messageOf({{NAN, 1}}), "");
  EXPECT_NE(messageOf({{0, NAN}}), "");
  EXPECT_NE(messageOf(std::vector<Profile::Point>(257)).find("257 points"), std::string::npos);
  Material material;
  material.lineDensityProfile.points = {{0, -1}};
  EXPECT_FALSE(checkMaterial(material));
}

TEST(MaterialParameters, UnusualNumbersAreSaid) {
  EXPECT_TRUE(unusualNumbers({}, {}).empty());
  Material material;
  material.bendDampingRatio = 0.05;
  MaterialDials dials;
  dials.bounce = 6;
  const auto sentences = unusualNumbers(material, dials);
  ASSERT_EQ(sentences.size(), 2u);
  EXPECT_EQ(sentences[0].find("bend_damping_ratio is 0.05; usual is from 0.1 to 2."), 0u) << sentences[0];
  EXPECT_EQ(sentences[1].find("dials.bounce is 6"), 0u) << sentences[1];

  // Damping that is enough for the material, but not for its least damped strand.
  Material varied;
  varied.variation.bendDampingRatio = 0.5;
  ASSERT_EQ(unusualNumbers(varied, {}).size(), 1u);
  EXPECT_NE(unusualNumbers(varied, {})[0].find("0.075"), std::string::npos);
}

// Piecewise linear, level beyond its ends; by hand.
TEST(Profile, IsLinearBetweenPoints) {
  EXPECT_EQ(Profile{}.at(0.3), 1);
  const Profile one{{{0.5, 2}}};
  for (const double s : {0.0, 0.5, 1.0}) EXPECT_EQ(one.at(s), 2);
  const Profile profile{{{0.2, 1}, {0.6, 3}, {0.8, 0.5}}};
  EXPECT_EQ(profile.at(0), 1);
  EXPECT_EQ(profile.at(0.2), 1);
  EXPECT_DOUBLE_EQ(profile.at(0.4), 2);
  EXPECT_DOUBLE_EQ(profile.at(0.6), 3);
  EXPECT_DOUBLE_EQ(profile.at(0.7), 1.75);
  EXPECT_EQ(profile.at(0.8), 0.5);
  EXPECT_EQ(profile.at(1), 0.5);
}

TEST(MaterialOfStrand, WithoutVariationIsTheMaterial) {
  Material material;
  material.bendStiffness = 3.3;
  material.variation.seed = 9;
  Material own = material;
  own.variation = {};
  EXPECT_EQ(materialOfStrand(material, 17), own);
}

TEST(MaterialOfStrand, VariesWithinItsSharesAndEvenly) {
  Material material;
  material.variation = {.bendStiffness = 0.3, .coreStiffness = 0.2, .bendDampingRatio = 0.1, .seed = 5};
  constexpr int kStrands = 20000;
  double sum = 0, squares = 0, least = 1, most = 0, product = 0;
  for (int i = 0; i < kStrands; ++i) {
    const Material own = materialOfStrand(material, static_cast<std::size_t>(i));
    const double bend = (own.bendStiffness / material.bendStiffness - 1) / 0.3,
                 core = (own.coreStiffness / material.coreStiffness - 1) / 0.2,
                 ratio = (own.bendDampingRatio / material.bendDampingRatio - 1) / 0.1;
    for (const double x : {bend, core, ratio}) EXPECT_LE(std::abs(x), 1 + 1e-12);
    sum += bend;
    squares += bend * bend;
    product += bend * core;
    least = std::min(least, bend);
    most = std::max(most, bend);
    EXPECT_EQ(materialOfStrand(own, 3), own) << "what has been varied is not varied again";
  }
  // Even from -1 to 1: mean 0, variance 1/3; four standard errors of either, and of the product of two.
  EXPECT_NEAR(sum / kStrands, 0, 4 * std::sqrt(1.0 / 3 / kStrands));
  EXPECT_NEAR(squares / kStrands, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / kStrands));
  EXPECT_NEAR(product / kStrands, 0, 4.0 / 3 / std::sqrt(kStrands));
  EXPECT_LT(least, -0.999);
  EXPECT_GT(most, 0.999);
}

TEST(MaterialOfStrand, HangsOnSeedAndIndexAlone) {
  Material material;
  material.variation = {.bendStiffness = 0.3, .coreStiffness = 0, .bendDampingRatio = 0, .seed = 5};
  const double bend = materialOfStrand(material, 7).bendStiffness;
  EXPECT_EQ(materialOfStrand(material, 7).bendStiffness, bend);
  EXPECT_NE(materialOfStrand(material, 8).bendStiffness, bend);
  material.variation.coreStiffness = 0.5;
  EXPECT_EQ(materialOfStrand(material, 7).bendStiffness, bend) << "one variation does not change another";
  material.variation.seed = 6;
  EXPECT_NE(materialOfStrand(material, 7).bendStiffness, bend);
}

}  // namespace
}  // namespace ringlet::material_parameters_test
