// Implements sweep_command.h: turns options into a plan. sweep_run.cpp runs it, sweep_table.cpp and
// sweep_sheet.cpp show the results.
#include "program/sweep/sweep_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "program/cli/command_line.h"
#include "program/cli/confined_option.h"
#include "program/cli/exit_codes.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/simulate/output_options.h"
#include "program/simulate/run_report.h"
#include "program/sweep/sweep_plan.h"
#include "program/sweep/sweep_run.h"
#include "program/sweep/sweep_sheet.h"
#include "program/sweep/sweep_table.h"
#include "ringlet/base/whole_file.h"

namespace ringlet::program {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  ringlet sweep scene.toml --vary material.dials.hold=0.5:2:5 -o out\n"
    "  ringlet sweep scene.toml --vary material.preset=wavy,ringlet,coil --vary simulation.gravity=5,9.81 -o "
    "out\n"
    "  ringlet sweep scene.toml --vary simulation.frames=24 --vary 'air.wind=[0,0,0],[3,0,0]' -o out\n"
    "  ringlet sweep scene.toml --vary material.dials.hold=0.5:2:5 --only 2/4 -o out     one of four "
    "machines\n"
    "\n"
    "KEY is any key of a scene file with its table (`ringlet scene --keys`, `ringlet material --list`), "
    "whether or not the\n"
    "scene has it; of tables that may stand several times the number comes after the name: body.1.radius. A "
    "key with one\n"
    "value is the same in all runs.\n"
    "\n"
    "Writes into DIR: run-0001, run-0002, ... with what `ringlet simulate` writes, scene.toml, which that "
    "command runs\n"
    "again, and run.json; sweep.csv and sweep.json, the table; sheet.png, the last frame of each run. The "
    "same command\n"
    "again runs what is not finished, and refuses a folder with runs of something else.\n"
    "\n"
    "--json prints runs, of each: run folder state (finished, kept from before, failed, interrupted, to do) "
    "exit_status\n"
    "values error and frames droop_mm (of tips, mean) stretch_mean stretch_max (of edges, in the last frame) "
    "max_edge_stretch (of every step)\n"
    "nonfinite steps_per_frame ms_per_frame seconds positions_hash device; with --measure core_elongation "
    "turns\n"
    "mean_radius_mm bounce_hz settle_s energy_ratio, as `ringlet measure` has them.\n"
    "\n"
    "Exit status: 0 all runs are done; of runs that failed that of the first, as for simulate; 130 Ctrl-C.";

// The command line as typed.
struct TypedSweep {
  std::filesystem::path scene;
  std::vector<std::string> vary;
  TypedKeys keys;
  std::string only, backend = "gpu";
  SceneReach reach = SceneReach::anywhere;
  SweepOptions options;
  bool noSheet = false, untuned = false, list = false, json = false, quiet = false;
};

// Reads "2/4", the second of four parts. Throws CLI11's error for anything else.
void readPart(const std::string& typed, SweepOptions& options) {
  const std::size_t slash = typed.find('/');
  const auto number = [](std::string_view text) {
    std::size_t value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc{} && end == text.data() + text.size() ? value : 0;
  };
  if (slash != std::string::npos) {
    options.part = number(std::string_view(typed).substr(0, slash));
    options.parts = number(std::string_view(typed).substr(slash + 1));
  }
  if (slash == std::string::npos || options.part < 1 || options.parts < options.part)
    throw CLI::ValidationError("--only",
                               fmt::format("'{}' is no part; expected i/n, from 1/n to n/n", typed));
}

// Reports conflicts, and what would be lost, before anything runs.
std::vector<SweepAxis> readAxes(const TypedSweep& typed) {
  std::vector<SweepAxis> axes;
  for (SceneChange& set : typed.keys.changes()) axes.push_back({std::move(set.key), {std::move(set.value)}});
  for (const std::string& text : typed.vary) {
    auto axis = parseAxis(text);
    if (!axis) throw CLI::ValidationError("--vary", axis.error().message);
    axes.push_back(std::move(*axis));
  }
  return axes;
}

Status writeText(const std::filesystem::path& path, const std::string& text) {
  return writeWholeFile(path, std::as_bytes(std::span<const char>(text)));
}

// Writes the table and the sheet with all results so far.
Status writeResults(std::vector<SweepEntry>& entries, std::span<const SweepAxis> axes,
                    const SweepOptions& options) {
  const std::string json =
      sweepJson(entries, axes, options).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (Status written = writeText(options.folder / "sweep.json", json); !written) return written;
  if (Status written = writeText(options.folder / "sweep.csv", sweepCsv(entries, axes, options)); !written)
    return written;
  if (!options.drawsSheet) return {};
  return writeSweepSheet(options.folder / "sheet.png", entries, axes, options);
}

// Warns if runs used several devices, whose results differ in the last digits.
void warnOfDevices(std::span<const SweepEntry> entries) {
  std::set<std::string> devices;
  for (const SweepEntry& entry : entries) {
    if (entry.report.is_object())
      devices.insert(entry.report.value("device", "") + entry.report.value("driver", ""));
  }
  if (devices.size() > 1)
    say("ringlet sweep: warning: these runs are of {} devices or drivers; the last digits of equal runs "
        "differ\n",
        devices.size());
}

int run(TypedSweep& typed) {
  const std::vector<SweepAxis> axes = readAxes(typed);
  SweepOptions& options = typed.options;
  if (!typed.only.empty()) readPart(typed.only, options);
  options.onReference = typed.backend == "reference";
  if (options.onReference && (!options.device.empty() || typed.untuned))
    throw CLI::ValidationError(typed.untuned ? "--untuned" : "--device", "only --backend gpu has a device");
  options.usesTuned = !typed.untuned;
  options.drawsSheet = !typed.noSheet;
  options.showProgress = !typed.quiet;

  const auto runs = planRuns(typed.scene, axes, typed.reach);
  if (!runs) return fail("sweep", runs.error());
  if (!options.lastOnly)
    for (const SweepRun& run : *runs) checkOutputs(run.scene.output);
  auto entries = lookAtRuns(*runs, options);
  if (!entries) return fail("sweep", entries.error());
  if (!typed.list) {
    std::error_code code;
    std::filesystem::create_directories(options.folder, code);
    if (code)
      return fail("sweep",
                  {fmt::format("cannot create the folder {}: {}", options.folder.string(), code.message()),
                   Fault::output});
    if (Status ran = runSweep(*entries, axes, options); !ran) return fail("sweep", ran.error());
    warnOfDevices(*entries);
    if (Status written = writeResults(*entries, axes, options); !written)
      return fail("sweep", written.error());
  }
  if (typed.json) {
    printJson(sweepJson(*entries, axes, options));
  } else if (!typed.quiet) {
    print("{}", sweepText(*entries, axes, options));
    if (!typed.list) print("{}\n", (options.folder / "sweep.csv").string());
    if (!typed.list && options.drawsSheet) print("{}\n", (options.folder / "sheet.png").string());
  }
  return typed.list ? kExitFine : exitCodeOf(*entries);
}

void addSweepMachine(CLI::App& command, TypedSweep& typed) {
  const char* machine = "Machine";
  addBackendOption(command, typed.backend)->group(machine);
  addDeviceOption(command, typed.options.device)->group(machine);
  command
      .add_flag("--untuned", typed.untuned,
                "Choose kernels by the built-in model, whatever `ringlet tune` measured")
      ->group(machine);

  command
      .add_option(
          "--jobs", typed.options.jobs,
          "Runs at a time: one is read, prepared and written while another is stepped (default 2; 1 where "
          "ms_per_frame is to be of a run by itself)")
      ->check(wholeBetween(1, 64))
      ->type_name("N")
      ->group(machine);
}

void addSweepOutput(CLI::App& command, TypedSweep& typed) {
  const char* output = "Output";
  command
      .add_flag("--last-only", typed.options.lastOnly,
                "Of each run only last.obj: no animation and no picture of its own")
      ->group(output);
  command.add_flag("--no-sheet", typed.noSheet, "Draw no sheet.png of all runs")->group(output);
  command
      .add_flag("--measure", typed.options.measures,
                "Measure every frame as `ringlet measure` does: some 0.3 us a particle and frame, on the CPU")
      ->group(output);
  command
      .add_flag(
          "--json-progress", typed.options.tellsProgress,
          "Print a line of JSON for every frame that is written, as simulate does, with its run, and for "
          "every run: run, runs, state, seconds, seconds_left")
      ->group(output);
  command.add_flag("--json", typed.json, "Print one JSON object instead of the table")->group(output);
  command.add_flag("--quiet", typed.quiet, "No progress bar and no table")->group(output);
}

}  // namespace

void addSweepCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedSweep>();
  SweepOptions& options = typed->options;
  CLI::App* command =
      app.add_subcommand("sweep", "Runs a scene for many values of its keys, and compares them");
  command->footer(kFooter);
  command->add_option("SCENE", typed->scene, "Scene file to vary")
      ->required()
      ->check(endsIn({".toml"}))
      ->type_name("FILE");
  command
      ->add_option(
          "--vary", typed->vary,
          "A key and its values: KEY=a:b:n, n of them evenly from a to b, or KEY=v1,v2,v3; several --vary: "
          "every combination, the last changing fastest")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("KEY=VALUES");
  addSetOption(*command, typed->keys);
  command->add_option("-o,--output", options.folder, "Folder for the results, made if it is not there")
      ->required()
      ->type_name("DIR");
  command->add_option("--only", typed->only, "Only part i of n: its runs are counted out in turn")
      ->type_name("i/n");
  command->add_flag("--list", typed->list, "Print the runs and their states, and run none");
  command->add_flag("--overwrite", options.overwrites, "Run all anew, whatever DIR holds");
  addConfinedOption(*command, typed->reach);

  addSweepMachine(*command, *typed);
  addSweepOutput(*command, *typed);
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
