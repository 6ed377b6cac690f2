// StageTimes: how long the parts of a frame take: of the last ones, smoothed, and of all, as means.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/solver/diagnostics.h"
#include "view/live_hair.h"

namespace ringlet::view {

class StageTimes {
 public:
  using Times = std::vector<std::pair<std::string, double>>;  // [ms a frame], in the order of a frame

  void begin() { frame_.clear(); }
  /// What comes twice in a frame counts together.
  void add(const std::string& stage, double milliseconds) { of(frame_, stage) += milliseconds; }
  /// What the solver took since the last frame.
  void addSolver(const std::vector<LiveHair>& hairs) {
    solved_.resize(hairs.size(), 0);
    for (std::size_t k = 0; k < hairs.size(); ++k) {
      double total = 0;
      for (const auto& [stage, milliseconds] : Diagnostics(hairs[k].simulation()).stageMilliseconds())
        total += milliseconds;
      add("solve", total < solved_[k] ? total : total - solved_[k]);  // less: the hair is another
      solved_[k] = total;
    }
  }
  void end(bool counts) {
    for (const auto& [stage, milliseconds] : frame_) {
      double& smooth = of(smoothed_, stage);
      smooth += (smooth > 0 ? 0.1 : 1) * (milliseconds - smooth);
      if (counts) of(sums_, stage) += milliseconds;
    }
    if (counts) ++count_;
  }

  const Times& smoothed() const { return smoothed_; }
  Times means() const {
    Times means = sums_;
    for (auto& [stage, milliseconds] : means)
      milliseconds /= static_cast<double>(std::max<std::size_t>(count_, 1));
    return means;
  }

 private:
  static double& of(Times& times, const std::string& stage) {
    const auto found = std::ranges::find(times, stage, &std::pair<std::string, double>::first);
    return found != times.end() ? found->second : times.emplace_back(stage, 0).second;
  }

  Times frame_, smoothed_, sums_;
  std::vector<double> solved_;  // of each hair, in all
  std::size_t count_ = 0;
};

}  // namespace ringlet::view
