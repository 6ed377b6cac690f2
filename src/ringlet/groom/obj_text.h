// ObjText: cuts the text of an OBJ file into words, line by line; and what its words say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ringlet {

/// A reading position in OBJ text. Lines end with LF, CR LF or CR; a backslash right before the end joins the
/// next line on;
/// '#' begins a comment. Lines may have any length. Allocates nothing.
class ObjText {
 public:
  explicit ObjText(std::string_view text);

  bool isAtEnd() const { return position_ == text_.size(); }
  /// Number, from 1, of the line at the reading position.
  std::size_t line() const { return line_; }
  /// The next word of this line; empty at its end.
  std::string_view nextWord();
  /// Passes over what is left of this line, comment and end included.
  void nextLine();

 private:
  std::size_t lineEndAt(std::size_t position) const;  // bytes of the line end there, 0 if there is none
  void skipBlanks();

  std::string_view text_;
  std::size_t position_ = 0, line_ = 1;
};

/// A finite number in any of C's decimal forms, whatever the locale; a leading plus is fine.
std::optional<float> parseObjNumber(std::string_view word);

/// The point's index of `i`, `i/t`, `i//n` or `i/t/n`, as it stands there: from 1, or from -1 back.
std::optional<std::int64_t> parseObjIndex(std::string_view word);

}  // namespace ringlet
