// Implements bodies/mesh_file.h.
#include "ringlet/bodies/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/obj_text.h"

namespace ringlet {
namespace {

struct Content {
  TriangleMesh mesh;
  std::vector<std::size_t> lines;  // of each triangle
  std::size_t polylines = 0;
};

Error wrong(const std::string& name, std::size_t line, std::string_view found, std::string_view expected) {
  return {fmt::format("{}: line {}: found {}; expected {}", name, line, found, expected)};
}

Status readPoint(ObjText& text, Content& content, double metresPerUnit, const std::string& name) {
  std::array<double, 3> xyz{};
  for (double& value : xyz) {
    const std::size_t line = text.line();
    const std::string_view word = text.nextWord();
    const std::optional<float> number = parseObjNumber(word);
    if (!number) {
      return wrong(name, line, word.empty() ? "the end of the line" : quoted(word),
                   "three finite numbers after 'v'");
    }
    value = double{*number} * metresPerUnit;
  }
  if (content.mesh.points.size() == std::numeric_limits<std::uint32_t>::max())
    return wrong(name, text.line(), "one point too many", "fewer than 2^32 points");
  content.mesh.points.push_back({xyz[0], xyz[1], xyz[2]});
  return {};
}

// Indices may name points that come later in the file, so the upper bound is checked at the end.
Status readFace(ObjText& text, Content& content, const std::string& name) {
  const std::size_t line = text.line();
  std::array<std::uint32_t, 3> triangle{};  // the fan's first point, the last but one and the last
  std::size_t count = 0;
  for (std::string_view word = text.nextWord(); !word.empty(); word = text.nextWord()) {
    const std::optional<std::int64_t> index = parseObjIndex(word);
    if (!index || *index == 0)
      return wrong(name, text.line(), quoted(word), "a point's index: counted from 1, or from -1 back");
    const auto known = static_cast<std::int64_t>(content.mesh.points.size());
    const std::int64_t point = *index > 0 ? *index - 1 : known + *index;
    if (point < 0) {
      return wrong(name, text.line(), quoted(word),
                   fmt::format("an index of the {} points above this line", known));
    }
    if (point >= std::numeric_limits<std::uint32_t>::max())
      return wrong(name, text.line(), quoted(word), "an index below 2^32");
    triangle[count < 2 ? count : 2] = static_cast<std::uint32_t>(point);
    if (++count < 3) continue;
    content.mesh.triangles.push_back(triangle);
    content.lines.push_back(line);
    triangle[1] = triangle[2];
  }
  if (count < 3) {
    return wrong(name, line, fmt::format("'f' with {} indices", count),
                 "at least three, the corners of a polygon");
  }
  return {};
}

// Whether three corners are at three places.
bool hasArea(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3d a = mesh.points[triangle[0]], b = mesh.points[triangle[1]], c = mesh.points[triangle[2]];
  return a != b && b != c && c != a;
}

// Of all faces; those without an area too.
Result<TriangleMesh> facesOf(std::span<const std::byte> bytes, const std::filesystem::path& path,
                             double metresPerUnit) {
  const std::string name = path.string();
  if (!(metresPerUnit >= 1e-6 && metresPerUnit <= 1000))
    return Error{fmt::format("{}: a unit of {} m; expected 1e-6 to 1000", name, metresPerUnit)};

  Content content;
  for (ObjText text(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
       !text.isAtEnd(); text.nextLine()) {
    const std::string_view keyword = text.nextWord();
    Status status;
    if (keyword == "v") {
      status = readPoint(text, content, metresPerUnit, name);
    } else if (keyword == "f") {
      status = readFace(text, content, name);
    } else if (keyword == "l") {
      ++content.polylines;
    }
    if (!status) return status.error();
  }

  TriangleMesh& mesh = content.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t index : mesh.triangles[t]) {
      if (index >= mesh.points.size()) {
        return wrong(name, content.lines[t], fmt::format("index {}", std::uint64_t{index} + 1),
                     fmt::format("at most {}, the number of points", mesh.points.size()));
      }
    }
  }
  if (std::ranges::none_of(mesh.triangles, [&](const auto& triangle) { return hasArea(mesh, triangle); })) {
    return Error{fmt::format(
        "{}: found {} points ('v'), {} polylines ('l'), {} triangles of no size and no others; expected "
        "lines like 'f 1 2 3', the faces of a body",
        name, mesh.points.size(), content.polylines, mesh.triangles.size())};
  }
  return std::move(mesh);
}

// What `read` makes of a file's bytes.
template <class Read>
Result<TriangleMesh> readFile(const std::filesystem::path& path, Read read) {
  try {
    const Result<std::vector<std::byte>> bytes = readWholeFile(path);
    if (!bytes) return bytes.error();
    return read(*bytes);
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", path.string())};
  }
}

}  // namespace

bool isObjMesh(const std::filesystem::path& path) { return endingOf(path) == ".obj"; }

Result<TriangleMesh> readObjMesh(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                 double metresPerUnit) {
  auto mesh = facesOf(bytes, path, metresPerUnit);
  if (mesh) std::erase_if(mesh->triangles, [&](const auto& triangle) { return !hasArea(*mesh, triangle); });
  return mesh;
}

Result<TriangleMesh> readObjMesh(const std::filesystem::path& path, double metresPerUnit) {
  return readFile(path, [&](const auto& bytes) { return readObjMesh(bytes, path, metresPerUnit); });
}

Result<TriangleMesh> readObjFaces(const std::filesystem::path& path, double metresPerUnit) {
  return readFile(path, [&](const auto& bytes) { return facesOf(bytes, path, metresPerUnit); });
}

}  // namespace ringlet
