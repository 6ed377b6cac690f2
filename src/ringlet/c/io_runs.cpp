// Implements c/ringlet_io.h: whole runs of scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/host_words.h"
#include "ringlet/c/io_handles.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/run/run.h"
#include "ringlet/run/run_facts.h"

namespace ringlet::c {
namespace {

Outcome checkNumbers(const ringlet_run_options& asked) {
  const auto in = [](auto value, int least, int most) { return value >= least && value <= most; };
  if (!in(asked.frame_count, 0, kMostFrame))
    return Outcome::invalid(
        fmt::format("frame_count is {}; it takes 0 to {}", asked.frame_count, kMostFrame));
  if (!in(asked.checkpoint_frames, 0, kMostFrame))
    return Outcome::invalid(
        fmt::format("checkpoint_frames is {}; it takes 0 to {}", asked.checkpoint_frames, kMostFrame));
  if (!in(static_cast<int>(asked.leftovers), 0, 3))
    return Outcome::invalid(
        fmt::format("leftovers is {}; it takes 0 to 3", static_cast<int>(asked.leftovers)));
  if (!asked.folder && (asked.files || asked.checkpoint_frames > 0 || asked.leftovers != 0))
    return Outcome::invalid(
        "files, checkpoint_frames and leftovers are of a run that writes, and folder is NULL");
  return {};
}

Outcome takeDevices(const ringlet_run_options& asked, std::vector<ComputeDevice>& devices) {
  for (std::uint32_t k = 0; k < asked.device_count; ++k) {
    if (!asked.devices || !asked.devices[k])
      return Outcome::invalid(fmt::format("device {} of {} is NULL", k, asked.device_count));
    devices.push_back(asked.devices[k]->device);
  }
  return {};
}

Outcome takeFiles(const ringlet_run_options& asked, SceneOutput& output) {
  if (!asked.files) return {};
  std::vector<std::string> names;
  for (std::uint32_t k = 0; k < asked.file_count; ++k) {
    if (!asked.files[k]) return Outcome::invalid(fmt::format("file {} of {} is NULL", k, asked.file_count));
    names.emplace_back(asked.files[k]);
  }
  const Status chosen = chooseFiles(names, output);
  return chosen ? Outcome() : Outcome::invalid(chosen.error().message);
}

RunOptions optionsOf(const SceneFile& file, const ringlet_run_options& asked) {
  RunOptions options = runOptionsOf(file);
  options.folder = asked.folder ? asked.folder : "";
  options.checkpointFrames = asked.checkpoint_frames;
  options.leftovers = static_cast<Leftovers>(asked.leftovers);
  options.words = {.overwrite = "RINGLET_LEFTOVERS_OVERWRITE",
                   .resume = "RINGLET_LEFTOVERS_RESUME",
                   .elsewhere = "another folder",
                   .who = "a host of ringlet"};
  return options;
}

// Frames until all are done or the caller ends it.
Result<RunOutcome> run(const LoadedScene& scene, RunOptions options, std::vector<ComputeDevice> devices,
                       const ringlet_run_options& asked) {
  bool isStopped = false;
  RunEvents events{.isStopped = [&] { return isStopped; }};
  if (asked.go_on) {
    events.computed = [&](const ComputedFrame& frame) {
      if (!isStopped) isStopped = asked.go_on(frame.number, asked.user) == 0;
    };
  }
  if (devices.empty()) {
    auto opened = ComputeDevice::open();
    if (!opened) return opened.error();
    devices.push_back(std::move(*opened));
  }
  options.mover = followOn(devices.front());
  return runScene(scene, options, hairOn(std::move(devices)), std::move(events));
}

Outcome runAll(const ringlet_scene& of, const ringlet_run_options& asked, ringlet_run_result* result,
               float* xyz) {
  std::vector<ComputeDevice> devices;
  SceneFile file = of.file;
  for (Outcome taken : {checkNumbers(asked), takeDevices(asked, devices), takeFiles(asked, file.output)})
    if (!taken.isFine()) return taken;
  LoadedScene scene = *of.loaded;
  if (asked.frame_count > 0) scene.frameCount = asked.frame_count;
  RunOptions options = optionsOf(file, asked);
  std::optional<LoadedGroom> origin;
  if (asked.folder) {
    if (Status prepared = prepareRun(file, of.path, origin, options); !prepared)
      return inSceneWords(prepared.error());
  }
  const std::size_t before = scene.warnings.size();  // which were told as it was read
  const auto outcome = run(scene, std::move(options), std::move(devices), asked);
  if (!outcome) return inSceneWords(outcome.error());
  std::vector<std::string> warnings(outcome->warnings.begin() + static_cast<std::ptrdiff_t>(before),
                                    outcome->warnings.end());
  for (std::string& sentence : warnings) sentence = inSceneWords(sentence);
  warnOf(warnings, asked.warn, asked.user);
  if (xyz) std::memcpy(xyz, outcome->positions.data(), outcome->positions.size() * sizeof(Vec3f));
  if (!result) return {};
  ringlet_run_result told{.struct_size = 0,
                          .frame_count = outcome->frameCount,
                          .resumed_from = outcome->resumedFrom,
                          .interrupted = outcome->interrupted,
                          .can_resume = outcome->canResume,
                          .positions_hash = {}};
  outcome->positionsHash.copy(told.positions_hash, sizeof(told.positions_hash) - 1);
  give(result, told);
  return {};
}

}  // namespace
}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_scene_run(const ringlet_scene* scene, const ringlet_run_options* options,
                                 ringlet_run_result* result, float* xyz, uint64_t particle_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_scene_run takes a scene, how to run it and a result to fill",
            {given("scene", scene), sizedOrNull("options", options), sizedOrNull("result", result)});
        !wrong.isFine())
      return wrong;
    const std::size_t count = scene->loaded->groom.points.size();
    if (xyz && particle_count != count)
      return Outcome::invalid(
          fmt::format("particle_count is {}; the scene's groom has {} particles", particle_count, count));
    return runAll(*scene, taken(options), result, xyz);
  });
}
