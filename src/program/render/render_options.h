// The options of `ringlet render`, and what they ask for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"
#include "program/cli/key_options.h"
#include "ringlet/pictures/render_animation.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// As they were typed.
struct RenderOptions {
  std::filesystem::path input, output, groom, scene, against;
  std::string frames, size = "960x540", colour = "auburn", up = "Y", camera, ground, format = "png", device;
  std::optional<int> hairs;
  TypedKeys keys;
  SceneReach reach = SceneReach::anywhere;
  std::optional<double> metresPerUnit, width, melanin, most;
  double redness = 0.3, azimuth = 35, elevation = 5, distance = 1, orbit = 0;
  int samples = 4, blur = 1;
  bool isGroom = false;  // IN is a groom, and no animation
  bool noBodies = false, noLegend = false, json = false, quiet = false;
};

void addRenderOptions(CLI::App& command, RenderOptions& options);

/// Throws CLI::ValidationError for what makes no sense together.
void checkRenderOptions(const RenderOptions& options);

/// All but what must be read: the scene, its camera, the strands at rest.
RenderPlan renderPlanOf(const RenderOptions& options);

}  // namespace ringlet::program
