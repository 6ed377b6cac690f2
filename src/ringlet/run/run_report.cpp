// Implements run_report.h.
#include "ringlet/run/run_report.h"

#include "ringlet/run/report_rows.h"

namespace ringlet {
namespace {

using Json = ReportJson;

// The inputs of a report.
struct Source {
  const RunNames& names;
  const Settings& settings;
  const RunOutcome& outcome;
};
using Row = ReportRow<Source>;

constexpr ReportRow<FrameMilliseconds> kFrameTimes[] = {
    {{"first", "ms", "Of the first frame, in which drivers compile."},
     [](const FrameMilliseconds& f) -> Json { return f.first; }},
    {{"median", "ms", "Of all frames, the median."},
     [](const FrameMilliseconds& f) -> Json { return f.median; }},
    {{"least", "ms", "Of all frames, the least."},
     [](const FrameMilliseconds& f) -> Json { return f.least; }},
};

constexpr ReportRow<BodyOutcome> kBodies[] = {
    {{"name", "", "Its name."}, [](const BodyOutcome& b) -> Json { return b.name; }},
    {{"shape", "", "Its shape."}, [](const BodyOutcome& b) -> Json { return b.shape; }},
    {{"deforms", "", "Whether it bends."}, [](const BodyOutcome& b) -> Json { return b.bends; }},
    {{"sides", "", "From which hair is kept off: outside or both."},
     [](const BodyOutcome& b) -> Json { return b.isCloth ? "both" : "outside"; }},
    {{"cell_mm", "mm", "Edge of a cell of its distance grid; null of an exact form and of cloth."},
     [](const BodyOutcome& b) { return b.cell ? Json(1000 * *b.cell) : Json(); }},
    {{"within_mm", "mm", "Depth up to which it keeps hair out."},
     [](const BodyOutcome& b) -> Json { return 1000 * b.within; }},
    {{"deepest_mm", "mm", "As deepest_penetration_mm."},
     [](const BodyOutcome& b) -> Json { return 1000 * b.numbers.deepest; }},
    {{"inside", "", "As inside_bodies."}, [](const BodyOutcome& b) -> Json { return b.numbers.inside; }},
    {{"caught", "", "Particles that were deeper than within_mm once they had been outside."},
     [](const BodyOutcome& b) -> Json { return b.numbers.caught; }},
};

constexpr ReportRow<CrossingReport> kWays[] = {
    {{"changed_share", "1", "Share of ways, of all particles in all steps, that were changed."},
     [](const CrossingReport& r) -> Json { return r.shareOf(r.changed); }},
    {{"mean_change_mm", "mm", "By how much, on the mean of these."},
     [](const CrossingReport& r) -> Json { return 1000 * r.meanChange(); }},
    {{"most_change_mm", "mm", "And at most."},
     [](const CrossingReport& r) -> Json { return 1000 * r.mostChange; }},
    {{"tied_share", "1", "Share of particles that were tied to others for a step, and moved as one."},
     [](const CrossingReport& r) -> Json { return r.shareOf(r.tied); }},
    {{"stretched", "", "Edges, over all steps, that the changes made longer than the stretch limit allows."},
     [](const CrossingReport& r) -> Json { return r.stretched; }},
    {{"most_stretch", "1", "The longest of these over its length in the groom; 0: there was none."},
     [](const CrossingReport& r) -> Json { return r.mostStretch; }},
    {{"held_steps", "", "Steps in which nothing else helped than to move all hair as the head does."},
     [](const CrossingReport& r) -> Json { return r.heldSteps; }},
    {{"unsafe", "", "Pairs of edges that may have crossed in spite of all: by the ways of roots."},
     [](const CrossingReport& r) -> Json { return r.unsafe; }},
};

constexpr Row kWallTimes[] = {
    {{"start", "s", "Device, kernels, pre-roll."},
     [](const Source& f) -> Json { return f.outcome.wall.start; }},
    {{"frames", "s", "Until the last frame is written."},
     [](const Source& f) -> Json { return f.outcome.wall.frames; }},
    {{"finish", "s", "last.obj and sheet.png."},
     [](const Source& f) -> Json { return f.outcome.wall.finish; }},
};

template <auto member>
Json ofHost(const Source& from) {
  return from.outcome.host ? Json((*from.outcome.host).*member) : Json();
}

constexpr Row kWaits[] = {
    {{"device", "ms", "The loop waited for the device."},
     [](const Source& f) -> Json { return f.outcome.waitedForDevice; }},
    {{"writer", "ms", "The loop waited for the writer."},
     [](const Source& f) -> Json { return f.outcome.waitedForWriter; }},
    {{"submit", "ms", "The host submitted; null without a device or with several."},
     ofHost<&HostMilliseconds::submit>},
    {{"fence", "ms", "The host was at the device's fence; null likewise."}, ofHost<&HostMilliseconds::fence>},
    {{"copy", "ms", "Positions were copied out of the frame."},
     [](const Source& f) -> Json { return f.outcome.copied; }},
};

// Null where there are no contacts, or they were not measured.
template <auto member>
Json ofContacts(const Source& from) {
  return from.outcome.contacts ? Json((*from.outcome.contacts).*member) : Json();
}
template <auto member>
Json ofOverlaps(const Source& from) {
  return from.outcome.contactNumbers ? Json((*from.outcome.contactNumbers).*member) : Json();
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
    {{"frame_ms", "ms", "The same of single frames; null where ranks step the hair.", keysOf<kFrameTimes>},
     [](const Source& f) -> Json {
       return f.outcome.frameTimes ? objectOf<kFrameTimes>(*f.outcome.frameTimes) : Json();
     }},
    {{"stages_ms", "ms",
      "The same a frame, by stage; beside it copy_out, the copy of positions to the host, which is not in "
      "ms_per_frame, and readback, write and scalp, which go on while the next frame is stepped."},
     [](const Source& f) -> Json { return f.outcome.stages; }},
    {{"wall_s", "s", "Time of the run.", keysOf<kWallTimes>}, objectOf<kWallTimes>},
    {{"compute_share", "1", "Share of stepping in wall_s.frames."},
     [](const Source& f) -> Json { return f.outcome.computeShare; }},
    {{"waits_ms", "ms", "Time of the host, a frame.", keysOf<kWaits>}, objectOf<kWaits>},
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
    {{"no_crossings", "", "What kept hair from going through hair; null where it is not kept from that.",
      keysOf<kWays>},
     [](const Source& f) -> Json {
       return f.outcome.contacts && f.settings.contacts.noCrossings
                  ? objectOf<kWays>(f.outcome.contacts->ways)
                  : Json();
     }},
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
    {{"bodies", "", "A list of all bodies.", keysOf<kBodies>},
     [](const Source& f) {
       Json bodies = Json::array();
       for (const BodyOutcome& body : f.outcome.bodies) bodies.push_back(objectOf<kBodies>(body));
       return bodies;
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
    {{"hairs", "", "Hairs that follow the strands and are written in their place; 0: none."},
     [](const Source& f) -> Json { return f.outcome.hairCount; }},
    {{"follow_error", "1",
      "How far hairs that follow are from where they would be, by those that are simulated as well: root mean "
      "square over points and frames, as a share of a hair's length; null without a sample."},
     [](const Source& f) { return f.outcome.follow ? Json(f.outcome.follow->rms) : Json(); }},
    {{"follow_error_worst", "1", "The same of the hair that is farthest off in a frame."},
     [](const Source& f) { return f.outcome.follow ? Json(f.outcome.follow->worst) : Json(); }},
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
    {{"outputs", "", "The files written."},
     [](const Source& f) -> Json { return pathsOf(f.outcome.outputs); }},
};

}  // namespace

std::string runReport(const RunNames& names, const Settings& settings, const RunOutcome& outcome) {
  const Json json = objectOf<kRows>(Source{names, settings, outcome});
  // Paths may have bytes that are no text.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<ReportKey> runReportKeys() { return keysOf<kRows>(); }

}  // namespace ringlet
