// motion/usd_skinned_mesh.h and what it is made of: meshes that skeletons and blend shapes of USD deform, in
// text and in crates, against formulas of usd_skin_samples.h; and what is refused.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "ringlet/motion/mesh_motion_file.h"
#include "ringlet/motion/scalp.h"
#include "ringlet/motion/usd_mesh.h"
#include "tests/motion/mesh_motion_samples.h"
#include "tests/motion/usd_skin_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::usd_skin_test {

namespace {

constexpr double kTimes[] = {0.5, 1, 1.1, 1.25, 1.5, 1.75, 1.9, 2, 3};
constexpr double kNear = 1e-7;  // [m] of points 10 cm from the origin, from floats and halves

using Mesh = std::shared_ptr<const MeshMotion>;

Result<Mesh> readBytes(const std::string& bytes) {
  return readUsdMesh(std::as_bytes(std::span(bytes)), "arm.usd");
}

// Tries both forms of the file.
void readBoth(const UsdScene& scene, const std::function<void(const MeshMotion&)>& check) {
  for (const bool isCrate : {false, true}) {
    SCOPED_TRACE(isCrate ? "crate" : "text");
    const auto mesh = readBytes(isCrate ? scene.crate() : scene.text());
    ASSERT_TRUE(mesh) << mesh.error().message;
    check(**mesh);
  }
}

void expectPoints(const UsdScene& scene, const std::function<Vec3d(std::size_t, double)>& expected) {
  readBoth(scene, [&](const MeshMotion& mesh) {
    for (const double t : kTimes) {
      const auto found = mesh.pointsAt(t);
      ASSERT_EQ(found.size(), arm::kPoints.size());
      for (std::size_t p = 0; p < found.size(); ++p)
        EXPECT_LT(length(found[p] - expected(p, t)), kNear) << "point " << p << " at " << t;
    }
  });
}

void expectWarning(const UsdScene& scene, const std::string& warning) {
  readBoth(scene, [&](const MeshMotion& mesh) {
    ASSERT_EQ(mesh.warnings().size(), 1u) << fmt::format("{}", fmt::join(mesh.warnings(), "\n"));
    EXPECT_EQ(mesh.warnings().front(), warning);
  });
}

// What shapes and joints do, without each other.
UsdScene withoutShapes() {
  UsdScene scene = arm::scene();
  scene.remove("/Root/Arm", "skel:blendShapes");
  scene.remove("/Root/Arm", "skel:blendShapeTargets");
  return scene;
}
UsdScene withoutJoints() {
  UsdScene scene = arm::scene();
  scene.remove("/Root/Arm", "primvars:skel:jointIndices");
  scene.remove("/Root/Arm", "primvars:skel:jointWeights");
  return scene;
}
Vec3d jointed(std::size_t p, double t) {
  const double s = arm::share(t, 1, 2);
  return arm::inWorld(arm::skinned(arm::kPoints[p], arm::kWeights[p], arm::upperAt(s), arm::lowerAt(s)));
}

}  // namespace

TEST(UsdSkin, PointsFollowShapesJointsAndTheSkeletonsPrim) {
  expectPoints(arm::scene(), arm::pointAt);
  readBoth(arm::scene(), [&](const MeshMotion& mesh) {
    EXPECT_DOUBLE_EQ(mesh.firstSeconds(), 1);
    EXPECT_DOUBLE_EQ(mesh.lastSeconds(), 2);
    EXPECT_EQ(mesh.triangles(), (Triangles{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));
    EXPECT_TRUE(mesh.warnings().empty()) << mesh.warnings().front();
  });
}

// Points that have samples of their own are shaped and carried all the same.
TEST(UsdSkin, SamplesOfPointsCountFirst) {
  UsdScene scene = withoutShapes();
  auto& points = scene.at("/Root/Arm", "points");
  auto later = points.numbers;
  for (double& number : later) number = 2 * number + 0.5;
  points.samples = {{10, points.numbers}, {30, later}};
  expectPoints(scene, [](std::size_t p, double t) {
    const double s = arm::share(t, 1, 2), own = arm::share(t, 1, 3);
    const Vec3d point = arm::kPoints[p] * (1 + own) + Vec3d{0.5, 0.5, 0.5} * own;
    return arm::inWorld(arm::skinned(point, arm::kWeights[p], arm::upperAt(s), arm::lowerAt(s)));
  });
  readBoth(scene, [](const MeshMotion& mesh) { EXPECT_DOUBLE_EQ(mesh.lastSeconds(), 3); });
}

// A mesh without joints stands where its own prim does.
TEST(UsdSkin, BlendShapesMoveAMeshByThemselves) {
  expectPoints(withoutJoints(), [](std::size_t p, double t) {
    const Vec3d q = (arm::shaped(p, t) + Vec3d{100, 0, 0}) * 0.01;
    return Vec3d{q.x, q.z, -q.y};
  });
  readBoth(withoutJoints(), [](const MeshMotion& mesh) {
    EXPECT_DOUBLE_EQ(mesh.firstSeconds(), 1.2);
    EXPECT_DOUBLE_EQ(mesh.lastSeconds(), 1.8);
  });
}

TEST(UsdSkin, NamesThatShareAShapeAddUp) {
  UsdScene scene = withoutJoints();
  scene.at("/Root/Arm", "skel:blendShapeTargets").texts = {"/Root/Arm/DentShape", "/Root/Arm/DentShape"};
  expectPoints(scene, [](std::size_t p, double) {
    const Vec3d q = (arm::kPoints[p] + arm::kDent[p] * 0.5 + Vec3d{100, 0, 0}) * 0.01;
    return Vec3d{q.x, q.z, -q.y};  // 0.5 - s and s
  });
}

TEST(UsdSkin, ConstantInfluencesAreOfAllPoints) {
  UsdScene scene = withoutShapes();
  for (const char* interpolation : {"constant", ""}) {
    scene.at("/Root/Arm", "primvars:skel:jointIndices") = {.type = "int[]",
                                                           .name = "primvars:skel:jointIndices",
                                                           .numbers = {1, 2},
                                                           .interpolation = interpolation};
    scene.at("/Root/Arm", "primvars:skel:jointWeights") = {.type = "float[]",
                                                           .name = "primvars:skel:jointWeights",
                                                           .numbers = {1, 3},
                                                           .interpolation = interpolation};
    expectPoints(scene, [](std::size_t p, double t) {
      const double s = arm::share(t, 1, 2);
      return arm::inWorld(arm::skinned(arm::kPoints[p], {1, 3, 0}, arm::upperAt(s), arm::lowerAt(s)));
    });
  }
}

// All that a mesh may take over from a prim above it; an animation that the mesh's side names, as older files
// have it; paths from where they stand.
TEST(UsdSkin, BindingsComeFromPrimsAbove) {
  UsdScene scene = withoutShapes();
  for (const char* name : {"skel:joints", "primvars:skel:jointIndices", "primvars:skel:jointWeights",
                           "primvars:skel:geomBindTransform"}) {
    const UsdSceneProperty property = scene.at("/Root/Arm", name);
    scene.prim("/Root").properties.push_back(property);
    scene.remove("/Root/Arm", name);
  }
  const UsdSceneProperty source = scene.at("/Root/Bones", "skel:animationSource");
  scene.remove("/Root/Bones", "skel:animationSource");
  scene.prim("/Root/Arm").properties.push_back(source);
  expectPoints(scene, jointed);

  std::string text = scene.text();
  const std::string absolute = "</Root/Bones/Wave>", relative = "<../Bones/Wave>";
  text.replace(text.find(absolute), absolute.size(), relative);
  const auto mesh = readBytes(text);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_LT(length((*mesh)->pointsAt(1.5)[4] - jointed(4, 1.5)), kNear);
}

TEST(UsdSkin, EditsOfTargetsAreTargets) {
  UsdScene scene = arm::scene();
  scene.at("/Root", "skel:skeleton").isPrepended = true;
  scene.at("/Root/Arm", "skel:blendShapeTargets").isPrepended = true;
  expectPoints(scene, arm::pointAt);

  std::string text = arm::scene().text();
  const std::string both = "rel skel:blendShapeTargets = [</Root/Arm/BulgeShape>, </Root/Arm/DentShape>]";
  ASSERT_NE(text.find(both), text.npos);
  text.replace(text.find(both), both.size(),
               "prepend rel skel:blendShapeTargets = </Root/Arm/BulgeShape>\n"
               "append rel skel:blendShapeTargets = [</Root/Arm/DentShape>,] ( doc = \"x\" )");
  const auto mesh = readBytes(text);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_LT(length((*mesh)->pointsAt(1.5)[3] - arm::pointAt(3, 1.5)), kNear);
}

// Joints whose parents come later, and one whose parent is not there: it hangs on the next one above.
TEST(UsdSkin, NamesOfJointsAreTheHierarchy) {
  UsdScene scene = withoutShapes();
  const std::vector<std::string> names{"Upper/Lower/Wrist/Hand", "Upper/Lower", "Upper"};
  scene.at("/Root/Bones", "joints").texts = names;
  scene.at("/Root/Bones", "bindTransforms").numbers =
      matricesOf({arm::kBindHand, arm::kBindLower, arm::kBindUpper});
  scene.at("/Root/Bones", "restTransforms").numbers =
      matricesOf({arm::kRestHand, arm::kRestLower, arm::kRestUpper});
  scene.at("/Root/Arm", "skel:joints").texts = {names[0], names[2], names[1]};
  expectPoints(scene, jointed);
}

// Without a joint order of its own a mesh counts joints as the skeleton does.
TEST(UsdSkin, JointsAreTheSkeletonsWhereTheMeshNamesNone) {
  UsdScene scene = withoutShapes();
  scene.remove("/Root/Arm", "skel:joints");
  for (double& joint : scene.at("/Root/Arm", "primvars:skel:jointIndices").numbers)
    joint = joint == 0 ? 2 : joint - 1;
  expectPoints(scene, jointed);
}

TEST(UsdSkin, RestsWithoutAnAnimation) {
  UsdScene scene = withoutShapes();
  scene.remove("/Root/Bones", "skel:animationSource");
  expectPoints(scene, [](std::size_t p, double) {
    return arm::inWorld(arm::skinned(arm::kPoints[p], arm::kWeights[p], arm::kRestUpper, arm::kRestLower));
  });
  expectWarning(scene, "/Root/Arm: does not move");
}

// A skeleton that binds a mesh without joint weights or blend shapes leaves it alone.
TEST(UsdSkin, LeavesAMeshThatNothingDeforms) {
  UsdScene scene = withoutShapes();
  scene.remove("/Root/Arm", "primvars:skel:jointIndices");
  scene.remove("/Root/Arm", "primvars:skel:jointWeights");
  expectPoints(scene, [](std::size_t p, double) {
    const Vec3d q = (arm::kPoints[p] + Vec3d{100, 0, 0}) * 0.01;
    return Vec3d{q.x, q.z, -q.y};
  });
  expectWarning(scene, "/Root/Arm: does not move");
}

TEST(UsdSkin, MirroredSkeletonsTurnFacesRound) {
  UsdScene scene = arm::scene();
  scene.at("/Root/Bones", "xformOp:scale", "double3").numbers = {1, 1, -1};
  scene.at("/Root/Bones", "xformOpOrder").texts.push_back("xformOp:scale");
  const Triangles turned{{0, 2, 1}, {1, 3, 2}, {2, 4, 3}}, straight{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}};
  readBoth(scene, [&](const MeshMotion& mesh) { EXPECT_EQ(mesh.triangles(), turned); });
  scene.at("/Root/Arm", "primvars:skel:geomBindTransform").numbers = matrixOf({{'s', {1, -1, 1}}});
  readBoth(scene, [&](const MeshMotion& mesh) { EXPECT_EQ(mesh.triangles(), straight); });
}

TEST(UsdSkin, WarnsOfWhatIsLeftOut) {
  UsdScene scene = arm::scene();
  scene.at("/Root/Arm/DentShape", "inbetweens:half", "vector3f[]").numbers = numbersOfPoints(arm::kDent);
  scene.at("/Root/Arm/DentShape", "inbetweens:half:normalOffsets", "vector3f[]").numbers =
      numbersOfPoints(arm::kDent);
  expectWarning(scene,
                "/Root/Arm/DentShape: inbetween shapes are left out ('half'); the shape grows straight with "
                "its weight");
  expectPoints(scene, arm::pointAt);

  scene = arm::scene();
  scene.at("/Root/Arm", "primvars:skel:skinningMethod", "token").texts = {"dualQuaternion"};
  expectWarning(scene,
                "/Root/Arm: is skinned by 'dualQuaternion'; linear blending is used, which narrows joints "
                "that twist");

  scene = arm::scene();
  scene.at("/Root/Bones/Wave", "blendShapes").texts = {"Dent", "Other", "Third"};
  expectWarning(scene, "/Root/Arm: no animation weights the blend shapes 'Bulge'; they do nothing");
}

// The bind pose has them, in the skeleton's space.
TEST(UsdSkin, PointsWithoutWeightStayInTheBindPose) {
  UsdScene scene = withoutShapes();
  auto& weights = scene.at("/Root/Arm", "primvars:skel:jointWeights").numbers;
  weights[4] = weights[5] = 0;
  expectPoints(scene, [](std::size_t p, double t) {
    return p == 2 ? arm::inWorld(moved(arm::kPoints[2], arm::kGeomBind)) : jointed(p, t);
  });
  expectWarning(scene, "/Root/Arm: 1 of its points have no weight; no joint moves them");
}

TEST(UsdSkin, MeshesOfFilesMoveRoots) {
  const auto folder = scratchFolder("usd_skin_files");
  writeBytes(folder / "arm.usda", arm::scene().text());
  writeBytes(folder / "arm.usdc", arm::scene().crate());
  for (const char* name : {"arm.usda", "arm.usdc"}) {
    SCOPED_TRACE(name);
    const auto mesh = readMeshMotion({.path = folder / name}, false);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const Vec3d root = arm::pointAt(4, 1);
    const auto scalp = Scalp::bind(*mesh, std::vector<Vec3d>{root}, 1, 0.01);
    ASSERT_TRUE(scalp) << scalp.error().message;
    const HeadPose pose = scalp->posesAt(1.5).front();
    EXPECT_LT(length(rotate(pose.rotation, root) + pose.position - arm::pointAt(4, 1.5)), 1e-6);
  }
}

namespace {

struct Refusal {
  const char* name;
  std::function<void(UsdScene&)> spoil;
  std::string message;
};

const std::string kArm = "/Root/Arm", kBones = "/Root/Bones", kWave = "/Root/Bones/Wave";
const double kInfinity = std::numeric_limits<double>::infinity();

std::function<void(UsdScene&)> without(const std::string& prim, const std::string& name) {
  return [=](UsdScene& scene) { scene.remove(prim, name); };
}
std::function<void(UsdScene&)> withTexts(const std::string& prim, const std::string& name,
                                         const std::vector<std::string>& texts) {
  return [=](UsdScene& scene) { scene.at(prim, name).texts = texts; };
}
std::function<void(UsdScene&)> withNumber(const std::string& prim, const std::string& name, std::size_t k,
                                          double number) {
  return [=](UsdScene& scene) { scene.at(prim, name).numbers[k] = number; };
}
std::function<void(UsdScene&)> shortened(const std::string& prim, const std::string& name, std::size_t size) {
  return [=](UsdScene& scene) { scene.at(prim, name).numbers.resize(size); };
}
// Of the second sample.
std::function<void(UsdScene&)> withSample(const std::string& name, const std::vector<double>& numbers) {
  return [=](UsdScene& scene) { scene.at(kWave, name).samples[1].second = numbers; };
}

std::vector<Refusal> refusalsOfBindings() {
  const auto withRel = [](const std::string& prim, const std::string& name, const std::string& target) {
    return [=](UsdScene& scene) { scene.at(prim, name, "rel").texts = {target}; };
  };
  return {
      {"skeleton of another type", withRel(kArm, "skel:skeleton", kWave),
       "arm.usd: /Root/Arm: skel:skeleton names '/Root/Bones/Wave', which is of type 'SkelAnimation'; expected "
       "a Skeleton"},
      {"animation of another type", withRel(kBones, "skel:animationSource", kArm),
       "/Root/Bones: skel:animationSource names '/Root/Arm', which is of type 'Mesh'; expected a "
       "SkelAnimation"},
      {"two skeletons", withTexts("/Root", "skel:skeleton", {kBones, kBones}),
       "/Root: skel:skeleton has 2 targets; expected one"},
      {"shape of another type", withTexts(kArm, "skel:blendShapeTargets", {"/Root/Arm/DentShape", kArm}),
       "/Root/Arm: skel:blendShapeTargets names '/Root/Arm', which is of type 'Mesh'; expected a BlendShape"},
      {"fewer shapes than names", withTexts(kArm, "skel:blendShapeTargets", {"/Root/Arm/DentShape"}),
       "/Root/Arm: found 2 skel:blendShapes and 1 skel:blendShapeTargets; expected as many of each"},
      {"no skeleton", without("/Root", "skel:skeleton"),
       "/Root/Arm: has primvars:skel:jointIndices but no skel:skeleton, of its own or of a prim above"},
      {"binding taken away", [](UsdScene& scene) { scene.at(kArm, "skel:skeleton", "rel").texts.clear(); },
       "/Root/Arm: has primvars:skel:jointIndices but no skel:skeleton, of its own or of a prim above"},
      {"no weights", without(kArm, "primvars:skel:jointWeights"),
       "/Root/Arm: has primvars:skel:jointIndices but no primvars:skel:jointWeights"},
      {"unknown joint", withTexts(kArm, "skel:joints", {"Upper/Lower/Hand", "Upper", "Toe"}),
       "/Root/Arm: skel:joints names 'Toe', which is none of the 3 joints of /Root/Bones"},
      {"joint twice", withTexts(kBones, "joints", {"Upper", "Upper", "Upper/Lower"}),
       "/Root/Bones: joints has 'Upper' twice; expected each once"},
      {"index of no joint", withNumber(kArm, "primvars:skel:jointIndices", 3, 3),
       "/Root/Arm: found joint 3 in jointIndices; expected 0 to 2"},
      {"negative index", withNumber(kArm, "primvars:skel:jointIndices", 3, -1),
       "/Root/Arm: found joint -1 in jointIndices; expected 0 to 2"},
      {"fewer weights", shortened(kArm, "primvars:skel:jointWeights", 9),
       "/Root/Arm: found 10 jointIndices and 9 jointWeights; expected as many of each"},
      {"no multiple of the points",
       [](UsdScene& scene) {
         for (const char* name : {"primvars:skel:jointIndices", "primvars:skel:jointWeights"})
           scene.at(kArm, name).numbers.resize(9);
       },
       "/Root/Arm: found 9 jointIndices; expected as many for each of the 5 points"},
      {"weight that is infinite", withNumber(kArm, "primvars:skel:jointWeights", 2, kInfinity),
       "/Root/Arm: jointWeights has inf; expected finite numbers"},
      {"no interpolation",
       [](UsdScene& scene) { scene.at(kArm, "primvars:skel:jointIndices").interpolation = ""; },
       "/Root/Arm: found 10 primvars:skel:jointIndices and no interpolation; expected \"vertex\" or"},
      {"interpolation of faces",
       [](UsdScene& scene) { scene.at(kArm, "primvars:skel:jointWeights").interpolation = "uniform"; },
       "/Root/Arm: found primvars:skel:jointWeights of interpolation 'uniform'; expected \"vertex\" or"},
      {"indexed weights",
       [](UsdScene& scene) {
         scene.at(kArm, "primvars:skel:jointWeights:indices", "int[]").numbers = {0, 1};
       },
       "/Root/Arm: has primvars:skel:jointWeights:indices; expected values that are not indexed"}};
}

std::vector<Refusal> refusalsOfSkeletons() {
  return {{"no joints", without(kBones, "joints"), "/Root/Bones: has no joints"},
          {"no bind matrices", without(kBones, "bindTransforms"), "/Root/Bones: has no bindTransforms"},
          {"fewer bind matrices", shortened(kBones, "bindTransforms", 32),
           "/Root/Bones: found 2 bindTransforms; expected 3, one for each of its joints"},
          {"fewer rest matrices", shortened(kBones, "restTransforms", 16),
           "/Root/Bones: found 1 restTransforms; expected 3, one for each of its joints"},
          {"no rest matrices", without(kBones, "restTransforms"),
           "/Root/Bones: has no restTransforms, which the joint 'Upper/Lower/Hand' needs"},
          {"flat bind matrix",
           [](UsdScene& scene) {
             auto& numbers = scene.at(kBones, "bindTransforms").numbers;
             std::fill(numbers.begin() + 16, numbers.begin() + 20, 0);
           },
           "/Root/Bones: the matrix of joint 'Upper/Lower' in bindTransforms has no inverse"},
          {"bind matrix that is not finite", withNumber(kBones, "bindTransforms", 17, kInfinity),
           "/Root/Bones: found a number in matrix 1 of bindTransforms that is not finite"},
          {"projecting rest matrix", withNumber(kBones, "restTransforms", 3, 1),
           "/Root/Bones: matrix 0 of restTransforms has another last column than 0, 0, 0, 1"},
          {"two geomBindTransforms",
           [](UsdScene& scene) {
             auto& bind = scene.at(kArm, "primvars:skel:geomBindTransform");
             bind.type = "matrix4d[]";
             bind.numbers = joinedNumbers(bind.numbers, bind.numbers);
           },
           "/Root/Arm: found 2 primvars:skel:geomBindTransform; expected 1, one for all points"},
          {"deep joint",
           [](UsdScene& scene) {
             std::string name = "Upper";
             for (int k = 0; k < 300; ++k) name += "/a";
             scene.at(kBones, "joints").texts[2] = name;
           },
           "/Root/Bones: joint 'Upper/a/a"}};
}

std::vector<Refusal> refusalsOfAnimations() {
  return {
      {"joint of the animation twice", withTexts(kWave, "joints", {"Upper", "Upper"}),
       "/Root/Bones/Wave: joints has 'Upper' twice"},
      {"no scales", without(kWave, "scales"),
       "/Root/Bones/Wave: has no scales; expected translations, rotations and scales"},
      {"fewer rotations later", withSample("rotations", turnNumbers('x', 1)),
       "/Root/Bones/Wave: found 1 rotations at time 20; expected 2, one for each of its joints"},
      {"more translations later", withSample("translations", std::vector<double>(9)),
       "/Root/Bones/Wave: found 3 translations at time 20; expected 2, one for each of its joints"},
      {"infinite translation", withSample("translations", {0, 0, 0, 0, kInfinity, 0}),
       "/Root/Bones/Wave: found a number in translations at time 20 that is not finite"},
      {"no turn", withSample("rotations", std::vector<double>(8)),
       "/Root/Bones/Wave: found a quaternion of 0 in rotations"},
      {"fewer weights later", withSample("blendShapeWeights", {1, 2}),
       "/Root/Bones/Wave: found 2 blendShapeWeights at time 18; expected 3, one for each of its blendShapes"},
      {"no weights", without(kWave, "blendShapeWeights"),
       "/Root/Bones/Wave: has blendShapes but no blendShapeWeights"},
      {"no offsets", without("/Root/Arm/DentShape", "offsets"), "/Root/Arm/DentShape: has no offsets"},
      {"fewer offsets than points", shortened("/Root/Arm/DentShape", "offsets", 12),
       "/Root/Arm/DentShape: found 4 offsets; expected 5, as many as the mesh has points"},
      {"fewer offsets than indices", shortened("/Root/Arm/BulgeShape", "offsets", 3),
       "/Root/Arm/BulgeShape: found 1 offsets; expected 2, as many as pointIndices"},
      {"offset of no point", withNumber("/Root/Arm/BulgeShape", "pointIndices", 1, 5),
       "/Root/Arm/BulgeShape: found 5 in pointIndices; expected 0 to 4, the mesh's points"},
      {"infinite offset", withNumber("/Root/Arm/BulgeShape", "offsets", 4, kInfinity),
       "/Root/Arm/BulgeShape: offset 1 is not finite"},
      {"faces that change",
       [](UsdScene& scene) {
         auto& faces = scene.at(kArm, "faceVertexIndices");
         faces.samples = {{1, faces.numbers}, {2, {0, 1, 2, 1, 2, 3, 2, 4, 3}}};
       },
       "/Root/Arm: faceVertexIndices changes at time 2; the faces of a mesh that moves stay the same"},
      {"weights that change",
       [](UsdScene& scene) {
         auto& weights = scene.at(kArm, "primvars:skel:jointWeights");
         weights.samples = {{1, weights.numbers}, {2, std::vector<double>(10, 1)}};
       },
       "/Root/Arm: primvars:skel:jointWeights changes at time 2; expected the same at all times"}};
}

}  // namespace

TEST(UsdSkin, SaysWhatItCannotUse) {
  for (const auto& refusals : {refusalsOfBindings(), refusalsOfSkeletons(), refusalsOfAnimations()}) {
    for (const Refusal& refusal : refusals) {
      SCOPED_TRACE(refusal.name);
      UsdScene scene = arm::scene();
      refusal.spoil(scene);
      for (const std::string& bytes : {scene.text(), scene.crate()}) {
        const auto mesh = readBytes(bytes);
        const std::string problem = mesh ? "nothing" : mesh.error().message;
        EXPECT_NE(problem.find(refusal.message), std::string::npos)
            << "found    " << problem << "\nexpected " << refusal.message;
      }
    }
  }
}

// What only text can say, or is only said otherwise there.
TEST(UsdSkin, SaysWhatIsWrongInText) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = arm::scene().text();
    const std::size_t at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return text.replace(at, from.size(), to);
  };
  struct Case {
    std::string text, message;
  };
  for (const Case& c :
       {Case{changed("rel skel:skeleton = </Root/Bones>", "rel skel:skeleton = </Root/Bone>"),
             "arm.usd: /Root: skel:skeleton names '/Root/Bone', where there is no prim; expected a Skeleton"},
        Case{changed("def Skeleton \"Bones\"", "def Skeleton \"Bones\" ( active = false )"),
             "names '/Root/Bones', which is inactive or not defined"},
        Case{changed("def Skeleton \"Bones\"", "def Skeleton \"Bones\" ( references = @a.usd@ )"),
             "/Root/Bones: has references, which are not followed; flatten the file first"},
        Case{changed("rel skel:skeleton = </Root/Bones>", "rel skel:skeleton = None"),
             "/Root/Arm: has primvars:skel:jointIndices but no skel:skeleton"},
        Case{changed("rel skel:skeleton", "delete rel skel:skeleton"),
             "/Root/Arm: has primvars:skel:jointIndices but no skel:skeleton"},
        Case{changed("rel skel:skeleton = </Root/Bones>", "rel skel:skeleton = \"Bones\""),
             "arm.usd: line 9: found"},
        Case{
            changed("quatf[] rotations.timeSamples", "quatf[] rotations.connect = </A.x>\nint a.timeSamples"),
            "/Root/Bones/Wave: rotations is given by a connection"},
        Case{changed("translations.timeSamples = { 10:", "translations.timeSamples = { 20:"),
             "/Root/Bones/Wave: found samples of translations at time 20 that do not rise in time"}}) {
    const auto mesh = readBytes(c.text);
    const std::string problem = mesh ? "nothing" : mesh.error().message;
    EXPECT_NE(problem.find(c.message), std::string::npos)
        << "found    " << problem << "\nexpected " << c.message;
  }
}

// Values that grooms carry along unread must be read of a mesh.
TEST(UsdSkin, RefusesWeightsOfAKindThatIsNotRead) {
  UsdScene scene = arm::scene();
  scene.at("/Root/Arm", "primvars:skel:jointWeights").type = "asset";
  const auto mesh = readBytes(scene.crate());
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().message, "arm.usd: found a value of type 12; expected numbers or names");
}

// Every shorter file and every changed byte is read or refused, whole.
TEST(UsdSkin, SurvivesBrokenFiles) {
  for (const std::string& whole : {arm::scene().text(), arm::scene().crate()}) {
    const auto use = [](const std::string& bytes) {
      const auto mesh = readBytes(bytes);
      if (!mesh) return;
      EXPECT_EQ((*mesh)->pointsAt(1.5).size(), (*mesh)->pointCount());
    };
    for (std::size_t size = 0; size < whole.size(); size += 7) use(whole.substr(0, size));
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const char flip : {'\x01', '\x80'}) {
        std::string broken = whole;
        broken[at] = static_cast<char>(broken[at] ^ flip);
        use(broken);
      }
    }
  }
}

}  // namespace ringlet::test::usd_skin_test
