// Implements contact_options.h.
#include "program/cli/contact_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>

#include "program/cli/command_line.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::program {
namespace {

constexpr const char* kGroup = "Contacts";
// Either asks for pruning.
constexpr const char *kMaxNeighbours = "max_neighbours", *kDropShare = "drop_share";

// A level of pruning: none, or overlaps from 1 on.
CLI::Validator pruneLevel() {
  const NumberRange allowed = fieldNamed(contactFields(), "min_overlaps")->allowed;
  const CLI::Validator number =
      wholeBetween(static_cast<std::int64_t>(allowed.low), static_cast<std::int64_t>(allowed.high));
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
  command
      ->add_option(
          "--contacts", choice.state,
          "How strands push each other away: off; explicit, pair by pair; volume, all as a volume, coarse "
          "and fast; auto or on, as a volume where they are dense at rest and pair by pair elsewhere "
          "(default " +
              defaultState + "); jacobi only")
      ->check(oneOf({"off", "on", "auto", "explicit", "volume"}))
      ->type_name("STATE")
      ->group(kGroup);
  command
      ->add_option(
          "--prune", choice.prune,
          "Overlapping spheres at rest from which on two strands may touch pair by pair, 1 to 1000000: more "
          "misses more and is little faster; none: all may, also those apart at rest (default none)")
      ->check(pruneLevel())
      ->type_name("N|none")
      ->group(kGroup);
  addSettingOptions(command, contactFields(), "contacts", choice.typed, kGroup);
}

void checkContactOptions(const ContactChoice& choice) {
  const char* pruning = choice.typed.contains(kMaxNeighbours) ? "--max-neighbours"
                        : choice.typed.contains(kDropShare)   ? "--drop-share"
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
  const std::string option = choice.prune ? "--prune" : typedOption(contactFields(), choice.typed);
  if (!option.empty()) throw CLI::ValidationError(option, reason);
}

void applyContactOptions(const ContactChoice& choice, ContactSettings& settings) {
  settings.on = choice.on().value_or(settings.on);
  if (const auto method = choice.method()) settings.method = *method;
  applySettingOptions(contactFields(), choice.typed, settings);
  // Any of the three asks for pruning, also in a scene that has none.
  if (choice.prune || choice.typed.contains(kMaxNeighbours) || choice.typed.contains(kDropShare))
    settings.prunePairs = choice.prune != "none";
  if (choice.prune && settings.prunePairs) settings.minOverlaps = wholeNumber(*choice.prune);
}

}  // namespace ringlet::program
