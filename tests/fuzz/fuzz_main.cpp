// What libFuzzer calls, for every fuzzer: tryBytes, with the memory it holds watched.
#include <atomic>
#include <cstdint>

#include "tests/fuzz/fuzz_target.h"

extern "C" {
int __sanitizer_install_malloc_and_free_hooks(void (*malloc)(const volatile void*, std::size_t),
                                              void (*free)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* pointer);
}

namespace ringlet::fuzz {
namespace {

// Of the file being tried, in all threads [bytes].
std::atomic<std::int64_t> held{0}, mostHeld{0};

void add(const volatile void*, std::size_t size) {
  const std::int64_t now = held += static_cast<std::int64_t>(size);
  std::int64_t most = mostHeld;
  while (now > most && !mostHeld.compare_exchange_weak(most, now)) {
  }
}
void remove(const volatile void* pointer) {
  if (pointer) held -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(pointer));
}

}  // namespace
}  // namespace ringlet::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ringlet::fuzz;
  static const int installed = __sanitizer_install_malloc_and_free_hooks(add, remove);
  demand(installed > 0, "the sanitizer tells of memory");
  held = mostHeld = 0;
  tryBytes(std::as_bytes(std::span(data, size)));
  const auto allowed = static_cast<std::int64_t>(kMemory.base + kMemory.perByte * size);
  if (mostHeld > allowed)
    std::fprintf(stderr, "%lld bytes were held for a file of %zu, %lld are allowed\n",
                 static_cast<long long>(mostHeld), size, static_cast<long long>(allowed));
  demand(mostHeld <= allowed, "memory stays below its bound");
  return 0;
}
