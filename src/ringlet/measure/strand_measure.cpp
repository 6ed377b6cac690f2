// Implements measure/strand_measure.h.
//
//        p_i
//       /          z_i = p_i - c_i in the measuring frame, a complex number: |z| is the radius,
//      /           arg z turns by one turn of the curl; summed from particle to particle it is the winding
//  ---c_i---c_i+1---> core
#include "ringlet/measure/strand_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Edges shorter than this share of the mean edge are left out, since their stretch is rounding: files hold
// edges of 6e-6 beside 4e-2.
constexpr double kShortestEdgeShare = 1e-3;

// Closer to the core than this share of the mean radius, the direction from the core is noise, as in a
// straight part of a curl.
constexpr double kSmallestOffsetShare = 0.05;

// A part of a strand is curled if its winding over one window, ideally a whole turn, is at least this.
constexpr double kCurledTurns = 0.5;

// A strand with less total winding than this has no handedness [turns].
constexpr double kLeastWinding = 0.25;

// A core shorter than this share of the strand is a point (a flat ring), to which no length can be compared.
constexpr double kShortestCoreShare = 1e-6;

double polylineLength(std::span<const Vec3d> points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += length(points[i] - points[i - 1]);
  return sum;
}

Status checkFinite(std::span<const Vec3d> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{fmt::format("particle {} is at ({}, {}, {}); only finite positions can be measured", i,
                               p.x, p.y, p.z)};
    }
  }
  return {};
}

int signOf(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

}  // namespace

double unwrapDegrees(double angle, double before) { return angle + 360 * std::round((before - angle) / 360); }

Result<StrandRuler> StrandRuler::make(std::span<const Vec3d> rest) {
  if (rest.size() < 2) {
    return Error{fmt::format("it has {} particle{}; a strand needs 2 to be measured", rest.size(),
                             rest.size() == 1 ? "" : "s")};
  }
  if (Status finite = checkFinite(rest); !finite) return finite.error();

  StrandRuler ruler;
  ruler.points_.assign(rest.begin(), rest.end());
  ruler.at_ = ringlet::arcPositions(rest);
  ruler.restLength_ = polylineLength(rest);
  const double arcLength = ruler.at_.back();
  if (!(arcLength > 0) || !std::isfinite(arcLength) || !std::isfinite(ruler.restLength_)) {
    return Error{fmt::format("its particles have no finite length between them ({} m)", ruler.restLength_)};
  }
  ruler.shape_ = measureCurl(rest);
  ruler.window_ = coreWindow(ruler.shape_, arcLength);
  ruler.shortestEdge_ = kShortestEdgeShare * ruler.restLength_ / static_cast<double>(rest.size() - 1);
  ruler.restChord_ = length(rest.back() - rest.front());
  ruler.weights_.resize(rest.size());
  for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
    const double half = (ruler.at_[i + 1] - ruler.at_[i]) / 2;
    ruler.weights_[i] += half;
    ruler.weights_[i + 1] += half;
  }

  // The rest curl about its core.
  const std::vector<Vec3d> core = smoothCore(rest, ruler.at_, ruler.window_);
  ruler.rootFrame_ = rootFrameOf(core);
  ruler.restCoreLength_ = polylineLength(core);
  ruler.restOffsets_ = ruler.offsetsFrom(core, rest, {});
  ruler.smallestOffset_ = kSmallestOffsetShare * ruler.meanRadius(ruler.restOffsets_);

  // The direction of winding of each part.
  const std::vector<double> winding = ruler.windingOf(ruler.restOffsets_);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    ruler.restWindow_.push_back(ruler.windingOverATurn(winding, ruler.at_[i]));
    if (i == 0) continue;
    const double middle = (ruler.at_[i - 1] + ruler.at_[i]) / 2;
    ruler.edgeHand_.push_back(signOf(ruler.windingOverATurn(winding, middle)));
  }
  ruler.rest_ = ruler.measureFinite(rest, {0, 1, 0}, {}, ruler.restOffsets_, ruler.restCoreLength_);
  return ruler;
}

Result<StrandMeasure> StrandRuler::measure(std::span<const Vec3d> points, Vec3d up,
                                           Quatd headRotation) const {
  RINGLET_ASSERT(points.size() == points_.size(), "as many particles as at rest");
  if (Status finite = checkFinite(points); !finite) return finite.error();
  const std::vector<Vec3d> core = smoothCore(points, at_, window_);
  return measureFinite(points, up, headRotation, offsetsFrom(core, points, headRotation),
                       polylineLength(core));
}

StrandMeasure StrandRuler::measureFinite(std::span<const Vec3d> points, Vec3d up, Quatd headRotation,
                                         const Offsets& offsets, double coreLength) const {
  StrandMeasure measured;

  // The tip relative to the root.
  const Vec3d tip = points.back() - points.front();
  const Vec3d restTip = rotate(headRotation, points_.back() - points_.front());
  measured.droop = dot(restTip - tip, up);
  measured.relativeDroop = measured.droop / arcLength();

  // Lengths.
  measured.chord = length(tip);
  if (restChord_ > kShortestCoreShare * arcLength()) measured.chordElongation = measured.chord / restChord_;
  measured.coreLength = coreLength;
  if (restCoreLength_ > kShortestCoreShare * arcLength())
    measured.coreElongation = coreLength / restCoreLength_;
  measured.arcDrift = polylineLength(points) / restLength_ - 1;
  double stretch = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double restEdge = length(points_[i] - points_[i - 1]);
    if (restEdge > shortestEdge_) stretch = std::max(stretch, length(points[i] - points[i - 1]) / restEdge);
  }
  measured.maxEdgeStretch = stretch;

  // The curl.
  measured.meanRadius = meanRadius(offsets);
  if (shape_.turns == 0) return measured;
  const std::vector<double> winding = windingOf(offsets);
  for (std::size_t i = 1; i < winding.size(); ++i)
    measured.turns += edgeHand_[i - 1] * (winding[i] - winding[i - 1]);
  measured.winding = winding.back();
  if (std::abs(measured.winding) >= kLeastWinding) measured.handedness = signOf(measured.winding);

  // Handedness, turn by turn.
  double curled = 0, kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(restWindow_[i]) < kCurledTurns) continue;
    curled += weights_[i];
    if (windingOverATurn(winding, at_[i]) * restWindow_[i] > 0) kept += weights_[i];
  }
  if (curled > 0) measured.handednessKept = kept / curled;

  // The last turn compared with rest. A constant error of the core adds e conj(z), which cancels over a turn.
  std::complex<double> turn = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (at_[i] > arcLength() - window_) turn += weights_[i] * offsets[i] * std::conj(restOffsets_[i]);
  }
  measured.tipRotation = std::arg(turn) * 360 / kTurn;
  return measured;
}

StrandRuler::Offsets StrandRuler::offsetsFrom(std::span<const Vec3d> core, std::span<const Vec3d> points,
                                              Quatd headRotation) const {
  const std::vector<MeasuringFrame> frames = framesAlong(core, rotated(rootFrame_, headRotation));
  Offsets offsets;
  offsets.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d offset = points[i] - core[i];
    offsets.emplace_back(dot(offset, frames[i].normal), dot(offset, frames[i].binormal));
  }
  return offsets;
}

// Turns about the core from the root to each particle. A particle on the core adds nothing.
std::vector<double> StrandRuler::windingOf(const Offsets& offsets) const {
  std::vector<double> winding;
  winding.reserve(offsets.size());
  std::complex<double> before = 0;
  double sum = 0;
  for (const std::complex<double>& offset : offsets) {
    if (std::abs(offset) > smallestOffset_) {
      if (before != 0.0) sum += std::arg(offset * std::conj(before)) / kTurn;
      before = offset;
    }
    winding.push_back(sum);
  }
  return winding;
}

// Turns within the window around s; at the ends the window is shifted, not cut.
double StrandRuler::windingOverATurn(std::span<const double> winding, double s) const {
  auto at = [&](double where) {
    const auto above = std::upper_bound(at_.begin() + 1, at_.end() - 1, where);
    const auto i = static_cast<std::size_t>(above - at_.begin());
    const double span = at_[i] - at_[i - 1];
    const double share = span > 0 ? std::clamp((where - at_[i - 1]) / span, 0.0, 1.0) : 0;
    return winding[i - 1] + (winding[i] - winding[i - 1]) * share;
  };
  const double from = std::clamp(s - window_ / 2, 0.0, std::max(0.0, arcLength() - window_));
  return at(from + window_) - at(from);
}

double StrandRuler::meanRadius(const Offsets& offsets) const {
  double sum = 0;
  for (std::size_t i = 0; i < offsets.size(); ++i) sum += weights_[i] * std::abs(offsets[i]);
  return sum / arcLength();
}

}  // namespace ringlet
