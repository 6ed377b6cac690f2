// SceneHair: the hair of a scene, stepped frame by frame by some backend: a device (device_hair.h), several
// devices (split_hair.h), or, in the program, the reference or other ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Sums over all steps since the hair was made.
struct HairReports {
  SimulationReport hair;
  ContactReport contacts;  // of the last frame; empty without contacts
};

/// Computing times, summed over all frames waited for [ms].
struct HairTimes {
  std::map<std::string, double> stages{};
  std::optional<HostMilliseconds> host{};  // none without a device, or with several
};

struct HairFacts {
  std::string device, driver, kernel;
  std::size_t rigidStrandCount = 0;            // number of strands carried rigidly (rest/rigid_strands.h)
  bool isTuned = false;                        // measurements of `ringlet tune` chose the shapes
  double compileMilliseconds = 0;              // of its kernels; 0 if there are none to compile
  std::optional<std::uint64_t> deviceBytes{};  // of its device buffers at present; none without a device
  std::vector<std::string> warnings{};         // of the hair and its settings
  std::vector<std::string> messages{};         // of the device
};

class SceneHair {
 public:
  virtual ~SceneHair() = default;

  /// Applies the frame's change and steps it. Frames in flight are as in Simulation (kFramesInFlight; so is
  /// how long framePositions may be called); there may be none if the frame has a change.
  virtual Status submit(const SceneFrame& frame) = 0;
  virtual Status wait() = 0;
  /// Positions of the frame waited for last, written into positions of the whole groom: groom order, relative
  /// to the head's origin, along world axes [m]. Divided hair writes only its own strands.
  virtual void framePositions(std::span<Vec3f> all) = 0;
  /// The present positions, also before the first frame; no frame may be in flight.
  virtual Result<std::vector<Vec3f>> positions() = 0;
  /// The state on which later frames depend, with no frame in flight. restore() puts it into hair that has
  /// stepped nothing, which then continues with frame `frame`. As Simulation::checkpoint and restore.
  virtual Result<std::vector<std::byte>> checkpoint() = 0;
  virtual Status restore(const SceneFrames& frames, int frame, std::span<const std::byte> checkpoint) = 0;
  virtual Result<HairReports> reports() = 0;
  virtual HairTimes times() const = 0;
  /// The dispatches of the frame waited for last, on one device; empty for other backends.
  virtual std::vector<StageSpan> frameStages() const { return {}; }
  /// Whether times() may be called after every frame: not where it costs a message to other ranks.
  virtual bool tellsTimesOfFrames() const { return true; }
  virtual HairFacts facts() const = 0;
};

/// What a backend makes hair from.
struct SceneHairInput {
  const LoadedScene& scene;
  const SceneFrames& frames;        // of this scene
  bool isStepByStep = false;        // each frame submitted is a step (SceneFrame::step) and not a whole frame
  bool measuresResidual = false;    // of the velocity solve
  const WholeRest* rest = nullptr;  // of all of the hair, if it is known

  Settings settings() const { return isStepByStep ? stepByStep(frames.settings()) : frames.settings(); }
};

/// Makes the hair of a run. hairOn (divided_hair.h) makes it on devices.
using HairMaker = std::function<Result<std::unique_ptr<SceneHair>>(const SceneHairInput&)>;

/// Applies permanent changes to hair; `Hair` has cut and setNumbers.
template <class Hair>
Status takeChange(const HairChange& change, bool isStepByStep, Hair& hair) {
  for (const TimedCuts& now : change.cuts) {
    if (Status cut = hair.cut(now.cuts); !cut) return cut;
  }
  if (!change.numbers) return {};
  const Settings& settings = change.numbers->settings;
  return hair.setNumbers(isStepByStep ? stepByStep(settings) : settings, change.numbers->material);
}
template <class Hair>
Status takeChangesBefore(const SceneFrames& frames, int frame, bool isStepByStep, Hair& hair) {
  const auto changes = frames.changesBefore(frame);
  if (!changes) return changes.error();
  for (const HairChange& change : *changes) {
    if (Status taken = takeChange(change, isStepByStep, hair); !taken) return taken;
  }
  return {};
}

}  // namespace ringlet
