// Implements key_options.h.
#include "program/cli/key_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>

#include "program/cli/command_line.h"
#include "ringlet/base/assert.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/scene/setting_field.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::program {
namespace {

struct KeyOption {
  const char *option, *table, *key;
  const char* type = "";     // for the help; "": from the kind of value
  const char* without = "";  // a key of the table that this one replaces
  const char* turnsOn = "";  // a switch of the table that must be on for this key to have an effect

  std::string fullKey() const { return fmt::format("{}.{}", table, key); }
};

// In the order of the help.
constexpr KeyOption kKeyOptions[] = {
    {"--unit", "groom", "unit"},
    {"--up", "groom", "up", "AXIS"},
    {"--root-end", "groom", "root_end", "END"},
    {"--points-per-strand", "groom", "points_per_strand"},
    {"--guides", "groom", "guides"},
    {"--guides-file", "groom", "guides_file"},
    {"--guides-primvar", "groom", "guides_primvar", "NAME"},
    {"--guides-sample", "groom", "guides_sample"},
    {"--from", "start", "from", "RUN"},
    {"--from-frame", "start", "frame"},
    {"--from-blend", "start", "blend", "FRAMES"},
    {"--bind", "groom", "bind"},
    {"--bind-frame", "groom", "bind_frame"},
    {"--style", "groom", "style"},
    {"--strands", "groom", "strands"},
    {"--locks", "groom", "locks"},
    {"--particles", "groom", "particles"},
    {"--columns", "groom", "columns"},
    {"--rows", "groom", "rows"},
    {"--spacing", "groom", "spacing"},
    {"--scalp-radius", "groom", "scalp_radius"},
    {"--scalp", "groom", "scalp"},
    {"--radius", "groom", "radius"},
    {"--turns", "groom", "turns", "N"},
    {"--length", "groom", "length"},
    {"--phase", "groom", "phase", "RADIANS"},
    {"--hand", "groom", "hand", "HAND"},
    {"--vary-radius", "groom", "vary_radius", "SHARE"},
    {"--vary-length", "groom", "vary_length", "SHARE"},
    {"--vary-phase", "groom", "vary_phase", "SHARE"},
    {"--other-hand", "groom", "other_hand", "SHARE"},
    {"--seed", "groom", "seed"},
    {"--hairline", "groom.cut", "hairline"},
    {"--parting", "groom.cut", "parting"},
    {"--fringe", "groom.cut", "fringe"},
    {"--top", "groom.cut", "top"},
    {"--sides", "groom.cut", "sides"},
    {"--back", "groom.cut", "back"},
    {"--layers", "groom.cut", "layers"},
    {"--level", "groom.cut", "level"},
    {"--straight-root", "groom.cut", "straight_root"},
    {"--clump", "groom.cut", "clump"},
    {"--amplitude", "motion", "amplitude", "A"},
    {"--frequency", "motion", "frequency", "HZ"},
    {"--joint", "motion", "joint"},
    {"--animation", "motion", "animation"},
    {"--motion-unit", "motion", "unit"},
    {"--motion-up", "motion", "up", "AXIS"},
    {"--skip-frames", "motion", "skip_frames"},
    {"--pre-roll", "motion", "pre_roll", "S"},
    {"--fps", "simulation", "fps", "F"},
    {"--frames", "simulation", "frames", "", "seconds"},
    {"--steps-per-frame", "simulation", "steps_per_frame"},
    {"--gravity", "simulation", "gravity", "G"},
    {"--preload", "simulation", "preload", "P"},
    {"--max-stretch", "simulation", "max_stretch"},
    {"--roots", "simulation", "roots"},
    {"--integrator", "simulation", "integrator"},
    {"--iterations", "simulation", "iterations"},
    {"--contact-radius", "contacts", "radius"},
    {"--fill-gaps", "contacts", "fill_gaps"},
    {"--contact-detail", "contacts", "detail"},
    {"--max-neighbours", "contacts", "max_neighbours", "", "", "prune_pairs"},
    {"--drop-share", "contacts", "drop_share", "", "", "prune_pairs"},
    {"--contact-friction", "contacts", "friction"},
    {"--contact-taper", "contacts", "taper"},
    {"--volume-cell", "contacts", "volume_cell"},
    {"--contact-iterations", "contacts", "iterations"},
    {"--cache", "output", "cache", "PRECISION"},
    {"--width", "output", "width"},
    {"--tip-width", "output", "tip_width"},
    {"--usd-values", "output", "values", "LIST"},
    {"--head", "output", "head", "WAY"},
    {"--clips", "output", "clip_frames"},
    {"--hairs", "output", "hairs"},
    {"--frizz", "output", "frizz"},
    {"--clump", "output", "clump", "S"},
    {"--blend", "output", "blend", "S"},
    {"--hair-scalp", "output", "hair_scalp_file"},
    {"--usd-prims", "output", "prims", "WHOSE"},
};

// The row of "simulation.gravity"; null if the key has no option.
const KeyOption* rowOf(std::string_view key) {
  const auto* found = std::ranges::find(kKeyOptions, key, &KeyOption::fullKey);
  return found == std::end(kKeyOptions) ? nullptr : found;
}

const SceneKey& keyOf(const KeyOption& option) {
  static const std::vector<SceneKey> keys = sceneKeys();
  const auto found = std::ranges::find_if(
      keys, [&](const SceneKey& key) { return key.table == option.table && key.key == option.key; });
  RINGLET_ASSERT(found != keys.end(), "an option is no key of scene files");
  return *found;
}

bool isNumber(const SceneKey& key) { return key.type == "number"; }
bool isWhole(const SceneKey& key) { return key.type == "whole number"; }
bool isSwitch(const SceneKey& key) { return key.type == "true or false"; }
bool isList(const SceneKey& key) { return key.type.starts_with("list"); }

// The value as it would be in a scene file. The option's check has passed.
SceneChange changeOf(const SceneKey& key, const std::string& typed, std::vector<std::string> without) {
  using Form = SceneChange::Form;
  SceneChange change{key.table + "." + key.key, typed, Form::text, std::move(without)};
  if (isNumber(key)) change.value = fmt::format("{}", std::strtod(typed.c_str(), nullptr));
  if (isWhole(key)) change.value = fmt::format("{}", std::strtoll(typed.c_str(), nullptr, 10));
  if (isSwitch(key)) change.value = typed == "on" ? "true" : "false";
  if (isNumber(key) || isWhole(key) || isSwitch(key)) change.form = Form::toml;
  if (key.type == "path") change.form = Form::path;
  return change;
}

void addCheck(CLI::Option& option, const SceneKey& key) {
  const NumberRange& allowed = key.allowed;
  if (isNumber(key)) option.check(between(allowed.low, allowed.high));
  if (isWhole(key))
    option.check(
        wholeBetween(static_cast<std::int64_t>(allowed.low), static_cast<std::int64_t>(allowed.high)));
  if (isSwitch(key)) option.check(oneOf({"on", "off"}));
  if (!key.choices.empty()) option.check(oneOf(namesIn(key.choices)));
}

std::string typeNameOf(const KeyOption& option, const SceneKey& key) {
  if (*option.type) return option.type;
  if (isNumber(key)) return key.unit == "m" ? "METRES" : "X";
  if (isSwitch(key)) return "on|off";
  if (key.type == "path") return "FILE";
  return isWhole(key) ? "N" : "NAME";
}

// The effect of the key, followed by "(from 0 to 1 m; default 0)".
std::string helpOf(const SceneKey& key) {
  const std::string range = isSwitch(key) ? "on or off" : key.range.empty() ? key.type : key.range;
  const std::string standard = key.standard == "true" ? "on" : key.standard == "false" ? "off" : key.standard;
  std::string_view effect = key.effect;
  effect.remove_suffix(effect.ends_with('.') ? 1 : 0);
  // Which generator has a key its command says.
  const bool saysWith = !key.onlyWith.empty() && (key.table != "groom" || key.onlyWith == "file");
  const std::string with = saysWith ? fmt::format("; only with {}", key.onlyWith) : "";
  return fmt::format("{} ({}; default {}{})", effect, range, standard, with);
}

void addOption(CLI::App& command, TypedKeys& typed, const KeyOption& row, const std::string& group) {
  const SceneKey& key = keyOf(row);
  const std::string help = helpOf(key), type = typeNameOf(row, key);
  std::vector<std::string> without;
  if (*row.without) without.emplace_back(row.without);
  const auto keep = [&typed, &key, &row, without](const std::string& text) {
    typed.options.push_back(changeOf(key, text, without));
    if (*row.turnsOn) typed.options.push_back({fmt::format("{}.{}", row.table, row.turnsOn), "true"});
  };
  CLI::Option* option = nullptr;
  if (isList(key)) {
    const auto keepList = [&typed, &key](const std::vector<std::string>& texts) {
      std::vector<std::string> quoted;
      for (const std::string& text : texts) quoted.push_back('"' + text + '"');
      SceneChange change{key.table + "." + key.key, fmt::format("[{}]", fmt::join(quoted, ", "))};
      typed.options.push_back(std::move(change));
    };
    option =
        command.add_option_function<std::vector<std::string>>(row.option, keepList, help)->delimiter(',');
  } else {
    option = command.add_option_function<std::string>(row.option, keep, help);
  }
  addCheck(*option, key);
  option->type_name(type);
  if (!group.empty()) option->group(group);
}

// Rewrites a scene's message about keys with the names of the options that set them.
CLI::ValidationError usageError(const Error& error, const TypedKeys& typed) {
  std::string message = error.message;
  std::string first = typed.options.empty() ? "--set" : optionNamed(typed.options.front().key);
  for (const SceneChange& change : typed.options) {
    const std::string option = optionNamed(change.key);
    const std::string found = "found " + change.key;
    const std::size_t at = message.find(found);
    if (option.empty() || at == std::string::npos) continue;
    message.replace(at, found.size(), "found " + option);
    first = option;
  }
  return CLI::ValidationError(first, message);
}

// Options of a table's keys alone do not switch on what the presence of the table would.
std::vector<SceneChange> settled(const TypedKeys& typed, const std::function<Result<SceneFile>()>& untyped) {
  std::vector<SceneChange> changes = typed.changes();
  const bool isOfContacts = std::ranges::any_of(
      typed.options, [](const SceneChange& change) { return change.key.starts_with("contacts."); });
  if (!isOfContacts || typed.has("contacts.on")) return changes;
  if (const auto scene = untyped())
    changes.insert(changes.begin(), {"contacts.on", scene->contacts.on ? "true" : "false"});
  return changes;
}

// Reads a scene with changes. An error that only they cause is a usage error.
Result<SceneFile> readWith(
    const TypedKeys& typed,
    const std::function<Result<SceneFile>(const std::vector<SceneChange>& changes)>& read) {
  const auto untyped = [&] { return read({}); };
  auto scene = read(settled(typed, untyped));
  if (scene || typed.isEmpty() || !untyped()) return scene;
  throw usageError(scene.error(), typed);
}

// A scene that consists of the options only.
SceneFile sceneOfOptions(const TypedKeys& typed, bool upIsZ = false) {
  const std::string text = fmt::format("[groom]\nfile = \"-\"\nup = \"{}\"\n", upIsZ ? 'Z' : 'Y');
  auto scene = parseScene(text, "the options", {}, typed.options);
  if (!scene) throw usageError(scene.error(), typed);
  return std::move(*scene);
}

CLI::Validator isChange() {
  return CLI::Validator(
      [](std::string& text) {
        return text.find('=') != std::string::npos && text.front() != '='
                   ? std::string()
                   : fmt::format("must be KEY=VALUE, as contacts.on=true, not '{}'", text);
      },
      "");
}

}  // namespace

bool TypedKeys::has(std::string_view key) const {
  return std::ranges::find(options, key, &SceneChange::key) != options.end();
}

std::string TypedKeys::optionOf(std::string_view table) const {
  for (const SceneChange& change : options)
    if (std::string_view(change.key).substr(0, change.key.rfind('.')) == table)
      return optionNamed(change.key);
  return "";
}

std::vector<SceneChange> TypedKeys::changes() const {
  std::vector<SceneChange> all = options;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    all.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  return all;
}

void addKeyOptions(CLI::App& command, TypedKeys& typed, std::string_view table, const std::string& group) {
  for (const KeyOption& row : kKeyOptions)
    if (row.table == table) addOption(command, typed, row, group);
}

void addOptionsOfKeys(CLI::App& command, TypedKeys& typed, const std::vector<std::string_view>& keys,
                      const std::string& group) {
  for (const std::string_view key : keys) {
    const KeyOption* row = rowOf(key);
    RINGLET_ASSERT(row, "a key has no option");
    addOption(command, typed, *row, group);
  }
}

std::string optionNamed(std::string_view key) {
  if (key == "motion.kind" || key == "motion.file") return "--motion";
  if (key == "simulation.chebyshev") return "--no-chebyshev";
  const KeyOption* row = rowOf(key);
  return row ? row->option : "";
}

void addSetOption(CLI::App& command, TypedKeys& typed, const std::string& group) {
  CLI::Option* option = command
                            .add_option("--set", typed.sets,
                                        "A key of the scene, as its file would have it (`ringlet scene "
                                        "--keys`): motion.kind=shake; again for others")
                            ->check(isChange())
                            ->type_name("KEY=VALUE");
  if (!group.empty()) option->group(group);
}

Result<SceneFile> readTypedScene(const std::filesystem::path& file, const TypedKeys& typed,
                                 SceneReach reach) {
  return readWith(typed,
                  [&](const std::vector<SceneChange>& changes) { return readScene(file, changes, reach); });
}

Result<SceneFile> readTyped(const std::filesystem::path& input, const TypedKeys& typed, SceneReach reach,
                            const char* motion) {
  const bool isScene = isSceneFile(input);
  std::error_code code;
  if (std::filesystem::is_directory(input, code))
    return Error{fmt::format("{}: is a folder; expected the file of a scene (.toml) or of a groom ({})",
                             input.string(), kGroomEndings),
                 Fault::input};
  if (!isScene && !isGroomFile(input))
    return Error{
        fmt::format("{} is neither a scene (.toml) nor a groom ({})", input.string(), kGroomEndings)};
  if (isScene) return readTypedScene(input, typed, reach);
  return readWith(typed, [&](std::vector<SceneChange> changes) {
    using Form = SceneChange::Form;
    changes.insert(changes.begin(),
                   {{"groom.file", input.string(), Form::path, {}}, {"motion.kind", motion, Form::text, {}}});
    return parseScene("", input.string(), {}, changes, reach);
  });
}

Result<SceneFile> parseTyped(std::string_view text, const std::string& name, const TypedKeys& typed) {
  return readWith(
      typed, [&](const std::vector<SceneChange>& changes) { return parseScene(text, name, {}, changes); });
}

void addHairLookOptions(CLI::App& command, TypedKeys& typed) {
  addOptionsOfKeys(command, typed,
                   {"output.frizz", "output.clump", "output.blend", "output.hair_scalp_file"});
}

HairLook hairLookOf(const TypedKeys& typed) {
  const SceneFile scene = sceneOfOptions(typed);
  const auto ifTyped = [&](std::string_view key, double value) {
    return typed.has(key) ? std::optional(value) : std::nullopt;
  };
  return {.frizz = ifTyped("output.frizz", scene.output.frizz),
          .clump = ifTyped("output.clump", scene.output.clump),
          .blend = ifTyped("output.blend", scene.output.blend),
          .scalp = scene.output.hairScalpFile};
}

GroomReading readingOf(const TypedKeys& typed, bool upIsZ) {
  return ringlet::readingOf(sceneOfOptions(typed, upIsZ).groom);
}

}  // namespace ringlet::program
