// Canvas: the picture of the whole window: pictures of hair, copied from the device's buffers, under the
// panel (Dear ImGui). It goes to the window, and, where asked for, to the host.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/owned.h"
#include "view/window.h"

namespace ringlet::view {

/// A picture of hair in the window.
struct PlacedPicture {
  const gpu::Buffer* pixels = nullptr;  // as HairRenderer::shown
  int left = 0, width = 0, height = 0;  // from the top [pixels]
};

class Canvas {
 public:
  /// Starts Dear ImGui for the window, which must be attached to the device.
  static Result<std::unique_ptr<Canvas>> create(std::shared_ptr<gpu::Device> device, Window& window);
  ~Canvas();
  Canvas(const Canvas&) = delete;

  /// Draws the pictures and ImGui's draw data, shows them, and waits until that is done. `wanted`: the host
  /// gets the pixels too, as pixels().
  Status show(std::span<const PlacedPicture> pictures, bool wanted);
  /// Of the last show that was wanted: red in the lowest byte.
  std::vector<std::uint32_t> pixels() const;
  PixelSize size() const { return size_; }

 private:
  explicit Canvas(std::shared_ptr<gpu::Device> device, Window& window)
      : device_(std::move(device)), window_(&window) {}
  Status makeFixed();
  Status makeRenderPass();
  Status startUi();
  Status makeImage();
  void clear(VkImage image);
  Status begin();
  Status submit(bool isShown);
  void recordPictures(std::span<const PlacedPicture> pictures);
  void recordUi();
  void recordReadBack();
  void recordShown(VkImage image);
  struct Use {
    VkImageLayout layout;
    VkPipelineStageFlags stage;
    VkAccessFlags access;
  };
  void change(VkImage image, const Use& before, const Use& after);

  using OwnedImage = gpu::Owned<VkImage, &VolkDeviceTable::vkDestroyImage>;
  using OwnedMemory = gpu::Owned<VkDeviceMemory, &VolkDeviceTable::vkFreeMemory>;
  using OwnedView = gpu::Owned<VkImageView, &VolkDeviceTable::vkDestroyImageView>;
  using OwnedFramebuffer = gpu::Owned<VkFramebuffer, &VolkDeviceTable::vkDestroyFramebuffer>;
  using OwnedRenderPass = gpu::Owned<VkRenderPass, &VolkDeviceTable::vkDestroyRenderPass>;

  std::shared_ptr<gpu::Device> device_;
  Window* window_;
  gpu::OwnedCommandPool pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  gpu::OwnedFence fence_;
  gpu::OwnedDescriptorPool descriptors_;  // ImGui's
  OwnedRenderPass renderPass_;
  bool hasUi_ = false;

  OwnedMemory memory_;
  OwnedImage image_;
  OwnedView view_;
  OwnedFramebuffer framebuffer_;
  std::optional<gpu::Buffer> readBack_;
  PixelSize size_;
};

}  // namespace ringlet::view
