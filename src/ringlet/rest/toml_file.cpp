// Implements rest/toml_file.h.
#include "ringlet/rest/toml_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "ringlet/base/nearest_name.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

// Keys nest a table per dot, and toml++ 3.3 recurses through them without a limit: 8,000 are too deep for a
// stack of 8 MiB with sanitizers. Between two dots counted here there may be one that is not counted.
constexpr std::size_t kMostDots = 2048;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isOfWord(char c) {
  return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '+' ||
         c == '-';
}

// Counts dots except those of decimal numbers, of which there may be many: a dot between two digits that is
// the only one in its word.
std::size_t dotsOfKeys(std::string_view line) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    std::size_t dots = 0, end = at;
    bool isDecimal = false;
    for (; end < line.size() && isOfWord(line[end]); ++end) {
      if (line[end] != '.') continue;
      ++dots;
      isDecimal =
          dots == 1 && end > at && isDigit(line[end - 1]) && end + 1 < line.size() && isDigit(line[end + 1]);
    }
    count += isDecimal ? 0 : dots;
    at = std::max(at, end);
  }
  return count;
}

// The largest possible nesting depth: keys with values may be nested in each other; only one heading counts.
std::size_t nestingOf(std::string_view text) {
  std::size_t withValues = 0, heading = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (line.find_first_of("={") != std::string_view::npos) {
      withValues += dotsOfKeys(line);
    } else {
      heading = std::max(heading, dotsOfKeys(line));
    }
    at = end + 1;
  }
  return withValues + heading;
}

Error tooLarge(const std::string& name, std::uintmax_t size, const char* what) {
  return {fmt::format("{}: found {} bytes; expected {}, which has {} at most", name, size, what,
                      kLargestTomlFile)};
}

std::string adviceOnKey(std::string_view word, const std::string& table, std::span<const KnownKey> known) {
  std::vector<KnownKey> keys(known.begin(), known.end());
  const auto others = std::stable_partition(keys.begin(), keys.end(),
                                            [&](const KnownKey& key) { return key.table == table; });
  std::vector<std::string> names;
  for (const KnownKey& key : keys) names.push_back(key.key);
  const std::size_t nearest = nearestName(word, names);
  names.resize(static_cast<std::size_t>(others - keys.begin()));
  if (nearest == keys.size()) return fmt::format("expected {}", fmt::join(names, ", "));
  const KnownKey& meant = keys[nearest];
  if (table.empty() || !meant.table.empty()) return fmt::format("did you mean {}?", meant.fullName());
  // Keys after a table's heading belong to that table, also at the end of a file.
  return fmt::format("did you mean {}, which stands above all tables? [{}] takes {}", meant.key, table,
                     fmt::join(names, ", "));
}

}  // namespace

Result<toml::table> parseToml(std::string_view text, const std::string& name, const char* what) {
  if (text.size() > kLargestTomlFile) return tooLarge(name, text.size(), what);
  if (const std::size_t dotCount = nestingOf(text); dotCount > kMostDots) {
    return Error{
        fmt::format("{}: found {} dots; expected {}, which has {} at most", name, dotCount, what, kMostDots)};
  }
  toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return Error{
        fmt::format("{}: line {}: found no TOML: {}", name, error.source().begin.line, error.description())};
  }
  return std::move(parsed).table();
}

Result<std::string> readTomlText(const std::filesystem::path& path, const char* what) {
  // Before memory is allocated.
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kLargestTomlFile) return tooLarge(path.string(), size, what);
  auto bytes = readWholeFile(path);
  if (!bytes) return bytes.error();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

std::uint32_t lineOf(const toml::node& node) { return node.source().begin.line; }

std::string found(const toml::node& node) {
  if (const auto* text = node.as_string()) return "the text " + ringlet::quoted(text->get());
  if (const auto* number = node.as_integer()) return fmt::format("the number {}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("the number {}", number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string tomlNumber(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // inf and nan stay as they are
  return text;
}

std::string tomlText(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += fmt::format("\\{}", c);
    } else if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\u{:04x}", byte);
    } else {
      result += c;
    }
  }
  return result + "\"";
}

void TomlProblems::add(std::uint32_t line, std::string message) {
  if (!message_.empty() && line >= line_) return;
  line_ = line;
  message_ = std::move(message);
}

void TomlProblems::addFound(const toml::node& node, const std::string& key, const std::string& expected) {
  add(lineOf(node), fmt::format("found {} for {}; expected {}", found(node), key, expected));
}

void TomlProblems::addUnknownKeys(const toml::table& table, const std::string& name,
                                  std::span<const KnownKey> known) {
  for (const auto& [key, node] : table) {
    const std::string_view word = key.str();
    const bool isKnown = std::any_of(known.begin(), known.end(), [&](const KnownKey& one) {
      return one.table == name && one.key == word;
    });
    if (isKnown) continue;
    const std::string where = name.empty() ? "" : " in [" + name + "]";
    add(key.source().begin.line,
        fmt::format("found the unknown key {}{}; {}", quoted(word), where, adviceOnKey(word, name, known)));
  }
}

Error TomlProblems::error(const std::string& name) const {
  if (line_ == 0) return Error{fmt::format("{}: {}", name, message_)};
  return Error{fmt::format("{}: line {}: {}", name, line_, message_)};
}

}  // namespace ringlet
