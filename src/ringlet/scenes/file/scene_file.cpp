// Implements scenes/file/scene_file.h: reading. Writing and listing are scene_text.cpp.
#include "ringlet/scenes/file/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "ringlet/base/is_below.h"
#include "ringlet/base/nearest_name.h"
#include "ringlet/base/quoted.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_table.h"
#include "ringlet/rest/toml_file.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scenes/file/scene_change.h"
#include "ringlet/scenes/file/scene_fields.h"
#include "ringlet/scenes/file/scene_text.h"
#include "ringlet/scenes/frames/scene_keys.h"
#include "ringlet/scenes/load/scene_maps.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

constexpr const char* kWhat = "a scene";
constexpr const char* kThreeMotions = "one of kind, file and keys";

template <class Owner>
void addKeys(std::vector<KnownKey>& keys, const std::string& table,
             std::span<const SceneField<Owner>> fields) {
  for (const auto& field : fields) keys.push_back({table, field.key});
}

const std::vector<KnownKey>& knownKeys() {
  static const std::vector<KnownKey> all = [] {
    std::vector<KnownKey> keys;
    for (const char* table :
         {"groom", "material", "motion", "scalp", "start", "simulation", "contacts", "air", "goal", "body",
          "camera", "field", "hold", "cut", "group", "map", "key", "output"})
      keys.push_back({"", table});
    addKeys(keys, "groom", groomFields());
    keys.push_back({"groom", "cut"});
    addKeys(keys, "groom.cut", cutFields());
    keys.push_back({"material", "file"});
    std::ranges::copy(knownMaterialKeys("material"), std::back_inserter(keys));
    addKeys(keys, "motion", motionFields());
    addKeys(keys, "motion", headMotionFields());
    keys.push_back({"motion", "key"});
    keys.push_back({"motion", "roots"});
    addKeys(keys, "motion.key", keyframeFields());
    addKeys(keys, "motion.roots", rootsFields());
    addKeys(keys, "scalp", scalpFields());
    addKeys(keys, "start", startFields());
    addKeys(keys, "simulation", simulationFields());
    addKeys(keys, "contacts", contactFields());
    addKeys(keys, "air", airFields());
    addKeys(keys, "goal", goalFields());
    keys.push_back({"goal", "file"});
    addKeys(keys, "body", bodyFields());
    keys.push_back({"body", "moves"});
    addKeys(keys, "body.moves", motionFields());
    keys.push_back({"body.moves", "key"});
    addKeys(keys, "body.moves.key", keyframeFields());
    addKeys(keys, "camera", cameraFields());
    addKeys(keys, "field", forceFieldFields());
    addKeys(keys, "hold", holdFields());
    addKeys(keys, "cut", sceneCutFields());
    addKeys(keys, "group", groupFields());
    addKeys(keys, "map", mapFields());
    addKeys(keys, "output", outputFields());
    return keys;
  }();
  return all;
}

// "; did you mean NAME?", or nothing.
std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  const std::size_t index = nearestName(word, names);
  return index < names.size() ? fmt::format("; did you mean {}?", names[index]) : "";
}

std::string oneOf(const std::string& choices, std::string_view word) {
  return fmt::format("one of {}{}", choices, nearest(word, namesIn(choices)));
}

bool isAmong(const std::string& name, const std::string& list) {
  const auto names = namesIn(list);
  return std::ranges::find(names, name) != names.end();
}

// As many numbers as an array holds, all in a range; nothing for anything else.
template <std::size_t count>
std::optional<std::array<double, count>> numbersOf(const toml::node& node, const NumberRange& allowed) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != count) return std::nullopt;
  std::array<double, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!(*list)[i].is_number()) return std::nullopt;
    numbers[i] = (*list)[i].template value<double>().value_or(NAN);
    if (!allowed.contains(numbers[i])) return std::nullopt;
  }
  return numbers;
}

// Walks a parsed file.
class SceneReader {
 public:
  SceneReader(const std::string& name, const std::filesystem::path& folder, SceneReach reach,
              std::span<const SceneChange> changes)
      : name_(name), folder_(folder), reach_(reach), changes_(changes) {}

  Result<SceneFile> read(const toml::table& file) {
    SceneFile scene;
    problems_.addUnknownKeys(file, "", knownKeys());
    readGroom(file, scene.groom);
    readMaterial(file, scene);
    if (const toml::table* table = tableOf(file, "", "motion")) readHeadMotion(*table, scene.motion);
    if (const toml::table* table = tableOf(file, "", "scalp")) {
      readFields(*table, "scalp", scalpFields(), scene.scalp);
      checkScalp(*table, scene.scalp);
    }
    if (const toml::table* table = tableOf(file, "", "start"))
      readFields(*table, "start", startFields(), scene.start);
    readSimulation(file, scene.simulation);
    if (const toml::table* table = tableOf(file, "", "contacts")) {
      scene.contacts.on = true;
      readFields(*table, "contacts", contactFields(), scene.contacts);
      refuseForeign(*table, "contacts", contactFields(), nameOf(scene.contacts.taper), "the taper");
    }
    if (const toml::table* table = tableOf(file, "", "air")) {
      scene.air.on = true;
      readFields(*table, "air", airFields(), scene.air);
    }
    if (const toml::table* table = tableOf(file, "", "goal")) {
      scene.goal.on = true;
      readFields(*table, "goal", goalFields(), scene.goal);
      if (const toml::node* path = table->get("file"))
        scene.goalFile = pathOf(*path, "goal.file").value_or(std::filesystem::path{});
    }
    for (const toml::table* table : tablesOf(file, "", "body")) {
      scene.bodies.emplace_back();
      readBody(*table, scene, scene.bodies.back());
    }
    if (const toml::table* table = tableOf(file, "", "scalp")) checkScalpBody(*table, scene);
    for (const toml::table* table : tablesOf(file, "", "camera")) {
      scene.cameras.emplace_back();
      readCamera(*table, scene, scene.cameras.back());
    }
    for (const toml::table* table : tablesOf(file, "", "group")) {
      scene.groups.emplace_back();
      readGroup(*table, scene, scene.groups.back());
    }
    for (const toml::table* table : tablesOf(file, "", "field")) {
      scene.fields.emplace_back();
      readForceField(*table, scene, scene.fields.back());
    }
    for (const toml::table* table : tablesOf(file, "", "hold")) {
      scene.holds.emplace_back();
      readHold(*table, scene, scene.holds.back());
    }
    for (const toml::table* table : tablesOf(file, "", "cut")) {
      scene.cuts.emplace_back();
      readCut(*table, scene, scene.cuts.back());
    }
    readMaps(file, scene);
    readTimeKeys(file, scene);
    if (const toml::table* table = tableOf(file, "", "output"))
      readFields(*table, "output", outputFields(), scene.output);

    if (!problems_.empty()) return problems_.error(name_);
    if (!missing_.empty()) return missing_.error(name_);
    for (const std::string& sentence : unusualNumbers(scene.material.material, scene.material.dials))
      scene.warnings.push_back(fmt::format("{}: {}", name_, sentence));
    return scene;
  }

 private:
  // A table below another, its keys checked; nothing where there is none.
  const toml::table* tableOf(const toml::table& owner, const std::string& ownerName, const char* key) {
    const toml::node* node = owner.get(key);
    if (!node) return nullptr;
    const std::string name = KnownKey{ownerName, key}.fullName();
    if (!node->is_table()) {
      problems_.addFound(*node, name, fmt::format("a table, as in [{}]", name));
      return nullptr;
    }
    if (name != "material") problems_.addUnknownKeys(*node->as_table(), name, knownKeys());
    return node->as_table();
  }

  // Several of them, each headed by [[name]].
  std::vector<const toml::table*> tablesOf(const toml::table& owner, const std::string& ownerName,
                                           const char* key) {
    const toml::node* node = owner.get(key);
    if (!node) return {};
    const std::string name = KnownKey{ownerName, key}.fullName();
    std::vector<const toml::table*> tables;
    const toml::array* list = node->as_array();
    if (!list) problems_.addFound(*node, name, fmt::format("a list of tables, as in [[{}]]", name));
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const toml::node& item = (*list)[i];
      if (!item.is_table()) {
        problems_.addFound(item, name, fmt::format("a list of tables, as in [[{}]]", name));
        continue;
      }
      problems_.addUnknownKeys(*item.as_table(), name, knownKeys());
      tables.push_back(item.as_table());
    }
    return tables;
  }

  template <class Owner>
  void readFields(const toml::table& table, const std::string& name,
                  std::span<const SceneField<Owner>> fields, Owner& owner) {
    for (const SceneField<Owner>& field : fields) {
      const toml::node* node = table.get(field.key);
      if (!node) continue;
      const std::string key = KnownKey{name, field.key}.fullName();
      std::visit(
          [&](auto member) {
            using Value = typename Unwrapped<std::remove_reference_t<decltype(owner.*member)>>::Type;
            if constexpr (std::is_same_v<Value, std::filesystem::path>) {
              if (auto path = pathOf(*node, key)) owner.*member = std::move(*path);
              return;
            } else if (std::optional<Value> value = valueOf<Value>(*node, field.allowed, field.choices)) {
              owner.*member = std::move(*value);
              return;
            }
            const auto* text = node->as_string();
            const bool mayBeNear =
                text && !field.choices.empty() && !std::is_same_v<Value, std::vector<std::string>>;
            std::string expected = mayBeNear ? oneOf(field.choices, text->get()) : expectedOf(field);
            const bool isFile = mayBeNear && std::filesystem::path(text->get()).has_extension();
            if (isFile && field.choices == motionNames())
              expected +=
                  fmt::format("; a {} file goes into {}", kMotionEndings, KnownKey{name, "file"}.fullName());
            problems_.addFound(*node, key, expected);
          },
          field.member);
    }
  }

  template <class Value, std::size_t count>
  static std::optional<Value> named(const char* const (&names)[count], const toml::node& node) {
    const auto* at = std::ranges::find(names, node.value_exact<std::string>().value_or(""));
    return at == std::end(names) ? std::nullopt : std::optional(static_cast<Value>(at - names));
  }

  // What a node says, if it is of that type and range.
  template <class Value>
  std::optional<Value> valueOf(const toml::node& node, const NumberRange& allowed,
                               const std::string& choices) {
    if constexpr (std::is_same_v<Value, bool>) {
      return node.value_exact<bool>();
    } else if constexpr (std::is_integral_v<Value>) {
      const auto number = node.value_exact<std::int64_t>();
      if (!number || !allowed.contains(static_cast<double>(*number))) return std::nullopt;
      return static_cast<Value>(*number);
    } else if constexpr (std::is_same_v<Value, double>) {
      const auto number = node.is_number() ? node.value<double>() : std::nullopt;
      return number && allowed.contains(*number) ? number : std::nullopt;
    } else if constexpr (std::is_same_v<Value, std::string>) {
      auto text = node.value_exact<std::string>();
      return text && !text->empty() && (choices.empty() || isAmong(*text, choices)) ? text : std::nullopt;
    } else if constexpr (std::is_same_v<Value, Vec3d>) {
      const auto numbers = numbersOf<3>(node, allowed);
      if (!numbers) return std::nullopt;
      return Vec3d{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    } else if constexpr (std::is_same_v<Value, Quatd>) {
      const auto numbers = numbersOf<4>(node, allowed);
      if (!numbers) return std::nullopt;
      return Quatd{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
    } else if constexpr (std::is_same_v<Value, ContactTaper>) {
      return named<ContactTaper>(kContactTaperNames, node);
    } else if constexpr (std::is_same_v<Value, ContactMethod>) {
      return named<ContactMethod>(kContactMethodNames, node);
    } else if constexpr (std::is_same_v<Value, BodyShape>) {
      const BodyForm* form = formNamed(node.value_exact<std::string_view>().value_or(""));
      return form ? std::optional(form->shape) : std::nullopt;
    } else {
      static_assert(std::is_same_v<Value, std::vector<std::string>>);
      const toml::array* list = node.as_array();
      if (!list) return std::nullopt;
      std::vector<std::string> texts;
      for (const toml::node& item : *list) {
        auto text = valueOf<std::string>(item, allowed, choices);
        if (!text) return std::nullopt;
        texts.push_back(std::move(*text));
      }
      return texts;
    }
  }

  // Nothing where it is none, or out of reach; that is a problem then.
  std::optional<std::filesystem::path> pathOf(const toml::node& node, const std::string& key) {
    const auto text = node.value_exact<std::string>();
    if (!text || text->empty() || text->find('\0') != text->npos) {
      problems_.addFound(node, key, "a path");
      return std::nullopt;
    }
    const auto isTyped = [&](const SceneChange& change) {
      return change.key == key && change.form == SceneChange::Form::path && change.value == *text;
    };
    if (std::ranges::any_of(changes_, isTyped)) return *text;
    std::filesystem::path path = folder_ / *text;
    if (reach_ == SceneReach::anywhere || isBelow(path, folder_)) return path;
    problems_.addFound(node, key, "a path in or below the scene's folder, to which it is confined");
    return std::nullopt;
  }

  // Keys that only others have: `mode` is the kind, shape or source of this one ("" where that is wrong
  // already), `what` says of what.
  template <class Owner>
  void refuseForeign(const toml::table& table, const std::string& name,
                     std::span<const SceneField<Owner>> fields, const std::string& mode,
                     const std::string& what) {
    if (mode.empty()) return;
    for (const SceneField<Owner>& field : fields) {
      const toml::node* node = table.get(field.key);
      if (!node || field.onlyWith.empty() || isAmong(mode, field.onlyWith)) continue;
      problems_.add(
          lineOf(*node),
          fmt::format("found {} with {} {}; only {} {} it", KnownKey{name, field.key}.fullName(), what, mode,
                      field.onlyWith, namesIn(field.onlyWith).size() > 1 ? "have" : "has"));
    }
  }

  void readGroup(const toml::table& table, const SceneFile& scene, SceneGroup& group) {
    readFields(table, "group", groupFields(), group);
    for (const char* key : {"name", "strands"})
      if (!table.get(key))
        missing_.add(lineOf(table), fmt::format("found a group without {}; expected name and strands", key));
    refuseTwice(table, "group", scene.groups, group.name);
    checkName(table, "group", group.name);
    const toml::node* name = table.get("name");
    if (name && !group.name.empty() && !std::isalpha(static_cast<unsigned char>(group.name.front())))
      problems_.addFound(*name, "group.name", "a name that begins with a letter");
    const std::span<const SceneGroup> before(scene.groups.data(), scene.groups.size() - 1);
    if (const toml::node* strands = table.get("strands"); strands && !group.strands.empty()) {
      if (const auto runs = parseStrands(group.strands, 1, before); !runs)
        problems_.add(lineOf(*strands), fmt::format("group.strands: {}", runs.error().message));
    }
  }

  void readMaps(const toml::table& file, SceneFile& scene) {
    for (const toml::table* table : tablesOf(file, "", "map")) {
      SceneMap map;
      readFields(*table, "map", mapFields(), map);
      const toml::node *number = table->get("number"), *preset = table->get("preset");
      const auto expectOne = [&](std::initializer_list<const char*> names) {
        std::vector<const toml::node*> found;
        for (const char* name : names)
          if (const toml::node* node = table->get(name)) found.push_back(node);
        if (found.size() == 1) return found.front();
        const std::string list = fmt::format("{}", fmt::join(names, ", "));
        if (found.empty())
          missing_.add(lineOf(*table),
                       fmt::format("found a map with none of {}; expected one of them", list));
        else
          problems_.add(lineOf(**std::ranges::max_element(found, {}, [](auto* n) { return lineOf(*n); })),
                        fmt::format("found a map with {} of {}; expected one of them", found.size(), list));
        return static_cast<const toml::node*>(nullptr);
      };
      expectOne({"number", "preset"});
      const toml::node* source = expectOne({"file", "strands", "primvar", "texture"});
      if (preset && !number && source && source != table->get("strands"))
        problems_.add(lineOf(*source), "found a preset for other than strands; only a number has factors");
      if (const toml::node* factor = table->get("factor"); factor && preset)
        problems_.add(lineOf(*factor), "found map.factor with a preset; only a number has it");
      for (const char* key : {"file", "strands", "primvar", "texture"})
        if (source && source == table->get(key)) refuseForeign(*table, "map", mapFields(), key, "a map of");
      if (!problems_.empty() || !missing_.empty()) continue;
      if (map.number == kGoalStrengthMap && !scene.goal.on)
        problems_.add(lineOf(*number),
                      "found a map of goal.strength without [goal]; expected a goal it is of");
      if (map.number == kContactRadiusMap && !scene.contacts.on)
        problems_.add(lineOf(*number),
                      "found a map of contacts.radius without [contacts]; expected contacts");
      // By itself first, so that a mistake has its line.
      Material alone = scene.material.material;
      const std::span<const SceneMap> one(&map, 1);
      const Status added = isOfMaterial(map) ? applyMaps(one, scene, alone) : checkStrands(map, scene);
      if (!added) problems_.add(lineOf(*source), added.error().message);
      scene.maps.push_back(std::move(map));
    }
    if (scene.maps.empty() || !problems_.empty() || !missing_.empty()) return;
    scene.hasMaterial = scene.hasMaterial || std::ranges::any_of(scene.maps, isOfMaterial);
    Status whole = applyMaps(scene.maps, scene, scene.material.material);
    if (whole) whole = checkMaterial(scene.material.material);
    if (!whole) problems_.add(lineOf(*file.get("map")), whole.error().message);
  }

  void readTimeKeys(const toml::table& file, SceneFile& scene) {
    const toml::node* node = file.get("key");
    if (!node) return;
    const toml::array* list = node->as_array();
    if (!list || !std::ranges::all_of(*list, [](const toml::node& item) { return item.is_table(); })) {
      problems_.addFound(*node, "key", "a list of tables, as in [[key]]");
      return;
    }
    for (const toml::node& item : *list) {
      const toml::table& table = *item.as_table();
      SceneTimeKey key;
      const std::string which = fmt::format("key {}", scene.timeKeys.size() + 1);
      const toml::node* time = table.get("time");
      if (!time) {
        missing_.add(lineOf(table), fmt::format("found no time of {}; expected one, in seconds", which));
      } else if (const auto number = valueOf<double>(*time, {-3600, 36000}, "")) {
        key.time = *number;
        if (!scene.timeKeys.empty() && !(key.time > scene.timeKeys.back().time))
          problems_.add(lineOf(*time),
                        fmt::format("found the time {} of {}; expected one after that of the key before, {}",
                                    key.time, which, scene.timeKeys.back().time));
      } else {
        problems_.addFound(*time, "key.time", "a number from -3600 to 36000 s");
      }
      readKeyedValues(table, "", scene, key);
      if (key.values.empty() && problems_.empty())
        missing_.add(
            lineOf(table),
            fmt::format(
                "found nothing that {} changes; expected keys with their tables, as air.wind = [1, 0, 0]",
                which));
      scene.timeKeys.push_back(std::move(key));
    }
  }

  // The values of a key, whose names are those of the scene's tables.
  void readKeyedValues(const toml::table& table, const std::string& above, SceneFile& scene,
                       SceneTimeKey& key) {
    for (const auto& [word, node] : table) {
      const std::string name = KnownKey{above, std::string(word.str())}.fullName();
      if (above.empty() && name == "time") continue;
      if (const toml::table* below = node.as_table()) {
        readKeyedValues(*below, name, scene, key);
        continue;
      }
      const auto number = keyedNumber(scene, name);
      if (!number) {
        problems_.add(lineOf(node),
                      fmt::format("found {} in a key; it {}{}", ringlet::quoted(name),
                                  isKnown(name) ? "does not change while hair moves" : "is no key of a scene",
                                  nearest(name, keyedNames(scene))));
        continue;
      }
      const auto vector = number->isVector ? valueOf<Vec3d>(node, number->allowed, "") : std::nullopt;
      const auto single = number->isVector ? std::nullopt : valueOf<double>(node, number->allowed, "");
      if (vector || single) {
        key.values.push_back({name, vector ? *vector : Vec3d{*single, 0, 0}});
        switchOn(*number, scene);
      } else {
        const std::string range = rangeOf(number->allowed, number->unit);
        problems_.addFound(node, name,
                           number->isVector ? "[x, y, z]" : "a number" + (range.empty() ? "" : " " + range));
      }
    }
  }

  static bool isKnown(const std::string& name) {
    return std::ranges::any_of(knownKeys(), [&](const KnownKey& key) { return key.fullName() == name; });
  }
  static std::vector<std::string> keyedNames(const SceneFile& scene) {
    std::vector<std::string> names;
    for (const KeyedNumber& number : keyedNumbers()) names.push_back(number.key);
    for (const KeyedNumber& number : actingNumbers(scene)) names.push_back(number.key);
    return names;
  }

  void readGroom(const toml::table& file, SceneGroom& groom) {
    const toml::table* table = tableOf(file, "", "groom");
    if (!table) {
      if (!file.get("groom"))
        missing_.add(1, "found no groom; expected [groom], with file or generate, the name of a generator");
      return;
    }
    if (const auto style = table->get("style"))
      groom = groomOfStyle(style->value<std::string>().value_or(""));
    readFields(*table, "groom", groomFields(), groom);
    const toml::table* cut = tableOf(*table, "groom", "cut");
    if (cut) readFields(*cut, "groom.cut", cutFields(), groom.cut);
    if (cut && groom.generate != "head")
      problems_.add(lineOf(*cut), "found groom.cut; only the groom from head has it");
    const toml::node *path = table->get("file"), *generator = table->get("generate");
    if (path && generator) {
      problems_.add(std::max(lineOf(*path), lineOf(*generator)),
                    "found groom.file and groom.generate; expected one of the two");
    } else if (!path && !generator) {
      missing_.add(lineOf(*table), "found neither groom.file nor groom.generate; expected one of the two");
    } else {
      refuseForeign(*table, "groom", groomFields(), path ? "file" : groom.generate, "a groom from");
    }
  }

  void readMaterial(const toml::table& file, SceneFile& scene) {
    const toml::table* table = tableOf(file, "", "material");
    if (!table) return;
    scene.hasMaterial = true;
    problems_.addUnknownKeys(*table, "material", knownKeys());
    if (const toml::node* node = table->get("file"))
      readMaterialFile(*node, table->get("preset"), scene.material);
    readMaterialTable(*table, "material", scene.material, problems_);
  }

  void readMaterialFile(const toml::node& node, const toml::node* preset, LoadedMaterial& material) {
    const auto path = pathOf(node, "material.file");
    if (!path) return;
    if (preset) {
      problems_.add(std::max(lineOf(node), lineOf(*preset)),
                    "found material.file and material.preset; expected one of the two");
      return;
    }
    auto loaded = ringlet::readMaterial(*path);
    if (!loaded) {
      problems_.add(lineOf(node), loaded.error().message);
      return;
    }
    material = std::move(*loaded);
    material.warnings.clear();  // told of the whole below
  }

  void readHeadMotion(const toml::table& table, SceneMotion& motion) {
    readMotion(table, "motion", motion, false);
    readFields(table, "motion", headMotionFields(), motion);
    if (const toml::table* roots = tableOf(table, "motion", "roots"))
      readFields(*roots, "motion.roots", rootsFields(), motion.roots);
  }

  // mustMove: there has to be a kind, a file or keys.
  void readMotion(const toml::table& table, const std::string& name, SceneMotion& motion, bool mustMove) {
    motion.kind.clear();
    readFields(table, name, motionFields(), motion);
    for (const toml::table* key : tablesOf(table, name, "key")) readKeyframe(*key, name + ".key", motion);

    const toml::node *kind = table.get("kind"), *path = table.get("file"), *keys = table.get("key");
    const int count = (kind ? 1 : 0) + (path ? 1 : 0) + (keys ? 1 : 0);
    if (count > 1) {
      const toml::node& second = *(keys ? keys : path);
      problems_.add(lineOf(second), fmt::format("found two ways for {} to move; expected {}",
                                                name == "motion" ? "the head" : "the body", kThreeMotions));
      return;
    }
    if (count == 0) {
      // What is left says how, but not what.
      const toml::node* stray = nullptr;
      for (const auto& field : motionFields()) {
        if (const toml::node* node = table.get(field.key); node && !field.onlyWith.empty() && !stray)
          stray = node;
      }
      if (stray || mustMove)
        missing_.add(lineOf(stray ? *stray : table),
                     fmt::format("found no way to move in [{}]; expected {}", name, kThreeMotions));
      motion.kind = "still";
      return;
    }
    if (keys && motion.keys.empty())
      problems_.addFound(*keys, name + ".key", fmt::format("at least one key, as in [[{}.key]]", name));
    refuseForeign(table, name, motionFields(), kind ? motion.kind : path ? "file" : "keys", "a motion by");
    if (path) refuseOtherFiles(table, name, motionFileKind(motion.file.string()), motion.skipFrames);
    if (motion.axis && !(length(*motion.axis) > 0))
      problems_.addFound(*table.get("axis"), name + ".axis", "a direction, whose length is above 0");
  }

  // Keys that only one kind of file has.
  void refuseOtherFiles(const toml::table& table, const std::string& name, MotionFileKind kind,
                        int skipFrames) {
    const toml::node *skips = table.get("skip_frames"), *animation = table.get("animation");
    if (kind == MotionFileKind::gltf && skips && skipFrames > 0)
      problems_.add(lineOf(*skips), fmt::format("found {}.skip_frames: a glTF animation has times and no "
                                                "frames; cut it where it is made",
                                                name));
    if (kind == MotionFileKind::bvh && animation)
      problems_.add(lineOf(*animation), fmt::format("found {}.animation: a .bvh file has only one", name));
  }

  void readKeyframe(const toml::table& table, const std::string& name, SceneMotion& motion) {
    SceneKeyframe key;
    readFields(table, name, keyframeFields(), key);
    const std::string which = fmt::format("key {} of {}", motion.keys.size() + 1, name);
    const toml::node* time = table.get("time");
    if (!time) {
      missing_.add(lineOf(table), fmt::format("found no time of {}; expected one, in seconds", which));
    } else if (!motion.keys.empty() && !(key.time > motion.keys.back().time)) {
      problems_.add(lineOf(*time),
                    fmt::format("found the time {} of {}; expected one after that of the key before, {}",
                                key.time, which, motion.keys.back().time));
    }
    if (const toml::node* quaternion = table.get("quaternion")) {
      const Quatd q = key.quaternion.value_or(Quatd{});
      if (table.get("rotate_degrees")) {
        problems_.add(
            std::max(lineOf(*quaternion), lineOf(*table.get("rotate_degrees"))),
            fmt::format("found a quaternion and rotate_degrees of {}; expected one of the two", which));
      } else if (!(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w > 0)) {
        problems_.addFound(*quaternion, name + ".quaternion", "[x, y, z, w], of a length above 0");
      }
    }
    motion.keys.push_back(key);
  }

  void readSimulation(const toml::table& file, SceneSimulation& simulation) {
    const toml::table* table = tableOf(file, "", "simulation");
    if (!table) return;
    readFields(*table, "simulation", simulationFields(), simulation);
    const toml::node *frames = table->get("frames"), *seconds = table->get("seconds");
    if (frames && seconds) {
      problems_.add(std::max(lineOf(*frames), lineOf(*seconds)),
                    "found simulation.frames and simulation.seconds; expected one of the two");
    }
    refuseForeign(*table, "simulation", simulationFields(), simulation.integrator, "the integrator");
  }

  void readBody(const toml::table& table, const SceneFile& scene, SceneBody& body) {
    readFields(table, "body", bodyFields(), body);
    if (!table.get("shape")) {
      missing_.add(lineOf(table), fmt::format("found a body without a shape; expected shape = one of {}",
                                              bodyFields()[1].choices));
    }
    const BodyForm* form = formNamed(table["shape"].value_exact<std::string_view>().value_or(""));
    refuseForeign(table, "body", bodyFields(), form ? std::string(form->name) : "", "the shape");
    const toml::node *path = table.get("file"), *generator = table.get("generate");
    if (form && form->shape == BodyShape::grid && !path == !generator) {
      (path ? problems_ : missing_)
          .add(lineOf(path ? *path : table),
               fmt::format("found a mesh with {}; expected one of file and generate",
                           path ? "both a file and a generator" : "neither a file nor a generator"));
    }
    readMoves(table, scene, body);
    checkDeforms(table, body);
  }

  // Keys that only a mesh that deforms has, or only another.
  void checkDeforms(const toml::table& table, const SceneBody& body) {
    for (const char* key : {"cache", "cache_fps", "animation", "start", "region", "sides"})
      if (const toml::node* node = table.get(key); node && !body.deforms)
        problems_.add(lineOf(*node), fmt::format("found body.{}; expected deforms = true beside it", key));
    for (const char* key : {"cells", "region"})
      if (const toml::node* node = table.get(key); node && body.sides == "both")
        problems_.add(
            lineOf(*node),
            fmt::format("found body.{} of cloth (sides = \"both\"), which has no grid; expected none", key));
    if (const toml::node* node = table.get("generate")) checkGenerator(*node, body);
    if (body.deforms)
      for (const char* key : {"mesh", "unit", "cache", "cache_fps", "animation"})
        refuseOfGenerated(table, key, body.generate);
    for (const char* key : {"scale", "position", "rotate_degrees", "bind", "bind_frame"})
      if (const toml::node* node = table.get(key); node && body.deforms)
        problems_.add(lineOf(*node),
                      fmt::format("found body.{} of a mesh that deforms, whose points are in the "
                                  "world as its file has them; expected none",
                                  key));
  }

  void checkScalp(const toml::table& table, const SceneScalp& scalp) {
    const toml::node *path = table.get("file"), *body = table.get("body");
    if (!path && !body)
      missing_.add(lineOf(table), "found neither scalp.file nor scalp.body; expected one of the two");
    for (const char* key : {"file", "cache", "mesh", "animation", "unit", "up", "cache_fps", "start"})
      if (const toml::node* node = table.get(key); node && !scalp.body.empty())
        problems_.add(lineOf(*node),
                      fmt::format("found scalp.{} beside scalp.body, whose own it is; expected none", key));
  }

  void checkScalpBody(const toml::table& table, const SceneFile& scene) {
    const toml::node* node = table.get("body");
    if (!node || !node->is_string()) return;
    std::vector<std::string> names;
    for (const SceneBody& body : scene.bodies)
      if (body.deforms) names.push_back(body.name);
    if (std::ranges::find(names, scene.scalp.body) == names.end())
      problems_.addFound(*node, "scalp.body",
                         "the name of a body that deforms" + nearest(scene.scalp.body, names));
  }

  // Of generated meshes, all but the head deform, and the cape is cloth.
  void checkGenerator(const toml::node& node, const SceneBody& body) {
    const bool isCape = body.generate == "cape";
    if (body.deforms != (isCape || body.generate == "bust"))
      problems_.addFound(
          node, "body.generate",
          body.deforms ? "bust or cape: no other generated mesh deforms" : "deforms = true beside it");
    else if (isCape && body.sides != "both")
      problems_.addFound(node, "body.generate", "sides = \"both\" beside it");
  }

  // What says how a file is read.
  void refuseOfGenerated(const toml::table& table, const char* key, const std::string& generator) {
    if (const toml::node* node = table.get(key); node && !generator.empty())
      problems_.add(
          lineOf(*node),
          fmt::format("found body.{} of the generated {}; only a mesh of a file has it", key, generator));
  }

  // "head", "still", or a motion of its own; or a joint.
  void readMoves(const toml::table& table, const SceneFile& scene, SceneBody& body) {
    const toml::node *moves = table.get("moves"), *joint = table.get("joint");
    if (moves && joint) {
      problems_.add(std::max(lineOf(*moves), lineOf(*joint)),
                    "found body.moves and body.joint; expected one of the two");
    } else if (joint && scene.motion.file.empty()) {
      problems_.add(lineOf(*joint), "found body.joint, but the head follows no file; expected motion.file");
    }
    if (!moves) return;
    if (const auto* text = moves->as_string(); text && text->get() == "still") {
      body.moves = SceneMotion{.kind = "still"};
    } else if (moves->is_table()) {
      problems_.addUnknownKeys(*moves->as_table(), "body.moves", knownKeys());
      readMotion(*moves->as_table(), "body.moves", body.moves.emplace(), true);
    } else if (!text || text->get() != "head") {
      problems_.addFound(*moves, "body.moves",
                         "\"head\", \"still\" or a motion, as in { kind = \"spin\" }" +
                             nearest(text ? text->get() : "", {"head", "still"}));
    }
  }

  void readCamera(const toml::table& table, const SceneFile& scene, SceneCamera& camera) {
    readFields(table, "camera", cameraFields(), camera);
    if (!table.get("name")) missing_.add(lineOf(table), "found a camera without a name; expected one");
    const toml::node *eye = table.get("eye"), *path = table.get("file");
    if (!eye && !path)
      missing_.add(lineOf(table), "found a camera with neither eye nor file; expected one of the two");
    refuseForeign(table, "camera", cameraFields(), path ? "file" : "eye", "a camera with");
    if (camera.eye && *camera.eye == camera.target)
      problems_.addFound(*eye, "camera.eye", "another place than camera.target");
    checkJoint(table, "camera", scene);
    refuseTwice(table, "camera", scene.cameras, camera.name);
  }

  // Names by which keys and options find one of a list.
  template <class Owner>
  void refuseTwice(const toml::table& table, const std::string& what, const std::vector<Owner>& all,
                   const std::string& name) {
    if (!name.empty() && std::ranges::count(all, name, &Owner::name) > 1)
      problems_.addFound(*table.get("name"), what + ".name",
                         fmt::format("a name that no other {} has", what));
  }

  // Of one that a joint carries.
  void checkJoint(const toml::table& table, const std::string& what, const SceneFile& scene) {
    const toml::node *joint = table.get("joint"), *bind = table.get("bind");
    if (joint && scene.motion.file.empty())
      problems_.add(lineOf(*joint),
                    fmt::format("found {}.joint, but the head follows no file; expected motion.file", what));
    if (joint && bind)
      problems_.add(std::max(lineOf(*joint), lineOf(*bind)),
                    fmt::format("found {0}.joint and {0}.bind; expected one of the two", what));
  }

  void readForceField(const toml::table& table, const SceneFile& scene, SceneForceField& field) {
    readFields(table, "field", forceFieldFields(), field);
    if (!table.get("kind"))
      missing_.add(lineOf(table), fmt::format("found a field without a kind; expected kind = one of {}",
                                              fieldNamed(forceFieldFields(), "kind")->choices));
    refuseForeign(table, "field", forceFieldFields(), field.kind, "the kind");
    if (field.kind == "grid" && !table.get("file"))
      missing_.add(lineOf(table), "found a grid without a file; expected an .npy file");
    if (const toml::node* axis = table.get("axis"); axis && !(length(field.axis) > 0))
      problems_.addFound(*axis, "field.axis", "a direction, of any length above 0");
    checkJoint(table, "field", scene);
    refuseTwice(table, "field", scene.fields, field.name);
    checkName(table, "field", field.name);
  }

  void readHold(const toml::table& table, const SceneFile& scene, SceneHold& hold) {
    readFields(table, "hold", holdFields(), hold);
    const toml::node *begin = table.get("begin"), *end = table.get("end"), *start = table.get("start"),
                     *release = table.get("release");
    if ((begin || end) && !(hold.begin <= hold.end))
      problems_.addFound(*(end ? end : begin), end ? "hold.end" : "hold.begin",
                         "an end that is no nearer to the root than the beginning");
    if (start && release && !(*hold.start < *hold.release))
      problems_.addFound(*release, "hold.release", "a time after hold.start");
    checkStrandRuns(table, "hold", scene, hold.strands);
    checkJoint(table, "hold", scene);
    refuseTwice(table, "hold", scene.holds, hold.name);
    checkName(table, "hold", hold.name);
  }

  void readCut(const toml::table& table, const SceneFile& scene, SceneCut& cut) {
    readFields(table, "cut", sceneCutFields(), cut);
    checkStrandRuns(table, "cut", scene, cut.strands);
    refuseTwice(table, "cut", scene.cuts, cut.name);
  }

  void checkStrandRuns(const toml::table& table, const std::string& what, const SceneFile& scene,
                       const std::string& stated) {
    const toml::node* strands = table.get("strands");
    if (!strands || stated.empty()) return;
    if (const auto runs = parseStrands(stated, 1, scene.groups); !runs)
      problems_.add(lineOf(*strands), fmt::format("{}.strands: {}", what, runs.error().message));
  }

  // Keys have it between dots.
  void checkName(const toml::table& table, const std::string& what, const std::string& name) {
    const auto isFine = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (!name.empty() && !std::ranges::all_of(name, isFine))
      problems_.addFound(*table.get("name"), what + ".name", "letters, digits, _ and - only");
  }

  const std::string& name_;
  const std::filesystem::path& folder_;
  SceneReach reach_;
  std::span<const SceneChange> changes_;
  TomlProblems problems_, missing_;  // what is missing may be there, but mistyped: it is told last
};

}  // namespace

bool isSceneFile(const std::filesystem::path& path) { return isMaterialFile(path); }

namespace {

// Keys of a material at the top, and none of a scene.
bool isMaterialsTable(const toml::table& file) {
  const std::vector<KnownKey> scenes = knownKeys(), materials = knownMaterialKeys("");
  const auto hasOneOf = [&](const std::vector<KnownKey>& known) {
    return std::ranges::any_of(known,
                               [&](const KnownKey& one) { return one.table.empty() && file.get(one.key); });
  };
  return hasOneOf(materials) && !hasOneOf(scenes);
}

}  // namespace

Result<SceneFile> parseScene(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder, std::span<const SceneChange> changes,
                             SceneReach reach) {
  auto file = parseToml(text, name, kWhat);
  if (!file) return file.error();
  for (const SceneChange& change : changes) {
    if (Status changed = applyChange(change, *file); !changed)
      return Error{fmt::format("{}: {}", name, changed.error().message)};
  }
  if (isMaterialsTable(*file)) {
    return Error{fmt::format(
        "{0}: is a material file and no scene: it goes with a groom or a scene, as file = \"{0}\" of "
        "[material] (--material {0})",
        name)};
  }
  return SceneReader(name, folder, reach, changes).read(*file);
}

Result<SceneFile> readScene(const std::filesystem::path& path, std::span<const SceneChange> changes,
                            SceneReach reach) {
  const auto text = readTomlText(path, kWhat);
  if (!text) return text.error();
  return parseScene(*text, path.string(), path.parent_path(), changes, reach);
}

}  // namespace ringlet
