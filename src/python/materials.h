// A material as Python holds it: its numbers, and the dials on top of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/binding.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scene/settings.h"

namespace ringlet::python {

struct MaterialObject {
  Material material;
  MaterialDials dials;
  std::vector<std::string> warnings{};  // of its file
};

/// The material with its dials worked in. Where settings.max_stretch is the default, the bounce decides it.
/// What the dials could not do is a sentence for `warnings`. Throws Failure for a material that dials spoil.
Material dialled(const MaterialObject& object, Settings& settings, std::vector<std::string>& warnings);

/// For a fingerprint: all numbers.
std::string textOf(const Material& material);

}  // namespace ringlet::python
