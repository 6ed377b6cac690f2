// Implements conform_cases.h.
#include "program/device/conform_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "parity/contacts.h"
#include "parity/parity.h"
#include "parity/sample_bodies.h"
#include "parity/tolerances.h"
#include "program/device/planned_shapes.h"
#include "ringlet/base/stopwatch.h"

namespace ringlet::program {
namespace {

using Outcome = Check::Outcome;
// Adds up the time between begin and end.
class CompileClock : public CompileObserver {
 public:
  void begin(std::size_t) override { watch_.emplace(milliseconds_); }
  void end() override { watch_.reset(); }
  double seconds() const { return milliseconds_ / 1000; }

 private:
  double milliseconds_ = 0;
  std::optional<Stopwatch> watch_;
};

// NaN counts as wrong.
Check compared(const std::string& name, double figure, double tolerance, const std::string& detail,
               const std::string& where, double compileSeconds) {
  const bool isRight = figure <= tolerance;
  return {.name = name,
          .outcome = isRight ? Outcome::right : Outcome::wrong,
          .figure = figure,
          .tolerance = tolerance,
          .detail = isRight ? detail : fmt::format("{}; {}", detail, where),
          .compileSeconds = compileSeconds};
}

void checkStep(const ComputeDevice& device, parity::ParityCase c, const std::string& name, double tolerance,
               const Tell& tell) {
  CompileClock clock;
  c.kernel.observer = &clock;
  const auto errors = parity::oneStepErrors(device, c);
  const auto worst = std::ranges::max_element(
      errors, {}, [](const auto& e) { return std::isnan(e.error) ? INFINITY : e.error; });
  tell(compared(name + ": a step", worst->error, tolerance, "worst: " + worst->field, worst->where,
                clock.seconds()));
}

void checkFrame(const ComputeDevice& device, parity::ParityCase c, const std::string& name, double tolerance,
                const Tell& tell) {
  CompileClock clock;
  c.kernel.observer = &clock;
  const parity::FieldError e = parity::oneFrameError(device, c);
  tell(compared(name + ": a frame", e.error, tolerance, e.field, e.where, clock.seconds()));
}

// FNV-1a over the positions after two frames.
Result<std::uint64_t> hashOfRun(const ComputeDevice& device, const parity::ParityCase& c) {
  auto simulation = Simulation::create(device, c.groom, c.material, c.settings, {}, c.kernel);
  if (!simulation) return simulation.error();
  for (int frame = 1; frame <= 2; ++frame) {
    const HeadPose head{{0, 0, 0.03 * std::sin(0.5 * frame)}, fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
    if (Status stepped = simulation->stepFrame(head); !stepped) return stepped.error();
  }
  const auto positions = simulation->positions();
  if (!positions) return positions.error();
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Vec3f& p : *positions) {
    std::uint32_t words[3];
    std::memcpy(words, &p, sizeof words);
    for (const std::uint32_t word : words) hash = (hash ^ word) * 0x100000001b3;
  }
  return hash;
}

// The same run on two devices, or twice on one.
void checkSameBits(const ComputeDevice& one, const ComputeDevice& other, parity::ParityCase c,
                   const std::string& name, const Tell& tell) {
  CompileClock clock;
  c.kernel.observer = &clock;
  const auto first = hashOfRun(one, c);
  if (!first) return tell(failed(name, first.error()));
  const auto second = hashOfRun(other, c);
  if (!second) return tell(failed(name, second.error()));
  const bool isSame = *first == *second;
  tell({.name = name,
        .outcome = isSame ? Outcome::right : Outcome::wrong,
        .detail =
            isSame ? fmt::format("{:016x}", *first) : fmt::format("{:016x} and {:016x}", *first, *second),
        .compileSeconds = clock.seconds()});
}

StrandShape serialShape(const DeviceLimits& limits) {
  return {.lanes = 1, .particlesPerLane = std::min(128u, limits.longestRunInMemory), .inMemory = true};
}

// Strands of these lengths, but at most `longest` particles.
Groom randomGroom(std::vector<int> lengths, std::uint32_t longest, unsigned seed) {
  for (int& length : lengths) length = std::min(length, static_cast<int>(longest));
  return parity::randomGroom(lengths, seed);
}

// Full strands, strands that end near the end of a lane, and short ones.
Groom groomOf(const StrandShape& shape) {
  if (shape.serial()) return randomGroom({2, 3, 31, 64, 100, 16, 17, 65, 128}, shape.capacity(), 7);
  const int run = static_cast<int>(shape.particlesPerLane), all = static_cast<int>(shape.capacity());
  std::vector<int> lengths;
  for (const int length : {all, 2, all - 1, run + 1, run, 3, all / 2 + 1, all})
    lengths.push_back(std::clamp(length, 2, all));
  return parity::randomGroom(lengths, 7);
}

KernelChoice kernelOf(const StrandShape& shape) {
  using Form = KernelChoice::Form;
  return {.form = shape.serial()   ? Form::serial
                  : shape.inMemory ? Form::memory
                                   : Form::lanes,
          .particlesPerLane = static_cast<int>(shape.particlesPerLane),
          .lanes = static_cast<int>(shape.lanes)};
}

Settings usualSettings() {
  Settings settings;
  settings.gravityPreload = 0.7;
  return settings;
}

struct ShapeCase {
  StrandShape shape;
  std::string name;
  Material material{};  // decides whether the shape is asked for by hair alone or by other work
  bool withStorage = false;
  double oneStep = parity::kOneStep;
};

void checkShape(const ConformCases& cases, const ShapeCase& of, const Tell& tell) {
  const parity::ParityCase c{groomOf(of.shape), of.material, usualSettings(), kernelOf(of.shape)};
  checkStep(cases.device, c, of.name, of.oneStep, tell);
  checkFrame(cases.device, c, of.name, parity::kOneFrame, tell);
  checkSameBits(cases.device, cases.device, c, of.name + ": the same bits again", tell);
  if (of.withStorage)
    checkSameBits(cases.device, cases.withoutTexels, c, of.name + ": the same bits without texels", tell);
}

void checkShapes(const ConformCases& cases, const Tell& tell) {
  const DeviceLimits limits = cases.device.limits();
  const std::uint32_t one[] = {64};
  const auto lengths = cases.quick ? std::span<const std::uint32_t>(one) : std::span(kUsualLengths);
  for (const StrandWork work : {StrandWork::hairAlone, StrandWork::plain}) {
    if (cases.quick && work != StrandWork::hairAlone) continue;
    const Material material = work == StrandWork::hairAlone ? Material{} : parity::varyingMaterial();
    for (const StrandShape& shape : plannedShapes(limits, work, lengths)) {
      if (shape.serial()) continue;  // checked below, whether it is planned or not
      const bool holdsSixtyFour = shape == plannedShapes(limits, work, one).front();
      const char* hair = work == StrandWork::hairAlone ? "hair alone" : "stiffness that varies";
      checkShape(cases,
                 {.shape = shape,
                  .name = fmt::format("{}, {}", hair, shape.describe()),
                  .material = material,
                  .withStorage = work == StrandWork::hairAlone && holdsSixtyFour},
                 tell);
    }
  }
  checkShape(cases, {.shape = serialShape(limits), .name = "hair alone, serial", .withStorage = !cases.quick},
             tell);
  if (cases.quick || !limits.hasSubgroupShuffle || limits.subgroupSize == 1) return;
  const StrandShape widest{.lanes = limits.subgroupSize,
                           .particlesPerLane = std::min(48u, limits.longestRunInMemory),
                           .inMemory = true};
  checkShape(cases,
             {.shape = widest,
              .name = "hair alone, " + widest.describe(),
              .oneStep = parity::oneStepOf(widest.capacity())},
             tell);
}

// `count` random points in a cube of `side` [m].
void checkLists(const ComputeDevice& device, int count, double side, const Tell& tell) {
  const std::string name = fmt::format("contact lists of {} points in {} mm", count, 1000 * side);
  std::mt19937 engine(7);
  std::vector<Vec3f> points;
  const auto coordinate = [&] { return side * static_cast<double>(engine()) / 4294967295.0; };
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.push_back(Vec3f(Vec3d{x, y, z}));
  }
  const auto lists = parity::compareLists(device, points);
  if (!lists) return tell(failed(name, lists.error()));
  const auto wrong = static_cast<double>(lists->missed + lists->extra + lists->repeated);
  tell(compared(name, wrong, 0, fmt::format("of {} pairs", lists->near),
                fmt::format("{} missed, {} too many, {} not once on each side", lists->missed, lists->extra,
                            lists->repeated),
                0));
}

// Frames of a shaken swatch whose strands touch.
void checkMeeting(const ConformCases& cases, const Settings& settings, const std::string& what,
                  const Tell& tell) {
  constexpr int kFrames = 3;
  CompileClock clock;
  KernelChoice kernel;
  kernel.observer = &clock;
  ContactReport report;
  const auto apart =
      parity::shakenError(cases.device, parity::denseSwatch(32), settings, kernel, kFrames,
                          [&](const Simulation& simulation, const reference::Simulation<double>&) {
                            if (const auto now = simulation.contactReport()) report = *now;
                          });
  const std::string name = fmt::format("{}: {} frames [m]", what, kFrames);
  if (!apart) return tell(failed(name, apart.error()));
  const std::string done = report.volumeStrands > 0 ? fmt::format("{} strands", report.volumeStrands)
                                                    : fmt::format("{} contacts", report.contacts);
  tell(compared(name, *apart, parity::kMeetingMetres, done, "positions", clock.seconds()));
}

void checkContacts(const ConformCases& cases, const Tell& tell) {
  checkLists(cases.device, 1000, 0.12, tell);  // some 1,400 pairs
  checkLists(cases.device, 300, 0.01, tell);   // each close to all others
  const Settings pairs = parity::meetingSettings();
  Settings volume = pairs;
  volume.contacts.method = ContactMethod::volume;
  for (const auto& [settings, what] : {std::pair{pairs, "contacts"}, std::pair{volume, "a volume"}}) {
    const parity::ParityCase swatch{parity::denseSwatch(32), {}, settings, {}};
    checkSameBits(cases.device, cases.device, swatch, fmt::format("{}: the same bits again", what), tell);
    if (cases.quick) continue;
    checkSameBits(cases.device, cases.withoutTexels, swatch,
                  fmt::format("{}: the same bits without texels", what), tell);
    checkMeeting(cases, settings, what, tell);
  }
  if (cases.quick) return;
  for (const ContactTaper taper : {ContactTaper::distance, ContactTaper::time}) {
    Settings atOnce = pairs;
    atOnce.contacts.taper = taper;
    atOnce.contacts.rampSeconds = 0;  // in full from the first step
    checkStep(cases.device, {parity::randomGroom({64, 31, 64, 17, 2, 64, 33, 64, 3}, 3), {}, atOnce, {}, 5},
              taper == ContactTaper::time ? "contacts, time taper" : "contacts", parity::kOneStep, tell);
  }
}

// A sphere and a box that strands of 25 cm hang into.
std::vector<Body> bodiesAmongStrands() {
  std::vector<Body> bodies;
  for (const Body& shape : parity::sampleBodies()) {
    if (shape.shape != BodyShape::sphere && shape.shape != BodyShape::box) continue;
    bodies.push_back(shape);
    bodies.back().place = {Vec3d{0.02, -0.2, 0.03} + Vec3d{0.05, -0.02, 0.01} * double(bodies.size()),
                           fromRotationVector(Vec3d{0.3, 0.2, -0.4})};
  }
  return bodies;
}

void checkSurroundings(const ConformCases& cases, const Tell& tell) {
  for (const bool isSerial : {false, true}) {
    const std::uint32_t longest = isSerial ? serialShape(cases.device.limits()).capacity() : 64;
    parity::ParityCase c{randomGroom({64, 31, 50, 64, 2, 33}, longest, 13), {}, usualSettings(), {}, 4};
    if (isSerial) c.kernel.form = KernelChoice::Form::serial;
    const char* form = isSerial ? ", serial" : "";
    parity::ParityCase pulled = c;
    pulled.kernel.features.forces = true;
    checkStep(cases.device, pulled, fmt::format("forces from outside{}", form), parity::kOneStep, tell);
    parity::ParityCase aimed = c;
    aimed.kernel.features.goals = true;
    checkStep(cases.device, aimed, fmt::format("goals{}", form), parity::kOneStep, tell);
    parity::ParityCase inFields = c;
    inFields.kernel.features.fields = true;
    checkStep(cases.device, inFields, fmt::format("fields{}", form), parity::kOneStep, tell);
    parity::ParityCase airy = c;
    airy.settings.air = {.on = true, .fallSpeed = 2, .wind = {5, 0, 1}, .gust = 0.5, .turbulence = 2};
    checkStep(cases.device, airy, fmt::format("air{}", form), parity::kOneStep, tell);
    c.bodies = bodiesAmongStrands();
    c.settings.air = {.on = true, .fallSpeed = 3, .wind = {2, 0, 1}, .turbulence = 1};
    const std::string name = fmt::format("bodies in air{}", form);
    checkStep(cases.device, c, name, parity::kOneStepAmongBodies, tell);
    checkFrame(cases.device, c, name, parity::kOneFrameAmongBodies, tell);
  }
}

}  // namespace

void runCases(const ConformCases& cases, const Tell& tell) {
  checkShapes(cases, tell);
  checkContacts(cases, tell);
  if (!cases.quick) checkSurroundings(cases, tell);
}

}  // namespace ringlet::program
