// Implements conform_command.h: options, and the report as text and JSON. The checks are conform_probes.cpp
// and conform_cases.cpp, the facts conform_facts.cpp.
#include "program/device/conform_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

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
#include "program/cli/standard_output.h"
#include "program/device/conform_break.h"
#include "program/device/conform_cases.h"
#include "program/device/conform_facts.h"
#include "program/device/conform_probes.h"
#include "ringlet/gpu/device.h"

namespace ringlet::program {
namespace {

constexpr const char* kConformHelp =
    "Examples:\n"
    "  ringlet conform\n"
    "  ringlet conform --quick --device 1\n"
    "  ringlet conform --json conform.json > conform.txt\n"
    "\n"
    "Checks whether this device and its driver compute hair correctly. Send the report with a bug.\n"
    "First come facts about the device. Then each line is a check: its outcome, its figure beside the\n"
    "tolerance, and how long the driver compiled for it.\n"
    "  probes           tiny kernels whose results are known exactly: shuffles, loops, bits, barriers,\n"
    "                   atomics, indirect dispatch\n"
    "  hair             every strand shape that is planned for 16, 32, 64, 128 and 256 particles, and the\n"
    "                   serial form: one step against the reference in float, one frame against the\n"
    "                   reference in double, and the same bits when it is run again. Errors are shares of\n"
    "                   the field's scale (of the strand's length for positions).\n"
    "  without texels   the same bits where kernels read storage buffers instead of texel buffers\n"
    "  contacts         lists against brute force, the same bits again, a step, frames, pair by pair and as "
    "a volume\n"
    "  bodies, air      a step and a frame\n"
    "--quick leaves out all shapes but those for 64 particles of hair alone and the serial form, the runs\n"
    "without texels but one, steps and frames with contacts, bodies, and air.\n"
    "\n"
    "Outcomes: right; WRONG (the device does not conform); quirk (the driver is wrong where Ringlet does "
    "not\n"
    "rely on it); skipped (the device lacks what is checked, and Ringlet does without).\n"
    "The last line is `conforms`, or `does not conform` after a list of what is wrong.\n"
    "\n"
    "--json keys: facts (as printed) quick checks (of each name outcome figure tolerance detail\n"
    "compile_seconds) conforms (null until all is checked). The file is whole after each check.\n"
    "\n"
    "Exit status: 0 conforms, 1 does not conform or something failed, 2 wrong usage.";

// The command line as typed.
struct TypedConform {
  std::string device, breaks;
  std::filesystem::path json;
  bool quick = false;
};

Result<ComputeDevice> openToConform(const TypedConform& typed, std::uint64_t mostTexelRecords) {
  gpu::DeviceOptions options;
  options.mostTexelRecords = mostTexelRecords;
  if (!typed.breaks.empty()) options.changeCode = breaking(typed.breaks);
  auto opened = gpu::Device::open(typed.device, options);
  if (!opened) return opened.error();
  return ComputeDevice::over(std::move(*opened));
}

std::string lineOf(const Check& check) {
  std::string figures;
  if (check.figure && check.tolerance)
    figures = *check.tolerance == 0 ? fmt::format("{:g} wrong", *check.figure)
                                    : fmt::format("{:.1e} of {:.1e}", *check.figure, *check.tolerance);
  std::string line =
      fmt::format("  {:<7}  {:<62} {:<18}  {}", wordOf(check.outcome), check.name, figures, check.detail);
  if (check.compileSeconds >= 0.05) line += fmt::format("  (compiled in {:.1f} s)", check.compileSeconds);
  return line;
}

nlohmann::ordered_json asJson(const nlohmann::ordered_json& facts, const TypedConform& typed,
                              const std::vector<Check>& checks, std::optional<bool> conforms) {
  nlohmann::ordered_json json{{"facts", facts}, {"quick", typed.quick}, {"checks", nlohmann::json::array()}};
  const auto orNull = [](const std::optional<double>& number) {
    return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
  };
  for (const Check& check : checks) {
    json["checks"].push_back({{"name", check.name},
                              {"outcome", wordOf(check.outcome)},
                              {"figure", orNull(check.figure)},
                              {"tolerance", orNull(check.tolerance)},
                              {"detail", check.detail},
                              {"compile_seconds", check.compileSeconds}});
  }
  json["conforms"] = conforms ? nlohmann::ordered_json(*conforms) : nlohmann::ordered_json();
  return json;
}

// Prints each line at once, since some checks take a driver's compiler many seconds.
int run(const TypedConform& typed) {
  const auto device = openToConform(typed, 0);
  if (!device) return fail("conform", device.error());
  const auto withoutTexels = openToConform(typed, 1);
  if (!withoutTexels) return fail("conform", withoutTexels.error());

  const nlohmann::ordered_json facts = factsOf(*device);
  print("ringlet conform{}\n{}\n", typed.quick ? " --quick" : "", factsText(facts));
  if (!typed.breaks.empty()) print("  The kernel {} has an error on purpose (--break).\n\n", typed.breaks);
  std::vector<Check> checks;
  const GrowingReport report(typed.json);
  Status written = report.grow(asJson(facts, typed, checks, {}));
  if (!written) return fail("conform", written.error());
  const auto tell = [&](const Check& check) {
    print("{}\n", lineOf(check));
    std::fflush(stdout);
    checks.push_back(check);
    if (written) written = report.grow(asJson(facts, typed, checks, {}));
  };
  runProbes(*device, tell);
  runCases({*device, *withoutTexels, typed.quick}, tell);
  for (const ComputeDevice* one : {&*device, &*withoutTexels}) {
    for (const std::string& message : one->validationMessages())
      tell({.name = "Vulkan validation", .outcome = Check::Outcome::wrong, .detail = message});
  }

  const bool conforms =
      std::ranges::none_of(checks, [](const Check& check) { return check.outcome == Check::Outcome::wrong; });
  if (!conforms) print("\nwrong:\n");
  for (const Check& check : checks) {
    if (check.outcome == Check::Outcome::wrong) print("  {}\n", check.name);
  }
  print("\n{}\n", conforms ? "conforms" : "does not conform");
  written = report.finish(asJson(facts, typed, checks, conforms));
  if (!written) return fail("conform", written.error());
  return conforms ? kExitFine : kExitFailed;
}

}  // namespace

void addConformCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedConform>();
  CLI::App* command =
      app.add_subcommand("conform", "Checks whether a device and its driver compute hair correctly");
  command->footer(kConformHelp);
  addDeviceOption(*command, typed->device);
  command->add_flag("--quick", typed->quick, "Leaves out what takes long; see below");
  command->add_option("--json", typed->json, "Writes the report to this file as one JSON object, too")
      ->type_name("FILE");
  // For tests: puts a known error into a kernel, to show that conform finds it.
  command->add_option("--break", typed->breaks)->check(oneOf(breakableKernels()))->group("");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
