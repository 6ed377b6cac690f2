// One conversion: some frames of an animation into a file, or files, of another format.
#pragma once

#include <filesystem>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/pictures/full_hair.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {

enum class ConvertTo { animation, frame, frameSequence, sheet };

struct ConvertPlan {
  ConvertTo to = ConvertTo::animation;  // of the format that the output's name says
  std::filesystem::path output;
  int firstFrame = 1, lastFrame = 1;  // of the animation
  CachePrecision precision = CachePrecision::float32;
  UsdExtras usd{};
  FullHair* hair = nullptr;            // that follows the animation, and is written in its place
  const LoadedScene* scene = nullptr;  // whose bodies that hair stays out of
  CutList cuts{};                      // of what is written, in the animation's frames
  bool showProgress = true;
};

struct ConvertOutcome {
  std::vector<std::filesystem::path> outputs;  // of a sequence the first and the last
  int fileCount = 0;
  double errorBound = 0;        // the farthest a point may be from what was simulated [m]
  std::uint64_t byteCount = 0;  // of all files
};

/// Whether a frame can be a file of that ending: .obj or .ply.
bool isFrameFile(const std::filesystem::path& path);

/// The name of a frame's file in a sequence: name.0001.ply for name.ply; in a folder hair.0001.obj.
std::filesystem::path framePath(const std::filesystem::path& output, int frame);

/// Frames are read, written and forgotten one by one. Fails with one sentence; what was written so far is
/// kept.
Result<ConvertOutcome> convert(AnimationReader& source, const ConvertPlan& plan);

}  // namespace ringlet::program
