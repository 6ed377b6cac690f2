// Implements material_command.h.
#include "program/convert/material_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_output.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/groom_inspection.h"
#include "ringlet/measure/material_suggestion.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/load/scene_maps.h"

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMaterialExample =
    "Example:\n"
    "  ringlet material --list\n"
    "  ringlet material --suggest groom.usd -o hair.toml\n"
    "  ringlet material ringlet -o soft.toml    (then edit soft.toml)\n"
    "  ringlet simulate head.obj --material soft.toml --hold 0.5 -o out\n"
    "\n"
    "--list says of every parameter its unit, its effect, and its usual and allowed range. Numbers with unit "
    "w are\n"
    "multiples of a strand's own weight, so that they mean the same for every strand.\n"
    "\n"
    "A file may name a preset and change some of its numbers:\n"
    "  preset = \"coil\"\n"
    "  bend_stiffness = 20\n"
    "  [dials]\n"
    "  hold = 1.5\n"
    "  [variation]             # from strand to strand\n"
    "  bend_stiffness = 0.2\n"
    "  [profile]               # from root to tip: points [share of the arc length, factor]\n"
    "  bend_stiffness = [[0, 1], [1, 0.5]]\n"
    "\n"
    "--json keys: name summary parameters dials variation profile warnings outputs; of a parameter: key unit "
    "effect\n"
    "value (null: measured on the rest curl) default low high usual_low usual_high. With --list: presets, "
    "and the same\n"
    "without values.\n"
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage.";

struct TypedMaterial {
  std::string name;
  std::filesystem::path file, groom;
  std::optional<double> metresPerUnit;
  bool list = false, json = false;
  TypedKeys reading;
};

std::string unitText(const ParameterText& parameter) {
  return parameter.unit == std::string("1") ? "" : std::string(" ") + parameter.unit;
}

std::string pointsText(const Profile& profile) {
  std::vector<std::string> points;
  for (const Profile::Point& point : profile.points)
    points.push_back(fmt::format("[{}, {}]", point.s, point.factor));
  return points.empty() ? "1 everywhere" : fmt::format("{}", fmt::join(points, ", "));
}

// One parameter: "  key  value unit", then what it does and what it may be.
std::string lineOf(const ParameterText& parameter, const std::string& value) {
  return fmt::format("  {:<22} {}\n  {:<22} {}\n  {:<22} Usual {}; allowed {}.\n", parameter.key, value, "",
                     parameter.effect, "", rangeText(parameter.usual, parameter.unit),
                     rangeText(parameter.allowed, parameter.unit));
}

template <class Owner>
std::string linesOf(std::span<const Parameter<Owner>> parameters, const Owner& owner) {
  std::string text;
  for (const Parameter<Owner>& parameter : parameters) {
    const std::optional<double> value = parameter.of(owner);
    text += lineOf(parameter,
                   value ? fmt::format("{}{}", *value, unitText(parameter)) : "measured on the rest curl");
  }
  return text;
}

std::string asText(const Material& material, const MaterialDials& dials) {
  std::string text = linesOf(materialParameters(), material);
  text += "\nDials, on top of the numbers above:\n" + linesOf(dialParameters(), dials);
  text += "\nVariation, from strand to strand:\n" + linesOf(variationParameters(), material.variation);
  text += "\nProfile, from root to tip:\n";
  for (const ProfileParameter& parameter : profileParameters())
    text += lineOf(parameter, pointsText(material.*parameter.member));
  return text;
}

Json jsonOf(const ParameterText& parameter) {
  return {{"key", parameter.key},
          {"unit", parameter.unit},
          {"effect", parameter.effect},
          {"low", parameter.allowed.low},
          {"high", parameter.allowed.high},
          {"usual_low", parameter.usual.low},
          {"usual_high", parameter.usual.high}};
}

Json jsonOf(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

// `owner` null: without values.
template <class Owner>
Json jsonOf(std::span<const Parameter<Owner>> parameters, const Owner* owner) {
  Json list = Json::array();
  for (const Parameter<Owner>& parameter : parameters) {
    Json json = jsonOf(static_cast<const ParameterText&>(parameter));
    json["default"] = jsonOf(parameter.defaultValue());
    if (owner) json["value"] = jsonOf(parameter.of(*owner));
    list.push_back(std::move(json));
  }
  return list;
}

Json jsonOfTables(const LoadedMaterial* loaded) {
  Json json;
  json["parameters"] = jsonOf(materialParameters(), loaded ? &loaded->material : nullptr);
  json["dials"] = jsonOf(dialParameters(), loaded ? &loaded->dials : nullptr);
  json["variation"] = jsonOf(variationParameters(), loaded ? &loaded->material.variation : nullptr);
  json["profile"] = Json::array();
  for (const ProfileParameter& parameter : profileParameters()) {
    Json profile = jsonOf(static_cast<const ParameterText&>(parameter));
    profile["default"] = Json::array();
    if (loaded) {
      profile["value"] = Json::array();
      for (const Profile::Point& point : (loaded->material.*parameter.member).points)
        profile["value"].push_back({point.s, point.factor});
    }
    json["profile"].push_back(std::move(profile));
  }
  return json;
}

int list(const TypedMaterial& typed) {
  if (typed.json) {
    Json json;
    json["presets"] = Json::array();
    for (const std::string& name : presetNames())
      json["presets"].push_back({{"name", name}, {"summary", presetSummary(name)}});
    json.update(jsonOfTables(nullptr));
    printJson(json);
    return kExitFine;
  }
  print("Presets:\n");
  for (const std::string& name : presetNames()) print("  {:<12} {}\n", name, presetSummary(name));
  print("\nParameters and their defaults:\n{}", asText({}, {}));
  return kExitFine;
}

// Shows the preset that a groom looks like, and on standard error why.
Result<std::string> suggested(const TypedMaterial& typed) {
  auto groom = readGroom(typed.groom, readingOf(typed.reading));
  if (!groom) return groom.error();
  if (typed.metresPerUnit) groom->groom.metresPerUnit = *typed.metresPerUnit;
  for (const std::string& warning : groom->warnings) say("ringlet material: warning: {}\n", warning);
  const auto suggestion = suggestMaterial(inspectShape(groom->groom), groom->groom.metresPerUnit);
  say("ringlet material: {} looks like {}: {}\n", typed.groom.string(), suggestion.preset, suggestion.reason);
  return suggestion.preset;
}

int show(TypedMaterial& typed) {
  if (!typed.groom.empty()) {
    auto name = suggested(typed);
    if (!name) return fail("material", name.error());
    typed.name = std::move(*name);
  }
  auto loaded = loadMaterial(typed.name);
  if (!loaded) return fail("material", loaded.error());
  for (const std::string& warning : loaded->warnings) say("ringlet material: warning: {}\n", warning);
  if (!typed.file.empty()) {
    if (Status written = writeMaterial(typed.file, loaded->material, loaded->dials); !written)
      return fail("material", written.error());
  }

  const std::string summary = presetSummary(typed.name);
  if (typed.json) {
    Json json{{"name", typed.name}, {"summary", summary}};
    json.update(jsonOfTables(&*loaded));
    json["warnings"] = loaded->warnings;
    json["outputs"] = Json::array();
    if (!typed.file.empty()) json["outputs"].push_back(typed.file.string());
    printJson(json);
  } else if (!typed.file.empty()) {
    print("{}: {}\n", typed.name, typed.file.string());
  } else {
    print("{}{}{}\n\n{}", typed.name, summary.empty() ? "" : ": ", summary,
          asText(loaded->material, loaded->dials));
  }
  return kExitFine;
}

// Accepts a preset's name or the name of a file.
CLI::Validator materialName() {
  return CLI::Validator(
      [](std::string& name) {
        if (isMaterialFile(name)) return std::string();  // whether it can be read, the command finds out
        const auto loaded = loadMaterial(name);
        return loaded ? std::string() : loaded.error().message;
      },
      "");
}

// Those that act on more than springs.
bool paperHas(const Parameter<MaterialDials>& dial) {
  return dial.key == std::string_view("bounce") || dial.key == std::string_view("weight");
}

std::string optionOf(const Parameter<MaterialDials>& dial) {
  std::string option = std::string("--") + dial.key;
  std::ranges::replace(option, '_', '-');
  return option;
}

}  // namespace

void addMaterialCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedMaterial>();
  CLI::App* command =
      app.add_subcommand("material", "Shows what hair can be made of: presets, files, every number");
  command->footer(kMaterialExample);
  command
      ->add_option("MATERIAL", typed->name,
                   fmt::format("A preset ({}) or a .toml file", fmt::join(presetNames(), ", ")))
      ->check(materialName())
      ->type_name("NAME|FILE");
  command->add_flag("--list", typed->list, "List the presets and every parameter");
  command
      ->add_option(
          "--suggest", typed->groom,
          "Show the preset that this groom looks most like, by how many of its strands are curled, and how "
          "wide")
      ->type_name("GROOM");
  addOptionsOfKeys(*command, typed->reading, {"groom.points_per_strand"});
  command->add_option("--unit", typed->metresPerUnit, "With --suggest: metres per unit of the groom")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command->add_option("-o,--output", typed->file, "Write it to a file, every number with its comment")
      ->check(endsIn({".toml"}))
      ->type_name("FILE");
  command->add_flag("--json", typed->json, "Print one JSON object");
  command->callback([typed, &exitCode] {
    if (typed->list && !typed->name.empty())
      throw CLI::ValidationError("MATERIAL", "--list shows all materials; leave out the name");
    if (!typed->groom.empty() && (typed->list || !typed->name.empty()))
      throw CLI::ValidationError("--suggest", "names a material by itself; leave out the name and --list");
    if (!typed->list && typed->name.empty() && typed->groom.empty())
      throw CLI::ValidationError("MATERIAL",
                                 "name a preset or a .toml file, or use --list or --suggest GROOM");
    if (!typed->reading.isEmpty() && typed->groom.empty())
      throw CLI::ValidationError("--points-per-strand", "only --suggest reads a groom");
    if (typed->metresPerUnit && typed->groom.empty())
      throw CLI::ValidationError("--unit", "only --suggest reads a groom");
    if (typed->list && !typed->file.empty())
      throw CLI::ValidationError("--output", "only one material can be written; name it instead of --list");
    exitCode = typed->list ? list(*typed) : show(*typed);
  });
}

MaterialDials turned(const DialChoice& choice, MaterialDials dials) {
  for (std::size_t d = 0; d < choice.size(); ++d) {
    if (choice[d]) dialParameters()[d].set(dials, choice[d]);
  }
  return dials;
}

void addDialOptions(CLI::App* command, DialChoice& choice, const std::string& group) {
  const auto dials = dialParameters();
  choice.resize(dials.size());
  for (std::size_t d = 0; d < dials.size(); ++d) {
    const Parameter<MaterialDials>& dial = dials[d];
    command
        ->add_option(optionOf(dial), choice[d],
                     fmt::format("{} A number {}, usual {} (default {})", dial.effect,
                                 rangeText(dial.allowed, dial.unit), rangeText(dial.usual, dial.unit),
                                 *dial.defaultValue()))
        ->check(between(dial.allowed.low, dial.allowed.high))
        ->type_name("X")
        ->group(group);
  }
}

void addMaterialOptions(CLI::App* command, MaterialChoice& choice, const std::string& group) {
  command
      ->add_option(
          "--material", choice.name,
          fmt::format(
              "What hair is made of: {}, or a .toml file; see `ringlet material` (default: that command's "
              "defaults)",
              fmt::join(presetNames(), ", ")))
      ->check(materialName())
      ->type_name("NAME|FILE")
      ->group(group);
  addDialOptions(command, choice.dials, group);
}

void checkDialOptions(const DialChoice& choice, Integrator integrator) {
  if (integrator != Integrator::paper) return;
  for (std::size_t d = 0; d < choice.size(); ++d) {
    const Parameter<MaterialDials>& dial = dialParameters()[d];
    if (choice[d] && !paperHas(dial))
      throw CLI::ValidationError(
          optionOf(dial),
          "--integrator paper has spring constants of its own, which this dial does not change");
  }
}

Status applyMaterialOptions(const MaterialChoice& choice, SceneFile& scene) {
  if (!choice.name.empty()) {
    auto found = loadMaterial(choice.name);
    if (!found) return found.error();
    scene.material = std::move(*found);
    scene.hasMaterial = true;
    if (Status added = applyMaps(scene.maps, scene, scene.material.material); !added) return added;
  }
  // The reader of the scene's own dials has told what is unusual.
  scene.material.dials = turned(choice.dials, scene.material.dials);
  for (std::string& sentence : unusualNumbers({}, turned(choice.dials, {})))
    scene.warnings.push_back(std::move(sentence));
  return {};
}

}  // namespace ringlet::program
