// Implements open_device.h.
#include "program/device/open_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "program/cli/cache_folder.h"

namespace ringlet::program {
namespace {

std::string asked() {
  const char* words = std::getenv("RINGLET_WITHOUT");
  return words ? words : "";
}

bool leaveOut(std::string_view word, gpu::DeviceOptions& options) {
  if (word == "texels") return options.mostTexelRecords = 1, true;  // fewer than any kernel needs
  if (word == "timestamps") return options.withoutTimestamps = true;
  if (word == "mapping") return options.alwaysStage = true;
  if (word == "full_subgroups") return options.withoutFullSubgroups = true;
  if (word == "atomic_int64") return options.withoutAtomicInt64 = true;
  if (word == "cpu_forms") return options.asGpu = true;
  return word.empty();
}

}  // namespace

Result<gpu::DeviceOptions> optionsWithout(const std::string& words) {
  gpu::DeviceOptions options;
  std::string_view rest = words;
  while (!rest.empty()) {
    const std::string_view word = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    if (leaveOut(word, options)) continue;
    return Error{fmt::format(
        "RINGLET_WITHOUT: there is no {}; it may have texels, timestamps, mapping, full_subgroups, "
        "atomic_int64, cpu_forms, with commas between",
        word)};
  }
  return options;
}

Result<ComputeDevice> openDevice(const std::string& choice) {
  const auto options = optionsWithout(asked());
  if (!options) return options.error();
  auto opened = gpu::Device::open(choice, *options, cacheFolder());
  if (!opened) return opened.error();
  return ComputeDevice::over(std::move(*opened));
}

Result<int> groupSizeAsked() {
  const char* text = std::getenv("RINGLET_GROUP_SIZE");
  if (!text || !*text) return 0;
  int size = 0;
  const char* end = text + std::strlen(text);
  const auto [stop, code] = std::from_chars(text, end, size);
  if (code == std::errc{} && stop == end && size > 0) return size;
  return Error{fmt::format("RINGLET_GROUP_SIZE: found {}; expected a whole number above 0", text)};
}

std::string whatIsLeftOut() {
  const std::string words = asked();
  return words.empty() ? "" : fmt::format("the device does without {} (RINGLET_WITHOUT)", words);
}

}  // namespace ringlet::program
