// Options that are keys of a scene under a name of their own, made from what sceneKeys() says of the key; and
// --set, which takes any key. Both end as changes of the scene (scenes/file/scene_file.h).
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

/// Keys as typed. What stands later goes over what stands before; --set goes over options.
struct TypedKeys {
  std::vector<SceneChange> options;
  std::vector<std::string> sets;  // KEY=VALUE

  /// Whether an option, not --set, says this key ("simulation.gravity").
  bool has(std::string_view key) const;
  /// The first option that was typed of a key of this table; "" for none.
  std::string optionOf(std::string_view table) const;
  bool isEmpty() const { return options.empty() && sets.empty(); }
  std::vector<SceneChange> changes() const;
};

/// Adds the options of a table's keys ("groom.cut"), in a group of the help. `typed` must outlive the
/// command.
void addKeyOptions(CLI::App& command, TypedKeys& typed, std::string_view table, const std::string& group);

/// Adds the options of these keys only, each with its table.
void addOptionsOfKeys(CLI::App& command, TypedKeys& typed, const std::vector<std::string_view>& keys,
                      const std::string& group = "");

/// The option of a key ("--gravity"); "" where it has none.
std::string optionNamed(std::string_view key);

/// Adds --set.
void addSetOption(CLI::App& command, TypedKeys& typed, const std::string& group = "");

/// The scene of a file, keys as typed. Throws CLI11's error for keys that the scene does not take, by the
/// names of their options. Errors: those of the file.
Result<SceneFile> readTypedScene(const std::filesystem::path& file, const TypedKeys& typed, SceneReach reach);

/// The same, or of a groom's file, whose head then moves as the built-in motion `motion`.
Result<SceneFile> readTyped(const std::filesystem::path& input, const TypedKeys& typed, SceneReach reach,
                            const char* motion);

/// The same from a scene's text.
Result<SceneFile> parseTyped(std::string_view text, const std::string& name, const TypedKeys& typed);

/// Adds the options of how hairs that follow strands differ from them.
void addHairLookOptions(CLI::App& command, TypedKeys& typed);
/// What was typed of them. Throws CLI11's error for what a scene refuses, as an empty path.
HairLook hairLookOf(const TypedKeys& typed);

/// How a groom's file is read, options of [groom] as typed.
GroomReading readingOf(const TypedKeys& typed, bool upIsZ = false);

}  // namespace ringlet::program
