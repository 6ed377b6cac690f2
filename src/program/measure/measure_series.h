// What changes over the frames of a motion, as `ringlet measure --plot` draws it and its JSON tells it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "ringlet/measure/contact_quality.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/run/run_report.h"

namespace ringlet::program {

/// A motion, frame by frame; the groom at rest is the first.
struct MotionSeries {
  std::string name;  // of the run
  double framesPerSecond = 24;
  std::vector<FrameMeasure> frames;
  std::vector<ContactQuality> contacts;  // likewise; hairs as thick as contacts have them unasked
};

/// One of its curves.
struct SeriesKind {
  ReportKey key;
  const char* label;  // of the axis
  double (*value)(const MotionSeries& series, std::size_t frame);
};
std::span<const SeriesKind> seriesKinds();

/// The keys of that JSON: the seconds, and those of the kinds. Each has a number a frame.
std::vector<ReportKey> seriesKeys();
nlohmann::ordered_json seriesJson(const MotionSeries& series);

}  // namespace ringlet::program
