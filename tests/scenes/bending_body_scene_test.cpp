// A body of a scene that bends (scenes/load/bending_body.h): every kind of file gives its points, its grid is
// where hair can be, and keys that do not go together are refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/bodies/body_samples.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::bending_body_scene_test {
namespace {

constexpr int kSamples = 13;

// A ball that swells, 24 samples a second.
TriangleMesh ballAt(double seconds) {
  TriangleMesh ball = sphereMesh(0.1, 4);
  for (Vec3d& p : ball.points) p = Vec3d{p.x * (1 + seconds), p.y, p.z * (1 + seconds)} + Vec3d{0, 1.5, 0};
  return ball;
}

std::filesystem::path folderWithBall(const char* name) {
  const auto folder = scratchFolder(name);
  std::vector<std::vector<Vec3d>> samples;
  for (int k = 0; k < kSamples; ++k) samples.push_back(ballAt(k / 24.0).points);
  writeMeshMotion(folder, "ball", ballAt(0).triangles, samples, 24);
  std::string groom;
  for (int i = 0; i < 12; ++i) groom += fmt::format("v 0.05 {} 0\n", 1.65 - 0.01 * i);
  groom += "l";
  for (int i = 1; i <= 12; ++i) groom += fmt::format(" {}", i);
  std::ofstream(folder / "hair.obj") << groom << "\n";
  return folder;
}

Result<LoadedScene> loadedWith(const std::filesystem::path& folder, const std::string& keys,
                               int frames = 12) {
  std::ofstream(folder / "scene.toml")
      << "[groom]\nfile = 'hair.obj'\nunit = 1\n[simulation]\nframes = " << frames
      << "\nsteps_per_frame = 4\n[[body]]\nname = 'ball'\nshape = 'mesh'\n"
      << keys;
  const auto scene = readScene(folder / "scene.toml");
  if (!scene) return scene.error();
  return loadScene(*scene);
}

TEST(BendingBodyScene, EveryKindOfFileGivesItsPoints) {
  const auto folder = folderWithBall("bending_body_forms");
  for (const char* file : {"file = 'ball.obj'\ncache = 'ball.pc2'", "file = 'ball.obj'\ncache = 'ball.mdd'",
                           "file = 'ball.####.obj'", "file = 'ball.usda'", "file = 'ball.usdc'",
                           "file = 'ball.abc'\nmesh = 'M'"}) {
    SCOPED_TRACE(file);
    const auto loaded = loadedWith(folder, std::string(file) + "\ndeforms = true\nunit = 1\ncells = 20\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->warnings, std::vector<std::string>());
    ASSERT_EQ(loaded->moving.size(), 1u);
    ASSERT_TRUE(loaded->bodies[0].bends());
    EXPECT_TRUE(checkBody(loaded->bodies[0]));
    const auto frame = SceneFrames(*loaded).at(5);
    ASSERT_TRUE(frame);
    const std::size_t count = ballAt(0).points.size();
    ASSERT_EQ(frame->points.size(), 1u);
    ASSERT_EQ(frame->points[0].size(), 4 * count);
    for (std::size_t k = 0; k < 4; ++k) {
      const TriangleMesh then = ballAt((5 + (double(k) + 1) / 4) / 24);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_LT(length(frame->points[0][k * count + i] - then.points[i]), 2e-5) << k << ", " << i;
    }
    // A step alone has its own.
    EXPECT_EQ(frame->step(2).points[0], std::vector(frame->points[0].begin() + std::ptrdiff_t(2 * count),
                                                    frame->points[0].begin() + std::ptrdiff_t(3 * count)));
  }
}

// A run that is cut short has the same bits.
TEST(BendingBodyScene, ItsGridIsTheSameForAShorterRun) {
  const auto folder = folderWithBall("bending_body_shorter");
  const std::string body = "file = 'ball.obj'\ncache = 'ball.pc2'\ndeforms = true\nunit = 1\ncells = 20\n";
  for (const char* region : {"hair", "all"}) {
    const std::string keys = body + fmt::format("region = '{}'\n", region);
    const auto whole = loadedWith(folder, keys), part = loadedWith(folder, keys, 2);
    ASSERT_TRUE(whole && part);
    const BendingMesh &a = *whole->bodies[0].mesh, &b = *part->bodies[0].mesh;
    EXPECT_EQ(a.origin, b.origin) << region;
    EXPECT_EQ(a.cell, b.cell) << region;
    EXPECT_EQ(a.counts, b.counts) << region;
    EXPECT_EQ(a.reach, b.reach) << region;
  }
}

// The strand is 11 cm long and grows 15 cm above the ball's middle.
TEST(BendingBodyScene, ItsGridIsWhereHairCanBe) {
  const auto folder = folderWithBall("bending_body_region");
  const std::string body = "file = 'ball.obj'\ncache = 'ball.pc2'\ndeforms = true\nunit = 1\ncells = 20\n";
  const auto near = loadedWith(folder, body), all = loadedWith(folder, body + "region = 'all'\n");
  ASSERT_TRUE(near && all);
  const auto lowest = [](const LoadedScene& scene) {  // the carrier is not turned at the start
    return SceneFrames(scene).bodiesAt(0)[0].position.y + scene.bodies[0].mesh->origin.y;
  };
  const BendingMesh& grid = *near->bodies[0].mesh;
  EXPECT_GT(lowest(*near), 1.54 - 4 * grid.cell);
  EXPECT_LT(lowest(*near), 1.54);
  EXPECT_LT(lowest(*all), 1.4);
  // It reaches as far as the mesh comes in any frame.
  EXPECT_GE(all->bodies[0].mesh->origin.x + all->bodies[0].mesh->cell * all->bodies[0].mesh->counts[0],
            ballAt(0.5).points[0].x);
  std::filesystem::remove(folder / "hair.obj");
  std::ofstream(folder / "hair.obj") << "v 5 5 5\nv 5 5 5.1\nl 1 2\n";
  const auto far = loadedWith(folder, body);
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().message.find("the body ball: the longest strand does not reach its mesh"),
            std::string::npos)
      << far.error().message;
}

// The ball goes 3 m away and turns, and only then swells: its grid goes with it and does not see that. Before
// its start, half a second on, it stands with the head.
TEST(BendingBodyScene, ItsGridGoesAlongWithIt) {
  const auto folder = folderWithBall("bending_body_carrier");
  std::vector<std::vector<Vec3d>> samples;
  const Vec3d middle{0, 1.5, 0}, way{3, 0.5, -1};
  for (int k = 0; k < kSamples; ++k) {
    std::vector<Vec3d>& points = samples.emplace_back(ballAt(k < 8 ? 0 : 0.3).points);
    const Quatd turn = fromRotationVector(Vec3d{0.3, 1, -0.2} * (0.2 * k));
    for (Vec3d& p : points) p = middle + rotate(turn, p - middle) + way * (k / 12.0);
  }
  writeMeshMotion(folder, "away", ballAt(0).triangles, samples, 24);
  const auto loaded = loadedWith(
      folder, "file = 'away.obj'\ncache = 'away.pc2'\ndeforms = true\nunit = 1\ncells = 20\nstart = 0.125\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const SceneFrames frames(*loaded);
  const std::vector<Vec3d> first = frames.bodyPointsAt(0)[0];
  for (const double frame : {-3.0, 0.0, 2.5, 3.0, 4.0, 7.0, 10.0}) {
    const std::vector<Vec3d> seen = frames.bodyPointsAt(frame)[0];
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_LT(length(seen[i] - first[i]), 2e-5) << frame;
    // In the world it is where the file has it.
    const BodyPose pose = frames.bodiesAt(frame)[0];
    const auto sample = static_cast<std::size_t>(std::clamp(frame - 3, 0.0, 12.0));
    for (std::size_t i = 0; i < first.size(); ++i)
      EXPECT_LT(length(pose.position + rotate(pose.rotation, seen[i]) - samples[sample][i]), 2e-5) << frame;
  }
  double bent = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    bent = std::max(bent, length(frames.bodyPointsAt(12)[0][i] - first[i]));
  EXPECT_GT(bent, 0.005);
  EXPECT_LT(bent, 0.05);
}

// Cloth is taken as it is: all of it, with its holes, and no nearer than 0.5 mm.
TEST(BendingBodyScene, ClothHasNoGrid) {
  const auto folder = folderWithBall("bending_body_cloth");
  const std::string body = "file = 'ball.obj'\ncache = 'ball.pc2'\ndeforms = true\nunit = 1\n";
  const auto closed = loadedWith(folder, body), cloth = loadedWith(folder, body + "sides = 'both'\n");
  ASSERT_TRUE(closed && cloth);
  EXPECT_FALSE(closed->bodies[0].isCloth());
  ASSERT_TRUE(cloth->bodies[0].isCloth());
  EXPECT_EQ(cloth->bodies[0].mesh->cornerCount(), 8u);
  EXPECT_EQ(cloth->bodies[0].thickness, 5e-4);
  const auto &mesh = *cloth->bodies[0].mesh, &other = *closed->bodies[0].mesh;
  EXPECT_EQ(mesh.points.size(), other.points.size());
  auto triangles = mesh.surface.triangles, others = other.surface.triangles;
  EXPECT_NE(triangles, others);  // in the order of its tree
  std::ranges::sort(triangles), std::ranges::sort(others);
  EXPECT_EQ(triangles, others);
  const auto thick = loadedWith(folder, body + "sides = 'both'\nthickness = 0.002\n");
  ASSERT_TRUE(thick);
  EXPECT_EQ(thick->bodies[0].thickness, 0.002);
}

TEST(BendingBodyScene, RefusesKeysThatDoNotGoTogether) {
  const auto folder = folderWithBall("bending_body_keys");
  const std::string file = "file = 'ball.obj'\n", bending = file + "cache = 'ball.pc2'\ndeforms = true\n";
  const auto refused = [&](const std::string& keys, const std::string& part) {
    const auto loaded = loadedWith(folder, keys);
    ASSERT_FALSE(loaded) << keys;
    EXPECT_NE(loaded.error().message.find(part), std::string::npos) << loaded.error().message;
  };
  for (const char* key :
       {"scale = 2", "position = [0, 1, 0]", "rotate_degrees = [0, 1, 0]", "bind = 'world'"})
    refused(bending + key + "\n", "of a mesh that deforms");
  for (const char* key : {"cache = 'ball.pc2'", "cache_fps = 24", "animation = '0'", "start = 1",
                          "region = 'all'", "sides = 'both'"})
    refused(file + key + "\n", "expected deforms = true beside it");
  for (const char* key : {"cells = 20", "region = 'all'"})
    refused(bending + "sides = 'both'\n" + key + "\n", "of cloth");
  refused(file + "deforms = true\n", "the body ball");  // an OBJ file alone has no motion
}

}  // namespace
}  // namespace ringlet::test::bending_body_scene_test
