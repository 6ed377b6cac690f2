// Pictures of an animation: frames are read, hair follows them on the device, is drawn, and written as PNG.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/render/hair_renderer.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

struct RenderPlan {
  std::filesystem::path output;        // a folder for frame.0001.png and so on; or a .png, for one frame
  int firstFrame = 1, lastFrame = 0;   // of the animation; the last 0: all there are
  const Groom* rest = nullptr;         // the strands as they were groomed; none: frame 1
  const LoadedScene* scene = nullptr;  // whose bodies are shown; none: a head where roots are on a ball
  bool showsSolids = true;
  std::optional<int> hairs;     // that follow the strands; 0: the strands themselves; none: as usual
  std::optional<double> width;  // diameter at the root [m]; none: by the number of hairs
  PictureSize size;
  Look look;
  CameraPlace camera;
  double orbit = 0;  // that the camera goes round from the first frame to the last [rad]
  int moments = 1;   // of a frame, over the half of it before its end: motion blur
  bool showProgress = true;
};

/// Seconds are means over frames, but for the first, which compiles kernels; where there is only one, of
/// that.
struct RenderOutcome {
  int frameCount = 0;
  std::size_t strandCount = 0, hairCount = 0, pointCount = 0;
  double width = 0;                                    // [m]
  double secondsPerFrame = 0, cpuSecondsPerFrame = 0;  // of setting, drawing and reading back; not of files
  double startSeconds = 0;                             // reading for the camera, planning hair, compiling
  std::map<std::string, double> stages;                // on the device [ms a frame]
  std::uint64_t deviceBytes = 0;
  bool showsHead = false;  // that is none of the scene's bodies
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

}  // namespace ringlet::program
