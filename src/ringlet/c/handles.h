// What is behind the handles of c/ringlet.h, and how its functions fail.
#pragma once

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/c/ringlet.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/simulation.h"

struct ringlet_device {
  ringlet::ComputeDevice device;
  std::string name;
};
struct ringlet_settings {
  ringlet::Settings settings;
};
struct ringlet_material {
  ringlet::Material material;
};
struct ringlet_asset {
  ringlet::HairAsset asset;
  const void* device;  // to tell devices apart
  bool hasBodies, movesRoots;
};
struct ringlet_hair {
  ringlet::Simulation simulation;
  const void* device;
  std::uint64_t particleCount, strandCount;
  std::uint32_t bodyCount;
  bool movesRoots;
  std::vector<ringlet::DevicePositions> devicePositions;
  int recordedFrames = 0;  // in commands of the host's, and not over
};

namespace ringlet::c {

/// How a function ended.
struct Outcome {
  ringlet_result result = RINGLET_OK;
  std::string message{};

  Outcome() = default;
  Outcome(const Error& error);
  Outcome(const Status& status) : Outcome(status ? Outcome() : Outcome(status.error())) {}
  static Outcome invalid(std::string message) {
    Outcome outcome;
    outcome.result = RINGLET_ERROR_INVALID_ARGUMENT;
    outcome.message = std::move(message);
    return outcome;
  }
};

/// Keeps the message for ringlet_error_message.
ringlet_result tell(Outcome outcome) noexcept;
ringlet_result tellOutOfMemory() noexcept;

/// What a function does, with no way out for an exception.
template <class Body>
ringlet_result guarded(Body&& body) noexcept {
  try {
    return tell(body());
  } catch (const std::bad_alloc&) {
    return tellOutOfMemory();
  } catch (const std::exception& error) {
    return tell(Error{error.what()});
  }
}

/// A caller's struct, with what it does not know of yet 0. Null: all 0.
template <class T>
T taken(const T* from) {
  T value{};
  if (from) std::memcpy(&value, from, std::min(from->struct_size, sizeof(T)));
  return value;
}
/// Element `index` of an array of them.
template <class T>
T taken(const T* array, std::size_t index) {
  return taken(reinterpret_cast<const T*>(reinterpret_cast<const char*>(array) + index * array->struct_size));
}
/// What the caller's struct has room for of `value`.
template <class T>
void give(T* to, T value) {
  value.struct_size = to->struct_size;
  std::memcpy(to, &value, std::min(to->struct_size, sizeof(T)));
}
template <class T>
bool hasSize(const T* from) {
  return from && from->struct_size >= sizeof(std::size_t);
}
/// Of one that may be left out.
template <class T>
bool hasSizeOrIsNull(const T* from) {
  return !from || hasSize(from);
}

}  // namespace ringlet::c
