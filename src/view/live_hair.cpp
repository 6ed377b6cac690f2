// Implements view/live_hair.h.
#include "view/live_hair.h"

#include <utility>

#include "ringlet/rest/live_material.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::view {
namespace {

constexpr double kRounding = 1 + 1e-9;  // of two ways to say one step

}  // namespace

Result<LiveHair> LiveHair::create(const ComputeDevice& device, const LoadedScene& scene,
                                  const HairNumbers& numbers, const SceneMoment& now) {
  LiveHair self(device, scene, numbers);
  if (Status built = self.build(now); !built) return built.error();
  return self;
}

Status LiveHair::build(const SceneMoment& now) {
  auto asset =
      HairAsset::build(*device_, scene_->groom, numbers_.material, numbers_.settings, kernelOf(*scene_));
  if (!asset) return asset.error();
  asset_ = std::move(*asset);
  built_ = numbers_;
  return place(now);
}

Status LiveHair::place(const SceneMoment& now) {
  const ScenePlaces places = now.frames.placesAt(now.frame, now.dragsBefore);
  InitialState start = stateOf(places, *scene_);
  start.readsBack = false;
  auto hair = Simulation::create(*asset_, start);
  if (!hair) return hair.error();
  hair_.emplace(std::move(*hair));
  if (now.frame == now.frames.first()) {
    if (Status begun = beginShot(places, *scene_, *hair_); !begun) return begun;
  }
  for (const TimedCuts& before : now.frames.cutsBefore(now.frame)) {
    if (Status cut = hair_->cut(before.cuts); !cut) return cut;
  }
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

Result<LiveHair::Change> LiveHair::setNumbers(const HairNumbers& numbers, const SceneMoment& now) {
  const bool isOtherMaterial = !(numbers.material == numbers_.material);
  const bool areOtherSettings = !(numbers.settings == numbers_.settings);
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
  if (Status built = anew.build(now); !built) return built.error();
  if (Status set = anew.hair_->setState(*state); !set) return set.error();
  *this = std::move(anew);
  return Change::rebuilt;
}

Status LiveHair::reset(const SceneMoment& now) {
  if (Status placed = place(now); !placed) return placed;
  if (Status set = hair_->setSettings(numbers_.settings); !set) return set;
  return hair_->setMaterial(numbers_.material);
}

}  // namespace ringlet::view
