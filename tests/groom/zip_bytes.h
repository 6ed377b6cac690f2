// ZipBytes: a package of stored files field by field; tests spoil one field each.
#pragma once

#include <cstdint>
#include <string>

namespace ringlet::test {

/// By itself one file, a.usda. Fields of the directory are the file's own, unless they are set.
struct ZipBytes {
  std::string name = "a.usda", extra{}, content{};
  std::uint16_t method = 0, flags = 0;
  std::string nameInDirectory{};
  std::uint32_t sizeInBoth = 0, sizeInDirectory = 0, begin = 0;
  int others = 0;  // small files behind it
  std::string comment{};

  std::string bytes() const {
    std::string out = file(name, extra, content);
    std::string directory = entry(nameInDirectory.empty() ? name : nameInDirectory,
                                  sizeInDirectory ? sizeInDirectory
                                  : sizeInBoth    ? sizeInBoth
                                                  : size(content),
                                  begin);
    for (int i = 0; i < others; ++i) {
      directory += entry("b.png", 3, size(out));
      out += file("b.png", "", "png");
    }
    const std::uint32_t at = size(out);
    out += directory;
    number(out, 0x06054b50, 4);
    for (const int value : {0, 0, 1 + others, 1 + others}) number(out, static_cast<std::uint32_t>(value), 2);
    number(out, size(directory), 4);
    number(out, at, 4);
    number(out, size(comment), 2);
    return out + comment;
  }

 private:
  static std::uint32_t size(const std::string& text) { return static_cast<std::uint32_t>(text.size()); }
  static void number(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i & 0xff);
  }
  // What a file and its entry have in common, from the version on.
  std::string head(const std::string& called, std::uint32_t length, std::size_t more) const {
    std::string out;
    for (const std::uint32_t value : {10u, std::uint32_t{flags}, std::uint32_t{method}, 0u, 0u})
      number(out, value, 2);
    for (const std::uint32_t value : {0u, length, length}) number(out, value, 4);
    number(out, size(called), 2);
    number(out, static_cast<std::uint32_t>(more), 2);
    return out;
  }
  std::string file(const std::string& called, const std::string& more, const std::string& bytes) const {
    std::string out;
    number(out, 0x04034b50, 4);
    return out + head(called, sizeInBoth ? sizeInBoth : size(bytes), more.size()) + called + more + bytes;
  }
  std::string entry(const std::string& called, std::uint32_t length, std::uint32_t at) const {
    std::string out;
    number(out, 0x02014b50, 4);
    number(out, 10, 2);
    out += head(called, length, 0);
    for (int i = 0; i < 3; ++i) number(out, 0, 2);
    number(out, 0, 4);
    number(out, at, 4);
    return out + called;
  }
};

}  // namespace ringlet::test
