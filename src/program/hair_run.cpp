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

#include "program/frame_lines.h"
#include "program/frame_sink.h"
#include "program/hair_maker.h"
#include "program/interruption.h"
#include "program/progress_bar.h"
#include "program/run_checkpoints.h"
#include "program/run_facts.h"
#include "program/run_folder.h"
#include "program/run_writers.h"
#include "program/simulate_run.h"
#include "program/stepper.h"
#include "program/stopwatch.h"
#include "program/writer_thread.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/scenes/scene_frames.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

using Clock = std::chrono::steady_clock;
double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
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
std::vector<RunFact> factsOf(const LoadedScene& scene, const RunOptions& options) {
  std::vector<RunFact> facts = options.facts;
  const auto add = [&](const char* name, auto value) { facts.push_back({name, fmt::format("{}", value)}); };
  add("program", RINGLET_VERSION);
  add("strands", scene.groom.strandCount());
  add("frames", scene.frameCount);
  add("steps a frame", scene.settings.stepsPerFrame);
  add("max_stretch", scene.settings.maxStretch);
  add("pre-roll", scene.preRollSeconds);
  addOutputFacts(options, facts);
  add("measured contacts", options.measuresContacts);
  add("measured residual", measuresResidual(scene, options));
  return facts;
}

// From the folder to the numbers, in the order of its functions.
class HairRun {
 public:
  HairRun(const LoadedScene& scene, const RunOptions& options, const FrameObserver& observer)
      : scene_(scene), options_(options), observer_(observer) {
    outcome_.strandCount = scene.groom.strandCount();
    outcome_.particleCount = scene.groom.points.size();
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
  Status preRoll();
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

  const LoadedScene& scene_;
  const SceneFrames frames_{scene_};
  const RunOptions& options_;
  const FrameObserver& observer_;
  SimulateOutcome outcome_;

  std::optional<EndsUnheard> unheard_;
  std::optional<RunFolder> folder_;
  RunCheckpoints checkpoints_;
  std::unique_ptr<SceneHair> hair_;
  std::optional<Stepper> stepper_;
  std::optional<Writers> writers_;
  std::optional<BodyWatch> bodyWatch_;
  std::optional<ComputedFrame> underWay_;  // its positions are still to come

  const Clock::time_point start_ = Clock::now();
  Clock::time_point firstFrame_{}, lastFrame_{};
  HairTimes timesBefore_;
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
    auto made = RunCheckpoints::make(*folder_, options_.checkpointFrames, factsOf(scene_, options_));
    if (!made) return made.error();
    checkpoints_ = std::move(*made);
  }
  // Until the first frame is there, in which drivers compile too. In a sweep others write, and ranks end
  // together.
  if (options_.runNumber == 0 && !options_.onRanks) unheard_.emplace();
  auto hair = ringlet::program::makeHair({scene_, frames_, options_.measuresContacts}, options_);
  if (!hair) return hair.error();
  hair_ = std::move(*hair);
  if (hasCheckpoints) {
    const HairFacts facts = hair_->facts();
    if (Status same = checkpoints_.addDevice(*folder_, facts.device, facts.driver, facts.kernel); !same)
      return same;
  }
  if (outcome_.resumedFrom == 0) {
    if (checkpoints_.areWanted()) {
      if (Status written = checkpoints_.write(0, {}, {}); !written) return written;
    }
    if (Status rolled = preRoll(); !rolled) return rolled;
  }
  timesBefore_ = hair_->times();
  auto stepper = Stepper::make(*hair_, scene_, options_.measuresContacts);
  if (!stepper) return stepper.error();
  stepper_.emplace(std::move(*stepper));
  return {};
}

Status HairRun::makeSink() {
  const int done = outcome_.resumedFrom;
  if (folder_) {
    std::optional<FullHair> hairs;
    if (options_.hairs > 0) {
      const HeadScalp* scalp =
          scene_.rootShifts.empty() ? (scene_.scalp ? &*scene_.scalp : nullptr) : nullptr;
      const auto ground = hairGroundOf(scene_.hairs, scalp, options_.look, scene_.groom.metresPerUnit);
      if (!ground) return ground.error();
      auto made = FullHair::make(scene_.groom, scene_.groom.metresPerUnit,
                                 options_.look.of({.hairCount = options_.hairs}), scene_.bodies, *ground,
                                 CutList(frames_, scene_.frameCount));
      if (!made) return made.error();
      hairs.emplace(std::move(*made));
    }
    writers_.emplace(scene_, options_, std::move(hairs), done);
  }
  if (!scene_.bodies.empty()) bodyWatch_.emplace(scene_.groom, scene_.bodies, scene_.settings.rootCount);
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
    const FrameLines lines(done, scene_.frameCount, options_.tellsFrames, options_.runNumber);
    readers.write = [this, lines](int number, std::vector<Vec3f> points,
                                  const ComputedFrame& frame) -> Status {
      if (Status added = writers_->addFrame(number, std::move(points), frame.head, frame.bodies); !added)
        return added;
      lines.tell(number);
      return {};
    };
  }
  disk_.emplace(1);
  sink_.emplace(scene_.groom, std::move(readers));
  return done > 0 ? restore() : Status{};
}

// The motion up to the first frame, so that hair begins it as it moves.
Status HairRun::preRoll() {
  for (int number = frames_.first(); number < 0 && !wasInterrupted(); ++number) {
    const auto frame = frames_.at(number);
    if (!frame) return frame.error();
    for (std::size_t step = 0; step < (options_.measuresContacts ? frame->stepCount() : 1); ++step) {
      if (Status handed = hair_->submit(options_.measuresContacts ? frame->step(step) : *frame); !handed)
        return handed;
      if (Status waited = hair_->wait(); !waited) return waited;
    }
  }
  return {};
}

Status HairRun::restore() {
  Archive computed = Archive::reading(folder_->checkpoint()->computed);
  Archive written = Archive::reading(folder_->checkpoint()->written);
  if (Status restored = stepper_->restore(computed, frames_, outcome_.resumedFrom); !restored)
    return restored;
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
  ProgressBar progress(first, scene_.frameCount, options_.showProgress);
  int frame = first;
  for (; frame < scene_.frameCount && !wasInterrupted(); ++frame) {
    progress.show(sink_->frameCount());
    if (checkpoints_.areDueAt(frame) && frame > first) {
      if (Status saved = saveAt(frame); !saved) return saved;
    }
    const auto now = [&] {
      Stopwatch watch(posesTime_);
      return frames_.at(frame);
    }();
    if (!now) {
      (void)takeUnderWay();  // it may be whole
      return afterWritten(now.error());
    }
    if (!now->change.isNone()) {
      if (Status taken = takeUnderWay(); !taken) return taken;
    }
    if (Status submitted = stepper_->submit(*now); !submitted) {
      (void)takeUnderWay();  // it may be whole
      return afterWritten(submitted.error());
    }
    if (Status taken = takeUnderWay(); !taken) return taken;
    const auto bodies = now->bodiesAtEnd();
    underWay_ = {frame + 1, {}, now->heads.back(), {bodies.begin(), bodies.end()}};
  }
  if (Status taken = takeUnderWay(); !taken) return taken;
  unheard_.reset();
  if (frame < scene_.frameCount && checkpoints_.areWanted()) {
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
  const Status waited = stepper_->wait();
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
  if (Status kept = stepper_->save(archive); !kept) return afterWritten(kept.error());
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
  outcome_.interrupted = wasInterrupted() && outcome_.frameCount < scene_.frameCount;
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
  const auto reports = hair_->reports();
  if (!reports) return reports.error();
  outcome_.report = reports->hair;
  outcome_.report.nonfinite = std::max<std::uint64_t>(reports->hair.nonfinite, sink_->mostReplaced());
  if (measuresResidual(scene_, options_)) outcome_.velocityResidual = reports->hair.velocityResidual;
  outcome_.positionsHash = positionsHash(sink_->lastPositions());
  outcome_.hair = hair_->facts();
  if (bodyWatch_) outcome_.bodyNumbers = bodyWatch_->numbers();
  stepper_->tell(reports->contacts, outcome_);
  return {};
}

// Per frame of this run.
void HairRun::tellTimes() {
  HairTimes times = hair_->times();
  std::map<std::string, double>& computing = times.stages;
  for (const auto& [stage, milliseconds] : timesBefore_.stages) computing[stage] -= milliseconds;
  for (const auto& [stage, milliseconds] : computing)
    outcome_.millisecondsPerFrame += stage == kCopyStage ? 0 : milliseconds;
  outcome_.computeShare = outcome_.millisecondsPerFrame / (1000 * outcome_.wall.frames);
  outcome_.stages.merge(computing);
  outcome_.stages["readback"] = readbackTime_;
  outcome_.stages["write"] = sink_->millisecondsWriting();
  outcome_.waitedForWriter = waitedForWriter_;
  outcome_.host = times.host;
  if (outcome_.host && timesBefore_.host) {
    outcome_.host->submit -= timesBefore_.host->submit;
    outcome_.host->fence -= timesBefore_.host->fence;
  }
  if (scene_.scalp) outcome_.stages["scalp"] = posesTime_;
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
  add(outcome_.hair.messages);
}

}  // namespace

// The paper's loops solve no system; contacts, air and bodies have one of other terms; the reference does not
// measure.
bool measuresResidual(const LoadedScene& scene, const RunOptions& options) {
  const Settings& settings = scene.settings;
  return options.kernel.residual && !options.onReference && !settings.contacts.on && !settings.air.on &&
         !settings.goal.on && scene.bodies.empty() && settings.integrator != Integrator::paper;
}

Result<SimulateOutcome> runHair(const LoadedScene& scene, const RunOptions& options,
                                const FrameObserver& observer) {
  catchInterruption();
  return HairRun(scene, options, observer).run();
}

}  // namespace ringlet::program
