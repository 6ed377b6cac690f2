// A host, as an engine is one: it makes Vulkan's instance, device and queue itself, watched by the validation
// layer, and Ringlet works on them. It knows Ringlet's public headers only.
#define VK_NO_PROTOTYPES
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/simulation.h"
#include "ringlet_shaders/scale_values_test.h"

namespace ringlet::test {
namespace {

// Of the host's Vulkan, found by name.
struct Calls {
  PFN_vkGetInstanceProcAddr get = nullptr;
  VkInstance instance = VK_NULL_HANDLE;

  template <class Function>
  Function call(const char* name) const {
    const auto found = reinterpret_cast<Function>(get(instance, name));
    EXPECT_TRUE(found) << name;
    return found;
  }
};
#define CALL(name) calls_.call<PFN_##name>(#name)

VKAPI_ATTR VkBool32 VKAPI_CALL keep(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
  return VK_FALSE;
}

class Host {
 public:
  static constexpr std::uint32_t kVersion = VK_API_VERSION_1_3;

  // Without features: as a host does that never heard of what Ringlet would like.
  explicit Host(bool asksForNeeds) {
    void* library = dlopen("libvulkan.so.1", RTLD_NOW);
    calls_.get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    makeInstance();
    std::uint32_t count = 1;
    CALL(vkEnumeratePhysicalDevices)(calls_.instance, &count, &physical_);
    handles_ = {.getInstanceProcAddr = reinterpret_cast<void*>(calls_.get),
                .instance = calls_.instance,
                .physicalDevice = physical_,
                .apiVersion = kVersion};
    const auto needs = ComputeDevice::needs(handles_);
    EXPECT_TRUE(needs) << needs.error().message;
    handles_.queueFamily = needs->queueFamily;
    makeDevice(asksForNeeds ? *needs : HostVulkanNeeds{});
  }
  ~Host() {
    CALL(vkDestroyDevice)(device_, nullptr);
    CALL(vkDestroyDebugUtilsMessengerEXT)(calls_.instance, messenger_, nullptr);
    CALL(vkDestroyInstance)(calls_.instance, nullptr);
  }
  Host(const Host&) = delete;

  HostVulkan handles() { return handles_; }
  const std::shared_ptr<std::vector<std::string>>& messages() const { return messages_; }

  // Commands of the host's, handed to the queue; and until they are done.
  using Record = std::function<void(VkCommandBuffer)>;
  struct Work {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
  };
  Work submit(const Record& record);
  void wait(const Work& work);
  // What the host's own kernel finds in a buffer, after other commands of the same submission: it reads every
  // number, and a copy of it comes back.
  std::vector<std::uint32_t> read(
      VkBuffer source, std::uint64_t bytes, const Record& before = [](VkCommandBuffer) {});

 private:
  struct Owned {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
  };
  void makeInstance();
  void makeDevice(const HostVulkanNeeds& needs);
  Owned makeBuffer(std::uint64_t bytes, VkBufferUsageFlags usage);
  void drop(const Owned& owned) {
    CALL(vkDestroyBuffer)(device_, owned.buffer, nullptr);
    CALL(vkFreeMemory)(device_, owned.memory, nullptr);
  }

  Calls calls_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<std::vector<std::string>> messages_ = std::make_shared<std::vector<std::string>>();
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queueMutex_;
  HostVulkan handles_;
};

void Host::makeInstance() {
  const VkValidationFeatureEnableEXT synchronisation =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  const VkDebugUtilsMessengerCreateInfoEXT messenger{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .pNext = nullptr,
      .flags = 0,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = keep,
      .pUserData = messages_.get()};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = &messenger,
                                         .enabledValidationFeatureCount = 1,
                                         .pEnabledValidationFeatures = &synchronisation,
                                         .disabledValidationFeatureCount = 0,
                                         .pDisabledValidationFeatures = nullptr};
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = kVersion;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = &features;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = 1;
  info.ppEnabledLayerNames = &layer;
  info.enabledExtensionCount = extensions.size();
  info.ppEnabledExtensionNames = extensions.data();
  ASSERT_EQ(CALL(vkCreateInstance)(&info, nullptr, &calls_.instance), VK_SUCCESS);
  CALL(vkCreateDebugUtilsMessengerEXT)(calls_.instance, &messenger, nullptr, &messenger_);
}

void Host::makeDevice(const HostVulkanNeeds& needs) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = handles_.queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceSubgroupSizeControlFeatures sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES;
  sizes.subgroupSizeControl = needs.subgroupSizeControl;
  sizes.computeFullSubgroups = needs.computeFullSubgroups;
  std::vector<const char*> extensions;
  for (const std::string& extension : needs.extensions) extensions.push_back(extension.c_str());
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = needs.subgroupSizeControl || needs.computeFullSubgroups ? &sizes : nullptr;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  ASSERT_EQ(CALL(vkCreateDevice)(physical_, &info, nullptr, &device_), VK_SUCCESS);
  CALL(vkGetDeviceQueue)(device_, handles_.queueFamily, 0, &queue_);
  handles_.device = device_;
  handles_.queue = queue_;
  handles_.subgroupSizeControl = needs.subgroupSizeControl;
  handles_.computeFullSubgroups = needs.computeFullSubgroups;
  handles_.queueMutex = &queueMutex_;
}

Host::Owned Host::makeBuffer(std::uint64_t bytes, VkBufferUsageFlags usage) {
  Owned owned;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = usage;
  CALL(vkCreateBuffer)(device_, &info, nullptr, &owned.buffer);
  VkMemoryRequirements wants;
  CALL(vkGetBufferMemoryRequirements)(device_, owned.buffer, &wants);
  VkPhysicalDeviceMemoryProperties memory;
  CALL(vkGetPhysicalDeviceMemoryProperties)(physical_, &memory);
  constexpr VkMemoryPropertyFlags kSeen =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = wants.size;
  for (std::uint32_t type = memory.memoryTypeCount; type-- > 0;) {
    if ((wants.memoryTypeBits >> type & 1) && (memory.memoryTypes[type].propertyFlags & kSeen) == kSeen)
      allocation.memoryTypeIndex = type;
  }
  CALL(vkAllocateMemory)(device_, &allocation, nullptr, &owned.memory);
  CALL(vkBindBufferMemory)(device_, owned.buffer, owned.memory, 0);
  CALL(vkMapMemory)(device_, owned.memory, 0, VK_WHOLE_SIZE, 0, &owned.mapped);
  std::memset(owned.mapped, 0, bytes);
  return owned;
}

Host::Work Host::submit(const Record& record) {
  Work work;
  VkCommandPoolCreateInfo commandInfo{};
  commandInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  commandInfo.queueFamilyIndex = handles_.queueFamily;
  CALL(vkCreateCommandPool)(device_, &commandInfo, nullptr, &work.pool);
  VkCommandBufferAllocateInfo allocateCommands{};
  allocateCommands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocateCommands.commandPool = work.pool;
  allocateCommands.commandBufferCount = 1;
  VkCommandBuffer commands;
  CALL(vkAllocateCommandBuffers)(device_, &allocateCommands, &commands);
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  CALL(vkBeginCommandBuffer)(commands, &begin);
  record(commands);
  CALL(vkEndCommandBuffer)(commands);
  VkFenceCreateInfo fenceInfo{};
  fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  CALL(vkCreateFence)(device_, &fenceInfo, nullptr, &work.fence);
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  {
    const std::lock_guard lock(queueMutex_);
    CALL(vkQueueSubmit)(queue_, 1, &submit, work.fence);
  }
  return work;
}

void Host::wait(const Work& work) {
  CALL(vkWaitForFences)(device_, 1, &work.fence, VK_TRUE, ~0ull);
  CALL(vkDestroyFence)(device_, work.fence, nullptr);
  CALL(vkDestroyCommandPool)(device_, work.pool, nullptr);
}

std::vector<std::uint32_t> Host::read(VkBuffer source, std::uint64_t bytes, const Record& before) {
  const Owned target = makeBuffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Owned shift = makeBuffer(16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);

  std::array<VkDescriptorSetLayoutBinding, 3> bindings{};
  std::array<VkDescriptorBufferInfo, 3> buffers{
      {{source, 0, bytes}, {target.buffer, 0, bytes}, {shift.buffer, 0, 16}}};
  std::array<VkWriteDescriptorSet, 3> writes{};
  const std::array<VkDescriptorPoolSize, 2> sizes{
      {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}, {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}}};
  for (std::uint32_t b = 0; b < 3; ++b) {
    bindings[b] = {b, b < 2 ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1,
                   VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo setInfo{};
  setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setInfo.bindingCount = 3;
  setInfo.pBindings = bindings.data();
  VkDescriptorSetLayout setLayout;
  CALL(vkCreateDescriptorSetLayout)(device_, &setInfo, nullptr, &setLayout);
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
  VkPipelineLayoutCreateInfo layoutInfo{};
  layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &setLayout;
  layoutInfo.pushConstantRangeCount = 1;
  layoutInfo.pPushConstantRanges = &push;
  VkPipelineLayout layout;
  CALL(vkCreatePipelineLayout)(device_, &layoutInfo, nullptr, &layout);

  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = sizeof(k_scale_values_test);
  moduleInfo.pCode = k_scale_values_test;
  VkShaderModule module;
  CALL(vkCreateShaderModule)(device_, &moduleInfo, nullptr, &module);
  const std::uint32_t groupSize = 64;
  const VkSpecializationMapEntry entry{0, 0, 4};
  const VkSpecializationInfo special{1, &entry, 4, &groupSize};
  VkComputePipelineCreateInfo pipelineInfo{};
  pipelineInfo.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  pipelineInfo.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  pipelineInfo.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipelineInfo.stage.module = module;
  pipelineInfo.stage.pName = "main";
  pipelineInfo.stage.pSpecializationInfo = &special;
  pipelineInfo.layout = layout;
  VkPipeline pipeline;
  CALL(vkCreateComputePipelines)(device_, VK_NULL_HANDLE, 1, &pipelineInfo, nullptr, &pipeline);

  VkDescriptorPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = 2;
  poolInfo.pPoolSizes = sizes.data();
  VkDescriptorPool pool;
  CALL(vkCreateDescriptorPool)(device_, &poolInfo, nullptr, &pool);
  VkDescriptorSetAllocateInfo allocateSet{};
  allocateSet.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocateSet.descriptorPool = pool;
  allocateSet.descriptorSetCount = 1;
  allocateSet.pSetLayouts = &setLayout;
  VkDescriptorSet set;
  CALL(vkAllocateDescriptorSets)(device_, &allocateSet, &set);
  for (std::uint32_t b = 0; b < 3; ++b) {
    writes[b] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                 nullptr,
                 set,
                 b,
                 0,
                 1,
                 bindings[b].descriptorType,
                 nullptr,
                 &buffers[b],
                 nullptr};
  }
  CALL(vkUpdateDescriptorSets)(device_, 3, writes.data(), 0, nullptr);

  const auto count = static_cast<std::uint32_t>(bytes / 4);
  const auto record = [&](VkCommandBuffer commands) {
    before(commands);
    // As DevicePositions asks for.
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    CALL(vkCmdPipelineBarrier)
    (commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &barrier, 0,
     nullptr, 0, nullptr);
    CALL(vkCmdBindPipeline)(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    CALL(vkCmdBindDescriptorSets)
    (commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    const std::array<std::uint32_t, 2> countAndFactor{count, 1};
    CALL(vkCmdPushConstants)(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, 8, countAndFactor.data());
    CALL(vkCmdDispatch)(commands, (count + groupSize - 1) / groupSize, 1, 1);
  };
  wait(submit(record));
  std::vector<std::uint32_t> values(count);
  std::memcpy(values.data(), target.mapped, bytes);

  CALL(vkDestroyDescriptorPool)(device_, pool, nullptr);
  CALL(vkDestroyPipeline)(device_, pipeline, nullptr);
  CALL(vkDestroyShaderModule)(device_, module, nullptr);
  CALL(vkDestroyPipelineLayout)(device_, layout, nullptr);
  CALL(vkDestroyDescriptorSetLayout)(device_, setLayout, nullptr);
  drop(target);
  drop(shift);
  return values;
}

HeadPose headAt(int which, double t) {
  return {Vec3d{which ? -0.3 : 0.5, 0.1, 0} * t, fromRotationVector(Vec3d{0, 4, 1} * t)};
}

Result<HairAsset> assetOn(const ComputeDevice& device, bool contacts = true) {
  HeadParameters parameters;
  parameters.strandCount = 40;
  parameters.curl.particleCount = 24;
  Settings settings;
  settings.contacts.on = contacts;
  return HairAsset::build(device, *makeHead(parameters), {}, settings);
}

// As a host's kernel reads them.
void expectPositions(const std::vector<std::uint32_t>& found, const DevicePositions& chunk,
                     const std::vector<Vec3f>& wanted) {
  ASSERT_EQ(chunk.particles.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Vec3f& p = wanted[chunk.particles[i]];
    ASSERT_EQ(std::memcmp(&found[4 * i], &p, sizeof(p)), 0) << "particle " << i;
  }
}

// Two heads of one asset for 60 frames, on a device opened as Ringlet asks for and on one that has nothing
// switched on. After each frame the host's own kernel finds what a device of Ringlet's own comes to.
TEST(AdoptedDevice, AHostReadsPositionsWithItsOwnKernel) {
  constexpr int kFrames = 60;
  for (const bool asksForNeeds : {true, false}) {
    SCOPED_TRACE(asksForNeeds);
    auto host = std::make_unique<Host>(asksForNeeds);
    const auto messages = host->messages();
    {
      const auto device = ComputeDevice::adopt(host->handles());
      ASSERT_TRUE(device) << device.error().message;
      const auto asset = assetOn(*device);
      ASSERT_TRUE(asset) << asset.error().message;
      const auto own = ComputeDevice::open();
      ASSERT_TRUE(own) << own.error().message;
      const auto ownAsset = assetOn(*own);
      std::vector<Simulation> heads, expected;
      for (int which = 0; which < 2; ++which) {
        auto made = Simulation::create(*asset, {.head = headAt(which, 0), .readsBack = false});
        ASSERT_TRUE(made) << made.error().message;
        heads.push_back(std::move(*made));
        expected.push_back(*Simulation::create(*ownAsset, {.head = headAt(which, 0)}));
      }
      for (int frame = 1; frame <= kFrames; ++frame) {
        for (int which = 0; which < 2; ++which) {
          ASSERT_TRUE(heads[which].stepFrame(headAt(which, frame / 24.0)));
          ASSERT_TRUE(expected[which].stepFrame(headAt(which, frame / 24.0)));
        }
        for (int which = 0; which < 2; ++which) {
          const std::vector<Vec3f> wanted = *expected[which].positions();
          const std::vector<DevicePositions> chunks = heads[which].devicePositions();
          ASSERT_EQ(chunks.size(), 1u);
          const auto found = host->read(static_cast<VkBuffer>(chunks[0].buffer), chunks[0].bytes);
          expectPositions(found, chunks[0], wanted);
          if (frame == kFrames) {
            EXPECT_EQ(*heads[which].positions(), wanted) << "without being read back each frame";
            EXPECT_LT(heads[which].memory().frames, expected[which].memory().frames);
          }
        }
      }
    }
    host.reset();  // everything of Ringlet's is gone, or the layer says so
    EXPECT_EQ(*messages, std::vector<std::string>{});
  }
}

std::vector<HeadPose> posesOf(int which, int frame) {
  const int steps = Settings{}.stepsPerFrame;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= steps; ++k) poses.push_back(headAt(which, (frame - 1 + double(k) / steps) / 24.0));
  return poses;
}

// Two heads of one asset for 60 frames in commands of the host's, which read what they find there. With
// contacts one frame is under way at a time, without them two.
TEST(AdoptedDevice, AHostRecordsFramesIntoItsOwnCommands) {
  constexpr int kFrames = 60;
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts);
    auto host = std::make_unique<Host>(true);
    const auto messages = host->messages();
    {
      const auto device = ComputeDevice::adopt(host->handles());
      ASSERT_TRUE(device) << device.error().message;
      const auto asset = assetOn(*device, contacts);
      ASSERT_TRUE(asset) << asset.error().message;
      const auto ownAsset = assetOn(*ComputeDevice::open(), contacts);
      std::vector<Simulation> heads, expected;
      for (int which = 0; which < 2; ++which) {
        heads.push_back(*Simulation::create(*asset, {.head = headAt(which, 0), .readsBack = which == 0}));
        expected.push_back(*Simulation::create(*ownAsset, {.head = headAt(which, 0)}));
      }
      std::deque<Host::Work> underWay;
      std::deque<std::vector<Vec3f>> wanted;
      for (int frame = 1; frame <= kFrames; ++frame) {
        SCOPED_TRACE(frame);
        const std::vector<HeadPose> poses[2] = {posesOf(0, frame), posesOf(1, frame)};
        for (int which = 0; which < 2; ++which) ASSERT_TRUE(expected[which].stepFrame(poses[which]));
        wanted.push_back(*expected[0].positions());
        const auto record = [&](VkCommandBuffer commands) {
          const Status status =
              recordFrames(std::vector<HairFrame>{{&heads[0], poses[0]}, {&heads[1], poses[1]}}, commands);
          EXPECT_TRUE(status) << status.error().message;
        };
        underWay.push_back(host->submit(record));
        EXPECT_FALSE(heads[0].positions()) << "nobody has said that the frame is over";
        for (; underWay.size() > (contacts || frame == kFrames ? 0 : 1); underWay.pop_front()) {
          host->wait(underWay.front());
          for (Simulation& head : heads) {
            const Status over = head.frameIsOver();
            ASSERT_TRUE(over) << over.error().message;
          }
          EXPECT_EQ(heads[0].framePositions(), wanted.front());
          wanted.pop_front();
        }
        if (!contacts && frame % 20 != 0) continue;
        for (; !underWay.empty(); underWay.pop_front()) {
          host->wait(underWay.front());
          for (Simulation& head : heads) ASSERT_TRUE(head.frameIsOver());
          wanted.pop_front();
        }
        const DevicePositions chunk = heads[1].devicePositions()[0];
        expectPositions(host->read(static_cast<VkBuffer>(chunk.buffer), chunk.bytes), chunk,
                        *expected[1].positions());
      }
      for (int which = 0; which < 2; ++which) {
        EXPECT_EQ(heads[which].state()->positions, expected[which].state()->positions);
        EXPECT_EQ(heads[which].state()->velocities, expected[which].state()->velocities);
      }
    }
    host.reset();
    EXPECT_EQ(*messages, std::vector<std::string>{});
  }
}

// In the submission that steps the hair.
TEST(AdoptedDevice, AHostReadsAFrameInTheSameCommands) {
  Host host(true);
  {
    const auto device = ComputeDevice::adopt(host.handles());
    auto hair = Simulation::create(*assetOn(*device, false), {.head = headAt(0, 0), .readsBack = false});
    auto expected = Simulation::create(*assetOn(*ComputeDevice::open(), false), {.head = headAt(0, 0)});
    const DevicePositions chunk = hair->devicePositions()[0];
    for (int frame = 1; frame <= 5; ++frame) {
      const std::vector<HeadPose> poses = posesOf(0, frame);
      const auto found = host.read(static_cast<VkBuffer>(chunk.buffer), chunk.bytes, [&](auto commands) {
        ASSERT_TRUE(recordFrames(std::vector<HairFrame>{{&*hair, poses}}, commands));
      });
      ASSERT_TRUE(hair->frameIsOver());
      ASSERT_TRUE(expected->stepFrame(poses));
      expectPositions(found, chunk, *expected->positions());
    }
  }
  EXPECT_EQ(*host.messages(), std::vector<std::string>{});
}

// What cannot be recorded changes nothing: the frames that can go on as if it had not been asked for.
TEST(AdoptedDevice, AHostIsToldWhatItCannotRecord) {
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts);
    Host host(true);
    {
      const auto device = ComputeDevice::adopt(host.handles());
      auto hair = *Simulation::create(*assetOn(*device, contacts), {.head = headAt(0, 0)});
      auto expected = *Simulation::create(*assetOn(*ComputeDevice::open(), contacts), {.head = headAt(0, 0)});
      const std::vector<HeadPose> jump(posesOf(0, 1).size(), HeadPose{Vec3d{50, 0, 0}, {}});
      std::vector<Host::Work> works;
      const auto step = [&](const std::vector<HeadPose>& poses) {
        Status status;
        works.push_back(host.submit([&](VkCommandBuffer commands) {
          status = recordFrames(std::vector<HairFrame>{{&hair, poses}}, commands);
        }));
        return status;
      };
      EXPECT_TRUE(hair.frameIsOver()) << "there is none";
      const int most = contacts ? 1 : 2;
      for (int frame = 1; frame <= most; ++frame) {
        ASSERT_TRUE(step(posesOf(0, frame)));
        ASSERT_TRUE(expected.stepFrame(posesOf(0, frame)));
      }
      const Status tooMany = step(posesOf(0, most + 1)), whileJumping = step(jump);
      EXPECT_FALSE(tooMany);
      EXPECT_FALSE(whileJumping);
      EXPECT_NE(tooMany.error().message.find("call frameIsOver"), std::string::npos);
      EXPECT_NE(whileJumping.error().message.find("call frameIsOver"), std::string::npos);
      const auto early = hair.positions();
      ASSERT_FALSE(early);
      EXPECT_NE(early.error().message.find("call frameIsOver"), std::string::npos);
      for (const Host::Work& work : works) host.wait(work);
      works.clear();
      for (int frame = 1; frame <= most; ++frame) ASSERT_TRUE(hair.frameIsOver());
      EXPECT_EQ(*hair.positions(), *expected.positions());
      ASSERT_TRUE(step(jump));
      ASSERT_TRUE(expected.stepFrame(jump));
      ASSERT_TRUE(hair.frameIsOver()) << "a jump is none of the device's";
      EXPECT_EQ(*hair.positions(), *expected.positions());
      for (const Host::Work& work : works) host.wait(work);
    }
    EXPECT_EQ(*host.messages(), std::vector<std::string>{});
  }
}

TEST(AdoptedDevice, SaysWhatAHostLacks) {
  Host host(true);
  HostVulkan handles = host.handles();
  handles.queueFamily = 99;
  auto refused = ComputeDevice::adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("of family 99, which does not compute"), std::string::npos)
      << refused.error().message;
  handles = host.handles();
  handles.device = nullptr;
  refused = ComputeDevice::adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "a host hands over no physical device, no device or no queue");
  handles.instance = nullptr;
  EXPECT_FALSE(ComputeDevice::adopt(handles));
  EXPECT_FALSE(ComputeDevice::needs(handles));
  handles = host.handles();
  handles.apiVersion = VK_API_VERSION_1_0;
  const auto needs = ComputeDevice::needs(handles);
  ASSERT_FALSE(needs);
  EXPECT_NE(needs.error().message.find("the instance was made for Vulkan 1.0.0, needed is 1.1"),
            std::string::npos)
      << needs.error().message;
}

}  // namespace
}  // namespace ringlet::test
