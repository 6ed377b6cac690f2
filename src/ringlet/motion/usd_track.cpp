// Implements motion/usd_track.h.
#include "ringlet/motion/usd_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ringlet {

Result<UsdTrack> UsdTrack::of(const UsdPrims& prims, const UsdProperty& property, const UsdTrackForm& form) {
  const UsdAttribute& attribute = *property.attribute;
  const auto wrong = [&](const std::string& sentence) { return prims.wrong(property.prim, sentence); };
  if (!attribute.drivenBy.empty())
    return wrong(fmt::format("{} is given by {}, which is not followed", attribute.name, attribute.drivenBy));
  const auto rate = prims.timeCodesPerSecond();
  if (!rate) return rate.error();
  UsdTrack track;
  track.width_ = form.elementCount * form.width;
  const auto add = [&](double time, const UsdValue& value, const std::string& when) -> Status {
    const std::vector<double>& numbers = value.numbers;
    if (numbers.size() != track.width_ || (value.width != form.width && !numbers.empty()))
      return wrong(fmt::format("found {} {}{}; expected {}, {}", numbers.size() / value.width, attribute.name,
                               when, form.elementCount, form.reason));
    if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }))
      return wrong(fmt::format("found a number in {}{} that is not finite", attribute.name, when));
    const double seconds = time / *rate;
    if (!std::isfinite(seconds) || (!track.seconds_.empty() && !(seconds > track.seconds_.back())))
      return wrong(fmt::format("found samples of {}{} that do not rise in time", attribute.name, when));
    track.seconds_.push_back(seconds);
    track.numbers_.insert(track.numbers_.end(), numbers.begin(), numbers.end());
    return {};
  };
  Status added;
  if (attribute.samples.empty()) added = add(0, attribute.value, "");
  for (std::size_t k = 0; k < attribute.samples.size() && added; ++k) {
    const UsdSample& sample = attribute.samples[k];
    added = add(sample.time, sample.value, fmt::format(" at time {}", sample.time));
  }
  if (!added) return added.error();
  return track;
}

UsdTrack::Place UsdTrack::at(double seconds) const {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(seconds_, seconds) - seconds_.begin());
  const std::size_t k = next == 0 ? 0 : next - 1;
  const double* before = numbers_.data() + k * width_;
  if (next == 0 || next == seconds_.size()) return {before, before, 0};
  return {before, before + width_, (seconds - seconds_[k]) / (seconds_[next] - seconds_[k])};
}

}  // namespace ringlet
