// Implements devices_command.h.
#include "program/device/devices_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "program/cli/exit_codes.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {
namespace {

nlohmann::ordered_json asJson(const std::vector<DeviceSummary>& devices) {
  nlohmann::ordered_json json;
  json["devices"] = nlohmann::json::array();
  for (const DeviceSummary& device : devices) {
    json["devices"].push_back({{"index", device.index},
                               {"name", device.name},
                               {"type", device.type},
                               {"driver", device.driver},
                               {"memory_bytes", device.memoryBytes},
                               {"subgroup", device.subgroupSizes.front()},
                               {"subgroup_reported", device.reportedSubgroupSize},
                               {"subgroup_choices", device.subgroupSizes},
                               {"usable", device.usable},
                               {"why", device.why}});
  }
  return json;
}

// "subgroup 32", or with other possible widths: "subgroup 32 (or 64)".
std::string subgroupText(const DeviceSummary& device) {
  const auto& sizes = device.subgroupSizes;
  std::string others;
  for (std::size_t i = 1; i < sizes.size(); ++i)
    others += fmt::format("{}{}", i == 1 ? "or " : ", ", sizes[i]);
  return fmt::format("subgroup {}{}", sizes.front(), others.empty() ? "" : " (" + others + ")");
}

std::string asText(const std::vector<DeviceSummary>& devices) {
  // Columns as wide as their widest entry.
  std::size_t nameWidth = 4;
  for (const DeviceSummary& device : devices) nameWidth = std::max(nameWidth, device.name.size());
  std::string text;
  for (const DeviceSummary& device : devices) {
    text +=
        fmt::format("{:>2}  {:<{}}  {:<10}  {:>6.1f} GiB  {}  {}{}\n", device.index, device.name, nameWidth,
                    device.type, static_cast<double>(device.memoryBytes) / (1 << 30), subgroupText(device),
                    device.driver, device.usable ? "" : "  (unusable: " + device.why + ")");
  }
  return text;
}

int run(bool json) {
  const auto devices = ComputeDevice::list();
  if (json) {
    printJson(asJson(devices));
  } else {
    print("{}", asText(devices));
  }
  if (std::any_of(devices.begin(), devices.end(), [](const DeviceSummary& d) { return d.usable; }))
    return kExitFine;
  say("ringlet devices: {}; install a Vulkan driver (Debian: mesa-vulkan-drivers has one for the CPU)\n",
      devices.empty() ? "there is no Vulkan device" : "no device can be used");
  return kExitFailed;
}

}  // namespace

void addDevicesCommand(CLI::App& app, int& exitCode) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "devices",
      "Lists the Vulkan devices: number, name, kind, memory, subgroup widths, driver, and why a device "
      "cannot be used");
  command->add_flag("--json", *json, "Print one JSON object");
  command->footer(
      "subgroup: the width strand kernels are given by default, and in brackets what else --subgroup of "
      "simulate\n"
      "and scene can ask for.\n\n"
      "--json keys: devices (of each index name type driver memory_bytes subgroup (by default)\n"
      "subgroup_reported (by the driver) subgroup_choices usable why)\n\n"
      "Example:\n  ringlet devices\n  ringlet simulate groom.obj --device 0 -o out");
  command->callback([json, &exitCode] { exitCode = run(*json); });
}

}  // namespace ringlet::program
