// motion/skinned_mesh.h and scalp.h: against closed forms, a rigid motion, and all triangles one by one.
#include "ringlet/motion/scalp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "ringlet/bodies/distance_to_triangle.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/motion/skinned_mesh.h"
#include "tests/motion/gltf_samples.h"

namespace ringlet::test::scalp_test {

namespace {

std::shared_ptr<const SkinnedMesh> meshOf(const GltfBuilder& builder, const SkinnedMeshChoice& choice = {}) {
  auto file = parseGltf(bytesOf(builder.glb()), "");
  EXPECT_TRUE(file) << file.error().message;
  if (!file) return nullptr;
  auto mesh = SkinnedMesh::of(std::make_shared<const GltfFile>(std::move(*file)), choice);
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? std::make_shared<const SkinnedMesh>(std::move(*mesh)) : nullptr;
}

std::string problemOf(const GltfBuilder& builder, const SkinnedMeshChoice& choice = {}) {
  auto file = parseGltf(bytesOf(builder.text()), "");
  if (!file) return "file: " + file.error().message;
  const auto mesh = SkinnedMesh::of(std::make_shared<const GltfFile>(std::move(*file)), choice);
  return mesh ? "" : mesh.error().message;
}

// Random triangles of all sizes, on a node that turns and travels.
GltfBuilder travellingTriangles(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.1, 0.1), small(-0.02, 0.02);
  std::vector<double> points;
  for (int k = 0; k < count; ++k) {
    const Vec3d middle{place(random), place(random), place(random)};
    for (int corner = 0; corner < 3; ++corner)
      points.insert(points.end(),
                    {middle.x + small(random), middle.y + small(random), middle.z + small(random)});
  }
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}, {"mesh", 0}});
  file.root["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", file.floats(points, "VEC3")}}}}}}}};
  const double half = std::sqrt(0.5);
  file.channel(0, head, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0.6 * half, 0, 0.8 * half, half});
  file.channel(0, head, "translation", "LINEAR", {0, 1}, {0, 1.5, 0, 2, 1, 0.5});
  return file;
}

std::vector<Vec3d> randomPlaces(std::size_t count, Vec3d around, double reach) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-reach, reach);
  std::vector<Vec3d> places;
  for (std::size_t k = 0; k < count; ++k)
    places.push_back(around + Vec3d{place(random), place(random), place(random)});
  return places;
}

TEST(SkinnedMesh, BendsAsItsJointsDo) {
  const std::tuple<int, int, double> cases[] = {{5121, 5126, 1e-6}, {5123, 5123, 2e-5}, {5121, 5121, 4e-3}};
  for (const auto& [jointType, weightType, tolerance] : cases) {
    const auto mesh = meshOf(bendingStrip(8, jointType, weightType));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->triangles().size(), 16u);
    EXPECT_EQ(mesh->warnings().size(), 0u);
    EXPECT_EQ(mesh->lastSeconds(), 1);
    const std::vector<Vec3d> rest = mesh->pointsAt(0);
    for (double t : {0.0, 0.3, 1.0}) {
      const std::vector<Vec3d> points = mesh->pointsAt(t);
      for (std::size_t p = 0; p < points.size(); ++p)
        EXPECT_LT(length(points[p] - bentPoint(rest[p], t)), tolerance) << p << " " << t;
    }
  }
}

// The strip with a morph target that lifts all of it, and a sparse one that moves point 3 aside.
GltfBuilder morphingStrip() {
  GltfBuilder file = bendingStrip(8, 5121, 5126);
  std::vector<double> lifts;
  for (int p = 0; p < 18; ++p) lifts.insert(lifts.end(), {0, 0.1, 0});
  const int lift = file.floats(lifts, "VEC3");
  const int index = file.accessor(std::vector<std::uint8_t>{3}, "SCALAR", 5121);
  const int aside = file.floats({0, 0, 0.3}, "VEC3");
  const auto viewOf = [&](int a) {
    return file.root["accessors"][static_cast<std::size_t>(a)]["bufferView"];
  };
  file.root["accessors"].push_back({{"componentType", 5126},
                                    {"count", 18},
                                    {"type", "VEC3"},
                                    {"sparse",
                                     {{"count", 1},
                                      {"indices", {{"bufferView", viewOf(index)}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", viewOf(aside)}}}}}});
  auto& mesh = file.root["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", lift}},
                                      {{"POSITION", file.root["accessors"].size() - 1}}};
  mesh["weights"] = {0.5, 1};
  return file;
}

TEST(SkinnedMesh, MorphsBeforeItBends) {
  const auto plain = meshOf(bendingStrip(8, 5121, 5126));
  ASSERT_TRUE(plain);
  const std::vector<Vec3d> rest = plain->pointsAt(0);
  const auto expectAt = [&](const GltfBuilder& file, double t, double lift, double aside) {
    const auto mesh = meshOf(file);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->warnings().size(), 0u);
    const std::vector<Vec3d> points = mesh->pointsAt(t);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Vec3d shape = rest[p] + Vec3d{0, 0.1 * lift, p == 3 ? 0.3 * aside : 0};
      EXPECT_LT(length(points[p] - bentPoint(shape, t)), 1e-6) << p << " " << t;
    }
  };
  GltfBuilder file = morphingStrip();
  expectAt(file, 0.3, 0.5, 1);  // the mesh's weights
  file.root["nodes"][2]["weights"] = {2, 0};
  expectAt(file, 1, 2, 0);  // its node's
  GltfBuilder linear = file, step = file, cubic = file;
  linear.channel(0, 2, "weights", "LINEAR", {0, 1}, {0, 1, 1, -1});
  step.channel(0, 2, "weights", "STEP", {0, 1}, {0, 1, 1, -1});
  cubic.channel(0, 2, "weights", "CUBICSPLINE", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0});
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const double eased = t * t * (3 - 2 * t), late = t < 1 ? 0 : 1;
    expectAt(linear, t, t, 1 - 2 * t);
    expectAt(step, t, late, 1 - 2 * late);
    expectAt(cubic, t, eased, 1 - 2 * eased);
  }
}

// A file in which nothing but weights is animated lasts as long as these.
TEST(SkinnedMesh, LastsAsLongAsItMorphs) {
  GltfBuilder file = morphingStrip();
  file.root["animations"] = nlohmann::json::array();
  file.channel(0, 2, "weights", "LINEAR", {0.5, 3}, {0, 0, 1, 0});
  const auto mesh = meshOf(file);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->firstSeconds(), 0.5);
  EXPECT_EQ(mesh->lastSeconds(), 3);
  EXPECT_GT(length(mesh->pointsAt(3)[0] - mesh->pointsAt(0.5)[0]), 0.09);
}

TEST(SkinnedMesh, FollowsItsNodeWithoutASkin) {
  const auto mesh = meshOf(travellingTriangles(5), {.placement = {.metresPerUnit = 2, .upIsZ = true}});
  ASSERT_TRUE(mesh);
  const auto plain = meshOf(travellingTriangles(5));
  ASSERT_TRUE(plain);
  const std::vector<Vec3d> lifted = mesh->pointsAt(0.4), points = plain->pointsAt(0.4);
  const Vec3d gone = points[0] - plain->pointsAt(0)[0];
  EXPECT_GT(length(gone), 0.1);
  for (std::size_t p = 0; p < points.size(); ++p)
    EXPECT_LT(length(lifted[p] - Vec3d{points[p].x, -points[p].z, points[p].y} * 2.0), 1e-12);
}

TEST(SkinnedMesh, SaysWhatItCannotUse) {
  const auto strip = [](auto&& change) {
    GltfBuilder file = bendingStrip(2, 5121, 5126);
    change(file.root);
    return problemOf(file);
  };
  using nlohmann::json;
  const std::pair<std::string, const char*> cases[] = {
      {strip([](json&) {}), ""},
      {strip([](json& root) { root["meshes"][0]["primitives"][0]["mode"] = 5; }), "no triangles"},
      {strip([](json& root) { root["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
       "no POSITION"},
      {strip([](json& root) {
         root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
       }),
       "KHR_draco_mesh_compression"},
      {strip([](json& root) {
         root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 3}}};
       }),
       "POSITION of a morph target"},
      {strip([](json& root) {
         root["accessors"].push_back(root["accessors"][1]);
         root["accessors"].back()["count"] = 2;
         root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", root["accessors"].size() - 1}}};
       }),
       "morph target 0 has 2 points, not 6"},
      {strip([](json& root) { root["accessors"][1]["count"] = 5; }), "triangle 3 has point 5 of 5"},
      {strip([](json& root) { root["accessors"][3]["count"] = 11; }), "no triangles"},
      {strip([](json& root) { root["accessors"][3]["byteOffset"] = 2, root["accessors"][3]["count"] = 9; }),
       ""},
      {strip([](json& root) { root["accessors"][2]["count"] = 5; }), "6 points have 5 joints"},
      {strip([](json& root) { root["skins"][0]["joints"] = {0}; }), "follow 2 joints, its skin has 1"},
      {strip([](json& root) {
         root["skins"][0]["joints"] = {0, 9};
       }),
       "joint 9 of 3"},
      {strip([](json& root) { root["accessors"][4]["count"] = 1; }), "2 joints have 1 inverse bind"},
      {problemOf(bendingStrip(2, 5121, 5126), {.node = "stirp"}), "did you mean strip?"},
      {problemOf(bendingStrip(2, 5121, 5126), {.animation = "9"}), "it has take0"},
      {problemOf(GltfBuilder{}), "no mesh"},
  };
  for (const auto& [problem, expected] : cases) {
    if (*expected == '\0') {
      EXPECT_EQ(problem, "");
    } else {
      EXPECT_NE(problem.find(expected), std::string::npos) << expected << ": " << problem;
    }
  }
  GltfBuilder twice = bendingStrip(2, 5121, 5126);
  twice.node({{"name", "other"}, {"mesh", 0}});
  EXPECT_NE(problemOf(twice).find("2 meshes, so that one must be named: strip, other"), std::string::npos)
      << problemOf(twice);
  EXPECT_EQ(problemOf(twice, {.node = "other"}), "");
  GltfBuilder mixed = bendingStrip(2, 5121, 5126);
  auto& primitives = mixed.root["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[1]["mode"] = 1;
  const auto mesh = meshOf(mixed);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles().size(), 8u) << "two primitives of triangles";
  EXPECT_EQ(mesh->pointCount(), 12u);
  ASSERT_EQ(mesh->warnings().size(), 1u);
  EXPECT_NE(mesh->warnings()[0].find("primitive 1 is of mode 1"), std::string::npos);
}

void tryAll(const std::string& bytes) {
  auto file = parseGltf(bytesOf(bytes), "");
  if (!file) return;
  for (std::size_t n = 0; n < file->nodes.size(); ++n) {
    for (const GltfAnimation& animation : file->animations) (void)file->motionOf(n, &animation, {}, 10);
  }
  auto mesh = SkinnedMesh::of(std::make_shared<const GltfFile>(std::move(*file)));
  if (!mesh) return;
  const auto shared = std::make_shared<const SkinnedMesh>(std::move(*mesh));
  const auto scalp = Scalp::bind(shared, shared->pointsAt(0), 0, 1);
  if (scalp) (void)scalp->posesAt(0.5);
}

// Bytes changed anywhere; and whatever stands in the text replaced by what is absurd there.
TEST(SkinnedMesh, SurvivesBrokenFiles) {
  using nlohmann::json;
  GltfBuilder builder = bendingStrip(1, 5121, 5126);
  const std::string whole = builder.glb();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    for (char c : {'\0', '9', '\x7f', '\xff'}) {
      changed[at] = c;
      tryAll(changed);
    }
  }
  builder.root["accessors"].push_back({{"componentType", 5126},
                                       {"count", 4},
                                       {"type", "VEC3"},
                                       {"sparse",
                                        {{"count", 1},
                                         {"indices", {{"bufferView", 3}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", 1}}}}}});
  builder.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7;
  tryAll(builder.glb());
  const json tree = builder.root.flatten();
  const json absurd[] = {-1,
                         0,
                         1,
                         3,
                         255,
                         65536,
                         2147483647,
                         -2147483648,
                         4294967295u,
                         1ull << 62,
                         18446744073709551615ull,
                         1e300,
                         -0.5,
                         "x",
                         nullptr,
                         json::array(),
                         json::object()};
  for (const auto& [path, value] : tree.items()) {
    for (const json& other : absurd) {
      GltfBuilder changed = builder;
      changed.root[json::json_pointer(path)] = other;
      tryAll(changed.glb());
    }
  }
}

TEST(Scalp, FindsTheNearestOfAllTriangles) {
  const auto mesh = meshOf(travellingTriangles(300));
  ASSERT_TRUE(mesh);
  const std::vector<Vec3d> points = mesh->pointsAt(0);
  const TriangleTree tree({points, mesh->triangles()});
  for (Vec3d p : randomPlaces(500, {0, 1.5, 0}, 0.2)) {
    double least = INFINITY;
    for (const auto& [a, b, c] : mesh->triangles()) {
      const auto w = closestShares(p, points[a], points[b], points[c]);
      least = std::min(least, length(p - points[a] * w[0] - points[b] * w[1] - points[c] * w[2]));
    }
    const auto found = tree.nearest(p);
    EXPECT_NEAR(found.distance, least, 1e-14);
    const auto [a, b, c] = mesh->triangles()[found.triangle];
    EXPECT_NEAR(length(p - closestOnTriangle(p, points[a], points[b], points[c])), least, 1e-14);
  }
}

// Nothing on a triangle is nearer: moving along an edge from the place found, inwards, leads away.
TEST(Scalp, NearestPlacesAreNearest) {
  const Vec3d a{0, 0, 0}, b{1, 0.2, 0}, c{0.3, 0.9, 0.4};
  for (Vec3d p : randomPlaces(2000, {0.4, 0.4, 0.1}, 1.5)) {
    const auto w = closestShares(p, a, b, c);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    const Vec3d place = a * w[0] + b * w[1] + c * w[2];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GE(w[k], -1e-15);
    // A convex set: nearest exactly where all of it is on the far side of the plane through the place.
    for (Vec3d corner : {a, b, c}) EXPECT_LT(dot(p - place, corner - place), 1e-12);
  }
}

// Three corners in a row: no triangle has a frame, and no root a place.
TEST(Scalp, TrianglesWithoutAnAreaHoldNothing) {
  GltfBuilder builder;
  const int positions = builder.floats({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3");
  builder.root["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  builder.node({{"name", "line"}, {"mesh", 0}});
  const auto mesh = meshOf(builder);
  ASSERT_TRUE(mesh);
  const std::vector<Vec3d> roots{{1, 0, 0}};
  const auto scalp = Scalp::bind(mesh, roots, 0, 10);
  ASSERT_FALSE(scalp);
  EXPECT_NE(scalp.error().message.find("1 of 1 roots"), std::string::npos) << scalp.error().message;
}

TEST(Scalp, StartsWhereItIsBound) {
  const auto mesh = meshOf(bendingStrip(8, 5121, 5126));
  ASSERT_TRUE(mesh);
  const std::vector<Vec3d> roots = randomPlaces(100, {1, 0.5, 0}, 0.5);
  for (double t0 : {0.0, 0.7}) {
    const auto scalp = Scalp::bind(mesh, roots, t0, 5);
    ASSERT_TRUE(scalp) << scalp.error().message;
    for (const HeadPose& pose : scalp->posesAt(t0)) {
      EXPECT_LT(length(pose.position), 1e-12);
      EXPECT_LT(length(Vec3d{pose.rotation.x, pose.rotation.y, pose.rotation.z}), 1e-12);
    }
  }
}

TEST(Scalp, FollowsARigidMotion) {
  const GltfBuilder builder = travellingTriangles(200);
  const auto mesh = meshOf(builder);
  const auto file = parseGltf(bytesOf(builder.glb()), "");
  ASSERT_TRUE(mesh && file);
  const auto scalp = Scalp::bind(mesh, randomPlaces(300, {0, 1.5, 0}, 0.12), 0.1, 1);
  ASSERT_TRUE(scalp) << scalp.error().message;
  const auto at = [&](double t) {
    const Affine world = file->worldAt(0, &file->animations[0], t);
    return HeadPose{world.position, *nearestRotation(world)};
  };
  const HeadPose start = at(0.1);
  for (double t : {0.0, 0.35, 1.0}) {
    const HeadPose now = at(t);
    const Quatd turn = now.rotation * start.rotation.conjugate();
    const Vec3d place = now.position - rotate(turn, start.position);
    for (const HeadPose& pose : scalp->posesAt(t)) {
      ASSERT_LT(length(pose.position - place), 1e-9) << t;
      const Quatd off = pose.rotation * turn.conjugate();
      ASSERT_LT(length(Vec3d{off.x, off.y, off.z}), 1e-9) << t;
    }
  }
}

// On the strip as it bends, closed forms: a root on it stays at its share of its triangle, one above it at
// its distance from it.
TEST(Scalp, StaysOnABendingTriangle) {
  const auto mesh = meshOf(bendingStrip(8, 5121, 5126));
  ASSERT_TRUE(mesh);
  std::vector<Vec3d> roots;
  for (Vec3d p : randomPlaces(50, {1, 0, 0}, 0.9))
    roots.insert(roots.end(), {{p.x, 0, p.z / 10}, {p.x, 0.05, p.z / 10}});
  const auto scalp = Scalp::bind(mesh, roots, 0, 0.051);
  ASSERT_TRUE(scalp) << scalp.error().message;
  EXPECT_NEAR(scalp->farthestRoot(), 0.05, 1e-12);
  const std::vector<Vec3d> rest = mesh->pointsAt(0);
  for (double t : {0.2, 0.5, 1.0}) {
    const std::vector<HeadPose> poses = scalp->posesAt(t);
    for (std::size_t r = 0; r < roots.size(); ++r) {
      const Vec3d root = poses[r].position + rotate(poses[r].rotation, roots[r]);
      const auto [a, b, c] = mesh->triangles()[scalp->triangleOf(r)];
      const auto w = closestShares(roots[r], rest[a], rest[b], rest[c]);
      const Vec3d pa = bentPoint(rest[a], t), pb = bentPoint(rest[b], t), pc = bentPoint(rest[c], t);
      const Vec3d normal = normalizedOr(cross(pb - pa, pc - pa), Vec3d{});
      EXPECT_LT(length(root - (pa * w[0] + pb * w[1] + pc * w[2]) - normal * roots[r].y), 1e-6) << r;
    }
  }
}

TEST(Scalp, CountsRootsThatAreElsewhere) {
  const auto mesh = meshOf(bendingStrip(8, 5121, 5126));
  ASSERT_TRUE(mesh);
  const std::vector<Vec3d> roots{{1, 0, 0}, {1, 3, 0}, {1, 0.5, 0}, {NAN, 0, 0}, {1, 0.1, 0}};
  const auto scalp = Scalp::bind(mesh, roots, 0, 0.2);
  ASSERT_FALSE(scalp);
  EXPECT_NE(scalp.error().message.find("3 of 5 roots"), std::string::npos) << scalp.error().message;
  EXPECT_NE(scalp.error().message.find("strand 3"), std::string::npos) << scalp.error().message;
  EXPECT_TRUE(Scalp::bind(mesh, {}, 0, 0.2)->posesAt(1).empty());
}

// As many roots as a head has: each goes where it goes when it is bound alone.
TEST(Scalp, BindsTenThousandRootsAsEachAlone) {
  const auto mesh = meshOf(travellingTriangles(10000));
  ASSERT_TRUE(mesh);
  const std::vector<Vec3d> roots = randomPlaces(10000, {0, 1.5, 0}, 0.15);
  const auto scalp = Scalp::bind(mesh, roots, 0, 1);
  ASSERT_TRUE(scalp);
  const std::vector<HeadPose> poses = scalp->posesAt(0.5);
  ASSERT_EQ(poses.size(), roots.size());
  for (std::size_t r = 0; r < roots.size(); r += 999) {
    const auto alone = Scalp::bind(mesh, std::span(roots).subspan(r, 1), 0, 1);
    ASSERT_TRUE(alone);
    EXPECT_EQ(scalp->triangleOf(r), alone->triangleOf(0)) << r;
    EXPECT_EQ(poses[r].position, alone->posesAt(0.5)[0].position) << r;
  }
}

}  // namespace
}  // namespace ringlet::test::scalp_test
