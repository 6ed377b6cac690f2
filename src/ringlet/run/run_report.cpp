// Implements run_report.h.
#include "ringlet/run/run_report.h"

#include <nlohmann/json.hpp>

#include <iterator>
#include <vector>

namespace ringlet {
namespace {

using Json = nlohmann::ordered_json;

// The inputs of a report.
struct Source {
  const RunNames& names;
  const Settings& settings;
  const RunOutcome& outcome;
};

struct Row {
  ReportKey key;
  Json (*value)(const Source& from);
};

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json frameTimes(const Source& from) {
  const auto& times = from.outcome.frameTimes;
  if (!times) return nullptr;
  return {{"first", times->first}, {"median", times->median}, {"least", times->least}};
}

Json wallTimes(const Source& from) {
  const auto& wall = from.outcome.wall;
  return {{"start", wall.start}, {"frames", wall.frames}, {"finish", wall.finish}};
}

Json waits(const Source& from) {
  const RunOutcome& outcome = from.outcome;
  const auto ofHost = [&](double HostMilliseconds::*part) {
    return outcome.host ? Json((*outcome.host).*part) : Json();
  };
  return {{"device", outcome.waitedForDevice},
          {"writer", outcome.waitedForWriter},
          {"submit", ofHost(&HostMilliseconds::submit)},
          {"fence", ofHost(&HostMilliseconds::fence)},
          {"copy", outcome.copied}};
}

// Null where there are no contacts, or they were not measured.
template <auto member>
Json ofContacts(const Source& from) {
  return from.outcome.contacts ? Json((*from.outcome.contacts).*member) : Json();
}
template <auto member>
Json ofOverlaps(const Source& from) {
  return from.outcome.contactNumbers ? Json((*from.outcome.contactNumbers).*member) : Json();
}

Json outputs(const Source& from) {
  Json paths = Json::array();
  for (const auto& path : from.outcome.outputs) paths.push_back(path.string());
  return paths;
}

constexpr Row kRows[] = {
    {{"frames", "", "Finished frames."}, [](const Source& f) -> Json { return f.outcome.frameCount; }},
    {{"strands", "", "Strands."}, [](const Source& f) -> Json { return f.outcome.strandCount; }},
    {{"particles", "", "Particles."}, [](const Source& f) -> Json { return f.outcome.particleCount; }},
    {{"rigid_strands", "",
      "Strands that are carried rigidly: too fine for float32, or short and in need of far more steps than the "
      "others."},
     [](const Source& f) -> Json { return f.outcome.hair.rigidStrandCount; }},
    {{"ms_per_frame", "ms", "Time of stepping alone, by the device's clock where it has one."},
     [](const Source& f) -> Json { return f.outcome.millisecondsPerFrame; }},
    {{"frame_ms", "ms",
      "The same of the first frame, in which drivers compile, of the median and of the least; null where ranks "
      "step the hair."},
     frameTimes},
    {{"stages_ms", "ms",
      "The same a frame, by stage; beside it copy_out, the copy of positions to the host, which is not in "
      "ms_per_frame, and readback, write and scalp, which go on while the next frame is stepped."},
     [](const Source& f) -> Json { return f.outcome.stages; }},
    {{"wall_s", "s",
      "start: device, kernels, pre-roll; frames: until the last is written; finish: last.obj and sheet.png."},
     wallTimes},
    {{"compute_share", "1", "Share of stepping in wall_s.frames."},
     [](const Source& f) -> Json { return f.outcome.computeShare; }},
    {{"waits_ms", "ms",
      "A frame: time that the loop waited for the device and for the writer; time of the host to submit and at "
      "the device's fence (null without a device or with several), and to copy positions out of the frame."},
     waits},
    {{"max_edge_stretch", "1",
      "Longest edge over its length in the groom, over all outer steps; null where it is not finite."},
     [](const Source& f) -> Json { return f.outcome.report.maxEdgeStretch; }},
    {{"limited_share", "1", "Share of edges, over all steps, that the stretch limit changed."},
     [](const Source& f) -> Json { return f.outcome.report.limitedShare; }},
    {{"nonfinite", "", "Particles without a finite position or velocity."},
     [](const Source& f) -> Json { return f.outcome.report.nonfinite; }},
    {{"velocity_residual", "1",
      "Of the velocity solve, relative to its right-hand side, worst strand and step; measuring it takes a few "
      "per cent of the step's time. Null for paper, with contacts, bodies or air, and for the reference."},
     [](const Source& f) -> Json { return orNull(f.outcome.velocityResidual); }},
    {{"volume_strands", "", "Strands that meet as a volume; null without contacts, as the nine that follow."},
     ofContacts<&ContactReport::volumeStrands>},
    {{"contact_particles", "", "Particles by which strands meet pair by pair."},
     ofContacts<&ContactReport::contactParticles>},
    {{"contacts", "",
      "Contacts between particles, in the frame of the largest overlap; in the last where "
      "contacts are not measured."},
     ofContacts<&ContactReport::contacts>},
    {{"pairs_unpruned", "", "Pairs of strands that overlap at rest when enlarged."},
     ofContacts<&ContactReport::pairsUnpruned>},
    {{"pairs", "", "Of those, pairs that may touch."}, ofContacts<&ContactReport::pairs>},
    {{"pair_tests", "", "Tests of pairs of particles, over all steps."},
     ofContacts<&ContactReport::pairTests>},
    {{"rebuilds", "", "Rebuilds of the lists, over all steps."}, ofContacts<&ContactReport::rebuilds>},
    {{"momentum_error", "1",
      "What contacts added to the sum of momenta in a step, over the sum of what each added; of the frame of "
      "contacts."},
     ofContacts<&ContactReport::momentumError>},
    {{"volume_cut", "",
      "How often a particle's coupling to the volume was larger than its sums have room for, and was cut."},
     ofContacts<&ContactReport::volumeCut>},
    {{"volume_largest", "1", "The largest coupling, as a share of that room."},
     ofContacts<&ContactReport::volumeLargest>},
    {{"raw_recall", "1",
      "Share of overlapping spheres whose strands may touch, in the frame of contacts; null where contacts are "
      "not measured, as the three that follow."},
     [](const Source& f) -> Json {
       const auto& measured = f.outcome.contactNumbers;
       return f.outcome.contacts && measured ? Json(measured->worst.rawRecall) : Json();
     }},
    {{"overlap_beyond_rest_sum", "1",
      "Overlap of all pairs of spheres, pruned or not, beyond that at rest, in sums of two radii, in the worst "
      "frame."},
     [](const Source& f) -> Json {
       const auto& measured = f.outcome.contactNumbers;
       return measured ? Json(measured->worst.overlapBeyondRestSum) : Json();
     }},
    {{"deepest_overlap_all", "1", "The largest of any pair and frame."},
     ofOverlaps<&ContactNumbers::deepestOverlap>},
    {{"crossings", "", "Strands that went through each other, counted step by step and summed over the run."},
     ofOverlaps<&ContactNumbers::crossings>},
    {{"deepest_penetration_mm", "mm",
      "Depth of any particle in a body once it was outside, at a frame's end; null without bodies."},
     [](const Source& f) -> Json {
       return f.outcome.bodyNumbers ? Json(1000 * f.outcome.bodyNumbers->deepest) : Json();
     }},
    {{"inside_bodies", "", "Particles that began in a body and are there still; null without bodies."},
     [](const Source& f) -> Json {
       return f.outcome.bodyNumbers ? Json(f.outcome.bodyNumbers->inside) : Json();
     }},
    {{"device", "", "Its name."}, [](const Source& f) -> Json { return f.outcome.hair.device; }},
    {{"driver", "", "Its name and version."}, [](const Source& f) -> Json { return f.outcome.hair.driver; }},
    {{"kernel", "", "Form and shape of the strand kernel."},
     [](const Source& f) -> Json { return f.outcome.hair.kernel; }},
    {{"tuned", "", "Whether `ringlet tune` chose the shapes of the kernel."},
     [](const Source& f) -> Json { return f.outcome.hair.isTuned; }},
    {{"device_bytes", "", "Size of the simulation's buffers at the end; null for the reference."},
     [](const Source& f) -> Json { return orNull(f.outcome.hair.deviceBytes); }},
    {{"cache_error_bound_m", "m",
      "Largest distance of a point of hair.rgc from its particle; 0 for float32, null without a cache."},
     [](const Source& f) -> Json { return orNull(f.outcome.cacheErrorBound); }},
    {{"compile_ms", "ms", "Time of making the kernels, once; 0 for the reference."},
     [](const Source& f) -> Json { return f.outcome.hair.compileMilliseconds; }},
    {{"backend", "", "gpu or reference."}, [](const Source& f) -> Json { return f.names.backend; }},
    {{"positions_hash", "", "Hash of every bit of the last frame."},
     [](const Source& f) -> Json { return f.outcome.positionsHash; }},
    {{"integrator", "", "Its name."}, [](const Source& f) -> Json { return f.names.integrator; }},
    {{"material", "", "A preset, a file, scene or default."},
     [](const Source& f) -> Json { return f.names.material; }},
    {{"steps_per_frame", "", "Outer steps a frame."},
     [](const Source& f) -> Json { return f.settings.stepsPerFrame; }},
    {{"fps", "1/s", "Frames per second."},
     [](const Source& f) -> Json { return f.settings.framesPerSecond; }},
    {{"resumed_from", "", "Frames that a run before had done; times are of this run's own frames."},
     [](const Source& f) -> Json { return f.outcome.resumedFrom; }},
    {{"interrupted", "", "Whether a signal ended the run."},
     [](const Source& f) -> Json { return f.outcome.interrupted; }},
    {{"warnings", "", "Sentences for a person."}, [](const Source& f) -> Json { return f.outcome.warnings; }},
    {{"notes", "", "Sentences on what may be better, as a preset that fits."},
     [](const Source& f) -> Json { return f.outcome.notes; }},
    {{"outputs", "", "The files written."}, outputs},
};

}  // namespace

std::string runReport(const RunNames& names, const Settings& settings, const RunOutcome& outcome) {
  Json json;
  for (const Row& row : kRows) json[row.key.key] = row.value({names, settings, outcome});
  // Paths may contain bytes that are not valid text.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::span<const ReportKey> runReportKeys() {
  static const std::vector<ReportKey> keys = [] {
    std::vector<ReportKey> all;
    for (const Row& row : kRows) all.push_back(row.key);
    return all;
  }();
  return keys;
}

}  // namespace ringlet
