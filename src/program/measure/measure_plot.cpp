// Implements measure_plot.h.
#include "program/measure/measure_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "ringlet/base/whole_file.h"
#include "ringlet/pictures/program_input.h"

namespace ringlet::program {
namespace {

constexpr int kPlotWidth = 900, kPanelHeight = 190;  // [pixels]

// As gnuplot reads it between single quotes: whatever is in it stands for itself.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return result + "'";
}

// The block $runK: a line a frame, seconds first.
std::string dataOf(const MotionSeries& run, std::size_t number) {
  std::string text = fmt::format("$run{} << END\n", number);
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    text += fmt::format("{:.6g}", static_cast<double>(k) / run.framesPerSecond);
    for (const SeriesKind& kind : seriesKinds()) text += fmt::format(" {:.6g}", kind.value(run, k));
    text += "\n";
  }
  return text + "END\n";
}

// The values of all runs with room around them, also where they are all the same.
std::string rangeOf(const SeriesKind& kind, std::span<const MotionSeries> runs) {
  double low = kind.value(runs[0], 0), high = low;
  for (const MotionSeries& run : runs) {
    for (std::size_t k = 0; k < run.frames.size(); ++k) {
      low = std::min(low, kind.value(run, k));
      high = std::max(high, kind.value(run, k));
    }
  }
  const double room = std::max(0.05 * (high - low), 1e-3 * std::max(-low, high));
  return fmt::format("[{:.6g}:{:.6g}]", low - room, high + room);
}

// By their column in the data. One that is zero all the while, such as contacts of a single strand, says
// nothing.
std::vector<std::size_t> panelsOf(std::span<const MotionSeries> runs) {
  std::vector<std::size_t> panels;
  for (std::size_t kind = 0; kind < seriesKinds().size(); ++kind) {
    const bool isShown = std::ranges::any_of(runs, [&](const MotionSeries& run) {
      for (std::size_t k = 0; k < run.frames.size(); ++k)
        if (seriesKinds()[kind].value(run, k) != 0) return true;
      return false;
    });
    if (isShown) panels.push_back(kind);
  }
  return panels;
}

std::string scriptOf(const std::filesystem::path& path, const std::string& extension,
                     std::span<const MotionSeries> runs) {
  const std::vector<std::size_t> panels = panelsOf(runs);
  const char* terminal = extension == ".svg" ? "svg" : "pngcairo";
  std::string script = fmt::format(
      "set terminal {} noenhanced font ',10' size {},{} background rgb 'white'\nset output {}\n"
      "set multiplot layout {},1\nset lmargin 12\nset rmargin 3\nset grid\n"
      "set key outside above horizontal\n",
      terminal, kPlotWidth, kPanelHeight * panels.size(), quoted(path.string()), panels.size());
  for (std::size_t r = 0; r < runs.size(); ++r) script += dataOf(runs[r], r);
  for (const std::size_t panel : panels) {
    const SeriesKind& kind = seriesKinds()[panel];
    if (panel == panels.back()) script += "set xlabel 'seconds'\n";
    script += fmt::format("set ylabel {}\nset yrange {}\nplot ", quoted(kind.label), rangeOf(kind, runs));
    for (std::size_t r = 0; r < runs.size(); ++r) {
      script += fmt::format("{}$run{} using 1:{} with lines linewidth 2 title {}", r > 0 ? ", " : "", r,
                            panel + 2, quoted(runs[r].name));
    }
    script += "\nunset key\n";  // one is enough
  }
  return script + "unset multiplot\nunset output\n";
}

}  // namespace

bool canPlotInto(const std::filesystem::path& path) {
  return path.extension() == ".svg" || path.extension() == ".png";
}

Status drawPlot(const std::filesystem::path& path, std::span<const MotionSeries> runs) {
  if (Status can = checkReplaceable(path); !can) return can;
  const std::filesystem::path unfinished = path.string() + ".partial";
  const std::string script = scriptOf(unfinished, path.extension().string(), runs);
  auto gnuplot = ProgramInput::start({"gnuplot", "plots are drawn", "gnuplot-nox"}, {"-"});
  if (!gnuplot) return gnuplot.error();
  Status drawn = gnuplot->write(std::as_bytes(std::span(script)));
  if (drawn) drawn = gnuplot->finish();
  std::error_code code;
  if (!drawn) {
    std::filesystem::remove(unfinished, code);
    return Error{fmt::format("{}: {}", path.string(), drawn.error().message), Fault::output};
  }
  std::filesystem::rename(unfinished, path, code);
  if (!code) return {};
  return Error{fmt::format("cannot write {}: {}", path.string(), code.message()), Fault::output};
}

}  // namespace ringlet::program
