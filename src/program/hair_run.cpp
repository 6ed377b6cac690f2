// Implements runHair of simulate_run.h.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "program/backend.h"
#include "program/exit_codes.h"
#include "program/frame_lines.h"
#include "program/frame_poses.h"
#include "program/frame_sink.h"
#include "program/interruption.h"
#include "program/progress_bar.h"
#include "program/ranks.h"
#include "program/remote_backend.h"
#include "program/run_checkpoints.h"
#include "program/run_facts.h"
#include "program/run_folder.h"
#include "program/run_writers.h"
#include "program/simulate_run.h"
#include "program/stepper.h"
#include "program/stopwatch.h"
#include "program/writer_thread.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

using Clock = std::chrono::steady_clock;
double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// The paper's loops solve no system; contacts, air and bodies have one of other terms; the reference does not
// measure.
bool measuresResidual(const RunInput& input, const RunOptions& options) {
  return options.kernel.residual && !options.onReference && !input.settings.contacts.on &&
         !input.settings.air.on && !input.settings.goal.on && input.bodies.empty() &&
         input.settings.integrator != Integrator::paper;
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
                          input.rootShifts, input.bodies,   bodies,   roots, rootsEarlier,
                          input.geometry};
  if (options.onReference) return makeReferenceBackend(made);
  KernelChoice kernel = options.kernel;
  kernel.fields = input.forces && input.forces->haveFields();
  kernel.goals = input.forces && input.forces->haveGoals();
  kernel.residual = measuresResidual(input, options);
  const GpuChoice gpu{options.device, options.opened, kernel, options.usesTuned, options.showProgress};
  static bool wasDivided = false;  // other ranks have left then
  if (ranks().count > 1 && !std::exchange(wasDivided, true))
    return makeRankBackend(made, gpu, options.devices);
  return options.devices.empty() ? makeGpuBackend(made, gpu) : makeSplitBackend(made, gpu, options.devices);
}

// The numbers that keys give the frame, where they are others than those of the time they were last taken of.
Status takeNumbers(Backend& backend, const RunInput& input, const RunOptions& options, int frame,
                   std::optional<double>& takenOf) {
  if (!input.keys) return {};
  if (options.onReference && input.settings.contacts.on && input.keys->changeContacts())
    return Error{"numbers of contacts change over time on the GPU only (--backend gpu)"};
  const double end = (frame + 1) / input.settings.framesPerSecond;
  if (takenOf && input.keys->areEqual(*takenOf, end)) return {};
  const auto numbers = input.keys->at(end, input.settings.stepsPerFrame);
  if (!numbers) return numbers.error();
  takenOf = end;
  return backend.change(options.measuresContacts ? stepByStep(numbers->settings) : numbers->settings,
                        numbers->material, end);
}

std::span<const TimedCuts> cutsOf(const RunInput& input, const RunOptions& options, int frame) {
  return cutsOfFrame(input.cuts, frame, input.settings.framesPerSecond,
                     frame == -preRollFrames(input, options));
}

Status makeCuts(Backend& backend, std::span<const TimedCuts> all) {
  for (const TimedCuts& now : all) {
    if (Status cut = backend.cut(now.cuts); !cut) return cut;
  }
  return {};
}

// The motion up to the first frame, so that hair begins it as it moves.
Status preRoll(Backend& backend, const RunInput& input, const RunOptions& options) {
  std::optional<double> numbersOf;
  for (int frame = -preRollFrames(input, options); frame < 0 && !wasInterrupted(); ++frame) {
    const auto found = posesOfFrame(input, frame);
    if (!found) return found.error();
    const FramePoses& poses = *found;
    if (Status cut = makeCuts(backend, cutsOf(input, options, frame)); !cut) return cut;
    if (Status taken = takeNumbers(backend, input, options, frame, numbersOf); !taken) return taken;
    const std::size_t together = options.measuresContacts ? 1 : poses.heads.size();  // as makeBackend says
    for (std::size_t step = 0; step < poses.heads.size(); step += together) {
      if (Status stepped = poses.step(backend, step, together); !stepped) return stepped;
    }
  }
  return {};
}

// A failure in the middle of a run, with what it leaves.
Error afterFrames(int frameCount, const Error& cause, const RunOptions& options) {
  const std::vector<std::string> animations = animationsOf(options);
  if (frameCount == 0 || options.folder.empty() || animations.empty()) return cause;
  return Error{fmt::format("{} (the first {} frames are kept in {})", cause.message, frameCount,
                           (options.folder / (animations.front() + ".partial")).string()),
               cause.fault};
}

// What this run and one that goes on with it must have in common, but for the device.
std::vector<RunFact> factsOf(const RunInput& input, const RunOptions& options) {
  std::vector<RunFact> facts = options.facts;
  const auto add = [&](const char* name, auto value) { facts.push_back({name, fmt::format("{}", value)}); };
  add("program", RINGLET_VERSION);
  add("strands", input.groom.strandCount());
  add("frames", options.frameCount);
  add("steps a frame", input.settings.stepsPerFrame);
  add("max_stretch", input.settings.maxStretch);
  add("pre-roll", options.preRollSeconds);
  addOutputFacts(options, facts);
  add("measured contacts", options.measuresContacts);
  add("measured residual", measuresResidual(input, options));
  return facts;
}

// From the folder to the numbers, in the order of its functions.
class HairRun {
 public:
  HairRun(const RunInput& input, const RunOptions& options, const FrameObserver& observer)
      : input_(input), options_(options), observer_(observer) {
    outcome_.strandCount = input.groom.strandCount();
    outcome_.particleCount = input.groom.points.size();
  }

  Result<SimulateOutcome> run() {
    for (const auto part : {&HairRun::openFolder, &HairRun::makeHair, &HairRun::makeSink, &HairRun::stepAll,
                            &HairRun::finishFiles, &HairRun::tellReports}) {
      if (Status done = (this->*part)(); !done) return done.error();
    }
    tellTimes();
    tellWarnings();
    return std::move(outcome_);
  }

 private:
  Status openFolder();
  Status makeHair();
  Status makeSink();
  Status takeNumbersBefore(int frame);
  Status restore();
  Status stepAll();
  Status takeUnderWay();
  Status saveAt(int frame);
  Status finishWriting();
  Error afterWritten(const Error& cause);
  Status finishFiles();
  Status tellReports();
  void tellTimes();
  void tellWarnings();

  const RunInput& input_;
  const RunOptions& options_;
  const FrameObserver& observer_;
  SimulateOutcome outcome_;

  std::optional<EndsUnheard> unheard_;
  std::optional<RunFolder> folder_;
  RunCheckpoints checkpoints_;
  std::unique_ptr<Backend> backend_;
  std::optional<Stepper> stepper_;
  std::optional<Writers> writers_;
  std::optional<BodyWatch> bodyWatch_;
  std::optional<ComputedFrame> underWay_;  // its positions are still to come
  std::optional<double> numbersOf_;        // time whose keys the hair has [s]

  const Clock::time_point start_ = Clock::now();
  Clock::time_point firstFrame_{}, lastFrame_{};
  std::map<std::string, double> stagesBefore_;
  HostMilliseconds hostBefore_;
  double posesTime_ = 0, readbackTime_ = 0, waitedForWriter_ = 0;  // [ms]
  std::optional<WriterThread> disk_;                               // waits for the disk
  std::optional<FrameSink> sink_;                                  // goes first: it works on the rest
};

Status HairRun::openFolder() {
  if (options_.folder.empty()) return {};
  auto opened = RunFolder::open(options_.folder, options_.leftovers, outputsOf(options_));
  if (!opened) return opened.error();
  folder_.emplace(std::move(*opened));
  if (folder_->checkpoint()) outcome_.resumedFrom = folder_->checkpoint()->frame;
  return {};
}

// What can fail before the first step; and the steps before the first frame.
Status HairRun::makeHair() {
  const bool hasCheckpoints = folder_ && (options_.checkpointFrames > 0 || folder_->checkpoint());
  if (hasCheckpoints) {
    auto made = RunCheckpoints::make(*folder_, options_.checkpointFrames, factsOf(input_, options_));
    if (!made) return made.error();
    checkpoints_ = std::move(*made);
  }
  // Until the first frame is there, in which drivers compile too. In a sweep others write, and ranks end
  // together.
  if (options_.runNumber == 0 && ranks().count <= 1) unheard_.emplace();
  auto backend = makeBackend(input_, options_);
  if (!backend) return backend.error();
  backend_ = std::move(*backend);
  if (hasCheckpoints) {
    Status same =
        checkpoints_.addDevice(*folder_, backend_->device(), backend_->driver(), backend_->kernel());
    if (!same) return same;
  }
  if (outcome_.resumedFrom == 0) {
    if (checkpoints_.areWanted()) {
      if (Status written = checkpoints_.write(0, {}, {}); !written) return written;
    }
    if (Status rolled = preRoll(*backend_, input_, options_); !rolled) return rolled;
  }
  stagesBefore_ = backend_->stageMilliseconds();
  hostBefore_ = backend_->hostMilliseconds().value_or(HostMilliseconds{});
  auto stepper = Stepper::make(*backend_, input_, options_);
  if (!stepper) return stepper.error();
  stepper_.emplace(std::move(*stepper));
  return {};
}

Status HairRun::makeSink() {
  const int done = outcome_.resumedFrom;
  if (folder_) {
    std::optional<FullHair> hairs;
    if (options_.hairs > 0) {
      const HeadScalp* scalp = input_.rootShifts.empty() ? input_.scalp : nullptr;
      const auto ground = hairGroundOf(input_.hairs ? *input_.hairs : SceneHairs(), scalp, options_.look,
                                       input_.groom.metresPerUnit);
      if (!ground) return ground.error();
      auto made = FullHair::make(input_.groom, input_.groom.metresPerUnit,
                                 options_.look.of({.hairCount = options_.hairs}), input_.bodies, *ground,
                                 {input_.cuts, input_.settings.framesPerSecond, options_.frameCount});
      if (!made) return made.error();
      hairs.emplace(std::move(*made));
    }
    writers_.emplace(input_, options_, std::move(hairs), done);
  }
  if (!input_.bodies.empty()) bodyWatch_.emplace(input_.groom, input_.bodies, input_.settings.rootCount);
  const bool writesFrames = !animationsOf(options_).empty() || options_.writesSheet || options_.tellsFrames;
  FrameReaders readers{.bodies = bodyWatch_ ? &*bodyWatch_ : nullptr,
                       .observe = {},
                       .write = {},
                       .needLastOnly = !writesFrames && (!observer_ || options_.observesLast)};
  if (observer_) {
    readers.observe = [this](const ComputedFrame& frame, std::span<const Vec3f> points) -> Status {
      const Status seen = observer_(points, frame.head);
      return seen ? seen : afterFrames(frame.number - 1, seen.error(), options_);
    };
  }
  if (writers_) {
    const FrameLines lines(done, options_.frameCount, options_.tellsFrames, options_.runNumber);
    readers.write = [this, lines](int number, std::vector<Vec3f> points,
                                  const ComputedFrame& frame) -> Status {
      if (Status added = writers_->addFrame(number, std::move(points), frame.head, frame.bodies); !added)
        return added;
      lines.tell(number);
      return {};
    };
  }
  disk_.emplace(1);
  sink_.emplace(input_.groom, std::move(readers));
  return done > 0 ? restore() : Status{};
}

// What keys did in the frames before, of which a checkpoint knows nothing. A material that was another and
// came back has other last bits than one that never changed: the first change is made too. The state,
// restored after this, says whether the hair sleeps; numbers that are set anew would wake it.
Status HairRun::takeNumbersBefore(int frame) {
  if (!input_.keys) return {};
  for (int before = -preRollFrames(input_, options_); before < frame - 1; ++before) {
    const double end = (before + 1) / input_.settings.framesPerSecond;
    const auto numbers = input_.keys->at(end, input_.settings.stepsPerFrame);
    if (!numbers) return numbers.error();
    if (numbers->material == input_.material) continue;
    if (Status taken = takeNumbers(*backend_, input_, options_, before, numbersOf_); !taken) return taken;
    break;
  }
  return takeNumbers(*backend_, input_, options_, frame - 1, numbersOf_);
}

Status HairRun::restore() {
  if (Status taken = takeNumbersBefore(outcome_.resumedFrom); !taken) return taken;
  for (int frame = -preRollFrames(input_, options_); frame < outcome_.resumedFrom; ++frame) {
    if (Status cut = makeCuts(*backend_, cutsOf(input_, options_, frame)); !cut) return cut;
  }
  Archive computed = Archive::reading(folder_->checkpoint()->computed);
  Archive written = Archive::reading(folder_->checkpoint()->written);
  if (Status restored = stepper_->archive(computed); !restored) return restored;
  sink_->archive(written);
  writers_->archive(written);
  if (!computed.isWhole() || !written.isWhole()) return Error{kForeignCheckpoint, Fault::input};
  folder_->dropState();
  return {};
}

// Frames, until all are done or Ctrl-C comes: while one computes, the one before it is read back and those
// before that are written.
Status HairRun::stepAll() {
  firstFrame_ = Clock::now();
  const int first = outcome_.resumedFrom;
  ProgressBar progress(first, options_.frameCount, options_.showProgress);
  int frame = first;
  for (; frame < options_.frameCount && !wasInterrupted(); ++frame) {
    progress.show(sink_->frameCount());
    if (checkpoints_.areDueAt(frame) && frame > first) {
      if (Status saved = saveAt(frame); !saved) return saved;
    }
    const auto found = [&] {
      Stopwatch watch(posesTime_);
      return posesOfFrame(input_, frame);
    }();
    if (!found) {
      (void)takeUnderWay();  // it may be whole
      return afterWritten(found.error());
    }
    const FramePoses& poses = *found;
    if (const auto cuts = cutsOf(input_, options_, frame); !cuts.empty()) {
      if (Status taken = takeUnderWay(); !taken) return taken;
      if (Status cut = makeCuts(*backend_, cuts); !cut) return afterWritten(cut.error());
    }
    if (input_.keys) {
      if (Status taken = takeUnderWay(); !taken) return taken;
      if (Status taken = takeNumbers(*backend_, input_, options_, frame, numbersOf_); !taken)
        return afterWritten(taken.error());
    }
    if (Status submitted = stepper_->submitFrame(poses); !submitted) {
      (void)takeUnderWay();  // it may be whole
      return afterWritten(submitted.error());
    }
    if (Status taken = takeUnderWay(); !taken) return taken;
    const auto bodies = poses.bodiesAtEnd();
    underWay_ = {frame + 1, {}, poses.heads.back(), {bodies.begin(), bodies.end()}};
  }
  if (Status taken = takeUnderWay(); !taken) return taken;
  unheard_.reset();
  if (frame < options_.frameCount && checkpoints_.areWanted()) {
    if (Status saved = saveAt(frame); !saved) return saved;
  }
  Status written = finishWriting();
  progress.show(sink_->frameCount());
  lastFrame_ = Clock::now();
  return written;
}

Status HairRun::takeUnderWay() {
  if (!underWay_) return {};
  ComputedFrame frame = std::move(*underWay_);
  underWay_.reset();
  const Status waited = stepper_->waitFrame();
  unheard_.reset();
  if (!waited) return afterWritten(waited.error());
  {
    Stopwatch watch(readbackTime_);
    frame.positions = stepper_->framePositions(sink_->takeRoom());
  }
  Stopwatch watch(waitedForWriter_);
  return sink_->hand(std::move(frame));
}

// A checkpoint after `frame` frames: the hair's state now; what is known of those frames joins it on the
// sink's thread; and frames go on while the disk takes both.
Status HairRun::saveAt(int frame) {
  if (Status taken = takeUnderWay(); !taken) return taken;
  Archive archive = Archive::writing();
  if (Status kept = stepper_->archive(archive); !kept) return afterWritten(kept.error());
  return sink_->handJob([this, frame, computed = archive.take()]() mutable {
    Archive written = Archive::writing();
    sink_->archive(written);
    writers_->archive(written);
    return disk_->hand([this, frame, computed = std::move(computed), written = written.take()]() mutable {
      if (Status synced = writers_->sync(); !synced) return synced;
      return checkpoints_.write(frame, std::move(computed), std::move(written));
    });
  });
}

Status HairRun::finishWriting() {
  const Status written = sink_->finish();
  const Status saved = disk_->finish();
  return written ? saved : written;
}

Error HairRun::afterWritten(const Error& cause) {
  (void)finishWriting();
  return afterFrames(sink_->frameCount(), cause, options_);
}

// Finishes the files with the frames written so far, unless another run resumes this one.
Status HairRun::finishFiles() {
  outcome_.frameCount = sink_->frameCount();
  outcome_.interrupted = wasInterrupted() && outcome_.frameCount < options_.frameCount;
  outcome_.canResume = outcome_.interrupted && checkpoints_.areWanted();
  if (writers_ && outcome_.frameCount > 0 && !outcome_.canResume) {
    auto outputs = writers_->finish();
    if (!outputs) return outputs.error();
    outcome_.outputs = std::move(*outputs);
    outcome_.cacheErrorBound = writers_->errorBound();
    folder_->finish();
  }
  outcome_.wall = {secondsBetween(start_, firstFrame_), secondsBetween(firstFrame_, lastFrame_),
                   secondsBetween(lastFrame_, Clock::now())};
  return {};
}

Status HairRun::tellReports() {
  auto report = backend_->report();
  if (!report) return report.error();
  outcome_.report = *report;
  outcome_.report.nonfinite = std::max<std::uint64_t>(report->nonfinite, sink_->mostReplaced());
  if (measuresResidual(input_, options_)) outcome_.velocityResidual = report->velocityResidual;
  outcome_.positionsHash = positionsHash(sink_->lastPositions());
  outcome_.device = backend_->device();
  outcome_.driver = backend_->driver();
  outcome_.kernel = backend_->kernel();
  outcome_.isTuned = backend_->isTuned();
  outcome_.rigidStrandCount = backend_->rigidStrandCount();
  outcome_.deviceBytes = backend_->deviceBytes();
  if (bodyWatch_) outcome_.bodyNumbers = bodyWatch_->numbers();
  return stepper_->tell(outcome_);
}

// Per frame of this run.
void HairRun::tellTimes() {
  outcome_.compileMilliseconds = backend_->compileMilliseconds();
  std::map<std::string, double> computing = backend_->stageMilliseconds();
  for (const auto& [stage, milliseconds] : stagesBefore_) computing[stage] -= milliseconds;
  for (const auto& [stage, milliseconds] : computing)
    outcome_.millisecondsPerFrame += stage == kCopyStage ? 0 : milliseconds;
  outcome_.computeShare = outcome_.millisecondsPerFrame / (1000 * outcome_.wall.frames);
  outcome_.stages.merge(computing);
  outcome_.stages["readback"] = readbackTime_;
  outcome_.stages["write"] = sink_->millisecondsWriting();
  outcome_.waitedForWriter = waitedForWriter_;
  outcome_.host = backend_->hostMilliseconds();
  if (outcome_.host) {
    outcome_.host->submit -= hostBefore_.submit;
    outcome_.host->fence -= hostBefore_.fence;
  }
  if (input_.scalp) outcome_.stages["scalp"] = posesTime_;
  if (bodyWatch_) outcome_.stages["measure_bodies"] = sink_->millisecondsWatching();
  const double frames = std::max(outcome_.frameCount - outcome_.resumedFrom, 1);
  for (auto& [stage, milliseconds] : outcome_.stages) milliseconds /= frames;
  for (double* time : {&outcome_.millisecondsPerFrame, &outcome_.waitedForDevice, &outcome_.waitedForWriter,
                       &outcome_.copied})
    *time /= frames;
  if (outcome_.host) outcome_.host->submit /= frames, outcome_.host->fence /= frames;
}

void HairRun::tellWarnings() {
  if (folder_) outcome_.warnings = folder_->warnings();
  const auto add = [&](const std::vector<std::string>& warnings) {
    outcome_.warnings.insert(outcome_.warnings.end(), warnings.begin(), warnings.end());
  };
  add(stepper_->warnings());
  if (outcome_.contacts) add(outcome_.contacts->warnings());
  add(backend_->deviceMessages());
}

// What a rank but 0 does of a run.
[[noreturn]] void serveRun(const RunInput& input, const RunOptions& options) {
  RankScene scene;
  scene.numbersAt = [&](double seconds) -> Result<SceneNumbers> {
    auto numbers = input.keys->at(seconds, input.settings.stepsPerFrame);
    if (numbers && options.measuresContacts) numbers->settings = stepByStep(numbers->settings);
    return numbers;
  };
  auto poses = posesOfFrame(input, 0);
  if (poses) scene.fields = poses->forces.fields;
  auto hair = poses ? makeBackend(input, options) : poses.error();
  scene.pointCount = input.groom.points.size();
  if (hair) scene.points = pointsOf(input.groom, (*hair)->ownStrands());
  serve(std::move(hair), scene);
  leaveRanks(kExitFine);
  std::exit(kExitFine);
}

}  // namespace

Result<SimulateOutcome> runHair(const RunInput& input, const RunOptions& options,
                                const FrameObserver& observer) {
  catchInterruption();
  if (ranks().own > 0) serveRun(input, options);
  return HairRun(input, options, observer).run();
}

}  // namespace ringlet::program
