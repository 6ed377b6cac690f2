// Wrong calls of c/ringlet_io.h: every function with every set of NULLs, numbers that nothing has, files that
// are none, calls in a wrong order, in a wrong process. Each is answered, and the host lives on.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <string>

#include "ringlet/base/whole_file.h"
#include "ringlet/c/ringlet_io.h"
#include "tests/kernels/c_handles.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"

namespace ringlet::test::c_wrong_files_test {
namespace {

namespace fs = std::filesystem;

using CWrongFiles = CTest;

constexpr const char* kScene =
    "[groom]\ngenerate = 'swatch'\ncolumns = 2\nrows = 1\nparticles = 8\n"
    "[simulation]\nframes = 2\nsteps_per_frame = 4\n"
    "[[body]]\nshape = 'sphere'\nradius = 0.02\nposition = [0, -0.5, 0]\n";
constexpr std::uint32_t kParticles = 16;

// Of every handle a good one, and files to read.
struct Good : Handles {
  fs::path folder = scratchFolder("c_wrong_files");
  std::string hair = (folder / "g.hair").string(), mesh = (folder / "m.obj").string(),
              frames = (folder / "a.rgc").string(), scene = (folder / "s.toml").string();
  ringlet_scene* loaded = nullptr;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  std::vector<float> xyz = std::vector<float>(3 * kParticles, 0.25f);
  ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
  ringlet_scene_reading sceneReading = RINGLET_INIT(ringlet_scene_reading);
  ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
  ringlet_animation_options animationOptions = RINGLET_INIT(ringlet_animation_options);
  ringlet_pose head{}, poses[8]{};

  void make() {
    std::ofstream(mesh) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(scene) << kScene;
    ASSERT_EQ(ringlet_scene_parse(kScene, nullptr, nullptr, &loaded), RINGLET_OK) << ringlet_error_message();
    ASSERT_EQ(ringlet_scene_groom(loaded, &groom), RINGLET_OK);
    ASSERT_EQ(ringlet_groom_write(hair.c_str(), &groom), RINGLET_OK) << ringlet_error_message();
    ringlet_animation* animation = begun(frames.c_str());
    ASSERT_EQ(ringlet_animation_add(animation, xyz.data(), kParticles, nullptr), RINGLET_OK);
    ASSERT_EQ(ringlet_animation_finish(animation), RINGLET_OK) << ringlet_error_message();
    ringlet_animation_release(animation);
  }
  void start() {
    ASSERT_EQ(ringlet_scene_build(device, loaded, nullptr, &asset), RINGLET_OK) << ringlet_error_message();
    ASSERT_EQ(ringlet_scene_hair(loaded, asset, &hairs.emplace_back()), RINGLET_OK)
        << ringlet_error_message();
  }
  ringlet_animation* begun(const char* path) {
    ringlet_animation* animation = nullptr;
    EXPECT_EQ(ringlet_animation_create(path, &groom, nullptr, &animation), RINGLET_OK)
        << ringlet_error_message();
    return animation;
  }
  // A scene with a body that bends, of four points.
  ringlet_scene* bending() {
    for (const char* frame : {"b.1.obj", "b.2.obj"})
      std::ofstream(folder / frame)
          << "v 0 -1 0\nv 1 -1 0\nv 0 -1 -1\nv 0 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const std::string text =
        kScene +
        std::string("[[body]]\nshape = 'mesh'\nfile = 'b.#.obj'\nunit = 1\ncells = 8\ndeforms = true\n");
    ringlet_scene* made = nullptr;
    EXPECT_EQ(ringlet_scene_parse(text.c_str(), folder.c_str(), nullptr, &made), RINGLET_OK)
        << ringlet_error_message();
    return made;
  }
  ringlet_frames* opened() {
    ringlet_frames* made = nullptr;
    EXPECT_EQ(ringlet_frames_open(frames.c_str(), nullptr, nullptr, &made), RINGLET_OK);
    return made;
  }
  ~Good() { ringlet_scene_release(loaded); }
};

// A call of which each pointer may be NULL: bit k of `nulls` says that pointer k is.
struct Call {
  const char* function;
  std::vector<const char*> pointers;  // by name; in brackets those that may be NULL
  std::function<ringlet_result(unsigned nulls)> run;
};

template <class T>
T* orNull(T* pointer, unsigned nulls, int bit) {
  return nulls & (1u << bit) ? nullptr : pointer;
}

// What a call said; what it made is released.
template <class Handle>
ringlet_result released(Handle* handle, void (*release)(Handle*), ringlet_result result) {
  release(handle);
  return result;
}

std::vector<Call> readingCalls(Good& c) {
  return {
      {"ringlet_groom_read",
       {"path", "[reading]", "groom"},
       [&c](unsigned n) {
         ringlet_loaded_groom* groom = nullptr;
         const auto result =
             ringlet_groom_read(orNull(c.hair.c_str(), n, 0), orNull(&c.reading, n, 1), orNull(&groom, n, 2));
         return released(groom, ringlet_loaded_groom_release, result);
       }},
      {"ringlet_loaded_groom_get",
       {"from", "groom"},
       [&c](unsigned n) {
         ringlet_loaded_groom* from = nullptr;
         EXPECT_EQ(ringlet_groom_read(c.hair.c_str(), nullptr, &from), RINGLET_OK);
         ringlet_groom groom = RINGLET_INIT(ringlet_groom);
         const auto result = ringlet_loaded_groom_get(orNull(from, n, 0), orNull(&groom, n, 1));
         return released(from, ringlet_loaded_groom_release, result);
       }},
      {"ringlet_groom_write",
       {"path", "groom"},
       [&c](unsigned n) {
         return ringlet_groom_write(orNull(c.hair.c_str(), n, 0), orNull(&c.groom, n, 1));
       }},
      {"ringlet_material_read",
       {"preset_or_path", "[user]", "material"},
       [&c](unsigned n) {
         ringlet_material* material = nullptr;
         const auto result = ringlet_material_read(orNull("coil", n, 0), nullptr, orNull(&c.head, n, 1),
                                                   orNull(&material, n, 2));
         return released(material, ringlet_material_release, result);
       }},
      {"ringlet_material_write",
       {"path", "material"},
       [&c](unsigned n) {
         const std::string path = (c.folder / "w.toml").string();
         return ringlet_material_write(orNull(path.c_str(), n, 0), orNull(c.material, n, 1));
       }},
      {"ringlet_mesh_read",
       {"path", "mesh"},
       [&c](unsigned n) {
         ringlet_mesh* mesh = nullptr;
         const auto result = ringlet_mesh_read(orNull(c.mesh.c_str(), n, 0), 0.01, orNull(&mesh, n, 1));
         return released(mesh, ringlet_mesh_release, result);
       }},
      {"ringlet_mesh_get",
       {"from", "body"},
       [&c](unsigned n) {
         ringlet_mesh* mesh = nullptr;
         EXPECT_EQ(ringlet_mesh_read(c.mesh.c_str(), 0.01, &mesh), RINGLET_OK);
         ringlet_body body = RINGLET_INIT(ringlet_body);
         const auto result = ringlet_mesh_get(orNull(mesh, n, 0), orNull(&body, n, 1));
         return released(mesh, ringlet_mesh_release, result);
       }},
  };
}

std::vector<Call> sceneCalls(Good& c) {
  return {
      {"ringlet_scene_read",
       {"path", "[reading]", "scene"},
       [&c](unsigned n) {
         ringlet_scene* scene = nullptr;
         const auto result = ringlet_scene_read(orNull(c.scene.c_str(), n, 0), orNull(&c.sceneReading, n, 1),
                                                orNull(&scene, n, 2));
         return released(scene, ringlet_scene_release, result);
       }},
      {"ringlet_scene_parse",
       {"text", "[folder]", "[reading]", "scene"},
       [&c](unsigned n) {
         ringlet_scene* scene = nullptr;
         const auto result = ringlet_scene_parse(orNull(kScene, n, 0), orNull(".", n, 1),
                                                 orNull(&c.sceneReading, n, 2), orNull(&scene, n, 3));
         return released(scene, ringlet_scene_release, result);
       }},
      {"ringlet_scene_get",
       {"scene", "facts"},
       [&c](unsigned n) {
         ringlet_scene_facts facts = RINGLET_INIT(ringlet_scene_facts);
         return ringlet_scene_get(orNull(c.loaded, n, 0), orNull(&facts, n, 1));
       }},
      {"ringlet_scene_groom",
       {"scene", "groom"},
       [&c](unsigned n) { return ringlet_scene_groom(orNull(c.loaded, n, 0), orNull(&c.groom, n, 1)); }},
      {"ringlet_scene_settings",
       {"scene", "settings"},
       [&c](unsigned n) {
         ringlet_settings* settings = nullptr;
         const auto result = ringlet_scene_settings(orNull(c.loaded, n, 0), orNull(&settings, n, 1));
         return released(settings, ringlet_settings_release, result);
       }},
      {"ringlet_scene_material",
       {"scene", "material"},
       [&c](unsigned n) {
         ringlet_material* material = nullptr;
         const auto result = ringlet_scene_material(orNull(c.loaded, n, 0), orNull(&material, n, 1));
         return released(material, ringlet_material_release, result);
       }},
      {"ringlet_scene_frame_poses",
       {"scene", "step_poses", "[body_poses]", "[root_poses]"},
       [&c](unsigned n) {
         return ringlet_scene_frame_poses(orNull(c.loaded, n, 0), 0, orNull(c.poses, n, 1),
                                          orNull(c.poses + 4, n, 2), orNull(c.poses, n, 3));
       }},
      {"ringlet_scene_frame_points",
       {"scene", "[xyz]", "vertex_count"},
       [&c](unsigned n) {
         ringlet_scene* scene = c.bending();
         double xyz[4 * 4 * 3];
         std::uint32_t count = 0;
         const auto result =
             ringlet_scene_frame_points(orNull(scene, n, 0), 0, 0, orNull(xyz, n, 1), orNull(&count, n, 2));
         return released(scene, ringlet_scene_release, result);
       }},
  };
}

std::vector<Call> sceneHairCalls(Good& c) {
  return {
      {"ringlet_scene_build",
       {"device", "scene", "[options]", "asset"},
       [&c](unsigned n) {
         ringlet_asset* asset = nullptr;
         const auto result = ringlet_scene_build(orNull(c.device, n, 0), orNull(c.loaded, n, 1),
                                                 orNull(&c.options, n, 2), orNull(&asset, n, 3));
         return released(asset, ringlet_asset_release, result);
       }},
      {"ringlet_scene_hair",
       {"scene", "asset", "hair"},
       [&c](unsigned n) {
         ringlet_hair* hair = nullptr;
         const auto result =
             ringlet_scene_hair(orNull(c.loaded, n, 0), orNull(c.asset, n, 1), orNull(&hair, n, 2));
         return released(hair, ringlet_hair_release, result);
       }},
      {"ringlet_scene_step",
       {"scene", "hair"},
       [&c](unsigned n) { return ringlet_scene_step(orNull(c.loaded, n, 0), orNull(c.hairs[0], n, 1), 0); }},
      {"ringlet_scene_run",
       {"scene", "[options]", "[result]", "[xyz]"},
       [&c](unsigned n) {
         ringlet_run_options run = RINGLET_INIT(ringlet_run_options);
         run.frame_count = 1;
         std::vector<float> xyz(3 * kParticles);
         ringlet_run_result result = RINGLET_INIT(ringlet_run_result);
         return ringlet_scene_run(orNull(c.loaded, n, 0), orNull(&run, n, 1), orNull(&result, n, 2),
                                  orNull(xyz.data(), n, 3), kParticles);
       }},
  };
}

std::vector<Call> animationCalls(Good& c) {
  return {
      {"ringlet_animation_create",
       {"path", "groom", "[options]", "animation"},
       [&c](unsigned n) {
         const std::string path = (c.folder / "made.usda").string();
         ringlet_animation* animation = nullptr;
         const auto result =
             ringlet_animation_create(orNull(path.c_str(), n, 0), orNull(&c.groom, n, 1),
                                      orNull(&c.animationOptions, n, 2), orNull(&animation, n, 3));
         return released(animation, ringlet_animation_release, result);
       }},
      {"ringlet_animation_add",
       {"animation", "xyz", "[head]"},
       [&c](unsigned n) {
         ringlet_animation* animation = c.begun((c.folder / "added.usda").c_str());
         const auto result = ringlet_animation_add(orNull(animation, n, 0), orNull(c.xyz.data(), n, 1),
                                                   kParticles, orNull(&c.head, n, 2));
         return released(animation, ringlet_animation_release, result);
       }},
      {"ringlet_animation_add_hair",
       {"animation", "hair"},
       [&c](unsigned n) {
         ringlet_animation* animation = c.begun((c.folder / "added.usda").c_str());
         const auto result = ringlet_animation_add_hair(orNull(animation, n, 0), orNull(c.hairs[0], n, 1));
         return released(animation, ringlet_animation_release, result);
       }},
      {"ringlet_animation_finish",
       {"animation"},
       [&c](unsigned n) {
         ringlet_animation* animation = c.begun((c.folder / "finished.usda").c_str());
         EXPECT_EQ(ringlet_animation_add(animation, c.xyz.data(), kParticles, nullptr), RINGLET_OK);
         const auto result = ringlet_animation_finish(orNull(animation, n, 0));
         return released(animation, ringlet_animation_release, result);
       }},
  };
}

std::vector<Call> framesCalls(Good& c) {
  return {
      {"ringlet_frames_open",
       {"path", "[user]", "frames"},
       [&c](unsigned n) {
         ringlet_frames* frames = nullptr;
         const auto result = ringlet_frames_open(orNull(c.frames.c_str(), n, 0), nullptr,
                                                 orNull(&c.head, n, 1), orNull(&frames, n, 2));
         return released(frames, ringlet_frames_release, result);
       }},
      {"ringlet_frames_get",
       {"frames", "facts"},
       [&c](unsigned n) {
         ringlet_frames* frames = c.opened();
         ringlet_frames_facts facts = RINGLET_INIT(ringlet_frames_facts);
         const auto result = ringlet_frames_get(orNull(frames, n, 0), orNull(&facts, n, 1));
         return released(frames, ringlet_frames_release, result);
       }},
      {"ringlet_frames_next",
       {"frames", "xyz"},
       [&c](unsigned n) {
         ringlet_frames* frames = c.opened();
         float room[3 * kParticles];
         const auto result = ringlet_frames_next(orNull(frames, n, 0), orNull(room, n, 1), kParticles);
         return released(frames, ringlet_frames_release, result);
       }},
  };
}

std::vector<Call> callsOf(Good& c) {
  std::vector<Call> all;
  for (const auto& calls : {readingCalls, sceneCalls, sceneHairCalls, animationCalls, framesCalls})
    for (Call& call : calls(c)) all.push_back(std::move(call));
  return all;
}

TEST(CWrongFilesList, HasEveryFunctionOfTheHeader) {
  const auto file = readWholeFile(fs::path(RINGLET_SOURCE_DIR) / "src/ringlet/c/ringlet_io.h");
  ASSERT_TRUE(file);
  const std::string text(reinterpret_cast<const char*>(file->data()), file->size());
  const std::regex declaration(R"((?:ringlet_result|void) (ringlet_\w+)\()");
  std::set<std::string> inHeader, inList;
  for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
    const std::string name = (*at)[1];
    if (!name.ends_with("_release")) inHeader.insert(name);
  }
  Good none;
  for (const Call& call : callsOf(none)) inList.insert(call.function);
  EXPECT_EQ(inHeader, inList);
}

TEST_F(CWrongFiles, PointersThatAreNull) {
  Good c;
  open(c);
  c.make();
  c.start();
  for (const Call& call : callsOf(c)) {
    for (unsigned nulls = 0; nulls < 1u << call.pointers.size(); ++nulls) {
      const char* missing = nullptr;  // the first that must not be
      for (std::size_t k = 0; k < call.pointers.size() && !missing; ++k)
        if (nulls & (1u << k) && call.pointers[k][0] != '[') missing = call.pointers[k];
      const ringlet_result result = call.run(nulls);
      if (!missing) {
        EXPECT_EQ(result, RINGLET_OK) << call.function << " " << nulls << ": " << ringlet_error_message();
        continue;
      }
      const std::string message = ringlet_error_message();
      EXPECT_EQ(result, RINGLET_ERROR_INVALID_ARGUMENT) << call.function << " " << nulls;
      EXPECT_NE(message.find(std::string(missing) + " is NULL"), std::string::npos) << message;
      EXPECT_NE(message.find(call.function), std::string::npos) << message;
    }
  }
  ringlet_loaded_groom_release(nullptr), ringlet_mesh_release(nullptr), ringlet_scene_release(nullptr);
  ringlet_animation_release(nullptr), ringlet_frames_release(nullptr);
}

// Structs without their size are refused, and of those that are filled nothing is written beyond it.
TEST_F(CWrongFiles, StructsOfOtherSizes) {
  Good c;
  open(c);
  c.make();
  c.start();
  const auto each = [&](auto init, const char* what, auto call) {
    using Struct = decltype(init);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, sizeof(std::size_t) - 1}) {
      struct {
        Struct value;
        std::uint64_t guard = 0x5a5a5a5a5a5a5a5a;
      } room{init};
      room.value.struct_size = size;
      EXPECT_EQ(call(&room.value), RINGLET_ERROR_INVALID_ARGUMENT) << what << " of " << size;
      EXPECT_NE(std::string(ringlet_error_message()).find("RINGLET_INIT"), std::string::npos) << what;
      EXPECT_EQ(room.guard, 0x5a5a5a5a5a5a5a5a) << what;
    }
  };
  each(RINGLET_INIT(ringlet_groom_reading), "groom_reading", [&](auto* s) {
    ringlet_loaded_groom* none = nullptr;
    return ringlet_groom_read(c.hair.c_str(), s, &none);
  });
  each(RINGLET_INIT(ringlet_scene_reading), "scene_reading", [&](auto* s) {
    ringlet_scene* none = nullptr;
    return ringlet_scene_read(c.scene.c_str(), s, &none);
  });
  each(RINGLET_INIT(ringlet_scene_facts), "scene_facts",
       [&](auto* s) { return ringlet_scene_get(c.loaded, s); });
  each(RINGLET_INIT(ringlet_run_options), "run_options",
       [&](auto* s) { return ringlet_scene_run(c.loaded, s, nullptr, nullptr, 0); });
  each(RINGLET_INIT(ringlet_run_result), "run_result",
       [&](auto* s) { return ringlet_scene_run(c.loaded, nullptr, s, nullptr, 0); });
  each(RINGLET_INIT(ringlet_groom), "groom", [&](auto* s) { return ringlet_scene_groom(c.loaded, s); });
  each(RINGLET_INIT(ringlet_groom), "groom", [&](auto* s) { return ringlet_groom_write(c.hair.c_str(), s); });
  each(RINGLET_INIT(ringlet_asset_options), "asset_options", [&](auto* s) {
    ringlet_asset* none = nullptr;
    return ringlet_scene_build(c.device, c.loaded, s, &none);
  });
  each(RINGLET_INIT(ringlet_animation_options), "animation_options", [&](auto* s) {
    ringlet_animation* none = nullptr;
    return ringlet_animation_create((c.folder / "x.usda").c_str(), &c.groom, s, &none);
  });
}

struct Number {
  const char* name;
  std::function<ringlet_result(double)> give;
};

std::vector<Number> numbersOf(Good& c) {
  const auto animation = [&](auto set) {
    return [&c, set](double value) {
      ringlet_animation_options options = RINGLET_INIT(ringlet_animation_options);
      set(options, value);
      ringlet_animation* made = nullptr;
      const ringlet_result result =
          ringlet_animation_create((c.folder / "n.usda").c_str(), &c.groom, &options, &made);
      return released(made, ringlet_animation_release, result);
    };
  };
  return {
      {"groom_reading.metres_per_unit",
       [&c](double value) {
         ringlet_groom_reading reading = RINGLET_INIT(ringlet_groom_reading);
         reading.metres_per_unit = value;
         ringlet_loaded_groom* groom = nullptr;
         const ringlet_result result = ringlet_groom_read(c.hair.c_str(), &reading, &groom);
         return released(groom, ringlet_loaded_groom_release, result);
       }},
      {"mesh metres_per_unit",
       [&c](double value) {
         ringlet_mesh* mesh = nullptr;
         const ringlet_result result = ringlet_mesh_read(c.mesh.c_str(), value, &mesh);
         return released(mesh, ringlet_mesh_release, result);
       }},
      {"frames_per_second", animation([](auto& o, double v) { o.frames_per_second = v; })},
      {"metres_per_unit", animation([](auto& o, double v) { o.metres_per_unit = v; })},
      {"width", animation([](auto& o, double v) { o.width = v; })},
      {"tip_width", animation([](auto& o, double v) { o.tip_width = v; })},
      {"xyz",
       [&c](double value) {
         ringlet_animation* made = c.begun((c.folder / "n.usdc").c_str());
         std::vector<float> xyz = c.xyz;
         xyz[31] = static_cast<float>(value);
         const ringlet_result result = ringlet_animation_add(made, xyz.data(), kParticles, nullptr);
         return released(made, ringlet_animation_release, result);
       }},
      {"head",
       [&c](double value) {
         ringlet_animation* made = c.begun((c.folder / "n.rgc").c_str());
         const ringlet_pose head{{0, value, 0}, {0, 0, 0, 0}};
         const ringlet_result result = ringlet_animation_add(made, c.xyz.data(), kParticles, &head);
         return released(made, ringlet_animation_release, result);
       }},
      {"groom.points",
       [&c](double value) {
         std::vector<float> xyz = c.xyz;
         xyz[31] = static_cast<float>(value);
         ringlet_groom groom = c.groom;
         groom.points = xyz.data();
         return ringlet_groom_write((c.folder / "n.hair").c_str(), &groom);
       }},
  };
}

TEST_F(CWrongFiles, NumbersThatNothingHas) {
  Good c;
  open(c);
  c.make();
  c.start();
  for (const Number& number : numbersOf(c)) {
    for (const double value : {double(NAN), double(INFINITY), -double(INFINITY), 3e300, -3e300}) {
      EXPECT_NE(number.give(value), RINGLET_OK) << number.name << " = " << value;
      EXPECT_STRNE(ringlet_error_message(), "");
    }
    EXPECT_EQ(number.give(0.01), RINGLET_OK) << number.name << ": " << ringlet_error_message();
  }
}

TEST_F(CWrongFiles, FramesAndParticlesThatASceneHasNot) {
  Good c;
  open(c);
  c.make();
  c.start();
  for (const std::int32_t frame : {-2147483647 - 1, 2147483647, 1'000'001}) {
    ringlet_pose poses[8];
    expectInvalid(ringlet_scene_frame_poses(c.loaded, frame, poses, nullptr, nullptr), "frame is");
    expectInvalid(ringlet_scene_step(c.loaded, c.hairs[0], frame), "frame is");
  }
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{15}, ~std::uint64_t{0}}) {
    ringlet_animation* made = c.begun((c.folder / "n.usda").c_str());
    expectInvalid(ringlet_animation_add(made, c.xyz.data(), count, nullptr), "16 particles");
    ringlet_animation_release(made);
  }
}

// Missing, a folder, a device, empty, of other content; and names that nothing can be written as.
TEST_F(CWrongFiles, FilesThatAreNone) {
  Good c;
  open(c);
  c.make();
  fs::create_directories(c.folder / "folder.obj");
  std::ofstream(c.folder / "empty");
  const std::string garbage(4096, '\xb7');
  std::vector<std::string> paths = {"", "/dev/null", "/dev/full", (c.folder / "missing").string(),
                                    c.folder.string()};
  for (const char* ending : {".hair", ".obj", ".tfx", ".ply", ".data", ".bin", ".usda", ".usdc", ".usd",
                             ".usdz", ".abc", ".toml", ".rgc", ".pc2"}) {
    for (const char* content : {"", garbage.c_str()}) {
      paths.push_back((c.folder / (std::string(*content ? "garbage" : "empty") + ending)).string());
      std::ofstream(paths.back()) << content;
    }
    paths.push_back((c.folder / (std::string("missing") + ending)).string());
  }
  for (const std::string& path : paths) {
    ringlet_loaded_groom* groom = nullptr;
    EXPECT_NE(ringlet_groom_read(path.c_str(), nullptr, &groom), RINGLET_OK) << path;
    ringlet_mesh* mesh = nullptr;
    EXPECT_NE(ringlet_mesh_read(path.c_str(), 1, &mesh), RINGLET_OK) << path;
    ringlet_frames* frames = nullptr;
    EXPECT_NE(ringlet_frames_open(path.c_str(), nullptr, nullptr, &frames), RINGLET_OK) << path;
    if (!path.ends_with("empty.toml")) {  // a scene or a material of which all is the default
      ringlet_material* material = nullptr;
      EXPECT_NE(ringlet_material_read(path.c_str(), nullptr, nullptr, &material), RINGLET_OK) << path;
    }
    ringlet_scene* scene = nullptr;
    EXPECT_NE(ringlet_scene_read(path.c_str(), nullptr, &scene), RINGLET_OK) << path;
    EXPECT_STRNE(ringlet_error_message(), "");
  }
  fs::create_directories(c.folder / "f.usda");
  fs::create_directories(c.folder / "f.hair");
  for (const std::string& path :
       {std::string("/dev/full"), std::string("/dev/null"), std::string(), c.folder.string(),
        (c.folder / "x.xyz").string(), (c.folder / "missing/x.hair").string(),
        (c.folder / "missing/x.usda").string(), (c.folder / "f.hair").string(),
        (c.folder / "f.usda").string()}) {
    EXPECT_NE(ringlet_groom_write(path.c_str(), &c.groom), RINGLET_OK) << path;
    ringlet_animation* animation = nullptr;
    EXPECT_NE(ringlet_animation_create(path.c_str(), &c.groom, nullptr, &animation), RINGLET_OK) << path;
  }
  for (const char* device : {"/dev/full", "/dev/null"}) {
    EXPECT_NE(ringlet_material_write(device, c.material), RINGLET_OK);
    EXPECT_TRUE(fs::is_character_file(device)) << device << " was replaced";
  }
}

TEST_F(CWrongFiles, CallsInAWrongOrder) {
  Good c;
  open(c);
  c.make();
  c.start();
  ringlet_animation* animation = c.begun((c.folder / "o.usda").c_str());
  expectInvalid(ringlet_animation_finish(animation), "no frame");
  ASSERT_EQ(ringlet_animation_add(animation, c.xyz.data(), kParticles, nullptr), RINGLET_OK);
  ASSERT_EQ(ringlet_animation_finish(animation), RINGLET_OK) << ringlet_error_message();
  expectInvalid(ringlet_animation_finish(animation), "is finished");
  expectInvalid(ringlet_animation_add(animation, c.xyz.data(), kParticles, nullptr), "is finished");
  expectInvalid(ringlet_animation_add_hair(animation, c.hairs[0]), "is finished");
  ringlet_animation_release(animation);

  ringlet_animation_options one = RINGLET_INIT(ringlet_animation_options);
  one.frame_count = 1;
  for (const char* name : {"f.usda", "f.usdc", "f.abc", "f.rgc", "f.pc2"}) {
    ASSERT_EQ(ringlet_animation_create((c.folder / name).c_str(), &c.groom, &one, &animation), RINGLET_OK);
    ASSERT_EQ(ringlet_animation_add(animation, c.xyz.data(), kParticles, nullptr), RINGLET_OK);
    expectInvalid(ringlet_animation_add(animation, c.xyz.data(), kParticles, nullptr), "frame_count");
    ringlet_animation_release(animation);
    EXPECT_TRUE(fs::exists(c.folder / (std::string(name) + ".partial"))) << name << ": the frame is kept";
  }

  // Hair, assets and scenes that do not belong together.
  ringlet_scene* other = nullptr;
  ASSERT_EQ(ringlet_scene_parse(kScene, nullptr, nullptr, &other), RINGLET_OK);
  expectInvalid(ringlet_scene_step(other, c.hairs[0], 0), "another scene");
  ringlet_hair* none = nullptr;
  expectInvalid(ringlet_scene_hair(other, c.asset, &none), "another scene");
  ringlet_asset* plain = nullptr;
  ASSERT_EQ(ringlet_asset_build(c.device, &c.groom, nullptr, nullptr, nullptr, &plain), RINGLET_OK);
  expectInvalid(ringlet_scene_hair(other, plain, &none), "another scene");
  ringlet_asset_release(plain), ringlet_scene_release(other);
  ASSERT_EQ(ringlet_hair_set_bodies(c.hairs[0], nullptr, 0), RINGLET_OK);
  expectInvalid(ringlet_scene_step(c.loaded, c.hairs[0], 0), "0 bodies and the scene 1");

  c.hairs[0]->recordedFrames = 1;
  animation = c.begun((c.folder / "r.usda").c_str());
  expectInvalid(ringlet_scene_step(c.loaded, c.hairs[0], 0), "ringlet_frame_is_over");
  expectInvalid(ringlet_animation_add_hair(animation, c.hairs[0]), "ringlet_frame_is_over");
  ringlet_animation_release(animation);
  c.hairs[0]->recordedFrames = 0;

  // Grooms that are none.
  ringlet_groom groom = c.groom;
  groom.strand_count = 0;
  EXPECT_NE(ringlet_groom_write((c.folder / "e.hair").c_str(), &groom), RINGLET_OK);
  expectInvalid(ringlet_animation_create((c.folder / "e.usda").c_str(), &groom, nullptr, &animation),
                "no strands");
  const std::uint32_t sizes[] = {15, 1};
  groom = c.groom, groom.strand_sizes = sizes;
  EXPECT_NE(ringlet_groom_write((c.folder / "e.hair").c_str(), &groom), RINGLET_OK);
  expectInvalid(ringlet_animation_create((c.folder / "e.usda").c_str(), &groom, nullptr, &animation),
                "2 at least");
}

TEST_F(CWrongFiles, InAProcessThatForkMade) {
  Good c;
  open(c);
  c.make();
  c.start();
  ringlet_animation* animation = c.begun((c.folder / "fork.usda").c_str());
  const std::function<ringlet_result()> calls[] = {
      [&] { return ringlet_scene_step(c.loaded, c.hairs[0], 0); },
      [&] { return ringlet_animation_add_hair(animation, c.hairs[0]); },
      [&] { return ringlet_scene_build(c.device, c.loaded, nullptr, &c.asset); },
      [&] { return ringlet_scene_hair(c.loaded, c.asset, &c.hairs[0]); },
      [&] {
        ringlet_run_options options = RINGLET_INIT(ringlet_run_options);
        options.devices = &c.device, options.device_count = 1;
        return ringlet_scene_run(c.loaded, &options, nullptr, nullptr, 0);
      }};
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);  // a wait that never ends
    int number = 0;
    for (const auto& call : calls) {
      ++number;
      if (call() != RINGLET_ERROR || !std::strstr(ringlet_error_message(), "after fork()")) _exit(number);
    }
    _exit(0);
  }
  ASSERT_GT(child, 0);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0) << "the number of the call that was not refused";
  ringlet_animation_release(animation);
}

}  // namespace
}  // namespace ringlet::test::c_wrong_files_test
