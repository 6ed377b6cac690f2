// Keys of a scene that are set beside its file. Private to the library: it shows toml++.
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/rest/toml_file.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Sets the key in a parsed file; tables that are not there are made. Whether a scene has such a key, its
/// reader finds out. Errors: no dotted key, a list without that table, a way through what is no table.
Status applyChange(const SceneChange& change, toml::table& file);

}  // namespace ringlet
