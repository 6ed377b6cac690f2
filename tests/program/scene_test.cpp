// `ringlet scene`: which scenes there are, what their options do, what is written and printed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/builtin_scene.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"
#include "tests/support/tolerances.h"

namespace ringlet::scene_test {
namespace {

using nlohmann::json;
using test::runProgram;
using test::scratchFolder;

void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in:\n" << text;
}

// Standard output of a run, as JSON; it is that and nothing else. Short runs by the reference need no device.
json scene(const std::filesystem::path& folder, std::vector<std::string> arguments,
           const std::string& backend = "reference") {
  arguments.insert(arguments.begin(), "scene");
  arguments.insert(arguments.end(), {"--backend", backend, "--json"});
  const auto result = runProgram(folder, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

std::set<std::string> keysOf(const json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

TEST(Scene, ListsEveryScene) {
  const auto folder = scratchFolder("scene_list");
  const auto text = runProgram(folder, {"scene", "--list"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  const auto result = runProgram(folder, {"scene", "--list", "--json"});
  const json out = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << result.out;
  ASSERT_EQ(out["scenes"].size(), sceneNames().size());
  for (std::size_t i = 0; i < sceneNames().size(); ++i) {
    const std::string name = sceneNames()[i];
    EXPECT_EQ(out["scenes"][i]["name"], name);
    EXPECT_EQ(out["scenes"][i]["summary"], sceneSummary(name));
    EXPECT_EQ(out["scenes"][i]["seconds"], makeScene(name)->seconds);
    EXPECT_EQ(out["scenes"][i]["preload"], makeScene(name)->settings.gravityPreload);
    expectContains(text.out, name);
    expectContains(text.out, sceneSummary(name));
  }
}

const std::vector<std::string> kContactKeys = {"volume_strands",
                                               "contact_particles",
                                               "contacts",
                                               "pairs_unpruned",
                                               "pairs",
                                               "pair_tests",
                                               "rebuilds",
                                               "momentum_error",
                                               "volume_cut",
                                               "volume_largest",
                                               "raw_recall",
                                               "overlap_beyond_rest_sum",
                                               "deepest_overlap_all",
                                               "crossings"};

class SceneBackends : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (GetParam() == std::string("gpu")) RINGLET_NEEDS_DEVICE(folder_);
  }
  std::filesystem::path folder_ = scratchFolder(std::string("scene_") + GetParam());
};
INSTANTIATE_TEST_SUITE_P(Both, SceneBackends, testing::Values("reference", "gpu"),
                         [](const testing::TestParamInfo<const char*>& backend) { return backend.param; });

TEST_P(SceneBackends, EveryOneRunsAndSaysAllOfSimulateAndMeasure) {
  // The keys of the other two commands, which a scene has together, and its own.
  ASSERT_EQ(runProgram(folder_, {"make", "curl", "-o", "curl.obj"}).exitCode, 0);
  const auto simulated = runProgram(
      folder_, {"simulate", "curl.obj", "--frames", "1", "--backend", GetParam(), "--json", "-o", "out"});
  const auto measured = runProgram(folder_, {"measure", "curl.obj", "out", "--json"});
  std::set<std::string> expected = keysOf(json::parse(simulated.out, nullptr, false));
  expected.merge(keysOf(json::parse(measured.out, nullptr, false)));
  expected.erase("spread");
  expected.merge(std::set<std::string>{"scene", "seconds", "preload", "core", "frames_on", "frame_turn_deg"});
  for (const char* key :
       {"droop_mm", "core_elongation", "turns", "mean_radius_mm", "handedness_kept", "arc_drift",
        "max_edge_stretch", "limited_share", "tip_rotation_deg", "bounce_hz", "settle_s", "energy_ratio",
        "velocity_residual", "frames", "strands", "particles", "ms_per_frame", "positions_hash"})
    EXPECT_TRUE(expected.count(key)) << key;

  for (const std::string& name : sceneNames()) {
    if (sceneShowsContacts(name)) continue;  // below
    SCOPED_TRACE(name);
    const json out = scene(folder_, {name, "--particles", "32", "--seconds", "0.125"}, GetParam());
    ASSERT_TRUE(out.is_object());
    EXPECT_EQ(keysOf(out), expected);
    EXPECT_EQ(out["scene"], name);
    EXPECT_EQ(out["material"], "scene");
    EXPECT_EQ(out["backend"], GetParam());
    EXPECT_EQ(out["seconds"], 0.125);
    EXPECT_EQ(out["frames"], 3);
    EXPECT_EQ(out["fps"], 24);
    EXPECT_EQ(out["steps_per_frame"], 8);
    EXPECT_EQ(out["strands"], name == "release" ? 32 : 1);
    EXPECT_EQ(out["particles"], 32 * out["strands"].get<int>());
    EXPECT_EQ(out["preload"], makeScene(name)->settings.gravityPreload);
    EXPECT_EQ(out["core"], true);
    EXPECT_EQ(out["frames_on"], "smoothed");
    EXPECT_EQ(out["nonfinite"], 0);
    EXPECT_EQ(out["warnings"], json::array());
    EXPECT_EQ(out["outputs"], json::array());
    EXPECT_EQ(out["velocity_residual"].is_number(), GetParam() == std::string("gpu"));
    for (const std::string& key : kContactKeys) EXPECT_TRUE(out[key].is_null()) << key;
    EXPECT_EQ(out["frame_turn_deg"].is_number(), name == "twist_jump");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "groom.obj")) << "nothing is written without -o";
}

// Scenes of hair that meets hair, made small: their numbers with contacts, and those that remain without.
TEST(Scene, HairThatMeetsHairIsMeasured) {
  const auto folder = scratchFolder("scene_contacts");
  RINGLET_NEEDS_DEVICE(folder);
  for (const std::string& name : sceneNames()) {
    if (!sceneShowsContacts(name)) continue;
    SCOPED_TRACE(name);
    std::vector<std::string> arguments{name, "--seconds", "0.125"};
    if (name != "two_curls") arguments.insert(arguments.end(), {"--strands", "12"});
    const json on = scene(folder, arguments, "gpu");
    ASSERT_TRUE(on.is_object());
    EXPECT_EQ(on["fps"], 24) << "though steps are measured one by one";
    EXPECT_EQ(on["steps_per_frame"], 8);
    EXPECT_EQ(on["frames"], 3);
    EXPECT_EQ(on["nonfinite"], 0);
    EXPECT_TRUE(on["velocity_residual"].is_null());
    for (const std::string& key : kContactKeys) EXPECT_TRUE(on[key].is_number()) << key;
    EXPECT_LE(on["pairs"], on["pairs_unpruned"]);
    EXPECT_GE(on["rebuilds"], 1);
    EXPECT_GE(on["raw_recall"], 0);
    EXPECT_LE(on["raw_recall"], 1);
    EXPECT_TRUE(on["stages_ms"]["measure"].is_number());

    arguments.insert(arguments.end(), {"--contacts", "off"});
    const json off = scene(folder, arguments, "gpu");
    for (const std::string& key : kContactKeys) {
      const bool remains =
          key == "overlap_beyond_rest_sum" || key == "deepest_overlap_all" || key == "crossings";
      EXPECT_EQ(off[key].is_number(), remains) << key;
    }
  }
}

// The reference has contacts and shifted roots as well: the same pairs may touch, and what it shows is the
// device's to rounding.
TEST(Scene, BothBackendsMeetAlike) {
  const auto folder = scratchFolder("scene_contacts_reference");
  const std::vector<std::string> arguments{"two_curls", "--seconds", "1"};
  const json reference = scene(folder, arguments, "reference");
  ASSERT_TRUE(reference.is_object());
  for (const std::string& key : kContactKeys) EXPECT_TRUE(reference[key].is_number()) << key;
  EXPECT_GT(reference["contacts"], 0) << "hair must meet";
  EXPECT_EQ(reference["crossings"], 0);
  RINGLET_NEEDS_DEVICE(folder);
  const json device = scene(folder, arguments, "gpu");
  for (const char* key : {"pairs_unpruned", "pairs", "contacts", "crossings"})
    EXPECT_EQ(reference[key], device[key]) << key;
  for (const char* key : {"deepest_overlap_all", "overlap_beyond_rest_sum", "momentum_error"})
    EXPECT_NEAR(reference[key], device[key], 1e-3) << key;
}

// Steps that are frames of their own are the same steps.
TEST(Scene, MeasuringChangesNothing) {
  const auto folder = scratchFolder("scene_measured");
  RINGLET_NEEDS_DEVICE(folder);
  ASSERT_EQ(
      runProgram(folder, {"make", "swatch", "--columns", "3", "--rows", "2", "-o", "swatch.obj"}).exitCode,
      0);
  std::vector<std::string> arguments{"simulate",          "swatch.obj", "--contacts", "on", "--frames", "6",
                                     "--steps-per-frame", "4",          "--json",     "-o", "out"};
  const json plain = json::parse(runProgram(folder, arguments).out, nullptr, false);
  arguments.insert(arguments.end(), {"--measure-contacts", "--overwrite"});
  const json measured = json::parse(runProgram(folder, arguments).out, nullptr, false);
  ASSERT_TRUE(plain.is_object() && measured.is_object());
  for (const char* key : {"positions_hash", "warnings", "steps_per_frame", "fps", "pairs", "pair_tests",
                          "rebuilds", "limited_share", "max_edge_stretch"})
    EXPECT_EQ(plain[key], measured[key]) << key;
  EXPECT_FALSE(plain["warnings"].empty()) << "4 steps are few, and the sentence says 4";
  for (const char* key : {"raw_recall", "overlap_beyond_rest_sum", "deepest_overlap_all", "crossings"}) {
    EXPECT_TRUE(plain[key].is_null()) << key;
    EXPECT_TRUE(measured[key].is_number()) << key;
  }
  EXPECT_TRUE(plain["contacts"].is_number());
}

TEST(Scene, ContactOptionsTakeEffect) {
  const auto folder = scratchFolder("scene_contact_options");
  RINGLET_NEEDS_DEVICE(folder);
  auto run = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"flip", "--strands", "20", "--particles", "32", "--seconds", "0.125"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return scene(folder, arguments, "gpu");
  };
  const json plain = run({"--prune", "8"}), all = run({}), few = run({"--prune", "30"}),
             bound = run({"--max-neighbours", "2"}), dropped = run({"--drop-share", "0.5"});
  EXPECT_EQ(all["pairs"], all["pairs_unpruned"]);
  EXPECT_EQ(all["raw_recall"], 1);
  EXPECT_EQ(run({"--prune", "none"})["positions_hash"], all["positions_hash"]);
  EXPECT_LT(plain["pairs"], all["pairs"]);
  EXPECT_LT(few["pairs"], plain["pairs"]);
  EXPECT_LE(bound["pairs"], 20);
  EXPECT_LT(dropped["pairs"], plain["pairs"]);
  EXPECT_GT(dropped["pairs"], 0);
  EXPECT_LT(few["pair_tests"], plain["pair_tests"]);
  EXPECT_LT(run({"--contact-radius", "0.002", "--fill-gaps", "off"})["pairs_unpruned"],
            plain["pairs_unpruned"]);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--contact-iterations", "4"}, {"--contact-friction", "1"}, {"--bend-stiffness", "2"}})
    EXPECT_NE(run(options)["positions_hash"], all["positions_hash"]) << options[0];

  // Thinned where hair is dense, which a hundred strands are and twenty are not.
  const auto flip = [&](const char* strands, const char* detail) {
    return scene(folder,
                 {"flip", "--particles", "32", "--seconds", "0.125", "--contacts", "explicit", "--strands",
                  strands, "--contact-detail", detail},
                 "gpu");
  };
  EXPECT_EQ(flip("20", "0.5")["positions_hash"], flip("20", "1")["positions_hash"]);
  EXPECT_LT(flip("100", "0.5")["contact_particles"],
            0.6 * flip("100", "1")["contact_particles"].get<double>());

  const auto text = runProgram(folder, {"scene", "two_curls", "--seconds", "0.125"});
  EXPECT_EQ(text.exitCode, 0) << text.err;
  for (const char* part : {"  contacts      ", " in the worst frame, momentum error ", "  pairs         ",
                           ", and all that are not", "  overlap       ", "  crossings     0, in all steps"})
    expectContains(text.out, part);
}

// What measure finds in the files is what the scene said, but for what only its steps know.
void expectMeasureAgrees(const std::filesystem::path& folder, const json& said) {
  const auto measured = runProgram(folder, {"measure", "out/groom.obj", "out", "--json"});
  ASSERT_EQ(measured.exitCode, 0) << measured.err;
  const json found = json::parse(measured.out, nullptr, false);
  for (const char* key : {"strands", "particles", "frames", "handedness_kept"})
    EXPECT_EQ(found[key], said[key]);
  auto expectNear = [](const json& a, const json& b, const std::string& key) {
    ASSERT_EQ(a[key].is_null(), b[key].is_null()) << key;
    if (a[key].is_null()) return;
    const double x = a[key], y = b[key];
    EXPECT_NEAR(x, y, test::kMeasuredAgain * (1 + std::abs(y))) << key;
  };
  for (const char* key : {"droop_mm", "core_elongation", "turns", "mean_radius_mm", "arc_drift",
                          "tip_rotation_deg", "bounce_hz", "sway_hz", "settle_s", "energy_ratio"})
    expectNear(found, said, key);
  for (const char* key : {"droop_mm", "core_elongation", "tip_rotation_deg"})
    expectNear(found["worst"], said["worst"], key);
  EXPECT_LE(found["max_edge_stretch"].get<double>(), said["max_edge_stretch"].get<double>() + 1e-6);
}

// By way of a file that is run by `simulate` too, with all that a built-in scene has by itself no place for.
TEST(Scene, SetChangesWhatRunsAndWhatIsWritten) {
  const auto folder = scratchFolder("scene_set");
  RINGLET_NEEDS_DEVICE(folder);
  const std::vector<std::string> scene{"scene", "head_shake", "--seconds", "0.2", "--untuned"};
  const auto with = [](std::vector<std::string> words, std::vector<std::string> more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto hashOf = [&](const std::vector<std::string>& words) {
    const auto result = runProgram(folder, words);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return json::parse(result.out, nullptr, false).value("positions_hash", "none");
  };
  const std::string plain = hashOf(with(scene, {"--json"}));
  for (const char* change : {"simulation.gravity=2", "material.dials.hold=0.1", "air.wind=[30, 0, 10]",
                             "goal.strength=30", "simulation.integrator=point_jacobi"}) {
    SCOPED_TRACE(change);
    const std::string changed = hashOf(with(scene, {"--json", "--set", change}));
    EXPECT_NE(changed, plain);
    ASSERT_EQ(runProgram(folder, with(scene, {"--quiet", "--write", "scene.toml", "--set", change})).exitCode,
              0);
    EXPECT_EQ(hashOf({"simulate", "scene.toml", "--json", "--untuned", "--overwrite", "-o", "out"}), changed);
  }
}

TEST(Scene, WritesFilesThatMeasureReadsBack) {
  const auto folder = scratchFolder("scene_files");
  // Long enough to bounce and to settle; a head that turns and shows it by roots that are not on a line.
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"hanging_curl", "--preload", "0", "--seconds", "4"},
                                             {"walk_cycle", "--strands", "4", "--seconds", "1"}}) {
    SCOPED_TRACE(arguments[0]);
    std::filesystem::remove_all(folder / "out");
    auto all = arguments;
    all.insert(all.end(), {"--particles", "32", "-o", "out"});
    const json out = scene(folder, all);
    ASSERT_TRUE(out.is_object());
    EXPECT_EQ(out["outputs"], (json{"out/hair.usda", "out/last.obj", "out/sheet.png", "out/groom.obj"}));
    const std::string help = runProgram(folder, {"scene", "--help"}).out;
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder / "out")) {
      expectContains(help, file.path().filename());
      ++count;
    }
    EXPECT_EQ(count, 4u);
    EXPECT_EQ(out["bounce_hz"].is_number(), arguments[0] == "hanging_curl");
    expectMeasureAgrees(folder, out);
  }
}

TEST(Scene, OptionsTakeEffect) {
  const auto folder = scratchFolder("scene_options");
  auto run = [&](const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> arguments{name, "--particles", "32", "--seconds", "0.25"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return scene(folder, arguments);
  };
  auto hash = [](const json& out) { return out["positions_hash"].get<std::string>(); };

  // Gravity without preload pulls the curl down; with it, by nothing.
  const json held = run("hanging_curl", {}), free = run("hanging_curl", {"--preload", "0"});
  EXPECT_LT(std::abs(held["droop_mm"].get<double>()), 0.01);
  EXPECT_EQ(held["energy_ratio"], 0);
  EXPECT_GT(free["droop_mm"].get<double>(), 1);
  EXPECT_EQ(free["preload"], 0);

  const json shaken = run("head_shake", {}), coreless = run("head_shake", {"--core", "off"});
  EXPECT_EQ(coreless["core"], false);
  EXPECT_NE(hash(coreless), hash(shaken));
  const json raw = run("head_shake", {"--frames-on", "raw"});
  EXPECT_EQ(raw["frames_on"], "raw");
  EXPECT_NE(hash(raw), hash(shaken));
  const json finer = run("head_shake", {"--steps-per-frame", "16"});
  EXPECT_EQ(finer["steps_per_frame"], 16);
  EXPECT_NE(hash(finer), hash(shaken));
  EXPECT_EQ(hash(run("head_shake", {"--core", "on", "--frames-on", "smoothed", "--steps-per-frame", "8",
                                    "--preload", "0"})),
            hash(shaken))
      << "these are its own";

  const json larger = scene(folder, {"release", "--particles", "40", "--strands", "9", "--seconds", "0.1"});
  EXPECT_EQ(larger["strands"], 16) << "whole rows of 8";
  EXPECT_EQ(larger["particles"], 640);
  EXPECT_EQ(larger["frames"], 2);

  const json paper = run("hanging_curl", {"--integrator", "paper"});
  EXPECT_EQ(paper["integrator"], "paper");
  EXPECT_EQ(paper["steps_per_frame"], 30);
  EXPECT_EQ(paper["preload"], 0);
  EXPECT_TRUE(paper["velocity_residual"].is_null());
}

// Steps stay as the scene or the user has them, and what the hair wants instead is said: the rest state's own
// sentences.
TEST(Scene, WarnsWhereHairWantsMoreSteps) {
  const auto folder = scratchFolder("scene_warnings");
  struct Case {
    std::string name;
    std::vector<std::string> options;
    SceneOptions same;
  };
  for (const Case& c : {Case{"head_shake", {"--steps-per-frame", "4"}, {.stepsPerFrame = 4}},
                        Case{"walk_cycle", {"--frames-on", "raw"}, {.smoothedFrames = false}}}) {
    std::vector<std::string> arguments{"scene",     c.name,      "--seconds", "0.05",
                                       "--backend", "reference", "--json"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const json out = json::parse(result.out, nullptr, false);
    EXPECT_EQ(out["steps_per_frame"], c.same.stepsPerFrame.value_or(8));
    const auto made = makeScene(c.name, c.same);
    const std::vector<std::string> expected =
        buildRestState(made->groom, made->material, made->settings)->warnings;
    ASSERT_EQ(expected.size(), 1u);
    expectContains(expected[0], "steps per frame");
    EXPECT_EQ(out["warnings"], json(expected));
    EXPECT_EQ(result.err, "ringlet scene: warning: " + expected[0] + "\n");
  }

  const json coarse = scene(folder, {"hanging_curl", "--particles", "16", "--seconds", "0.05"});
  ASSERT_EQ(coarse["warnings"].size(), 1u);
  expectContains(coarse["warnings"][0], "a curl holds its shape from 4, 32 in all");
}

// Frames turn by the less on the smoothed strand the shorter the step is; on the raw one they jump.
TEST(Scene, TwistJumpSaysHowFarFramesTurn) {
  const auto folder = scratchFolder("scene_frame_turn");
  auto turn = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"twist_jump", "--particles", "32", "--seconds", "1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return scene(folder, arguments)["frame_turn_deg"].get<double>();
  };
  const double coarse = turn({}), fine = turn({"--steps-per-frame", "32"}),
               raw = turn({"--frames-on", "raw"});
  EXPECT_GT(coarse, 1);
  EXPECT_LT(coarse, 20);
  EXPECT_NEAR(fine / coarse, 0.25, 0.05);
  EXPECT_GT(raw, 45);

  const auto text = runProgram(
      folder, {"scene", "twist_jump", "--particles", "32", "--seconds", "0.1", "--backend", "reference"});
  expectContains(text.out, "  frames        turned by at most ");
  expectContains(text.out, " degrees in a step of 1/192 s");
  expectContains(text.out, "  curl          none at rest");
}

TEST(Scene, TheTableSaysTheNumbers) {
  const auto folder = scratchFolder("scene_text");
  std::vector<std::string> arguments{"scene",     "hanging_curl", "--particles", "32",
                                     "--seconds", "0.25",         "--preload",   "0",
                                     "--backend", "reference",    "--output",    "out"};
  const json out =
      scene(folder, {"hanging_curl", "--particles", "32", "--seconds", "0.25", "--preload", "0"});
  const auto text = runProgram(folder, arguments);
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_EQ(test::withoutCompileNotes(text.err), "") << "no progress bar where standard error is no terminal";
  for (const std::string& part :
       {"hanging_curl: " + sceneSummary("hanging_curl"), std::string("6 frames of 1 strand, 32 particles"),
        std::string("jacobi, 8 steps a frame"), std::string("out/groom.obj"),
        fmt::format("  droop         {:.4f} mm at the end", out["droop_mm"].get<double>()),
        fmt::format("  core          {:.4f} x its length at rest", out["core_elongation"].get<double>()),
        fmt::format("  curl          {:.3f} turns of radius {:.3f} mm, hand kept", out["turns"].get<double>(),
                    out["mean_radius_mm"].get<double>()),
        std::string("  tip           turned by "), std::string("  bounce        none measured, not settled")})
    expectContains(text.out, part);

  arguments.insert(arguments.end(), {"--quiet", "--overwrite"});
  const auto quiet = runProgram(folder, arguments);
  EXPECT_EQ(quiet.exitCode, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

// Arguments of `ringlet scene` that cannot be, and what is answered.
const struct {
  std::vector<std::string> arguments;
  int exitCode;
  std::string message;
} kMistakes[] = {
    {{}, 2, "NAME (or --list) is required"},
    {{"hanging_crul"}, 2, "did you mean hanging_curl?"},
    {{"dance"}, 2, "only hanging_curl, walk_cycle, head_shake, bounce, twist_jump, release"},
    {{"bounce", "release"}, 2, "one word too many: 'release'"},
    {{"bounce", "--partcles", "32"}, 2, "did you mean --particles?"},
    {{"bounce", "--particles", "1"}, 2, "--particles: must be a whole number from 2"},
    {{"bounce", "--strands", "0"}, 2, "--strands: must be a whole number from 1"},
    {{"bounce", "--preload", "1.5"}, 2, "--preload: must be a number from 0 to 1"},
    {{"bounce", "--core", "offf"}, 2, "did you mean off?"},
    {{"bounce", "--frames-on", "smooth"}, 2, "did you mean smoothed?"},
    {{"bounce", "--steps-per-frame", "341"}, 2, "must be a whole number from 1 to 340"},
    {{"bounce", "--seconds", "0"}, 2, "--seconds: must be a number from"},
    {{"bounce", "--seconds", "nan"}, 2, "not 'nan'"},
    {{"bounce", "--integrator", "papr"}, 2, "did you mean paper?"},
    {{"bounce", "--backend", "cpu"}, 2, "only gpu, reference"},
    {{"bounce", "--backend", "reference", "--device", "0"}, 2, "only --backend gpu has a device"},
    {{"bounce", "--integrator", "paper", "--core", "off"}, 2, "--core: --integrator paper takes"},
    {{"bounce", "--integrator", "paper", "--frames-on", "raw"}, 2, "--frames-on: --integrator"},
    {{"bounce", "--integrator", "paper", "--preload", "1"}, 2, "--preload: --integrator paper"},
    {{"two_curls", "--contacts", "yes"},
     2,
     "--contacts: there is no 'yes' (only off, on, auto, explicit, volume)"},
    {{"two_curls", "--contact-radius", "0"}, 2, "--contact-radius: must be a number from 1e-06 to 1"},
    {{"two_curls", "--prune", "0"}, 2, "whole number from 1 to 1000000, not '0', or none"},
    {{"two_curls", "--prune", "all"}, 2, "not 'all', or none"},
    {{"two_curls", "--prune", "none", "--drop-share", "0.5"}, 2, "--drop-share: --prune none prunes"},
    {{"two_curls", "--contact-iterations", "0"}, 2, "must be a whole number from 1 to 1000"},
    {{"two_curls", "--contact-friction", "11"}, 2, "must be a number from 0 to 1"},
    {{"two_curls", "--max-neighbours", "-1"}, 2, "must be a whole number from 0"},
    {{"bounce", "--prune", "8"}, 2, "--prune: only with --contacts on, or in a scene of hair"},
    {{"bounce", "--integrator", "paper", "--bend-stiffness", "1"}, 2, "--bend-stiffness: --integ"},
    {{"two_curls", "--set", "groom.scale=2"}, 2, "--set: groom.scale has no place here"},
    {{"two_curls", "--set", "output.folder=out"}, 2, "--set: output.folder has no place here"},
    {{"two_curls", "--set", "simulation.gravty=2"}, 2, "did you mean simulation.gravity?"},
    {{"two_curls", "--strands", "3"}, 1, "two_curls has its two strands"},
    {{"two_curls", "--integrator", "paper"}, 1, "contacts need jacobi"},
    {{"--list", "bounce"}, 2, "NAME: --list only says which scenes there are"},
    {{"--list", "-o", "out"}, 2, "--output: --list only says"},
    {{"twist_jump", "--particles", "8"}, 1, "ringlet scene: twist_jump with 8 particles: it takes 16"},
    {{"bounce", "--backend", "reference", "-o", "file"}, 5, "ringlet scene: bounce: "},
    {{"bounce", "--device", "Voodoo 2"}, 1, "--backend reference"},
};

TEST(Scene, MistakesAreOneSentence) {
  const auto folder = scratchFolder("scene_mistakes");
  std::ofstream(folder / "file") << "x";
  for (const auto& c : kMistakes) {
    auto arguments = c.arguments;
    arguments.insert(arguments.begin(), "scene");
    const auto result = runProgram(folder, arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.message;
    EXPECT_EQ(result.out, "") << c.message;
    expectContains(result.err, c.message);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace ringlet::scene_test
