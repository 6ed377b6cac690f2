// Implements measure_series.h.
#include "program/measure/measure_series.h"

#include <nlohmann/json.hpp>

#include "ringlet/run/report_rows.h"

namespace ringlet::program {
namespace {

constexpr ReportKey kSeconds{"seconds", "s", "Since the groom at rest, the first frame."};

constexpr SeriesKind kKinds[] = {
    {{"droop_mm", "mm", "Droop, mean over strands."},
     "droop [mm]",
     [](const MotionSeries& series, std::size_t frame) { return 1000 * series.frames[frame].droop; }},
    {{"core_elongation", "1", "Core elongation, mean over strands."},
     "core elongation",
     [](const MotionSeries& series, std::size_t frame) { return series.frames[frame].coreElongation; }},
    {{"turns", "", "Turns, mean over strands that are curled at rest."},
     "turns",
     [](const MotionSeries& series, std::size_t frame) { return series.frames[frame].turns; }},
    {{"energy_uj", "uJ", "Kinetic energy of hair of 10 mg/m, each strand seen from its root."},
     "kinetic energy [uJ]",
     [](const MotionSeries& series, std::size_t frame) { return 1e6 * series.frames[frame].energy; }},
    {{"deepest_contact", "1",
      "How far hairs are in each other beyond rest, as a share of their reach (1: two centres in one place); "
      "the deepest. They are as thick as contacts have them unasked."},
     "deepest contact",
     [](const MotionSeries& series, std::size_t frame) { return series.contacts[frame].deepestOverlap; }},
    {{"mean_contact", "1", "The mean of that."},
     "mean contact",
     [](const MotionSeries& series, std::size_t frame) {
       const ContactQuality& contacts = series.contacts[frame];
       return contacts.overlapping == 0
                  ? 0.0
                  : contacts.overlapBeyondRestSum / static_cast<double>(contacts.overlapping);
     }},
};

}  // namespace

std::span<const SeriesKind> seriesKinds() { return kKinds; }

std::vector<ReportKey> seriesKeys() {
  std::vector<ReportKey> keys = keysOf<kKinds>();
  keys.insert(keys.begin(), kSeconds);
  return keys;
}

nlohmann::ordered_json seriesJson(const MotionSeries& series) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < series.frames.size(); ++k) {
    json[kSeconds.key].push_back(static_cast<double>(k) / series.framesPerSecond);
    for (const SeriesKind& kind : kKinds) json[kind.key.key].push_back(kind.value(series, k));
  }
  return json;
}

}  // namespace ringlet::program
