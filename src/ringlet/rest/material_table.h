// A material as a table of a larger file, read and written with the keys of a material file. Private to the
// library, since it includes toml++.
#pragma once

#include <string>
#include <vector>

#include "ringlet/rest/material_file.h"
#include "ringlet/rest/toml_file.h"

namespace ringlet {

/// All keys of a material, below a table of that name ("" for a file of its own).
std::vector<KnownKey> knownMaterialKeys(const std::string& table);

/// Reads the keys of a table into a material. Numbers without a key keep their values; the key `preset`
/// replaces all of them. Unknown keys at the table's own level are ignored, since other readers may know
/// them; in its sub-tables they are problems. Adds no warnings.
void readMaterialTable(const toml::table& table, const std::string& name, LoadedMaterial& loaded,
                       TomlProblems& problems);

/// The numbers of a material and its dials that differ from the default, as a table of that name, with a
/// comment above each; "" if none differs.
std::string materialTableText(const Material& material, const MaterialDials& dials, const std::string& name);

}  // namespace ringlet
