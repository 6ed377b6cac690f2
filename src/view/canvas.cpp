// Implements view/canvas.h.
#include "view/canvas.h"

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>

#include <array>
#include <cstring>
#include <utility>

#include "ringlet/gpu/check.h"

namespace ringlet::view {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;  // of HairRenderer's pixels
constexpr VkImageSubresourceRange kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
constexpr VkImageSubresourceLayers kLayer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

VkExtent3D extentOf(PixelSize size) {
  return {static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height), 1};
}

}  // namespace

Result<std::unique_ptr<Canvas>> Canvas::create(std::shared_ptr<gpu::Device> device, Window& window) {
  std::unique_ptr<Canvas> self(new Canvas(std::move(device), window));
  for (const auto part : {&Canvas::makeFixed, &Canvas::makeRenderPass, &Canvas::startUi}) {
    if (Status made = (self.get()->*part)(); !made) return made.error();
  }
  return self;
}

Canvas::~Canvas() {
  (void)device_->vk().vkDeviceWaitIdle(device_->handle());
  if (!hasUi_) return;
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

Status Canvas::makeFixed() {
  const VolkDeviceTable& vk = device_->vk();
  auto poolInfo = gpu::zeroed<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  poolInfo.queueFamilyIndex = device_->queueFamily();
  VkCommandPool pool = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateCommandPool(device_->handle(), &poolInfo, nullptr, &pool),
                   "make the window's commands");
  pool_ = {device_, pool};
  auto commandInfo = gpu::zeroed<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commandInfo.commandPool = pool;
  commandInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commandInfo.commandBufferCount = 1;
  RINGLET_VK_CHECK(vk.vkAllocateCommandBuffers(device_->handle(), &commandInfo, &commands_),
                   "make the window's commands");
  const auto fenceInfo = gpu::zeroed<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  VkFence fence = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateFence(device_->handle(), &fenceInfo, nullptr, &fence),
                   "make the window's fence");
  fence_ = {device_, fence};
  const VkDescriptorPoolSize sizes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  auto setInfo = gpu::zeroed<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  setInfo.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  setInfo.maxSets = 4;
  setInfo.poolSizeCount = 1;
  setInfo.pPoolSizes = &sizes;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateDescriptorPool(device_->handle(), &setInfo, nullptr, &descriptors),
                   "make the panel's descriptors");
  descriptors_ = {device_, descriptors};
  return {};
}

// Over what is there; then it is copied from.
Status Canvas::makeRenderPass() {
  VkAttachmentDescription attachment{};
  attachment.format = kFormat;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  attachment.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkSubpassDependency after{};
  after.srcSubpass = 0;
  after.dstSubpass = VK_SUBPASS_EXTERNAL;
  after.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  after.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  after.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  after.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  auto info = gpu::zeroed<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &after;
  VkRenderPass pass = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device_->vk().vkCreateRenderPass(device_->handle(), &info, nullptr, &pass),
                   "make the panel's render pass");
  renderPass_ = {device_, pass};
  return {};
}

Status Canvas::startUi() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is kept between runs
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForVulkan(window_->handle(), true);
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device_->instance();
  info.PhysicalDevice = device_->physical();
  info.Device = device_->handle();
  info.QueueFamily = device_->queueFamily();
  info.Queue = device_->queue();
  info.DescriptorPool = descriptors_.get();
  info.MinImageCount = info.ImageCount = 2;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  ImGui_ImplVulkan_Init(&info, renderPass_.get());
  hasUi_ = true;
  if (Status begun = begin(); !begun) return begun;
  ImGui_ImplVulkan_CreateFontsTexture(commands_);
  if (Status done = submit(false); !done) return done;
  ImGui_ImplVulkan_DestroyFontUploadObjects();
  return {};
}

// As large as the window, black at first.
Status Canvas::makeImage() {
  const VolkDeviceTable& vk = device_->vk();
  const PixelSize size = window_->imageSize();
  auto info = gpu::zeroed<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = kFormat;
  info.extent = extentOf(size);
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage =
      VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  framebuffer_ = {}, view_ = {}, image_ = {}, memory_ = {};
  VkImage image = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateImage(device_->handle(), &info, nullptr, &image), "make the window's picture");
  image_ = {device_, image};
  VkMemoryRequirements wants;
  vk.vkGetImageMemoryRequirements(device_->handle(), image, &wants);
  auto memoryInfo = gpu::zeroed<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  memoryInfo.allocationSize = wants.size;
  while (!(wants.memoryTypeBits >> memoryInfo.memoryTypeIndex & 1)) ++memoryInfo.memoryTypeIndex;
  for (std::uint32_t type = device_->memory().memoryTypeCount; type-- > 0;) {
    const bool isLocal =
        device_->memory().memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    if ((wants.memoryTypeBits >> type & 1) && isLocal) memoryInfo.memoryTypeIndex = type;
  }
  VkDeviceMemory memory = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkAllocateMemory(device_->handle(), &memoryInfo, nullptr, &memory),
                   "make the window's picture");
  memory_ = {device_, memory};
  RINGLET_VK_CHECK(vk.vkBindImageMemory(device_->handle(), image, memory, 0), "make the window's picture");
  auto viewInfo = gpu::zeroed<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  viewInfo.image = image;
  viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
  viewInfo.format = kFormat;
  viewInfo.subresourceRange = kWhole;
  VkImageView view = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateImageView(device_->handle(), &viewInfo, nullptr, &view),
                   "make the window's picture");
  view_ = {device_, view};
  auto frameInfo = gpu::zeroed<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  frameInfo.renderPass = renderPass_.get();
  frameInfo.attachmentCount = 1;
  frameInfo.pAttachments = &view;
  frameInfo.width = info.extent.width;
  frameInfo.height = info.extent.height;
  frameInfo.layers = 1;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(vk.vkCreateFramebuffer(device_->handle(), &frameInfo, nullptr, &framebuffer),
                   "make the window's picture");
  framebuffer_ = {device_, framebuffer};
  auto readBack = gpu::Buffer::create(*device_, std::uint64_t{4} * info.extent.width * info.extent.height,
                                      gpu::BufferKind::stream, "picture of the window");
  if (!readBack) return readBack.error();
  readBack_.emplace(std::move(*readBack));
  size_ = size;
  clear(image);
  return {};
}

// To black, and to be copied from.
void Canvas::clear(VkImage image) {
  change(
      image, {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0},
      {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT});
  const VkClearColorValue black{{0, 0, 0, 1}};
  device_->vk().vkCmdClearColorImage(commands_, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1,
                                     &kWhole);
  change(image,
         {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT},
         {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT});
}

Status Canvas::begin() {
  auto info = gpu::zeroed<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  RINGLET_VK_CHECK(device_->vk().vkBeginCommandBuffer(commands_, &info), "record the window's commands");
  return {};
}

Status Canvas::submit(bool isShown) {
  const VolkDeviceTable& vk = device_->vk();
  RINGLET_VK_CHECK(vk.vkEndCommandBuffer(commands_), "record the window's commands");
  const VkSemaphore acquired = window_->acquired();
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
  auto info = gpu::zeroed<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands_;
  const VkSemaphore finished = isShown ? window_->finished() : VK_NULL_HANDLE;
  if (isShown) {
    info.waitSemaphoreCount = info.signalSemaphoreCount = 1;
    info.pWaitSemaphores = &acquired;
    info.pWaitDstStageMask = &stage;
    info.pSignalSemaphores = &finished;
  }
  const VkFence fence = fence_.get();
  RINGLET_VK_CHECK(vk.vkQueueSubmit(device_->queue(), 1, &info, fence), "draw the window");
  if (isShown) {
    if (Status shown = window_->present(); !shown) return shown;
  }
  RINGLET_VK_CHECK(vk.vkWaitForFences(device_->handle(), 1, &fence, VK_TRUE, ~0ull), "wait for the window");
  RINGLET_VK_CHECK(vk.vkResetFences(device_->handle(), 1, &fence), "wait for the window");
  return {};
}

void Canvas::change(VkImage image, const Use& before, const Use& after) {
  auto barrier = gpu::zeroed<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = before.access;
  barrier.dstAccessMask = after.access;
  barrier.oldLayout = before.layout;
  barrier.newLayout = after.layout;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = kWhole;
  device_->vk().vkCmdPipelineBarrier(commands_, before.stage, after.stage, 0, 0, nullptr, 0, nullptr, 1,
                                     &barrier);
}

void Canvas::recordPictures(std::span<const PlacedPicture> pictures) {
  const VolkDeviceTable& vk = device_->vk();
  auto drawn = gpu::zeroed<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  drawn.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  drawn.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  vk.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                          1, &drawn, 0, nullptr, 0, nullptr);
  change(
      image_.get(), {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, 0},
      {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT});
  for (const PlacedPicture& picture : pictures) {
    VkBufferImageCopy region{};
    region.bufferRowLength = static_cast<std::uint32_t>(picture.width);
    region.imageSubresource = kLayer;
    region.imageOffset = {picture.left, 0, 0};
    region.imageExtent = extentOf(
        {std::min(picture.width, size_.width - picture.left), std::min(picture.height, size_.height)});
    if (picture.left >= size_.width) continue;
    vk.vkCmdCopyBufferToImage(commands_, picture.pixels->handle(), image_.get(),
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  }
  change(image_.get(),
         {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT},
         {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
          VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT});
}

void Canvas::recordUi() {
  const VolkDeviceTable& vk = device_->vk();
  auto info = gpu::zeroed<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  info.renderPass = renderPass_.get();
  info.framebuffer = framebuffer_.get();
  info.renderArea.extent = {extentOf(size_).width, extentOf(size_).height};
  vk.vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands_);
  vk.vkCmdEndRenderPass(commands_);
}

void Canvas::recordReadBack() {
  VkBufferImageCopy region{};
  region.imageSubresource = kLayer;
  region.imageExtent = extentOf(size_);
  device_->vk().vkCmdCopyImageToBuffer(commands_, image_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       readBack_->handle(), 1, &region);
  auto seen = gpu::zeroed<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  seen.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  seen.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  device_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                                     1, &seen, 0, nullptr, 0, nullptr);
}

void Canvas::recordShown(VkImage image) {
  change(
      image, {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, 0},
      {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT});
  VkImageBlit region{};
  region.srcSubresource = region.dstSubresource = kLayer;
  region.srcOffsets[1] = {size_.width, size_.height, 1};
  region.dstOffsets[1] = {window_->imageSize().width, window_->imageSize().height, 1};
  device_->vk().vkCmdBlitImage(commands_, image_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
  change(image,
         {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT},
         {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0});
}

Status Canvas::show(std::span<const PlacedPicture> pictures, bool wanted) {
  auto image = window_->acquire();
  if (!image) return image.error();
  if (*image == VK_NULL_HANDLE) return {};
  if (Status begun = begin(); !begun) return begun;
  if (!(size_ == window_->imageSize())) {
    if (Status made = makeImage(); !made) return made;
  }
  recordPictures(pictures);
  recordUi();
  if (wanted) recordReadBack();
  recordShown(*image);
  return submit(true);
}

std::vector<std::uint32_t> Canvas::pixels() const {
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(size_.width) * size_.height);
  std::memcpy(pixels.data(), readBack_->mapped().data(), 4 * pixels.size());
  return pixels;
}

}  // namespace ringlet::view
