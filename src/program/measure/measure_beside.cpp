// Implements measure_beside.h.
#include "program/measure/measure_beside.h"

#include <algorithm>
#include <utility>

namespace ringlet::program {

Result<MeasureBeside> MeasureBeside::make(const Groom& rest, AnimationReader against,
                                          std::optional<AnimationReader> without) {
  MeasureBeside beside(rest, std::move(against), std::move(without));
  if (!beside.without_) return beside;
  auto ruler = ContactRuler::make(rest, {}, {});
  if (!ruler) return ruler.error();
  beside.contacts_.emplace(std::move(*ruler));
  return beside;
}

double MeasureBeside::overlapOf(std::span<const Vec3f> points) const {
  std::vector<Vec3f> metres;
  for (const Vec3f& p : points) metres.push_back(Vec3f(Vec3d(p) * rest_->metresPerUnit));
  return contacts_->measure(metres).overlapBeyondRestSum;
}

// In the unit of the groom.
Result<std::vector<Vec3f>> MeasureBeside::pointsOf(AnimationReader& run, int frame) const {
  if (Status read = run.readFrame(frame); !read) return read.error();
  std::vector<Vec3f> points = run.groom().points;
  const double share = run.header().metresPerUnit / rest_->metresPerUnit;
  if (share != 1)
    for (Vec3f& p : points) p = Vec3f(Vec3d(p) * share);
  return points;
}

Status MeasureBeside::addFrame(int frame, const GroomRuler& ruler, std::span<const Vec3f> points) {
  if (frame > against_.frameCount() || (without_ && frame > without_->frameCount())) return {};
  auto against = pointsOf(against_, frame);
  if (!against) return against.error();
  lastAgainst_ = std::move(*against);
  const auto ways = tipWays(ruler, *rest_, points, lastAgainst());
  if (!ways) return ways.error();
  frames_.push_back(*ways);
  lastPoints_.assign(points.begin(), points.end());
  if (!without_) return {};
  const auto without = pointsOf(*without_, frame);
  if (!without) return without.error();
  overlap_ = std::max(overlap_, overlapOf(points));
  overlapAgainst_ = std::max(overlapAgainst_, overlapOf(lastAgainst()));
  overlapWithout_ = std::max(overlapWithout_, overlapOf(*without));
  return {};
}

MotionBeside MeasureBeside::result() const {
  MotionBeside beside{.frames = frames_, .mean = {}};
  const double share = 1 / static_cast<double>(std::max<std::size_t>(frames_.size(), 1));
  for (const TipWays& frame : frames_) {
    beside.mean.way += share * frame.way;
    beside.mean.other += share * frame.other;
    beside.mean.apart += share * frame.apart;
  }
  const double prevented = overlapWithout_ - overlapAgainst_;
  if (prevented > 0) beside.kept = (overlapWithout_ - overlap_) / prevented;
  return beside;
}

}  // namespace ringlet::program
