// A material as Python holds it: its numbers, and the dials on top of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/binding.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_dials.h"

namespace ringlet::python {

struct MaterialObject {
  Material material;
  MaterialDials dials;
  std::vector<std::string> warnings{};  // of its file
};

/// The material with its dials worked in.
/// What the dials could not do is a sentence for `warnings`. Throws Failure for a material that dials spoil.
Material dialled(const MaterialObject& object, std::vector<std::string>& warnings);

}  // namespace ringlet::python
