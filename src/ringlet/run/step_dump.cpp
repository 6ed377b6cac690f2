// Implements run/step_dump.h.
#include "ringlet/run/step_dump.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <system_error>

#include "ringlet/base/whole_file.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

// Steps to the end of step `last` and no further.
Status stepTo(std::uint64_t last, const LoadedScene& scene, const SceneFrames& frames, Simulation& hair) {
  std::uint64_t done = 0;
  for (int number = frames.first(); number < scene.frameCount; ++number) {
    const auto frame = frames.at(number);
    if (!frame) return frame.error();
    for (std::size_t k = 0; k < frame->stepCount(); ++k) {
      const SceneFrame step = frame->step(k);
      if (Status prepared = prepare(step, hair, true); !prepared) return prepared;
      if (Status stepped = hair.stepFrame(step.heads, step.bodies, step.roots, step.bodyPoints()); !stepped)
        return stepped;
      if (number >= 0 && ++done == last) return {};
    }
  }
  return Error{
      fmt::format("could not stop after step {}: the scene has {} steps, 1 being the first", last, done),
      Fault::input};
}

Status writeBuffers(const Simulation& hair, const fs::path& folder) {
  const auto contents = Diagnostics(hair).bufferContents();
  if (!contents) return contents.error();
  std::string list;
  for (const BufferContent& buffer : *contents) {
    std::string name = buffer.name + ".bin";
    std::ranges::replace(name, ' ', '_');
    if (Status written = writeWholeFile(folder / name, buffer.bytes); !written) return written;
    list += fmt::format("{:>12} {}\n", buffer.bytes.size(), name);
  }
  return writeWholeFile(folder / "buffers.txt", std::as_bytes(std::span(list)));
}

}  // namespace

Status dumpStep(const LoadedScene& scene, const DeviceHairChoice& choice, std::uint64_t step,
                const fs::path& folder) {
  std::error_code code;
  if (fs::exists(folder, code))
    return Error{
        fmt::format("could not write buffers into {}: it is there; name another folder, or remove it",
                    folder.string()),
        Fault::output};
  const SceneFrames frames(scene);
  auto hair = makeSimulation({.scene = scene, .frames = frames, .isStepByStep = true}, choice);
  if (!hair) return hair.error();
  if (Status stepped = stepTo(step, scene, frames, *hair); !stepped) return stepped;
  fs::create_directories(folder, code);
  if (code)
    return Error{fmt::format("could not create the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  return writeBuffers(*hair, folder);
}

}  // namespace ringlet
