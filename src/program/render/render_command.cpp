// Implements render_command.h: what a RenderPlan needs is read, and what came of it is said. Pictures are
// made in pictures/render_animation.cpp.
#include "program/render/render_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/interruption.h"
#include "program/cli/keys_help.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/device/open_device.h"
#include "program/render/picture_run.h"
#include "program/render/render_options.h"
#include "program/render/render_report.h"
#include "program/simulate/simulate_run.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/groom_doubts.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/pictures/render_animation.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_camera.h"

namespace ringlet::program {
namespace {

constexpr const char* kRenderExample =
    "Examples:\n"
    "  ringlet render out -o pictures                    the run in out/, as pictures/frame.0001.png and so "
    "on\n"
    "  ringlet render out -o shot.png --frames 12:12     one frame\n"
    "  ringlet render head.obj -o head.png               a groom as it is\n"
    "  ringlet render scene.toml -o pictures             simulates it first, into pictures/\n"
    "  ringlet render out -o pictures --hairs 100000 --colour blond --size 1920x1080\n"
    "  ringlet render out -o pictures --orbit 360 --samples 3 --blur 4\n"
    "  ringlet render out -o pictures --scene scene.toml   with the scene's bodies, and its groom at rest\n"
    "  ringlet render out -o film.mp4                    a film (needs ffmpeg)\n"
    "  ringlet render out -o pictures --format exr --scene scene.toml --camera close\n"
    "  ringlet render out -o pictures --colour stretch --ground\n"
    "\n"
    "Of 100 to 10,000 strands 30,000 hairs are shown that follow them; of fewer, a lock of 300 hairs about "
    "each;\n"
    "of more, the strands themselves.\n"
    "Where roots are on a ball a head is shown; with a scene, its bodies. The camera shows all frames.\n"
    "\n"
    "Colours that show a number of each strand, from blue by green and yellow to red:\n"
    "  stretch    by how much its longest edge is longer than at rest: 0 to 5 %\n"
    "  contacts   how deep it is in others beyond rest, over the sum of the radii: 0 to 100 %\n"
    "  error      how far its farthest particle is from where it is in the run --against: 0 to 10 mm\n"
    "--most says another end. With strand each strand has a colour of its own.\n"
    "\n";
constexpr const char* kRenderExitHelp =
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage, 130 interrupted; pictures that are finished "
    "stay.";

// The animation in a run's folder, the one that is read fastest first.
Result<std::filesystem::path> animationOf(const std::filesystem::path& input) {
  std::error_code code;
  if (!std::filesystem::is_directory(input, code)) return input;
  for (const char* suffix : {"", ".partial"})
    for (const char* name : {"hair.rgc", "hair.usdc", "hair.abc", "hair.usda"}) {
      const auto path = input / (std::string(name) + suffix);
      if (std::filesystem::exists(path, code)) return path;
    }
  return Error{
      fmt::format(
          "{} holds no hair.rgc, hair.usdc, hair.abc or hair.usda; name a folder that `ringlet simulate` wrote, or an "
          "animation, a scene or a groom",
          input.string()),
      Fault::input};
}

// The scene's of that name, if one is asked for.
Status setCamera(RenderPlan& plan, const SceneFile& scene, const std::string& name) {
  if (name.empty()) return {};
  auto camera = loadCamera(scene, name);
  if (!camera) return camera.error();
  plan.camera.ofScene = std::move(*camera);
  return {};
}

// Into the folder of the pictures, as a cache.
Status simulate(const LoadedScene& scene, const SceneFile& file, const RenderOptions& typed,
                const ComputeDevice& device) {
  // A cache in it may be that of an earlier picture; of a run's other files none is written here.
  for (const char* name : {"hair.usda", "hair.usdc", "hair.abc", "last.obj", "sheet.png", "checkpoint.rgk"}) {
    std::error_code code;
    if (!std::filesystem::exists(typed.output / name, code)) continue;
    return Error{
        fmt::format(
            "{} holds a run's {}, beside which the pictures' own run would be written; choose another folder "
            "with -o",
            typed.output.string(), name),
        Fault::output};
  }
  SimulateOptions options;
  options.folder = typed.output;
  options.up = file.groom.up == "Z" ? UpAxis::z : UpAxis::y;
  options.animations.clear();
  options.writesLast = options.writesSheet = false;
  options.cache = CachePrecision::float32;
  options.opened = device;
  options.leftovers = Leftovers::overwrite;
  options.showProgress = !typed.quiet && !typed.json;
  const auto outcome = simulate(scene, options);
  if (!outcome) return outcome.error();
  for (const std::string& warning : outcome->warnings) say("ringlet render: warning: {}\n", warning);
  return {};
}

Result<RenderOutcome> runScene(const RenderOptions& typed, const ComputeDevice& device, RenderPlan plan) {
  const auto file = readTypedScene(typed.input, typed.keys, typed.reach);
  if (!file) return file.error();
  const auto scene = loadScene(*file);
  if (!scene) return scene.error();
  if (Status set = setCamera(plan, *file, typed.camera); !set) return set.error();
  if (Status done = simulate(*scene, *file, typed, device); !done) return done.error();
  plan.rest = &scene->groom;
  plan.scene = &*scene;
  return drawAnimation(typed.output / "hair.rgc", device, std::move(plan), !typed.quiet && !typed.json);
}

Result<RenderOutcome> runGroom(const RenderOptions& typed, const ComputeDevice& device,
                               const RenderPlan& plan) {
  auto groom = readGroom(typed.input, readingOf(typed.keys, typed.up == "Z"));
  if (!groom) return groom.error();
  if (typed.metresPerUnit) groom->groom.metresPerUnit = *typed.metresPerUnit;
  if (auto doubt = groom->statesUp ? std::nullopt : doubtOfUp(groom->groom, typed.up == "Z"))
    groom->warnings.push_back(std::move(*doubt));
  for (const std::string& warning : groom->warnings) say("ringlet render: warning: {}\n", warning);
  return renderGroom(groom->groom, typed.up == "Z" ? UpAxis::z : UpAxis::y, device, plan);
}

Result<RenderOutcome> runAnimation(const RenderOptions& typed, const ComputeDevice& device, RenderPlan plan) {
  const auto animation = animationOf(typed.input);
  if (!animation) return animation.error();
  if (plan.colours && !typed.against.empty()) {
    const auto against = animationOf(typed.against);
    if (!against) return against.error();
    plan.colours->against = *against;
  }
  std::optional<LoadedScene> scene;
  std::optional<LoadedGroom> groom;
  if (!typed.scene.empty()) {
    const auto file = readTypedScene(typed.scene, typed.keys, typed.reach);
    if (!file) return file.error();
    auto loaded = loadScene(*file);
    if (!loaded) return loaded.error();
    if (Status set = setCamera(plan, *file, typed.camera); !set) return set.error();
    scene = std::move(*loaded);
    plan.scene = &*scene;
    plan.rest = &scene->groom;
  } else if (!typed.groom.empty()) {
    auto read = readGroom(typed.groom, readingOf(typed.keys));
    if (!read) return read.error();
    groom = std::move(*read);
    plan.rest = &groom->groom;
  }
  return drawAnimation(*animation, device, std::move(plan), !typed.quiet && !typed.json);
}

void printOutcome(const RenderOptions& typed, const RenderPlan& plan, const RenderOutcome& outcome,
                  const ComputeDevice& device) {
  if (typed.json) {
    printJson(renderJson({typed, plan, outcome, device.name(), device.driver()}));
    return;
  }
  if (typed.quiet || outcome.outputs.empty()) return;
  print("{} picture{} of {} hairs, {:.2f} s each: {}{}\n", outcome.frameCount,
        outcome.frameCount == 1 ? "" : "s", outcome.hairCount, outcome.secondsPerFrame,
        outcome.outputs.front().string(),
        outcome.outputs.size() > 1 ? " to " + outcome.outputs.back().filename().string() : "");
  if (plan.colours) print("colours: {}\n", plan.colours->scale->sentence(plan.colours->most));
}

int run(RenderOptions typed) {
  std::error_code code;
  if (!std::filesystem::exists(typed.input, code) && !isSequence(typed.input))
    return fail("render",
                {fmt::format("{}: there is no such file or folder", typed.input.string()), Fault::input});
  typed.isGroom = isGroomFile(typed.input) && !holdsAnimation(typed.input);
  checkRenderOptions(typed);
  catchInterruption();
  if (isFilm(typed.output)) {
    if (Status can = checkFilms(); !can) return fail("render", can.error());
  }
  const auto device = openDevice(typed.device);
  if (!device) return fail("render", device.error());
  const RenderPlan plan = renderPlanOf(typed);
  const auto outcome = isSceneFile(typed.input) ? runScene(typed, *device, plan)
                       : typed.isGroom          ? runGroom(typed, *device, plan)
                                                : runAnimation(typed, *device, plan);
  if (!outcome) return fail("render", outcome.error());
  for (const std::string& warning : outcome->warnings) say("ringlet render: warning: {}\n", warning);
  for (const std::string& message : device->validationMessages())
    say("ringlet render: warning: {}\n", message);
  printOutcome(typed, plan, *outcome, *device);
  return outcome->interrupted ? kExitInterrupted : kExitFine;
}

}  // namespace

void addRenderCommand(CLI::App& app, int& exitCode) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "Draws pictures of a run, an animation, a scene or a groom");
  command->footer(kRenderExample + keysHelp(renderKeys()) + kRenderExitHelp);
  addRenderOptions(*command, *options);
  command->callback([options, &exitCode] { exitCode = run(*options); });
}

}  // namespace ringlet::program
