// A material as a table of a larger file, read and written with the keys of a material file. Private to the
// library: it shows toml++.
#pragma once

#include <string>
#include <vector>

#include "ringlet/rest/material_file.h"
#include "ringlet/rest/toml_file.h"

namespace ringlet {

/// Every key a material may have, below a table of that name ("" for a file of its own).
std::vector<KnownKey> knownMaterialKeys(const std::string& table);

/// Works the keys of a table into a material; those that are not there stay as they are, but `preset`
/// replaces all. Keys that nobody knows go unseen at the table's own level, so that it may have others, and
/// are problems below it. Adds no warnings.
void readMaterialTable(const toml::table& table, const std::string& name, LoadedMaterial& loaded,
                       TomlProblems& problems);

/// What of a material is not Material's default, and of its dials, as a table of that name; a comment above
/// every number. "" where all is.
std::string materialTableText(const Material& material, const MaterialDials& dials, const std::string& name);

}  // namespace ringlet
