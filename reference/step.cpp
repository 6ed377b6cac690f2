// Implements step.h.
#include "reference/step.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "ringlet/base/assert.h"
#include "ringlet/crossings/crossing_step.h"
#include "ringlet/rest/goal.h"

namespace ringlet::reference {

template <class Real>
Simulation<Real>::Simulation(const Groom& groom, const Material& material, const Settings& settings,
                             const HeadPose& start, const HeadPose& oneStepEarlier,
                             const PaperMaterial& paper, std::span<const Body> bodies)
    : settings_(settings),
      balancedGravity_(settings.gravity),
      paper_(paper),
      previousHead_(oneStepEarlier),
      head_(start),
      firstPoint_(groom.firstPoint),
      bodies_(bodies.begin(), bodies.end()),
      bending_(bodies) {
  RINGLET_ASSERT(bodies.empty() || settings.integrator == Integrator::jacobi,
                 "bodies need the integrator jacobi");
  for (const Body& body : bodies_) bodyPoses_.push_back(body.poseAt(0, start));
  if (settings.air.on) windModes_ = windModes(settings.air);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    strandInGroom_.push_back(static_cast<std::uint32_t>(s));
    pieces_.push_back({0, groom.strand(s).size()});
    restTurns_.push_back(Rotation<double>::Identity());
    rest_.push_back(restOf(groom, material, settings, s));
  }
  rootShifts_.assign(groom.strandCount(), Vector3<double>::Zero());
  rootPoses_.assign(groom.strandCount(), BodyPose{});
  previousRootPoses_ = rootPoses_;
  if (settings.goal.on) aimAtGroom(groom);
  systems_.resize(groom.strandCount());
  taps_.resize(groom.strandCount());
  isRigid_.assign(groom.strandCount(), false);
  findContacts();
  placeAtRest();
}

template <class Real>
RestStrand<Real> Simulation<Real>::restOf(const Groom& groom, const Material& material,
                                          const Settings& settings, std::size_t s) const {
  Settings balanced = settings;
  balanced.gravity = balancedGravity_;
  const std::uint32_t strand = strandInGroom_[s];
  auto rest = makeRestStrand<Real>(groom.strand(strand), groom.metresPerUnit,
                                   materialOfStrand(material, strand), paper_, balanced, pieces_[s]);
  rest.restTurn = restTurns_[s];
  return rest;
}

template <class Real>
void Simulation<Real>::cut(const Groom& groom, const Material& material, std::span<const StrandCut> cuts) {
  const auto doubled = [](auto& values, std::size_t at) {
    values.insert(values.begin() + static_cast<std::ptrdiff_t>(at), values[at]);
  };
  if (whole_.empty()) whole_ = rest_;
  for (const StrandCut& cut : cuts) {
    const auto s =
        static_cast<std::size_t>(std::ranges::find(strandInGroom_, cut.strand) - strandInGroom_.begin());
    if (isRigid_[s]) continue;
    RINGLET_ASSERT(cut.keep > 0 && cut.keep < pieces_[s].end, "a cut is within what is left of the strand");
    doubled(strandInGroom_, s), doubled(pieces_, s), doubled(restTurns_, s), doubled(rest_, s);
    doubled(rootShifts_, s), doubled(rootPoses_, s), doubled(previousRootPoses_, s);
    isRigid_.insert(isRigid_.begin() + static_cast<std::ptrdiff_t>(s), false);
    pieces_[s].end = pieces_[s + 1].begin = cut.keep;
    restTurns_[s + 1] = toEigen<double>(head_.rotation);
    firstPoint_.insert(firstPoint_.begin() + static_cast<std::ptrdiff_t>(s) + 1, firstPoint_[s] + cut.keep);
    for (const std::size_t piece : {s, s + 1}) rest_[piece] = restOf(groom, material, settings_, piece);
    contacts_.volume.release(firstPoint_[s + 1], firstPoint_[s + 2]);
  }
  systems_.assign(rest_.size(), {});
  taps_.assign(rest_.size(), {});
}

template <class Real>
void Simulation<Real>::change(const Groom& groom, const Material& material, const Settings& settings) {
  for (std::size_t s = 0; s < rest_.size(); ++s) rest_[s] = restOf(groom, material, settings, s);
  for (std::size_t s = 0; s < whole_.size(); ++s)
    whole_[s] = makeRestStrand<Real>(groom.strand(s), groom.metresPerUnit, materialOfStrand(material, s),
                                     paper_, settings);
  settings_ = settings;
  if (settings.air.on) windModes_ = windModes(settings.air);
  if (settings.goal.on) aimAtGroom(groom);
}

template <class Real>
void Simulation<Real>::findContacts() {
  if (!settings_.contacts.on) return;
  RINGLET_ASSERT(settings_.integrator == Integrator::jacobi, "contacts need the integrator jacobi");
  std::vector<RestStrand<Real>> touching = rest_;  // of rigid ones no point
  for (std::size_t s = 0; s < rest_.size(); ++s)
    if (isRigid_[s]) touching[s].points.clear();
  contacts_ = makeContacts(touching, firstPoint_, settings_.contacts);
}

template <class Real>
void Simulation<Real>::carryRigidly(std::span<const std::uint32_t> strands) {
  if (strands.empty()) return;
  for (std::uint32_t s : strands) isRigid_[s] = true;
  findContacts();
  placeAtRest();
}

template <class Real>
void Simulation<Real>::stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                                 std::span<const BodyPose> rootPoses, BodyPoints bodyPoints) {
  RINGLET_ASSERT(rootPoses.empty() || rootPoses.size() == stepPoses.size() * wholeStrands().size(),
                 "every strand has a pose in every step");
  const std::vector<BodyPose> carried =
      bodyPoses.empty() ? bodyPosesOf(bodies_, stepPoses, std::vector<double>(stepPoses.size()))
                        : std::vector<BodyPose>(bodyPoses.begin(), bodyPoses.end());
  RINGLET_ASSERT(carried.size() == stepPoses.size() * bodies_.size(), "every body has a pose in every step");
  if (settings_.jumps(length(stepPoses.back().position - head_.position))) {
    carryTo(stepPoses.back());
    bending_.jump(carried, bodyPoints);
    bodyPoses_.assign(carried.end() - static_cast<std::ptrdiff_t>(bodies_.size()), carried.end());
    if (!rootPoses.empty()) rootPoses_ = ofPieces(rootPoses.last(wholeStrands().size()));
    previousRootPoses_ = rootPoses_;
    for (std::size_t s = 0; s < rest_.size(); ++s) placeRigid(s);
    report_.steps += stepPoses.size();
    fieldsBefore_ = fields_;
    return;
  }
  bending_.beginFrame(bodyPoses_, carried, bodyPoints);
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    const std::vector<BodyPose> roots =
        rootPoses.empty() ? rootPoses_
                          : ofPieces(rootPoses.subspan(k * wholeStrands().size(), wholeStrands().size()));
    stepOnce(k, stepPoses.size(), stepPoses[k],
             std::span(carried).subspan(k * bodies_.size(), bodies_.size()), roots);
  }
  goalsBefore_ = goals_;
  fieldsBefore_ = fields_;
}

template <class Real>
std::vector<BodyPose> Simulation<Real>::ofPieces(std::span<const BodyPose> poses) const {
  std::vector<BodyPose> all;
  for (const std::uint32_t strand : strandInGroom_) all.push_back(poses[strand]);
  return all;
}

template <class Real>
void Simulation<Real>::placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
  RINGLET_ASSERT(now.size() == rest_.size() && oneStepEarlier.size() == rest_.size(),
                 "every strand has a pose");
  rootPoses_.assign(now.begin(), now.end());
  previousRootPoses_.assign(oneStepEarlier.begin(), oneStepEarlier.end());
  placeAtRest();
}

template <class Real>
void Simulation<Real>::setState(const Field<Real>& positions, const Field<Real>& velocities) {
  RINGLET_ASSERT(positions.size() == positions_.size(), "setState needs a position for every particle");
  RINGLET_ASSERT(velocities.size() == velocities_.size(), "setState needs a velocity for every particle");
  positions_ = positions;
  velocities_ = velocities;
  for (std::size_t s = 0; s < rest_.size(); ++s) placeRigid(s);
  contacts_.live.clear();
  contacts_.changes.clear();
  contacts_.volume.forget();
}

template <class Real>
void Simulation<Real>::setRootShifts(std::span<const Vec3d> shifts) {
  RINGLET_ASSERT(shifts.size() == rest_.size(), "every strand has a root shift");
  for (std::size_t s = 0; s < rest_.size(); ++s) rootShifts_[s] = toEigen<double>(shifts[s]);
}

template <class Real>
void Simulation<Real>::setForces(std::span<const Vec3f> forces) {
  RINGLET_ASSERT(forces.size() == positions_.size(), "every particle has a force");
  forces_.clear();
  for (const Vec3f& force : forces) forces_.push_back(toEigen<double>(force));
}

template <class Real>
void Simulation<Real>::setGoals(std::span<const Vec3f> places, std::span<const float> strengths,
                                double dampingRatio, std::span<const Vec3f> from) {
  const bool isFirst = goals_.empty();
  goals_.clear();
  goalStiffness_.clear();
  goalDamping_.clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    goals_.push_back(toEigen<double>(places[i]));
    goalStiffness_.push_back(goalStiffness(strengths[i]));
    goalDamping_.push_back(goalDamping(goalStiffness_.back(), dampingRatio));
  }
  std::size_t first = 0;
  for (const RestStrand<Real>& rest : wholeStrands()) {
    if (!settings_.goal.shape) break;
    const double mass = std::accumulate(rest.masses.begin(), rest.masses.end(), 0.0);
    const double arc = std::accumulate(rest.edgeLengths.begin(), rest.edgeLengths.end(), 0.0);
    for (std::size_t i = 0; i < rest.edgeCount(); ++i) {
      const std::size_t at = first + i;
      const double weight = mass * kStandardGravity, strength = strengths[at];
      const double edgeMass = static_cast<double>(rest.edgeLengths[i]) * static_cast<double>(rest.masses[i]);
      goalStiffness_[at] = strength * weight / edgeMass;
      goalDamping_[at] = dampingRatio * arc * std::sqrt(strength * weight * mass / arc) / edgeMass;
    }
    first += rest.particleCount();
  }
  if (isFirst) goalsBefore_ = goals_;
  if (from.empty()) return;
  goalsBefore_.clear();
  for (const Vec3f& place : from) goalsBefore_.push_back(toEigen<double>(place));
}

template <class Real>
void Simulation<Real>::setFields(std::span<const ForceField> fields, std::span<const ForceField> from) {
  fields_.assign(fields.begin(), fields.end());
  fieldsBefore_ = fields_;
  if (!from.empty()) fieldsBefore_.assign(from.begin(), from.end());
}

// A step takes them as they are at its end.
template <class Real>
std::vector<ForceField> Simulation<Real>::fieldsAtStep(std::size_t k, std::size_t steps) const {
  std::vector<ForceField> now;
  for (std::size_t f = 0; f < fields_.size(); ++f)
    now.push_back(
        interpolate(fieldsBefore_[f], fields_[f], static_cast<double>(k + 1) / static_cast<double>(steps)));
  return now;
}

// Settings::goal: its strength goes evenly from the root's to the tip's along the arc.
template <class Real>
void Simulation<Real>::aimAtGroom(const Groom& groom) {
  std::vector<Vec3f> places;
  std::vector<float> strengths;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    double arc = 0;
    for (const Real edge : wholeStrands()[s].edgeLengths) arc += static_cast<double>(edge);
    double along = 0;
    for (std::size_t i = 0; i < groom.strand(s).size(); ++i) {
      if (i > 0) along += static_cast<double>(wholeStrands()[s].edgeLengths[i - 1]);
      const double share = arc > 0 ? along / arc : 0;
      const double atTip = settings_.goal.strength * settings_.goal.tipShare;
      strengths.push_back(static_cast<float>((1 - share) * settings_.goal.strength + share * atTip));
      places.push_back(static_cast<Vec3f>(Vec3d(groom.strand(s)[i]) * groom.metresPerUnit));
    }
  }
  setGoals(places, strengths, settings_.goal.damping);
}

template <class Real>
GoalStep Simulation<Real>::goalStep(std::size_t s, std::size_t k, std::size_t steps) const {
  GoalStep step;
  if (goals_.empty() || rest_[s].falls()) return step;
  step.isShape = settings_.goal.shape;
  const double n = static_cast<double>(steps), begin = static_cast<double>(k) / n,
               end = static_cast<double>(k + 1) / n;
  for (std::size_t i = firstPoint_[s]; i < firstPoint_[s + 1]; ++i) {
    step.before.push_back((1 - begin) * goalsBefore_[i] + begin * goals_[i]);
    step.after.push_back((1 - end) * goalsBefore_[i] + end * goals_[i]);
    step.stiffness.push_back(goalStiffness_[i]);
    step.damping.push_back(goalDamping_[i]);
  }
  return step;
}

template <class Real>
Report Simulation<Real>::report() const {
  Report report = report_;
  report.contacts = static_cast<std::size_t>(std::ranges::count_if(contacts_.live, [&](const auto& contact) {
    return settings_.contacts.taper == ContactTaper::time || contact.weights.spring > 0;
  }));
  report.momentumError = contacts_.momentumError;
  report.freeMomentumError = contacts_.freeMomentumError;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    if (!positions_[i].allFinite() || !velocities_[i].allFinite()) ++report.nonfinite;
  }
  return report;
}

template <class Real>
void Simulation<Real>::placeAtRest() {
  const double T = settings_.stepSeconds();
  positions_.clear();
  velocities_.clear();
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    const Carried now = carried(head_, rootPoses_[s]), before = carried(previousHead_, previousRootPoses_[s]);
    for (const Vector3<Real>& point : rest_[s].points) {
      const Vector3<double> x = point.template cast<double>();
      const Vector3<double> here = now.origin + now.rotation * x;
      positions_.push_back(here.template cast<Real>());
      velocities_.push_back(((here - before.origin - before.rotation * x) / T).template cast<Real>());
    }
  }
  for (std::size_t s = 0; s < rest_.size(); ++s) placeRigid(s);
}

template <class Real>
void Simulation<Real>::placeRigid(std::size_t s) {
  if (!isRigid_[s]) return;
  const Carried now = carried(head_, rootPoses_[s]), before = carried(previousHead_, previousRootPoses_[s]);
  for (std::size_t i = 0; i < rest_[s].points.size(); ++i) {
    const Vector3<double> x = rest_[s].points[i].template cast<double>(), shift = rootShifts_[s];
    const Vector3<double> here = now.origin + now.rotation * (x + head_.shift * shift);
    const Vector3<double> there = before.origin + before.rotation * (x + previousHead_.shift * shift);
    positions_[firstPoint_[s] + i] = here.template cast<Real>();
    velocities_[firstPoint_[s] + i] = ((here - there) / settings_.stepSeconds()).template cast<Real>();
  }
}

template <class Real>
typename Simulation<Real>::Carried Simulation<Real>::carried(const HeadPose& head, const BodyPose& root) {
  const Rotation<double> turn = toEigen<double>(head.rotation);
  return {turn * toEigen<double>(root.rotation), turn * toEigen<double>(root.position)};
}

template <class Real>
void Simulation<Real>::carryTo(const HeadPose& next) {
  const Rotation<double> before = toEigen<double>(head_.rotation), now = toEigen<double>(next.rotation);
  const Rotation<double> turned = (now * before.conjugate()).normalized();
  const Vector3<double> lastStep = toEigen<double>(head_.position - previousHead_.position);
  const Vector3<double> step = turned * lastStep;
  const Vector3<double> travel = toEigen<double>(next.position - head_.position);
  const Vector3<double> faster = (step - lastStep) / settings_.stepSeconds();
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    const auto carry = [&](Field<Real>& field, const Vector3<double>& change) {
      for (Vector3<Real>& value : strandOf(field, s)) {
        Vector3<double> v = value.template cast<double>();
        v = rest_[s].falls() ? Vector3<double>(v - change) : turned * v;
        value = v.template cast<Real>();
      }
    };
    carry(positions_, travel);
    carry(velocities_, faster);
  }
  const Rotation<double> earlier = (turned * toEigen<double>(previousHead_.rotation)).normalized();
  previousHead_ = {next.position - Vec3d{step.x(), step.y(), step.z()},
                   {earlier.x(), earlier.y(), earlier.z(), earlier.w()},
                   next.shift};
  head_ = next;
  contacts_.live.clear();
  contacts_.changes.clear();
  if (turned.vec().norm() > 1e-12) contacts_.volume.forget();
}

template <class Real>
void Simulation<Real>::stepOnce(std::size_t k, std::size_t steps, const HeadPose& next,
                                std::span<const BodyPose> bodyPoses, const std::vector<BodyPose>& roots) {
  const std::vector<BodyStep<Real>> bodies = bodySteps(k, next, bodyPoses);
  std::vector<std::vector<ClothList<Real>>> lists;  // of all particles, by body
  for (const BodyStep<Real>& body : bodies) lists.push_back(clothLists<Real>(body, positions_, velocities_));
  const auto ofStrand = [&](std::vector<BodyStep<Real>> all, std::size_t s) {
    for (std::size_t b = 0; b < all.size(); ++b)
      if (!lists[b].empty())
        all[b].lists = std::span(lists[b]).subspan(firstPoint_[s], rest_[s].particleCount());
    return all;
  };
  // Where hair meets as a volume the first solve, by which strands hear of each other, knows no bodies.
  const bool meetsAsOne = settings_.contacts.on && !contacts_.pairByPair;
  const std::vector<BodyStep<Real>> inFirstSolve = meetsAsOne ? std::vector<BodyStep<Real>>{} : bodies;
  const AirStep<Real> air = airStep(next);
  const std::vector<ForceField> inStep = fieldsAtStep(k, steps);
  const FieldStep fields{inStep, toEigen<double>(head_.position),
                         toEigen<double>((next.position - head_.position) / settings_.stepSeconds())};
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    if (isRigid_[s]) continue;
    const HeadStep<Real> head = headStep(next, s, roots[s]);
    const auto positions = strandOf(positions_, s), velocities = strandOf(velocities_, s);
    const OutsideForces forces =
        forces_.empty() ? OutsideForces{}
                        : OutsideForces(forces_).subspan(firstPoint_[s], rest_[s].particleCount());
    prepareStrand(rest_[s], settings_, head, air, forces, goalStep(s, k, steps), fields, positions,
                  velocities, scratch_, taps_[s], systems_[s]);
    solveVelocities(rest_[s], settings_, head, forces, ofStrand(inFirstSolve, s), systems_[s], scratch_,
                    taps_[s], positions, velocities);
  }
  if (settings_.contacts.on) {
    updateContacts(settings_.contacts, static_cast<Real>(settings_.stepSeconds()), positions_, velocities_,
                   contacts_);
    const auto solveOne = [&](std::size_t s, std::span<Vector3<double>> velocities) {
      if (isRigid_[s]) return;
      solveAmongBodies<Real>(rest_[s], ofStrand(bodies, s), strandOf(positions_, s), systems_[s], scratch_,
                             velocities);
    };
    const VolumeFrame frame{toEigen<double>(head_.rotation), toEigen<double>(next.rotation),
                            settings_.stepSeconds()};
    solveContacts(settings_.contacts, frame, firstPoint_, systems_, solveOne, positions_, contacts_,
                  velocities_);
  }
  const bool keepsApart = settings_.contacts.on && settings_.contacts.noCrossings;
  const Field<Real> starts = keepsApart ? positions_ : Field<Real>{};
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    if (isRigid_[s]) continue;
    moveStrand(rest_[s], settings_, headStep(next, s, roots[s]), ofStrand(bodies, s), strandOf(positions_, s),
               strandOf(velocities_, s), scratch_, taps_[s]);
    record(rest_[s], taps_[s]);
  }
  if (keepsApart) keepApart(next, starts);
  if (settings_.contacts.on) rememberChanges(velocities_, contacts_);
  ++report_.steps;
  previousHead_ = head_;
  head_ = next;
  previousRootPoses_ = rootPoses_;
  rootPoses_ = roots;
  for (std::size_t s = 0; s < rest_.size(); ++s) placeRigid(s);
  bodyPoses_.assign(bodyPoses.begin(), bodyPoses.end());
}

template <class Real>
void Simulation<Real>::keepApart(const HeadPose& next, const Field<Real>& starts) {
  CrossingHair hair{.firstPoint = firstPoint_,
                    .bundles = bundlesOf(settings_.contacts, rest_.size()),
                    .takesPart = {},
                    .masses = {},
                    .lengths = {},
                    .maxStretch = settings_.maxStretch};
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    hair.takesPart.push_back(!isRigid_[s]);
    for (std::size_t i = 0; i < rest_[s].particleCount(); ++i) {
      hair.masses.push_back(i < rest_[s].rootCount ? 0 : static_cast<double>(rest_[s].masses[i]));
      hair.lengths.push_back(i < rest_[s].edgeCount() ? static_cast<double>(rest_[s].edgeLengths[i]) : 0);
    }
  }
  const auto points = [](const Field<Real>& field) {
    std::vector<Vec3d> all;
    for (const Vector3<Real>& x : field) all.push_back({double(x[0]), double(x[1]), double(x[2])});
    return all;
  };
  const std::vector<Vec3d> wanted = points(positions_);
  std::vector<Vec3d> placed = wanted;
  const Quatd turn = normalized(next.rotation * head_.rotation.conjugate());
  ways_.add(
      keepFromCrossing(hair, turn, points(starts), placed, {.storesFloat = std::is_same_v<Real, float>}));
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (placed[i] == wanted[i]) continue;
    positions_[i] = toEigen<Real>(placed[i]);
    velocities_[i] += toEigen<Real>((placed[i] - wanted[i]) / settings_.stepSeconds());
  }
}

template <class Real>
AirStep<Real> Simulation<Real>::airStep(const HeadPose& next) const {
  if (!settings_.air.on) return {};
  const double T = settings_.stepSeconds(), seconds = T * static_cast<double>(report_.steps + 1);
  const Vec3d travel = (next.position - head_.position) / T;
  return {.settings = &settings_.air,
          .wind = toEigen<Real>(evenWindAt(settings_.air, seconds) - travel),
          .modes = windModes_,
          .origin = toEigen<double>(head_.position),
          .seconds = seconds};
}

template <class Real>
std::vector<BodyStep<Real>> Simulation<Real>::bodySteps(std::size_t k, const HeadPose& next,
                                                        std::span<const BodyPose> poses) const {
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
                     .seconds = static_cast<Real>(settings_.stepSeconds()),
                     .shapeNow = bending_.shapeAt(b, k),
                     .shapeNext = bending_.shapeAt(b, k + 1),
                     .bending = bending_.share(k)});
  }
  return steps;
}

template <class Real>
HeadStep<Real> Simulation<Real>::headStep(const HeadPose& next, std::size_t s,
                                          const BodyPose& nextRoot) const {
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

template <class Real>
void Simulation<Real>::record(const RestStrand<Real>& rest, const StrandTaps<Real>& taps) {
  report_.maxEdgeStretch = std::max(report_.maxEdgeStretch, static_cast<double>(taps.maxEdgeStretch));
  report_.limitedEdges += taps.limitedCount;
  report_.degenerateEdges += taps.degenerateCount;
  report_.edgeSteps += rest.edgeCount();
}

template <class Real>
void Simulation<Real>::archive(Archive& archive) {
  archive.value(previousHead_);
  archive.value(head_);
  archive.values(std::span(previousRootPoses_));
  archive.values(std::span(rootPoses_));
  archive.values(std::span(bodyPoses_));
  if (!whole_.empty()) {
    for (std::size_t s = 0; s < rest_.size(); ++s) {
      archive.values(std::span(restTurns_[s].coeffs().data(), 4));
      rest_[s].restTurn = restTurns_[s];
    }
  }
  archive.values(numbersOf(positions_));
  archive.values(numbersOf(velocities_));
  archive.value(report_);
  if (!settings_.contacts.on) return;
  archiveContacts(archive, contacts_);
  archive.value(ways_);
}

template class Simulation<float>;
template class Simulation<double>;

}  // namespace ringlet::reference
