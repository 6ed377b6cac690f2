// One run of hair: steps it frame by frame, writes what comes out.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "program/hair_look.h"
#include "program/run_folder.h"
#include "ringlet/base/result.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/measure/contact_watch.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_file.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::program {

/// Where hair is stepped, how long, and what is kept of it.
struct RunOptions {
  std::filesystem::path folder;                  // for the results; empty: nothing is written
  std::vector<std::string> animations{".usda"};  // endings of what is written as hair.*, but for the cache
  bool writesLast = true, writesSheet = true;    // last.obj, sheet.png
  std::optional<CachePrecision> cache;           // of hair.rgc; none: it is not written
  UpAxis up = UpAxis::y;
  double width = 0.0005;                // diameter of strands in what is written [m]
  std::optional<double> tipWidth;       // at the tip, in USD files [m]
  std::vector<std::string> values;      // that these have besides, as SceneOutput says them
  int hairs = 0;                        // above 0: animations have so many, which follow the strands
  HairLook look;                        // of these
  UsdHead usdHead = UsdHead::baked;     // and where these have the head's motion
  int clipFrames = 0;                   // above 0: hair.usda has value clips of so many frames
  bool usesGroomPrims = false;          // hair.usdc has changes of the prims of the groom's file
  const LoadedGroom* origin = nullptr;  // that file, where it is looked at for these
  bool onReference = false;             // rather than on the GPU
  bool onRanks = false;                 // each has a part of the hair (rank_hair.h)
  std::string device;
  std::vector<std::string> devices;     // in its place: on which the strands are divided
  std::optional<ComputeDevice> opened;  // in its place: runs on one device share its compiled kernels
  KernelChoice kernel;                  // its residual: measured where the integrator has one, on the GPU
  bool usesTuned = true;                // strand shapes by what `ringlet tune` measured
  bool showProgress = true;
  bool tellsFrames = false;   // a line of JSON a finished frame, on standard output
  int runNumber = 0;          // of a sweep, which these lines say; 0: of none
  bool observesLast = false;  // the observer needs the last frame only
  // Runs that do not end. A folder then has a checkpoint, from 1 frame up; 0: none, or as many as the run
  // had.
  int checkpointFrames = 0;  // from one to the next
  Leftovers leftovers = Leftovers::refuse;
  std::vector<RunFact> facts;  // what a run that goes on must have been a run of, but for device and kernels
  bool measuresContacts = false;  // every step and frame, with contacts on or off; costs CPU time
};

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

/// What came of it. Times of stages and waits: per finished frame [ms].
struct SimulateOutcome {
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
  std::string positionsHash;                     // of the last frame
  bool interrupted = false;
  bool canResume = false;  // it was interrupted, and a checkpoint is there
  int resumedFrom = 0;     // frames that a run before had done
  std::vector<std::string> warnings, notes;
  std::vector<std::filesystem::path> outputs;
  std::optional<double> cacheErrorBound;  // how far a point of the cache may be from its particle [m]
};

/// Sees every frame, in order, on a thread of its own, the last before runHair returns: points in the groom's
/// unit, in its order, finite; and where the head is. RunOptions::observesLast: it may miss all but the last.
using FrameObserver = std::function<Status(std::span<const Vec3f> points, const HeadPose& head)>;

/// Of the scene, which must live as long. Fails with one sentence; frames finished before a failure are kept.
/// Ctrl-C ends it early, but well: with what is finished, or, where it has checkpoints, with one.
Result<SimulateOutcome> runHair(const LoadedScene& scene, const RunOptions& options,
                                const FrameObserver& observer = {});

/// Whether the velocity solve's residual is asked for, and there is one.
bool measuresResidual(const LoadedScene& scene, const RunOptions& options);

/// What a scene says of its run and its files; all else is the default.
RunOptions runOptionsOf(const SceneFile& scene);

/// The same of a scene that a file says: its material is a fact, its warnings come before the run's own.
Result<SimulateOutcome> runLoadedScene(const LoadedScene& scene, RunOptions options,
                                       const FrameObserver& observer = {});

}  // namespace ringlet::program
