// Implements view/window.h.
#include "view/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ringlet/gpu/check.h"

namespace ringlet::view {
namespace {

// What GLFW said last, on the one thread that has windows.
std::string& lastError() {
  static std::string text;
  return text;
}

Error withoutWindow(const char* attempt) {
  return Error{fmt::format(
      "cannot {}: {}. Run it in a desktop session, or without one under `xvfb-run -a` (Debian: xvfb); "
      "`ringlet render` makes pictures without a window",
      attempt, lastError().empty() ? "GLFW does not say why" : lastError())};
}

template <class Function>
Function instanceFunction(const gpu::Device& device, const char* name) {
  return reinterpret_cast<Function>(glfwGetInstanceProcAddress(device.instance(), name));
}
#define INSTANCE_CALL(name) instanceFunction<PFN_##name>(*device_, #name)

}  // namespace

Result<std::unique_ptr<Window>> Window::open(PixelSize size, const std::string& title) {
  glfwSetErrorCallback([](int, const char* text) { lastError() = text; });
  if (!glfwInit()) return withoutWindow("open a window");
  std::unique_ptr<Window> self(new Window);
  if (!glfwVulkanSupported()) return withoutWindow("draw in a window with Vulkan");
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  self->window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (!self->window_) return withoutWindow("open a window");
  // Before ImGui's, which calls this one; ImGui itself misses keys that are let go within a frame.
  glfwSetWindowUserPointer(self->window_, self.get());
  glfwSetKeyCallback(self->window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action != GLFW_PRESS) return;
    static_cast<Window*>(glfwGetWindowUserPointer(window))->keys_.push_back({key, modifiers});
  });
  return self;
}

std::vector<Window::Key> Window::takeKeys() { return std::exchange(keys_, {}); }

Window::~Window() {
  swapchain_ = {};
  if (surface_) INSTANCE_CALL(vkDestroySurfaceKHR)(device_->instance(), surface_, nullptr);
  if (window_) glfwDestroyWindow(window_);
  glfwTerminate();
}

gpu::DeviceOptions Window::deviceOptions() const {
  gpu::DeviceOptions options;
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  options.instanceExtensions.assign(names, names + count);
  options.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  options.wantsGraphics = true;
  return options;
}

Status Window::attach(std::shared_ptr<gpu::Device> device) {
  device_ = std::move(device);
  const VkResult made = glfwCreateWindowSurface(device_->instance(), window_, nullptr, &surface_);
  if (made != VK_SUCCESS) return withoutWindow("draw in a window with Vulkan");
  VkBool32 isPossible = VK_FALSE;
  RINGLET_VK_CHECK(INSTANCE_CALL(vkGetPhysicalDeviceSurfaceSupportKHR)(
                       device_->physical(), device_->queueFamily(), surface_, &isPossible),
                   "ask whether a device shows pictures in a window");
  if (!isPossible)
    return Error{fmt::format(
        "the Vulkan device {} cannot show pictures in this window; choose another with --device, of those "
        "that `ringlet devices` lists",
        device_->properties().name)};
  auto semaphore = makeSemaphore();
  if (!semaphore) return semaphore.error();
  acquired_ = std::move(*semaphore);
  return makeSwapchain();
}

PixelSize Window::size() const {
  PixelSize size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

bool Window::isClosed() const { return glfwWindowShouldClose(window_) != 0; }

Result<Window::OwnedSemaphore> Window::makeSemaphore() const {
  const auto info = gpu::zeroed<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
  VkSemaphore semaphore = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device_->vk().vkCreateSemaphore(device_->handle(), &info, nullptr, &semaphore),
                   "make a semaphore of the window");
  return OwnedSemaphore(device_, semaphore);
}

// Pictures are encoded for screens already: a format that would do so again is the last choice.
Result<VkSurfaceFormatKHR> Window::chooseFormat() const {
  const auto list = INSTANCE_CALL(vkGetPhysicalDeviceSurfaceFormatsKHR);
  std::uint32_t count = 0;
  RINGLET_VK_CHECK(list(device_->physical(), surface_, &count, nullptr), "list the window's formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  RINGLET_VK_CHECK(list(device_->physical(), surface_, &count, formats.data()), "list the window's formats");
  if (formats.empty()) return Error{"the window has no format that pictures could have"};
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
    const auto found = std::ranges::find(formats, wanted, &VkSurfaceFormatKHR::format);
    if (found != formats.end()) return *found;
  }
  return formats.front();
}

Status Window::makeSwapchain() {
  askedSize_ = size();
  swapchainSize_ = {};
  VkSurfaceCapabilitiesKHR can{};
  RINGLET_VK_CHECK(
      INSTANCE_CALL(vkGetPhysicalDeviceSurfaceCapabilitiesKHR)(device_->physical(), surface_, &can),
      "ask what the window can show");
  const auto format = chooseFormat();
  if (!format) return format.error();
  auto info = gpu::zeroed<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = surface_;
  info.minImageCount = can.minImageCount + 1;
  if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format->format;
  info.imageColorSpace = format->colorSpace;
  const bool isFree = can.currentExtent.width == 0xffffffffu;  // then the size is ours to choose
  info.imageExtent = isFree ? VkExtent2D{static_cast<std::uint32_t>(askedSize_.width),
                                         static_cast<std::uint32_t>(askedSize_.height)}
                            : can.currentExtent;
  if (info.imageExtent.width == 0 || info.imageExtent.height == 0) return {};  // minimised
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_.get();
  VkSwapchainKHR made = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device_->vk().vkCreateSwapchainKHR(device_->handle(), &info, nullptr, &made),
                   "make the window's images");
  swapchain_ = OwnedSwapchain(device_, made);
  std::uint32_t count = 0;
  RINGLET_VK_CHECK(device_->vk().vkGetSwapchainImagesKHR(device_->handle(), made, &count, nullptr),
                   "list the window's images");
  images_.resize(count);
  RINGLET_VK_CHECK(device_->vk().vkGetSwapchainImagesKHR(device_->handle(), made, &count, images_.data()),
                   "list the window's images");
  finished_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    auto semaphore = makeSemaphore();
    if (!semaphore) return semaphore.error();
    finished_.push_back(std::move(*semaphore));
  }
  swapchainSize_ = {static_cast<int>(info.imageExtent.width), static_cast<int>(info.imageExtent.height)};
  return {};
}

Result<VkImage> Window::acquire() {
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (swapchainSize_ == PixelSize{} || !(askedSize_ == size())) {
      (void)device_->vk().vkDeviceWaitIdle(device_->handle());
      if (Status made = makeSwapchain(); !made) return made.error();
      if (swapchainSize_ == PixelSize{}) return VkImage{VK_NULL_HANDLE};
    }
    const VkResult result = device_->vk().vkAcquireNextImageKHR(device_->handle(), swapchain_.get(), ~0ull,
                                                                acquired_.get(), VK_NULL_HANDLE, &image_);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) return images_[image_];
    if (result != VK_ERROR_OUT_OF_DATE_KHR)
      return gpu::vulkanError("vkAcquireNextImageKHR", result, "get the window's next image");
    swapchainSize_ = {};
  }
  return VkImage{VK_NULL_HANDLE};
}

Status Window::present() {
  const VkSemaphore finishedImage = finished();
  const VkSwapchainKHR swapchain = swapchain_.get();
  auto info = gpu::zeroed<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &finishedImage;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &image_;
  const VkResult result = device_->vk().vkQueuePresentKHR(device_->queue(), &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
    swapchainSize_ = {};
    return {};
  }
  if (result != VK_SUCCESS) return gpu::vulkanError("vkQueuePresentKHR", result, "show the window's image");
  return {};
}

}  // namespace ringlet::view
