// Implements command_line.h.
#include "program/cli/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "ringlet/base/nearest_name.h"

namespace ringlet::program {
namespace {

// The innermost subcommand on the command line: `make curl`, not `make`.
const CLI::App& innermost(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : innermost(*chosen.front());
}

std::string fullName(const CLI::App& app) {
  return app.get_parent() ? fullName(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

// Rewrites CLI11's message "Could not convert: --seed = 99999999999" about a number without a check.
std::string outOfRange(const std::string& what) {
  const std::size_t colon = what.find(": "), equals = what.find(" = ");
  if (colon == std::string::npos || equals == std::string::npos || equals < colon) return what;
  return fmt::format("{}: '{}' is no number, or beyond what it can be",
                     what.substr(colon + 2, equals - colon - 2), what.substr(equals + 3));
}

}  // namespace

std::string closestName(std::string_view word, const std::vector<std::string>& names) {
  const std::size_t nearest = nearestName(word, names);
  return nearest < names.size() ? names[nearest] : "";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const std::string closest = closestName(word, names);
  return closest.empty() ? "" : fmt::format("; did you mean {}?", closest);
}

CLI::Validator oneOf(std::vector<std::string> names) {
  return CLI::Validator(
      [names = std::move(names)](std::string& word) {
        if (std::find(names.begin(), names.end(), word) != names.end()) return std::string();
        return fmt::format("there is no '{}' (only {}){}", word, fmt::join(names, ", "),
                           suggestion(word, names));
      },
      "");
}

CLI::Validator between(double low, double high) {
  return CLI::Validator(
      [=](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool isNumber = end != text.c_str() && *end == '\0';
        if (isNumber && value >= low && value <= high) return std::string();  // false for NaN
        return fmt::format("must be a number from {} to {}, not '{}'", low, high, text);
      },
      "");
}

CLI::Validator wholeBetween(std::int64_t low, std::int64_t high) {
  return CLI::Validator(
      [=](std::string& text) {
        std::int64_t value = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool isWhole = code == std::errc() && end == text.data() + text.size();
        if (isWhole && value >= low && value <= high) return std::string();
        return fmt::format("must be a whole number from {} to {}, not '{}'", low, high, text);
      },
      "");
}

CLI::Validator endsIn(std::vector<std::string> extensions) {
  return CLI::Validator(
      [extensions = std::move(extensions)](std::string& path) {
        std::string extension = std::filesystem::path(path).extension().string();
        for (char& c : extension) {
          if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        }
        if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
          return std::string();
        return fmt::format("'{}' must end in {}", path, fmt::join(extensions, " or "));
      },
      "");
}

CLI::Option* addBackendOption(CLI::App& command, std::string& backend) {
  return command
      .add_option("--backend", backend, "gpu (Vulkan) or reference (CPU, double precision) (default gpu)")
      ->check(oneOf({"gpu", "reference"}))
      ->type_name("NAME");
}

CLI::Option* addDeviceOption(CLI::App& command, std::string& device) {
  return command
      .add_option(
          "--device", device,
          "Vulkan device, by index or part of its name; see `ringlet devices` (default $RINGLET_DEVICE, else "
          "the best)")
      ->type_name("D");
}

std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = innermost(app);
  std::string what = error.what();
  if (dynamic_cast<const CLI::ConversionError*>(&error)) what = outOfRange(what);

  // The first unknown word: an option, or a subcommand where one is required.
  const std::vector<std::string> unknown = app.remaining(true);
  std::vector<std::string> commands;
  const auto subcommands = command.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* subcommand : subcommands) commands.push_back(subcommand->get_name());
  if (unknown.empty() && !commands.empty() && command.get_subcommands().empty()) {
    what = fmt::format("say what to do: {}", fmt::join(commands, ", "));
  }
  if (!unknown.empty()) {
    const std::string& word = unknown.front();
    if (word.starts_with("-")) {
      std::vector<std::string> names;
      for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      }
      what = fmt::format("there is no option {}{}", word, suggestion(word, names));
    } else if (!commands.empty()) {
      what = fmt::format("there is no command '{}' (only {}){}", word, fmt::join(commands, ", "),
                         suggestion(word, commands));
    } else {
      what = fmt::format("one word too many: '{}'", word);
    }
  }
  return fmt::format("{}: {}\nSee {} --help.", fullName(command), what, fullName(command));
}

}  // namespace ringlet::program
