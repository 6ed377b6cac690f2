// Implements motion/usd_clip_schedule.h: the times.
#include "ringlet/motion/usd_clip_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ringlet {
namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kJumpShare = 1e-9;  // of the time: how long before it a jump begins

double justBefore(double stage) { return stage - std::max(std::abs(stage), 1.0) * kJumpShare; }

// Of two times of knots that the clip goes through straight; whole numbers stay whole.
double alongKnots(double from, double to, double at, double otherFrom, double otherTo) {
  return otherFrom + (at - from) * (otherTo - otherFrom) / (to - from);
}

class KeyMaker {
 public:
  KeyMaker(const UsdClipSchedule& schedule, std::size_t range, const std::vector<double>& samples,
           std::size_t most)
      : knots_(schedule.knots),
        samples_(samples),
        begin_(range == 0 ? -kEver : schedule.ranges[range].from),
        end_(range + 1 < schedule.ranges.size() ? schedule.ranges[range + 1].from : kEver),
        most_(most) {}

  bool addKnots() {
    const auto [first, last] = knotsInside();
    for (std::size_t k = first; k < last; ++k) {
      const bool jumps = k + 1 < knots_.size() && knots_[k + 1].stage == knots_[k].stage;
      if (!add({jumps ? justBefore(knots_[k].stage) : knots_[k].stage, knots_[k].clip})) return false;
    }
    return true;
  }

  // Between two knots each sample falls on one time of the stage.
  bool addSamples() {
    if (knots_.empty()) {
      for (auto at = std::ranges::lower_bound(samples_, begin_); at != samples_.end() && *at < end_; ++at)
        if (!add({*at, *at})) return false;
      return true;
    }
    const auto [first, last] = knotsInside();
    for (std::size_t k = first == 0 ? 0 : first - 1; k < last && k + 1 < knots_.size(); ++k)
      if (!addBetween(knots_[k], knots_[k + 1])) return false;
    return true;
  }

  bool add(UsdClipKey key) {
    if (!(key.stage >= begin_ && key.stage < end_)) return true;
    if (keys_.size() == most_) return false;
    keys_.push_back(key);
    return true;
  }

  std::vector<UsdClipKey> taken() {
    std::ranges::stable_sort(keys_, {}, &UsdClipKey::stage);
    keys_.erase(std::unique(keys_.begin(), keys_.end(),
                            [](const UsdClipKey& a, const UsdClipKey& b) { return a.stage == b.stage; }),
                keys_.end());
    return std::move(keys_);
  }

 private:
  // From which on and up to which knots lie in the range; one more at its end, where a jump begins before it.
  std::pair<std::size_t, std::size_t> knotsInside() const {
    const auto first = std::ranges::lower_bound(knots_, begin_, {}, &UsdClipKey::stage);
    const auto last = std::ranges::upper_bound(knots_, end_, {}, &UsdClipKey::stage);
    return {first - knots_.begin(), last - knots_.begin()};
  }

  bool addBetween(const UsdClipKey& a, const UsdClipKey& b) {
    if (a.stage == b.stage || a.clip == b.clip) return true;
    // Only the clip's times that the range sees: of a long segment there may be many more.
    const double from = std::max(a.stage, begin_), to = std::min(b.stage, end_);
    const auto clipAt = [&](double stage) { return alongKnots(a.stage, b.stage, stage, a.clip, b.clip); };
    const auto [low, high] = std::minmax({clipAt(from), clipAt(to)});
    const auto begin = std::ranges::lower_bound(samples_, low),
               end = std::ranges::upper_bound(samples_, high);
    for (auto at = begin; at < end; ++at) {
      const double stage = alongKnots(a.clip, b.clip, *at, a.stage, b.stage);
      if (stage > a.stage && stage < b.stage && !add({stage, *at})) return false;
    }
    return true;
  }

  const std::vector<UsdClipKey>& knots_;
  const std::vector<double>& samples_;
  double begin_, end_;
  std::size_t most_;
  std::vector<UsdClipKey> keys_{};
};

}  // namespace

double UsdClipSchedule::clipTimeAt(double stage) const {
  if (knots.empty()) return stage;
  const auto after = std::ranges::upper_bound(knots, stage, {}, &UsdClipKey::stage);
  if (after == knots.begin()) return knots.front().clip;
  const UsdClipKey& before = *(after - 1);
  if (after == knots.end() || before.stage == stage) return before.clip;
  return alongKnots(before.stage, after->stage, stage, before.clip, after->clip);
}

Result<std::vector<UsdClipKey>> UsdClipSchedule::keysOf(std::size_t range,
                                                        const std::vector<double>& sampleTimes,
                                                        std::size_t most) const {
  KeyMaker maker(*this, range, sampleTimes, most);
  const double from = ranges[range].from;
  if (!maker.add({from, clipTimeAt(from)}) || !maker.addKnots() || !maker.addSamples())
    return Error{fmt::format("clip set '{}': its times come to more than {} samples", name, most)};
  return maker.taken();
}

}  // namespace ringlet
