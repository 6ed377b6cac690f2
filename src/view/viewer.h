// runView: a window in which a scene's hair moves, until it is closed.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "view/hair_pane.h"

namespace ringlet::view {

/// A solid that is seen: a body of the scene, or what the head carries.
struct ViewSolid {
  std::optional<std::size_t> body;
  SolidPlace onHead{};  // of what the head carries
};

struct ViewPlan {
  const SceneFile* file = nullptr;
  const LoadedScene* scene = nullptr;
  PaneLook look;                  // its solids are those of `solids`
  std::vector<ViewSolid> solids;  // one for each of them
  Vec3d up{0, 1, 0};
  std::string device;                 // as gpu::Device::open takes it
  std::filesystem::path cacheFolder;  // likewise
  int frameCount = 0;                 // after which it ends; 0: when it is closed
  bool startsPaused = false;
  std::filesystem::path saveTo;    // the scene with changed numbers
  std::filesystem::path pictures;  // a folder for window.0001.png and so on
  std::filesystem::path widgets;   // a file that tells where widgets are, every frame; empty: none
  bool (*wasInterrupted)() = nullptr;
};

struct ViewOutcome {
  std::size_t frameCount = 0;                          // shown
  double seconds = 0, cpuSeconds = 0;                  // of these, but for the first
  std::vector<std::pair<std::string, double>> stages;  // [ms a frame]
  std::size_t sceneFrames = 0;                         // stepped since the beginning
  std::uint64_t deviceBytes = 0;
  std::string device, driver;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> warnings, validationMessages;
};

/// Fails with one sentence.
Result<ViewOutcome> runView(const ViewPlan& plan);

}  // namespace ringlet::view
