// Implements sweep_sheet.h.
#include "program/sweep/sweep_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/sheet.h"

namespace ringlet::program {
namespace {

constexpr std::size_t kMostStrands = 300;  // in a cell, which is 240 pixels wide
constexpr int kCellWidth = 240, kCellHeight = 320, kDot = 2;
constexpr std::size_t kMostLetters = 19;  // in a line of a cell
constexpr int kMostColumns = 12;

// The last frame of a run that was finished before; empty if it cannot be read.
SweepCell readCell(const SweepEntry& entry, const SweepOptions& options) {
  auto read = readGroom(folderOf(*entry.run, options) / "last.obj", {});
  if (!read) return {};
  read->groom.metresPerUnit = entry.report.value("metres_per_unit", read->groom.metresPerUnit);
  return cellOf(read->groom, read->groom.points);
}

std::vector<std::string> labelsOf(const SweepEntry& entry, std::span<const SweepAxis> axes) {
  std::vector<std::string> labels{std::to_string(entry.run->number)};
  if (entry.state == RunState::failed || entry.state == RunState::interrupted)
    labels[0] += fmt::format(" {}", nameOf(entry.state));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].values.size() < 2) continue;
    std::string label = fmt::format("{} {}", shortName(axes[i], axes), entry.run->changes[i].value);
    if (label.size() > kMostLetters) label = label.substr(label.size() - kMostLetters);
    labels.push_back(std::move(label));
  }
  return labels;
}

int columnsOf(std::size_t cellCount, std::span<const SweepAxis> axes) {
  std::vector<int> counts;
  for (const SweepAxis& axis : axes) {
    if (axis.values.size() > 1)
      counts.push_back(static_cast<int>(std::min<std::size_t>(axis.values.size(), 100)));
  }
  if (counts.size() > 1 && counts.back() <= kMostColumns) return counts.back();
  if (cellCount <= 6) return static_cast<int>(cellCount);
  return std::min(kMostColumns, static_cast<int>(std::ceil(std::sqrt(1.5 * static_cast<double>(cellCount)))));
}

}  // namespace

SweepCell cellOf(const Groom& groom, std::span<const Vec3f> points) {
  SweepCell cell{{0}, {}};
  const std::size_t count = groom.strandCount(), shown = std::min(count, kMostStrands);
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t strand = i * count / shown;
    for (std::size_t p = groom.firstPoint[strand]; p < groom.firstPoint[strand + 1]; ++p)
      cell.points.push_back(points[p] * static_cast<float>(groom.metresPerUnit));
    cell.firstPoint.push_back(static_cast<std::uint32_t>(cell.points.size()));
  }
  return cell;
}

Status writeSweepSheet(const std::filesystem::path& path, std::vector<SweepEntry>& entries,
                       std::span<const SweepAxis> axes, const SweepOptions& options) {
  const std::size_t count = std::min(entries.size(), kMostCells);
  std::vector<Panel> panels;
  std::size_t mostLabels = 0;
  bool isEmpty = true;
  for (SweepEntry& entry : std::span(entries).first(count)) {
    if (entry.state == RunState::kept && entry.cell.points.empty()) entry.cell = readCell(entry, options);
    isEmpty = isEmpty && entry.cell.points.empty();
    panels.push_back({entry.cell.firstPoint, entry.cell.points, labelsOf(entry, axes)});
    mostLabels = std::max(mostLabels, panels.back().labels.size());
  }
  if (isEmpty) return {};
  const int columns = columnsOf(count, axes);
  return drawPanels(panels, {.columns = columns,
                             .rows = (static_cast<int>(count) + columns - 1) / columns,
                             .width = kCellWidth,
                             .height = kCellHeight,
                             .up = entries[0].run->scene.groom.up == "Z" ? UpAxis::z : UpAxis::y,
                             .labelDot = kDot,
                             .footer = static_cast<int>(mostLabels) * 10 * kDot})
      .writePng(path);
}

}  // namespace ringlet::program
