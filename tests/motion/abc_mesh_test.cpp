// motion/abc_mesh.h: meshes of Alembic files against closed forms, one that the Alembic library wrote, and
// what is refused.
#include "ringlet/motion/abc_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "ringlet/motion/mesh_motion_file.h"
#include "tests/motion/abc_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::abc_mesh_test {
namespace {

const AbcTriangles kTriangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}};
constexpr double kFps = 25;

std::vector<Vec3d> pointsAt(double a) {
  return {{0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {1, a, 0}, {0, 0.25, 1 + a * a}};
}
std::vector<std::vector<Vec3d>> samples(std::size_t count = 5) {
  std::vector<std::vector<Vec3d>> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(pointsAt(0.4 * static_cast<double>(k)));
  return all;
}
AbcBytes fileOf(std::vector<AbcBytes::Object> objects) {
  AbcBytes file;
  file.samplings.push_back({1 / kFps, {0}});
  file.objects = std::move(objects);
  return file;
}

Result<std::shared_ptr<const MeshMotion>> read(const std::string& bytes, const AbcMeshChoice& choice = {}) {
  return readAbcMesh(std::as_bytes(std::span(bytes)), "m.abc", choice);
}
Result<std::shared_ptr<const MeshMotion>> read(AbcBytes file, const AbcMeshChoice& choice = {}) {
  return read(file.bytes(), choice);
}
template <class File>
void expectProblem(File file, const std::string& expected, const AbcMeshChoice& choice = {}) {
  const auto mesh = read(std::move(file), choice);
  const std::string problem = mesh ? "" : mesh.error().message;
  EXPECT_NE(problem.find(expected), std::string::npos) << "found: " << problem << "\nexpected: " << expected;
}

double volumeOf(const MeshMotion& mesh, double t) {
  const std::vector<Vec3d> points = mesh.pointsAt(t);
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles()) volume += dot(points[a], cross(points[b], points[c])) / 6;
  return volume;
}

// At samples and between them, of times that are even, cyclic or each stated.
TEST(AbcMesh, GoesOnStraightLinesBetweenSamples) {
  const std::vector<double> stated{1, 1.5, 1.6, 3, 7};
  const AbcBytes::Sampling kinds[] = {{0.5, {10}}, {1, {2, 2.25}}, {AbcBytes::kNoCycle, stated}};
  for (int kind = 0; kind < 3; ++kind) {
    AbcBytes file = fileOf({abcMesh("M", kTriangles, samples(), 1)});
    file.samplings[1] = kinds[kind];
    const auto timeOf = [&](std::size_t k) {
      const auto s = static_cast<double>(k);
      return kind == 0 ? 10 + 0.5 * s : kind == 1 ? 2 + std::floor(s / 2) + (k % 2 ? 0.25 : 0) : stated[k];
    };
    const auto mesh = read(file);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ((*mesh)->triangles(), kTriangles);
    EXPECT_EQ((*mesh)->firstSeconds(), timeOf(0));
    EXPECT_EQ((*mesh)->lastSeconds(), timeOf(4));
    EXPECT_TRUE((*mesh)->warnings().empty());
    for (std::size_t k = 0; k < 4; ++k) {
      for (const double share : {0.0, 0.25, 1.0}) {
        const auto found = (*mesh)->pointsAt(timeOf(k) + share * (timeOf(k + 1) - timeOf(k)));
        const auto a = samples()[k], b = samples()[k + 1];
        for (std::size_t p = 0; p < 4; ++p)
          EXPECT_LT(length(found[p] - (a[p] + (b[p] - a[p]) * share)), 1e-6) << "kind " << kind;
      }
    }
  }
}

// Samples that are stored once: the mesh rests until 3, moves at 3 and 4 and rests again from there.
TEST(AbcMesh, RepeatedSamplesHold) {
  AbcBytes::Object mesh = abcMesh("M", kTriangles, samples(3), 1);
  AbcBytes::Property& points = mesh.properties[0].parts[0];
  points.count = 10;
  points.firstChanged = 3;
  points.lastChanged = 4;
  const auto moving = read(fileOf({mesh}));
  ASSERT_TRUE(moving) << moving.error().message;
  EXPECT_EQ((*moving)->firstSeconds(), 0);
  EXPECT_EQ((*moving)->lastSeconds(), 9 / kFps);
  const auto all = samples(3);
  const auto xOf1 = [&](double frame) { return (*moving)->pointsAt(frame / kFps)[1].x; };
  EXPECT_NEAR(xOf1(0), all[0][1].x, 1e-6);
  EXPECT_NEAR(xOf1(2), all[0][1].x, 1e-6) << "it still rests";
  EXPECT_NEAR(xOf1(2.5), (all[0][1].x + all[1][1].x) / 2, 1e-6);
  EXPECT_NEAR(xOf1(3), all[1][1].x, 1e-6);
  EXPECT_NEAR(xOf1(4), all[2][1].x, 1e-6);
  EXPECT_NEAR(xOf1(8.5), all[2][1].x, 1e-6);
}

// Operations in the order of the file, of which the last acts first; each goes straight between its samples.
TEST(AbcMesh, FollowsTransformsOfAllObjectsAbove) {
  AbcBytes file = fileOf({abcXform(
      "above", {0x50, 0x10, 0x01}, {{0, 1, 0, 0, 2, 2, 2}, {90, 1, 0, 0, 2, 2, 2}}, 2,
      {abcXform("way", {0x12}, {{0, 0, 0}, {0, 3, 0}}, 1, {abcMesh("M", kTriangles, samples(), 1)})})});
  file.samplings.push_back({1, {0.02}});
  const auto mesh = read(file);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ((*mesh)->firstSeconds(), 0);
  EXPECT_NEAR((*mesh)->lastSeconds(), 1.02, 1e-12);
  for (const double t : {0.0, 0.02, 0.04, 1.02, 2.0}) {
    // At the times of samples, where both are exact.
    const double up = t < 0.04 ? 75 * t : 3;
    const double angle = (t < 0.02 ? 0 : std::min(1.0, t - 0.02)) * std::acos(0.0);
    const auto frame = static_cast<std::size_t>(std::min(t * kFps, 4.0));
    const double share = std::min(t * kFps, 4.0) - static_cast<double>(frame);
    const auto a = samples(6)[frame], b = samples(6)[frame + 1];
    const auto found = (*mesh)->pointsAt(t);
    for (std::size_t p = 0; p < 4; ++p) {
      Vec3d x = a[p] + (b[p] - a[p]) * share + Vec3d{0, up, 0};
      x = x * 2.0 + Vec3d{1, 0, 0};
      x = {x.x * std::cos(angle) + x.z * std::sin(angle), x.y, x.z * std::cos(angle) - x.x * std::sin(angle)};
      EXPECT_LT(length(found[p] - x), 2e-6) << "point " << p << " at " << t;
    }
  }
}

TEST(AbcMesh, EveryOperationPlacesPoints) {
  const Vec3d x{1, 2, 3};
  struct Case {
    std::uint8_t op;
    std::vector<double> numbers;
    Vec3d placed;
  };
  for (const Case& c :
       {Case{0x00, {2, 3, 4}, {2, 6, 12}}, Case{0x10, {1, 1, 1}, {2, 3, 4}},
        Case{0x20, {0, 0, 5, 90}, {-2, 1, 3}}, Case{0x20, {1, 1, 1, 120}, {3, 1, 2}},
        Case{0x20, {0, 0, 0, 90}, {1, 2, 3}},
        Case{0x30, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1}, {9, 9, 15}},
        Case{0x40, {90}, {1, -3, 2}}, Case{0x50, {90}, {3, 2, -1}}, Case{0x60, {90}, {-2, 1, 3}}}) {
    const auto mesh =
        read(fileOf({abcXform("X", {c.op}, {c.numbers}, 0, {abcMesh("M", {{0, 1, 2}}, {{x, {}, {}}}, 0)})}));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_LT(length((*mesh)->pointsAt(0)[0] - c.placed), 1e-6) << "operation " << int{c.op};
    const bool mirrors = c.op == 0x30;
    EXPECT_EQ((*mesh)->triangles()[0][1], mirrors ? 2u : 1u);
  }
}

TEST(AbcMesh, ObjectsThatDoNotInheritStandInTheWorld) {
  AbcBytes::Object inner = abcXform("in", {0x10}, {{1, 0, 0}}, 0, {abcMesh("M", kTriangles, samples(), 1)});
  const auto at = [&] {
    const auto mesh = read(fileOf({abcXform("out", {0x10}, {{0, 5, 0}}, 0, {inner})}));
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? (*mesh)->pointsAt(0)[0] : Vec3d{};
  };
  EXPECT_EQ(at(), (Vec3d{1, 5, 0}));
  inner.properties[0].parts[0].samples = {std::string(1, '\0')};
  EXPECT_EQ(at(), (Vec3d{1, 0, 0}));
}

TEST(AbcMesh, FacesAreFansTurnedToTheOutside) {
  const std::vector<Vec3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto cage = read(fileOf({abcMesh("M", {4}, {3, 2, 1, 0}, {square}, 0, "AbcGeom_SubD_v1")}));
  ASSERT_TRUE(cage) << cage.error().message;
  EXPECT_EQ((*cage)->triangles(), (AbcTriangles{{3, 1, 2}, {3, 0, 1}}));
  ASSERT_EQ((*cage)->warnings().size(), 2u);
  EXPECT_EQ((*cage)->warnings()[0],
            "/M: a subdivision surface; its cage is taken, which lies a little outside");
  EXPECT_EQ((*cage)->warnings()[1], "/M: does not move");
}

TEST(AbcMesh, IsNamedWhereThereAreSeveral) {
  std::vector<AbcBytes::Object> many;
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"})
    many.push_back(abcMesh(name, kTriangles, samples(), 1));
  const AbcBytes file = fileOf({{.name = "top", .children = many}, abcMesh("b", kTriangles, samples(2), 1)});
  expectProblem(
      file,
      "m.abc: has 8 meshes, so that one must be named, by its path: /b, /top/a, /top/b, /top/c, /top/d, /top/e");
  expectProblem(file, "has 2 meshes, so that one must be named", {.object = "b"});
  expectProblem(file, "there is no mesh 'B'; there are /b, /top/a, ", {.object = "B"});
  expectProblem(fileOf({{.name = "top"}}), "m.abc: found no mesh (PolyMesh, SubD) among 1 objects");
  const auto named = read(file, {.object = "/b"});
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_NEAR((*named)->lastSeconds(), 1 / kFps, 1e-12);
  EXPECT_TRUE(read(file, {.object = "g"}));
}

// A topology that changes is refused by the sample, what changed and the counts; one that is written anew in
// each sample but stays is taken.
TEST(AbcMesh, RefusesOtherTopologies) {
  const auto with = [](auto change) {
    AbcBytes::Object mesh = abcMesh("M", kTriangles, samples(3), 1);
    auto& parts = mesh.properties[0].parts;
    change(parts[0], parts[1], parts[2]);
    return fileOf({mesh});
  };
  using P = AbcBytes::Property;
  const auto counts = [](const std::vector<std::int32_t>& values) { return abcNumbers(values); };
  const auto same = with([](P&, P& corners, P& sizes) {
    corners.samples.resize(3, corners.samples[0]);
    sizes.samples.resize(3, sizes.samples[0]);
  });
  EXPECT_TRUE(read(same)) << read(same).error().message;
  expectProblem(with([&](P& points, P&, P&) { points.samples[2] += abcPoints({{}}); }),
                "m.abc: /M: found 5 points in sample 3; expected 4: points and faces of a mesh");
  expectProblem(with([&](P&, P&, P& sizes) {
                  sizes.samples = {counts({3, 3, 3, 3}), counts({3, 3, 3, 3, 3})};
                }),
                "found 5 numbers of .faceCounts in sample 2; expected 4");
  expectProblem(with([&](P&, P& corners, P&) {
                  std::string other = corners.samples[0];
                  other[4] = 3;  // the second number
                  corners.samples = {corners.samples[0], corners.samples[0], other};
                }),
                "found 3 as number 2 of .faceIndices in sample 3; expected 2");
}

TEST(AbcMesh, SaysWhatItCannotUse) {
  const auto with = [](auto change) {
    AbcBytes::Object mesh = abcMesh("M", kTriangles, samples(3), 1);
    auto& parts = mesh.properties[0].parts;
    change(parts);
    return fileOf({abcXform("X", {0x10}, {{0, 0, 0}}, 0, {mesh})});
  };
  using Parts = std::vector<AbcBytes::Property>;
  const auto integers = [](const std::vector<std::int32_t>& values) {
    return std::vector<std::string>{abcNumbers(values)};
  };
  expectProblem(with([](Parts& p) { p.erase(p.begin()); }), "m.abc: /X/M: has no P");
  expectProblem(with([](Parts& p) { p.pop_back(); }), "has no .faceCounts");
  expectProblem(with([](Parts& p) { p[1].samples = {""}; }), "has no .faceIndices");
  expectProblem(with([](Parts& p) { p[0].width = 1; }), "found P of 1 float32 an element; expected 3 floats");
  expectProblem(with([](Parts& p) { p[1].type = AbcBytes::f32; }),
                "found .faceIndices of float32; expected integers");
  expectProblem(with([&](Parts& p) {
                  p[2].samples = integers({3, 2});
                }),
                "found a face of 2 corners; expected 3");
  expectProblem(with([&](Parts& p) { p[2].samples = integers({3, 99}); }), "found a face of 99 corners");
  expectProblem(with([&](Parts& p) {
                  p[2].samples = integers({3, 3});
                }),
                "found 12 corners; expected 6, for 2 faces");
  expectProblem(with([&](Parts& p) {
                  p[1].samples = integers({0, 1, 2, 0, 1, -2, 0, 1, 2, 0, 1, 2});
                }),
                "found the point -2 in a face");
  expectProblem(with([&](Parts& p) {
                  p[1].samples = integers({0, 1, 2, 0, 1, 4, 0, 1, 2, 0, 1, 2});
                }),
                "/X/M: a triangle has the corner 4; expected at most 3");
  expectProblem(with([](Parts& p) {
                  p[0].samples[1].replace(0, 4, abcNumber(std::numeric_limits<float>::infinity()));
                }),
                "/X/M: point 0 of sample 2 is not finite");
}

TEST(AbcMesh, SaysWhichTransformsItCannotFollow) {
  const AbcBytes::Object mesh = abcMesh("M", kTriangles, samples(3), 1);
  const auto placed = [&](const std::vector<std::uint8_t>& ops,
                          const std::vector<std::vector<double>>& values) {
    return fileOf({abcXform("X", ops, values, 1, {mesh})});
  };
  expectProblem(placed({0x70}, {{0}}), "m.abc: /X: found operation 112; expected 0 to 111");
  expectProblem(placed({0x10}, {{0}}), "/X: found 1 numbers in sample 1 of .xform/.vals; expected 3");
  expectProblem(placed({0x30}, {{1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}), "expected an affine one");
  expectProblem(placed({0x40}, {{0}, {std::numeric_limits<double>::quiet_NaN()}}),
                "/X: found a number in sample 2 of .xform/.vals that is not finite");
  AbcBytes::Object changing = abcXform("X", {0x40}, {{0}}, 1, {mesh});
  changing.properties[0].parts[1].samples.push_back("\x50");
  expectProblem(fileOf({changing}), "/X: its .ops change over time");
  AbcBytes::Object without = abcXform("X", {0x40}, {{0}}, 1, {mesh});
  without.properties[0].parts.pop_back();
  expectProblem(fileOf({without}), "/X: has .ops without .vals");
  AbcBytes::Object deep = mesh;
  for (int k = 0; k < 5; ++k)
    deep = abcXform("X", std::vector<std::uint8_t>(250, 0x40), {std::vector<double>(250)}, 0, {deep});
  expectProblem(fileOf({deep}), "expected at most 1024 together");
}

// A small file that repeats one large sample many times is no way to fill memory.
TEST(AbcMesh, RefusesMoreSamplesThanTheFileHasRoomFor) {
  const std::vector<Vec3d> points(4000);
  std::vector<std::vector<Vec3d>> all(2000, points);
  AbcBytes::Object mesh = abcMesh("M", {{0, 1, 2}}, {points}, 1);
  mesh.properties[0].parts[0].samples.resize(2000, abcPoints(points));
  expectProblem(fileOf({mesh}), "/M: its 2000 samples of 4000 points are more than is read of a file of");
}

// Every shorter file and every changed byte is read or refused, whole.
TEST(AbcMesh, SurvivesBrokenFiles) {
  const std::string whole =
      fileOf({abcXform("X", {0x10}, {{0, 0, 0}, {0, 1, 0}}, 1, {abcMesh("M", kTriangles, samples(2), 1)})})
          .bytes();
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(read(whole.substr(0, size))) << size << " bytes";
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char flip : {'\x01', '\x10', '\x80', '\xff'}) {
      std::string broken = whole;
      broken[at] = static_cast<char>(broken[at] ^ flip);
      const auto mesh = read(broken);
      if (!mesh) continue;
      EXPECT_EQ((*mesh)->pointsAt(0.01).size(), (*mesh)->pointCount()) << "byte " << at;
    }
  }
}

// As the library's own reader says of it (README.md beside it): a closed tube that sways, carried upwards.
TEST(AbcMesh, ReadsATubeOfTheAlembicLibrary) {
  RINGLET_NEEDS_DATA(path, "abc/mesh_bending.abc");
  const auto read = readMeshMotion({.path = path, .mesh = "tube"}, false);
  ASSERT_TRUE(read) << read.error().message;
  const MeshMotion& mesh = **read;
  EXPECT_EQ(mesh.pointCount(), 122u);
  EXPECT_EQ(mesh.triangles().size(), 2 * 108u + 24u);
  EXPECT_EQ(mesh.firstSeconds(), 0);
  EXPECT_NEAR(mesh.lastSeconds(), 19 / 30.0, 1e-12);
  EXPECT_TRUE(mesh.warnings().empty());
  EXPECT_LT(length(mesh.pointsAt(1)[121] - Vec3d{-0.0660822, 0.4 + 19 * 0.02, 0}), 1e-6);
  EXPECT_NEAR(mesh.pointsAt(0.5 / 30)[0].y - mesh.pointsAt(0)[0].y, 0.01, 1e-7) << "it is carried up";
  for (const double t : {0.0, 0.3, 1.0}) EXPECT_GT(volumeOf(mesh, t), 0.001) << "the outside is outside";
  // The groom's unit and axes, where nothing says others; what is said counts.
  const auto large = readMeshMotion({.path = path, .metresPerUnit = 0.01}, true);
  ASSERT_TRUE(large);
  EXPECT_LT(length((*large)->pointsAt(1)[121] - mesh.pointsAt(1)[121] * 0.01), 1e-9);
  const auto turned = readMeshMotion({.path = path, .up = FileAxis::plusY}, true);
  ASSERT_TRUE(turned);
  const Vec3d last = mesh.pointsAt(1)[121];
  EXPECT_LT(length((*turned)->pointsAt(1)[121] - Vec3d{last.x, -last.z, last.y}), 1e-9);
}

}  // namespace
}  // namespace ringlet::test::abc_mesh_test
