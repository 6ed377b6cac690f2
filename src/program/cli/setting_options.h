// Options for settings: made from their tables (scene/setting_field.h), and read back through them.
#pragma once

#include <map>
#include <span>
#include <string>

#include "program/cli/cli_fwd.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet::program {

/// What was typed, by a setting's key.
using TypedSettings = std::map<std::string, std::string, std::less<>>;

/// Adds an option for each setting that has one. `table`: of a scene file, whose keys they are. `typed` must
/// outlive the command.
template <class Owner>
void addSettingOptions(CLI::App* command, std::span<const SettingField<Owner>> fields, const char* table,
                       TypedSettings& typed, const char* group);

/// Settings as typed, in place of what they are.
template <class Owner>
void applySettingOptions(std::span<const SettingField<Owner>> fields, const TypedSettings& typed,
                         Owner& settings);

/// The first option that was typed; "" for none.
template <class Owner>
std::string typedOption(std::span<const SettingField<Owner>> fields, const TypedSettings& typed) {
  for (const SettingField<Owner>& field : fields)
    if (typed.contains(field.key)) return field.option;
  return "";
}

}  // namespace ringlet::program
