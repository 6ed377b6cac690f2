// Implements run.h.
#include "ringlet/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "ringlet/base/stopwatch.h"
#include "ringlet/output/partial_frames.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/run/frame_sink.h"
#include "ringlet/run/run_checkpoints.h"
#include "ringlet/run/run_facts.h"
#include "ringlet/run/run_folder.h"
#include "ringlet/run/run_writers.h"
#include "ringlet/run/stepper.h"
#include "ringlet/run/trace_file.h"
#include "ringlet/run/writer_thread.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/version.h"

namespace ringlet {
namespace {

using Clock = std::chrono::steady_clock;
double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// A failure in the middle of a run, with a note on which frames are kept.
Error afterFrames(int frameCount, const Error& cause, const RunOptions& options) {
  const std::vector<std::string> animations = animationsOf(options);
  if (options.folder.empty() || animations.empty()) return cause;
  return framesKept(cause, static_cast<std::size_t>(frameCount),
                    options.folder / (animations.front() + ".partial"));
}

// Facts that must be equal in this run and in one that resumes it, except those of the device.
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
  addMaterialFacts(scene.material, facts);
  return facts;
}

}  // namespace

// A run, from opening its folder to its outcome; functions are in the order in which they are called.
class Run::Work {
 public:
  Work(const LoadedScene& scene, RunOptions options, RunEvents events)
      : scene_(scene), options_(std::move(options)), events_(std::move(events)) {
    outcome_.strandCount = scene.groom.strandCount();
    outcome_.particleCount = scene.groom.points.size();
  }

  Status open(const HairMaker& makeHair);
  Result<bool> next();
  Result<RunOutcome> finish();
  int resumedFrom() const { return outcome_.resumedFrom; }

 private:
  Status openFolder();
  Status openHair(const HairMaker& makeHair);
  Status makeSink();
  Status preRoll();
  Status restore();
  Status step(const SceneFrame& frame);
  Status takeUnderWay();
  Status finishFrames();
  Status saveAt(int frame);
  Status finishWriting();
  Error afterWritten(const Error& cause);
  void tellProgress() const {
    if (events_.progress) events_.progress(sink_->frameCount());
  }
  bool isStopped() const { return events_.isStopped && events_.isStopped(); }
  void tellFirstFrame() {
    if (events_.firstFrame && !std::exchange(hasFirstFrame_, true)) events_.firstFrame();
  }
  Status finishFiles();
  Status finishTrace() { return trace_ ? trace_->finish() : Status{}; }
  void tellBodies();
  Status tellReports();
  void tellTimes();
  void tellWarnings();

  const LoadedScene& scene_;
  const SceneFrames frames_{scene_};
  const RunOptions options_;
  const RunEvents events_;
  RunOutcome outcome_;

  std::optional<RunFolder> folder_;
  RunCheckpoints checkpoints_;
  std::unique_ptr<SceneHair> hair_;
  std::optional<Stepper> stepper_;
  std::optional<TraceFile> trace_;
  std::optional<RunWriters> writers_;
  std::optional<BodyWatch> bodyWatch_;
  int frame_ = 0;                          // index of the next frame
  std::optional<ComputedFrame> underWay_;  // submitted; its positions have not been read back

  bool hasFirstFrame_ = false;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point firstFrame_{}, lastFrame_{};
  HairTimes timesBefore_;
  double posesTime_ = 0, readbackTime_ = 0, waitedForWriter_ = 0;  // [ms]
  std::optional<WriterThread> disk_;                               // waits for checkpoints to reach the disk
  std::optional<FrameSink> sink_;                                  // destroyed first: it uses the other
                                                                   // members
};

Status Run::Work::open(const HairMaker& makeHair) {
  if (Status opened = openFolder(); !opened) return opened;
  if (Status opened = openHair(makeHair); !opened) return opened;
  frame_ = outcome_.resumedFrom;
  return makeSink();
}

Status Run::Work::openFolder() {
  if (options_.folder.empty()) return {};
  auto opened = RunFolder::open(options_.folder, options_.leftovers, outputsOf(options_), options_.words);
  if (!opened) return opened.error();
  folder_.emplace(std::move(*opened));
  if (folder_->checkpoint()) outcome_.resumedFrom = folder_->checkpoint()->frame;
  return {};
}

// Everything that can fail before the first step, and the pre-roll.
Status Run::Work::openHair(const HairMaker& makeHair) {
  const bool hasCheckpoints = folder_ && (options_.checkpointFrames > 0 || folder_->checkpoint());
  if (hasCheckpoints) {
    auto made =
        RunCheckpoints::make(*folder_, options_.checkpointFrames, factsOf(scene_, options_), options_.words);
    if (!made) return made.error();
    checkpoints_ = std::move(*made);
  }
  auto hair = makeHair(hairInputOf(scene_, frames_, options_));
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
  if (!options_.trace.empty()) {
    auto trace = TraceFile::create(options_.trace);
    if (!trace) return trace.error();
    trace_.emplace(std::move(*trace));
  }
  timesBefore_ = hair_->times();
  auto stepper = Stepper::make(*hair_, scene_, options_.measuresContacts);
  if (!stepper) return stepper.error();
  stepper_.emplace(std::move(*stepper));
  return {};
}

Status Run::Work::makeSink() {
  const int done = outcome_.resumedFrom;
  if (folder_) {
    auto hairs = FullHair::ofScene(scene_, options_.hairs, options_.look, options_.mover,
                                   CutList(frames_, scene_.frameCount));
    if (!hairs) return hairs.error();
    writers_.emplace(scene_, options_, std::move(*hairs), done);
  }
  if (!scene_.bodies.empty()) bodyWatch_.emplace(scene_.groom, scene_.bodies, scene_.settings.rootCount);
  const bool writesFrames = !animationsOf(options_).empty() || options_.writesSheet || events_.written;
  FrameReaders readers{.bodies = bodyWatch_ ? &*bodyWatch_ : nullptr,
                       .observe = {},
                       .write = {},
                       .needLastOnly = !writesFrames && (!events_.observe || options_.observesLast)};
  if (events_.observe) {
    readers.observe = [this](const ComputedFrame& frame, std::span<const Vec3f> points) -> Status {
      const Status seen = events_.observe(points, frame.head);
      return seen ? seen : afterFrames(frame.number - 1, seen.error(), options_);
    };
  }
  if (writers_) {
    readers.write = [this](int number, std::vector<Vec3f> points, const ComputedFrame& frame) -> Status {
      if (Status added = writers_->addFrame(number, std::move(points), frame.head, frame.bodies); !added)
        return added;
      if (events_.written) events_.written(number);
      return {};
    };
  }
  disk_.emplace(1);
  sink_.emplace(scene_.groom, std::move(readers));
  return done > 0 ? restore() : Status{};
}

// Steps the motion up to the first frame, so that hair is already moving when it begins.
Status Run::Work::preRoll() {
  for (int number = frames_.first(); number < 0 && !isStopped(); ++number) {
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

Status Run::Work::restore() {
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

// Submits a frame; meanwhile the frame before it is read back, and earlier ones are written.
Result<bool> Run::Work::next() {
  if (frame_ == outcome_.resumedFrom) firstFrame_ = Clock::now();
  if (frame_ >= scene_.frameCount || isStopped()) return false;
  tellProgress();
  if (checkpoints_.areDueAt(frame_) && frame_ > outcome_.resumedFrom) {
    if (Status saved = saveAt(frame_); !saved) return saved.error();
  }
  const auto frame = [&] {
    Stopwatch watch(posesTime_);
    return frames_.at(frame_);
  }();
  if (!frame) {
    (void)takeUnderWay();  // the frame in flight may be complete
    return afterWritten(frame.error());
  }
  if (Status stepped = step(*frame); !stepped) return stepped.error();
  ++frame_;
  return true;
}

Status Run::Work::step(const SceneFrame& frame) {
  if (!frame.change.isNone()) {
    if (Status taken = takeUnderWay(); !taken) return taken;
  }
  if (Status submitted = stepper_->submit(frame); !submitted) {
    (void)takeUnderWay();  // the frame in flight may be complete
    return afterWritten(submitted.error());
  }
  if (Status taken = takeUnderWay(); !taken) return taken;
  const auto bodies = frame.bodiesAtEnd();
  underWay_ = {frame_ + 1, {}, frame.heads.back(), {bodies.begin(), bodies.end()}, frame.pointsAtEnd()};
  return {};
}

Status Run::Work::finishFrames() {
  if (firstFrame_ == Clock::time_point{}) firstFrame_ = Clock::now();
  if (Status taken = takeUnderWay(); !taken) return taken;
  tellFirstFrame();
  if (frame_ < scene_.frameCount && checkpoints_.areWanted()) {
    if (Status saved = saveAt(frame_); !saved) return saved;
  }
  Status written = finishWriting();
  tellProgress();
  lastFrame_ = Clock::now();
  return written;
}

Result<RunOutcome> Run::Work::finish() {
  for (const auto part : {&Work::finishFrames, &Work::finishFiles, &Work::tellReports, &Work::finishTrace}) {
    if (Status done = (this->*part)(); !done) return done.error();
  }
  tellTimes();
  tellWarnings();
  return std::move(outcome_);
}

Status Run::Work::takeUnderWay() {
  if (!underWay_) return {};
  ComputedFrame frame = std::move(*underWay_);
  underWay_.reset();
  const Status waited = stepper_->wait();
  tellFirstFrame();
  if (!waited) return afterWritten(waited.error());
  if (trace_) trace_->addFrame(frame.number, hair_->frameStages());
  {
    Stopwatch watch(readbackTime_);
    frame.positions = stepper_->framePositions(sink_->takeRoom());
  }
  if (events_.computed) events_.computed(frame);
  Stopwatch watch(waitedForWriter_);
  return sink_->hand(std::move(frame));
}

// Writes a checkpoint after `frame` frames: saves the hair's state now; adds what is known of those frames on
// the sink's thread; and writes both to disk on a third thread while frames go on.
Status Run::Work::saveAt(int frame) {
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

Status Run::Work::finishWriting() {
  const Status written = sink_->finish();
  const Status saved = disk_->finish();
  return written ? saved : written;
}

Error Run::Work::afterWritten(const Error& cause) {
  (void)finishWriting();
  return afterFrames(sink_->frameCount(), cause, options_);
}

// Finishes the files with the frames written so far, unless another run resumes this one.
Status Run::Work::finishFiles() {
  outcome_.frameCount = sink_->frameCount();
  outcome_.interrupted = outcome_.frameCount < scene_.frameCount;
  outcome_.canResume = outcome_.interrupted && checkpoints_.areWanted();
  if (writers_ && outcome_.frameCount > 0 && !outcome_.canResume) {
    auto outputs = writers_->finish();
    if (!outputs) return outputs.error();
    outcome_.outputs = std::move(*outputs);
    outcome_.cacheErrorBound = writers_->errorBound();
    outcome_.hairCount = writers_->hairCount();
    outcome_.follow = writers_->followNumbers();
    folder_->finish();
  }
  outcome_.wall = {secondsBetween(start_, firstFrame_), secondsBetween(firstFrame_, lastFrame_),
                   secondsBetween(lastFrame_, Clock::now())};
  return {};
}

void Run::Work::tellBodies() {
  outcome_.bodyNumbers = bodyWatch_->numbers();
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    outcome_.bodies.push_back(bodyOutcome(scene_.bodies[b], bodyWatch_->numbersOf(b)));
}

Status Run::Work::tellReports() {
  const auto reports = hair_->reports();
  if (!reports) return reports.error();
  outcome_.report = reports->hair;
  outcome_.report.nonfinite = std::max<std::uint64_t>(reports->hair.nonfinite, sink_->mostReplaced());
  if (measuresResidual(scene_, options_)) outcome_.velocityResidual = reports->hair.velocityResidual;
  outcome_.positions = sink_->takeLastPositions();
  if (outcome_.positions.empty()) {
    auto positions = hair_->positions();
    if (!positions) return positions.error();
    outcome_.positions = std::move(*positions);
  }
  outcome_.positionsHash = positionsHash(outcome_.positions);
  outcome_.hair = hair_->facts();
  if (bodyWatch_) tellBodies();
  stepper_->tell(reports->contacts, outcome_);
  return {};
}

// Times per frame of this run, without frames that an earlier run had done.
void Run::Work::tellTimes() {
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

void Run::Work::tellWarnings() {
  const auto add = [&](const std::vector<std::string>& warnings) {
    outcome_.warnings.insert(outcome_.warnings.end(), warnings.begin(), warnings.end());
  };
  outcome_.notes = scene_.notes;
  add(scene_.warnings);
  if (folder_) add(folder_->warnings());
  add(stepper_->warnings());
  if (outcome_.contacts) add(outcome_.contacts->warnings());
  for (const BodyOutcome& body : outcome_.bodies)
    if (const auto caught = caughtWarning(body)) outcome_.warnings.push_back(*caught);
  add(outcome_.hair.messages);
}

Run::Run(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Run::Run(Run&&) noexcept = default;
Run::~Run() = default;

Result<Run> Run::open(const LoadedScene& scene, RunOptions options, const HairMaker& makeHair,
                      RunEvents events) {
  auto work = std::make_unique<Work>(scene, std::move(options), std::move(events));
  if (Status opened = work->open(makeHair); !opened) return opened.error();
  return Run(std::move(work));
}

int Run::resumedFrom() const { return work_->resumedFrom(); }
Result<bool> Run::next() { return work_->next(); }
Result<RunOutcome> Run::finish() { return work_->finish(); }

Result<RunOutcome> runScene(const LoadedScene& scene, const RunOptions& options, const HairMaker& makeHair,
                            RunEvents events) {
  auto run = Run::open(scene, options, makeHair, std::move(events));
  if (!run) return run.error();
  for (;;) {
    const auto more = run->next();
    if (!more) return more.error();
    if (!*more) break;
  }
  return run->finish();
}

}  // namespace ringlet
