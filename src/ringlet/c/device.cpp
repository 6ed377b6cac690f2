// Implements c/ringlet.h: errors and devices.
#include <fmt/format.h>

#include <mutex>
#include <set>

#include "ringlet/base/shown_text.h"
#include "ringlet/c/handles.h"
#include "ringlet/solver/device_points.h"
#include "ringlet/version.h"

namespace ringlet::c {
namespace {

thread_local std::string message;
thread_local const char* fixedMessage = nullptr;  // where there was no memory for one

ringlet_result resultOf(Fault fault) {
  switch (fault) {
    case Fault::hostMemory:
      return RINGLET_ERROR_OUT_OF_MEMORY;
    case Fault::deviceMemory:
      return RINGLET_ERROR_OUT_OF_DEVICE_MEMORY;
    case Fault::deviceLost:
      return RINGLET_ERROR_DEVICE_LOST;
    case Fault::compile:
      return RINGLET_ERROR_COMPILE;
    default:
      return RINGLET_ERROR;
  }
}

HostVulkan hostOf(const ringlet_host_vulkan& host) {
  HostVulkan taken{.getInstanceProcAddr = host.get_instance_proc_addr,
                   .instance = host.instance,
                   .physicalDevice = host.physical_device,
                   .device = host.device,
                   .queue = host.queue,
                   .queueFamily = host.queue_family,
                   .apiVersion = host.api_version,
                   .subgroupSizeControl = host.subgroup_size_control != 0,
                   .computeFullSubgroups = host.compute_full_subgroups != 0};
  if (host.allocate) {
    taken.allocate = [host](std::uint64_t bytes, std::uint64_t alignment, std::uint32_t type,
                            HostMemory& to) {
      constexpr int kOutOfHostMemory = -1;  // VK_ERROR_OUT_OF_HOST_MEMORY
      try {
        ringlet_memory memory{};
        const int result = host.allocate(host.user, bytes, alignment, type, &memory);
        to = {memory.memory, memory.offset, memory.mapped, memory.own};
        return result;
      } catch (...) {  // a host in C++
        return kOutOfHostMemory;
      }
    };
  }
  if (host.free) {
    taken.free = [host](const HostMemory& from) {
      const ringlet_memory memory{from.memory, from.offset, from.mapped, from.own};
      try {
        host.free(host.user, &memory);
      } catch (...) {  // from a destructor there is no way out
      }
    };
  }
  return taken;
}

ringlet_device* handleOf(ComputeDevice device) {
  std::string name = device.name();
  return new ringlet_device{std::move(device), std::move(name)};
}

// Names that are good as long as the program: there are few.
const char* kept(const std::string& name) {
  static std::mutex mutex;
  static std::set<std::string> names;
  const std::lock_guard lock(mutex);
  return names.insert(name).first->c_str();
}

}  // namespace

Outcome::Outcome(const Error& error) : result(resultOf(error.fault)), message(error.message) {}

ringlet_result tell(Outcome outcome) noexcept {
  if (outcome.result == RINGLET_OK) return RINGLET_OK;
  message = shownText(outcome.message);  // hosts print it
  fixedMessage = nullptr;
  return outcome.result;
}

ringlet_result tellOutOfMemory() noexcept {
  fixedMessage = "there is no memory left; use fewer strands or close other programs";
  return RINGLET_ERROR_OUT_OF_MEMORY;
}

ringlet_result tellThrown(const char* what) noexcept {
  try {
    return tell(Error{fmt::format("a function of the caller's threw: {}", what)});
  } catch (...) {
    return tellOutOfMemory();
  }
}

void warnOf(const std::vector<std::string>& warnings, void (*warn)(const char* sentence, void* user),
            void* user) {
  for (const std::string& sentence : warnings)
    if (warn) warn(shownText(sentence).c_str(), user);
}

Outcome checkArguments(const char* sentence, std::initializer_list<Argument> arguments) {
  for (const Argument& argument : arguments)
    if (argument.fault)
      return Outcome::invalid(fmt::format("{}: {} {}", sentence, argument.name, argument.fault));
  return {};
}

Outcome checkProcess(const ringlet_hair& hair) { return hair.device.checkProcess(); }

Outcome checkFree(const ringlet_hair& hair) {
  if (Outcome outcome = checkProcess(hair); !outcome.isFine()) return outcome;
  if (hair.recordedFrames == 0) return {};
  return Outcome::invalid("a frame of the hair is in a host's commands: call ringlet_frame_is_over first");
}

Outcome takeFeatures(std::uint32_t bits, Features& features) {
  if (bits >> kFeatureNames.size() != 0)
    return Outcome::invalid(fmt::format("features {:#x}; expected bits of ringlet_features", bits));
  for (std::size_t k = 0; k < kFeatureNames.size(); ++k)
    features.*kFeatureNames[k].member = (bits >> k & 1) != 0;
  return {};
}

}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

const char* ringlet_version(void) { return RINGLET_VERSION; }

const char* ringlet_error_message(void) { return fixedMessage ? fixedMessage : message.c_str(); }

ringlet_result ringlet_device_open(const char* choice, ringlet_device** device) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_device_open has nowhere to put the device", {given("device", device)});
        !wrong.isFine())
      return wrong;
    auto opened = ComputeDevice::open(choice ? choice : "");
    if (!opened) return opened.error();
    *device = handleOf(std::move(*opened));
    return {};
  });
}

ringlet_result ringlet_device_needs(const ringlet_host_vulkan* host, ringlet_host_needs* needs,
                                    const char** extension_names, uint32_t capacity) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_device_needs takes two structs that say their size",
                                       {sized("host", host), sized("needs", needs)});
        !wrong.isFine())
      return wrong;
    const auto found = ComputeDevice::needs(hostOf(taken(host)));
    if (!found) return found.error();
    give(needs, {.struct_size = 0,
                 .queue_family = found->queueFamily,
                 .subgroup_size_control = found->subgroupSizeControl,
                 .compute_full_subgroups = found->computeFullSubgroups,
                 .extension_count = static_cast<uint32_t>(found->extensions.size())});
    for (uint32_t k = 0; extension_names && k < capacity && k < found->extensions.size(); ++k)
      extension_names[k] = kept(found->extensions[k]);
    return {};
  });
}

ringlet_result ringlet_device_adopt(const ringlet_host_vulkan* host, ringlet_device** device) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_device_adopt takes a host that says its size, and a place for the device",
                           {sized("host", host), given("device", device)});
        !wrong.isFine())
      return wrong;
    auto adopted = ComputeDevice::adopt(hostOf(taken(host)));
    if (!adopted) return adopted.error();
    *device = handleOf(std::move(*adopted));
    return {};
  });
}

ringlet_result ringlet_read_device_points(ringlet_device* device, const ringlet_device_points* buffers,
                                          uint32_t buffer_count, double* const* xyz) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_read_device_points takes a device, buffers that say their size, and places for their points",
            {given("device", device), sized("buffers", buffers), given("xyz", xyz)});
        !wrong.isFine())
      return wrong;
    std::vector<DevicePoints> from;
    for (uint32_t b = 0; b < buffer_count; ++b) {
      const ringlet_device_points points = taken(buffers, b);
      from.push_back({points.buffer, points.offset, points.stride == 0 ? 12 : points.stride, points.count});
      if (!xyz[b]) return Outcome::invalid(fmt::format("there is no place for the points of buffer {}", b));
    }
    const auto read = readPoints(device->device, from);
    if (!read) return read.error();
    for (std::size_t b = 0; b < read->size(); ++b) {
      double* to = xyz[b];
      for (const Vec3d& p : (*read)[b])
        for (const double number : {p.x, p.y, p.z}) *to++ = number;
    }
    return {};
  });
}

const char* ringlet_device_name(const ringlet_device* device) { return device ? device->name.c_str() : ""; }
void ringlet_device_release(ringlet_device* device) { delete device; }
