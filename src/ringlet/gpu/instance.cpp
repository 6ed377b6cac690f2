// Implements gpu/instance.h.
#include "ringlet/gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "ringlet/gpu/check.h"

namespace ringlet::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// Volk's global functions, filled once: they lead to every instance alike.
std::mutex loaderMutex;
bool isLoaderOpen = false;
bool areInstanceFunctionsLoaded = false;

Status openLoader() {
  const std::lock_guard lock(loaderMutex);
  if (isLoaderOpen) return {};
  if (volkInitialize() != VK_SUCCESS) {
    return Error{
        "no Vulkan on this machine: the Vulkan loader (libvulkan.so.1) was not found. Install it and a "
        "driver, on Debian the packages libvulkan1 and mesa-vulkan-drivers"};
  }
  isLoaderOpen = true;
  return {};
}

// A host's loader is the one that this process has, or the first.
void useLoader(PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
  const std::lock_guard lock(loaderMutex);
  if (isLoaderOpen) return;
  volkInitializeCustom(getInstanceProcAddr);
  isLoaderOpen = true;
}

void loadInstanceFunctions(VkInstance instance) {
  const std::lock_guard lock(loaderMutex);
  if (areInstanceFunctionsLoaded) return;
  volkLoadInstanceOnly(instance);
  areInstanceFunctionsLoaded = true;
}

template <class Extension>
bool contains(const std::vector<Extension>& extensions, const char* name) {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const Extension& e) { return std::strcmp(e.extensionName, name) == 0; });
}

Result<std::vector<VkExtensionProperties>> instanceExtensions(const char* layer) {
  std::vector<VkExtensionProperties> extensions;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    RINGLET_VK_CHECK(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr),
                     "list Vulkan's extensions");
    extensions.resize(count);
    result = vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
    extensions.resize(count);
  }
  if (result != VK_SUCCESS) {
    return vulkanError("vkEnumerateInstanceExtensionProperties", result, "list Vulkan's extensions");
  }
  return extensions;
}

Result<bool> hasValidationLayer() {
  std::vector<VkLayerProperties> layers;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    RINGLET_VK_CHECK(vkEnumerateInstanceLayerProperties(&count, nullptr), "list Vulkan's layers");
    layers.resize(count);
    result = vkEnumerateInstanceLayerProperties(&count, layers.data());
    layers.resize(count);
  }
  if (result != VK_SUCCESS)
    return vulkanError("vkEnumerateInstanceLayerProperties", result, "list Vulkan's layers");
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& l) {
    return std::strcmp(l.layerName, kValidationLayer) == 0;
  });
}

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  static_cast<ValidationLog*>(log)->add(data->pMessage ? data->pMessage : "(a message without text)");
  return VK_FALSE;  // go on with the call
}

// Warnings and errors about our use of Vulkan. Left out: plain information, and the type `general`, by which
// the loader speaks of other drivers' broken installations.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog* log) {
  auto info =
      zeroed<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = keepMessage;
  info.pUserData = log;
  return info;
}

// A loader of Vulkan 1.0 refuses applications that ask for more.
Status checkLoader(std::uint32_t version) {
  if (version >= VK_API_VERSION_1_1) return {};
  return Error{fmt::format(
      "the Vulkan loader of this machine is of version {}.{}; 1.1 or newer is needed: update it (on Debian "
      "the package libvulkan1)",
      VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version))};
}

// What an instance is made with.
struct SwitchedOn {
  std::vector<const char*> extensions, layers;
  VkInstanceCreateFlags flags = 0;
  bool debugUtils = false;
};

Result<SwitchedOn> switchedOn(bool validation, std::span<const std::string> wanted) {
  auto extensions = instanceExtensions(nullptr);
  if (!extensions) return extensions.error();
  SwitchedOn on;
  // Drivers that put Vulkan on top of another interface (MoltenVK) are shown only to those who ask.
  if (contains(*extensions, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
    on.extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    on.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
  }

  for (const std::string& name : wanted) {
    if (!contains(*extensions, name.c_str()))
      return Error{fmt::format(
          "the Vulkan loader of this machine has no {}, which a window needs: install the driver of its "
          "display, on Debian mesa-vulkan-drivers",
          name)};
    on.extensions.push_back(name.c_str());
  }

  if (validation) {
    auto hasLayer = hasValidationLayer();
    if (!hasLayer) return hasLayer.error();
    if (!*hasLayer) {
      return Error{fmt::format(
          "RINGLET_VALIDATION=1 asks for the Vulkan layer {}, which is not installed: on Debian install the "
          "package vulkan-validationlayers, or unset RINGLET_VALIDATION",
          kValidationLayer)};
    }
    on.layers.push_back(kValidationLayer);
    on.extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  // Names for messages and capture tools; the layer has it where the loader has not.
  on.debugUtils = validation || contains(*extensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (on.debugUtils) on.extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  return on;
}

}  // namespace

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

Result<std::unique_ptr<Instance>> Instance::create(bool validation, std::span<const std::string> wanted) {
  if (Status status = openLoader(); !status) return status.error();
  const std::uint32_t loaderVersion = volkGetInstanceVersion();
  if (Status status = checkLoader(loaderVersion); !status) return status.error();
  const auto on = switchedOn(validation, wanted);
  if (!on) return on.error();
  std::unique_ptr<Instance> self(new Instance);
  self->apiVersion_ = std::min<std::uint32_t>(loaderVersion, VK_API_VERSION_1_3);
  self->hasDebugUtils_ = on->debugUtils;
  if (validation) self->validationLog_ = std::make_shared<ValidationLog>();

  // The messenger stands in the chain too, so that the instance's own creation and end are watched.
  const std::array enabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(self->validationLog_.get());
  auto features = zeroed<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size());
  features.pEnabledValidationFeatures = enabled.data();

  auto application = zeroed<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "ringlet";
  application.pEngineName = "ringlet";
  application.apiVersion = self->apiVersion_;

  auto info = zeroed<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pNext = validation ? &features : nullptr;
  info.flags = on->flags;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<std::uint32_t>(on->layers.size());
  info.ppEnabledLayerNames = on->layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(on->extensions.size());
  info.ppEnabledExtensionNames = on->extensions.data();
  const VkResult created = vkCreateInstance(&info, nullptr, &self->instance_);
  if (created == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return Error{
        "no Vulkan device on this machine: the Vulkan loader found no working driver. Install the driver of "
        "your graphics card, or on Debian mesa-vulkan-drivers, which also runs on the CPU; `vulkaninfo "
        "--summary` (package vulkan-tools) shows what the loader finds"};
  }
  if (created != VK_SUCCESS) return vulkanError("vkCreateInstance", created, "start Vulkan");
  loadInstanceFunctions(self->instance_);

  if (validation) {
    // Asked for by name: volk's global may have been loaded from an instance without this extension.
    const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(self->instance_, "vkCreateDebugUtilsMessengerEXT"));
    if (!createMessenger)
      return Error{"the Vulkan loader does not know vkCreateDebugUtilsMessengerEXT: update it"};
    RINGLET_VK_CHECK(createMessenger(self->instance_, &messenger, nullptr, &self->messenger_),
                     "listen to the validation layer");
  }
  return self;
}

Result<std::unique_ptr<Instance>> Instance::adopt(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                                  VkInstance instance, std::uint32_t apiVersion) {
  if (!getInstanceProcAddr || !instance)
    return Error{"a host hands over no Vulkan instance, or no vkGetInstanceProcAddr"};
  useLoader(getInstanceProcAddr);
  loadInstanceFunctions(instance);
  std::unique_ptr<Instance> self(new Instance);
  self->instance_ = instance;
  self->isOwned_ = false;
  self->apiVersion_ = std::min<std::uint32_t>(apiVersion, VK_API_VERSION_1_3);
  return self;
}

Instance::~Instance() {
  if (!instance_ || !isOwned_) return;
  if (messenger_) {
    const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroyMessenger(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

Result<std::vector<VkPhysicalDevice>> Instance::physicalDevices() const {
  std::vector<VkPhysicalDevice> devices;
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    RINGLET_VK_CHECK(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "list the Vulkan devices");
    devices.resize(count);
    result = vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    devices.resize(count);
  }
  if (result != VK_SUCCESS)
    return vulkanError("vkEnumeratePhysicalDevices", result, "list the Vulkan devices");
  return devices;
}

}  // namespace ringlet::gpu
