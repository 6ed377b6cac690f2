// What a run is told as: one JSON object, a few lines of text, sentences on standard error. Commands that
// step hair share it, so that the same key means the same everywhere.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ringlet/run/run_report.h"
#include "ringlet/scene/settings.h"

namespace ringlet::program {

/// What the keys about contacts mean, for --help.
inline constexpr const char* kContactKeysHelp =
    "Keys about contacts, null without them: volume_strands (that meet as a volume) contact_particles (by "
    "which strands\n"
    "meet pair by pair) pairs_unpruned (pairs of strands that overlap at rest when enlarged)\n"
    "pairs (of those, that may touch) pair_tests rebuilds (of lists; both over all steps) contacts (between "
    "particles)\n"
    "momentum_error (of a step: what contacts added to the sum of momenta, over the sum of what each added)\n"
    "volume_cut (how often a particle's coupling to the volume was larger than its sums have room for, and "
    "was cut)\n"
    "volume_largest (the largest coupling, as a share of that room).\n"
    "Null where contacts are not measured: raw_recall (share of overlapping spheres whose strands may "
    "touch)\n"
    "overlap_beyond_rest_sum (over all pairs of spheres, pruned or not, beyond their overlap at rest, in "
    "sums of two\n"
    "radii) deepest_overlap_all (the largest of any pair and frame) crossings (strands that went through "
    "each other,\n"
    "counted step by step and summed over the run; over a whole frame straight paths would cross where hair "
    "did not).\n"
    "overlap_beyond_rest_sum is that of the worst frame, where it is largest; contacts, momentum_error and "
    "raw_recall\n"
    "are of the same frame (of the last, where contacts are not measured).\n";

/// runReport, to be added to.
nlohmann::ordered_json runJson(const RunNames& names, const Settings& settings, const RunOutcome& outcome);
std::string runText(const RunNames& names, const Settings& settings, const RunOutcome& outcome);

/// Prints warnings, lost particles and an interruption to standard error, as `ringlet COMMAND`, and returns
/// what the program is to return. frameCount: planned.
int tellTroubles(const char* command, const RunOutcome& outcome, int frameCount);

}  // namespace ringlet::program
