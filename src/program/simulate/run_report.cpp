// Implements run_report.h.
#include "program/simulate/run_report.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

#include "program/cli/exit_codes.h"
#include "program/cli/standard_output.h"

namespace ringlet::program {
namespace {

constexpr double kFar = 0.05;  // hair that stays farther from all bodies never touched them [m]

std::string waysText(const CrossingReport& ways) {
  std::string text = fmt::format(
      "  no crossings  {:.3g} % of ways were changed, by {:.3g} mm on the mean and {:.3g} mm at most; {:.2g} % of "
      "particles were tied\n",
      100 * ways.shareOf(ways.changed), 1000 * ways.meanChange(), 1000 * ways.mostChange,
      100 * ways.shareOf(ways.tied));
  if (ways.stretched > 0)
    text +=
        fmt::format("                this stretched {} edges beyond the limit, to {:.3g} x their length\n",
                    ways.stretched, ways.mostStretch);
  if (ways.heldSteps > 0)
    text +=
        fmt::format("                in {} steps all hair had to move as the head does\n", ways.heldSteps);
  return text;
}

std::string contactText(const RunOutcome& outcome, const ContactSettings& settings) {
  std::string text;
  if (outcome.contacts) {
    const ContactReport& report = *outcome.contacts;
    text += fmt::format(
        "  contacts      {} in the {} frame, momentum error {:.2g}; {} pair tests, {} rebuilds of the "
        "lists\n",
        report.contacts, outcome.contactNumbers ? "worst" : "last", report.momentumError, report.pairTests,
        report.rebuilds);
    text +=
        fmt::format("  pairs         {} of {} pairs of strands that are near at rest may touch{}\n",
                    report.pairs, report.pairsUnpruned, settings.prunePairs ? "" : ", and all that are not");
    if (report.volumeStrands > 0)
      text += fmt::format("  volume        {} strands meet as a volume, with up to {:.2g} of its range\n",
                          report.volumeStrands, report.volumeLargest);
    if (settings.noCrossings) text += waysText(report.ways);
  }
  if (outcome.contactNumbers) {
    const ContactNumbers& numbers = *outcome.contactNumbers;
    text += fmt::format(
        "  overlap       {:.4f} of the radii beyond rest at the deepest, {:.4g} in all at the worst "
        "frame{}\n",
        numbers.deepestOverlap, numbers.worst.overlapBeyondRestSum,
        outcome.contacts ? fmt::format(", recall {:.3f}", numbers.worst.rawRecall) : "");
    text += fmt::format("  crossings     {}, in all steps\n", numbers.crossings);
  }
  return text;
}

}  // namespace

nlohmann::ordered_json runJson(const RunNames& names, const Settings& settings, const RunOutcome& outcome) {
  return nlohmann::ordered_json::parse(runReport(names, settings, outcome));
}

std::string runText(const RunNames& names, const Settings& settings, const RunOutcome& outcome) {
  std::string text = fmt::format("{} frame{} of {} strand{}, {} particles{}\n", outcome.frameCount,
                                 outcome.frameCount == 1 ? "" : "s", outcome.strandCount,
                                 outcome.strandCount == 1 ? "" : "s", outcome.particleCount,
                                 outcome.interrupted ? " (interrupted)" : "");
  text += fmt::format("  stepped by    {}, {} step{} a frame, on {} ({}{})\n", names.integrator,
                      settings.stepsPerFrame, settings.stepsPerFrame == 1 ? "" : "s", outcome.hair.device,
                      outcome.hair.kernel, outcome.hair.isTuned ? ", tuned" : "");
  text +=
      fmt::format("  a frame took  {:.2f} ms to step, {:.2f} ms to read back, {:.2f} ms to write\n",
                  outcome.millisecondsPerFrame, outcome.stages.at("readback"), outcome.stages.at("write"));
  text +=
      fmt::format("  all frames    took {:.2f} s, {:.0f} % of it stepping; {:.2f} s before, {:.2f} s after\n",
                  outcome.wall.frames, 100 * outcome.computeShare, outcome.wall.start, outcome.wall.finish);
  text +=
      fmt::format("  longest edge  {:.4f} x its length in the groom; the limit touched {:.3g} % of edges\n",
                  outcome.report.maxEdgeStretch, 100 * outcome.report.limitedShare);
  text += contactText(outcome, settings.contacts);
  if (const auto& bodies = outcome.bodyNumbers) {
    text += bodies->deepest == 0 && bodies->nearest > kFar
                ? std::string("  bodies        hair did not meet them; do they stand where the hair is?")
                : fmt::format("  bodies        deepest {:.3g} mm", 1000 * bodies->deepest);
    if (bodies->strand >= 0)
      text += fmt::format(" (strand {} particle {}, frame {})", bodies->strand, bodies->particle,
                          bodies->frame + 1);
    text += bodies->inside > 0
                ? fmt::format("; {} particles began inside and are there still\n", bodies->inside)
                : "\n";
  }
  if (outcome.hairCount > 0) {
    text += fmt::format("  hairs         {} follow the strands and are written in their place",
                        outcome.hairCount);
    if (const auto& follow = outcome.follow)
      text += fmt::format(
          ": {:.2g} % of their length from where they would be, {:.2g} % at worst ({} were simulated too)",
          100 * follow->rms, 100 * follow->worst, follow->hairs);
    text += '\n';
  }
  for (const BodyOutcome& body : outcome.bodies)
    if (body.cell)
      text += fmt::format("                {}: cells of {:.3g} mm, keeps hair out within {:.3g} mm\n",
                          body.name, 1000 * *body.cell, 1000 * body.within);
  for (const std::string& note : outcome.notes) text += fmt::format("  note          {}\n", note);
  for (const auto& path : outcome.outputs) {
    text += fmt::format("  {}  {}", path == outcome.outputs.front() ? "written     " : "            ",
                        path.string());
    if (path.extension() == ".rgc" && *outcome.cacheErrorBound > 0)
      text += fmt::format(" (points off by at most {:.3g} mm)", 1000 * *outcome.cacheErrorBound);
    text += '\n';
  }
  return text;
}

int tellTroubles(const char* command, const RunOutcome& outcome, int frameCount) {
  for (const std::string& warning : outcome.warnings) say("ringlet {}: warning: {}\n", command, warning);

  // Particles without a position: name the first, so that it can be examined.
  const SimulationReport& report = outcome.report;
  if (report.nonfinite > 0) {
    std::string first;
    if (report.firstNonfiniteStrand >= 0) {
      first = fmt::format(", first strand {} particle {}", report.firstNonfiniteStrand,
                          report.firstNonfiniteParticle);
    }
    say("ringlet {}: {} particles have no finite position{}; in the files their strands end before them. Try "
        "more --steps-per-frame.\n",
        command, report.nonfinite, first);
  }
  if (outcome.interrupted) {
    say("ringlet {}: interrupted after {} of {} frames{}\n", command, outcome.frameCount, frameCount,
        outcome.canResume         ? "; --resume goes on from there"
        : outcome.frameCount == 0 ? "; nothing was written"
                                  : "; they are kept");
    return kExitInterrupted;
  }
  return report.nonfinite > 0 ? kExitNonfinite : kExitFine;
}

}  // namespace ringlet::program
