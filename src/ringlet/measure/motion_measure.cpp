// Implements measure/motion_measure.h.
#include "ringlet/measure/motion_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/measure/tip_motion.h"

namespace ringlet {
namespace {

// Smaller motion is rounding of positions stored as floats.
constexpr double kDrivenShare = 1e-5;    // change of the roots' displacement between frames, relative to the
                                         // arc length
constexpr double kDrivenAngle = 1e-4;    // the same for the head's rotation [rad]
constexpr double kSmallestShare = 1e-5;  // excursion of a tip, relative to the arc length

// Mean turns and radius of strands that are curled at rest; straight strands have none.
struct MeanCurl {
  double turns = 0, radius = 0;
};
MeanCurl meanCurlOf(const GroomRuler& ruler, std::span<const StrandMeasure> measures) {
  std::vector<double> turns, radii;
  for (std::size_t s = 0; s < measures.size(); ++s) {
    if (ruler.strand(s).shape().turns == 0) continue;
    turns.push_back(measures[s].turns);
    radii.push_back(measures[s].meanRadius);
  }
  return {spreadOf(turns).mean, spreadOf(radii).mean};
}

double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

// The angle of a rotation [rad].
double angleOf(Quatd q) { return 2 * std::atan2(length(Vec3d{q.x, q.y, q.z}), std::abs(q.w)); }

void keepWorst(WorstMeasure& worst, const StrandMeasure& now, bool isFirst) {
  worst.droop = larger(worst.droop, now.droop);
  worst.coreElongation = isFirst ? now.coreElongation : std::max(worst.coreElongation, now.coreElongation);
  worst.arcDrift = larger(worst.arcDrift, now.arcDrift);
  worst.maxEdgeStretch = std::max(worst.maxEdgeStretch, now.maxEdgeStretch);
  worst.tipRotation = larger(worst.tipRotation, now.tipRotation);
}

struct Energy {
  double peak = 0, ratio = 0;
};

// Whether the path leaves its start by more than `smallest`; if not, its speeds are rounding too.
bool hasMoved(std::span<const Vec3d> path, double smallest) {
  return std::ranges::any_of(path, [&](Vec3d p) { return length(p - path.front()) > smallest; });
}

Energy energyOf(std::span<const double> energies, double framesPerSecond, bool moved) {
  if (energies.empty()) return {};
  const std::size_t closing = closingFrameCount(energies.size(), framesPerSecond);
  double sum = 0;
  for (double energy : energies.last(closing)) sum += energy;
  const double peak = std::ranges::max(energies);
  return {peak, moved && peak > 0 ? sum / static_cast<double>(closing) / peak : 0};
}

}  // namespace

Result<MotionMeasure> MotionMeasure::make(const Groom& rest, const MotionOptions& options) {
  RINGLET_ASSERT(options.framesPerSecond > 0, "frames have a rate");
  auto ruler = GroomRuler::make(rest);
  if (!ruler) return ruler.error();
  return MotionMeasure(std::move(*ruler), options);
}

MotionMeasure::MotionMeasure(GroomRuler ruler, const MotionOptions& options)
    : ruler_(std::move(ruler)), options_(options), strands_(ruler_.strandCount()) {}

Status MotionMeasure::addFrame(std::span<const Vec3f> points, double metresPerUnit,
                               std::optional<Quatd> headRotation, std::span<const Vec3f> velocities) {
  RINGLET_ASSERT(points.size() == ruler_.particleCount(), "one point per particle of the groom");
  RINGLET_ASSERT(velocities.empty() || velocities.size() == points.size(), "one velocity per particle");
  const Quatd head = headRotation.value_or(ruler_.headRotationOf(points, metresPerUnit));
  auto measures = ruler_.measure(points, metresPerUnit, options_.up, head);
  if (!measures) return measures.error();

  const bool isFirst = frameCount_ == 0;
  Vec3d rootSum{};
  double energySum = 0;
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    StrandHistory& history = strands_[s];

    // Shape.
    StrandMeasure& now = (*measures)[s];
    now.tipRotation = unwrapDegrees(now.tipRotation, history.last.tipRotation);
    history.last = now;
    keepWorst(history.worst, now, isFirst);

    // Positions relative to the root, in the head's frame.
    std::vector<Vec3d> particles = ruler_.strandIn(points, metresPerUnit, s);
    const Vec3d root = particles.front();
    rootSum += root;
    for (Vec3d& p : particles) p = rotate(head.conjugate(), p - root);
    history.tips.push_back(particles.back());
    history.coreLengths.push_back(now.coreLength);

    // Kinetic energy: each particle has half the mass of each adjacent edge.
    std::vector<Vec3d> speeds = velocities.empty() ? std::vector<Vec3d>{} : ruler_.strandIn(velocities, 1, s);
    const std::span<const double> at = ruler_.strand(s).arcPositions();
    double energy = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const double arc = (at[std::min(i + 1, at.size() - 1)] - at[i == 0 ? 0 : i - 1]) / 2;
      Vec3d velocity{};
      if (!speeds.empty()) {
        velocity = speeds[i] - speeds.front();
      } else if (!isFirst) {
        velocity = (particles[i] - history.particles[i]) * options_.framesPerSecond;
      }
      energy += 0.5 * options_.lineDensity * arc * dot(velocity, velocity);
    }
    energySum += energy;
    if (!isFirst || !speeds.empty()) history.energies.push_back(energy);
    history.particles = std::move(particles);
  }
  frames_.push_back(summary(*measures, energySum));
  watchHead(rootSum / static_cast<double>(strands_.size()), head);
  ++frameCount_;
  return {};
}

FrameMeasure MotionMeasure::summary(std::span<const StrandMeasure> measures, double energy) const {
  FrameMeasure frame{
      .droop = 0, .coreElongation = 0, .turns = meanCurlOf(ruler_, measures).turns, .energy = energy};
  const double share = 1 / static_cast<double>(measures.size());
  for (const StrandMeasure& strand : measures) {
    frame.droop += share * strand.droop;
    frame.coreElongation += share * strand.coreElongation;
  }
  return frame;
}

// The head drives the hair in a frame if its displacement differs from that of the frame before: that of its
// roots, or its rotation.
void MotionMeasure::watchHead(Vec3d meanRoot, Quatd headRotation) {
  if (frameCount_ >= 2) {
    const Vec3d change = meanRoot - meanRoots_[0] * 2.0 + meanRoots_[1];
    const Quatd turn = headRotation * headRotations_[0].conjugate();
    const Quatd turnBefore = headRotations_[0] * headRotations_[1].conjugate();
    if (length(change) > kDrivenShare * ruler_.meanArcLength() ||
        angleOf(turn * turnBefore.conjugate()) > kDrivenAngle) {
      freeFrame_ = frameCount_;
    }
  }
  meanRoots_[1] = meanRoots_[0];
  meanRoots_[0] = meanRoot;
  headRotations_[1] = headRotations_[0];
  headRotations_[0] = headRotation;
}

MotionReport MotionMeasure::report() const {
  RINGLET_ASSERT(frameCount_ > 0, "a motion has frames");
  const double fps = options_.framesPerSecond;
  MotionReport report;
  report.frameCount = frameCount_;
  report.seconds = static_cast<double>(frameCount_ - 1) / fps;
  report.freeSeconds = static_cast<double>(freeFrame_) / fps;

  std::vector<StrandMeasure> last;
  std::vector<double> total;
  bool anyMoved = false;
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    const StrandHistory& history = strands_[s];
    const double smallest = kSmallestShare * ruler_.strand(s).arcLength();
    const std::span<const Vec3d> tips = history.tips;
    const std::span<const double> coreLengths = history.coreLengths;
    const bool moved = hasMoved(tips, smallest);
    anyMoved = anyMoved || moved;
    const Energy energy = energyOf(history.energies, fps, moved);
    report.strands.push_back({.last = history.last,
                              .worst = history.worst,
                              .bounceHz = bounceFrequency(coreLengths.subspan(freeFrame_), fps, smallest),
                              .swayHz = swayFrequency(tips.subspan(freeFrame_), fps, smallest),
                              .settleSeconds = settleSeconds(tips, fps, freeFrame_, smallest),
                              .peakEnergy = energy.peak,
                              .energyRatio = energy.ratio});
    last.push_back(history.last);
    total.resize(history.energies.size());
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += history.energies[k];
  }
  report.frames = frames_;
  report.last = ruler_.summarize(last);
  const Energy energy = energyOf(total, fps, anyMoved);
  report.peakEnergy = energy.peak;
  report.energyRatio = energy.ratio;
  return report;
}

CurlNumbers curlNumbers(const GroomRuler& ruler, std::span<const StrandMeasure> measures) {
  const GroomMeasure groom = ruler.summarize(measures);
  CurlNumbers numbers;
  numbers.strandCount = groom.strandCount;
  numbers.particleCount = groom.particleCount;
  numbers.droop = groom.droop.mean;
  numbers.coreElongation = groom.coreElongation.mean;
  numbers.handednessKept = groom.handednessKept.min >= kHandKeptShare;
  numbers.arcDrift = worstOf(groom.arcDrift);
  numbers.maxEdgeStretch = groom.maxEdgeStretch.max;
  numbers.tipRotation = worstOf(groom.tipRotation);
  numbers.worstDroop = worstOf(groom.droop);
  numbers.worstCoreElongation = groom.coreElongation.max;
  numbers.worstTipRotation = numbers.tipRotation;
  const MeanCurl curl = meanCurlOf(ruler, measures);
  numbers.turns = curl.turns;
  numbers.meanRadius = curl.radius;
  return numbers;
}

CurlNumbers curlNumbers(const GroomRuler& ruler, const MotionReport& report) {
  std::vector<StrandMeasure> last;
  for (const StrandMotion& strand : report.strands) last.push_back(strand.last);
  CurlNumbers numbers = curlNumbers(ruler, last);
  numbers.frameCount = report.frameCount;
  if (report.frameCount > 1) numbers.energyRatio = report.energyRatio;

  std::vector<double> bounces, sways;
  bool allSettled = true;
  double settled = 0;
  for (const StrandMotion& strand : report.strands) {
    numbers.arcDrift = larger(numbers.arcDrift, strand.worst.arcDrift);
    numbers.maxEdgeStretch = std::max(numbers.maxEdgeStretch, strand.worst.maxEdgeStretch);
    numbers.worstDroop = larger(numbers.worstDroop, strand.worst.droop);
    numbers.worstCoreElongation = std::max(numbers.worstCoreElongation, strand.worst.coreElongation);
    numbers.worstTipRotation = larger(numbers.worstTipRotation, strand.worst.tipRotation);
    if (strand.bounceHz) bounces.push_back(*strand.bounceHz);
    if (strand.swayHz) sways.push_back(*strand.swayHz);
    allSettled = allSettled && strand.settleSeconds.has_value();
    settled = std::max(settled, strand.settleSeconds.value_or(0));
  }
  if (!bounces.empty()) numbers.bounceHz = spreadOf(bounces).mean;
  if (!sways.empty()) numbers.swayHz = spreadOf(sways).mean;
  if (allSettled && report.frameCount > 1) numbers.settleSeconds = settled;
  return numbers;
}

}  // namespace ringlet
