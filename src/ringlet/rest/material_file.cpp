// Implements rest/material_file.h.
#include "ringlet/rest/material_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <span>

#include "ringlet/base/nearest_name.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/material_table.h"
#include "ringlet/rest/toml_file.h"

namespace ringlet {
namespace {

constexpr const char* kFromRest = "rest";  // in place of a length: measured on the rest curl

constexpr const char* kWhat = "a material";

// The name of a table below another: "dials" or "material.dials".
std::string below(const std::string& table, const char* key) { return KnownKey{table, key}.fullName(); }

// "straight, wavy, ...; did you mean NAME?"
std::string presetsNear(std::string_view word) {
  const std::vector<std::string> names = presetNames();
  const std::size_t nearest = nearestName(word, names);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     nearest < names.size() ? fmt::format("; did you mean {}?", names[nearest]) : "");
}

// Reads the keys of a table.
class MaterialReader {
 public:
  MaterialReader(const std::string& name, TomlProblems& problems) : name_(name), problems_(problems) {}

  void read(const toml::table& file, LoadedMaterial& loaded) {
    readPreset(file, loaded.material);
    readNumbers(file, name_, materialParameters(), loaded.material);
    if (const toml::table* table = tableOf(file, "dials"))
      readNumbers(*table, below(name_, "dials"), dialParameters(), loaded.dials);
    if (const toml::table* table = tableOf(file, "variation"))
      readNumbers(*table, below(name_, "variation"), variationParameters(), loaded.material.variation);
    if (const toml::table* table = tableOf(file, "profile")) readProfiles(*table, loaded.material);

    // Problems that involve several lines: the two elongations.
    if (problems_.empty()) {
      if (Status status = checkMaterial(loaded.material); !status) {
        const toml::node* high = file.get("core_elongation_high");
        const toml::node* low = file.get("core_elongation_low");
        problems_.add(lineOf(high ? *high : low ? *low : file), status.error().message);
      }
    }
  }

 private:
  void readPreset(const toml::table& file, Material& material) {
    const toml::node* node = file.get("preset");
    if (!node) return;
    const auto* text = node->as_string();
    const std::optional<Material> preset = text ? materialPreset(text->get()) : std::nullopt;
    if (preset) {
      material = *preset;
    } else {
      problems_.addFound(*node, below(name_, "preset"), "one of " + presetsNear(text ? text->get() : ""));
    }
  }

  const toml::table* tableOf(const toml::table& file, const char* key) {
    const toml::node* node = file.get(key);
    if (!node) return nullptr;
    const std::string name = below(name_, key);
    if (!node->is_table()) problems_.addFound(*node, name, fmt::format("a table, as in [{}]", name));
    if (node->is_table()) problems_.addUnknownKeys(*node->as_table(), name, knownMaterialKeys(name_));
    return node->as_table();
  }

  template <class Owner>
  void readNumbers(const toml::table& table, const std::string& tableName,
                   std::span<const Parameter<Owner>> parameters, Owner& owner) {
    for (const Parameter<Owner>& parameter : parameters) {
      const toml::node* node = table.get(parameter.key);
      if (!node) continue;
      if (parameter.canBeUnset() && node->is_string() && node->as_string()->get() == kFromRest) {
        parameter.set(owner, std::nullopt);
        continue;
      }
      const bool isNumber = parameter.isWhole() ? node->is_integer() : node->is_number();
      const double value = isNumber ? node->value<double>().value_or(-1) : -1;
      if (isNumber && parameter.allowed.contains(value)) {
        parameter.set(owner, value);
        continue;
      }
      problems_.addFound(*node, below(tableName, parameter.key),
                         fmt::format("a {}number {}{}", parameter.isWhole() ? "whole " : "",
                                     rangeText(parameter.allowed, parameter.unit),
                                     parameter.canBeUnset() ? fmt::format(", or \"{}\"", kFromRest) : ""));
    }
  }

  void readProfiles(const toml::table& table, Material& material) {
    for (const ProfileParameter& parameter : profileParameters()) {
      const toml::node* node = table.get(parameter.key);
      if (!node) continue;
      const std::string key = below(below(name_, "profile"), parameter.key),
                        expected = "a list of points [share of the arc length, factor]";
      Profile profile;
      const toml::array* points = node->as_array();
      if (!points) {
        problems_.addFound(*node, key, expected);
        continue;
      }
      for (const toml::node& item : *points) {
        const toml::array* pair = item.as_array();
        if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number()) {
          problems_.addFound(item, fmt::format("point {} of {}", profile.points.size() + 1, key), expected);
          break;
        }
        profile.points.push_back(
            {(*pair)[0].value<double>().value_or(-1), (*pair)[1].value<double>().value_or(-1)});
        if (Status status = checkProfile(parameter, profile); !status) {
          problems_.add(lineOf(item), status.error().message);
          break;
        }
      }
      material.*parameter.member = std::move(profile);
    }
  }

  const std::string& name_;  // of the table
  TomlProblems& problems_;
};

template <class Owner>
void writeNumber(std::string& text, const Parameter<Owner>& parameter, const Owner& owner) {
  const std::optional<double> value = parameter.of(owner);
  if (!value) {
    text += fmt::format("\"{}\"\n", kFromRest);
  } else if (parameter.isWhole()) {
    text += fmt::format("{:.0f}\n", *value);
  } else {
    text += tomlNumber(*value) + "\n";
  }
}

template <class Owner>
void writeNumbers(std::string& text, std::span<const Parameter<Owner>> parameters, const Owner& owner) {
  for (const Parameter<Owner>& parameter : parameters) {
    text += fmt::format(
        "\n# {}\n# {}; usual is {}{}.\n{} = ", parameter.effect, rangeText(parameter.allowed, parameter.unit),
        rangeText(parameter.usual, parameter.unit),
        parameter.canBeUnset() ? fmt::format(", or \"{}\": measured on the rest curl", kFromRest) : "",
        parameter.key);
    writeNumber(text, parameter, owner);
  }
}

// Writes the numbers that differ from the default, under a heading.
template <class Owner>
void writeOthers(std::string& text, const std::string& heading, std::span<const Parameter<Owner>> parameters,
                 const Owner& owner) {
  std::string lines;
  for (const Parameter<Owner>& parameter : parameters) {
    if (parameter.of(owner) == parameter.defaultValue()) continue;
    lines += fmt::format("{} = ", parameter.key);
    writeNumber(lines, parameter, owner);
    lines.insert(lines.size() - 1,
                 fmt::format("  # {}{}",
                             parameter.unit == std::string("1") ? "" : fmt::format("[{}] ", parameter.unit),
                             parameter.effect));
  }
  if (!lines.empty()) text += fmt::format("\n[{}]\n{}", heading, lines);
}

std::string pointsText(const Profile& profile) {
  std::vector<std::string> points;
  for (const Profile::Point& point : profile.points)
    points.push_back(fmt::format("[{}, {}]", tomlNumber(point.s), tomlNumber(point.factor)));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

}  // namespace

std::vector<KnownKey> knownMaterialKeys(const std::string& table) {
  std::vector<KnownKey> keys;
  for (const char* key : {"preset", "dials", "variation", "profile"}) keys.push_back({table, key});
  for (const auto& parameter : materialParameters()) keys.push_back({table, parameter.key});
  for (const auto& parameter : dialParameters()) keys.push_back({below(table, "dials"), parameter.key});
  for (const auto& parameter : variationParameters())
    keys.push_back({below(table, "variation"), parameter.key});
  for (const auto& parameter : profileParameters()) keys.push_back({below(table, "profile"), parameter.key});
  return keys;
}

void readMaterialTable(const toml::table& table, const std::string& name, LoadedMaterial& loaded,
                       TomlProblems& problems) {
  MaterialReader(name, problems).read(table, loaded);
}

std::string materialTableText(const Material& material, const MaterialDials& dials, const std::string& name) {
  std::string text;
  writeOthers(text, name, materialParameters(), material);
  writeOthers(text, below(name, "dials"), dialParameters(), dials);
  writeOthers(text, below(name, "variation"), variationParameters(), material.variation);
  std::string profiles;
  for (const ProfileParameter& parameter : profileParameters()) {
    if (const Profile& profile = material.*parameter.member; !profile.points.empty())
      profiles += fmt::format("{} = {}  # {}\n", parameter.key, pointsText(profile), parameter.effect);
  }
  if (!profiles.empty()) text += fmt::format("\n[{}]\n{}", below(name, "profile"), profiles);
  return text;
}

Result<LoadedMaterial> parseMaterial(std::string_view text, const std::string& name) {
  const auto file = parseToml(text, name, kWhat);
  if (!file) return file.error();
  if (file->get("groom") || file->get("material")) {
    return Error{fmt::format(
        "{}: is a scene and no material file; what stands below its [material] can be one", name)};
  }
  LoadedMaterial loaded;
  TomlProblems problems;
  readMaterialTable(*file, "", loaded, problems);
  problems.addUnknownKeys(*file, "", knownMaterialKeys(""));
  if (!problems.empty()) return problems.error(name);
  for (const std::string& sentence : unusualNumbers(loaded.material, loaded.dials))
    loaded.warnings.push_back(fmt::format("{}: {}", name, sentence));
  return loaded;
}

Result<LoadedMaterial> readMaterial(const std::filesystem::path& path) {
  const auto text = readTomlText(path, kWhat);
  if (!text) return text.error();
  return parseMaterial(*text, path.string());
}

bool isMaterialFile(const std::filesystem::path& name) {
  std::string extension = name.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension == ".toml";
}

Result<LoadedMaterial> loadMaterial(const std::string& presetOrFile) {
  if (const auto preset = materialPreset(presetOrFile)) return LoadedMaterial{*preset, {}, {}};
  if (isMaterialFile(presetOrFile)) return readMaterial(presetOrFile);
  return Error{fmt::format("there is no material {}; expected a file that ends in .toml, or one of {}",
                           ringlet::quoted(presetOrFile), presetsNear(presetOrFile))};
}

std::string materialText(const Material& material, const MaterialDials& dials) {
  std::string text =
      "# A Ringlet material. Unit w: the strand's own weight, line_density x 9.81 m/s^2 x its length, so "
      "that\n"
      "# a number means the same for every strand. What is left out keeps its default, or that of a preset\n"
      "# named at the top, as in: preset = \"ringlet\"\n";
  writeNumbers(text, materialParameters(), material);
  text += "\n# Factors on the numbers above, and how far hair may lengthen.\n[dials]\n";
  writeNumbers(text, dialParameters(), dials);
  text += "\n# How strands differ from one another.\n[variation]\n";
  writeNumbers(text, variationParameters(), material.variation);
  text +=
      "\n# How a strand changes from root to tip; straight lines between points, no points: 1 everywhere.\n";
  text += "[profile]\n";
  for (const ProfileParameter& parameter : profileParameters()) {
    text +=
        fmt::format("\n# {}\n# Factors {}; usual is {}.\n{} = {}\n", parameter.effect,
                    rangeText(parameter.allowed, parameter.unit), rangeText(parameter.usual, parameter.unit),
                    parameter.key, pointsText(material.*parameter.member));
  }
  return text;
}

Status writeMaterial(const std::filesystem::path& path, const Material& material,
                     const MaterialDials& dials) {
  Status status = checkMaterial(material);
  if (status) status = checkDials(dials);
  if (!status) return Error{fmt::format("{}: cannot write it: {}", path.string(), status.error().message)};
  return writeWholeFile(path, std::as_bytes(std::span<const char>(materialText(material, dials))));
}

}  // namespace ringlet
