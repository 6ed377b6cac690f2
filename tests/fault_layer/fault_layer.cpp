// A Vulkan layer that lets calls fail, so that tests see what becomes of a run whose device is lost or full:
//
//   VK_LAYER_PATH=FOLDER VK_INSTANCE_LAYERS=VK_LAYER_RINGLET_fault RINGLET_FAULT=vkQueueSubmit:17:-4 ringlet
//   ...
//
// The 17th call of vkQueueSubmit, and all after it, return -4, VK_ERROR_DEVICE_LOST, without reaching the
// driver. With `hang` for the number they do not return.
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

// One instance and one device at a time are enough for the programs under test.
PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
VkInstance theInstance = VK_NULL_HANDLE;
VkDevice theDevice = VK_NULL_HANDLE;

struct Fault {
  std::string call;
  long at = 0;
  VkResult result = VK_SUCCESS;
  bool hangs = false;
};

const Fault& fault() {
  static const Fault asked = [] {
    Fault parsed;
    const char* text = std::getenv("RINGLET_FAULT");
    if (!text) return parsed;
    const std::string all = text;
    const std::size_t first = all.find(':'), second = all.find(':', first + 1);
    parsed.call = all.substr(0, first);
    parsed.at = std::atol(all.c_str() + first + 1);
    parsed.hangs = all.substr(second + 1) == "hang";
    parsed.result = static_cast<VkResult>(std::atol(all.c_str() + second + 1));
    return parsed;
  }();
  return asked;
}

bool failsNow() {
  static std::atomic<long> calls = 0;
  const bool isTime = ++calls >= fault().at;
  while (isTime && fault().hangs) sleep(1);
  return isTime;
}

template <class Function>
Function nextOf(const char* name) {
  return reinterpret_cast<Function>(nextDeviceProc(theDevice, name));
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, uint32_t count, const VkSubmitInfo* submits,
                                           VkFence fence) {
  if (failsNow()) return fault().result;
  return nextOf<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, uint32_t count, const VkFence* fences,
                                             VkBool32 all, uint64_t timeout) {
  if (failsNow()) return fault().result;
  return nextOf<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* callbacks,
                                              VkDeviceMemory* memory) {
  if (failsNow()) return fault().result;
  return nextOf<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, callbacks, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* callbacks,
                                                      VkPipeline* pipelines) {
  if (failsNow()) return fault().result;
  return nextOf<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(device, cache, count, infos,
                                                                          callbacks, pipelines);
}

PFN_vkVoidFunction failing(const char* name) {
  if (fault().call != name) return nullptr;
  if (std::strcmp(name, "vkQueueSubmit") == 0) return reinterpret_cast<PFN_vkVoidFunction>(queueSubmit);
  if (std::strcmp(name, "vkWaitForFences") == 0) return reinterpret_cast<PFN_vkVoidFunction>(waitForFences);
  if (std::strcmp(name, "vkAllocateMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(allocateMemory);
  if (std::strcmp(name, "vkCreateComputePipelines") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(createComputePipelines);
  return nullptr;
}

// The loader's link to what comes next.
template <class LayerInfo, class CreateInfo>
LayerInfo* linkOf(const CreateInfo* info, VkStructureType type) {
  auto* chain = const_cast<void*>(info->pNext);
  while (chain) {
    auto* layer = static_cast<LayerInfo*>(chain);
    if (layer->sType == type && layer->function == VK_LAYER_LINK_INFO) return layer;
    chain = const_cast<void*>(layer->pNext);
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkInstance* instance) {
  auto* link = linkOf<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, callbacks, instance);
  theInstance = *instance;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = linkOf<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  nextDeviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(nextInstanceProc(theInstance, "vkCreateDevice"));
  const VkResult result = create(physical, info, callbacks, device);
  theDevice = *device;
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(deviceProc);
  if (const auto function = failing(name)) return function;
  return nextDeviceProc(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(instanceProc);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(deviceProc);
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(createInstance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(createDevice);
  return nextInstanceProc ? nextInstanceProc(instance, name) : nullptr;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
  interface->loaderLayerInterfaceVersion = 2;
  interface->pfnGetInstanceProcAddr = instanceProc;
  interface->pfnGetDeviceProcAddr = deviceProc;
  interface->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
