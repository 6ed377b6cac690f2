// Implements material_command.h.
#include "program/material_command.h"
#include "program/standard_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "program/command_line.h"
#include "program/exit_codes.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExample =
    "Example:\n"
    "  ringlet material --list\n"
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
    "and "
    "the same\n"
    "without values.\n"
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage.";

struct Typed {
  std::string name;
  std::filesystem::path file;
  bool list = false, json = false;
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

void print(const Json& json) { fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace)); }

int list(const Typed& typed) {
  if (typed.json) {
    Json json;
    json["presets"] = Json::array();
    for (const std::string& name : presetNames())
      json["presets"].push_back({{"name", name}, {"summary", presetSummary(name)}});
    json.update(jsonOfTables(nullptr));
    print(json);
    return kExitFine;
  }
  fmt::print("Presets:\n");
  for (const std::string& name : presetNames()) fmt::print("  {:<12} {}\n", name, presetSummary(name));
  fmt::print("\nParameters and their defaults:\n{}", asText({}, {}));
  return kExitFine;
}

int show(const Typed& typed) {
  auto loaded = loadMaterial(typed.name);
  if (!loaded) {
    say("ringlet material: {}\n", loaded.error().message);
    return exitCodeOf(loaded.error());
  }
  for (const std::string& warning : loaded->warnings) say("ringlet material: warning: {}\n", warning);
  if (!typed.file.empty()) {
    if (Status written = writeMaterial(typed.file, loaded->material, loaded->dials); !written) {
      say("ringlet material: {}\n", written.error().message);
      return exitCodeOf(written.error());
    }
  }

  const std::string summary = presetSummary(typed.name);
  if (typed.json) {
    Json json{{"name", typed.name}, {"summary", summary}};
    json.update(jsonOfTables(&*loaded));
    json["warnings"] = loaded->warnings;
    json["outputs"] = Json::array();
    if (!typed.file.empty()) json["outputs"].push_back(typed.file.string());
    print(json);
  } else if (!typed.file.empty()) {
    fmt::print("{}: {}\n", typed.name, typed.file.string());
  } else {
    fmt::print("{}{}{}\n\n{}", typed.name, summary.empty() ? "" : ": ", summary,
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

// The dials, those of the command line turned.
MaterialDials turned(const MaterialChoice& choice, MaterialDials dials) {
  dials.hold = choice.hold.value_or(dials.hold);
  dials.bounce = choice.bounce.value_or(dials.bounce);
  dials.springBack = choice.springBack.value_or(dials.springBack);
  dials.curlKeep = choice.curlKeep.value_or(dials.curlKeep);
  return dials;
}

const Parameter<MaterialDials>& dialNamed(std::string_view key) {
  const auto dials = dialParameters();
  return *std::find_if(dials.begin(), dials.end(), [&](const auto& dial) { return dial.key == key; });
}

}  // namespace

void addMaterialCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<Typed>();
  CLI::App* command =
      app.add_subcommand("material", "Shows what hair can be made of: presets, files, every number");
  command->footer(kExample);
  command
      ->add_option("MATERIAL", typed->name,
                   fmt::format("A preset ({}) or a .toml file", fmt::join(presetNames(), ", ")))
      ->check(materialName())
      ->type_name("NAME|FILE");
  command->add_flag("--list", typed->list, "List the presets and every parameter");
  command->add_option("-o,--output", typed->file, "Write it to a file, every number with its comment")
      ->check(endsIn({".toml"}))
      ->type_name("FILE");
  command->add_flag("--json", typed->json, "Print one JSON object");
  command->callback([typed, &exitCode] {
    if (typed->list == !typed->name.empty()) {
      throw CLI::ValidationError("MATERIAL", typed->list ? "--list shows all materials; leave out the name"
                                                         : "name a preset or a .toml file, or use --list");
    }
    if (typed->list && !typed->file.empty())
      throw CLI::ValidationError("--output", "only one material can be written; name it instead of --list");
    exitCode = typed->list ? list(*typed) : show(*typed);
  });
}

void addMaterialOptions(CLI::App* command, MaterialChoice& choice, const std::string& group) {
  command
      ->add_option("--material", choice.name,
                   fmt::format("What hair is made of: {}, or a .toml file; see `ringlet material` (default: "
                               "that command's defaults)",
                               fmt::join(presetNames(), ", ")))
      ->check(materialName())
      ->type_name("NAME|FILE")
      ->group(group);
  auto addDial = [&](const char* option, const char* key, std::optional<double>& value) {
    const Parameter<MaterialDials>& dial = dialNamed(key);
    command
        ->add_option(option, value,
                     fmt::format("{} A number {}, usual {} (default {}, or the file's)", dial.effect,
                                 rangeText(dial.allowed, dial.unit), rangeText(dial.usual, dial.unit),
                                 *dial.defaultValue()))
        ->check(between(dial.allowed.low, dial.allowed.high))
        ->type_name("X")
        ->group(group);
  };
  addDial("--hold", "hold", choice.hold);
  addDial("--bounce", "bounce", choice.bounce);
  addDial("--spring-back", "spring_back", choice.springBack);
  addDial("--curl-keep", "curl_keep", choice.curlKeep);
  command
      ->add_option("--max-stretch", choice.maxStretch,
                   "Longest an edge may become, as a multiple of the groom's edge, 1 to 100: 1 + bounce "
                   "(default 1.1)")
      ->check(between(1, 100))
      ->type_name("S")
      ->group(group);
}

void checkMaterialOptions(const MaterialChoice& choice, Integrator integrator) {
  if (choice.bounce && choice.maxStretch) {
    throw CLI::ValidationError("--bounce", fmt::format("--max-stretch {} says the same as --bounce {}; give "
                                                       "one of the two",
                                                       *choice.maxStretch, *choice.maxStretch - 1));
  }
  if (integrator == Integrator::paper && (choice.hold || choice.springBack || choice.curlKeep)) {
    throw CLI::ValidationError(choice.hold         ? "--hold"
                               : choice.springBack ? "--spring-back"
                                                   : "--curl-keep",
                               "--integrator paper has spring constants of its own, which no dial changes");
  }
}

Status applyMaterialOptions(const MaterialChoice& choice, SceneFile& scene) {
  if (!choice.name.empty()) {
    auto found = loadMaterial(choice.name);
    if (!found) return found.error();
    scene.material = std::move(*found);
    scene.hasMaterial = true;
  }
  // The reader of the scene's own dials has told what is unusual.
  scene.material.dials = turned(choice, scene.material.dials);
  for (std::string& sentence : unusualNumbers({}, turned(choice, {})))
    scene.warnings.push_back(std::move(sentence));
  if (choice.bounce) scene.simulation.maxStretch.reset();  // they say the same
  if (choice.maxStretch) scene.simulation.maxStretch = choice.maxStretch;
  return {};
}

}  // namespace ringlet::program
