// motion/mesh_motion_file.h, sampled_mesh.h and point_cache.h: every form of a mesh that moves against a
// closed form, and what is refused.
#include "ringlet/motion/mesh_motion_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "ringlet/motion/point_cache.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/usd_mesh.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::mesh_motion_test {

namespace {

constexpr double kFps = 25;
const Triangles kTriangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}};

// A tetrahedron whose points go round; triangle 0 has no area at first.
std::vector<Vec3d> pointsAt(std::size_t sample) {
  const double a = 0.4 * static_cast<double>(sample);
  return {{0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {1, a, 0}, {0, 0.25, 1 + a * a}};
}
std::vector<std::vector<Vec3d>> samples(std::size_t count = 5) {
  std::vector<std::vector<Vec3d>> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(pointsAt(k));
  return all;
}

struct Form {
  const char* name;
  MeshMotionChoice choice;
};
std::vector<Form> formsIn(const std::filesystem::path& folder) {
  const MeshMotionChoice sequence{.path = folder / "m.####.obj", .framesPerSecond = kFps};
  MeshMotionChoice pc2{.path = folder / "m.obj", .cache = folder / "m.pc2", .framesPerSecond = kFps},
      mdd = pc2;
  mdd.cache = folder / "m.mdd";
  mdd.framesPerSecond = 1;  // it has seconds
  return {{"pc2", pc2},
          {"mdd", mdd},
          {"sequence", sequence},
          {"usda", {.path = folder / "m.usda"}},
          {"usdc", {.path = folder / "m.usdc"}},
          {"abc", {.path = folder / "m.abc"}}};
}

std::string problemOf(const MeshMotionChoice& choice) {
  const auto mesh = readMeshMotion(choice, false);
  return mesh ? "" : mesh.error().message;
}

TEST(MeshMotion, GoesOnStraightLinesBetweenSamplesInEveryForm) {
  const auto folder = scratchFolder("mesh_motion_forms");
  writeMeshMotion(folder, "m", kTriangles, samples(), kFps);
  for (Form& form : formsIn(folder)) {
    SCOPED_TRACE(form.name);
    form.choice.metresPerUnit = 0.01;
    const auto mesh = readMeshMotion(form.choice, false);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ((*mesh)->triangles(), kTriangles);
    ASSERT_EQ((*mesh)->pointCount(), 4u);
    const double first = isUsdFile(form.choice.path) ? 1 / kFps : 0;  // its time codes begin with 1
    EXPECT_EQ((*mesh)->firstSeconds(), first);
    EXPECT_NEAR((*mesh)->lastSeconds(), first + 4 / kFps, 1e-7);
    EXPECT_TRUE((*mesh)->warnings().empty());
    for (const double frame : {-3.0, 0.0, 0.25, 1.0, 2.5, 3.75, 4.0, 9.0}) {
      const double within = std::clamp(frame, 0.0, 4.0);
      const auto before = static_cast<std::size_t>(std::min(within, 3.0));
      const auto a = pointsAt(before), b = pointsAt(before + 1);
      const auto found = (*mesh)->pointsAt(first + frame / kFps);
      for (std::size_t p = 0; p < 4; ++p) {
        const Vec3d expected = (a[p] + (b[p] - a[p]) * (within - static_cast<double>(before))) * 0.01;
        EXPECT_LT(length(found[p] - expected), 1e-8) << "point " << p << " of frame " << frame;
      }
    }
  }
}

TEST(MeshMotion, IsTurnedFromTheFilesAxes) {
  const auto folder = scratchFolder("mesh_motion_axes");
  writeMeshMotion(folder, "m", kTriangles, samples(), kFps);
  for (Form& form : formsIn(folder)) {
    for (const bool upIsZ : {false, true}) {
      form.choice.up.reset();  // as ours, but for USD, which states Y
      if (isUsdFile(form.choice.path) && upIsZ) form.choice.up = FileAxis::plusZ;
      const auto own = readMeshMotion(form.choice, upIsZ);
      form.choice.up = upIsZ ? FileAxis::plusY : FileAxis::plusZ;
      const auto turned = readMeshMotion(form.choice, upIsZ);
      ASSERT_TRUE(own && turned);
      const auto points = (*own)->pointsAt(0.1), found = (*turned)->pointsAt(0.1);
      for (std::size_t p = 0; p < 4; ++p) {
        const Vec3d x = points[p];
        const Vec3d expected = upIsZ ? Vec3d{x.x, -x.z, x.y} : Vec3d{x.x, x.z, -x.y};
        EXPECT_LT(length(found[p] - expected), 1e-7) << form.name << ", up is Z: " << upIsZ;
      }
    }
  }
}

// MDD files of left-handed programs have Z the other way round than the OBJ file beside them; points in a
// plane say nothing.
TEST(MeshMotion, CachesThatAreMirroredAreTurnedRound) {
  const auto folder = scratchFolder("mesh_motion_mirrored");
  auto all = samples();
  all.erase(all.begin());  // which lies in a plane
  for (Form& form : formsIn(folder)) {
    if (form.choice.cache.empty()) continue;
    SCOPED_TRACE(form.name);
    writeMeshMotion(folder, "m", kTriangles, all, kFps);
    const auto plain = readMeshMotion(form.choice, false);
    ASSERT_TRUE(plain);
    EXPECT_TRUE((*plain)->warnings().empty());
    auto mirrored = all;
    for (auto& points : mirrored)
      for (Vec3d& p : points) p.z = -p.z;
    writeBytes(folder / "m.pc2", pc2Bytes(mirrored));
    writeBytes(folder / "m.mdd", mddBytes(mirrored, 1 / kFps));
    const auto turned = readMeshMotion(form.choice, false);
    ASSERT_TRUE(turned) << turned.error().message;
    EXPECT_EQ((*turned)->warnings().size(), 1u);
    EXPECT_EQ((*turned)->pointsAt(0.1), (*plain)->pointsAt(0.1));
    writeMeshMotion(folder, "m", {{0, 1, 2}},
                    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, -1}, {}}}, kFps);
    const auto sheet = readMeshMotion(form.choice, false);
    ASSERT_TRUE(sheet);
    EXPECT_TRUE((*sheet)->warnings().empty());
  }
}

// A change of topology names the file and what changed; so does a file that ends early or late.
TEST(MeshMotion, RefusesOtherTopologies) {
  const auto folder = scratchFolder("mesh_motion_topology");
  writeMeshMotion(folder, "m", kTriangles, samples(), kFps);
  const auto forms = formsIn(folder);
  const auto more = [](std::vector<std::vector<Vec3d>> all) {
    for (auto& points : all) points.push_back({});
    return all;
  };
  writeBytes(folder / "m.pc2", pc2Bytes(more(samples())));
  EXPECT_NE(problemOf(forms[0].choice).find("m.pc2: found 5 points; expected 4, as many as"),
            std::string::npos)
      << problemOf(forms[0].choice);
  writeBytes(folder / "m.mdd", mddBytes(more(samples()), 1 / kFps));
  EXPECT_NE(problemOf(forms[1].choice).find("m.mdd: found 5 points; expected 4"), std::string::npos);

  Triangles fewer = kTriangles, other = kTriangles;
  fewer.pop_back();
  std::swap(other[1][0], other[1][1]);
  struct Case {
    std::string text, message;
  };
  for (const Case& c : {Case{objText(more(samples())[2], kTriangles), "found 5 points; expected 4"},
                        Case{objText(pointsAt(2), fewer), "found 3 triangles; expected 4"},
                        Case{objText(pointsAt(2), other), "found triangle 2 between other points"},
                        Case{"v 0 0\n", "line 1"}}) {
    writeBytes(folder / "m.0009.obj", c.text);
    const std::string problem = problemOf(forms[2].choice);
    EXPECT_NE(problem.find("m.0009.obj"), std::string::npos) << problem;
    EXPECT_NE(problem.find(c.message), std::string::npos) << problem;
  }
}

std::string usdProblemOf(const std::string& text, const UsdMeshChoice& choice = {}) {
  const auto mesh = readUsdMesh(std::as_bytes(std::span(text)), "m.usda", choice);
  return mesh ? "" : mesh.error().message;
}

// Points and transforms have samples at different times; each goes straight between its own.
TEST(UsdMesh, FollowsTransformsOfAllPrimsAbove) {
  const std::string mesh =
      usdaText(kTriangles, samples(), kFps,
               "  double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 4: (0, 3, 0) }\n"
               "  uniform token[] xformOpOrder = [\"xformOp:translate\"]\n");
  const std::size_t at = mesh.find("def Mesh");
  const std::string text = mesh.substr(0, at) +
                           "def Xform \"Above\"\n{\n  float xformOp:rotateY.timeSamples = { 2: 0, 3: 90 }\n"
                           "  uniform token[] xformOpOrder = [\"xformOp:rotateY\"]\n" +
                           mesh.substr(at) + "}\n";
  const auto read = readUsdMesh(std::as_bytes(std::span(text)), "m.usda");
  ASSERT_TRUE(read) << read.error().message;
  for (const double code : {1.0, 2.0, 3.0, 3.5, 4.0, 5.0, 7.0}) {
    const double within = std::min(code, 5.0);
    const auto k = static_cast<std::size_t>(std::min(within, 4.0)) - 1;
    const auto a = pointsAt(k), b = pointsAt(k + 1);
    const double up = std::min(code, 4.0) - 1;
    const auto found = (*read)->pointsAt(code / kFps);
    for (std::size_t p = 0; p < 4; ++p) {
      Vec3d x = a[p] + (b[p] - a[p]) * (within - 1 - static_cast<double>(k)) + Vec3d{0, up, 0};
      if (code >= 3) x = {x.z, x.y, -x.x};
      EXPECT_LT(length(found[p] - x), 1e-6) << "point " << p << " at " << code;
    }
  }
}

TEST(UsdMesh, FacesAreFansSeenFromOutside) {
  const std::string square =
      "#usda 1.0\ndef Mesh \"A\"\n{\n  point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0)]\n"
      "  int[] faceVertexCounts = [4]\n  int[] faceVertexIndices = [0, 1, 2, 3]\n";
  const auto trianglesOf = [&](const std::string& more) {
    const std::string text = square + more + "}\n";
    const auto mesh = readUsdMesh(std::as_bytes(std::span(text)), "m.usda");
    EXPECT_TRUE(mesh) << mesh.error().message;
    if (!mesh) return Triangles{};
    EXPECT_EQ((*mesh)->warnings().size(), 2u) << "it is a subdivision surface, and does not move";
    EXPECT_NEAR(length((*mesh)->pointsAt(0)[2]), std::sqrt(2.0), 1e-6) << "centimetres";
    return (*mesh)->triangles();
  };
  EXPECT_EQ(trianglesOf(""), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  const Triangles turned{{0, 2, 1}, {0, 3, 2}};
  const std::string left = "  uniform token orientation = \"leftHanded\"\n";
  const std::string mirrored =
      "  float3 xformOp:scale = (1, 1, -1)\n  uniform token[] xformOpOrder = [\"xformOp:scale\"]\n";
  EXPECT_EQ(trianglesOf(left), turned);
  EXPECT_EQ(trianglesOf(mirrored), turned);
  EXPECT_EQ(trianglesOf(left + mirrored), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(UsdMesh, SaysWhatItCannotUse) {
  const std::string good = usdaText(kTriangles, samples(), kFps);
  ASSERT_EQ(usdProblemOf(good), "");
  auto longer = samples();
  longer[3].push_back({});
  const auto with = [&](const std::string& line) { return usdaText(kTriangles, samples(), kFps, line); };
  struct Case {
    std::string text, message;
    UsdMeshChoice choice{};
  };
  const std::string two = good + good.substr(good.find("def Mesh"));
  for (const Case& c :
       {Case{usdaText(kTriangles, longer, kFps), "m.usda: /M: found 5 points at time 4; expected 4"},
        Case{with("  int[] faceVertexIndices.timeSamples = { 1: [0, 1, 2], 2: [0, 2, 1] }\n"),
             "faceVertexIndices changes at time 2"},
        Case{with("  int[] faceVertexCounts.timeSamples = { 1: [3, 3], 2: [6] }\n"),
             "faceVertexCounts changes at time 2"},
        Case{usdaText({{0, 1, 9}}, samples(), kFps), "a triangle has the corner 9"},
        Case{usdaText({}, samples(), kFps), "/M: has no faceVertexCounts"},
        Case{with("  rel skel:skeleton = </S>\n"),
             "skel:skeleton names '/S', where there is no prim; expected a Skeleton"},
        Case{"#usda 1.0\ndef Xform \"A\"\n{\n}\n", "found no Mesh prim"}, Case{two, "has 2 Mesh prims"},
        Case{good, "there is no Mesh prim 'N'; there are /M", {.prim = "N"}},
        Case{with("  token visibility = \"inherited\"\n  point3f[] points.connect = </A.x>\n"),
             "points are given by a connection"}})
    EXPECT_NE(usdProblemOf(c.text, c.choice).find(c.message), std::string::npos)
        << usdProblemOf(c.text, c.choice) << "\nexpected: " << c.message;
  EXPECT_EQ(usdProblemOf(good, {.prim = "/M"}), "");
}

// A film of Blender's, where there is one: the cape of the bend data waves and stays a sheet of 14 x 14
// quads.
TEST(UsdMesh, ReadsTheCape) {
  RINGLET_NEEDS_DATA(path, "bend/cape.usda");
  const auto read = readMeshMotion({.path = path}, true);
  ASSERT_TRUE(read) << read.error().message;
  const auto& mesh = *read;
  EXPECT_EQ(mesh->pointCount(), 225u);
  EXPECT_EQ(mesh->triangles().size(), 392u);
  EXPECT_NEAR(mesh->lastSeconds() - mesh->firstSeconds(), 0.5, 1e-9);
  EXPECT_GT(length(mesh->pointsAt(0.3)[224] - mesh->pointsAt(0.1)[224]), 0.01);
}

TEST(MeshMotion, SaysWhatItCannotRead) {
  const auto folder = scratchFolder("mesh_motion_refusals");
  writeMeshMotion(folder, "m", kTriangles, samples(), kFps);
  writeBytes(folder / "m.fbx", "x");
  const auto file = [&](const char* name) { return folder / name; };
  struct Case {
    MeshMotionChoice choice;
    const char* message;
  };
  for (const Case& c : {Case{{.path = file("m.obj")}, "has one pose; expected a point cache"},
                        Case{{.path = file("n.####.obj")}, "found no file with a number in place of '#'"},
                        Case{{.path = file("m.obj"), .cache = file("m.obj")}, "expected a point cache"},
                        Case{{.path = file("m.obj"), .cache = file("none.pc2")}, "none.pc2"},
                        Case{{.path = file("none.obj"), .cache = file("m.pc2")}, "none.obj"},
                        Case{{.path = file("m.glb"), .cache = file("m.pc2")}, "only an OBJ file has one"},
                        Case{{.path = file("m.fbx")}, "a mesh that moves is read from .gltf"}})
    EXPECT_NE(problemOf(c.choice).find(c.message), std::string::npos) << problemOf(c.choice);
}

// Every shorter file and every changed byte is read or refused, whole.
TEST(PointCache, SurvivesBrokenFiles) {
  for (const char* name : {"m.pc2", "m.mdd"}) {
    const std::string whole =
        std::string(name) == "m.pc2" ? pc2Bytes(samples(2)) : mddBytes(samples(2), 1 / kFps);
    const auto read = [&](const std::string& bytes) {
      return readPointCache(std::as_bytes(std::span(bytes)), name, kFps);
    };
    ASSERT_TRUE(read(whole));
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_FALSE(read(whole.substr(0, size))) << name << " of " << size << " bytes";
    EXPECT_FALSE(read(whole + "x")) << name;
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const char flip : {'\x01', '\x80', '\xff'}) {
        std::string broken = whole;
        broken[at] = static_cast<char>(broken[at] ^ flip);
        const auto samples = read(broken);
        if (!samples) continue;
        const auto mesh = SampledMesh::of(kTriangles, *samples);
        if (mesh) {
          EXPECT_TRUE(isFinite(mesh->pointsAt(0.01)[1])) << name << ", byte " << at;
        }
      }
    }
  }
}

TEST(MeshSequence, FindsItsFilesByNumber) {
  const auto folder = scratchFolder("mesh_sequence");
  for (const char* name :
       {"a.2.obj", "a.10.obj", "a.010.obj", "a.x.obj", "a..obj", "a.3.OBJ", "b.1.obj", "a.-1.obj"})
    writeBytes(folder / name, "");
  const auto names = [&](const char* pattern) {
    std::vector<std::string> found;
    for (const auto& path : meshSequenceFiles(folder / pattern)) found.push_back(path.filename().string());
    return found;
  };
  EXPECT_EQ(names("a.#.obj"), (std::vector<std::string>{"a.2.obj", "a.010.obj", "a.10.obj"}));
  EXPECT_EQ(names("a.##.obj"), (std::vector<std::string>{"a.010.obj", "a.10.obj"}));
  EXPECT_EQ(names("c.#.obj"), std::vector<std::string>{});
  EXPECT_TRUE(meshSequenceFiles(folder / "none" / "a.#.obj").empty());
}

}  // namespace
}  // namespace ringlet::test::mesh_motion_test
