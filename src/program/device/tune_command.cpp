// Implements tune_command.h: options, and the table. tune_run.cpp measures, tuned_shapes.cpp writes the file.
#include "program/device/tune_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/growing_report.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_output.h"
#include "program/device/open_device.h"
#include "program/device/tune_run.h"
#include "program/device/tuned_shapes.h"
#include "program/simulate/run_report.h"
#include "ringlet/groom/groom_file.h"

namespace ringlet::program {
namespace {

constexpr const char* kTuneHelp =
    "Examples:\n"
    "  ringlet tune\n"
    "  ringlet tune groom.hair --seconds 60\n"
    "  ringlet tune --particles 24 100 --device 0\n"
    "  ringlet tune --work contacts,volume,bodies --seconds 120\n"
    "\n"
    "A strand is laid over a device as lanes x run, or in one lane in memory (serial). Which shape is "
    "fastest\n"
    "is the device's matter: tune times them in turn, each held against another first, and remembers device\n"
    "times in strand_shapes.toml in $RINGLET_CACHE_DIR (else $XDG_CACHE_HOME/ringlet, ~/.cache/ringlet).\n"
    "`simulate` and `scene` then choose by these where hair is alone (jacobi; no contacts, bodies or air), "
    "on\n"
    "the same device and driver and with the same ringlet; what was not timed counts as the model has it, "
    "in\n"
    "proportion. Where the driver lets the subgroup width be chosen, shapes are timed at every width, and "
    "the\n"
    "width whose best shapes are fastest over all lengths is remembered with its times. How long a kernel "
    "takes to make counts too: few strands keep one that is soon there.\n"
    "Another shape gives other last bits: --untuned leaves it aside. Tuning again replaces what was\n"
    "measured before.\n"
    "--work says what strands do while shapes are timed: nothing else (alone), or they meet each other, pair "
    "by\n"
    "pair (contacts) or as a volume, or a sphere (bodies); these three are timed with a quarter of the "
    "strands.\n"
    "Only times of alone are remembered: runs with other work choose shapes by the built-in model.\n"
    "\n"
    "--json keys: device driver rounds left_out (shapes there was no time for) subgroup (the fastest width; "
    "0 without alone)\n"
    "shapes (of each work particles shape lanes run (0: serial) subgroup\n"
    "ns_per_particle_step model_ns_per_particle_step difference against) troubles file\n"
    "interrupted. difference: the farthest particle from where `against` has it after a frame, as a share "
    "of\n"
    "the strands' length. troubles: of each work particles shape lanes run subgroup message: a shape that "
    "cannot be had, or\n"
    "that is not where another is after a frame; the others are timed, and nothing is remembered\n"
    "where hair alone has troubles.\n"
    "--report: the file is whole after each shape and round, a second apart at least; of a shape that is not "
    "timed\n"
    "yet, ns_per_particle_step is null.\n"
    "\n"
    "Exit status: 0 done, 1 something failed or a shape is wrong, 2 wrong usage, 130 Ctrl-C (nothing is "
    "remembered).";

// The command line as typed.
struct TypedTune {
  std::filesystem::path groom, report;
  std::vector<std::uint32_t> particles;
  std::vector<std::string> works;
  std::string device;
  TuneOptions options;
  bool json = false, quiet = false;
  TypedKeys reading;
};

nlohmann::ordered_json asJson(const ComputeDevice& device, const TuneOutcome& outcome,
                              const std::filesystem::path& file) {
  nlohmann::ordered_json json{{"device", device.name()},          {"driver", device.driver()},
                              {"rounds", outcome.rounds},         {"left_out", outcome.leftOut},
                              {"subgroup", outcome.subgroupSize}, {"shapes", nlohmann::json::array()}};
  const auto shapeOf = [](const auto& one) {
    return nlohmann::ordered_json{
        {"work", nameOf(one.work)},          {"particles", one.particleCount},
        {"shape", one.shape.describe()},     {"lanes", one.shape.serial() ? 0 : one.shape.lanes},
        {"run", one.shape.particlesPerLane}, {"subgroup", one.subgroupSize}};
  };
  for (const TimedShape& one : outcome.timed) {
    nlohmann::ordered_json shape = shapeOf(one);
    shape["ns_per_particle_step"] =
        one.nanoseconds > 0 ? nlohmann::ordered_json(one.nanoseconds) : nlohmann::ordered_json();
    shape["model_ns_per_particle_step"] = one.model;
    shape["difference"] = one.difference;
    shape["against"] = one.against.describe();
    json["shapes"].push_back(std::move(shape));
  }
  json["troubles"] = nlohmann::json::array();
  for (const ShapeTrouble& one : outcome.troubles) {
    nlohmann::ordered_json trouble = shapeOf(one);
    trouble["message"] = one.error.message;
    json["troubles"].push_back(std::move(trouble));
  }
  json["file"] = file.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(file.string());
  json["interrupted"] = outcome.interrupted;
  return json;
}

// A star marks the fastest shape of each kind of work and length.
std::string asText(const ComputeDevice& device, const TuneOutcome& outcome,
                   const std::filesystem::path& file) {
  std::string text = fmt::format(
      "{} ({}), ns a particle and step, medians of {} rounds\n"
      "  work      particles  shape          subgroup  measured     model  differs by\n",
      device.name(), device.driver(), outcome.rounds);
  for (const TimedShape& one : outcome.timed) {
    const bool isFastest = std::ranges::none_of(outcome.timed, [&](const TimedShape& other) {
      return other.work == one.work && other.particleCount == one.particleCount &&
             other.nanoseconds < one.nanoseconds;
    });
    text += fmt::format("  {:<8}  {:>9}  {:<14} {:>8} {:>9.4g} {:>9.4g}  {:.1e} from {}\n", nameOf(one.work),
                        one.particleCount, one.shape.describe() + (isFastest ? " *" : ""),
                        one.shape.serial() ? "" : std::to_string(one.subgroupSize), one.nanoseconds,
                        one.model, one.difference, one.against.describe());
  }
  if (!file.empty())
    text += fmt::format("  remembered, for subgroups of {}, in {}\n", outcome.subgroupSize, file.string());
  return text;
}

Result<std::vector<std::uint32_t>> lengthsOf(const TypedTune& typed) {
  if (typed.groom.empty()) {
    std::vector<std::uint32_t> lengths = typed.particles.empty() ? TuneOptions{}.lengths : typed.particles;
    std::ranges::sort(lengths);
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    return lengths;
  }
  const auto loaded = readGroom(typed.groom, readingOf(typed.reading));
  if (!loaded) return loaded.error();
  std::vector<std::uint32_t> counts;
  for (std::size_t s = 0; s < loaded->groom.strandCount(); ++s)
    counts.push_back(static_cast<std::uint32_t>(loaded->groom.strand(s).size()));
  if (counts.empty())
    return Error{fmt::format("{}: has no strands to take lengths from", typed.groom.string())};
  return typicalLengths(std::move(counts));
}

// The kinds of work that were typed, each once, in the order of kTuneWorks.
std::vector<TuneWork> worksOf(const TypedTune& typed) {
  std::vector<TuneWork> works;
  for (const TuneWork work : kTuneWorks) {
    if (std::ranges::find(typed.works, nameOf(work)) != typed.works.end()) works.push_back(work);
  }
  return works.empty() ? TuneOptions{}.works : works;
}

int run(TypedTune& typed) {
  auto lengths = lengthsOf(typed);
  if (!lengths) return fail("tune", lengths.error());
  typed.options.lengths = std::move(*lengths);
  typed.options.works = worksOf(typed);
  typed.options.showProgress = !typed.quiet;
  const auto device = openDevice(typed.device);
  if (!device) return fail("tune", device.error());
  const GrowingReport report(typed.report);
  if (report.isThere())
    typed.options.grow = [&](const TuneOutcome& soFar) { return report.grow(asJson(*device, soFar, {})); };
  const auto outcome = timeShapes(*device, typed.options);
  if (!outcome) return fail("tune", outcome.error());

  // The table is shown even if the result cannot be stored.
  Result<std::filesystem::path> file = std::filesystem::path{};
  if (!outcome->costs.empty()) file = rememberShapes(*device, outcome->costs, outcome->subgroupSize);
  const std::filesystem::path written = file ? *file : std::filesystem::path{};
  for (const std::string& message : device->validationMessages())
    say("ringlet tune: warning: Vulkan validation: {}\n", message);
  if (outcome->leftOut > 0)
    say("ringlet tune: warning: no time for {} of the shapes; give it more with --seconds\n",
        outcome->leftOut);
  if (Status told = report.finish(asJson(*device, *outcome, written)); !told)
    return fail("tune", told.error());
  if (typed.json) {
    printJson(asJson(*device, *outcome, written));
  } else if (!typed.quiet && !outcome->interrupted) {
    print("{}", asText(*device, *outcome, written));
  }
  if (outcome->interrupted) {
    say("ringlet tune: interrupted; nothing was remembered\n");
    return kExitInterrupted;
  }
  for (const ShapeTrouble& one : outcome->troubles) say("ringlet tune: {}\n", one.error.message);
  if (!outcome->troubles.empty()) {
    if (written.empty()) say("ringlet tune: nothing was remembered\n");
    return exitCodeOf(outcome->troubles.front().error);
  }
  return file ? kExitFine : fail("tune", file.error());
}

}  // namespace

void addTuneCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedTune>();
  CLI::App* command =
      app.add_subcommand("tune", "Measures which strand shapes are fastest on a device, and remembers it");
  command->footer(kTuneHelp);
  CLI::Option* groom =
      command
          ->add_option(
              "GROOM", typed->groom,
              "A groom (.hair, .obj, .usd, .abc, .tfx, .ply, .data, .bin) whose strands' lengths to tune for: four "
              "at most that stand for all")
          ->type_name("FILE");
  addOptionsOfKeys(*command, typed->reading, {"groom.points_per_strand"});
  command
      ->add_option(
          "--particles", typed->particles,
          "Particles of the strands to tune for, 8 numbers at most, 2 to 3000 (default 16 32 64 128)")
      ->check(wholeBetween(2, 3000))
      ->expected(1, 8)
      ->type_name("N")
      ->excludes(groom);
  command
      ->add_option(
          "--strands", typed->options.strandCount,
          "Strands of each length, 1 to 100,000 (default: as many as have 65,536 particles on a CPU device, "
          "1,048,576 on others)")
      ->check(wholeBetween(1, 100'000))
      ->type_name("N");
  command
      ->add_option(
          "--work", typed->works,
          "What strands do while they are timed: alone, contacts, volume, bodies, or several of these "
          "(default alone)")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kTuneWorkNames), std::end(kTuneWorkNames))))
      ->delimiter(',')
      ->type_name("WORK");
  command
      ->add_option(
          "--seconds", typed->options.seconds,
          "How long it may take, about; a third of it for timing, the rest for compiling (default 20)")
      ->check(between(0.1, 3600))
      ->type_name("S");
  addDeviceOption(*command, typed->device);
  command
      ->add_option("--report", typed->report,
                   "Writes the JSON to this file, too, and what is known meanwhile")
      ->type_name("FILE");
  command->add_flag("--json", typed->json, "Print one JSON object instead of the table");
  command->add_flag("--quiet", typed->quiet, "No progress bar and no table");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
