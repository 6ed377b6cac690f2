// The group of options "Contacts": keys of [contacts], and two options that say several of them.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"
#include "program/cli/key_options.h"

namespace ringlet::program {

/// Adds the group. defaultState: what --help says where --contacts is left out. `typed` must outlive the
/// command.
void addContactOptions(CLI::App& command, TypedKeys& typed, const std::string& defaultState);

/// On or off, as typed; unset: neither.
std::optional<bool> typedContacts(const TypedKeys& typed);

/// Throws CLI11's error for options that exclude each other.
void checkContactOptions(const TypedKeys& typed);

/// Throws CLI11's error for an option that says how contacts are, where `reason` says that there are none.
void refuseContactOptions(const TypedKeys& typed, const std::string& reason);

}  // namespace ringlet::program
