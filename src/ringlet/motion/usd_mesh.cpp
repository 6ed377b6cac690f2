// Implements motion/usd_mesh.h.
#include "ringlet/motion/usd_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/quoted.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usdz_file.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/usd_clips.h"
#include "ringlet/motion/usd_prims.h"
#include "ringlet/motion/usd_skinned_mesh.h"
#include "ringlet/motion/usd_transform_stack.h"

namespace ringlet {
namespace {

using UsdMeshPointer = std::shared_ptr<const MeshMotion>;

constexpr double kUsdUnit = 0.01;      // of a file that says none [m]
constexpr std::size_t kMostNamed = 6;  // in a sentence

class UsdMeshMaker {
 public:
  UsdMeshMaker(UsdLayer& layer, const std::string& name, const UsdMeshChoice& choice)
      : layer_(layer), name_(name), choice_(choice), prims_(layer, name) {}

  Result<UsdMeshPointer> make() {
    if (Status found = findMesh(); !found) return found.error();
    if (Status whole = prims_.checkComposition(prim_); !whole) return whole.error();
    if (Status read = readClips(); !read) return read.error();
    if (Status read = readFaces(); !read) return read.error();
    if (Status read = readPoints(); !read) return read.error();
    auto deformers = readUsdDeformers(prims_, prim_, samples_.pointCount, warnings_);
    if (!deformers) return deformers.error();
    if (Status placed = place(*deformers); !placed) return placed.error();
    return deformers->isEmpty() ? sampled() : skinned(std::move(*deformers));
  }

 private:
  const UsdPrim& mesh() const { return layer_.prims[prim_]; }
  Error wrong(std::uint32_t prim, const std::string& sentence) const { return prims_.wrong(prim, sentence); }

  Result<UsdMeshPointer> sampled() {
    auto mesh =
        SampledMesh::of(std::move(triangles_), std::move(samples_), std::move(placed_), std::move(warnings_));
    if (!mesh) return wrong(prim_, mesh.error().message);
    return UsdMeshPointer(std::make_shared<const SampledMesh>(std::move(*mesh)));
  }
  Result<UsdMeshPointer> skinned(UsdDeformers deformers) {
    auto shape = SampledMesh::of(std::move(triangles_), std::move(samples_), {}, std::move(warnings_));
    if (!shape) return wrong(prim_, shape.error().message);
    auto mesh = UsdSkinnedMesh::of(std::move(*shape), std::move(deformers), std::move(placed_));
    if (!mesh) return wrong(prim_, mesh.error().message);
    return UsdMeshPointer(std::make_shared<const UsdSkinnedMesh>(std::move(*mesh)));
  }

  Status findMesh() {
    std::vector<std::uint32_t> meshes;
    for (std::uint32_t p = 0; p < layer_.prims.size(); ++p)
      if (layer_.prims[p].type == "Mesh" && prims_.isThere(p)) meshes.push_back(p);
    std::vector<std::string> paths;
    for (const std::uint32_t p : meshes) paths.push_back(usdPathOf(layer_, p));
    const std::string& wanted = choice_.prim;
    const std::string there = fmt::format(
        "{}", fmt::join(paths.begin(),
                        paths.begin() + std::min<std::ptrdiff_t>(kMostNamed, std::ssize(paths)), ", "));
    const bool isComposed =
        !layer_.composedBy.empty() ||
        std::ranges::any_of(layer_.prims, [](const UsdPrim& prim) { return !prim.composedBy.empty(); });
    if (meshes.empty())
      return Error{fmt::format(
          "{}: found no Mesh prim{}", name_,
          isComposed ? fmt::format(" but other files that are not followed; {}", kFlattenUsd) : "")};
    std::erase_if(meshes, [&](std::uint32_t p) {
      return !wanted.empty() && layer_.prims[p].name != wanted && usdPathOf(layer_, p) != wanted;
    });
    if (meshes.empty())
      return Error{
          fmt::format("{}: there is no Mesh prim {}; there are {}", name_, ringlet::quoted(wanted), there)};
    if (meshes.size() > 1)
      return Error{fmt::format("{}: has {} Mesh prims, so that one must be named, by its path: {}", name_,
                               meshes.size(), there)};
    prim_ = meshes.front();
    return {};
  }

  Result<const UsdValue*> constantOf(std::string_view name) const {
    const UsdAttribute* attribute = usdAttributeOf(mesh(), name);
    if (!attribute || attribute->value.numbers.empty()) return wrong(prim_, fmt::format("has no {}", name));
    return prims_.constantOf({prim_, attribute}, "the faces of a mesh that moves stay the same");
  }

  Status readFaces() {
    const auto counts = constantOf("faceVertexCounts");
    if (!counts) return counts.error();
    const auto indices = constantOf("faceVertexIndices");
    if (!indices) return indices.error();
    const std::vector<double>& corners = (*indices)->numbers;
    const bool isLeft = usdTokenOf(mesh(), "orientation", "rightHanded") == "leftHanded";
    std::size_t at = 0;
    for (const double count : (*counts)->numbers) {
      if (!(count >= 3 && count <= static_cast<double>(corners.size() - at)) || count != std::floor(count))
        return wrong(
            prim_, fmt::format("found a face of {} corners; expected 3 or more, and {} for all faces", count,
                               corners.size()));
      for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(count); ++k) {
        MeshMotion::Triangle triangle{};
        const std::size_t three[] = {at, at + k, at + k + 1};
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::size_t which = three[corner];
          if (!(corners[which] >= 0 && corners[which] < 4294967295.0))
            return wrong(prim_,
                         fmt::format("found the point {} in a face; expected 0 or more", corners[which]));
          triangle[corner] = static_cast<std::uint32_t>(corners[which]);
        }
        if (isLeft) std::swap(triangle[1], triangle[2]);
        triangles_.push_back(triangle);
      }
      at += static_cast<std::size_t>(count);
    }
    if (usdTokenOf(mesh(), "subdivisionScheme", "catmullClark") != "none")
      warnings_.push_back(
          fmt::format("{}: a subdivision surface; its cage is taken, which lies a little outside",
                      usdPathOf(layer_, prim_)));
    return {};
  }

  Status readClips() {
    auto clipped = readUsdClips(layer_, prims_, prim_, choice_.clips);
    if (!clipped) return clipped.error();
    clippedPoints_ = std::move(clipped->points);
    warnings_ = std::move(clipped->warnings);
    return {};
  }

  Status readPoints() {
    if (clippedPoints_) return takeClippedPoints();
    const UsdAttribute* points = usdAttributeOf(mesh(), "points");
    if (!points) return wrong(prim_, "has no points");
    if (!points->drivenBy.empty())
      return wrong(prim_, fmt::format("points are given by {}, which is not followed", points->drivenBy));
    std::vector<UsdSample> only;
    if (points->samples.empty()) only.push_back({0, points->value});
    const std::vector<UsdSample>& samples = only.empty() ? points->samples : only;
    samples_.pointCount = samples.front().value.numbers.size() / 3;
    for (const UsdSample& sample : samples) {
      const std::vector<double>& numbers = sample.value.numbers;
      if (sample.value.width != 3 || numbers.size() != 3 * samples_.pointCount || numbers.empty())
        return wrong(prim_,
                     fmt::format("found {} points at time {}; expected {}: points and faces of a mesh that "
                                 "moves stay the same",
                                 numbers.size() / 3, sample.time, samples_.pointCount));
    }
    const auto rate = prims_.timeCodesPerSecond();
    if (!rate) return rate.error();
    for (const UsdSample& sample : samples) {
      const std::vector<double>& xyz = sample.value.numbers;
      samples_.seconds.push_back(sample.time / *rate);
      for (std::size_t at = 0; at < xyz.size(); at += 3)
        samples_.points.push_back(static_cast<Vec3f>(Vec3d{xyz[at], xyz[at + 1], xyz[at + 2]}));
    }
    return {};
  }

  Status takeClippedPoints() {
    const auto rate = prims_.timeCodesPerSecond();
    if (!rate) return rate.error();
    samples_ = std::move(*clippedPoints_);
    for (double& time : samples_.seconds) time /= *rate;
    return {};
  }

  // By the prim that places what the deformers leave.
  Status place(const UsdDeformers& deformers) {
    const auto stack = UsdTransformStack::of(prims_, deformers.placedBy);
    if (!stack) return stack.error();
    auto placed = stack->placements(world());
    if (!placed) return placed.error();
    placed_ = std::move(*placed);
    if (placed_.seconds.size() < 2 && samples_.seconds.size() < 2 && !deformers.move())
      warnings_.push_back(fmt::format("{}: does not move", usdPathOf(layer_, prim_)));
    const Affine& first = placed_.placements.front();
    const bool mirrorsSkin = deformers.skin && deformers.skin->isMirroring();
    if ((dot(first.x, cross(first.y, first.z)) < 0) != mirrorsSkin)
      for (MeshMotion::Triangle& triangle : triangles_) std::swap(triangle[1], triangle[2]);
    return {};
  }

  Affine world() const {
    Affine scaled;
    scaled.x.x = scaled.y.y = scaled.z.z =
        choice_.metresPerUnit.value_or(layer_.metresPerUnit.value_or(kUsdUnit));
    const FileAxis stated = layer_.upAxis == "Z" ? FileAxis::plusZ : FileAxis::plusY;
    return turnUp(choice_.up.value_or(stated), choice_.upIsZ) * scaled;
  }

  UsdLayer& layer_;
  const std::string& name_;
  const UsdMeshChoice& choice_;
  UsdPrims prims_;
  std::uint32_t prim_ = kNoUsdPrim;
  std::vector<MeshMotion::Triangle> triangles_;
  std::optional<PointSamples> clippedPoints_;  // with time codes as seconds
  PointSamples samples_;
  PlacementSamples placed_;
  std::vector<std::string> warnings_;
};

}  // namespace

bool isUsdFile(const std::filesystem::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".usda" || ending == ".usdc" || ending == ".usd" || ending == ".usdz";
}

Result<UsdMeshPointer> readUsdMesh(std::span<const std::byte> bytes, const std::string& name,
                                   const UsdMeshChoice& choice) {
  auto layer = readUsdLayer(bytes, name, UsdContent::meshes);
  if (!layer) return layer.error();
  UsdMeshChoice chosen = choice;
  if (isUsdz(bytes)) chosen.clips = nullptr;  // they are beside the layer, in the package
  return UsdMeshMaker(*layer, name, chosen).make();
}

}  // namespace ringlet
