// Cuts of scenes: what a scene says of them, and with which frame each is made.
#include "ringlet/scenes/frames/scene_cuts.h"

#include <gtest/gtest.h>

#include <optional>

#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/file/scene_text.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/support/gpu_test.h"

namespace ringlet::scene_cuts_test {
namespace {

// Two straight strands of five particles.
const std::string kGroom =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 5\nturns = 0\nradius = 0.001\n"
    "length = 0.04\nspacing = 0.02\nvary_radius = 0\nvary_length = 0\nvary_phase = 0\n";

Result<std::vector<TimedCuts>> cutsIn(const std::string& text) {
  const auto scene = parseScene(kGroom + text, "scene.toml");
  if (!scene) return scene.error();
  auto loaded = loadScene(*scene);
  if (!loaded) return loaded.error();
  return std::move(loaded->cuts);
}
std::string errorOf(const std::string& text) {
  const auto cuts = cutsIn(text);
  return cuts ? "" : cuts.error().message;
}

TEST(SceneCuts, ParticlesBeyondTheirPlaceFall) {
  const auto cuts = cutsIn(
      "[[group]]\nname = \"right\"\nstrands = \"1\"\n"
      "[[cut]]\ntime = 2\nat = 0\nstrands = \"right\"\n"  // two particles stay
      "[[cut]]\ntime = 1\nat = 0.6\n"
      "[[cut]]\ntime = 1\nat = 0.8\n"                      // the shorter of two at a time
      "[[cut]]\ntime = 3\nat = 0.9\n"                      // nothing is left there
      "[[cut]]\ntime = 0\nat = 0.75\nstrands = \"0\"\n");  // where a particle is: it falls
  ASSERT_TRUE(cuts) << cuts.error().message;
  ASSERT_EQ(cuts->size(), 3u);
  EXPECT_EQ((*cuts)[0].seconds, 0);
  EXPECT_EQ((*cuts)[0].cuts, (std::vector<StrandCut>{{0, 3}}));
  EXPECT_EQ((*cuts)[1].seconds, 1);
  EXPECT_EQ((*cuts)[1].cuts, (std::vector<StrandCut>{{1, 3}}));  // strand 0 is as short
  EXPECT_EQ((*cuts)[2].seconds, 2);
  EXPECT_EQ((*cuts)[2].cuts, (std::vector<StrandCut>{{1, 2}}));
}

TEST(SceneCuts, AreMadeAsAFrameBegins) {
  LoadedScene scene;
  scene.cuts = {{-1, {}}, {0, {}}, {0.04, {}}, {0.25, {}}};
  const auto timesOf = [](std::span<const TimedCuts> cuts) {
    std::vector<double> times;
    for (const TimedCuts& now : cuts) times.push_back(now.seconds);
    return times;
  };
  using Times = std::vector<double>;
  for (const double preRoll : {0.0, 0.5}) {
    scene.preRollSeconds = preRoll;
    const SceneFrames frames(scene);
    EXPECT_EQ(timesOf(frames.cutsAt(frames.first())), preRoll > 0 ? Times{-1} : (Times{-1, 0}));
    if (preRoll > 0) {
      EXPECT_EQ(timesOf(frames.cutsAt(0)), Times{0});
    }
    EXPECT_EQ(timesOf(frames.cutsAt(1)), Times{0.04});  // 1/24 s
    EXPECT_EQ(timesOf(frames.cutsAt(5)), Times{});
    EXPECT_EQ(timesOf(frames.cutsAt(6)), Times{0.25});
    EXPECT_EQ(timesOf(frames.cutsAt(7)), Times{});
    EXPECT_EQ(timesOf(frames.cutsBefore(frames.first())), Times{});
    EXPECT_EQ(timesOf(frames.cutsBefore(6)), (Times{-1, 0, 0.04}));
    EXPECT_EQ(timesOf(frames.cutsBefore(7)), (Times{-1, 0, 0.04, 0.25}));
  }
}

TEST(SceneCuts, AreWrittenBack) {
  const auto scene =
      parseScene(kGroom + "[[cut]]\nname = \"off\"\nstrands = \"1\"\nat = 0.25\ntime = 1.5\n", "scene.toml");
  ASSERT_TRUE(scene);
  const auto again = parseScene(sceneText(*scene), "scene.toml");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->cuts, scene->cuts);
  EXPECT_EQ(scene->cuts, (std::vector<SceneCut>{{"off", "1", 0.25, 1.5}}));
}

TEST(SceneCuts, WhatIsWrongIsSaid) {
  const auto says = [](const std::string& text, const std::string& what) {
    const std::string error = errorOf(text);
    EXPECT_NE(error.find(what), std::string::npos) << error;
  };
  says("[[cut]]\nname = \"off\"\nstrands = \"2\"\n", "the cut off: it names strand 2; the groom has 2");
  says("[[cut]]\nstrands = \"bun\"\n", "cut.strands");
  says("[[cut]]\nat = 1.5\n", "cut.at");
  says("[[cut]]\n[simulation]\nintegrator = \"paper\"\n", "hair is cut with the integrator jacobi only");
}

class SceneCutsRun : public test::GpuTest {
 protected:
  // Of a scene from its first frame, its own cuts or, once at the start, those.
  std::vector<Vec3f> after(int frames, LoadedScene scene, const std::vector<StrandCut>* cuts = nullptr) {
    if (cuts) scene.cuts.clear();
    const auto asset = buildAsset(device(), scene);
    EXPECT_TRUE(asset) << asset.error().message;
    const SceneFrames all(scene);
    const ScenePlaces start = all.placesAt(all.first());
    auto hair = Simulation::create(*asset, stateOf(start, scene));
    EXPECT_TRUE(hair) << hair.error().message;
    if (cuts) {
      EXPECT_TRUE(hair->cut(*cuts));
    }
    for (int frame = all.first(); frame < frames; ++frame) EXPECT_TRUE(stepScene(all, *hair, frame));
    const auto positions = hair->positions();
    EXPECT_TRUE(positions);
    return *positions;
  }
};

// A cut of long ago is made with the first frame there is, that of a pre-roll too.
TEST_F(SceneCutsRun, WhatWasCutBeforeIsCutAtTheStart) {
  for (const char* motion : {"", "[motion]\nkind = \"still\"\npre_roll = 0.1\n"}) {
    const auto scene = parseScene(kGroom + motion + "[[cut]]\ntime = -9\nat = 0.5\nstrands = \"1\"\n", "s");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto loaded = loadScene(*scene);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->cuts.size(), 1u);
    const std::vector<StrandCut> none;
    const auto positions = after(2, *loaded);
    EXPECT_EQ(positions, after(2, *loaded, &loaded->cuts[0].cuts)) << motion;
    EXPECT_NE(positions, after(2, *loaded, &none)) << motion;
  }
}

}  // namespace
}  // namespace ringlet::scene_cuts_test
