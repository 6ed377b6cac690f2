// Implements simulate_run.h.
#include "program/simulate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "program/backend.h"
#include "program/frame_sink.h"
#include "program/interruption.h"
#include "program/load_scene.h"
#include "program/progress_bar.h"
#include "program/run_writers.h"
#include "program/stopwatch.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet::program {
namespace {

using Clock = std::chrono::steady_clock;
double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// Where head, bodies and roots are at the end of every step of a frame.
struct FramePoses {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies;  // as bodyPosesOf gives them
  std::vector<BodyPose> roots;   // as Simulation::stepFrame takes them

  /// Hands over steps [first, first + count) of them.
  Status submit(Backend& backend, std::size_t first, std::size_t count) const {
    const auto ofSteps = [&](const std::vector<BodyPose>& poses) {
      const std::size_t each = poses.size() / heads.size();
      return std::span(poses).subspan(first * each, count * each);
    };
    return backend.submitFrame(std::span(heads).subspan(first, count), ofSteps(bodies), ofSteps(roots));
  }
  Status submit(Backend& backend) const { return submit(backend, 0, heads.size()); }
  Status step(Backend& backend, std::size_t first, std::size_t count) const {
    if (Status handed = submit(backend, first, count); !handed) return handed;
    return backend.waitFrame();
  }
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
  return makeGpuBackend(made, {options.device, kernel, options.usesTuned, options.showProgress});
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

// Steps hair, with frames in flight; where contacts are to be measured step by step instead, to look at each.
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

  /// As Backend::submitFrame and waitFrame.
  Status submitFrame(const FramePoses& poses) {
    return watch_ ? lookAtSteps(poses) : poses.submit(*backend_);
  }
  Status waitFrame() {
    Stopwatch stopwatch(waiting_);
    if (!watch_) return backend_->waitFrame();
    waited_ = std::move(looked_.front());
    looked_.pop_front();
    return {};
  }
  /// Of the frame waited for last, once.
  std::vector<Vec3f> framePositions() { return watch_ ? std::move(waited_) : backend_->framePositions(); }

  /// What was seen goes into the outcome.
  Status tell(SimulateOutcome& outcome) const {
    outcome.waitedForDevice = waiting_;
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

  Status lookAtSteps(const FramePoses& poses) {
    for (std::size_t step = 0; step < poses.heads.size(); ++step) {
      {
        Stopwatch stopwatch(waiting_);
        if (Status stepped = poses.step(*backend_, step, 1); !stepped) return stepped;
      }
      if (Status seen = look(); !seen) return seen;
    }
    looked_.push_back(std::move(now_));
    Stopwatch stopwatch(measuring_);
    if (!watch_->endFrame() || !hasContacts_) return {};
    auto report = backend_->contactReport();
    if (!report) return report.error();
    worst_ = *report;
    return {};
  }

  Status look() {
    Stopwatch stopwatch(measuring_);
    auto positions = backend_->positions();
    if (!positions) return positions.error();
    watch_->addStep(*positions);
    now_ = std::move(*positions);
    return {};
  }

  Backend* backend_;
  bool hasContacts_;
  std::optional<ContactWatch> watch_;
  std::vector<Vec3f> now_, waited_;          // positions, where watch_ looks at steps
  std::deque<std::vector<Vec3f>> looked_{};  // of frames not waited for
  ContactReport worst_;
  double waiting_ = 0, measuring_ = 0;  // [ms]
};

// A failure in the middle of a run, with what it leaves.
Error afterFrames(int frameCount, const Error& cause, const RunOptions& options) {
  if (frameCount == 0 || options.folder.empty() || (!options.writesUsd && !options.cache)) return cause;
  const char* file = options.writesUsd ? "hair.usda.partial" : "hair.rgc.partial";
  return Error{fmt::format("{} (the first {} frames are kept in {})", cause.message, frameCount,
                           (options.folder / file).string())};
}

struct LoopTimes {
  double poses = 0, readback = 0, waitedForWriter = 0;  // [ms]
};

// Frames, until all are done or Ctrl-C comes: while one computes, the one before it is read back and those
// before that are written.
Status runFrames(Stepper& stepper, const RunInput& input, const RunOptions& options, FrameSink& sink,
                 LoopTimes& times) {
  ProgressBar progress(options.frameCount, options.showProgress);
  const auto afterWritten = [&](const Error& cause) {
    (void)sink.finish();
    return afterFrames(sink.frameCount(), cause, options);
  };
  std::optional<ComputedFrame> underWay;  // its positions are still to come
  const auto takeUnderWay = [&]() -> Status {
    if (!underWay) return {};
    ComputedFrame frame = std::move(*underWay);
    underWay.reset();
    if (Status waited = stepper.waitFrame(); !waited) return afterWritten(waited.error());
    {
      Stopwatch watch(times.readback);
      frame.positions = stepper.framePositions();
    }
    Stopwatch watch(times.waitedForWriter);
    return sink.hand(std::move(frame));
  };

  for (int frame = 0; frame < options.frameCount && !wasInterrupted(); ++frame) {
    progress.show(sink.frameCount());
    const FramePoses poses = [&] {
      Stopwatch watch(times.poses);
      return posesOfFrame(input, frame);
    }();
    if (Status submitted = stepper.submitFrame(poses); !submitted) {
      (void)takeUnderWay();  // it may be whole
      return afterWritten(submitted.error());
    }
    if (Status taken = takeUnderWay(); !taken) return taken;
    const auto bodies = poses.bodiesAtEnd();
    underWay = {frame + 1, {}, poses.heads.back(), {bodies.begin(), bodies.end()}};
  }
  if (Status taken = takeUnderWay(); !taken) return taken;
  const Status written = sink.finish();
  progress.show(sink.frameCount());
  return written;
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
  const Clock::time_point start = Clock::now();
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

  std::optional<BodyWatch> bodyWatch;
  if (!input.bodies.empty()) bodyWatch.emplace(groom, input.bodies, input.settings.rootCount);
  FrameReaders readers{.bodies = bodyWatch ? &*bodyWatch : nullptr, .observe = {}, .write = {}};
  if (observer) {
    readers.observe = [&](const ComputedFrame& frame, std::span<const Vec3f> points) -> Status {
      const Status seen = observer(points, frame.head);
      return seen ? seen : afterFrames(frame.number - 1, seen.error(), options);
    };
  }
  if (writers) {
    readers.write = [&](int number, std::vector<Vec3f> points) {
      return writers->addFrame(number, std::move(points));
    };
  }
  FrameSink sink(groom, std::move(readers));
  LoopTimes times;
  const Clock::time_point first = Clock::now();
  if (Status ran = runFrames(*stepper, input, options, sink, times); !ran) return ran.error();
  const Clock::time_point last = Clock::now();
  outcome.frameCount = sink.frameCount();
  outcome.interrupted = wasInterrupted() && outcome.frameCount < options.frameCount;

  // What there is becomes files.
  if (writers && outcome.frameCount > 0) {
    auto outputs = writers->finish(options.folder, groom);
    if (!outputs) return outputs.error();
    outcome.outputs = std::move(*outputs);
    if (writers->cache) outcome.cacheErrorBound = writers->cache->errorBound();
  }
  outcome.wall = {secondsBetween(start, first), secondsBetween(first, last),
                  secondsBetween(last, Clock::now())};

  // And numbers.
  auto report = (*backend)->report();
  if (!report) return report.error();
  outcome.report = *report;
  outcome.report.nonfinite = std::max<std::uint64_t>(report->nonfinite, sink.mostReplaced());
  if (measuresResidual(input, options)) outcome.velocityResidual = report->velocityResidual;
  outcome.positionsHash = positionsHash(sink.lastPositions());
  outcome.rigidStrandCount = (*backend)->rigidStrandCount();
  outcome.device = (*backend)->device();
  outcome.driver = (*backend)->driver();
  outcome.kernel = (*backend)->kernel();
  outcome.isTuned = (*backend)->isTuned();
  outcome.deviceBytes = (*backend)->deviceBytes();
  outcome.compileMilliseconds = (*backend)->compileMilliseconds();
  outcome.stages = (*backend)->stageMilliseconds();
  for (const auto& [stage, milliseconds] : stagesBefore) outcome.stages[stage] -= milliseconds;
  for (const auto& [stage, milliseconds] : outcome.stages) outcome.millisecondsPerFrame += milliseconds;
  outcome.computeShare = outcome.millisecondsPerFrame / (1000 * outcome.wall.frames);
  outcome.stages["readback"] = times.readback;
  outcome.stages["write"] = sink.millisecondsWriting();
  outcome.waitedForWriter = times.waitedForWriter;
  if (input.scalp) outcome.stages["scalp"] = times.poses;
  if (bodyWatch) {
    outcome.stages["measure_bodies"] = sink.millisecondsWatching();
    outcome.bodyNumbers = bodyWatch->numbers();
  }
  if (Status told = stepper->tell(outcome); !told) return told.error();
  const double frames = std::max(outcome.frameCount, 1);
  for (auto& [stage, milliseconds] : outcome.stages) milliseconds /= frames;
  for (double* time : {&outcome.millisecondsPerFrame, &outcome.waitedForDevice, &outcome.waitedForWriter})
    *time /= frames;
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
