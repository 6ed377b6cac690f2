// Implements groom/ply_file.h.
//
//   ply
//   format binary_little_endian 1.0          or ascii
//   comment ...
//   element vertex 1200
//   property float x                         and y, z, others
//   element strand 12
//   property ushort nsegs
//   element edge 1188
//   property int vertex1                     and vertex2
//   end_header
//   all of the first element, then of the next
#include "ringlet/groom/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/edge_chains.h"
#include "ringlet/groom/groom_check.h"
#include "ringlet/groom/left_out.h"
#include "ringlet/groom/strands_of_points.h"

namespace ringlet {
namespace {

enum class Kind : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct KindName {
  std::string_view name;
  Kind kind;
};
constexpr std::array<KindName, 16> kKinds{{{"char", Kind::i8},
                                           {"int8", Kind::i8},
                                           {"uchar", Kind::u8},
                                           {"uint8", Kind::u8},
                                           {"short", Kind::i16},
                                           {"int16", Kind::i16},
                                           {"ushort", Kind::u16},
                                           {"uint16", Kind::u16},
                                           {"int", Kind::i32},
                                           {"int32", Kind::i32},
                                           {"uint", Kind::u32},
                                           {"uint32", Kind::u32},
                                           {"float", Kind::f32},
                                           {"float32", Kind::f32},
                                           {"double", Kind::f64},
                                           {"float64", Kind::f64}}};
constexpr std::size_t kMostProperties = 256;  // of all elements
constexpr float kNoPlace = std::numeric_limits<float>::quiet_NaN();

std::optional<Kind> kindOf(std::string_view name) {
  const auto* found = std::ranges::find(kKinds, name, &KindName::name);
  if (found == kKinds.end()) return std::nullopt;
  return found->kind;
}

std::size_t sizeOf(Kind kind) {
  switch (kind) {
    case Kind::i8:
    case Kind::u8:
      return 1;
    case Kind::i16:
    case Kind::u16:
      return 2;
    case Kind::f64:
      return 8;
    default:
      return 4;
  }
}

struct Property {
  std::string_view name;
  Kind kind = Kind::f32;
  std::optional<Kind> listCount;  // of a list: what its length is stored as
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  // Which of its properties has this name.
  std::optional<std::size_t> indexOf(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &Property::name);
    if (found == properties.end() || found->listCount) return std::nullopt;
    return static_cast<std::size_t>(found - properties.begin());
  }
};

class PlyReader {
 public:
  PlyReader(std::span<const std::byte> bytes, const std::string& name, const GroomReading& reading)
      : bytes_(bytes),
        text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        name_(name),
        reading_(reading) {}

  Result<LoadedGroom> read() {
    if (Status read = readHeader(); !read) return read.error();
    for (const Element& element : elements_) {
      if (Status read = readElement(element); !read) return read.error();
    }
    if (points_.empty())
      return Error{fmt::format("{}: found no points; expected an element `vertex`", name_)};
    if (points_.size() > std::numeric_limits<std::uint32_t>::max())
      return Error{fmt::format("{}: has {} points; at most 2^32 - 1 can be read", name_, points_.size())};
    if (hasStrands_) return strandsByCount();
    if (!edges_.empty()) return strandsByEdge();
    if (faceCount_ == 0 && reading_.pointsPerStrand > 0) {
      if (notFinite_.count > 0) return Error{fmt::format("{}: {}", name_, notFinite_.first)};
      return strandsOfPoints(points_, reading_.pointsPerStrand, name_);
    }
    const std::string found = fmt::format(
        "{}: found {} points and neither an element `strand` nor `edge`; expected one of them, which says "
        "where strands end",
        name_, points_.size());
    if (faceCount_ > 0) return Error{fmt::format("{}; its {} faces make it a mesh", found, faceCount_)};
    return Error{fmt::format("{}; {}", found, kSayPointsPerStrand)};
  }

 private:
  // --- The header.

  std::string_view takeLine() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  static std::string_view takeWord(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
  }
  Error wrongLine(std::string_view found, std::string_view expected) const {
    return Error{fmt::format("{}: line {}: found {}; expected {}", name_, line_, quoted(found), expected)};
  }

  Status readHeader() {
    if (takeLine() != "ply") return wrongLine(text_.substr(0, 4), "'ply'");
    bool hasFormat = false;
    while (at_ < text_.size()) {
      const std::string_view line = takeLine();
      std::string_view rest = line;
      const std::string_view word = takeWord(rest);
      if (word == "end_header") {
        if (!hasFormat) return wrongLine(line, "a line `format` before it");
        return {};
      }
      if (word == "format") {
        const std::string_view format = takeWord(rest);
        if (format != "ascii" && format != "binary_little_endian")
          return wrongLine(line, "format ascii or binary_little_endian");
        isText_ = format == "ascii";
        hasFormat = true;
      } else if (word == "element") {
        Element element{takeWord(rest), 0, {}};
        const std::string_view count = takeWord(rest);
        const auto [end, code] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (element.name.empty() || code != std::errc() || end != count.data() + count.size())
          return wrongLine(line, "element, its name and how many");
        elements_.push_back(std::move(element));
      } else if (word == "property") {
        if (Status read = readProperty(line, rest); !read) return read;
      } else if (word != "comment" && word != "obj_info" && !word.empty()) {
        return wrongLine(line, "format, element, property, comment or end_header");
      }
    }
    return Error{fmt::format("{}: line {}: the file ends here; expected 'end_header'", name_, line_)};
  }

  Status readProperty(std::string_view line, std::string_view rest) {
    Property property;
    std::string_view word = takeWord(rest);
    if (word == "list") {
      property.listCount = kindOf(takeWord(rest));
      if (!property.listCount || *property.listCount >= Kind::f32)
        return wrongLine(line, "a whole number's type");
      word = takeWord(rest);
    }
    const auto kind = kindOf(word);
    property.name = takeWord(rest);
    if (!kind || property.name.empty()) return wrongLine(line, "property, its type and its name");
    if (elements_.empty()) return wrongLine(line, "an element before its properties");
    if (++propertyCount_ > kMostProperties)
      return wrongLine(line, fmt::format("at most {} properties", kMostProperties));
    property.kind = *kind;
    elements_.back().properties.push_back(property);
    return {};
  }

  // --- What follows it.

  Error ended() const {
    return Error{
        fmt::format("{}: at byte {}: the file ends here, within what its header names", name_, text_.size())};
  }
  Error wrongValue(const Element& element, std::uint64_t index, const std::string& found,
                   std::string_view expected) const {
    return Error{
        fmt::format("{}: {} {}: found {}; expected {}", name_, element.name, index, found, expected)};
  }

  // The next value, as text or as so many bytes; nothing at the file's end, or where a word is no number.
  std::optional<double> takeValue(Kind kind) {
    if (isText_) {
      at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
      std::string_view word = text_.substr(at_, text_.find_first_of(" \t\r\n", at_) - at_);
      at_ += word.size();
      if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
      double value = 0;
      const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
      const bool isTiny = code == std::errc::result_out_of_range && word.find_first_of("eE") != word.npos &&
                          word.find('-', word.find_first_of("eE")) != word.npos;
      if (word.empty() || (code != std::errc() && !isTiny) || end != word.data() + word.size())
        return std::nullopt;
      return value;
    }
    const std::size_t size = sizeOf(kind);
    if (size > bytes_.size() - at_) return std::nullopt;
    at_ += size;
    const std::size_t at = at_ - size;
    switch (kind) {
      case Kind::i8:
        return static_cast<double>(std::to_integer<std::int8_t>(bytes_[at]));
      case Kind::u8:
        return static_cast<double>(std::to_integer<std::uint8_t>(bytes_[at]));
      case Kind::i16:
        return static_cast<double>(static_cast<std::int16_t>(readU16(bytes_, at)));
      case Kind::u16:
        return static_cast<double>(readU16(bytes_, at));
      case Kind::i32:
        return static_cast<double>(static_cast<std::int32_t>(readU32(bytes_, at)));
      case Kind::u32:
        return static_cast<double>(readU32(bytes_, at));
      case Kind::f32:
        return static_cast<double>(readF32(bytes_, at));
      case Kind::f64:
        return readF64(bytes_, at);
    }
    return std::nullopt;
  }

  // Each has one byte at least: no count can make us take more memory than the file has.
  Status readElement(const Element& element) {
    if (element.properties.empty() || element.count > text_.size() - at_) {
      if (element.count == 0) return {};
      return Error{fmt::format("{}: at byte {}: the file ends at byte {}; expected {} of {}", name_, at_,
                               text_.size(), element.count, quoted(element.name))};
    }
    using Take = Status (PlyReader::*)(const Element&, std::uint64_t, std::span<const double>);
    Take take = nullptr;
    std::vector<std::size_t> wanted;
    const auto want = [&](Take by, std::initializer_list<std::string_view> names) -> Status {
      take = by;
      for (const std::string_view name : names) {
        const auto index = element.indexOf(name);
        if (!index)
          return Error{
              fmt::format("{}: its element {} has no property {}", name_, quoted(element.name), name)};
        wanted.push_back(*index);
      }
      return {};
    };
    Status found;
    if (element.name == "vertex") found = want(&PlyReader::addPoint, {"x", "y", "z"});
    if (element.name == "strand") {
      hasStrands_ = true;
      found = want(&PlyReader::addStrand, {"nsegs"});
    }
    if (element.name == "edge" && !hasStrands_) found = want(&PlyReader::addEdge, {"vertex1", "vertex2"});
    if (element.name == "face") faceCount_ = element.count;
    if (!found) return found;

    std::vector<double> values(element.properties.size()), chosen(wanted.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < values.size(); ++p) {
        const Property& property = element.properties[p];
        const auto value = takeValue(property.listCount.value_or(property.kind));
        if (!value) return noValue(element, i);
        values[p] = *value;
        if (!property.listCount) continue;
        if (!(*value >= 0 && *value <= static_cast<double>(text_.size() - at_))) return ended();
        for (auto left = static_cast<std::size_t>(std::ceil(*value)); left > 0; --left) {
          if (!takeValue(property.kind)) return noValue(element, i);
        }
      }
      for (std::size_t w = 0; w < wanted.size(); ++w) chosen[w] = values[wanted[w]];
      if (!take) continue;
      if (Status taken = (this->*take)(element, i, chosen); !taken) return taken;
    }
    return {};
  }
  Error noValue(const Element& element, std::uint64_t index) const {
    if (!isText_ || at_ >= text_.size()) return ended();
    return wrongValue(element, index, "no number before byte " + std::to_string(at_), "one");
  }

  Status addPoint(const Element& element, std::uint64_t index, std::span<const double> v) {
    constexpr double kMost = std::numeric_limits<float>::max();
    for (const double value : v) {
      if (std::abs(value) <= kMost) continue;
      notFinite_.add(fmt::format("{} {}: found ({}, {}, {}); expected finite numbers", element.name, index,
                                 v[0], v[1], v[2]));
      points_.push_back({kNoPlace, kNoPlace, kNoPlace});
      return {};
    }
    points_.push_back(Vec3f(Vec3d{v[0], v[1], v[2]}));
    return {};
  }
  static bool isFinite(Vec3f p) { return std::isfinite(p.x); }
  Status addStrand(const Element& element, std::uint64_t index, std::span<const double> v) {
    if (!(v[0] >= 0 && v[0] < 4294967295.0) || v[0] != std::floor(v[0]))
      return wrongValue(element, index, fmt::format("nsegs {}", v[0]), "a count of edges");
    edgeCounts_.push_back(static_cast<std::uint32_t>(v[0]));
    return {};
  }
  Status addEdge(const Element& element, std::uint64_t index, std::span<const double> v) {
    for (const double end : v) {
      if (!(end >= 0 && end < 4294967295.0) || end != std::floor(end))
        return wrongValue(element, index, fmt::format("point {}", end), "a point's number, from 0");
    }
    edges_.push_back({static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]),
                      static_cast<std::size_t>(index + 1)});
    return {};
  }

  Result<LoadedGroom> strandsByCount() {
    LoadedGroom loaded;
    std::uint64_t sum = 0;
    for (const std::uint32_t count : edgeCounts_) sum += std::uint64_t{count} + 1;
    if (sum > points_.size()) {
      return Error{
          fmt::format("{}: its {} strands have {} points by their nsegs, and it has {}; expected as many",
                      name_, edgeCounts_.size(), sum, points_.size())};
    }
    std::size_t first = 0, tooShort = 0, bad = 0;
    for (const std::uint32_t count : edgeCounts_) {
      const auto strand = std::span<const Vec3f>(points_).subspan(first, std::size_t{count} + 1);
      first += strand.size();
      if (strand.size() < 2) {
        ++tooShort;
      } else if (!std::ranges::all_of(strand, isFinite)) {
        ++bad;
      } else {
        loaded.groom.addStrand(strand);
      }
    }
    if (loaded.groom.strandCount() == 0 && bad > 0)
      return Error{fmt::format("{}: {}", name_, notFinite_.first)};
    if (loaded.groom.strandCount() == 0) {
      return Error{fmt::format("{}: none of the {} strands has two points; a strand needs two", name_,
                               edgeCounts_.size())};
    }
    if (bad > 0)
      loaded.warnings.push_back(LeftOutStrands{bad, notFinite_.first}.warning(name_, edgeCounts_.size()));
    if (tooShort > 0) {
      loaded.warnings.push_back(
          fmt::format("{}: left out {} of {} strands, which have one point; a strand needs two", name_,
                      tooShort, edgeCounts_.size()));
    }
    if (sum < points_.size()) {
      loaded.warnings.push_back(fmt::format("{}: the last {} of {} points are of no strand", name_,
                                            points_.size() - sum, points_.size()));
    }
    return loaded;
  }

  Result<LoadedGroom> strandsByEdge() {
    std::vector<bool> isUsed(points_.size(), false);
    for (const ListedEdge& edge : edges_) {
      for (const std::uint32_t end : {edge.from, edge.to}) {
        if (end >= points_.size()) {
          return Error{fmt::format("{}: edge {}: found point {}; expected one of {}, from 0", name_,
                                   edge.line - 1, end, points_.size())};
        }
        isUsed[end] = true;
      }
    }
    const JoinedEdges joined = joinEdges(edges_, points_.size());
    const std::string edges = name_ + ": its edges, one a line";
    LoadedGroom loaded;
    std::size_t bad = 0;
    for (const EdgeChain& chain : joined.chains) {
      if (!std::ranges::all_of(chain.points, [&](std::uint32_t point) { return isFinite(points_[point]); })) {
        ++bad;
        continue;
      }
      for (const std::uint32_t point : chain.points) loaded.groom.points.push_back(points_[point]);
      loaded.groom.firstPoint.push_back(static_cast<std::uint32_t>(loaded.groom.points.size()));
    }
    if (loaded.groom.strandCount() == 0) {
      return Error{bad > 0 ? fmt::format("{}: {}", name_, notFinite_.first)
                           : fmt::format("{}: {}", edges, joined.leftOut.first)};
    }
    const std::size_t all = joined.chains.size() + joined.leftOut.count;
    if (joined.leftOut.count > 0) loaded.warnings.push_back(joined.leftOut.warning(edges, all));
    if (bad > 0) loaded.warnings.push_back(LeftOutStrands{bad, notFinite_.first}.warning(name_, all));
    if (const auto alone = std::ranges::count(isUsed, false); alone > 0) {
      loaded.warnings.push_back(
          fmt::format("{}: {} of {} points are of no strand", name_, alone, points_.size()));
    }
    return loaded;
  }

  std::span<const std::byte> bytes_;
  std::string_view text_;  // the same
  const std::string& name_;
  const GroomReading& reading_;
  std::uint64_t faceCount_ = 0;
  LeftOutStrands notFinite_;  // points of this kind, which are kNoPlace
  std::size_t at_ = 0, line_ = 0, propertyCount_ = 0;
  bool isText_ = true, hasStrands_ = false;
  std::vector<Element> elements_;
  std::vector<Vec3f> points_;
  std::vector<std::uint32_t> edgeCounts_;  // of each strand
  std::vector<ListedEdge> edges_;
};

}  // namespace

Result<LoadedGroom> readPly(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading) {
  const std::string name = path.string();
  return PlyReader(bytes, name, reading).read();
}

Status writePly(const std::filesystem::path& path, const Groom& topology, std::span<const Vec3f> points) {
  RINGLET_ASSERT(points.size() == topology.points.size(), "writePly needs as many points as the groom has");
  if (Status status = checkGroom(topology, points, path); !status) return status;
  std::uint32_t mostEdges = 0;
  for (std::size_t s = 0; s < topology.strandCount(); ++s)
    mostEdges = std::max(mostEdges, topology.firstPoint[s + 1] - topology.firstPoint[s] - 1);
  const bool isShort = mostEdges <= std::numeric_limits<std::uint16_t>::max();
  const std::string head = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by Ringlet\nelement vertex {}\nproperty float "
      "x\nproperty float y\nproperty float z\nelement strand {}\nproperty {} nsegs\nend_header\n",
      points.size(), topology.strandCount(), isShort ? "ushort" : "uint");
  std::vector<std::byte> bytes;
  bytes.reserve(head.size() + 12 * points.size() + 4 * topology.strandCount());
  for (const char c : head) bytes.push_back(static_cast<std::byte>(c));
  for (const Vec3f p : points) {
    for (const float number : {p.x, p.y, p.z}) appendF32(bytes, number);
  }
  for (std::size_t s = 0; s < topology.strandCount(); ++s) {
    appendU32(bytes, topology.firstPoint[s + 1] - topology.firstPoint[s] - 1);
    if (isShort) bytes.resize(bytes.size() - 2);
  }
  return writeWholeFile(path, bytes);
}

}  // namespace ringlet
