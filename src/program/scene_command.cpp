// Implements scene_command.h: options to a BuiltinScene, which is stepped as `ringlet simulate` steps and
// measured as `ringlet measure` measures.
#include "program/scene_command.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "program/command_line.h"
#include "program/exit_codes.h"
#include "program/measure_command.h"
#include "program/run_report.h"
#include "program/simulate_run.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/scenes/builtin_scene.h"

namespace ringlet::program {
namespace {

constexpr const char* kExample =
    "Examples:\n"
    "  ringlet scene --list\n"
    "  ringlet scene hanging_curl --preload 0 --particles 128\n"
    "  ringlet scene walk_cycle --frames-on raw --json -o out\n"
    "\n"
    "Every frame is measured, the groom at rest counting as the one before the first. --json prints the keys "
    "of\n"
    "`simulate` and of `measure` together; max_edge_stretch is that of every step. Beside them: scene, "
    "preload, "
    "core,\n"
    "frames_on, seconds, velocity_residual (of the velocity solve, worst strand and step; null where it is "
    "not "
    "measured:\n"
    "paper, reference). DIR receives groom.obj, hair.usda, last.obj and sheet.png, in centimetres, Y up.\n"
    "\n"
    "Exit status: as for simulate.";

// The command line as typed.
struct Typed {
  std::string name;
  SceneOptions scene;
  RunOptions run;
  RunNames names{.material = "scene"};
  std::string core = "on", framesOn = "smoothed";
  bool list = false, json = false, quiet = false;
};

void printList() {
  for (const std::string& name : sceneNames()) fmt::print("{:<14}{}\n", name, sceneSummary(name));
}

std::string orDash(std::optional<double> value, const char* unit) {
  return value ? fmt::format("{:.3g} {}", *value, unit) : "-";
}

std::string measureText(const CurlNumbers& numbers, std::optional<double> residual) {
  std::string text = fmt::format("  droop         {:.4f} mm at the end, {:.4f} mm at the worst frame\n",
                                 1000 * numbers.droop, 1000 * numbers.worstDroop);
  text += fmt::format("  core          {:.4f} x its length at rest, {:.4f} x at the worst frame\n",
                      numbers.coreElongation, numbers.worstCoreElongation);
  text += fmt::format("  curl          {:.3f} turns of radius {:.3f} mm, hand {}, arc drift {:.2e}\n",
                      numbers.turns, 1000 * numbers.meanRadius, numbers.handednessKept ? "kept" : "not kept",
                      numbers.arcDrift);
  text += fmt::format("  tip           turned by {:.2f} degrees, {:.2f} at the worst frame\n",
                      numbers.tipRotation, numbers.worstTipRotation);
  text += fmt::format("  bounce        {}, settled after {}, energy left of its peak {}\n",
                      orDash(numbers.bounceHz, "Hz"), orDash(numbers.settleSeconds, "s"),
                      orDash(numbers.energyRatio, ""));
  if (residual) text += fmt::format("  residual      {:.2e} of the velocity solve\n", *residual);
  return text;
}

Error inScene(const Typed& typed, const Error& cause) {
  return Error{fmt::format("{}: {}", typed.name, cause.message)};
}

// The groom at rest beside the animation, so that `ringlet measure DIR/groom.obj DIR` works.
Status writeGroom(const BuiltinScene& scene, const RunOptions& options, SimulateOutcome& outcome) {
  if (outcome.outputs.empty()) return {};
  const std::filesystem::path path = options.folder / "groom.obj";
  if (Status written = writeObj(path, scene.groom, scene.groom.points); !written) return written;
  outcome.outputs.push_back(path);
  return {};
}

Result<int> runScene(Typed& typed) {
  auto scene = makeScene(typed.name, typed.scene);
  if (!scene) return scene.error();
  RunOptions& options = typed.run;
  options.frameCount = scene->frameCount();
  const Settings& settings = scene->settings;
  const bool hasResidual = settings.integrator != Integrator::paper && !options.onReference;
  options.kernel.residual = hasResidual;

  // Measured from the groom itself on.
  const double unit = scene->groom.metresPerUnit;
  auto measure = MotionMeasure::make(scene->groom, {.framesPerSecond = settings.framesPerSecond,
                                                    .lineDensity = scene->material.lineDensity});
  if (!measure) return inScene(typed, measure.error());
  const auto look = [&](std::span<const Vec3f> points, const HeadPose& head) {
    return measure->addFrame(points, unit, head.rotation);
  };
  if (Status seen = look(scene->groom.points, scene->motion.poseAt(0)); !seen)
    return inScene(typed, seen.error());
  auto outcome = runHair({scene->groom, scene->material, settings, scene->motion}, options, look);
  if (!outcome) return inScene(typed, outcome.error());
  if (Status written = writeGroom(*scene, options, *outcome); !written)
    return inScene(typed, written.error());

  const CurlNumbers numbers = curlNumbers(measure->ruler(), measure->report());
  std::optional<double> residual;
  if (hasResidual) residual = outcome->report.velocityResidual;
  const int exitCode = tellTroubles("scene", *outcome, options.frameCount);
  if (typed.json) {
    nlohmann::ordered_json json{{"scene", scene->name},
                                {"seconds", outcome->frameCount / settings.framesPerSecond},
                                {"preload", settings.gravityPreload},
                                {"core", typed.scene.core},
                                {"frames_on", typed.framesOn}};
    json.update(runJson(typed.names, settings, *outcome));
    // Where both know a number, the run's is that of every step.
    nlohmann::ordered_json curl;
    addCurlKeys(curl, numbers);
    curl.erase("max_edge_stretch");
    json.update(curl);
    json["velocity_residual"] = residual ? nlohmann::ordered_json(*residual) : nlohmann::ordered_json();
    printJson(json);
  } else if (!typed.quiet) {
    fmt::print("{}: {}\n{}{}", scene->name, scene->summary, runText(typed.names, settings, *outcome),
               measureText(numbers, residual));
  }
  return exitCode;
}

int run(Typed& typed) {
  if (typed.list) {
    printList();
    return kExitFine;
  }
  auto exitCode = runScene(typed);
  if (exitCode) return *exitCode;
  fmt::print(stderr, "ringlet scene: {}\n", exitCode.error().message);
  return kExitFailed;
}

// What one option means for another. Throws CLI11's error for what makes no sense together.
void resolve(Typed& typed) {
  if (typed.list) return;
  if (typed.name.empty()) throw CLI::RequiredError("NAME (or --list)");
  typed.scene.core = typed.core == "on";
  typed.scene.smoothedFrames = typed.framesOn == "smoothed";
  typed.scene.integrator = integratorByName(typed.names.integrator);
  typed.run.onReference = typed.names.backend == "reference";
  if (typed.run.onReference && !typed.run.device.empty())
    throw CLI::ValidationError("--device", "only --backend gpu has a device");
  typed.run.showProgress = !typed.quiet;
}

}  // namespace

void addSceneCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<Typed>();
  CLI::App* command =
      app.add_subcommand("scene", "Runs a built-in scene and measures what becomes of its hair");
  command->footer(kExample);
  command->add_option("NAME", typed->name, "The scene; see --list")
      ->check(oneOf(sceneNames()))
      ->type_name("NAME");
  command->add_flag("--list", typed->list, "Print the scenes and what each shows");
  command->add_option("-o,--output", typed->run.folder, "Folder for the animation (default: none is written)")
      ->type_name("DIR");

  const char* hair = "Hair";
  command->add_option("--particles", typed->scene.particles, "Particles of each strand (default 64)")
      ->check(wholeBetween(2, 65536))
      ->type_name("N")
      ->group(hair);
  command->add_option("--strands", typed->scene.strands, "Strands side by side (default 1; release 32)")
      ->check(wholeBetween(1, 100'000))
      ->type_name("N")
      ->group(hair);
  command
      ->add_option("--preload", typed->scene.preload,
                   "Share of gravity balanced in the rest pose, 0 to 1 (default: the scene's; 0 for paper)")
      ->check(between(0, 1))
      ->type_name("P")
      ->group(hair);
  command->add_option("--core", typed->core, "Core spring on or off (default on)")
      ->check(oneOf({"on", "off"}))
      ->type_name("STATE")
      ->group(hair);
  command
      ->add_option("--frames-on", typed->framesOn,
                   "Strand frames on the smoothed or the raw strand (default smoothed)")
      ->check(oneOf({"smoothed", "raw"}))
      ->type_name("WHICH")
      ->group(hair);

  const char* solver = "Solver";
  command
      ->add_option("--integrator", typed->names.integrator, "jacobi, point_jacobi or paper (default jacobi)")
      ->check(oneOf(integratorNames()))
      ->type_name("NAME")
      ->group(solver);
  command
      ->add_option("--steps-per-frame", typed->scene.stepsPerFrame,
                   "Outer steps a frame of 1/24 s (default 8; 30 for paper)")
      ->check(wholeBetween(1, 10'000))
      ->type_name("N")
      ->group(solver);
  command->add_option("--seconds", typed->scene.seconds, "Length of the scene (default: its own)")
      ->check(between(0.001, 36'000))
      ->type_name("S")
      ->group(solver);
  command
      ->add_option("--backend", typed->names.backend,
                   "gpu (Vulkan) or reference (CPU, double precision) (default gpu)")
      ->check(oneOf({"gpu", "reference"}))
      ->type_name("NAME")
      ->group(solver);
  command
      ->add_option("--device", typed->run.device,
                   "Vulkan device, by index or part of its name; see `ringlet devices`")
      ->type_name("D")
      ->group(solver);

  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary");
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary");

  command->callback([typed, &exitCode] {
    resolve(*typed);
    exitCode = run(*typed);
  });
}

}  // namespace ringlet::program
