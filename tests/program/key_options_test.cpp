// Options that are keys of a scene: every one of them reaches its key and nothing else.
#include "program/cli/key_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "program/cli/contact_options.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::program::key_options_test {
namespace {

constexpr const char* kTables[] = {"groom",      "groom.cut", "motion", "start",
                                   "simulation", "contacts",  "output"};

// Spellings that scripts rely on.
constexpr std::pair<const char*, const char*> kSpellings[] = {
    {"--unit", "groom.unit"},
    {"--up", "groom.up"},
    {"--root-end", "groom.root_end"},
    {"--points-per-strand", "groom.points_per_strand"},
    {"--guides", "groom.guides"},
    {"--guides-file", "groom.guides_file"},
    {"--from", "start.from"},
    {"--from-frame", "start.frame"},
    {"--from-blend", "start.blend"},
    {"--guides-primvar", "groom.guides_primvar"},
    {"--guides-sample", "groom.guides_sample"},
    {"--bind", "groom.bind"},
    {"--bind-frame", "groom.bind_frame"},
    {"--style", "groom.style"},
    {"--strands", "groom.strands"},
    {"--locks", "groom.locks"},
    {"--particles", "groom.particles"},
    {"--columns", "groom.columns"},
    {"--rows", "groom.rows"},
    {"--spacing", "groom.spacing"},
    {"--scalp-radius", "groom.scalp_radius"},
    {"--scalp", "groom.scalp"},
    {"--radius", "groom.radius"},
    {"--turns", "groom.turns"},
    {"--length", "groom.length"},
    {"--phase", "groom.phase"},
    {"--hand", "groom.hand"},
    {"--vary-radius", "groom.vary_radius"},
    {"--vary-length", "groom.vary_length"},
    {"--vary-phase", "groom.vary_phase"},
    {"--other-hand", "groom.other_hand"},
    {"--seed", "groom.seed"},
    {"--hairline", "groom.cut.hairline"},
    {"--parting", "groom.cut.parting"},
    {"--fringe", "groom.cut.fringe"},
    {"--top", "groom.cut.top"},
    {"--sides", "groom.cut.sides"},
    {"--back", "groom.cut.back"},
    {"--layers", "groom.cut.layers"},
    {"--level", "groom.cut.level"},
    {"--straight-root", "groom.cut.straight_root"},
    {"--clump", "groom.cut.clump"},
    {"--amplitude", "motion.amplitude"},
    {"--frequency", "motion.frequency"},
    {"--joint", "motion.joint"},
    {"--animation", "motion.animation"},
    {"--motion-unit", "motion.unit"},
    {"--motion-up", "motion.up"},
    {"--skip-frames", "motion.skip_frames"},
    {"--pre-roll", "motion.pre_roll"},
    {"--fps", "simulation.fps"},
    {"--frames", "simulation.frames"},
    {"--steps-per-frame", "simulation.steps_per_frame"},
    {"--gravity", "simulation.gravity"},
    {"--preload", "simulation.preload"},
    {"--max-stretch", "simulation.max_stretch"},
    {"--roots", "simulation.roots"},
    {"--integrator", "simulation.integrator"},
    {"--iterations", "simulation.iterations"},
    {"--contact-radius", "contacts.radius"},
    {"--fill-gaps", "contacts.fill_gaps"},
    {"--contact-detail", "contacts.detail"},
    {"--max-neighbours", "contacts.max_neighbours"},
    {"--drop-share", "contacts.drop_share"},
    {"--contact-friction", "contacts.friction"},
    {"--contact-taper", "contacts.taper"},
    {"--volume-cell", "contacts.volume_cell"},
    {"--contact-iterations", "contacts.iterations"},
    {"--cache", "output.cache"},
    {"--width", "output.width"},
    {"--tip-width", "output.tip_width"},
    {"--usd-values", "output.values"},
    {"--head", "output.head"},
    {"--clips", "output.clip_frames"},
    {"--hairs", "output.hairs"},
    {"--frizz", "output.frizz"},
    {"--clump", "output.clump"},
    {"--blend", "output.blend"},
    {"--hair-scalp", "output.hair_scalp_file"},
    {"--usd-prims", "output.prims"}};

// Keys as a command line leaves them, or what CLI11 says of it.
struct Parsed {
  TypedKeys typed;
  std::string problem;
};
Parsed parse(std::string_view table, std::vector<std::string> words) {
  Parsed result;
  CLI::App app;
  if (table == "contacts")
    addContactOptions(app, result.typed, "off");
  else
    addKeyOptions(app, result.typed, table, "");
  addSetOption(app, result.typed);
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    result.problem = error.what();
  }
  return result;
}

// A scene in which every key of the table may stand.
std::string sceneFor(const SceneKey& key) {
  const auto has = [&](const char* kind) { return key.onlyWith.find(kind) != std::string::npos; };
  std::string text = "[groom]\n";
  text += key.table == "groom.cut" || has("head") ? "generate = \"head\"\n"
          : has("swatch")                         ? "generate = \"swatch\"\n"
                                                  : "file = \"a.obj\"\n";
  text += "[motion]\n";
  const bool isOfFile = key.table == "motion" && key.onlyWith == "file";
  text += isOfFile ? fmt::format("file = \"a.{}\"\n", key.key == "animation" ? "glb" : "bvh")
                   : "kind = \"shake\"\n";
  text += fmt::format("[simulation]\nintegrator = \"{}\"\n", has("point_jacobi") ? "point_jacobi" : "jacobi");
  text += fmt::format("[contacts]\ntaper = \"{}\"\n", has("time") ? "time" : "distance");
  return text;
}

// A value that is not the default, and one that is refused; the latter "" where anything goes.
std::pair<std::string, std::string> valuesOf(const SceneKey& key) {
  if (!key.choices.empty()) {
    const auto names = namesIn(key.choices);
    return {names.back() == key.standard ? names.front() : names.back(), "moon"};
  }
  if (key.type == "true or false") return {key.standard == "true" ? "off" : "on", "true"};
  if (!key.type.ends_with("number")) return {"a.txt", ""};
  const bool isWhole = key.type == "whole number";
  const double low = key.allowed.low, high = key.allowed.high;
  const double value = isWhole ? std::min(low + 2, high) : 0.5 * low + 0.5 * high + 0.001 * (high - low);
  return {fmt::format("{}", value), fmt::format("{}", high + std::max(1.0, 0.001 * high))};
}

// What the text of a scene says of a key.
std::string valueIn(const std::string& text, const SceneKey& key) {
  const std::size_t table = text.find("\n[" + key.table + "]\n"),
                    line = text.find("\n" + key.key + " = ", table);
  if (table == std::string::npos || line == std::string::npos) return "";
  const std::size_t from = line + key.key.size() + 4;
  return text.substr(from, text.find("  #", from) - from);
}

// What the text of a scene says more, line by line, keys without their values.
std::vector<std::string> difference(const std::string& text, const std::string& other) {
  const auto linesOf = [](const std::string& all) {
    std::vector<std::string> lines;
    std::string table;
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find('\n', at), all.size());
      const std::string line = all.substr(at, end - at);
      if (line.starts_with("[")) table = line.substr(1, line.find(']') - 1);
      if (const auto equals = line.find(" = "); equals != std::string::npos)
        lines.push_back(fmt::format("{}.{}", table, line.substr(0, line.find("  #"))));
      at = end + 1;
    }
    return lines;
  };
  const auto a = linesOf(text), b = linesOf(other);
  std::vector<std::string> keys;
  const auto add = [&](const std::vector<std::string>& from, const std::vector<std::string>& without) {
    for (const std::string& line : from)
      if (std::ranges::find(without, line) == without.end()) keys.push_back(line.substr(0, line.find(" = ")));
  };
  add(a, b);
  add(b, a);
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

TEST(KeyOptions, EachReachesItsKeyAndNoOther) {
  int count = 0;
  for (const SceneKey& key : sceneKeys()) {
    const std::string full = key.table + "." + key.key, option = optionNamed(full);
    if (std::ranges::find(kTables, key.table) == std::end(kTables) || option.empty()) continue;
    if (option == "--motion" || option == "--no-chebyshev") continue;
    SCOPED_TRACE(option + " for " + full);
    ++count;
    const auto [value, refused] = valuesOf(key);
    const Parsed found = parse(key.table, {option, value});
    ASSERT_EQ(found.problem, "");
    EXPECT_TRUE(found.typed.has(full));
    const std::string text = sceneFor(key);
    const auto before = parseScene(text, "scene.toml");
    ASSERT_TRUE(before) << before.error().message;
    const auto after = parseTyped(text, "scene.toml", found.typed);
    ASSERT_TRUE(after) << after.error().message;
    std::vector<std::string> expected{full};
    if (full == "contacts.max_neighbours" || full == "contacts.drop_share")
      expected.emplace_back("contacts.prune_pairs");
    EXPECT_EQ(difference(sceneText(*after), sceneText(*before)), expected);
    if (key.type.ends_with("number")) {
      EXPECT_EQ(std::strtod(valueIn(sceneText(*after), key).c_str(), nullptr),
                std::strtod(value.c_str(), nullptr));
    }
    if (!refused.empty()) {
      EXPECT_NE(parse(key.table, {option, refused}).problem, "");
    }
  }
  EXPECT_EQ(count, std::ssize(kSpellings));
  for (const auto& [option, key] : kSpellings) EXPECT_EQ(optionNamed(key), option);
}

TEST(KeyOptions, NothingTypedIsNothing) {
  for (const char* table : kTables) EXPECT_TRUE(parse(table, {}).typed.isEmpty()) << table;
}

// Numbers are taken as other options take them, whatever TOML says of their form; texts stay texts.
TEST(KeyOptions, ValuesAreReadAsOptionsAre) {
  const auto sceneOf = [](std::string_view table, const char* option, const char* value) {
    const Parsed found = parse(table, {fmt::format("{}={}", option, value)});
    EXPECT_EQ(found.problem, "") << value;
    const auto scene =
        parseTyped("[groom]\nfile = \"a.obj\"\n[motion]\nfile = \"a.bvh\"\n", "s", found.typed);
    EXPECT_TRUE(scene) << value;
    return scene ? *scene : SceneFile{};
  };
  for (const char* ten : {"10", "10.", "1e1", "+10", "10.0"})
    EXPECT_EQ(sceneOf("simulation", "--gravity", ten).simulation.gravity, 10) << ten;
  EXPECT_EQ(sceneOf("simulation", "--gravity", ".5").simulation.gravity, 0.5);
  EXPECT_EQ(sceneOf("simulation", "--gravity", "-1e-9").simulation.gravity, -1e-9);
  for (const char* joint : {"5", "true", "[1]", "a\"b", "x # y", "Kopf\xc3\xa4"})
    EXPECT_EQ(sceneOf("motion", "--joint", joint).motion.joint, joint);
}

TEST(KeyOptions, FramesStandInPlaceOfSeconds) {
  const auto scene = parseTyped("[groom]\nfile = \"a.obj\"\n[simulation]\nseconds = 2\n", "s",
                                parse("simulation", {"--frames", "7"}).typed);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->simulation.frames, 7);
  EXPECT_EQ(scene->simulation.seconds, std::nullopt);
}

TEST(KeyOptions, PathsAreThoseOfTheWorkingDirectoryAndInReach) {
  const Parsed found = parse("output", {"--hair-scalp", "../head.obj", "--hairs", "9"});
  const auto scene = parseScene("[groom]\ngenerate = \"head\"\n", "s", "folder", found.typed.changes(),
                                SceneReach::ownFolder);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->output.hairScalpFile, "../head.obj");
}

TEST(KeyOptions, SetTakesAnyKeyAndGoesOverOptions) {
  const Parsed found = parse("simulation", {"--set", "simulation.gravity=3", "--gravity", "4", "--set",
                                            "air.wind=[1, 2, 3]", "--set", "motion.kind=nod"});
  ASSERT_EQ(found.problem, "");
  const auto scene = parseTyped("[groom]\nfile = \"a.obj\"\n", "s", found.typed);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->simulation.gravity, 3);
  EXPECT_EQ(scene->air.wind, (Vec3d{1, 2, 3}));
  EXPECT_EQ(scene->motion.kind, "nod");
  for (const char* wrong : {"gravity", "=3", ""})
    EXPECT_NE(parse("simulation", {"--set", wrong}).problem.find("KEY=VALUE"), std::string::npos) << wrong;
}

// What the scene refuses is told by the name that was typed.
TEST(KeyOptions, ProblemsHaveTheNamesOfOptions) {
  struct Case {
    const char* table;
    std::vector<std::string> words;
    const char *option, *says;
  };
  for (const Case& one :
       {Case{"simulation", {"--iterations", "5"}, "--iterations", "found --iterations with the integrator"},
        Case{"motion", {"--joint", "Head"}, "--joint", "found --joint with a motion by shake"},
        Case{"simulation", {"--set", "simulation.gravty=1"}, "--set", "simulation.gravity"}}) {
    SCOPED_TRACE(one.option);
    const Parsed found = parse(one.table, one.words);
    ASSERT_EQ(found.problem, "");
    try {
      const auto scene =
          parseTyped("[groom]\nfile = \"a.obj\"\n[motion]\nkind = \"shake\"\n", "s", found.typed);
      ADD_FAILURE() << "was taken";
    } catch (const CLI::ValidationError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find(one.option), 0U) << message;
      EXPECT_NE(message.find(one.says), std::string::npos) << message;
    }
  }
}

TEST(KeyOptions, HairsLookAsTyped) {
  const HairLook none = hairLookOf({}),
                 look = hairLookOf(parse("output", {"--frizz", "1", "--hair-scalp", "../a.obj"}).typed);
  EXPECT_FALSE(none.frizz || none.clump || none.blend || !none.scalp.empty());
  EXPECT_EQ(look.frizz, 1);
  EXPECT_FALSE(look.clump || look.blend);
  EXPECT_EQ(look.scalp, "../a.obj");
  EXPECT_THROW(hairLookOf(parse("output", {"--hair-scalp", ""}).typed), CLI::ValidationError);
}

// An option that says how contacts are leaves them off or on, as the scene has them.
TEST(KeyOptions, ContactsStayOffWhereOnlyTheirNumbersAreTyped) {
  const TypedKeys typed = parse("contacts", {"--contact-radius", "0.002"}).typed;
  for (const bool isOn : {false, true}) {
    const std::string text = "[groom]\nfile = \"a.obj\"\n";
    const auto scene = parseTyped(text + (isOn ? "[contacts]\n" : ""), "s", typed);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->contacts.on, isOn);
    EXPECT_EQ(scene->contacts.radius, 0.002);
  }
}

}  // namespace
}  // namespace ringlet::program::key_options_test
