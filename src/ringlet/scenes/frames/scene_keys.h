// Keys over time of a scene: numbers that change while hair moves. [[key]] of a scene file.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/number_range.h"
#include "ringlet/base/result.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/keyframes.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// A number of a scene that may change while hair moves, or three of them.
struct KeyedNumber {
  std::string key;  // with its table: "air.wind", "material.dials.hold"
  const char* unit;
  NumberRange allowed;
  bool isVector;
  std::function<Vec3d(const SceneFile&)> get;         // one number: x
  std::function<void(SceneFile&, const Vec3d&)> set;  // in the range
};

/// All there are: the live ones of settings_fields.h, but for a frame's length, and of a material and its
/// dials what setMaterial takes.
std::span<const KeyedNumber> keyedNumbers();
/// And those of fields and holds that a scene has: "field.NAME.strength".
std::vector<KeyedNumber> actingNumbers(const SceneFile& scene);
/// Nothing for a key that is among neither.
std::optional<KeyedNumber> keyedNumber(const SceneFile& scene, std::string_view key);
/// What a field or hold is called in keys: its name, or its number from 1.
std::string nameInKeys(const std::string& name, std::size_t index);

/// Switches on what a keyed number is a part of: keys of air.wind are air, with or without [air].
void switchOn(const KeyedNumber& number, SceneFile& scene);

/// What hair moves by at some time.
struct SceneNumbers {
  Settings settings;
  Material material;  // its dials worked in
};

/// The numbers of a scene with keys. Between keys each goes on the cubic that head motions by keys take,
/// within its range; before its first key and after its last it stays.
class SceneKeys {
 public:
  /// Of a scene file that has keys. Errors: a material that its dials spoil at some key.
  static Result<SceneKeys> make(const SceneFile& scene);

  /// With as many steps a frame as `stepsPerFrame`. Errors: numbers that spoil each other between keys.
  Result<SceneNumbers> at(double seconds, int stepsPerFrame) const;
  /// Of the keys, rising [s].
  const std::vector<double>& times() const { return times_; }
  /// Fields and holds as they are then, in the scene's order.
  std::vector<SceneForceField> fieldsAt(double seconds) const;
  std::vector<SceneHold> holdsAt(double seconds) const;
  GoalSettings goalAt(double seconds) const;
  bool changeContacts() const;

 private:
  struct Track {
    KeyedNumber number;
    Keyframes keys;  // values are positions
    Vec3d at(double seconds) const;
  };

  SceneFile scene_;
  std::vector<Track> tracks_;
  std::vector<double> times_;
};

}  // namespace ringlet
