// bodies/mesh_file.h: faces of every form, and errors that name the line.
#include "ringlet/bodies/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/support/test_support.h"

namespace ringlet::mesh_file_test {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Result<TriangleMesh> read(const std::string& text, double metresPerUnit = 1) {
  return readObjMesh(std::as_bytes(std::span(text)), "test.obj", metresPerUnit);
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Triangles trianglesOf(const std::string& faces) {
  const Result<TriangleMesh> mesh = read(kSquare + faces);
  EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
  return mesh ? mesh->triangles : Triangles{};
}

void expectError(const std::string& text, const std::string& part) {
  const Result<TriangleMesh> mesh = read(text);
  ASSERT_FALSE(mesh) << text;
  EXPECT_NE(mesh.error().message.find("test.obj"), std::string::npos) << mesh.error().message;
  EXPECT_NE(mesh.error().message.find(part), std::string::npos) << mesh.error().message;
}

TEST(MeshFile, ReadsCornersOfEveryForm) {
  for (const char* face : {"f 1 2 3", "f 1/7 2/8 3/9", "f 1//7 2//7 3//7", "f 1/7/8 2/7/8 3/7/8",
                           "f -4 -3 -2", "f -4//1 2 +3/1", "f 1 \\\n 2 3 # three", "\tf  1\t2  3  \r"})
    EXPECT_EQ(trianglesOf(std::string(face) + "\n"), (Triangles{{0, 1, 2}})) << face;
}

TEST(MeshFile, CutsPolygonsIntoFans) {
  EXPECT_EQ(trianglesOf("f 1 2 3 4\n"), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(trianglesOf("v 0 0.5 0\nf 2 3 4 5 1\n"), (Triangles{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST(MeshFile, PutsObjectsTogetherInMetres) {
  const Result<TriangleMesh> mesh = read(
      "o a\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 2 3\no b\ng c\nusemtl d\ns 1\nv 50 -25 0\nf 1 4 -3\n", 0.01);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}, {0, 3, 1}}));
  ASSERT_EQ(mesh->points.size(), 4u);
  EXPECT_EQ(mesh->points[0], (Vec3d{1, 0, 0}));
  EXPECT_EQ(mesh->points[3], (Vec3d{0.5, -0.25, 0}));
}

TEST(MeshFile, TakesPointsThatComeLater) {
  const Result<TriangleMesh> mesh = read(std::string("f 1 2 3\n") + kSquare);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}}));
}

TEST(MeshFile, LeavesOutTrianglesOfFewerThanThreePlaces) {
  EXPECT_EQ(trianglesOf("v 1 0 0\nf 1 2 2\nf 1 2 5\nf 1 2 3\nf 3 3 3\n"), (Triangles{{0, 1, 2}}));
  EXPECT_EQ(trianglesOf("f 1 2 2 3 4\n"), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  expectError(std::string(kSquare) + "f 1 1 2\nl 1 2\n",
              "found 4 points ('v'), 1 polylines ('l'), 1 triangles");
}

TEST(MeshFile, SaysWhatIsWrongAndWhere) {
  expectError("", "expected lines like 'f 1 2 3'");
  expectError(std::string(kSquare) + "l 1 2 3\n", "1 polylines");
  expectError("v 1 2\nf 1 2 3\n", "line 1: found the end of the line; expected three finite numbers");
  expectError("v 1 2 nan\n", "line 1: found 'nan'");
  expectError("v 1 2 1e999\n", "line 1: found '1e999'");
  expectError(std::string(kSquare) + "f 1 2\n", "line 5: found 'f' with 2 indices; expected at least three");
  expectError(std::string(kSquare) + "f\n", "line 5: found 'f' with 0 indices");
  expectError(std::string(kSquare) + "f 1 2 0\n", "line 5: found '0'");
  expectError(std::string(kSquare) + "f 1 2 x\n", "line 5: found 'x'");
  expectError(std::string(kSquare) + "f 1 2 3\nf 1 2 5\n", "line 6: found index 5; expected at most 4");
  expectError(std::string(kSquare) + "f 1 2 -5\n", "line 5: found '-5'; expected an index of the 4 points");
  expectError(std::string(kSquare) + "f 1 2 99999999999\n", "line 5");
  expectError(std::string(kSquare) + "f 1 2 99999999999999999999\n", "line 5");
  for (double unit : {0.0, -1.0, 1e9, std::nan("")})
    EXPECT_FALSE(read(std::string(kSquare) + "f 1 2 3\n", unit));
  const Result<TriangleMesh> missing = readObjMesh("nowhere/a.obj", 1);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("No such file"), std::string::npos) << missing.error().message;
}

TEST(MeshFile, SurvivesSpoiltFiles) {
  const std::string valid =
      std::string(kSquare) + "f 1/1/1 2/2/2 3/3/3 4/4/4\nf -1 -2 \\\n-3\nf 1//1 3//2 2//1\n";
  const std::string alphabet = "0123456789-+./\\ \n\r\tvf#e";
  std::mt19937 random(20240601);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = valid;
    for (std::size_t change = 1 + random() % 4; change > 0; --change)
      bytes[random() % bytes.size()] = alphabet[random() % alphabet.size()];
    const Result<TriangleMesh> mesh = read(bytes);
    accepted += bool(mesh);
    if (mesh) {
      ASSERT_TRUE(checkMesh(*mesh)) << bytes;
    } else {
      ASSERT_GT(mesh.error().message.size(), 10u);
    }
  }
  EXPECT_GT(accepted, 200);
  EXPECT_LT(accepted, 19800);
}

TEST(MeshFile, ReadsRealMeshes) {
  RINGLET_NEEDS_DATA(path, "sintel/sintel-collider.obj");
  const Result<TriangleMesh> mesh = readObjMesh(path, 1);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 341u);
  EXPECT_EQ(mesh->triangles.size(), 678u);
  EXPECT_TRUE(isWatertight(*mesh));
}

}  // namespace
}  // namespace ringlet::mesh_file_test
