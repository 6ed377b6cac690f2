// Implements confined_option.h.
#include "program/cli/confined_option.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <system_error>

namespace ringlet::program {

void addConfinedOption(CLI::App& command, SceneReach& reach) {
  command.add_flag_function(
      "--confined",
      [&reach](std::int64_t count) { reach = count > 0 ? SceneReach::ownFolder : SceneReach::anywhere; },
      "For a scene file of a stranger: refuse it where it names a file to read, or a folder for results, "
      "that is not in or below its own folder, links followed");
}

Status checkHoldsNoLinks(const std::filesystem::path& folder) {
  std::error_code code;
  if (!std::filesystem::exists(folder, code)) return {};
  auto entry = std::filesystem::recursive_directory_iterator(folder, code);
  for (; !code && entry != std::filesystem::recursive_directory_iterator(); entry.increment(code)) {
    if (entry->is_symlink(code))
      return Error{fmt::format("{} is a symbolic link; with --confined the folder of the results holds none",
                               entry->path().string()),
                   Fault::output};
  }
  if (!code) return {};
  return Error{fmt::format("cannot look into {}: {}", folder.string(), code.message()), Fault::output};
}

}  // namespace ringlet::program
