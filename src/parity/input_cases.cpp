// Implements parity/input_cases.h.
#include "parity/input_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "parity/contacts.h"
#include "parity/sample_bodies.h"
#include "parity/tolerances.h"

namespace ringlet::parity {
namespace {

// The worst field of a step.
InputCase step(std::string name, const ParityCase& c, double tolerance = kOneStep) {
  return {std::move(name), tolerance, [c](const ComputeDevice& device) {
            const std::vector<FieldError> errors = oneStepErrors(device, c);
            return *std::ranges::max_element(
                errors, {}, [](const FieldError& e) { return std::isnan(e.error) ? INFINITY : e.error; });
          }};
}

InputCase frames(std::string name, const ParityCase& c, int count = 1, double tolerance = kOneFrame) {
  return {std::move(name), tolerance,
          [c, count](const ComputeDevice& device) { return oneFrameError(device, c, count); }};
}

// Strands that are shaken into each other.
InputCase meeting(std::string name, const Groom& groom, const Settings& settings, int count = 2) {
  return {std::move(name), kMeetingMetres, [=](const ComputeDevice& device) {
            const auto apart = shakenError(device, groom, settings, {}, count, [](auto&, auto&) {});
            return apart ? FieldError{"positions", *apart, "in some frame"}
                         : FieldError{"shaken", INFINITY, apart.error().message};
          }};
}

Groom someStrands() { return randomGroom({33, 64, 31, 17, 2, 50}, 13); }

Material otherMaterial() {
  Material material = varyingMaterial();
  material.coreRelaxedShare = 0.4;
  material.coreElongationLow = 1.02;
  material.coreElongationHigh = 1.2;
  material.gravityFactor = 0.8;
  return material;
}

Settings otherSettings() {
  Settings settings;
  settings.framesPerSecond = 30;
  settings.stepsPerFrame = 5;
  settings.gravity = {1, -8, 2};
  settings.gravityPreload = 0.7;
  settings.maxStretch = 1.05;
  settings.rootCount = 3;
  return settings;
}

// A head that was turned, with roots that go their ways beside it.
ParityCase turnedCase() {
  ParityCase c{someStrands(), otherMaterial(), otherSettings(), {}};
  c.turned = fromRotationVector(Vec3d{1.2, -0.4, 0.8});
  c.shiftsRoots = true;
  return c;
}

// One of each shape that strands of 25 cm hang into, turned, with a surface of its own; one of them, with its
// middle far from its origin, and one that goes through the world by itself.
std::vector<Body> bodiesAmongStrands() {
  const Vec3d beside{0.1, -0.3, 0.2};
  std::vector<Body> bodies = sampleBodies();
  bodies.push_back(gridBall(0.06, 0.01, beside));
  bodies.push_back(gridBall(0.07, 0.01));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Body& body = bodies[b];
    body.friction = 0.1 * double(b + 1);
    body.thickness = 0.001 * double(b + 1);
    body.place = {Vec3d{0.1 * std::cos(double(b)), -0.22, 0.1 * std::sin(double(b))},
                  fromRotationVector(Vec3d{0.3, 0.2, -0.4} * double(b + 1))};
  }
  bodies[2].place = {{0, -0.45, 0}, fromRotationVector(Vec3d{0.2, 0, 0.1})};  // the plane, below
  Body& far = bodies[5];
  far.place.rotation = fromRotationVector(Vec3d{0, std::numbers::pi, 0.4});
  far.place.position = Vec3d{0.02, -0.2, 0.03} - rotate(far.place.rotation, beside);
  bodies.back().motion =
      Motion{.kind = MotionKind::glide, .axis = {0, 1, 0}, .amplitude = 3, .start = {3, 0.7, 0}};
  bodies.back().place.position = {-0.05, 0, -0.04};
  return bodies;
}

// All that acts on hair by itself, in one case.
ParityCase surroundedCase() {
  ParityCase c{
      someStrands(), {}, {}, {.features = {.roots = true, .forces = true, .goals = true, .fields = true}}};
  c.settings.air = {
      .on = true, .fallSpeed = 3, .alongShare = 0.2, .wind = {2, -0.5, 1}, .gust = 0.5, .turbulence = 1};
  c.bodies = bodiesAmongStrands();
  return c;
}

Settings otherContacts() {
  Settings settings = meetingSettings();
  settings.framesPerSecond = 30;
  settings.contacts.stiffness = 800;
  settings.contacts.dampingRatio = 0.8;
  settings.contacts.friction = 0.3;
  settings.contacts.iterations = 3;
  return settings;
}

Settings fadingContacts() {
  Settings settings = otherContacts();
  settings.contacts.taper = ContactTaper::time;
  settings.contacts.rampSeconds = 0.03;
  settings.contacts.stiffnessReleaseSeconds = 0.05;
  settings.contacts.dampingReleaseSeconds = 0.07;
  settings.contacts.breakFactor = 1.3;
  return settings;
}

Settings volumeSettings() {
  Settings settings = meetingSettings();
  settings.contacts.method = ContactMethod::volume;
  return settings;
}

Settings otherVolume() {
  Settings settings = volumeSettings();
  settings.framesPerSecond = 30;
  settings.rootCount = 3;
  settings.contacts.volumeCell = 0.02;
  settings.contacts.volumeDrag = 100;
  settings.contacts.volumeStiffness = 5e3;
  settings.contacts.volumeMemorySeconds = 0.2;
  settings.contacts.iterations = 2;
  return settings;
}

void addHairAlone(std::vector<InputCase>& cases) {
  cases.push_back(frames("plain hair", {someStrands(), {}, {}, {}}));
  cases.push_back(step("turned, roots shifted, another material", turnedCase()));
  cases.push_back(frames("turned, roots shifted, another material", turnedCase(), 2));
  ParityCase point{someStrands(), {}, {}, {}};
  point.settings.integrator = Integrator::pointJacobi;
  point.settings.pointIterations = 20;
  point.settings.chebyshev = false;
  cases.push_back(step("point Jacobi", point));
  ParityCase paper{someStrands(), {}, {}, {}};
  paper.settings.integrator = Integrator::paper;
  paper.settings.stepsPerFrame = 30;
  paper.settings.gravityPreload = 0;
  paper.settings.forceLoops = 18, paper.settings.dampingLoops = 12;
  cases.push_back(step("the paper's", paper));
  ParityCase heads = turnedCase();
  heads.kernel.heads = 4;
  cases.push_back(frames("one of many heads", heads));
  heads.groom = randomGroom({20, 64, 33, 48, 12, 31, 64, 5, 27, 40}, 17);
  cases.push_back(frames("one of many heads, another groom", heads));
  cases.push_back(frames("long and short strands", {randomGroom({300, 12, 64, 200, 5}, 19), {}, {}, {}}));
}

void addSurroundings(std::vector<InputCase>& cases) {
  cases.push_back(step("among all that acts", surroundedCase(), kOneStepAmongBodies));
  cases.push_back(frames("among all that acts", surroundedCase(), 2, kOneFrameAmongBodies));
  ParityCase heads = surroundedCase();
  heads.kernel = {.heads = 4, .features = {.goals = true, .fields = true}};
  cases.push_back(frames("one of many heads among all that acts", heads, 1, kOneFrameAmongBodies));
  ParityCase lying{someStrands(), {}, {}, {.features = {.goals = true}}};
  lying.settings.goal.shape = true;
  cases.push_back(step("goals of edges", lying));
  ParityCase cut = surroundedCase();
  cut.kernel = {};
  cut.settings.air.on = false;
  cut.turned = fromRotationVector(Vec3d{0.5, 2, -1});
  cut.cuts = {{{0, 20}, {1, 30}}, {{1, 12}}};
  cases.push_back(step("cut on a turned head", cut, kOneStepAmongBodies));
}

// Two bodies that bend, each with a field of its own, and one that does not; two of cloth, below the hair.
void addBending(std::vector<InputCase>& cases) {
  ParityCase c{someStrands(), {}, {}, {}};
  c.bodies = {bendingBall(0.1, 0.006), bendingBall(0.08, 0.007), gridBall(0.06, 0.01)};
  for (std::size_t b = 0; b < c.bodies.size(); ++b)
    c.bodies[b].place = {Vec3d{0.1 * std::cos(2.0 * double(b)), -0.22, 0.1 * std::sin(2.0 * double(b))},
                         fromRotationVector(Vec3d{0.3, 0.2, -0.4} * double(b + 1))};
  for (const double below : {0.5, 0.6}) c.bodies.push_back(sheet(0.2, {0, -below, 0}));
  cases.push_back(step("bodies that bend", c, kOneStepAmongBodies));
}

void addContacts(std::vector<InputCase>& cases) {
  const Groom swatch = denseSwatch(32);
  cases.push_back(meeting("contacts", swatch, meetingSettings()));
  cases.push_back(meeting("contacts, other settings", swatch, otherContacts()));
  Settings fading = meetingSettings();
  fading.contacts.taper = ContactTaper::time;
  cases.push_back(meeting("contacts that fade", swatch, fading));
  cases.push_back(meeting("contacts that fade, other settings", swatch, fadingContacts()));
  for (const Settings& all : {meetingSettings(), fading}) {
    Settings pruned = all;
    pruned.contacts.prunePairs = true;
    pruned.contacts.minOverlaps = 20;
    const bool fades = all.contacts.taper == ContactTaper::time;
    cases.push_back(meeting(fades ? "pruned contacts that fade" : "pruned contacts", swatch, pruned));
    Settings dense = all;
    // At other radii and in longer runs a pair is found a step apart: 1e-6 to 2e-5 m.
    dense.contacts.radius = fades ? 0.006 : 0.008;
    dense.framesPerSecond = 96, dense.stepsPerFrame = 2;
    cases.push_back(meeting(fades ? "contacts of dense hair that fade" : "contacts of dense hair",
                            bunchAndStrands(), dense, 1));
  }
  Settings thinned = meetingSettings();
  thinned.contacts.radius = 0.0015;
  thinned.contacts.detail = 0.5;
  cases.push_back(meeting("thinned contacts", bunchAndStrands(), thinned));
  cases.push_back(meeting("a volume", swatch, volumeSettings()));
  cases.push_back(meeting("a volume, other settings", swatch, otherVolume()));
  Settings beside = meetingSettings();
  beside.contacts.method = ContactMethod::automatic;
  cases.push_back(meeting("a volume beside contacts", bunchAndStrands(), beside));
}

}  // namespace

std::vector<InputCase> inputCases() {
  std::vector<InputCase> cases;
  addHairAlone(cases);
  addSurroundings(cases);
  addBending(cases);
  addContacts(cases);
  return cases;
}

std::vector<InputCase> readbackCases() {
  ParityCase cut{someStrands(), {}, {}, {.mostBufferBytes = 2048}};
  return {frames("plain hair", {someStrands(), {}, {}, {}}), frames("in buffers of 2 KiB", cut)};
}

}  // namespace ringlet::parity
