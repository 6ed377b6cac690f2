// Implements bench/hand_vectorised.h.
#include "bench/hand_vectorised.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/operation_count.h"
#include "layout/strands.h"

namespace ringlet::bench {
namespace {

constexpr float kAnyLength = 1e20f;  // of an edge beyond the tip [m]

layout::vec4 packed(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
layout::vec3 packed3(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
layout::vec4 packed(Quatd q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

Status checkScope(const RestState& rest, const Settings& settings) {
  if (settings.integrator != Integrator::jacobi || settings.contacts.on || settings.air.on)
    return Error{"the hand-vectorised loop knows the integrator jacobi alone, without contacts and air"};
  if (!rest.rigid.empty()) return Error{"the hand-vectorised loop carries no strands rigidly"};
  const auto bendVaries = [&](const layout::StrandRest& strand) {
    const auto edges = std::span(rest.particles).subspan(strand.firstParticle, strand.particleCount - 1);
    return std::ranges::any_of(edges, [](const layout::ParticleRest& p) { return p.bendFactor != 1; });
  };
  if (std::ranges::any_of(rest.strands, bendVaries))
    return Error{"the hand-vectorised loop knows no bending that varies along a strand"};
  return {};
}

SweepRun runOf(const RestState& rest, const Material& material, const Settings& settings) {
  SweepRun run;
  run.gravity = packed(settings.gravity);
  run.gravity.w = static_cast<float>(settings.stepSeconds());
  run.maxStretch = static_cast<float>(settings.maxStretch);
  run.coreRelaxedShare = static_cast<float>(material.coreRelaxedShare);
  run.coreElongationLow = static_cast<float>(material.coreElongationLow);
  run.coreElongationHigh = static_cast<float>(material.coreElongationHigh);
  run.rootCount = static_cast<std::uint32_t>(settings.rootCount);
  run.oneSmoothing =
      std::ranges::all_of(rest.strands, [](const layout::StrandRest& s) { return s.bendBeta == s.coreBeta; });
  return run;
}

void fillLane(StrandsRest& to, std::size_t lane, const layout::StrandRest& strand, float T) {
  const auto set = [lane](Eight& eight, float value) { eight.lane[lane] = value; };
  const auto set3 = [&](Eight(&to3)[3], const auto& v) {
    set(to3[0], v.x);
    set(to3[1], v.y);
    set(to3[2], v.z);
  };
  // Backward Euler damps by T k of itself (equations/implicit_edge.glsl).
  const float bendDamping =
      std::max(strand.bendDamping - T * strand.bendStiffness, 0.5f * strand.bendDamping);
  set(to.bendBeta, strand.bendBeta);
  set(to.coreBeta, strand.coreBeta);
  set(to.stretchStiffness, strand.stretchStiffness);
  set(to.bendStiffness, strand.bendStiffness);
  set(to.coreStiffness, strand.coreStiffness);
  set(to.coreDamping, strand.coreDamping);
  set(to.across, T * (bendDamping + T * strand.bendStiffness));
  set(to.along, std::max(0.0f, T * (strand.stretchDamping + T * strand.stretchStiffness - bendDamping)));
  set(to.perCoreLength, 1 / strand.restCoreLength);
  set3(to.firstEdge, strand.firstEdge);
  for (std::size_t k = 0; k < layout::kMaxRootCount; ++k) set3(to.pins[k], strand.roots[k].pin);
}

void fillLane(EdgeRest& to, std::size_t lane, const layout::ParticleRest& rest, bool isEdge,
              float maxStretch) {
  to.target[0].lane[lane] = rest.target.x;
  to.target[1].lane[lane] = rest.target.y;
  to.target[2].lane[lane] = rest.target.z;
  to.restLength.lane[lane] = rest.stretchRestLength;
  to.longest.lane[lane] = isEdge ? maxStretch * rest.edgeLength : kAnyLength;
  to.coreLength.lane[lane] = rest.coreEdgeLength;
  to.scale.lane[lane] = isEdge ? 1 / rest.edgeLength : 0;
  to.mass.lane[lane] = rest.mass;
}

}  // namespace

void HandVectorised::addBlock(std::uint32_t firstStrand, const Settings& settings) {
  const auto last = static_cast<std::uint32_t>(rest_.strands.size() - 1);
  Block block;
  auto strands = std::make_unique<StrandsRest>();
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const layout::StrandRest& strand = rest_.strands[std::min(firstStrand + lane, last)];
    block.firstParticle[lane] = strand.firstParticle;
    block.particleCount[lane] = strand.particleCount;
    block.longest = std::max(block.longest, strand.particleCount);
    fillLane(*strands, lane, strand, static_cast<float>(settings.stepSeconds()));
  }
  std::vector<EdgeRest> edges(block.longest);
  for (std::uint32_t i = 0; i < block.longest; ++i) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t count = block.particleCount[lane];
      layout::ParticleRest rest = rest_.particles[block.firstParticle[lane] + std::min(i, count - 1)];
      if (i >= count) rest.mass = 1;
      fillLane(edges[i], lane, rest, i + 1 < count, run_.maxStretch);
    }
  }
  edges_.push_back(std::move(edges));
  strands_.push_back(std::move(strands));
  block.edges = edges_.back().data();
  block.strands = strands_.back().get();
  blocks_.push_back(block);
}

Result<HandVectorised> HandVectorised::create(const Groom& groom, const Material& material,
                                              const Settings& settings, unsigned threads) {
  if (!canSweep()) return Error{"the hand-vectorised loop needs a CPU with AVX2 and FMA"};
  auto rest = buildRestState(groom, material, settings);
  if (!rest) return rest.error();
  if (Status status = checkScope(*rest, settings); !status) return status.error();

  HandVectorised hand;
  hand.stepSeconds_ = settings.stepSeconds();
  hand.run_ = runOf(*rest, material, settings);
  hand.rest_ = std::move(*rest);
  for (std::uint32_t s = 0; s < hand.rest_.strands.size(); s += kLanes) hand.addBlock(s, settings);
  for (const Vec3f& p : hand.rest_.points) hand.positions_.push_back({p.x, p.y, p.z, 0});
  hand.velocities_.resize(hand.positions_.size());
  hand.team_ = std::make_unique<ThreadTeam>(std::max(1u, threads));
  hand.work_.resize(hand.team_->size());
  hand.stretches_.resize(hand.team_->size(), 0.0f);
  hand.given_ = std::make_unique<std::atomic<std::size_t>>(0);
  for (auto& work : hand.work_) work.resize(hand.rest_.strands.back().particleCount);
  return hand;
}

std::vector<layout::StepPose> HandVectorised::advance(std::span<const HeadPose> poses) {
  const auto turn = [&] { return now_.rotation * oneStepEarlier_.rotation.conjugate(); };
  std::vector<layout::StepPose> device{{packed(now_.rotation), packed(turn()), {}, 0}};
  for (const HeadPose& next : poses) {
    const Vec3d travelBefore = now_.position - oneStepEarlier_.position;
    oneStepEarlier_ = now_;
    now_ = next;
    const Vec3d change = (now_.position - oneStepEarlier_.position - travelBefore) / stepSeconds_;
    device.push_back({packed(now_.rotation), packed(turn()), packed3(change), 0});
  }
  return device;
}

void HandVectorised::beginFrame(std::span<const layout::StepPose> poses) {
  run_.poses = poses.data();
  run_.steps = static_cast<std::uint32_t>(poses.size() - 1);
  run_.positions = positions_.data();
  run_.velocities = velocities_.data();
  *given_ = 0;
}

// Blocks are given out one by one; the longest first, so that none is left for the end.
void HandVectorised::sweepBlocks(unsigned thread) {
  for (std::size_t k = (*given_)++; k < blocks_.size(); k = (*given_)++) {
    const float stretch = runBlock(run_, blocks_[blocks_.size() - 1 - k], work_[thread].data());
    stretches_[thread] = std::max(stretches_[thread], stretch);
  }
}

void HandVectorised::stepFrame(std::span<const HeadPose> poses) {
  const auto device = advance(poses);
  beginFrame(device);
  team_->run([this](unsigned thread) { sweepBlocks(thread); });
}

void HandVectorised::stepFrameAlone(std::span<const HeadPose> poses) {
  const auto device = advance(poses);
  beginFrame(device);
  sweepBlocks(0);
}

std::uint64_t HandVectorised::operations(std::uint32_t steps) const {
  const layout::StepPose still{{0, 0, 0, 1}, {0, 0, 0, 1}, {}, 0};
  const std::vector<layout::StepPose> poses(steps + 1, still);
  SweepRun run = run_;
  run.poses = poses.data();
  run.steps = steps;
  std::map<std::uint32_t, std::uint64_t> ofStrand;  // by particles
  std::uint64_t sum = 0;
  for (std::size_t s = 0; s < rest_.strands.size(); ++s) {
    Block block = blocks_[s / kLanes];
    block.longest = rest_.strands[s].particleCount;
    const auto [known, isNew] = ofStrand.try_emplace(block.longest, 0);
    if (isNew) known->second = countOperations(run, block);
    sum += known->second;
  }
  return sum;
}

std::uint64_t HandVectorised::bytesMoved() const {
  return rest_.points.size() * (4 * sizeof(layout::vec4) + sizeof(layout::ParticleRest)) +
         rest_.strands.size() * sizeof(layout::StrandRest);
}

std::vector<Vec3f> HandVectorised::positions() const {
  std::vector<Vec3f> result(positions_.size());
  for (std::size_t s = 0; s < rest_.strands.size(); ++s) {
    const layout::StrandRest& strand = rest_.strands[s];
    for (std::uint32_t i = 0; i < strand.particleCount; ++i) {
      const layout::vec4& p = positions_[strand.firstParticle + i];
      result[rest_.firstInGroom[s] + i] = {p.x, p.y, p.z};
    }
  }
  return result;
}

}  // namespace ringlet::bench
