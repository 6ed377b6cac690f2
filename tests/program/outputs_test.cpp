// What `ringlet simulate` writes: which files, what is in them, what a killed run leaves of each and how it
// goes on.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::outputs_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::readText;
using test::runProgram;
using test::scratchFolder;

constexpr const char* kUsdGroom = R"(#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Head"
{
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def BasisCurves "Top"
    {
        uniform token type = "linear"
        int[] curveVertexCounts = [4, 3]
        point3f[] points = [(0, 0, 0), (0.25, 0, -1), (0, 0, -2), (0.25, 0, -3), (2, 0, 0), (2, 0, -1), (2, 0.5, -2)]
        color3f[] primvars:displayColor = [(1, 0, 0.5), (0.25, 1, 0)] (interpolation = "uniform")
    }
    def BasisCurves "Side"
    {
        uniform token type = "linear"
        int[] curveVertexCounts = [3]
        point3f[] points = [(5, 0, 0), (5, 0, -1), (5, 0.25, -2)]
    }
}
)";

class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = scratchFolder("outputs");
    std::ofstream(folder_ / "groom.obj") << "v 0 0 0\nv 0 -1 0.2\nv 0.1 -2 0\nv 0 -3 0.1\nv 0 -4 0\n"
                                            "v 2 0 0\nv 2 -1 0\nv 2.1 -2 0\nl 1 2 3 4 5\nl 6 7 8\n";
    std::ofstream(folder_ / "groom.usda") << kUsdGroom;
  }

  ProgramResult run(const std::vector<std::string>& arguments) { return runProgram(folder_, arguments); }
  // A run of the reference, with what else is asked for.
  ProgramResult simulate(const std::string& groom, std::vector<std::string> more) {
    std::vector<std::string> arguments{"simulate", groom, "--backend", "reference", "--frames", "5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  std::set<std::string> filesIn(const std::string& folder) const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder))
      if (entry.is_regular_file() && entry.path().filename() != ".ringlet.lock")
        files.insert(entry.path().lexically_relative(folder_ / folder).string());
    return files;
  }

  fs::path folder_;
};

TEST_F(Outputs, AreThoseThatWereAskedFor) {
  struct Case {
    std::vector<std::string> options;
    std::set<std::string> files;
  };
  for (const Case& c :
       {Case{{}, {"hair.usda", "last.obj", "sheet.png"}}, Case{{"--no-last"}, {"hair.usda", "sheet.png"}},
        Case{{"--no-sheet"}, {"hair.usda", "last.obj"}},
        Case{{"--usdc", "--no-usd", "--no-last", "--no-sheet"}, {"hair.usdc"}},
        Case{{"--also", "hair.pc2,hair.usdc,hair.abc", "--no-usd", "--no-last", "--no-sheet"},
             {"hair.abc", "hair.obj", "hair.pc2", "hair.usdc"}},
        Case{{"--usdc", "--cache", "16bit"}, {"hair.rgc", "hair.usda", "hair.usdc", "last.obj", "sheet.png"}},
        Case{{"--clips", "2", "--no-last", "--no-sheet"},
             {"hair.usda", "hair_clips/hair.0001.usdc", "hair_clips/hair.0002.usdc",
              "hair_clips/hair.0003.usdc", "hair_clips/manifest.usda"}}}) {
    fs::remove_all(folder_ / "out");
    std::vector<std::string> options = c.options;
    options.insert(options.end(), {"--json", "-o", "out"});
    const auto result = simulate("groom.obj", options);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(filesIn("out"), c.files);
    std::set<std::string> said;
    const json told = json::parse(result.out);
    for (const auto& path : told["outputs"])
      said.insert(fs::path(path.get<std::string>()).lexically_relative("out").string());
    std::set<std::string> atTop = c.files;
    // Of formats of several files the one that was asked for.
    std::erase_if(
        atTop, [](const std::string& file) { return file.starts_with("hair_clips") || file == "hair.obj"; });
    EXPECT_EQ(said, atTop);
  }
}

// Every animation that a run writes is byte by byte what `convert` makes of its cache.
TEST_F(Outputs, AreWhatConvertMakesOfTheCache) {
  std::vector<std::string> files;
  for (const AnimationFormat& format : animationFormats())
    if (!format.hasPrecisions) files.push_back(std::string("hair") + format.extension);
  std::ofstream(folder_ / "scene.toml")
      << "[groom]\nfile = 'groom.obj'\n[output]\ncache = 'float32'\nfiles = ['"
      << fmt::format("{}", fmt::join(files, "', '")) << "']\n";
  const auto result = simulate("scene.toml", {"-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  for (const std::string& file : files) {
    ASSERT_EQ(run({"convert", "out/hair.rgc", file}).exitCode, 0) << file;
    EXPECT_TRUE(readText(folder_ / file) == readText(folder_ / "out" / file)) << file;
  }
}

// The hairs are those that `convert --hairs` makes of the same run; the strands stay in last.obj.
TEST_F(Outputs, HairsThatFollowAreInEveryAnimation) {
  const std::vector<std::string> formats{"--usdc",  "--also",   "hair.abc", "--cache",
                                         "float32", "--motion", "nod"};
  const auto simulateInto = [&](const std::string& folder, std::vector<std::string> more) {
    more.insert(more.end(), formats.begin(), formats.end());
    more.insert(more.end(), {"-o", folder});
    const auto result = simulate("groom.obj", more);
    ASSERT_EQ(result.exitCode, 0) << result.err;
  };
  simulateInto("strands", {});
  simulateInto("hairs", {"--hairs", "50"});
  simulateInto("clips", {"--hairs", "50", "--clips", "2"});
  EXPECT_EQ(readText(folder_ / "hairs/last.obj"), readText(folder_ / "strands/last.obj"));
  EXPECT_TRUE(readText(folder_ / "hairs/sheet.png") == readText(folder_ / "strands/sheet.png"));
  const auto frameOf = [&](const std::string& file, const std::vector<std::string>& more,
                           const std::string& frame = "4") {
    std::vector<std::string> arguments{"convert", file, "frame.obj", "--frame", frame};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, 0) << file << ": " << result.err;
    return readText(folder_ / "frame.obj");
  };
  const std::string expected = frameOf("strands/hair.rgc", {"--hairs", "50", "--groom", "groom.obj"});
  EXPECT_NE(expected, frameOf("strands/hair.rgc", {}));
  for (const char* file :
       {"hairs/hair.usda", "hairs/hair.usdc", "hairs/hair.abc", "hairs/hair.rgc", "clips/hair.rgc"})
    EXPECT_EQ(frameOf(file, {}), expected) << file;
  EXPECT_EQ(frameOf("clips/hair_clips/hair.0002.usdc", {}, "2"), expected);
}

// All hairs of a groom whose guides are simulated are in every animation, as many and where the groom has
// them; and what is made of an animation of the guides alone is the same.
TEST_F(Outputs, HairsOfTheGroomFollowItsGuides) {
  ASSERT_EQ(run({"make", "head", "--strands", "40", "--particles", "12", "--turns", "2", "-o", "dense.obj"})
                .exitCode,
            0);
  ASSERT_EQ(run({"make", "head", "--strands", "7", "--particles", "9", "--turns", "2", "-o", "guides.obj"})
                .exitCode,
            0);
  const std::vector<std::string> formats{"--usdc", "--also", "hair.abc", "--cache", "float32"};
  const auto simulateInto = [&](const std::string& groom, const std::string& folder,
                                std::vector<std::string> more) {
    more.insert(more.end(), formats.begin(), formats.end());
    more.insert(more.end(), {"-o", folder, "--json"});
    const auto result = simulate(groom, more);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false);
  };
  const auto frameOf = [&](const std::string& file, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"convert", file, "frame.obj", "--frame", "4"});
    const auto result = run(more);
    EXPECT_EQ(result.exitCode, 0) << file << ": " << result.err;
    return readText(folder_ / "frame.obj");
  };
  const json still =
      simulateInto("dense.obj", "still", {"--guides", "9", "--guides-sample", "5", "--motion", "still"});
  EXPECT_EQ(still["strands"], 14);
  EXPECT_EQ(still["hairs"], 40);
  EXPECT_LT(double(still["follow_error"]), 1e-3);
  const auto first = readGroom(folder_ / "dense.obj", {});
  ASSERT_TRUE(first);
  for (const char* file : {"hair.usda", "hair.usdc", "hair.abc", "hair.rgc"}) {
    SCOPED_TRACE(file);
    auto reader = AnimationReader::open(folder_ / "still" / file);
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_TRUE(reader->readFrame(1));
    EXPECT_EQ(reader->groom().firstPoint, first->groom.firstPoint);
    for (std::size_t i = 0; i < first->groom.points.size(); ++i)
      ASSERT_LT(length(reader->groom().points[i] - first->groom.points[i]), 0.02f) << i;
  }
  const json nod = simulateInto("dense.obj", "nod", {"--guides-file", "guides.obj", "--motion", "nod"});
  EXPECT_EQ(nod["strands"], 7);
  EXPECT_TRUE(nod["follow_error"].is_null());
  const std::string expected = frameOf("nod/hair.rgc");
  for (const char* file : {"hair.usda", "hair.usdc", "hair.abc"})
    EXPECT_TRUE(frameOf(std::string("nod/") + file) == expected) << file;
  simulateInto("guides.obj", "guides", {"--motion", "nod"});
  std::ofstream(folder_ / "dense.toml") << "[groom]\nfile = 'dense.obj'\nguides_file = 'guides.obj'\n";
  EXPECT_TRUE(frameOf("guides/hair.rgc", {"--scene", "dense.toml"}) == expected);
  const auto other = run({"convert", "nod/hair.rgc", "frame.obj", "--frame", "4", "--scene", "dense.toml"});
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_NE(other.err.find("IN has 40 strands, its guides are 7"), std::string::npos) << other.err;
}

// What the groom's file says of its curves is said of all its hairs, whoever is simulated.
TEST_F(Outputs, HairsOfTheGroomKeepItsPrimsAndValues) {
  std::ofstream(folder_ / "scene.usda") << kUsdGroom;
  const auto valuesOf = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--usdc", "--no-usd", "--usd-values", "groom,unreal", "-o", "values"});
    const auto result = simulate("scene.usda", more);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    auto read = readGroom(folder_ / "values/hair.usdc", {.keepsPrims = true});
    EXPECT_TRUE(read);
    fs::remove_all(folder_ / "values");
    std::map<std::string, std::vector<double>> values;
    for (const GroomValue& value : read->prims.front().values) values[value.name] = value.numbers;
    return values;
  };
  auto whole = valuesOf({"--up", "Z"}), guided = valuesOf({"--up", "Z", "--guides", "1"});
  EXPECT_EQ(guided["primvars:groom_guide"].size(), 3u);
  EXPECT_EQ(std::ranges::count(guided["primvars:groom_guide"], 1), 1);
  guided.erase("primvars:groom_guide");
  EXPECT_EQ(guided, whole);
}

// A ball that moves with the head pushes hairs, the same in the run and afterwards.
TEST_F(Outputs, HairsStayOutOfTheScenesBodies) {
  std::ofstream(folder_ / "ball.toml")
      << "[groom]\nfile = 'groom.obj'\nunit = 0.01\n[motion]\nkind = 'nod'\n"
         "[[body]]\nshape = 'sphere'\nradius = 0.01\nposition = [0, -0.025, 0.012]\n";
  const auto result = simulate("ball.toml", {"--hairs", "400", "--cache", "float32", "-o", "hairs"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto strands = simulate("ball.toml", {"--cache", "float32", "-o", "strands"});
  ASSERT_EQ(strands.exitCode, 0) << strands.err;
  const auto converted = [&](const char* known, const char* file) {
    const auto made = run({"convert", "strands/hair.rgc", "made.rgc", "--hairs", "400", known, file});
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return readText(folder_ / "made.rgc");
  };
  const std::string found = readText(folder_ / "hairs/hair.rgc");
  EXPECT_TRUE(converted("--scene", "ball.toml") == found);
  EXPECT_FALSE(converted("--groom", "groom.obj") == found) << "the ball must press on hairs";
}

// A groom of Alembic goes through info, convert, measure and simulate; what its file says of curves goes on
// into USD files, but its objects are no prims of USD.
TEST_F(Outputs, AnAlembicGroomGoesThroughTheProgram) {
  const std::vector<std::int32_t> counts{5, 4};
  test::AbcCurveForm form;
  form.more = {
      test::abcArray("width", test::AbcBytes::f32, test::abcNumbers<float>({0.5f}), 1, "geoScope=con")};
  form.params = {test::abcArray("groom_id", test::AbcBytes::i32, test::abcNumbers<std::int32_t>({41, 42}), 1,
                                "geoScope=uni")};
  std::ofstream(folder_ / "groom.abc", std::ios::binary) << test::abcFile({test::abcXform(
      "head", {0x10}, {{0, 3, 0}}, 0, {test::abcCurves("a b", counts, test::abcCurl(counts), form)})});
  const auto info = run({"info", "groom.abc"});
  ASSERT_EQ(info.exitCode, 0) << info.err;
  EXPECT_NE(info.out.find("2 strands, 9 particles"), std::string::npos) << info.out;
  const auto read = readGroom(folder_ / "groom.abc");
  ASSERT_TRUE(read) << read.error().message;
  for (const char* out : {"a.hair", "a.obj", "a.ply"}) {
    const auto made = run({"convert", "groom.abc", out});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    const auto back = readGroom(folder_ / out);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->groom.points, read->groom.points) << out;
  }
  const auto made = simulate("groom.abc", {"--usdc", "--usd-values", "groom", "-o", "abc"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  for (const char* file : {"abc/hair.usda", "abc/hair.usdc"}) {
    const auto back = readGroom(folder_ / file, {.keepsPrims = true});
    ASSERT_TRUE(back) << back.error().message;
    const auto& values = back->prims.at(0).values;
    const auto id = std::ranges::find(values, "primvars:groom_id", &GroomValue::name);
    ASSERT_NE(id, values.end()) << file;
    EXPECT_EQ(id->numbers, (std::vector<double>{41, 42})) << file;
    const auto widths = std::ranges::find(values, "widths", &GroomValue::name);
    ASSERT_NE(widths, values.end()) << file;
    EXPECT_EQ(widths->numbers, (std::vector<double>{0.5})) << file;
  }
  EXPECT_EQ(run({"measure", "groom.abc", "abc/hair.usda"}).exitCode, 0);
  const auto prims = simulate("groom.abc", {"--usd-prims", "groom", "--usdc", "--no-usd", "-o", "no"});
  EXPECT_EQ(prims.exitCode, 1);
  EXPECT_NE(prims.err.find("only a USD groom has prims"), std::string::npos) << prims.err;
}

TEST_F(Outputs, HairsHaveNothingOfTheGroomsFile) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--usd-values", "groom"}, {"--usd-prims", "groom", "--usdc", "--no-usd"}}) {
    std::vector<std::string> arguments = options;
    arguments.insert(arguments.end(), {"--hairs", "50", "-o", "refused"});
    const auto result = simulate("groom.usda", arguments);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("hairs have no prims"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "refused"));
  }
  EXPECT_EQ(simulate("groom.obj", {"--hairs", "0", "-o", "refused"}).exitCode, 2);
}

// Strands are of the first group that has them, and hairs of their strand's.
TEST_F(Outputs, UnrealHasTheGroupsOfTheScene) {
  const auto groom = readGroom(folder_ / "groom.obj");
  ASSERT_TRUE(groom) << groom.error().message;
  const std::size_t strands = groom->groom.strandCount();
  ASSERT_GE(strands, 2u);
  for (const std::size_t hairs : {std::size_t{0}, 2 * strands}) {
    std::ofstream(folder_ / "unreal.toml")
        << "[groom]\nfile = 'groom.obj'\n[[group]]\nname = 'fringe'\nstrands = '1'\n[[group]]\nname = 'most'\n"
           "strands = '1:"
        << strands - 1 << "'\n[output]\nfiles = ['hair.usda', 'hair.usdc']\nvalues = ['unreal']\n"
        << (hairs > 0 ? fmt::format("hairs = {}\n", hairs) : "");
    const auto made = simulate("unreal.toml", {"-o", "unreal", "--overwrite"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    for (const char* file : {"unreal/hair.usda", "unreal/hair.usdc"}) {
      SCOPED_TRACE(fmt::format("{}, {} hairs", file, hairs));
      const auto back = readGroom(folder_ / file, {.keepsPrims = true});
      ASSERT_TRUE(back) << back.error().message;
      const auto& values = back->prims.at(0).values;
      const auto ids = std::ranges::find(values, "primvars:groom_group_id", &GroomValue::name);
      const auto names = std::ranges::find(values, "primvars:groom_group_name", &GroomValue::name);
      ASSERT_NE(ids, values.end());
      ASSERT_NE(names, values.end());
      ASSERT_EQ(ids->numbers.size(), hairs > 0 ? hairs : strands);
      // One strand is in no group, one in the first, the others in the second; of hairs as many each.
      const std::size_t each = ids->numbers.size() / strands;
      EXPECT_EQ(std::ranges::count(ids->numbers, 2.0), std::ptrdiff_t(each));
      EXPECT_EQ(std::ranges::count(ids->numbers, 0.0), std::ptrdiff_t(each));
      EXPECT_EQ(std::ranges::count(ids->numbers, 1.0), std::ptrdiff_t(each * (strands - 2)));
      for (std::size_t s = 0; s < ids->numbers.size(); ++s)
        EXPECT_EQ(names->texts.at(s), (std::vector<std::string>{"fringe", "most", "others"}.at(
                                          static_cast<std::size_t>(ids->numbers[s]))));
    }
  }
}

TEST_F(Outputs, TheSceneSaysWhatOptionsSay) {
  std::ofstream(folder_ / "scene.toml")
      << "[groom]\nfile = 'groom.obj'\n[motion]\nkind = 'shake'\n[output]\nfolder = 'scene'\n"
         "files = ['hair.usdc', 'hair.usda', 'hair.abc']\ntip_width = 0.0001\nvalues = ['id', 'rest', 'velocities']\n"
         "head = 'transform'\nhairs = 20\n";
  auto result = simulate("scene.toml", {});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  result = simulate("groom.obj", {"--usdc", "--also", "hair.abc", "--no-last", "--no-sheet", "--tip-width",
                                  "0.0001", "--usd-values", "id,rest,velocities", "--head", "transform",
                                  "--hairs", "20", "-o", "typed"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(filesIn("scene"), filesIn("typed"));
  for (const std::string& file : filesIn("typed"))
    EXPECT_TRUE(readText(folder_ / "scene" / file) == readText(folder_ / "typed" / file)) << file;
}

// Wherever the head's motion is, the hair is in the same place.
TEST_F(Outputs, TheHeadsMotionIsBakedOrApart) {
  const std::vector<std::string> motion{"--motion", "nod",     "--usdc", "--also",
                                        "hair.abc", "--cache", "float32"};
  const auto readAll = [&](const std::string& file) {
    std::vector<std::vector<Vec3f>> frames;
    auto reader = AnimationReader::open(folder_ / file);
    EXPECT_TRUE(reader) << reader.error().message;
    for (int frame = 1; reader && frame <= reader->frameCount(); ++frame) {
      EXPECT_TRUE(reader->readFrame(frame));
      frames.push_back(reader->groom().points);
    }
    return frames;
  };
  std::vector<std::vector<Vec3f>> baked;
  for (const char* head : {"baked", "transform", "none"}) {
    std::vector<std::string> options = motion;
    options.insert(options.end(), {"--head", head, "-o", head});
    const auto result = simulate("groom.obj", options);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const std::string folder = head;
    if (folder == "baked") baked = readAll("baked/hair.rgc");
    EXPECT_TRUE(readAll(folder + "/hair.rgc") == baked);
    for (const char* file : {"/hair.usda", "/hair.usdc", "/hair.abc"}) {
      const auto frames = readAll(folder + file);
      ASSERT_EQ(frames.size(), baked.size());
      for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        const double apart = test::farthestApart(frames[frame], baked[frame]);
        if (folder == "baked") {
          EXPECT_EQ(apart, 0);
        }
        // Two roundings of coordinates below 8.
        if (folder == "transform") {
          EXPECT_LT(apart, 8 * 0x1p-24 * 4);
        }
        // Seen from the head roots do not move.
        if (folder == "none") {
          EXPECT_LT(length(Vec3d(frames[frame][5]) - Vec3d{2, 0, 0}), 8 * 0x1p-24 * 4);
        }
      }
    }
  }
}

// Laid over the groom: the groom's prims bring the points of the changes to where hair was simulated. The
// file is Z up and the run Y up.
TEST_F(Outputs, ChangesOfTheGroomsPrims) {
  const auto result = simulate("groom.usda", {"--usdc", "--no-usd", "--usd-prims", "groom", "--cache",
                                              "float32", "--motion", "still", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  auto changes = AnimationReader::open(folder_ / "out/hair.usdc"),
       cache = AnimationReader::open(folder_ / "out/hair.rgc");
  ASSERT_TRUE(changes && cache);
  EXPECT_EQ(changes->header().up, UpAxis::z) << "as the groom's file";
  EXPECT_EQ(changes->groom().firstPoint, (std::vector<std::uint32_t>{0, 4, 7, 10}));
  for (int frame = 1; frame <= 5; ++frame) {
    ASSERT_TRUE(changes->readFrame(frame) && cache->readFrame(frame));
    for (std::size_t i = 0; i < 10; ++i) {
      const Vec3d local(changes->groom().points[i]), moved = local + Vec3d{1, 2, 3};
      const Vec3d world{moved.x, moved.z, -moved.y};
      EXPECT_LT(length(world - Vec3d(cache->groom().points[i])), 16 * 0x1p-24 * 4) << frame << " " << i;
    }
  }
}

TEST_F(Outputs, AWrongCommandLineIsSaid) {
  struct Case {
    std::vector<std::string> options;
    std::string message;
    int exitCode = 2;
  };
  for (const Case& c :
       {Case{{"--usd-values", "velocities"}, "add --usdc"}, Case{{"--usd-values", "speed"}, "'speed'"},
        Case{{"--head", "left"}, "'left'"}, Case{{"--clips", "0"}, "from 1"},
        Case{{"--clips", "2", "--no-usd"}, "only hair.usda has clips"},
        Case{{"--usd-prims", "groom"}, "--usdc --no-usd"},
        Case{{"--usd-prims", "groom", "--usdc", "--no-usd", "--head", "transform"}, "baked or none"},
        Case{{"--usd-prims", "groom", "--usdc", "--no-usd"}, "only a USD groom has prims", 1}}) {
    std::vector<std::string> options = c.options;
    options.insert(options.end(), {"-o", "no"});
    const auto result = simulate("groom.obj", options);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_NE(result.err.find(c.message), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder_ / "no"));
  }
}

// What a killed run leaves in every format that simulate writes is refused by the next, and gone on with from
// a checkpoint to the bytes of a run without a break.
TEST_F(Outputs, AKilledRunGoesOnInEveryFormat) {
  const std::vector<std::string> all{"--usdc",  "--also",       "hair.pc2,hair.abc", "--cache",
                                     "float32", "--usd-values", "id,velocities"};
  for (const std::vector<std::string>& ways :
       {std::vector<std::string>{}, {"--clips", "3"}, {"--hairs", "40"}}) {
    std::vector<std::string> arguments{"simulate", "groom.obj", "--backend", "reference",    "--motion",
                                       "still",    "--frames",  "60",        "--checkpoint", "7"};
    arguments.insert(arguments.end(), all.begin(), all.end());
    arguments.insert(arguments.end(), ways.begin(), ways.end());
    auto with = [&](std::vector<std::string> more) {
      std::vector<std::string> typed = arguments;
      typed.insert(typed.end(), more.begin(), more.end());
      return typed;
    };
    fs::remove_all(folder_ / "whole");
    fs::remove_all(folder_ / "broken");
    ASSERT_EQ(run(with({"-o", "whole"})).exitCode, 0);
    {
      test::RunningProgram program(folder_, with({"-o", "broken", "--json-progress"}));
      const bool began = program.waitUntil([&] {
        const std::string lines = readText(folder_ / "stdout.txt");
        return std::ranges::count(lines, '\n') > 10;
      });
      program.send(SIGKILL);
      program.wait();
      ASSERT_TRUE(began);
    }
    if (!fs::exists(folder_ / "broken/hair.usdc.partial")) continue;  // it was done before it was killed
    if (ways.empty()) {  // as if it was killed when the first of its files had its name
      fs::remove(folder_ / "broken/hair.usda.partial");
      fs::copy(folder_ / "whole/hair.usda", folder_ / "broken/hair.usda",
               fs::copy_options::overwrite_existing);
    }
    const auto refused = run(with({"-o", "broken"}));
    EXPECT_EQ(refused.exitCode, 5);
    for (const std::string file : {"hair.usda", "hair.usdc", "hair.abc", "hair.rgc"}) {
      if (!fs::exists(folder_ / "broken" / file)) {
        EXPECT_NE(refused.err.find(file + ".partial"), std::string::npos) << refused.err;
      }
    }
    for (const char* partial : {"broken/hair.usdc.partial", "broken/hair.abc.partial"}) {
      auto left = AnimationReader::open(folder_ / partial);
      ASSERT_TRUE(left) << left.error().message;
      EXPECT_GE(left->frameCount(), 10) << partial;
    }
    const auto resumed = run(with({"-o", "broken", "--resume"}));
    ASSERT_EQ(resumed.exitCode, 0) << resumed.err;
    EXPECT_EQ(filesIn("broken"), filesIn("whole"));
    for (const std::string& file : filesIn("whole"))
      EXPECT_TRUE(readText(folder_ / "broken" / file) == readText(folder_ / "whole" / file)) << file;
  }
}

// By a reader of crates that has nothing of ours.
TEST_F(Outputs, AnotherProgramReadsTheCrate) {
  RINGLET_NEEDS_DATA(reader, "../tools/read_usdc.py");
  const auto result = simulate("groom.obj", {"--usdc", "--usd-values", "id,rest,velocities", "--head",
                                             "transform", "--tip-width", "0.0001", "-o", "out"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::string command = "python3 " + reader.string() + " " + (folder_ / "out/hair.usdc").string() +
                              " --json > " + (folder_ / "read.json").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  const json read = json::parse(readText(folder_ / "read.json"));
  EXPECT_EQ(read["version"], (json{0, 8, 0}));
  const json& layer = read["layer"];
  for (const char* path : {"/", "/Hair", "/Hair.points", "/Hair.extent", "/Hair.velocities", "/Hair.widths",
                           "/Hair.primvars:id", "/Hair.primvars:rest", "/Hair.xformOp:transform"})
    EXPECT_TRUE(layer.contains(path)) << path;
  EXPECT_EQ(layer["/"]["fields"]["endTimeCode"]["$v"], 5);
}

}  // namespace
}  // namespace ringlet::outputs_test
