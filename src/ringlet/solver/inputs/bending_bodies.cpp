// Implements solver/inputs/bending_bodies.h.
#include "ringlet/solver/inputs/bending_bodies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"

namespace ringlet {
namespace {

// Of a carrier, at a share of a frame whose step k it ends at ends[k * stride].
BodyPose poseAt(const BodyPose& start, std::span<const BodyPose> ends, std::size_t stride, std::size_t steps,
                double share) {
  const double at = share * double(steps);
  const auto before = std::min(static_cast<std::size_t>(at), steps - 1);
  const BodyPose& from = before == 0 ? start : ends[(before - 1) * stride];
  return interpolate(from, ends[before * stride], at - double(before));
}

bool isNearGrid(const BendingMesh& mesh, Vec3d p) {
  const Vec3d q = (p - mesh.origin) / mesh.cell;
  const double band = double{layout::kMeshBand};
  const auto isWithin = [&](double value, std::uint32_t cells) {
    return value >= -band && value <= cells + band;
  };
  return isWithin(q.x, mesh.counts[0]) && isWithin(q.y, mesh.counts[1]) && isWithin(q.z, mesh.counts[2]);
}

}  // namespace

BendingBodies::BendingBodies(std::span<const Body> bodies, std::uint32_t copies)
    : all_(bodies.begin(), bodies.end()), copies_(copies) {
  for (std::size_t b = 0; b < all_.size(); ++b) {
    const BendingMesh* shape = all_[b].mesh.get();
    if (all_[b].bends()) bodies_.push_back({b, shape, shape->surface.pointsOf(shape->points)});
  }
}

std::uint64_t BendingBodies::pointBytes() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : bodies_) count += copies_ * mesh.now.size();
  return count * sizeof(layout::vec4);
}
std::uint64_t BendingBodies::pairCount() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : bodies_) count += copies_ * mesh.shape->cornerCount();
  return count;
}

Status BendingBodies::createFields(gpu::Device& device, const gpu::Buffer& points, const gpu::Buffer& pairs,
                                   std::uint32_t firstPair, std::span<layout::BodyRest> rests) {
  std::vector<const BendingMesh*> meshes;
  for (const Mesh& mesh : bodies_) meshes.push_back(mesh.shape);
  auto made = MeshFields::create(device, meshes, copies_, points, pairs, firstPair);
  if (!made) return made.error();
  fields_.emplace(std::move(*made));
  std::uint32_t cloth = 0;
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    const layout::MeshRest& mesh = fields_->rests()[m];
    layout::BodyRest& rest = rests[bodies_[m].body];
    rest.gridOrigin = mesh.gridOrigin;
    rest.cell = mesh.cell;
    std::copy(std::begin(mesh.cells), std::end(mesh.cells), rest.cells);
    rest.firstPair = mesh.firstPair;
    rest.firstKey = mesh.firstKey;
    rest.triangleBits = bodies_[m].shape->isCloth ? mesh.levels : mesh.triangleBits;
    rest.firstWay = mesh.firstWay;
    rest.triangleCount = mesh.triangleCount;
    if (bodies_[m].shape->isCloth) rest.lists[0] = cloth++;
  }
  return {};
}

std::vector<BendingBodies::Surfaces> BendingBodies::samplesOf(const FrameContext& frame,
                                                              std::span<const BodyPose> start) const {
  if (frame.bodyPoints.empty()) return {};
  RINGLET_ASSERT(frame.bodyPoints.size() == bodies_.size(), "every body that bends has points");
  std::vector<BodyPose> carried;  // by the head, where nobody says otherwise
  if (frame.bodyPoses.empty())
    carried = bodyPosesOf(all_, frame.heads.subspan(2), std::vector<double>(frame.steps()));
  const std::span<const BodyPose> ends = frame.bodyPoses.empty() ? carried : frame.bodyPoses;
  const std::size_t count = frame.bodyPoints.front().size() / bodies_.front().shape->points.size();
  std::vector<Surfaces> samples(count);
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    const Mesh& mesh = bodies_[m];
    const std::size_t pointCount = mesh.shape->points.size();
    RINGLET_ASSERT(frame.bodyPoints[m].size() == count * pointCount,
                   "every body that bends has as many samples of all its points");
    for (std::size_t s = 0; s < count; ++s) {
      const BodyPose carrier = poseAt(start[mesh.body], ends.subspan(mesh.body), all_.size(), frame.steps(),
                                      double(s + 1) / double(count));
      std::vector<Vec3d> points;
      for (const Vec3d p : frame.bodyPoints[m].subspan(s * pointCount, pointCount))
        points.push_back(seenFrom(carrier, p));
      samples[s].push_back(mesh.shape->surface.pointsOf(points));
    }
  }
  return samples;
}

// As many as keep the way of each point near a grid within a cell from one to the next; of cloth, which moves
// straight between them, as many as there are samples.
std::uint32_t BendingBodies::buildCount(std::span<const Surfaces> samples, std::size_t steps) const {
  double most = 0;
  for (const Mesh& mesh : bodies_)
    if (mesh.shape->isCloth) most = double(samples.size());
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    const Mesh& mesh = bodies_[m];
    for (std::size_t i = 0; i < mesh.now.size(); ++i) {
      double way = 0;
      bool isNear = false;
      Vec3d before = mesh.now[i];
      for (const auto& sample : samples) {
        isNear = isNear || isNearGrid(*mesh.shape, before) || isNearGrid(*mesh.shape, sample[m][i]);
        way += length(sample[m][i] - before);
        before = sample[m][i];
      }
      if (isNear) most = std::max(most, way / mesh.shape->cell);
    }
  }
  return static_cast<std::uint32_t>(std::clamp(std::ceil(most), 1.0, double(steps)));
}

BendingBodies::Work BendingBodies::writeFrame(const FrameContext& frame, std::span<const BodyPose> start,
                                              std::span<layout::vec4> points, std::span<float> fields) {
  const std::size_t steps = frame.steps();
  auto samples = samplesOf(frame, start);
  bool moves = false;
  for (const auto& sample : samples)
    for (std::size_t m = 0; m < bodies_.size(); ++m) moves = moves || sample[m] != bodies_[m].now;
  if (!moves && !isStale_) {
    std::ranges::fill(fields, static_cast<float>(current_));
    return {};
  }

  const std::uint32_t builds = moves ? buildCount(samples, steps) : 1;
  const auto endOf = [&](std::uint32_t build) { return (build * steps + builds / 2) / builds; };  // in steps
  std::size_t out = 0;
  for (std::size_t m = 0; m < bodies_.size(); ++m) {
    for (std::uint32_t copy = 0; copy < copies_; ++copy) {
      const double at = double(endOf(std::min(copy, builds))) / double(steps) * double(samples.size());
      const auto before = std::min(static_cast<std::size_t>(at), samples.empty() ? 0 : samples.size() - 1);
      for (std::size_t i = 0; i < bodies_[m].now.size(); ++i, ++out) {
        if (copy > builds) continue;
        const Vec3d from = before == 0 ? bodies_[m].now[i] : samples[before - 1][m][i];
        const Vec3d to = samples.empty() ? from : samples[before][m][i];
        points[out] = packed(at == double(before + 1) ? to : from + (to - from) * (at - double(before)));
      }
    }
  }
  for (std::uint32_t build = 0; build < builds; ++build) {
    const std::size_t begin = endOf(build), end = endOf(build + 1);
    for (std::size_t k = begin; k < end; ++k)
      fields[k] = static_cast<float>(build) + static_cast<float>(k - begin) / static_cast<float>(end - begin);
  }
  fields[steps] = static_cast<float>(builds);
  const Work work{.moved = isStale_ ? 0 : current_, .first = isStale_ ? 0u : 1u, .last = builds};
  if (moves)
    for (std::size_t m = 0; m < bodies_.size(); ++m) bodies_[m].now = std::move(samples.back()[m]);
  current_ = builds;
  isStale_ = false;
  return work;
}

BendingBodies::Work BendingBodies::writeMoment(std::span<const std::vector<Vec3d>> points,
                                               std::span<layout::vec4> out) {
  RINGLET_ASSERT(points.empty() || points.size() == bodies_.size(), "every body that bends has points");
  for (std::size_t m = 0; m < points.size(); ++m) {
    Mesh& mesh = bodies_[m];
    RINGLET_ASSERT(points[m].size() == mesh.shape->points.size(), "a place for every point of its mesh");
    std::vector<Vec3d> surface = mesh.shape->surface.pointsOf(points[m]);
    isStale_ = isStale_ || surface != mesh.now;
    mesh.now = std::move(surface);
  }
  if (!isStale_) return {};
  isStale_ = false;
  std::size_t k = 0;
  for (const Mesh& mesh : bodies_)
    for (const Vec3d& p : mesh.now) out[k++] = packed(p);
  return {.moved = 0, .first = 0, .last = 0};
}

void BendingBodies::jump(const FrameContext& frame, std::span<const BodyPose> start) {
  auto samples = samplesOf(frame, start);
  if (samples.empty()) return;
  for (std::size_t m = 0; m < bodies_.size(); ++m) bodies_[m].now = std::move(samples.back()[m]);
  isStale_ = true;
}

bool BendingBodies::isQuiet(const FrameContext& frame) const {
  if (bodies_.empty()) return true;
  return !isStale_ && frame.bodyPoints.empty();
}

void BendingBodies::archive(Archive& archive) {
  for (Mesh& mesh : bodies_) archive.values(std::span(mesh.now));
  if (archive.isReading()) isStale_ = true;
}

void BendingBodies::record(gpu::CommandList& list, const Work& work) const {
  if (work.first > work.last) return;
  if (work.moved > 0) fields_->moveToFirst(list, work.moved);
  fields_->record(list, work.first, work.last);
}

}  // namespace ringlet
