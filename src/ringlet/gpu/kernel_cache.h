// KernelCache: the kernels a device has compiled. Each is compiled once and kept until the device closes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet::gpu {

class Kernel;
struct KernelDescription;

/// Any thread may call it. The device owns the cache, so what the cache holds must not hold the device open.
class KernelCache {
 public:
  using Compiled = Result<std::shared_ptr<const Kernel>>;

  /// The kernel of this description: the one there is, or what `compile` returns. Where several threads ask
  /// for the same kernel, one compiles and the others wait for it. A failure is not kept.
  Compiled findOrCompile(const KernelDescription& description, const std::function<Compiled()>& compile);
  /// Whether findOrCompile would return at once.
  bool has(const KernelDescription& description) const;
  /// How many kernels the driver has been asked to compile so far.
  std::size_t compiledCount() const;

 private:
  using Key = std::vector<std::uint64_t>;

  mutable std::mutex mutex_;
  std::map<Key, std::shared_future<Compiled>> kernels_;
  std::size_t compiledCount_ = 0;
};

}  // namespace ringlet::gpu
