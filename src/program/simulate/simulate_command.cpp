// Implements simulate_command.h: turns options into changes of a scene. simulate_run.cpp runs it,
// run_report.cpp reports.
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
#include "program/cli/key_options.h"
#include "program/cli/keys_help.h"
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

constexpr int kMostFrames = 1'000'000;  // eleven hours at 24 a second; more is probably a typing error
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
    "\n";
constexpr const char* kSimulateExitHelp =
    "\n"
    "Exit status: 0 done, 2 wrong usage, 3 done but some particles have no position, 130 Ctrl-C; of "
    "failures\n"
    "4 a file that cannot be read, 5 one that cannot be written, 6 disk full, 7 another run has the folder,\n"
    "8 out of memory, 9 out of the device's memory, 10 device lost, 11 a kernel does not compile, 1 all "
    "others.";

// The command line as typed. What is not typed comes from the scene file or is the default.
struct TypedSimulate {
  std::filesystem::path input, folder;
  TypedKeys keys;
  SceneReach reach = SceneReach::anywhere;
  MaterialChoice material;
  OutputChoice outputs;
  std::string backend = "gpu", device, kernel = "auto";
  std::vector<std::string> devices;
  std::optional<int> lanes, run, subgroup, checkpoint;
  std::optional<std::uint64_t> dump;
  std::filesystem::path trace;
  bool measuresContacts = false, untuned = false, json = false, quiet = false, jsonProgress = false,
       resume = false, overwrite = false;
};

// Why a word is neither a built-in motion nor a motion file; empty if it is one.
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

// Replaces the scene's motion by the one typed, except for the pre-roll and the roots.
SceneChange motionChange(const std::string& word) {
  using Form = SceneChange::Form;
  const bool isFile = motionFileKind(word) != MotionFileKind::none;
  SceneChange change{isFile ? "motion.file" : "motion.kind", word, isFile ? Form::path : Form::text};
  change.without = {"key"};
  for (const auto& field : motionFields()) change.without.emplace_back(field.key);
  return change;
}

// Throws CLI11's error for options that exclude each other.
void checkOptions(const TypedSimulate& typed, const SceneFile& scene) {
  if (scene.output.folder.empty()) throw CLI::RequiredError("--output");
  checkOutputs(scene.output);
  checkDialOptions(typed.material.dials, integratorNamed(scene.simulation.integrator));
  checkContactOptions(typed.keys);
  if (!scene.contacts.on && !typed.measuresContacts)
    refuseContactOptions(typed.keys, "only with --contacts on or --measure-contacts");
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

// The options of the run.
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
  auto scene = readTyped(typed.input, typed.keys, typed.reach, "shake");
  if (!scene) return fail("simulate", scene.error());
  if (!typed.folder.empty()) scene->output.folder = typed.folder;
  applyOutputOptions(typed.outputs, scene->output);
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

void addMotionOptions(CLI::App& command, TypedKeys& keys) {
  const char* group = "Motion";
  command
      .add_option_function<std::string>(
          "--motion", [&keys](const std::string& word) { keys.options.push_back(motionChange(word)); },
          fmt::format("How the head moves: {}; or a {} file (default shake)", motionNames(), kMotionEndings))
      ->check(CLI::Validator([](std::string& word) { return wrongMotion(word); }, "NAME"))
      ->type_name("NAME|FILE")
      ->group(group);
  addKeyOptions(command, keys, "motion", group);
}

void addSimulationOptions(CLI::App& command, TypedKeys& keys) {
  const char* group = "Simulation";
  addKeyOptions(command, keys, "simulation", group);
  command
      .add_flag_callback(
          "--no-chebyshev",
          [&keys] {
            keys.options.push_back({"simulation.chebyshev", "false"});
          },
          "point_jacobi: plain iterations, not accelerated")
      ->group(group);
}

// Options for where the run is computed.
void addMachineOptions(CLI::App& command, TypedSimulate& typed) {
  const char* machine = "Machine";
  addBackendOption(command, typed.backend)->group(machine);
  CLI::Option* device = addDeviceOption(command, typed.device)->group(machine);
  command
      .add_option("--devices", typed.devices,
                  "Vulkan devices among which the strands are divided, as 0,1, to the same bits as on one")
      ->delimiter(',')
      ->excludes(device)
      ->type_name("D,D")
      ->group(machine);
  command
      .add_option(
          "--kernel", typed.kernel,
          "Form of the strand kernel: lanes, whose runs are in registers; memory, whose runs are in memory, "
          "slower and for long strands; serial, in memory and one lane a strand; or auto (default auto)")
      ->check(oneOf({"auto", "lanes", "memory", "serial"}))
      ->type_name("FORM")
      ->group(machine);
  command
      .add_option(
          "--lanes", typed.lanes,
          "Lanes a strand is spread over: a power of two, the device's subgroup at most (default: chosen by "
          "device and length)")
      ->check(wholeBetween(1, 128))
      ->type_name("L")
      ->group(machine);
  command
      .add_option(
          "--run", typed.run,
          "Particles a lane holds, 4 to 16, on a CPU device to 24, and to 64 in one, two or the most lanes; "
          "in memory to 1024 (default: chosen by device and length)")
      ->check(wholeBetween(kShortestRun, kLongestRunInMemory))
      ->type_name("K")
      ->group(machine);

  command.add_option("--subgroup", typed.subgroup, kSubgroupHelp)
      ->check(wholeBetween(1, 128))
      ->type_name("N")
      ->group(machine);
  command
      .add_flag("--untuned", typed.untuned,
                "Choose lanes and run by the built-in model, whatever `ringlet tune` measured")
      ->group(machine);
}

// Options for how the run begins and continues, and what it prints.
void addRunOptions(CLI::App& command, TypedSimulate& typed) {
  const char* output = "Output";
  command
      .add_option(
          "--checkpoint", typed.checkpoint,
          "Every N frames write what a run that is killed can go on from, with --resume: DIR/checkpoint.rgk, "
          "which goes when the run ends")
      ->check(wholeBetween(1, kMostFrames))
      ->type_name("N")
      ->group(output);
  command
      .add_flag(
          "--resume", typed.resume,
          "Go on with the run in DIR from its last checkpoint, to the same bits as without a break; begin "
          "where there is nothing to go on with. Everything else must be asked for as it was")
      ->group(output);
  command
      .add_flag(
          "--overwrite", typed.overwrite,
          "Begin anew where DIR holds files of another run, finished or not; with --resume only where there "
          "is no checkpoint")
      ->group(output);
  command
      .add_flag("--json-progress", typed.jsonProgress,
                "Print a line of JSON for every frame that is written: frame, frames, seconds, seconds_left")
      ->group(output);
  command.add_flag("--json", typed.json, "Print one JSON object instead of the summary")->group(output);
  command.add_flag("--quiet", typed.quiet, "No progress bar and no summary")->group(output);
}

void addDebugOptions(CLI::App& command, TypedSimulate& typed) {
  const char* output = "Output";
  CLI::Option* dump = command.add_option("--dump", typed.dump,
                                         "In place of a run: what the device holds after this step of it, a "
                                         "file a buffer, into DIR/step_STEP");
  dump->check(wholeBetween(1, 1000000000))->type_name("STEP")->group(output);
  for (const char* ofARun : {"--devices", "--measure-contacts", "--checkpoint", "--resume", "--overwrite",
                             "--json-progress", "--json"})
    dump->excludes(ofARun);
  CLI::Option* trace = command.add_option("--trace", typed.trace,
                                          "Write when each dispatch ran, for chrome://tracing or Perfetto");
  trace->type_name("FILE")->group(output);
  for (const char* other : {"--devices", "--measure-contacts", "--dump"}) trace->excludes(other);
}

}  // namespace

void addSimulateCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedSimulate>();
  CLI::App* command = app.add_subcommand("simulate", "Moves the hair of a groom and writes the animation");
  command->footer(kSimulateExample + keysHelp(runReportKeys()) + kSimulateExitHelp);

  command
      ->add_option(
          "GROOM", typed->input,
          "Strands to simulate: a .hair, .obj, .usd, .abc, .tfx, .ply, .data or .bin file; or a scene file, .toml, "
          "whose keys `ringlet scene --keys` prints and the options here override")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("-o,--output", typed->folder,
                   "Folder for the results, made if it is not there; a scene file may say it")
      ->type_name("DIR");

  addConfinedOption(*command, typed->reach);

  addSetOption(*command, typed->keys);
  addOptionsOfKeys(
      *command, typed->keys,
      {"groom.unit", "groom.up", "groom.root_end", "groom.points_per_strand", "groom.guides",
       "groom.guides_file", "groom.guides_primvar", "groom.guides_sample", "groom.bind", "groom.bind_frame"},
      "Groom");
  addOptionsOfKeys(*command, typed->keys, {"start.from", "start.frame", "start.blend"}, "Start");
  addMotionOptions(*command, typed->keys);
  addSimulationOptions(*command, typed->keys);

  addMaterialOptions(command, typed->material, "Material");

  addContactOptions(*command, typed->keys, "off");
  command
      ->add_flag("--measure-contacts", typed->measuresContacts,
                 "Measure after every step how deep hairs are in each other and count those that cross, with "
                 "contacts on or off: some 6 us a particle and step of dense hair, on the CPU")
      ->group("Contacts");

  addMachineOptions(*command, *typed);
  addOutputOptions(*command, typed->outputs, typed->keys);
  addRunOptions(*command, *typed);
  addDebugOptions(*command, *typed);

  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
