// One conversion: some frames of an animation into a file, or files, of another format.
#pragma once

#include <filesystem>
#include <vector>

#include "program/animation_source.h"
#include "ringlet/base/result.h"

namespace ringlet::program {

enum class ConvertTo { animation, obj, objSequence, sheet };

struct ConvertPlan {
  ConvertTo to = ConvertTo::animation;  // of the format that the output's name says
  std::filesystem::path output;
  int firstFrame = 1, lastFrame = 1;  // of the animation
  CachePrecision precision = CachePrecision::float32;
  bool showProgress = true;
};

struct ConvertOutcome {
  std::vector<std::filesystem::path> outputs;  // of a sequence the first and the last
  int fileCount = 0;
  double errorBound = 0;        // the farthest a point may be from what was simulated [m]
  std::uint64_t byteCount = 0;  // of all files
};

/// The name of a frame's file in a sequence: name.0001.obj for name.obj; in a folder hair.0001.obj.
std::filesystem::path framePath(const std::filesystem::path& output, int frame);

/// Frames are read, written and forgotten one by one. Fails with one sentence; what was written so far is
/// kept.
Result<ConvertOutcome> convert(AnimationSource& source, const ConvertPlan& plan);

}  // namespace ringlet::program
