// Implements solver/plan/submission_pace.h.
#include "ringlet/solver/plan/submission_pace.h"

#include <algorithm>
#include <cmath>

#include "ringlet/gpu/command_list.h"

namespace ringlet {
namespace {

// Limit of a dispatch while no time is known: short even on a slow device with costly settings.
constexpr std::uint64_t kFirstParticleSteps = 1 << 17;
// Changes of work below this share of a submission do not matter.
constexpr double kNegligibleShare = 1.0 / 64;

}  // namespace

std::uint64_t SubmissionPace::mostParticleSteps() const {
  if (target_ == 0) return std::numeric_limits<std::uint64_t>::max();
  if (std::isinf(strandRate_)) return kFirstParticleSteps;
  const double most = target_ / std::max(strandRate_, 1e-15);
  return most < 1e18 ? std::max<std::uint64_t>(1, static_cast<std::uint64_t>(most))
                     : 1'000'000'000'000'000'000;
}

bool SubmissionPace::cutsBefore(double seconds) {
  if (target_ == 0) return false;
  const bool isTooLong = openSeconds_ > 0 && openSeconds_ + seconds > target_;
  openSeconds_ = isTooLong ? seconds : openSeconds_ + seconds;
  return isTooLong;
}

double SubmissionPace::secondsOf(const std::string& stage) const {
  const auto found = stageSeconds_.find(stage);
  return found == stageSeconds_.end() ? std::numeric_limits<double>::infinity() : found->second;
}

void SubmissionPace::beginStage(gpu::CommandList& list, const std::string& name) {
  if (cutsBefore(secondsOf(name))) list.cut();
  list.beginStage(name);
}

bool SubmissionPace::learn(std::span<const std::pair<std::string, double>> stageMilliseconds,
                           double particleSteps) {
  if (target_ == 0) return false;
  double strandSeconds = 0;
  std::map<std::string, double> longest;
  for (const auto& [stage, milliseconds] : stageMilliseconds) {
    if (stage == kStrandStage) {
      strandSeconds += milliseconds * 1e-3;
    } else {
      longest[stage] = std::max(longest[stage], milliseconds * 1e-3);
    }
  }
  const auto isTwice = [&](double now, double planned) {
    return now > 2 * std::max(planned, kNegligibleShare * target_);
  };
  bool isSlower = std::isinf(strandRate_) || isTwice(strandSeconds, strandRate_ * particleSteps);
  for (const auto& [stage, seconds] : longest)
    isSlower = isSlower || !stageSeconds_.contains(stage) || isTwice(seconds, secondsOf(stage));
  if (!isSlower) return false;
  strandRate_ = strandSeconds / particleSteps;
  for (const auto& [stage, seconds] : longest) stageSeconds_[stage] = seconds;
  return true;
}

}  // namespace ringlet
