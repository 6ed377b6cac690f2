// Scene files, from a file to files: `ringlet simulate SCENE.toml`, what is typed beside it, and `ringlet
// scene
// --write` and --keys.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "ringlet/groom/groom_file.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/file/scene_file.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::scene_file_test {
namespace {

using nlohmann::json;
using test::readText;
using test::runProgram;
using test::scratchFolder;

void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n" << text;
}

// A strand of three particles and a right angle, 20 cm long, and a head that goes 12 units to the side in 12
// frames, a shoulder that stays behind by 5.
void writeFiles(const std::filesystem::path& folder) {
  std::ofstream(folder / "groom.obj") << "v 0 0 0\nv 0 -10 0\nv 10 -10 0\nl 1 2 3\n";
  std::ofstream bvh(folder / "walk.bvh");
  bvh << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT "
         "Shoulder\n{\n"
         "OFFSET -5 1 0\nCHANNELS 0\n}\nJOINT Head\n{\nOFFSET 0 2 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 0 0 "
         "0\n}\n"
         "}\n}\nMOTION\nFrames:13\nFrame Time: 0.0416666667\n";
  for (int k = 0; k <= 12; ++k) bvh << k << " 0 0\n";
}

void writeScene(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << "[groom]\nfile = 'groom.obj'\n" << text;
}

json run(const std::filesystem::path& folder, std::vector<std::string> arguments,
         const char* backend = "reference") {
  arguments.insert(arguments.end(), {"--backend", backend, "--json", "--overwrite"});
  const auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

// A scene by another folder says the same as the options do.
TEST(SceneFileProgram, SaysWhatOptionsSay) {
  const auto folder = scratchFolder("scene_file_options");
  std::filesystem::create_directories(folder / "scenes");
  writeFiles(folder / "scenes");
  writeScene(
      folder / "scenes/nod.toml",
      "unit = 0.02\nup = 'Z'\n[material]\npreset = 'coil'\n[material.dials]\nhold = 0.5\n"
      "[motion]\nkind = 'nod'\namplitude = 0.6\nfrequency = 3\npre_roll = 0.25\n"
      "[simulation]\nfps = 30\nframes = 5\nsteps_per_frame = 4\ngravity = 5\npreload = 0.25\nroots = 2\n"
      "max_stretch = 1.05\n[output]\nfolder = '../out'\nwidth = 0.001\nfiles = ['last.obj', "
      "'hair.usda']\ncache = 'float32'\n");
  const json scene = run(folder, {"simulate", "scenes/nod.toml"});
  EXPECT_EQ(scene["outputs"],
            (json{"scenes/../out/hair.usda", "scenes/../out/hair.rgc", "scenes/../out/last.obj"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/sheet.png"));
  EXPECT_EQ(scene["material"], "scene");
  const json options = run(folder, {"simulate",
                                    "scenes/groom.obj",
                                    "--unit",
                                    "0.02",
                                    "--up",
                                    "Z",
                                    "--material",
                                    "coil",
                                    "--hold",
                                    "0.5",
                                    "--motion",
                                    "nod",
                                    "--amplitude",
                                    "0.6",
                                    "--frequency",
                                    "3",
                                    "--pre-roll",
                                    "0.25",
                                    "--fps",
                                    "30",
                                    "--frames",
                                    "5",
                                    "--steps-per-frame",
                                    "4",
                                    "--gravity",
                                    "5",
                                    "--preload",
                                    "0.25",
                                    "--roots",
                                    "2",
                                    "--max-stretch",
                                    "1.05",
                                    "--width",
                                    "0.001",
                                    "-o",
                                    "other"});
  EXPECT_EQ(scene["positions_hash"], options["positions_hash"]);
  for (const char* key : {"frames", "fps", "steps_per_frame"}) EXPECT_EQ(scene[key], options[key]) << key;
  EXPECT_EQ(readText(folder / "out/hair.usda"), readText(folder / "other/hair.usda"));
}

// Each option in place of what the file says: the same as by options alone, and not the same as by the file.
TEST(SceneFileProgram, OptionsOverrideTheFile) {
  const auto folder = scratchFolder("scene_file_override");
  writeFiles(folder);
  writeScene(folder / "nod.toml",
             "[material]\npreset = 'coil'\n[material.dials]\nhold = 1.5\n[motion]\nkind = 'nod'\namplitude = "
             "0.6\nfrequency = 3\npre_roll = 0.25\n[simulation]\nfps = 30\nseconds = 0.2\nsteps_per_frame = "
             "4\ngravity = 5\npreload = 0.25\nroots = 2\nmax_stretch = 1.05\n[output]\nfolder = 'out'\n");
  const std::vector<std::pair<std::string, std::string>> stated = {
      {"--unit", "0.01"},     {"--up", "Y"},
      {"--material", "coil"}, {"--motion", "nod"},
      {"--amplitude", "0.6"}, {"--frequency", "3"},
      {"--pre-roll", "0.25"}, {"--fps", "30"},
      {"--frames", "6"},      {"--steps-per-frame", "4"},
      {"--gravity", "5"},     {"--preload", "0.25"},
      {"--roots", "2"},       {"--max-stretch", "1.05"},
      {"--hold", "1.5"}};
  const json plain = run(folder, {"simulate", "nod.toml"});
  EXPECT_EQ(plain["frames"], 6);
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--unit", "0.02"},
                                                        {"--up", "Z"},
                                                        {"--material", "wavy"},
                                                        {"--amplitude", "0.3"},
                                                        {"--frequency", "2"},
                                                        {"--pre-roll", "0"},
                                                        {"--fps", "24"},
                                                        {"--frames", "3"},
                                                        {"--steps-per-frame", "5"},
                                                        {"--gravity", "9.81"},
                                                        {"--preload", "0"},
                                                        {"--roots", "1"}}) {
    SCOPED_TRACE(option);
    std::vector<std::string> alone{"simulate", "groom.obj", "-o", "alone"};
    for (const auto& [name, number] : stated) {
      if (option == "--material" && name == "--hold") continue;  // a material comes with dials of its own
      // A second's fifth is as many frames as there are.
      const std::string frames = option == "--fps" ? "5" : "6";
      alone.insert(alone.end(), {name, name == option ? value : name == "--frames" ? frames : number});
    }
    const json typed = run(folder, {"simulate", "nod.toml", option, value});
    EXPECT_NE(typed["positions_hash"], plain["positions_hash"]);
    EXPECT_EQ(typed["positions_hash"], run(folder, alone)["positions_hash"]);
  }
  EXPECT_EQ(run(folder, {"simulate", "nod.toml", "-o", "elsewhere"})["outputs"][1], "elsewhere/last.obj");

  // Another motion is another motion, but what else [motion] says stays.
  const json shaken = run(folder, {"simulate", "nod.toml", "--motion", "shake"});
  std::vector<std::string> alone{"simulate", "groom.obj", "-o", "alone"};
  for (const auto& [name, number] : stated) {
    if (name != "--amplitude" && name != "--frequency")
      alone.insert(alone.end(), {name, name == "--motion" ? "shake" : number});
  }
  EXPECT_EQ(shaken["positions_hash"], run(folder, alone)["positions_hash"]);
}

TEST(SceneFileProgram, HeadsFollowKeysForAsLongAsThereAreAny) {
  const auto folder = scratchFolder("scene_file_keys");
  writeFiles(folder);
  writeScene(
      folder / "keys.toml",
      "[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.5\nposition = [0.1, 0, 0.2]\nrotate_degrees = "
      "[0, 90, 0]\n[simulation]\ngravity = 0\n");
  const json out = run(folder, {"simulate", "keys.toml", "-o", "out"});
  EXPECT_EQ(out["frames"], 12);
  EXPECT_EQ(out["warnings"], json::array());
  const auto last = readGroom(folder / "out/last.obj");
  ASSERT_TRUE(last) << last.error().message;
  EXPECT_LT(length(last->groom.points[0] - Vec3f{10, 0, 20}), 1e-4f);
}

TEST(SceneFileProgram, GroomsAreMadeAndPlaced) {
  const auto folder = scratchFolder("scene_file_generate");
  std::ofstream(folder / "curl.toml") << "[groom]\ngenerate = 'curl'\nparticles = 40\nturns = 4\nscale = 2\n"
                                         "rotate_degrees = [0, 0, 90]\noffset = [0.5, 0, 0]\n[simulation]\n"
                                         "gravity = 0\nframes = 1\n";
  const json out = run(folder, {"simulate", "curl.toml", "-o", "out"});
  EXPECT_EQ(out["particles"], 40);
  const auto last = readGroom(folder / "out/last.obj");
  ASSERT_TRUE(last);
  // Its tip hung 25 cm below; now 50 cm to the side of what it was moved by.
  EXPECT_NEAR(last->groom.points.back().x, 100, 1e-2);
}

// What a joint carries goes as it does. Nothing steps bodies yet but what lies below this file: they are
// read.
TEST(SceneFileProgram, BodiesAreRead) {
  const auto folder = scratchFolder("scene_file_bodies");
  writeFiles(folder);
  const std::string motion = "[motion]\nfile = 'walk.bvh'\nunit = 0.01\n[simulation]\nframes = 1\n";
  writeScene(folder / "joint.toml", motion + "[[body]]\nshape = 'capsule'\njoint = 'Shoulder'\n");
  EXPECT_EQ(run(folder, {"simulate", "joint.toml", "-o", "out"})["warnings"], json::array());
  writeScene(folder / "told.toml",
             "[motion]\nfile = 'walk.bvh'\n[simulation]\nframes = 1\n[[body]]\nshape = "
             "'sphere'\njoint = 'Shoulder'\n");
  EXPECT_EQ(run(folder, {"simulate", "told.toml", "-o", "out"})["warnings"].size(), 1u)
      << "once for one file";

  struct Case {
    std::string text, message;
    std::vector<std::string> options{};
    int exitCode = 1;
  };
  for (
      const Case& c :
      {Case{motion + "[[body]]\nshape = 'sphere'\njoint = 'Shuolder'\n",
            "the body sphere 1: ./walk.bvh has no joint Shuolder; did you mean Shoulder?"},
       Case{
           motion + "[[body]]\nname = 'neck'\nshape = 'sphere'\njoint = 'Shoulder'\n",
           "--motion: ./wrong.toml: line 11: found body.joint, but the head follows no file; expected motion.file",
           {"--motion", "nod"},
           2},
       Case{motion + "[[body]]\nshape = 'box'\nmoves = { file = 'none.bvh' }\n", "none.bvh", {}, 4}}) {
    writeScene(folder / "wrong.toml", c.text);
    std::vector<std::string> arguments{"simulate", "./wrong.toml", "-o", "out", "--backend", "reference"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    expectContains(result.err, c.message);
  }
}

TEST(SceneFileProgram, MistakesAreOneSentence) {
  const auto folder = scratchFolder("scene_file_mistakes");
  writeFiles(folder);
  struct Case {
    std::string text;
    std::vector<std::string> options;
    int exitCode;
    std::string message;
  };
  const std::vector<std::string> out{"-o", "out"};
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), out.begin(), out.end());
    return options;
  };
  for (const Case& c : {
           Case{
               "[motion]\nkind = 'nodd'\n", out, 1,
               "ringlet simulate: scene.toml: line 4: found the text 'nodd' for motion.kind; expected one of "
               "still, shake, nod, spin, glide, walk, turn, jump, whip; did you mean nod?"},
           Case{"", {}, 2, "--output is required"},
           Case{"[[motion.key]]\ntime = 0\n", with({"--amplitude", "1"}), 2,
                "found --amplitude with a motion by keys"},
           Case{"[motion]\nfile = 'walk.bvh'\n", with({"--frequency", "1"}), 2,
                "found --frequency with a motion by file"},
           Case{"", with({"--joint", "Head"}), 2, "found no way to move in [motion]"},
           Case{"", with({"--iterations", "5"}), 2,
                "found --iterations with the integrator jacobi; only point_jacobi has it"},
           Case{"[contacts]\non = false\n", with({"--prune", "5"}), 2, "only with --contacts on"},
           Case{"[contacts]\n[simulation]\nintegrator = 'paper'\n", out, 1, "contacts need jacobi"},
           Case{"[motion]\nfile = 'none.bvh'\n", out, 4, "none.bvh"},
       }) {
    writeScene(folder / "scene.toml", c.text);
    std::vector<std::string> arguments{"simulate", "scene.toml", "--backend", "reference"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << result.err;
    expectContains(result.err, c.message);
  }
  const auto missing = runProgram(folder, {"simulate", "none.toml", "-o", "out"});
  EXPECT_EQ(missing.exitCode, 4);
  expectContains(missing.err, "none.toml: cannot read it");
}

// A built-in scene as a file steps the same hair, bit by bit, roots that move beside the head and all.
TEST(SceneFileProgram, BuiltinScenesAsFilesStepTheSameHair) {
  const auto folder = scratchFolder("scene_file_builtin");
  for (const std::string& name : sceneNames()) {
    SCOPED_TRACE(name);
    std::vector<std::string> options{name, "--seconds", "0.125", "--particles", "24"};
    if (name != "two_curls") options.insert(options.end(), {"--strands", "12"});
    std::vector<std::string> writing = options, running = options;
    writing.insert(writing.begin(), "scene");
    running.insert(running.begin(), "scene");
    writing.insert(writing.end(), {"--write", name + ".toml"});
    const auto written = runProgram(folder, writing);
    ASSERT_EQ(written.exitCode, 0) << written.err;
    EXPECT_EQ(written.out, fmt::format("{0}: {0}.toml and {0}-groom.obj\n", name));
    EXPECT_EQ(readText(folder / (name + ".toml")).rfind("# The built-in scene " + name, 0), 0u);
    const json expected = run(folder, running);
    std::vector<std::string> again{"simulate", name + ".toml", "-o", "out"};
    if (!expected["contacts"].is_null())
      again.push_back("--measure-contacts");  // as `scene` does: of the worst frame
    const json found = run(folder, again);
    EXPECT_EQ(found["positions_hash"], expected["positions_hash"]);
    for (const char* key : {"frames", "fps", "steps_per_frame", "strands", "particles", "contacts", "pairs"})
      EXPECT_EQ(found[key], expected[key]) << key;
  }
}

TEST(SceneFileProgram, BuiltinScenesAsFilesStepTheSameHairOnTheDevice) {
  const auto folder = scratchFolder("scene_file_builtin_gpu");
  RINGLET_NEEDS_DEVICE(folder);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"walk_cycle", "--frames-on", "raw", "--steps-per-frame", "6"},
        std::vector<std::string>{"pile", "--strands", "12"},
        std::vector<std::string>{"hanging_curl", "--integrator", "paper"}}) {
    SCOPED_TRACE(options[0]);
    std::vector<std::string> writing = options, running = options;
    writing.insert(writing.begin(), "scene");
    writing.insert(writing.end(), {"--seconds", "0.125", "--write", "scene.toml", "--quiet"});
    running.insert(running.begin(), "scene");
    running.insert(running.end(), {"--seconds", "0.125"});
    const auto written = runProgram(folder, writing);
    ASSERT_EQ(written.exitCode, 0) << written.err;
    EXPECT_EQ(written.out, "");
    EXPECT_EQ(run(folder, {"simulate", "scene.toml", "-o", "out"}, "gpu")["positions_hash"],
              run(folder, running, "gpu")["positions_hash"]);
  }
}

TEST(SceneFileProgram, KeysArePrinted) {
  const auto folder = scratchFolder("scene_file_list");
  const auto text = runProgram(folder, {"scene", "--keys"});
  const json out = json::parse(runProgram(folder, {"scene", "--keys", "--json"}).out, nullptr, false);
  ASSERT_EQ(out["keys"].size(), sceneKeys().size());
  for (std::size_t i = 0; i < sceneKeys().size(); ++i) {
    const SceneKey key = sceneKeys()[i];
    EXPECT_EQ(out["keys"][i]["key"], key.key);
    EXPECT_EQ(out["keys"][i]["effect"], key.effect);
    expectContains(text.out, "\n  " + key.key + " ");
    expectContains(text.out, key.effect);
  }
  for (const char* heading : {"\n[groom]\n", "\n[[body]]\n", "\n[[motion.key]]\n", "\n[motion.roots]\n"})
    expectContains(text.out, heading);
  for (const auto& [arguments, message] : {
           std::pair{std::vector<std::string>{"scene", "--keys", "pile"},
                     "--keys only says which keys there are"},
           std::pair{std::vector<std::string>{"scene", "pile", "--write", "a.toml", "-o", "out"},
                     "with --write nothing is run"},
           std::pair{std::vector<std::string>{"scene", "pile", "--write", "a.txt"}, "must end in .toml"},
       }) {
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 2);
    expectContains(result.err, message);
  }
  const auto nowhere = runProgram(folder, {"scene", "pile", "--write", "none/a.toml"});
  EXPECT_EQ(nowhere.exitCode, 5);
  expectContains(nowhere.err, "cannot write into its folder");
}

// Every command that takes a scene takes any key of it, and says which it does not know.
TEST(SceneFileProgram, EveryCommandOfScenesTakesSet) {
  const auto folder = scratchFolder("every_set");
  ASSERT_EQ(runProgram(folder, {"make", "curl", "-o", "curl.obj", "--quiet"}).exitCode, 0);
  writeScene(folder / "scene.toml", "");
  ASSERT_EQ(runProgram(folder, {"simulate", "curl.obj", "--frames", "2", "--backend", "reference", "--cache",
                                "float32", "-o", "run", "--quiet"})
                .exitCode,
            0);
  const std::map<std::string, std::vector<std::string>> commands{
      {"simulate", {"simulate", "scene.toml", "-o", "out"}},
      {"scene", {"scene", "bounce"}},
      {"render", {"render", "scene.toml", "-o", "pictures"}},
      {"convert", {"convert", "run/hair.rgc", "hairs.usda", "--hairs", "9", "--scene", "scene.toml"}},
      {"sweep", {"sweep", "scene.toml", "--vary", "simulation.frames=2", "-o", "swept"}},
      {"view", {"view", "scene.toml"}}};
  for (const char* name : {"make", "simulate", "sweep", "info", "measure", "render", "view", "convert",
                           "scene", "devices", "tune", "conform", "kernels", "material"}) {
    SCOPED_TRACE(name);
    const bool takesSet =
        runProgram(folder, {name, "--help"}).out.find("--set KEY=VALUE") != std::string::npos;
    ASSERT_EQ(takesSet, commands.contains(name));
    if (!takesSet) continue;
    std::vector<std::string> words = commands.at(name);
    words.insert(words.end(), {"--set", "simulation.gravty=1"});
    const auto result = runProgram(folder, words);
    EXPECT_NE(result.exitCode, 0);
    EXPECT_NE(result.err.find("did you mean simulation.gravity?"), std::string::npos) << result.err;
    words.back() = "gravity";
    EXPECT_NE(runProgram(folder, words).err.find("KEY=VALUE"), std::string::npos);
  }
}

}  // namespace
}  // namespace ringlet::scene_file_test
