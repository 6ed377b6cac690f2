// The rows of settings (scene/settings_fields.h).
#include "ringlet/scene/settings_fields.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <type_traits>

namespace ringlet::settings_fields_test {
namespace {

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
}  // namespace ringlet::settings_fields_test
