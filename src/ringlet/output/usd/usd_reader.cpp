// Implements output/usd/usd_reader.h. The text's form is drawn in usd_writer.cpp.
#include "ringlet/output/usd/usd_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::size_t kReadBytes = 1 << 16;
constexpr std::size_t kLongestToken = 128;  // of what we write; more is not ours

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool isOfNumber(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

// The whole text as a finite number, or nothing.
template <class T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
    return std::nullopt;
  return value;
}

}  // namespace

Result<UsdReader> UsdReader::open(const std::filesystem::path& path) {
  auto reader = begin(path);
  if (!reader || !reader->isPartial_) return reader;
  if (Status counted = reader->countFrames(); !counted) return counted.error();
  return reader;
}

// How many are whole, by reading them all: what a file of a killed run states may be of another moment than
// its frames.
Status UsdReader::countFrames() {
  auto ahead = begin(path_);
  if (!ahead) return ahead.error();
  std::vector<Vec3f> points;
  auto more = ahead->readFrame(points);
  while (more && *more) more = ahead->readFrame(points);
  frameCount_ = ahead->framesRead_;
  isCounted_ = true;
  if (!more)
    warnings_.push_back(fmt::format("its end is torn and left out, after {} whole frames ({})", frameCount_,
                                    more.error().message));
  return {};
}

Result<UsdReader> UsdReader::begin(const std::filesystem::path& path) {
  UsdReader reader;
  reader.path_ = path;
  reader.isPartial_ = path.extension() == ".partial";
  auto opened = openToRead(path);
  if (!opened) return opened.error();
  reader.file_ = std::move(*opened);
  if (Status read = reader.readHeader(); !read) return read.error();
  return reader;
}

Status UsdReader::expectAll(std::initializer_list<std::string_view> tokens) {
  for (std::string_view token : tokens) {
    if (Status found = expect(token); !found) return found;
  }
  return {};
}

Status UsdReader::readHeader() {
  if (Status read = readMeasures(); !read) return read;

  // The strands.
  if (Status found = expectAll({")", "def", "BasisCurves", "\"Hair\""}); !found) return found;
  if (accept("(")) {
    return Error{
        fmt::format("{}: is in parts, which are not read together; name one of its clips, {}_clips/*.usdc",
                    path_.string(), path_.stem().string())};
  }
  if (Status found = expectAll({"{", "int[]", "curveVertexCounts", "=", "["}); !found) return found;
  if (Status read = readCounts(); !read) return read;
  if (Status read = readWidth(); !read) return read;

  // What may stand between, up to what moves.
  while (!accept("float3[] extent.timeSamples = {")) {
    if (accept("matrix4d xformOp:transform.timeSamples = {")) {
      if (Status read = readHeads(); !read) return read;
    } else if (Status skipped = skipAttribute(); !skipped) {
      return skipped;
    }
  }
  if (Status read = readExtents(); !read) return read;
  if (Status found = expectAll({"point3f[]", "points.timeSamples", "=", "{"}); !found) return found;
  return {};
}

// What the file is measured in.
Status UsdReader::readMeasures() {
  if (Status found = expectAll({"#usda", "1.0", "(", "defaultPrim", "=", "\"Hair\"", "endTimeCode", "="});
      !found)
    return found;
  auto frames = number();
  if (!frames) return frames.error();
  if (!(*frames >= 0 && *frames <= std::numeric_limits<int>::max())) return wanted("a number of frames");
  struct Entry {
    std::string_view key;
    double* value;
  };
  double firstTimeCode = 0;
  for (const Entry& entry : {Entry{"metersPerUnit", &metresPerUnit_}, Entry{"startTimeCode", &firstTimeCode},
                             Entry{"timeCodesPerSecond", &framesPerSecond_}}) {
    if (Status found = expect(entry.key); !found) return found;
    if (Status found = expect("="); !found) return found;
    auto value = number();
    if (!value) return value.error();
    if (!(*value > 0)) return wanted(fmt::format("{} above 0", entry.key));
    *entry.value = *value;
  }
  firstTimeCode_ = firstTimeCode;
  frameCount_ = static_cast<int>(std::clamp(*frames - firstTimeCode + 1, 0.0, 2e9));
  if (Status found = expectAll({"upAxis", "="}); !found) return found;
  if (accept("\"Z\"")) {
    up_ = UpAxis::z;
  } else if (Status found = expect("\"Y\""); !found) {
    return found;
  }
  return {};
}

// Of the particles of strands.
Status UsdReader::readCounts() {
  while (!accept("]")) {
    if (!particleCounts_.empty()) {
      if (Status found = expect(","); !found) return found;
    }
    auto count = number();
    if (!count) return count.error();
    if (!(*count >= 1 && *count <= 1e9) || *count != std::floor(*count)) return wanted("a particle count");
    particleCounts_.push_back(static_cast<std::uint32_t>(*count));
    particleCount_ += particleCounts_.back();
  }
  return {};
}

Status UsdReader::readWidth() {
  if (Status found =
          expectAll({"uniform", "token", "type", "=", "\"linear\"", "float[]", "widths", "=", "["});
      !found)
    return found;
  auto width = coordinate();
  if (!width) return width.error();
  if (!(*width > 0)) return wanted("a width above 0");
  diameter_ = *width;
  while (accept(",")) {
    if (auto other = coordinate(); !other) return other.error();
  }
  if (Status found = expectAll({"]", "(", "interpolation", "=", "\""}); !found) return found;
  if (!accept("constant\"") && !accept("uniform\"") && !accept("vertex\""))
    return wanted("'constant', 'uniform' or 'vertex'");
  if (Status found = expectAll({")", "uniform", "token", "wrap", "=", "\"nonperiodic\""}); !found)
    return found;
  return {};
}

// Of an attribute whose value is no number we need: "type name = value", and perhaps "( metadata )".
Status UsdReader::skipAttribute() {
  bool isValue = false;
  for (int depth = 0;; ++at_) {
    const char c = peek();
    if (c == '\0') return wanted("an attribute");
    if (c == '"') {
      for (++at_; peek() != '"'; ++at_) {
        if (peek() == '\\') ++at_;
        if (peek() == '\0') return wanted("'\"'");
      }
    }
    isValue |= c == '=';
    depth += (c == '[' || c == '(') - (c == ']' || c == ')');
    if (depth < 0 || c == '{' || c == '}') return wanted("an attribute");
    if (depth > 0 || c != '\n' || !isValue) continue;
    return {};
  }
}

// Of each frame where the head is: the rows of a matrix. The last may be of a frame that is not there.
Status UsdReader::readHeads() {
  while (!accept("}")) {
    auto timeCode = number();
    if (!timeCode) return timeCode.error();
    for (std::string_view token : {":", "("}) {
      if (Status found = expect(token); !found) return found;
    }
    Vec3d rows[4];
    for (int row = 0; row < 4; ++row) {
      double* const numbers[]{&rows[row].x, &rows[row].y, &rows[row].z, nullptr};
      for (int column = 0; column < 4; ++column) {
        if (Status found = expect(column == 0 ? "(" : ","); !found) return found;
        auto value = number();
        if (!value) return value.error();
        if (numbers[column]) *numbers[column] = *value;
      }
      if (Status found = expect(")"); !found) return found;
      if (row < 3) {
        if (Status found = expect(","); !found) return found;
      }
    }
    for (std::string_view token : {")", ","}) {
      if (Status found = expect(token); !found) return found;
    }
    heads_.push_back({{rows[0], rows[1], rows[2]}, rows[3]});
  }
  isHeadApart_ = true;
  return {};
}

// They are not needed, only read over. The last frame's may be there before its points are; of a killed run
// it may be torn.
Status UsdReader::readExtents() {
  if (isPartial_) {
    while (peek() != '}' && at_ < buffer_.size()) ++at_;
    return expect("}");
  }
  while (!accept("}")) {
    auto timeCode = number();
    if (!timeCode) return timeCode.error();
    for (std::string_view token : {":", "["}) {
      if (Status found = expect(token); !found) return found;
    }
    for (std::string_view token : {",", "]"}) {
      if (auto corner = readTuple(); !corner) return corner.error();
      if (Status found = expect(token); !found) return found;
    }
    if (Status found = expect(","); !found) return found;
  }
  return {};
}

Result<bool> UsdReader::readFrame(std::vector<Vec3f>& points) {
  if (isFinished_ || (isCounted_ && framesRead_ == frameCount_)) return false;
  if (accept("}")) {
    if (Status ended = readEnd(); !ended) return ended.error();
    isFinished_ = true;
    return false;
  }
  auto timeCode = number();
  if (!timeCode) return timeCode.error();
  if (*timeCode != firstTimeCode_ + framesRead_)
    return wanted(fmt::format("time code {}", firstTimeCode_ + framesRead_));
  for (std::string_view token : {":", "["}) {
    if (Status found = expect(token); !found) return found.error();
  }
  points.clear();
  while (points.size() < particleCount_) {
    auto point = readTuple();
    if (!point) return point.error();
    points.push_back(*point);
    if (Status found = expect(","); !found) return found.error();
  }
  for (std::string_view token : {"]", ","}) {
    if (Status found = expect(token); !found) return found.error();
  }
  if (isHeadApart_) {
    if (heads_.size() <= static_cast<std::size_t>(framesRead_))
      return wanted("a transform of the frame before");
    for (Vec3f& point : points) {
      point = Vec3f(heads_[static_cast<std::size_t>(framesRead_)](Vec3d(point)));
      if (!std::isfinite(point.x + point.y + point.z)) return wanted("a transform to finite points");
    }
  }
  ++framesRead_;
  return true;
}

// Behind the last frame: what closes all; of a `.partial` perhaps the frame that was being written, as a
// comment.
Status UsdReader::readEnd() {
  accept(";");
  if (Status found = expect("}"); !found) return found;
  skipSpace();
  if (isPartial_) return peek() == '#' || !fill() ? Status{} : wanted("the end of the file");
  if (fill()) return wanted("the end of the file");
  if (framesRead_ != frameCount_)
    return wanted(fmt::format("{} frames, as endTimeCode says, after {}", frameCount_, framesRead_));
  return {};
}

Result<Vec3f> UsdReader::readTuple() {
  float values[3]{};
  for (int axis = 0; axis < 3; ++axis) {
    if (Status found = expect(axis == 0 ? "(" : ","); !found) return found.error();
    auto value = coordinate();
    if (!value) return value.error();
    values[axis] = *value;
  }
  if (Status found = expect(")"); !found) return found.error();
  return Vec3f{values[0], values[1], values[2]};
}

// More text behind what is there; false at the end of the file.
bool UsdReader::fill() {
  if (buffer_.size() - at_ >= kLongestToken) return true;
  if (file_) {
    bufferStart_ += at_;
    buffer_.erase(0, at_);
    at_ = 0;
    const std::size_t before = buffer_.size();
    buffer_.resize(before + kReadBytes);
    buffer_.resize(before + std::fread(buffer_.data() + before, 1, kReadBytes, file_.get()));
    if (buffer_.size() == before) file_.reset();
  }
  return at_ < buffer_.size();
}

char UsdReader::peek() { return at_ < buffer_.size() || fill() ? buffer_[at_] : '\0'; }

void UsdReader::skipSpace() {
  while (isSpace(peek())) ++at_;
  fill();
}

bool UsdReader::accept(std::string_view token) {
  skipSpace();
  if (std::string_view(buffer_).substr(at_, token.size()) != token) return false;
  at_ += token.size();
  return true;
}

Status UsdReader::expect(std::string_view token) {
  if (!accept(token)) return wanted(fmt::format("'{}'", token));
  return {};
}

std::string UsdReader::word() {
  skipSpace();
  std::size_t end = at_;
  while (end < buffer_.size() && end - at_ < kLongestToken && isOfNumber(buffer_[end])) ++end;
  return buffer_.substr(at_, end - at_);
}

Result<double> UsdReader::number() {
  const std::string text = word();
  const std::optional<double> value = parse<double>(text);
  if (!value) return wanted("a number");
  at_ += text.size();
  return *value;
}

// Read as float at once: nine digits stand for a float, not for the nearest double.
Result<float> UsdReader::coordinate() {
  const std::string text = word();
  const std::optional<float> value = parse<float>(text);
  if (!value) return wanted("a finite number");
  at_ += text.size();
  return *value;
}

Error UsdReader::wanted(std::string_view what) {
  skipSpace();
  const std::string found =
      at_ < buffer_.size() ? quoted(std::string_view(buffer_).substr(at_, 33)) : "the end of the file";
  return Error{fmt::format(
      "{}: byte {}: expected {}, found {}; only animations that `ringlet simulate` wrote can be read",
      path_.string(), bufferStart_ + at_, what, found)};
}

}  // namespace ringlet
