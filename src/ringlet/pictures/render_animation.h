// Pictures of an animation: frames are read, hair follows them on the device, is drawn, and written.
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
  std::optional<double> height;  // along the up axis [m]; none: of the lowest point of all frames
};

struct RenderPlan {
  PictureTarget target;                // framesPerSecond: that of the animation
  int firstFrame = 1, lastFrame = 0;   // of the animation; the last 0: all there are
  bool isSheet = false;                // at most six of these, evenly chosen, as panels of one picture
  const Groom* rest = nullptr;         // the strands as they were groomed; none: frame 1
  const LoadedScene* scene = nullptr;  // whose bodies are shown; none: a head where roots are on a ball
  bool showsSolids = true;
  std::optional<Ground> ground;
  PictureHairChoice hair;
  PictureSize size;
  Look look;
  std::optional<StrandColourChoice> colours;  // in place of the look's
  PictureCameraChoice camera;
  int moments = 1;                    // of a frame, over the half of it before its end: motion blur
  std::function<bool()> isStopped{};  // asked before each picture: whether to end early
  std::function<void(int finished, int count)> progress{};  // before the first, and after each
};

/// Seconds are means over frames, but for the first, which compiles kernels; where there is only one, of
/// that.
struct RenderOutcome {
  int frameCount = 0;
  std::size_t strandCount = 0, hairCount = 0, pointCount = 0;
  double width = 0;                                    // [m]
  double secondsPerFrame = 0, cpuSecondsPerFrame = 0;  // of setting and drawing; not of files
  double startSeconds = 0;                             // reading for the camera, planning hair, compiling
  std::map<std::string, double> stages;                // on the device [ms a frame]
  std::uint64_t deviceBytes = 0;
  bool showsHead = false;              // that is none of the scene's bodies
  std::optional<double> groundHeight;  // [m]
  bool interrupted = false;
  std::vector<std::filesystem::path> outputs;  // the first and the last
  std::vector<std::string> warnings;
};

/// Pictures that are finished stay, whatever comes. Fails with one sentence.
Result<RenderOutcome> renderAnimation(const std::filesystem::path& animation, const ComputeDevice& device,
                                      const RenderPlan& plan);

/// One picture of a groom whose up axis is `up`.
Result<RenderOutcome> renderGroom(const Groom& groom, UpAxis up, const ComputeDevice& device,
                                  const RenderPlan& plan);

}  // namespace ringlet
