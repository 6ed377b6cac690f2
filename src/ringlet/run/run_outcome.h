// RunOutcome: the results of a run.
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
#include "ringlet/measure/follow_numbers.h"
#include "ringlet/run/body_outcome.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Wall-clock time of the phases of a run [s].
struct RunSeconds {
  double start = 0;   // opening files and device, pre-roll
  double frames = 0;  // from the first frame until the last is written
  double finish = 0;  // closing files, last.obj, the sheet
};

/// Stepping times of frames [ms]. The first frame is listed apart: a driver may compile in it, and the time
/// that work takes is not known yet.
struct FrameMilliseconds {
  double first = 0, median = 0, least = 0;
};

/// Times of stages and waits are per finished frame [ms].
struct RunOutcome {
  int frameCount = 0;  // finished
  std::size_t strandCount = 0, particleCount = 0;
  double millisecondsPerFrame = 0;       // stepping only, by the device's clock if it has one
  std::map<std::string, double> stages;  // stepping in parts, by the same clock; all others in wall-clock
                                         // time, which overlaps with other work
  RunSeconds wall;
  double computeShare = 0;  // stepping as a share of wall.frames
  // Time for which the frame loop waited for stepping, and for the writer to take a frame.
  double waitedForDevice = 0, waitedForWriter = 0;
  std::optional<FrameMilliseconds> frameTimes;  // none if there was no frame, or ranks step the hair
  // With one device: the host's time for submitting frames and for waiting at fences, which may overlap with
  // submitting or waiting of the loop; and for copying positions out of the frame.
  std::optional<HostMilliseconds> host;
  double copied = 0;
  SimulationReport report;
  std::optional<double> velocityResidual;  // that of the report, if it was measured
  std::optional<ContactReport> contacts;   // if contacts are on; contacts and momentumError are those of the
                                           // worst frame if contacts are measured, else of the last frame
  std::optional<ContactNumbers> contactNumbers;  // if contacts are measured
  std::optional<BodyNumbers> bodyNumbers;        // over all frames; if there are bodies
  std::vector<BodyOutcome> bodies;               // each of them
  HairFacts hair;                                // at the end
  std::vector<Vec3f> positions;  // of the last frame, as SceneHair::positions; at the start if there was no
                                 // frame
  std::string positionsHash;     // of positions
  bool interrupted = false;      // it was stopped before its last frame
  bool canResume = false;        // a checkpoint exists
  int resumedFrom = 0;           // number of frames that an earlier run had done
  std::vector<std::string> warnings, notes;
  std::vector<std::filesystem::path> outputs;
  std::size_t hairCount = 0;              // that follow strands and are written in their place
  std::optional<FollowNumbers> follow;    // how well they do, where some of them are simulated as well
  std::optional<double> cacheErrorBound;  // largest distance of a point of the cache from its particle [m]
};

}  // namespace ringlet
