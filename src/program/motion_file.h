// A head's motion from a file, as the user names it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/usd_writer.h"
#include "ringlet/scene/motion.h"

namespace ringlet::program {

struct MotionFileChoice {
  std::filesystem::path path;  // .bvh
  std::string joint = "Head";
  std::optional<double> metresPerUnit;  // unset: so that the skeleton is 1.7 m tall
  int skippedFrames = 0;                // at the start: a T-pose
};

/// Whether a word after --motion names a file and no built-in motion.
bool isMotionFile(const std::string& word);

/// The joint's way, upright along `up`. Warnings, of which none is said twice, say what unit was taken, and
/// where the head turns faster than any. Fails with the names of the joints where the joint is not there.
Result<Motion> readMotionFile(const MotionFileChoice& choice, UpAxis up, std::vector<std::string>& warnings);

}  // namespace ringlet::program
