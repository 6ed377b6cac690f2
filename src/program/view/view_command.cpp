// Implements view_command.h: turns options into a ViewPlan. The window is in src/view.
#include "program/view/view_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/cli/cache_folder.h"
#include "program/cli/command_line.h"
#include "program/cli/confined_option.h"
#include "program/cli/exit_codes.h"
#include "program/cli/interruption.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/render/picture_options.h"
#include "program/simulate/run_report.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/pictures/follow_plan.h"
#include "ringlet/pictures/picture_solids.h"
#include "ringlet/render/look.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/cut_list.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "view/viewer.h"

namespace ringlet::program {
namespace {

constexpr const char* kViewExample =
    "Examples:\n"
    "  ringlet view head.obj                              hair that hangs on a head\n"
    "  ringlet view scene.toml --hairs 3000               hairs that follow the scene's strands\n"
    "  ringlet view head.obj --set motion.kind=shake --set contacts.on=true\n"
    "  ringlet view scene.toml --save tuned.toml          where Ctrl+S writes the numbers that were changed\n"
    "  xvfb-run -a ringlet view head.obj --frames 100 --json    how fast it is, without a screen\n"
    "\n"
    "Mouse: left drag turns the camera, right or middle drag moves it, the wheel goes nearer. Ctrl + left "
    "drag\n"
    "moves the head, or the body under the mouse; Ctrl + right drag turns it.\n"
    "Keys: Space plays and pauses, . steps, R resets, Ctrl+Z and Ctrl+Y undo and redo, Ctrl+S saves, F12 "
    "takes a\n"
    "picture, H puts the camera back, Tab hides the panel, W switches the air; B bodies, G guides, S "
    "stretch,\n"
    "C contacts, F frames; Ctrl+Q ends.\n"
    "\n"
    "--json keys: frames seconds frames_per_second cpu_ms_per_frame stages_ms (but for the first frame, "
    "which\n"
    "compiles kernels) scene_frames strands hairs size samples device driver device_bytes interrupted "
    "warnings\n"
    "outputs.\n"
    "\n"
    "Exit status: 0 done, 1 something failed (as where there is no display), 2 wrong usage, 4 input that "
    "cannot be\n"
    "read, 130 interrupted.";

struct TypedView {
  std::filesystem::path input, save, pictures, widgets;
  SceneReach reach = SceneReach::anywhere;
  std::string size = "640x480", colour = "auburn", device;
  int frames = 0, samples = 2, hairs = 0;
  TypedKeys keys;
  bool paused = false, json = false;
};

#ifdef RINGLET_HAS_WINDOW

// Adds the bodies of the scene, or else a head if roots lie on a ball.
void addSolids(const LoadedScene& scene, Vec3d up, view::ViewPlan& plan) {
  const Groom& groom = scene.groom;
  Vec3d low{1e9, 1e9, 1e9}, high = low * -1.0;
  const std::vector<Vec3d> roots = rootPlaces(groom);
  for (const Vec3f& point : groom.points) {
    const Vec3d p = Vec3d(point) * groom.metresPerUnit;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const PictureSolids solids = scene.bodies.empty() ? PictureSolids::ofRoots(roots, up)
                                                    : PictureSolids::ofScene(scene, length(high - low));
  plan.look.solids = solids.meshes();
  for (const std::size_t body : solids.bodies()) plan.solids.push_back({body, {}});
  if (scene.bodies.empty())
    for (const SolidPlace& place : solids.placesAt(0, roots, Quatd{}))
      plan.solids.push_back({std::nullopt, place});
}

Status addHairs(const LoadedScene& scene, int hairs, const HairLook& look, view::ViewPlan& plan) {
  const double lastCut = scene.cuts.empty() ? 0 : scene.cuts.back().seconds;
  const int frames = static_cast<int>(std::ceil(lastCut * scene.settings.framesPerSecond)) + 1;
  auto follow = FollowPlan::ofScene(scene, hairs, look, CutList(SceneFrames(scene), frames));
  if (!follow) return follow.error();
  const auto count = static_cast<double>(*follow ? (*follow)->hairs().size() : scene.groom.strandCount());
  plan.look.width = std::min(widthOfHairs(count), view::kMostStrandWidth);
  if (!*follow) return {};
  plan.look.follow = std::make_shared<const FollowPlan>(std::move(**follow));
  plan.look.bodies = scene.bodies;
  return {};
}

Result<view::ViewOutcome> runScene(const TypedView& typed, const SceneFile& file, LoadedScene& scene) {
  view::ViewPlan plan;
  plan.file = &file;
  plan.scene = &scene;
  plan.up = upOf(file.groom);
  addSolids(scene, plan.up, plan);
  if (Status added = addHairs(scene, typed.hairs, hairLookOf(typed.keys), plan); !added) return added.error();
  const auto [width, height] = *parsePair(typed.size, 'x');
  // Coarse volumes of light, enough for a preview.
  plan.look.size = {.width = width,
                    .height = height,
                    .side = typed.samples,
                    .shadowCells = 64,
                    .shadowSlices = 32,
                    .densityCells = 16,
                    .isPreview = true};
  plan.look.look = *lookByName(typed.colour);
  plan.device = typed.device;
  plan.cacheFolder = cacheFolder();
  plan.frameCount = typed.frames;
  plan.startsPaused = typed.paused;
  plan.saveTo = typed.save;
  plan.pictures = typed.pictures;
  plan.widgets = typed.widgets;
  plan.wasInterrupted = wasInterrupted;
  return view::runView(plan);
}

void printOutcome(const TypedView& typed, const LoadedScene& scene, const view::ViewOutcome& outcome) {
  if (!typed.json) return;
  const double frames = std::max(1.0, static_cast<double>(outcome.frameCount) - 1);
  nlohmann::ordered_json json{{"frames", outcome.frameCount},
                              {"seconds", outcome.seconds},
                              {"frames_per_second", outcome.seconds > 0 ? frames / outcome.seconds : 0},
                              {"cpu_ms_per_frame", 1000 * outcome.cpuSeconds / frames},
                              {"stages_ms", nlohmann::ordered_json::object()},
                              {"scene_frames", outcome.sceneFrames},
                              {"strands", scene.groom.strandCount()},
                              {"hairs", typed.hairs},
                              {"size", typed.size},
                              {"samples", typed.samples},
                              {"device", outcome.device},
                              {"driver", outcome.driver},
                              {"device_bytes", outcome.deviceBytes},
                              {"interrupted", wasInterrupted()},
                              {"warnings", outcome.warnings},
                              {"outputs", nlohmann::json::array()}};
  for (const auto& [stage, milliseconds] : outcome.stages) json["stages_ms"][stage] = milliseconds;
  for (const auto& path : outcome.outputs) json["outputs"].push_back(path.string());
  printJson(json);
}

int run(TypedView typed) {
  catchInterruption();
  const auto file = readTyped(typed.input, typed.keys, typed.reach, "still");
  if (!file) return fail("view", file.error());
  auto scene = loadScene(*file);
  if (!scene) return fail("view", scene.error());
  for (const std::string& warning : scene->warnings) say("ringlet view: warning: {}\n", warning);
  if (typed.save.empty()) typed.save = typed.input.stem().string() + ".view.toml";
  const auto outcome = runScene(typed, *file, *scene);
  if (!outcome) return fail("view", outcome.error());
  for (const std::string& warning : outcome->warnings) say("ringlet view: warning: {}\n", warning);
  for (const std::string& message : outcome->validationMessages) say("ringlet view: warning: {}\n", message);
  printOutcome(typed, *scene, *outcome);
  return wasInterrupted() ? kExitInterrupted : kExitFine;
}

#else

int run(const TypedView& typed) {
  // Checks the input even though there is no window.
  if (const auto file = readTyped(typed.input, typed.keys, typed.reach, "still"); !file)
    return fail("view", file.error());
  const std::string missing = RINGLET_VIEW_MISSING;
  say("ringlet view: this program was built without a window: {}; `ringlet render` makes pictures without "
      "one\n",
      missing.empty() ? std::string("with -DRINGLET_BUILD_VIEW=OFF")
                      : fmt::format("install {} (Debian) and build it again", missing));
  return kExitFailed;
}

#endif

}  // namespace

void addViewCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedView>();
  CLI::App* command =
      app.add_subcommand("view", "Opens a window in which hair moves while its numbers change");
  command->footer(kViewExample);
  command->add_option("IN", typed->input, "A scene (.toml) or a groom")->required()->type_name("PATH");
  addSetOption(*command, typed->keys);
  addOptionsOfKeys(*command, typed->keys,
                   {"groom.unit", "groom.up", "groom.root_end", "groom.points_per_strand", "groom.guides",
                    "groom.guides_file", "groom.guides_primvar", "start.from", "start.frame", "start.blend"});
  addConfinedOption(*command, typed->reach);
  addHairLookOptions(*command, typed->keys);
  command->add_option("--hairs", typed->hairs, "Hairs that follow the strands; 0: the strands themselves")
      ->check(wholeBetween(0, 10'000'000))
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--size", typed->size, "Width and height of the picture, pixels; the panel is beside it")
      ->check(isPair('x', 64, 8192, "640x480"))
      ->capture_default_str()
      ->type_name("WxH");
  addSamplesOption(*command, typed->samples);
  addColourOption(*command, typed->colour);
  command->add_option("--save", typed->save, "Where Ctrl+S writes the scene (default: IN's name, .view.toml)")
      ->check(endsIn({".toml"}))
      ->type_name("FILE");
  command
      ->add_option("--screenshots", typed->pictures,
                   "Folder for the pictures of F12, and for one of the last of --frames (default: this one)")
      ->type_name("FOLDER");
  command
      ->add_option("--frames", typed->frames,
                   "Frames after which it ends, shown as fast as they come (default: when it is closed)")
      ->check(wholeBetween(1, 1'000'000'000))
      ->type_name("N");
  command->add_flag("--paused", typed->paused, "Begin with hair at rest, not stepped");
  command
      ->add_option("--widgets", typed->widgets,
                   "A JSON file that tells every frame where the widgets are, for scripts")
      ->type_name("FILE");
  addDeviceOption(*command, typed->device);
  command->add_flag("--json", typed->json, "Print one JSON object at the end");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
