// Options made from tables of settings: every one of them reaches its setting, and nothing else does.
#include "program/cli/setting_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include <string>
#include <type_traits>
#include <vector>

#include "ringlet/scene/settings_fields.h"

namespace ringlet::program::setting_options_test {
namespace {

// The settings as a command line leaves them, or what CLI11 says of it.
struct Parsed {
  ContactSettings settings;
  TypedSettings typed;
  std::string problem;
};
Parsed parse(std::vector<std::string> words) {
  Parsed result;
  CLI::App app;
  addSettingOptions(&app, contactFields(), "contacts", result.typed, "Contacts");
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    result.problem = error.what();
  }
  applySettingOptions(contactFields(), result.typed, result.settings);
  return result;
}

// A value that is not the default, and one that is refused.
std::pair<std::string, std::string> valuesOf(const SettingField<ContactSettings>& field) {
  const bool isText = !field.choices.empty();
  if (isText) return {namesIn(field.choices).back(), "moon"};
  const bool isSwitch = std::holds_alternative<bool ContactSettings::*>(field.member);
  if (isSwitch) return {"on", "true"};
  const bool isWhole = std::holds_alternative<int ContactSettings::*>(field.member) ||
                       std::holds_alternative<std::optional<int> ContactSettings::*>(field.member);
  const double value = isWhole ? field.allowed.low + 3 : 0.5 * field.allowed.low + 0.5 * field.allowed.high;
  return {fmt::format("{}", value), fmt::format("{}", field.allowed.high + 1)};
}

bool isDefault(const SettingField<ContactSettings>& field, const ContactSettings& settings) {
  return std::visit([&](auto member) { return settings.*member == ContactSettings{}.*member; }, field.member);
}

TEST(SettingOptions, EachReachesItsSettingAndNoOther) {
  int count = 0;
  for (const SettingField<ContactSettings>& field : contactFields()) {
    if (!*field.option) continue;
    SCOPED_TRACE(field.option);
    ++count;
    const auto [value, refused] = valuesOf(field);
    const Parsed found = parse({field.option, value});
    EXPECT_EQ(found.problem, "");
    EXPECT_EQ(typedOption(contactFields(), found.typed), field.option);
    for (const SettingField<ContactSettings>& other : contactFields())
      EXPECT_EQ(isDefault(other, found.settings), other.key != field.key) << other.key;
    EXPECT_TRUE(checkNumbers(found.settings));
    EXPECT_NE(parse({field.option, refused}).problem, "");
  }
  EXPECT_GE(count, 9);
}

TEST(SettingOptions, NothingTypedIsNothing) {
  const Parsed none = parse({});
  EXPECT_EQ(typedOption(contactFields(), none.typed), "");
  EXPECT_EQ(fixedDifference(none.settings, ContactSettings{}), "");
}

// Every setting is either live or named where it differs.
TEST(SettingsFields, SayWhichMayNotChange) {
  for (const SettingField<ContactSettings>& field : contactFields()) {
    ContactSettings other;
    std::visit(
        [&](auto member) {
          auto& value = other.*member;
          using Value = std::remove_cvref_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, std::optional<int>>) {
            value = 1;
          } else if constexpr (std::is_same_v<Value, bool>) {
            value = !value;
          } else if constexpr (std::is_arithmetic_v<Value>) {
            value += 1;
          } else if constexpr (std::is_enum_v<Value>) {
            value = static_cast<Value>(1);
          } else if constexpr (std::is_same_v<Value, std::optional<double>>) {  // optional numbers
            value = 1.0;
          }
        },
        field.member);
    EXPECT_EQ(fixedDifference(ContactSettings{}, other),
              field.isLive ? "" : "contacts." + std::string(field.key));
  }
}

}  // namespace
}  // namespace ringlet::program::setting_options_test
