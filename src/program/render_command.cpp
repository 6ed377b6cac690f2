// Implements render_command.h: options to a RenderPlan. Pictures are made in render_run.cpp.
#include "program/render_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>

#include "program/cache_folder.h"
#include "program/command_line.h"
#include "program/exit_codes.h"
#include "program/interruption.h"
#include "program/picture_options.h"
#include "program/render_run.h"
#include "program/run_report.h"
#include "program/simulate_run.h"
#include "program/standard_error.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet::program {
namespace {

constexpr const char* kExample =
    "Examples:\n"
    "  ringlet render out -o pictures                    the run in out/, as pictures/frame.0001.png and so "
    "on\n"
    "  ringlet render out -o shot.png --frames 12:12     one frame\n"
    "  ringlet render head.obj -o head.png               a groom as it is\n"
    "  ringlet render scene.toml -o pictures             simulates it first, into pictures/\n"
    "  ringlet render out -o pictures --hairs 100000 --colour blond --size 1920x1080\n"
    "  ringlet render out -o pictures --orbit 360 --samples 3 --blur 4\n"
    "  ringlet render out -o pictures --scene scene.toml   with the scene's bodies, and its groom at rest\n"
    "\n"
    "Of 100 to 10,000 strands 30,000 hairs are shown that follow them; of fewer, a lock of 300 hairs about "
    "each;\n"
    "of more, the strands themselves.\n"
    "Where roots are on a ball a head is shown; with a scene, its bodies. The camera shows all frames.\n"
    "\n"
    "--json keys: frames strands hairs points width_m size samples seconds_per_frame cpu_seconds_per_frame "
    "(of\n"
    "drawing, without files; but for the first frame, which compiles kernels) start_seconds stages_ms "
    "device\n"
    "driver device_bytes head (one is shown that is no body of a scene) interrupted warnings outputs (the "
    "first\n"
    "and the last).\n"
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage, 130 interrupted; pictures that are finished "
    "stay.";

struct Typed {
  std::filesystem::path input, output, groom, scene;
  std::string frames, size = "960x540", colour = "auburn", up = "Y", device;
  std::optional<int> hairs;
  std::optional<double> width, melanin;
  double redness = 0.3, azimuth = 35, elevation = 5, distance = 1, orbit = 0;
  int samples = 4, blur = 1;
  bool noBodies = false, json = false, quiet = false;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

RenderPlan planOf(const Typed& typed) {
  RenderPlan plan;
  plan.output = typed.output;
  if (const auto range = parsePair(typed.frames, ':'))
    plan.firstFrame = range->first, plan.lastFrame = range->second;
  plan.hairs = typed.hairs;
  plan.width = typed.width;
  const auto size = *parsePair(typed.size, 'x');
  plan.size = {size.first, size.second, typed.samples};
  plan.look = *lookByName(typed.colour);
  if (typed.melanin) {
    // Hairs differ by a fifth of their melanin to either side.
    plan.look.pigments[0] = absorptionOfMelanin(0.8 * *typed.melanin, typed.redness);
    plan.look.pigments[1] = absorptionOfMelanin(std::min(1.2 * *typed.melanin, 1.0), typed.redness);
  }
  plan.camera = {radians(typed.azimuth), radians(typed.elevation), typed.distance};
  plan.orbit = radians(typed.orbit);
  plan.moments = typed.blur;
  plan.showsSolids = !typed.noBodies;
  plan.showProgress = !typed.quiet && !typed.json;
  return plan;
}

void checkOptions(const Typed& typed) {
  const auto range = parsePair(typed.frames, ':');
  if (range && range->first > range->second)
    throw CLI::ValidationError("--frames", "the first frame comes after the last");
  const bool isOne = typed.output.extension() == ".png";
  const bool isGroom = isGroomFile(typed.input) && !holdsAnimation(typed.input);
  if (isOne && !isGroom && !(range && range->first == range->second))
    throw CLI::ValidationError("--output",
                               "is one picture; say which frame, as --frames 12:12, or name a folder");
  if (isSceneFile(typed.input) && (isOne || !typed.scene.empty() || !typed.groom.empty()))
    throw CLI::ValidationError(
        "IN",
        "is a scene, which is simulated into the folder of its pictures: name a folder "
        "with -o, and neither --scene nor --groom");
  if (!isGroom && typed.up != "Y")
    throw CLI::ValidationError("--up", "is of a groom; animations and scenes say it themselves");
  if (isGroom && (!typed.frames.empty() || !typed.groom.empty() || !typed.scene.empty()))
    throw CLI::ValidationError("IN",
                               "is a groom, which has no frames; leave out --frames, --groom and --scene");
  if (!typed.scene.empty() && !typed.groom.empty())
    throw CLI::ValidationError("--groom", "the scene names its groom; say one of --scene and --groom");
}

// The animation in a run's folder, the one that is read fastest first.
Result<std::filesystem::path> animationIn(const std::filesystem::path& input) {
  std::error_code code;
  if (!std::filesystem::is_directory(input, code)) return input;
  for (const char* suffix : {"", ".partial"})
    for (const char* name : {"hair.rgc", "hair.usdc", "hair.usda"}) {
      const auto path = input / (std::string(name) + suffix);
      if (std::filesystem::exists(path, code)) return path;
    }
  return Error{
      fmt::format(
          "{} holds no hair.rgc, hair.usdc or hair.usda; name a folder that `ringlet simulate` wrote, or "
          "an animation, a scene or a groom",
          input.string()),
      Fault::input};
}

// Into the folder of the pictures, as a cache.
Status simulate(const LoadedScene& scene, const SceneFile& file, const Typed& typed,
                const ComputeDevice& device) {
  RunOptions options;
  options.folder = typed.output;
  options.up = file.groom.up == "Z" ? UpAxis::z : UpAxis::y;
  options.writesUsd = options.writesLast = options.writesSheet = false;
  options.cache = CachePrecision::float32;
  options.opened = device;
  options.leftovers = Leftovers::overwrite;
  options.showProgress = !typed.quiet && !typed.json;
  const auto outcome = runLoadedScene(scene, options);
  if (!outcome) return outcome.error();
  for (const std::string& warning : outcome->warnings) say("ringlet render: warning: {}\n", warning);
  return {};
}

Result<RenderOutcome> runScene(const Typed& typed, const ComputeDevice& device, RenderPlan plan) {
  const auto file = readScene(typed.input);
  if (!file) return file.error();
  const auto scene = loadScene(*file);
  if (!scene) return scene.error();
  if (Status done = simulate(*scene, *file, typed, device); !done) return done.error();
  plan.rest = &scene->groom;
  plan.scene = &*scene;
  return renderAnimation(typed.output / "hair.rgc", device, plan);
}

Result<RenderOutcome> runGroom(const Typed& typed, const ComputeDevice& device, const RenderPlan& plan) {
  const auto groom = readGroom(typed.input);
  if (!groom) return groom.error();
  for (const std::string& warning : groom->warnings) say("ringlet render: warning: {}\n", warning);
  RenderPlan one = plan;
  if (one.output.extension() != ".png") one.output /= "frame.0001.png";
  return renderGroom(groom->groom, typed.up == "Z" ? UpAxis::z : UpAxis::y, device, one);
}

Result<RenderOutcome> runAnimation(const Typed& typed, const ComputeDevice& device, RenderPlan plan) {
  const auto animation = animationIn(typed.input);
  if (!animation) return animation.error();
  std::optional<LoadedScene> scene;
  std::optional<LoadedGroom> groom;
  if (!typed.scene.empty()) {
    const auto file = readScene(typed.scene);
    if (!file) return file.error();
    auto loaded = loadScene(*file);
    if (!loaded) return loaded.error();
    scene = std::move(*loaded);
    plan.scene = &*scene;
    plan.rest = &scene->groom;
  } else if (!typed.groom.empty()) {
    auto read = readGroom(typed.groom);
    if (!read) return read.error();
    groom = std::move(*read);
    plan.rest = &groom->groom;
  }
  return renderAnimation(*animation, device, plan);
}

void printOutcome(const Typed& typed, const RenderOutcome& outcome, const ComputeDevice& device) {
  if (typed.json) {
    nlohmann::ordered_json json{{"frames", outcome.frameCount},
                                {"strands", outcome.strandCount},
                                {"hairs", outcome.hairCount},
                                {"points", outcome.pointCount},
                                {"width_m", outcome.width},
                                {"size", typed.size},
                                {"samples", typed.samples},
                                {"seconds_per_frame", outcome.secondsPerFrame},
                                {"cpu_seconds_per_frame", outcome.cpuSecondsPerFrame},
                                {"start_seconds", outcome.startSeconds},
                                {"stages_ms", outcome.stages},
                                {"device", device.name()},
                                {"driver", device.driver()},
                                {"device_bytes", outcome.deviceBytes},
                                {"head", outcome.showsHead},
                                {"interrupted", outcome.interrupted},
                                {"warnings", outcome.warnings},
                                {"outputs", nlohmann::json::array()}};
    for (const auto& path : outcome.outputs) json["outputs"].push_back(path.string());
    printJson(json);
    return;
  }
  if (typed.quiet || outcome.outputs.empty()) return;
  fmt::print("{} picture{} of {} hairs, {:.2f} s each: {}{}\n", outcome.frameCount,
             outcome.frameCount == 1 ? "" : "s", outcome.hairCount, outcome.secondsPerFrame,
             outcome.outputs.front().string(),
             outcome.outputs.size() > 1 ? " to " + outcome.outputs.back().filename().string() : "");
}

int run(const Typed& typed) {
  checkOptions(typed);
  catchInterruption();
  const auto fail = [](const Error& error) {
    say("ringlet render: {}\n", error.message);
    return exitCodeOf(error);
  };
  const auto device = ComputeDevice::open(typed.device, cacheFolder());
  if (!device) return fail(device.error());
  const RenderPlan plan = planOf(typed);
  const bool isGroom = isGroomFile(typed.input) && !holdsAnimation(typed.input);
  const auto outcome = isSceneFile(typed.input) ? runScene(typed, *device, plan)
                       : isGroom                ? runGroom(typed, *device, plan)
                                                : runAnimation(typed, *device, plan);
  if (!outcome) return fail(outcome.error());
  for (const std::string& warning : outcome->warnings) say("ringlet render: warning: {}\n", warning);
  for (const std::string& message : device->validationMessages())
    say("ringlet render: warning: {}\n", message);
  printOutcome(typed, *outcome, *device);
  return outcome->interrupted ? kExitInterrupted : kExitFine;
}

}  // namespace

void addRenderCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<Typed>();
  CLI::App* command =
      app.add_subcommand("render", "Draws pictures of a run, an animation, a scene or a groom");
  command->footer(kExample);
  command
      ->add_option(
          "IN", typed->input,
          "A folder that simulate wrote, an animation (.rgc, .usdc, .usda), a scene (.toml) or a groom")
      ->required()
      ->type_name("PATH");
  command->add_option("-o,--output", typed->output, "Folder for frame.0001.png and so on, or one .png")
      ->required()
      ->type_name("PATH");
  command->add_option("--frames", typed->frames, "First and last frame, from 1 (default: all)")
      ->check(isPair(':', 1, 1'000'000'000, "1:24"))
      ->type_name("A:B");
  command
      ->add_option("--hairs", typed->hairs,
                   "Hairs that follow the strands; 0: the strands themselves (default: see below)")
      ->check(wholeBetween(0, 10'000'000))
      ->type_name("N");
  command->add_option("--groom", typed->groom, "The strands at rest, where IN does not begin so; for --hairs")
      ->type_name("FILE");
  command
      ->add_option("--scene", typed->scene,
                   "The scene that IN was simulated from: its bodies, and its groom at rest")
      ->type_name("FILE");
  command
      ->add_option("--width", typed->width,
                   "Diameter of hairs at the root, metres (default: by their number)")
      ->check(between(1e-7, 0.1))
      ->type_name("METRES");
  command->add_option("--size", typed->size, "Width and height of pictures, pixels")
      ->check(isPair('x', 1, 16384, "960x540"))
      ->capture_default_str()
      ->type_name("WxH");
  addSamplesOption(*command, typed->samples);
  command
      ->add_option("--blur", typed->blur,
                   "Moments of each frame that are shown together: motion blur; 1 is none")
      ->check(wholeBetween(1, 64))
      ->capture_default_str()
      ->type_name("N");
  addColourOption(*command, typed->colour);
  command->add_option("--melanin", typed->melanin, "In place of --colour: from 0, white, to 1, black")
      ->check(between(0, 1))
      ->type_name("SHARE");
  command->add_option("--redness", typed->redness, "Share of the melanin that is red")
      ->check(between(0, 1))
      ->capture_default_str()
      ->type_name("SHARE");
  command
      ->add_option("--azimuth", typed->azimuth,
                   "Camera about the up axis, from the front to the right, degrees")
      ->check(between(-3600, 3600))
      ->capture_default_str()
      ->type_name("DEG");
  command->add_option("--elevation", typed->elevation, "Camera above the hair, degrees")
      ->check(between(-89, 89))
      ->capture_default_str()
      ->type_name("DEG");
  command->add_option("--distance", typed->distance, "Of the camera, over the one that shows all hair")
      ->check(between(0.05, 100))
      ->capture_default_str()
      ->type_name("FACTOR");
  command
      ->add_option("--orbit", typed->orbit,
                   "The camera goes round by so much from the first frame to the last, degrees")
      ->check(between(-36000, 36000))
      ->capture_default_str()
      ->type_name("DEG");
  command->add_option("--up", typed->up, "Of a groom: the axis that points up, Y or Z")
      ->check(oneOf({"Y", "Z"}))
      ->capture_default_str()
      ->type_name("AXIS");
  command->add_flag("--no-bodies", typed->noBodies, "Hair alone: no bodies and no head");
  addDeviceOption(*command, typed->device);
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary");
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
