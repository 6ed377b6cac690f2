// motion/usd_clips.h: meshes whose samples are in value clips: against the same samples in one file, against
// the formula of their times, and what is refused.
#include "ringlet/motion/usd_clips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>

#include "ringlet/motion/mesh_motion_file.h"
#include "ringlet/motion/usd_mesh.h"
#include "tests/groom/zip_bytes.h"
#include "tests/motion/usd_clip_samples.h"
#include "tests/motion/usd_skin_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::usd_clips_test {
namespace {

namespace fs = std::filesystem;
using Mesh = std::shared_ptr<const MeshMotion>;
using Points = std::vector<Vec3d>;

constexpr double kFps = 25;
const Triangles kTriangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}};

// A tetrahedron whose points go round; floats, so that files hold them exactly.
Points poseAt(double sample) {
  const double a = 0.4 * sample;
  Points points{{0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {1, a, 0}, {0, 0.25, 1 + a * a}};
  for (Vec3d& p : points) p = Vec3d(static_cast<Vec3f>(p));
  return points;
}
std::vector<Points> poses(const std::vector<double>& times) {
  std::vector<Points> all;
  for (const double time : times) all.push_back(poseAt(time));
  return all;
}
std::vector<double> counted(double first, double last) {
  std::vector<double> times;
  for (double time = first; time <= last; ++time) times.push_back(time);
  return times;
}

Result<Mesh> readIn(const fs::path& folder, const std::string& layer) {
  const fs::path path = folder / "m.usd";
  writeBytes(path, layer);
  return readMeshMotion({.path = path}, false);
}
Mesh meshIn(const fs::path& folder, const std::string& layer) {
  auto mesh = readIn(folder, layer);
  EXPECT_TRUE(mesh) << mesh.error().message << "\n" << layer;
  return mesh ? *mesh : nullptr;
}
std::string problemIn(const fs::path& folder, const std::string& layer) {
  const auto mesh = readIn(folder, layer);
  return mesh ? "" : mesh.error().message;
}

// --- Clips without a change of times.

struct Form {
  std::string name;
  std::vector<std::pair<double, double>> spans;  // of each clip: its first and last sample
  SampleClipSet set;
};
std::vector<Form> forms() {
  const SampleTemplate each{.path = "./clips/c.###.usd", .start = 1, .end = 9};
  SampleTemplate thirds = each;
  thirds.stride = 3;
  std::vector<std::pair<double, double>> nine;
  for (const double time : counted(1, 9)) nine.push_back({time, time});
  const std::vector<std::string> names{"./clips/c.001.usd", "clips/c.004.usd", "clips/../clips/c.007.usd"};
  const NumberPairs active{{1, 0}, {4, 1}, {7, 2}};
  return {
      {"one clip", {{1, 9}}, {.files = {"./clips/c.001.usd"}, .active = {{1, 0}}}},
      {"three clips",
       {{1, 3}, {4, 6}, {7, 9}},
       {.files = names, .active = active, .times = {{1, 1}, {9, 9}}}},
      {"three without times", {{1, 3}, {4, 6}, {7, 9}}, {.files = names, .active = active}},
      {"three with knots",
       {{1, 3}, {4, 6}, {7, 9}},
       {.files = names, .active = active, .times = {{1, 1}, {3, 3}, {4, 4}, {7, 7}, {9, 9}}}},
      {"entries of one clip", {{1, 9}}, {.files = {"clips/c.001.usd"}, .active = {{1, 0}, {2, 0}, {7, 0}}}},
      {"more than is used",
       {{1, 5}, {4, 9}},
       {.files = {"clips/none.usd", "clips/c.001.usd", "clips/c.004.usd"}, .active = {{1, 1}, {5, 2}}}},
      {"a template of frames", nine, {.form = each}},
  };
}

TEST(UsdClips, SayWhatSamplesInTheFileDo) {
  const auto folder = scratchFolder("usd_clips_forms");
  const auto times = counted(1, 9);
  const Mesh plain = meshIn(folder, usdaText(kTriangles, poses(times), kFps));
  ASSERT_TRUE(plain);
  for (const Form& form : forms()) {
    for (const bool isRootCrate : {false, true}) {
      for (const bool areClipsCrates : {false, true}) {
        SCOPED_TRACE(form.name + (isRootCrate ? ", crate" : ", text") +
                     (areClipsCrates ? ", of crates" : ", of text"));
        fs::remove_all(folder / "clips");
        fs::create_directory(folder / "clips");
        for (const auto& [first, last] : form.spans) {
          const auto of = counted(first, last);
          writeBytes(folder / fmt::format("clips/c.{:03}.usd", static_cast<int>(first)),
                     areClipsCrates ? clipCrate(of, poses(of)) : clipText(of, poses(of)));
        }
        const Mesh mesh = meshIn(folder, isRootCrate ? clippedCrate(kTriangles, kFps, {form.set})
                                                     : clippedText(kTriangles, kFps, clipsText({form.set})));
        ASSERT_TRUE(mesh);
        EXPECT_EQ(mesh->triangles(), plain->triangles());
        EXPECT_TRUE(mesh->warnings().empty());
        EXPECT_EQ(mesh->firstSeconds(), plain->firstSeconds());
        EXPECT_EQ(mesh->lastSeconds(), plain->lastSeconds());
        for (double code = 0; code <= 11; code += 0.125)
          EXPECT_EQ(mesh->pointsAt(code / kFps), plain->pointsAt(code / kFps)) << "at " << code;
      }
    }
  }
}

// --- Times.

// What holds at a time of the stage: a clip at one of its times; `share` of the way to another.
struct Held {
  double stage;
  std::size_t clip;
  double time;
  std::size_t nextClip = 0;
  double nextTime = 0, share = 0;
};
struct TimeCase {
  const char* name;
  SampleClipSet set;
  std::vector<Held> held;
};

// Clip k has samples at its times 1 to 5, of poses that no other has.
Points clipAt(std::size_t clip, double time) {
  const double within = std::clamp(time, 1.0, 5.0), before = std::min(std::floor(within), 4.0);
  Points a = poseAt(before + 10 * static_cast<double>(clip));
  const Points b = poseAt(before + 1 + 10 * static_cast<double>(clip));
  for (std::size_t p = 0; p < a.size(); ++p) a[p] = a[p] + (b[p] - a[p]) * (within - before);
  return a;
}

const std::vector<TimeCase>& timeCases() {
  static const std::vector<TimeCase> cases{
      {"offset",
       {.files = {"c.000.usda"}, .active = {{11, 0}}, .times = {{11, 1}, {15, 5}}},
       {{0, 0, 1}, {11, 0, 1}, {12.5, 0, 2.5}, {14, 0, 4}, {15, 0, 5}, {20, 0, 5}}},
      {"slow",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 1}, {8, 5}}},
       {{1, 0, 1.5}, {3, 0, 2.5}, {7.5, 0, 4.75}, {8, 0, 5}}},
      {"fast",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 1}, {2, 5}}},
       {{0.5, 0, 2}, {0.75, 0, 2.5}, {1.9, 0, 4.8}}},
      {"backwards",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 5}, {4, 1}}},
       {{0, 0, 5}, {1.25, 0, 3.75}, {3.5, 0, 1.5}, {4, 0, 1}, {9, 0, 1}}},
      {"to and fro",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 2}, {2, 4}, {4, 2}}},
       {{1, 0, 3}, {2, 0, 4}, {2.5, 0, 3.5}, {3.75, 0, 2.25}}},
      {"jump",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 1}, {4, 5}, {4, 1}, {8, 5}}},
       {{3.5, 0, 4.5}, {3.999, 0, 4.999}, {4, 0, 1}, {4.5, 0, 1.5}, {8, 0, 5}}},
      {"jump at once",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 5}, {0, 1}, {4, 5}}},
       {{-1, 0, 5}, {0, 0, 1}, {1.5, 0, 2.5}}},
      {"jump within a segment of the clip",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 1.25}, {1, 2.25}, {1, 4.5}, {2, 5}}},
       {{0, 0, 1.25}, {0.75, 0, 2}, {0.875, 0, 2.125}, {1, 0, 4.5}, {1.5, 0, 4.75}}},
      {"stands still",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, 1}, {2, 3}, {6, 3}, {8, 5}}},
       {{1, 0, 2}, {2, 0, 3}, {4, 0, 3}, {6, 0, 3}, {7, 0, 4}}},
      {"beyond the samples",
       {.files = {"c.000.usda"}, .active = {{0, 0}}, .times = {{0, -3}, {10, 7}}},
       {{0, 0, 1}, {4, 0, 1}, {5.5, 0, 2.5}, {8, 0, 5}, {10, 0, 5}}},
      // Past its last sample a clip goes straight to where the next begins.
      {"two clips",
       {.files = {"c.000.usda", "c.001.usda"},
        .active = {{1, 0}, {7, 1}},
        .times = {{1, 1}, {5, 5}, {7, 1}, {11, 5}}},
       {{1.5, 0, 1.5}, {5, 0, 5}, {5.25, 0, 4.5}, {8.5, 1, 2.5}, {11, 1, 5}, {30, 1, 5}}},
      {"two clips, held and jumped",
       {.files = {"c.000.usda", "c.001.usda"},
        .active = {{1, 0}, {7, 1}},
        .times = {{1, 1}, {5, 5}, {7, 7}, {7, 1}, {11, 5}}},
       {{5, 0, 5}, {6, 0, 5}, {6.999, 0, 5}, {7, 1, 1}, {8.5, 1, 2.5}}},
      {"two clips, the stage's times",
       {.files = {"c.000.usda", "c.001.usda"}, .active = {{1, 0}, {4, 1}}},
       {{0, 0, 1}, {3, 0, 3}, {3.25, 0, 3, 1, 4, 0.25}, {4, 1, 4}, {4.5, 1, 4.5}, {9, 1, 5}}},
      {"a clip twice, between another",
       {.files = {"c.000.usda", "c.001.usda"},
        .active = {{0, 0}, {4, 1}, {8, 0}},
        .times = {{0, 1}, {4, 5}, {4, 1}, {8, 5}, {8, 1}, {12, 5}}},
       {{1.5, 0, 2.5}, {3.999, 0, 4.999}, {4, 1, 1}, {6.5, 1, 3.5}, {8, 0, 1}, {10.25, 0, 3.25}}},
      // As usdstitchclips loops clips of one frame each.
      {"a loop of frames",
       {.files = {"c.000.usda", "c.001.usda", "c.002.usda"},
        .active = {{1, 0}, {2, 1}, {3, 2}, {4, 0}, {5, 1}, {6, 2}},
        .times = {{1, 1}, {2, 2}, {3, 3}, {4, 1}, {5, 2}, {6, 3}}},
       {{1, 0, 1}, {2, 1, 2}, {3, 2, 3}, {4, 0, 1}, {5, 1, 2}, {6, 2, 3}, {9, 2, 3}}},
      {"a template",
       {.form = SampleTemplate{.path = "c.###.usda", .start = 0, .end = 2}},
       {{0, 0, 1}, {0.5, 0, 1, 1, 1, 0.5}, {1, 1, 1}, {2, 2, 2}, {7, 2, 2}}},
      {"a template of halves",
       {.form = SampleTemplate{.path = "h.##.#.usda", .start = 0.5, .end = 2.5, .stride = 0.5}},
       {{0, 0, 1}, {0.5, 0, 1}, {1.75, 0, 1.75}, {2.25, 0, 2, 1, 2.5, 0.5}, {2.5, 1, 2.5}}},
      {"a template with an offset",
       {.form = SampleTemplate{.path = "c.#.usda", .start = 3, .end = 5, .offset = 0.5}},
       {{2, 0, 2.5}, {2.5, 0, 2.5}, {4.25, 0, 4, 1, 4.5, 0.5}, {4.5, 1, 4.5}, {5, 1, 5}, {6, 2, 5}}},
  };
  return cases;
}

TEST(UsdClips, FollowTheirTimes) {
  const auto folder = scratchFolder("usd_clips_times");
  const auto times = counted(1, 5);
  for (std::size_t clip = 0; clip < 3; ++clip) {
    std::vector<Points> samples;
    for (const double time : times) samples.push_back(clipAt(clip, time));
    writeBytes(folder / fmt::format("c.{:03}.usda", clip), clipText(times, samples));
    writeBytes(folder / fmt::format("c.{}.usda", clip + 3), clipText(times, samples));
    if (clip < 2) writeBytes(folder / (clip == 0 ? "h.00.5.usda" : "h.02.5.usda"), clipText(times, samples));
  }
  for (const TimeCase& c : timeCases()) {
    for (const bool isCrate : {false, true}) {
      SCOPED_TRACE(c.name);
      const Mesh mesh = meshIn(folder, isCrate ? clippedCrate(kTriangles, kFps, {c.set})
                                               : clippedText(kTriangles, kFps, clipsText({c.set})));
      ASSERT_TRUE(mesh);
      for (const Held& held : c.held) {
        const Points a = clipAt(held.clip, held.time), b = clipAt(held.nextClip, held.nextTime);
        const Points found = mesh->pointsAt(held.stage / kFps);
        for (std::size_t p = 0; p < a.size(); ++p) {
          const Vec3d expected = a[p] + (b[p] - a[p]) * held.share;
          EXPECT_LT(length(found[p] - expected), 1e-5 * (1 + length(expected)))
              << "point " << p << " at " << held.stage;
        }
      }
    }
  }
}

// --- Where what is said is taken from.

constexpr const char* kAbove =
    "#usda 1.0\n(\n  metersPerUnit = 1\n  upAxis = \"Y\"\n  timeCodesPerSecond = 25\n)\ndef Xform \"Hero\" {}{{\n"
    "  double3 xformOp:translate{}\n  uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
    "  def Mesh \"M\"\n  {{\n{}  uniform token subdivisionScheme = \"none\"\n{}  }}\n}}\n";

// The clips are of the prim above, which has another name there, and say where that goes.
TEST(UsdClips, MoveThePrimsAbove) {
  const auto folder = scratchFolder("usd_clips_above");
  const auto pointsOf = [](const std::vector<double>& times) {
    std::string text = "  point3f[] points.timeSamples = {\n";
    for (const double time : times) text += fmt::format("    {}: {},\n", time, usdTuples(poseAt(time)));
    return text + "  }\n";
  };
  const auto movesOf = [](const std::vector<double>& times) {
    std::string text = ".timeSamples = { ";
    for (const double time : times) text += fmt::format("{}: ({}, {}, 0), ", time, time * time, 0.5 * time);
    return text + "}";
  };
  const Mesh plain = meshIn(folder, fmt::format(fmt::runtime(kAbove), "", movesOf(counted(1, 8)),
                                                facesText(kTriangles), pointsOf(counted(1, 8))));
  for (const auto& [first, last] : {std::pair{1.0, 4.0}, {5.0, 8.0}}) {
    const auto times = counted(first, last);
    writeBytes(
        folder / fmt::format("c.{}.usda", first),
        fmt::format(
            "#usda 1.0\nover \"World\"\n{{\n over \"Model\"\n {{\n  double3 xformOp:translate{}\n  over \"M\"\n  {{\n{}  }}\n }}\n}}\n",
            movesOf(times), pointsOf(times)));
  }
  const SampleClipSet set{
      .files = {"c.1.usda", "c.5.usda"}, .active = {{1, 0}, {5, 1}}, .primPath = "/World/Model"};
  const Mesh mesh = meshIn(folder, fmt::format(fmt::runtime(kAbove), clipsText({set}), "",
                                               facesText(kTriangles), "  point3f[] points\n"));
  ASSERT_TRUE(plain && mesh);
  EXPECT_GT(length(plain->pointsAt(8 / kFps)[0] - plain->pointsAt(1 / kFps)[0]), 60);
  for (double code = 0; code <= 9; code += 0.25)
    EXPECT_EQ(mesh->pointsAt(code / kFps), plain->pointsAt(code / kFps)) << "at " << code;
  // A place of the file itself counts more.
  const Mesh placed = meshIn(
      folder, fmt::format(fmt::runtime(kAbove), clipsText({set}), " = (0, 0, 0)", facesText(kTriangles), ""));
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->pointsAt(8 / kFps)[0], (Vec3d{0, 0, 0}));
}

TEST(UsdClips, FacesMayBeInClipsAlone) {
  const auto folder = scratchFolder("usd_clips_faces");
  const auto times = counted(1, 3);
  const std::string still = "  uniform token orientation = \"leftHanded\"\n";
  const Mesh plain = meshIn(folder, usdaText(kTriangles, poses(times), kFps, still));
  const SampleClipSet set{.files = {"a.usda", "b.usda"}, .active = {{1, 0}, {3, 1}}};
  const std::string layer =
      "#usda 1.0\n(\n  metersPerUnit = 1\n  timeCodesPerSecond = 25\n)\ndef Mesh \"M\" " + clipsText({set}) +
      "{\n  uniform token subdivisionScheme = \"none\"\n}\n";
  writeBytes(folder / "a.usda",
             clipText({1, 2}, poses({1, 2}), facesText(kTriangles) + still, "def Mesh \"M\""));
  for (const bool isSaidTwice : {false, true}) {
    writeBytes(folder / "b.usda", clipText({3}, poses({3}), isSaidTwice ? facesText(kTriangles) : ""));
    const Mesh mesh = meshIn(folder, layer);
    ASSERT_TRUE(plain && mesh);
    EXPECT_EQ(mesh->triangles(), plain->triangles());
    for (double code = 0; code <= 4; code += 0.25)
      EXPECT_EQ(mesh->pointsAt(code / kFps), plain->pointsAt(code / kFps)) << "at " << code;
  }
}

TEST(UsdClips, TheFilesOwnPointsCountMore) {
  const auto folder = scratchFolder("usd_clips_own");
  writeBytes(folder / "a.usda", clipText({1, 2}, poses({1, 2})));
  const std::string metadata = clipsText({{.files = {"a.usda"}, .active = {{1, 0}}}});
  const Mesh still = meshIn(
      folder, clippedText(kTriangles, kFps, metadata, "  point3f[] points = " + usdTuples(poseAt(7)) + "\n"));
  ASSERT_TRUE(still);
  EXPECT_EQ(still->pointsAt(0), poseAt(7));
  ASSERT_EQ(still->warnings().size(), 2u);
  EXPECT_NE(still->warnings()[0].find("/M: its points stand in the file itself, which counts more"),
            std::string::npos);
}

// Of several sets the first that has samples counts, in the order of their names or of clipSets.
TEST(UsdClips, SetsHaveAnOrder) {
  const auto folder = scratchFolder("usd_clips_sets");
  for (const auto& [name, pose] : {std::pair{"a", 3.0}, {"b", 8.0}})
    writeBytes(folder / (std::string(name) + ".usda"), clipText({1}, {poseAt(pose)}));
  writeBytes(folder / "none.usda", "#usda 1.0\nover \"M\"\n{\n}\n");
  const auto set = [](const char* name, const char* file) {
    return SampleClipSet{.files = {file}, .active = {{1, 0}}, .name = name};
  };
  const std::vector<SampleClipSet> sets{set("z", "b.usda"), set("k", "a.usda"), set("e", "none.usda")};
  struct Case {
    const char* order;
    double pose;
  };
  for (const Case& c : {Case{"", 3},
                        {"  clipSets = [\"z\", \"k\"]\n", 8},
                        {"  clipSets = [\"z\"]\n", 8},
                        {"  prepend clipSets = [\"z\"]\n", 8},
                        {"  append clipSets = [\"k\"]\n", 8},
                        {"  delete clipSets = [\"k\", \"y\"]\n", 8},
                        {"  add clipSets = [\"z\"]\n", 3}}) {
    const Mesh mesh = meshIn(folder, clippedText(kTriangles, kFps, clipsText(sets, c.order)));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->pointsAt(0), poseAt(c.pose)) << c.order;
  }
  EXPECT_NE(problemIn(folder, clippedText(kTriangles, kFps, clipsText(sets, "  clipSets = [\"e\"]\n")))
                .find("has no points, and neither has its clip"),
            std::string::npos);
}

// Clips that say nothing of a mesh are gone past where the set asks for that.
TEST(UsdClips, GapsAreFilledWhereThatIsAsked) {
  const auto folder = scratchFolder("usd_clips_gaps");
  writeBytes(folder / "a.usda", clipText({0, 1}, {poseAt(2), poseAt(3)}));
  writeBytes(folder / "b.usda", "#usda 1.0\nover \"M\"\n{\n}\n");
  writeBytes(folder / "c.usda", clipText({3}, {poseAt(5)}));
  SampleClipSet set{
      .files = {"a.usda", "b.usda", "c.usda"}, .active = {{0, 0}, {2, 1}, {3, 2}}, .fillsGaps = true};
  for (const bool isCrate : {false, true}) {
    const Mesh mesh = meshIn(folder, isCrate ? clippedCrate(kTriangles, kFps, {set})
                                             : clippedText(kTriangles, kFps, clipsText({set})));
    ASSERT_TRUE(mesh);
    const Points a = poseAt(3), b = poseAt(5), found = mesh->pointsAt(2.5 / kFps);
    for (std::size_t p = 0; p < a.size(); ++p)
      EXPECT_LT(length(found[p] - (a[p] + (b[p] - a[p]) * 0.75)), 1e-6);
  }
  set.fillsGaps = false;
  EXPECT_NE(problemIn(folder, clippedText(kTriangles, kFps, clipsText({set})))
                .find("b.usda: /M has no samples of points"),
            std::string::npos);
}

// Joints that move in clips: the arm's samples are in clips alone.
TEST(UsdClips, MoveTheJointsOfASkeleton) {
  const auto folder = scratchFolder("usd_clips_joints");
  const UsdScene scene = arm::scene();
  const std::string whole = scene.text();
  const Mesh plain = meshIn(folder, whole);
  UsdScene still = scene;
  std::string moving;
  for (UsdScenePrim& prim : still.prims)
    if (prim.type == "SkelAnimation") {
      moving = prim.path;
      std::erase_if(prim.properties, [](const auto& property) { return !property.samples.empty(); });
    }
  ASSERT_FALSE(moving.empty());
  writeBytes(folder / "arm.usda", whole);
  std::string layer = still.text();
  const std::string name = "\"" + moving.substr(moving.rfind('/') + 1) + "\"\n";
  layer.insert(layer.find(name) + name.size(),
               clipsText({{.files = {"arm.usda"}, .active = {{-100, 0}}, .primPath = moving}}));
  const Mesh mesh = meshIn(folder, layer);
  ASSERT_TRUE(plain && mesh);
  EXPECT_NE(plain->pointsAt(1), plain->pointsAt(1.5));
  for (double t = 0; t < 3; t += 0.05) {
    const Points found = mesh->pointsAt(t), expected = plain->pointsAt(t);
    for (std::size_t p = 0; p < found.size(); ++p) EXPECT_LT(length(found[p] - expected[p]), 1e-12) << t;
  }
}

// --- What is refused.

TEST(UsdClips, SayWhatTheyCannotUse) {
  const auto folder = scratchFolder("usd_clips_refusals");
  const auto outside = scratchFolder("usd_clips_outside");
  const std::vector<double> times{1, 2};
  writeBytes(folder / "good.usda", clipText(times, poses(times)));
  writeBytes(outside / "good.usda", clipText(times, poses(times)));
  writeBytes(folder / "hollow.usda", "#usda 1.0\ndef Xform \"Else\"\n{\n}\n");
  writeBytes(folder / "still.usda",
             "#usda 1.0\ndef Mesh \"M\"\n{\n  point3f[] points = " + usdTuples(poseAt(1)) + "\n}\n");
  writeBytes(folder / "torn.usda", "#usda 1.0\nover \"M\"\n{\n");
  writeBytes(
      folder / "nan.usda",
      "#usda 1.0\nover \"M\"\n{\n  point3f[] points.timeSamples = { 1: [(nan, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)] }\n}\n");
  auto fewer = poses(times);
  fewer[1].pop_back();
  writeBytes(folder / "fewer.usda", clipText(times, fewer));
  for (auto& points : fewer) points.resize(3);
  writeBytes(folder / "three.usda", clipText(times, fewer));
  writeBytes(folder / "counts.usda", clipText(times, poses(times), facesText({{0, 1, 2}})));
  writeBytes(folder / "turned.usda",
             clipText(times, poses(times), facesText({{0, 1, 2}, {0, 2, 3}, {3, 1, 2}, {3, 1, 0}})));
  std::error_code code;
  fs::create_symlink(outside / "good.usda", folder / "link.usda", code);
  fs::create_directory(folder / "folder.usda");

  const SampleClipSet good{
      .files = {"good.usda", "good.usda"}, .active = {{1, 0}}, .times = {{1, 1}, {2, 2}}};
  const auto of = [&](auto change) {
    SampleClipSet set = good;
    change(set);
    return clippedText(kTriangles, kFps, clipsText({set}));
  };
  const auto files = [&](std::vector<std::string> names) {
    return of([&](SampleClipSet& set) {
      set.files = names;
      if (names.size() == 2) set.active = {{1, 0}, {2, 1}};
    });
  };
  const auto active = [&](NumberPairs pairs) { return of([&](SampleClipSet& set) { set.active = pairs; }); };
  const auto clipTimes = [&](NumberPairs pairs) {
    return of([&](SampleClipSet& set) { set.times = pairs; });
  };
  const auto lines = [&](const std::string& more) {
    return of([&](SampleClipSet& set) { set = {.more = more}; });
  };
  const auto form = [&](SampleTemplate made) {
    return of([&](SampleClipSet& set) { set = {.form = made}; });
  };
  const auto path = [&](const std::string& primPath) {
    return of([&](SampleClipSet& set) { set.primPath = primPath; });
  };
  const std::string files2 = "      asset[] assetPaths = [@good.usda@]\n",
                    active2 = "      double2[] active = [(1, 0)]\n";
  ASSERT_EQ(problemIn(folder, of([](SampleClipSet&) {})), "");
  struct Case {
    std::string layer, message;
  };
  std::vector<SampleClipSet> many;
  for (int k = 0; k < 17; ++k)
    many.push_back({.files = {"hollow.usda"}, .active = {{1, 0}}, .name = fmt::format("s{}", k)});
  NumberPairs zigzag;
  for (int k = 0; k < 2000; ++k) zigzag.push_back({k, k % 2 == 0 ? 0 : 4000});
  writeBytes(folder / "long.usda", clipText(counted(1, 1000), poses(counted(1, 1000))));
  const std::string set = "m.usd: /M: clip set 'default': ";
  for (
      const Case& c : {
          Case{files({"none.usda"}), set + (folder / "none.usda").string()},
          Case{files({"folder.usda"}), set + (folder / "folder.usda").string()},
          Case{files({"torn.usda"}), set + (folder / "torn.usda").string() + ": line"},
          Case{files({(outside / "good.usda").string()}),
               "is absolute; clips are read from the folder of the USD file"},
          Case{files({"../" + outside.filename().string() + "/good.usda"}),
               "leads out of the folder of the USD file"},
          Case{files({"link.usda"}), "by a symbolic link"},
          Case{files({"file:good.usda"}), "is an address"},
          Case{files({"hollow.usda"}),
               "/M: has no points, and neither has its clip " + (folder / "hollow.usda").string()},
          Case{files({"still.usda"}), "neither has its clip " + (folder / "still.usda").string()},
          Case{files({"good.usda", "hollow.usda"}),
               set + (folder / "hollow.usda").string() + ": there is no prim /M"},
          Case{files({"good.usda", "still.usda"}),
               set + (folder / "still.usda").string() + ": /M has no samples of points"},
          Case{files({"nan.usda"}), "is not finite"},
          Case{files({"fewer.usda"}), (folder / "fewer.usda").string() +
                                          ": /M: found 3 points at its time 2; expected 4, as in " +
                                          (folder / "fewer.usda").string()},
          Case{files({"good.usda", "three.usda"}),
               (folder / "three.usda").string() + ": /M: found 3 points at its time 1; expected 4, as in " +
                   (folder / "good.usda").string()},
          Case{files({"three.usda"}), "a triangle has the corner 3"},
          Case{files({"good.usda", "counts.usda"}),
               (folder / "counts.usda").string() +
                   ": /M: found 1 faceVertexCounts; expected 4, as in the file that names the clip"},
          Case{
              files({"good.usda", "turned.usda"}),
              (folder / "turned.usda").string() +
                  ": /M: found 1 as number 7 of faceVertexIndices; expected 2, as in the file that names the clip"},
          Case{active({{1, 2}}), "active has clip 2 at time 1; expected 0 to 1, of its 2 assetPaths"},
          Case{active({{1, -1}}), "active has clip -1"},
          Case{active({{1, 0.5}}), "active has clip 0.5"},
          Case{active({{1, 0}, {1, 1}}), "active has time 1 after 1; expected times that rise"},
          Case{active({{2, 0}, {1, 1}}), "active has time 1 after 2"},
          Case{active({}), set + "found none as active; expected pairs"},
          Case{clipTimes({{2, 1}, {1, 2}}), "times has time 1 after 2; expected times that rise"},
          Case{clipTimes({{2, 1}, {2, 2}, {2, 3}}), "times has time 2 three times"},
          Case{path("M"), "found 'M' as primPath; expected the path of a prim"},
          Case{path(""), "found '' as primPath"},
          Case{path("/M.points"), "found '/M.points' as primPath"},
          Case{path("/N"), "neither has its clip"},
          Case{lines(""), "found none as templateAssetPath; expected it, or assetPaths"},
          Case{lines(files2), "found none as active"},
          Case{lines(files2 + "      double2[] active = []\n"), "found no pairs as active"},
          Case{lines(files2 + "      double3[] active = [(1, 0, 0)]\n"),
               "found 1 times 3 numbers as active; expected pairs of numbers"},
          Case{lines(files2 + "      string active = \"1\"\n"), "found 1 texts as active"},
          Case{lines(files2 + "      dictionary active = { int a = 1 }\n"), "found a dictionary as active"},
          Case{lines("      double assetPaths = 3\n" + active2),
               "found 1 numbers as assetPaths; expected files"},
          Case{lines("      dictionary assetPaths = { }\n" + active2), "found a dictionary as assetPaths"},
          Case{lines(files2 + active2 + "      double times = 3\n"), "found 1 numbers as times"},
          Case{lines(files2 + active2 + "      double2[] times = [(1, inf)]\n"),
               "pair 1 of times is not finite"},
          Case{lines(files2 + active2 + "      string interpolateMissingClipValues = \"x\"\n"),
               "found 1 texts as interpolateMissingClipValues; expected a number"},
          Case{form({"gone.###.usd", 1, 3}),
               set + "found no file of " + (folder / "gone.###.usd").string() + ", from 1 to 3 by 1"},
          Case{form({"good.usda", 1, 3}),
               "found 'good.usda' as templateAssetPath; expected one group of '#'"},
          Case{form({"a.#.b.#.usda", 1, 3}), "expected one group of '#'"},
          Case{form({"a.#.#.#.usda", 1, 3}), "expected one group of '#'"},
          Case{form({"/a.#.usda", 1, 3}), "is absolute"},
          Case{form({"../a.#.usda", 1, 3}), "leads out of the folder"},
          Case{form({"a.#.usda", 3, 1}),
               "its template goes from 3 to 1 by 1; expected an end that is no earlier"},
          Case{form({"a.#.usda", 1, 3, 0}), "by 0; expected an end"},
          Case{form({"a.#.usda", 1, 3, -1}), "by -1; expected an end"},
          Case{form({"a.#.usda", 0, 1e9, 0.001}), "times; expected at most 100000"},
          Case{form({"a.#.usda", -1e12, 1, 1}), "as templateStartTime; expected at most"},
          Case{form({"a.#.usda", 1, 3, 1, 1.5}),
               "found 1.5 as templateActiveOffset; expected at most 1 either way"},
          Case{lines("      string templateAssetPath = \"a.#.usda\"\n"),
               "found none as templateStartTime; expected a number"},
          Case{clippedText(kTriangles, kFps, "( clips = { double default = 3 } )"),
               "clip set 'default': found no dictionary of it"},
          Case{clippedText(kTriangles, kFps, clipsText(many)),
               "m.usd: /M: 17 clip sets hold for /M; expected at most 16"},
          Case{of([&](SampleClipSet& s) {
                 s = {.files = {"long.usda"}, .active = {{0, 0}}, .times = zigzag};
               }),
               "its times come to more"},
      }) {
    const std::string problem = problemIn(folder, c.layer);
    EXPECT_NE(problem.find(c.message), std::string::npos) << problem << "\nexpected: " << c.message;
    EXPECT_NE(problem.find(folder.string()), std::string::npos) << problem;
  }
}

// Of crates, whose values have types of their own.
TEST(UsdClips, SayWhatCratesCannotHave) {
  const auto folder = scratchFolder("usd_clips_crates");
  writeBytes(folder / "good.usda", clipText({1, 2}, poses({1, 2})));
  using Entries = std::map<std::string, std::function<CrateBytes::Rep(CrateBytes&)>>;
  const Entries good{{"primPath", [](CrateBytes& crate) { return crate.string("/M"); }},
                     {"assetPaths", [](CrateBytes& crate) { return crate.assets({"good.usda"}); }},
                     {"active", [](CrateBytes& crate) {
                        return crate.array<double>(19, {1, 0}, 2);
                      }}};
  const auto problemOf = [&](const Entries& entries) {
    CrateBytes crate;
    for (const char* name : {"M", "faceVertexCounts", "faceVertexIndices"}) crate.name(name);
    CrateBytes::Fields fields;
    for (const auto& [name, made] : entries) fields.push_back({name, made(crate)});
    crate.addRoot({"M"});
    const auto set = crate.dictionary(fields);
    crate.addPrim("/M", "Mesh", {}, {{"clips", crate.dictionary({{"default", set}})}});
    crate.addAttribute("/M.faceVertexCounts", crate.integers({3}));
    crate.addAttribute("/M.faceVertexIndices", crate.integers({0, 1, 2}));
    return problemIn(folder, crate.bytes());
  };
  ASSERT_EQ(problemOf(good), "");
  struct Case {
    const char* name;
    std::function<CrateBytes::Rep(CrateBytes&)> made;
    const char* message;
  };
  for (const Case& c : {
           Case{"active",
                [](CrateBytes& crate) {
                  return crate.array<double>(23, {1, 0, 0}, 3);
                },
                "found 1 times 3 numbers as active"},
           Case{"active", [](CrateBytes& crate) { return crate.token("x"); }, "found 1 texts as active"},
           Case{"active", [](CrateBytes& crate) { return crate.dictionary({}); },
                "found a dictionary as active"},
           Case{"active", [](CrateBytes& crate) { return crate.samples({1}, {crate.flag(true)}); },
                "found no pairs as active; expected one or more"},
           Case{"assetPaths", [](CrateBytes& crate) { return crate.flag(true); },
                "found 1 numbers as assetPaths"},
           Case{"primPath",
                [](CrateBytes& crate) {
                  return crate.array<double>(9, {1, 2});
                },
                "found 2 numbers as primPath"},
       }) {
    Entries changed = good;
    changed[c.name] = c.made;
    EXPECT_NE(problemOf(changed).find(c.message), std::string::npos)
        << problemOf(changed) << "\nexpected: " << c.message;
  }
}

// Bytes alone, and packages, have no files beside them.
TEST(UsdClips, AreRefusedWhereThereAreNoFiles) {
  const std::string layer =
      clippedText(kTriangles, kFps, clipsText({{.files = {"a.usda"}, .active = {{1, 0}}}}));
  const auto mesh = readUsdMesh(std::as_bytes(std::span(layer)), "m.usda");
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("m.usda: /M: has value clips"), std::string::npos)
      << mesh.error().message;
  const auto folder = scratchFolder("usd_clips_package");
  writeBytes(folder / "a.usda", clipText({1, 2}, poses({1, 2})));
  EXPECT_EQ(problemIn(folder, layer), "");
  EXPECT_NE(problemIn(folder, ZipBytes{.content = layer}.bytes()).find("/M: has value clips"),
            std::string::npos);
}

// A layer and its clip without a disk.
class OneClip final : public UsdClipFiles {
 public:
  explicit OneClip(const std::string& bytes) : bytes_(bytes) {}
  Status check(const std::string&) const override { return {}; }
  std::string pathOf(const std::string& name) const override { return name; }
  bool has(const std::string& name) const override { return name.size() < 9; }
  Result<std::vector<std::byte>> read(const std::string&) const override {
    const auto bytes = std::as_bytes(std::span(bytes_));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  }

 private:
  const std::string& bytes_;
};

// Every changed byte of either file is read or refused, whole.
TEST(UsdClips, SurviveBrokenFiles) {
  const SampleClipSet set{
      .files = {"a", "b"}, .active = {{1, 0}, {3, 1}}, .times = {{1, 1}, {2, 2}, {2, 1}, {9, 3}}},
      form{.form = SampleTemplate{"a.#", 1, 3, 0.5, 0.25}};
  const std::string clips[] = {clipText({1, 2, 3}, poses({1, 2, 3})), clipCrate({1, 2, 3}, poses({1, 2, 3}))};
  std::size_t readCount = 0, triedCount = 0;
  const auto tryBoth = [&](const std::string& layer, const std::string& clip) {
    const OneClip files(clip);
    const auto mesh = readUsdMesh(std::as_bytes(std::span(layer)), "m.usd", {.clips = &files});
    ++triedCount;
    if (!mesh) return;
    ++readCount;
    for (const double t : {(*mesh)->firstSeconds(), 0.07, (*mesh)->lastSeconds()})
      ASSERT_EQ((*mesh)->pointsAt(t).size(), (*mesh)->pointCount());
  };
  for (const std::string& layer :
       {clippedText(kTriangles, kFps, clipsText({set})), clippedCrate(kTriangles, kFps, {set}),
        clippedText(kTriangles, kFps, clipsText({form}))}) {
    for (const std::string& clip : clips) {
      for (const bool breaksClip : {false, true}) {
        const std::string& whole = breaksClip ? clip : layer;
        for (std::size_t at = 0; at < whole.size(); ++at) {
          for (const char flip : {'\x01', '\x08', '\xff'}) {
            std::string broken = whole;
            broken[at] = static_cast<char>(broken[at] ^ flip);
            ASSERT_NO_FATAL_FAILURE(tryBoth(breaksClip ? layer : broken, breaksClip ? broken : clip));
          }
        }
      }
    }
  }
  std::printf("%zu of %zu changed files could be read\n", readCount, triedCount);
  EXPECT_GT(readCount, 100u);
}

TEST(UsdClips, NameTheirFiles) {
  const auto folder = scratchFolder("usd_clips_names");
  fs::create_directory(folder / "c");
  for (const char* name : {"c/t.1.usd", "c/t.3.usd", "c/t.4.usd"}) writeBytes(folder / name, "x");
  const SampleClipSet stated{.files = {"b.usda", "./c/../a.usda", "b.usda"}, .active = {{1, 0}}, .name = "s"},
      made{.form = SampleTemplate{"c/t.#.usd", 1, 3}, .name = "t"},
      broken{.files = {"../x.usda"}, .active = {{1, 0}}};
  const std::vector<fs::path> expected{folder / "a.usda", folder / "b.usda", folder / "c/t.1.usd",
                                       folder / "c/t.3.usd"};
  writeBytes(folder / "m.usd", clippedText(kTriangles, kFps, clipsText({stated, made})));
  EXPECT_EQ(usdClipFilesOf(folder / "m.usd"), expected);
  writeBytes(folder / "m.usd", clippedCrate(kTriangles, kFps, {stated, made}));
  EXPECT_EQ(usdClipFilesOf(folder / "m.usd"), expected);
  for (const std::string& layer : {clippedText(kTriangles, kFps, clipsText({broken})),
                                   usdaText(kTriangles, poses({1}), kFps), std::string("x")}) {
    writeBytes(folder / "m.usd", layer);
    EXPECT_TRUE(usdClipFilesOf(folder / "m.usd").empty());
  }
  EXPECT_TRUE(usdClipFilesOf(folder / "none.usd").empty());
}

}  // namespace
}  // namespace ringlet::test::usd_clips_test
