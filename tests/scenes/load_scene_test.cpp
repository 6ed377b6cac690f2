// scenes/load/load_scene.h: everything a run of a scene file starts from. That whole runs have the bits of
// the command's is tests/python/test_scenes.py.
#include "ringlet/scenes/load/load_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/rest/rest_state.h"
#include "tests/bodies/body_samples.h"
#include "tests/motion/gltf_samples.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::load_scene_test {
namespace {

const std::string kCurl = "[groom]\ngenerate = \"curl\"\nparticles = 16\n";

LoadedScene loaded(const std::string& text) {
  const auto scene = parseScene(kCurl + text, "the scene");
  EXPECT_TRUE(scene) << scene.error().message;
  auto made = loadScene(*scene);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

TEST(LoadScene, FramesAreCountedSecondsOrTheLengthOfKeys) {
  EXPECT_EQ(loaded("").frameCount, 48);
  EXPECT_EQ(loaded("[simulation]\nframes = 7\n").frameCount, 7);
  EXPECT_EQ(loaded("[simulation]\nseconds = 0.5\nfps = 30\n").frameCount, 15);
  const std::string keys =
      "[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 2\nposition = [1, 0, 0]\n";
  EXPECT_EQ(loaded(keys + "[simulation]\nfps = 30\n").frameCount, 60);
  EXPECT_EQ(loaded(keys + "[simulation]\nframes = 3\n").frameCount, 3);
}

// Of 24 frames a second, a metre a frame: keys further apart than 24 m/s are jumps.
TEST(LoadScene, KeysFurtherApartThanAHeadGoesAreCut) {
  const std::string keys =
      "[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 1\nposition = [23, 0, 0]\n"
      "[[motion.key]]\ntime = 2\nposition = [48, 0, 0]\n";
  const auto cut = loaded(keys).motion.keyframes;
  EXPECT_EQ(cut->cutSpeed, 24);
  EXPECT_FALSE(cut->isCut(0));
  EXPECT_TRUE(cut->isCut(1));
  EXPECT_FALSE(loaded(keys + "[simulation]\nteleport_distance = 0\n").motion.keyframes->isCut(1));
}

TEST(LoadScene, DialsAreWorkedIn) {
  const std::string material = "[material]\nbend_stiffness = 4\n[material.dials]\nhold = 2\nweight = 0.25\n";
  EXPECT_EQ(loaded(material).material.bendStiffness, 8);
  EXPECT_EQ(loaded(material).material.gravityFactor, 0.25);
  const auto spoilt =
      loadScene(*parseScene(kCurl + "[material]\nbend_stiffness = 1e6\n[material.dials]\nhold = 2\n", "s"));
  ASSERT_FALSE(spoilt);
  EXPECT_NE(spoilt.error().message.find("with the dials worked in: hold 2"), std::string::npos)
      << spoilt.error().message;
}

// The curl asks for a step of some length: twice the frames, half the steps.
TEST(LoadScene, StepsAreChosenWhereTheyAreNotSaid) {
  EXPECT_EQ(loaded("[simulation]\nsteps_per_frame = 3\n").settings.stepsPerFrame, 3);
  const int steps = loaded("[simulation]\nfps = 24\n").settings.stepsPerFrame;
  EXPECT_GE(steps, 8);
  EXPECT_EQ(loaded("[simulation]\nfps = 12\n").settings.stepsPerFrame, 2 * steps);
}

// What is known of a groom is taken for it, unless its points move: bound to the world they do.
TEST(LoadScene, GeometryThatIsKnownIsNotMeasuredAgain) {
  const auto scene = parseScene(kCurl, "the scene");
  ASSERT_TRUE(scene);
  const auto groom = loadGroom(scene->groom);
  ASSERT_TRUE(groom);
  const auto measured = measureGeometry(groom->groom);
  ASSERT_TRUE(measured);
  const auto known = std::make_shared<const std::vector<StrandGeometry>>(*measured);
  EXPECT_EQ(loadScene(*scene, &*groom, known)->geometry, known);

  const auto bound = parseScene(kCurl + "bind = \"world\"\n[motion]\nkind = \"shake\"\n", "the scene");
  ASSERT_TRUE(bound) << bound.error().message;
  const auto moved = loadScene(*bound, &*groom, known);
  ASSERT_TRUE(moved) << moved.error().message;
  ASSERT_TRUE(moved->geometry);
  EXPECT_NE(moved->geometry, known);
}

TEST(LoadScene, BodiesAndWhatMovesThemAreThere) {
  const LoadedScene scene = loaded(
      "[motion]\nkind = \"shake\"\npre_roll = 0.5\nstart = [1, 2, 3]\n[motion.roots]\nshift = [0.1, 0, 0]\n"
      "[[body]]\nshape = \"sphere\"\nmoves = { kind = \"nod\" }\n");
  ASSERT_EQ(scene.bodies.size(), 1u);
  ASSERT_TRUE(scene.bodies[0].motion);
  EXPECT_EQ(scene.bodies[0].motion->kind, MotionKind::nod);
  EXPECT_EQ(scene.preRollSeconds, 0.5);
  EXPECT_EQ(scene.motion.start, (Vec3d{1, 2, 3}));
  EXPECT_EQ(scene.rootShifts, (std::vector<Vec3d>{{0.1, 0, 0}}));
  EXPECT_FALSE(scene.scalp);
}

// A glTF file has Y up: its body stands in a scene that is Z up, too.
TEST(LoadScene, GltfBodiesStandWhateverIsUp) {
  const auto folder = test::scratchFolder("load_scene_gltf_body");
  std::vector<double> points;  // a post of 0.4 m along Y, 0.1 m thick, from its foot
  for (const double y : {0.0, 0.4})
    for (const double z : {-0.05, 0.05})
      for (const double x : {-0.05, 0.05}) points.insert(points.end(), {x, y, z});
  test::GltfBuilder file;
  const std::vector<std::uint16_t> triangles{0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                                             2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  file.root["meshes"] = {{{"primitives",
                           {{{"attributes", {{"POSITION", file.floats(points, "VEC3")}}},
                             {"indices", file.accessor(triangles, "SCALAR", 5123)}}}}}};
  file.node({{"name", "post"}, {"mesh", 0}});
  std::ofstream(folder / "post.gltf") << file.text();
  for (const bool upIsZ : {false, true}) {
    const auto scene =
        parseScene(fmt::format("{}up = \"{}\"\n[[body]]\nshape = \"mesh\"\nfile = \"post.gltf\"\n", kCurl,
                               upIsZ ? "Z" : "Y"),
                   "the scene", folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto made = loadScene(*scene);
    ASSERT_TRUE(made) << made.error().message;
    const Vec3d up = upIsZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    EXPECT_LT(distanceTo(made->bodies[0], up * 0.3), -0.02);
    EXPECT_GT(distanceTo(made->bodies[0], up * -0.1), 0.05);
  }
}

// A closed box of USD, with a wall beside it: one is named, by name or path, in the file's unit, turned up.
TEST(LoadScene, UsdBodiesAreNamedMeshes) {
  const auto folder = test::scratchFolder("load_scene_usd_body");
  std::vector<Vec3d> corners;
  for (const double y : {0.0, 40.0})
    for (const double z : {-5.0, 5.0})
      for (const double x : {-5.0, 5.0}) corners.push_back({x, y, z});
  const auto prim = [&](const char* name, double shift) {
    std::vector<Vec3d> points = corners;
    for (Vec3d& p : points) p.x += shift;
    return fmt::format(
        "def Mesh \"{}\"\n{{\n  point3f[] points = {}\n  int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]\n"
        "  int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]\n"
        "  uniform token subdivisionScheme = \"none\"\n}}\n",
        name, test::usdTuples(points));
  };
  std::ofstream(folder / "posts.usda") << "#usda 1.0\n(\n  metersPerUnit = 0.01\n  upAxis = \"Y\"\n)\n"
                                       << prim("Post", 0) << prim("Wall", 100);
  const std::string body = "[[body]]\nshape = \"mesh\"\nfile = \"posts.usda\"\n";
  for (const char* name : {"Post", "/Post", "Wall"}) {
    for (const char* up : {"Y", "Z"}) {
      const auto scene = parseScene(fmt::format("{}up = \"{}\"\n{}mesh = \"{}\"\n", kCurl, up, body, name),
                                    "the scene", folder);
      ASSERT_TRUE(scene) << scene.error().message;
      const auto made = loadScene(*scene);
      ASSERT_TRUE(made) << made.error().message;
      const Vec3d upward = *up == 'Z' ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
      const Vec3d at{std::string(name) == "Wall" ? 1.0 : 0, 0, 0};
      EXPECT_LT(distanceTo(made->bodies[0], at + upward * 0.3), -0.02) << name;
      EXPECT_GT(distanceTo(made->bodies[0], at - upward * 0.1), 0.05) << name;
    }
  }
  const auto unnamed = parseScene(kCurl + body, "the scene", folder);
  ASSERT_TRUE(unnamed);
  const auto refused = loadScene(*unnamed);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("/Post, /Wall"), std::string::npos) << refused.error().message;
}

// Alembic states neither unit nor axis: the groom's count, or the key's.
TEST(LoadScene, AlembicBodiesAreInTheGroomsUnitAndAxes) {
  const auto folder = test::scratchFolder("load_scene_abc_body");
  const TriangleMesh ball = test::sphereMesh(0.1, 4);
  const auto pointsAt = [&](double x, double scale) {
    std::vector<Vec3d> points;
    for (const Vec3d& p : ball.points) points.push_back((p + Vec3d{x, 0, 0.3}) * scale);
    return points;
  };
  for (const double scale : {1.0, 100.0}) {
    test::AbcBytes file;
    file.objects = {test::abcMesh("Ball", ball.triangles, {pointsAt(0, scale), pointsAt(5, scale)}, 0),
                    test::abcMesh("Other", ball.triangles, {pointsAt(1, scale)}, 0)};
    test::writeBytes(folder / "balls.abc", file.bytes());
    for (const char* up : {"Y", "Z"}) {
      const std::string unit = scale > 1 ? "" : "unit = 1\n";  // the groom is in centimetres
      const auto scene =
          parseScene(fmt::format("{}up = \"{}\"\n[[body]]\nshape = \"mesh\"\nfile = \"balls.abc\"\n"
                                 "mesh = \"/Ball\"\n{}",
                                 kCurl, up, unit),
                     "the scene", folder);
      ASSERT_TRUE(scene) << scene.error().message;
      const auto made = loadScene(*scene);
      ASSERT_TRUE(made) << made.error().message;
      EXPECT_LT(distanceTo(made->bodies[0], {0, 0, 0.3}), -0.05) << "up is " << up;
      EXPECT_NEAR(distanceTo(made->bodies[0], {0, 0.3, 0.3}), 0.2, 0.02) << "up is " << up;
    }
  }
}

// What a body, a scalp or the head cannot be read from is said with what it can, and is the input's fault.
TEST(LoadScene, FilesOfOtherKindsAreToldWhatIsRead) {
  const auto folder = test::scratchFolder("load_scene_kinds");
  std::ofstream(folder / "walk.fbx") << "Kaydara FBX Binary  ";
  const std::string gltf = ".gltf, .glb";
  for (const auto& [text, expected] : std::initializer_list<std::pair<std::string, std::string>>{
           {"[motion]\nfile = \"walk.fbx\"\n", ".bvh, " + gltf},
           {"[[body]]\nshape = \"sphere\"\nmoves = { file = \"walk.fbx\" }\n", ".bvh, " + gltf},
           {"[[body]]\nshape = \"mesh\"\nfile = \"walk.fbx\"\n", ".obj, " + gltf},
           {"[scalp]\nfile = \"walk.fbx\"\n", gltf}}) {
    SCOPED_TRACE(text);
    const auto scene = parseScene(kCurl + text, "the scene", folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto made = loadScene(*scene);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find(expected), std::string::npos) << made.error().message;
  }
  for (const char* table : {"[motion]\nfile = ", "[[body]]\nshape = \"mesh\"\nfile = ", "[scalp]\nfile = "}) {
    const auto scene = parseScene(kCurl + table + std::string("\"none.glb\"\n"), "the scene", folder);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto made = loadScene(*scene);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().fault, Fault::input) << made.error().message;
  }
}

TEST(LoadScene, AFileThatIsNotThereIsNamed) {
  const auto made = loadScene(*parseScene("[groom]\nfile = \"missing.obj\"\n", "s", "folder"));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().fault, Fault::input);
  EXPECT_NE(made.error().message.find("folder/missing.obj"), std::string::npos) << made.error().message;
}

// A mesh that hairs grow on, on a head that is turned and elsewhere when the run begins: with the head it is
// seen as it was made; in the world it stays where it is.
TEST(LoadScene, HairsGrowOnTheMeshAsTheHeadSeesIt) {
  const TriangleMesh made = makeHeadMesh();
  const Quatd turn = fromRotationVector(Vec3d{0, 0.5 * std::numbers::pi, 0});
  const Vec3d away{0.2, 1.5, -0.1};
  for (const bool isWorlds : {false, true}) {
    const LoadedScene scene = loaded(
        "[motion]\n[[motion.key]]\ntime = 0\nposition = [0.2, 1.5, -0.1]\nrotate_degrees = [0, 90, 0]\n"
        "[[motion.key]]\ntime = 1\nposition = [0.2, 1.5, -0.1]\nrotate_degrees = [0, 90, 0]\n"
        "[output]\nhairs = 9\nhair_scalp = \"skull\"\n[[body]]\nname = \"skull\"\nshape = \"mesh\"\n"
        "generate = \"head\"\n" +
        std::string(isWorlds ? "bind = \"world\"\n" : ""));
    ASSERT_TRUE(scene.hairs.scalp);
    ASSERT_EQ(scene.hairs.scalp->points.size(), made.points.size());
    double farthest = 0;
    for (std::size_t i = 0; i < made.points.size(); ++i) {
      const Vec3d seen = isWorlds ? rotate(turn.conjugate(), made.points[i] - away) : made.points[i];
      farthest = std::max(farthest, length(scene.hairs.scalp->points[i] - seen));
    }
    EXPECT_LT(farthest, 1e-6) << isWorlds;
  }
}

}  // namespace
}  // namespace ringlet::load_scene_test
