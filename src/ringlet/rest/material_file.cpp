// Implements rest/material_file.h.
#include "ringlet/rest/material_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <span>

#include "ringlet/base/nearest_name.h"
#include "ringlet/groom/quoted.h"
#include "ringlet/groom/whole_file.h"
#include "ringlet/rest/material_parameters.h"

// Errors come as values. toml++ 3.3 asserts what a file can break ("[,"), and with NDEBUG lets the compiler
// assume it; its own error, which comes next, is what is wanted.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(condition) static_cast<void>(0)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace ringlet {
namespace {

constexpr std::uintmax_t kLargestFile = 1
                                        << 20;  // [bytes] a material has some thousand; more is another file
// Keys nest a table per dot, and toml++ 3.3 recurses through them without a limit: 8,000 are too deep for a
// stack of 8 MiB with sanitizers. A material with the longest profiles has 1,100 dots.
constexpr std::ptrdiff_t kMostDots = 4096;
constexpr const char* kFromRest = "rest";  // for a length that is measured on the rest curl

// A key and the table it belongs in, "" for the file itself.
struct KnownKey {
  std::string table, key;
  std::string fullName() const { return table.empty() ? key : table + "." + key; }
};

std::vector<KnownKey> knownKeys() {
  std::vector<KnownKey> keys{{"", "preset"}, {"", "dials"}, {"", "variation"}, {"", "profile"}};
  for (const auto& parameter : materialParameters()) keys.push_back({"", parameter.key});
  for (const auto& parameter : dialParameters()) keys.push_back({"dials", parameter.key});
  for (const auto& parameter : variationParameters()) keys.push_back({"variation", parameter.key});
  for (const auto& parameter : profileParameters()) keys.push_back({"profile", parameter.key});
  return keys;
}

// What the user may have meant by a key of a table: the nearest of all keys, those of the same table first,
// or what the table may hold.
std::string adviceOnKey(std::string_view word, const std::string& table) {
  std::vector<KnownKey> keys = knownKeys();
  const auto others = std::stable_partition(keys.begin(), keys.end(),
                                            [&](const KnownKey& key) { return key.table == table; });
  std::vector<std::string> names;
  for (const KnownKey& key : keys) names.push_back(key.key);
  const std::size_t nearest = nearestName(word, names);
  names.resize(static_cast<std::size_t>(others - keys.begin()));
  if (nearest == keys.size()) return fmt::format("expected {}", fmt::join(names, ", "));
  const KnownKey& meant = keys[nearest];
  if (table.empty() || !meant.table.empty()) return fmt::format("did you mean {}?", meant.fullName());
  // What follows a table's heading belongs to it, also at the end of a file.
  return fmt::format("did you mean {}, which stands above all tables? [{}] takes {}", meant.key, table,
                     fmt::join(names, ", "));
}

// "straight, wavy, ...; did you mean NAME?"
std::string presetsNear(std::string_view word) {
  const std::vector<std::string> names = presetNames();
  const std::size_t nearest = nearestName(word, names);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     nearest < names.size() ? fmt::format("; did you mean {}?", names[nearest]) : "");
}

// A value as it may stand in a message: "the text 'soft'", "the number 5".
std::string found(const toml::node& node) {
  if (const auto* text = node.as_string()) return "the text " + ringlet::quoted(text->get());
  if (const auto* number = node.as_integer()) return fmt::format("the number {}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("the number {}", number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::uint32_t lineOf(const toml::node& node) { return node.source().begin.line; }

// Walks a parsed file and keeps the topmost problem.
class MaterialReader {
 public:
  explicit MaterialReader(const std::string& name) : name_(name) {}

  Result<LoadedMaterial> read(const toml::table& file) {
    LoadedMaterial loaded;
    readPreset(file, loaded.material);
    readNumbers(file, "", materialParameters(), loaded.material);
    if (const toml::table* table = tableOf(file, "dials"))
      readNumbers(*table, "dials", dialParameters(), loaded.dials);
    if (const toml::table* table = tableOf(file, "variation"))
      readNumbers(*table, "variation", variationParameters(), loaded.material.variation);
    if (const toml::table* table = tableOf(file, "profile")) readProfiles(*table, loaded.material);
    refuseUnknownKeys(file, "");

    // What one line alone does not show: the two elongations.
    if (message_.empty()) {
      if (Status status = checkMaterial(loaded.material); !status) {
        const toml::node* high = file.get("core_elongation_high");
        const toml::node* low = file.get("core_elongation_low");
        add(lineOf(high ? *high : low ? *low : file), status.error().message);
      }
    }
    if (!message_.empty()) return Error{fmt::format("{}: line {}: {}", name_, line_, message_)};
    for (const std::string& sentence : unusualNumbers(loaded.material, loaded.dials))
      loaded.warnings.push_back(fmt::format("{}: {}", name_, sentence));
    return loaded;
  }

 private:
  void add(std::uint32_t line, std::string message) {
    if (!message_.empty() && line >= line_) return;
    line_ = line;
    message_ = std::move(message);
  }
  void addFound(const toml::node& node, const std::string& key, const std::string& expected) {
    add(lineOf(node), fmt::format("found {} for {}; expected {}", found(node), key, expected));
  }

  void readPreset(const toml::table& file, Material& material) {
    const toml::node* node = file.get("preset");
    if (!node) return;
    const auto* text = node->as_string();
    const std::optional<Material> preset = text ? materialPreset(text->get()) : std::nullopt;
    if (preset) {
      material = *preset;
    } else {
      addFound(*node, "preset", "one of " + presetsNear(text ? text->get() : ""));
    }
  }

  const toml::table* tableOf(const toml::table& file, const char* key) {
    const toml::node* node = file.get(key);
    if (!node) return nullptr;
    if (!node->is_table()) addFound(*node, key, fmt::format("a table, as in [{}]", key));
    if (node->is_table()) refuseUnknownKeys(*node->as_table(), key);
    return node->as_table();
  }

  void refuseUnknownKeys(const toml::table& table, const std::string& name) {
    const std::vector<KnownKey> keys = knownKeys();
    for (const auto& [key, node] : table) {
      const std::string_view word = key.str();
      const bool isKnown = std::any_of(keys.begin(), keys.end(), [&](const KnownKey& known) {
        return known.table == name && known.key == word;
      });
      if (isKnown) continue;
      const std::string where = name.empty() ? "" : " in [" + name + "]";
      add(key.source().begin.line,
          fmt::format("found the unknown key {}{}; {}", quoted(word), where, adviceOnKey(word, name)));
    }
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
      const std::string key = KnownKey{tableName, parameter.key}.fullName();
      addFound(*node, key,
               fmt::format("a {}number {}{}", parameter.isWhole() ? "whole " : "",
                           rangeText(parameter.allowed, parameter.unit),
                           parameter.canBeUnset() ? fmt::format(", or \"{}\"", kFromRest) : ""));
    }
  }

  void readProfiles(const toml::table& table, Material& material) {
    for (const ProfileParameter& parameter : profileParameters()) {
      const toml::node* node = table.get(parameter.key);
      if (!node) continue;
      const std::string key = fmt::format("profile.{}", parameter.key),
                        expected = "a list of points [share of the arc length, factor]";
      Profile profile;
      const toml::array* points = node->as_array();
      if (!points) {
        addFound(*node, key, expected);
        continue;
      }
      for (const toml::node& item : *points) {
        const toml::array* pair = item.as_array();
        if (!pair || pair->size() != 2 || !(*pair)[0].is_number() || !(*pair)[1].is_number()) {
          addFound(item, fmt::format("point {} of {}", profile.points.size() + 1, key), expected);
          break;
        }
        profile.points.push_back(
            {(*pair)[0].value<double>().value_or(-1), (*pair)[1].value<double>().value_or(-1)});
        if (Status status = checkProfile(parameter, profile); !status) {
          add(lineOf(item), status.error().message);
          break;
        }
      }
      material.*parameter.member = std::move(profile);
    }
  }

  const std::string& name_;
  std::uint32_t line_ = 0;
  std::string message_;
};

Error tooLarge(const std::string& name, std::uintmax_t size) {
  return {
      fmt::format("{}: found {} bytes; expected a material, which has {} at most", name, size, kLargestFile)};
}

// The shortest decimal that reads back as the same bits, always with a point or an exponent.
std::string tomlNumber(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <class Owner>
void writeNumbers(std::string& text, std::span<const Parameter<Owner>> parameters, const Owner& owner) {
  for (const Parameter<Owner>& parameter : parameters) {
    const std::optional<double> value = parameter.of(owner);
    text += fmt::format(
        "\n# {}\n# {}; usual is {}{}.\n{} = ", parameter.effect, rangeText(parameter.allowed, parameter.unit),
        rangeText(parameter.usual, parameter.unit),
        parameter.canBeUnset() ? fmt::format(", or \"{}\": measured on the rest curl", kFromRest) : "",
        parameter.key);
    if (!value) {
      text += fmt::format("\"{}\"\n", kFromRest);
    } else if (parameter.isWhole()) {
      text += fmt::format("{:.0f}\n", *value);
    } else {
      text += tomlNumber(*value) + "\n";
    }
  }
}

}  // namespace

Result<LoadedMaterial> parseMaterial(std::string_view text, const std::string& name) {
  if (text.size() > kLargestFile) return tooLarge(name, text.size());
  if (const auto dotCount = std::count(text.begin(), text.end(), '.'); dotCount > kMostDots) {
    return Error{fmt::format("{}: found {} dots; expected a material, which has {} at most", name, dotCount,
                             kMostDots)};
  }
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return Error{
        fmt::format("{}: line {}: found no TOML: {}", name, error.source().begin.line, error.description())};
  }
  return MaterialReader(name).read(parsed.table());
}

Result<LoadedMaterial> readMaterial(const std::filesystem::path& path) {
  // Before memory is asked for.
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kLargestFile) return tooLarge(path.string(), size);
  auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  return parseMaterial({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
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
    std::vector<std::string> points;
    for (const Profile::Point& point : (material.*parameter.member).points)
      points.push_back(fmt::format("[{}, {}]", tomlNumber(point.s), tomlNumber(point.factor)));
    text += fmt::format("\n# {}\n# Factors {}; usual is {}.\n{} = [{}]\n", parameter.effect,
                        rangeText(parameter.allowed, parameter.unit),
                        rangeText(parameter.usual, parameter.unit), parameter.key, fmt::join(points, ", "));
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
