// Implements measure_command.h.
#include "program/measure/measure_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/keys_help.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/measure/benchmark_cases.h"
#include "program/measure/benchmark_score.h"
#include "program/measure/measure_plot.h"
#include "program/measure/measure_report.h"
#include "program/measure/measure_run.h"

namespace ringlet::program {
namespace {

constexpr const char* kMeasureExample =
    "Examples:\n"
    "  ringlet measure groom.obj                     the curls of a groom\n"
    "  ringlet measure groom.obj settled.obj         what is left of them in another pose\n"
    "  ringlet measure groom.obj out --json          and in what `ringlet simulate` wrote\n"
    "  ringlet measure groom.obj out --against settled.obj\n"
    "                                                and how far that is from one more pose\n"
    "  ringlet measure groom.obj auto --against explicit --without off\n"
    "                                                three runs: do contacts let hair move as they should?\n"
    "  ringlet measure groom.obj out --plot out.svg --over softer --over stiffer\n"
    "                                                three motions of it over each other\n"
    "  ringlet measure --benchmark bench --write     the neutral benchmark's files, for any simulator\n"
    "  ringlet measure --benchmark bench             how well their runs went\n"
    "\n"
    "A USD file (.usda, .usdc, .usd, .usdz) states its unit and its up axis, and so does an .abc that Ringlet\n"
    "wrote; --unit and --up go before them.\n"
    "OTHER is a groom with the same strands, a folder that `ringlet simulate` wrote, or an animation, of Ringlet\n"
    "or of another program.\n"
    "A hair.usda may be the groom as well: its first frame is.\n"
    "In an animation the groom counts as the frame before the first; tables show the last frame.\n"
    "Everything is seen from the head: each strand from its root, turned as the roots together turn (one\n"
    "root, or roots on a line, cannot show every turn; the head then turns as little as they allow).\n"
    "Bounce (of the core's length), sway and settling are those after the head last drove the hair.\n"
    "--against compares that pose, or the last frame, with one more, in REST's unit, their roots put together. Of\n"
    "two animations it also compares all frames that both have, and --without is the same motion without\n"
    "contacts; hairs are as thick as contacts have them unasked. A stiff volume keeps all and moves little, so\n"
    "look at way, tips and kept.\n"
    "--plot draws the series of OTHER and of each --over over time. What is zero all the while is left out. It\n"
    "needs gnuplot.\n"
    "\n";
constexpr const char* kMeasureExitHelp =
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage.";

// The command line as typed.
struct TypedMeasure {
  MeasurePlan plan;
  std::filesystem::path benchmark;
  bool json = false, strands = false, write = false;
};

Status runBenchmark(const TypedMeasure& typed) {
  if (typed.write) return writeBenchmark(typed.benchmark);
  const auto scores = scoreBenchmark(typed.benchmark);
  if (!scores) return scores.error();
  typed.json ? printJson(benchmarkJson(*scores)) : print("{}", benchmarkText(*scores));
  return {};
}

int run(const TypedMeasure& typed) {
  if (typed.benchmark.empty() == typed.plan.rest.empty())
    throw CLI::ValidationError("REST", "name a groom at rest, or the folder of --benchmark");
  if (!typed.benchmark.empty()) {
    const Status done = runBenchmark(typed);
    return done ? kExitFine : fail("measure", done.error());
  }
  auto measured = runMeasure(typed.plan);
  if (!measured) return fail("measure", measured.error());
  if (typed.json) {
    printJson(measuredJson(*measured, typed.strands));
  } else {
    print("{}{}", measuredText(*measured), typed.strands ? strandsText(*measured) : "");
  }
  return kExitFine;
}

}  // namespace

void addMeasureCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedMeasure>();
  CLI::App* command = app.add_subcommand("measure", "Measures the curl of a groom, and what became of it");
  command->footer(kMeasureExample + keysHelp(measureKeys()) +
                  keysHelp(benchmarkKeys(), "--json keys with --benchmark:") + kMeasureExitHelp);
  command
      ->add_option("REST", typed->plan.rest,
                   "The groom at rest: a .hair, .obj, .usd, .abc, .tfx, .ply, .data or .bin file")
      ->type_name("FILE");
  command
      ->add_option("OTHER", typed->plan.other,
                   "What became of it: a pose (a groom's file), a folder, an animation")
      ->type_name("PATH");
  command
      ->add_option(
          "--unit", typed->plan.metresPerUnit,
          "Metres per unit of the files (default: the animation's, else what the file states, else 0.01: "
          "centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command->add_option("--up", typed->plan.up, "The files' up axis, Y or Z (default: the animation's, else Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS");
  addOptionsOfKeys(*command, typed->plan.reading, {"groom.points_per_strand"});
  command
      ->add_option(
          "--against", typed->plan.against,
          "Another pose of these strands (a groom's file) or what another run wrote, to compare with")
      ->type_name("PATH");
  command
      ->add_option("--without", typed->plan.without,
                   "What a run without contacts wrote, to say which share of overlap is kept apart")
      ->needs("--against")
      ->type_name("PATH");
  CLI::Option* plotted = command
                             ->add_option("--plot", typed->plan.plot,
                                          "Draws what changes over time into a .svg or .png (needs gnuplot)")
                             ->check(CLI::Validator(
                                 [](const std::string& path) {
                                   return canPlotInto(path) ? "" : "a plot is a .svg or .png file";
                                 },
                                 ""))
                             ->type_name("FILE");
  command->add_option("--over", typed->plan.over, "One more run of REST in the plot; may be repeated")
      ->needs(plotted)
      ->type_name("PATH")
      ->allow_extra_args(false);
  CLI::Option* benchmark =
      command
          ->add_option("--benchmark", typed->benchmark,
                       "In place of REST: the folder of the neutral benchmark, whose cases "
                       "any simulator ran; says how well each went")
          ->type_name("DIR");
  command->add_flag("--write", typed->write, "Write the files of the benchmark's cases into DIR")
      ->needs(benchmark);
  command->add_flag("--strands", typed->strands, "Every strand by itself too");
  command->add_flag("--json", typed->json, "Print one JSON object instead of tables");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
