// Implements solver/plan/shape_cost_file.h.
#include "ringlet/solver/plan/shape_cost_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"
#include "ringlet/rest/toml_file.h"

namespace ringlet {
namespace {

constexpr const char* kWhat = "measured strand shapes";
constexpr std::int64_t kMostLanes = 128;  // of any device; no subgroup is wider

Error inFile(const std::string& name, const toml::node& node, const std::string& message) {
  return Error{fmt::format("{}: line {}: {}", name, lineOf(node), message)};
}

Result<std::uint32_t> wholeIn(const toml::table& table, const char* key, std::int64_t low, std::int64_t high,
                              const std::string& name) {
  const auto value = table[key].value_exact<std::int64_t>();
  if (value && *value >= low && *value <= high) return static_cast<std::uint32_t>(*value);
  return inFile(name, table, fmt::format("expected {}, a whole number from {} to {}", key, low, high));
}

Result<ShapeCost> shapeCostOf(const toml::table& table, const std::string& name) {
  ShapeCost cost;
  cost.nanoseconds = table["nanoseconds"].value<double>().value_or(0);
  if (!std::isfinite(cost.nanoseconds) || cost.nanoseconds <= 0)
    return inFile(name, table, "expected nanoseconds, a number above 0");
  if (table["serial"].value_or(false)) {
    cost.shape = kAnySerialShape;
    return cost;
  }
  const auto lanes = wholeIn(table, "lanes", 1, kMostLanes, name);
  if (!lanes) return lanes.error();
  const auto run = wholeIn(table, "run", kShortestRun, kLongestRun, name);
  if (!run) return run.error();
  if (!std::has_single_bit(*lanes)) return inFile(name, table, "expected lanes, a power of two");
  cost.shape = {*lanes, *run};
  return cost;
}

Result<DeviceCosts> deviceCostsOf(const toml::table& table, const std::string& name) {
  DeviceCosts device;
  for (const auto& [key, text] : {std::pair{"name", &device.device}, std::pair{"driver", &device.driver},
                                  std::pair{"kernels", &device.kernels}}) {
    const auto value = table[key].value_exact<std::string>();
    if (!value) return inFile(name, table, fmt::format("expected {}, a text", key));
    *text = *value;
  }
  const auto width = wholeIn(table, "subgroup", 0, kMostLanes, name);
  if (!width) return width.error();
  device.subgroupSize = *width;
  const toml::array* shapes = table["shapes"].as_array();
  if (!shapes) return inFile(name, table, "expected shapes, a list");
  for (const toml::node& node : *shapes) {
    if (!node.is_table()) return inFile(name, node, fmt::format("found {}; expected a shape", found(node)));
    auto cost = shapeCostOf(*node.as_table(), name);
    if (!cost) return cost.error();
    device.costs.push_back(*cost);
  }
  return device;
}

std::string textOf(const DeviceCosts& device) {
  std::string text = fmt::format(
      "\n[[device]]\nname = {}\ndriver = {}\nkernels = {}\nsubgroup = {}\nshapes = [\n",
      tomlText(device.device), tomlText(device.driver), tomlText(device.kernels), device.subgroupSize);
  for (const ShapeCost& cost : device.costs) {
    const std::string shape = cost.shape.serial() ? "serial = true"
                                                  : fmt::format("lanes = {}, run = {}", cost.shape.lanes,
                                                                cost.shape.particlesPerLane);
    text += fmt::format("  {{ {}, nanoseconds = {} }},\n", shape, tomlNumber(cost.nanoseconds));
  }
  return text + "]\n";
}

}  // namespace

Result<std::vector<DeviceCosts>> readShapeCosts(const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto text = readTomlText(path, kWhat);
  if (!text) return text.error();
  const auto file = parseToml(*text, name, kWhat);
  if (!file) return file.error();
  const toml::array* tables = (*file)["device"].as_array();
  if (!tables) return inFile(name, *file, "expected a [[device]]");
  std::vector<DeviceCosts> devices;
  for (const toml::node& node : *tables) {
    if (!node.is_table()) return inFile(name, node, fmt::format("found {}; expected a table", found(node)));
    auto device = deviceCostsOf(*node.as_table(), name);
    if (!device) return device.error();
    devices.push_back(std::move(*device));
  }
  return devices;
}

Status writeShapeCosts(const std::filesystem::path& path, const std::vector<DeviceCosts>& devices) {
  std::string text =
      "# Device time of strand shapes, hair alone: of a step of one strand, of the serial form of one\n"
      "# particle [ns]. `ringlet tune` writes this file; it may be deleted.\n";
  for (const DeviceCosts& device : devices) text += textOf(device);
  std::error_code ignored;  // the write below reports it
  std::filesystem::create_directories(path.parent_path(), ignored);
  return writeWholeFile(path, std::as_bytes(std::span<const char>(text)));
}

}  // namespace ringlet
