// Grooms that are read and wrong all the same: `info` counts and mends what is wrong with them, scenes that
// simulate them warn, and what a file cannot hold is said when it is written. Grooms that are right are not
// warned of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/bodies/body_samples.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/style_samples.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::groom_faults_test {
namespace {

using namespace test;
using nlohmann::json;

// Strands of a head of 9 cm at the origin, Y up, in centimetres: they lie on it, further out with every
// particle, and hang from where it is widest.
Groom hairOfAHead(std::size_t strands = 60) {
  Groom groom;
  for (std::size_t s = 0; s < strands; ++s) {
    const double up = 1 - (static_cast<double>(s) + 0.5) / static_cast<double>(strands);
    const double turn = static_cast<double>(s) * std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3f> strand;
    for (int i = 0; i < 12; ++i) {
      const double along = 9 * std::acos(up) + 1.8 * i, widest = 9 * std::numbers::pi / 2;
      const double angle = std::min(along, widest) / 9, radius = 9 + 0.25 * i;
      strand.push_back(Vec3f(Vec3d{radius * std::sin(angle) * std::cos(turn),
                                   radius * std::cos(angle) - std::max(along - widest, 0.0),
                                   radius * std::sin(angle) * std::sin(turn)}));
    }
    groom.addStrand(strand);
  }
  return groom;
}

Groom changed(const Groom& groom, const std::function<void(std::size_t, std::vector<Vec3f>&)>& change) {
  Groom other;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    std::vector<Vec3f> strand(groom.strand(s).begin(), groom.strand(s).end());
    change(s, strand);
    other.addStrand(strand);
  }
  return other;
}
Groom reversed(std::size_t step = 1) {
  return changed(hairOfAHead(), [&](std::size_t s, auto& strand) {
    if (s % step == 0) std::ranges::reverse(strand);
  });
}
Groom moved(const Groom& groom, Vec3f by) {
  return changed(groom, [&](std::size_t, auto& strand) {
    for (Vec3f& p : strand) p = p + by;
  });
}
Groom zUp(const Groom& groom) {
  return changed(groom, [](std::size_t, auto& strand) {
    for (Vec3f& p : strand) p = {p.x, -p.z, p.y};
  });
}
Groom withPlace(Vec3f place, std::size_t at, std::size_t first = 0, std::size_t step = 1) {
  return changed(hairOfAHead(), [&](std::size_t s, auto& strand) {
    if (s >= first && (s - first) % step == 0)
      strand.insert(strand.begin() + static_cast<std::ptrdiff_t>(at), place);
  });
}

class GroomFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder(std::string("groom_faults_") +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  json info(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "info");
    arguments.push_back("--json");
    const ProgramResult result = runProgram(folder_, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }
  void write(const std::string& name, const Groom& groom) {
    ASSERT_TRUE(writeGroom(folder_ / name, groom)) << name;
  }
  void writeText(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string bytesOf(const std::string& name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // The scene of a groom's file.
  Result<LoadedScene> scene(const std::string& file, const std::string& groomKeys = "",
                            const std::string& rest = "") {
    const auto parsed =
        parseScene(fmt::format("[groom]\nfile = \"{}\"\n{}\n{}", file, groomKeys, rest), "scene", folder_);
    EXPECT_TRUE(parsed) << parsed.error().message;
    if (!parsed) return parsed.error();
    auto loaded = loadScene(*parsed);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded;
  }
  std::string warningsOf(const std::string& file, const std::string& groomKeys = "",
                         const std::string& rest = "") {
    const auto loaded = scene(file, groomKeys, rest);
    std::string all;
    if (loaded)
      for (const std::string& warning : loaded->warnings) all += warning + "\n";
    return all;
  }

  std::filesystem::path folder_;
};

constexpr const char* kHeadBody = "[[body]]\nname = \"skin\"\nshape = \"mesh\"\ngenerate = \"head\"\n";
constexpr const char* kBallBody = "[[body]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.09\n";

// --- Roots at tips.

TEST_F(GroomFaults, StrandsFromTipToRootAreCountedAndTurnedRound) {
  write("good.obj", hairOfAHead());
  EXPECT_EQ(info({"good.obj"})["faults"]["reversed_strands"]["count"], 0);
  const struct {
    std::size_t step;
    int count;
    const char* end;
  } kCases[] = {{1, 60, "last"}, {1, 60, "head"}, {3, 20, "head"}, {7, 9, "head"}};
  for (const auto& one : kCases) {
    write("bad.obj", reversed(one.step));
    const json found = info({"bad.obj"})["faults"]["reversed_strands"];
    EXPECT_EQ(found["count"], one.count);
    EXPECT_EQ(found["first_strand"], 0);
    const json fixed = info({"bad.obj", "--root-end", one.end, "--fix", "mended.hair"});
    EXPECT_EQ(fixed["faults"]["reversed_strands"]["count"], 0)
        << "what is said is of the strands as they are read";
    EXPECT_TRUE(hasSameBits(readGroom(folder_ / "mended.hair")->groom, hairOfAHead()))
        << one.count << one.end;
  }
}

TEST_F(GroomFaults, AScenesBodyOrHeadSaysThatStrandsRunFromTipToRoot) {
  write("good.obj", hairOfAHead());
  write("all.obj", reversed());
  write("some.obj", reversed(3));
  for (const char* body : {kHeadBody, kBallBody, ""}) {
    EXPECT_EQ(warningsOf("good.obj", "", body), "") << body;
    const std::string all = warningsOf("all.obj", "", body), some = warningsOf("some.obj", "", body);
    EXPECT_TRUE(contains(all, "60 of 60 strands") && contains(all, "--root-end last")) << all;
    EXPECT_TRUE(contains(some, "20 of 60 strands") && contains(some, "--root-end head")) << some;
    EXPECT_EQ(all.find("tip to root"), all.rfind("tip to root")) << "said once: " << all;
    if (*body) {
      EXPECT_TRUE(contains(all, contains(body, "skin") ? "the body skin" : "the body ball")) << all;
    }
    EXPECT_FALSE(contains(warningsOf("all.obj", "root_end = \"last\"", body), "tip to root"));
    EXPECT_FALSE(contains(warningsOf("some.obj", "root_end = \"head\"", body), "tip to root"));
  }
  // Turned round, it is the same groom.
  const auto turned = scene("all.obj", "root_end = \"last\"");
  ASSERT_TRUE(turned);
  EXPECT_TRUE(hasSameBits(turned->groom, hairOfAHead()));
}

// Of few strands too, and what is advised works.
TEST_F(GroomFaults, EightStrandsAreCountedAndTurnedByABody) {
  const Groom good = hairOfAHead(8);
  for (const std::size_t step : {1u, 2u, 3u, 8u}) {
    write("bad.obj", changed(good, [&](std::size_t s, auto& strand) {
            if (s % step == 0) std::ranges::reverse(strand);
          }));
    const std::string end = step == 1 ? "last" : "head";
    for (const char* body : {kHeadBody, kBallBody}) {
      const std::string warned = warningsOf("bad.obj", "", body);
      const std::string count = fmt::format("{} of 8 strands", (8 + step - 1) / step);
      EXPECT_TRUE(contains(warned, count.c_str()) && contains(warned, ("--root-end " + end + ")").c_str()))
          << step << ": " << warned;
    }
    const auto turned =
        readGroom(folder_ / "bad.obj", {.rootEnd = step == 1 ? RootEnd::last : RootEnd::head});
    ASSERT_TRUE(turned);
    EXPECT_TRUE(hasSameBits(turned->groom, good)) << step;
  }
}

TEST_F(GroomFaults, HairThatEndsOnShouldersRunsTheRightWay) {
  // Its tips lie on a body, and its roots, 20 cm higher, on a head that is none.
  const Groom longHair = changed(hairOfAHead(), [](std::size_t, auto& strand) {
    const Vec3f root = strand.front();
    for (std::size_t i = 0; i < strand.size(); ++i)
      strand[i] = {root.x, root.y - (root.y + 20) * static_cast<float>(i) / 11, root.z};
  });
  write("long.obj", longHair);
  const std::string shoulders =
      "[[body]]\nshape = \"capsule\"\nradius = 0.12\nlength = 0.3\nposition = [0, -0.32, 0]\nrotate_degrees "
      "= [0, 0, "
      "90]\n";
  EXPECT_FALSE(contains(warningsOf("long.obj", "", shoulders), "tip to root"))
      << warningsOf("long.obj", "", shoulders);
}

// --- Places where no hair is.

TEST_F(GroomFaults, StraysAreCountedWarnedOfAndMendedWhereverTheyAre) {
  write("good.obj", hairOfAHead());
  for (const Vec3f place :
       {Vec3f{0, 0, 0}, Vec3f{80, -30, 5}, Vec3f{99999, 99999, 99999}, Vec3f{0, 1e10f, 0}}) {
    for (const std::size_t at : {0u, 5u, 12u}) {
      write("bad.obj", withPlace(place, at, 1, 2));
      const json found = info({"bad.obj"})["faults"];
      EXPECT_EQ(found["stray_particles"]["count"], 30) << at;
      EXPECT_EQ(found["stray_particles"]["first_strand"], 1);
      if (length(place) > 20) {
        EXPECT_EQ(found["long_edges"]["first_strand"], 1) << at;
      }
      // Where it stands in the scene does not matter: the file's origin is meant.
      for (const char* keys : {"", "offset = [0.3, 0, 0]"}) {
        const std::string warned = warningsOf("bad.obj", keys);
        EXPECT_TRUE(contains(warned, "30 particles stand far off") && contains(warned, "first in strand 1") &&
                    contains(warned, "info FILE --fix"))
            << warned;
      }
      const json fixed = info({"bad.obj", "--fix", "mended.obj"});
      EXPECT_EQ(fixed["fixed"]["strays"], 30);
      EXPECT_TRUE(hasSameBits(readGroom(folder_ / "mended.obj")->groom, hairOfAHead())) << at;
    }
  }
  write("alone.obj", withPlace({80, -30, 5}, 12, 7, 100));
  EXPECT_EQ(info({"alone.obj"})["faults"]["long_edges"]["count"], 1);
  EXPECT_TRUE(contains(warningsOf("alone.obj"), "1 edge is more than 6 times as long"))
      << warningsOf("alone.obj");
  EXPECT_EQ(warningsOf("good.obj"), "");
}

TEST_F(GroomFaults, RepeatedParticlesAreNamedByARunAndMended) {
  const Groom bad = changed(hairOfAHead(8), [](std::size_t s, auto& strand) {
    if (s == 3) strand.insert(strand.begin() + 4, 2, strand[4]);
  });
  write("bad.obj", moved(bad, {0, 160, 0}));
  write("good.obj", moved(hairOfAHead(8), {0, 160, 0}));
  const auto run = [&](const char* file) {
    return runProgram(folder_, {"simulate", file, "--backend", "reference", "--frames", "1", "--no-sheet",
                                "--no-usd", "--overwrite", "-o", "out"});
  };
  const ProgramResult warned = run("bad.obj");
  EXPECT_EQ(warned.exitCode, 0) << warned.err;
  for (const char* part : {"2 repeated particles", "the first in strand 3", "info FILE --fix OUT"})
    EXPECT_TRUE(contains(warned.err, part)) << part << " in\n" << warned.err;
  EXPECT_FALSE(contains(warned.err, "finely cut")) << warned.err;
  info({"bad.obj", "--fix", "mended.obj"});
  const ProgramResult mended = run("mended.obj"), good = run("good.obj");
  EXPECT_FALSE(contains(mended.err, "repeated")) << mended.err;
  EXPECT_EQ(mended.err, good.err);
}

// Every fault into every format: what is mended has none of those that can be mended, and is mended at once.
TEST_F(GroomFaults, WhatFixWritesIsReadAgainAndIsFixed) {
  const auto twice = [](Groom groom) {
    groom.addStrand(std::vector<Vec3f>(groom.strand(2).begin(), groom.strand(2).end()));
    return groom;
  };
  Groom points = hairOfAHead();
  points.addStrand(std::vector<Vec3f>{{5, 0, 0}, {5, 0, 0}, {5, 0, 0}});
  const std::pair<const char*, Groom> kFaults[] = {{"repeated", changed(hairOfAHead(),
                                                                        [](std::size_t, auto& strand) {
                                                                          strand.insert(strand.begin() + 4, 2,
                                                                                        strand[4]);
                                                                          strand.push_back(strand.back());
                                                                        })},
                                                   {"strays at the end", withPlace({0, 0, 0}, 12)},
                                                   {"strays at the start", withPlace({0, 0, 0}, 0)},
                                                   {"strays between", withPlace({80, -30, 5}, 5)},
                                                   {"twice", twice(hairOfAHead())},
                                                   {"twice with strays", twice(withPlace({0, 0, 0}, 12))},
                                                   {"points", points},
                                                   {"turned", reversed(3)}};
  for (const auto& [what, groom] : kFaults) {
    for (const char* ending : {".obj", ".hair", ".ply"}) {
      write("bad.obj", groom);
      info({"bad.obj", "--root-end", "head", "--fix", std::string("once") + ending});
      const json found =
          info({std::string("once") + ending, "--root-end", "head", "--fix", std::string("again") + ending});
      for (const char* key : {"repeated_particles", "stray_particles", "long_edges", "reversed_strands",
                              "point_strands", "duplicates"})
        EXPECT_EQ(found["faults"][key]["count"], 0) << what << ending << " " << key;
      EXPECT_EQ(bytesOf(std::string("again") + ending), bytesOf(std::string("once") + ending))
          << what << ending;
      EXPECT_TRUE(hasSameBits(readGroom(folder_ / (std::string("once") + ending))->groom, hairOfAHead()))
          << what << ending;
      EXPECT_TRUE(found["warnings"].empty()) << found["warnings"];
    }
  }
}

// --- No false alarms.

TEST_F(GroomFaults, GeneratedHeadsOfEveryStyleAreRight) {
  for (const std::string& style : styleNames()) {
    const auto parameters = headOfStyle(style);
    ASSERT_TRUE(parameters) << style;
    const auto groom = makeHead(*parameters);
    ASSERT_TRUE(groom);
    write("head.hair", *groom);
    const json found = info({"head.hair"});
    for (const auto& [key, fault] : found["faults"].items())
      EXPECT_EQ(fault["count"], 0) << style << " " << key;
    EXPECT_EQ(warningsOf("head.hair", "", kHeadBody), "") << style;
  }
}

TEST_F(GroomFaults, RealGroomsAreRight) {
  for (const char* name : {"hair/straight.hair", "curlycue/frame_000.obj", "curlycue/frame_070_settled.obj",
                           "sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", "usd/hair-blender-3.0.1.usda",
                           "usd/hair.usda", "usd/curves.usda"}) {
    RINGLET_NEEDS_DATA(path, name);
    const json faults = info({path.string()})["faults"];
    for (const char* key : {"stray_particles", "reversed_strands", "long_edges"})
      EXPECT_EQ(faults[key]["count"], 0) << name << " " << key;
  }
}

// --- Units and axes.

TEST_F(GroomFaults, WhatAFileCannotHoldIsSaidWhenItIsWritten) {
  const auto usd = [](const char* metadata) {
    return std::string("#usda 1.0\n(\n") + metadata +
           "\n)\ndef BasisCurves \"Hair\" { uniform token type = \"linear\" int[] curveVertexCounts = [3, 3] "
           "point3f[] "
           "points = [(0, 0, 0), (0, -6, 0), (0, -12, 0), (1, 0, 0), (1, -6, 0), (1, -12, 0)] }\n";
  };
  writeText("inches.usda", usd("metersPerUnit = 0.0254"));
  writeText("metres.usda", usd("metersPerUnit = 1"));
  writeText("usual.usda", usd("metersPerUnit = 0.01"));
  writeText("z.usda", usd("upAxis = \"Z\""));
  write("groom.obj", hairOfAHead());
  const struct {
    std::vector<std::string> input;
    const char* unit;
    bool isZ;
  } kCases[] = {{{"inches.usda"}, "--unit 0.0254 ", false},
                {{"metres.usda"}, "--unit 1 ", false},
                {{"usual.usda"}, "", false},
                {{"z.usda"}, "", false},  // turned to Y up
                {{"z.usda", "--up", "Z"}, "", true},
                {{"groom.obj", "--unit", "0.001"}, "--unit 0.001 ", false},
                {{"inches.usda", "--unit", "0.01"}, "", false},
                {{"inches.usda", "--up", "Z"}, "--unit 0.0254 ", true}};
  for (const auto& one : kCases) {
    for (const char* ending : {".hair", ".obj", ".ply"}) {
      for (const bool fixes : {false, true}) {
        std::vector<std::string> arguments{fixes ? "info" : "convert"};
        arguments.insert(arguments.end(), one.input.begin(), one.input.end());
        if (fixes) arguments.push_back("--fix");
        arguments.push_back(std::string("out") + ending);
        const ProgramResult result = runProgram(folder_, arguments);
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(contains(result.err, "does not hold its unit"), *one.unit != 0) << result.err;
        if (*one.unit) {
          EXPECT_TRUE(contains(result.err, one.unit)) << result.err;
        }
        EXPECT_EQ(contains(result.err, "does not hold its up axis") && contains(result.err, "--up Z"),
                  one.isZ)
            << result.err;
        arguments.push_back("--json");
        const json told = json::parse(runProgram(folder_, arguments).out, nullptr, false);
        EXPECT_EQ(contains(told["warnings"].dump(), "does not hold its unit"), *one.unit != 0);
      }
    }
  }
}

// Nothing is said of a file that is not there in the end.
TEST_F(GroomFaults, WhatIsNotWrittenLosesNothing) {
  write("groom.obj", hairOfAHead(4));
  ASSERT_EQ(
      runProgram(folder_, {"simulate", "groom.obj", "--unit", "0.0254", "--up", "Z", "--backend", "reference",
                           "--frames", "1", "--cache", "float32", "--no-sheet", "-o", "out"})
          .exitCode,
      0);
  for (const char* taken : {"taken.obj", "taken.ply", "taken.hair"})
    std::filesystem::create_directories(folder_ / taken / "by a folder");
  std::ofstream(folder_ / "file") << "no folder";
  for (const std::string name : {"taken.obj", "taken.ply", "taken.hair", "file/out.obj", "out.tfx"}) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"convert", "groom.obj", "--unit", "0.0254", "--up", "Z", name},
          {"info", "groom.obj", "--unit", "0.0254", "--up", "Z", "--fix", name},
          {"convert", "out/hair.rgc", "--frame", "1", name}}) {
      if (command[1] == "out/hair.rgc" && name == "taken.hair") continue;  // a folder for frames
      const ProgramResult refused = runProgram(folder_, command);
      EXPECT_NE(refused.exitCode, 0) << command[0] << " " << name;
      EXPECT_FALSE(contains(refused.err, "does not hold")) << command[0] << " " << refused.err;
    }
  }
}

TEST_F(GroomFaults, FramesOfAnAnimationLoseItsUnitToo) {
  write("groom.obj", hairOfAHead(4));
  ASSERT_EQ(
      runProgram(folder_, {"simulate", "groom.obj", "--unit", "0.0254", "--up", "Z", "--backend", "reference",
                           "--frames", "1", "--cache", "float32", "--no-sheet", "-o", "out"})
          .exitCode,
      0);
  for (const std::vector<std::string>& to :
       {std::vector<std::string>{"a.obj", "--frame", "1"}, {"b.ply", "--frame", "1"}, {"frames"}}) {
    std::vector<std::string> arguments{"convert", "out/hair.rgc"};
    arguments.insert(arguments.end(), to.begin(), to.end());
    const ProgramResult result = runProgram(folder_, arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(contains(result.err, "--unit 0.0254 ") && contains(result.err, "--up Z")) << result.err;
  }
  const ProgramResult whole = runProgram(folder_, {"convert", "out/hair.rgc", "a.usda"});
  EXPECT_EQ(whole.exitCode, 0) << whole.err;
  EXPECT_FALSE(contains(whole.err, "does not hold")) << whole.err;
}

TEST_F(GroomFaults, AGroomOnItsSideIsWarnedOf) {
  write("y.obj", hairOfAHead());
  write("z.obj", zUp(hairOfAHead()));
  EXPECT_EQ(warningsOf("y.obj"), "");
  EXPECT_EQ(warningsOf("z.obj", "up = \"Z\""), "");
  for (const std::string& warned : {warningsOf("z.obj"), warningsOf("z.obj", "", kBallBody)})
    EXPECT_TRUE(contains(warned, "hang along -Z, and Y is up") && contains(warned, "--up Z")) << warned;
  EXPECT_TRUE(contains(warningsOf("y.obj", "up = \"Z\""), "--up Y"));
  // Turned by hand, or combed back on a head that stands: nothing.
  EXPECT_FALSE(contains(warningsOf("z.obj", "rotate_degrees = [-90, 0, 0]"), "is up"));
  write("back.obj", changed(hairOfAHead(), [](std::size_t, auto& strand) {
          const Vec3f root = strand.front();
          for (std::size_t i = 0; i < strand.size(); ++i)
            strand[i] = {root.x, root.y, root.z - 2.f * static_cast<float>(i)};
        }));
  EXPECT_FALSE(contains(warningsOf("back.obj"), "is up")) << warningsOf("back.obj");
}

TEST_F(GroomFaults, AGroomThatStandsOnFeetTurnsAboutItsOwnHeadWhereThatIsAsked) {
  write("far.obj", moved(hairOfAHead(), {0, 160, 0}));
  write("aside.obj", moved(hairOfAHead(), {0, 160, 160}));
  write("near.obj", hairOfAHead());
  for (const char* kind : {"nod", "spin", "turn", "whip", "walk"}) {
    const std::string motion = fmt::format("[motion]\nkind = \"{}\"\n", kind);
    EXPECT_EQ(warningsOf("near.obj", "", motion), "") << kind;
    // What spins about the axis that it stands on stays there.
    const bool isOnAxis = kind == std::string("spin") || kind == std::string("whip");
    EXPECT_EQ(warningsOf("far.obj", "", motion).empty(), isOnAxis) << warningsOf("far.obj", "", motion);
    const std::string warned = warningsOf(isOnAxis ? "aside.obj" : "far.obj", "", motion);
    EXPECT_TRUE(contains(warned, "about which " + std::string(kind)) && contains(warned, "--bind world"))
        << warned;
    const auto bound = scene("far.obj", "bind = \"world\"", motion);
    ASSERT_TRUE(bound);
    EXPECT_TRUE(bound->warnings.empty()) << kind << ": " << bound->warnings.front();
    // It begins where it was modelled, and its head's middle stays within what the motion itself moves it.
    const HeadPose first = bound->motion.poseAt(0);
    EXPECT_NEAR(first.position.y, 1.6, 0.01) << kind;
    EXPECT_NEAR(first.position.y + 0.01 * double(bound->groom.points[0].y),
                0.01 * (160 + double(hairOfAHead().points[0].y)), 1e-5)
        << kind;
    for (double t = 0; t < 2; t += 0.1)
      EXPECT_LT(length(bound->motion.poseAt(t).position - first.position), 0.15) << kind;
  }
  // Motions that only move it, and none, are no matter.
  for (const char* kind : {"still", "shake", "jump", "glide"})
    EXPECT_EQ(warningsOf("far.obj", "", fmt::format("[motion]\nkind = \"{}\"\n", kind)), "") << kind;
  // Keys that turn say their own place.
  const std::string keys =
      "[[motion.key]]\ntime = 0\nposition = [0, 0, 0]\n[[motion.key]]\ntime = 1\nposition = [0, 0, "
      "0]\nrotate_degrees = [30, 0, 0]\n";
  EXPECT_TRUE(contains(warningsOf("far.obj", "", keys), "start = [")) << warningsOf("far.obj", "", keys);
  EXPECT_FALSE(
      contains(warningsOf("far.obj", "bind = \"world\"", "[motion]\nstart = [0, 1.6, 0]\n" + keys), "turn"));
}

TEST_F(GroomFaults, ABodyThatHairDoesNotMeetIsNoSuccess) {
  write("groom.obj", hairOfAHead(4));
  for (const bool isFar : {false, true}) {
    TriangleMesh ball = sphereMesh(0.085, 3);
    for (Vec3d& point : ball.points) point.x += isFar ? 3 : 0;
    writeMeshMotion(folder_, "ball", ball.triangles, {ball.points, ball.points}, 24);
    const std::string place = fmt::format("position = [{}, 0, 0]\n", isFar ? 3 : 0),
                      mesh = "shape = \"mesh\"\nunit = 1\nfile = \"ball.obj\"\n",
                      bends = mesh + "deforms = true\ncache = \"ball.pc2\"\n";
    for (const std::string& body : {"shape = \"sphere\"\nradius = 0.085\n" + place,
                                    "shape = \"capsule\"\nradius = 0.085\nlength = 0.01\n" + place, mesh,
                                    bends + "region = \"all\"\n", bends + "sides = \"both\"\n"}) {
      SCOPED_TRACE(body);
      writeText("scene.toml", "[groom]\nfile = \"groom.obj\"\n[[body]]\nname = \"ball\"\n" + body);
      const ProgramResult run =
          runProgram(folder_, {"simulate", "scene.toml", "--backend", "reference", "--frames", "2",
                               "--no-sheet", "--no-usd", "--overwrite", "-o", "out"});
      ASSERT_EQ(run.exitCode, 0) << run.err;
      EXPECT_EQ(contains(run.out, "hair did not meet them"), isFar) << run.out;
      EXPECT_EQ(contains(run.out, "deepest"), !isFar) << run.out;
    }
  }
}

// --- A preset that fits better.

TEST_F(GroomFaults, ADefaultRunSaysWhichPresetFitsWhereThatIsClear) {
  const auto curls =
      makeSwatch({.curl = {.radius = 0.003, .turns = 20, .length = 0.15, .particleCount = 200}});
  ASSERT_TRUE(curls);
  write("coils.hair", *curls);
  const auto notes = [&](const char* rest) {
    const auto loaded = scene("coils.hair", "", rest);
    return loaded && !loaded->notes.empty() ? loaded->notes.front() : std::string();
  };
  EXPECT_TRUE(contains(notes(""), "looks like coil") && contains(notes(""), "--material coil")) << notes("");
  EXPECT_EQ(notes("[material]\npreset = \"coil\"\n"), "");
  EXPECT_EQ(notes("[material]\npreset = \"straight\"\n"), "");
  EXPECT_EQ(notes("[material]\nbend_stiffness = 3\n"), "");
  // Near the width that tells two presets apart it says nothing.
  const auto between =
      makeSwatch({.curl = {.radius = 0.005, .turns = 10, .length = 0.15, .particleCount = 200}});
  ASSERT_TRUE(between);
  write("between.hair", *between);
  const ProgramResult run = runProgram(folder_, {"simulate", "coils.hair", "--backend", "reference",
                                                 "--frames", "1", "--no-sheet", "--no-usd", "-o", "out"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "note") && contains(run.out, "--material coil")) << run.out;
}

// --- What is given in place of a groom.

TEST_F(GroomFaults, FoldersMaterialsAndScenesAreCalledThat) {
  std::filesystem::create_directory(folder_ / "folder");
  std::filesystem::create_directory(folder_ / "folder.obj");
  std::filesystem::create_directory(folder_ / "folder.toml");
  write("groom.obj", hairOfAHead(4));
  writeText("material.toml", "bend_stiffness = 4\n[dials]\nhold = 2\n");
  writeText("dials.toml", "[dials]\nhold = 2\n");
  writeText("scene.toml", "[groom]\nfile = \"groom.obj\"\n[material]\npreset = \"coil\"\n");
  const struct {
    std::vector<std::string> arguments;
    const char* says;
  } kCases[] = {
      {{"simulate", "folder", "-o", "out"}, "folder: is a folder"},
      {{"simulate", "folder.obj", "-o", "out"}, "folder.obj: is a folder"},
      {{"simulate", "folder.toml", "-o", "out"}, "folder.toml: is a folder"},
      {{"info", "folder"}, "folder: is a folder"},
      {{"view", "folder"}, "folder: is a folder"},
      {{"measure", "folder", "groom.obj"}, "name the groom first"},
      {{"material", "--suggest", "folder"}, "folder: is a folder"},
      {{"simulate", "material.toml", "-o", "out"}, "material.toml: is a material file and no scene"},
      {{"simulate", "dials.toml", "-o", "out"}, "dials.toml: is a material file and no scene"},
      {{"view", "material.toml"}, "material.toml: is a material file and no scene"},
      {{"render", "material.toml", "-o", "out"}, "material.toml: is a material file and no scene"},
      {{"simulate", "groom.obj", "--material", "scene.toml", "-o", "out"},
       "scene.toml: is a scene and no material"},
  };
  for (const auto& one : kCases) {
    const ProgramResult result = runProgram(folder_, one.arguments);
    EXPECT_NE(result.exitCode, 0);
    EXPECT_TRUE(contains(result.err, one.says)) << one.says << " in\n" << result.err;
  }
}

// --- Points alone.

TEST_F(GroomFaults, EveryCommandCutsAFileOfPointsWhereTheNumberIsSaid) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 24\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n";
  for (int i = 0; i < 24; ++i) ply += fmt::format("{} {} 0\n", i / 12, -(i % 12));
  writeText("points.ply", ply);
  const std::vector<std::vector<std::string>> kCommands{
      {"info", "points.ply"},
      {"convert", "points.ply", "out.hair"},
      {"material", "--suggest", "points.ply"},
      {"simulate", "points.ply", "--backend", "reference", "--frames", "1", "--no-sheet", "--overwrite", "-o",
       "out"}};
  for (std::vector<std::string> arguments : kCommands) {
    const ProgramResult refused = runProgram(folder_, arguments);
    EXPECT_NE(refused.exitCode, 0) << arguments[0];
    EXPECT_TRUE(contains(refused.err, "--points-per-strand N")) << refused.err;
    arguments.insert(arguments.end(), {"--points-per-strand", "7"});
    const ProgramResult wrong = runProgram(folder_, arguments);
    EXPECT_NE(wrong.exitCode, 0) << arguments[0];
    EXPECT_TRUE(contains(wrong.err, "24 points") && contains(wrong.err, "7 points")) << wrong.err;
    arguments.back() = "12";
    const ProgramResult cut = runProgram(folder_, arguments);
    EXPECT_EQ(cut.exitCode, 0) << arguments[0] << ": " << cut.err;
  }
  EXPECT_EQ(info({"points.ply", "--points-per-strand", "12"})["strands"], 2);
  EXPECT_EQ(scene("points.ply", "points_per_strand = 12")->groom.strandCount(), 2u);
}

}  // namespace
}  // namespace ringlet::groom_faults_test
