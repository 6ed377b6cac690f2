// Material files: what is read, what is refused and in which words, and that writing and reading give back
// the same bits.
#include "ringlet/rest/material_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <random>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/toml_file.h"
#include "tests/support/test_support.h"

namespace ringlet::material_file_test {
namespace {

std::string errorOf(const std::string& text) {
  const auto loaded = parseMaterial(text, "hair.toml");
  return loaded ? "" : loaded.error().message;
}

TEST(MaterialFile, AnEmptyFileIsTheDefault) {
  for (const char* text : {"", "# nothing\n", "[dials]\n[variation]\n[profile]\n"}) {
    const auto loaded = parseMaterial(text, "hair.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->material, Material{});
    EXPECT_EQ(loaded->dials, MaterialDials{});
    EXPECT_TRUE(loaded->warnings.empty());
  }
}

// Each dot of a key is a table, however its words look; those of numbers are none.
TEST(MaterialFile, KeysThatNestTooDeepAreRefused) {
  for (const std::string word : {"a", "1", "a1", "1e"}) {
    std::string key = word;
    for (int i = 0; i < 3000; ++i) key += "." + word;
    for (const std::string& text : {key + " = 1\n", "[" + key + "]\n"})
      EXPECT_NE(errorOf(text).find("found 3000 dots"), std::string::npos) << errorOf(text).substr(0, 200);
  }
  std::string points = "[0, 1]";
  for (int i = 1; i < 3000; ++i) points += ", [0.5, 1.25]";
  EXPECT_EQ(errorOf("[profile]\nbend_stiffness = [" + points + "]\n").find("dots"), std::string::npos);
}

TEST(MaterialFile, EverythingIsRead) {
  const auto loaded = parseMaterial(
      "preset = 'coil'  # the base, wherever it stands\n"
      "bend_stiffness = 8   # a whole number will do\n"
      "core_stiffness = 1.25e1\n"
      "bend_smoothing_length = 0.02\n"
      "core_smoothing_length = 'rest'\n"
      "[dials]\nhold = 1.5\nbounce = 0\nspring_back = 2\ncurl_keep = 0\n"
      "[variation]\nbend_stiffness = 0.2\ncore_stiffness = 0.1\nbend_damping_ratio = 0.3\nseed = 4294967295\n"
      "[profile]\nbend_stiffness = [[0, 1], [0.5, 0.8],\n [1, 0.25]]\nline_density = []\n",
      "hair.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  Material expected = materialPreset("coil").value();
  expected.bendStiffness = 8;
  expected.coreStiffness = 12.5;
  expected.bendSmoothingLength = 0.02;
  expected.variation = {
      .bendStiffness = 0.2, .coreStiffness = 0.1, .bendDampingRatio = 0.3, .seed = 4294967295u};
  expected.bendStiffnessProfile.points = {{0, 1}, {0.5, 0.8}, {1, 0.25}};
  EXPECT_EQ(loaded->material, expected);
  EXPECT_EQ(loaded->dials, (MaterialDials{.hold = 1.5, .bounce = 0, .springBack = 2, .curlKeep = 0}));
}

TEST(MaterialFile, UnusualNumbersWarn) {
  const auto loaded = parseMaterial("bend_damping_ratio = 0.02", "hair.toml");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->material.bendDampingRatio, 0.02);
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_EQ(loaded->warnings[0],
            "hair.toml: bend_damping_ratio is 0.02; usual is from 0.1 to 2. Damping of bending: how fast a "
            "swing settles. Below 0.1 bending may gain energy and never come to rest.");
}

// One line a kind of mistake: the text, and the message after "hair.toml: ".
const struct {
  const char *text, *message;
} kMistakes[] = {
    // keys
    {"\nbend_stifness = 5", "line 2: found the unknown key 'bend_stifness'; did you mean bend_stiffness?"},
    {"bendStiffness = 5", "line 1: found the unknown key 'bendStiffness'; did you mean bend_stiffness?"},
    {"hold = 2", "line 1: found the unknown key 'hold'; did you mean dials.hold?"},
    {"[dials]\n\nbend_stiffness = 2",
     "line 3: found the unknown key 'bend_stiffness' in [dials]; did you mean bend_stiffness, which stands "
     "above all tables? [dials] takes hold, bounce, spring_back, curl_keep, weight, root_hold, tip_hold, "
     "wet"},
    {"[variation]\nsead = 2",
     "line 2: found the unknown key 'sead' in [variation]; did you mean variation.seed?"},
    {"[profile]\nxyz = 2",
     "line 2: found the unknown key 'xyz' in [profile]; expected bend_stiffness, bend_damping_ratio, "
     "stretch_stiffness, stretch_damping_time, core_stiffness, core_damping_ratio, line_density"},
    {"[dial]\nhold = 2", "line 1: found the unknown key 'dial'; did you mean dials?"},
    // types
    {"bend_stiffness = '5'",
     "line 1: found the text '5' for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = true",
     "line 1: found true for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = [5, 6]",
     "line 1: found a list of 2 for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"[bend_stiffness]\nx = 5",
     "line 1: found a table for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = 2020-01-01",
     "line 1: found a date or time for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"core_smoothing_length = 'auto'",
     "line 1: found the text 'auto' for core_smoothing_length; expected a number from 0 to 1000 m, or "
     "\"rest\""},
    {"bend_stiffness = 'rest'",
     "line 1: found the text 'rest' for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"[variation]\nseed = 1.5",
     "line 2: found the number 1.5 for variation.seed; expected a whole number from 0 to 4294967295"},
    {"dials = 3", "line 1: found the number 3 for dials; expected a table, as in [dials]"},
    {"[[dials]]\nhold = 1", "line 1: found a list of 1 for dials; expected a table, as in [dials]"},
    // ranges
    {"bend_stiffness = -1",
     "line 1: found the number -1 for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = nan",
     "line 1: found the number nan for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = inf",
     "line 1: found the number inf for bend_stiffness; expected a number from 0.001 to 1000000 w"},
    {"bend_stiffness = 9223372036854775807",
     "line 1: found the number 9223372036854775807 for bend_stiffness; expected a number from 0.001 to "
     "1000000 w"},
    {"core_relaxed_share = 1.5",
     "line 1: found the number 1.5 for core_relaxed_share; expected a number from 0 to 1"},
    {"[dials]\nhold = 0", "line 2: found the number 0 for dials.hold; expected a number from 0.001 to 1000"},
    {"[variation]\nbend_stiffness = 1.0",
     "line 2: found the number 1 for variation.bend_stiffness; expected a number from 0 to 0.9"},
    {"[variation]\nseed = -1",
     "line 2: found the number -1 for variation.seed; expected a whole number from 0 to 4294967295"},
    {"\n\ncore_elongation_low = 1.3",
     "line 3: core_elongation_high is 1.1; it must be above core_elongation_low, which is 1.3, by 1e-06 or "
     "more"},
    // presets
    {"preset = 'ringlets'",
     "line 1: found the text 'ringlets' for preset; expected one of straight, wavy, loose_curl, ringlet, "
     "coil; did you mean ringlet?"},
    {"preset = 7",
     "line 1: found the number 7 for preset; expected one of straight, wavy, loose_curl, ringlet, coil"},
    // profiles
    {"[profile]\nbend_stiffness = 2",
     "line 2: found the number 2 for profile.bend_stiffness; expected a list of points [share of the arc "
     "length, factor]"},
    {"[profile]\nbend_stiffness = [0, 1]",
     "line 2: found the number 0 for point 1 of profile.bend_stiffness; expected a list of points [share "
     "of the arc length, factor]"},
    {"[profile]\nbend_stiffness = [[0, 1],\n[1, 'x']]",
     "line 3: found a list of 2 for point 2 of profile.bend_stiffness; expected a list of points [share of "
     "the arc length, factor]"},
    {"[profile]\nbend_stiffness = [[0, 1],\n[0, 2]]",
     "line 3: profile.bend_stiffness: point 2 is [0, 2]; points must go from root to tip"},
    {"[profile]\nline_density = [[0, 5000]]",
     "line 2: profile.line_density: point 1 is [0, 5000]; its factor must be from 0.001 to 1000"},
    // several: the topmost
    {"line_density = 'x'\nbend_stiffness = 'y'\nabc = 1",
     "line 1: found the text 'x' for line_density; expected a number from 1e-12 to 1000000 kg/m"},
    {"abcdefgh.x = 1\nbend_stiffness = 'y'",
     "line 1: found the unknown key 'abcdefgh'; expected preset, dials, variation, profile, line_density, "
     "stretch_stiffness, stretch_damping_time, bend_stiffness, bend_damping_ratio, core_stiffness, "
     "core_damping_ratio, core_relaxed_share, core_elongation_low, core_elongation_high, gravity_factor, "
     "inertia_factor, "
     "bend_smoothing_length, core_smoothing_length"},
};

TEST(MaterialFile, MistakesAreNamedWithLineAndRemedy) {
  for (const auto& c : kMistakes) {
    const std::string error = errorOf(c.text);
    EXPECT_EQ(error, std::string("hair.toml: ") + c.message) << c.text;
  }
}

// Where toml++ takes one for impossible, this does not compile.
constexpr bool isTold(char32_t letter) {
  return toml::impl::is_non_ascii_horizontal_whitespace(letter) == (letter == U'\xa0' || letter == U'\ufeff');
}
static_assert(isTold(U'\u01a0') && isTold(U'\u3042') && isTold(U'\ufeef') && isTold(U'\ufeff'));

TEST(MaterialFile, WhatIsNoTomlIsNamedWithItsLine) {
  for (const char* text :
       {"\n\nbend_stiffness = ", "\n\nbend_stiffness 5", "\n\n= 5", "\n\n[dials", "\n\n[", "\n\n[[[",
        "\n\n[,]", "\n\nbend_stiffness = 5 6", "\n\npreset = 'ringlet", "\n\nhold = 1\nhold = 2",
        "\n\n\x01 = 1", "\n\nx = '\xff'", "\n\nx = 0x", "\n\nx = \"\\q\"", "\n\n[dials]\n[dials]",
        "\n\n\xc6\xa0", "\n\n\xef\xbb\xaf", "\n\nx = 0\"\xef\xb9\xbf"}) {
    const std::string error = errorOf(text);
    EXPECT_EQ(error.rfind("hair.toml: line ", 0), 0u) << text << " -> " << error;
    EXPECT_GE(std::stoi(error.substr(16)), 3) << text << " -> " << error;
    EXPECT_NE(error.find("found no TOML: "), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_NE(errorOf(std::string("a = 1\0", 6)), "");
}

TEST(MaterialFile, NestingWithoutEndIsRefused) {
  for (const char* piece : {"a.", "[", "a = {", "[a.", "x = [", "[[a]]\n", "1.1 . ", "[{a.b.c.d = \n"}) {
    std::string text;
    while (text.size() < 500000) text += piece;
    EXPECT_NE(errorOf(text + "a = 1\n"), "") << piece;
    for (std::size_t size : {8000u, 4000u, 12000u}) {
      EXPECT_NE(errorOf(text.substr(0, size) + "a = 1\n"), "") << piece;
      EXPECT_NE(errorOf("[" + text.substr(0, size) + "a]\n" + text.substr(0, size) + "a = 1\n"), "") << piece;
    }
  }
  EXPECT_NE(errorOf(std::string(2 << 20, '#')).find("2097152 bytes"), std::string::npos);
}

// Pieces of a valid file changed at random: read or refused, never more.
TEST(MaterialFile, SpoiltFilesAreReadOrRefused) {
  const std::string valid =
      "preset = \"ringlet\"\nbend_stiffness = 8.5\ncore_smoothing_length = \"rest\"\n[dials]\nhold = 1.5\n"
      "[variation]\nseed = 3\n[profile]\nbend_stiffness = [[0, 1], [1, 0.5]]\n";
  const std::string alphabet = "[]{}=.,\"'#\n\t 0123456789e+-_axX:\\\xff";
  std::mt19937 random(20240601);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = valid;
    for (unsigned change = 1 + random() % 4; change > 0 && !text.empty(); --change) {
      const std::size_t at = random() % text.size(), count = random() % 8;
      switch (random() % 4) {
        case 0:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.erase(at, count);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), count));
          break;
        case 3:
          text.resize(random() % 8 == 0 ? at + 1 : text.size());
          break;
      }
    }
    const auto loaded = parseMaterial(text, "hair.toml");
    if (!loaded) {
      ASSERT_EQ(loaded.error().message.rfind("hair.toml: ", 0), 0u) << loaded.error().message;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(checkMaterial(loaded->material)) << text;
    ASSERT_TRUE(checkDials(loaded->dials)) << text;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 19900);
}

// Any number of an allowed range, by its bits rather than its size, so that every exponent comes up.
double anyIn(const NumberRange& range, std::mt19937_64& random) {
  const auto low = std::bit_cast<std::uint64_t>(range.low), high = std::bit_cast<std::uint64_t>(range.high);
  return std::bit_cast<double>(low + random() % (high - low + 1));
}

template <class Owner>
void randomise(std::span<const Parameter<Owner>> parameters, Owner& owner, std::mt19937_64& random) {
  for (const Parameter<Owner>& parameter : parameters) {
    if (parameter.canBeUnset() && random() % 4 == 0) continue;
    parameter.set(owner, anyIn(parameter.allowed, random));
  }
}

TEST(MaterialFile, WhatIsWrittenIsReadBackBitByBit) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    Material material;
    MaterialDials dials;
    randomise(materialParameters(), material, random);
    randomise(variationParameters(), material.variation, random);
    randomise(dialParameters(), dials, random);
    material.coreElongationLow = anyIn({0, 1}, random);
    material.coreElongationHigh = anyIn({1.1, 1e3}, random);
    for (const ProfileParameter& parameter : profileParameters()) {
      for (double s = anyIn({0, 0.1}, random); s < 1; s += 0.01 + anyIn({0, 0.5}, random))
        (material.*parameter.member).points.push_back({s, anyIn(parameter.allowed, random)});
    }
    const std::string text = materialText(material, dials);
    const auto loaded = parseMaterial(text, "hair.toml");
    ASSERT_TRUE(loaded) << loaded.error().message << "\n" << text;
    ASSERT_EQ(loaded->material, material) << text;
    ASSERT_EQ(loaded->dials, dials) << text;
    ASSERT_EQ(materialText(loaded->material, loaded->dials), text);
  }
}

TEST(MaterialFile, WrittenFilesExplainEveryNumber) {
  const auto path = test::scratchFolder("material_file") / "coil.toml";
  const Material coil = materialPreset("coil").value();
  ASSERT_TRUE(writeMaterial(path, coil));
  const std::string text = test::readText(path);
  auto expectLine = [&](const std::string& line) {
    EXPECT_NE(text.find("\n" + line), std::string::npos) << line << " is missing in:\n" << text;
  };
  for (const auto& parameter : materialParameters()) {
    expectLine(std::string("# ") + parameter.effect + "\n# from ");
    expectLine(std::string(parameter.key) + " = ");
  }
  for (const auto& parameter : dialParameters()) expectLine(std::string("# ") + parameter.effect);
  for (const auto& parameter : variationParameters()) expectLine(std::string("# ") + parameter.effect);
  for (const auto& parameter : profileParameters()) expectLine(std::string("# ") + parameter.effect);
  expectLine("bend_stiffness = 10.0\n");
  expectLine("core_smoothing_length = \"rest\"\n");
  const auto loaded = readMaterial(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->material, coil);
}

TEST(MaterialFile, WhatCouldNotBeReadIsNotWritten) {
  const auto folder = test::scratchFolder("material_unwritable");
  Material material;
  material.bendStiffness = -1;
  const Status status = writeMaterial(folder / "x.toml", material);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("cannot write it: bend_stiffness is -1"), std::string::npos);
  EXPECT_FALSE(writeMaterial(folder / "x.toml", {}, {.hold = 0}));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  EXPECT_FALSE(writeMaterial(folder / "none" / "x.toml", {}));
}

TEST(LoadMaterial, TakesPresetsAndFiles) {
  const auto folder = test::scratchFolder("load_material");
  for (const std::string& name : presetNames()) {
    const auto loaded = loadMaterial(name);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->material, materialPreset(name));
    EXPECT_EQ(loaded->dials, MaterialDials{});
  }
  std::ofstream(folder / "Hair.TOML") << "bend_stiffness = 7\n";
  const auto loaded = loadMaterial((folder / "Hair.TOML").string());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->material.bendStiffness, 7);

  const auto unknown = loadMaterial("ringlte");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().message,
            "there is no material 'ringlte'; expected a file that ends in .toml, or one of straight, wavy, "
            "loose_curl, ringlet, coil; did you mean ringlet?");
  const auto none = loadMaterial((folder / "none.toml").string());
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("none.toml"), std::string::npos);
  EXPECT_FALSE(loadMaterial(folder.string()));
  EXPECT_FALSE(loadMaterial(""));
}

}  // namespace
}  // namespace ringlet::material_file_test
