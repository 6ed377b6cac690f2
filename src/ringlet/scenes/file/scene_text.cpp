// Implements scenes/file/scene_text.h, and the listing and writing of scenes/file/scene_file.h.
#include "ringlet/scenes/file/scene_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_table.h"
#include "ringlet/rest/toml_file.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scenes/frames/scene_keys.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

// Values as TOML.
std::string valueText(double value) { return tomlNumber(value); }
std::string valueText(int value) { return fmt::format("{}", value); }
std::string valueText(std::uint32_t value) { return fmt::format("{}", value); }
std::string valueText(bool value) { return value ? "true" : "false"; }
std::string valueText(const std::string& value) { return tomlText(value); }
std::string valueText(ContactTaper value) { return tomlText(nameOf(value)); }
std::string valueText(ContactMethod value) { return tomlText(nameOf(value)); }
std::string valueText(BodyShape value) { return tomlText(std::string(nameOf(value))); }
std::string valueText(const std::filesystem::path& value) { return tomlText(value.generic_string()); }
std::string valueText(Vec3d v) {
  return fmt::format("[{}, {}, {}]", tomlNumber(v.x), tomlNumber(v.y), tomlNumber(v.z));
}
std::string valueText(Quatd q) {
  return fmt::format("[{}, {}, {}, {}]", tomlNumber(q.x), tomlNumber(q.y), tomlNumber(q.z), tomlNumber(q.w));
}
std::string valueText(const std::vector<std::string>& values) {
  std::vector<std::string> texts;
  for (const std::string& value : values) texts.push_back(tomlText(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}
template <class T>
std::string valueText(const std::optional<T>& value) {
  return value ? valueText(*value) : "";
}

// Relative to the scene's folder, so that both can be moved together; but of what shares nothing but the root
// with it, which is likely to stay where it is.
std::string pathText(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto normal = path.lexically_normal(), base = folder.lexically_normal();
  const auto relative = normal.lexically_relative(base);
  if (folder.empty() || relative.empty()) return valueText(path);
  const auto first = [](const std::filesystem::path& of) { return *of.relative_path().begin(); };
  const bool isNear =
      *relative.begin() != ".." || (!base.relative_path().empty() && first(normal) == first(base));
  return valueText(isNear ? relative : normal);
}

// A default for a person: 0.01 rather than 0.01.0, Y rather than "Y".
std::string shown(const auto& value) {
  std::string text = valueText(value);
  if (text.size() > 1 && text.front() == '"') text = text.substr(1, text.size() - 2);
  for (std::size_t at; (at = text.find(".0")) != std::string::npos &&
                       (at + 2 == text.size() || text[at + 2] == ',' || text[at + 2] == ']');)
    text.erase(at, 2);
  return text.empty() ? "none" : text;
}

template <class Owner>
void addKeys(std::vector<SceneKey>& keys, const char* table, std::span<const SceneField<Owner>> fields) {
  const Owner standard{};
  for (const SceneField<Owner>& field : fields) {
    const std::string own = std::visit([&](auto member) { return shown(standard.*member); }, field.member);
    keys.push_back({table, field.key, typeOf(field), field.unit == std::string("1") ? "" : field.unit,
                    rangeOf(field.allowed, field.unit), *field.standard ? field.standard : own,
                    field.onlyWith, field.effect, field.allowed, field.choices});
  }
}

// "KEY = VALUE  # what it does", for all that differ from what stands without them.
template <class Owner>
std::string linesOf(std::span<const SceneField<Owner>> fields, const Owner& owner, const Owner& standard,
                    const std::filesystem::path& folder) {
  std::string lines;
  for (const SceneField<Owner>& field : fields) {
    const auto [value, usual] = std::visit(
        [&](auto member) -> std::pair<std::string, std::string> {
          using Value = std::remove_cvref_t<decltype(owner.*member)>;
          if constexpr (std::is_same_v<Value, std::filesystem::path>) {
            const std::filesystem::path& path = owner.*member;
            if (path.empty()) return {};
            return {pathText(path, folder), ""};
          } else if constexpr (std::is_same_v<Value, std::string>) {
            return {(owner.*member).empty() ? "" : valueText(owner.*member), valueText(standard.*member)};
          } else {
            return {valueText(owner.*member), valueText(standard.*member)};
          }
        },
        field.member);
    const bool isRequired = field.standard == std::string("required");
    if (value.empty() || (value == usual && !isRequired)) continue;
    const std::string unit =
        *field.unit && field.unit != std::string("1") ? fmt::format("[{}] ", field.unit) : "";
    lines += fmt::format("{} = {}  # {}{}\n", field.key, value, unit, field.effect);
  }
  return lines;
}

std::string headed(const std::string& heading, const std::string& lines) {
  return lines.empty() ? "" : fmt::format("\n{}\n{}", heading, lines);
}

std::string motionText(const SceneMotion& motion, const std::string& name,
                       const std::filesystem::path& folder) {
  const SceneMotion none{};
  std::string lines = linesOf(motionFields(), motion, none, folder);
  if (name == "motion") lines += linesOf(headMotionFields(), motion, none, folder);
  std::string text = headed("[" + name + "]", lines);
  for (const SceneKeyframe& key : motion.keys) {
    const std::string rest = linesOf(keyframeFields(), key, SceneKeyframe{.time = NAN}, folder);
    text += headed("[[" + name + ".key]]", rest);
  }
  return text;
}

std::string bodyText(const SceneBody& body, const std::filesystem::path& folder) {
  std::string lines = linesOf(bodyFields(), body, SceneBody{}, folder);
  if (!body.moves) return headed("[[body]]", lines);
  const SceneMotion& motion = *body.moves;
  const bool isStill = motion.kind == "still" && motion.start == Vec3d{};
  if (isStill) lines += "moves = \"still\"\n";
  return headed("[[body]]", lines) + (isStill ? "" : motionText(motion, "body.moves", folder));
}

// "simulation.gravity, max_stretch; air.wind, ...": a table is named once.
std::string keyedList() {
  std::string list, table;
  for (const KeyedNumber& number : keyedNumbers()) {
    const std::size_t dot = number.key.rfind('.');
    const std::string of = number.key.substr(0, dot);
    if (of == table) {
      list += ", " + number.key.substr(dot + 1);
    } else {
      list += (list.empty() ? "" : "; ") + number.key;
    }
    table = of;
  }
  return list;
}

// A table whose presence switches on.
template <class Owner>
std::string switchedText(const char* heading, std::span<const SceneField<Owner>> fields, const Owner& owner) {
  Owner on{}, off{};
  on.on = true;
  if (!owner.on && linesOf(fields, owner, off, {}).empty()) return "";
  return fmt::format("\n{}\n{}", heading, linesOf(fields, owner, on, {}));
}

}  // namespace

std::string rangeOf(const NumberRange& allowed, const char* unit) {
  if (allowed.low == 0 && allowed.high == 0) return "";
  if (!std::isinf(allowed.high)) return rangeText(allowed, *unit ? unit : "1");
  return fmt::format("from {}{} on", allowed.low, *unit ? fmt::format(" {}", unit) : "");
}

std::vector<SceneKey> sceneKeys() {
  std::vector<SceneKey> keys;
  addKeys(keys, "groom", groomFields());
  addKeys(keys, "groom.cut", cutFields());
  keys.push_back(
      {"material", "file", "path", "", "", "none", "",
       "A material file to start from; all of a material's own keys, also those of its tables dials, "
       "variation and profile, may stand beside it (`ringlet material --list`)."});
  addKeys(keys, "motion", motionFields());
  addKeys(keys, "motion", headMotionFields());
  keys.push_back(
      {"motion", "key", "list of tables", "", "", "none", "",
       "In place of a kind: poses at times, each headed by [[motion.key]]; the head rests before the first "
       "and after the last."});
  addKeys(keys, "motion.key", keyframeFields());
  addKeys(keys, "motion.roots", rootsFields());
  addKeys(keys, "scalp", scalpFields());
  addKeys(keys, "start", startFields());
  addKeys(keys, "simulation", simulationFields());
  addKeys(keys, "contacts", contactFields());
  addKeys(keys, "air", airFields());
  addKeys(keys, "goal", goalFields());
  keys.push_back(
      {"goal", "file", "path", "", "", "none: the groom itself", "",
       "What hair is pulled to: an animation, of Ringlet or of another program, whose points are in the world, or "
       "a groom in another pose, placed as the groom is. Its strands are the groom's."});
  addKeys(keys, "body", bodyFields());
  keys.push_back(
      {"body", "moves", "head, still or a table", "", "", "head", "",
       "What carries it: the head, nothing, or a motion of its own in the world, with the keys of [motion], "
       "as in { kind = \"spin\" }."});
  addKeys(keys, "camera", cameraFields());
  addKeys(keys, "field", forceFieldFields());
  addKeys(keys, "hold", holdFields());
  addKeys(keys, "cut", sceneCutFields());
  addKeys(keys, "group", groupFields());
  addKeys(keys, "map", mapFields());
  keys.push_back(
      {"key", "time", "number", "s", "from -3600 to 36000 s", "none", "",
       "Time of a key, each headed by [[key]]: numbers that change while hair moves. 0 is the beginning of "
       "the first frame, and a frame has the numbers of its end."});
  keys.push_back(
      {"key", "TABLE.KEY", "number or [x, y, z]", "", "", "none", "",
       "What a number of another table is at that time, as air.wind = [1, 0, 0]. Between keys it goes on a "
       "cubic; before its first key and after its last it stays. These change: " +
           keyedList() +
           "; and of a field or hold that has a name, field.NAME.strength, position, reach, drag, "
           "hold.NAME.strength, gather."});
  addKeys(keys, "output", outputFields());
  return keys;
}

std::string sceneText(const SceneFile& scene, const std::filesystem::path& folder,
                      const std::string& heading) {
  std::string text = heading;
  const SceneGroom usual = groomOfStyle(scene.groom.style);
  text += headed("[groom]", linesOf(groomFields(), scene.groom, usual, folder));
  text += headed("[groom.cut]", linesOf(cutFields(), scene.groom.cut, usual.cut, folder));
  text += materialTableText(scene.material.material, scene.material.dials, "material");
  if (scene.motion.kind != "still" || scene.motion.preRollSeconds > 0 || !(scene.motion.start == Vec3d{}))
    text += motionText(scene.motion, "motion", folder);
  text += headed("[motion.roots]", linesOf(rootsFields(), scene.motion.roots, SceneRoots{}, folder));
  text += headed("[scalp]", linesOf(scalpFields(), scene.scalp, SceneScalp{}, folder));
  text += headed("[start]", linesOf(startFields(), scene.start, SceneStart{}, folder));
  text += headed("[simulation]", linesOf(simulationFields(), scene.simulation, SceneSimulation{}, folder));
  text += switchedText("[contacts]", contactFields(), scene.contacts);
  text += switchedText("[air]", airFields(), scene.air);
  text += switchedText("[goal]", goalFields(), scene.goal);
  if (!scene.goalFile.empty()) text += fmt::format("file = {}\n", pathText(scene.goalFile, folder));
  for (const SceneBody& body : scene.bodies) text += bodyText(body, folder);
  for (const SceneCamera& camera : scene.cameras)
    text += headed("[[camera]]", linesOf(cameraFields(), camera, SceneCamera{}, folder));
  for (const SceneGroup& group : scene.groups)
    text += headed("[[group]]", linesOf(groupFields(), group, SceneGroup{}, folder));
  for (const SceneForceField& field : scene.fields)
    text += headed("[[field]]", linesOf(forceFieldFields(), field, SceneForceField{}, folder));
  for (const SceneHold& hold : scene.holds)
    text += headed("[[hold]]", linesOf(holdFields(), hold, SceneHold{}, folder));
  for (const SceneCut& cut : scene.cuts)
    text += headed("[[cut]]", linesOf(sceneCutFields(), cut, SceneCut{}, folder));
  for (const SceneMap& map : scene.maps)
    text += headed("[[map]]", linesOf(mapFields(), map, SceneMap{}, folder));
  for (const SceneTimeKey& key : scene.timeKeys) {
    text += fmt::format("\n[[key]]\ntime = {}  # [s]\n", tomlNumber(key.time));
    for (const SceneKeyedValue& value : key.values)
      text += fmt::format(
          "{} = {}\n", value.key,
          keyedNumber(scene, value.key)->isVector ? valueText(value.value) : valueText(value.value.x));
  }
  text += headed("[output]", linesOf(outputFields(), scene.output, SceneOutput{}, folder));
  return text;
}

}  // namespace ringlet
