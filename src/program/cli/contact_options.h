// The option group "Contacts": keys of [contacts], and two options that set several of them.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"
#include "program/cli/key_options.h"

namespace ringlet::program {

/// Adds the group. defaultState: the state that --help gives for a missing --contacts. `typed` must outlive
/// the command.
void addContactOptions(CLI::App& command, TypedKeys& typed, const std::string& defaultState);

/// On or off as typed; none if it was not typed.
std::optional<bool> typedContacts(const TypedKeys& typed);

/// Throws CLI11's error for options that exclude each other.
void checkContactOptions(const TypedKeys& typed);

/// Throws CLI11's error for any option about contacts; `reason` says why there are no contacts.
void refuseContactOptions(const TypedKeys& typed, const std::string& reason);

}  // namespace ringlet::program
