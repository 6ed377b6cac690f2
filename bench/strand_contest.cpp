// Implements bench/strand_contest.h.
#include "bench/strand_contest.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "bench/clocks.h"
#include "bench/curls.h"
#include "bench/peaks.h"

namespace ringlet::bench {
namespace {

constexpr double kAgreement = 1e-5;  // tests/support/tolerances.h, kOneFrame
constexpr std::size_t kVerifiedStrands = 64;
constexpr double kReferenceParticles = 16384;
constexpr double kPeakSeconds = 0.002;

Settings settingsOf(int steps) {
  Settings settings;
  settings.stepsPerFrame = steps;
  return settings;
}

// Of the first particles, of a strand's length.
double distance(const std::vector<Vec3f>& found, const reference::Field<double>& expected) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    largest = std::max(largest, (reference::toEigen<double>(found[i]) - expected[i]).norm());
  return largest / kCurlLength;
}

Status checkDistance(const char* who, double distance) {
  if (distance < kAgreement) return {};
  return Error{fmt::format(
      "{} is {:.1e} of a strand's length from the double reference after a shaken frame, {:.0e} is "
      "allowed; not timed",
      who, distance, kAgreement)};
}

}  // namespace

Result<Contest> Contest::create(const ComputeDevice& device, const std::vector<int>& particleCounts,
                                int steps, Baselines baselines, const KernelChoice& choice) {
  Contest contest;
  contest.settings_ = settingsOf(steps);
  contest.particles_ = std::accumulate(particleCounts.begin(), particleCounts.end(), 0.0);
  contest.team_ = std::make_unique<ThreadTeam>(coreCount());
  const Groom groom = curls(particleCounts);
  auto simulation = Simulation::create(device, groom, {}, contest.settings_, {}, choice);
  if (!simulation) return simulation.error();
  contest.simulation_ = std::move(*simulation);
  if (baselines == Baselines::all) {
    if (Status status = contest.addHand(groom); !status) return status.error();
    contest.addReferences(particleCounts);
  }

  // In motion, and held against the reference; then the head stands, and all see the same poses.
  contest.poses_ = shaken(contest.settings_);
  if (Status status = contest.verifyFrame(particleCounts); !status) return status.error();
  contest.poses_.assign(static_cast<std::size_t>(steps), contest.poses_.back());
  if (Status status = contest.round(); !status) return status.error();
  contest.samples_ = {};
  return contest;
}

// Strands do not feel each other, so that the first say what all do.
Status Contest::verifyFrame(std::vector<int> particleCounts) {
  particleCounts.resize(std::min(particleCounts.size(), kVerifiedStrands));
  reference::Simulation<double> expected(curls(particleCounts), {}, settings_);
  expected.stepFrame(poses_);
  if (Status status = simulation_->stepFrame(poses_); !status) return status;
  const auto found = simulation_->positions();
  if (!found) return found.error();
  if (Status status = checkDistance("the kernel", distance(*found, expected.positions())); !status)
    return status;
  if (!hand_) return {};
  hand_->stepFrame(poses_);
  return checkDistance("the hand-vectorised loop", distance(hand_->positions(), expected.positions()));
}

Status Contest::addHand(const Groom& groom) {
  if (!canSweep()) return {};
  auto hand = HandVectorised::create(groom, {}, settings_, coreCount());
  if (!hand) return hand.error();
  hand_ = std::move(*hand);
  const int steps = settings_.stepsPerFrame;
  operationsPerStep_ = static_cast<double>(hand_->operations(static_cast<std::uint32_t>(steps))) / steps;
  bytesPerStep_ = static_cast<double>(hand_->bytesMoved()) / steps;
  return {};
}

void Contest::addReferences(const std::vector<int>& particleCounts) {
  std::vector<int> some;
  double particles = 0;
  for (const int count : particleCounts) {
    if (particles >= kReferenceParticles) break;
    some.push_back(count);
    particles += count;
  }
  referenceShare_ = particles / particles_;
  const Groom groom = curls(some);
  referenceDouble_ = std::make_unique<reference::Simulation<double>>(groom, Material{}, settings_);
  referenceFloat_ = std::make_unique<reference::Simulation<float>>(groom, Material{}, settings_);
}

Status Contest::stepKernel() {
  const double steps = settings_.stepsPerFrame;
  const double before = Diagnostics(*simulation_).stageMilliseconds()["strand_step"],
               cpu = processCpuSeconds(), wall = wallSeconds();
  if (Status status = simulation_->stepFrame(poses_); !status) return status;
  samples_.kernelWall.push_back((wallSeconds() - wall) / steps);
  samples_.kernelCpu.push_back((processCpuSeconds() - cpu) / steps);
  samples_.kernel.push_back(1e-3 * (Diagnostics(*simulation_).stageMilliseconds()["strand_step"] - before) /
                            steps);
  return {};
}

void Contest::stepHand() {
  const double steps = settings_.stepsPerFrame, cpu = processCpuSeconds(), start = wallSeconds();
  hand_->stepFrame(poses_);
  const double between = wallSeconds();
  samples_.handCpu.push_back((processCpuSeconds() - cpu) / steps);
  hand_->stepFrameAlone(poses_);
  samples_.hand.push_back((between - start) / steps);
  samples_.handAlone.push_back((wallSeconds() - between) / steps);
}

// One step: it takes as long as any.
void Contest::stepReferences() {
  const std::span<const HeadPose> one(&poses_.back(), 1);
  const double cpu = processCpuSeconds(), start = wallSeconds();
  referenceDouble_->stepFrame(one);
  const double between = wallSeconds();
  samples_.referenceCpu.push_back((processCpuSeconds() - cpu) / referenceShare_);
  referenceFloat_->stepFrame(one);
  samples_.referenceDouble.push_back((between - start) / referenceShare_);
  samples_.referenceFloat.push_back((wallSeconds() - between) / referenceShare_);
}

Status Contest::round() {
  if (Status status = stepKernel(); !status) return status;
  if (hand_) {
    stepHand();
    samples_.peak.push_back(operationsPerStep_ / multiplyAddPeak(*team_, kPeakSeconds));
  }
  if (referenceDouble_) stepReferences();
  return {};
}

Status Contest::rounds(int count) {
  for (int k = 0; k < count; ++k) {
    if (Status status = round(); !status) return status;
  }
  return {};
}

}  // namespace ringlet::bench
