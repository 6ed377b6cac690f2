// Implements support/strict_usd.h.
#include "tests/support/strict_usd.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "tests/support/test_support.h"

namespace ringlet::test {
namespace {

class StrictUsdReader {
 public:
  explicit StrictUsdReader(const std::filesystem::path& path) {
    if (!std::ifstream(path)) throw std::runtime_error("cannot open " + path.string());
    text_ = readText(path);
  }

  UsdFile read() {
    UsdFile usd;
    const std::string magic = "#usda 1.0\n";
    if (text_.compare(0, magic.size(), magic) != 0) fail("the first line");
    at_ = magic.size();
    expect("(");
    while (!accept(")")) {
      std::string key = word();
      expect("=");
      usd.metadata[key] = peek() == '"' ? quoted() : word();
    }
    expect("def");
    expect("BasisCurves");
    if (quoted() != "\"Hair\"") fail("the prim's name");
    expect("{");
    while (!accept("}")) {
      readAttribute(usd);
      // A statement ends with its line, or with a semicolon.
      const std::size_t end = at_;
      skipSpace();
      const bool isNewLine = text_.find('\n', end) < at_;
      if (!accept(";") && !isNewLine) fail("the statement's end");
    }
    skipSpace();
    while (at_ < text_.size() && text_[at_] == '#') {  // a comment runs to its line's end
      at_ = std::min(text_.find('\n', at_), text_.size());
      skipSpace();
    }
    if (at_ != text_.size()) fail("the end of the file");
    return usd;
  }

 private:
  void readAttribute(UsdFile& usd) {
    std::string type = word();
    if (type == "uniform") {
      if (word() != "token") fail("a token");
      std::string name = word();
      expect("=");
      usd.tokens[name] = quoted();
      return;
    }
    std::string name = word();
    if (name == "curveVertexCounts" && type == "int[") {
      expect("=");
      for (double count : numbers()) usd.counts.push_back(static_cast<int>(count));
    } else if (name == "widths" && type == "float[") {
      expect("=");
      for (double width : numbers()) usd.widths.push_back(static_cast<float>(width));
      expect("(");
      expect("interpolation");
      expect("=");
      usd.widthInterpolation = quoted();
      expect(")");
    } else if (name == "points.timeSamples" && type == "point3f[") {
      usd.points = samples();
    } else if (name == "extent.timeSamples" && type == "float3[") {
      usd.extent = samples();
    } else {
      fail("an attribute we know, not " + type + "] " + name);
    }
  }

  std::map<double, std::vector<Vec3f>> samples() {
    std::map<double, std::vector<Vec3f>> all;
    expect("=");
    expect("{");
    while (!accept("}")) {
      double key = number();
      if (!all.empty() && key <= all.rbegin()->first) fail("a later time code");
      expect(":");
      std::vector<Vec3f>& tuples = all[key];
      expect("[");
      while (!accept("]")) {
        Vec3f v;
        expect("(");
        v.x = static_cast<float>(number());
        expect(",");
        v.y = static_cast<float>(number());
        expect(",");
        v.z = static_cast<float>(number());
        expect(")");
        tuples.push_back(v);
        if (!accept(",") && peek() != ']') fail("a comma");
      }
      if (!accept(",") && peek() != '}') fail("a comma");
    }
    return all;
  }

  std::vector<double> numbers() {
    std::vector<double> all;
    expect("[");
    while (!accept("]")) {
      all.push_back(number());
      if (!accept(",") && peek() != ']') fail("a comma");
    }
    return all;
  }

  // Read as float first: nine digits stand for a float, not for the nearest double.
  double number() {
    skipSpace();
    char* end = nullptr;
    const char* begin = text_.c_str() + at_;
    double value = std::strtof(begin, &end);
    if (end == begin) fail("a number");
    at_ += end - begin;
    return value;
  }
  std::string quoted() {
    skipSpace();
    if (peek() != '"') fail("a quote");
    std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string::npos) fail("a closing quote");
    std::string found = text_.substr(at_, end + 1 - at_);
    at_ = end + 1;
    return found;
  }
  // Letters, digits and what stands in names and numbers; an array type's "[]" is read, and comes back as
  // "[".
  std::string word() {
    skipSpace();
    std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                  std::string("._:-+").find(text_[at_]) != std::string::npos))
      ++at_;
    std::string found = text_.substr(begin, at_ - begin);
    if (found.empty()) fail("a word");
    if (text_.compare(at_, 2, "[]") == 0) {
      at_ += 2;
      found += "[";
    }
    return found;
  }
  char peek() {
    skipSpace();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(const std::string& token) {
    skipSpace();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  void expect(const std::string& token) {
    if (!accept(token)) fail(token);
  }
  void skipSpace() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  [[noreturn]] void fail(const std::string& wanted) {
    throw std::runtime_error("byte " + std::to_string(at_) + ": expected " + wanted + ", found '" +
                             text_.substr(at_, 30) + "'");
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

UsdFile readUsd(const std::filesystem::path& path) { return StrictUsdReader(path).read(); }

}  // namespace ringlet::test
