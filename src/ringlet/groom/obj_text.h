// ObjText: cuts the text of an OBJ file into words, line by line.
#pragma once

#include <cstddef>
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

}  // namespace ringlet
