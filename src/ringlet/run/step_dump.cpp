// Implements run/step_dump.h.
#include "ringlet/run/step_dump.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <system_error>

#include "ringlet/output/byte_file.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/scene_frames.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

Result<Simulation> hairAt(const LoadedScene& scene, const SceneFrames& frames,
                          const DeviceHairChoice& choice) {
  const ScenePlaces start = frames.placesAt(frames.first());
  KernelChoice kernel = choice.kernel;
  kernel.geometry = scene.geometry.get();
  return Simulation::create(choice.device, scene.groom, scene.material, stepByStep(frames.settings()),
                            stateOf(start, scene), kernelOf(scene, kernel));
}

// To the end of that step, and no further.
Status stepTo(std::uint64_t last, const LoadedScene& scene, const SceneFrames& frames, Simulation& hair) {
  std::uint64_t done = 0;
  for (int number = frames.first(); number < scene.frameCount; ++number) {
    const auto frame = frames.at(number);
    if (!frame) return frame.error();
    for (std::size_t k = 0; k < frame->stepCount(); ++k) {
      const SceneFrame step = frame->step(k);
      if (Status prepared = prepare(step, hair, true); !prepared) return prepared;
      if (Status stepped = hair.stepFrame(step.heads, step.bodies, step.roots); !stepped) return stepped;
      if (number >= 0 && ++done == last) return {};
    }
  }
  return Error{
      fmt::format("could not stop after step {}: the scene has {} steps, 1 being the first", last, done),
      Fault::input};
}

Status writeFile(const fs::path& path, std::string_view bytes) {
  auto file = ByteFile::create(path.string() + ".partial");
  if (!file) return file.error();
  if (Status written = file->writeAt(0, bytes); !written) return written;
  return file->closeAs(path);
}

Status writeBuffers(const Simulation& hair, const fs::path& folder) {
  const auto contents = hair.bufferContents();
  if (!contents) return contents.error();
  std::string list;
  for (const BufferContent& buffer : *contents) {
    const std::string_view bytes(reinterpret_cast<const char*>(buffer.bytes.data()), buffer.bytes.size());
    if (Status written = writeFile(folder / (buffer.name + ".bin"), bytes); !written) return written;
    list += fmt::format("{:>12} {}\n", bytes.size(), buffer.name);
  }
  return writeFile(folder / "buffers.txt", list);
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
  auto hair = hairAt(scene, frames, choice);
  if (!hair) return hair.error();
  if (Status stepped = stepTo(step, scene, frames, *hair); !stepped) return stepped;
  fs::create_directories(folder, code);
  if (code)
    return Error{fmt::format("could not create the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  return writeBuffers(*hair, folder);
}

}  // namespace ringlet
