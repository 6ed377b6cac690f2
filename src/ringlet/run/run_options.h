// RunOptions: what a run of a scene writes, what it keeps to go on from, and what it measures.
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
#include "ringlet/run/scene_hair.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// What becomes of what a run finds in its folder. The last goes on with a run that has a checkpoint and
/// begins anew where there is none.
enum class Leftovers { refuse, overwrite, resume, resumeOrOverwrite };

/// How the user says what errors advise.
struct RunWords {
  std::string overwrite = "Leftovers::overwrite", resume = "Leftovers::resume", elsewhere = "another folder",
              who = "a host of ringlet";
};

struct RunOptions {
  std::filesystem::path folder{};                // for the results; empty: nothing is written
  std::vector<std::string> animations{".usda"};  // endings of what is written as hair.*, but for the cache
  bool writesLast = true, writesSheet = true;    // last.obj, sheet.png
  std::optional<CachePrecision> cache{};         // of hair.rgc; none: it is not written
  UpAxis up = UpAxis::y;
  double width = 0.0005;              // diameter of strands in what is written [m]
  std::optional<double> tipWidth{};   // at the tip, in USD files [m]
  std::vector<std::string> values{};  // that these have besides, as SceneOutput says them
  int hairs = 0;                      // above 0: animations have so many, which follow the strands
  HairLook look{};                    // of these
  FollowMoverMaker mover{};  // what moves them, such as followOn(device); needed where there are hairs
  UsdHead usdHead = UsdHead::baked;     // and where these have the head's motion
  int clipFrames = 0;                   // above 0: hair.usda has value clips of so many frames
  bool usesGroomPrims = false;          // hair.usdc has changes of the prims of the groom's file
  const LoadedGroom* origin = nullptr;  // that file, where it is looked at for these
  bool observesLast = false;            // RunEvents::observe needs the last frame only
  int checkpointFrames = 0;             // from one to the next; 0: none, or as many as the run had
  Leftovers leftovers = Leftovers::refuse;
  std::vector<RunFact> facts{};   // what a run that goes on must have been a run of (run_facts.h)
  std::filesystem::path trace{};  // of when each dispatch ran on one device (trace_file.h); empty: none. Not
                                  // with measuresContacts, whose frames are steps
  bool measuresContacts = false;  // every step and frame, with contacts on or off; costs CPU time
  bool measuresResidual = false;  // of the velocity solve, where the integrator has one and kernels tell it
  RunWords words{};
};

/// What a scene file says of its run and its files; all else is the default.
RunOptions runOptionsOf(const SceneFile& scene);

/// Takes the groom's file as what values and prims come from; it must live as long as the run. Fails where
/// the groom has no prims and their changes are asked for.
Status chooseOrigin(const LoadedGroom& groom, RunOptions& options);
/// Whether what is written needs more of the groom's file than its strands.
bool needsOrigin(const SceneOutput& output);

/// These files in place of what the scene says, by their names: hair.usda and the like (hair.rgc with every
/// bit), last.obj, sheet.png. Errors: another name.
Status chooseFiles(const std::vector<std::string>& names, SceneOutput& output);

/// The animations such a run writes, by their names in its folder.
std::vector<std::string> animationsOf(const RunOptions& options);
/// What such a run writes, finished.
std::vector<std::filesystem::path> outputsOf(const RunOptions& options);

/// Whether the velocity solve's residual is asked for, and there is one.
bool measuresResidual(const LoadedScene& scene, const RunOptions& options);
/// What the run's hair is made of. Refers to scene and frames.
SceneHairInput hairInputOf(const LoadedScene& scene, const SceneFrames& frames, const RunOptions& options);

}  // namespace ringlet
