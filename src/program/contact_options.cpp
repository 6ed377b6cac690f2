// Implements contact_options.h.
#include "program/contact_options.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>

#include "program/command_line.h"

namespace ringlet::program {
namespace {

constexpr int kMostOverlaps = 1'000'000;  // checkSettings' bound

// A level of pruning: none, or overlaps from 1 on.
CLI::Validator pruneLevel() {
  const CLI::Validator number = wholeBetween(1, kMostOverlaps);
  return CLI::Validator(
      [number](std::string& text) {
        if (text == "none") return std::string();
        const std::string problem = number(text);
        return problem.empty() ? problem : problem + ", or none";
      },
      "");
}

int wholeNumber(const std::string& text) {
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

void addContactOptions(CLI::App* command, ContactChoice& choice, const std::string& defaultState) {
  const char* group = "Contacts";
  command
      ->add_option(
          "--contacts", choice.state,
          "How strands push each other away: off; explicit, pair by pair; volume, all as a volume, coarse "
          "and fast; auto or on, as a volume where they are dense at rest and pair by pair elsewhere "
          "(default " +
              defaultState + "); jacobi only")
      ->check(oneOf({"off", "on", "auto", "explicit", "volume"}))
      ->type_name("STATE")
      ->group(group);
  command
      ->add_option("--contact-radius", choice.radius,
                   "Radius of the spheres by which strands feel each other, metres, 1e-6 to 1 (default: half "
                   "the mean distance of neighbouring roots)")
      ->check(between(1e-6, 1))
      ->type_name("METRES")
      ->group(group);
  command
      ->add_option("--fill-gaps", choice.fillGaps,
                   "on: strands whose particles stand further apart than two radii get a larger radius, so "
                   "that nothing slips between; in a dense groom slow (default off)")
      ->check(oneOf({"on", "off"}))
      ->type_name("STATE")
      ->group(group);
  command
      ->add_option(
          "--contact-detail", choice.detail,
          "Share of their contact particles by which strands that are dense at rest meet others "
          "pair by pair, 0.05 to 1: with 0.5 a frame of dense hair takes less than half as long, and "
          "more of it slips through (default 1: all)")
      ->check(between(0.05, 1))
      ->type_name("X")
      ->group(group);
  command
      ->add_option(
          "--prune", choice.prune,
          "Overlapping spheres at rest from which on two strands may touch pair by pair, 1 to 1000000: "
          "more misses more and is little faster; none: all may, also those apart at rest (default none)")
      ->check(pruneLevel())
      ->type_name("N|none")
      ->group(group);
  command
      ->add_option("--max-neighbours", choice.maxNeighbours,
                   "Most strands that one may touch, those with the most overlaps, 0 to 1000000 (default 0: "
                   "no bound)")
      ->check(wholeBetween(0, kMostOverlaps))
      ->type_name("N")
      ->group(group);
  command
      ->add_option("--drop-share", choice.dropShare,
                   "Share of the pairs of strands then left that is dropped at random, 0 to 1 (default 0)")
      ->check(between(0, 1))
      ->type_name("P")
      ->group(group);
  command
      ->add_option("--contact-iterations", choice.iterations,
                   "Solves of a step in which strands hear of each other, 1 to 1000: more is slower and "
                   "loses less momentum (default 2; 1 where all hair meets as a volume)")
      ->check(wholeBetween(1, 1000))
      ->type_name("N")
      ->group(group);
  command
      ->add_option("--contact-friction", choice.friction,
                   "Damping of strands that slide along each other, pair by pair, as a share of that between "
                   "strands that meet, 0 to 1 (default 0)")
      ->check(between(0, 1))
      ->type_name("X")
      ->group(group);
  command
      ->add_option(
          "--contact-taper", choice.taper,
          "How a contact comes and goes, with the distance of the two, or in time as in the paper, which "
          "is slower and pair by pair: distance or time (default distance)")
      ->check(oneOf({std::begin(kContactTaperNames), std::end(kContactTaperNames)}))
      ->type_name("TAPER")
      ->group(group);
  command
      ->add_option(
          "--volume-cell", choice.volumeCell,
          "Where hair meets as a volume: how far a strand feels what is about it, metres, 1e-5 to 10 "
          "(default: four contact radii, or more where particles are further apart)")
      ->check(between(1e-5, 10))
      ->type_name("METRES")
      ->group(group);
}

void checkContactOptions(const ContactChoice& choice) {
  const char* pruning = choice.maxNeighbours ? "--max-neighbours"
                        : choice.dropShare   ? "--drop-share"
                                             : nullptr;
  if (choice.prune == "none" && pruning)
    throw CLI::ValidationError(pruning, "--prune none prunes nothing; leave one of the two out");
}

std::optional<ContactMethod> ContactChoice::method() const {
  if (!state || *state == "off") return std::nullopt;
  const auto* at = std::ranges::find(kContactMethodNames, *state);
  return at == std::end(kContactMethodNames) ? ContactMethod::automatic
                                             : static_cast<ContactMethod>(at - kContactMethodNames);
}

void refuseContactOptions(const ContactChoice& choice, const std::string& reason) {
  const char* option = choice.radius          ? "--contact-radius"
                       : choice.fillGaps      ? "--fill-gaps"
                       : choice.detail        ? "--contact-detail"
                       : choice.prune         ? "--prune"
                       : choice.maxNeighbours ? "--max-neighbours"
                       : choice.dropShare     ? "--drop-share"
                       : choice.iterations    ? "--contact-iterations"
                       : choice.friction      ? "--contact-friction"
                       : choice.taper         ? "--contact-taper"
                       : choice.volumeCell    ? "--volume-cell"
                                              : nullptr;
  if (option) throw CLI::ValidationError(option, reason);
}

void applyContactOptions(const ContactChoice& choice, ContactSettings& settings) {
  settings.on = choice.on().value_or(settings.on);
  if (const auto method = choice.method()) settings.method = *method;
  if (choice.radius) settings.radius = choice.radius;
  if (choice.fillGaps) settings.fillGaps = *choice.fillGaps == "on";
  settings.detail = choice.detail.value_or(settings.detail);
  // Any of the three asks for pruning, also in a scene that has none.
  if (choice.prune || choice.maxNeighbours || choice.dropShare) settings.prunePairs = choice.prune != "none";
  if (choice.prune && settings.prunePairs) settings.minOverlaps = wholeNumber(*choice.prune);
  settings.maxNeighbours = choice.maxNeighbours.value_or(settings.maxNeighbours);
  settings.dropShare = choice.dropShare.value_or(settings.dropShare);
  if (choice.iterations) settings.iterations = choice.iterations;
  settings.friction = choice.friction.value_or(settings.friction);
  if (choice.volumeCell) settings.volumeCell = choice.volumeCell;
  if (choice.taper) settings.taper = *choice.taper == "time" ? ContactTaper::time : ContactTaper::distance;
}

}  // namespace ringlet::program
