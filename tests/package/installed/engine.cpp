// An engine: heads of hair step in the engine's own commands, and are drawn from device memory.
#include <vulkan/vulkan.h>

#include <vector>

#include "ringlet/solver/hair_frames.h"

// host: the engine's handles; device and queue were made with what ComputeDevice::needs asks for.
ringlet::Result<ringlet::HairAsset> loadHair(const ringlet::HostVulkan& host, const ringlet::Groom& groom) {
  const auto device = ringlet::ComputeDevice::adopt(host);
  if (!device) return device.error();
  return ringlet::HairAsset::build(*device, groom, ringlet::Material{}, ringlet::Settings{}, {.heads = 100});
}

struct Head {
  ringlet::Simulation hair;              // create(asset, {.head = pose, .readsBack = false})
  std::vector<ringlet::HeadPose> poses;  // of this frame, one for each of Settings::stepsPerFrame
};

// Into the frame's command buffer, before the pass that draws VkBuffer devicePositions()[0].buffer.
ringlet::Status stepHair(std::vector<Head>& heads, VkCommandBuffer commands) {
  std::vector<ringlet::HairFrame> frames;
  for (Head& head : heads) frames.push_back({&head.hair, head.poses});
  if (auto status = ringlet::recordFrames(frames, commands); !status) return status;
  const VkMemoryBarrier drawn{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT,
                              VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, 0,
                       1, &drawn, 0, nullptr, 0, nullptr);
  return {};
}

// When the frame's fence has been waited for.
ringlet::Status endFrame(std::vector<Head>& heads) {
  for (Head& head : heads)
    if (auto status = frameIsOver(head.hair); !status) return status;
  return {};
}
