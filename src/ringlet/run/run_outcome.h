// RunOutcome: what came of a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/measure/contact_numbers.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Where a run's time went, on the wall's clock [s].
struct RunSeconds {
  double start = 0;   // opening files and device, pre-roll
  double frames = 0;  // from the first frame until the last is written
  double finish = 0;  // closing files, last.obj, the sheet
};

/// Of the frames' times of stepping [ms]. The first is of the run's own: in it a driver may compile, and how
/// long work takes is not known yet.
struct FrameMilliseconds {
  double first = 0, median = 0, least = 0;
};

/// Times of stages and waits: per finished frame [ms].
struct RunOutcome {
  int frameCount = 0;  // finished
  std::size_t strandCount = 0, particleCount = 0;
  double millisecondsPerFrame = 0;       // stepping only, by the device's own clock where it has one
  std::map<std::string, double> stages;  // that, in parts; all others by the wall, while others go on
  RunSeconds wall;
  double computeShare = 0;  // of wall.frames: stepping
  // What the loop over frames waited for stepping, and for room among frames to be written.
  double waitedForDevice = 0, waitedForWriter = 0;
  std::optional<FrameMilliseconds> frameTimes;  // none: no frame, or ranks step the hair
  // Of one device: handing frames to it and standing at its fences, which may be while the loop submits or
  // waits; and copying positions out of the frame.
  std::optional<HostMilliseconds> host;
  double copied = 0;
  SimulationReport report;
  std::optional<double> velocityResidual;  // the report's, where it was measured
  std::optional<ContactReport> contacts;   // where they are on; contacts and momentumError of the worst frame
                                           // where contacts are measured, else of the last
  std::optional<ContactNumbers> contactNumbers;  // where they are measured
  std::optional<BodyNumbers> bodyNumbers;        // where there are bodies; of every frame
  HairFacts hair;                                // at the end
  std::vector<Vec3f> positions;  // of the last frame, as SceneHair::positions; of the start, if there is none
  std::string positionsHash;     // of these
  bool interrupted = false;      // it was stopped before its last frame
  bool canResume = false;        // and a checkpoint is there
  int resumedFrom = 0;           // frames that a run before had done
  std::vector<std::string> warnings, notes;
  std::vector<std::filesystem::path> outputs;
  std::optional<double> cacheErrorBound;  // how far a point of the cache may be from its particle [m]
};

}  // namespace ringlet
