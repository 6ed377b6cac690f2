// Implements groom/obj_file.h.
#include "ringlet/groom/obj_file.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/edge_chains.h"
#include "ringlet/groom/groom_check.h"
#include "ringlet/groom/obj_text.h"

namespace ringlet {
namespace {

// All that the OBJ specification names; only v and l matter to hair.
constexpr auto kOtherKeywords = std::to_array<std::string_view>(
    {"vt",     "vn",       "vp",       "f",      "p",          "o",         "g",     "s",     "mg",
     "usemtl", "mtllib",   "usemap",   "maplib", "cstype",     "deg",       "bmat",  "step",  "curv",
     "curv2",  "surf",     "parm",     "trim",   "hole",       "scrv",      "sp",    "end",   "con",
     "bevel",  "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech", "stech", "call",
     "csh",    "bsp",      "bzp",      "cdc",    "cdp",        "res"});

// An element of two or more points, as its line gives it: an edge to join, or a whole strand.
struct Polyline {
  std::size_t firstIndex = 0, indexCount = 0;  // into ObjContent::indices
  std::size_t line = 0;
};

struct ObjContent {
  std::vector<Vec3f> points;
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

Status readPoint(ObjText& text, ObjContent& content, const std::string& name) {
  std::array<float, 3> xyz{};
  for (float& value : xyz) {
    const std::size_t line = text.line();
    const std::string_view word = text.nextWord();
    const std::optional<float> number = parseObjNumber(word);
    if (!number) return wrong(name, line, shown(word), "three finite numbers after 'v'");
    value = *number;
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

}  // namespace

Result<LoadedGroom> readObj(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  Result<ObjContent> content =
      readContent(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name);
  if (!content) return content.error();
  if (content->polylines.empty()) {
    return Error{fmt::format(
        "{}: found {} points ('v'), {} faces ('f') and no polylines; expected lines like 'l 1 2 3', one per "
        "strand",
        name, content->points.size(), content->faces)};
  }

  // Lines of two indices are edges to be joined, longer ones strands.
  std::vector<FoundStrand> strands;
  std::vector<ListedEdge> edges;
  std::size_t pointUses = 0;
  for (const Polyline& polyline : content->polylines) {
    const auto indices =
        std::span<const std::uint32_t>(content->indices).subspan(polyline.firstIndex, polyline.indexCount);
    for (std::uint32_t index : indices) {
      if (index >= content->points.size()) {
        return wrong(name, polyline.line, fmt::format("index {}", std::uint64_t{index} + 1),
                     fmt::format("at most {}, the number of points", content->points.size()));
      }
    }
    pointUses += indices.size();
    if (indices.size() == 2) {
      edges.push_back({indices.front(), indices.back(), polyline.line});
    } else if (indices.front() == indices.back()) {
      return wrong(name, polyline.line,
                   fmt::format("a closed loop: point {} at both ends", indices.front() + 1),
                   "a strand with a root and a tip");
    } else {
      strands.push_back({indices, polyline.line});
    }
  }
  if (pointUses > std::numeric_limits<std::uint32_t>::max()) {
    return Error{
        fmt::format("{}: its strands have {} particles; at most 2^32 - 1 can be read", name, pointUses)};
  }
  const Result<std::vector<EdgeChain>> chains = joinEdges(edges, content->points.size(), name);
  if (!chains) return chains.error();
  for (const EdgeChain& chain : *chains) strands.push_back({chain.points, chain.firstLine});
  std::ranges::sort(strands, {}, &FoundStrand::line);

  LoadedGroom loaded;
  loaded.groom.points.reserve(pointUses);
  loaded.groom.firstPoint.reserve(strands.size() + 1);
  for (const FoundStrand& strand : strands) {
    for (std::uint32_t index : strand.indices) loaded.groom.points.push_back(content->points[index]);
    loaded.groom.firstPoint.push_back(static_cast<std::uint32_t>(loaded.groom.points.size()));
  }

  if (content->onePointLines > 0) {
    loaded.warnings.push_back(fmt::format("{}: left out {} 'l' lines of one point; a strand needs two", name,
                                          content->onePointLines));
  }
  const auto mixed = std::ranges::count(*chains, false, &EdgeChain::isOneDirection);
  if (mixed > 0) {
    loaded.warnings.push_back(fmt::format(
        "{}: {} strands are joined from edges of both directions; their root is taken to be where "
        "most edges begin",
        name, mixed));
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
