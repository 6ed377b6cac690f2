// `ringlet simulate --cache` and `ringlet convert`: every way from one file to another, ranges, what is said
// of files that are unfinished, torn or wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/cache_reader.h"
#include "tests/program/run_program.h"
#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace ringlet::convert_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::readText;
using test::readUsd;
using test::runProgram;
using test::scratchFolder;

constexpr int kFrames = 5;

// A folder with out/hair.usda, out/hair.rgc and out/last.obj of one run: two strands, Z up, 30 frames a
// second.
class Convert : public testing::Test {
 protected:
  void SetUp() override { simulate("float32"); }

  void simulate(const std::string& precision) {
    folder_ = scratchFolder("convert");
    std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -1 0.2\nv 0.1 -2 0\nv 0 -3 0.1\nv 0 -4 0\n"
                                            "v 2 0 0\nv 2 -1 0\nv 2.1 -2 0\nl 1 2 3 4 5\nl 6 7 8\n";
    const auto result =
        run({"simulate", "groom.obj", "--up", "Z", "--fps", "30", "--width", "0.0007", "--backend",
             "reference", "--frames", std::to_string(kFrames), "--cache", precision, "-o", "out"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    for (const char* file : {"out/hair.usda", "out/hair.rgc", "out/last.obj", "out/sheet.png"})
      ASSERT_NE(result.out.find(file), std::string::npos) << file << " is missing in:\n" << result.out;
  }

  ProgramResult run(const std::vector<std::string>& arguments) { return runProgram(folder_, arguments); }

  // Converts and expects that to work; what it prints with --json.
  json convert(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "convert");
    arguments.push_back("--json");
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  }

  std::vector<Vec3f> pointsOf(const fs::path& path) {
    auto groom = readGroom(folder_ / path);
    EXPECT_TRUE(groom);
    return groom ? groom->groom.points : std::vector<Vec3f>{};
  }

  fs::path folder_;
};

TEST_F(Convert, AFloat32CacheBecomesTheTextThatSimulateWrites) {
  const json out = convert({"out/hair.rgc", "again.usda"});
  EXPECT_EQ(readText(folder_ / "again.usda"), readText(folder_ / "out/hair.usda"));
  EXPECT_EQ(out["frames"], kFrames);
  EXPECT_EQ(out["strands"], 2);
  EXPECT_EQ(out["particles"], 8);
  EXPECT_EQ(out["error_bound_m"], 0);
  EXPECT_EQ(out["warnings"], json::array());
  EXPECT_EQ(out["outputs"], json{"again.usda"});
  EXPECT_EQ(out["bytes"], fs::file_size(folder_ / "again.usda"));
}

TEST_F(Convert, UsdTextBecomesTheCacheThatSimulateWrites) {
  convert({"out/hair.usda", "again.rgc"});
  EXPECT_EQ(readText(folder_ / "again.rgc"), readText(folder_ / "out/hair.rgc"));
}

// Every format that can be read, into every format there is, and by way of each back to the first.
TEST_F(Convert, EveryFormatBecomesEveryOther) {
  const auto usd = readUsd(folder_ / "out/hair.usda");
  for (const AnimationFormat& from : animationFormats()) {
    if (!from.isRead) continue;
    const std::string input = std::string("from") + from.extension;
    convert({"out/hair.rgc", input});
    for (const AnimationFormat& to : animationFormats()) {
      SCOPED_TRACE(std::string(from.extension) + " to " + to.extension);
      const std::string output = std::string("to") + to.extension,
                        again = std::string("again") + from.extension;
      const json out = convert({input, output});
      EXPECT_EQ(out["frames"], kFrames);
      EXPECT_EQ(out["error_bound_m"], 0);
      if (!to.isRead) {
        EXPECT_EQ(fs::file_size(folder_ / output), 32u + 12u * 8 * kFrames);
        EXPECT_EQ(pointsOf("to.obj"), usd.points.at(1));
        continue;
      }
      convert({output, again});
      EXPECT_TRUE(readText(folder_ / again) == readText(folder_ / input)) << "changed on the way";
    }
    // One file a frame.
    for (const char* ending : {".obj", ".ply"}) {
      convert({input, std::string("pose") + ending});
      for (int frame = 1; frame <= kFrames; ++frame)
        EXPECT_EQ(pointsOf("pose.000" + std::to_string(frame) + ending), usd.points.at(frame))
            << input << ending;
      convert({input, std::string("one") + ending, "--frame", "3"});
      EXPECT_EQ(pointsOf(std::string("one") + ending), usd.points.at(3)) << input << ending;
    }
  }
}

TEST_F(Convert, ACrateIsThatOfSimulate) {
  const auto result =
      run({"simulate", "groom.obj",    "--up",          "Z",           "--fps",    "30",
           "--width",  "0.0007",       "--backend",     "reference",   "--frames", std::to_string(kFrames),
           "--usdc",   "--usd-values", "id,velocities", "--tip-width", "0.0001",   "--overwrite",
           "-o",       "out"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  convert({"out/hair.usda", "again.usdc", "--usd-values", "id,velocities", "--tip-width", "0.0001"});
  EXPECT_TRUE(readText(folder_ / "again.usdc") == readText(folder_ / "out/hair.usdc"));
  const json info = convert({"out/hair.usdc", "--info"});
  EXPECT_EQ(info["format"], "usdc");
  EXPECT_EQ(info["frames"], kFrames);
  EXPECT_EQ(info["finished"], true);
  const auto measured = run({"measure", "groom.obj", "out/hair.usda", "--up", "Z", "--json"});
  ASSERT_EQ(measured.exitCode, 0) << measured.err;
  EXPECT_EQ(run({"measure", "groom.obj", "out/hair.usdc", "--up", "Z", "--json"}).out, measured.out);
}

TEST_F(Convert, ClipsAreOfSoManyFrames) {
  convert({"out/hair.rgc", "parts.usda", "--clips", "2"});
  const auto usd = readUsd(folder_ / "out/hair.usda");
  for (int clip = 1; clip <= 3; ++clip) {
    const std::string file = "parts_clips/parts.000" + std::to_string(clip) + ".usdc";
    convert({file, "clip.obj", "--frame", "1"});
    EXPECT_EQ(pointsOf("clip.obj"), usd.points.at(2 * clip - 1)) << file;
  }
  EXPECT_FALSE(fs::exists(folder_ / "parts_clips/parts.0004.usdc"));
}

TEST_F(Convert, A16BitCacheIsOffByNoMoreThanItSays) {
  const auto exact = readUsd(folder_ / "out/hair.usda");
  const std::string fromFloats =
      (convert({"out/hair.rgc", "small.rgc", "--precision", "16bit"}), readText(folder_ / "small.rgc"));
  const json out = convert({"small.rgc", "small.usda"}), info = convert({"small.rgc", "--info"});
  EXPECT_EQ(out["error_bound_m"], info["error_bound_m"]);
  const double bound = info["error_bound_m"].get<double>();
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, 0.04 / 65535) << "strands 4 cm long";
  // Of a part it is that of the worst of its frames, the last included.
  double worst = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const double one = convert({"small.rgc", "one.obj", "--frame", std::to_string(frame)})["error_bound_m"];
    EXPECT_GT(one, 0) << frame;
    worst = std::max(worst, one);
  }
  EXPECT_EQ(worst, bound);
  const auto rounded = readUsd(folder_ / "small.usda");
  for (int frame = 1; frame <= kFrames; ++frame) {
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3d apart = Vec3d(rounded.points.at(frame)[i]) - Vec3d(exact.points.at(frame)[i]);
      EXPECT_LE(0.01 * length(apart), bound) << "frame " << frame << " particle " << i;
    }
  }
  simulate("16bit");
  EXPECT_EQ(readText(folder_ / "out/hair.rgc"), fromFloats) << "as simulate writes it at once";
}

TEST_F(Convert, PrecisionIsKeptUnlessSaid) {
  convert({"out/hair.rgc", "small.rgc", "--precision", "16bit"});
  convert({"small.rgc", "kept.rgc"});
  EXPECT_EQ(convert({"kept.rgc", "--info"})["precision"], "16bit");
  convert({"small.rgc", "float.rgc", "--precision", "float32"});
  EXPECT_EQ(convert({"float.rgc", "--info"})["precision"], "float32");
}

TEST_F(Convert, FramesBecomeObjFiles) {
  const auto usd = readUsd(folder_ / "out/hair.usda");
  const json all = convert({"out/hair.rgc", "pose.obj"});
  EXPECT_EQ(all["outputs"], (json{"pose.0001.obj", "pose.0005.obj"}));
  const json some = convert({"out/hair.usda", "frames", "--frames", "2:3"});
  EXPECT_EQ(some["outputs"], (json{"frames/hair.0002.obj", "frames/hair.0003.obj"}));
  EXPECT_EQ(some["frames"], 2);
  EXPECT_EQ(convert({"out/hair.usda", "deep/down/", "--frames", "2:2"})["frames"], 1);
  EXPECT_EQ(pointsOf("deep/down/hair.0002.obj"), usd.points.at(2));
  for (int frame = 1; frame <= kFrames; ++frame)
    EXPECT_EQ(pointsOf("pose.000" + std::to_string(frame) + ".obj"), usd.points.at(frame));
  EXPECT_EQ(pointsOf("frames/hair.0003.obj"), usd.points.at(3));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "frames"), {}), 2);
  EXPECT_EQ(some["bytes"], fs::file_size(folder_ / "frames/hair.0002.obj") +
                               fs::file_size(folder_ / "frames/hair.0003.obj"));

  for (const char* input : {"out/hair.rgc", "out/hair.usda"}) {
    convert({input, "one.obj", "--frame", "4"});
    EXPECT_EQ(pointsOf("one.obj"), usd.points.at(4)) << input;
  }
  convert({"out/hair.rgc", "last.obj", "--frame", std::to_string(kFrames)});
  EXPECT_EQ(readText(folder_ / "last.obj"), readText(folder_ / "out/last.obj"));
}

TEST_F(Convert, RangesCountFromOneAgain) {
  const auto whole = readUsd(folder_ / "out/hair.usda");
  convert({"out/hair.rgc", "part.usda", "--frames", "3:5"});
  const auto part = readUsd(folder_ / "part.usda");
  ASSERT_EQ(part.points.size(), 3u);
  for (int frame = 1; frame <= 3; ++frame) EXPECT_EQ(part.points.at(frame), whole.points.at(frame + 2));
  convert({"out/hair.rgc", "part.rgc", "--frame", "2"});
  EXPECT_EQ(convert({"part.rgc", "--info"})["frames"], 1);
}

TEST_F(Convert, TheSheetIsThatOfSimulate) {
  for (const char* input : {"out/hair.rgc", "out/hair.usda"}) {
    convert({input, "sheet.png"});
    EXPECT_EQ(readText(folder_ / "sheet.png"), readText(folder_ / "out/sheet.png")) << input;
  }
}

TEST_F(Convert, InfoSaysWhatIsInside) {
  const json cache = convert({"out/hair.rgc", "--info"}), usd = convert({"out/hair.usda", "--info"});
  EXPECT_EQ(cache["format"], "cache");
  EXPECT_EQ(usd["format"], "usd");
  for (const json& info : {cache, usd}) {
    EXPECT_EQ(info["precision"], "float32");
    EXPECT_EQ(info["finished"], true);
    EXPECT_EQ(info["frames"], kFrames);
    EXPECT_EQ(info["strands"], 2);
    EXPECT_EQ(info["particles"], 8);
    EXPECT_EQ(info["fps"], 30);
    EXPECT_EQ(info["metres_per_unit"], 0.01);
    EXPECT_EQ(info["up"], "Z");
    EXPECT_NEAR(info["width_m"].get<double>(), 0.0007, 1e-9);
    EXPECT_EQ(info["error_bound_m"], 0);
    EXPECT_DOUBLE_EQ(info["bytes_per_point"].get<double>(), info["bytes"].get<double>() / (8 * kFrames));
  }
  EXPECT_EQ(cache["bytes"], fs::file_size(folder_ / "out/hair.rgc"));
  const auto text = run({"convert", "out/hair.rgc", "--info"});
  for (const char* part : {"cache, float32, finished", "5 at 30 a second", "2, 8 particles, 0.7 mm wide",
                           "Z up", "bytes a point", "exact"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << " is missing in:\n" << text.out;
}

TEST_F(Convert, ACacheInPlaceOfUsd) {
  const auto result = run({"simulate", "groom.obj", "--backend", "reference", "--frames", "2", "--cache",
                           "16bit", "--no-usd", "--json", "-o", "small"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["outputs"],
            (json{"small/hair.rgc", "small/last.obj", "small/sheet.png"}));
  EXPECT_FALSE(fs::exists(folder_ / "small/hair.usda"));
  const double bound = json::parse(result.out)["cache_error_bound_m"];
  EXPECT_GT(bound, 0);
  EXPECT_EQ(json::parse(run({"convert", "small/hair.rgc", "--info", "--json"}).out)["error_bound_m"], bound);
  EXPECT_TRUE(json::parse(run({"simulate", "groom.obj", "--backend", "reference", "--frames", "1", "--json",
                               "-o", "none"})
                              .out)["cache_error_bound_m"]
                  .is_null());
}

TEST_F(Convert, MeasureReadsCachesToo) {
  const auto usd = run({"measure", "groom.obj", "out/hair.usda", "--json"});
  ASSERT_EQ(usd.exitCode, 0) << usd.err;
  EXPECT_EQ(run({"measure", "groom.obj", "out/hair.rgc", "--json"}).out, usd.out);
  fs::remove(folder_ / "out/hair.usda");
  EXPECT_EQ(run({"measure", "groom.obj", "out", "--json"}).out, usd.out) << "in a folder";
}

// What a killed run leaves: no index, and half of a frame.
TEST_F(Convert, AnUnfinishedCacheIsReadAsFarAsItGoes) {
  const std::string whole = readText(folder_ / "out/hair.rgc");
  std::uint64_t indexAt = 0;
  std::memcpy(&indexAt, whole.data() + whole.size() - 16, 8);
  std::ofstream(folder_ / "cut.rgc.partial", std::ios::binary) << whole.substr(0, indexAt);
  std::ofstream(folder_ / "torn.rgc.partial", std::ios::binary) << whole.substr(0, indexAt - 7);
  struct Case {
    std::string name, message;
    int frames;
  };
  for (const Case& c : {Case{"cut.rgc.partial", "was not finished; it has 5 frames", 5},
                        Case{"torn.rgc.partial", "frame 5 is torn or damaged", 4}}) {
    const json info = convert({c.name, "--info"});
    EXPECT_EQ(info["finished"], false);
    EXPECT_EQ(info["frames"], c.frames);
    const auto result = run({"convert", c.name, "rest.usda"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
    EXPECT_EQ(readUsd(folder_ / "rest.usda").points.size(), static_cast<std::size_t>(c.frames));
  }
}

TEST_F(Convert, AKilledRunLeavesItsFrames) {
  test::RunningProgram program(folder_, {"simulate", "groom.obj", "--backend", "reference", "--frames",
                                         "1000000", "--cache", "float32", "--no-usd", "-o", "killed"});
  const fs::path partial = folder_ / "killed/hair.rgc.partial";
  const bool began = program.waitUntil([&] { return fs::exists(partial) && fs::file_size(partial) > 5000; });
  program.send(SIGKILL);
  EXPECT_EQ(program.wait().exitCode, -1);
  ASSERT_TRUE(began);
  auto reader = CacheReader::open(partial);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_GT(reader->frameCount(), 5);
  EXPECT_FALSE(reader->isFinished());
}

TEST_F(Convert, HairsFollowTheStrands) {
  ASSERT_EQ(run({"make", "head", "--strands", "12", "--particles", "32", "-o", "h.obj"}).exitCode, 0);
  ASSERT_EQ(run({"simulate", "h.obj", "--backend", "reference", "--motion", "turn", "--frames", "6",
                 "--cache", "float32", "--no-usd", "-o", "turned"})
                .exitCode,
            0);
  EXPECT_EQ(convert({"h.obj", "rest.obj", "--hairs", "100"})["strands"], 100);
  const json out = convert({"turned/hair.rgc", "full.rgc", "--hairs", "100", "--groom", "h.obj"});
  EXPECT_EQ(out["strands"], 100);
  EXPECT_EQ(out["particles"], 100 * 32);
  EXPECT_EQ(out["frames"], 6);
  const json info = convert({"full.rgc", "--info"});
  EXPECT_EQ(info["strands"], 100);
  EXPECT_EQ(info["fps"], 24);
  convert({"full.rgc", "six.obj", "--frame", "6"});
  convert({"turned/hair.rgc", "alone.obj", "--frame", "6", "--hairs", "100", "--groom", "h.obj"});
  EXPECT_EQ(readText(folder_ / "alone.obj"), readText(folder_ / "six.obj"))
      << "frames know nothing of others";
  for (const auto& [option, usual, other] :
       {std::tuple("--frizz", "1", "3"), {"--clump", "0.25", "0.9"}, {"--blend", "0", "1"}}) {
    const auto with = [&, dial = option](const char* value) {
      convert(
          {"turned/hair.rgc", "look.obj", "--frame", "6", "--hairs", "100", "--groom", "h.obj", dial, value});
      return readText(folder_ / "look.obj");
    };
    EXPECT_EQ(with(usual), readText(folder_ / "six.obj")) << option;
    EXPECT_NE(with(other), readText(folder_ / "six.obj")) << option;
  }

  // Roots move as the head does: none comes nearer to another. Tips move by themselves.
  const auto rest = pointsOf("rest.obj"), six = pointsOf("six.obj");
  ASSERT_EQ(six.size(), rest.size());
  double changed = 0, moved = 0, bent = 0;
  const auto apart = [](const std::vector<Vec3f>& points, std::size_t a, std::size_t b) {
    return length(Vec3d(points[a]) - Vec3d(points[b]));
  };
  for (std::size_t h = 32; h < rest.size(); h += 32) {
    changed = std::max(changed, std::abs(apart(rest, 0, h) - apart(six, 0, h)));
    moved = std::max(moved, length(Vec3d(rest[h]) - Vec3d(six[h])));
    bent = std::max(bent, std::abs(apart(rest, 31, h + 31) - apart(six, 31, h + 31)));
  }
  EXPECT_LT(changed, 0.001) << "[cm]";
  EXPECT_GT(moved, 1);
  EXPECT_GT(bent, 0.05);
}

TEST_F(Convert, FailuresAreOneSentenceAndHaveAnExitStatus) {
  std::ofstream(folder_ / "wrong.rgc") << "hello";
  std::ofstream(folder_ / "file") << "x";
  std::string damaged = readText(folder_ / "out/hair.rgc");
  damaged[170] ^= 1;
  std::ofstream(folder_ / "damaged.rgc", std::ios::binary) << damaged;
  std::string later = readText(folder_ / "out/hair.rgc");
  later[later.size() / 2] ^= 1;
  std::ofstream(folder_ / "later.rgc", std::ios::binary) << later;
  fs::create_directories(folder_ / "here");
  fs::copy(folder_ / "out/hair.rgc", folder_ / "here/hair.rgc.partial");
  std::ofstream(folder_ / "left.usda.partial") << "frames of another";
  ASSERT_EQ(run({"make", "curl", "--particles", "65536", "-o", "long.hair"}).exitCode, 0);
  std::ofstream(folder_ / "large.obj") << "v 0 0 0\nv 0 -100 20\nv 10 -200 0\nv 0 -300 10\nv 0 -400 0\n"
                                          "v 200 0 0\nv 200 -100 0\nv 210 -200 0\nl 1 2 3 4 5\nl 6 7 8\n";
  std::ofstream(folder_ / "point.obj") << "v 0 0 0\nv 0 0 0\nv 2 0 0\nv 2 -1 0\nl 1 2\nl 3 4\n";
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
    int exitCode = 1;
  };
  for (const Case& c :
       {Case{{"none.rgc", "a.usda"}, "none.rgc", 4}, Case{{"wrong.rgc", "a.usda"}, "5 bytes"},
        Case{{"groom.obj", "a.usdz"}, "cannot write a groom: .usdz is only read"},
        Case{{"damaged.rgc", "a.usda"}, "frame 1 is damaged"},
        Case{{"later.rgc", "b.usda"}, "frames before it are kept in b.usda.partial"},
        Case{{"out/hair.rgc", "a.usda", "--frames", "2:6"}, "has frames 1 to 5; there is no frame 6"},
        Case{{"out/hair.usda", "a.obj", "--frame", "6"}, "there is no frame 6"},
        Case{{"out/hair.rgc", "out/hair.rgc"}, "choose another name"},
        Case{{"here/hair.rgc.partial", "here/hair.rgc"}, "choose another name"},
        Case{{"out/hair.rgc", "left.usda"}, "left.usda.partial holds frames", 5},
        Case{{"out/hair.rgc", "a.rgc", "--hairs", "9", "--groom", "none.obj"}, "none.obj", 4},
        Case{{"long.hair", "a.hair", "--hairs", "70000"}, "70000 hairs have 4587520000 points"},
        Case{{"out/hair.rgc", "a.rgc", "--hairs", "9", "--groom", "large.obj"},
             "times as long as the groom's: one of them is in another unit"},
        Case{{"out/hair.rgc", "a.rgc", "--hairs", "9", "--groom", "point.obj"},
             "strand 1 of the groom has no length"},
        Case{{"out/hair.rgc", "none/a.usda"}, "none/a.usda", 5}, Case{{"out/hair.rgc", "file"}, "file"}}) {
    std::vector<std::string> arguments{"convert"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("ringlet convert: "), std::string::npos);
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
  EXPECT_EQ(readText(folder_ / "here/hair.rgc.partial"), readText(folder_ / "out/hair.rgc")) << "untouched";
  EXPECT_EQ(convert({"damaged.rgc", "rest.usda", "--frames", "2:5"})["frames"], 4) << "the others can be had";
  EXPECT_EQ(readText(folder_ / "left.usda.partial"), "frames of another");
  EXPECT_EQ(run({"convert", "out/hair.rgc", "left.usda", "--overwrite"}).exitCode, 0);
}

TEST_F(Convert, AWrongCommandLineIsSaidAndExit2) {
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  for (const Case& c :
       {Case{{"convert", "out/hair.rgc"}, "--info"},
        Case{{"convert", "out/hair.rgc", "a.fbx"}, ".usda, .usdc, .abc, .rgc, .pc2, .obj"},
        Case{{"convert", "out/hair.rgc", "a.usda", "--info"}, "leave out OUT"},
        Case{{"convert", "out/hair.rgc", "a.usda", "--precision", "16bit"}, "only a cache"},
        Case{{"convert", "out/hair.rgc", "a.usdc", "--clips", "2"}, "only a .usda has clips"},
        Case{{"convert", "out/hair.rgc", "a.usda", "--usd-values", "velocities"},
             "into .usdc, .abc and clips only"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--usd-values", "id"},
             "only .usda, .usdc and .abc have it"},
        Case{{"convert", "out/hair.rgc", "a.obj", "--tip-width", "0.001"},
             "only .usda, .usdc and .abc have it"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--precision", "8bit"}, "there is no '8bit'"},
        Case{{"convert", "out/hair.rgc", "a.obj", "--frame", "2", "--frames", "1:2"}, "say one of them"},
        Case{{"convert", "out/hair.rgc", "a.obj", "--frame", "0"}, "from 1"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--hairs", "9"}, "name with --groom the groom"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--groom", "groom.obj"},
             "only --hairs and a point cache need it"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--frizz", "2"},
             "only such hairs have frizz, clumps and blends"},
        Case{{"convert", "out/hair.rgc", "a.rgc", "--blend", "1"},
             "only such hairs have frizz, clumps and blends"},
        Case{{"simulate", "groom.obj", "-o", "none", "--clump", "0.5"},
             "only such hairs have frizz, clumps and blends"},
        Case{{"render", "out", "-o", "none", "--hairs", "0", "--frizz", "2"}, "0 are no hairs"},
        Case{
            {"convert", "out/hair.rgc", "a.rgc", "--hairs", "9", "--groom", "groom.obj", "--scene", "a.toml"},
            "say one of --scene and --groom"},
        Case{{"convert", "groom.obj", "a.obj", "--hairs", "9", "--scene", "scene.toml"},
             "IN is a groom itself"},
        Case{{"convert", "out/hair.rgc", "--info", "--hairs", "9"}, "leave out OUT"},
        Case{{"convert", "groom.obj", "a.obj", "--hairs", "9", "--groom", "groom.obj"},
             "IN is a groom itself"},
        Case{{"convert", "groom.obj", "a.obj", "--hairs", "0"}, "from 1 to 10000000"},
        Case{{"convert", "out/hair.rgc", "a.obj", "--frames", "5:2"}, "as 1:24"},
        Case{{"convert", "out/hair.rgc", "a.obj", "--frames", "0"}, "as 1:24"},
        Case{{"simulate", "groom.obj", "--cache", "float16", "-o", "x"}, "there is no 'float16'"}}) {
    const auto result = run(c.arguments);
    EXPECT_EQ(result.exitCode, 2) << c.message;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace ringlet::convert_test
