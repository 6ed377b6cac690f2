// What is behind the handles of c/ringlet.h, and how its functions fail.
#pragma once

#include <algorithm>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <memory>
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
  ringlet::ComputeDevice device;
  std::shared_ptr<const void> scene{};  // that it was built of; none: a groom of the caller's
};
struct ringlet_hair {
  ringlet::Simulation simulation;
  ringlet::ComputeDevice device;
  std::uint64_t particleCount, strandCount;
  std::uint32_t bodyCount;
  std::vector<std::size_t> bendingPoints{};  // of each body that bends
  std::vector<ringlet::DevicePositions> devicePositions{};
  std::shared_ptr<const void> scene{};  // the asset's
  int recordedFrames = 0;               // in commands of the host's, and not over
};

namespace ringlet::c {

/// How a function ended.
struct Outcome {
  ringlet_result result = RINGLET_OK;
  std::string message{};

  Outcome() = default;
  Outcome(const Error& error);
  Outcome(const Status& status) : Outcome(status ? Outcome() : Outcome(status.error())) {}
  bool isFine() const { return result == RINGLET_OK; }
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
ringlet_result tellThrown(const char* what) noexcept;

/// What a function does, with no way out for an exception.
template <class Body>
ringlet_result guarded(Body&& body) noexcept {
  try {
    return tell(body());
  } catch (const std::bad_alloc&) {
    return tellOutOfMemory();
  } catch (const std::exception& error) {
    return tellThrown(error.what());
  } catch (...) {  // of a callback
    return tellThrown("something that is no std::exception");
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

/// An argument, and what is wrong with it; null: nothing.
struct Argument {
  const char* name;
  const char* fault;
};
inline Argument given(const char* name, const void* argument) {
  return {name, argument ? nullptr : "is NULL"};
}
/// A struct, or an array of them.
template <class T>
Argument sized(const char* name, const T* argument) {
  if (!argument) return given(name, argument);
  return {name, hasSize(argument) ? nullptr : "has no struct_size; make it with RINGLET_INIT"};
}
template <class T>
Argument sizedOrNull(const char* name, const T* argument) {
  return argument ? sized(name, argument) : Argument{name, nullptr};
}
/// "ringlet_step_to takes hair and a pose: head is NULL" for the first that is wrong.
Outcome checkArguments(const char* sentence, std::initializer_list<Argument> arguments);

/// Tells sentences to a host, which prints them; `warn` may be null.
void warnOf(const std::vector<std::string>& warnings, void (*warn)(const char* sentence, void* user),
            void* user);

/// A groom of the caller's.
Outcome takeGroom(const ringlet_groom& from, Groom& made);
/// Whether it has strands of two particles at least.
Outcome checkStrands(const Groom& groom);
/// ringlet_asset_build and ringlet_hair_create, of what was taken.
Outcome buildAsset(const ComputeDevice& device, const Groom& groom, const Settings& settings,
                   const Material& material, const ringlet_asset_options& options, ringlet_asset** asset);
Outcome createHair(const ringlet_asset& asset, const InitialState& initial, ringlet_hair** hair);

/// Whether hair can be used in this process.
Outcome checkProcess(const ringlet_hair& hair);
/// The same, and no frame of it is in a host's commands.
Outcome checkFree(const ringlet_hair& hair);
/// Whether hair was built for something; `option` is the member of ringlet_asset_options that says so.
/// Fails where a bit is none of ringlet_features.
Outcome takeFeatures(std::uint32_t bits, Features& features);

}  // namespace ringlet::c
