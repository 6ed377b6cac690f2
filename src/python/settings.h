// Settings by name, for all parts of the module.
#pragma once

#include <string>

#include "python/binding.h"
#include "ringlet/scene/settings.h"

namespace ringlet::python {

/// Sets some by name, all or none: {"gravity": (0, -5, 0), "contacts": {"friction": 0.2}}. Throws TypeError
/// for a name that there is not, ValueError for a number out of its range.
void setAll(Settings& settings, const py::kwargs& named);

}  // namespace ringlet::python
