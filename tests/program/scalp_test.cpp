// Scenes with a scalp: roots on a mesh that bends, on both backends, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/base/whole_file.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/motion/skinned_mesh.h"
#include "tests/motion/gltf_samples.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/motion/usd_clip_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::scalp_test {
namespace {

using nlohmann::json;
using test::runProgram;
using test::scratchFolder;

// The strip of gltf_samples.h with three strands of 10 cm on it, in metres.
constexpr double kRoots[] = {0.125, 0.625, 1.625};
constexpr double kRootZ = -0.05;  // in each piece's first triangle

std::filesystem::path folderWithFiles(const std::string& name, double bone) {
  const auto folder = scratchFolder(name);
  std::ofstream(folder / "strip.glb", std::ios::binary) << test::bendingStrip(8, 5121, 5126).glb();
  std::ofstream obj(folder / "groom.obj");
  for (double x : kRoots) {
    for (int k = 0; k < 5; ++k) obj << fmt::format("v {} {} {}\n", x - bone, -0.025 * k, kRootZ);
  }
  for (int s = 0; s < 3; ++s)
    obj << fmt::format("l {0} {1} {2} {3} {4}\n", 5 * s + 1, 5 * s + 2, 5 * s + 3, 5 * s + 4, 5 * s + 5);
  return folder;
}

void writeScene(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << "[groom]\nfile = 'groom.obj'\nunit = 1\n"
                         "[simulation]\nfps = 24\nframes = 12\n[output]\nfolder = 'out'\n"
                      << text;
}

// The root of strand s, bent for t seconds: the middle of the piece's edge from (x, -0.1) to (x', -0.1) at
// share 1/2, and half way to (x, 0.1).
Vec3d bentRoot(std::size_t s, double t) {
  const double left = kRoots[s] - 0.125, wz = (kRootZ + 0.1) / 0.2;
  const Vec3d a{left, 0, -0.1}, b{left, 0, 0.1}, c{left + 0.25, 0, -0.1};
  return test::bentPoint(a, t) * (1 - wz - 0.5) + test::bentPoint(b, t) * wz + test::bentPoint(c, t) * 0.5;
}

void expectOnStrip(const std::filesystem::path& folder, const Vec3d& offset = {}) {
  const auto last = readGroom(folder / "out/last.obj");
  ASSERT_TRUE(last) << last.error().message;
  for (std::size_t s = 0; s < 3; ++s)
    EXPECT_LT(length(Vec3d(last->groom.strand(s).front()) - offset - bentRoot(s, 0.5)), 1e-5) << s;
}

json simulate(const std::filesystem::path& folder, const char* backend) {
  const auto result = runProgram(folder, {"simulate", "scene.toml", "--backend", backend, "--json"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

std::string refused(const std::filesystem::path& folder) {
  const auto result = runProgram(folder, {"simulate", "scene.toml", "--backend", "reference"});
  EXPECT_NE(result.exitCode, 0);
  return result.err;
}

TEST(ScalpProgram, KeepsRootsOnAMeshThatBends) {
  const auto folder = folderWithFiles("scalp_bends", 0);
  writeScene(folder / "scene.toml", "[motion]\nkind = 'nod'\npre_roll = 0.25\n[scalp]\nfile = 'strip.glb'\n");
  simulate(folder, "reference");
  expectOnStrip(folder);
}

TEST(ScalpProgram, KeepsRootsOnAMeshThatBendsOnTheDevice) {
  const auto folder = folderWithFiles("scalp_on_device", 0);
  RINGLET_NEEDS_DEVICE(folder);
  writeScene(folder / "scene.toml", "[scalp]\nfile = 'strip.glb'\n[contacts]\nradius = 0.01\n");
  simulate(folder, "gpu");
  expectOnStrip(folder);
}

// A slab above the strip, into which it bends, is told; one below it is not.
TEST(ScalpProgram, SaysWhereRootsComeIntoABodyThatDoesNotBend) {
  const auto folder = folderWithFiles("scalp_in_body", 0);
  for (const auto& [y, count] : {std::pair{0.4, 1u}, {-0.4, 0u}}) {
    writeScene(folder / "scene.toml",
               fmt::format("[scalp]\nfile = 'strip.glb'\n[[body]]\nname = 'slab'\nshape = 'box'\n"
                           "half_extents = [3, 0.3, 1]\nposition = [0, {}, 0]\n",
                           y));
    std::filesystem::remove_all(folder / "out");
    const json warnings = simulate(folder, "reference")["warnings"];
    const auto told = std::ranges::count_if(warnings, [](const json& warning) {
      return warning.get<std::string>().find("into the body slab, which does not bend") != std::string::npos;
    });
    EXPECT_EQ(told, count) << warnings;
  }
}

// m.clips.usda and crates of its samples: 1 to 5, and the rest, which has times of its own.
void writeClipped(const std::filesystem::path& folder, const test::Triangles& triangles,
                  const std::vector<std::vector<Vec3d>>& samples) {
  std::vector<double> first, second;
  for (std::size_t k = 0; k < samples.size(); ++k)
    (k < 5 ? first : second).push_back(static_cast<double>(k < 5 ? k + 1 : k + 101));
  const auto cut = samples.begin() + static_cast<std::ptrdiff_t>(first.size());
  test::writeBytes(folder / "m.clip.1.usdc", test::clipCrate(first, {samples.begin(), cut}));
  test::writeBytes(folder / "m.clip.2.usdc", test::clipCrate(second, {cut, samples.end()}));
  const auto last = static_cast<double>(samples.size());
  test::writeBytes(
      folder / "m.clips.usda",
      test::clippedText(triangles, 24,
                        test::clipsText({{.files = {"m.clip.1.usdc", "./m.clip.2.usdc"},
                                          .active = {{1, 0}, {6, 1}},
                                          .times = {{1, 1}, {5, 5}, {6, 106}, {last, 100 + last}}}})));
}

// The strip in every form that has samples: m.obj with m.pc2, m.usda and so on.
void writeSampled(const std::filesystem::path& folder) {
  const auto strip = readSkinnedMesh(folder / "strip.glb");
  ASSERT_TRUE(strip) << strip.error().message;
  std::vector<std::vector<Vec3d>> samples;
  for (int frame = 0; frame <= 12; ++frame) samples.push_back(strip->pointsAt(frame / 24.0));
  test::writeMeshMotion(folder, "m", strip->triangles(), samples, 24);
  writeClipped(folder, strip->triangles(), samples);
}

// A body's mesh is the scalp: the same bits as where the scalp names the same file, and read once.
TEST(ScalpProgram, IsTheMeshOfABody) {
  const auto folder = folderWithFiles("scalp_of_body", 0);
  ASSERT_NO_FATAL_FAILURE(writeSampled(folder));
  for (const std::string mesh :
       {"file = 'strip.glb'\n", "file = 'm.obj'\ncache = 'm.pc2'\ncache_fps = 24\nunit = 1\nstart = 0.125\n",
        "file = 'm.usda'\nmesh = 'M'\n", "file = 'm.clips.usda'\n"}) {
    SCOPED_TRACE(mesh);
    const std::string body =
        "[[body]]\nname = 'skin'\nshape = 'mesh'\ndeforms = true\nsides = 'both'\n" + mesh;
    std::vector<std::string> hashes;
    for (const std::string& scalp : {mesh, std::string("body = 'skin'\n")}) {
      writeScene(folder / "scene.toml", "[scalp]\n" + scalp + body);
      std::filesystem::remove_all(folder / "out");
      hashes.push_back(simulate(folder, "reference")["positions_hash"]);
    }
    EXPECT_EQ(hashes[1], hashes[0]);
  }
}

// One mesh in every form: roots are on it, and forms with the same samples give the same hair.
TEST(ScalpProgram, FollowsPointCachesAndSequences) {
  const auto folder = folderWithFiles("scalp_samples", 0);
  ASSERT_NO_FATAL_FAILURE(writeSampled(folder));
  std::vector<std::string> hashes;
  for (const char* scalp :
       {"file = 'm.obj'\ncache = 'm.pc2'", "file = 'm.obj'\ncache = 'm.pc2'\ncache_fps = 24",
        "file = 'm.obj'\ncache = 'm.mdd'", "file = 'm.####.obj'\nup = 'Y'", "file = 'm.usda'\nmesh = 'M'",
        "file = 'm.usdc'\nmesh = '/M'", "file = 'm.clips.usda'", "file = 'm.abc'\nmesh = '/M'\nup = 'Y'"}) {
    writeScene(folder / "scene.toml", fmt::format("[motion]\nkind = 'nod'\n[scalp]\n{}\nunit = 1\n", scalp));
    std::filesystem::remove_all(folder / "out");
    const json run = simulate(folder, "reference");
    EXPECT_EQ(run["warnings"], json::array());
    expectOnStrip(folder);
    hashes.push_back(run["positions_hash"]);
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[3], hashes[0]);
  EXPECT_EQ(hashes[6], hashes[4]) << "of value clips";
  EXPECT_EQ(hashes[5], hashes[4]) << "USD's times begin with 1/24 s, MDD's are rounded";
  for (const char* needs : {"m.pc2", "m.0012.obj"}) {
    writeScene(folder / "scene.toml", "[scalp]\nfile = 'm.####.obj'\nunit = 1\n");
    if (std::string(needs) == "m.pc2")
      writeScene(folder / "scene.toml", "[scalp]\nfile = 'm.obj'\ncache = 'm.pc2'\nunit = 1\n");
    std::ofstream(folder / needs) << "v 0 0 0\n";
    EXPECT_NE(refused(folder).find(std::string("the scalp: ") + (folder / needs).filename().string()),
              std::string::npos)
        << refused(folder);
  }
}

// The head is the strip's second bone, 1 m along X, put 10 m up: the groom is in the bone's frame, the mesh
// comes along.
TEST(ScalpProgram, SharesTheHeadsFile) {
  const auto folder = folderWithFiles("scalp_shares", 1);
  writeScene(
      folder / "scene.toml",
      "[motion]\nfile = 'strip.glb'\njoint = 'bone1'\nstart = [0, 10, 0]\n[scalp]\nfile = 'strip.glb'\n");
  const json run = simulate(folder, "reference");
  EXPECT_EQ(run["warnings"], json::array());
  expectOnStrip(folder, {0, 10, 0});
}

std::string bytesOf(const std::filesystem::path& path) {
  const auto bytes = readWholeFile(path);
  return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
}

// Hairs that follow have roots all over the strip, go with it as it bends, and are the same afterwards.
TEST(ScalpProgram, CarriesRootsOfHairs) {
  const auto folder = folderWithFiles("scalp_hairs", 0);
  const auto does = [&](const std::vector<std::string>& arguments) {
    const auto result = runProgram(folder, arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
  };
  const std::string scene = "cache = 'float32'\n[motion]\nkind = 'nod'\n[scalp]\nfile = 'strip.glb'\n";
  writeScene(folder / "scene.toml", scene);
  const std::vector<std::string> simulated{"simulate", "scene.toml", "--backend", "reference", "-o"};
  auto more = simulated;
  does((more.insert(more.end(), {"strands"}), more));
  for (const char* name : {"hairs", "again"}) {
    more = simulated;
    more.insert(more.end(), {name, "--hairs", "300"});
    does(more);
  }
  does({"convert", "strands/hair.rgc", "made.rgc", "--hairs", "300", "--scene", "scene.toml"});
  const std::string found = bytesOf(folder / "hairs/hair.rgc");
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(bytesOf(folder / "again/hair.rgc") == found);
  EXPECT_TRUE(bytesOf(folder / "made.rgc") == found);

  does({"convert", "hairs/hair.rgc", "last.obj", "--frame", "12"});
  const auto last = readGroom(folder / "last.obj");
  ASSERT_TRUE(last) << last.error().message;
  ASSERT_EQ(last->groom.strandCount(), 300u);
  const auto strip = readSkinnedMesh(folder / "strip.glb");
  ASSERT_TRUE(strip) << strip.error().message;
  const TriangleTree bent({strip->pointsAt(0.5), strip->triangles()});
  const TriangleTree flat({strip->pointsAt(0), strip->triangles()});
  double farthest = 0, farthestFromFlat = 0;
  for (std::size_t h = 0; h < 300; ++h) {
    const Vec3d root(last->groom.strand(h).front());
    farthest = std::max(farthest, bent.nearest(root).distance);
    farthestFromFlat = std::max(farthestFromFlat, flat.nearest(root).distance);
  }
  EXPECT_LT(farthest, 1e-4) << "0.1 mm";
  EXPECT_GT(farthestFromFlat, 0.1) << "the strip must bend";

  // A map of density over strands leaves some of the same.
  writeScene(folder / "thin.toml",
             scene + "[[map]]\nnumber = 'output.hairs'\nstrands = '2'\nfactor = 0.25\n");
  does(
      {"convert", "strands/hair.rgc", "thin.obj", "--frame", "12", "--hairs", "300", "--scene", "thin.toml"});
  const auto thin = readGroom(folder / "thin.obj");
  EXPECT_LT(thin->groom.strandCount(), 260u);
  EXPECT_GT(thin->groom.strandCount(), 150u);
}

// A head of triangles among the bodies, or in a file.
TEST(ScalpProgram, HairsGrowOnAMeshThatIsNamed) {
  const auto folder = scratchFolder("hair_scalp");
  const auto does = [&](const std::vector<std::string>& arguments) {
    const auto result = runProgram(folder, arguments);
    ASSERT_EQ(result.exitCode, 0) << result.err;
  };
  does({"make", "head", "--strands", "40", "--particles", "12", "--turns", "1", "-o", "head.obj"});
  const TriangleMesh head = makeHeadMesh();
  std::ofstream mesh(folder / "mesh.obj");
  for (const Vec3d& p : head.points) mesh << fmt::format("v {} {} {}\n", 100 * p.x, 100 * p.y, 100 * p.z);
  for (const auto& [a, b, c] : head.triangles) mesh << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  mesh.close();
  const auto write = [&](const char* name, const char* body) {
    std::ofstream(folder / name) << "[groom]\nfile = 'head.obj'\n[motion]\nkind = 'nod'\n"
                                    "[simulation]\nframes = 2\n[output]\ncache = 'float32'\n"
                                 << body;
  };
  write("scene.toml",
        "hair_scalp = 'skull'\nhairs = 500\n[[body]]\nname = 'skull'\nshape = 'mesh'\ngenerate = 'head'\n");
  does({"simulate", "scene.toml", "--backend", "reference", "-o", "out"});
  does({"convert", "out/hair.rgc", "last.obj", "--frame", "2"});
  does({"convert", "head.obj", "rest.obj", "--hairs", "500", "--hair-scalp", "mesh.obj"});
  const auto rest = readGroom(folder / "rest.obj"), last = readGroom(folder / "last.obj");
  ASSERT_TRUE(rest && last);
  const TriangleTree tree(head);
  for (std::size_t h = 0; h < 500; ++h)
    EXPECT_LT(tree.nearest(Vec3d(rest->groom.strand(h).front()) * 0.01).distance, 1e-4);
  // The head carries the mesh: every two roots are as far apart as at rest.
  for (std::size_t h = 1; h < 500; ++h)
    EXPECT_NEAR(length(last->groom.strand(h).front() - last->groom.strand(0).front()),
                length(rest->groom.strand(h).front() - rest->groom.strand(0).front()), 1e-3);

  const auto refusal = [&](const char* body) {
    write("wrong.toml", body);
    const auto result = runProgram(folder, {"simulate", "wrong.toml", "--backend", "reference", "-o", "no"});
    EXPECT_NE(result.exitCode, 0);
    return result.err;
  };
  EXPECT_NE(refusal("hairs = 9\nhair_scalp = 'skull'\n").find("no body is named skull"), std::string::npos);
  EXPECT_NE(refusal("hairs = 9\nhair_scalp = 'b'\n[[body]]\nname = 'b'\nshape = 'sphere'\n")
                .find("is a sphere; expected a mesh"),
            std::string::npos);
}

TEST(ScalpProgram, SaysWhatIsWrong) {
  const auto folder = folderWithFiles("scalp_wrong", 0);
  const auto says = [&](const std::string& scalp, const char* part) {
    writeScene(folder / "scene.toml", "[scalp]\n" + scalp);
    const std::string error = refused(folder);
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  says("farthest = 0.1\n", "found neither scalp.file nor scalp.body");
  says("file = 'none.glb'\n", "none.glb");
  says("file = 'strip.glb'\nmesh = 'skull'\n", "skull");
  says("file = 'strip.glb'\nunit = 0.01\n", "3 of 3 roots are further than 0.01 m");
}

}  // namespace
}  // namespace ringlet::scalp_test
