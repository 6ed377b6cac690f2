// Implements simulate_run.h.
#include "program/simulate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "program/backend.h"
#include "program/interruption.h"
#include "program/load_scene.h"
#include "program/progress_bar.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/output/finite_points.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/output/sheet.h"
#include "ringlet/output/usd_writer.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet::program {
namespace {

// Adds the wall time until it goes out of scope to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& milliseconds) : milliseconds_(milliseconds) {}
  ~Stopwatch() {
    milliseconds_ +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;

 private:
  double& milliseconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Where head, bodies and roots are at the end of every step of a frame.
struct FramePoses {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies;  // as bodyPosesOf gives them
  std::vector<BodyPose> roots;   // as Simulation::stepFrame takes them

  /// Steps [first, first + count) of them.
  Status step(Backend& backend, std::size_t first, std::size_t count) const {
    const auto ofSteps = [&](const std::vector<BodyPose>& poses) {
      const std::size_t each = poses.size() / heads.size();
      return std::span(poses).subspan(first * each, count * each);
    };
    return backend.stepFrame(std::span(heads).subspan(first, count), ofSteps(bodies), ofSteps(roots));
  }
  Status step(Backend& backend) const { return step(backend, 0, heads.size()); }
  std::span<const BodyPose> bodiesAtEnd() const {
    return std::span(bodies).last(bodies.size() / heads.size());
  }
};

// Times are exact quotients, so they do not drift.
FramePoses posesOfFrame(const RunInput& input, int frame) {
  const Settings& settings = input.settings;
  FramePoses poses;
  std::vector<double> times;
  for (int step = 1; step <= settings.stepsPerFrame; ++step) {
    const double steps = static_cast<double>(frame) * settings.stepsPerFrame + step;
    times.push_back(steps / (settings.framesPerSecond * settings.stepsPerFrame));
    poses.heads.push_back(input.motion.poseAt(times.back()));
    if (input.scalp)
      std::ranges::copy(input.scalp->rootPosesAt(times.back()), std::back_inserter(poses.roots));
  }
  poses.bodies = bodyPosesOf(input.bodies, poses.heads, times);
  return poses;
}

// From the solver's frame (metres, seen from the head's origin) to the file's.
std::vector<Vec3f> toFile(std::span<const Vec3f> positions, const HeadPose& head, double metresPerUnit) {
  std::vector<Vec3f> points;
  points.reserve(positions.size());
  for (Vec3f p : positions) points.push_back(Vec3f((head.position + Vec3d(p)) / metresPerUnit));
  return points;
}

// The paper's loops solve no system; contacts, air and bodies have one of other terms; the reference does not
// measure.
bool measuresResidual(const RunInput& input, const RunOptions& options) {
  return options.kernel.residual && !options.onReference && !input.settings.contacts.on &&
         !input.settings.air.on && input.bodies.empty() && input.settings.integrator != Integrator::paper;
}

// The same steps, each a frame of its own: so that each can be looked at.
Settings stepByStep(Settings settings) {
  settings.framesPerSecond *= settings.stepsPerFrame;
  settings.stepsPerFrame = 1;
  return settings;
}

// Frames before the first, in which nothing is written.
int preRollFrames(const RunInput& input, const RunOptions& options) {
  return static_cast<int>(std::ceil(options.preRollSeconds * input.settings.framesPerSecond - 1e-6));
}

Result<std::unique_ptr<Backend>> makeBackend(const RunInput& input, const RunOptions& options) {
  const double start = -preRollFrames(input, options) / input.settings.framesPerSecond;
  const Settings settings = options.measuresContacts ? stepByStep(input.settings) : input.settings;
  const HeadPose head = input.motion.poseAt(start);
  const std::vector<BodyPose> bodies = bodyPosesOf(input.bodies, std::span(&head, 1), std::span(&start, 1));
  const double earlier = start - settings.stepSeconds();
  std::vector<BodyPose> roots, rootsEarlier;
  if (input.scalp) roots = input.scalp->rootPosesAt(start), rootsEarlier = input.scalp->rootPosesAt(earlier);
  const BackendInput made{input.groom,      input.material, settings, head,  input.motion.poseAt(earlier),
                          input.rootShifts, input.bodies,   bodies,   roots, rootsEarlier};
  if (options.onReference) return makeReferenceBackend(made);
  KernelChoice kernel = options.kernel;
  kernel.residual = measuresResidual(input, options);
  return makeGpuBackend(made, options.device, kernel);
}

// The motion up to the first frame, so that hair begins it as it moves.
Status preRoll(Backend& backend, const RunInput& input, const RunOptions& options) {
  for (int frame = -preRollFrames(input, options); frame < 0 && !wasInterrupted(); ++frame) {
    const FramePoses poses = posesOfFrame(input, frame);
    const std::size_t together = options.measuresContacts ? 1 : poses.heads.size();  // as makeBackend says
    for (std::size_t step = 0; step < poses.heads.size(); step += together) {
      if (Status stepped = poses.step(backend, step, together); !stepped) return stepped;
    }
  }
  return {};
}

// Steps hair and, where contacts are to be measured, looks at every step.
class Stepper {
 public:
  static Result<Stepper> make(Backend& backend, const RunInput& input, const RunOptions& options) {
    Stepper stepper(backend, input.settings.contacts.on);
    if (!options.measuresContacts) return stepper;
    auto watch = ContactWatch::make(input.groom, input.material, input.settings);
    if (!watch) return watch.error();
    stepper.watch_.emplace(std::move(*watch));
    if (Status seen = stepper.look(); !seen) return seen.error();
    return stepper;
  }

  Status stepFrame(const FramePoses& poses) {
    if (!watch_) {
      Stopwatch stopwatch(stepping_);
      return poses.step(*backend_);
    }
    for (std::size_t step = 0; step < poses.heads.size(); ++step) {
      {
        Stopwatch stopwatch(stepping_);
        if (Status stepped = poses.step(*backend_, step, 1); !stepped) return stepped;
      }
      if (Status seen = look(); !seen) return seen;
    }
    Stopwatch stopwatch(measuring_);
    if (!watch_->endFrame() || !hasContacts_) return {};
    auto report = backend_->contactReport();
    if (!report) return report.error();
    worst_ = *report;
    return {};
  }

  /// What was seen goes into the outcome.
  Status tell(SimulateOutcome& outcome) const {
    outcome.millisecondsPerFrame = stepping_;
    if (hasContacts_) {
      auto report = backend_->contactReport();
      if (!report) return report.error();
      if (watch_) report->contacts = worst_.contacts, report->momentumError = worst_.momentumError;
      outcome.contacts = *report;
    }
    if (watch_) {
      outcome.contactNumbers = watch_->numbers();
      outcome.stages["measure"] = measuring_;
    }
    return {};
  }

  /// Steps that are frames of their own would be called wrong numbers of steps a frame.
  std::vector<std::string> warnings() const { return watch_ ? watch_->warnings() : backend_->warnings(); }

 private:
  Stepper(Backend& backend, bool hasContacts) : backend_(&backend), hasContacts_(hasContacts) {}

  Status look() {
    Stopwatch stopwatch(measuring_);
    auto positions = backend_->positions();
    if (!positions) return positions.error();
    watch_->addStep(*positions);
    return {};
  }

  Backend* backend_;
  bool hasContacts_;
  std::optional<ContactWatch> watch_;
  ContactReport worst_;
  double stepping_ = 0, measuring_ = 0;  // [ms]
};

// A failure in the middle of a run, with what it leaves.
Error afterFrames(int frameCount, const Error& cause, const RunOptions& options) {
  if (frameCount == 0 || options.folder.empty() || !options.writesUsd) return cause;
  return Error{fmt::format("{} (the first {} frames are kept in {})", cause.message, frameCount,
                           (options.folder / "hair.usda.partial").string())};
}

// The writers of a run, so that the loop below reads as what happens to a frame.
struct Writers {
  std::optional<UsdWriter> usd;
  std::optional<Sheet> sheet;
  bool writesLast;
  std::vector<Vec3f> lastPoints;  // [file unit]

  Status addFrame(int frame, std::vector<Vec3f> points) {
    if (sheet) sheet->offer(frame, points);
    lastPoints = std::move(points);
    return usd ? usd->addFrame(lastPoints) : Status{};
  }

  Result<std::vector<std::filesystem::path>> finish(const std::filesystem::path& folder, const Groom& groom) {
    std::vector<std::filesystem::path> written;
    if (usd) {
      if (Status done = usd->finish(); !done) return done.error();
      written.push_back(folder / "hair.usda");
    }
    if (writesLast) {
      written.push_back(folder / "last.obj");
      if (Status done = writeObj(written.back(), groom, lastPoints); !done) return done.error();
    }
    if (sheet) {
      written.push_back(folder / "sheet.png");
      if (Status done = sheet->write(written.back()); !done) return done.error();
    }
    return written;
  }
};

Result<Writers> openWriters(const RunInput& input, const RunOptions& options) {
  const double metresPerUnit = input.groom.metresPerUnit;
  std::error_code code;
  std::filesystem::create_directories(options.folder, code);
  if (code)
    return Error{fmt::format("cannot create the folder {}: {}", options.folder.string(), code.message())};
  Writers writers{{}, {}, options.writesLast, {}};
  if (options.writesUsd) {
    auto usd = UsdWriter::create(options.folder / "hair.usda", input.groom,
                                 {.framesPerSecond = input.settings.framesPerSecond,
                                  .metresPerUnit = metresPerUnit,
                                  .up = options.up,
                                  .diameter = static_cast<float>(options.width / metresPerUnit),
                                  .frameCount = options.frameCount});
    if (!usd) return usd.error();
    writers.usd.emplace(std::move(*usd));
  }
  if (options.writesSheet) writers.sheet.emplace(input.groom, options.frameCount, options.up);
  return writers;
}

// Where keys are further apart than a head goes, it jumps: on a smooth way it would only be fast.
void cutJumps(const Settings& settings, Motion& motion) {
  if (!motion.keyframes || settings.teleportDistance <= 0) return;
  Keyframes keys = *motion.keyframes;
  keys.cutSpeed = settings.teleportDistance * settings.framesPerSecond;
  motion.keyframes = std::make_shared<const Keyframes>(std::move(keys));
}

}  // namespace

Result<SimulateOutcome> runHair(const RunInput& input, const RunOptions& options,
                                const FrameObserver& observer) {
  const Groom& groom = input.groom;
  SimulateOutcome outcome;
  outcome.strandCount = groom.strandCount();
  outcome.particleCount = groom.points.size();
  catchInterruption();

  // Everything that can fail before the first step: the folder, the device.
  std::optional<Writers> writers;
  if (!options.folder.empty()) {
    auto opened = openWriters(input, options);
    if (!opened) return opened.error();
    writers.emplace(std::move(*opened));
  }
  auto backend = makeBackend(input, options);
  if (!backend) return backend.error();
  if (Status rolled = preRoll(**backend, input, options); !rolled) return rolled.error();
  const std::map<std::string, double> stagesBefore = (*backend)->stageMilliseconds();
  auto stepper = Stepper::make(**backend, input, options);
  if (!stepper) return stepper.error();

  // Frames, until all are done or Ctrl-C comes.
  double readback = 0, writing = 0, watching = 0, following = 0;  // [ms]
  std::optional<BodyWatch> bodyWatch;
  if (!input.bodies.empty()) bodyWatch.emplace(groom, input.bodies, input.settings.rootCount);
  std::size_t mostReplaced = 0;
  std::vector<Vec3f> positions;
  {
    ProgressBar progress(options.frameCount, options.showProgress);
    for (int frame = 0; frame < options.frameCount && !wasInterrupted(); ++frame) {
      progress.show(frame);
      const FramePoses poses = [&] {
        Stopwatch watch(following);
        return posesOfFrame(input, frame);
      }();
      if (Status stepped = stepper->stepFrame(poses); !stepped)
        return afterFrames(frame, stepped.error(), options);
      {
        Stopwatch watch(readback);
        auto read = (*backend)->positions();
        if (!read) return afterFrames(frame, read.error(), options);
        positions = std::move(*read);
      }
      if (bodyWatch) {
        Stopwatch watch(watching);
        bodyWatch->look(positions, poses.heads.back(), poses.bodiesAtEnd());
      }
      Stopwatch watch(writing);
      std::vector<Vec3f> points = toFile(positions, poses.heads.back(), groom.metresPerUnit);
      mostReplaced = std::max(mostReplaced, replaceNonfinite(groom, points));
      if (observer) {
        if (Status seen = observer(points, poses.heads.back()); !seen)
          return afterFrames(frame, seen.error(), options);
      }
      if (writers) {
        if (Status added = writers->addFrame(frame + 1, std::move(points)); !added) return added.error();
      }
      outcome.frameCount = frame + 1;
    }
    progress.show(outcome.frameCount);
  }
  outcome.interrupted = wasInterrupted() && outcome.frameCount < options.frameCount;

  // What there is becomes files.
  if (writers && outcome.frameCount > 0) {
    Stopwatch watch(writing);
    auto outputs = writers->finish(options.folder, groom);
    if (!outputs) return outputs.error();
    outcome.outputs = std::move(*outputs);
  }

  // And numbers.
  auto report = (*backend)->report();
  if (!report) return report.error();
  outcome.report = *report;
  outcome.report.nonfinite = std::max<std::uint64_t>(report->nonfinite, mostReplaced);
  if (measuresResidual(input, options)) outcome.velocityResidual = report->velocityResidual;
  outcome.positionsHash = positionsHash(positions);
  outcome.device = (*backend)->device();
  outcome.driver = (*backend)->driver();
  outcome.kernel = (*backend)->kernel();
  outcome.deviceBytes = (*backend)->deviceBytes();
  outcome.stages = (*backend)->stageMilliseconds();
  for (const auto& [stage, milliseconds] : stagesBefore) outcome.stages[stage] -= milliseconds;
  outcome.stages["readback"] = readback;
  outcome.stages["write"] = writing;
  if (input.scalp) outcome.stages["scalp"] = following;
  if (bodyWatch) {
    outcome.stages["measure_bodies"] = watching;
    outcome.bodyNumbers = bodyWatch->numbers();
  }
  if (Status told = stepper->tell(outcome); !told) return told.error();
  const double frames = std::max(outcome.frameCount, 1);
  for (auto& [stage, milliseconds] : outcome.stages) milliseconds /= frames;
  outcome.millisecondsPerFrame /= frames;
  outcome.warnings = stepper->warnings();
  for (const std::string& message : (*backend)->deviceMessages()) outcome.warnings.push_back(message);
  return outcome;
}

Result<SimulateOutcome> runSimulation(SimulateOptions& options) {
  auto loaded = loadGroom(options.groom);
  if (!loaded) return loaded.error();
  std::vector<std::string> warnings = options.warnings;
  warnings.insert(warnings.end(), loaded->warnings.begin(), loaded->warnings.end());
  Settings settings = options.settings;
  const auto material = chooseMaterial(options.material, settings, warnings);
  if (!material) return material.error();
  if (options.motionFile) {
    const Motion stated = options.motion;
    auto motion = readMotionFile(*options.motionFile, options.up, warnings);
    if (!motion) return motion.error();
    options.motion = std::move(*motion);
    options.motion.start = stated.start;
    options.motion.roots = stated.roots;
  }
  cutJumps(settings, options.motion);
  if (options.choosesFrames && options.motion.keyframes) {
    const double frames = options.motion.keyframes->seconds() * settings.framesPerSecond;
    options.frameCount = static_cast<int>(std::clamp(frames + 1e-6, 1.0, 1e6));
  }
  if (options.choosesSteps) {
    const auto steps = chooseStepsPerFrame(loaded->groom, *material, settings);
    if (!steps) return steps.error();
    settings.stepsPerFrame = options.settings.stepsPerFrame = *steps;
  }

  const std::vector<Vec3d> shifts = rootShiftsOf(options.rootShift, loaded->groom.strandCount());
  std::optional<HeadScalp> scalp;
  if (!options.scalp.file.empty()) {
    auto bound =
        loadScalp(options.scalp, loaded->groom, options.motion, options.motionFile, options.up, warnings);
    if (!bound) return bound.error();
    scalp = std::move(*bound);
  }
  auto outcome = runHair(
      {loaded->groom, *material, settings, options.motion, shifts, options.bodies, scalp ? &*scalp : nullptr},
      options);
  if (!outcome) return outcome.error();
  outcome->warnings.insert(outcome->warnings.begin(), warnings.begin(), warnings.end());
  return outcome;
}

}  // namespace ringlet::program
