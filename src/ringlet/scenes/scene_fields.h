// Every key of a scene file, once: where it goes, its type, unit, range, default, and what it does. What
// reads, writes, lists and checks scene files goes through these tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet {

/// A key whose value is a part of an Owner: SceneGroom, SceneMotion, ...
template <class Owner>
struct SceneField {
  const char* key;
  const char* unit;      // of numbers; "" for none
  const char* standard;  // what holds without the key, in words; "" for the Owner's own default
  const char* effect;    // one sentence
  std::variant<double Owner::*, std::optional<double> Owner::*, int Owner::*, std::optional<int> Owner::*,
               std::uint32_t Owner::*, bool Owner::*, std::string Owner::*, std::filesystem::path Owner::*,
               Vec3d Owner::*, std::optional<Vec3d> Owner::*, std::optional<Quatd> Owner::*,
               std::vector<std::string> Owner::*, ContactTaper Owner::*, ContactMethod Owner::*>
      member;
  NumberRange allowed{};   // of a number, or of each of several
  std::string choices{};   // of a text or a list of texts, separated by commas; "" for any
  std::string onlyWith{};  // the kinds, shapes or sources that have it, separated by commas; "" for all
};

std::span<const SceneField<SceneGroom>> groomFields();
std::span<const SceneField<SceneMotion>> motionFields();      // of the head's and of bodies' own
std::span<const SceneField<SceneMotion>> headMotionFields();  // of the head's only
std::span<const SceneField<SceneKeyframe>> keyframeFields();
std::span<const SceneField<SceneRoots>> rootsFields();
std::span<const SceneField<SceneScalp>> scalpFields();
std::span<const SceneField<SceneSimulation>> simulationFields();
std::span<const SceneField<ContactSettings>> contactFields();
std::span<const SceneField<AirSettings>> airFields();
std::span<const SceneField<SceneBody>> bodyFields();
std::span<const SceneField<SceneOutput>> outputFields();

/// "a, b, c" as a list.
std::vector<std::string> namesIn(std::string_view list);

}  // namespace ringlet
