// joint_name: a joint among many by its name, as files of every origin write it, and what to say when it is
// not there.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

/// The first of exactly that name; else, whatever the case, by the whole or by what stands after a colon
/// ("mixamorig:Head"). Empty names are nobody's.
std::optional<std::size_t> findJoint(const std::vector<std::string>& names, std::string_view wanted);

/// "FILE has no joint Haed; did you mean Head? It has Hips, Head": the nearest, and the first dozen. `what`
/// is what the file calls its joints.
Error noSuchJoint(const std::string& file, std::string_view what, std::string_view wanted,
                  const std::vector<std::string>& names);

}  // namespace ringlet
