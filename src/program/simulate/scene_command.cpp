// Implements scene_command.h: turns options into a BuiltinScene, steps it as `ringlet simulate` does, and
// measures it as `ringlet measure` does.
#include "program/simulate/scene_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "program/cli/command_line.h"
#include "program/cli/contact_options.h"
#include "program/cli/exit_codes.h"
#include "program/cli/standard_output.h"
#include "program/convert/material_command.h"
#include "program/simulate/hair_maker.h"
#include "program/simulate/run_report.h"
#include "program/simulate/scene_report.h"
#include "program/simulate/simulate_run.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/measure/frame_turn.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::program {
namespace {

constexpr const char* kSceneExample =
    "Examples:\n"
    "  ringlet scene --list\n"
    "  ringlet scene hanging_curl --preload 0 --particles 128\n"
    "  ringlet scene walk_cycle --frames-on raw --json -o out\n"
    "  ringlet scene bounce --bounce 2\n"
    "  ringlet scene curtain --contacts off\n"
    "  ringlet scene flip --prune 8\n"
    "  ringlet measure out/groom.obj out            measures what was written once more\n"
    "  ringlet scene flip --write flip.toml         then edit it and: ringlet simulate flip.toml -o out\n"
    "  ringlet scene --keys                         all that a scene file may say\n"
    "\n"
    "Every frame is measured, the groom at rest counting as the one before the first. A scene is stepped as "
    "often as\n"
    "it says, however many steps its hair wants; a warning says if that is more.\n"
    "\n"
    "DIR receives groom.obj (the groom at rest), hair.usda, last.obj and sheet.png, in centimetres, Y up. Of "
    "these\n"
    "`ringlet measure` finds the same numbers, but for what files do not hold: steps between frames, and the "
    "turning\n"
    "of a head with one strand (walk_cycle).\n"
    "\n"
    "--json prints the keys of `simulate` and of `measure` together; max_edge_stretch is that of every step.\n"
    "\n";
constexpr const char* kSceneExitHelp =
    "\n"
    "Scenes of hair that meets hair (two_curls, curtain, pile, fall, flip, head, walk_head, bust) measure "
    "contacts also where these\n"
    "are off; others where they are on. Steps are then\n"
    "measured one by one. Their radius is 5.5 mm and gaps are filled, but on head and walk_head, which have the\n"
    "defaults of simulate; that of bust is 7.5 mm.\n"
    "\n"
    "Exit status: as for simulate.";

// The command line as typed.
struct TypedScene {
  std::string name;
  SceneOptions scene;
  DialChoice dials;
  TypedKeys changes;
  SimulateOptions run;
  RunNames names{.material = "scene"};
  std::string core = "on", framesOn = "smoothed";
  std::filesystem::path file;  // file to write the scene to
  std::optional<int> subgroup;
  bool list = false, keys = false, untuned = false, json = false, quiet = false, overwrite = false;
};

void printList() {
  for (const std::string& name : sceneNames()) {
    const BuiltinScene scene = *makeScene(name);
    print("{:<14}{} ({} s, preload {})\n", name, scene.summary, scene.seconds, scene.settings.gravityPreload);
  }
}

// Every key of a scene file, table by table.
void printKeys() {
  print(
      "A scene file is TOML; [[...]] may stand several times. Paths are relative to the file. Beside what\n"
      "stands here [material] takes all keys of a material file: `ringlet material --list`.\n");
  std::string table;
  for (const SceneKey& key : sceneKeys()) {
    if (key.table != table) {
      const bool isList = key.table == "body" || key.table == "camera" || key.table == "map" ||
                          key.table == "key" || key.table == "motion.key";
      print("\n{}\n", isList ? "[[" + key.table + "]]" : "[" + key.table + "]");
    }
    table = key.table;
    // If there is a range, it contains the unit.
    const std::string unit = key.range.empty() && !key.unit.empty() ? " " + key.unit : "";
    print("  {:<26} {}\n  {:<26} {}{}{}{}; default {}.{}\n", key.key, key.effect, "",
          static_cast<char>(std::toupper(static_cast<unsigned char>(key.type[0]))), key.type.substr(1), unit,
          key.range.empty() ? "" : " " + key.range, key.standard,
          key.onlyWith.empty() ? "" : " Only with " + key.onlyWith + ".");
  }
}

Error inScene(const TypedScene& typed, const Error& cause) {
  return Error{fmt::format("{}: {}", typed.name, cause.message), cause.fault};
}

// Writes the groom at rest beside the animation, so that `ringlet measure DIR/groom.obj DIR` works.
Status writeGroom(const BuiltinScene& scene, const SimulateOptions& options, RunOutcome& outcome) {
  if (outcome.outputs.empty()) return {};
  const std::filesystem::path path = options.folder / "groom.obj";
  if (Status written = writeObj(path, scene.groom, scene.groom.points); !written) return written;
  outcome.outputs.push_back(path);
  return {};
}

// The largest turn of a strand's frame in one outer step: runs the scene again with the same steps, each a
// frame of its own. None if Ctrl-C ended it.
Result<std::optional<double>> measureFrameTurn(const BuiltinScene& scene, SimulateOptions options) {
  LoadedScene steps = scene;
  steps.settings = stepByStep(scene.settings);
  steps.frameCount *= scene.settings.stepsPerFrame;
  options.measuresContacts = false;
  options.onRanks = false;  // the other ranks have ended
  options.folder.clear();
  options.measuresResidual = false;

  FrameTurn turn(scene.groom, scene.material);
  turn.look(scene.groom.points, scene.groom.metresPerUnit);
  const auto look = [&](std::span<const Vec3f> points, const HeadPose& head) -> Status {
    turn.look(points, scene.groom.metresPerUnit, head.rotation);
    return {};
  };
  const auto outcome = simulate(steps, options, look);
  if (!outcome) return outcome.error();
  return outcome->interrupted ? std::nullopt : std::optional(turn.largest());
}

// The scene as a file, keys as typed in place of its own.
Result<SceneFile> fileOf(const BuiltinScene& scene, const std::filesystem::path& groom,
                         const TypedKeys& keys) {
  SceneFile file = sceneFileOf(scene, groom);
  if (keys.isEmpty()) return file;
  return parseTyped(sceneText(file), scene.name, keys);
}

// Writes the scene as a file, and its groom beside it.
Result<int> writeScene(const TypedScene& typed, const BuiltinScene& scene) {
  const std::filesystem::path folder = typed.file.parent_path(),
                              groom = folder / (typed.file.stem().string() + "-groom.obj");
  const std::string heading = fmt::format(
      "# The built-in scene {}. {}\n# ringlet simulate {} -o out\n# What is left out keeps its default; "
      "`ringlet scene --keys` prints every key.\n",
      scene.name, scene.summary, typed.file.filename().string());
  const auto file = fileOf(scene, groom, typed.changes);
  if (!file) return file.error();
  const std::string text = sceneText(*file, folder, heading);
  if (Status written = writeObj(groom, scene.groom); !written) return written.error();
  if (Status written = writeWholeFile(typed.file, std::as_bytes(std::span<const char>(text))); !written)
    return written.error();
  for (const std::string& warning : scene.warnings) say("ringlet scene: warning: {}\n", warning);
  if (typed.json) {
    printJson(writtenJson({scene.name, {typed.file, groom}}));
  } else if (!typed.quiet) {
    print("{}: {} and {}\n", scene.name, typed.file.string(), groom.string());
  }
  return kExitFine;
}

// Throws CLI11's error for keys that a built-in scene does not have.
void checkSets(const TypedKeys& keys) {
  for (const SceneChange& change : keys.changes())
    for (const char* table : {"groom.", "output."})
      if (change.key.starts_with(table))
        throw CLI::ValidationError(
            "--set",
            fmt::format("{} has no place here: a built-in scene makes its own groom and writes what -o "
                        "says; write the scene with --write and change that",
                        change.key));
}

// Applies keys as typed to the scene.
Status applyKeys(const TypedKeys& keys, BuiltinScene& scene) {
  if (keys.isEmpty()) return {};
  const auto file = fileOf(scene, "groom.obj", keys);
  if (!file) return file.error();
  const LoadedGroom groom{scene.groom};
  auto loaded = loadScene(*file, &groom);
  if (!loaded) return loaded.error();
  loaded->warnings.insert(loaded->warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  loaded->notes = std::move(scene.notes);
  static_cast<LoadedScene&>(scene) = std::move(*loaded);
  scene.seconds = scene.frameCount / scene.settings.framesPerSecond;
  return {};
}

Result<int> runScene(TypedScene& typed) {
  auto scene = makeScene(typed.name, typed.scene);
  if (!scene) return scene.error();
  if (!typed.file.empty()) return writeScene(typed, *scene);
  if (Status applied = applyKeys(typed.changes, *scene); !applied) return applied.error();
  typed.names.integrator = kIntegratorNames[static_cast<int>(scene->settings.integrator)];
  SimulateOptions& options = typed.run;
  options.measuresContacts = scene->showsContacts || scene->settings.contacts.on;
  options.measuresResidual = !options.onReference;
  if (const auto exitCode = joinRun(*scene, options)) return *exitCode;
  const Settings& settings = scene->settings;

  // Measures relative to the groom itself.
  const double unit = scene->groom.metresPerUnit;
  auto measure = MotionMeasure::make(scene->groom, {.framesPerSecond = settings.framesPerSecond,
                                                    .lineDensity = scene->material.lineDensity});
  if (!measure) return inScene(typed, measure.error());
  const auto look = [&](std::span<const Vec3f> points, const HeadPose& head) {
    return measure->addFrame(points, unit, head.rotation);
  };
  if (Status seen = look(scene->groom.points, scene->motion.poseAt(0)); !seen)
    return inScene(typed, seen.error());
  auto outcome = simulate(*scene, options, look);
  if (!outcome) return inScene(typed, outcome.error());
  if (Status written = writeGroom(*scene, options, *outcome); !written)
    return inScene(typed, written.error());

  SceneNumbers numbers{curlNumbers(measure->ruler(), measure->report()), outcome->velocityResidual, {}};
  if (scene->showsFrames && !outcome->interrupted && outcome->report.nonfinite == 0) {
    auto turn = measureFrameTurn(*scene, options);
    if (!turn) return inScene(typed, turn.error());
    numbers.frameTurn = *turn;
    outcome->interrupted = !numbers.frameTurn;
  }
  const int exitCode = tellTroubles("scene", *outcome, scene->frameCount);
  if (typed.json) {
    printJson(sceneJson({typed.names, typed.scene.core, typed.framesOn, *scene, *outcome, numbers}));
  } else if (!typed.quiet) {
    print("{}: {}\n{}{}", scene->name, scene->summary, runText(typed.names, settings, *outcome),
          sceneMeasureText(numbers, settings));
  }
  return exitCode;
}

int run(TypedScene& typed) {
  if (typed.list || typed.keys) {
    if (typed.json)
      printJson(typed.list ? sceneListJson() : sceneKeysJson());
    else
      typed.list ? printList() : printKeys();
    return kExitFine;
  }
  auto exitCode = runScene(typed);
  if (exitCode) return *exitCode;
  say("ringlet scene: {}\n", exitCode.error().message);
  return exitCodeOf(exitCode.error());
}

// Throws CLI11's error for options that cannot be combined with --list or --keys: all except --json.
void checkList(const CLI::App& command, bool list) {
  const std::string own = list ? "--list" : "--keys";
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != own && name != "--json") {
      throw CLI::ValidationError(name, fmt::format("{} only says which {} there are; leave this out", own,
                                                   list ? "scenes" : "keys"));
    }
  }
}

// The same for --integrator paper, whose springs, frames and loads are those of the paper.
void checkPaper(const TypedScene& typed) {
  const char* option = typed.scene.bendStiffness             ? "--bend-stiffness"
                       : !typed.scene.core                   ? "--core"
                       : !typed.scene.smoothedFrames         ? "--frames-on"
                       : typed.scene.preload.value_or(0) > 0 ? "--preload"
                                                             : nullptr;
  if (option) {
    throw CLI::ValidationError(
        option,
        "--integrator paper takes its springs as printed: their stiffness, a core, smoothed frames and no "
        "preload; leave this out");
  }
}

// Derives options from each other. Throws CLI11's error for those that exclude each other.
void resolve(TypedScene& typed) {
  if (typed.name.empty()) throw CLI::RequiredError("NAME (or --list)");
  typed.scene.core = typed.core == "on";
  typed.scene.smoothedFrames = typed.framesOn == "smoothed";
  typed.scene.integrator = integratorNamed(typed.names.integrator);
  if (typed.scene.integrator == Integrator::paper) checkPaper(typed);
  checkDialOptions(typed.dials, typed.scene.integrator);
  typed.scene.dials = turned(typed.dials, {});
  checkContactOptions(typed.changes);
  checkSets(typed.changes);
  typed.scene.contacts = typedContacts(typed.changes);
  if (!typed.scene.contacts.value_or(sceneShowsContacts(typed.name)) && !sceneShowsContacts(typed.name))
    refuseContactOptions(typed.changes, "only with --contacts on, or in a scene of hair that meets hair");
  typed.run.onReference = typed.names.backend == "reference";
  if (typed.run.onReference && !typed.run.device.empty())
    throw CLI::ValidationError("--device", "only --backend gpu has a device");
  if (!typed.file.empty() && !typed.run.folder.empty())
    throw CLI::ValidationError("--output", "with --write nothing is run; leave one of the two out");
  if (typed.run.onReference && typed.untuned)
    throw CLI::ValidationError("--untuned", "only --backend gpu is ever tuned");
  if (typed.run.onReference && typed.subgroup)
    throw CLI::ValidationError("--subgroup", "only --backend gpu asks for subgroups");
  typed.run.kernel.subgroupSize = typed.subgroup.value_or(0);
  typed.run.usesTuned = !typed.untuned;
  typed.run.showProgress = !typed.quiet;
  if (typed.overwrite) typed.run.leftovers = Leftovers::overwrite;
}

void addHairOptions(CLI::App& command, TypedScene& typed) {
  const char* hair = "Hair";
  command.add_option("--particles", typed.scene.particles, "Particles of each strand (default 64)")
      ->check(wholeBetween(2, 65536))
      ->type_name("N")
      ->group(hair);
  command
      .add_option(
          "--strands", typed.scene.strands,
          "Strands side by side (default 1; release 32; flip 100, bust 500, head 1500); of each swatch (curtain 50, "
          "pile and fall 12), in whole rows")
      ->check(wholeBetween(1, 100'000))
      ->type_name("N")
      ->group(hair);
  command
      .add_option("--preload", typed.scene.preload,
                  "Share of gravity balanced in the rest pose, 0 to 1 (default: the scene's; 0 for paper)")
      ->check(between(0, 1))
      ->type_name("P")
      ->group(hair);
  command
      .add_option(
          "--bend-stiffness", typed.scene.bendStiffness,
          "Stiffness that keeps the curl's shape, in weights of a strand, 0 to 1e5 (default: the scene's)")
      ->check(between(0, 1e5))
      ->type_name("W")
      ->group(hair);
  command.add_option("--core", typed.core, "Core spring on or off (default on)")
      ->check(oneOf({"on", "off"}))
      ->type_name("STATE")
      ->group(hair);
  command
      .add_option("--frames-on", typed.framesOn,
                  "Strand frames on the smoothed or the raw strand (default smoothed)")
      ->check(oneOf({"smoothed", "raw"}))
      ->type_name("WHICH")
      ->group(hair);

  addSetOption(command, typed.changes, hair);
}

void addSolverOptions(CLI::App& command, TypedScene& typed) {
  const char* solver = "Solver";
  command
      .add_option("--integrator", typed.names.integrator, "jacobi, point_jacobi or paper (default jacobi)")
      ->check(oneOf({std::begin(kIntegratorNames), std::end(kIntegratorNames)}))
      ->type_name("NAME")
      ->group(solver);
  command
      .add_option("--steps-per-frame", typed.scene.stepsPerFrame,
                  "Outer steps a frame of 1/24 s, 1 to 340 (default 8; 30 for paper)")
      ->check(wholeBetween(1, 340))
      ->type_name("N")
      ->group(solver);
  command.add_option("--seconds", typed.scene.seconds, "Length of the scene (default: its own)")
      ->check(between(0.001, 36'000))
      ->type_name("S")
      ->group(solver);
  addBackendOption(command, typed.names.backend)->group(solver);
  addDeviceOption(command, typed.run.device)->group(solver);
  command.add_option("--subgroup", typed.subgroup, kSubgroupHelp)
      ->check(wholeBetween(1, 128))
      ->type_name("N")
      ->group(solver);
  command
      .add_flag("--untuned", typed.untuned,
                "Choose the kernel's shapes by the built-in model, whatever `ringlet tune` measured")
      ->group(solver);
}

}  // namespace

void addSceneCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedScene>();
  CLI::App* command =
      app.add_subcommand("scene", "Runs a built-in scene and measures what becomes of its hair");
  command->footer(kSceneExample + sceneReportsHelp() + kSceneExitHelp);
  command->add_option("NAME", typed->name, "The scene; see --list")
      ->check(oneOf(sceneNames()))
      ->type_name("NAME");
  command->add_flag("--list", typed->list, "Print the scenes and what each shows");
  command->add_flag("--keys", typed->keys, "Print every key of a scene file");
  command
      ->add_option("--write", typed->file,
                   "Do not run the scene but write it as a scene file, its groom beside it (FILE-groom.obj)")
      ->check(endsIn({".toml"}))
      ->type_name("FILE");
  command->add_option("-o,--output", typed->run.folder, "Folder for the animation (default: none is written)")
      ->type_name("DIR");
  command->add_flag("--overwrite", typed->overwrite,
                    "Begin anew where DIR holds files of another run, finished or not");

  addHairOptions(*command, *typed);
  addDialOptions(command, typed->dials, "Dials");
  addContactOptions(*command, typed->changes, "in scenes of hair that meets hair");

  addSolverOptions(*command, *typed);
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary");
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary");

  command->callback([typed, command, &exitCode] {
    typed->list || typed->keys ? checkList(*command, typed->list) : resolve(*typed);
    exitCode = run(*typed);
  });
}

}  // namespace ringlet::program
