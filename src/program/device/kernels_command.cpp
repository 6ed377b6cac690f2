// Implements kernels_command.h: options, the table and its JSON. kernels_child.cpp compiles the kernels.
#include "program/device/kernels_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/growing_report.h"
#include "program/cli/standard_output.h"
#include "program/device/kernels_child.h"
#include "program/device/kernels_list.h"
#include "program/device/kernels_statistics.h"
#include "ringlet/gpu/device.h"
#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKernelsHelp =
    "Examples:\n"
    "  ringlet kernels\n"
    "  ringlet kernels --statistics --json kernels.json\n"
    "  ringlet kernels --only 'hair alone'\n"
    "  ringlet kernels --statistics --only 'hair alone' --shapes 8x4,4x8\n"
    "  RADV_FORCE_FAMILY=navi21 ringlet kernels --statistics\n"
    "\n"
    "Compiles every kernel that a run could use on this device: the strand kernels of each kind of work in\n"
    "the shapes that are planned for 16 to 256 particles and in the serial form, and the contact kernels.\n"
    "A line a kernel: the subgroup size it got (`-`: the driver does not tell), the seconds the driver's\n"
    "compiler took, and with --statistics what the driver tells of the machine code: registers, spilled\n"
    "registers, scratch memory, code size, waves. It needs VK_KHR_pipeline_executable_properties for that.\n"
    "Flags: `spills` (registers did not suffice, and values go through memory; NVIDIA's driver tells only "
    "of\n"
    "local memory, in which arrays are too), `1 wave` (what issues instructions has one subgroup at a time "
    "and\n"
    "cannot hide waiting times).\n"
    "\n"
    "lavapipe compiles to machine code only at a kernel's first use; the seconds there are those before it.\n"
    "\n"
    "Each kernel is compiled in a process of its own, since drivers crash in their own statistics: such a\n"
    "kernel is compiled again without them, and its line says so. No hair is simulated, so that a driver\n"
    "without hardware will do: RADV takes RADV_FORCE_FAMILY=navi21 and the like.\n"
    "\n"
    "--json keys: device driver kernels (of each name compiled trouble subgroup (null: not told) seconds\n"
    "flags statistics (of each name value)). The file is whole after each kernel.\n"
    "\n"
    "Exit status: 0 all compiled, 1 one did not or something failed, 2 wrong usage.";

// The command line as typed.
struct TypedKernels {
  std::string device, only;
  std::vector<std::string> shapes;  // LANESxRUN
  std::filesystem::path json;
  bool statistics = false;
  int one = -1;  // in a child: index of the kernel; `statistics` then asks for statistics
};

Result<ComputeDevice> openToCompile(const TypedKernels& typed) {
  gpu::DeviceOptions options;
  options.allowNull = true;
  options.inspection = typed.statistics ? gpu::Inspection::statistics : gpu::Inspection::sizes;
  auto opened = gpu::Device::open(typed.device, options);
  if (!opened) return opened.error();
  return ComputeDevice::over(std::move(*opened));
}

bool hasPart(const std::string& whole, const char* part) { return whole.find(part) != std::string::npos; }

std::string lineOf(const ListedKernel& kernel, const CompiledKernel& compiled) {
  std::string line = fmt::format("  {:<56} {:>8} {:>8}", kernel.name,
                                 compiled.subgroup ? fmt::to_string(*compiled.subgroup) : "-",
                                 compiled.isCompiled ? fmt::format("{:.2f} s", compiled.seconds) : "FAILED");
  const auto add = [&](const std::string& text) {
    if (!text.empty()) line += "  " + text;
  };
  add(statisticsText(compiled.statistics));
  for (const std::string& flag : flagsOf(compiled.statistics)) add("[" + flag + "]");
  add(compiled.trouble);
  return line;
}

Json asJson(const ListedKernel& kernel, const CompiledKernel& compiled) {
  Json json{
      {"name", kernel.name},         {"compiled", compiled.isCompiled},
      {"trouble", compiled.trouble}, {"subgroup", compiled.subgroup ? Json(*compiled.subgroup) : Json()},
      {"seconds", compiled.seconds}, {"flags", flagsOf(compiled.statistics)},
      {"statistics", Json::array()}};
  for (const gpu::KernelStatistic& one : compiled.statistics)
    json["statistics"].push_back({{"name", one.name}, {"value", one.value}});
  return json;
}

// The device's shapes with runs in registers that were typed.
Result<std::vector<StrandShape>> shapesOf(const TypedKernels& typed, const DeviceLimits& limits) {
  std::vector<StrandShape> shapes;
  const std::vector<ShapeCost> offered = shapeCosts(limits);
  for (const std::string& text : typed.shapes) {
    const auto found = std::ranges::find_if(offered, [&](const ShapeCost& one) {
      return !one.shape.inMemory && text == fmt::format("{}x{}", one.shape.lanes, one.shape.particlesPerLane);
    });
    if (found == offered.end())
      return Error{fmt::format(
          "--shapes {}: no such shape with runs in registers here; it is LANESxRUN, as in 8x4, with lanes a "
          "power of two up to {}, and a run of {} or more",
          text, limits.subgroupSize, kShortestRun)};
    shapes.push_back(found->shape);
  }
  return shapes;
}

// Compiles with statistics; if the driver crashes, without.
CompiledKernel compileSafely(const TypedKernels& typed, int device, std::size_t index) {
  std::vector<std::string> arguments{"kernels", "--device", std::to_string(device), "--one",
                                     std::to_string(index)};
  if (!typed.shapes.empty()) {
    arguments.push_back("--shapes");
    arguments.push_back(fmt::format("{}", fmt::join(typed.shapes, ",")));
  }
  if (!typed.statistics) return compileInChild(arguments);
  std::vector<std::string> withStatistics = arguments;
  withStatistics.push_back("--statistics");
  CompiledKernel compiled = compileInChild(withStatistics);
  if (compiled.isCompiled || !compiled.trouble.starts_with("the driver crashed")) return compiled;
  CompiledKernel again = compileInChild(arguments);
  if (again.isCompiled) again.trouble = compiled.trouble + " in its statistics";
  return again;
}

int run(const TypedKernels& typed) {
  const auto device = openToCompile(typed);
  if (!device) return fail("kernels", device.error());
  const auto shapes = shapesOf(typed, device->limits());
  if (!shapes) return fail("kernels", shapes.error());
  const std::vector<ListedKernel> kernels = listKernels(*device, *shapes);
  if (typed.one >= 0) {
    if (typed.one >= static_cast<int>(kernels.size()))
      return fail("kernels", {"there are fewer kernels than that"});
    printCompiled(compileKernel(*device, kernels[static_cast<std::size_t>(typed.one)]));
    return kExitFine;
  }

  const gpu::DeviceProperties& p = device->gpu().properties();
  print("{} ({}), {} kernels\n", p.name, p.driver, kernels.size());
  if (typed.statistics && p.inspection == gpu::Inspection::none)
    print("  this driver has no statistics (VK_KHR_pipeline_executable_properties)\n");
  print("  {:<56} {:>8} {:>8}\n", "kernel", "subgroup", "compiled");
  Json json{{"device", p.name}, {"driver", p.driver}, {"kernels", Json::array()}};
  const GrowingReport report(typed.json);
  if (Status written = report.grow(json); !written) return fail("kernels", written.error());
  int failures = 0;
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    if (!hasPart(kernels[k].name, typed.only.c_str())) continue;
    const CompiledKernel compiled = compileSafely(typed, p.index, k);
    print("{}\n", lineOf(kernels[k], compiled));
    std::fflush(stdout);
    json["kernels"].push_back(asJson(kernels[k], compiled));
    if (Status written = report.grow(json); !written) return fail("kernels", written.error());
    failures += !compiled.isCompiled;
  }
  if (Status written = report.finish(json); !written) return fail("kernels", written.error());
  if (failures > 0)
    return fail("kernels", {fmt::format("{} of {} kernels did not compile", failures, json["kernels"].size()),
                            Fault::compile});
  return kExitFine;
}

}  // namespace

void addKernelsCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedKernels>();
  CLI::App* command =
      app.add_subcommand("kernels", "Compiles every kernel on a device, and says what the driver made of it");
  command->footer(kKernelsHelp);
  addDeviceOption(*command, typed->device);
  command->add_flag("--statistics", typed->statistics,
                    "Tell of registers, spills, scratch, code size, waves");
  command->add_option("--json", typed->json, "Writes it to this file as one JSON object, too")
      ->type_name("FILE");
  command->add_option("--only", typed->only, "Only kernels with this in their name")->type_name("TEXT");
  command
      ->add_option("--shapes", typed->shapes,
                   "Strand kernels in these shapes, LANESxRUN,..., and not in those that are planned")
      ->type_name("SHAPES")
      ->delimiter(',');
  // In a child process: compiles the kernel with this index and prints one line.
  command->add_option("--one", typed->one)->group("");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
