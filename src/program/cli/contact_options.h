// The options by which commands choose contacts between hairs.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"
#include "program/cli/setting_options.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::program {

/// Contacts as asked for on a command line; what was left out is the scene's, or ContactSettings' own.
struct ContactChoice {
  std::optional<std::string> state;  // off, on, or one of kContactMethodNames
  std::optional<std::string> prune;  // a number of overlaps, or none
  TypedSettings typed;               // all others

  /// Switched on or off; unset: neither.
  std::optional<bool> on() const { return state ? std::optional(*state != "off") : std::nullopt; }
  /// How, where they are switched on.
  std::optional<ContactMethod> method() const;
};

/// Adds the group of options "Contacts". defaultState: what --help says where --contacts is left out.
/// `choice` must outlive the command.
void addContactOptions(CLI::App* command, ContactChoice& choice, const std::string& defaultState);

/// Throws CLI11's error for options that exclude each other.
void checkContactOptions(const ContactChoice& choice);

/// Throws CLI11's error for an option that says how contacts are, where `reason` says that there are none.
void refuseContactOptions(const ContactChoice& choice, const std::string& reason);

void applyContactOptions(const ContactChoice& choice, ContactSettings& settings);

}  // namespace ringlet::program
