// Implements scenes/scene_keys.h.
#include "ringlet/scenes/scene_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_fields.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet {
namespace {

double inRange(double value, const NumberRange& allowed) {
  const bool isAny = allowed.low == 0 && allowed.high == 0;
  return isAny ? value : std::clamp(value, allowed.low, allowed.high);
}

// Whole numbers, texts and switches do not change smoothly.
template <class Owner>
void addField(std::vector<KeyedNumber>& numbers, const char* table, const SettingField<Owner>& field,
              Owner SceneFile::*owner) {
  const std::string key = fmt::format("{}.{}", table, field.key);
  std::visit(
      [&](auto member) {
        using Value = typename Unwrapped<std::remove_cvref_t<decltype(std::declval<Owner&>().*member)>>::Type;
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Vec3d>) {
          constexpr bool isVector = std::is_same_v<Value, Vec3d>;
          const auto get = [owner, member](const SceneFile& scene) {
            const auto& value = (scene.*owner).*member;
            Value now{};
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::optional<Value>>) {
              now = value.value_or(Value{});
            } else {
              now = value;
            }
            if constexpr (isVector) {
              return now;
            } else {
              return Vec3d{now, 0, 0};
            }
          };
          const auto set = [owner, member](SceneFile& scene, const Vec3d& value) {
            if constexpr (isVector) {
              (scene.*owner).*member = value;
            } else {
              (scene.*owner).*member = value.x;
            }
          };
          numbers.push_back({key, field.unit, field.allowed, isVector, get, set});
        }
      },
      field.member);
}

template <class Owner>
void addLive(std::vector<KeyedNumber>& numbers, const char* table,
             std::span<const SettingField<Owner>> fields, Owner SceneFile::*owner) {
  for (const SettingField<Owner>& field : fields)
    if (field.isLive) addField(numbers, table, field, owner);
}

// Those of a material that it may change while hair moves: found by changing them.
template <class Owner, class OwnerOf>
void addMaterial(std::vector<KeyedNumber>& numbers, const char* table,
                 std::span<const Parameter<Owner>> parameters, OwnerOf ownerOf) {
  for (const Parameter<Owner>& parameter : parameters) {
    if (parameter.isWhole() || parameter.canBeUnset()) continue;
    LoadedMaterial changed;
    parameter.set(ownerOf(changed), 0.5 * (parameter.usual.low + *parameter.defaultValue()) + 1e-3);
    Material material = changed.material;
    (void)applyDials(changed.dials, material);
    if (!fixedDifference(Material{}, material).empty()) continue;
    numbers.push_back({fmt::format("{}.{}", table, parameter.key), parameter.unit, parameter.allowed, false,
                       [&parameter, ownerOf](const SceneFile& scene) {
                         LoadedMaterial copy = scene.material;
                         return Vec3d{parameter.of(ownerOf(copy)).value_or(0), 0, 0};
                       },
                       [&parameter, ownerOf](SceneFile& scene, const Vec3d& value) {
                         parameter.set(ownerOf(scene.material), value.x);
                       }});
  }
}

}  // namespace

std::span<const KeyedNumber> keyedNumbers() {
  static const std::vector<KeyedNumber> all = [] {
    std::vector<KeyedNumber> numbers;
    for (const auto& field : simulationFields()) {
      for (const char* key : {"gravity", "max_stretch", "teleport_distance", "sleep_speed"})
        if (field.key == std::string_view(key))
          addField(numbers, "simulation", field, &SceneFile::simulation);
    }
    addMaterial(numbers, "material", materialParameters(),
                [](LoadedMaterial& m) -> Material& { return m.material; });
    addMaterial(numbers, "material.dials", dialParameters(),
                [](LoadedMaterial& m) -> MaterialDials& { return m.dials; });
    addMaterial(numbers, "material.variation", variationParameters(),
                [](LoadedMaterial& m) -> MaterialVariation& { return m.material.variation; });
    addLive(numbers, "contacts", contactFields(), &SceneFile::contacts);
    addLive(numbers, "air", airFields(), &SceneFile::air);
    addLive(numbers, "goal", goalFields(), &SceneFile::goal);
    return numbers;
  }();
  return all;
}

const KeyedNumber* keyedNumber(std::string_view key) {
  const auto numbers = keyedNumbers();
  const auto found = std::ranges::find(numbers, key, &KeyedNumber::key);
  return found == numbers.end() ? nullptr : &*found;
}

void switchOn(const KeyedNumber& number, SceneFile& scene) {
  if (number.key.starts_with("material.")) scene.hasMaterial = true;
  if (number.key.starts_with("contacts.")) scene.contacts.on = true;
  if (number.key.starts_with("air.")) scene.air.on = true;
  if (number.key.starts_with("goal.")) scene.goal.on = true;
}

Vec3d SceneKeys::Track::at(double seconds) const {
  const Vec3d value = keys.poseAt(seconds).position;
  const NumberRange& allowed = number->allowed;
  return {inRange(value.x, allowed), number->isVector ? inRange(value.y, allowed) : 0,
          number->isVector ? inRange(value.z, allowed) : 0};
}

Result<SceneKeys> SceneKeys::make(const SceneFile& scene) {
  SceneKeys self;
  self.scene_ = scene;
  for (const SceneTimeKey& key : scene.timeKeys) {
    self.times_.push_back(key.time);
    for (const SceneKeyedValue& value : key.values) {
      const KeyedNumber* number = keyedNumber(value.key);
      if (!number) return Error{fmt::format("{} does not change while hair moves", value.key)};
      auto track = std::ranges::find(self.tracks_, number, &Track::number);
      if (track == self.tracks_.end()) {
        self.tracks_.push_back({number, Keyframes{.poses = {}, .restsAtEnds = true}});
        track = self.tracks_.end() - 1;
        switchOn(*number, self.scene_);
      }
      track->keys.poses.push_back({value.value, {}});
      track->keys.times.push_back(key.time);
    }
  }
  for (const double time : self.times_) {
    if (auto numbers = self.at(time, 1); !numbers) return numbers.error();
  }
  return self;
}

Result<SceneNumbers> SceneKeys::at(double seconds, int stepsPerFrame) const {
  SceneFile scene = scene_;
  for (const Track& track : tracks_) track.number->set(scene, track.at(seconds));
  SceneNumbers numbers{settingsOf(scene), {}};
  numbers.settings.stepsPerFrame = stepsPerFrame;
  std::vector<std::string> warnings;  // said of the file
  auto material = loadMaterialOf(scene, numbers.settings.integrator, warnings);
  if (!material) return Error{fmt::format("at {} s: {}", seconds, material.error().message)};
  numbers.material = std::move(*material);
  return numbers;
}

bool SceneKeys::areEqual(double a, double b) const {
  return std::ranges::all_of(tracks_, [&](const Track& track) { return track.at(a) == track.at(b); });
}

bool SceneKeys::changeContacts() const {
  return std::ranges::any_of(tracks_,
                             [](const Track& track) { return track.number->key.starts_with("contacts."); });
}

}  // namespace ringlet
