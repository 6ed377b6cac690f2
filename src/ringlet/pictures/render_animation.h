// Renders an animation: frames are read, hair follows them on the device, is drawn, and pictures are written.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/pictures/picture_camera.h"
#include "ringlet/pictures/picture_files.h"
#include "ringlet/pictures/picture_hair.h"
#include "ringlet/pictures/strand_colours.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet {

/// A ground under everything.
struct Ground {
  std::optional<double> height;  // along the up axis [m]; none: that of the lowest point of all frames
};

struct RenderPlan {
  PictureTarget target;                // framesPerSecond: that of the animation
  int firstFrame = 1, lastFrame = 0;   // of the animation; lastFrame 0: its end
  bool isSheet = false;                // at most six of these, evenly spaced, as panels of one picture
  const Groom* rest = nullptr;         // the strands as groomed; null: frame 1
  const LoadedScene* scene = nullptr;  // its bodies are shown; null: a head if roots lie on a ball
  bool showsSolids = true;
  std::optional<Ground> ground;
  PictureHairChoice hair;
  PictureSize size;
  Look look;
  std::optional<StrandColourChoice> colours;  // in place of the look's hair colour
  PictureCameraChoice camera;
  int moments = 1;                    // of a frame, over the half of it before its end: motion blur
  std::function<bool()> isStopped{};  // called before each picture; true: end early
  std::function<void(int finished, int count)> progress{};  // called before the first picture and after each
};

/// Mean seconds a frame, without the first, which compiles kernels, unless it is the only one.
struct RenderOutcome {
  int frameCount = 0;
  std::size_t strandCount = 0, hairCount = 0, pointCount = 0;
  double width = 0;                                    // [m]
  double secondsPerFrame = 0, cpuSecondsPerFrame = 0;  // moving and drawing hair; without files
  double startSeconds = 0;                             // reading for the camera, planning hair, compiling
  std::map<std::string, double> stages;                // on the device [ms a frame]
  std::uint64_t deviceBytes = 0;
  bool showsHead = false;              // a head is drawn that is no body of the scene
  std::optional<double> groundHeight;  // [m]
  bool interrupted = false;
  std::vector<std::filesystem::path> outputs;  // the first and the last
  std::vector<std::string> warnings;
};

/// Finished pictures are kept even after an error. An error is one sentence.
Result<RenderOutcome> renderAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                      const RenderPlan& plan);

/// One picture of a groom whose up axis is `up`.
Result<RenderOutcome> renderGroom(const Groom& groom, UpAxis up, const ComputeDevice& device,
                                  const RenderPlan& plan);

}  // namespace ringlet
