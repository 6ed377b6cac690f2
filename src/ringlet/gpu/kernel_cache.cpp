// Implements gpu/kernel_cache.h.
#include "ringlet/gpu/kernel_cache.h"

#include <chrono>
#include <span>

#include "ringlet/gpu/kernel.h"

namespace ringlet::gpu {
namespace {

// FNV-1a, word by word.
std::uint64_t hashOf(std::span<const std::uint32_t> words) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint32_t word : words) hash = (hash ^ word) * 0x100000001b3;
  return hash;
}

// Everything of a description that decides what is compiled.
std::vector<std::uint64_t> keyOf(const KernelDescription& d) {
  std::vector<std::uint64_t> key{hashOf(d.spirv), d.spirv.size(),       d.pushConstantBytes,
                                 d.groupSize,     d.wantsFullSubgroups, d.subgroupSize};
  for (const SpecializationConstant& constant : d.constants)
    key.push_back(std::uint64_t{constant.id} << 32 | constant.value);
  return key;
}

}  // namespace

KernelCache::Compiled KernelCache::findOrCompile(const KernelDescription& description,
                                                 const std::function<Compiled()>& compile) {
  const Key key = keyOf(description);
  std::promise<Compiled> promise;
  {
    std::unique_lock lock(mutex_);
    const auto [place, isNew] = kernels_.try_emplace(key);
    if (!isNew) {
      const std::shared_future<Compiled> found = place->second;
      lock.unlock();
      return found.get();
    }
    place->second = promise.get_future().share();
    ++compiledCount_;
  }
  Compiled compiled = compile();
  promise.set_value(compiled);
  if (!compiled) {
    const std::lock_guard lock(mutex_);
    kernels_.erase(key);
  }
  return compiled;
}

bool KernelCache::has(const KernelDescription& description) const {
  const std::lock_guard lock(mutex_);
  const auto found = kernels_.find(keyOf(description));
  return found != kernels_.end() &&
         found->second.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::size_t KernelCache::compiledCount() const {
  const std::lock_guard lock(mutex_);
  return compiledCount_;
}

}  // namespace ringlet::gpu
