// Implements groom/obj_text.h.
#include "ringlet/groom/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ringlet {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // some editors put it before UTF-8

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

ObjText::ObjText(std::string_view text) : text_(text) {
  if (text_.starts_with(kByteOrderMark)) position_ = kByteOrderMark.size();
}

std::size_t ObjText::lineEndAt(std::size_t position) const {
  if (position >= text_.size()) return 0;
  if (text_[position] == '\n') return 1;
  if (text_[position] != '\r') return 0;
  return position + 1 < text_.size() && text_[position + 1] == '\n' ? 2 : 1;
}

void ObjText::skipBlanks() {
  while (position_ < text_.size()) {
    if (isBlank(text_[position_])) {
      ++position_;
      continue;
    }
    const std::size_t end = text_[position_] == '\\' ? lineEndAt(position_ + 1) : 0;
    if (end == 0) return;
    position_ += 1 + end;
    ++line_;
  }
}

std::string_view ObjText::nextWord() {
  skipBlanks();
  const std::size_t start = position_;
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (isBlank(c) || c == '#' || lineEndAt(position_) > 0) break;
    if (c == '\\' && lineEndAt(position_ + 1) > 0) break;
    ++position_;
  }
  return text_.substr(start, position_ - start);
}

void ObjText::nextLine() {
  // A comment ends with its line; before it, a backslash goes on to the next.
  while (!nextWord().empty()) {
  }
  while (position_ < text_.size() && lineEndAt(position_) == 0) ++position_;
  if (position_ < text_.size()) {
    position_ += lineEndAt(position_);
    ++line_;
  }
}

std::optional<float> parseObjNumber(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  float value = 0;
  const char* const end = word.data() + word.size();
  auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code == std::errc::result_out_of_range && stop == end) {
    // Too large for a float is wrong; too near zero is as good as zero.
    double wide = 0;
    const bool isWide = std::from_chars(word.data(), end, wide).ec == std::errc();
    const bool isTiny =
        isWide ? std::abs(wide) < 1 : word.find("e-") != word.npos || word.find("E-") != word.npos;
    if (!isTiny) return std::nullopt;
    return static_cast<float>(wide);
  }
  if (code != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parseObjIndex(std::string_view word) {
  const std::size_t slash = std::min(word.find('/'), word.size());
  std::string_view number = word.substr(0, slash);
  if (number.size() > 1 && number.front() == '+' && number[1] != '-') number.remove_prefix(1);
  std::int64_t index = 0;
  const char* const end = number.data() + number.size();
  const auto [stop, code] = std::from_chars(number.data(), end, index);
  const bool isIndex = code == std::errc() && stop == end;
  if (!isIndex || word.find_first_not_of("-+/0123456789", slash) != word.npos) return std::nullopt;
  return index;
}

}  // namespace ringlet
