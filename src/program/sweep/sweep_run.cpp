// Implements sweep_run.h.
#include "program/sweep/sweep_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "program/cli/exit_codes.h"
#include "program/cli/interruption.h"
#include "program/cli/progress_bar.h"
#include "program/cli/standard_error.h"
#include "program/device/gpu_hair.h"
#include "program/measure/measure_report.h"
#include "program/simulate/output_options.h"
#include "program/simulate/run_report.h"
#include "program/simulate/simulate_run.h"
#include "program/sweep/sweep_record.h"
#include "program/sweep/sweep_sheet.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/measure/pose_numbers.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/run/run_facts.h"
#include "ringlet/run/run_folder.h"
#include "ringlet/run/run_writers.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRecord = "run.json";
constexpr const char* kScene = "scene.toml";

// The options of a run: what it writes, and where.
SimulateOptions optionsOf(const SweepRun& run, const SweepOptions& sweep) {
  SimulateOptions options(runOptionsOf(run.scene));
  options.folder = folderOf(run, sweep);
  options.writesLast = true;  // the sheet is drawn from it
  if (sweep.lastOnly) {
    options.animations.clear();
    options.writesSheet = options.usesGroomPrims = false;
    options.cache.reset();
  }
  options.onReference = sweep.onReference;
  options.device = sweep.device;
  options.usesTuned = sweep.usesTuned;
  options.showProgress = false;
  options.tellsFrames = sweep.tellsProgress;
  options.observesLast = !sweep.measures;
  options.runNumber = run.number;
  return options;
}

// The scene as a file for the run's folder, so that `ringlet simulate` can repeat the run.
std::string sceneTextOf(const SweepRun& run) {
  std::string heading = fmt::format("# Run {} of a sweep:\n", run.number);
  for (const SceneChange& change : run.changes)
    heading += fmt::format("#   {} = {}\n", change.key, change.value);
  return sceneText(run.scene, {}, heading);
}

bool holdsText(const fs::path& path, const std::string& text) {
  const auto bytes = readWholeFile(path);
  return bytes && std::ranges::equal(*bytes, std::as_bytes(std::span<const char>(text)));
}

// The facts of runs. A file that several runs read is examined only once.
class SweepFacts {
 public:
  explicit SweepFacts(const SweepOptions& options) : options_(options) {}

  Result<std::vector<RunFact>> of(const SweepRun& run) {
    auto facts = factsOf(run.scene, {});
    if (!facts) return facts.error();
    const std::vector<fs::path> inputs = inputFilesOf({}, run.scene);
    if (!contents_.contains(inputs)) {
      auto contents = factsOf(SceneFile{}, inputs);
      if (!contents) return contents.error();
      contents_[inputs] = std::move(*contents);
    }
    facts->insert(facts->end(), contents_[inputs].begin(), contents_[inputs].end());
    const auto add = [&](const char* name, auto value) {
      facts->push_back({name, fmt::format("{}", value)});
    };
    add("program", RINGLET_VERSION);
    add("backend", options_.onReference ? "reference" : "gpu");
    addOutputFacts(optionsOf(run, options_), *facts);
    add("measured frames", options_.measures);
    return facts;
  }

 private:
  const SweepOptions& options_;
  std::map<std::vector<fs::path>, std::vector<RunFact>> contents_;
};

// Keeps the last frame and, if asked for, measures all of them; on the writer's thread.
class FrameWatch {
 public:
  FrameWatch(const LoadedScene& scene, Vec3d up) : scene_(scene), up_(up) {}

  Status measureFrames() {
    auto made = MotionMeasure::make(scene_.groom, {.framesPerSecond = scene_.settings.framesPerSecond,
                                                   .up = up_,
                                                   .lineDensity = scene_.material.lineDensity});
    if (!made) return made.error();
    measure_.emplace(std::move(*made));
    return look(scene_.groom.points, scene_.motion.poseAt(0));
  }

  Status look(std::span<const Vec3f> points, const HeadPose& head) {
    last_.assign(points.begin(), points.end());
    head_ = head;
    return measure_ ? measure_->addFrame(points, scene_.groom.metresPerUnit, head.rotation) : Status{};
  }

  void tell(Json& report) const {
    const PoseNumbers numbers = poseNumbers(scene_.groom, last_, up_, head_.rotation);
    report["droop_mm"] = 1000 * numbers.droop;
    report["stretch_mean"] = numbers.meanStretch;
    report["stretch_max"] = numbers.maxStretch;
    report["metres_per_unit"] = scene_.groom.metresPerUnit;
    if (!measure_) return;
    Json curl;
    addCurlKeys(curl, curlNumbers(measure_->ruler(), measure_->report()));
    curl.erase("max_edge_stretch");  // the run's own value covers every step
    report.update(curl);
  }

  const std::vector<Vec3f>& lastPoints() const { return last_; }

 private:
  const LoadedScene& scene_;
  Vec3d up_;
  std::vector<Vec3f> last_;
  HeadPose head_;
  std::optional<MotionMeasure> measure_;
};

// Executes runs, with the data that they share. Runs may be on different threads.
class Sweep {
 public:
  explicit Sweep(const SweepOptions& options) : options_(options), facts_(options) {}

  /// The device of all runs, opened by the first; none with the reference.
  Result<std::optional<ComputeDevice>> device() {
    const std::scoped_lock lock(mutex_);
    if (device_ || options_.onReference) return device_;
    auto opened = openGpu(options_.device);
    if (!opened) return opened.error();
    device_ = std::move(*opened);
    return device_;
  }

  void run(SweepEntry& entry) {
    const auto failed = [&](const Error& error) {
      entry.state = RunState::failed;
      entry.error = error.message;
      entry.exitCode = program::exitCodeOf(error);
      if (error.fault != Fault::deviceLost) return;
      // The next run may find another device of that name, or the same one after its reset.
      const std::scoped_lock lock(mutex_);
      device_.reset();
    };
    try {
      if (Status ran = runAndRecord(entry); !ran) failed(ran.error());
    } catch (const std::bad_alloc&) {
      failed({"not enough memory for this run", Fault::hostMemory});
    }
  }

  /// Prints each warning once, with the runs it concerns.
  void tellWarnings() const {
    for (const auto& [sentence, runs] : warnings_) {
      const std::string others = runs.size() > 1 ? fmt::format(" and {} more", runs.size() - 1) : "";
      say("ringlet sweep: warning: run {}{}: {}\n", *runs.begin(), others, sentence);
    }
  }

 private:
  // A groom with its geometry, which each run would measure otherwise.
  struct SharedGroom {
    std::shared_ptr<const LoadedGroom> loaded;
    SharedGeometry geometry;  // none: each run reports the error
  };

  // Keeps one groom, for runs that need the same.
  Result<SharedGroom> groomOf(const SceneGroom& scene, bool withOrigin) {
    const std::scoped_lock lock(groomMutex_);
    if (groom_.loaded && groomScene_ == scene && groomHasOrigin_ == withOrigin) return groom_;
    auto read = loadGroom(scene, withOrigin);
    if (!read) return read.error();
    groom_.loaded = std::make_shared<const LoadedGroom>(std::move(*read));
    groom_.geometry.reset();
    if (auto measured = measureGeometry(groom_.loaded->groom))
      groom_.geometry = std::make_shared<const std::vector<StrandGeometry>>(std::move(*measured));
    groomScene_ = scene;
    groomHasOrigin_ = withOrigin;
    return groom_;
  }

  Result<std::vector<RunFact>> factsOf(const SweepRun& run) {
    const std::scoped_lock lock(mutex_);
    return facts_.of(run);
  }

  void noteWarnings(const std::vector<std::string>& warnings, int run) {
    const std::scoped_lock lock(mutex_);
    for (const std::string& warning : warnings) warnings_[warning].insert(run);
  }

  // Prepares the run's folder, with its scene. Files that a run of this scene left there are removed: without
  // a record it did not end. Nothing else is touched.
  Status prepareFolder(const SweepRun& run, const RunOptions& options) const {
    const fs::path& folder = options.folder;
    std::error_code code;
    fs::create_directories(folder, code);
    if (code)
      return Error{fmt::format("cannot create the folder {}: {}", folder.string(), code.message()),
                   Fault::output};
    const std::string text = sceneTextOf(run);
    if (!options_.overwrites && !holdsText(folder / kScene, text)) {
      if (Status isFree = checkFolderIsFree(folder, outputsOf(options), options.words); !isFree)
        return isFree;
    }
    fs::remove(folder / kRecord, code);
    return writeWholeFile(folder / kScene, std::as_bytes(std::span<const char>(text)));
  }

  Status runAndRecord(SweepEntry& entry) {
    const SweepRun& run = *entry.run;
    SimulateOptions options = optionsOf(run, options_);
    auto opened = device();
    if (!opened) return opened.error();
    options.opened = std::move(*opened);
    const auto groom = groomOf(run.scene.groom, needsOrigin(run.scene.output));
    if (!groom) return groom.error();
    auto scene = loadScene(run.scene, groom->loaded.get(), groom->geometry);
    if (!scene) return scene.error();
    auto facts = factsOf(run);
    if (!facts) return facts.error();
    if (Status chosen = chooseOrigin(*groom->loaded, options); !chosen) return chosen.error();
    if (Status prepared = prepareFolder(run, options); !prepared) return prepared;
    options.leftovers = Leftovers::overwrite;

    FrameWatch watch(*scene, run.scene.groom.up == "Z" ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0});
    if (options_.measures) {
      if (Status measured = watch.measureFrames(); !measured) return measured;
    }
    const auto outcome = simulate(*scene, options, [&](std::span<const Vec3f> points, const HeadPose& head) {
      return watch.look(points, head);
    });
    if (!outcome) return outcome.error();
    noteWarnings(outcome->warnings, run.number);
    if (outcome->interrupted) {
      entry.state = RunState::interrupted;
      entry.exitCode = kExitInterrupted;
      return {};
    }
    RunNames names{run.scene.simulation.integrator, options_.onReference ? "reference" : "gpu"};
    if (run.scene.hasMaterial) names.material = "scene";
    entry.report = runJson(names, scene->settings, *outcome);
    watch.tell(entry.report);
    entry.report["seconds"] = outcome->wall.start + outcome->wall.frames + outcome->wall.finish;
    if (options_.drawsSheet) entry.cell = cellOf(scene->groom, watch.lastPoints());
    entry.exitCode = outcome->report.nonfinite > 0 ? kExitNonfinite : kExitFine;
    if (Status written = writeRecord(options.folder / kRecord, {std::move(*facts), entry.report}); !written)
      return written;
    entry.state = RunState::finished;
    return {};
  }

  const SweepOptions& options_;
  std::mutex mutex_, groomMutex_;
  SweepFacts facts_;
  std::optional<ComputeDevice> device_;
  std::map<std::string, std::set<int>> warnings_;  // with the runs they concern
  SharedGroom groom_;
  SceneGroom groomScene_;  // which groom_ was read for
  bool groomHasOrigin_ = false;
};

// Output as runs end: a bar, lines of JSON, failures.
class SweepProgress {
 public:
  SweepProgress(std::size_t count, std::span<const SweepAxis> axes, const SweepOptions& options)
      : count_(count),
        axes_(axes),
        tellsLines_(options.tellsProgress),
        bar_(0, static_cast<int>(count), options.showProgress, "run") {
    bar_.show(0);
  }

  void tell(const SweepEntry& entry) {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (entry.state == RunState::failed) {
      bar_.clear();
      say("ringlet sweep: run {} ({}) failed: {}\n", entry.run->number, valuesText(*entry.run, axes_),
          entry.error);
    }
    if (tellsLines_) tellLine(entry);
    bar_.show(static_cast<int>(done_));
  }

  void clear() { bar_.clear(); }

 private:
  // Prints {"run": 3, "runs": 20, "state": "finished", "seconds": 3.1, "seconds_left": 17.6}
  void tellLine(const SweepEntry& entry) const {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    const std::string line = fmt::format(
        "{{\"run\": {}, \"runs\": {}, \"state\": \"{}\", \"seconds\": {:.3f}, \"seconds_left\": {:.3f}}}\n",
        entry.run->number, count_, nameOf(entry.state), seconds.count(),
        seconds.count() * static_cast<double>(count_ - done_) / static_cast<double>(done_));
    (void)std::fwrite(line.data(), 1, line.size(), stdout);
    (void)std::fflush(stdout);
  }

  std::size_t count_, done_ = 0;
  std::span<const SweepAxis> axes_;
  bool tellsLines_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  ProgressBar bar_;
};

}  // namespace

const char* nameOf(RunState state) {
  switch (state) {
    case RunState::finished:
      return "finished";
    case RunState::kept:
      return "kept";
    case RunState::failed:
      return "failed";
    case RunState::interrupted:
      return "interrupted";
    case RunState::open:
      break;
  }
  return "to do";
}

fs::path folderOf(const SweepRun& run, const SweepOptions& options) {
  return options.folder / fmt::format("run-{:04}", run.number);
}

Result<std::vector<SweepEntry>> lookAtRuns(std::span<const SweepRun> runs, const SweepOptions& options) {
  std::vector<SweepEntry> entries;
  SweepFacts known(options);
  for (const SweepRun& run : runs) {
    SweepEntry& entry = entries.emplace_back();
    entry.run = &run;
    entry.isOurs = (run.number - 1) % options.parts == options.part - 1;
    if (options.overwrites && entry.isOurs) continue;
    const fs::path folder = folderOf(run, options);
    auto record = readRecord(folder / kRecord);
    if (!record) return record.error();
    if (!*record) continue;
    const auto facts = known.of(run);
    if (!facts) continue;  // a file is missing; its run will report it
    if (const std::string differences = differencesOf(*facts, (*record)->facts); !differences.empty()) {
      return Error{
          fmt::format(
              "{} holds a finished run of something else: {}. Choose another folder with -o; --overwrite "
              "runs all anew",
              folder.string(), differences),
          Fault::input};
    }
    entry.state = RunState::kept;
    entry.report = std::move((*record)->report);
    if (entry.report.value("nonfinite", 0) > 0) entry.exitCode = kExitNonfinite;
  }
  return entries;
}

Status runSweep(std::vector<SweepEntry>& entries, std::span<const SweepAxis> axes,
                const SweepOptions& options) {
  catchInterruption();
  std::vector<SweepEntry*> open;
  for (SweepEntry& entry : entries) {
    if (entry.isOurs && entry.state == RunState::open) open.push_back(&entry);
  }
  if (open.empty()) return {};
  Sweep sweep(options);
  if (const auto opened = sweep.device(); !opened) return opened.error();

  SweepProgress progress(open.size(), axes, options);
  std::atomic<std::size_t> next = 0;
  inParallel(static_cast<unsigned>(std::min<std::size_t>(options.jobs, open.size())), [&] {
    for (std::size_t i; !wasInterrupted() && (i = next++) < open.size();) {
      sweep.run(*open[i]);
      progress.tell(*open[i]);
    }
  });
  progress.clear();
  sweep.tellWarnings();
  return {};
}

int exitCodeOf(std::span<const SweepEntry> entries) {
  int code = kExitFine;
  for (const SweepEntry& entry : entries) {
    const bool wasLeft = entry.isOurs && entry.state == RunState::open;
    if (wasLeft || entry.state == RunState::interrupted) return kExitInterrupted;
    const bool isWorse = entry.exitCode != kExitFine && (code == kExitFine || code == kExitNonfinite);
    if (entry.isOurs && isWorse) code = entry.exitCode;
  }
  return code;
}

}  // namespace ringlet::program
