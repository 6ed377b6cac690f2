// Implements motion/abc_mesh.h.
#include "ringlet/motion/abc_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/quoted.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_transform.h"
#include "ringlet/motion/sampled_mesh.h"

namespace ringlet {
namespace {

using AbcMeshPointer = std::shared_ptr<const MeshMotion>;

constexpr std::string_view kPolyMesh = "AbcGeom_PolyMesh_v1", kSubD = "AbcGeom_SubD_v1";
constexpr std::size_t kMostAbcNamed = 6;  // in a sentence
constexpr const char* kStaysTheSame = "points and faces of a mesh that moves stay the same";

class AbcMeshMaker {
 public:
  AbcMeshMaker(const AbcArchive& archive, const AbcMeshChoice& choice) : archive_(archive), choice_(choice) {}

  Result<AbcMeshPointer> make() {
    if (Status found = findMesh(); !found) return found.error();
    if (Status found = findProperties(); !found) return found.error();
    if (Status read = readFaces(); !read) return read.error();
    if (Status read = readPoints(); !read) return read.error();
    if (Status placed = place(); !placed) return placed.error();
    auto mesh =
        SampledMesh::of(std::move(triangles_), std::move(samples_), std::move(placed_), std::move(warnings_));
    if (!mesh) return wrong(mesh.error().message);
    return AbcMeshPointer(std::make_shared<const SampledMesh>(std::move(*mesh)));
  }

 private:
  Error wrong(const std::string& sentence) const { return archive_.wrong(object_, sentence); }
  std::string_view schemaOf(std::uint32_t object) const {
    return abcValueOf(archive_.objects()[object].metadata, "schema");
  }

  Status findMesh() {
    std::vector<std::uint32_t> meshes;
    const std::size_t objectCount = archive_.objects().size();
    for (std::uint32_t k = 1; k < objectCount; ++k)
      if (schemaOf(k) == kPolyMesh || schemaOf(k) == kSubD) meshes.push_back(k);
    if (meshes.empty())
      return Error{fmt::format("{}: found no mesh (PolyMesh, SubD) among {} objects", archive_.name(),
                               objectCount - 1)};
    std::vector<std::string> paths;
    for (std::size_t k = 0; k < std::min(meshes.size(), kMostAbcNamed); ++k)
      paths.push_back(archive_.pathOf(meshes[k]));
    const std::string there = fmt::format("{}", fmt::join(paths, ", "));
    const std::string& wanted = choice_.object;
    std::erase_if(meshes, [&](std::uint32_t k) {
      return !wanted.empty() && archive_.objects()[k].name != wanted && archive_.pathOf(k) != wanted;
    });
    if (meshes.empty())
      return Error{fmt::format("{}: there is no mesh {}; there are {}", archive_.name(),
                               ringlet::quoted(wanted), there)};
    if (meshes.size() > 1)
      return Error{fmt::format("{}: has {} meshes, so that one must be named, by its path: {}",
                               archive_.name(), meshes.size(), there)};
    object_ = meshes.front();
    if (schemaOf(object_) == kSubD)
      warnings_.push_back(
          fmt::format("{}: a subdivision surface; its cage is taken, which lies a little outside",
                      archive_.pathOf(object_)));
    return {};
  }

  Status findProperties() {
    const auto all = archive_.propertiesOf(object_);
    if (!all) return all.error();
    const AbcProperty* compound = abcPropertyNamed(*all, ".geom");
    if (!compound) return wrong("has no .geom");
    auto own = archive_.propertiesOf(*compound);
    if (!own) return own.error();
    properties_ = std::move(*own);
    return {};
  }

  Result<AbcProperty> propertyOf(std::string_view name) const {
    const AbcProperty* found = abcPropertyNamed(properties_, name);
    if (!found || found->sampleCount == 0) return wrong(fmt::format("has no {}", name));
    return *found;
  }

  // Integers that must be the same in all samples.
  Result<AbcSample> constantOf(std::string_view name) const {
    const auto property = propertyOf(name);
    if (!property) return property.error();
    if (property->type < AbcType::u8 || property->type > AbcType::i64)
      return wrong(fmt::format("found {} of {}; expected integers", name, nameOf(property->type)));
    const auto first = archive_.stored(*property, 0);
    if (!first) return first;
    if (first->numberCount() == 0) return wrong(fmt::format("has no {}", name));
    const auto place = archive_.placeOfStored(*property, 0);
    std::size_t bytesLeft = archive_.byteCount();  // equal samples have one place, others do not overlap
    for (std::uint32_t k = 1; k < property->storedCount(); ++k) {
      const auto other = archive_.placeOfStored(*property, k);
      if (!other) return other.error();
      if (*other == *place) continue;
      const auto sample = archive_.stored(*property, k);
      if (!sample) return sample;
      const std::uint32_t number = property->sampleOfStored(k) + 1;
      if (sample->numberCount() != first->numberCount())
        return wrong(fmt::format("found {} numbers of {} in sample {}; expected {}: {}",
                                 sample->numberCount(), name, number, first->numberCount(), kStaysTheSame));
      if (sample->bytes().size() > bytesLeft) return wrong(fmt::format("samples of {} overlap", name));
      bytesLeft -= sample->bytes().size();
      std::size_t at = 0;
      while (at < first->numberCount() && sample->number(at) == first->number(at)) ++at;
      if (at == first->numberCount()) continue;
      return wrong(fmt::format("found {} as number {} of {} in sample {}; expected {}: {}",
                               sample->number(at), at + 1, name, number, first->number(at), kStaysTheSame));
    }
    return first;
  }

  // Faces of the format are clockwise seen from outside.
  Status readFaces() {
    const auto counts = constantOf(".faceCounts");
    if (!counts) return counts.error();
    const auto corners = constantOf(".faceIndices");
    if (!corners) return corners.error();
    std::size_t at = 0;
    const std::size_t cornerCount = corners->numberCount();
    for (std::size_t face = 0; face < counts->numberCount(); ++face) {
      const double count = counts->number(face);
      if (!(count >= 3 && count <= static_cast<double>(cornerCount - at)))
        return wrong(fmt::format("found a face of {} corners; expected 3 or more, and {} for all faces",
                                 count, cornerCount));
      for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(count); ++k) {
        MeshMotion::Triangle triangle{};
        const std::size_t three[] = {at, at + k + 1, at + k};
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const double point = corners->number(three[corner]);
          if (!(point >= 0 && point < 4294967295.0))
            return wrong(fmt::format("found the point {} in a face; expected 0 or more", point));
          triangle[corner] = static_cast<std::uint32_t>(point);
        }
        triangles_.push_back(triangle);
      }
      at += static_cast<std::size_t>(count);
    }
    if (at == cornerCount) return {};
    return wrong(
        fmt::format("found {} corners; expected {}, for {} faces", cornerCount, at, counts->numberCount()));
  }

  Status readPoints() {
    const auto property = propertyOf("P");
    if (!property) return property.error();
    const bool isFloat =
        property->type == AbcType::f16 || property->type == AbcType::f32 || property->type == AbcType::f64;
    if (!isFloat || property->width != 3)
      return wrong(fmt::format("found P of {} {} an element; expected 3 floats", property->width,
                               nameOf(property->type)));
    const auto knots = archive_.knotsOf(*property);
    if (!knots) return knots.error();
    for (const AbcKnot& knot : *knots) {
      const auto sample = archive_.stored(*property, knot.stored);
      if (!sample) return sample.error();
      const std::size_t count = sample->elementCount();
      if (samples_.seconds.empty()) samples_.pointCount = count;
      if (count != samples_.pointCount)
        return wrong(fmt::format("found {} points in sample {}; expected {}: {}", count, knot.sample + 1,
                                 samples_.pointCount, kStaysTheSame));
      if (3 * (samples_.points.size() + count) > archive_.mostNumbers())
        return wrong(fmt::format("its {} samples of {} points are more than is read of a file of {} bytes",
                                 knots->size(), count, archive_.byteCount()));
      samples_.seconds.push_back(knot.seconds);
      for (std::size_t k = 0; k < 3 * count; k += 3)
        samples_.points.push_back(
            static_cast<Vec3f>(Vec3d{sample->number(k), sample->number(k + 1), sample->number(k + 2)}));
    }
    return {};
  }

  Status place() {
    const auto transforms = AbcTransforms::of(archive_, object_);
    if (!transforms) return transforms.error();
    placed_ = {transforms->seconds(), {}};
    if (placed_.seconds.empty()) placed_.seconds.push_back(0);
    for (const double seconds : placed_.seconds) {
      const auto [rows, move] = transforms->at(seconds);
      placed_.placements.push_back(choice_.world * Affine{rows[0], rows[1], rows[2], move});
    }
    if (placed_.seconds.size() < 2 && samples_.seconds.size() < 2)
      warnings_.push_back(fmt::format("{}: does not move", archive_.pathOf(object_)));
    const Affine& first = placed_.placements.front();
    if (dot(first.x, cross(first.y, first.z)) < 0)
      for (MeshMotion::Triangle& triangle : triangles_) std::swap(triangle[1], triangle[2]);
    return {};
  }

  const AbcArchive& archive_;
  const AbcMeshChoice& choice_;
  std::uint32_t object_ = 0;
  std::vector<AbcProperty> properties_;
  std::vector<MeshMotion::Triangle> triangles_;
  PointSamples samples_;
  PlacementSamples placed_{{}, {}};
  std::vector<std::string> warnings_;
};

}  // namespace

bool isAbcFile(const std::filesystem::path& path) { return endingOf(path) == ".abc"; }

Result<AbcMeshPointer> readAbcMesh(std::span<const std::byte> bytes, const std::string& name,
                                   const AbcMeshChoice& choice) {
  const auto archive = AbcArchive::of(bytes, name);
  if (!archive) return archive.error();
  return AbcMeshMaker(*archive, choice).make();
}

}  // namespace ringlet
