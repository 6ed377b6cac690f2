// Window: one window of the desktop (GLFW), its Vulkan surface and swapchain, and the images that go there.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/owned.h"

struct GLFWwindow;

namespace ringlet::view {

struct PixelSize {
  int width = 0, height = 0;
  bool operator==(const PixelSize&) const = default;
};

class Window {
 public:
  /// Errors: there is no display, or it has no Vulkan; the message says what to do.
  static Result<std::unique_ptr<Window>> open(PixelSize size, const std::string& title);
  ~Window();
  Window(const Window&) = delete;

  /// How the device has to be opened that draws here.
  gpu::DeviceOptions deviceOptions() const;
  /// Makes the surface and the swapchain; before that nothing can be shown. Errors: the device cannot draw
  /// here.
  Status attach(std::shared_ptr<gpu::Device> device);

  GLFWwindow* handle() const { return window_; }
  PixelSize size() const;  // of what can be drawn on
  bool isClosed() const;
  /// Keys that were pressed since the last call, however short: GLFW's number and modifiers of each.
  struct Key {
    int key = 0, modifiers = 0;
  };
  std::vector<Key> takeKeys();

  /// The next image to be drawn on; null where none can be had now, as in a window without an area.
  /// `acquired` is signalled when it is free.
  Result<VkImage> acquire();
  VkSemaphore acquired() const { return acquired_.get(); }
  VkSemaphore finished() const { return finished_[image_].get(); }
  PixelSize imageSize() const { return swapchainSize_; }
  /// Shows the image after `finished`.
  Status present();

 private:
  using OwnedSemaphore = gpu::Owned<VkSemaphore, &VolkDeviceTable::vkDestroySemaphore>;
  using OwnedSwapchain = gpu::Owned<VkSwapchainKHR, &VolkDeviceTable::vkDestroySwapchainKHR>;

  Window() = default;
  Status makeSwapchain();
  Result<VkSurfaceFormatKHR> chooseFormat() const;
  Result<OwnedSemaphore> makeSemaphore() const;

  GLFWwindow* window_ = nullptr;
  std::vector<Key> keys_;
  std::shared_ptr<gpu::Device> device_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
  OwnedSwapchain swapchain_;
  std::vector<VkImage> images_;
  OwnedSemaphore acquired_;
  std::vector<OwnedSemaphore> finished_;  // one an image
  PixelSize swapchainSize_, askedSize_;   // askedSize_: of the window when it was made
  std::uint32_t image_ = 0;
};

}  // namespace ringlet::view
