// What readers of TOML files share: parsing that no text can break, values in words, the topmost problem of a
// file, advice on unknown keys. Private to the library: it shows toml++.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "ringlet/base/result.h"

// Errors come as values. toml++ 3.3 asserts what a file can break ("[,"), and with NDEBUG lets the compiler
// assume it; its own error, which comes next, is what is wanted.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(condition) static_cast<void>(0)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace ringlet {

inline constexpr std::uintmax_t kLargestTomlFile = 1 << 20;  // [bytes] what it may be; more is another file

/// `name` stands for the file in messages, `what` says what it should hold ("a material"). Errors: too large,
/// nested too deeply, no TOML.
Result<toml::table> parseToml(std::string_view text, const std::string& name, const char* what);

/// The text of a file that is small enough. Errors: as for readWholeFile, too large.
Result<std::string> readTomlText(const std::filesystem::path& path, const char* what);

std::uint32_t lineOf(const toml::node& node);

/// A value as it may stand in a message: "the text 'soft'", "the number 5".
std::string found(const toml::node& node);

/// The shortest decimal that reads back as the same bits, always with a point or an exponent.
std::string tomlNumber(double value);

/// A text in quotes that reads back as the same bytes; it is UTF-8.
std::string tomlText(std::string_view text);

/// A key and the table it belongs in, "" for the file itself.
struct KnownKey {
  std::string table, key;
  std::string fullName() const { return table.empty() ? key : table + "." + key; }
};

/// Of several problems of a file the topmost is told.
class TomlProblems {
 public:
  void add(std::uint32_t line, std::string message);
  void addFound(const toml::node& node, const std::string& key, const std::string& expected);
  /// Every key of a table called `name` that is none of the known ones, with what may have been meant: the
  /// nearest of all keys, those of the same table first, or what the table may hold.
  void addUnknownKeys(const toml::table& table, const std::string& name, std::span<const KnownKey> known);

  bool empty() const { return message_.empty(); }
  /// "NAME: line N: ..."; there is one.
  Error error(const std::string& name) const;

 private:
  std::uint32_t line_ = 0;
  std::string message_;
};

}  // namespace ringlet
