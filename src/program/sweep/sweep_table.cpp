// Implements sweep_table.h.
#include "program/sweep/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

struct Column {
  const char* key;
  int digits;       // decimals, in text; -1: not shown in text
  bool isMeasured;  // only with --measure
};

constexpr Column kColumns[] = {
    {"frames", -1, false},
    {"droop_mm", 2, false},
    {"stretch_mean", 4, false},
    {"stretch_max", 4, false},
    {"max_edge_stretch", 4, false},
    {"core_elongation", 4, true},
    {"turns", 2, true},
    {"mean_radius_mm", 2, true},
    {"bounce_hz", 2, true},
    {"settle_s", 2, true},
    {"energy_ratio", 4, true},
    {"nonfinite", -1, false},
    {"steps_per_frame", -1, false},
    {"ms_per_frame", 2, false},
    {"seconds", 2, false},
    {"positions_hash", 0, false},
    {"device", -1, false},
};

std::vector<Column> columnsOf(const SweepOptions& options) {
  std::vector<Column> columns;
  for (const Column& column : kColumns) {
    if (options.measures || !column.isMeasured) columns.push_back(column);
  }
  return columns;
}

Json numberIn(const SweepEntry& entry, const char* key) {
  return entry.report.is_object() ? entry.report.value(key, Json()) : Json();
}

// A cell in the format of RFC 4180.
std::string csvCell(std::string text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csvCell(const Json& value) {
  if (value.is_null()) return "";
  return csvCell(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string textOf(const Json& value, int digits) {
  if (value.is_number_float()) return fmt::format("{:.{}f}", value.get<double>(), digits);
  if (value.is_null()) return "-";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// Aligns the columns. The first row is the heading.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:>{}}  ", row[i], widths[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace

Json sweepJson(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
               const SweepOptions& options) {
  Json runs = Json::array();
  for (const SweepEntry& entry : entries) {
    Json run{{"run", entry.run->number},
             {"folder", folderOf(*entry.run, options).string()},
             {"state", nameOf(entry.state)},
             {"exit_status", entry.exitCode}};
    for (std::size_t i = 0; i < axes.size(); ++i) run["values"][axes[i].key] = entry.run->changes[i].value;
    if (!entry.error.empty()) run["error"] = entry.error;
    if (!entry.report.is_null()) {
      for (const Column& column : columnsOf(options)) run[column.key] = numberIn(entry, column.key);
    }
    runs.push_back(std::move(run));
  }
  return {{"runs", std::move(runs)}};
}

std::string sweepCsv(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                     const SweepOptions& options) {
  std::string text = "run,state,exit_status";
  for (const SweepAxis& axis : axes) text += "," + csvCell(axis.key);
  for (const Column& column : columnsOf(options)) text += fmt::format(",{}", column.key);
  text += ",error\n";
  for (const SweepEntry& entry : entries) {
    text += fmt::format("{},{},{}", entry.run->number, nameOf(entry.state), entry.exitCode);
    for (const SceneChange& change : entry.run->changes) text += "," + csvCell(change.value);
    for (const Column& column : columnsOf(options)) text += "," + csvCell(numberIn(entry, column.key));
    text += "," + csvCell(entry.error) + "\n";
  }
  return text;
}

std::string sweepText(std::span<const SweepEntry> entries, std::span<const SweepAxis> axes,
                      const SweepOptions& options) {
  std::vector<std::vector<std::string>> rows(1, {"run"});
  for (const SweepAxis& axis : axes) {
    if (axis.values.size() > 1) rows[0].push_back(shortName(axis, axes));
  }
  rows[0].push_back("state");
  for (const Column& column : columnsOf(options)) {
    if (column.digits >= 0) rows[0].push_back(column.key);
  }
  for (const SweepEntry& entry : entries) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(std::to_string(entry.run->number));
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (axes[i].values.size() > 1) row.push_back(entry.run->changes[i].value);
    }
    row.push_back(nameOf(entry.state));
    for (const Column& column : columnsOf(options)) {
      if (column.digits >= 0) row.push_back(textOf(numberIn(entry, column.key), column.digits));
    }
  }
  return aligned(rows);
}

}  // namespace ringlet::program
