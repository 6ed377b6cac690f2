// The plot of `ringlet measure --plot`, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <span>

#include "program/measure/measure_series.h"
#include "ringlet/base/result.h"

namespace ringlet::program {

/// The file name endings it can draw, for messages and checks: ".svg" and ".png".
bool canPlotInto(const std::filesystem::path& path);

/// A panel for each SeriesKind that is not zero all the while, over seconds; a curve for each run. Errors:
/// gnuplot is not installed, or it failed; nothing is left of a file that could not be finished.
Status drawPlot(const std::filesystem::path& path, std::span<const MotionSeries> runs);

}  // namespace ringlet::program
