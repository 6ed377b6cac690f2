// The reference simulation of a whole groom on the CPU, one thread: the same stages in the same order as the
// GPU's list, in float or double. The oracle of the kernel tests, the baseline of the benchmarks, and
// `--backend reference`. Mirrors src/ringlet/solver/simulation.h.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reference/kernels/contact_step.h"
#include "reference/kernels/strand_step.h"
#include "ringlet/base/assert.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet::reference {

/// What happened to the numbers since the simulation began.
struct Report {
  double maxEdgeStretch = 0;          // longest edge over the groom's edge, over every outer step [1]
  std::uint64_t limitedEdges = 0;     // edges, times steps, the stretch limit touched
  std::uint64_t edgeSteps = 0;        // all edges, times steps
  std::uint64_t degenerateEdges = 0;  // edges, times steps, that had no direction
  std::uint64_t nonfinite = 0;        // particles whose position or velocity is not finite now
  std::uint64_t steps = 0;            // outer steps
  std::uint64_t contacts = 0;         // pairs that touch or have not yet broken, now
  double momentumError = 0;           // of the last step's contacts: |sum| over sum of magnitudes [1]

  double limitedShare() const {
    return edgeSteps > 0 ? static_cast<double>(limitedEdges) / static_cast<double>(edgeSteps) : 0;
  }
};

template <class Real>
class Simulation {
 public:
  /// The head starts at `start`, coming from `oneStepEarlier` (one outer step before), and the hair moves
  /// with it.
  Simulation(const Groom& groom, const Material& material, const Settings& settings, const HeadPose& start,
             const HeadPose& oneStepEarlier, const PaperMaterial& paper = {},
             std::span<const Body> bodies = {})
      : settings_(settings),
        previousHead_(oneStepEarlier),
        head_(start),
        firstPoint_(groom.firstPoint),
        bodies_(bodies.begin(), bodies.end()) {
    RINGLET_ASSERT(bodies.empty() || settings.integrator == Integrator::jacobi,
                   "bodies need the integrator jacobi");
    for (const Body& body : bodies_) bodyPoses_.push_back(body.poseAt(0, start));
    if (settings.air.on) windModes_ = windModes(settings.air);
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      rest_.push_back(makeRestStrand<Real>(groom.strand(s), groom.metresPerUnit,
                                           materialOfStrand(material, s), paper, settings));
    }
    rootShifts_.assign(groom.strandCount(), Vector3<double>::Zero());
    rootPoses_.assign(groom.strandCount(), BodyPose{});
    previousRootPoses_ = rootPoses_;
    systems_.resize(groom.strandCount());
    taps_.resize(groom.strandCount());
    if (settings.contacts.on) {
      RINGLET_ASSERT(settings.integrator == Integrator::jacobi, "contacts need the integrator jacobi");
      contacts_ = makeContacts(rest_, firstPoint_, settings.contacts);
    }
    placeAtRest();
  }
  Simulation(const Groom& groom, const Material& material, const Settings& settings,
             const HeadPose& start = {})
      : Simulation(groom, material, settings, start, start) {}

  /// Outer steps; stepPoses[k] is the head's pose at the end of step k. A frame is settings.stepsPerFrame of
  /// them. bodyPoses: as bodyPosesOf gives them; without, all bodies are the head's. rootPoses[step * strands
  /// + strand]: each strand's own pose in the head's frame; without, they stay.
  void stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                 std::span<const BodyPose> rootPoses = {}) {
    RINGLET_ASSERT(rootPoses.empty() || rootPoses.size() == stepPoses.size() * rest_.size(),
                   "every strand has a pose in every step");
    const std::vector<BodyPose> carried =
        bodyPoses.empty() ? bodyPosesOf(bodies_, stepPoses, std::vector<double>(stepPoses.size()))
                          : std::vector<BodyPose>(bodyPoses.begin(), bodyPoses.end());
    RINGLET_ASSERT(carried.size() == stepPoses.size() * bodies_.size(),
                   "every body has a pose in every step");
    if (settings_.jumps(length(stepPoses.back().position - head_.position))) {
      carryTo(stepPoses.back());
      bodyPoses_.assign(carried.end() - static_cast<std::ptrdiff_t>(bodies_.size()), carried.end());
      if (!rootPoses.empty())
        rootPoses_.assign(rootPoses.end() - static_cast<std::ptrdiff_t>(rest_.size()), rootPoses.end());
      previousRootPoses_ = rootPoses_;
      report_.steps += stepPoses.size();
      return;
    }
    for (std::size_t k = 0; k < stepPoses.size(); ++k) {
      const std::vector<BodyPose> roots =
          rootPoses.empty() ? rootPoses_
                            : std::vector<BodyPose>(
                                  rootPoses.begin() + static_cast<std::ptrdiff_t>(k * rest_.size()),
                                  rootPoses.begin() + static_cast<std::ptrdiff_t>((k + 1) * rest_.size()));
      stepOnce(stepPoses[k], std::span(carried).subspan(k * bodies_.size(), bodies_.size()), roots);
    }
  }
  /// Strands' own poses before the first step and one step earlier; puts the hair there, at rest.
  void placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
    RINGLET_ASSERT(now.size() == rest_.size() && oneStepEarlier.size() == rest_.size(),
                   "every strand has a pose");
    rootPoses_.assign(now.begin(), now.end());
    previousRootPoses_.assign(oneStepEarlier.begin(), oneStepEarlier.end());
    placeAtRest();
  }
  /// Where bodies are before the first step; without, where they are at t = 0.
  void placeBodies(std::span<const BodyPose> poses) { bodyPoses_.assign(poses.begin(), poses.end()); }

  /// Groom order, relative to the head's origin and its translation, along world axes.
  const Field<Real>& positions() const { return positions_; }    // [m]
  const Field<Real>& velocities() const { return velocities_; }  // [m/s]
  void setState(const Field<Real>& positions, const Field<Real>& velocities) {
    RINGLET_ASSERT(positions.size() == positions_.size(), "setState needs a position for every particle");
    RINGLET_ASSERT(velocities.size() == velocities_.size(), "setState needs a velocity for every particle");
    positions_ = positions;
    velocities_ = velocities;
    contacts_.live.clear();
    contacts_.changes.clear();
  }

  /// How far each strand's root moves beside the head, when the head's pose has `shift` 1: in the groom's
  /// axes [m]. Before the first frame.
  void setRootShifts(std::span<const Vec3d> shifts) {
    RINGLET_ASSERT(shifts.size() == rest_.size(), "every strand has a root shift");
    for (std::size_t s = 0; s < rest_.size(); ++s) rootShifts_[s] = toEigen<double>(shifts[s]);
  }

  const HeadPose& head() const { return head_; }
  const Settings& settings() const { return settings_; }
  const std::vector<RestStrand<Real>>& restStrands() const { return rest_; }
  /// Between strands, with what the last outer step found; empty unless settings.contacts.on.
  const Contacts<Real>& contacts() const { return contacts_; }
  /// Intermediates of the last outer step, one entry per strand.
  const std::vector<StrandTaps<Real>>& taps() const { return taps_; }

  Report report() const {
    Report report = report_;
    report.contacts = contacts_.live.size();
    report.momentumError = contacts_.momentumError;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (!positions_[i].allFinite() || !velocities_[i].allFinite()) ++report.nonfinite;
    }
    return report;
  }

 private:
  void placeAtRest() {
    const double T = settings_.stepSeconds();
    positions_.clear();
    velocities_.clear();
    for (std::size_t s = 0; s < rest_.size(); ++s) {
      const Carried now = carried(head_, rootPoses_[s]),
                    before = carried(previousHead_, previousRootPoses_[s]);
      for (const Vector3<Real>& point : rest_[s].points) {
        const Vector3<double> x = point.template cast<double>();
        const Vector3<double> here = now.origin + now.rotation * x;
        positions_.push_back(here.template cast<Real>());
        velocities_.push_back(((here - before.origin - before.rotation * x) / T).template cast<Real>());
      }
    }
  }

  // A strand, by the head and its own pose: x = origin + rotation x_groom, relative to the head's origin.
  struct Carried {
    Rotation<double> rotation;
    Vector3<double> origin;
  };
  static Carried carried(const HeadPose& head, const BodyPose& root) {
    const Rotation<double> turn = toEigen<double>(head.rotation);
    return {turn * toEigen<double>(root.rotation), turn * toEigen<double>(root.position)};
  }

  // Rigidly: seen from the head, hair and head go on as they were.
  void carryTo(const HeadPose& next) {
    const Rotation<double> before = toEigen<double>(head_.rotation), now = toEigen<double>(next.rotation);
    const Rotation<double> turned = (now * before.conjugate()).normalized();
    for (Field<Real>* field : {&positions_, &velocities_}) {
      for (Vector3<Real>& v : *field) v = (turned * v.template cast<double>()).template cast<Real>();
    }
    const Vector3<double> step = turned * toEigen<double>(head_.position - previousHead_.position);
    const Rotation<double> earlier = (turned * toEigen<double>(previousHead_.rotation)).normalized();
    previousHead_ = {next.position - Vec3d{step.x(), step.y(), step.z()},
                     {earlier.x(), earlier.y(), earlier.z(), earlier.w()},
                     next.shift};
    head_ = next;
    contacts_.live.clear();
    contacts_.changes.clear();
  }

  void stepOnce(const HeadPose& next, std::span<const BodyPose> bodyPoses,
                const std::vector<BodyPose>& roots) {
    const std::vector<BodyStep<Real>> bodies = bodySteps(next, bodyPoses);
    const AirStep<Real> air = airStep(next);
    for (std::size_t s = 0; s < rest_.size(); ++s) {
      const HeadStep<Real> head = headStep(next, s, roots[s]);
      const auto positions = strandOf(positions_, s), velocities = strandOf(velocities_, s);
      prepareStrand(rest_[s], settings_, head, air, positions, velocities, scratch_, taps_[s], systems_[s]);
      solveVelocities(rest_[s], settings_, head, bodies, systems_[s], scratch_, taps_[s], positions,
                      velocities);
    }
    if (settings_.contacts.on) {
      updateContacts(settings_.contacts, static_cast<Real>(settings_.stepSeconds()), positions_, velocities_,
                     contacts_);
      const auto solveOne = [&](std::size_t s, std::span<Vector3<double>> velocities) {
        solveAmongBodies<Real>(rest_[s], bodies, strandOf(positions_, s), systems_[s], scratch_, velocities);
      };
      solveContacts(settings_.contacts.iterations, firstPoint_, systems_, solveOne, contacts_, velocities_);
    }
    for (std::size_t s = 0; s < rest_.size(); ++s) {
      moveStrand(rest_[s], settings_, headStep(next, s, roots[s]), bodies, strandOf(positions_, s),
                 strandOf(velocities_, s), scratch_, taps_[s]);
      record(rest_[s], taps_[s]);
    }
    if (settings_.contacts.on) rememberChanges(velocities_, contacts_);
    ++report_.steps;
    previousHead_ = head_;
    head_ = next;
    previousRootPoses_ = rootPoses_;
    rootPoses_ = roots;
    bodyPoses_.assign(bodyPoses.begin(), bodyPoses.end());
  }

  AirStep<Real> airStep(const HeadPose& next) const {
    if (!settings_.air.on) return {};
    const double T = settings_.stepSeconds(), seconds = T * static_cast<double>(report_.steps + 1);
    const Vec3d travel = (next.position - head_.position) / T;
    return {.settings = &settings_.air,
            .wind = toEigen<Real>(evenWindAt(settings_.air, seconds) - travel),
            .modes = windModes_,
            .origin = toEigen<double>(head_.position),
            .seconds = seconds};
  }

  // In double, as headStep.
  std::vector<BodyStep<Real>> bodySteps(const HeadPose& next, std::span<const BodyPose> poses) const {
    std::vector<BodyStep<Real>> steps;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const BodyPose &from = bodyPoses_[b], &to = poses[b];
      const Vec3d now = from.position - head_.position, then = to.position - next.position;
      steps.push_back({.body = &bodies_[b],
                       .rotationNow = toEigen<Real>(from.rotation),
                       .rotationNext = toEigen<Real>(to.rotation),
                       .positionNow = toEigen<Real>(now),
                       .positionNext = toEigen<Real>(then),
                       .velocity = toEigen<Real>((then - now) / settings_.stepSeconds()),
                       .turn = toEigen<Real>(to.rotation * from.rotation.conjugate()),
                       .seconds = static_cast<Real>(settings_.stepSeconds())});
    }
    return steps;
  }

  // For strand s. In double: the head's velocity is a small difference of positions that may be large.
  HeadStep<Real> headStep(const HeadPose& next, std::size_t s, const BodyPose& nextRoot) const {
    const double T = settings_.stepSeconds();
    const Vec3d velocityNow = (head_.position - previousHead_.position) / T;
    const Vec3d velocityNext = (next.position - head_.position) / T;
    const Carried carriedNow = carried(head_, rootPoses_[s]), carriedNext = carried(next, nextRoot);
    return {.before = carried(previousHead_, previousRootPoses_[s]).rotation,
            .now = carriedNow.rotation,
            .next = carriedNext.rotation,
            .velocityChange = toEigen<Real>(velocityNext - velocityNow),
            .seconds = static_cast<Real>(T),
            .originNow = carriedNow.origin,
            .originNext = carriedNext.origin,
            .shiftNow = head_.shift * rootShifts_[s],
            .shiftNext = next.shift * rootShifts_[s]};
  }

  std::span<Vector3<Real>> strandOf(Field<Real>& field, std::size_t s) const {
    return std::span(field).subspan(firstPoint_[s], firstPoint_[s + 1] - firstPoint_[s]);
  }

  void record(const RestStrand<Real>& rest, const StrandTaps<Real>& taps) {
    report_.maxEdgeStretch = std::max(report_.maxEdgeStretch, static_cast<double>(taps.maxEdgeStretch));
    report_.limitedEdges += taps.limitedCount;
    report_.degenerateEdges += taps.degenerateCount;
    report_.edgeSteps += rest.edgeCount();
  }

  Settings settings_;
  HeadPose previousHead_, head_;                         // poses n - 1 and n
  Field<double> rootShifts_;                             // at HeadPose::shift 1 [m]
  std::vector<BodyPose> previousRootPoses_, rootPoses_;  // of strands in the head's frame, n - 1 and n
  std::vector<std::uint32_t> firstPoint_;                // as in Groom
  std::vector<Body> bodies_;
  std::vector<WindMode> windModes_;
  std::vector<BodyPose> bodyPoses_;  // at pose n, in the world
  std::vector<RestStrand<Real>> rest_;
  Field<Real> positions_, velocities_;
  std::vector<StrandSystem> systems_;  // of the current step
  std::vector<StrandTaps<Real>> taps_;
  Contacts<Real> contacts_;
  StepScratch<Real> scratch_;
  Report report_;
};

}  // namespace ringlet::reference
