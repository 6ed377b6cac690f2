// Options that set a key of a scene and have a name of their own; they are made from sceneKeys(). And --set,
// which sets any key. Both become changes of the scene (scenes/file/scene_file.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "program/cli/cli_fwd.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// Keys as typed. Later ones override earlier ones; --set overrides options.
struct TypedKeys {
  std::vector<SceneChange> options;
  std::vector<std::string> sets;  // KEY=VALUE

  /// Whether an option, not --set, sets this key ("simulation.gravity").
  bool has(std::string_view key) const;
  /// The first option typed that sets a key of this table; "" if none does.
  std::string optionOf(std::string_view table) const;
  bool isEmpty() const { return options.empty() && sets.empty(); }
  std::vector<SceneChange> changes() const;
};

/// Adds the options for the keys of a table ("groom.cut") as a group of the help. `typed` must outlive the
/// command.
void addKeyOptions(CLI::App& command, TypedKeys& typed, std::string_view table, const std::string& group);

/// Adds only the options for these keys, each given with its table.
void addOptionsOfKeys(CLI::App& command, TypedKeys& typed, const std::vector<std::string_view>& keys,
                      const std::string& group = "");

/// The option that sets a key ("--gravity"); "" if there is none.
std::string optionNamed(std::string_view key);

/// Adds --set.
void addSetOption(CLI::App& command, TypedKeys& typed, const std::string& group = "");

/// Reads a scene file with keys as typed. Throws CLI11's error, with the names of options, for keys that the
/// scene refuses. Errors: those of the file.
Result<SceneFile> readTypedScene(const std::filesystem::path& file, const TypedKeys& typed, SceneReach reach);

/// The same; or for a groom's file a scene whose head moves as the built-in motion `motion`.
Result<SceneFile> readTyped(const std::filesystem::path& input, const TypedKeys& typed, SceneReach reach,
                            const char* motion);

/// The same from a scene's text.
Result<SceneFile> parseTyped(std::string_view text, const std::string& name, const TypedKeys& typed);

/// Adds the options for how following hairs differ from their strands.
void addHairLookOptions(CLI::App& command, TypedKeys& typed);
/// The values typed for these. Throws CLI11's error for what a scene refuses, such as an empty path.
HairLook hairLookOf(const TypedKeys& typed);

/// How a groom's file is read, with the options of [groom] as typed.
GroomReading readingOf(const TypedKeys& typed, bool upIsZ = false);

}  // namespace ringlet::program
