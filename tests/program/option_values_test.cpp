// Every option of every command refuses what is none of its values, unless any text may be one.
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <functional>
#include <set>
#include <string>

#include "program/commands.h"

namespace ringlet::program::option_values_test {
namespace {

constexpr const char* kNothing = "no such value!";

// What CLI11 says of the value; nothing: it is taken.
std::string refusal(CLI::Option& option) {
  try {
    option.add_result(kNothing);
    option.run_callback();
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

void eachOption(CLI::App& command, const std::string& path,
                const std::function<void(CLI::Option&, const std::string&)>& tell) {
  for (CLI::Option* option : command.get_options())
    if (option->get_expected_max() > 0) tell(*option, path + " " + option->get_name());
  for (CLI::App* below : command.get_subcommands(nullptr))
    eachOption(*below, path + " " + below->get_name(), tell);
}

TEST(OptionValues, AreRefusedWhereTheyAreNone) {
  CLI::App app;
  int exitCode = 0;
  addCommands(app, exitCode);
  // Paths and devices, by what help calls them; then names that a file has, and lists that the command reads.
  const std::set<std::string> anyOfType{"FILE", "PATH", "DIR", "FOLDER", "RUN", "GROOM", "D", "D,D"};
  const std::set<std::string> any{
      "ringlet render --camera", "ringlet simulate --animation",      "ringlet simulate --joint",
      "ringlet kernels --only",  "ringlet kernels --shapes",          "ringlet sweep --only",
      "ringlet sweep --vary",    "ringlet simulate --guides-primvar", "ringlet view --guides-primvar"};
  int refused = 0;
  eachOption(app, "ringlet", [&](CLI::Option& option, const std::string& name) {
    const bool isRefused = !refusal(option).empty();
    refused += isRefused;
    if (!anyOfType.contains(option.get_type_name())) {
      EXPECT_EQ(isRefused, !any.contains(name)) << name << " " << option.get_type_name();
    }
  });
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace ringlet::program::option_values_test
