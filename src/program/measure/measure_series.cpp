// Implements measure_series.h.
#include "program/measure/measure_series.h"

#include <nlohmann/json.hpp>

namespace ringlet::program {
namespace {

constexpr SeriesKind kKinds[] = {
    {"droop_mm", "droop [mm]",
     [](const MotionSeries& series, std::size_t frame) { return 1000 * series.frames[frame].droop; }},
    {"core_elongation", "core elongation",
     [](const MotionSeries& series, std::size_t frame) { return series.frames[frame].coreElongation; }},
    {"turns", "turns",
     [](const MotionSeries& series, std::size_t frame) { return series.frames[frame].turns; }},
    {"energy_uj", "kinetic energy [uJ]",
     [](const MotionSeries& series, std::size_t frame) { return 1e6 * series.frames[frame].energy; }},
    {"deepest_contact", "deepest contact",
     [](const MotionSeries& series, std::size_t frame) { return series.contacts[frame].deepestOverlap; }},
    {"mean_contact", "mean contact",
     [](const MotionSeries& series, std::size_t frame) {
       const ContactQuality& contacts = series.contacts[frame];
       return contacts.overlapping == 0
                  ? 0.0
                  : contacts.overlapBeyondRestSum / static_cast<double>(contacts.overlapping);
     }},
};

}  // namespace

std::span<const SeriesKind> seriesKinds() { return kKinds; }

nlohmann::ordered_json seriesJson(const MotionSeries& series) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < series.frames.size(); ++k) {
    json["seconds"].push_back(static_cast<double>(k) / series.framesPerSecond);
    for (const SeriesKind& kind : kKinds) json[kind.key].push_back(kind.value(series, k));
  }
  return json;
}

}  // namespace ringlet::program
