// motion/gltf_file.h, on files the test writes, against closed forms.
#include "ringlet/motion/gltf_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "tests/motion/gltf_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::gltf_file_test {
namespace {

using nlohmann::json;
constexpr double kPi = std::numbers::pi;
constexpr double kFloat = 1e-6;  // of numbers that went through the file's single precision

GltfFile parsed(const std::string& text) {
  auto file = parseGltf(bytesOf(text), "");
  EXPECT_TRUE(file) << file.error().message;
  return file ? std::move(*file) : GltfFile{};
}

double apart(Vec3d a, Vec3d b) { return length(a - b); }
double apart(Quatd a, Quatd b) {
  const Quatd d = a * b.conjugate();
  return 2 * std::atan2(length(Vec3d{d.x, d.y, d.z}), std::abs(d.w));
}
json list(Quatd q) { return {q.x, q.y, q.z, q.w}; }
void append(std::vector<double>& to, Quatd q) { to.insert(to.end(), {q.x, q.y, q.z, q.w}); }
Quatd turnZ(double angle) { return fromRotationVector(Vec3d{0, 0, angle}); }
Quatd turnX(double angle) { return fromRotationVector(Vec3d{angle, 0, 0}); }

TEST(GltfFile, NestedNodesWithScaleAndRotation) {
  GltfBuilder file;
  file.node({{"name", "Head"}, {"translation", {1, 0, 0}}, {"rotation", list(turnX(kPi / 2))}});
  file.node({{"name", "Neck"},
             {"translation", {1, 2, 3}},
             {"rotation", list(turnZ(kPi / 2))},
             {"scale", {2, 2, 2}},
             {"children", {0}}});
  // The same as a matrix, column by column: X to 3 Y, Y to -3 X, Z to 3 Z.
  file.node(
      {{"name", "Root"}, {"matrix", {0, 3, 0, 0, -3, 0, 0, 0, 0, 0, 3, 0, 10, 0, 0, 1}}, {"children", {1}}});
  const GltfFile read = parsed(file.text());
  const auto motion = read.motionOf(*read.find("Head"), nullptr, {}, {});
  ASSERT_TRUE(motion) << motion.error().message;
  ASSERT_EQ(motion->poses.size(), 1u) << "without an animation it stands still";
  // Neck carries (1, 0, 0) to (1, 4, 3), and Root that to (10 - 12, 3, 9).
  EXPECT_LT(apart(motion->poses[0].position, {-2, 3, 9}), 1e-12);
  EXPECT_LT(apart(motion->poses[0].rotation, turnZ(kPi) * turnX(kPi / 2)), 1e-12);
}

// M = R S with S symmetric and positive: R is the rotation nearest to M.
TEST(GltfFile, TakesTheNearestRotationOfASkewedFrame) {
  const Quatd turn = normalized(Quatd{0.3, -0.5, 0.2, 0.7});
  const Quatd along = normalized(Quatd{0.1, 0.4, -0.2, 0.9});
  const Affine stretch = affineOf({}, along, {0.01, 1, 40}) * affineOf({}, along.conjugate(), {1, 1, 1});
  const auto found = nearestRotation(affineOf({}, turn, {1, 1, 1}) * stretch);
  ASSERT_TRUE(found);
  EXPECT_LT(apart(*found, turn), 1e-10);
  const auto mirrored = nearestRotation(affineOf({}, turn, {-2, 2, 2}));
  ASSERT_TRUE(mirrored);
  EXPECT_LT(apart(*mirrored, turn), 1e-12);
  EXPECT_FALSE(nearestRotation(affineOf({}, turn, {1, 0, 1})));
  EXPECT_FALSE(nearestRotation(affineOf({}, turn, {1, INFINITY, 1})));
  for (double size : {1e-200, 1e200})
    EXPECT_LT(apart(*nearestRotation(affineOf({}, turn, {size, size, size})), turn), 1e-12);
}

TEST(GltfFile, InterpolatesLinearly) {
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  file.channel(0, head, "translation", "LINEAR", {0.5, 1.5}, {0, 0, 0, 4, -2, 8});
  std::vector<double> turns;
  append(turns, turnZ(0));
  append(turns, Quatd{0, 0, -std::sin(kPi / 3), -std::cos(kPi / 3)});  // 120 degrees, the other sign
  file.channel(0, head, "rotation", "LINEAR", {0.5, 1.5}, turns);
  file.channel(0, head, "scale", "LINEAR", {0.5, 1}, {1, 1, 1, 3, 3, 3});
  const GltfFile read = parsed(file.text());
  const GltfAnimation* take = &read.animations.front();
  EXPECT_EQ(take->firstSeconds, 0.5);
  EXPECT_EQ(take->lastSeconds, 1.5);
  for (double s : {-1.0, 0.0, 0.25, 0.6, 1.0, 3.0}) {
    const double part = std::clamp(s, 0.0, 1.0);
    const Affine world = read.worldAt(0, take, 0.5 + s);
    EXPECT_LT(apart(world.position, Vec3d{4, -2, 8} * part), kFloat);
    EXPECT_LT(apart(*nearestRotation(world), turnZ(part * 2 * kPi / 3)), kFloat) << s;
    EXPECT_NEAR(length(world.x), 1 + 2 * std::min(2 * part, 1.0), kFloat);
  }
}

TEST(GltfFile, HoldsSteps) {
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  file.channel(0, head, "translation", "STEP", {0, 1, 2}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
  const GltfFile read = parsed(file.text());
  const std::pair<double, double> cases[] = {{-1, 1}, {0, 1}, {0.99, 1}, {1, 2}, {1.5, 2}, {2, 3}, {9, 3}};
  for (const auto& [t, x] : cases) EXPECT_EQ(read.worldAt(0, &read.animations[0], t).position.x, x) << t;
}

// The specification's spline is Hermite's, so it is exact for a cubic whose derivatives are the tangents.
TEST(GltfFile, FollowsCubicSplines) {
  const auto cubic = [](double t) { return Vec3d{t * t * t - 2 * t, 1 - t * t, 3 * t}; };
  const auto slope = [](double t) { return Vec3d{3 * t * t - 2, -2 * t, 3}; };
  const std::vector<double> seconds{0, 0.5, 2};
  std::vector<double> values;
  for (double t : seconds) {
    for (Vec3d v : {slope(t), cubic(t), slope(t)}) values.insert(values.end(), {v.x, v.y, v.z});
  }
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  file.channel(0, head, "translation", "CUBICSPLINE", seconds, values);
  // Without tangents half way is the mean of two rotations, made unit: the rotation half way.
  std::vector<double> turns;
  for (double angle : {0.0, 2.0}) {
    turns.insert(turns.end(), {0, 0, 0, 0});
    append(turns, turnZ(angle));
    turns.insert(turns.end(), {0, 0, 0, 0});
  }
  file.channel(0, head, "rotation", "CUBICSPLINE", {0, 2}, turns);
  const GltfFile read = parsed(file.text());
  for (double t : {0.0, 0.1, 0.5, 0.9, 1.7, 2.0})
    EXPECT_LT(apart(read.worldAt(0, &read.animations[0], t).position, cubic(t)), kFloat) << t;
  EXPECT_LT(apart(*nearestRotation(read.worldAt(0, &read.animations[0], 1)), turnZ(1)), kFloat);
  const auto motion = read.motionOf(0, &read.animations[0], {}, {});
  ASSERT_TRUE(motion) << motion.error().message;
  for (double t = 0; t <= 2; t += 0.0371)
    EXPECT_LT(apart(motion->poseAt(t).position, cubic(t)), 2e-5) << "the keyframes lie close enough: " << t;
}

TEST(GltfFile, ReadsNormalizedAndSparseNumbers) {
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  const int times = file.floats({0, 1}, "SCALAR");
  // A quarter about Z in 16 bits; the sparse accessor is zero but for its second element.
  const auto half = static_cast<std::int16_t>(std::lround(32767 * std::sqrt(0.5)));
  const int turns =
      file.accessor(std::vector<std::int16_t>{0, 0, half, half, 0, 0, half, half}, "VEC4", 5122, true);
  const int indices = file.accessor(std::vector<std::uint8_t>{1}, "SCALAR", 5121);
  const int values = file.floats({7, 8, 9}, "VEC3");
  const auto viewOf = [&](int a) {
    return file.root["accessors"][static_cast<std::size_t>(a)]["bufferView"];
  };
  file.root["accessors"].push_back({{"componentType", 5126},
                                    {"count", 2},
                                    {"type", "VEC3"},
                                    {"sparse",
                                     {{"count", 1},
                                      {"indices", {{"bufferView", viewOf(indices)}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", viewOf(values)}}}}}});
  file.root["animations"] = {{{"samplers",
                               {{{"input", times}, {"output", turns}},
                                {{"input", times}, {"output", file.root["accessors"].size() - 1}}}},
                              {"channels",
                               {{{"sampler", 0}, {"target", {{"node", head}, {"path", "rotation"}}}},
                                {{"sampler", 1}, {"target", {{"node", head}, {"path", "translation"}}}},
                                {{"sampler", 1}, {"target", {{"node", head}, {"path", "weights"}}}}}}}};
  const GltfFile read = parsed(file.text());
  const GltfAnimation* take = &read.animations[0];
  EXPECT_EQ(take->channels.size(), 2u) << "morph weights move no node";
  EXPECT_LT(apart(read.worldAt(0, take, 0).position, {0, 0, 0}), 1e-12);
  EXPECT_LT(apart(read.worldAt(0, take, 1).position, {7, 8, 9}), 1e-12);
  EXPECT_LT(apart(*nearestRotation(read.worldAt(0, take, 1)), turnZ(kPi / 2)), 1e-4);
}

// Keys as close as frames are taken one by one; between others there are samples, and all keys are met.
TEST(GltfFile, SamplesAsDenselyAsKeysAreSet) {
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  const int other = file.node({{"name", "Other"}});
  std::vector<double> seconds, values;
  for (int k = 0; k <= 2400; ++k) {
    seconds.push_back(k / 24.0 + 3);
    values.insert(values.end(), {k % 7 * 0.5, static_cast<double>(k), 0});
  }
  file.channel(0, head, "translation", "LINEAR", seconds, values);
  file.channel(1, head, "translation", "LINEAR", {0, 0.3, 0.9}, {0, 0, 0, 1, 0, 0, 0, 0, 0});
  file.channel(1, other, "translation", "STEP", {0, 2}, {0, 0, 0, 1, 0, 0});
  const GltfFile read = parsed(file.text());
  const auto dense = read.motionOf(0, &read.animations[0], {}, {});
  ASSERT_TRUE(dense);
  ASSERT_EQ(dense->poses.size(), 2401u);
  EXPECT_NEAR(dense->seconds(), 100, 1e-5);
  for (std::size_t k = 0; k < dense->poses.size(); ++k)
    ASSERT_LT(apart(dense->poses[k].position, {static_cast<double>(k % 7) * 0.5, static_cast<double>(k), 0}),
              1e-3)
        << k;

  const auto sparse = read.motionOf(0, &read.animations[1], {}, {});
  ASSERT_TRUE(sparse);
  EXPECT_DOUBLE_EQ(sparse->seconds(), 2) << "as long as the animation, not as this node's part of it";
  EXPECT_LT(sparse->secondsPerKey, 1 / 119.0);
  EXPECT_LT(apart(sparse->poseAt(0.3).position, {1, 0, 0}), kFloat);
  EXPECT_LT(apart(sparse->poseAt(1.5).position, {0, 0, 0}), 1e-12);
  EXPECT_EQ(read.motionOf(0, &read.animations[1], {}, 30)->poses.size(), 61u);
  EXPECT_FALSE(read.motionOf(0, &read.animations[1], {}, 1e9));
}

TEST(GltfFile, PlacesTheFileInTheWorld) {
  GltfBuilder file;
  file.node(
      {{"name", "Head"}, {"translation", {1, 2, 3}}, {"rotation", list(fromRotationVector(Vec3d{0, 1, 0}))}});
  const GltfFile read = parsed(file.text());
  const auto motion = read.motionOf(0, nullptr, {.metresPerUnit = 0.01, .upIsZ = true}, {});
  ASSERT_TRUE(motion);
  EXPECT_LT(apart(motion->poses[0].position, {0.01, -0.03, 0.02}), 1e-15);
  EXPECT_LT(apart(motion->poses[0].rotation, turnZ(1)), 1e-12) << "about the up axis, as before";
}

TEST(GltfFile, ReadsAllThreeForms) {
  const auto folder = scratchFolder("gltf_forms");
  GltfBuilder file;
  const int head = file.node({{"name", "mixamorig:Head"}});
  file.channel(0, head, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 2, 3});
  std::ofstream(folder / "inside.gltf") << file.text();
  std::ofstream(folder / "beside.gltf") << file.textBeside("head%20way.bin");
  std::ofstream(folder / "head way.bin", std::ios::binary) << file.bytes();
  std::ofstream(folder / "binary.glb", std::ios::binary) << file.glb();
  for (const char* name : {"inside.gltf", "beside.gltf", "binary.glb"}) {
    const auto motion = readGltfMotion(folder / name);
    ASSERT_TRUE(motion) << motion.error().message;
    EXPECT_EQ(motion->seconds(), 1);
    EXPECT_LT(apart(motion->poses.back().position, {1, 2, 3}), 1e-12);
  }
  std::filesystem::remove(folder / "head way.bin");
  const auto missing = readGltfMotion(folder / "beside.gltf");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("head way.bin"), std::string::npos) << missing.error().message;
}

TEST(GltfFile, FindsNodesAndAnimationsByName) {
  const auto folder = scratchFolder("gltf_names");
  GltfBuilder file;
  file.node({{"name", "Head"}});  // a mesh's node, and below the skeleton's
  const int bone = file.node({{"name", "Head"}, {"translation", {0, 5, 0}}});
  file.node({{"name", "Left hand"}});
  file.node(json::object());
  file.root["skins"] = {{{"joints", {bone}}}};
  file.channel(0, bone, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
  file.channel(1, bone, "translation", "LINEAR", {0, 2}, {0, 0, 0, 1, 0, 0});
  std::ofstream(folder / "a.gltf") << file.text();
  const GltfFile read = parsed(file.text());
  EXPECT_EQ(read.find("Head"), 1u) << "a joint goes before";
  EXPECT_EQ(read.find("left HAND"), 2u);
  EXPECT_FALSE(read.find(""));
  EXPECT_EQ(*read.animationNamed(""), &read.animations[0]);
  EXPECT_EQ(*read.animationNamed("take1"), &read.animations[1]);
  EXPECT_EQ(*read.animationNamed("1"), &read.animations[1]);
  EXPECT_TRUE(read.moves(1, &read.animations[0]));
  EXPECT_FALSE(read.moves(0, &read.animations[0]));
  EXPECT_EQ(readGltfMotion(folder / "a.gltf", {.animation = "take1"})->seconds(), 2);
  const auto node = readGltfMotion(folder / "a.gltf", {.node = "Haed"});
  ASSERT_FALSE(node);
  EXPECT_NE(node.error().message.find("no node Haed; did you mean Head? it has Head, Head, Left hand"),
            std::string::npos)
      << node.error().message;
  for (const char* word : {"take7", "2", "-1"}) {
    const auto animation = readGltfMotion(folder / "a.gltf", {.animation = word});
    ASSERT_FALSE(animation);
    EXPECT_NE(animation.error().message.find("it has take0, take1"), std::string::npos)
        << animation.error().message;
  }
}

// Pictures and materials are nobody's business here, broken or not.
TEST(GltfFile, ReadsModelsWithPictures) {
  GltfBuilder file;
  file.node({{"name", "Head"}, {"translation", {1, 2, 3}}});
  file.floats({1}, "SCALAR");
  file.root["images"] = {
      {{"uri", "missing.png"}}, {{"bufferView", 0}, {"mimeType", "image/png"}}, {{"bufferView", 99}}};
  file.root["textures"] = {{{"source", 7}}};
  file.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                            {{"normalTexture", 1}}};
  file.root["extensionsUsed"] = {"KHR_lights_punctual"};
  file.root["extensions"] = {{"KHR_lights_punctual", {{"lights", {1, 2}}}}};
  for (const std::string& text : {file.text(), file.glb()}) EXPECT_EQ(parsed(text).nodes.size(), 1u);
}

// Compressed meshes are not read; what moves is, where that is not compressed too.
TEST(GltfFile, MovesWhatIsNotCompressed) {
  const auto compressed = [](const char* extension, bool isMoved) {
    GltfBuilder file = bendingStrip(2, 5121, 5126);
    file.root["extensionsRequired"] = {extension};
    if (std::string(extension) == "KHR_draco_mesh_compression") {
      file.root["meshes"][0]["primitives"][0]["extensions"][extension] = {{"bufferView", 0}};
      file.root["accessors"][3].erase("bufferView");  // of the indices
    } else {
      file.root["bufferViews"][isMoved ? 1 : 5]["extensions"][extension] = {{"buffer", 0}};
    }
    return file.glb();
  };
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    const GltfFile file = parsed(compressed(extension, true));
    EXPECT_TRUE(file.motionOf(1, &file.animations[0], {}, {}));
    ASSERT_TRUE(file.meshes[0].problem);
    EXPECT_NE(file.meshes[0].problem->message.find(extension), std::string::npos);
  }
  const auto file = parseGltf(bytesOf(compressed("EXT_meshopt_compression", false)), "");
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().message.find("EXT_meshopt_compression"), std::string::npos) << file.error().message;
}

// A head that moves, of whose file something is changed.
template <class Change>
std::string headWith(Change&& change) {
  GltfBuilder file;
  const int head = file.node({{"name", "Head"}});
  file.node({{"name", "Neck"}, {"children", {head}}});
  file.channel(0, head, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
  change(file.root);
  return file.text();
}

TEST(GltfFile, SaysWhatIsWrong) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "too short"},
      {"{    }", "asset"},
      {R"({"asset":{"version":"1.0"}})", "version '1.0'"},
      {R"({"asset":{"version":"2.0"},"nodes":[{"translation":[1,2]}]})", "node 0: its place"},
      {R"({"asset":{"version":"2.0"},"nodes":[{"rotation":[0,0,0,0]}]})", "is none"},
      {R"({"asset":{"version":"2.0"},"n)"
       "\\u006fdes\":[]}",
       "not plain"},
      {R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') + "}",
       "deep"},
      {headWith([](json& root) { root["nodes"][0]["children"] = {1}; }), "their own parents"},
      {headWith([](json& root) { root["nodes"][0]["children"] = {0}; }), "child of both"},
      {headWith([](json& root) { root["nodes"][0]["children"] = {2}; }), "child 2 of 2"},
      {headWith([](json& root) { root["nodes"][0]["children"] = {-1}; }), "child -1 of 2"},
      {headWith([](json& root) { root["nodes"][0]["mesh"] = 0; }), "mesh 0 of 0"},
      {headWith([](json& root) { root["nodes"][0]["skin"] = 3; }), "skin 3 of 0"},
      {headWith([](json& root) { root["nodes"][0]["matrix"] = std::vector<int>(16, 1); }),
       "which has a matrix"},
      {headWith([](json& root) { root["animations"][0]["channels"][0]["sampler"] = 1; }), "sampler 1 of 1"},
      {headWith([](json& root) { root["animations"][0]["channels"][0]["target"]["node"] = 2; }),
       "node 2 of 2"},
      {headWith([](json& root) { root["animations"][0]["samplers"][0]["input"] = 9; }), "no accessor 9"},
      {headWith([](json& root) { root["animations"][0]["samplers"][0]["input"] = 1; }), "3 numbers, not 1"},
      {headWith([](json& root) { root["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; }),
       "not 6"},
      {headWith([](json& root) { root["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }),
       "'BEZIER'"},
      {headWith([](json& root) { root["accessors"][0]["count"] = 1000000000000; }), "end beyond buffer view"},
      {headWith([](json& root) { root["accessors"][0]["count"] = 18446744073709551615ull; }),
       "end beyond buffer view"},
      {headWith([](json& root) { root["accessors"][0]["count"] = 0; }), "empty"},
      {headWith([](json& root) { root["accessors"][1]["count"] = 1; }), "2 keys have 1 values"},
      {headWith([](json& root) { root["accessors"][0]["byteOffset"] = 18446744073709551612ull; }),
       "end beyond"},
      {headWith([](json& root) { root["accessors"][0]["componentType"] = 5124; }), "type 5124"},
      {headWith([](json& root) { root["accessors"][0].erase("bufferView"); }), "no buffer view"},
      {headWith([](json& root) { root["bufferViews"][0]["byteOffset"] = 1 << 30; }), "beyond its buffer"},
      {headWith([](json& root) { root["bufferViews"][0]["byteLength"] = 4000000000u; }), "beyond its buffer"},
      {headWith([](json& root) { root["bufferViews"][0]["buffer"] = 4; }), "buffer 4"},
      {headWith([](json& root) { root["bufferViews"][1]["byteStride"] = 4; }),
       "steps 4 bytes over elements of 12"},
  };
  for (const auto& [text, expected] : cases) {
    const auto file = parseGltf(bytesOf(text), "");
    ASSERT_FALSE(file) << expected;
    EXPECT_NE(file.error().message.find(expected), std::string::npos)
        << expected << ": " << file.error().message;
  }
}

TEST(GltfFile, AChunkEndsWithinItsFile) {
  GltfBuilder sample = bendingStrip(1, 5121, 5126);
  std::string longer = sample.glb();
  const std::size_t second = longer.find(std::string("BIN\0", 4)) - 4;
  longer[second] = static_cast<char>(longer[second] + 8);
  const auto beyond = parseGltf(bytesOf(longer), "");
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().message.find("second chunk ends 8 bytes beyond"), std::string::npos)
      << beyond.error().message;
}

TEST(GltfFile, ANodeThatIsFlatHasNoMotion) {
  const GltfFile flat = parsed(headWith([](json& root) { root["nodes"][1]["scale"] = {0, 1, 1}; }));
  const auto motion = flat.motionOf(0, &flat.animations[0], {}, {});
  ASSERT_FALSE(motion);
  EXPECT_NE(motion.error().message.find("node Head is flat"), std::string::npos) << motion.error().message;
}

// Cut or changed anywhere, a file is refused or read and moved; nothing worse.
TEST(GltfFile, SurvivesBrokenFiles) {
  GltfBuilder sample = bendingStrip(1, 5121, 5126);
  sample.root["images"] = {{{"bufferView", 0}}};
  sample.root["extras"] = {{"a", {{1, 2}, {3}}}};
  const std::string whole = sample.glb();
  std::size_t readCount = 0;
  const auto tryAll = [&](const std::string& bytes) {
    const auto file = parseGltf(bytesOf(bytes), "");
    if (!file) return;
    ++readCount;
    for (std::size_t n = 0; n < file->nodes.size(); ++n) {
      for (const GltfAnimation& animation : file->animations) (void)file->motionOf(n, &animation, {}, 10);
    }
  };
  for (std::size_t size = 0; size < whole.size(); ++size) tryAll(whole.substr(0, size));
  EXPECT_EQ(readCount, 0u) << "a cut .glb is shorter than it says";
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    for (int bit : {0, 3, 6, 7}) {
      changed[at] = static_cast<char>(whole[at] ^ (1 << bit));
      tryAll(changed);
    }
    for (char c : {'9', '-', '"', '[', '}', '\xff'}) {
      changed[at] = c;
      tryAll(changed);
    }
  }
  fmt::print("{} of {} changed files could be read\n", readCount, whole.size() * 10);
  const std::string text = sample.text();
  for (std::size_t size = 0; size < text.size(); ++size) tryAll(text.substr(0, size));
}

}  // namespace
}  // namespace ringlet::test::gltf_file_test
