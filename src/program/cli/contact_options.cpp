// Implements contact_options.h.
#include "program/cli/contact_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string>

#include "program/cli/command_line.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::program {
namespace {

constexpr const char* kGroup = "Contacts";
constexpr const char *kOn = "contacts.on", *kMethod = "contacts.method", *kPrunes = "contacts.prune_pairs",
                     *kMinOverlaps = "contacts.min_overlaps", *kNoCrossings = "contacts.no_crossings";

// A pruning level: off, or a number of overlaps, at least 1.
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

void keepState(const std::string& state, TypedKeys& typed) {
  typed.options.push_back({kOn, state == "off" ? "false" : "true"});
  if (state != "off") typed.options.push_back({kMethod, state == "on" ? "auto" : state});
}

void keepPruning(const std::string& level, TypedKeys& typed) {
  typed.options.push_back({kPrunes, level == "none" ? "false" : "true"});
  if (level != "none") typed.options.push_back({kMinOverlaps, level});
}

}  // namespace

void addContactOptions(CLI::App& command, TypedKeys& typed, const std::string& defaultState) {
  command
      .add_option_function<std::string>(
          "--contacts", [&typed](const std::string& state) { keepState(state, typed); },
          "How strands push each other away: off; explicit, pair by pair; volume, all as a volume, coarse "
          "and fast; auto or on, as a volume where they are dense at rest and pair by pair elsewhere "
          "(default " +
              defaultState + "); jacobi only")
      ->check(oneOf({"off", "on", "auto", "explicit", "volume"}))
      ->type_name("STATE")
      ->group(kGroup);
  command
      .add_option_function<std::string>(
          "--prune", [&typed](const std::string& level) { keepPruning(level, typed); },
          "Overlapping spheres at rest from which on two strands may touch pair by pair, 1 to 1000000: more "
          "misses more and is little faster; none: all may, also those apart at rest (default none)")
      ->check(pruneLevel())
      ->type_name("N|none")
      ->group(kGroup);
  command
      .add_flag_callback(
          "--no-crossings",
          [&typed] {
            typed.options.push_back({kNoCrossings, "true"});
          },
          fieldNamed(contactFields(), "no_crossings")->effect)
      ->group(kGroup);
  addKeyOptions(command, typed, "contacts", kGroup);
}

std::optional<bool> typedContacts(const TypedKeys& typed) {
  const auto found = std::ranges::find(typed.options, kOn, &SceneChange::key);
  return found == typed.options.end() ? std::nullopt : std::optional(found->value == "true");
}

void checkContactOptions(const TypedKeys& typed) {
  const auto prunes = std::ranges::find(typed.options, kPrunes, &SceneChange::key);
  if (prunes == typed.options.end() || prunes->value == "true") return;
  for (const auto& [key, option] :
       {std::pair("contacts.max_neighbours", "--max-neighbours"), {"contacts.drop_share", "--drop-share"}})
    if (typed.has(key))
      throw CLI::ValidationError(option, "--prune none prunes nothing; leave one of the two out");
}

void refuseContactOptions(const TypedKeys& typed, const std::string& reason) {
  const auto saysHow = [](const SceneChange& change) {
    return change.key.starts_with("contacts.") && change.key != kOn && change.key != kMethod;
  };
  const auto how = std::ranges::find_if(typed.options, saysHow);
  if (how == typed.options.end()) return;
  const bool isPruning = how->key == kPrunes || how->key == kMinOverlaps;
  const bool isOfCrossings = how->key == kNoCrossings;
  throw CLI::ValidationError(isPruning       ? "--prune"
                             : isOfCrossings ? "--no-crossings"
                                             : optionNamed(how->key),
                             reason);
}

}  // namespace ringlet::program
