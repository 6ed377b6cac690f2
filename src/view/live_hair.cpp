// Implements view/live_hair.h.
#include "view/live_hair.h"

#include <utility>

#include "ringlet/rest/live_material.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::view {
namespace {

constexpr double kRounding = 1 + 1e-9;  // of two ways to say one step

bool isSame(const Settings& a, const Settings& b) {
  const auto equal = [&](const auto& field, const auto& x, const auto& y) {
    return std::visit([&](auto member) { return x.*member == y.*member; }, field.member);
  };
  for (const auto& field : settingsFields())
    if (!equal(field, a, b)) return false;
  for (const auto& field : contactFields())
    if (!equal(field, a.contacts, b.contacts)) return false;
  for (const auto& field : airFields())
    if (!equal(field, a.air, b.air)) return false;
  for (const auto& field : goalFields())
    if (!equal(field, a.goal, b.goal)) return false;
  return a.integrator == b.integrator;
}

}  // namespace

Result<LiveHair> LiveHair::create(const ComputeDevice& device, const LoadedScene& scene,
                                  const HairNumbers& numbers, const Standing& standing) {
  LiveHair self(device, scene, numbers);
  if (Status built = self.build(standing); !built) return built.error();
  return self;
}

Status LiveHair::build(const Standing& standing) {
  KernelChoice choice;
  choice.movingRoots = !standing.roots.empty();
  choice.fields = scene_->forces.haveFields();
  choice.goals = scene_->forces.haveGoals();
  auto asset = HairAsset::build(*device_, scene_->groom, numbers_.material, numbers_.settings, choice,
                                scene_->bodies.empty() ? BodyUse::none : BodyUse::some);
  if (!asset) return asset.error();
  asset_ = std::move(*asset);
  built_ = numbers_;
  return place(standing);
}

Status LiveHair::place(const Standing& standing) {
  auto hair = Simulation::create(*asset_, {.head = standing.head,
                                           .oneStepEarlier = standing.headEarlier,
                                           .bodies = scene_->bodies,
                                           .bodyPlaces = standing.bodies,
                                           .roots = standing.roots,
                                           .rootsEarlier = standing.rootsEarlier,
                                           .rootShifts = scene_->rootShifts,
                                           .readsBack = false});
  if (!hair) return hair.error();
  hair_.emplace(std::move(*hair));
  return {};
}

bool LiveHair::canTake(const HairNumbers& numbers) const {
  const bool isOtherMaterial = !(numbers.material == numbers_.material);
  return fixedDifference(built_.settings, numbers.settings).empty() &&
         fixedDifference(built_.material, numbers.material).empty() &&
         (!isOtherMaterial || numbers.settings.integrator == Integrator::jacobi) &&
         numbers.settings.stepsPerFrame <= built_.settings.stepsPerFrame &&
         numbers.settings.stepSeconds() <= built_.settings.stepSeconds() * kRounding;
}

Result<LiveHair::Change> LiveHair::setNumbers(const HairNumbers& numbers, const Standing& standing) {
  const bool isOtherMaterial = !(numbers.material == numbers_.material);
  const bool areOtherSettings = !isSame(numbers.settings, numbers_.settings);
  if (!isOtherMaterial && !areOtherSettings) return Change::none;
  if (canTake(numbers)) {
    if (areOtherSettings) {
      if (Status set = hair_->setSettings(numbers.settings); !set) return set.error();
      numbers_.settings = numbers.settings;
    }
    if (isOtherMaterial) {
      if (Status set = hair_->setMaterial(numbers.material); !set) return set.error();
      numbers_.material = numbers.material;
    }
    return Change::live;
  }
  const auto state = hair_->state();
  if (!state) return state.error();
  LiveHair anew(*device_, *scene_, numbers);
  if (Status built = anew.build(standing); !built) return built.error();
  if (Status set = anew.hair_->setState(*state); !set) return set.error();
  *this = std::move(anew);
  return Change::rebuilt;
}

Status LiveHair::reset(const Standing& standing) {
  if (Status placed = place(standing); !placed) return placed;
  if (!isSame(numbers_.settings, built_.settings)) {
    if (Status set = hair_->setSettings(numbers_.settings); !set) return set;
  }
  return numbers_.material == built_.material ? Status{} : hair_->setMaterial(numbers_.material);
}

}  // namespace ringlet::view
