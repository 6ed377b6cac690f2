// RunOptions: what a run of a scene writes, how often it writes checkpoints, and what it measures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/pictures/follow_mover.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/rest/material.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// What to do with files that a run finds in its folder. The last one resumes a run that has a checkpoint and
/// overwrites otherwise.
enum class Leftovers { refuse, overwrite, resume, resumeOrOverwrite };

/// How messages name the user's options.
struct RunWords {
  std::string overwrite = "Leftovers::overwrite", resume = "Leftovers::resume", elsewhere = "another folder",
              who = "a host of ringlet";
};

/// A named group of the scene's strands.
struct RunGroup {
  std::string name;
  std::vector<StrandRun> runs;
};

struct RunOptions {
  std::filesystem::path folder{};                // for the results; empty: nothing is written
  std::vector<std::string> animations{".usda"};  // endings of the hair.* files, without the cache
  bool writesLast = true, writesSheet = true;    // last.obj, sheet.png
  std::optional<CachePrecision> cache{};         // of hair.rgc; none: no cache is written
  UpAxis up = UpAxis::y;
  double width = 0.0005;              // diameter of strands in written files [m]
  std::optional<double> tipWidth{};   // at the tip, in USD files [m]
  std::vector<std::string> values{};  // further values in written files, as in SceneOutput
  std::vector<RunGroup> groups{};     // for the values of Unreal
  int hairs = 0;                      // above 0: animations contain this many hairs, which follow the
                                      // strands, in place of these
  HairLook look{};                    // of following hairs
  FollowMoverMaker mover{};  // moves following hairs, such as followOn(device); required if there are any
  UsdHead usdHead = UsdHead::baked;     // how USD files contain the head's motion
  int clipFrames = 0;                   // above 0: hair.usda has value clips of this many frames
  bool usesGroomPrims = false;          // hair.usdc contains changes of the prims of the groom's file
  const LoadedGroom* origin = nullptr;  // that file, if it is needed for values and prims
  bool observesLast = false;            // RunEvents::observe needs the last frame only
  int checkpointFrames = 0;             // frames between checkpoints; 0: none, or the interval of the run
                                        // that is resumed
  Leftovers leftovers = Leftovers::refuse;
  std::vector<RunFact> facts{};   // which a run that resumes must share (run_facts.h)
  std::filesystem::path trace{};  // file of the times of each dispatch on one device (trace_file.h); empty:
                                  // none. Not with measuresContacts, whose frames are steps
  bool measuresContacts = false;  // in every step and frame, whether contacts are on or off; costs CPU time
  bool measuresResidual = false;  // of the velocity solve, if the integrator has one and kernels measure it
  RunWords words{};
};

/// The options that a scene file contains; all others have their defaults.
RunOptions runOptionsOf(const SceneFile& scene);

/// Takes values and prims from the groom's file, which must outlive the run. Fails where changes of prims are
/// asked for and the groom has none.
Status chooseOrigin(const LoadedGroom& groom, RunOptions& options);
/// Whether the output needs more of the groom's file than its strands.
bool needsOrigin(const SceneOutput& output);

/// Replaces the scene's choice of files by these names: hair.usda and the like (hair.rgc with full
/// precision), last.obj, sheet.png. Errors: another name.
Status chooseFiles(const std::vector<std::string>& names, SceneOutput& output);

/// The names of the animations that the run writes in its folder.
std::vector<std::string> animationsOf(const RunOptions& options);
/// The files that the finished run leaves.
std::vector<std::filesystem::path> outputsOf(const RunOptions& options);

/// Whether the velocity solve's residual is asked for and can be measured.
bool measuresResidual(const LoadedScene& scene, const RunOptions& options);
/// The input from which the run's hair is made. Refers to scene and frames.
SceneHairInput hairInputOf(const LoadedScene& scene, const SceneFrames& frames, const RunOptions& options);

}  // namespace ringlet
