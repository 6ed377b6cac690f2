// Scene files: what is read and into which field, what is refused and in which words, that writing and
// reading give back the same, and what becomes of it. What a run makes of them:
// tests/program/scene_file_test.cpp.
#include "ringlet/scenes/file/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <set>

#include "ringlet/groom/hair_styles.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_file_test {
namespace {

// With a groom, where it has none.
std::string errorOf(const std::string& text) {
  const auto scene = parseScene(text, "scene.toml");
  return scene ? "" : scene.error().message;
}

SceneFile parsed(const std::string& text) {
  auto scene = parseScene(text, "scene.toml", "files");
  EXPECT_TRUE(scene) << scene.error().message << "\n" << text;
  return scene ? std::move(*scene) : SceneFile{};
}

constexpr const char* kGroom = "groom.file = 'hair.obj'\n";

// Every key of every table, none at its default. The motions are one of three.
const std::string kEverythingElse =
    "[material]\npreset = 'coil'\nbend_stiffness = 8\n"
    "[material.dials]\nhold = 1.5\nbounce = 0.2\n"
    "[material.variation]\nseed = 7\nbend_stiffness = 0.2\n"
    "[material.profile]\nbend_stiffness = [[0, 1], [1, 0.5]]\n"
    "[simulation]\nfps = 30\nframes = 12\nsteps_per_frame = 5\ngravity = 1.62\npreload = 0.5\nmax_stretch = "
    "1.3\n"
    "teleport_distance = 0.25\nroots = 2\nintegrator = 'point_jacobi'\niterations = 50\nchebyshev = false\n"
    "[contacts]\nradius = 0.004\nfill_gaps = true\nspacing = 0.5\nprune_pairs = true\nenlargement = 2\n"
    "min_overlaps = 4\nmax_neighbours = 9\ndrop_share = 0.25\nseed = 11\nstiffness = 500\ndamping_ratio = "
    "0.5\n"
    "friction = 0.75\ntaper = 'time'\nramp_seconds = 0.01\nstiffness_release_seconds = "
    "0.03\ndamping_release_seconds = 0.04\n"
    "break_factor = 1.5\niterations = 3\ndetail = 0.25\n"
    "[air]\nfall_speed = 3\nalong_share = 0.2\nwind = [1, -2, 3.5]\ngust = 0.5\ngust_seconds = 4\n"
    "turbulence = 0.75\neddy_size = 0.1\nseed = 12\n"
    "[[body]]\nname = 'skull'\nshape = 'sphere'\nradius = 0.09\nthickness = 0.001\nfriction = 0.5\n"
    "position = [0, 0.1, 0]\nrotate_degrees = [10, 20, 30]\n"
    "[[body]]\nshape = 'capsule'\nradius = 0.05\nlength = 0.2\nmoves = 'still'\n"
    "[[body]]\nshape = 'plane'\nmoves = { kind = 'spin', amplitude = 2 }\n"
    "[[body]]\nshape = 'box'\nhalf_extents = [1, 2, 3]\nmoves = 'head'\n"
    "[[body]]\nshape = 'mesh'\nfile = 'head.usd'\nmesh = 'Skin'\nunit = 1\ncells = 100\nscale = 1.5\n"
    "[body.moves]\ninterpolation = 'linear'\n[[body.moves.key]]\ntime = 1\n[[body.moves.key]]\ntime = 2\n"
    "position = [1, 0, 0]\n"
    "[[body]]\nshape = 'mesh'\ngenerate = 'head'\n"
    "[[body]]\nname = 'shoulders'\nshape = 'mesh'\ngenerate = 'bust'\ndeforms = true\n"
    "[[camera]]\nname = 'close'\neye = [0, 1, 2]\ntarget = [0, 0.5, 0]\nup = [0, 0, 1]\nfield_of_view = 40\n"
    "bind = 'head'\n[[camera]]\nname = 'Shot'\nfile = 'shot.glb'\n"
    "[[field]]\nname = 'fan'\nkind = 'uniform'\nstrength = 3\nposition = [1, 2, 3]\nrotate_degrees = [0, 0, "
    "90]\naxis = [1, 0, 0]\nreach = 0.5\ndrag = 4\nbind = 'head'\n"
    "[[field]]\nkind = 'blast'\nstrength = 50\nstart = 0.5\nspeed = 5\nthickness = 0.2\ncore = 0.01\n"
    "[[field]]\nkind = 'grid'\nstrength = 1\nfile = 'smoke.npy'\ncell = 0.05\n"
    "[[hold]]\nname = 'tie'\nstrands = '0:3,7'\nbegin = 0.2\nend = 0.3\ngather = 0.5\nposition = [0, 0.1, "
    "0]\nbind = 'world'\nstrength = 7\nstart = 0.1\nrelease = 2\nease = 0.2\n"
    "[[key]]\ntime = 1\nfield.fan.strength = 5\nfield.fan.position = [0, 1, 0]\nfield.2.drag = 1\n"
    "hold.tie.gather = 1\n"
    "[output]\nfolder = 'out'\nwidth = 0.001\nfiles = ['sheet.png', 'last.obj']\ncache = '16bit'\n"
    "tip_width = 0.0002\nvalues = ['rest', 'id']\nhead = 'none'\nprims = 'groom'\nclip_frames = 12\nhairs = "
    "500\n";

const std::string kKind =
    "[groom]\nfile = 'hair.obj'\nunit = 1\nup = 'Z'\nscale = 0.9\nrotate_degrees = [90, 0, 0]\n"
    "offset = [0, 0.01, 0]\n"
    "[motion]\nkind = 'jump'\namplitude = 0.3\nfrequency = 1.5\naxis = [0, 0, 2]\nease = 0.75\nuntil = 3\n"
    "start = [1, 2, 3]\npre_roll = 0.5\n"
    "[scalp]\nfile = 'skin.obj'\ncache = 'skin.pc2'\ncache_fps = 25\nup = '-Y'\nmesh = 'Skin'\nanimation = 'nod'\nunit = 0.01\nfarthest = 0.002\nstart = "
    "-0.5\n"
    "[motion.roots]\nshift = [0.01, 0, 0]\nfrequency = 2\nease = 0.5\nuntil = inf\n";

const std::string kFile =
    "[groom]\ngenerate = 'swatch'\nparticles = 32\ncolumns = 3\nrows = 2\nspacing = 0.03\nradius = "
    "0.02\nturns = 4\n"
    "length = 0.3\nphase = 1\nhand = 'left'\nvary_radius = 0.2\nvary_length = 0.3\nvary_phase = 0.5\n"
    "other_hand = 0\nseed = 3\n"
    "[motion]\nfile = 'walk.bvh'\njoint = 'Neck'\nunit = 0.01\nskip_frames = 2\n"
    "[[body]]\nshape = 'sphere'\njoint = 'Spine1'\n"
    "[scalp]\nbody = 'skin'\n[[body]]\nname = 'skin'\nshape = 'mesh'\nfile = 'skin.glb'\ndeforms = true\n"
    "[[field]]\nkind = 'point'\nstrength = -1\njoint = 'Hand'\n[[hold]]\njoint = 'Hand'\n";

const std::string kKeys =
    "[groom]\ngenerate = 'head'\nstrands = 20\nlocks = 4\nscalp_radius = 0.1\n"
    "[motion]\ninterpolation = 'linear'\n"
    "[[motion.key]]\ntime = -1\nposition = [1, 2, 3]\nrotate_degrees = [0, 90, 0]\n"
    "[[motion.key]]\ntime = 0.5\nquaternion = [0, 0, 2, 0]\n";

TEST(SceneFile, EverythingIsRead) {
  const SceneFile s = parsed(kKind + kEverythingElse);
  EXPECT_EQ(s.groom.file, "files/hair.obj");
  EXPECT_EQ(s.groom.generate, "");
  EXPECT_EQ(s.groom.metresPerUnit, 1);
  EXPECT_EQ(s.groom.up, "Z");
  EXPECT_EQ(s.groom.scale, 0.9);
  EXPECT_EQ(s.groom.rotateDegrees, (Vec3d{90, 0, 0}));
  EXPECT_EQ(s.groom.offset, (Vec3d{0, 0.01, 0}));

  Material material = materialPreset("coil").value();
  material.bendStiffness = 8;
  material.variation = {.bendStiffness = 0.2, .seed = 7};
  material.bendStiffnessProfile.points = {{0, 1}, {1, 0.5}};
  EXPECT_TRUE(s.hasMaterial);
  EXPECT_EQ(s.material.material, material);
  EXPECT_EQ(s.material.dials, (MaterialDials{.hold = 1.5, .bounce = 0.2}));

  EXPECT_EQ(s.motion.kind, "jump");
  EXPECT_EQ(s.motion.amplitude, 0.3);
  EXPECT_EQ(s.motion.frequency, 1.5);
  EXPECT_EQ(s.motion.axis, (Vec3d{0, 0, 2}));
  EXPECT_EQ(s.motion.easeSeconds, 0.75);
  EXPECT_EQ(s.motion.untilSeconds, 3);
  EXPECT_EQ(s.motion.start, (Vec3d{1, 2, 3}));
  EXPECT_EQ(s.motion.preRollSeconds, 0.5);
  EXPECT_EQ(s.motion.roots.shift, (Vec3d{0.01, 0, 0}));
  EXPECT_EQ(s.motion.roots.frequency, 2);
  EXPECT_EQ(s.motion.roots.easeSeconds, 0.5);
  EXPECT_EQ(s.motion.roots.untilSeconds, HUGE_VAL);

  EXPECT_EQ(s.simulation.framesPerSecond, 30);
  EXPECT_EQ(s.simulation.frames, 12);
  EXPECT_EQ(s.simulation.stepsPerFrame, 5);
  EXPECT_EQ(s.simulation.gravity, 1.62);
  EXPECT_EQ(s.simulation.preload, 0.5);
  EXPECT_EQ(s.simulation.maxStretch, 1.3);
  EXPECT_EQ(s.simulation.teleportDistance, 0.25);
  EXPECT_EQ(s.simulation.roots, 2);
  EXPECT_EQ(s.simulation.integrator, "point_jacobi");
  EXPECT_EQ(s.simulation.iterations, 50);
  EXPECT_FALSE(s.simulation.chebyshev);

  EXPECT_TRUE(s.contacts.on) << "as the table stands";
  EXPECT_EQ(s.contacts.radius, 0.004);
  EXPECT_TRUE(s.contacts.fillGaps);
  EXPECT_EQ(s.contacts.spacing, 0.5);
  EXPECT_TRUE(s.contacts.prunePairs);
  EXPECT_EQ(s.contacts.enlargement, 2);
  EXPECT_EQ(s.contacts.minOverlaps, 4);
  EXPECT_EQ(s.contacts.maxNeighbours, 9);
  EXPECT_EQ(s.contacts.dropShare, 0.25);
  EXPECT_EQ(s.contacts.seed, 11u);
  EXPECT_EQ(s.contacts.stiffness, 500);
  EXPECT_EQ(s.contacts.dampingRatio, 0.5);
  EXPECT_EQ(s.contacts.friction, 0.75);
  EXPECT_EQ(s.contacts.taper, ContactTaper::time);
  EXPECT_EQ(s.contacts.rampSeconds, 0.01);
  EXPECT_EQ(s.contacts.stiffnessReleaseSeconds, 0.03);
  EXPECT_EQ(s.contacts.dampingReleaseSeconds, 0.04);
  EXPECT_EQ(s.contacts.breakFactor, 1.5);
  EXPECT_EQ(s.contacts.iterations, 3);
  EXPECT_EQ(s.contacts.detail, 0.25);

  EXPECT_TRUE(s.air.on);
  EXPECT_EQ(s.air.fallSpeed, 3);
  EXPECT_EQ(s.air.alongShare, 0.2);
  EXPECT_EQ(s.air.wind, (Vec3d{1, -2, 3.5}));
  EXPECT_EQ(s.air.gust, 0.5);
  EXPECT_EQ(s.air.gustSeconds, 4);
  EXPECT_EQ(s.air.turbulence, 0.75);
  EXPECT_EQ(s.air.eddySize, 0.1);
  EXPECT_EQ(s.air.seed, 12u);

  ASSERT_EQ(s.bodies.size(), 7u);
  EXPECT_EQ(s.bodies[0].name, "skull");
  EXPECT_EQ(s.bodies[0].shape, BodyShape::sphere);
  EXPECT_EQ(s.bodies[0].radius, 0.09);
  EXPECT_EQ(s.bodies[0].thickness, 0.001);
  EXPECT_EQ(s.bodies[0].friction, 0.5);
  EXPECT_EQ(s.bodies[0].position, (Vec3d{0, 0.1, 0}));
  EXPECT_EQ(s.bodies[0].rotateDegrees, (Vec3d{10, 20, 30}));
  EXPECT_FALSE(s.bodies[0].moves) << "the head carries it";
  EXPECT_EQ(s.bodies[1].length, 0.2);
  ASSERT_TRUE(s.bodies[1].moves);
  EXPECT_EQ(s.bodies[1].moves->kind, "still");
  ASSERT_TRUE(s.bodies[2].moves);
  EXPECT_EQ(s.bodies[2].moves->kind, "spin");
  EXPECT_EQ(s.bodies[2].moves->amplitude, 2);
  EXPECT_EQ(s.bodies[3].halfExtents, (Vec3d{1, 2, 3}));
  EXPECT_FALSE(s.bodies[3].moves);
  EXPECT_EQ(s.bodies[4].file, "files/head.usd");
  EXPECT_EQ(s.bodies[4].mesh, "Skin");
  EXPECT_EQ(s.bodies[4].metresPerUnit, 1);
  EXPECT_EQ(s.bodies[4].cells, 100);
  EXPECT_EQ(s.bodies[4].scale, 1.5);
  ASSERT_TRUE(s.bodies[4].moves);
  ASSERT_EQ(s.bodies[4].moves->keys.size(), 2u);
  EXPECT_EQ(s.bodies[4].moves->keys[1].position, (Vec3d{1, 0, 0}));
  EXPECT_EQ(s.bodies[5].generate, "head");
  EXPECT_EQ(s.bodies[6].generate, "bust");
  EXPECT_TRUE(s.bodies[6].deforms);

  EXPECT_EQ(s.output.folder, "files/out");
  EXPECT_EQ(s.output.width, 0.001);
  EXPECT_EQ(s.output.files, (std::vector<std::string>{"sheet.png", "last.obj"}));
  EXPECT_EQ(s.output.cache, "16bit");
  EXPECT_TRUE(s.warnings.empty());
}

TEST(SceneFile, EveryOtherGroomAndMotionIsRead) {
  const SceneFile file = parsed(kFile);
  EXPECT_EQ(file.scalp.body, "skin");
  EXPECT_EQ(file.groom.generate, "swatch");
  EXPECT_EQ(file.groom.particles, 32);
  EXPECT_EQ(file.groom.columns, 3);
  EXPECT_EQ(file.groom.rows, 2);
  EXPECT_EQ(file.groom.spacing, 0.03);
  EXPECT_EQ(file.groom.radius, 0.02);
  EXPECT_EQ(file.groom.turns, 4);
  EXPECT_EQ(file.groom.length, 0.3);
  EXPECT_EQ(file.groom.phase, 1);
  EXPECT_EQ(file.groom.hand, "left");
  EXPECT_EQ(file.groom.varyRadius, 0.2);
  EXPECT_EQ(file.groom.varyLength, 0.3);
  EXPECT_EQ(file.groom.varyPhase, 0.5);
  EXPECT_EQ(file.groom.otherHand, 0);
  EXPECT_EQ(file.groom.seed, 3u);
  EXPECT_EQ(file.motion.kind, "");
  EXPECT_EQ(file.motion.file, "files/walk.bvh");
  EXPECT_EQ(file.motion.joint, "Neck");
  EXPECT_EQ(file.motion.metresPerUnit, 0.01);
  EXPECT_EQ(file.motion.skipFrames, 2);
  EXPECT_EQ(file.bodies.at(0).joint, "Spine1");

  const SceneFile keys = parsed(kKeys);
  EXPECT_EQ(keys.groom.strands, 20);
  EXPECT_EQ(keys.groom.locks, 4);
  EXPECT_EQ(keys.groom.scalpRadius, 0.1);
  EXPECT_EQ(keys.motion.interpolation, "linear");
  ASSERT_EQ(keys.motion.keys.size(), 2u);
  EXPECT_EQ(keys.motion.keys[0].time, -1);
  EXPECT_EQ(keys.motion.keys[0].position, (Vec3d{1, 2, 3}));
  EXPECT_EQ(keys.motion.keys[0].rotateDegrees, (Vec3d{0, 90, 0}));
  EXPECT_EQ(keys.motion.keys[1].quaternion, (Quatd{0, 0, 2, 0}));

  const SceneFile paper =
      parsed(std::string(kGroom) +
             "[simulation]\nintegrator = 'paper'\nforce_loops = 3\ndamping_loops = 4\nseconds = 2\n");
  EXPECT_EQ(paper.simulation.forceLoops, 3);
  EXPECT_EQ(paper.simulation.dampingLoops, 4);
  EXPECT_EQ(paper.simulation.seconds, 2);
}

TEST(SceneFile, AGroomIsEnough) {
  const SceneFile s = parsed(kGroom);
  EXPECT_EQ(s.motion.kind, "still");
  EXPECT_FALSE(s.hasMaterial);
  EXPECT_FALSE(s.contacts.on);
  EXPECT_FALSE(s.air.on);
  EXPECT_TRUE(s.bodies.empty());
  EXPECT_FALSE(parsed(std::string(kGroom) + "[contacts]\non = false\n").contacts.on);
}

TEST(SceneFile, PathsAreRelativeToTheFile) {
  const auto folder = test::scratchFolder("scene_file_paths");
  std::filesystem::create_directories(folder / "scenes");
  std::ofstream(folder / "scenes/a.toml") << "groom.file = '../hair.obj'\nmaterial.file = 'soft.toml'\n"
                                             "material.core_stiffness = 3\noutput.folder = '/elsewhere'\n";
  std::ofstream(folder / "scenes/soft.toml")
      << "bend_stiffness = 0.1\ncore_stiffness = 4\n[dials]\nhold = 0.5\n";
  const auto scene = readScene(folder / "scenes/a.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->groom.file, folder / "scenes/../hair.obj");
  EXPECT_EQ(scene->output.folder, "/elsewhere");
  EXPECT_EQ(scene->material.material.bendStiffness, 0.1) << "the file's";
  EXPECT_EQ(scene->material.material.coreStiffness, 3) << "instead of the file's";
  EXPECT_EQ(scene->material.dials.hold, 0.5);
  ASSERT_EQ(scene->warnings.size(), 1u) << "once, though the file by itself has it too";
  EXPECT_NE(scene->warnings[0].find("a.toml: bend_stiffness is 0.1; usual is"), std::string::npos);
}

// One line a kind of mistake: the text, and the message after "scene.toml: ".
TEST(SceneFile, MistakesAreNamedWithLineAndRemedy) {
  const struct {
    std::string text;
    const char* message;
  } kCases[] = {
      // keys
      {"groom.file = 'a.obj'\n[moton]\nkind = 'nod'",
       "line 2: found the unknown key 'moton'; did you mean motion?"},
      {"fps = 24\ngroom.file = 'a.obj'", "line 1: found the unknown key 'fps'; did you mean simulation.fps?"},
      {"[groom]\nfile = 'a.obj'\nunits = 1",
       "line 3: found the unknown key 'units' in [groom]; did you mean groom.unit?"},
      {"[groom]\nfile = 'a.obj'\n\nteleport_distnace = 1",
       "line 4: found the unknown key 'teleport_distnace' in [groom]; did you mean "
       "simulation.teleport_distance?"},
      {"[groom]\nfile = 'a.obj'\n[material]\nbend_stifness = 1",
       "line 4: found the unknown key 'bend_stifness' in [material]; did you mean material.bend_stiffness?"},
      {"[groom]\nfile = 'a.obj'\n[material.dials]\nhodl = 1",
       "line 4: found the unknown key 'hodl' in [material.dials]; did you mean material.dials.hold?"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'nod'\n[motion.roots]\nshfit = [0, 0, 0]",
       "line 6: found the unknown key 'shfit' in [motion.roots]; did you mean motion.roots.shift?"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\ntiem = 1",
       "line 4: found the unknown key 'tiem' in [motion.key]; did you mean motion.key.time?"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\ntime = 1\nzzzzzzzz = 1",
       "line 5: found the unknown key 'zzzzzzzz' in [motion.key]; expected time, position, rotate_degrees, "
       "quaternion"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'box'\nhalf_extent = 1",
       "line 5: found the unknown key 'half_extent' in [body]; did you mean body.half_extents?"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'box'\n[body.moves]\nknid = 'nod'",
       "line 6: found the unknown key 'knid' in [body.moves]; did you mean body.moves.kind?"},
      {"[grom]\nfile = 'a.obj'", "line 1: found the unknown key 'grom'; did you mean groom?"},
      // tables
      {"[[groom]]\nfile = 'a.obj'", "line 1: found a list of 1 for groom; expected a table, as in [groom]"},
      {"[groom]\nfile = 'a.obj'\n[body]\nshape = 'box'",
       "line 3: found a table for body; expected a list of tables, as in [[body]]"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkey = 3",
       "line 4: found the number 3 for motion.key; expected a list of tables, as in [[motion.key]]"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkey = []",
       "line 4: found a list of 0 for motion.key; expected at least one key, as in [[motion.key]]"},
      {"motion = 3\n[groom]\nfile = 'a.obj'",
       "line 1: found the number 3 for motion; expected a table, as in [motion]"},
      // types
      {"[groom]\nfile = 5", "line 2: found the number 5 for groom.file; expected a path"},
      {"[groom]\nfile = ''", "line 2: found the text '' for groom.file; expected a path"},
      {"[groom]\ngenerate = 'heads'",
       "line 2: found the text 'heads' for groom.generate; expected one of curl, swatch, head; did you mean "
       "head?"},
      {"[groom]\nfile = 'a.obj'\nup = 'z'", "line 3: found the text 'z' for groom.up; expected one of Y, Z"},
      {"[groom]\nfile = 'a.obj'\noffset = [0, 1]",
       "line 3: found a list of 2 for groom.offset; expected [x, y, z], each from -1000000 to 1000000 m"},
      {"[groom]\nfile = 'a.obj'\noffset = [0, 1, 'x']",
       "line 3: found a list of 3 for groom.offset; expected [x, y, z], each from -1000000 to 1000000 m"},
      {"[groom]\nfile = 'a.obj'\n[simulation]\nframes = 2.5",
       "line 4: found the number 2.5 for simulation.frames; expected a whole number from 1 to 1000000"},
      {"[groom]\nfile = 'a.obj'\n[simulation]\nfps = '24'",
       "line 4: found the text '24' for simulation.fps; expected a number from 0.001 to 1000000 1/s"},
      {"[groom]\nfile = 'a.obj'\n[contacts]\non = 1",
       "line 4: found the number 1 for contacts.on; expected true or false"},
      {"[groom]\nfile = 'a.obj'\n[output]\nfiles = ['hair.usd']",
       "line 4: found a list of 1 for output.files; expected a list of hair.usda, hair.usdc, hair.abc, hair.pc2, "
       "last.obj, "
       "sheet.png"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'sphere'\nmoves = 'heda'",
       "line 5: found the text 'heda' for body.moves; expected \"head\", \"still\" or a motion, as in { kind "
       "= "
       "\"spin\" }; did you mean head?"},
      {"[groom]\nfile = 'a.obj'\n[material]\nbend_stiffness = 'soft'",
       "line 4: found the text 'soft' for material.bend_stiffness; expected a number from 0.001 to 1000000 "
       "w"},
      {"[groom]\nfile = 'a.obj'\n[material]\npreset = 'ringlets'",
       "line 4: found the text 'ringlets' for material.preset; expected one of straight, wavy, loose_curl, "
       "ringlet, coil; did you mean ringlet?"},
      {"[groom]\nfile = 'a.obj'\n[material]\ndials = 1",
       "line 4: found the number 1 for material.dials; expected a table, as in [material.dials]"},
      // ranges
      {"[groom]\nfile = 'a.obj'\nunit = 0",
       "line 3: found the number 0 for groom.unit; expected a number from 1e-06 to 1000 m"},
      {"[groom]\nfile = 'a.obj'\n[simulation]\nroots = 4",
       "line 4: found the number 4 for simulation.roots; expected a whole number from 1 to 3"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'nod'\nuntil = -1",
       "line 5: found the number -1 for motion.until; expected a number from 0 s on"},
      {"[groom]\nfile = 'a.obj'\n[contacts]\nradius = nan",
       "line 4: found the number nan for contacts.radius; expected a number from 1e-06 to 1 m"},
      {"[groom]\nfile = 'a.obj'\n[air]\nseed = -1",
       "line 4: found the number -1 for air.seed; expected a whole number from 0 to 4294967295"},
      {"[groom]\nfile = 'a.obj'\n[material]\n\ncore_elongation_low = 1.3",
       "line 5: core_elongation_high is 1.1; it must be above core_elongation_low, which is 1.3, by 1e-06 or "
       "more"},
      // what makes no sense together
      {"", "line 1: found no groom; expected [groom], with file or generate, the name of a generator"},
      {"[groom]\nunit = 1", "line 1: found neither groom.file nor groom.generate; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\ngenerate = 'head'",
       "line 3: found groom.file and groom.generate; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\nstrands = 5",
       "line 3: found groom.strands with a groom from file; only head has it"},
      {"[groom]\ngenerate = 'curl'\nseed = 5",
       "line 3: found groom.seed with a groom from curl; only swatch, head have it"},
      {"[groom]\nfile = 'a.obj'\n[material]\npreset = 'coil'\nfile = 'b.toml'",
       "line 5: found material.file and material.preset; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'nod'\nfile = 'a.bvh'",
       "line 5: found two ways for the head to move; expected one of kind, file and keys"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'nod'\n[[motion.key]]\ntime = 1",
       "line 5: found two ways for the head to move; expected one of kind, file and keys"},
      {"[groom]\nfile = 'a.obj'\n[motion]\namplitude = 1",
       "line 4: found no way to move in [motion]; expected one of kind, file and keys"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'spin'\nfrequency = 1",
       "line 5: found motion.frequency with a motion by spin; only shake, nod, walk, jump have it"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'spin'\njoint = 'Head'",
       "line 5: found motion.joint with a motion by spin; only file has it"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nkind = 'spin'\naxis = [0, 0, 0]",
       "line 5: found a list of 3 for motion.axis; expected a direction, whose length is above 0"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\ntime = 1\n[[motion.key]]\ntime = 1",
       "line 6: found the time 1 of key 2 of motion.key; expected one after that of the key before, 1"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\ntime = 1\nquaternion = [0, 0, 0, 0]",
       "line 5: found a list of 4 for motion.key.quaternion; expected [x, y, z, w], of a length above 0"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\ntime = 1\nquaternion = [0, 0, 0, 1]\nrotate_degrees = [0, "
       "0, 0]",
       "line 6: found a quaternion and rotate_degrees of key 1 of motion.key; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\n[[motion.key]]\nposition = [1, 2, 3]",
       "line 3: found no time of key 1 of motion.key; expected one, in seconds"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'box'\nmoves = {}",
       "line 5: found no way to move in [body.moves]; expected one of kind, file and keys"},
      {"[groom]\nfile = 'a.obj'\n[simulation]\nframes = 2\nseconds = 2",
       "line 5: found simulation.frames and simulation.seconds; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\n[simulation]\niterations = 2",
       "line 4: found simulation.iterations with the integrator jacobi; only point_jacobi has it"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nradius = 1",
       "line 3: found a body without a shape; expected shape = one of sphere, capsule, plane, box, mesh"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'plane'\nradius = 1",
       "line 5: found body.radius with the shape plane; only sphere, capsule have it"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'",
       "line 3: found a mesh with neither a file nor a generator; expected one of file and generate"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'\nfile = 'b.obj'\ngenerate = 'head'",
       "line 5: found a mesh with both a file and a generator; expected one of file and generate"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'\ngenerate = 'bust'",
       "line 5: found the text 'bust' for body.generate; expected deforms = true beside it"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'\ngenerate = 'head'\ndeforms = true",
       "line 5: found the text 'head' for body.generate; expected bust or cape: no other generated mesh deforms"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'\ngenerate = 'cape'\ndeforms = true",
       "line 5: found the text 'cape' for body.generate; expected sides = \"both\" beside it"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'mesh'\ngenerate = 'bust'\ndeforms = true\nunit = 1",
       "line 7: found body.unit of the generated bust; only a mesh of a file has it"},
      {"[groom]\nfile = 'a.obj'\n[scalp]\nfarthest = 1",
       "line 3: found neither scalp.file nor scalp.body; expected one of the two"},
      {"[groom]\nfile = 'a.obj'\n[scalp]\nbody = 'bust'",
       "line 4: found the text 'bust' for scalp.body; expected the name of a body that deforms"},
      {"[groom]\nfile = 'a.obj'\n[scalp]\nbody = 'bust'\nstart = 1\n[[body]]\nname = 'bust'\nshape = "
       "'mesh'\ngenerate = 'bust'\ndeforms = true",
       "line 5: found scalp.start beside scalp.body, whose own it is; expected none"},
      {"[groom]\nfile = 'a.obj'\n[scalp]\nbody = 'busk'\n[[body]]\nname = 'bust'\nshape = "
       "'mesh'\ngenerate = 'bust'\ndeforms = true",
       "line 4: found the text 'busk' for scalp.body; expected the name of a body that deforms; did you mean bust?"},
      {"[groom]\nfile = 'a.obj'\n[scalp]\nbody = 'head'\n[[body]]\nname = 'head'\nshape = "
       "'mesh'\ngenerate = 'head'",
       "line 4: found the text 'head' for scalp.body; expected the name of a body that deforms"},
      {"[groom]\nfile = 'a.obj'\n[[body]]\nshape = 'sphere'\njoint = 'Neck'",
       "line 5: found body.joint, but the head follows no file; expected motion.file"},
      {"[groom]\nfile = 'a.obj'\n[motion]\nfile = 'a.bvh'\n[[body]]\nshape = 'sphere'\njoint = 'Neck'\nmoves "
       "= "
       "'head'",
       "line 8: found body.moves and body.joint; expected one of the two"},
      // several: the topmost; and what is no TOML
      {"[groom]\nfile = 'a.obj'\nunit = 0\n[motoin]\n[[body]]\n",
       "line 3: found the number 0 for groom.unit; expected a number from 1e-06 to 1000 m"},
  };
  for (const auto& c : kCases) EXPECT_EQ(errorOf(c.text), std::string("scene.toml: ") + c.message) << c.text;
  EXPECT_EQ(errorOf("[groom\n").rfind("scene.toml: line 1: found no TOML: ", 0), 0u) << errorOf("[groom\n");
  EXPECT_NE(errorOf("[groom]\nfile = 'a.obj'\nmaterial.file = 3\n[material]\nfile = 'none.toml'\n").size(),
            0u);
  EXPECT_EQ(
      errorOf("[groom]\nfile = 'a.obj'\n[material]\nfile = 'none.toml'\n").rfind("scene.toml: line 4: ", 0),
      0u);
}

// Tables of a list have numbers from 1 to their count.
TEST(SceneFile, AChangeReachesEachTableOfAList) {
  const std::string text =
      std::string(kGroom) +
      "[[body]]\nshape = 'sphere'\n[[body]]\nshape = 'sphere'\n[[body]]\nshape = 'sphere'\n";
  for (int k = 0; k <= 4; ++k) {
    const SceneChange change{fmt::format("body.{}.radius", k), "0.5"};
    const auto scene = parseScene(text, "scene.toml", {}, std::span(&change, 1));
    if (k == 0 || k == 4) {
      ASSERT_FALSE(scene) << k;
      EXPECT_NE(scene.error().message.find("expected the number of a table, from 1 to 3"), std::string::npos)
          << scene.error().message;
      continue;
    }
    ASSERT_TRUE(scene) << scene.error().message;
    for (int b = 0; b < 3; ++b)
      EXPECT_EQ(scene->bodies[static_cast<std::size_t>(b)].radius == 0.5, b + 1 == k) << k;
  }
}

TEST(SceneFile, CamerasAreRead) {
  const SceneFile s = parsed(kKind + kEverythingElse);
  ASSERT_EQ(s.cameras.size(), 2u);
  EXPECT_EQ(s.cameras[0], (SceneCamera{.name = "close",
                                       .eye = Vec3d{0, 1, 2},
                                       .target = {0, 0.5, 0},
                                       .up = Vec3d{0, 0, 1},
                                       .fieldOfView = 40,
                                       .bind = "head"}));
  EXPECT_EQ(s.cameras[1], (SceneCamera{.name = "Shot", .file = "files/shot.glb"}));
  const std::string at = std::string(kGroom) + "[[camera]]\n";
  const std::pair<const char*, const char*> refused[] = {
      {"eye = [0, 0, 1]\n", "a camera without a name"},
      {"name = 'a'\n", "neither eye nor file"},
      {"name = 'a'\nfile = 'a.glb'\ntarget = [0, 0, 1]\n", "camera.target with a camera with file"},
      {"name = 'a'\neye = [0, 0, 0]\n", "another place than camera.target"},
      {"name = 'a'\neye = [0, 0, 1]\njoint = 'Neck'\n", "expected motion.file"},
      {"name = 'a'\neye = [0, 0, 1]\nfield_of_view = 0\n", "from 1 to 170 deg"},
      {"name = 'a'\neye = [0, 0, 1]\n[[camera]]\nname = 'a'\neye = [0, 0, 1]\n", "no other camera"},
  };
  for (const auto& [text, part] : refused)
    EXPECT_NE(errorOf(at + text).find(part), std::string::npos) << text << errorOf(at + text);
}

// Of every key there is: what it is called, and that another type is refused in its line.
TEST(SceneFile, EveryKeyIsListedAndChecked) {
  std::set<std::string> seen;
  for (const SceneKey& key : sceneKeys()) {
    const std::string name = key.table + "." + key.key;
    SCOPED_TRACE(name);
    EXPECT_TRUE(seen.insert(name).second) << "twice";
    for (const std::string& text : {key.type, key.standard, key.effect}) EXPECT_FALSE(text.empty());
    EXPECT_EQ(key.effect.back(), '.');
    const bool isList = key.table == "body" || key.table == "camera" || key.table == "motion.key" ||
                        key.table == "field" || key.table == "hold";
    // A date is of no key's type.
    const std::string error =
        errorOf(fmt::format("{}\n{}{}{}\n{} = 2020-01-01\n", key.table == "groom" ? "" : kGroom,
                            isList ? "[[" : "[", key.table, isList ? "]]" : "]", key.key));
    EXPECT_EQ(error.find("unknown key"), std::string::npos) << error;
    if (key.key == "shape" || key.table == "groom") continue;  // without one that is the first thing to say
    EXPECT_EQ(error.rfind("scene.toml: line ", 0), 0u) << error;
  }
  for (const char* name :
       {"groom.file", "motion.kind", "motion.pre_roll", "motion.key.quaternion",
        "simulation.teleport_distance", "contacts.damping_release_seconds", "air.eddy_size",
        "body.half_extents", "body.moves", "camera.eye", "camera.field_of_view", "output.files",
        "motion.roots.shift", "scalp.file", "scalp.start", "field.kind", "hold.gather"})
    EXPECT_TRUE(seen.count(name)) << name;
}

TEST(SceneFile, WhatIsWrittenIsReadBack) {
  for (const std::string& text : {kKind + kEverythingElse, kFile, kKeys, std::string(kGroom)}) {
    const SceneFile scene = parsed(text);
    const std::string written = sceneText(scene, "files", "# Nothing.\n");
    EXPECT_EQ(written.rfind("# Nothing.\n", 0), 0u);
    const SceneFile again = parsed(written);
    EXPECT_EQ(sceneText(again, "files", "# Nothing.\n"), written);
    EXPECT_EQ(again.material.material, scene.material.material);
    EXPECT_EQ(again.groom.file, scene.groom.file);
    EXPECT_EQ(again.bodies.size(), scene.bodies.size());
    EXPECT_EQ(again.fields, scene.fields);
    EXPECT_EQ(again.holds, scene.holds);
    EXPECT_EQ(again.timeKeys, scene.timeKeys);
    ASSERT_EQ(again.cameras.size(), scene.cameras.size());
    for (std::size_t k = 0; k < scene.cameras.size(); ++k) EXPECT_EQ(again.cameras[k], scene.cameras[k]);
  }
  const std::string written = sceneText(parsed(kKind + kEverythingElse), "files");
  // Every key that was stated stands there again, but presets, whose numbers do, and what is the default.
  for (const char* line : {"file = \"hair.obj\"  # ", "rotate_degrees = [90.0, 0.0, 0.0]  # [deg] ",
                           "until = inf", "seed = 11", "moves = \"still\"", "[body.moves]",
                           "[[body.moves.key]]", "folder = \"out\"", "eddy_size = 0.1  # [m] "})
    EXPECT_NE(written.find(line), std::string::npos) << line << " is missing in:\n" << written;
}

TEST(SceneFile, PathsElsewhereStayWhole) {
  SceneFile scene = parsed(kGroom);
  scene.groom.file = "/else/\"where\"\\hair.obj";
  const SceneFile again = parsed(sceneText(scene, "files"));
  EXPECT_EQ(again.groom.file, scene.groom.file);
}

// Pieces of a valid file changed at random: read or refused, never more.
TEST(SceneFile, SpoiltFilesAreReadOrRefused) {
  const std::string valid = kKeys + kEverythingElse;
  const std::string alphabet = "[]{}=.,\"'#\n\t 0123456789e+-_axX:\\\xff";
  std::mt19937 random(20240601);
  int accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = valid;
    for (auto change = 1 + random() % 3; change > 0 && !text.empty(); --change) {
      const std::size_t at = random() % text.size(), count = random() % 8;
      switch (random() % 3) {
        case 0:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.erase(at, count);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), count));
          break;
      }
    }
    const auto scene = parseScene(text, "scene.toml");
    if (!scene) {
      ASSERT_EQ(scene.error().message.rfind("scene.toml: ", 0), 0u) << scene.error().message;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(parseScene(sceneText(*scene), "scene.toml")) << text;
  }
  EXPECT_GT(accepted, 100);
}

TEST(SceneFile, ManyKeysAreNoDeepNesting) {
  std::string text = kGroom;
  for (int k = 0; k < 3000; ++k)
    text += fmt::format("[[motion.key]]\ntime = {}.5\nposition = [0.1, 0.2, 0.3]\n", k);
  EXPECT_EQ(parsed(text).motion.keys.size(), 3000u);
}

void expectNear(Vec3d found, Vec3d expected) {
  EXPECT_LT(length(found - expected), 1e-12) << found.x << " " << found.y;
}

TEST(SceneParts, TurnsAreAboutXThenYThenZ) {
  expectNear(rotate(turnOfDegrees({90, 0, 0}), Vec3d{0, 1, 0}), {0, 0, 1});
  expectNear(rotate(turnOfDegrees({90, 90, 0}), Vec3d{0, 1, 0}), {1, 0, 0});
  expectNear(rotate(turnOfDegrees({90, 90, 90}), Vec3d{0, 1, 0}), {0, 1, 0});
}

TEST(SceneParts, GroomsArePlacedInTheHeadsFrame) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {0, 2, 0}});
  SceneGroom scene;
  placeGroom(scene, groom);
  EXPECT_EQ(groom.points[1], (Vec3f{0, 2, 0}));
  scene.scale = 3;
  scene.rotateDegrees = {90, 0, 0};
  scene.offset = {0.1, 0, 0};  // ten of the groom's centimetres
  placeGroom(scene, groom);
  EXPECT_LT(length(groom.points[0] - Vec3f{13, 0, 0}), 1e-5f);
  EXPECT_LT(length(groom.points[1] - Vec3f{10, 0, 6}), 1e-5f);
}

TEST(SceneParts, GeneratorsMakeWhatMakeMakes) {
  const auto swatch = generatedGroom(parsed(kFile).groom);
  ASSERT_TRUE(swatch) << swatch.error().message;
  EXPECT_EQ(swatch->strandCount(), 6u);
  EXPECT_EQ(swatch->points.size(), 6u * 32);
  const auto head = generatedGroom(SceneGroom{.file = {}, .generate = "head"}), made = makeHead();
  ASSERT_TRUE(head && made);
  EXPECT_EQ(head->points, made->points);
  EXPECT_EQ(generatedGroom(SceneGroom{.file = {}, .generate = "curl"})->points, makeCurl()->points);
}

TEST(SceneParts, StylesHoldWhereNothingElseIsSaid) {
  const std::string styled = "[groom]\ngenerate = \"head\"\nstrands = 40\nparticles = 16\nstyle = \"bob\"\n";
  HeadParameters bob = *headOfStyle("bob");
  bob.strandCount = 40;
  bob.curl.particleCount = 16;
  EXPECT_EQ(generatedGroom(parsed(styled).groom)->points, makeHead(bob)->points);
  // Back to the default, which is not the style's; written, it is read back.
  const SceneFile scene = parsed(styled + "turns = 8\n[groom.cut]\nparting = \"right\"\nclump = 0\n");
  bob.curl.turns = 8;
  bob.cut.parting = "right";
  bob.cut.clump = 0;
  EXPECT_EQ(generatedGroom(scene.groom)->points, makeHead(bob)->points);
  EXPECT_EQ(generatedGroom(parsed(sceneText(scene)).groom)->points, makeHead(bob)->points);
  const struct {
    std::string text;
    const char* message;
  } kCases[] = {
      {"[groom]\ngenerate = \"head\"\nstyle = \"bop\"\n",
       "line 3: found the text 'bop' for groom.style; expected one of"},
      {"[groom]\ngenerate = \"curl\"\nstyle = \"bob\"\n", "line 3: found groom.style with a groom from curl"},
      {"[groom]\ngenerate = \"swatch\"\n[groom.cut]\nclump = 0.5\n", "line 3: found groom.cut; only"},
      {"[groom]\ngenerate = \"head\"\n[groom.cut]\nparting = \"midle\"\n", "did you mean middle?"},
  };
  for (const auto& c : kCases) {
    const auto wrong = parseScene(c.text, "scene.toml");
    ASSERT_FALSE(wrong) << c.text;
    EXPECT_NE(wrong.error().message.find(c.message), std::string::npos) << wrong.error().message;
  }
}

TEST(SceneParts, MotionsAreTheStatedOnes) {
  const Vec3d up{0, 0, 1};
  const Motion spin = motionOf({.kind = "spin"}, up);
  EXPECT_EQ(spin.axis, up);
  EXPECT_EQ(spin.amplitude, std::numbers::pi);
  const Motion jump = motionOf(parsed(kKind).motion, up);
  EXPECT_EQ(jump.kind, MotionKind::jump);
  EXPECT_EQ(jump.amplitude, 0.3);
  EXPECT_EQ(jump.frequency, 1.5);
  EXPECT_EQ(jump.axis, up) << "of length 1";
  EXPECT_EQ(jump.easeSeconds, 0.75);
  EXPECT_EQ(jump.untilSeconds, 3);
  EXPECT_EQ(jump.start, (Vec3d{1, 2, 3}));
  EXPECT_EQ(jump.roots.frequency, 2);

  const Motion keys = motionOf(parsed(kKeys).motion, up);
  expectNear(keys.poseAt(-5).position, {1, 2, 3});
  expectNear(keys.poseAt(-0.25).position, {0.5, 1, 1.5});
  expectNear(rotate(keys.poseAt(-1).rotation, Vec3d{0, 0, 1}), {1, 0, 0});
  expectNear(rotate(keys.poseAt(9).rotation, Vec3d{1, 0, 0}), {-1, 0, 0});
}

TEST(SceneParts, BodiesAreTheStatedOnes) {
  const SceneFile scene = parsed(kKind + kEverythingElse);
  const Vec3d up{0, 0, 1};
  const HeadPose head{{5, 0, 0}, {}};
  const Body sphere = bodyOf(scene.bodies[0], 0, up);
  EXPECT_EQ(sphere.name, "skull");
  EXPECT_EQ(sphere.shape, BodyShape::sphere);
  EXPECT_EQ(sphere.radius, 0.09);
  EXPECT_EQ(sphere.thickness, 0.001);
  EXPECT_EQ(sphere.friction, 0.5);
  expectNear(sphere.poseAt(1, head).position, {5, 0.1, 0});
  const Body capsule = bodyOf(scene.bodies[1], 1, up);
  EXPECT_EQ(capsule.name, "capsule 2");
  EXPECT_EQ(capsule.shape, BodyShape::capsule);
  EXPECT_EQ(capsule.length, 0.2);
  expectNear(capsule.poseAt(1, head).position, {0, 0, 0});
  const Body plane = bodyOf(scene.bodies[2], 2, up);
  EXPECT_EQ(plane.shape, BodyShape::plane);
  ASSERT_TRUE(plane.motion);
  EXPECT_EQ(plane.motion->axis, up);
  EXPECT_EQ(plane.motion->amplitude, 2);
  EXPECT_EQ(bodyOf(scene.bodies[3], 3, up).halfExtents, (Vec3d{1, 2, 3}));
  const Body mesh = bodyOf(scene.bodies[4], 4, up);
  EXPECT_EQ(mesh.shape, BodyShape::grid);
  expectNear(mesh.poseAt(1.5, head).position, {0.5, 0, 0});
}

// What a file may say of a body's size, the body takes; and no more.
TEST(SceneFile, SizesOfBodiesAreThoseABodyTakes) {
  const Vec3d up{0, 1, 0};
  for (const auto& [shape, key] : {std::pair{"sphere", "radius"},
                                   {"capsule", "radius"},
                                   {"capsule", "length"},
                                   {"box", "half_extents"}}) {
    const bool isBox = std::string(shape) == "box";
    for (const std::string size : {"1e-6", "1000"}) {
      const std::string value = isBox ? fmt::format("[{0}, {0}, {0}]", size) : size;
      const SceneFile scene =
          parsed(kGroom + fmt::format("[[body]]\nshape = '{}'\n{} = {}\n", shape, key, value));
      ASSERT_EQ(scene.bodies.size(), 1u);
      const Status status = checkBody(bodyOf(scene.bodies[0], 0, up));
      EXPECT_TRUE(status) << shape << " " << key << ": " << status.error().message;
    }
    const std::string value = isBox ? "[1, 1, 1000.1]" : "1000.1";
    EXPECT_NE(errorOf(kGroom + fmt::format("[[body]]\nshape = '{}'\n{} = {}\n", shape, key, value)), "")
        << shape << " " << key;
  }
}

TEST(SceneParts, SettingsAreTheStatedOnes) {
  const Settings settings = settingsOf(parsed(kKind + kEverythingElse));
  EXPECT_EQ(settings.framesPerSecond, 30);
  EXPECT_EQ(settings.stepsPerFrame, 5);
  EXPECT_EQ(settings.integrator, Integrator::pointJacobi);
  EXPECT_EQ(settings.gravity, (Vec3d{0, 0, -1.62}));
  EXPECT_EQ(settings.gravityPreload, 0.5);
  EXPECT_EQ(settings.teleportDistance, 0.25);
  EXPECT_EQ(settings.rootCount, 2);
  EXPECT_EQ(settings.pointIterations, 50);
  EXPECT_FALSE(settings.chebyshev);
  EXPECT_EQ(settings.contacts.iterations, 3);
  EXPECT_EQ(settings.air.fallSpeed, 3);
  EXPECT_EQ(settingsOf(parsed(std::string(kGroom) + "simulation.integrator = 'paper'")).gravityPreload, 0);
}

// Every built-in scene as a file says all that is stepped.
TEST(SceneParts, BuiltinScenesBecomeFiles) {
  for (const std::string& name : sceneNames()) {
    const auto scene = makeScene(name, {.particles = 16, .seconds = 0.5});
    ASSERT_TRUE(scene) << scene.error().message;
    const SceneFile file = parsed(sceneText(sceneFileOf(*scene, "hair.obj")));
    EXPECT_EQ(file.material.material, scene->material) << name;
    EXPECT_EQ(file.simulation.frames, scene->frameCount) << name;
    const Motion motion = motionOf(file.motion, {0, 1, 0});
    for (double t = -0.5; t < 4; t += 0.013) {
      const HeadPose found = motion.poseAt(t), expected = scene->motion.poseAt(t);
      EXPECT_EQ(found.position, expected.position) << name << " " << t;
      EXPECT_EQ(found.rotation, expected.rotation) << name << " " << t;
      EXPECT_EQ(found.shift, scene->rootShifts.empty() ? found.shift : expected.shift) << name << " " << t;
    }
    EXPECT_EQ(rootShiftsOf(file.motion.roots.shift, scene->groom.strandCount()), scene->rootShifts) << name;
  }
}

}  // namespace
}  // namespace ringlet::scene_file_test
