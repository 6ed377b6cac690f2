// Built-in scenes: hair, head and settings for what a curl solver must show, by name. Tests, benchmarks and
// `ringlet scene` use the same ones.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/material_dials.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Options of every scene; an option that is left out has the scene's own value.
struct SceneOptions {
  std::optional<int> particles{};  // of each strand, in [2, 65536]
  std::optional<int> strands{};    // in [1, 100000]: copies side by side; swatches, of which a scene may have
                                   // two (then of each), take whole rows; two_curls has its two
  std::optional<double> preload{};             // share of gravity balanced in the rest pose
  std::optional<double> bendStiffness{};       // K_b [w], a material's range; not for `paper`
  MaterialDials dials{};                       // on top of the scene's material
  std::optional<bool> contacts{};              // on or off
  bool core = true;                            // false: no core spring
  bool smoothedFrames = true;                  // false: frames follow the raw strand, smoothing length 0
  std::optional<int> stepsPerFrame{};          // default 8, or 30 for Integrator::paper
  std::optional<double> seconds{};             // length of the scene, in (0, 36000]
  Integrator integrator = Integrator::jacobi;  // `paper` has its own constants and no preload
};

/// The head rests at t = 0 and eases into its motion. Y is up. In walk_head the body is the generated head
/// (bodies/head_mesh.h); in bust it is a mesh that bends, and has the roots (motion/bust_motion.h). Warnings:
/// effects that the options prevent.
struct BuiltinScene : LoadedScene {
  std::string name{}, summary{};
  double seconds = 0;          // frameCount is whole frames of it, at least one
  bool showsContacts = false;  // it shows contacts between hairs (measure/contact_watch.h)
  bool showsFrames = false;    // it shows the turn of strand frames (measure/frame_turn.h)
};

/// hanging_curl, walk_cycle, head_shake, bounce, twist_jump, release, and those of hair that meets hair:
/// two_curls, curtain, pile, fall, flip, head, walk_head, bust.
std::vector<std::string> sceneNames();

/// What it shows, in a sentence; empty for an unknown name.
std::string sceneSummary(std::string_view name);

/// Whether that is hair that meets hair: contacts are on unless asked off, and measured in any case.
bool sceneShowsContacts(std::string_view name);

/// Errors: an unknown name, an option out of its range, a core or smoothed frames switched off for `paper`,
/// which knows neither switch.
Result<BuiltinScene> makeScene(std::string_view name, const SceneOptions& options = {});

}  // namespace ringlet
