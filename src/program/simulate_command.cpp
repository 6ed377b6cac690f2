// Implements simulate_command.h: options to SimulateOptions. The run is simulate_run.cpp, what is said of it
// run_report.cpp.
#include "program/simulate_command.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "program/command_line.h"
#include "program/contact_options.h"
#include "program/exit_codes.h"
#include "program/material_command.h"
#include "program/run_report.h"
#include "program/simulate_run.h"

namespace ringlet::program {
namespace {

constexpr int kMostFrames = 1'000'000;  // eleven hours at 24 a second; more is a slip of the finger
constexpr const char* kExample =
    "Examples:\n"
    "  ringlet make head -o head.obj && ringlet simulate head.obj --motion shake --frames 48 -o out\n"
    "  ringlet simulate head.obj --contacts on --measure-contacts --prune 12 --json -o out\n"
    "  ringlet simulate head.obj --motion walk.bvh --skip-frames 1 -o out\n"
    "\n"
    "Writes into DIR: hair.usda (time-sampled BasisCurves, frame k at time code k), last.obj (the last "
    "frame, in the\n"
    "groom's order and unit), sheet.png (six frames side by side). Ctrl-C stops after the current frame and "
    "keeps what\n"
    "is finished; until a run ends its animation is hair.usda.partial, which is valid at all times.\n"
    "\n"
    "--json keys: frames strands particles ms_per_frame (wall time of stepping alone, without reading back "
    "and writing)\n"
    "stages_ms (per frame, by stage) max_edge_stretch limited_share nonfinite velocity_residual (of the "
    "velocity solve,\n"
    "worst strand and step; measuring it takes a few per cent of the step's time; null for paper, with "
    "contacts\n"
    "and for reference) device driver kernel backend positions_hash integrator material steps_per_frame fps\n"
    "interrupted warnings outputs.\n";
constexpr const char* kExitHelp =
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage, 3 done but some particles have no position, 130 "
    "Ctrl-C.";

// The command line as typed; names become values in resolve().
struct Typed {
  SimulateOptions options;
  std::string integrator = "jacobi", motion = "shake", up = "Y", backend = "gpu", kernel = "auto";
  std::optional<int> stepsPerFrame;
  std::optional<int> frameCount;
  std::optional<double> preload, amplitude, frequency;
  MotionFileChoice motionFile;
  bool motionFileGiven = false;  // any of its options
  double gravity = 9.81;
  ContactChoice contacts;
  bool noChebyshev = false, json = false, quiet = false;
  bool iterationsGiven = false;
};

// What one option means for another. Throws CLI11's error for what makes no sense together.
void resolve(Typed& typed) {
  SimulateOptions& options = typed.options;
  Settings& settings = options.settings;
  options.up = typed.up == "Z" ? UpAxis::z : UpAxis::y;
  const Vec3d up = options.up == UpAxis::z ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  settings.gravity = up * -typed.gravity;
  if (const MotionFileKind kind = motionFileKind(typed.motion); kind != MotionFileKind::none) {
    if (typed.amplitude || typed.frequency)
      throw CLI::ValidationError(typed.amplitude ? "--amplitude" : "--frequency",
                                 "a motion from a file has its own");
    if (kind == MotionFileKind::gltf && typed.motionFile.skippedFrames > 0)
      throw CLI::ValidationError("--skip-frames",
                                 "a glTF animation has times and no frames; cut it where it is made");
    if (kind == MotionFileKind::bvh && !typed.motionFile.animation.empty())
      throw CLI::ValidationError("--animation", "a .bvh file has only one");
    options.motionFile = typed.motionFile;
    options.motionFile->path = typed.motion;
    options.choosesFrames = !typed.frameCount;
  } else {
    if (typed.motionFileGiven)
      throw CLI::ValidationError(
          "--motion",
          "only a .bvh, .gltf or .glb file has a --joint, --motion-unit, --skip-frames and "
          "--animation");
    options.motion = motionByName(typed.motion, up).value();
    options.motion.amplitude = typed.amplitude.value_or(options.motion.amplitude);
    options.motion.frequency = typed.frequency.value_or(options.motion.frequency);
  }
  options.frameCount = typed.frameCount.value_or(options.frameCount);

  // The paper's own scheme is explicit: it needs short steps, and knows no preload.
  const bool isPaper = typed.integrator == "paper", isPoint = typed.integrator == "point_jacobi";
  settings.integrator = integratorByName(typed.integrator);
  options.choosesSteps = !typed.stepsPerFrame;
  settings.stepsPerFrame = typed.stepsPerFrame.value_or(1);
  settings.gravityPreload = typed.preload.value_or(isPaper ? 0 : 1);
  settings.chebyshev = !typed.noChebyshev;
  if (!isPoint && (typed.iterationsGiven || typed.noChebyshev)) {
    throw CLI::ValidationError(typed.noChebyshev ? "--no-chebyshev" : "--iterations",
                               "only --integrator point_jacobi has iterations");
  }
  checkMaterialOptions(options.material, settings.integrator);
  checkContactOptions(typed.contacts);
  applyContactOptions(typed.contacts, settings.contacts);
  if (!settings.contacts.on && !options.measuresContacts)
    refuseContactOptions(typed.contacts, "only with --contacts on or --measure-contacts");

  options.onReference = typed.backend == "reference";
  if (options.onReference && (!options.device.empty() || typed.kernel != "auto")) {
    throw CLI::ValidationError(typed.kernel != "auto" ? "--kernel" : "--device",
                               "only --backend gpu has a device and kernels");
  }
  using Form = KernelChoice::Form;
  options.kernel.residual = typed.json;
  options.kernel.form = typed.kernel == "lanes"    ? Form::lanes
                        : typed.kernel == "serial" ? Form::serial
                                                   : Form::automatic;
  options.showProgress = !typed.quiet;
}

std::vector<std::string> motionNameList() {
  std::vector<std::string> names;
  std::string all = motionNames();
  for (std::size_t at = 0, comma; at < all.size(); at = comma + 2) {
    comma = std::min(all.find(", ", at), all.size());
    names.push_back(all.substr(at, comma - at));
  }
  return names;
}

int run(Typed& typed) {
  auto outcome = runSimulation(typed.options);
  if (!outcome) {
    fmt::print(stderr, "ringlet simulate: {}\n", outcome.error().message);
    return kExitFailed;
  }
  const int exitCode = tellTroubles("simulate", *outcome, typed.options.frameCount);
  RunNames names{typed.integrator, typed.backend};
  if (!typed.options.material.name.empty()) names.material = typed.options.material.name;
  if (typed.json) {
    printJson(runJson(names, typed.options.settings, *outcome));
  } else if (!typed.quiet) {
    fmt::print("{}", runText(names, typed.options.settings, *outcome));
  }
  return exitCode;
}

}  // namespace

void addSimulateCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<Typed>();
  SimulateOptions& options = typed->options;
  Settings& settings = options.settings;
  CLI::App* command = app.add_subcommand("simulate", "Moves the hair of a groom and writes the animation");
  command->footer(std::string(kExample) + kContactKeysHelp + kExitHelp);

  command->add_option("GROOM", options.groom, "Strands to simulate: a .hair, .obj or .tfx file")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", options.folder, "Folder for the results, made if it is not there")
      ->required()
      ->type_name("DIR");

  // What moves.
  const char* scene = "Scene";
  command
      ->add_option("--frames", typed->frameCount,
                   "Frames to simulate (default 48, or a motion file's length)")
      ->check(wholeBetween(1, kMostFrames))
      ->type_name("N")
      ->group(scene);
  command
      ->add_option(
          "--pre-roll", options.preRollSeconds,
          "Seconds the hair moves before the first frame, so that it begins settled; before its file "
          "begins, the head glides into its first pose (default 0)")
      ->check(between(0, 3600))
      ->type_name("S")
      ->group(scene);
  command->add_option("--fps", settings.framesPerSecond, "Frames per second (default 24)")
      ->check(between(0.001, 1e6))
      ->type_name("F")
      ->group(scene);
  const CLI::Validator motionName = oneOf(motionNameList());
  command
      ->add_option("--motion", typed->motion,
                   "How the head moves: " + motionNames() + "; or a .bvh, .gltf or .glb file (default shake)")
      ->check(CLI::Validator(
          [motionName](std::string& word) {
            return motionFileKind(word) != MotionFileKind::none ? "" : motionName(word);
          },
          "NAME"))
      ->type_name("NAME|FILE")
      ->group(scene);
  const auto ofMotionFile = [&](CLI::Option* option, const char* type) {
    option->type_name(type)->group(scene)->each(
        [typed](const std::string&) { typed->motionFileGiven = true; });
  };
  ofMotionFile(command->add_option(
                   "--joint", typed->motionFile.joint,
                   "Joint of the .bvh file, node of the .gltf or .glb, that is the head (default Head)"),
               "NAME");
  ofMotionFile(command
                   ->add_option("--motion-unit", typed->motionFile.metresPerUnit,
                                "Metres per unit of the motion's file (default: a .bvh skeleton is 1.7 m "
                                "tall, glTF is in metres)")
                   ->check(between(1e-6, 1000)),
               "METRES");
  ofMotionFile(
      command
          ->add_option("--skip-frames", typed->motionFile.skippedFrames,
                       "Frames at the start of the .bvh file to leave out, as a T-pose is (default 0)")
          ->check(wholeBetween(0, kMostFrames)),
      "N");
  ofMotionFile(command->add_option(
                   "--animation", typed->motionFile.animation,
                   "Animation of the .gltf or .glb file, by name or number from 0 (default: the first)"),
               "NAME");
  command
      ->add_option("--amplitude", typed->amplitude,
                   "Size of the motion: shake metres (default 0.1), nod radians (0.4), spin radians/s (pi), "
                   "glide metres/s (1), walk metres (0.025), turn radians, once (pi)")
      ->check(between(-1000, 1000))
      ->type_name("A")
      ->group(scene);
  command->add_option("--frequency", typed->frequency, "Shakes (default 2), nods or strides (1) per second")
      ->check(between(0, 1000))
      ->type_name("HZ")
      ->group(scene);
  command
      ->add_option("--unit", options.metresPerUnit,
                   "Metres per unit of the groom's file (default 0.01: centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES")
      ->group(scene);
  command->add_option("--up", typed->up, "The file's up axis, Y or Z (default Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS")
      ->group(scene);
  command->add_option("--gravity", typed->gravity, "Gravity, downwards, m/s^2 (default 9.81)")
      ->check(between(-1000, 1000))
      ->type_name("G")
      ->group(scene);
  command
      ->add_option("--preload", typed->preload,
                   "Share of gravity balanced in the rest pose, 0 to 1 (default 1; 0 for paper)")
      ->check(between(0, 1))
      ->type_name("P")
      ->group(scene);

  // What hair is made of.
  addMaterialOptions(command, options.material, "Material");

  addContactOptions(command, typed->contacts, "off");
  command
      ->add_flag("--measure-contacts", options.measuresContacts,
                 "Measure after every step how deep hairs are in each other and count those that cross, with "
                 "contacts on or off: some 6 us a particle and step of dense hair, on the CPU")
      ->group("Contacts");

  // How it is stepped.
  const char* solver = "Solver";
  command->add_option("--integrator", typed->integrator, "jacobi, point_jacobi or paper (default jacobi)")
      ->check(oneOf(integratorNames()))
      ->type_name("NAME")
      ->group(solver);
  command
      ->add_option(
          "--steps-per-frame", typed->stepsPerFrame,
          "Outer steps a frame, 1 to 340 (default: enough for this groom and material, at 24 fps from 8; 30 "
          "for paper)")
      ->check(wholeBetween(1, 340))
      ->type_name("N")
      ->group(solver);
  command
      ->add_option("--iterations", settings.pointIterations, "point_jacobi: iterations a step (default 100)")
      ->check(wholeBetween(1, 60'000))
      ->type_name("N")
      ->group(solver)
      ->each([typed](const std::string&) { typed->iterationsGiven = true; });
  command->add_flag("--no-chebyshev", typed->noChebyshev, "point_jacobi: plain iterations, not accelerated")
      ->group(solver);
  command
      ->add_option("--roots", settings.rootCount,
                   "Particles at the root that follow the head, 1 to 3 (default 1)")
      ->check(wholeBetween(1, 3))
      ->type_name("N")
      ->group(solver);

  // Where it runs.
  const char* machine = "Machine";
  command
      ->add_option("--backend", typed->backend,
                   "gpu (Vulkan) or reference (CPU, double precision) (default gpu)")
      ->check(oneOf({"gpu", "reference"}))
      ->type_name("NAME")
      ->group(machine);
  command
      ->add_option(
          "--device", options.device,
          "Vulkan device, by index or part of its name; see `ringlet devices` (default $RINGLET_DEVICE, else "
          "the best)")
      ->type_name("D")
      ->group(machine);
  command
      ->add_option("--kernel", typed->kernel,
                   "Form of the strand kernel: auto, lanes or serial (default auto)")
      ->check(oneOf({"auto", "lanes", "serial"}))
      ->type_name("FORM")
      ->group(machine);

  // What is said and written.
  const char* output = "Output";
  command->add_option("--width", options.width, "Diameter of strands in hair.usda, metres (default 0.0005)")
      ->check(between(1e-9, 1))
      ->type_name("METRES")
      ->group(output);
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary")->group(output);
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary")->group(output);

  command->callback([typed, &exitCode] {
    resolve(*typed);
    exitCode = run(*typed);
  });
}

}  // namespace ringlet::program
