// Material files: what is read is written, and what is written is read as the same.
#include "ringlet/rest/material_file.h"

#include "ringlet/rest/material_parameters.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 4 << 20, .perByte = 4096};

void tryBytes(std::span<const std::byte> bytes) {
  const auto loaded = parseMaterial(textOf(bytes), "fuzz.toml");
  if (!loaded) return;
  demand(checkMaterial(loaded->material) && checkDials(loaded->dials),
         "a material that is read is in its ranges");
  const auto again = parseMaterial(materialText(loaded->material, loaded->dials), "again.toml");
  demand(static_cast<bool>(again), "a material that is written can be read");
  demand(again->material == loaded->material && again->dials == loaded->dials, "materials keep their bits");
}

}  // namespace ringlet::fuzz
