// c/ringlet_io.h: what C reads and writes is what C++ does.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "ringlet/base/whole_file.h"
#include "ringlet/c/ringlet_io.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/run/scene_run.h"
#include "tests/kernels/c_handles.h"
#include "tests/support/parity.h"
#include "tests/support/scene_path_cases.h"
#include "tests/support/test_support.h"

namespace ringlet::test::c_files_test {
namespace {

namespace fs = std::filesystem;

using CFiles = CTest;

std::string written(const fs::path& path, std::string_view text) {
  std::ofstream(path) << text;
  return path.string();
}

struct LoadedCGroom {
  ringlet_loaded_groom* handle = nullptr;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  ringlet_result read(const std::string& path, const ringlet_groom_reading* reading = nullptr) {
    const ringlet_result result = ringlet_groom_read(path.c_str(), reading, &handle);
    if (result == RINGLET_OK) {
      EXPECT_EQ(ringlet_loaded_groom_get(handle, &groom), RINGLET_OK);
    }
    return result;
  }
  std::vector<float> points(std::size_t count) const { return {groom.points, groom.points + 3 * count}; }
  ~LoadedCGroom() { ringlet_loaded_groom_release(handle); }
};

void keepWarning(const char* sentence, void* user) {
  static_cast<std::vector<std::string>*>(user)->push_back(sentence);
}

TEST(CFilesOnly, GroomsComeBackAsTheyWere) {
  const fs::path folder = scratchFolder("c_grooms");
  const Groom groom = randomGroom({12, 9, 2}, 3);
  const CGroom from(groom);
  for (const char* ending : {".hair", ".obj", ".ply"}) {
    const std::string path = (folder / (std::string("g") + ending)).string();
    ASSERT_EQ(ringlet_groom_write(path.c_str(), &from.groom), RINGLET_OK) << ringlet_error_message();
    LoadedCGroom read;
    ASSERT_EQ(read.read(path), RINGLET_OK) << ringlet_error_message();
    ASSERT_EQ(read.groom.strand_count, 3u) << ending;
    EXPECT_EQ(std::vector(read.groom.strand_sizes, read.groom.strand_sizes + 3), from.sizes) << ending;
    EXPECT_EQ(std::memcmp(read.groom.points, &groom.points[0].x, 23 * sizeof(Vec3f)), 0) << ending;
    EXPECT_EQ(read.groom.metres_per_unit, 0.01) << ending << " states none";
    ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
    reading.metres_per_unit = 0.5;
    LoadedCGroom again;
    ASSERT_EQ(again.read(path, &reading), RINGLET_OK);
    EXPECT_EQ(again.groom.metres_per_unit, 0.5);
  }
}

constexpr const char* kUsdGroom =
    "#usda 1.0\n(\n    metersPerUnit = 0.5\n    upAxis = \"Z\"\n)\n"
    "def BasisCurves \"hair\"\n{\n    int[] curveVertexCounts = [3]\n"
    "    point3f[] points = [(0, 0, 0), (1, 0, -1), (0, 2, -2)]\n    uniform token type = \"linear\"\n}\n";

TEST(CFilesOnly, AGroomsUnitAndAxisAreTheFilesOrTheHosts) {
  const fs::path folder = scratchFolder("c_usd_grooms");
  const std::string path = written(folder / "g.usda", kUsdGroom);
  LoadedCGroom upY;
  ASSERT_EQ(upY.read(path), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(upY.groom.metres_per_unit, 0.5);
  EXPECT_EQ(upY.points(3), (std::vector<float>{0, 0, 0, 1, -1, 0, 0, -2, -2}));
  ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
  reading.up_is_z = 1, reading.metres_per_unit = 0.02;
  LoadedCGroom upZ;
  ASSERT_EQ(upZ.read(path, &reading), RINGLET_OK);
  EXPECT_EQ(upZ.groom.metres_per_unit, 0.02);
  EXPECT_EQ(upZ.points(3), (std::vector<float>{0, 0, 0, 1, 0, -1, 0, 2, -2}));
}

// Points and nothing else, of strands that grow towards their first point.
TEST(CFilesOnly, AHostSaysWhatAGroomsFileDoesNot) {
  const fs::path folder = scratchFolder("c_groom_readings");
  const std::string path =
      written(folder / "g.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nend_header\n0 -3 0\n0 -1 0\n5 -3 0\n5 -1 0\n");
  ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
  LoadedCGroom none;
  EXPECT_EQ(none.read(path, &reading), RINGLET_ERROR) << "it holds no strands";
  EXPECT_NE(std::string(ringlet_error_message()).find("say how many: points_per_strand"), std::string::npos)
      << ringlet_error_message();
  reading.points_per_strand = 2;
  LoadedCGroom first;
  ASSERT_EQ(first.read(path, &reading), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(first.groom.strand_count, 2u);
  EXPECT_EQ(first.points(2), (std::vector<float>{0, -3, 0, 0, -1, 0}));
  reading.root_end = RINGLET_ROOT_LAST;
  LoadedCGroom last;
  ASSERT_EQ(last.read(path, &reading), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(last.points(2), (std::vector<float>{0, -1, 0, 0, -3, 0}));
  for (const std::uint32_t wrong : {1u, 1'000'001u, ~0u}) {
    reading.points_per_strand = wrong;
    expectInvalid(none.read(path, &reading), "points_per_strand");
  }
  reading.points_per_strand = 3;
  EXPECT_EQ(none.read(path, &reading), RINGLET_ERROR) << "4 points are no strands of 3";
  reading.points_per_strand = 2;
  for (const int wrong : {-1, 3, 1000}) {
    std::memcpy(&reading.root_end, &wrong, sizeof wrong);
    expectInvalid(none.read(path, &reading), "root_end");
  }
}

TEST(CFilesOnly, MaterialsAreThoseOfTheLibrary) {
  const fs::path folder = scratchFolder("c_materials");
  const std::string path = written(folder / "m.toml", "preset = 'coil'\n[dials]\nhold = 2\n");
  ringlet_material* material = nullptr;
  ASSERT_EQ(ringlet_material_read(path.c_str(), nullptr, nullptr, &material), RINGLET_OK)
      << ringlet_error_message();
  auto expected = loadMaterial(path);
  ASSERT_TRUE(expected);
  EXPECT_EQ(applyDials(expected->dials, expected->material), std::nullopt);
  EXPECT_EQ(materialText(material->material), materialText(expected->material));
  const std::string copy = (folder / "copy.toml").string();
  ASSERT_EQ(ringlet_material_write(copy.c_str(), material), RINGLET_OK) << ringlet_error_message();
  ringlet_material* again = nullptr;
  ASSERT_EQ(ringlet_material_read(copy.c_str(), nullptr, nullptr, &again), RINGLET_OK);
  EXPECT_EQ(materialText(again->material), materialText(material->material));
  ringlet_material_release(again), ringlet_material_release(material);

  ASSERT_EQ(ringlet_material_read("coil", nullptr, nullptr, &material), RINGLET_OK);
  ringlet_material_release(material);
  ASSERT_EQ(ringlet_material_read("coyl", nullptr, nullptr, &material), RINGLET_ERROR);
  EXPECT_NE(std::string(ringlet_error_message()).find("coil"), std::string::npos) << ringlet_error_message();
}

TEST_F(CFiles, AMeshIsTheSurfaceOfABody) {
  const fs::path folder = scratchFolder("c_meshes");
  const std::string path = written(folder / "m.obj",
                                   "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n"
                                   "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  ringlet_mesh* mesh = nullptr;
  ASSERT_EQ(ringlet_mesh_read(path.c_str(), 0.01, &mesh), RINGLET_OK) << ringlet_error_message();
  ringlet_body body = RINGLET_INIT(ringlet_body);
  const ringlet_number friction{"friction", {0.3}};
  body.numbers = &friction, body.number_count = 1, body.cells = 16;
  ASSERT_EQ(ringlet_mesh_get(mesh, &body), RINGLET_OK);
  EXPECT_STREQ(body.shape, "mesh");
  EXPECT_EQ(body.numbers, &friction) << "the rest stays";
  ASSERT_EQ(body.vertex_count, 4u);
  ASSERT_EQ(body.triangle_count, 4u);
  EXPECT_FLOAT_EQ(body.vertices[3], 0.1f);
  Handles c;
  open(c);
  const Groom groom = randomGroom({12, 9}, 3);
  const CGroom from(groom);
  ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
  options.features = RINGLET_BODIES;
  ASSERT_EQ(ringlet_asset_build(c.device, &from.groom, nullptr, nullptr, &options, &c.asset), RINGLET_OK);
  ASSERT_EQ(ringlet_hair_create(c.asset, nullptr, &c.hairs.emplace_back()), RINGLET_OK);
  EXPECT_EQ(ringlet_hair_set_bodies(c.hairs[0], &body, 1), RINGLET_OK) << ringlet_error_message();
  ringlet_mesh_release(mesh);
}

// All that a scene may have, in three frames and a pre-roll.
constexpr const char* kScene =
    "[groom]\ngenerate = 'swatch'\ncolumns = 2\nrows = 2\nparticles = 12\n"
    "[material]\npreset = 'coil'\n"
    "[motion]\nkind = 'shake'\npre_roll = 0.05\n"
    "[simulation]\nframes = 3\nfps = 30\nsteps_per_frame = 4\n"
    "[air]\non = true\nwind = [1, 0, 0]\n"
    "[[body]]\nshape = 'sphere'\nradius = 0.02\nposition = [0, -0.06, 0]\n"
    "[[field]]\nkind = 'point'\nstrength = 3\n"
    "[[hold]]\nbegin = 0.8\nend = 1\n"
    "[[cut]]\nstrands = '0'\nat = 0.6\ntime = 0.04\n"
    "[[key]]\ntime = 0\nair.wind = [1, 0, 0]\n[[key]]\ntime = 0.1\nair.wind = [5, 0, 0]\n";

struct CScene {
  ringlet_scene* handle = nullptr;
  ringlet_scene_facts facts = RINGLET_INIT(ringlet_scene_facts);
  ringlet_result parse(const char* text) {
    const ringlet_result result = ringlet_scene_parse(text, nullptr, nullptr, &handle);
    if (result == RINGLET_OK) {
      EXPECT_EQ(ringlet_scene_get(handle, &facts), RINGLET_OK);
    }
    return result;
  }
  ~CScene() { ringlet_scene_release(handle); }
};

TEST_F(CFiles, AScenesHairHasTheBitsOfTheLibrary) {
  CScene scene;
  ASSERT_EQ(scene.parse(kScene), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(scene.facts.frames_per_second, 30);
  EXPECT_EQ(scene.facts.frame_count, 3);
  EXPECT_EQ(scene.facts.pre_roll_frames, 2);
  EXPECT_EQ(scene.facts.steps_per_frame, 4u);
  EXPECT_EQ(scene.facts.body_count, 1u);
  EXPECT_EQ(scene.facts.strand_count, 4u);
  EXPECT_EQ(scene.facts.moving_roots, 0);

  const LoadedScene expected = *loadScene(*parseScene(kScene, "scene"));
  const auto asset = buildAsset(device(), expected);
  ASSERT_TRUE(asset) << asset.error().message;
  const SceneFrames frames(expected);
  const ScenePlaces start = frames.placesAt(frames.first());
  auto hair = Simulation::create(*asset, stateOf(start, expected));
  ASSERT_TRUE(hair) << hair.error().message;
  for (int frame = -2; frame < 0; ++frame) ASSERT_TRUE(stepScene(frames, *hair, frame));

  Handles c;
  open(c);
  ASSERT_EQ(ringlet_scene_build(c.device, scene.handle, nullptr, &c.asset), RINGLET_OK)
      << ringlet_error_message();
  ASSERT_EQ(ringlet_scene_hair(scene.handle, c.asset, &c.hairs.emplace_back()), RINGLET_OK)
      << ringlet_error_message();
  const std::size_t count = ringlet_asset_particle_count(c.asset);
  EXPECT_EQ(positionsOf(c.hairs[0], count), *hair->positions()) << "as the run begins";
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_EQ(ringlet_scene_step(scene.handle, c.hairs[0], frame), RINGLET_OK) << ringlet_error_message();
    ASSERT_TRUE(stepScene(frames, *hair, frame));
    EXPECT_EQ(positionsOf(c.hairs[0], count), *hair->positions()) << frame;
  }
}

TEST_F(CFiles, ARunIsEndedGoesOnAndHasTheFilesOfOneThatIsNot) {
  const fs::path folder = scratchFolder("c_runs");
  CScene scene;
  ASSERT_EQ(scene.parse(kScene), RINGLET_OK) << ringlet_error_message();
  const auto run = [&](const char* name, ringlet_leftovers leftovers, int least, ringlet_run_result& result) {
    const std::string out = (folder / name).string();
    const char* files[] = {"hair.usda", "hair.rgc", "last.obj"};
    ringlet_run_options options = RINGLET_INIT(ringlet_run_options);
    options.frame_count = 8;
    options.folder = out.c_str();
    options.files = files, options.file_count = 3;
    options.checkpoint_frames = 2;
    options.leftovers = leftovers;
    options.go_on = [](std::int32_t frame, void* user) { return int(frame < *static_cast<int*>(user)); };
    options.user = &least;
    result = RINGLET_INIT(ringlet_run_result);
    return ringlet_scene_run(scene.handle, &options, &result, nullptr, 0);
  };
  ringlet_run_result whole{}, part{}, rest{};
  ASSERT_EQ(run("whole", RINGLET_LEFTOVERS_REFUSE, 100, whole), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(whole.frame_count, 8);
  EXPECT_EQ(whole.interrupted, 0);
  ASSERT_EQ(run("part", RINGLET_LEFTOVERS_REFUSE, 4, part), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(part.frame_count, 5);  // the one under way is finished
  EXPECT_EQ(part.interrupted, 1);
  EXPECT_EQ(part.can_resume, 1);
  EXPECT_NE(run("part", RINGLET_LEFTOVERS_REFUSE, 100, rest), RINGLET_OK);
  EXPECT_NE(std::strstr(ringlet_error_message(), "RINGLET_LEFTOVERS_RESUME goes on with it"), nullptr)
      << ringlet_error_message();
  ASSERT_EQ(run("part", RINGLET_LEFTOVERS_RESUME, 100, rest), RINGLET_OK) << ringlet_error_message();
  EXPECT_EQ(rest.resumed_from, 5);
  EXPECT_STREQ(rest.positions_hash, whole.positions_hash);
  for (const char* name : {"hair.usda", "hair.rgc", "last.obj"})
    EXPECT_EQ(readText(folder / "part" / name), readText(folder / "whole" / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "part/checkpoint.rgk"));
}

TEST_F(CFiles, AScenesPartsAreForHostsThatStepThemselves) {
  const std::string plain = std::string(kScene).substr(0, std::string(kScene).find("[[field]]"));
  CScene scene;
  ASSERT_EQ(scene.parse(plain.c_str()), RINGLET_OK) << ringlet_error_message();
  Handles c;
  open(c);
  ringlet_settings_release(std::exchange(c.settings, nullptr));
  ringlet_material_release(std::exchange(c.material, nullptr));
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  ASSERT_EQ(ringlet_scene_groom(scene.handle, &groom), RINGLET_OK);
  ASSERT_EQ(ringlet_scene_settings(scene.handle, &c.settings), RINGLET_OK);
  ASSERT_EQ(ringlet_scene_material(scene.handle, &c.material), RINGLET_OK);
  const LoadedScene expected = *loadScene(*parseScene(plain, "scene"));
  EXPECT_EQ(materialText(c.material->material), materialText(expected.material));
  EXPECT_EQ(c.settings->settings.stepsPerFrame, 4);
  EXPECT_EQ(std::memcmp(groom.points, &expected.groom.points[0].x, 48 * sizeof(Vec3f)), 0);

  // Bodies go with the head of a scene whose bodies have no motion of their own.
  ringlet_pose heads[4], bodies[4];
  ASSERT_EQ(ringlet_scene_frame_poses(scene.handle, 1, heads, bodies, nullptr), RINGLET_OK);
  const SceneFrame poses = *SceneFrames(expected).at(1);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(heads[k].position[0], poses.heads[k].position.x) << k;
  ASSERT_EQ(poses.bodies.empty(), false);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(bodies[k].position[1], poses.bodies[k].position.y) << k;
}

TEST(CFilesOnly, ASceneIsChangedAndConfinedAsItIsRead) {
  const fs::path around = scratchFolder("c_scenes"), folder = around / "scene";
  fs::create_directories(folder);
  written(around / "out.obj", "v 0 0 0\nv 0 -1 0\nl 1 2\n");
  fs::copy_file(around / "out.obj", folder / "in.obj");
  const std::string inside = written(folder / "in.toml", "[groom]\nfile = 'in.obj'\n");
  const std::string outside = written(folder / "out.toml", "[groom]\nfile = '../out.obj'\n");
  for (const int isConfined : {0, 1}) {
    ringlet_scene_reading reading = RINGLET_INIT(ringlet_scene_reading);
    reading.is_confined = isConfined;
    for (const std::string& path : {inside, outside}) {
      ringlet_scene* scene = nullptr;
      const ringlet_result result = ringlet_scene_read(path.c_str(), &reading, &scene);
      EXPECT_EQ(result, isConfined && path == outside ? RINGLET_ERROR : RINGLET_OK) << path << isConfined;
      if (result != RINGLET_OK) {
        EXPECT_NE(std::string(ringlet_error_message()).find("groom.file"), std::string::npos)
            << ringlet_error_message();
      }
      ringlet_scene_release(std::exchange(scene, nullptr));
      const std::string text =
          "[groom]\nfile = '" + std::string(path == outside ? "../out" : "in") + ".obj'\n";
      EXPECT_EQ(ringlet_scene_parse(text.c_str(), folder.string().c_str(), &reading, &scene), result) << path;
      ringlet_scene_release(scene);
    }
  }
  const char* changes[] = {"simulation.frames=7", "groom.up=Z"};
  ringlet_scene_reading reading = RINGLET_INIT(ringlet_scene_reading);
  reading.changes = changes, reading.change_count = 2;
  ringlet_scene* scene = nullptr;
  ASSERT_EQ(ringlet_scene_read(inside.c_str(), &reading, &scene), RINGLET_OK) << ringlet_error_message();
  ringlet_scene_facts facts = RINGLET_INIT(ringlet_scene_facts);
  ASSERT_EQ(ringlet_scene_get(scene, &facts), RINGLET_OK);
  EXPECT_EQ(facts.frame_count, 7);
  ringlet_scene_release(scene);
}

// Every key that is a path, in a file and in text; what lies inside may be wrong, but is not refused for its
// place.
TEST(CFilesOnly, AConfinedSceneNamesNothingOutsideItsFolder) {
  const fs::path around = scratchFolder("c_confined"), folder = around / "scene";
  fs::create_directories(folder / "below");
  const std::string material = written(around / "m.toml", "line_density = 1e-5\n");
  fs::copy_file(around / "m.toml", folder / "below/m.toml");
  fs::create_symlink("../m.toml", folder / "link.toml");
  const auto messageOf = [&](const std::string& text, bool isConfined, bool isFile) {
    ringlet_scene_reading reading = RINGLET_INIT(ringlet_scene_reading);
    reading.is_confined = isConfined;
    ringlet_scene* scene = nullptr;
    const ringlet_result result =
        isFile ? ringlet_scene_read(written(folder / "scene.toml", text).c_str(), &reading, &scene)
               : ringlet_scene_parse(text.c_str(), folder.c_str(), &reading, &scene);
    ringlet_scene_release(scene);
    return result == RINGLET_OK ? std::string() : std::string(ringlet_error_message());
  };
  for (const PathCase& c : pathCases()) {
    for (const bool isFile : {true, false}) {
      SCOPED_TRACE(c.key + (isFile ? " in a file" : " in text"));
      for (const std::string& outside : {std::string("../m.toml"), material,
                                         std::string("below/../../m.toml"), std::string("link.toml")}) {
        const std::string refused = messageOf(withPath(c, outside), true, isFile);
        EXPECT_NE(refused.find(c.key), std::string::npos) << outside << ": " << refused;
        EXPECT_NE(refused.find("it is confined"), std::string::npos) << outside << ": " << refused;
        EXPECT_EQ(messageOf(withPath(c, outside), false, isFile).find("it is confined"), std::string::npos);
      }
      EXPECT_EQ(messageOf(withPath(c, "below/m.toml"), true, isFile).find("it is confined"),
                std::string::npos);
    }
  }
}

void expectThreeFrames(const fs::path& file, const Groom& topology) {
  ringlet_frames* frames = nullptr;
  ASSERT_EQ(ringlet_frames_open(file.c_str(), nullptr, nullptr, &frames), RINGLET_OK)
      << ringlet_error_message();
  ringlet_frames_facts facts = RINGLET_INIT(ringlet_frames_facts);
  ASSERT_EQ(ringlet_frames_get(frames, &facts), RINGLET_OK);
  EXPECT_EQ(facts.frames_per_second, 30);
  EXPECT_EQ(facts.metres_per_unit, topology.metresPerUnit);
  EXPECT_EQ(facts.frame_count, 3u);
  EXPECT_EQ(facts.strand_count, 4u);
  EXPECT_EQ(facts.is_finished, 1);
  ASSERT_EQ(facts.particle_count, topology.points.size());
  std::vector<Vec3f> points(facts.particle_count);
  for (int frame = 0; frame < 3; ++frame)
    ASSERT_EQ(ringlet_frames_next(frames, &points[0].x, points.size()), RINGLET_OK)
        << ringlet_error_message();
  EXPECT_NE(points[0], points[1]);
  expectInvalid(ringlet_frames_next(frames, &points[0].x, points.size()), "3 frames");
  ringlet_frames_release(frames);
}

// The file of C++'s writer, byte by byte, whether positions or hair are added; and its frames are read.
TEST_F(CFiles, AnimationsAreThoseOfTheLibrary) {
  const fs::path folder = scratchFolder("c_animations");
  CScene scene;
  ASSERT_EQ(scene.parse(kScene), RINGLET_OK) << ringlet_error_message();
  Handles c;
  open(c);
  ASSERT_EQ(ringlet_scene_build(c.device, scene.handle, nullptr, &c.asset), RINGLET_OK);
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  ASSERT_EQ(ringlet_scene_groom(scene.handle, &groom), RINGLET_OK);
  const Groom topology = loadScene(*parseScene(kScene, "scene"))->groom;
  for (const AnimationFormat& format : animationFormats()) {
    SCOPED_TRACE(format.extension);
    ringlet_hair* hair = nullptr;
    ASSERT_EQ(ringlet_scene_hair(scene.handle, c.asset, &hair), RINGLET_OK) << ringlet_error_message();
    ringlet_animation_options options = RINGLET_INIT(ringlet_animation_options);
    options.frames_per_second = 30, options.frame_count = 3, options.width = 0.001;
    const auto fileOf = [&](const char* name) { return folder / (std::string(name) + format.extension); };
    ringlet_animation *byHair = nullptr, *byPositions = nullptr;
    ASSERT_EQ(ringlet_animation_create(fileOf("hair").c_str(), &groom, &options, &byHair), RINGLET_OK)
        << ringlet_error_message();
    ASSERT_EQ(ringlet_animation_create(fileOf("positions").c_str(), &groom, &options, &byPositions),
              RINGLET_OK);
    const double unit = topology.metresPerUnit;
    auto writer = format.resume(fileOf("expected"), topology,
                                {.framesPerSecond = 30,
                                 .metresPerUnit = unit,
                                 .diameter = static_cast<float>(0.001 / unit),
                                 .frameCount = 3},
                                0);
    ASSERT_TRUE(writer) << writer.error().message;
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_EQ(ringlet_scene_step(scene.handle, hair, frame), RINGLET_OK) << ringlet_error_message();
      ASSERT_EQ(ringlet_animation_add_hair(byHair, hair), RINGLET_OK) << ringlet_error_message();
      const HeadPose head = hair->simulation.head();
      std::vector<Vec3f> points = positionsOf(hair, topology.points.size());
      const ringlet_pose pose = poseOf(head);
      ASSERT_EQ(ringlet_animation_add(byPositions, &points[0].x, points.size(), &pose), RINGLET_OK);
      for (Vec3f& p : points) p = static_cast<Vec3f>((head.position + Vec3d(p)) / unit);
      ASSERT_TRUE((*writer)->addFrame(points, rigidTransform(head.rotation, head.position / unit)));
    }
    ringlet_hair_release(hair);
    EXPECT_FALSE(fs::exists(fileOf("hair"))) << "before it is finished";
    ASSERT_EQ(ringlet_animation_finish(byHair), RINGLET_OK) << ringlet_error_message();
    ASSERT_EQ(ringlet_animation_finish(byPositions), RINGLET_OK);
    ASSERT_TRUE((*writer)->finish());
    ringlet_animation_release(byHair), ringlet_animation_release(byPositions);
    const auto expected = readWholeFile(fileOf("expected"));
    ASSERT_TRUE(expected);
    for (const char* name : {"hair", "positions"}) {
      const auto file = readWholeFile(fileOf(name));
      ASSERT_TRUE(file) << name;
      EXPECT_TRUE(*file == *expected) << name;
    }
    if (format.isRead) expectThreeFrames(fileOf("hair"), topology);
  }
}

TEST(CFilesOnly, WarningsAreSaid) {
  const fs::path folder = scratchFolder("c_warnings");
  std::vector<std::string> warnings;
  // A strand of one point is left out of a groom, and a torn end out of an animation.
  const std::string groom = written(folder / "g.obj", "v 0 0 0\nv 0 -1 0\nv 1 0 0\nl 1 2\nl 3\n");
  ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
  reading.warn = keepWarning, reading.user = &warnings;
  LoadedCGroom read;
  ASSERT_EQ(read.read(groom, &reading), RINGLET_OK) << ringlet_error_message();
  ASSERT_EQ(warnings.size(), 1u);
  warnings.clear();
  // A groom that lies on its side where Y is up, and hangs where Z is: it seems wrong.
  const std::string lying =
      written(folder / "l.obj", "v 0 0 0\nv 0 0 -20\nv 1 0 0\nv 1 0 -20\nl 1 2\nl 3 4\n");
  for (const int upIsZ : {0, 1}) {
    reading.up_is_z = upIsZ;
    LoadedCGroom side;
    ASSERT_EQ(side.read(lying, &reading), RINGLET_OK) << ringlet_error_message();
    ASSERT_EQ(warnings.size(), upIsZ ? 0u : 1u);
    if (!upIsZ) {
      EXPECT_NE(warnings[0].find("hang along -Z"), std::string::npos) << warnings[0];
      EXPECT_NE(warnings[0].find("takes up_is_z = 1"), std::string::npos) << warnings[0];
      EXPECT_EQ(warnings[0].find("--"), std::string::npos) << warnings[0];
    }
    warnings.clear();
  }
  ringlet_scene_reading sceneReading = RINGLET_INIT(ringlet_scene_reading);
  sceneReading.warn = keepWarning, sceneReading.user = &warnings;
  ringlet_scene* scene = nullptr;
  ASSERT_EQ(ringlet_scene_parse("[groom]\nfile = 'g.obj'\n", folder.c_str(), &sceneReading, &scene),
            RINGLET_OK)
      << ringlet_error_message();
  EXPECT_FALSE(warnings.empty());
  ringlet_scene_release(scene);
}

}  // namespace
}  // namespace ringlet::test::c_files_test
