// Implements base/host_words.h.
#include "ringlet/base/host_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <regex>

namespace ringlet {
namespace {

// An option in a sentence, with its value and the key of scene files that stands beside it, where they do.
struct Named {
  std::string option, value, key;
};

// The forms in which sentences name an option, the longest first, and which group of each is what.
constexpr const char* kForms =
    R"re((\w+ = "[^"]*" of \[+\w+\]+) \(--([a-z-]+) ([^()]*)\))re"     // up = "Z" of [groom] (--up Z)
    R"re(|--([a-z-]+) (\S+) \((\w+ = "[^"]*" of \[\w+\])\))re"         // --up Z (up = "Z" of [groom])
    R"re(|--([a-z-]+)(?: (\w+))? \((\w+ of \[\w+\])\))re"              // --unit (unit of [groom])
    R"re(|--([a-z-]+), (\w+ of \[\w+\]))re"                            // --unit, unit of [groom]
    R"re(|--([a-z-]+)(?: ([-+]?(?:[0-9][0-9.e-]*|[XYZ](?!\w))))?)re";  // --unit 0.01
constexpr int kNone = -1;
constexpr struct {
  int option, value, key;
} kGroups[] = {{2, 3, 1}, {4, 5, 6}, {7, 8, 9}, {10, kNone, 11}, {12, 13, kNone}};

Named named(const std::smatch& found) {
  for (const auto& groups : kGroups) {
    if (!found[static_cast<std::size_t>(groups.option)].matched) continue;
    const auto group = [&](int index) {
      return index == kNone ? std::string() : found[static_cast<std::size_t>(index)].str();
    };
    return {group(groups.option), group(groups.value), group(groups.key)};
  }
  return {};
}

// Each option in turn; what `say` gives nothing for stays.
std::string said(std::string_view sentence,
                 const std::function<std::optional<std::string>(const Named&)>& say) {
  static const std::regex forms(kForms);
  const std::string text(sentence);
  std::string all;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), forms), end; at != end; ++at) {
    const auto begin = text.cbegin() + at->position();
    const bool standsAlone = begin == text.cbegin() || begin[-1] == ' ' || begin[-1] == '(';
    all.append(from, begin);
    all += (standsAlone ? say(named(*at)) : std::nullopt).value_or(at->str());
    from = begin + at->length();
  }
  return all.append(from, text.cend());
}

std::optional<std::string> wordFor(std::span<const HostWord> words, const Named& of) {
  const auto found = std::ranges::find_if(words, [&](const HostWord& word) {
    return word.option == of.option && (word.value.empty() || word.value == of.value);
  });
  if (found == words.end()) return std::nullopt;
  return of.value.empty() ? std::string(found->name) : fmt::format(fmt::runtime(found->assignment), of.value);
}

// Where a sentence names an option alone.
constexpr HostWord kSceneWords[] = {
    {"unit", "unit of [groom]", "unit = {} of [groom]"},
    {"up", "up of [groom]", "up = \"{}\" of [groom]"},
    {"bind-frame", "bind_frame of [groom]", "bind_frame = {} of [groom]"},
    {"motion-unit", "unit of [motion]", "unit = {} of [motion]"},
};

}  // namespace

std::string inHostWords(std::string_view sentence, std::span<const HostWord> words) {
  return said(sentence, [&](const Named& of) { return wordFor(words, of); });
}

std::string inSceneWords(std::string_view sentence) {
  return said(sentence, [](const Named& of) {
    return of.key.empty() ? wordFor(kSceneWords, of) : std::optional<std::string>(of.key);
  });
}

}  // namespace ringlet
