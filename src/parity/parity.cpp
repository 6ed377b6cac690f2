// Implements parity/parity.h.
#include "parity/parity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <random>

#include "layout/strands.h"
#include "parity/sample_bodies.h"
#include "reference/step.h"
#include "ringlet/solver/diagnostics.h"

namespace ringlet::parity {
namespace {

using ReferenceF = reference::Simulation<float>;
using ReferenceD = reference::Simulation<double>;

// Uniform in [-1, 1], the same on every platform.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double operator()() { return 2.0 * static_cast<double>(engine_()) / 4294967295.0 - 1.0; }
  Vec3d vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

double meanEdge(std::span<const Vec3f> strand) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < strand.size(); ++i)
    sum += length(static_cast<Vec3d>(strand[i + 1] - strand[i]));
  return sum / static_cast<double>(strand.size() - 1);
}

template <class Real>
reference::Field<Real> toField(const std::vector<Vec3f>& values) {
  reference::Field<Real> field;
  for (Vec3f v : values) field.push_back(reference::toEigen<Real>(v));
  return field;
}

// Collects the largest error of one field.
class Comparison {
 public:
  Comparison(std::string field) { error_.field = std::move(field); }

  void add(std::size_t strand, std::size_t particle, double scale, const Eigen::VectorXd& expected,
           const Eigen::VectorXd& found) {
    double error = (expected - found).norm() / scale;
    if (!(error <= error_.error) || error_.where.empty()) {
      error_.error = std::isfinite(error) ? error : INFINITY;
      std::string values;
      for (Eigen::Index k = 0; k < expected.size(); ++k)
        values += fmt::format(" {:.9g}|{:.9g}", expected[k], found[k]);
      error_.where = fmt::format("strand {} particle {} scale {:.4g}: expected|found{}", strand, particle,
                                 scale, values);
    }
  }
  FieldError result() const { return error_; }

 private:
  FieldError error_;
};

FieldError failed(const char* call, const Error& error) { return {call, INFINITY, error.message}; }

Eigen::VectorXd three(const std::array<float, 4>& v, double factor = 1) {
  return Eigen::Vector3d(v[0], v[1], v[2]) * factor;
}

}  // namespace

std::vector<Vec3f> helix(int particles, double radius, double length, double turns, double noise,
                         std::uint32_t seed) {
  Random random(seed);
  std::vector<Vec3f> points;
  for (int i = 0; i < particles; ++i) {
    const double s = double(i) / (particles - 1), angle = 2 * std::numbers::pi * turns * s;
    const Vec3d p{radius * std::cos(angle), -length * s, radius * std::sin(angle)};
    points.push_back(static_cast<Vec3f>(p + random.vector() * noise));
  }
  return points;
}

Groom randomGroom(const std::vector<int>& particleCounts, std::uint32_t seed) {
  Random random(seed);
  Groom groom;
  groom.metresPerUnit = 1;
  for (std::size_t s = 0; s < particleCounts.size(); ++s) {
    const int n = particleCounts[s];
    const double length = 0.25 + 0.05 * random(),
                 turns = s % 3 == 2 ? 0 : std::min(8.0, n / 6.0) * (s % 2 ? 1 : -1);
    const double radius = s % 3 == 2 ? 0 : 0.01 + 0.004 * random();
    auto strand = helix(n, radius, length, turns, 0.05 * length / n, seed + static_cast<std::uint32_t>(s));
    const Vec3f root = static_cast<Vec3f>(random.vector() * 0.1);
    for (Vec3f& p : strand) p += root;
    groom.addStrand(strand);
  }
  return groom;
}

namespace {

// Three sine waves along a strand, s in [0, 1], zero at the root; of size about 1.
class Wave {
 public:
  explicit Wave(Random& random) {
    for (Vec3d& a : amplitudes_) a = random.vector();
  }
  Vec3d at(double s) const {
    Vec3d sum;
    for (int k = 0; k < 3; ++k) sum += amplitudes_[k] * std::sin((k + 0.5) * std::numbers::pi * s);
    return sum;
  }

 private:
  Vec3d amplitudes_[3];
};

}  // namespace

HairState randomState(const Groom& groom, const Settings& settings, std::uint32_t seed) {
  Random random(seed + 1000);
  HairState state;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = groom.strand(s);
    const double edge = meanEdge(strand), total = edge * static_cast<double>(strand.size() - 1);
    const Wave swing(random), speed(random);
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const bool pinned = i < static_cast<std::size_t>(settings.rootCount);
      const double along = static_cast<double>(i) / static_cast<double>(strand.size() - 1);
      const Vec3d shift = swing.at(along) * (0.002 * total) + random.vector() * (0.01 * edge);
      const Vec3d velocity = speed.at(along) + random.vector() * 0.01;
      state.positions.push_back(pinned ? strand[i]
                                       : static_cast<Vec3f>(static_cast<Vec3d>(strand[i]) + shift));
      state.velocities.push_back(pinned ? Vec3f{} : static_cast<Vec3f>(velocity));
    }
  }
  return state;
}

Material varyingMaterial() {
  Material material;
  material.inertiaFactor = 1.3;
  material.bendStiffnessProfile.points = {{0, 2}, {0.5, 1}, {1, 0.3}};
  material.bendDampingRatioProfile.points = {{0, 0.7}, {1, 1.5}};
  material.stretchStiffnessProfile.points = {{0.2, 1.5}, {0.8, 0.5}};
  material.stretchDampingTimeProfile.points = {{0, 0.4}, {1, 2}};
  material.coreStiffnessProfile.points = {{0, 0.3}, {0.5, 2}, {1, 0.8}};
  material.coreDampingRatioProfile.points = {{0, 1.8}, {1, 0.6}};
  material.lineDensityProfile.points = {{0, 1.5}, {1, 0.5}};
  using Runs = std::vector<StrandRun>;
  material.factors = {
      {&Material::bendStiffness, std::make_shared<Runs>(Runs{{0, 0, 0.5f}, {1, 1, 3}, {2, 7, 1.5f}})},
      {&Material::coreStiffness, std::make_shared<Runs>(Runs{{1, 3, 0.3f}})}};
  material.variation = {.bendStiffness = 0.3, .coreStiffness = 0.2, .bendDampingRatio = 0.3, .seed = 5};
  return material;
}

namespace {

// Of a case, at a time [s]: the head turns from where it was turned to and travels, and roots leave their
// places beside it.
HeadPose headOf(const ParityCase& c, Vec3d position, Vec3d turn, double t) {
  return {position, fromRotationVector(turn) * c.turned, c.shiftsRoots ? 0.3 + 8 * t + 300 * t * t : 0};
}

// Two poses before the step and one after.
struct HeadStep {
  HeadPose before, now, next;
};
HeadStep movingHead(const ParityCase& c) {
  const auto pose = [&](double t) {
    return headOf(c, {3 + 0.8 * t, 1 - 0.3 * t * t, 2 * t}, Vec3d{0.1, 1, 0.3} * (3 * t * t + t), t);
  };
  const double T = 1.0 / 192;
  return {pose(-T), pose(0), pose(T)};
}

// Some millimetres; none where they are not asked for.
std::vector<Vec3d> rootShifts(const ParityCase& c) {
  std::vector<Vec3d> shifts;
  Random random(c.seed + 5000);
  for (std::size_t s = 0; c.shiftsRoots && s < c.groom.strandCount(); ++s)
    shifts.push_back(random.vector() * 0.004);
  return shifts;
}

// Where strands' own poses go, each its own way: some degrees and millimetres, turning at some rad/s. None
// where they are not asked for.
class RootWays {
 public:
  RootWays(const ParityCase& c) {
    if (!c.kernel.features.roots) return;
    Random random(c.seed + 2000);
    for (std::size_t s = 0; s < c.groom.strandCount(); ++s) {
      Way way;
      for (Vec3d* v : {&way.turn, &way.turning, &way.place, &way.speed}) *v = random.vector();
      ways_.push_back(way);
    }
  }
  bool empty() const { return ways_.empty(); }
  std::vector<BodyPose> at(double t) const {
    std::vector<BodyPose> poses;
    for (const Way& way : ways_)
      poses.push_back({way.place * 0.005 + way.speed * (0.3 * t + 2 * t * t),
                       fromRotationVector(way.turn * 0.1 + way.turning * (2 * t + 20 * t * t))});
    return poses;
  }

 private:
  struct Way {
    Vec3d turn, turning, place, speed;
  };
  std::vector<Way> ways_;
};

// A random state as head, roots and shifts carry it: pinned particles where they have them, the others about
// them as before.
HairState startOf(const ParityCase& c, const HeadPose& head, const RootWays& roots) {
  HairState state = randomState(c.groom, c.settings, c.seed);
  std::vector<BodyPose> poses = roots.at(0);
  poses.resize(c.groom.strandCount());
  const std::vector<Vec3d> shifts = rootShifts(c);
  for (std::size_t s = 0; s < poses.size(); ++s) {
    const BodyPose& own = poses[s];
    const Vec3d origin = own.position + (shifts.empty() ? Vec3d{} : shifts[s] * head.shift);
    const Quatd turn = head.rotation * own.rotation;
    for (std::size_t g = c.groom.firstPoint[s]; g < c.groom.firstPoint[s + 1]; ++g) {
      Vec3f &p = state.positions[g], &v = state.velocities[g];
      p = static_cast<Vec3f>(rotate(head.rotation, origin) + rotate(turn, static_cast<Vec3d>(p)));
      v = static_cast<Vec3f>(rotate(turn, static_cast<Vec3d>(v)));
    }
  }
  return state;
}

// None where they are not asked for.
std::vector<Vec3f> randomForces(const ParityCase& c) {
  std::vector<Vec3f> forces;
  Random random(c.seed + 3000);
  for (std::size_t i = 0; c.kernel.features.forces && i < c.groom.points.size(); ++i)
    forces.push_back(static_cast<Vec3f>(random.vector() * 30.0));
  return forces;
}

// Where particles are pulled, some centimetres off the groom, or for a shape some shares of an edge, and how
// hard: up to some hundred weights, of a shape some ten, a third of them not at all. None where they are not
// asked for.
struct RandomGoals {
  explicit RandomGoals(const ParityCase& c) {
    Random random(c.seed + 4000);
    const double off = c.settings.goal.shape ? 0.001 : 0.03;  // [m]
    const float most = c.settings.goal.shape ? 10 : 300;
    for (std::size_t i = 0; c.kernel.features.goals && i < c.groom.points.size(); ++i) {
      const Vec3d way = random.vector();
      const Vec3f place = c.groom.points[i] * static_cast<float>(c.groom.metresPerUnit);
      first.push_back(place);
      second.push_back(place + static_cast<Vec3f>(way * off));
      const auto high = static_cast<float>(std::abs(way.x));
      strengths.push_back(i % 3 == 0 ? 0.f : 0.1f + most * high * high * high);
    }
  }
  template <class Hair>
  void set(Hair& hair, std::span<const Vec3f> places) const {
    if (!places.empty()) (void)hair.setGoals(places, strengths, 0.7);
  }
  std::vector<Vec3f> first, second;
  std::vector<float> strengths;
};

// In the step from `from` to `to` [s], about the head, where they are asked for.
template <class Hair>
void setSampleFields(Hair& hair, const ParityCase& c, const HeadPose& head, double from, double to) {
  if (!c.kernel.features.fields) return;
  (void)hair.setFields(sampleFields(head.position, to), sampleFields(head.position, from));
}

// On both sides.
template <class Real>
Status makeCuts(const ParityCase& c, Simulation& simulation, reference::Simulation<Real>& expected) {
  for (const std::vector<StrandCut>& cuts : c.cuts) {
    if (Status cut = simulation.cut(cuts); !cut) return cut;
    expected.cut(c.groom, c.material, cuts);
  }
  return {};
}

}  // namespace

std::vector<ForceField> sampleFields(const Vec3d& about, double seconds) {
  const auto gridOf = [](std::uint32_t seed, std::array<std::uint32_t, 3> nodes, double cell) {
    Random random(seed);
    auto made = std::make_shared<VelocityGrid>(VelocityGrid{nodes, cell, {}});
    for (std::uint32_t i = 0; i < nodes[0] * nodes[1] * nodes[2]; ++i)
      made->velocities.push_back(static_cast<Vec3f>(random.vector() * 8.0));
    return std::shared_ptr<const VelocityGrid>(std::move(made));
  };
  static const auto grid = gridOf(77, {5, 4, 6}, 0.07), other = gridOf(78, {3, 4, 2}, 0.1);
  const Vec3d moved = about + Vec3d{0.3, -0.1, 0.2} * seconds;
  const auto at = [&](double x, double y, double z) {
    return BodyPose{moved + Vec3d{x, y, z}, fromRotationVector(Vec3d{0.3, 0.2 + seconds, -0.1})};
  };
  return {
      {.name = "along", .place = at(0, 0, 0), .axis = {1, 2, 0}, .axial = 15 + 30 * seconds, .reach = 0.6},
      {.name = "point", .place = at(0.1, 0, 0), .radial = -40, .core = 0.03},
      {.name = "line",
       .place = at(0, 0, 0.1),
       .axis = {0, 0, 2},
       .aboutAxis = true,
       .radial = -30,
       .reach = 0.5},
      {.name = "vortex", .place = at(0.05, 0.1, 0), .aboutAxis = true, .around = 6, .core = 0.01, .drag = 20},
      {.name = "blast",
       .place = at(0, -0.2, 0),
       .radial = 300,
       .front = 0.1 + 3 * seconds,
       .thickness = 0.08},
      {.name = "brake", .place = at(-0.1, -0.1, 0), .reach = 0.25, .drag = 50},
      {.name = "another grid",
       .place = at(-0.05, -0.3, -0.1),
       .reach = 0.4,
       .drag = 10,
       .grid = other,
       .gridShare = 0.5},
      {.name = "grid",
       .place = at(-0.15, -0.15, -0.2),
       .reach = 0.5,
       .drag = 30,
       .grid = grid,
       .gridShare = 0.8},
  };
}

namespace {

// After a step, whose taps are kept.
std::vector<FieldError> fieldErrors(const ParityCase& c, Simulation& simulation, const HairState& found,
                                    const ReferenceF& expected) {
  double largestSpeed = 0;
  for (const auto& v : expected.velocities()) largestSpeed = std::max<double>(largestSpeed, v.norm());

  const auto tap = [&](std::uint32_t field) { return *Diagnostics(simulation).tap(field); };
  const auto smoothed = tap(layout::kTapSmoothedEdge), core = tap(layout::kTapCoreEdge),
             frames = tap(layout::kTapFrame), targets = tap(layout::kTapTarget),
             stretch = tap(layout::kTapStretchForce), bend = tap(layout::kTapBendForce),
             coreForce = tap(layout::kTapCoreForce), solved = tap(layout::kTapVelocity);
  Comparison cSmoothed("smoothed edges"), cCore("core edges"), cFrames("frames"), cTargets("targets"),
      cStretch("stretch forces"), cBend("bend forces"), cCoreForce("core forces"),
      cSolved("solved velocities"), cPositions("positions"), cVelocities("velocities");
  for (std::size_t s = 0; s < expected.restStrands().size(); ++s) {
    const auto& rest = expected.restStrands()[s];
    const auto& taps = expected.taps()[s];
    const double edge = rest.meanEdgeLength;
    const double unit = c.settings.integrator == Integrator::paper ? 1 : c.material.lineDensity * edge;
    for (std::size_t i = 0; i < rest.particleCount(); ++i) {
      const std::size_t g = expected.firstPoint()[s] + i;
      const auto v = [](const auto& x) { return Eigen::VectorXd(x.template cast<double>()); };
      cPositions.add(s, i, rest.arcLength, v(expected.positions()[g]),
                     v(reference::toEigen<float>(found.positions[g])));
      cVelocities.add(s, i, largestSpeed, v(expected.velocities()[g]),
                      v(reference::toEigen<float>(found.velocities[g])));
      if (rest.falls()) continue;
      cSolved.add(s, i, largestSpeed, v(taps.solvedVelocities[i]), three(solved[g]));
      if (i >= rest.edgeCount()) continue;
      cSmoothed.add(s, i, edge, v(taps.smoothedEdges[i]), three(smoothed[g]));
      cCore.add(s, i, edge, v(taps.coreEdges[i]), three(core[g]));
      cTargets.add(s, i, edge, v(taps.targets[i]), three(targets[g]));
      const Eigen::Vector4d q = taps.frames[i].coeffs().template cast<double>();
      const Eigen::Vector4d r(frames[g][0], frames[g][1], frames[g][2], frames[g][3]);
      cFrames.add(s, i, 1, q * (q.dot(r) < 0 ? -1 : 1), r);  // q and -q are one rotation
      const double l = rest.edgeLengths[i];
      cStretch.add(s, i, rest.stretchStiffness[i] * l, v(taps.stretchForces[i]), three(stretch[g], unit));
      cBend.add(s, i, rest.bendStiffness[i] * l, v(taps.bendForces[i]), three(bend[g], unit));
      cCoreForce.add(s, i, rest.coreStiffness[i] * l, v(taps.coreForces[i]), three(coreForce[g], unit));
    }
  }
  return {cSmoothed.result(),  cCore.result(),      cFrames.result(),    cTargets.result(),
          cStretch.result(),   cBend.result(),      cCoreForce.result(), cSolved.result(),
          cPositions.result(), cVelocities.result()};
}

}  // namespace

std::vector<FieldError> oneStepErrors(const ComputeDevice& device, ParityCase c, SimulationReport* report) {
  c.settings.framesPerSecond *= c.settings.stepsPerFrame;
  c.settings.stepsPerFrame = 1;
  c.kernel.taps = true;
  const HeadStep head = movingHead(c);
  const RootWays roots(c);
  const HairState start = startOf(c, head.now, roots);

  const double T = c.settings.stepSeconds();
  const std::vector<BodyPose> rootsNow = roots.at(0), rootsBefore = roots.at(-T), rootsNext = roots.at(T);
  const std::vector<Vec3d> shifts = rootShifts(c);
  auto simulation = Simulation::create(device, c.groom, c.material, c.settings,
                                       {.head = head.now,
                                        .oneStepEarlier = head.before,
                                        .bodies = c.bodies,
                                        .roots = rootsNow,
                                        .rootsEarlier = rootsBefore,
                                        .rootShifts = shifts},
                                       c.kernel);
  if (!simulation) return {failed("create", simulation.error())};
  if (Status set = simulation->setState(start); !set) return {failed("setState", set.error())};
  ReferenceF expected(c.groom, c.material, c.settings, head.now, head.before, {}, c.bodies);
  if (!roots.empty()) expected.placeRoots(rootsNow, rootsBefore);
  if (!shifts.empty()) expected.setRootShifts(shifts);
  expected.setState(toField<float>(start.positions), toField<float>(start.velocities));
  if (Status cut = makeCuts(c, *simulation, expected); !cut) return {failed("cut", cut.error())};
  const std::vector<Vec3f> forces = randomForces(c);
  if (!forces.empty()) {
    if (Status set = simulation->setForces(forces); !set) return {failed("setForces", set.error())};
  }
  const RandomGoals goals(c);
  for (const auto& places : {goals.first, goals.second}) goals.set(*simulation, places);
  setSampleFields(*simulation, c, head.now, 0, T);
  const std::vector<double> end{T};
  const std::vector<BodyPose> bodyPoses = bodyPosesOf(c.bodies, std::span(&head.next, 1), end);
  const std::vector<std::vector<Vec3d>> bent = bentInWorld(c.bodies, bodyPoses, end);
  const std::vector<std::span<const Vec3d>> points(bent.begin(), bent.end());
  if (Status stepped = simulation->stepFrame(std::span(&head.next, 1), bodyPoses, rootsNext, points);
      !stepped)
    return {failed("stepFrame", stepped.error())};
  const auto found = simulation->state();
  if (!found) return {failed("state", found.error())};
  if (report) *report = *simulation->report();

  if (!forces.empty()) expected.setForces(forces);
  for (const auto& places : {goals.first, goals.second}) goals.set(expected, places);
  setSampleFields(expected, c, head.now, 0, T);
  expected.stepFrame(std::span(&head.next, 1), bodyPoses, rootsNext, points);
  return fieldErrors(c, *simulation, *found, expected);
}

namespace {

FieldError positionsError(const std::vector<Vec3f>& found, const ReferenceD& expected) {
  Comparison comparison("positions");
  for (std::size_t s = 0; s < expected.restStrands().size(); ++s) {
    for (std::size_t i = 0; i < expected.restStrands()[s].particleCount(); ++i) {
      const std::size_t g = expected.firstPoint()[s] + i;
      comparison.add(s, i, expected.restStrands()[s].arcLength, expected.positions()[g],
                     reference::toEigen<double>(found[g]));
    }
  }
  return comparison.result();
}

}  // namespace

FieldError oneFrameError(const ComputeDevice& device, const ParityCase& c, int frameCount) {
  const auto pose = [&](int k) {
    const double t = k * c.settings.stepSeconds();
    return headOf(c, {0.5 * t * t, 0, 0.2 * t}, Vec3d{0, 2, 0.5} * (t * t), t);
  };
  const RootWays roots(c);
  const HairState start = startOf(c, pose(0), roots);
  const std::vector<BodyPose> rootsNow = roots.at(0), rootsBefore = roots.at(-c.settings.stepSeconds());
  const std::vector<Vec3d> shifts = rootShifts(c);
  auto simulation = Simulation::create(device, c.groom, c.material, c.settings,
                                       {.head = pose(0),
                                        .oneStepEarlier = pose(-1),
                                        .bodies = c.bodies,
                                        .roots = rootsNow,
                                        .rootsEarlier = rootsBefore,
                                        .rootShifts = shifts},
                                       c.kernel);
  if (!simulation) return failed("create", simulation.error());
  ReferenceD expected(c.groom, c.material, c.settings, pose(0), pose(-1), {}, c.bodies);
  if (!roots.empty()) expected.placeRoots(rootsNow, rootsBefore);
  if (!shifts.empty()) expected.setRootShifts(shifts);
  if (Status set = simulation->setState(start); !set) return failed("setState", set.error());
  expected.setState(toField<double>(start.positions), toField<double>(start.velocities));
  if (Status cut = makeCuts(c, *simulation, expected); !cut) return failed("cut", cut.error());
  const std::vector<Vec3f> forces = randomForces(c);
  if (!forces.empty()) {
    if (Status set = simulation->setForces(forces); !set) return failed("setForces", set.error());
    expected.setForces(forces);
  }
  const RandomGoals goals(c);
  for (int frame = 0; frame < frameCount; ++frame) {
    for (const auto& places : {goals.first, goals.second}) {
      goals.set(*simulation, places);
      goals.set(expected, places);
    }
    const double seconds = c.settings.stepsPerFrame * c.settings.stepSeconds();
    setSampleFields(*simulation, c, pose(0), frame * seconds, (frame + 1) * seconds);
    setSampleFields(expected, c, pose(0), frame * seconds, (frame + 1) * seconds);
    std::vector<BodyPose> rootPoses;
    std::vector<HeadPose> poses;
    std::vector<double> times;
    for (int k = 1; k <= c.settings.stepsPerFrame; ++k) {
      const int step = frame * c.settings.stepsPerFrame + k;
      poses.push_back(pose(step));
      times.push_back(step * c.settings.stepSeconds());
      std::ranges::copy(roots.at(times.back()), std::back_inserter(rootPoses));
    }
    const std::vector<BodyPose> bodyPoses = bodyPosesOf(c.bodies, poses, times);
    const std::vector<std::vector<Vec3d>> bent = bentInWorld(c.bodies, bodyPoses, times);
    const std::vector<std::span<const Vec3d>> points(bent.begin(), bent.end());
    if (Status stepped = simulation->stepFrame(poses, bodyPoses, rootPoses, points); !stepped)
      return failed("stepFrame", stepped.error());
    expected.stepFrame(poses, bodyPoses, rootPoses, points);
  }
  const auto found = simulation->positions();
  if (!found) return failed("positions", found.error());
  return positionsError(*found, expected);
}

std::string toText(const std::vector<FieldError>& errors) {
  std::string text;
  for (const FieldError& e : errors)
    text += fmt::format("{}{} {:.1e}", text.empty() ? "" : ", ", e.field, e.error);
  return text;
}

}  // namespace ringlet::parity
