// Implements simulate_command.h: options are changes of a scene, which is then run by simulate_run.cpp. What
// is said of it is run_report.cpp.
#include "program/simulate/simulate_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "program/cli/command_line.h"
#include "program/cli/confined_option.h"
#include "program/cli/contact_options.h"
#include "program/cli/exit_codes.h"
#include "program/cli/groom_options.h"
#include "program/cli/standard_output.h"
#include "program/convert/material_command.h"
#include "program/simulate/dump_run.h"
#include "program/simulate/hair_maker.h"
#include "program/simulate/output_options.h"
#include "program/simulate/rendered_sheet.h"
#include "program/simulate/run_report.h"
#include "program/simulate/simulate_run.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/run/run_facts.h"
#include "ringlet/run/run_folder.h"
#include "ringlet/run/run_writers.h"
#include "ringlet/scenes/file/scene_fields.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {
namespace {

constexpr int kMostFrames = 1'000'000;  // eleven hours at 24 a second; more is a slip of the finger
constexpr const char* kSimulateExample =
    "Examples:\n"
    "  ringlet make head -o head.obj && ringlet simulate head.obj --motion shake --frames 48 -o out\n"
    "  ringlet simulate head.obj --contacts on --measure-contacts --prune 12 --json -o out\n"
    "  ringlet simulate head.obj --motion walk.bvh --skip-frames 1 -o out\n"
    "  ringlet simulate scene.toml --frames 24 -o out\n"
    "  ringlet simulate scene.toml -o out --checkpoint 10 --resume --overwrite      again and again, until "
    "it ends\n"
    "  ringlet simulate head.obj --cache 16bit --no-usd -o out && ringlet convert out/hair.rgc --info\n"
    "\n"
    "Writes into DIR: hair.usda (time-sampled BasisCurves, frame k at time code k), last.obj (the last "
    "frame, in the\n"
    "groom's order and unit), sheet.png (six frames side by side). Ctrl-C stops after the current frame and "
    "keeps what\n"
    "is finished; until a run ends its animation is hair.usda.partial, which is valid at all times. --cache: "
    "hair.rgc,\n"
    "which `ringlet convert` makes other files of.\n"
    "\n"
    "--json keys: frames strands particles rigid_strands (of strands, carried rigidly: too fine for float32, "
    "or short and\n"
    "in need of far more steps than the others) ms_per_frame (stepping alone, by the device's clock where it "
    "has one)\n"
    "frame_ms (of that the first, the median and the least frame; null where ranks step the hair) stages_ms "
    "(per frame,\n"
    "by stage; copy_out, of positions to the host, is not in ms_per_frame; readback and write go on while "
    "the next frame is\n"
    "stepped) wall_s (start, frames,\n"
    "finish) compute_share (stepping, of wall_s.frames) waits_ms (per frame, for device and writer;\n"
    "the host's time for submit, fence and, of positions out of the frame, copy)\n"
    "max_edge_stretch limited_share nonfinite velocity_residual (of the velocity solve,\n"
    "worst strand and step; measuring it takes a few per cent of the step's time; null for paper, with "
    "contacts,\n"
    "bodies or air and for reference) deepest_penetration_mm (of any particle in a body once it was outside, "
    "at a\n"
    "frame's end) inside_bodies (particles that began in one and are there still; both null without bodies) "
    "device driver kernel tuned (shapes as `ringlet tune` measured) device_bytes (of the simulation's "
    "buffers, at\n"
    "the end; null for reference) cache_error_bound_m (how far points of hair.rgc may be from their "
    "particles;\n"
    "null without) compile_ms (making the kernels, once) backend positions_hash integrator\n"
    "material steps_per_frame fps\n"
    "resumed_from (frames that a run before had done) interrupted warnings notes (a preset that fits "
    "better)\n"
    "outputs. Times are of this run's frames.\n";
constexpr const char* kSimulateExitHelp =
    "\n"
    "Exit status: 0 done, 2 wrong usage, 3 done but some particles have no position, 130 Ctrl-C; of "
    "failures\n"
    "4 a file that cannot be read, 5 one that cannot be written, 6 disk full, 7 another run has the folder,\n"
    "8 out of memory, 9 out of the device's memory, 10 device lost, 11 a kernel does not compile, 1 all "
    "others.";

// The command line as typed; what is left out is the scene file's, or the default.
struct TypedSimulate {
  std::filesystem::path input, folder;
  std::optional<int> frames, bindFrame, stepsPerFrame, iterations, roots, skipFrames, lanes, run, subgroup;
  std::optional<double> preRoll, framesPerSecond, unit, motionUnit, amplitude, frequency, gravity, preload;
  std::optional<std::string> motion, joint, animation, motionUp, up, integrator, bind;
  SceneReach reach = SceneReach::anywhere;
  MaterialChoice material;
  ContactChoice contacts;
  GroomChoice groom;
  OutputChoice outputs;
  std::string backend = "gpu", device, kernel = "auto";
  std::vector<std::string> devices;
  std::optional<int> checkpoint;
  std::optional<std::uint64_t> dump;
  std::filesystem::path trace;
  bool measuresContacts = false, noChebyshev = false, untuned = false, json = false, quiet = false,
       jsonProgress = false, resume = false, overwrite = false;
};

template <class Value>
void replace(Value& value, const auto& typed) {
  if (typed) value = *typed;
}

// A groom by itself is a scene as well: one whose head shakes.
Result<SceneFile> readInput(const TypedSimulate& typed) {
  if (isSceneFile(typed.input)) return readScene(typed.input, {}, typed.reach);
  SceneFile scene;
  scene.groom.file = typed.input;
  scene.motion.kind = "shake";
  return scene;
}

// Why a word is neither a built-in motion nor a file of one; empty where it is.
std::string wrongMotion(std::string word) {
  if (motionFileKind(word) != MotionFileKind::none) return "";
  const std::string unknown = oneOf(namesIn(motionNames()))(word);
  if (unknown.empty()) return "";
  std::error_code ignored;
  const std::filesystem::path path = word;
  if (path.has_extension() || path.has_parent_path() || std::filesystem::exists(path, ignored))
    return fmt::format("{}; built-in motions are {}", noMotionFile(path).message, motionNames());
  return fmt::format("{}{} name a {} file", unknown, unknown.ends_with('?') ? " Or" : "; or", kMotionEndings);
}

// The motion as typed in place of the file's. Throws CLI11's error for what makes no sense together.
void applyMotionOptions(const TypedSimulate& typed, SceneMotion& motion) {
  if (typed.motion) {
    SceneMotion other{.preRollSeconds = motion.preRollSeconds, .roots = motion.roots};
    if (motionFileKind(*typed.motion) != MotionFileKind::none) {
      other.file = *typed.motion;
    } else {
      other.kind = *typed.motion;
    }
    motion = std::move(other);
  }
  if (motion.kind.empty() && (typed.amplitude || typed.frequency)) {
    throw CLI::ValidationError(
        typed.amplitude ? "--amplitude" : "--frequency",
        motion.file.empty() ? "a motion by keys has its own" : "a motion from a file has its own");
  }
  const MotionFileKind kind = motionFileKind(motion.file.string());
  if (kind == MotionFileKind::none &&
      (typed.joint || typed.motionUnit || typed.motionUp || typed.skipFrames || typed.animation)) {
    throw CLI::ValidationError(
        "--motion",
        fmt::format("only a {} file has a --joint, --motion-unit, --motion-up, --skip-frames and --animation",
                    kMotionEndings));
  }
  if (kind == MotionFileKind::gltf && typed.skipFrames.value_or(0) > 0)
    throw CLI::ValidationError("--skip-frames",
                               "a glTF animation has times and no frames; cut it where it is made");
  if (kind == MotionFileKind::bvh && typed.animation)
    throw CLI::ValidationError("--animation", "a .bvh file has only one");
  replace(motion.amplitude, typed.amplitude);
  replace(motion.frequency, typed.frequency);
  replace(motion.joint, typed.joint);
  replace(motion.animation, typed.animation);
  replace(motion.metresPerUnit, typed.motionUnit);
  replace(motion.up, typed.motionUp);
  replace(motion.skipFrames, typed.skipFrames);
  replace(motion.preRollSeconds, typed.preRoll);
}

// What was typed in place of what the file says.
void applyOptions(const TypedSimulate& typed, SceneFile& scene) {
  replace(scene.groom.metresPerUnit, typed.unit);
  replace(scene.groom.up, typed.up);
  applyGroomOptions(typed.groom, scene.groom);
  replace(scene.groom.bind, typed.bind);
  replace(scene.groom.bindFrame, typed.bindFrame);
  applyMotionOptions(typed, scene.motion);

  SceneSimulation& simulation = scene.simulation;
  if (typed.frames) simulation.seconds.reset();
  replace(simulation.frames, typed.frames);
  replace(simulation.framesPerSecond, typed.framesPerSecond);
  replace(simulation.gravity, typed.gravity);
  replace(simulation.preload, typed.preload);
  replace(simulation.integrator, typed.integrator);
  replace(simulation.stepsPerFrame, typed.stepsPerFrame);
  replace(simulation.iterations, typed.iterations);
  replace(simulation.roots, typed.roots);
  if (typed.noChebyshev) simulation.chebyshev = false;
  applyContactOptions(typed.contacts, scene.contacts);
  if (!typed.folder.empty()) scene.output.folder = typed.folder;
  applyOutputOptions(typed.outputs, scene.output);
}

// Throws CLI11's error for what makes no sense together.
void checkOptions(const TypedSimulate& typed, const SceneFile& scene) {
  if (scene.output.folder.empty()) throw CLI::RequiredError("--output");
  if (scene.simulation.integrator != "point_jacobi" && (typed.iterations || typed.noChebyshev)) {
    throw CLI::ValidationError(typed.noChebyshev ? "--no-chebyshev" : "--iterations",
                               "only --integrator point_jacobi has iterations");
  }
  checkOutputs(scene.output);
  checkDialOptions(typed.material.dials, integratorNamed(scene.simulation.integrator));
  checkContactOptions(typed.contacts);
  if (!scene.contacts.on && !typed.measuresContacts)
    refuseContactOptions(typed.contacts, "only with --contacts on or --measure-contacts");
  if (typed.backend == "reference" &&
      (!typed.device.empty() || !typed.devices.empty() || typed.kernel != "auto")) {
    throw CLI::ValidationError(typed.kernel != "auto"   ? "--kernel"
                               : !typed.devices.empty() ? "--devices"
                                                        : "--device",
                               "only --backend gpu has a device and kernels");
  }
  if (typed.untuned && typed.backend == "reference")
    throw CLI::ValidationError("--untuned", "only --backend gpu is ever tuned");
  if ((typed.lanes || typed.run) && (typed.backend == "reference" || typed.kernel == "serial")) {
    throw CLI::ValidationError(typed.lanes ? "--lanes" : "--run",
                               "only --backend gpu with --kernel auto, lanes or memory has lanes and runs");
  }
  if (typed.dump && typed.backend == "reference")
    throw CLI::ValidationError("--dump", "only --backend gpu has buffers to write");
  if (!typed.trace.empty() && typed.backend == "reference")
    throw CLI::ValidationError("--trace", "only --backend gpu has dispatches");
  if (typed.subgroup && (typed.backend == "reference" || typed.kernel == "serial")) {
    throw CLI::ValidationError("--subgroup",
                               "only --backend gpu with --kernel auto, lanes or memory asks for subgroups");
  }
}

// How the scene is run.
SimulateOptions optionsOf(const TypedSimulate& typed, const SceneFile& scene) {
  SimulateOptions options(runOptionsOf(scene));
  options.measuresContacts = typed.measuresContacts;
  options.onReference = typed.backend == "reference";
  options.device = typed.devices.empty() ? typed.device : typed.devices[0];
  if (typed.devices.size() > 1) options.devices = typed.devices;
  using Form = KernelChoice::Form;
  options.measuresResidual = typed.json && !options.onReference;
  options.kernel.form = typed.kernel == "lanes"    ? Form::lanes
                        : typed.kernel == "memory" ? Form::memory
                        : typed.kernel == "serial" ? Form::serial
                        : typed.lanes || typed.run ? Form::lanes
                                                   : Form::automatic;
  options.kernel.lanes = typed.lanes.value_or(0);
  options.kernel.particlesPerLane = typed.run.value_or(0);
  options.kernel.subgroupSize = typed.subgroup.value_or(0);
  options.usesTuned = !typed.untuned;
  options.showProgress = !typed.quiet;
  options.tellsFrames = typed.jsonProgress;
  options.checkpointFrames = typed.checkpoint.value_or(0);
  options.trace = typed.trace;
  options.leftovers = typed.resume ? (typed.overwrite ? Leftovers::resumeOrOverwrite : Leftovers::resume)
                                   : (typed.overwrite ? Leftovers::overwrite : Leftovers::refuse);
  return options;
}

int run(const TypedSimulate& typed) {
  if (typed.folder.empty() && !isSceneFile(typed.input)) throw CLI::RequiredError("--output");
  auto scene = readInput(typed);
  if (!scene) return fail("simulate", scene.error());
  applyOptions(typed, *scene);
  checkOptions(typed, *scene);
  if (Status applied = applyMaterialOptions(typed.material, *scene); !applied)
    return fail("simulate", applied.error());
  if (!typed.trace.empty() && isOneOfRanks())
    return fail("simulate", {"--trace tells of one device; start it without mpirun", Fault::input});
  SimulateOptions options = optionsOf(typed, *scene);
  if (typed.reach == SceneReach::ownFolder && typed.folder.empty()) {
    if (Status linkless = checkHoldsNoLinks(options.folder); !linkless)
      return fail("simulate", linkless.error());
  }
  const bool rendersSheet = typed.outputs.sheet == "rendered" && options.writesSheet;
  if (rendersSheet) {
    if (Status can = checkRenderedSheet(options); !can) return fail("simulate", can.error());
  }
  if (outputsOf(options).empty() && !typed.json && !typed.jsonProgress)
    say("ringlet simulate: warning: every file is left out, so that nothing will be written into {}\n",
        options.folder.string());
  std::optional<LoadedGroom> origin;
  if (Status prepared = prepareRun(*scene, typed.input, origin, options); !prepared)
    return fail("simulate", prepared.error());
  const auto loaded = loadScene(*scene, origin ? &*origin : nullptr);
  if (!loaded) return fail("simulate", loaded.error());
  if (typed.dump) return runDump(*loaded, options, *typed.dump);
  if (const auto exitCode = joinRun(*loaded, options)) return *exitCode;
  const auto outcome = simulate(*loaded, options);
  if (!outcome) return fail("simulate", outcome.error());
  if (rendersSheet && outcome->frameCount > 0 && !outcome->canResume) {
    if (Status drawn = writeRenderedSheet(*loaded, options); !drawn) return fail("simulate", drawn.error());
  }
  const int exitCode = tellTroubles("simulate", *outcome, loaded->frameCount);
  RunNames names{scene->simulation.integrator, typed.backend};
  if (scene->hasMaterial) names.material = "scene";
  if (!typed.material.name.empty()) names.material = typed.material.name;
  if (typed.json) {
    printJson(runJson(names, loaded->settings, *outcome));
  } else if (!typed.quiet) {
    print("{}", runText(names, loaded->settings, *outcome));
  }
  return exitCode;
}

}  // namespace

void addSimulateCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedSimulate>();
  CLI::App* command = app.add_subcommand("simulate", "Moves the hair of a groom and writes the animation");
  command->footer(std::string(kSimulateExample) + kContactKeysHelp + kSimulateExitHelp);

  command
      ->add_option(
          "GROOM", typed->input,
          "Strands to simulate: a .hair, .obj, .usd, .tfx, .ply, .data or .bin file; or a scene file, .toml, "
          "whose keys `ringlet scene --keys` prints and the options here override")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", typed->folder,
                   "Folder for the results, made if it is not there; a scene file may say it")
      ->type_name("DIR");

  addConfinedOption(*command, typed->reach);

  // What moves.
  const char* scene = "Scene";
  command->add_option("--frames", typed->frames, "Frames to simulate (default 48, or a motion file's length)")
      ->check(wholeBetween(1, kMostFrames))
      ->type_name("N")
      ->group(scene);
  command
      ->add_option(
          "--pre-roll", typed->preRoll,
          "Seconds the hair moves before the first frame, so that it begins settled; before its file begins, "
          "the head glides into its first pose (default 0)")
      ->check(between(0, 3600))
      ->type_name("S")
      ->group(scene);
  command->add_option("--fps", typed->framesPerSecond, "Frames per second (default 24)")
      ->check(between(0.001, 1e6))
      ->type_name("F")
      ->group(scene);
  command
      ->add_option(
          "--motion", typed->motion,
          fmt::format("How the head moves: {}; or a {} file (default shake)", motionNames(), kMotionEndings))
      ->check(CLI::Validator([](std::string& word) { return wrongMotion(word); }, "NAME"))
      ->type_name("NAME|FILE")
      ->group(scene);
  const auto ofMotionFile = [&](CLI::Option* option, const char* type) {
    option->type_name(type)->group(scene);
  };
  ofMotionFile(
      command->add_option(
          "--joint", typed->joint,
          "Joint of the .bvh file, node of the .gltf, .glb or .vrm, that is the head (default Head)"),
      "NAME");
  ofMotionFile(
      command
          ->add_option(
              "--motion-unit", typed->motionUnit,
              "Metres per unit of the motion's file (default: a .bvh person is 1.7 m tall, glTF is in "
              "metres)")
          ->check(between(1e-6, 1000)),
      "METRES");
  ofMotionFile(
      command
          ->add_option(
              "--motion-up", typed->motionUp,
              "Up axis of the motion's file, which is turned to --up: Y, Z, X, or --motion-up=-Y, -Z, -X "
              "(default: along which a .bvh person stands; of glTF Y)")
          ->check(oneOf(namesIn(kFileAxisNames))),
      "AXIS");
  ofMotionFile(
      command
          ->add_option("--skip-frames", typed->skipFrames,
                       "Frames at the start of the .bvh file to leave out, as a T-pose is (default 0)")
          ->check(wholeBetween(0, kMostFrames)),
      "N");
  ofMotionFile(
      command->add_option(
          "--animation", typed->animation,
          "Animation of the .gltf, .glb or .vrm file, by name or number from 0 (default: the first)"),
      "NAME");
  command
      ->add_option(
          "--amplitude", typed->amplitude,
          "Size of the motion: shake metres (default 0.1), nod radians (0.4), spin radians/s (pi), glide "
          "metres/s (1), walk metres (0.025), turn radians, once (pi), jump metres (0.2), whip radians (1)")
      ->check(between(-1000, 1000))
      ->type_name("A")
      ->group(scene);
  command
      ->add_option("--frequency", typed->frequency,
                   "Shakes (default 2), nods, strides or jumps (1) per second")
      ->check(between(0, 1000))
      ->type_name("HZ")
      ->group(scene);
  command
      ->add_option(
          "--unit", typed->unit,
          "Metres per unit of the groom's file (default: what a USD file states, else 0.01: centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES")
      ->group(scene);
  command->add_option("--up", typed->up, "The file's up axis, Y or Z (default Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS")
      ->group(scene);
  addGroomOptions(*command, typed->groom, scene);
  command
      ->add_option(
          "--bind", typed->bind,
          "What the groom is bound to: head, it is in the frame of the head's joint; world, it stands where "
          "it was modelled, whatever axes the joint has (default head)")
      ->check(oneOf({"head", "world"}))
      ->type_name("NAME")
      ->group(scene);
  command
      ->add_option(
          "--bind-frame", typed->bindFrame,
          "Frame of the motion at which what is bound to the world stands so; 1 is its first pose (default "
          "1)")
      ->check(wholeBetween(1, kMostFrames))
      ->type_name("N")
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
  addMaterialOptions(command, typed->material, "Material");

  addContactOptions(command, typed->contacts, "off");
  command
      ->add_flag("--measure-contacts", typed->measuresContacts,
                 "Measure after every step how deep hairs are in each other and count those that cross, with "
                 "contacts on or off: some 6 us a particle and step of dense hair, on the CPU")
      ->group("Contacts");

  // How it is stepped.
  const char* solver = "Solver";
  command->add_option("--integrator", typed->integrator, "jacobi, point_jacobi or paper (default jacobi)")
      ->check(oneOf({std::begin(kIntegratorNames), std::end(kIntegratorNames)}))
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
  command->add_option("--iterations", typed->iterations, "point_jacobi: iterations a step (default 100)")
      ->check(wholeBetween(1, 60'000))
      ->type_name("N")
      ->group(solver);
  command->add_flag("--no-chebyshev", typed->noChebyshev, "point_jacobi: plain iterations, not accelerated")
      ->group(solver);
  command
      ->add_option("--roots", typed->roots, "Particles at the root that follow the head, 1 to 3 (default 1)")
      ->check(wholeBetween(1, 3))
      ->type_name("N")
      ->group(solver);

  // Where it runs.
  const char* machine = "Machine";
  addBackendOption(*command, typed->backend)->group(machine);
  CLI::Option* device = addDeviceOption(*command, typed->device)->group(machine);
  command
      ->add_option("--devices", typed->devices,
                   "Vulkan devices among which the strands are divided, as 0,1, to the same bits as on one")
      ->delimiter(',')
      ->excludes(device)
      ->type_name("D,D")
      ->group(machine);
  command
      ->add_option(
          "--kernel", typed->kernel,
          "Form of the strand kernel: lanes, whose runs are in registers; memory, whose runs are in memory, "
          "slower and for long strands; serial, in memory and one lane a strand; or auto (default auto)")
      ->check(oneOf({"auto", "lanes", "memory", "serial"}))
      ->type_name("FORM")
      ->group(machine);
  command
      ->add_option(
          "--lanes", typed->lanes,
          "Lanes a strand is spread over: a power of two, the device's subgroup at most (default: chosen by "
          "device and length)")
      ->check(wholeBetween(1, 128))
      ->type_name("L")
      ->group(machine);
  command
      ->add_option(
          "--run", typed->run,
          "Particles a lane holds, 4 to 16, on a CPU device to 24, and to 64 in one, two or the most lanes; "
          "in memory to 1024 (default: chosen by device and length)")
      ->check(wholeBetween(kShortestRun, kLongestRunInMemory))
      ->type_name("K")
      ->group(machine);

  command->add_option("--subgroup", typed->subgroup, kSubgroupHelp)
      ->check(wholeBetween(1, 128))
      ->type_name("N")
      ->group(machine);
  command
      ->add_flag("--untuned", typed->untuned,
                 "Choose lanes and run by the built-in model, whatever `ringlet tune` measured")
      ->group(machine);

  // What is said and written.
  const char* output = "Output";
  addOutputOptions(command, typed->outputs);
  command
      ->add_option(
          "--checkpoint", typed->checkpoint,
          "Every N frames write what a run that is killed can go on from, with --resume: DIR/checkpoint.rgk, "
          "which goes when the run ends")
      ->check(wholeBetween(1, kMostFrames))
      ->type_name("N")
      ->group(output);
  command
      ->add_flag(
          "--resume", typed->resume,
          "Go on with the run in DIR from its last checkpoint, to the same bits as without a break; begin "
          "where there is nothing to go on with. Everything else must be asked for as it was")
      ->group(output);
  command
      ->add_flag(
          "--overwrite", typed->overwrite,
          "Begin anew where DIR holds files of another run, finished or not; with --resume only where there "
          "is no checkpoint")
      ->group(output);
  command
      ->add_flag("--json-progress", typed->jsonProgress,
                 "Print a line of JSON for every frame that is written: frame, frames, seconds, seconds_left")
      ->group(output);
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary")->group(output);
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary")->group(output);
  CLI::Option* dump = command->add_option("--dump", typed->dump,
                                          "In place of a run: what the device holds after this step of it, a "
                                          "file a buffer, into DIR/step_STEP");
  dump->check(wholeBetween(1, 1000000000))->type_name("STEP")->group(output);
  for (const char* ofARun : {"--devices", "--measure-contacts", "--checkpoint", "--resume", "--overwrite",
                             "--json-progress", "--json"})
    dump->excludes(ofARun);
  CLI::Option* trace = command->add_option("--trace", typed->trace,
                                           "Write when each dispatch ran, for chrome://tracing or Perfetto");
  trace->type_name("FILE")->group(output);
  for (const char* other : {"--devices", "--measure-contacts", "--dump"}) trace->excludes(other);

  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
