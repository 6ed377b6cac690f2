// whyNotBelow: of a file that another file names, whether it may be read: from that one's folder and below
// it, and from nowhere else. A file of a stranger reads nothing else.
#pragma once

#include <filesystem>
#include <string>

namespace ringlet {

/// Why the file is not read; empty where it may be. Refused: a name that is absolute, has a scheme, a
/// backslash or a NUL, or leads out of the folder ("": the current one), symbolic links followed. `format` is
/// that of the file that names it: "glTF".
std::string whyNotBelow(const std::string& name, const std::filesystem::path& folder, const char* format);

}  // namespace ringlet
