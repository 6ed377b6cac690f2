// Implements rest/rigid_strands.h.
#include "ringlet/rest/rigid_strands.h"
#include "ringlet/groom/mend_groom.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "layout/strands.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/rest/strand_constants.h"

namespace ringlet {
namespace {

constexpr double kShortShare = 0.1;         // of the median strand's length
constexpr double kStretchTolerance = 1e-3;  // relative to the stretch limit
constexpr double kShapelessRounding = 0.1;  // relative to the mean edge
constexpr double kNotableRounding = 0.01;   // relative to an edge
constexpr std::size_t kStrandsPerTooQuick = 100;
constexpr double kFarMoreSteps = 2;       // relative to the steps of the others
constexpr std::size_t kNamedStrands = 5;  // in a warning

// "strands 3, 17 and 2 more"
std::string named(std::span<const std::uint32_t> strands) {
  std::string text = strands.size() == 1 ? "strand" : "strands";
  const std::size_t count = std::min(strands.size(), kNamedStrands);
  for (std::size_t i = 0; i < count; ++i) {
    const bool isLastOfAll = i > 0 && i + 1 == strands.size();
    text += fmt::format("{}{}", i == 0 ? " " : isLastOfAll ? " and " : ", ", strands[i]);
  }
  if (strands.size() > count) text += fmt::format(" and {} more", strands.size() - count);
  return text;
}

// "3 of 100 strands are"
std::string counted(std::size_t count, std::size_t all) {
  return fmt::format("{} of {} strands {}", count, all, count == 1 ? "is" : "are");
}

// The median of one member over all strands.
template <class Value>
double medianOf(std::span<const StrandSize> sizes, Value value) {
  std::vector<double> values;
  for (const StrandSize& size : sizes) values.push_back(size.*value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

StrandSize sizeOfStrand(std::span<const Vec3f> points) {
  StrandSize size;
  double shortest = points.size() < 2 ? 0 : 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    size.distance = std::max(size.distance, length(static_cast<Vec3d>(points[i])));
    if (i == 0) continue;
    const double edge = length(static_cast<Vec3d>(points[i]) - static_cast<Vec3d>(points[i - 1]));
    size.length += edge;
    shortest = std::min(shortest, edge);
  }
  const double nothing = noEdgeLength(points);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double edge = length(static_cast<Vec3d>(points[i]) - static_cast<Vec3d>(points[i - 1]));
    size.repeatedCount += edge <= nothing ? 1 : 0;
  }
  size.meanEdge = size.length / static_cast<double>(std::max<std::size_t>(2, points.size()) - 1);
  size.shortestEdge = std::max(shortest, kShortestEdge * size.meanEdge);
  return size;
}

double medianLength(std::span<const StrandSize> sizes) { return medianOf(sizes, &StrandSize::length); }

std::vector<std::uint32_t> tooFineStrands(std::span<const StrandSize> sizes, double maxStretch) {
  const double shortLength = kShortShare * medianLength(sizes);
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < sizes.size(); ++s) {
    const StrandSize& size = sizes[s];
    const double rounding = edgeRounding(size.distance);
    const bool passesLimit = rounding > kStretchTolerance * maxStretch * size.shortestEdge;
    const bool isTooFine = (passesLimit && size.length < shortLength) ||
                           rounding > kShapelessRounding * size.meanEdge || size.length <= kLeastStrandLength;
    if (isTooFine) found.push_back(s);
  }
  return found;
}

std::vector<std::uint32_t> tooQuickStrands(std::span<const StrandSize> sizes,
                                           std::span<const double> longestSteps, double stepSeconds) {
  std::vector<double> ordered;
  for (double step : longestSteps)
    if (step > 0) ordered.push_back(step);
  const std::size_t few = ordered.size() / kStrandsPerTooQuick;
  if (few == 0) return {};
  const auto others = ordered.begin() + static_cast<std::ptrdiff_t>(few);  // of the others, the one with the
                                                                           // shortest step
  std::nth_element(ordered.begin(), others, ordered.end());
  const double bound = std::min(*others / kFarMoreSteps, stepSeconds * (1 - 1e-6));
  const double shortLength = kShortShare * medianLength(sizes);
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < sizes.size(); ++s) {
    if (longestSteps[s] > 0 && longestSteps[s] < bound && sizes[s].length < shortLength) found.push_back(s);
  }
  return found;
}

std::vector<std::string> tooFineWarnings(std::span<const StrandSize> sizes,
                                         std::span<const std::uint32_t> tooFine) {
  if (tooFine.empty()) return {};
  const auto share = [&](std::uint32_t s) { return sizes[s].meanEdge / std::max(sizes[s].distance, 1e-300); };
  const std::uint32_t worst =
      *std::ranges::min_element(tooFine, [&](auto a, auto b) { return share(a) < share(b); });
  return {fmt::format(
      "{} carried rigidly by the root, as float32 numbers are too coarse for the edges: {}. Strand {} has "
      "the finest: {:.2g} m on average, at {:.3g} m from the head's origin, where rounding changes an edge "
      "by up to {:.2g} m. Nearer to the head's origin finer strands move",
      counted(tooFine.size(), sizes.size()), named(tooFine), worst, sizes[worst].meanEdge,
      sizes[worst].distance, edgeRounding(sizes[worst].distance))};
}

std::vector<std::string> tooQuickWarnings(std::span<const StrandSize> sizes,
                                          std::span<const std::uint32_t> tooQuick,
                                          std::span<const double> longestSteps, const Settings& settings) {
  if (tooQuick.empty()) return {};
  const std::uint32_t worst =
      *std::ranges::min_element(tooQuick, [&](auto a, auto b) { return longestSteps[a] < longestSteps[b]; });
  const double needed = std::ceil(1 / (settings.framesPerSecond * longestSteps[worst]) - 1e-6);
  const bool mayBeTaken = needed < layout::kMaxStepPoses;
  return {fmt::format(
      "{} carried rigidly by the root, as so short strands need far more than {} steps per frame: {}. Strand "
      "{}, {:.2g} m long, needs the most, {:.0f}{}",
      counted(tooQuick.size(), sizes.size()), settings.stepsPerFrame, named(tooQuick), worst,
      sizes[worst].length, needed, mayBeTaken ? "; with so many all of them move" : "")};
}

std::vector<std::string> repeatWarnings(std::span<const StrandSize> sizes) {
  std::size_t count = 0, first = 0;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    if (count == 0) first = s;
    if (sizes[s].length > 0) count += sizes[s].repeatedCount;
  }
  if (count == 0) return {};
  return {fmt::format(
      "{} repeated particle{}, the first in strand {}: `ringlet info FILE --fix OUT` leaves them out", count,
      count == 1 ? "" : "s", first)};
}

std::vector<std::string> roundingWarnings(std::span<const StrandSize> sizes,
                                          std::span<const std::uint32_t> tooFine) {
  const double away = medianOf(sizes, &StrandSize::distance), edge = medianOf(sizes, &StrandSize::meanEdge);
  if (edgeRounding(away) > kNotableRounding * edge) {
    return {fmt::format(
        "the groom lies {:.3g} m from the head's origin, where float32 numbers are up to {:.2g} m apart, and "
        "its edges are {:.2g} m: move it to the origin, or check its unit",
        away, edgeRounding(away) / 2, edge)};
  }
  std::size_t count = 0;
  std::uint32_t worst = 0;
  double most = kNotableRounding;
  for (std::uint32_t s = 0; s < sizes.size(); ++s) {
    const double share = edgeRounding(sizes[s].distance) / sizes[s].shortestEdge;
    if (!(share > kNotableRounding) || sizes[s].repeatedCount > 0) continue;
    if (std::ranges::binary_search(tooFine, s)) continue;
    ++count;
    if (share > most) most = share, worst = s;
  }
  if (count == 0) return {};
  return {fmt::format(
      "{} so finely cut that rounding to float32 may pass the stretch limit, strand {} by {:.2g} % of an "
      "edge: {:.2g} m at {:.3g} m from the head's origin; cut edges longer, or move the groom to the origin",
      counted(count, sizes.size()), worst, 100 * most, sizes[worst].shortestEdge, sizes[worst].distance)};
}

}  // namespace ringlet
