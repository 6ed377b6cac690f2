// Mesh bodies in scene files: `ringlet simulate` on a box as an OBJ and as a glTF file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/motion/gltf_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace ringlet::body_test {
namespace {

using nlohmann::json;
using test::runProgram;
using test::scratchFolder;

// 10 cm to a side, its top 3 cm below the strand, in metres; outward, counterclockwise.
std::vector<std::array<double, 3>> corners() {
  std::vector<std::array<double, 3>> all;
  for (int k = 0; k < 8; ++k)
    all.push_back({0.05 + 0.1 * (k & 1), -0.13 + 0.1 * (k >> 1 & 1), -0.05 + 0.1 * (k >> 2 & 1)});
  return all;
}
constexpr std::array<std::array<std::uint16_t, 3>, 12> kTriangles{{{0, 2, 1},
                                                                   {1, 2, 3},
                                                                   {4, 5, 6},
                                                                   {5, 7, 6},
                                                                   {0, 1, 4},
                                                                   {1, 5, 4},
                                                                   {2, 6, 3},
                                                                   {3, 6, 7},
                                                                   {0, 4, 2},
                                                                   {2, 4, 6},
                                                                   {1, 3, 5},
                                                                   {3, 7, 5}}};

void writeFiles(const std::filesystem::path& folder) {
  std::ofstream groom(folder / "groom.obj");
  for (int i = 0; i < 24; ++i) groom << "v " << 20.0 * i / 23 << " 0 0\n";
  groom << "l";
  for (int i = 1; i <= 24; ++i) groom << ' ' << i;
  groom << '\n';

  std::ofstream obj(folder / "box.obj");
  std::vector<double> numbers;
  for (const auto& [x, y, z] : corners()) {
    obj << fmt::format("v {} {} {}\n", x, y, z);
    numbers.insert(numbers.end(), {x, y, z});
  }
  std::vector<std::uint16_t> indices;
  for (const auto& [a, b, c] : kTriangles) {
    obj << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    indices.insert(indices.end(), {a, b, c});
  }

  test::GltfBuilder gltf;
  const int positions = gltf.floats(numbers, "VEC3"), triangles = gltf.accessor(indices, "SCALAR", 5123);
  gltf.root["meshes"] = {
      {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", triangles}}}}}};
  gltf.node({{"name", "box"}, {"mesh", 0}});
  std::ofstream(folder / "box.gltf") << gltf.text();
}

json fallOn(const std::filesystem::path& folder, const std::string& body) {
  std::ofstream(folder / "scene.toml") << "[groom]\nfile = 'groom.obj'\n[material]\nbend_stiffness = "
                                          "0.5\n[simulation]\nframes = 12\npreload = 0\n"
                                       << body;
  const auto result = runProgram(
      folder, {"simulate", "scene.toml", "--overwrite", "-o", "out", "--backend", "reference", "--json"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

TEST(BodyProgram, AMeshIsTheSameFromEitherFormat) {
  const auto folder = scratchFolder("body_program");
  writeFiles(folder);
  const json none = fallOn(folder, "");
  const json obj = fallOn(folder, "[[body]]\nshape = 'mesh'\nfile = 'box.obj'\nunit = 1\ncells = 32\n");
  const json gltf = fallOn(folder, "[[body]]\nshape = 'mesh'\nfile = 'box.gltf'\ncells = 32\n");
  EXPECT_TRUE(none["deepest_penetration_mm"].is_null());
  ASSERT_FALSE(obj["deepest_penetration_mm"].is_null()) << obj;
  EXPECT_LT(obj["deepest_penetration_mm"].get<double>(), 0.5);
  EXPECT_GE(obj["deepest_penetration_mm"].get<double>(), 0);
  EXPECT_EQ(obj["inside_bodies"], 0);
  EXPECT_EQ(obj["warnings"].size(), none["warnings"].size()) << obj["warnings"];
  EXPECT_NE(obj["positions_hash"], none["positions_hash"]) << "the strand falls on the box";
  EXPECT_LT(
      std::abs(obj["deepest_penetration_mm"].get<double>() - gltf["deepest_penetration_mm"].get<double>()),
      1e-2)
      << "glTF holds floats";
}

// How deep a particle is in a sphere follows from the points of hair.usda: the radius less the distance from
// its centre. The number of the JSON is the largest of all frames and bodies, in millimetres; each body has
// its own, and the number of particles that are ever deeper than it keeps hair out.
TEST(BodyProgram, HairBetweenBodiesThatCloseIsToldAsTheFramesHaveIt) {
  const auto folder = scratchFolder("body_depth");
  writeFiles(folder);
  // Two spheres pass through each other, with the strand between them: it cannot be outside of both.
  const auto sphere = [](double y, double speed) {
    return fmt::format(
        "[[body]]\nshape = 'sphere'\nradius = 0.05\nposition = [0.1, {}, 0]\n"
        "moves = {{ kind = 'glide', axis = [0, 1, 0], amplitude = {} }}\n",
        y, speed);
  };
  const json out = fallOn(folder, sphere(-0.12, 0.4) + sphere(0.12, -0.4));
  std::array<double, 2> deepest{};  // [m]
  std::array<std::set<std::size_t>, 2> caught;
  for (const auto& [frame, points] : test::readUsd(folder / "out/hair.usda").points) {
    for (const std::size_t b : {0, 1}) {
      const Vec3d centre{0.1, (b == 0 ? -1 : 1) * (0.12 - 0.4 * frame / 24), 0};
      for (std::size_t i = 2; i < points.size(); ++i) {  // the first two follow the head
        const double depth = 0.05 - length(Vec3d(points[i]) * 0.01 - centre);
        deepest[b] = std::max(deepest[b], depth);
        if (depth > 1e-4) caught[b].insert(i);
      }
    }
  }
  ASSERT_GT(std::max(deepest[0], deepest[1]), 1e-3);
  EXPECT_NEAR(out["deepest_penetration_mm"].get<double>(), 1000 * std::max(deepest[0], deepest[1]), 1e-3);
  ASSERT_EQ(out["bodies"].size(), 2u);
  for (const std::size_t b : {0, 1}) {
    const json& body = out["bodies"][b];
    EXPECT_NEAR(body["deepest_mm"].get<double>(), 1000 * deepest[b], 1e-3) << body;
    EXPECT_EQ(body["caught"], caught[b].size()) << body;
    EXPECT_TRUE(body["cell_mm"].is_null()) << body;
    EXPECT_EQ(std::ranges::count_if(out["warnings"],
                                    [&](const json& warning) {
                                      return warning.get<std::string>().starts_with(
                                          fmt::format("{} particle", caught[b].size()));
                                    }) > 0,
              !caught[b].empty())
        << out["warnings"];
  }
}

TEST(BodyProgram, MistakesNameTheBody) {
  const auto folder = scratchFolder("body_mistakes");
  writeFiles(folder);
  std::ofstream(folder / "scene.toml")
      << "[groom]\nfile = 'groom.obj'\n[[body]]\nname = 'anvil'\nshape = 'mesh'\nfile = 'none.gltf'\n";
  const auto result =
      runProgram(folder, {"simulate", "scene.toml", "--overwrite", "-o", "out", "--backend", "reference"});
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_NE(result.err.find("anvil"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("none.gltf"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ringlet::body_test
