// Implements run_report.h.
#include "ringlet/run/run_report.h"

#include <nlohmann/json.hpp>

namespace ringlet {
namespace {

// Null where there are no contacts, or they were not measured.
void addContactKeys(nlohmann::ordered_json& json, const RunOutcome& outcome) {
  const auto& known = outcome.contacts;
  const auto& measured = outcome.contactNumbers;
  const auto orNull = [](bool has, auto value) {
    return has ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  const ContactReport report = known.value_or(ContactReport{});
  const ContactNumbers numbers = measured.value_or(ContactNumbers{});
  json["volume_strands"] = orNull(known.has_value(), report.volumeStrands);
  json["contact_particles"] = orNull(known.has_value(), report.contactParticles);
  json["contacts"] = orNull(known.has_value(), report.contacts);
  json["pairs_unpruned"] = orNull(known.has_value(), report.pairsUnpruned);
  json["pairs"] = orNull(known.has_value(), report.pairs);
  json["pair_tests"] = orNull(known.has_value(), report.pairTests);
  json["rebuilds"] = orNull(known.has_value(), report.rebuilds);
  json["momentum_error"] = orNull(known.has_value(), report.momentumError);
  json["volume_cut"] = orNull(known.has_value(), report.volumeCut);
  json["volume_largest"] = orNull(known.has_value(), report.volumeLargest);
  json["raw_recall"] = orNull(known && measured, numbers.worst.rawRecall);
  json["overlap_beyond_rest_sum"] = orNull(measured.has_value(), numbers.worst.overlapBeyondRestSum);
  json["deepest_overlap_all"] = orNull(measured.has_value(), numbers.deepestOverlap);
  json["crossings"] = orNull(measured.has_value(), numbers.crossings);
}

}  // namespace

std::string runReport(const RunNames& names, const Settings& settings, const RunOutcome& outcome) {
  nlohmann::ordered_json json;
  json["frames"] = outcome.frameCount;
  json["strands"] = outcome.strandCount;
  json["particles"] = outcome.particleCount;
  json["rigid_strands"] = outcome.hair.rigidStrandCount;
  json["ms_per_frame"] = outcome.millisecondsPerFrame;
  const auto& times = outcome.frameTimes;
  json["frame_ms"] = times ? nlohmann::ordered_json{{"first", times->first},
                                                    {"median", times->median},
                                                    {"least", times->least}}
                           : nlohmann::ordered_json();
  json["stages_ms"] = outcome.stages;
  json["wall_s"] = {
      {"start", outcome.wall.start}, {"frames", outcome.wall.frames}, {"finish", outcome.wall.finish}};
  json["compute_share"] = outcome.computeShare;
  const auto hostTime = [&](double HostMilliseconds::*part) {
    return outcome.host ? nlohmann::ordered_json((*outcome.host).*part) : nlohmann::ordered_json();
  };
  json["waits_ms"] = {{"device", outcome.waitedForDevice},
                      {"writer", outcome.waitedForWriter},
                      {"submit", hostTime(&HostMilliseconds::submit)},
                      {"fence", hostTime(&HostMilliseconds::fence)},
                      {"copy", outcome.copied}};
  json["max_edge_stretch"] = outcome.report.maxEdgeStretch;  // null where it is not finite
  json["limited_share"] = outcome.report.limitedShare;
  json["nonfinite"] = outcome.report.nonfinite;
  json["velocity_residual"] =
      outcome.velocityResidual ? nlohmann::ordered_json(*outcome.velocityResidual) : nlohmann::ordered_json();
  addContactKeys(json, outcome);
  json["deepest_penetration_mm"] = outcome.bodyNumbers
                                       ? nlohmann::ordered_json(1000 * outcome.bodyNumbers->deepest)
                                       : nlohmann::ordered_json();
  json["inside_bodies"] =
      outcome.bodyNumbers ? nlohmann::ordered_json(outcome.bodyNumbers->inside) : nlohmann::ordered_json();
  json["device"] = outcome.hair.device;
  json["driver"] = outcome.hair.driver;
  json["kernel"] = outcome.hair.kernel;
  json["tuned"] = outcome.hair.isTuned;
  json["device_bytes"] =
      outcome.hair.deviceBytes ? nlohmann::ordered_json(*outcome.hair.deviceBytes) : nlohmann::ordered_json();
  json["cache_error_bound_m"] =
      outcome.cacheErrorBound ? nlohmann::ordered_json(*outcome.cacheErrorBound) : nlohmann::ordered_json();
  json["compile_ms"] = outcome.hair.compileMilliseconds;
  json["backend"] = names.backend;
  json["positions_hash"] = outcome.positionsHash;
  json["integrator"] = names.integrator;
  json["material"] = names.material;
  json["steps_per_frame"] = settings.stepsPerFrame;
  json["fps"] = settings.framesPerSecond;
  json["resumed_from"] = outcome.resumedFrom;
  json["interrupted"] = outcome.interrupted;
  json["warnings"] = outcome.warnings;
  json["notes"] = outcome.notes;
  json["outputs"] = nlohmann::json::array();
  for (const auto& path : outcome.outputs) json["outputs"].push_back(path.string());
  // Paths may have bytes that are no text.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace ringlet
