// A session: hair that is stepped as a run would step it, while its numbers change and its head is dragged.
#include "view/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <optional>

#include "ringlet/gpu/recorder.h"
#include "ringlet/pictures/hair_ground.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"
#include "view/hair_pane.h"
#include "view/mouse_control.h"

namespace ringlet::view::session_test {
namespace {

struct Scene {
  SceneFile file;
  std::optional<LoadedScene> loaded;
};

Scene sceneOf(const char* motion = "shake", const std::string& more = "") {
  Scene scene;
  const auto file =
      parseScene(std::string("[groom]\ngenerate = \"head\"\nstrands = 12\nparticles = 16\nturns = 2\n"
                             "[motion]\nkind = \"") +
                     motion +
                     "\"\n[[body]]\nshape = \"sphere\"\nradius = 0.03\nposition = [0.3, 0, 0]\n"
                     "moves = \"still\"\n" +
                     more,
                 "scene");
  EXPECT_TRUE(file) << file.error().message;
  scene.file = *file;
  auto loaded = loadScene(scene.file);
  EXPECT_TRUE(loaded) << loaded.error().message;
  scene.loaded = std::move(*loaded);
  return scene;
}

class SessionTest : public test::GpuTest {
 protected:
  Session make(const Scene& scene) {
    auto session = Session::create(device(), scene.file, *scene.loaded);
    EXPECT_TRUE(session) << session.error().message;
    return std::move(*session);
  }
  static std::vector<Vec3f> run(Session& session, int frames, std::size_t hair = 0) {
    for (int k = 0; k < frames; ++k) {
      EXPECT_TRUE(session.submitFrame());
      EXPECT_TRUE(session.waitFrame());
    }
    return *session.hairs()[hair].simulation().positions();
  }
};

TEST_F(SessionTest, StepsAsARunOfTheSceneDoes) {
  const Scene scene = sceneOf();
  Session session = make(scene);
  const auto found = run(session, 6);
  const LoadedScene& loaded = *scene.loaded;
  const double step = loaded.settings.stepSeconds();
  auto expected = Simulation::create(device(), loaded.groom, loaded.material, loaded.settings,
                                     {.head = loaded.motion.poseAt(0),
                                      .oneStepEarlier = loaded.motion.poseAt(-step),
                                      .bodies = loaded.bodies});
  ASSERT_TRUE(expected) << expected.error().message;
  for (int frame = 0; frame < 6; ++frame) {
    std::vector<HeadPose> poses;
    std::vector<double> times;
    for (int k = 1; k <= loaded.settings.stepsPerFrame; ++k) {
      times.push_back((frame * loaded.settings.stepsPerFrame + k) * step);
      poses.push_back(loaded.motion.poseAt(times.back()));
    }
    ASSERT_TRUE(expected->stepFrame(poses, bodyPosesOf(loaded.bodies, poses, times)));
  }
  const auto positions = *expected->positions();
  ASSERT_EQ(found.size(), positions.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_LT(length(found[i] - positions[i]), 1e-5) << i;
  EXPECT_EQ(session.frame(), 6u);
  EXPECT_NEAR(session.seconds(), 6 / 24.0, 1e-12);
}

// Numbers over time: wind that comes, hair that becomes heavier, a field; and after an edit beside them.
TEST_F(SessionTest, KeysAreThoseOfARun) {
  const Scene scene = sceneOf("still",
                              "[[field]]\nname = \"fan\"\nkind = \"uniform\"\naxis = [1, 0, 0]\n"
                              "[[key]]\ntime = 0\nair.wind = [0, 0, 0]\nfield.fan.strength = 0\n"
                              "material.dials.weight = 1\n"
                              "[[key]]\ntime = 0.2\nair.wind = [3, 0, 0]\nfield.fan.strength = 4\n"
                              "material.dials.weight = 2\n");
  const LoadedScene& loaded = *scene.loaded;
  Session session = make(scene);
  const auto found = run(session, 8);
  KernelChoice kernel;
  kernel.features.fields = true;
  auto expected = Simulation::create(device(), loaded.groom, loaded.material, loaded.settings,
                                     {.bodies = loaded.bodies}, kernel);
  ASSERT_TRUE(expected) << expected.error().message;
  const auto steps = static_cast<std::size_t>(loaded.settings.stepsPerFrame);
  for (int frame = 0; frame < 8; ++frame) {
    const auto numbers = loaded.keys->at((frame + 1) / 24.0, loaded.settings.stepsPerFrame);
    ASSERT_TRUE(numbers && expected->setSettings(numbers->settings) &&
                expected->setMaterial(numbers->material));
    const double begin = frame / 24.0, end = (frame + 1) / 24.0;
    const auto forces =
        loaded.forces.inFrame({begin, loaded.motion.poseAt(begin)}, {end, loaded.motion.poseAt(end)},
                              loaded.settings.goal, &*loaded.keys);
    ASSERT_TRUE(forces && forces->set(*expected));
    ASSERT_TRUE(expected->stepFrame(std::vector<HeadPose>(steps)));
  }
  const auto positions = *expected->positions();
  EXPECT_EQ(found, positions) << "the same bits";
  EXPECT_NEAR(session.hairs()[0].numbers().settings.air.wind.x, 3, 1e-9);

  ASSERT_TRUE(session.reset());
  Edits edits = editsOf(scene.file);
  edits.materials[0].dials.hold = 2;
  ASSERT_TRUE(session.setEdits(edits));
  run(session, 8);
  EXPECT_NEAR(session.hairs()[0].numbers().settings.air.wind.x, 3, 1e-9);
  EXPECT_NEAR(session.hairs()[0].numbers().material.gravityFactor, 2, 1e-9);
  EXPECT_GT(session.hairs()[0].numbers().material.bendStiffness, 1.9 * loaded.material.bendStiffness);
}

TEST_F(SessionTest, ResetBringsTheBeginningBack) {
  const Scene scene = sceneOf();
  Session session = make(scene);
  const auto first = run(session, 4);
  session.headDrag.move({0.1, 0, 0});
  session.bodyDrags[0].move({0, 0.1, 0});
  EXPECT_NE(run(session, 4), first);
  ASSERT_TRUE(session.reset());
  EXPECT_EQ(session.frame(), 0u);
  EXPECT_EQ(run(session, 4), first) << "the same bits";
  EXPECT_EQ(session.bodies()[0].position.y, 0);
}

TEST_F(SessionTest, WhatIsLiveActsAtOnceAndAllElseWhereTheHairIs) {
  const Scene scene = sceneOf("still");
  Session session = make(scene);
  const auto before = run(session, 3);
  Edits edits = editsOf(scene.file);
  edits.simulation.stepsPerFrame = scene.loaded->settings.stepsPerFrame;
  edits.simulation.gravity = 3;
  edits.materials[0].dials.hold = 2;
  auto changed = session.setEdits(edits);
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_FALSE(*changed) << "the same buffers";
  EXPECT_EQ(session.hairs()[0].simulation().settings().gravity.y, -3);
  EXPECT_EQ(session.hairs()[0].simulation().material().bendStiffness,
            2 * scene.loaded->material.bendStiffness);

  edits.air.on = true;
  edits.air.wind = {8, 0, 0};
  changed = session.setEdits(edits);
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_TRUE(*changed) << "built anew";
  EXPECT_EQ(*session.hairs()[0].simulation().positions(), before) << "where it was";
  double moved = 0;
  const auto after = run(session, 10);
  for (std::size_t i = 0; i < after.size(); ++i)
    moved += (after[i] - before[i]).x / static_cast<double>(after.size());
  EXPECT_GT(moved, 0.002) << "with the wind [m]";

  edits.materials[0].material.coreElongationLow = 2;
  edits.materials[0].material.coreElongationHigh = 1.5;
  EXPECT_FALSE(session.setEdits(edits));
  EXPECT_EQ(run(session, 1).size(), before.size()) << "goes on as it was";
}

TEST_F(SessionTest, BBeginsWhereAIs) {
  const Scene scene = sceneOf();
  Session session = make(scene);
  const auto before = run(session, 3);
  Edits edits = editsOf(scene.file);
  edits.compares = true;
  edits.materials[1].dials.hold = 5;
  const auto changed = session.setEdits(edits);
  ASSERT_TRUE(changed) << changed.error().message;
  ASSERT_EQ(session.hairs().size(), 2u);
  EXPECT_EQ(*session.hairs()[1].simulation().positions(), before);
  const auto a = run(session, 4);
  EXPECT_NE(*session.hairs()[1].simulation().positions(), a);
  edits.compares = false;
  ASSERT_TRUE(session.setEdits(edits));
  EXPECT_EQ(session.hairs().size(), 1u);
}

// With the same numbers B goes as A does, on a head that is fast.
TEST_F(SessionTest, BOfTheSameNumbersHasTheBitsOfA) {
  const Scene scene = sceneOf("shake", "[simulation]\nsteps_per_frame = 6\n");
  Session session = make(scene);
  (void)run(session, 3);
  Edits edits = editsOf(scene.file);
  edits.compares = true;
  ASSERT_TRUE(session.setEdits(edits));
  ASSERT_EQ(session.hairs().size(), 2u);
  for (int frame = 0; frame < 3; ++frame) {
    const auto a = run(session, 1);
    EXPECT_EQ(*session.hairs()[1].simulation().positions(), a) << frame;
  }
}

// Either may be built anew by itself, which is told of both.
TEST_F(SessionTest, BuffersAreOthersWhicheverHairIsBuiltAnew) {
  const Scene scene = sceneOf("still");
  Session session = make(scene);
  Edits edits = editsOf(scene.file);
  edits.compares = true;
  ASSERT_TRUE(session.setEdits(edits));
  for (EditedMaterial& material : edits.materials) {
    material.material.lineDensity *= 2;
    const auto changed = session.setEdits(edits);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_TRUE(*changed);
  }
  edits.materials[0].dials.hold = 1.5;
  EXPECT_FALSE(*session.setEdits(edits)) << "live";
}

// Hair that is built anew is cut where it was, and B as A is; a reset makes it whole.
TEST_F(SessionTest, CutsAreMadeAndStay) {
  const Scene scene = sceneOf("still", "[[cut]]\ntime = 0.1\nat = 0.5\n");
  ASSERT_EQ(scene.loaded->cuts.size(), 1u);
  const StrandCut cut = scene.loaded->cuts[0].cuts[0];
  const std::size_t next = scene.loaded->groom.firstPoint[cut.strand] + cut.keep;
  const Groom& groom = scene.loaded->groom;
  const float whole =
      length(groom.points[next] - groom.points[next - 1]) * static_cast<float>(groom.metresPerUnit);
  const auto gap = [&](const std::vector<Vec3f>& points) {
    return length(points[next] - points[next - 1]) / whole;
  };
  Session session = make(scene);
  EXPECT_LT(gap(run(session, 3)), 1.2) << "not yet";
  const auto apart = gap(run(session, 6));
  EXPECT_GT(apart, 2) << "it falls";
  EXPECT_EQ(session.cutCount(), 1u);
  ASSERT_EQ(session.cutBeyond().size(), groom.strandCount());
  EXPECT_EQ(session.cutBeyond()[0], next - 1);
  Edits edits = editsOf(scene.file);
  edits.air.on = true;
  edits.compares = true;
  const auto changed = session.setEdits(edits);
  ASSERT_TRUE(changed && *changed) << "built anew";
  EXPECT_GT(gap(run(session, 4)), 1.5 * apart) << "and goes on falling";
  EXPECT_GT(gap(*session.hairs()[1].simulation().positions()), 1.5 * apart);
  ASSERT_TRUE(session.reset());
  EXPECT_LT(gap(run(session, 3)), 1.2);
}

TEST_F(SessionTest, APreRollIsOverAsItBegins) {
  const Scene scene = sceneOf("shake\"\npre_roll = 0.2\n# \"");
  ASSERT_EQ(scene.loaded->preRollSeconds, 0.2);
  Session session = make(scene);
  EXPECT_EQ(session.frame(), 0u);
  EXPECT_EQ(session.seconds(), 0);
  EXPECT_EQ(session.head().position, scene.loaded->motion.poseAt(0).position);
  Scene plain = sceneOf();
  Session other = make(plain);
  const auto moved = *session.hairs()[0].simulation().positions();
  EXPECT_NE(moved, *other.hairs()[0].simulation().positions()) << "the head has moved before";
  const auto first = run(session, 3);
  ASSERT_TRUE(session.reset());
  EXPECT_EQ(session.frame(), 0u);
  EXPECT_EQ(*session.hairs()[0].simulation().positions(), moved);
  EXPECT_EQ(run(session, 3), first);
}

// Time goes on where frames a second change, and does not drift.
TEST_F(SessionTest, TimeIsAQuotient) {
  const Scene scene = sceneOf();
  Session session = make(scene);
  (void)run(session, 7);
  EXPECT_EQ(session.seconds(), 7 / 24.0);
  Edits edits = editsOf(scene.file);
  edits.simulation.framesPerSecond = 48;
  ASSERT_TRUE(session.setEdits(edits));
  EXPECT_EQ(session.seconds(), 7 / 24.0);
  (void)run(session, 5);
  EXPECT_EQ(session.seconds(), 7 / 24.0 + 5 / 48.0);
  EXPECT_EQ(session.head().position, scene.loaded->motion.poseAt(7 / 24.0 + 5 / 48.0).position);
}

// Edits are numbers; which strands do not touch each other is kept when hair is built anew.
TEST_F(SessionTest, ListsOfStrandsStay) {
  const Scene scene = sceneOf(
      "still", "[contacts]\non = true\n[[group]]\nname = \"bun\"\nstrands = \"0:3\"\ntouch = false\n");
  ASSERT_TRUE(scene.loaded->settings.contacts.bundles);
  Session session = make(scene);
  Edits edits = editsOf(scene.file);
  edits.air.on = true;
  const auto changed = session.setEdits(edits);
  ASSERT_TRUE(changed && *changed);
  EXPECT_EQ(session.hairs()[0].simulation().settings().contacts.bundles,
            scene.loaded->settings.contacts.bundles);
}

TEST_F(SessionTest, TheMouseTakesTheHeadAndBodiesAlong) {
  const Scene scene = sceneOf("still");
  Session session = make(scene);
  const std::vector<Vec3d> points{{-0.3, -0.3, 0}, {0.4, 0.3, 0}};
  OrbitCamera camera(points, {0, 1, 0}, 1.5);
  SolidMesh ball;  // one triangle across the view, where the body is
  const CameraAxes axes = axesOf(camera.camera());
  ball.points = {axes.right * -0.05 - axes.up * 0.05, axes.right * 0.05 - axes.up * 0.05, axes.up * 0.05};
  ball.triangles = {{0, 1, 2}};
  const std::vector<SolidMesh> solids{ball};
  const std::vector<std::optional<std::size_t>> bodyOf{0};
  const MousePicture picture{.width = 600, .height = 400};
  MouseControl mouse;
  const auto drag = [&](double x, double y, double right) {
    const std::vector<SolidPlace> places{{session.bodies()[0].position, {}}};
    const MouseSolids seen{.solids = solids, .places = places, .bodyOf = bodyOf};
    Mouse now{.x = x, .y = y, .left = true, .isOverPicture = true, .control = true};
    mouse.update(now, picture, seen, camera, session);
    const std::string what = mouse.dragged();
    now.movedRight = right;
    mouse.update(now, picture, seen, camera, session);
    mouse.update(Mouse{}, picture, seen, camera, session);
    return what;
  };
  const Vec3d before = session.bodies()[0].position;
  const auto at = *camera.project(before, 600, 400);
  EXPECT_EQ(drag(at.x, at.y, 50), "body 1");
  EXPECT_EQ(drag(3, 3, 20), "head") << "where nothing is hit";
  (void)run(session, 30);
  const auto moved = *camera.project(session.bodies()[0].position, 600, 400);
  EXPECT_NEAR(moved.x, at.x + 50, 0.5);
  EXPECT_NEAR(moved.y, at.y, 0.5);
  EXPECT_NEAR(camera.project(session.head().position, 600, 400)->x - camera.project({}, 600, 400)->x, 20,
              0.5);
}

// What is drawn is where the solver has it: a pane of hair on a head that is elsewhere.
TEST_F(SessionTest, PanesDrawTheHairThatIsSimulated) {
  const Scene scene = sceneOf("still");
  Session session = make(scene);
  PaneLook look;
  look.size = {
      .width = 120, .height = 80, .side = 2, .shadowCells = 32, .shadowSlices = 16, .densityCells = 8};
  look.width = 0.004;
  auto pane = HairPane::create(gpu(), scene.loaded->groom, look);
  ASSERT_TRUE(pane) << pane.error().message;
  const auto draw = [&](const Camera& camera) {
    EXPECT_TRUE(pane->attach(gpu(), session.hairs()[0].simulation()));
    EXPECT_TRUE(pane->setFrame(camera, session.head(), {}, {}));
    auto recorder = gpu::Recorder::create(gpu(), "pane");
    EXPECT_TRUE(recorder->begin());
    pane->record(*recorder, session.head().rotation);
    EXPECT_TRUE(recorder->submitAndWait());
    pane->finish();
    std::vector<std::uint32_t> pixels(120 * 80);
    EXPECT_TRUE(pane->shown().download(std::as_writable_bytes(std::span(pixels))));
    return pixels;
  };
  Camera camera{.eye = {0, -0.1, 1}, .target = {0, -0.1, 0}};
  const auto still = draw(camera);
  session.headDrag.move({0.5, 0.25, 0});
  (void)run(session, 150);
  camera.eye += Vec3d{0.5, 0.25, 0};
  camera.target += Vec3d{0.5, 0.25, 0};
  const auto moved = draw(camera);
  // Hair is far redder than what is behind it.
  const auto isHair = [](std::uint32_t p) { return (p & 255) > (p >> 16 & 255) + 40; };
  const auto shared = [&](const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    double both = 0, any = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      both += isHair(a[i]) && isHair(b[i]), any += isHair(a[i]) || isHair(b[i]);
    EXPECT_GT(any, 100);
    return both / any;
  };
  EXPECT_GT(shared(still, moved), 0.5) << "a camera that went along sees much the same";
  EXPECT_LT(shared(still, draw({.eye = {0, -0.1, 1}, .target = {0, -0.1, 0}})), 0.2)
      << "one that stayed does not";
}

// On a scalp that bends, whose head is dragged: the roots are where the solver has them, and hairs follow
// there.
// Three strands on a strip that bends.
Scene stripScene() {
  const auto folder = test::scratchFolder("session_scalp");
  std::ofstream(folder / "strip.glb", std::ios::binary) << test::bendingStrip(8, 5121, 5126).glb();
  std::ofstream obj(folder / "groom.obj");
  for (const double x : {0.125, 0.625, 1.625})
    for (int k = 0; k < 5; ++k) obj << "v " << x << " " << -0.025 * k << " -0.05\n";
  obj << "l 1 2 3 4 5\nl 6 7 8 9 10\nl 11 12 13 14 15\n";
  obj.close();
  Scene scene;
  scene.file =
      *parseScene("[groom]\nfile = 'groom.obj'\nunit = 1\n[scalp]\nfile = 'strip.glb'\n", "scene", folder);
  scene.loaded = std::move(*loadScene(scene.file));
  return scene;
}

// How many of the places have hair, which is far redder than what is behind it, at most a pixel beside
// them.
double shareWithHair(const std::vector<Vec3d>& places, const Camera& camera,
                     const std::vector<std::uint32_t>& pixels) {
  double count = 0;
  for (const Vec3d& place : places) {
    const Vec3d way = place - camera.eye;
    const double perPixel = -way.z * std::tan(camera.fieldOfView / 2) / 40;
    const int left = static_cast<int>(60 + way.x / perPixel), top = static_cast<int>(40 - way.y / perPixel);
    bool isThere = false;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const std::uint32_t p = pixels.at(static_cast<std::size_t>((top + y) * 120 + left + x));
        isThere = isThere || (p & 255) > (p >> 16 & 255) + 40;
      }
    count += isThere;
  }
  return count / static_cast<double>(places.size());
}

TEST_F(SessionTest, HairsOnAScalpStandWhereItHasTheirRoots) {
  const Scene scene = stripScene();
  const LoadedScene& loaded = *scene.loaded;
  Session session = make(scene);
  session.headDrag.move({0.1, 0.05, 0});
  const std::vector<Vec3f> positions = run(session, 12);
  const std::vector<Vec3d> strandRoots = session.strandRoots();
  ASSERT_EQ(strandRoots.size(), 3u);
  double bent = 0;
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_LT(length(session.head().position + Vec3d(positions[5 * s]) - strandRoots[s]), 1e-5) << s;
    const Vec3d carried = session.head().position + Vec3d(loaded.groom.strand(s).front());
    bent = std::max(bent, length(strandRoots[s] - carried));
  }
  EXPECT_GT(bent, 0.01);
  EXPECT_TRUE(make(sceneOf()).strandRoots().empty());

  PaneLook look;
  look.size = {
      .width = 120, .height = 80, .side = 2, .shadowCells = 32, .shadowSlices = 16, .densityCells = 8};
  look.width = 0.004;
  auto follow = FollowPlan::make(loaded.groom, 1, {.hairCount = 300}, *hairGroundOf(loaded, {}));
  ASSERT_TRUE(follow) << follow.error().message;
  EXPECT_TRUE(follow->isOnScalp());
  look.follow = std::make_shared<const FollowPlan>(std::move(*follow));
  auto pane = HairPane::create(gpu(), loaded.groom, look);
  ASSERT_TRUE(pane) << pane.error().message;
  ASSERT_TRUE(pane->attach(gpu(), session.hairs()[0].simulation()));
  const Vec3d middle = (strandRoots[0] + strandRoots[1] + strandRoots[2]) / 3;
  const Camera camera{.eye = middle + Vec3d{0, 0, 4}, .target = middle};
  const std::vector<Vec3d> roots = look.follow->rootsAt(session.seconds(), session.head());
  ASSERT_TRUE(pane->setFrame(camera, session.head(), {}, {.roots = roots, .strandRoots = strandRoots}));
  auto recorder = gpu::Recorder::create(gpu(), "pane");
  ASSERT_TRUE(recorder->begin());
  pane->record(*recorder, session.head().rotation);
  ASSERT_TRUE(recorder->submitAndWait());
  std::vector<std::uint32_t> pixels(120 * 80);
  ASSERT_TRUE(pane->shown().download(std::as_writable_bytes(std::span(pixels))));
  std::vector<Vec3d> carried;  // by the head
  for (const Vec3d& root : look.follow->restRoots()) carried.push_back(session.head().position + root);
  EXPECT_GT(shareWithHair(roots, camera, pixels), 0.9);
  EXPECT_LT(shareWithHair(carried, camera, pixels), 0.6);
}

}  // namespace
}  // namespace ringlet::view::session_test
