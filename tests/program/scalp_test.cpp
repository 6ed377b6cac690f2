// Scenes with a scalp: roots on a mesh that bends, on both backends, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "tests/motion/gltf_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet {
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

TEST(ScalpProgram, SaysWhatIsWrong) {
  const auto folder = folderWithFiles("scalp_wrong", 0);
  const auto says = [&](const std::string& scalp, const char* part) {
    writeScene(folder / "scene.toml", "[scalp]\n" + scalp);
    const std::string error = refused(folder);
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  says("farthest = 0.1\n", "found no scalp.file");
  says("file = 'none.glb'\n", "none.glb");
  says("file = 'strip.glb'\nmesh = 'skull'\n", "skull");
  says("file = 'strip.glb'\nunit = 0.01\n", "3 of 3 roots are further than 0.01 m");
}

}  // namespace
}  // namespace ringlet
