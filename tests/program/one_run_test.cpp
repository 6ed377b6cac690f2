// One way from a scene to frames: the program, several devices, the window's session, C, Python and a host
// that steps a scene itself have the same bits.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/c/handles.h"
#include "ringlet/c/ringlet_io.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/load/load_scene.h"
#include "tests/program/run_program.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"
#include "view/session.h"

namespace ringlet::one_run_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::runProgram;

constexpr int kFrames = 5;
constexpr const char* kSwatch =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 3\nrows = 2\nparticles = 20\nturns = 3\n";

// A scene with one thing that changes between frames, or before them.
struct Case {
  const char* name;
  std::string text;
  bool isDivided = true;  // devices can share it
};

std::vector<Case> cases() {
  const std::string swatch = kSwatch, shaken = swatch + "[motion]\nkind = \"shake\"\n";
  const std::string keys =
      "[[key]]\ntime = 0\nair.wind = [0, 0, 0]\nmaterial.dials.weight = 1\n"
      "[[key]]\ntime = 0.1\nair.wind = [3, 0, 1]\nmaterial.dials.weight = 2\n";
  return {
      {"keys", shaken + keys},
      {"sleep", swatch + "[simulation]\nsleep_speed = 0.01\n[[key]]\ntime = 0\nsimulation.gravity = 9.81\n",
       false},
      {"cuts", shaken + "[[cut]]\ntime = 0\nat = 0.8\nstrands = \"1\"\n[[cut]]\ntime = 0.1\nat = 0.5\n",
       false},
      {"pre_roll", shaken + "pre_roll = 0.2\n"},
      {"all",
       shaken +
           "pre_roll = 0.15\n[[field]]\nkind = \"uniform\"\nstrength = 2\n[[hold]]\nbind = \"world\"\n"
           "strands = \"0:1\"\n[[body]]\nshape = \"sphere\"\nradius = 0.02\nposition = [0.2, 0, 0]\n"
           "moves = \"still\"\n[[cut]]\ntime = -0.05\nat = 0.7\n" +
           keys,
       false},
      {"touching",
       shaken + "[[group]]\nname = \"bun\"\nstrands = \"0:2\"\ntouch = false\n[contacts]\non = true\n" +
           keys},
      {"still_air",
       swatch + "[simulation]\nintegrator = \"point_jacobi\"\n[[key]]\ntime = 0\nsimulation.max_stretch = "
                "1.1\n[[key]]\ntime = 0.2\nsimulation.max_stretch = 1.3\n"},
  };
}

// Each device is opened once, and Python once, so that a kernel is compiled once by each, and not for each
// scene.
class OneRun : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    fs::copy(RINGLET_SOURCE_DIR "/examples", folder_, fs::copy_options::recursive);
    ASSERT_EQ(runProgram(folder_, {"make", "head", "--strands", "40", "--particles", "24", "--turns", "6",
                                   "--length", "0.2", "-o", "groom.obj"})
                  .exitCode,
              0);
  }

  std::string byProgram(const fs::path& scene) {
    const test::ProgramResult run =
        runProgram(folder_, {"simulate", scene.string(), "--frames", std::to_string(kFrames), "--json",
                             "--overwrite", "--no-usd", "--no-sheet", "-o", "out"});
    EXPECT_EQ(run.exitCode, 0) << scene << run.err;
    const json told = json::parse(run.out, nullptr, false);
    return told.is_object() ? told["positions_hash"].get<std::string>() : run.err;
  }
  std::string byHost(const LoadedScene& scene) {
    const SceneFrames frames(scene);
    const ScenePlaces start = frames.placesAt(frames.first());
    const auto asset = buildAsset(device(), scene);
    if (!asset) return asset.error().message;
    auto hair = Simulation::create(*asset, stateOf(start, scene));
    if (!hair) return hair.error().message;
    for (int frame = frames.first(); frame < kFrames; ++frame) {
      if (Status stepped = stepScene(frames, *hair, frame); !stepped) return stepped.error().message;
    }
    return positionsHash(*hair->positions());
  }
  std::string byWindow(const SceneFile& file, const LoadedScene& scene) {
    auto session = view::Session::create(device(), file, scene);
    if (!session) return session.error().message;
    for (int frame = 0; frame < kFrames; ++frame) {
      if (Status submitted = session->submitFrame(); !submitted) return submitted.error().message;
      if (Status waited = session->waitFrame(); !waited) return waited.error().message;
    }
    return positionsHash(*session->hairs()[0].simulation().positions());
  }
  std::string byC(const fs::path& path, std::uint32_t deviceCount) {
    ringlet_scene* scene = nullptr;
    ringlet_device own{device(), "the tests' own"};
    ringlet_device* const devices[] = {&own, &own};
    ringlet_run_options options = RINGLET_INIT(ringlet_run_options);
    options.frame_count = kFrames;
    options.devices = devices;
    options.device_count = deviceCount;
    ringlet_run_result result = RINGLET_INIT(ringlet_run_result);
    const bool hasRun = ringlet_scene_read(path.c_str(), nullptr, &scene) == RINGLET_OK &&
                        ringlet_scene_run(scene, &options, &result, nullptr, 0) == RINGLET_OK;
    ringlet_scene_release(scene);
    return hasRun ? result.positions_hash : ringlet_error_message();
  }

  void expectOne(const fs::path& path, bool isDivided) {
    SCOPED_TRACE(path.filename());
    const auto file = readScene(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto scene = loadScene(*file);
    ASSERT_TRUE(scene) << scene.error().message;
    const std::string expected = byProgram(path);
    ASSERT_EQ(expected.size(), 16u) << expected;
    EXPECT_EQ(byHost(*scene), expected) << "a host";
    EXPECT_EQ(byC(path, 1), expected) << "C";
    EXPECT_EQ(byWindow(*file, *scene), expected) << "a window's session";
    if (isDivided) {
      EXPECT_EQ(byC(path, 2), expected) << "two devices";
    }
    seen_.emplace_back(path, expected);
  }

  // Python, of all scenes seen.
  void TearDown() override {
#ifdef RINGLET_PYTHON
    expectPythonHas();
#endif
    GpuTest::TearDown();
  }
#ifdef RINGLET_PYTHON
  void expectPythonHas() {
    if (seen_.empty()) return;
    std::ofstream(folder_ / "run.py")
        << "import ringlet, sys\n"
           "device = ringlet.Device()\n"
           "for path in sys.argv[2:]:\n"
           "  run = ringlet.Scene.load(path).run(frames=int(sys.argv[1]), devices=[device])\n"
           "  print(run.positions_hash)\n";
    const std::string out = (folder_ / "hashes.txt").string();
    std::string command = "PYTHONPATH=" RINGLET_BUILD_DIR "/python PYTHONDONTWRITEBYTECODE=1 " RINGLET_PYTHON
                          " " +
                          (folder_ / "run.py").string() + " " + std::to_string(kFrames);
    std::string expected;
    for (const auto& [path, hash] : seen_) {
      command += " " + path.string();
      expected += hash + "\n";
    }
    command += " >" + out + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(test::readText(out), expected) << "Python";
  }
#endif

  const fs::path folder_ = test::scratchFolder("one_run");
  std::vector<std::pair<fs::path, std::string>> seen_;  // scenes and their hashes
};

TEST_F(OneRun, OfExamples) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".toml" || !readScene(entry.path())) continue;
    ++count;
    const auto scene = loadScene(*readScene(entry.path()));
    ASSERT_TRUE(scene) << scene.error().message;
    expectOne(entry.path(), scene->cuts.empty() && scene->settings.sleepSpeed == 0);
  }
  EXPECT_GE(count, 6);
}

// Those of many strands with fewer: what runs share does not depend on how many there are.
TEST_F(OneRun, OfBuiltInScenes) {
  for (const std::string& name : sceneNames()) {
    const fs::path path = folder_ / (name + ".toml");
    std::vector<std::string> arguments{"scene", name, "--write", path.string()};
    const std::size_t strands = makeScene(name)->groom.strandCount();
    if (strands > 200) arguments.insert(arguments.end(), {"--strands", "150"});
    const test::ProgramResult written = runProgram(folder_, arguments);
    ASSERT_EQ(written.exitCode, 0) << name << written.err;
    expectOne(path, strands > 1);
  }
}

TEST_F(OneRun, OfScenesThatChange) {
  for (const Case& each : cases()) {
    const fs::path path = folder_ / (std::string("case_") + each.name + ".toml");
    std::ofstream(path) << each.text;
    expectOne(path, each.isDivided);
  }
}

}  // namespace
}  // namespace ringlet::one_run_test
