// Implements motion/mesh_motion_file.h.
#include "ringlet/motion/mesh_motion_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <new>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/motion/abc_mesh.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/motion/point_cache.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/skinned_mesh.h"
#include "ringlet/motion/usd_mesh.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;
using MeshPointer = std::shared_ptr<const MeshMotion>;

constexpr double kOwnUnit = 1;  // points are read as the file has them; Affine brings them into metres

// "body.####.obj" is "body.", 4 and ".obj".
struct Pattern {
  std::string before, after;
  std::size_t digits = 0;
};
Pattern patternOf(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::size_t first = name.find('#');
  const std::size_t last = std::min(name.find_first_not_of('#', first), name.size());
  return {name.substr(0, first), name.substr(last), last - first};
}

// The number of a file of the sequence; none for another file.
std::optional<std::uint64_t> numberOf(const Pattern& pattern, const std::string& name) {
  if (!name.starts_with(pattern.before) || !name.ends_with(pattern.after)) return std::nullopt;
  if (name.size() < pattern.before.size() + pattern.digits + pattern.after.size()) return std::nullopt;
  const char* begin = name.data() + pattern.before.size();
  const char* end = name.data() + name.size() - pattern.after.size();
  std::uint64_t number = 0;
  const auto [at, error] = std::from_chars(begin, end, number);
  return error == std::errc() && at == end ? std::optional(number) : std::nullopt;
}

struct NumberedFile {
  std::uint64_t number = 0;
  fs::path path;
};
std::vector<NumberedFile> numberedFiles(const fs::path& path) {
  const Pattern pattern = patternOf(path);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<NumberedFile> files;
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    if (const auto number = numberOf(pattern, name)) files.push_back({*number, path.parent_path() / name});
  }
  std::ranges::sort(files, {}, [](const NumberedFile& file) { return std::pair(file.number, file.path); });
  return files;
}

Affine worldOf(const MeshMotionChoice& choice, bool upIsZ) {
  Affine scaled;
  const double unit = choice.metresPerUnit.value_or(1);
  scaled.x.x = scaled.y.y = scaled.z.z = unit;
  return turnUp(choice.up.value_or(upIsZ ? FileAxis::plusZ : FileAxis::plusY), upIsZ) * scaled;
}

// Whether the first sample is a mirror image of the points, or nearly one: the map from these that fits it
// best has a negative determinant. Of points in a plane it has none.
bool isMirrored(const std::vector<Vec3d>& points, const PointSamples& samples) {
  const std::size_t count = points.size();
  Vec3d from, to;
  for (std::size_t p = 0; p < count; ++p) {
    from += points[p] / static_cast<double>(count);
    to += Vec3d(samples.points[p]) / static_cast<double>(count);
  }
  Vec3d x, y, z;
  double size = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const Vec3d a = points[p] - from, b = Vec3d(samples.points[p]) - to;
    x += b * a.x;
    y += b * a.y;
    z += b * a.z;
    size += length(a) * length(b);
  }
  return dot(x, cross(y, z)) < -1e-6 * size * size * size;
}

Result<MeshPointer> sampled(TriangleMesh mesh, PointSamples samples, const MeshMotionChoice& choice,
                            bool upIsZ, std::vector<std::string> warnings = {}) {
  auto made = SampledMesh::of(std::move(mesh.triangles), std::move(samples), {{0}, {worldOf(choice, upIsZ)}},
                              std::move(warnings));
  if (!made) return Error{fmt::format("{}: {}", choice.path.string(), made.error().message)};
  return MeshPointer(std::make_shared<const SampledMesh>(std::move(*made)));
}

Result<MeshPointer> readCached(const MeshMotionChoice& choice, bool upIsZ) {
  if (!isPointCache(choice.cache))
    return Error{fmt::format("{}: found a file of another kind; expected a point cache, .pc2 or .mdd",
                             choice.cache.string())};
  auto mesh = readObjFaces(choice.path, kOwnUnit);
  if (!mesh) return mesh.error();
  auto samples = readPointCache(choice.cache, choice.framesPerSecond);
  if (!samples) return samples.error();
  if (samples->pointCount != mesh->points.size())
    return Error{fmt::format("{}: found {} points; expected {}, as many as {} has", choice.cache.string(),
                             samples->pointCount, mesh->points.size(), choice.path.string())};
  std::vector<std::string> warnings;
  if (isMirrored(mesh->points, *samples)) {
    for (Vec3f& point : samples->points) point.z = -point.z;
    warnings.push_back(
        fmt::format("its points are mirrored in {}, as left-handed programs write them; Z is turned round",
                    choice.cache.string()));
  }
  return sampled(std::move(*mesh), std::move(*samples), choice, upIsZ, std::move(warnings));
}

Result<MeshPointer> readSequence(const MeshMotionChoice& choice, bool upIsZ) {
  const std::vector<NumberedFile> files = numberedFiles(choice.path);
  if (files.empty())
    return Error{fmt::format("{}: found no file with a number in place of '#'", choice.path.string()),
                 Fault::input};
  TriangleMesh first;
  PointSamples samples;
  for (const NumberedFile& file : files) {
    auto mesh = readObjFaces(file.path, kOwnUnit);
    if (!mesh) return mesh.error();
    if (samples.seconds.empty()) {
      first = *mesh;
      samples.pointCount = mesh->points.size();
    }
    const auto differs = [&](const char* what, std::size_t found, std::size_t expected) {
      return Error{
          fmt::format("{}: found {} {}; expected {}, as in {}: points and faces of a mesh that moves "
                      "stay the same",
                      file.path.string(), found, what, expected, files.front().path.string())};
    };
    if (mesh->points.size() != samples.pointCount)
      return differs("points", mesh->points.size(), samples.pointCount);
    if (mesh->triangles.size() != first.triangles.size())
      return differs("triangles", mesh->triangles.size(), first.triangles.size());
    const auto other = std::ranges::mismatch(mesh->triangles, first.triangles).in1;
    if (other != mesh->triangles.end())
      return Error{
          fmt::format("{}: found triangle {} between other points than in {}; points and faces of a mesh "
                      "that moves stay the same",
                      file.path.string(), other - mesh->triangles.begin() + 1, files.front().path.string())};
    samples.seconds.push_back(static_cast<double>(file.number - files.front().number) /
                              choice.framesPerSecond);
    for (const Vec3d& point : mesh->points) samples.points.push_back(static_cast<Vec3f>(point));
  }
  return sampled(std::move(first), std::move(samples), choice, upIsZ);
}

Result<MeshPointer> readOfObj(const MeshMotionChoice& choice, bool upIsZ) {
  if (isMeshSequence(choice.path)) return readSequence(choice, upIsZ);
  if (!choice.cache.empty()) return readCached(choice, upIsZ);
  return Error{
      fmt::format("{}: an OBJ file has one pose; expected a point cache beside it (.pc2, .mdd), or a "
                  "sequence as in body.####.obj",
                  choice.path.string())};
}

Result<MeshPointer> readOfArchive(const MeshMotionChoice& choice, bool upIsZ) {
  const auto bytes = readWholeFile(choice.path);
  if (!bytes) return bytes.error();
  const std::string name = choice.path.string();
  if (isAbcFile(choice.path)) return readAbcMesh(*bytes, name, {choice.mesh, worldOf(choice, upIsZ)});
  const UsdClipFolder clips(choice.path.parent_path());
  return readUsdMesh(*bytes, name, {choice.mesh, choice.metresPerUnit, choice.up, upIsZ, &clips});
}

Result<MeshPointer> readOfAny(const MeshMotionChoice& choice, bool upIsZ) {
  const std::string name = choice.path.string();
  if (isObjMesh(choice.path)) return readOfObj(choice, upIsZ);
  if (!choice.cache.empty())
    return Error{fmt::format("{}: found a point cache, {}, beside it; only an OBJ file has one", name,
                             choice.cache.string())};
  if (isAbcFile(choice.path) || isUsdFile(choice.path)) return readOfArchive(choice, upIsZ);
  auto mesh = readSkinnedMesh(choice.path, {.node = choice.mesh,
                                            .animation = choice.animation,
                                            .placement = {.metresPerUnit = choice.metresPerUnit.value_or(1),
                                                          .upIsZ = upIsZ,
                                                          .up = choice.up.value_or(FileAxis::plusY)}});
  if (mesh) return MeshPointer(std::make_shared<const SkinnedMesh>(std::move(*mesh)));
  if (motionFileKind(name) == MotionFileKind::gltf) return mesh.error();
  return Error{fmt::format("{}; a mesh that moves is read from {}", mesh.error().message, kMeshMotionEndings),
               mesh.error().fault};
}

}  // namespace

bool isWithoutUnit(const fs::path& path) { return isObjMesh(path) || isAbcFile(path); }

bool isMeshSequence(const fs::path& path) { return path.filename().string().find('#') != std::string::npos; }

std::vector<fs::path> meshSequenceFiles(const fs::path& pattern) {
  std::vector<fs::path> paths;
  for (NumberedFile& file : numberedFiles(pattern)) paths.push_back(std::move(file.path));
  return paths;
}

std::vector<fs::path> meshMotionFiles(const fs::path& path, const fs::path& cache) {
  std::vector<fs::path> paths = isMeshSequence(path) ? meshSequenceFiles(path) : std::vector{path};
  if (!cache.empty()) paths.push_back(cache);
  return paths;
}

Result<MeshPointer> readMeshMotion(const MeshMotionChoice& choice, bool upIsZ) {
  try {
    return readOfAny(choice, upIsZ);
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", choice.path.string()),
                 Fault::hostMemory};
  }
}

}  // namespace ringlet
