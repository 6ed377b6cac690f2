// Force fields and holds of scenes: what a scene says of them, and what they are frame by frame.
#include "ringlet/scenes/frames/scene_forces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "ringlet/rest/goal.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/scenes/joint_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_forces_test {
namespace {

// Two straight strands of five particles, 4 cm long, 2 cm apart.
const std::string kGroom =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 5\nturns = 0\nradius = 0.001\n"
    "length = 0.04\nspacing = 0.02\nvary_radius = 0\nvary_length = 0\nvary_phase = 0\n";

LoadedScene loadedFrom(const std::string& text, const std::filesystem::path& folder = {}) {
  auto scene = parseScene(kGroom + text, "scene.toml", folder);
  EXPECT_TRUE(scene) << scene.error().message;
  auto loaded = loadScene(*scene);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return std::move(*loaded);
}
std::vector<ForceField> fieldsOf(const LoadedScene& scene, double seconds) {
  return scene.forces.fieldsAt(seconds, scene.motion.poseAt(seconds), scene.keys ? &*scene.keys : nullptr);
}
GoalPose goalsOf(const LoadedScene& scene, double seconds) {
  auto goals = scene.forces.goalsAt(seconds, scene.motion.poseAt(seconds), scene.settings.goal,
                                    scene.keys ? &*scene.keys : nullptr);
  EXPECT_TRUE(goals) << goals.error().message;
  return std::move(*goals);
}
std::string errorOf(const std::string& text) {
  const auto scene = parseScene(kGroom + text, "scene.toml");
  if (!scene) return scene.error().message;
  const auto loaded = loadScene(*scene);
  return loaded ? "" : loaded.error().message;
}
double apart(Vec3d a, Vec3d b) { return length(a - b); }

TEST(SceneForces, KindsAreFields) {
  const struct {
    const char* kind;
    double axial, radial, around, drag;
    bool aboutAxis;
  } kKinds[] = {{"uniform", 3, 0, 0, 0, false}, {"point", 0, -3, 0, 0, false}, {"line", 0, -3, 0, 0, true},
                {"vortex", 0, 0, 3, 0, true},   {"blast", 0, 3, 0, 0, false},  {"drag", 0, 0, 0, 20, false}};
  for (const auto& k : kKinds) {
    SCOPED_TRACE(k.kind);
    const std::string strength = k.kind == std::string("drag") ? "" : "strength = 3\n";
    const auto fields =
        fieldsOf(loadedFrom(fmt::format("[[field]]\nkind = \"{}\"\n{}reach = 2\nposition = [1, 2, 3]\n",
                                        k.kind, strength)),
                 0);
    ASSERT_EQ(fields.size(), 1u);
    const ForceField& f = fields[0];
    EXPECT_EQ(f.axial, k.axial);
    EXPECT_EQ(f.radial, k.radial);
    EXPECT_EQ(f.around, k.around);
    EXPECT_EQ(f.drag, k.drag);
    EXPECT_EQ(f.aboutAxis, k.aboutAxis);
    EXPECT_EQ(f.reach, 2);
    EXPECT_EQ(f.name, "1");
    EXPECT_EQ(apart(f.place.position, {1, 2, 3}), 0);
    EXPECT_EQ(f.thickness > 0, k.kind == std::string("blast"));
  }
}

TEST(SceneForces, FrontsGoOutwards) {
  const LoadedScene scene =
      loadedFrom("[[field]]\nkind = \"blast\"\nstrength = 9\nstart = 0.5\nspeed = 4\nthickness = 0.2\n");
  EXPECT_DOUBLE_EQ(fieldsOf(scene, 1.5)[0].front, 4);
  EXPECT_DOUBLE_EQ(fieldsOf(scene, 0)[0].front, -2);
  EXPECT_EQ(fieldsOf(scene, 0)[0].thickness, 0.2);
}

// In the world it stays; the head and a joint carry it, turned.
TEST(SceneForces, AreCarried) {
  const auto folder = test::scratchFolder("scene_forces");
  test::writeBvhOf(test::kJointAxes[2], folder / "walk.bvh");
  const std::string motion = "[motion]\nfile = \"walk.bvh\"\nunit = 0.01\n";
  const std::string field =
      "[[field]]\nkind = \"uniform\"\nstrength = 1\nposition = [0.1, 0, 0]\naxis = [1, 0, 0]\n";
  const LoadedScene scene =
      loadedFrom(motion + field + field + "bind = \"head\"\n" + field + "joint = \"Hips\"\n", folder);
  const double t = 6 / 24.0;
  const auto fields = fieldsOf(scene, t);
  ASSERT_EQ(fields.size(), 3u);
  EXPECT_EQ(apart(fields[0].place.position, {0.1, 0, 0}), 0);
  EXPECT_EQ(apart(worldAxis(fields[0]), {1, 0, 0}), 0);
  const double turn = test::jointTurn(6) * std::numbers::pi / 180;
  const Vec3d along{std::cos(turn), std::sin(turn), 0};
  const Vec3d there = Vec3d{test::jointWay(6), test::kJointHeight, 0} + along * 0.1;
  for (const std::size_t f : {1u, 2u}) {
    EXPECT_LT(apart(fields[f].place.position, there), 1e-6) << f;
    EXPECT_LT(apart(worldAxis(fields[f]), along), 1e-6) << f;
  }
}

TEST(SceneForces, KeysChangeThem) {
  const LoadedScene scene = loadedFrom(
      "[[field]]\nname = \"fan\"\nkind = \"vortex\"\nstrength = 1\n[[field]]\nkind = \"drag\"\n"
      "[[hold]]\nname = \"tie\"\nbegin = 0.5\nend = 0.5\n"
      "[[key]]\ntime = 1\nfield.fan.strength = 2\nfield.2.drag = 6\nhold.tie.strength = 0\n"
      "[[key]]\ntime = 3\nfield.fan.strength = 4\nfield.fan.position = [0, 1, 0]\nfield.fan.reach = 0.3\n"
      "hold.tie.strength = 10\n");
  EXPECT_EQ(fieldsOf(scene, 0)[0].around, 2);
  EXPECT_NEAR(fieldsOf(scene, 2)[0].around, 3, 1e-12);
  EXPECT_EQ(fieldsOf(scene, 5)[0].around, 4);
  EXPECT_EQ(apart(fieldsOf(scene, 2)[0].place.position, {0, 1, 0}), 0);
  EXPECT_EQ(fieldsOf(scene, 2)[0].reach, 0.3);
  EXPECT_EQ(fieldsOf(scene, 2)[1].drag, 6);
  EXPECT_EQ(goalsOf(scene, 0.5).strengths[2], 0);
  EXPECT_NEAR(goalsOf(scene, 2).strengths[2], 5, 1e-6);
  const SceneNumbers start = *scene.keys->at(0, 8), later = *scene.keys->at(5, 8);
  EXPECT_TRUE(start.settings == later.settings && start.material == later.material) << "neither have keys";
}

// Particles within the range, of the strands that are named, at their places in the groom.
TEST(SceneForces, HoldsHoldWhatTheyName) {
  const LoadedScene scene = loadedFrom("[[hold]]\nstrands = \"1\"\nbegin = 0.4\nend = 0.8\nstrength = 7\n");
  const GoalPose pose = goalsOf(scene, 0);
  const GroomGoal rest = ringlet::goalOf(scene.groom);
  ASSERT_EQ(pose.places.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(pose.strengths[i], i == 7 || i == 8 ? 7 : 0) << i;  // 0.5 and 0.75
    EXPECT_LT(apart(Vec3d(pose.places[i]), Vec3d(rest.places[i])), 1e-7);
  }
  EXPECT_EQ(goalsOf(loadedFrom("[[hold]]\n"), 0).strengths[2], 100) << "all strands, in the middle";
}

TEST(SceneForces, HoldsGatherAboutTheirMiddle) {
  const LoadedScene scene = loadedFrom(
      "[[hold]]\nbegin = 0.5\nend = 0.5\ngather = 0.25\n[[hold]]\nbegin = 1\nend = 1\ngather = 0\nposition = "
      "[0, -0.1, 0.3]\n");
  const GoalPose pose = goalsOf(scene, 0);
  const GroomGoal rest = ringlet::goalOf(scene.groom);
  const Vec3d middle = (Vec3d(rest.places[2]) + Vec3d(rest.places[7])) * 0.5;
  for (const std::size_t i : {2u, 7u})
    EXPECT_LT(apart(Vec3d(pose.places[i]), middle + (Vec3d(rest.places[i]) - middle) * 0.25), 1e-7);
  for (const std::size_t i : {4u, 9u}) EXPECT_LT(apart(Vec3d(pose.places[i]), {0, -0.1, 0.3}), 1e-7);
}

TEST(SceneForces, HoldsBeginAndLetGo) {
  const LoadedScene scene =
      loadedFrom("[[hold]]\nstart = 1\nrelease = 3\nease = 0.5\nstrength = 8\nbegin = 0.5\nend = 0.5\n");
  const std::pair<double, double> kTimes[] = {{0, 0},   {1, 0},    {1.25, 4}, {1.5, 8},
                                              {2.9, 8}, {3.25, 4}, {3.5, 0},  {9, 0}};
  for (const auto& [seconds, strength] : kTimes)
    EXPECT_NEAR(goalsOf(scene, seconds).strengths[2], strength, 1e-5) << seconds;
  const LoadedScene sudden = loadedFrom("[[hold]]\nrelease = 1\nease = 0\nstrength = 8\n");
  EXPECT_EQ(goalsOf(sudden, 0.999).strengths[2], 8);
  EXPECT_EQ(goalsOf(sudden, 1).strengths[2], 0);
}

// What the world or a joint holds begins where it is at 0 s, and goes where that goes.
TEST(SceneForces, HoldsAreCarried) {
  const auto folder = test::scratchFolder("scene_forces_holds");
  test::writeBvhOf(test::kJointAxes[0], folder / "walk.bvh");
  const std::string motion = "[motion]\nfile = \"walk.bvh\"\nunit = 0.01\n";
  const double t = 6 / 24.0;
  for (const char* by : {"bind = \"world\"", "joint = \"Hips\"", "bind = \"head\""}) {
    SCOPED_TRACE(by);
    const LoadedScene scene = loadedFrom(motion + "[[hold]]\n" + by + "\nbegin = 0\nend = 1\n", folder);
    const GroomGoal rest = ringlet::goalOf(scene.groom);
    const HeadPose start = scene.motion.poseAt(0), now = scene.motion.poseAt(t);
    const GoalPose before = goalsOf(scene, 0), after = goalsOf(scene, t);
    for (std::size_t i = 0; i < rest.places.size(); ++i) {
      const Vec3d x(rest.places[i]);
      EXPECT_LT(apart(Vec3d(before.places[i]), x), 1e-6);
      const Vec3d world = now.position + rotate(now.rotation, Vec3d(after.places[i]));
      const bool stays = std::string(by).find("world") != std::string::npos;
      const HeadPose& carrier = stays ? start : now;  // hips and head of this skeleton go together
      EXPECT_LT(apart(world, carrier.position + rotate(carrier.rotation, x)), 1e-6);
    }
  }
}

// Two springs on a particle are one between them, as strong as both.
TEST(SceneForces, HoldsAndTheGoalAddUp) {
  const LoadedScene scene = loadedFrom(
      "[goal]\nstrength = 30\n[[hold]]\nbegin = 1\nend = 1\ngather = 0\nposition = [0, 0, 0]\nstrength = "
      "10\n");
  const GroomGoal rest = ringlet::goalOf(scene.groom);
  const GoalPose pose = goalsOf(scene, 0);
  for (const std::size_t i : {4u, 9u}) {
    EXPECT_NEAR(pose.strengths[i], 40, 1e-5);
    EXPECT_LT(apart(Vec3d(pose.places[i]), Vec3d(rest.places[i]) * 0.75), 1e-7);
  }
  EXPECT_NEAR(pose.strengths[1], 30, 1e-5);
}

// Steps by themselves get what they have of the whole frame.
TEST(SceneForces, MapsAreFactorsOnTheGoal) {
  const LoadedScene scene = loadedFrom(
      "[goal]\nstrength = 4\ntip_share = 0.5\n[[map]]\nnumber = \"goal.strength\"\nstrands = \"1\"\nfactor = "
      "3\n"
      "[[map]]\nnumber = \"goal.strength\"\nstrands = \"0:1\"\nfactor = 0.5\n"
      "[[hold]]\nstrands = \"0\"\nbegin = 1\nend = 1\nstrength = 7\n");
  EXPECT_TRUE(scene.forces.haveGoals());
  const GoalPose goals = goalsOf(scene, 0);
  EXPECT_FLOAT_EQ(goals.strengths[0], 2);
  EXPECT_FLOAT_EQ(goals.strengths[4], 1 + 7) << "a hold has its own";
  EXPECT_FLOAT_EQ(goals.strengths[5], 6);
  EXPECT_FLOAT_EQ(goals.strengths[9], 3);
  EXPECT_EQ(materialOfStrand(scene.material, 1), materialOfStrand(Material{}, 1));
}

TEST(SceneForces, FramesComeInParts) {
  const LoadedScene scene = loadedFrom(
      "[motion]\nkind = \"spin\"\n[[field]]\nkind = \"uniform\"\nstrength = 1\nbind = \"head\"\nposition = "
      "[1, 0, 0]\n"
      "[[hold]]\nbind = \"world\"\n[[key]]\ntime = 0\nfield.1.strength = 0\n[[key]]\ntime = "
      "1\nfield.1.strength = 8\n");
  const FrameForces whole =
      *scene.forces.inFrame({0.25, scene.motion.poseAt(0.25)}, {0.75, scene.motion.poseAt(0.75)},
                            scene.settings.goal, &*scene.keys);
  const FrameForces first = whole.part(0, 0.5), second = whole.part(0.5, 1);
  const auto areNear = [](const ForceField& a, const ForceField& b) {
    return apart(a.place.position, b.place.position) + apart(worldAxis(a), worldAxis(b)) < 1e-12 &&
           a.axial == b.axial;
  };
  EXPECT_TRUE(areNear(first.fieldsFrom[0], whole.fieldsFrom[0]));
  EXPECT_TRUE(areNear(second.fields[0], whole.fields[0]));
  EXPECT_TRUE(areNear(first.fields[0], second.fieldsFrom[0]));
  EXPECT_FALSE(areNear(first.fields[0], whole.fields[0]));
  EXPECT_EQ(first.goals.places, second.placesFrom);
  EXPECT_EQ(first.placesFrom, whole.placesFrom);
  EXPECT_EQ(second.goals.places, whole.goals.places);
  EXPECT_FALSE(first.goals.places == second.goals.places);
  EXPECT_DOUBLE_EQ(first.fields[0].axial, (whole.fieldsFrom[0].axial + whole.fields[0].axial) / 2);
}

TEST(SceneForces, MistakesAreNamed) {
  const struct {
    std::string text;
    const char* message;
  } kCases[] = {
      {"[[field]]\nstrength = 1", "line 13: found a field without a kind; expected kind = one of uniform,"},
      {"[[field]]\nkind = \"vortx\"", "did you mean vortex?"},
      {"[[field]]\nkind = \"uniform\"\ncore = 1", "line 15: found field.core with the kind uniform; only"},
      {"[[field]]\nkind = \"grid\"", "line 13: found a grid without a file; expected an .npy file"},
      {"[[field]]\nkind = \"uniform\"\naxis = [0, 0, 0]", "line 15: found"},
      {"[[field]]\nkind = \"drag\"\njoint = \"Hand\"",
       "line 15: found field.joint, but the head follows no file"},
      {"[[field]]\nkind = \"drag\"\nname = \"a b\"", "letters, digits, _ and - only"},
      {"[[field]]\nkind = \"drag\"\nname = \"a\"\n[[field]]\nkind = \"drag\"\nname = \"a\"",
       "a name that no other field has"},
      {"[[field]]\nname = \"fan\"\nkind = \"drag\"\n[[key]]\ntime = 1\nfield.fun.drag = 1",
       "did you mean field.fan.drag?"},
      {"[[field]]\nname = \"fan\"\nkind = \"drag\"\n[[key]]\ntime = 1\nfield.fan.core = 1",
       "found 'field.fan.core' in a key; it"},
      {"[[hold]]\nbegin = 0.6\nend = 0.5", "line 15: found"},
      {"[[hold]]\nstart = 2\nrelease = 1", "a time after hold.start"},
      {"[[hold]]\nstrands = \"4:2\"", "line 14: hold.strands: "},
      {"[[hold]]\nstrands = \"0:2\"", "the hold 1: it names strand 2; the groom has 2, numbered from 0"},
      {"[[hold]]\nname = \"tie\"\nbegin = 0.3\nend = 0.4",
       "the hold tie: no particle stands between 0.3 and 0.4 of its strand's length"},
      {"[[field]]\nname = \"smoke\"\nkind = \"grid\"\nfile = \"none.npy\"", "the field smoke: "},
      {"[goal]\nshape = true\n[[hold]]\n", "goal.shape = true cannot stand with [[hold]]"},
      {"[[map]]\nnumber = \"goal.strength\"\nstrands = \"1\"\n",
       "line 14: found a map of goal.strength without [goal]"},
      {"[goal]\n[[map]]\nnumber = \"goal.strength\"\nfile = \"none.csv\"\n", "line 16: "},
      {"[goal]\n[[map]]\nnumber = \"goal.strength\"\nstrands = \"0:2\"\n",
       "the goal: a map of goal.strength names strand 2; the groom has 2, numbered from 0"},
      {"[simulation]\nintegrator = \"paper\"\n[[field]]\nkind = \"drag\"",
       "fields, holds and goals of a file need the integrator jacobi"},
  };
  for (const auto& c : kCases) {
    const std::string error = errorOf(c.text);
    EXPECT_NE(error.find(c.message), std::string::npos) << c.text << "\n" << error;
  }
}

}  // namespace
}  // namespace ringlet::scene_forces_test
