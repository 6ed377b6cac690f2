// HairRenderer: pictures of hair and bodies by compute kernels, on the device where the hair is; no window
// system and no graphics pipeline. What is nearest at each sample is found by atomics (render_hairs.comp,
// render_solids.comp), only what is seen is shaded, and shadows and skylight come from volumes that the hair
// is counted into (shadow_volume.glsl).
//
//     create -> { setFrame -> record, submitted by the caller }, once for each moment of a picture -> picture
//
// The same hair, camera and device give the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/render/camera.h"
#include "ringlet/render/look.h"
#include "ringlet/render/render_kernels.h"
#include "ringlet/render/solid_mesh.h"

namespace ringlet {

struct PictureSize {
  int width = 960, height = 540;           // [pixels], each in [1, 16384]
  int side = 4;                            // samples along a pixel's side, in [1, 4]
  std::uint64_t mostBytes = 128ull << 20;  // of samples drawn together; a larger picture is drawn in bands
  // Of the volumes that light is looked up in. Coarser ones are cheaper and softer.
  int shadowCells = 160, shadowSlices = 64;  // across and along each light's box, in [8, 256]
  int densityCells = 48;                     // along the box about all hair, in [8, 128]
  // One moment, shown at once: of a pixel's hair one sample is shaded, and shadows on bodies are less soft.
  // There is no light().
  bool isPreview = false;
};

/// Hair to be drawn, on the device.
struct DrawnHairs {
  const gpu::Buffer& points;                  // as FollowStage::points: uvec4[]
  std::span<const std::uint32_t> firstPoint;  // of each hair, and one more
  double width = 0.0002;                      // diameter at the root [m], above 0
  std::span<const float> widthFactors{};      // of each hair, on it; none: all 1
};

/// Where a body is: world from body; and what it has become, if it bends.
struct SolidPlace {
  Vec3d position;  // [m]
  Quatd rotation;
  std::shared_ptr<const SolidMesh> bent{};  // of its SolidMesh
};

class HairRenderer {
 public:
  /// `hairs.points` must live as long. Errors: a size out of its range; the device has too little memory.
  static Result<HairRenderer> create(gpu::Device& device, const DrawnHairs& hairs,
                                     std::vector<SolidMesh> solids, const PictureSize& size,
                                     const Look& look);
  HairRenderer(HairRenderer&&) = default;

  /// Of the next moment. `hair`: what all hair is within, for shadows; a place for each body. Nothing may be
  /// under way.
  Status setFrame(const Camera& camera, const Bounds& hair, std::span<const SolidPlace> places);

  /// From the next moment on, of each hair: its place among the look's pigments, 0 the first, 1 the last.
  /// Nothing may be under way.
  Status setPigments(std::span<const float> pigments);

  /// From the next moment on.
  void setLook(const Look& look) { look_ = look; }

  /// Draws the moment, with a stage for each part. `isFirst`: of a picture; later moments are added to it
  /// (motion blur).
  void record(gpu::CommandList& list, bool isFirst) const;

  /// The mean of the moments since the first: width * height pixels, row by row from the top: red in the
  /// lowest byte, green, blue, 255.
  Result<std::vector<std::uint32_t>> picture() const;

  /// The same pixels on the device, after what was recorded.
  const gpu::Buffer& shown() const;
  /// DrawnHair[hairs] (layout/picture.h), for what changes their pigments on the device.
  const gpu::Buffer& drawnHairs() const;

  /// The same in linear light, before the exposure: red, green, blue, one after the other.
  Result<std::vector<float>> light() const;

  std::uint64_t byteCount() const;  // of its buffers, without the hair

 private:
  HairRenderer() = default;
  Status makeBuffers(gpu::Device& device, const DrawnHairs& hairs);
  Status makeKernels(gpu::Device& device, const gpu::Buffer& points);
  void dispatch(gpu::CommandList& list, RenderKernel kernel, std::uint64_t invocations,
                std::uint32_t firstRow = 0, std::uint32_t rowCount = 0) const;
  std::uint32_t shadowStride() const;
  std::uint64_t densityCellCount() const;
  void recordShadows(gpu::CommandList& list) const;
  void recordBand(gpu::CommandList& list, std::uint32_t firstRow, std::uint32_t rowCount) const;
  void recordSeen(gpu::CommandList& list, std::uint32_t firstRow, std::uint32_t rowCount) const;

  const gpu::Buffer& buffer(std::uint32_t binding) const { return buffers_[binding]; }

  PictureSize size_;
  Look look_;
  std::vector<SolidMesh> solids_;
  std::uint32_t hairCount_ = 0, pointCount_ = 0, pointsPerHair_ = 0;
  std::uint32_t solidPointCount_ = 0, patchCount_ = 0, triangleCount_ = 0;
  std::uint32_t bandRows_ = 0;  // of pixels, drawn together
  double width_ = 0;
  bool hasAtomic64_ = false;
  std::vector<gpu::Buffer> buffers_;     // by binding
  std::optional<gpu::Buffer> noneSeen_;  // SeenCounts before there is anything
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels_;
  std::vector<gpu::Bindings> bindings_;
};

}  // namespace ringlet
