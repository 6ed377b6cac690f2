// Implements groom/obj_text.h.
#include "ringlet/groom/obj_text.h"

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

}  // namespace ringlet
