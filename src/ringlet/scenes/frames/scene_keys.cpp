// Implements scenes/frames/scene_keys.h.
#include "ringlet/scenes/frames/scene_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scenes/file/scene_fields.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

double inRange(double value, const NumberRange& allowed) {
  const bool isAny = allowed.low == 0 && allowed.high == 0;
  return isAny ? value : std::clamp(value, allowed.low, allowed.high);
}

// How to get at a part of a scene.
template <class Owner>
auto partOf(Owner SceneFile::*owner) {
  return [owner](auto& scene) -> auto& { return scene.*owner; };
}

// Whole numbers, texts and switches do not change smoothly.
template <class Owner>
void addField(std::vector<KeyedNumber>& numbers, const std::string& table, const SettingField<Owner>& field,
              auto ownerOf) {
  const std::string key = fmt::format("{}.{}", table, field.key);
  std::visit(
      [&](auto member) {
        using Value = typename Unwrapped<std::remove_cvref_t<decltype(std::declval<Owner&>().*member)>>::Type;
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Vec3d>) {
          constexpr bool isVector = std::is_same_v<Value, Vec3d>;
          const auto get = [ownerOf, member](const SceneFile& scene) {
            const auto& value = ownerOf(scene).*member;
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
          const auto set = [ownerOf, member](SceneFile& scene, const Vec3d& value) {
            if constexpr (isVector) {
              ownerOf(scene).*member = value;
            } else {
              ownerOf(scene).*member = value.x;
            }
          };
          numbers.push_back({key, field.unit, field.allowed, isVector, get, set});
        }
      },
      field.member);
}

template <class Owner>
void addLive(std::vector<KeyedNumber>& numbers, const std::string& table,
             std::span<const SettingField<Owner>> fields, auto ownerOf) {
  for (const SettingField<Owner>& field : fields)
    if (field.isLive) addField(numbers, table, field, ownerOf);
}

// The live ones of every table of a list.
template <class Owner>
void addListed(std::vector<KeyedNumber>& numbers, const char* table,
               std::span<const SettingField<Owner>> fields, const SceneFile& scene,
               std::vector<Owner> SceneFile::*list) {
  for (std::size_t i = 0; i < (scene.*list).size(); ++i) {
    const std::string name = nameInKeys((scene.*list)[i].name, i);
    addLive(
        numbers, fmt::format("{}.{}", table, name), fields,
        [ list, i ](auto& of) -> auto& { return (of.*list)[i]; });
  }
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
          addField(numbers, "simulation", field, partOf(&SceneFile::simulation));
    }
    addMaterial(numbers, "material", materialParameters(),
                [](LoadedMaterial& m) -> Material& { return m.material; });
    addMaterial(numbers, "material.dials", dialParameters(),
                [](LoadedMaterial& m) -> MaterialDials& { return m.dials; });
    addMaterial(numbers, "material.variation", variationParameters(),
                [](LoadedMaterial& m) -> MaterialVariation& { return m.material.variation; });
    addLive(numbers, "contacts", contactFields(), partOf(&SceneFile::contacts));
    addLive(numbers, "air", airFields(), partOf(&SceneFile::air));
    addLive(numbers, "goal", goalFields(), partOf(&SceneFile::goal));
    return numbers;
  }();
  return all;
}

std::string nameInKeys(const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{}", index + 1) : name;
}

std::vector<KeyedNumber> actingNumbers(const SceneFile& scene) {
  std::vector<KeyedNumber> numbers;
  addListed(numbers, "field", forceFieldFields(), scene, &SceneFile::fields);
  addListed(numbers, "hold", holdFields(), scene, &SceneFile::holds);
  return numbers;
}

std::optional<KeyedNumber> keyedNumber(const SceneFile& scene, std::string_view key) {
  const auto among = [&](std::span<const KeyedNumber> numbers) -> std::optional<KeyedNumber> {
    const auto found = std::ranges::find(numbers, key, &KeyedNumber::key);
    return found == numbers.end() ? std::nullopt : std::optional(*found);
  };
  if (auto number = among(keyedNumbers())) return number;
  return among(actingNumbers(scene));
}

void switchOn(const KeyedNumber& number, SceneFile& scene) {
  if (number.key.starts_with("material.")) scene.hasMaterial = true;
  if (number.key.starts_with("contacts.")) scene.contacts.on = true;
  if (number.key.starts_with("air.")) scene.air.on = true;
  if (number.key.starts_with("goal.")) scene.goal.on = true;
}

Vec3d SceneKeys::Track::at(double seconds) const {
  const Vec3d value = keys.poseAt(seconds).position;
  const NumberRange& allowed = number.allowed;
  return {inRange(value.x, allowed), number.isVector ? inRange(value.y, allowed) : 0,
          number.isVector ? inRange(value.z, allowed) : 0};
}

Result<SceneKeys> SceneKeys::make(const SceneFile& scene) {
  SceneKeys self;
  self.scene_ = scene;
  for (const SceneTimeKey& key : scene.timeKeys) {
    self.times_.push_back(key.time);
    for (const SceneKeyedValue& value : key.values) {
      const auto number = keyedNumber(scene, value.key);
      if (!number) return Error{fmt::format("{} does not change while hair moves", value.key)};
      auto track = std::ranges::find(self.tracks_, value.key, [](const Track& of) { return of.number.key; });
      if (track == self.tracks_.end()) {
        self.tracks_.push_back({*number, Keyframes{.poses = {}, .restsAtEnds = true}});
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
  for (const Track& track : tracks_) track.number.set(scene, track.at(seconds));
  SceneNumbers numbers{settingsOf(scene), {}};
  numbers.settings.stepsPerFrame = stepsPerFrame;
  std::vector<std::string> warnings;  // said of the file
  auto material = loadMaterialOf(scene, numbers.settings.integrator, warnings);
  if (!material) return Error{fmt::format("at {} s: {}", seconds, material.error().message)};
  numbers.material = std::move(*material);
  return numbers;
}

std::vector<SceneForceField> SceneKeys::fieldsAt(double seconds) const {
  SceneFile scene;
  scene.fields = scene_.fields;
  for (const Track& track : tracks_)
    if (track.number.key.starts_with("field.")) track.number.set(scene, track.at(seconds));
  return scene.fields;
}

std::vector<SceneHold> SceneKeys::holdsAt(double seconds) const {
  SceneFile scene;
  scene.holds = scene_.holds;
  for (const Track& track : tracks_)
    if (track.number.key.starts_with("hold.")) track.number.set(scene, track.at(seconds));
  return scene.holds;
}

GoalSettings SceneKeys::goalAt(double seconds) const {
  SceneFile scene;
  scene.goal = scene_.goal;
  for (const Track& track : tracks_)
    if (track.number.key.starts_with("goal.")) track.number.set(scene, track.at(seconds));
  return scene.goal;
}

bool SceneKeys::changeContacts() const {
  return std::ranges::any_of(tracks_,
                             [](const Track& track) { return track.number.key.starts_with("contacts."); });
}

}  // namespace ringlet
