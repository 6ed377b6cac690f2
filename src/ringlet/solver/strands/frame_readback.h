// FrameReadback: copies the positions at a frame's end to host memory, in groom order. On a GPU a kernel
// writes them there; on a CPU device the host reorders a copy, in a third of the time that the kernel would
// take.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

/// The places of a device's particles in its frames. If the device steps all strands, a frame has the order
/// of the groom, with gaps for rigid strands (solver/inputs/rigid_hair.h); if it steps a part of them, device
/// order without gaps.
struct FramePlaces {
  // By particle, device order; layout::kNoPlace for those of the halo.
  std::vector<std::uint32_t> places{};
  std::uint32_t count = 0;  // number of places of a frame
  bool areOfGroom = true;   // false: of a part

  static FramePlaces of(const RestState& rest);
  /// The places of a chunk's particles, in device memory. Fails when the device lacks memory.
  Result<std::shared_ptr<const gpu::Buffer>> onDevice(gpu::Device& device, const GroomChunk& chunk) const;
};

class FrameReadback {
 public:
  /// count: FramePlaces::count. `groom` must live as long, in one place. mostBufferBytes: the largest buffer
  /// that a kernel may bind. Fails when the device lacks memory.
  static Result<FrameReadback> create(gpu::Device& device, const DeviceGroom& groom, std::uint32_t count,
                                      std::uint64_t mostBufferBytes);

  /// Records the copy. The caller records the barrier before it.
  void record(gpu::CommandList& list) const;
  /// Completes the copy; call it once the device has done what was recorded.
  void arrive(const FramePlaces& places);
  /// Copies now, after a frame that was not recorded.
  Status download(const FramePlaces& places);
  /// The positions, by place. Places without a particle hold what was last written there.
  std::span<Vec3f> positions() const;
  std::uint64_t bytes() const;

 private:
  // The work of one dispatch: a chunk's particles with places in [begin, end).
  struct Piece {
    gpu::Bindings bindings;
    std::uint32_t count = 0, begin = 0, end = 0;
  };
  explicit FrameReadback(gpu::Buffer frame) : frame_(std::move(frame)) {}
  Status makePieces(gpu::Device& device, const DeviceGroom& groom, std::uint32_t count,
                    std::uint64_t mostBufferBytes);
  Status makeCopies(gpu::Device& device, const DeviceGroom& groom);
  void put(const FramePlaces& places, const GroomChunk& chunk, std::span<const layout::vec4> values) const;

  std::shared_ptr<const gpu::Kernel> kernel_;
  gpu::Buffer frame_;
  std::vector<gpu::Buffer> parts_;  // parts of frame_, if it is larger than a kernel may bind
  std::vector<Piece> pieces_;
  std::uint32_t mostGroups_ = 1;
  std::vector<gpu::Buffer> copies_;  // on a CPU device: each chunk's positions, in device order
  const DeviceGroom* groom_ = nullptr;
};

}  // namespace ringlet
