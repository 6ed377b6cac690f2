// Implements scenes/file/scene_change.h.
#include "ringlet/scenes/file/scene_change.h"

#include <fmt/format.h>

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::size_t kMostWords = 8;  // of a dotted key; no scene has one of more than four

std::vector<std::string> wordsOf(std::string_view key) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t dot = key.find('.');
    words.emplace_back(key.substr(0, dot));
    if (dot == std::string_view::npos) return words;
    key.remove_prefix(dot + 1);
  }
}

// The table below a node that a word of the key names.
Result<toml::table*> tableBelow(toml::node& node, const std::string& word, const std::string& key) {
  if (toml::array* list = node.as_array()) {
    std::size_t number = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool isNumber = code == std::errc{} && end == word.data() + word.size();
    if (isNumber && number >= 1 && number <= list->size() && (*list)[number - 1].is_table())
      return (*list)[number - 1].as_table();
    return Error{fmt::format("found {} in the key {}; expected the number of a table, from 1 to {}",
                             ringlet::quoted(word), ringlet::quoted(key), list->size())};
  }
  if (!node.is_table())
    return Error{fmt::format("found the key {} below {}", ringlet::quoted(key), found(node))};
  toml::table& table = *node.as_table();
  if (!table.contains(word)) table.insert(word, toml::table{});
  toml::node& next = *table.get(word);
  if (toml::table* below = next.as_table()) return below;
  return Error{fmt::format("found the key {}, but {} is {}", ringlet::quoted(key), ringlet::quoted(word),
                           found(next))};
}

}  // namespace

Status applyChange(const SceneChange& change, toml::table& file) {
  const std::vector<std::string> words = wordsOf(change.key);
  for (const std::string& word : words) {
    if (word.empty() || words.size() > kMostWords)
      return Error{fmt::format("found {}; expected a key with its table, as simulation.gravity",
                               ringlet::quoted(change.key))};
  }
  toml::table* table = &file;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    toml::node* list = table->get(words[i]);
    const bool isList = list && list->is_array() && i + 2 < words.size();
    auto below =
        isList ? tableBelow(*list, words[i + 1], change.key) : tableBelow(*table, words[i], change.key);
    if (!below) return below.error();
    table = *below;
    if (isList) ++i;
  }
  for (const std::string& key : change.without) table->erase(key);
  if (change.form != SceneChange::Form::toml) {
    table->insert_or_assign(words.back(), change.value);
    return {};
  }
  const auto value = parseToml("value = " + change.value, "", "a value");
  if (value && value->size() == 1 && value->contains("value")) {
    // A copy has no line.
    value->get("value")->visit([&](const auto& node) { table->insert_or_assign(words.back(), node); });
  } else {
    table->insert_or_assign(words.back(), change.value);
  }
  return {};
}

}  // namespace ringlet
