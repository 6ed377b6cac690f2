// Implements picture_options.h.
#include "program/render/picture_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>

#include "program/cli/command_line.h"
#include "ringlet/render/look.h"

namespace ringlet::program {

std::optional<std::pair<int, int>> parsePair(const std::string& text, char between) {
  const char *at = text.data(), *end = at + text.size();
  std::pair<int, int> pair;
  auto [middle, first] = std::from_chars(at, end, pair.first);
  if (first != std::errc() || middle == end || *middle != between) return std::nullopt;
  auto [stop, second] = std::from_chars(middle + 1, end, pair.second);
  if (second != std::errc() || stop != end) return std::nullopt;
  return pair;
}

CLI::Validator isPair(char between, int least, int most, const char* example) {
  return CLI::Validator(
      [=](std::string& text) {
        const auto pair = parsePair(text, between);
        const bool isFine = pair && std::min(pair->first, pair->second) >= least &&
                            std::max(pair->first, pair->second) <= most;
        return isFine ? std::string()
                      : fmt::format("must be two numbers from {} to {}, as {}, not '{}'", least, most,
                                    example, text);
      },
      "");
}

void addSamplesOption(CLI::App& command, int& samples) {
  command.add_option("--samples", samples, "Samples along a pixel's side: 1 is fast, 4 is smooth")
      ->check(wholeBetween(1, 4))
      ->capture_default_str()
      ->type_name("N");
}

void addColourOption(CLI::App& command, std::string& colour, const std::string& others) {
  const std::string all = hairColourNames() + (others.empty() ? "" : ", " + others);
  const std::string also =
      others.empty() ? "" : fmt::format("; or a number of each strand: {} (see below)", others);
  command.add_option("--colour", colour, fmt::format("Of hair: {}{}", hairColourNames(), also))
      ->check(CLI::Validator(
          [all](std::string& name) {
            const bool isKnown =
                fmt::format(", {},", all).find(fmt::format(", {},", name)) != std::string::npos;
            return isKnown ? std::string() : fmt::format("is one of {}, not '{}'", all, name);
          },
          ""))
      ->capture_default_str()
      ->type_name("NAME");
}

}  // namespace ringlet::program
