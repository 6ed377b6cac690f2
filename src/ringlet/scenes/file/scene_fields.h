// Every key of a scene file, once; those of contacts and the air are in scene/settings_fields.h. What reads,
// writes, lists and checks scene files goes through these tables.
#pragma once

#include <span>

#include "ringlet/scene/settings_fields.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

template <class Owner>
using SceneField = SettingField<Owner>;

inline constexpr NumberRange kPlace{-1e6, 1e6};  // of a coordinate [m]

std::span<const SceneField<SceneGroom>> groomFields();
std::span<const SceneField<HairCut>> cutFields();
std::span<const SceneField<SceneMotion>> motionFields();      // of the head's and of bodies' own
std::span<const SceneField<SceneMotion>> headMotionFields();  // of the head's only
std::span<const SceneField<SceneKeyframe>> keyframeFields();
std::span<const SceneField<SceneRoots>> rootsFields();
std::span<const SceneField<SceneScalp>> scalpFields();
std::span<const SceneField<SceneStart>> startFields();
std::span<const SceneField<SceneSimulation>> simulationFields();
std::span<const SceneField<SceneBody>> bodyFields();
std::span<const SceneField<SceneCamera>> cameraFields();
std::span<const SceneField<SceneForceField>> forceFieldFields();
std::span<const SceneField<SceneHold>> holdFields();
std::span<const SceneField<SceneCut>> sceneCutFields();
std::span<const SceneField<SceneMap>> mapFields();
std::span<const SceneField<SceneGroup>> groupFields();
std::span<const SceneField<SceneOutput>> outputFields();

}  // namespace ringlet
