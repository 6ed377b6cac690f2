// base/shown_text.h: no text commands a terminal, and none that does not is changed.
#include "ringlet/base/shown_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ringlet::shown_text_test {
namespace {

TEST(ShownText, WhatCommandsATerminalIsShown) {
  EXPECT_EQ(shownText("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(shownText("a\rb\bc\ad"), "a\\x0db\\x08c\\x07d");
  EXPECT_EQ(shownText(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(shownText("\x7f"), "\\x7f");
  EXPECT_EQ(shownText("\xc2\x9b[2J"), "\\x9b[2J") << "C1 in UTF-8";
  EXPECT_EQ(shownText("\x9b[2J"), "\\x9b[2J") << "C1 as one byte";
}

TEST(ShownText, NoByteOfAControlIsLeft) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string text{static_cast<char>(first), static_cast<char>(second)};
      const std::string shown = shownText(text);
      for (std::size_t k = 0; k < shown.size(); ++k) {
        const auto byte = static_cast<unsigned char>(shown[k]);
        EXPECT_TRUE(byte >= 0x20 || byte == '\n' || byte == '\t') << first << " " << second;
        EXPECT_NE(byte, 0x7f) << first << " " << second;
        const bool isOfTwo = k > 0 && static_cast<unsigned char>(shown[k - 1]) >= 0xc2;
        if (byte >= 0x80 && byte < 0xa0) {
          EXPECT_TRUE(isOfTwo && static_cast<unsigned char>(shown[k - 1]) != 0xc2) << first << " " << second;
        }
      }
    }
  }
}

TEST(ShownText, TextOfAnyLanguageStays) {
  for (const char* text : {"", "a line\n\tand another\n", "K\xc3\xb6pfchen", "\xe9\xa0\xad",
                           "\xf0\x9f\x92\x87", "\xc2\xa0", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(shownText(text), text);
}

TEST(ShownText, WhatIsNoUtf8IsShown) {
  EXPECT_EQ(shownText("\xc3"), "\\xc3") << "cut";
  EXPECT_EQ(shownText("\xc1\x9b"), "\\xc1\\x9b") << "too long a form of a control";
  EXPECT_EQ(shownText("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(shownText("\xf0\x80\x82\x9b"), "\\xf0\\x80\\x82\\x9b");
  EXPECT_EQ(shownText("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair";
  EXPECT_EQ(shownText("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(ShownText, JsonStaysJson) {
  EXPECT_EQ(shownJson("{\"a\": \"\xc2\x9b\x7f \xc3\xb6\"}\n"), "{\"a\": \"\\u009b\\u007f \xc3\xb6\"}\n");
}

}  // namespace
}  // namespace ringlet::shown_text_test
