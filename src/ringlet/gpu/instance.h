// Instance: a Vulkan instance, with the validation layer if it was asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/vulkan.h"

namespace ringlet::gpu {

/// What the validation layer said: its warnings and errors. Drivers may call from any thread.
class ValidationLog {
 public:
  void add(std::string message);
  std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

class Instance {
 public:
  /// With validation: VK_LAYER_KHRONOS_validation and its synchronisation validation; an Error where it is
  /// missing. `extensions`: to be switched on besides; an Error where one is missing.
  static Result<std::unique_ptr<Instance>> create(bool validation,
                                                  std::span<const std::string> extensions = {});
  /// An instance that a host made and destroys after this. apiVersion: the host's VkApplicationInfo's.
  static Result<std::unique_ptr<Instance>> adopt(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                                 VkInstance instance, std::uint32_t apiVersion);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// In the order of the loader; possibly none.
  Result<std::vector<VkPhysicalDevice>> physicalDevices() const;

  VkInstance handle() const { return instance_; }
  /// The highest version this instance lets a device be used with.
  std::uint32_t apiVersion() const { return apiVersion_; }
  /// Empty unless validation is on. It outlives the instance, so that messages about leaks can be read.
  const std::shared_ptr<ValidationLog>& validationLog() const { return validationLog_; }
  /// Whether VK_EXT_debug_utils is on: where the loader has it, but not known of a host's instance.
  bool hasDebugUtils() const { return hasDebugUtils_; }

 private:
  Instance() = default;

  VkInstance instance_ = VK_NULL_HANDLE;
  bool isOwned_ = true;
  std::uint32_t apiVersion_ = 0;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::shared_ptr<ValidationLog> validationLog_;
  bool hasDebugUtils_ = false;
};

}  // namespace ringlet::gpu
