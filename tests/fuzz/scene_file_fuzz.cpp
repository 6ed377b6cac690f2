// Scene files: what is read is written, and what is written is read as the same.
#include "ringlet/scenes/file/scene_file.h"

#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 4 << 20, .perByte = 4096};

void tryBytes(std::span<const std::byte> bytes) {
  const auto scene = parseScene(textOf(bytes), "fuzz.toml", kNoFolder);
  if (!scene) {
    demand(!scene.error().message.empty(), "an error has a message");
    return;
  }
  const std::string text = sceneText(*scene, kNoFolder);
  const auto again = parseScene(text, "again.toml", kNoFolder);
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  demand(static_cast<bool>(again), "a scene that is written can be read");
  demand(again->material.material == scene->material.material, "materials keep their bits");
  demand(sceneText(*again, kNoFolder) == text, "a scene that is read is written as it was");
}

}  // namespace ringlet::fuzz
