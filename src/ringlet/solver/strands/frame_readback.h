// FrameReadback: brings the positions at a frame's end into the host's memory, in the order of the groom. On
// a GPU a kernel writes them there; on a processor the host puts a copy of them into order, which costs it a
// third of that.
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

/// Where the particles of a device stand in its frames: of all of a groom's strands as in the groom, which
/// has gaps for those that are carried rigidly (solver/inputs/rigid_hair.h); of a part of them without gaps,
/// in device order.
struct FramePlaces {
  // Of each particle, device order; layout::kNoPlace for those of the halo.
  std::vector<std::uint32_t> places{};
  std::uint32_t count = 0;  // places of a frame
  bool areOfGroom = true;   // else of a part

  static FramePlaces of(const RestState& rest);
  /// Those of a chunk's particles. Fails when the device lacks memory.
  Result<std::shared_ptr<const gpu::Buffer>> onDevice(gpu::Device& device, const GroomChunk& chunk) const;
};

class FrameReadback {
 public:
  /// count: FramePlaces::count. `groom` must live as long, in one place. mostBufferBytes: the largest buffer
  /// that a kernel may bind. Fails when the device lacks memory.
  static Result<FrameReadback> create(gpu::Device& device, const DeviceGroom& groom, std::uint32_t count,
                                      std::uint64_t mostBufferBytes);

  /// Records it. The caller records the barrier before.
  void record(gpu::CommandList& list) const;
  /// Once the device has done what was recorded.
  void arrive(const FramePlaces& places);
  /// Does it now, after a frame that is not recorded.
  Status download(const FramePlaces& places);
  /// The positions, by place. Places of no particle hold what was last written there.
  std::span<Vec3f> positions() const;
  std::uint64_t bytes() const;

 private:
  // What a dispatch writes: places [begin, end), of a chunk's particles.
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
  std::vector<gpu::Buffer> parts_;  // of it, where it is larger than a kernel may bind
  std::vector<Piece> pieces_;
  std::uint32_t mostGroups_ = 1;
  std::vector<gpu::Buffer> copies_;  // on a processor: of each chunk's positions, in device order
  const DeviceGroom* groom_ = nullptr;
};

}  // namespace ringlet
