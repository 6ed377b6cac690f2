// `ringlet measure` as a user runs it: a groom, a pose, an animation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/output/animation_reader.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/output/usd/usd_writer.h"
#include "tests/measure/strand_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::measure_test {
namespace {

using namespace test;
using nlohmann::json;

// Two curls in centimetres, as the default unit has it.
Groom twoCurls(double stretch = 1) {
  Groom groom;
  for (double x : {0.0, 0.05}) {
    std::vector<Vec3f> strand;
    for (Vec3d p : cut({.handedness = x > 0 ? -1 : 1}, 64))
      strand.push_back(Vec3f(Vec3d{p.x + x, stretch * p.y, p.z} * 100.0));
    groom.addStrand(strand);
  }
  return groom;
}

// Curls that bounce, and come nearer to each other by that share.
void writeAnimation(const std::filesystem::path& folder, double metresPerUnit = 0.01, double nearer = 0) {
  std::filesystem::create_directories(folder);
  auto writer =
      UsdWriter::create(folder / "hair.usda", twoCurls(), {.metresPerUnit = metresPerUnit, .frameCount = 96});
  ASSERT_TRUE(writer);
  for (int k = 1; k <= 96; ++k) {
    const double t = k / 24.0;
    Groom pose = twoCurls(1 + 0.1 * std::exp(-4 * t) * std::sin(2 * kPi * 3 * t));
    for (Vec3f& p : pose.points) p.x *= static_cast<float>(1 - nearer * k / 96);
    ASSERT_TRUE(writer->addFrame(pose.points));
  }
  ASSERT_TRUE(writer->finish());
}

json measureJson(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "measure");
  arguments.push_back("--json");
  const ProgramResult result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return json::parse(result.out, nullptr, false);
}

TEST(Measure, AGroomAlone) {
  const auto folder = scratchFolder("measure_groom");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  const json found = measureJson(folder, {"rest.obj"});
  for (const char* key :
       {"strands", "particles", "frames", "droop_mm", "core_elongation", "turns", "mean_radius_mm",
        "handedness_kept", "arc_drift", "max_edge_stretch", "tip_rotation_deg", "bounce_hz", "settle_s",
        "energy_ratio", "limited_share", "velocity_residual"})
    EXPECT_TRUE(found.contains(key)) << key;
  EXPECT_EQ(found["strands"], 2);
  EXPECT_EQ(found["particles"], 128);
  EXPECT_EQ(found["frames"], 0);
  EXPECT_NEAR(found["turns"].get<double>(), 8, 0.01);
  EXPECT_NEAR(found["mean_radius_mm"].get<double>(), 10, 0.01);
  EXPECT_NEAR(found["spread"]["core_length_mm"][0].get<double>(), 250, 0.1);
  EXPECT_EQ(found["droop_mm"], 0);
  EXPECT_TRUE(found["bounce_hz"].is_null());

  // In another unit everything is as much larger.
  EXPECT_NEAR(measureJson(folder, {"rest.obj", "--unit", "1"})["mean_radius_mm"].get<double>(), 1000, 1);
}

TEST(Measure, APose) {
  const auto folder = scratchFolder("measure_pose");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  ASSERT_TRUE(writeGroom(folder / "now.hair", twoCurls(1.1)));
  const json found = measureJson(folder, {"rest.obj", "now.hair", "--strands"});
  EXPECT_NEAR(found["droop_mm"].get<double>(), 25, 1e-3);
  EXPECT_NEAR(found["core_elongation"].get<double>(), 1.1, 1e-3);
  EXPECT_EQ(found["handedness_kept"], true);
  ASSERT_EQ(found["per_strand"].size(), 2u);
  EXPECT_EQ(found["per_strand"][0]["handedness"], 1);
  EXPECT_EQ(found["per_strand"][1]["handedness"], -1);
  EXPECT_NEAR(found["per_strand"][1]["droop_mm"].get<double>(), 25, 1e-3);
  // Up along Z nothing droops.
  EXPECT_NEAR(measureJson(folder, {"rest.obj", "now.hair", "--up", "Z"})["droop_mm"].get<double>(), 0, 1e-3);

  const ProgramResult text = runProgram(folder, {"measure", "rest.obj", "now.hair", "--strands"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  for (const char* part : {"2 strands", "droop [mm]", "25.000", "kept by every strand", "strand"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
}

TEST(Measure, AnAnimation) {
  const auto folder = scratchFolder("measure_animation");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeAnimation(folder / "out");
  for (const char* other : {"out", "out/hair.usda"}) {
    const json found = measureJson(folder, {"rest.obj", other, "--strands"});
    EXPECT_EQ(found["frames"], 96);
    EXPECT_NEAR(found["bounce_hz"].get<double>(), 3, 0.1);
    EXPECT_LT(found["settle_s"].get<double>(), 1.5);
    EXPECT_LT(found["energy_ratio"].get<double>(), 1e-6);
    EXPECT_NEAR(found["droop_mm"].get<double>(), 0, 1e-3);
    EXPECT_GT(found["worst"]["core_elongation"].get<double>(), 1.06);
    EXPECT_TRUE(found["per_strand"][1].contains("settle_s"));
  }
  const ProgramResult text = runProgram(folder, {"measure", "rest.obj", "out"});
  for (const char* part : {"96 frames", "bounce", "settled", "energy"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;

  // One that was not finished is measured as far as it goes, with a warning.
  std::filesystem::rename(folder / "out/hair.usda", folder / "out/hair.usda.partial");
  const ProgramResult cut = runProgram(folder, {"measure", "rest.obj", "out"});
  EXPECT_EQ(cut.exitCode, 0);
  EXPECT_NE(cut.err.find("not finished"), std::string::npos) << cut.err;
}

TEST(Measure, AgainstAThirdPose) {
  const auto folder = scratchFolder("measure_against");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  ASSERT_TRUE(writeGroom(folder / "longer.obj", twoCurls(1.1)));
  ASSERT_TRUE(writeGroom(folder / "shorter.hair", twoCurls(0.9)));
  writeAnimation(folder / "out");
  // Tips of curls 25 cm long, as shares of their arc.
  const double length = 0.25 / std::hypot(2 * kPi * 0.01 * 8, 0.25);
  struct Case {
    std::vector<std::string> arguments;
    double tip;
  };
  for (const Case& c : {Case{{"rest.obj", "--against", "longer.obj"}, 0.1},
                        Case{{"rest.obj", "rest.obj", "--against", "longer.obj"}, 0.1},
                        Case{{"rest.obj", "longer.obj", "--against", "shorter.hair"}, 0.2},
                        Case{{"rest.obj", "longer.obj", "--against", "longer.obj"}, 0},
                        Case{{"rest.obj", "out", "--against", "shorter.hair"}, 0.1}}) {
    const json found = measureJson(folder, c.arguments);
    const json& against = found["against"];
    for (const char* key : {"particles", "tip", "core", "direction_deg", "turns", "radius"})
      ASSERT_EQ(against[key].size(), 3u) << key;
    EXPECT_NEAR(against["tip"][0].get<double>(), c.tip * length, 1e-3 * length);
    EXPECT_NEAR(against["particles"][2].get<double>(), c.tip * length / std::sqrt(3), 1e-3 * length);
    EXPECT_NEAR(against["turns"][1].get<double>(), 0, 1e-3);
  }
  EXPECT_FALSE(measureJson(folder, {"rest.obj", "longer.obj"}).contains("against"));
  const json strands = measureJson(folder, {"rest.obj", "--against", "longer.obj", "--strands"});
  EXPECT_NEAR(strands["per_strand"][1]["against"]["tip"].get<double>(), 0.1 * length, 1e-3 * length);

  const ProgramResult text =
      runProgram(folder, {"measure", "rest.obj", "out", "--against", "longer.obj", "--strands"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  for (const char* part : {"against longer.obj", "particles [% length]", "direction [deg]", "apart %"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;
}

// Curls that are stretched from frame to frame.
void writeStretched(const std::filesystem::path& folder, const std::vector<double>& stretches,
                    double framesPerSecond = 24) {
  std::filesystem::create_directories(folder);
  auto writer = UsdWriter::create(folder / "hair.usda", twoCurls(),
                                  {.framesPerSecond = framesPerSecond,
                                   .metresPerUnit = 0.01,
                                   .frameCount = static_cast<int>(stretches.size())});
  ASSERT_TRUE(writer);
  for (const double stretch : stretches) ASSERT_TRUE(writer->addFrame(twoCurls(stretch).points));
  ASSERT_TRUE(writer->finish());
}

// Tips of curls 25 cm long: their ways are what they are stretched by.
TEST(Measure, AMotionAgainstAnother) {
  const auto folder = scratchFolder("measure_beside");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeStretched(folder / "this", {1.02, 1.06});
  writeStretched(folder / "that", {1.04, 1.04});
  for (const char* that : {"that", "that/hair.usda"}) {
    const json found = measureJson(folder, {"rest.obj", "this", "--against", that});
    const json& beside = found["against_motion"];
    ASSERT_TRUE(beside.is_object());
    EXPECT_EQ(beside["frames"], 2);
    EXPECT_NEAR(beside["way_mm"].get<double>(), 10, 1e-3);
    EXPECT_NEAR(beside["against_way_mm"].get<double>(), 10, 1e-3);
    EXPECT_NEAR(beside["way"].get<double>(), 1, 1e-4);
    EXPECT_NEAR(beside["tips"].get<double>(), 0.5, 1e-4);
    EXPECT_TRUE(beside["kept"].is_null());
    EXPECT_NEAR(beside["each"]["way_mm"][0].get<double>(), 5, 1e-3);
    EXPECT_NEAR(beside["each"]["way_mm"][1].get<double>(), 15, 1e-3);
    EXPECT_NEAR(beside["each"]["tips"][1].get<double>(), 0.5, 1e-4);
    const double length = 0.25 / std::hypot(2 * kPi * 0.01 * 8, 0.25);
    EXPECT_NEAR(found["against"]["tip"][0].get<double>(), 0.02 * length, 1e-4 * length) << "the last frames";
  }
  const ProgramResult text = runProgram(folder, {"measure", "rest.obj", "this", "--against", "that"});
  for (const char* part : {"tips move 10.00 mm from rest", "1.000 of it", "0.500 of that way apart"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;

  // Of a longer run the frames that both have.
  writeStretched(folder / "longer", {1.04, 1.04, 1.5});
  const ProgramResult both =
      runProgram(folder, {"measure", "rest.obj", "this", "--against", "longer", "--json"});
  EXPECT_NE(both.err.find("2 frames and another 3"), std::string::npos) << both.err;
  EXPECT_NEAR(json::parse(both.out)["against_motion"]["tips"].get<double>(), 0.5, 1e-4);
  const ProgramResult longer =
      runProgram(folder, {"measure", "rest.obj", "longer", "--against", "this", "--json"});
  EXPECT_EQ(json::parse(longer.out)["against_motion"]["frames"], 2);
}

// All of what the other keeps apart, or none of it.
TEST(Measure, WhatContactsKeep) {
  const auto folder = scratchFolder("measure_kept");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeAnimation(folder / "apart");
  writeAnimation(folder / "together", 0.01, 0.8);
  writeAnimation(folder / "between", 0.01, 0.75);
  const auto kept = [&](const char* run) {
    return measureJson(
        folder, {"rest.obj", run, "--against", "apart", "--without", "together"})["against_motion"]["kept"];
  };
  EXPECT_EQ(kept("apart"), 1);
  EXPECT_EQ(kept("together"), 0);
  EXPECT_GT(kept("between"), 0.01);
  EXPECT_LT(kept("between"), 0.99);
  const ProgramResult text =
      runProgram(folder, {"measure", "rest.obj", "apart", "--against", "apart", "--without", "together"});
  EXPECT_NE(text.out.find("1.000 of what is kept apart there"), std::string::npos) << text.out;
}

// Curves that move, as any program writes them, are runs as well, in whatever unit.
TEST(Measure, AnotherProgramsRunIsCompared) {
  const auto folder = scratchFolder("measure_foreign");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeAnimation(folder / "out");
  auto ours = AnimationReader::open(folder / "out/hair.usda");
  ASSERT_TRUE(ours) << ours.error().message;
  std::string text =
      "#usda 1.0\n(\n metersPerUnit = 0.001\n)\ndef BasisCurves \"Hair\" {\n"
      " uniform token type = \"linear\"\n int[] curveVertexCounts = [64, 64]\n"
      " point3f[] points.timeSamples = {\n";
  for (int frame = 1; frame <= 96; ++frame) {
    ASSERT_TRUE(ours->readFrame(frame));
    text += std::to_string(frame) + ": [";
    for (const Vec3f& p : ours->groom().points)
      text += fmt::format("({}, {}, {}),", 10 * double{p.x}, 10 * double{p.y}, 10 * double{p.z});
    text += "],\n";
  }
  std::ofstream(folder / "foreign.usda") << text << " }\n}\n";
  for (const auto& [run, against] : {std::pair("foreign.usda", "out"), std::pair("out", "foreign.usda")}) {
    const ProgramResult result =
        runProgram(folder, {"measure", "rest.obj", run, "--against", against, "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json found = json::parse(result.out);
    EXPECT_EQ(found["frames"], 96);
    EXPECT_NEAR(found["bounce_hz"].get<double>(), 3, 0.1);
    EXPECT_NEAR(found["against_motion"]["tips"].get<double>(), 0, 1e-3);
    EXPECT_NEAR(found["against"]["tip"][2].get<double>(), 0, 1e-6);
  }
}

TEST(Measure, SaysWhatIsWrong) {
  const auto folder = scratchFolder("measure_wrong");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  Groom fewer, shorter = twoCurls();
  fewer.addStrand(twoCurls().strand(0));
  shorter.points.pop_back();
  --shorter.firstPoint.back();
  ASSERT_TRUE(writeGroom(folder / "fewer.obj", fewer));
  ASSERT_TRUE(writeGroom(folder / "shorter.obj", shorter));
  writeAnimation(folder / "out");
  writeStretched(folder / "fast", {1, 1}, 60);
  std::filesystem::create_directories(folder / "empty");
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    const char* part;
  };
  for (const Case& c :
       {Case{{"missing.obj"}, 4, "missing.obj"},
        Case{{"rest.obj", "missing.obj"}, 4, "missing.obj"},
        Case{{"rest.obj", "fewer.obj"}, 1, "2 and 1 strands"},
        Case{{"rest.obj", "shorter.obj"}, 1, "strand 1 has 64 particles"},
        Case{{"fewer.obj", "out"}, 1, "1 and 2 strands"},
        Case{{"rest.obj", "--against", "fewer.obj"}, 1, "rest.obj and fewer.obj hold 2 and 1 strands"},
        Case{{"rest.obj", "out", "--against", "shorter.obj"}, 1, "63 in shorter.obj"},
        Case{{"rest.obj", "--against", "missing.obj"}, 4, "missing.obj"},
        Case{{"rest.obj", "empty"}, 1, "holds no hair.usda"},
        Case{{"rest.obj", "out", "--against", "empty"}, 1, "empty holds no hair.usda"},
        Case{{"rest.obj", "out", "--against", "fast"}, 1, "only runs of one rate can be compared"},
        Case{{"fewer.obj", "out", "--against", "out"}, 1, "1 and 2 strands"},
        Case{{"rest.obj", "out", "--against", "rest.obj", "--without", "out"}, 1, "rest.obj, a pose"},
        Case{{"rest.obj", "rest.obj", "--against", "out", "--without", "out"}, 1, "rest.obj, a pose"},
        Case{{"rest.obj", "out", "--without", "out"}, 2, "--against"},
        Case{{"out"}, 1, "name the groom first, as in `ringlet measure groom.obj out`"},
        Case{{"out/hair.rgc", "rest.obj"}, 1, "name the groom first"},
        Case{{"rest.obj", "out", "--unit", "1"}, 1, "--unit 1 does not fit"},
        Case{{}, 2, "REST"},
        Case{{"rest.obj", "--up", "X"}, 2, "X"},
        Case{{"rest.obj", "--unit", "-1"}, 2, "-1"}}) {
    auto arguments = c.arguments;
    arguments.insert(arguments.begin(), "measure");
    const ProgramResult result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    EXPECT_NE(result.err.find(c.part), std::string::npos) << c.part << " in\n" << result.err;
  }
}

// What gnuplot makes of two motions of a groom, and the numbers it had.
TEST(Measure, MotionsArePlottedOverEachOther) {
  const auto folder = scratchFolder("measure_plot");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeAnimation(folder / "soft");
  writeAnimation(folder / "it's \"stiff\"");
  if (std::system("command -v gnuplot > /dev/null") != 0) {
    const ProgramResult result = runProgram(folder, {"measure", "rest.obj", "soft", "--plot", "a.svg"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.err.find("Debian: gnuplot-nox"), std::string::npos) << result.err;
    GTEST_SKIP() << "SKIPPED: gnuplot is not installed, no plot was drawn";
  }
  const json found = measureJson(
      folder, {"rest.obj", "soft", "--plot", "plot.svg", "--over", "it's \"stiff\"", "--over", "soft"});
  std::string svg = readText(folder / "plot.svg");
  for (const char* text :
       {"droop [mm]", "core elongation", "turns", "kinetic energy", "seconds", ">soft<", "stiff"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find("contact"), std::string::npos) << "nothing touches";
  const json& series = found["series"];
  ASSERT_EQ(series["seconds"].size(), 97);
  EXPECT_DOUBLE_EQ(series["seconds"][24], 1);
  EXPECT_NEAR(series["droop_mm"][96], found["droop_mm"], 1e-9);
  EXPECT_NEAR(series["turns"][96], found["turns"], 1e-9);
  const std::vector<double> elongations = series["core_elongation"];
  EXPECT_NEAR(elongations.front(), 1, 1e-9);
  EXPECT_GT(std::ranges::max(elongations), 1.02);
  EXPECT_LE(std::ranges::max(elongations), found["worst"]["core_elongation"].get<double>() + 1e-9);
  const std::vector<double> energies = series["energy_uj"];
  EXPECT_EQ(energies.front(), 0);
  EXPECT_GT(energies[2], 100 * energies.back()) << "the bounce dies away";
  EXPECT_EQ(series["deepest_contact"].size(), 97);

  writeAnimation(folder / "near", 0.01, 0.5);
  const std::vector<double> deepest =
      measureJson(folder, {"rest.obj", "near", "--plot", "near.svg"})["series"]["deepest_contact"];
  EXPECT_EQ(deepest.front(), 0);
  EXPECT_GT(deepest.back(), 0.2);
  const std::string nearSvg = readText(folder / "near.svg");
  for (const char* text : {"deepest contact", "mean contact"})
    EXPECT_NE(nearSvg.find(text), std::string::npos) << text;

  measureJson(folder, {"rest.obj", "soft", "--plot", "plot.png"});
  EXPECT_EQ(readText(folder / "plot.png").substr(1, 3), "PNG");
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
}

TEST(Measure, PlotsThatCannotBeAreRefused) {
  const auto folder = scratchFolder("measure_no_plot");
  ASSERT_TRUE(writeGroom(folder / "rest.obj", twoCurls()));
  writeAnimation(folder / "out");
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"rest.obj", "--plot", "a.svg"}, "one pose"},
      {{"rest.obj", "rest.obj", "--plot", "a.svg"}, "one pose"},
      {{"rest.obj", "out", "--plot", "a.svg", "--over", "rest.obj"}, "one pose"},
      {{"rest.obj", "out", "--plot", "a.svg", "--over", "nowhere"}, "nowhere"},
      {{"rest.obj", "out", "--plot", "a.pdf"}, ".svg or .png"},
      {{"rest.obj", "out", "--over", "out"}, "--plot"},
      {{"rest.obj", "out", "--plot", "nowhere/a.svg"}, "nowhere/a.svg"},
  };
  for (const auto& [arguments, expected] : cases) {
    std::vector<std::string> all{"measure"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramResult result = runProgram(folder, all);
    EXPECT_NE(result.exitCode, 0) << expected;
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
  }
}

}  // namespace
}  // namespace ringlet::measure_test
