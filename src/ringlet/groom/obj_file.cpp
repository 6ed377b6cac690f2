// Implements groom/obj_file.h.
#include "ringlet/groom/obj_file.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/edge_chains.h"
#include "ringlet/groom/groom_check.h"
#include "ringlet/groom/left_out.h"
#include "ringlet/groom/obj_text.h"
#include "ringlet/groom/strands_of_points.h"

namespace ringlet {
namespace {

// All that the OBJ specification names; only v and l matter to hair.
constexpr auto kOtherKeywords = std::to_array<std::string_view>(
    {"vt",     "vn",       "vp",       "f",      "p",          "o",         "g",     "s",     "mg",
     "usemtl", "mtllib",   "usemap",   "maplib", "cstype",     "deg",       "bmat",  "step",  "curv",
     "curv2",  "surf",     "parm",     "trim",   "hole",       "scrv",      "sp",    "end",   "con",
     "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech", "stech", "call",
     "csh",    "bsp",      "bzp",      "cdc",    "cdp",        "res"});

constexpr const char* kThreeNumbers = "three finite numbers after 'v'";

// An element of two or more points, as its line gives it: an edge to join, or a whole strand.
struct Polyline {
  std::size_t firstIndex = 0, indexCount = 0;  // into ObjContent::indices
  std::size_t line = 0;
};

// A point that is not finite.
struct BadPoint {
  std::size_t index = 0, line = 0;
  std::string_view word;  // of the file's text

  std::string text() const {
    return fmt::format("line {}: found {}; expected {}", line, quoted(word), kThreeNumbers);
  }
};

struct ObjContent {
  std::vector<Vec3f> points;
  std::vector<BadPoint> badPoints;     // by rising index
  std::vector<std::uint32_t> indices;  // from 0
  std::vector<Polyline> polylines;
  std::size_t onePointLines = 0, faces = 0;
  std::size_t unknownLines = 0, firstUnknownLine = 0;
  std::string firstUnknown;
};

Error wrong(const std::string& name, std::size_t line, std::string_view found, std::string_view expected) {
  return {fmt::format("{}: line {}: found {}; expected {}", name, line, found, expected)};
}

std::string shown(std::string_view word) { return word.empty() ? "the end of the line" : quoted(word); }

// "nan", "-inf", "1e99": what programs write for what is no place.
bool isNotFinite(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return !word.empty() && end == word.data() + word.size() &&
         (code == std::errc::result_out_of_range || (code == std::errc() && !std::isfinite(value)));
}

Status readPoint(ObjText& text, ObjContent& content, const std::string& name) {
  std::array<float, 3> xyz{};
  for (float& value : xyz) {
    const std::size_t line = text.line();
    const std::string_view word = text.nextWord();
    const std::optional<float> number = parseObjNumber(word);
    if (!number && !isNotFinite(word)) return wrong(name, line, shown(word), kThreeNumbers);
    if (!number && (content.badPoints.empty() || content.badPoints.back().index != content.points.size()))
      content.badPoints.push_back({content.points.size(), line, word});
    value = number.value_or(0);
  }
  if (content.points.size() == std::numeric_limits<std::uint32_t>::max()) {
    return wrong(name, text.line(), "one point too many", "fewer than 2^32 points");
  }
  content.points.push_back({xyz[0], xyz[1], xyz[2]});
  return {};
}

// Indices may name points that come later in the file, so the upper bound is checked at the end. Negative
// ones count back from the points read so far.
Status readPolyline(ObjText& text, ObjContent& content, const std::string& name) {
  Polyline polyline{content.indices.size(), 0, text.line()};
  for (std::string_view word = text.nextWord(); !word.empty(); word = text.nextWord()) {
    const std::optional<std::int64_t> index = parseObjIndex(word);
    if (!index || *index == 0) {
      return wrong(name, text.line(), quoted(word), "a point's index: counted from 1, or from -1 back");
    }
    const auto known = static_cast<std::int64_t>(content.points.size());
    const std::int64_t point = *index > 0 ? *index - 1 : known + *index;
    if (point < 0) {
      return wrong(name, text.line(), quoted(word),
                   fmt::format("an index of the {} points above this line", known));
    }
    if (point >= std::numeric_limits<std::uint32_t>::max()) {
      return wrong(name, text.line(), quoted(word), "an index below 2^32");
    }
    content.indices.push_back(static_cast<std::uint32_t>(point));
  }
  polyline.indexCount = content.indices.size() - polyline.firstIndex;
  if (polyline.indexCount == 0) return wrong(name, polyline.line, "'l' without indices", "at least two");
  if (polyline.indexCount == 1) {
    content.indices.pop_back();
    ++content.onePointLines;
    return {};
  }
  content.polylines.push_back(polyline);
  return {};
}

Result<ObjContent> readContent(std::string_view bytes, const std::string& name) {
  ObjContent content;
  for (ObjText text(bytes); !text.isAtEnd(); text.nextLine()) {
    const std::string_view keyword = text.nextWord();
    const std::size_t line = text.line();
    if (keyword == "v") {
      if (Status status = readPoint(text, content, name); !status) return status.error();
    } else if (keyword == "l") {
      if (Status status = readPolyline(text, content, name); !status) return status.error();
    } else if (keyword == "f") {
      ++content.faces;
    } else if (!keyword.empty() && std::ranges::find(kOtherKeywords, keyword) == kOtherKeywords.end()) {
      if (content.unknownLines++ == 0) {
        content.firstUnknownLine = line;
        content.firstUnknown = quoted(keyword);
      }
    }
  }
  return content;
}

// A strand to be, with the line that decides its place among the others.
struct FoundStrand {
  std::span<const std::uint32_t> indices;
  std::size_t line;
};

struct FoundStrands {
  std::vector<EdgeChain> chains;  // into which some of the strands are views
  std::vector<FoundStrand> good;
  LeftOutStrands leftOut;
  std::size_t mixedCount = 0;  // joined from edges of both directions
};

// Lines of two indices are edges to be joined, longer ones strands.
Result<FoundStrands> strandsOf(const ObjContent& content, const std::string& name) {
  FoundStrands found;
  std::vector<ListedEdge> edges;
  std::size_t pointUses = 0;
  for (const Polyline& polyline : content.polylines) {
    const auto indices =
        std::span<const std::uint32_t>(content.indices).subspan(polyline.firstIndex, polyline.indexCount);
    for (std::uint32_t index : indices) {
      if (index >= content.points.size()) {
        return wrong(name, polyline.line, fmt::format("index {}", std::uint64_t{index} + 1),
                     fmt::format("at most {}, the number of points", content.points.size()));
      }
    }
    pointUses += indices.size();
    if (indices.size() == 2) {
      edges.push_back({indices.front(), indices.back(), polyline.line});
    } else if (indices.front() == indices.back()) {
      found.leftOut.add(fmt::format(
          "line {}: found a closed loop: point {} at both ends; expected a strand with a root and a tip",
          polyline.line, indices.front() + 1));
    } else {
      found.good.push_back({indices, polyline.line});
    }
  }
  if (pointUses > std::numeric_limits<std::uint32_t>::max()) {
    return Error{
        fmt::format("{}: its strands have {} particles; at most 2^32 - 1 can be read", name, pointUses)};
  }
  JoinedEdges joined = joinEdges(edges, content.points.size());
  if (found.leftOut.count == 0) found.leftOut.first = joined.leftOut.first;
  found.leftOut.count += joined.leftOut.count;
  found.chains = std::move(joined.chains);
  for (const EdgeChain& chain : found.chains) found.good.push_back({chain.points, chain.firstLine});
  std::ranges::sort(found.good, {}, &FoundStrand::line);
  found.mixedCount =
      static_cast<std::size_t>(std::ranges::count(found.chains, false, &EdgeChain::isOneDirection));
  return found;
}

// One of its points that is not finite.
const BadPoint* badPointOf(const ObjContent& content, const FoundStrand& strand) {
  if (content.badPoints.empty()) return nullptr;
  for (const std::uint32_t index : strand.indices) {
    const auto bad = std::ranges::lower_bound(content.badPoints, std::size_t{index}, {}, &BadPoint::index);
    if (bad != content.badPoints.end() && bad->index == index) return &*bad;
  }
  return nullptr;
}

Result<LoadedGroom> withoutPolylines(const ObjContent& content, const std::string& name,
                                     const GroomReading& reading) {
  if (content.onePointLines > 0) {
    return Error{
        fmt::format("{}: found {} points ('v') and {} lines ('l') of one point each; a strand needs two",
                    name, content.points.size(), content.onePointLines)};
  }
  const std::string found = fmt::format(
      "{}: found {} points ('v'), {} faces ('f') and no polylines; expected lines like 'l 1 2 3', one per "
      "strand",
      name, content.points.size(), content.faces);
  if (content.faces > 0 || content.points.empty()) return Error{found};
  if (reading.pointsPerStrand == 0) return Error{fmt::format("{}; {}", found, kSayPointsPerStrand)};
  if (!content.badPoints.empty()) return Error{fmt::format("{}: {}", name, content.badPoints.front().text())};
  return strandsOfPoints(content.points, reading.pointsPerStrand, name);
}

}  // namespace

Result<LoadedGroom> readObj(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading) {
  const std::string name = path.string();
  Result<ObjContent> content =
      readContent(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name);
  if (!content) return content.error();
  if (content->polylines.empty()) return withoutPolylines(*content, name, reading);
  auto strands = strandsOf(*content, name);
  if (!strands) return strands.error();
  LoadedGroom loaded;
  const std::size_t all = strands->good.size() + strands->leftOut.count;
  LeftOutStrands leftOut = strands->leftOut;
  loaded.groom.points.reserve(content->indices.size());
  loaded.groom.firstPoint.reserve(strands->good.size() + 1);
  for (const FoundStrand& strand : strands->good) {
    if (const BadPoint* bad = badPointOf(*content, strand)) {
      leftOut.add(bad->text());
      continue;
    }
    for (std::uint32_t index : strand.indices) loaded.groom.points.push_back(content->points[index]);
    loaded.groom.firstPoint.push_back(static_cast<std::uint32_t>(loaded.groom.points.size()));
  }
  if (loaded.groom.strandCount() == 0) return Error{fmt::format("{}: {}", name, leftOut.first)};

  if (leftOut.count > 0) loaded.warnings.push_back(leftOut.warning(name, all));
  if (content->onePointLines > 0) {
    loaded.warnings.push_back(fmt::format("{}: left out {} 'l' lines of one point; a strand needs two", name,
                                          content->onePointLines));
  }
  if (strands->mixedCount > 0) {
    loaded.warnings.push_back(fmt::format(
        "{}: {} strands are joined from edges of both directions; their root is taken to be where most edges "
        "begin",
        name, strands->mixedCount));
  }
  if (content->unknownLines > 0) {
    loaded.warnings.push_back(
        fmt::format("{}: line {}: {} is no OBJ keyword; ignored, as {} such lines in all", name,
                    content->firstUnknownLine, content->firstUnknown, content->unknownLines));
  }
  return loaded;
}

Status writeObj(const std::filesystem::path& path, const Groom& groom) {
  return writeObj(path, groom, groom.points);
}

Status writeObj(const std::filesystem::path& path, const Groom& topology, std::span<const Vec3f> points,
                ObjLines lines) {
  RINGLET_ASSERT(points.size() == topology.points.size(), "writeObj needs as many points as the groom has");
  if (Status status = checkGroom(topology, points, path); !status) return status;
  std::string text =
      fmt::format("# Written by Ringlet: {} strands, {} particles\n", topology.strandCount(), points.size());
  auto out = std::back_inserter(text);
  // The fewest digits that give back the same float.
  for (Vec3f p : points) fmt::format_to(out, FMT_COMPILE("v {} {} {}\n"), p.x, p.y, p.z);
  for (std::size_t s = 0; s < topology.strandCount(); ++s) {
    const std::size_t first = topology.firstPoint[s] + 1, last = topology.firstPoint[s + 1];
    text += fmt::format("l {}", first);
    for (std::size_t i = first + 1; i <= last; ++i) {
      fmt::format_to(out, FMT_COMPILE(" {}"), i);
      if (lines == ObjLines::edges && i < last) fmt::format_to(out, "\nl {}", i);
    }
    text += '\n';
  }
  return writeWholeFile(path, std::as_bytes(std::span(text)));
}

}  // namespace ringlet
