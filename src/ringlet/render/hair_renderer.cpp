// Implements render/hair_renderer.h.
#include "ringlet/render/hair_renderer.h"
#include "ringlet/base/packed.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "layout/picture.h"
#include "ringlet/base/assert.h"
#include "ringlet/gpu/device_buffers.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kShadowHairs = 10000;      // that throw shadows, for all
constexpr double kNear = 0.01, kNearShare = 0.02;  // [m], and of the way to what is looked at, where less
constexpr double kMostHairs = 16384;               // before a place on average: sums stay within 32 bits

std::uint32_t kindOf(const SolidMesh& solid) {
  return solid.isGround() ? layout::kSolidGround : solid.isCloth ? layout::kSolidCloth : layout::kSolidBody;
}

Status checkSize(const PictureSize& size) {
  RINGLET_ASSERT(size.shadowCells >= 8 && size.shadowCells <= 256 && size.shadowSlices >= 8 &&
                     size.shadowSlices <= 256 && size.densityCells >= 8 && size.densityCells <= 128,
                 "the volumes of a picture's light have cells within their ranges");
  if (size.width >= 1 && size.width <= 16384 && size.height >= 1 && size.height <= 16384 && size.side >= 1 &&
      size.side <= 4)
    return {};
  return Error{fmt::format(
      "a picture of {} x {} pixels with {} samples along a pixel's side; at most 16384 pixels and 4 samples, "
      "at least 1 of each",
      size.width, size.height, size.side)};
}

// A row of a matrix that takes the world to an axis: 0 at `origin`, 1 after `length`.
layout::vec4 rowOf(Vec3d axis, Vec3d origin, double length) {
  return packed(axis / length, -dot(axis, origin) / length);
}

// Two lights that stand about the camera, and boxes along them about all hair.
void setLights(layout::Picture& picture, const Look& look, const Camera& camera, Vec3d middle,
               double radius) {
  const CameraAxes axes = axesOf(camera);
  const Vec3d ways[] = {normalizedOr(axes.up * 0.75 - axes.forward * 0.75 - axes.right * 0.65, axes.up),
                        normalizedOr(axes.up * 0.55 + axes.forward * 0.75 + axes.right * 0.6, axes.up)};
  const Vec3d colours[] = {look.key, look.rim};
  for (int light = 0; light < 2; ++light) {
    const Vec3d deep = -ways[light], across = anyNormal(deep), along = cross(deep, across);
    const Vec3d corner = middle - (deep + across + along) * radius;
    const Vec3d boxAxes[] = {across, along, deep};
    for (int axis = 0; axis < 3; ++axis)
      picture.lightAxes[3 * light + axis] = rowOf(boxAxes[axis], corner, 2 * radius);
    picture.lightDirection[light] = packed(ways[light]);
    picture.lightColour[light] = packed(colours[light]);
  }
  picture.densityBox = packed(middle - Vec3d{1, 1, 1} * radius, 2 * radius / picture.densityCells);
  picture.shadowCellArea = static_cast<float>(std::pow(2 * radius / picture.shadowCells, 2));
}

void writeLook(layout::Picture& picture, const Look& look) {
  picture.skyAbove = packed(look.skyAbove);
  picture.skyBelow = packed(look.skyBelow);
  RINGLET_ASSERT(look.pigments.size() >= 2 && look.pigments.size() <= layout::kMostPigments,
                 "a look has two to eight pigments");
  for (std::size_t i = 0; i < look.pigments.size(); ++i) picture.pigments[i] = packed(look.pigments[i]);
  picture.pigmentCount = static_cast<std::uint32_t>(look.pigments.size());
  picture.solidColours[layout::kSolidBody] = packed(look.solid);
  picture.solidColours[layout::kSolidGround] = packed(look.ground);
  picture.solidColours[layout::kSolidCloth] = packed(look.cloth);
  picture.backColours[0] = packed(look.backMiddle);
  picture.backColours[1] = packed(look.backEdge);
  const double b = look.roughnessAlong,
               deviation = 0.726 * b + 0.812 * b * b;  // Chiang et al. 2016, equation 7
  picture.along = static_cast<float>(deviation * deviation);
  picture.about = static_cast<float>(look.roughnessAbout);
  picture.tilt = static_cast<float>(look.tilt);
  picture.exposure = static_cast<float>(look.exposure);
  picture.tipRadius = static_cast<float>(look.tipRadius);
  picture.throughHair = static_cast<float>(look.throughHair);
  picture.shadowOpacity = static_cast<float>(look.shadowOpacity);
}

// Among the pigments, each hair its own place.
float pigmentOf(std::uint32_t hair) {
  std::uint32_t x = hair * 0x9e3779b9u + 1;
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return static_cast<float>((x ^ x >> 16) >> 8) / 16777216.0f;
}

std::vector<layout::SolidTriangle> trianglesOf(std::span<const SolidMesh> solids) {
  std::vector<layout::SolidTriangle> triangles;
  std::uint32_t first = 0;
  for (const SolidMesh& solid : solids) {
    for (const auto& t : solid.triangles)
      triangles.push_back({.points = {first + t[0], first + t[1], first + t[2]}, .unused = 0});
    first += static_cast<std::uint32_t>(solid.points.size());
  }
  return triangles;
}

}  // namespace

Result<HairRenderer> HairRenderer::create(gpu::Device& device, const DrawnHairs& hairs,
                                          std::vector<SolidMesh> solids, const PictureSize& size,
                                          const Look& look) {
  if (Status fine = checkSize(size); !fine) return fine.error();
  HairRenderer self;
  self.size_ = size;
  self.look_ = look;
  self.width_ = hairs.width;
  self.solids_ = std::move(solids);
  self.hairCount_ = static_cast<std::uint32_t>(hairs.firstPoint.size() - 1);
  self.pointCount_ = hairs.firstPoint.back();
  for (std::size_t h = 0; h + 1 < hairs.firstPoint.size(); ++h)
    self.pointsPerHair_ = std::max(self.pointsPerHair_, hairs.firstPoint[h + 1] - hairs.firstPoint[h]);
  for (const SolidMesh& solid : self.solids_) {
    self.solidPointCount_ += static_cast<std::uint32_t>(solid.points.size());
    self.patchCount_ += static_cast<std::uint32_t>(solid.patches.size());
    self.triangleCount_ += static_cast<std::uint32_t>(solid.triangles.size());
  }
  self.hasAtomic64_ = device.properties().hasAtomicInt64;
  if (Status made = self.makeBuffers(device, hairs); !made) return made.error();
  if (Status made = self.makeKernels(device, hairs.points); !made) return made.error();
  return self;
}

Status HairRenderer::makeBuffers(gpu::Device& device, const DrawnHairs& hairs) {
  std::vector<layout::DrawnHair> drawn;
  for (std::uint32_t h = 0; h < hairCount_; ++h)
    drawn.push_back({.firstPoint = hairs.firstPoint[h],
                     .pointCount = hairs.firstPoint[h + 1] - hairs.firstPoint[h],
                     .radius = static_cast<float>(hairs.width / 2 *
                                                  (hairs.widthFactors.empty() ? 1 : hairs.widthFactors[h])),
                     .pigment = pigmentOf(h)});

  const std::uint64_t row = std::uint64_t{8} * size_.side * size_.side * size_.width;
  const std::uint64_t most =
      std::min({size_.mostBytes, device.properties().maxStorageBufferRange,
                std::uint64_t{8} * device.pointGroupSize() * device.properties().maxGroupCount});
  bandRows_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(most / row, 1, size_.height));
  const std::uint64_t pixels = std::uint64_t{1} * size_.width * size_.height,
                      inBand = std::uint64_t{1} * size_.width * bandRows_;
  const std::uint64_t samples = row / 8 * bandRows_;
  const auto across = static_cast<std::uint64_t>(size_.shadowCells);
  const std::uint64_t shadows = 2 * across * across * static_cast<std::uint64_t>(size_.shadowSlices);
  const std::uint64_t cells = densityCellCount();

  const auto add = [&](Result<gpu::Buffer> buffer) -> Status {
    if (!buffer) return buffer.error();
    buffers_.push_back(std::move(*buffer));
    return {};
  };
  const auto room = [&](std::uint64_t bytes, const char* name) {
    return gpu::Buffer::create(device, bytes, gpu::BufferKind::storage, name);
  };
  const auto filled = [&](const auto& values, const char* name) {
    return createFilled(device, values, name);
  };
  // In the order of bindings; that of the hair's points is empty.
  const Status made[] = {
      add(room(sizeof(layout::Picture), "picture")),
      add(room(0, "none")),
      add(filled(drawn, "drawn hairs")),
      add(room(4 * shadows, "hair before lights")),
      add(room(4 * cells, "hair about places")),
      add(room(4 * cells, "seen sky")),
      add(room(8 * samples, "samples of the picture")),
      add(room(4 * samples, "samples of hair")),
      add(room(sizeof(layout::SeenCounts), "counts of what is seen")),
      add(room((std::uint64_t{solidPointCount_} + patchCount_) * sizeof(layout::SolidPoint),
               "points of bodies")),
      add(filled(trianglesOf(solids_), "triangles of bodies")),
      add(room(8 * inBand, "pixels of bodies")),
      add(room(8 * inBand, "colours of bodies")),
      add(room(size_.isPreview ? 0 : 16 * pixels, "samples' light")),
      add(room(4 * pixels, "shown pixels")),
      add(room(size_.isPreview ? 0 : 16 * pixels, "light of pixels"))};
  for (const Status& status : made)
    if (!status) return status;
  const std::vector<layout::SeenCounts> none{
      {.indirectHairs = {0, 1, 1}, .hairs = 0, .indirectSolids = {0, 1, 1}, .solids = 0}};
  auto counts = createFilled(device, none, "counts of nothing seen");
  if (!counts) return counts.error();
  noneSeen_.emplace(std::move(*counts));
  return {};
}

Status HairRenderer::makeKernels(gpu::Device& device, const gpu::Buffer& points) {
  gpu::BufferTable table;
  for (std::uint32_t binding = 0; binding < layout::kRenderBindingCount; ++binding) {
    const gpu::Buffer& bound = binding == layout::kBindDrawnPoints ? points : buffers_[binding];
    table.emplace(binding, bound);
    table.emplace(layout::kRenderTexels + binding, bound);
  }
  bool texels = true;
  for (const std::uint32_t binding : {layout::kBindDrawnPoints, layout::kBindDrawnHairs, layout::kBindSamples,
                                      layout::kBindSolidPoints, layout::kBindSolidTriangles})
    texels = texels && isSeenAsTexels(device, table.at(binding).get().bytes());
  for (std::size_t k = 0; k < kRenderKernelCount; ++k) {
    auto kernel = gpu::Kernel::create(
        device, describeRenderKernel(static_cast<RenderKernel>(k), device.pointGroupSize(), hasAtomic64_,
                                     texels, size_.isPreview));
    if (!kernel) return kernel.error();
    auto bindings = gpu::Bindings::create(**kernel, table);
    if (!bindings) return bindings.error();
    kernels_.push_back(std::move(*kernel));
    bindings_.push_back(std::move(*bindings));
  }
  return {};
}

Status HairRenderer::setFrame(const Camera& camera, const Bounds& hair, std::span<const SolidPlace> places) {
  layout::Picture picture{};
  const CameraAxes axes = axesOf(camera);
  picture.view[0] = rowOf(axes.right, camera.eye, 1);
  picture.view[1] = rowOf(axes.up, camera.eye, 1);
  picture.view[2] = rowOf(axes.forward, camera.eye, 1);
  picture.eye = packed(camera.eye);
  picture.shadowCells = static_cast<std::uint32_t>(size_.shadowCells);
  picture.shadowSlices = static_cast<std::uint32_t>(size_.shadowSlices);
  picture.densityCells = static_cast<std::uint32_t>(size_.densityCells);
  writeLook(picture, look_);
  setLights(picture, look_, camera, (hair.low + hair.high) / 2.0,
            std::max(length(hair.high - hair.low) / 2, 1e-4));
  picture.width = static_cast<std::uint32_t>(size_.width);
  picture.height = static_cast<std::uint32_t>(size_.height);
  picture.side = static_cast<std::uint32_t>(size_.side);
  picture.hairCount = hairCount_;
  picture.pointsPerHair = pointsPerHair_;
  picture.pointCount = pointCount_;
  picture.triangleCount = triangleCount_;
  picture.shadowStride = shadowStride();
  picture.focus = static_cast<float>(size_.height / 2.0 / std::tan(camera.fieldOfView / 2));
  picture.near = static_cast<float>(std::min(kNear, kNearShare * length(camera.target - camera.eye)));
  picture.fixedPoint = static_cast<float>(std::pow(2.0, 32) / (kMostHairs * picture.shadowCellArea));
  if (Status sent = buffers_[layout::kBindPicture].upload(std::as_bytes(std::span(&picture, 1))); !sent)
    return sent;

  // Points to be seen, then patches that throw shadows.
  std::vector<layout::SolidPoint> points;
  const auto add = [&](const SolidPlace& place, Vec3d point, Vec3d normal, double areaOrKind, double clear) {
    points.push_back({.position = packed(place.position + rotate(place.rotation, point), areaOrKind),
                      .normal = packed(rotate(place.rotation, normal), clear)});
  };
  const auto now = [&](std::size_t s) -> const SolidMesh& {
    return places[s].bent ? *places[s].bent : solids_[s];
  };
  for (std::size_t s = 0; s < solids_.size(); ++s)
    for (std::size_t i = 0; i < solids_[s].points.size(); ++i)
      add(places[s], now(s).points[i], now(s).normals[i], kindOf(solids_[s]),
          solids_[s].isGround() ? solids_[s].clearness[i] : 0);
  for (std::size_t s = 0; s < solids_.size(); ++s)
    for (const SolidMesh::Patch& patch : now(s).patches)
      add(places[s], patch.place, patch.normal, patch.area, 0);
  return buffers_[layout::kBindSolidPoints].upload(std::as_bytes(std::span(points)));
}

std::uint64_t HairRenderer::densityCellCount() const {
  const auto along = static_cast<std::uint64_t>(size_.densityCells);
  return along * along * along;
}

std::uint32_t HairRenderer::shadowStride() const { return std::max(1u, hairCount_ / kShadowHairs); }

void HairRenderer::dispatch(gpu::CommandList& list, RenderKernel kernel, std::uint64_t invocations,
                            std::uint32_t firstRow, std::uint32_t rowCount) const {
  const auto at = static_cast<std::size_t>(kernel);
  const std::uint32_t groupSize = kernels_[at]->groupSize();
  list.dispatch(*kernels_[at], bindings_[at], layout::PictureBand{firstRow, rowCount},
                static_cast<std::uint32_t>((invocations + groupSize - 1) / groupSize));
}

void HairRenderer::recordShadows(gpu::CommandList& list) const {
  list.beginStage("shadows");
  list.fillZero(buffer(layout::kBindShadows));
  list.fillZero(buffer(layout::kBindDensity));
  list.barrier();
  const std::uint32_t stride = shadowStride();
  dispatch(list, RenderKernel::shadowHairs,
           std::uint64_t{1} * ((hairCount_ + stride - 1) / stride) * pointsPerHair_);
  list.barrier();
  if (patchCount_ > 0) {
    dispatch(list, RenderKernel::shadowSolids, patchCount_, solidPointCount_, patchCount_);
    list.barrier();
  }
  dispatch(list, RenderKernel::shadowSum, std::uint64_t{2} * size_.shadowCells * size_.shadowCells);
  dispatch(list, RenderKernel::openness, densityCellCount());
  list.barrier();
  list.endStage();
}

void HairRenderer::recordSeen(gpu::CommandList& list, std::uint32_t firstRow, std::uint32_t rowCount) const {
  const std::uint64_t blocks =
      (std::uint64_t{rowCount} * size_.side + layout::kSolidRows - 1) / layout::kSolidRows;
  const auto draw = [&](RenderKernel solids, RenderKernel hairs) {
    if (triangleCount_ > 0) {
      dispatch(list, solids, triangleCount_ * blocks, firstRow, rowCount);
      list.barrier();
    }
    dispatch(list, hairs, pointCount_, firstRow, rowCount);
    list.barrier();
  };
  draw(RenderKernel::solids, RenderKernel::hairs);
  if (!hasAtomic64_) draw(RenderKernel::solidsId, RenderKernel::hairsId);
}

void HairRenderer::recordBand(gpu::CommandList& list, std::uint32_t firstRow, std::uint32_t rowCount) const {
  list.beginStage("draw");
  list.fillZero(buffer(layout::kBindSamples));
  list.copyBuffer(*noneSeen_, buffer(layout::kBindSeenCounts), sizeof(layout::SeenCounts));
  list.barrier();
  recordSeen(list, firstRow, rowCount);
  list.endStage();
  list.beginStage("shade");
  const std::uint64_t pixels = std::uint64_t{rowCount} * size_.width;
  dispatch(list, RenderKernel::compact, pixels, firstRow, rowCount);
  list.barrier();
  const auto shade = [&](RenderKernel kernel, std::uint64_t offset) {
    const auto at = static_cast<std::size_t>(kernel);
    list.dispatchIndirect(*kernels_[at], bindings_[at], layout::PictureBand{firstRow, rowCount},
                          buffer(layout::kBindSeenCounts), offset);
  };
  shade(RenderKernel::shadeHairs, offsetof(layout::SeenCounts, indirectHairs));
  shade(RenderKernel::shadeSolids, offsetof(layout::SeenCounts, indirectSolids));
  list.barrier();
  dispatch(list, RenderKernel::resolve, pixels, firstRow, rowCount);
  list.barrier();
  list.endStage();
}

void HairRenderer::record(gpu::CommandList& list, bool isFirst) const {
  if (isFirst && !size_.isPreview) {
    list.fillZero(buffer(layout::kBindPixels));
    list.barrier();
  }
  recordShadows(list);
  const auto height = static_cast<std::uint32_t>(size_.height);
  for (std::uint32_t row = 0; row < height; row += bandRows_)
    recordBand(list, row, std::min(bandRows_, height - row));
  if (size_.isPreview) return;
  list.beginStage("tone");
  for (const RenderKernel kernel : {RenderKernel::filter, RenderKernel::tone}) {
    dispatch(list, kernel, std::uint64_t{1} * size_.width * size_.height);
    list.barrier();
  }
  list.endStage();
}

const gpu::Buffer& HairRenderer::shown() const { return buffer(layout::kBindShown); }
const gpu::Buffer& HairRenderer::drawnHairs() const { return buffer(layout::kBindDrawnHairs); }

Status HairRenderer::setPigments(std::span<const float> pigments) {
  RINGLET_ASSERT(pigments.size() == hairCount_, "a pigment of each hair");
  auto drawn = downloadAll<layout::DrawnHair>(drawnHairs(), hairCount_);
  if (!drawn) return drawn.error();
  for (std::size_t h = 0; h < pigments.size(); ++h) (*drawn)[h].pigment = pigments[h];
  return buffers_[layout::kBindDrawnHairs].upload(std::as_bytes(std::span(*drawn)));
}

Result<std::vector<std::uint32_t>> HairRenderer::picture() const {
  return downloadAll<std::uint32_t>(buffer(layout::kBindShown),
                                    static_cast<std::size_t>(size_.width) * size_.height);
}

Result<std::vector<float>> HairRenderer::light() const {
  RINGLET_ASSERT(!size_.isPreview, "a preview keeps no light");
  const auto pixels = downloadAll<layout::vec4>(buffer(layout::kBindLight),
                                                static_cast<std::size_t>(size_.width) * size_.height);
  if (!pixels) return pixels.error();
  std::vector<float> light;
  for (const layout::vec4& pixel : *pixels) light.insert(light.end(), {pixel.x, pixel.y, pixel.z});
  return light;
}

std::uint64_t HairRenderer::byteCount() const {
  std::uint64_t bytes = 0;
  for (const gpu::Buffer& each : buffers_) bytes += each.bytes();
  return bytes;
}

}  // namespace ringlet
