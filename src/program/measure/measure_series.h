// What changes over the frames of a motion, as `ringlet measure --plot` draws it and its JSON tells it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "ringlet/measure/contact_quality.h"
#include "ringlet/measure/motion_measure.h"

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
  const char* key;    // of the JSON
  const char* label;  // of the axis
  double (*value)(const MotionSeries& series, std::size_t frame);
};
std::span<const SeriesKind> seriesKinds();

/// {seconds: [...], KEY: [...]}: a number a frame.
nlohmann::ordered_json seriesJson(const MotionSeries& series);

}  // namespace ringlet::program
