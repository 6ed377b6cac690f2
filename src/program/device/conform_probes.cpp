// Implements conform_probes.h.
#include "program/device/conform_probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/stopwatch.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet_shaders/probe_atomics_plain.h"
#include "ringlet_shaders/probe_bits_plain.h"
#include "ringlet_shaders/probe_groups_plain.h"
#include "ringlet_shaders/probe_loops_plain.h"
#include "ringlet_shaders/probe_scan_plain.h"
#include "ringlet_shaders/probe_shuffle_plain.h"
#include "ringlet_shaders/probe_turns_plain.h"

namespace ringlet::program {
namespace {

using Words = std::vector<std::uint32_t>;
using Outcome = Check::Outcome;

constexpr std::uint32_t kGroupSize = 64, kGroups = 4, kInvocations = kGroupSize * kGroups;

// One dispatch.
struct Launch {
  const char* name;
  std::span<const std::uint32_t> spirv;
  std::optional<std::uint32_t> push{};
  std::optional<std::uint32_t> groupsFrom{};  // buffer with the group counts; none: kGroups
  bool wantsFullSubgroups = false;
};

// The contents of the buffers, by binding number, after some dispatches.
struct Ran {
  std::vector<Words> buffers;
  double compileSeconds = 0;
};

Result<Ran> run(gpu::Device& device, std::span<const Launch> launches, std::vector<Words> buffers) {
  Ran ran{std::move(buffers)};
  std::vector<gpu::Buffer> onDevice;
  gpu::BufferTable table;
  onDevice.reserve(ran.buffers.size());
  for (const Words& words : ran.buffers) {
    auto made =
        gpu::Buffer::create(device, words.size() * sizeof(std::uint32_t), gpu::BufferKind::storage, "probe");
    if (!made) return made.error();
    if (Status sent = made->upload(std::as_bytes(std::span(words))); !sent) return sent.error();
    onDevice.push_back(std::move(*made));
    table.emplace(static_cast<std::uint32_t>(onDevice.size() - 1), onDevice.back());
  }
  auto recorder = gpu::Recorder::create(device, "probe");
  if (!recorder) return recorder.error();
  if (Status begun = recorder->begin(); !begun) return begun.error();
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels;
  std::vector<gpu::Bindings> bindings;
  for (const Launch& launch : launches) {
    gpu::KernelDescription description{.name = launch.name,
                                       .spirv = launch.spirv,
                                       .pushConstantBytes = launch.push ? 4u : 0u,
                                       .constants = {{0, kGroupSize}},
                                       .groupSize = kGroupSize,
                                       .wantsFullSubgroups = launch.wantsFullSubgroups};
    double milliseconds = 0;
    auto kernel = [&] {
      const Stopwatch watch(milliseconds);
      return gpu::Kernel::create(device, description);
    }();
    ran.compileSeconds += milliseconds / 1000;
    if (!kernel) return kernel.error();
    auto bound = gpu::Bindings::create(**kernel, table);
    if (!bound) return bound.error();
    kernels.push_back(std::move(*kernel));
    bindings.push_back(std::move(*bound));
    const auto push = launch.push ? std::as_bytes(std::span(&*launch.push, 1)) : std::span<const std::byte>{};
    if (launch.groupsFrom)
      recorder->dispatchIndirect(*kernels.back(), bindings.back(), push, onDevice[*launch.groupsFrom], 0);
    else
      recorder->dispatch(*kernels.back(), bindings.back(), push, kGroups);
    recorder->barrier();
  }
  if (Status done = recorder->submitAndWait(); !done) return done.error();
  for (std::size_t i = 0; i < onDevice.size(); ++i) {
    if (Status read = onDevice[i].download(std::as_writable_bytes(std::span(ran.buffers[i]))); !read)
      return read.error();
  }
  return ran;
}

// A hash (the finaliser of MurmurHash3).
std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x85ebca6bu;
  x = (x ^ x >> 13) * 0xc2b2ae35u;
  return x ^ x >> 16;
}
Words mixedWords(std::size_t count) {
  Words words(count);
  for (std::uint32_t i = 0; i < count; ++i) words[i] = mixed(i + 1);
  return words;
}

// Counts differences and describes the first.
class Difference {
 public:
  void add(std::size_t place, std::uint32_t expected, std::uint32_t found) {
    ++all_;
    if (expected == found) return;
    if (wrong_++ == 0) first_ = fmt::format("first at {}: expected {}, found {}", place, expected, found);
  }
  // `ifWrong`: the outcome if there are differences.
  Check check(const std::string& name, double compileSeconds, Outcome ifWrong = Outcome::wrong) const {
    return {.name = name,
            .outcome = wrong_ == 0 ? Outcome::right : ifWrong,
            .figure = static_cast<double>(wrong_),
            .tolerance = 0,
            .detail = wrong_ == 0 ? fmt::format("of {} values", all_)
                                  : fmt::format("of {} values; {}", all_, first_),
            .compileSeconds = compileSeconds};
  }

 private:
  std::size_t all_ = 0, wrong_ = 0;
  std::string first_;
};

// The device chooses the lane of each invocation; the expected values follow from its choice.
void probeShuffles(const ComputeDevice& device, const Tell& tell) {
  const std::string name = "shuffles at every lane";
  const gpu::DeviceProperties& p = device.gpu().properties();
  if (!p.hasSubgroupShuffle) {
    return tell({.name = name,
                 .outcome = Outcome::skipped,
                 .detail = "this device has no subgroup shuffles; hair runs in one lane a strand"});
  }
  constexpr std::uint32_t n = kInvocations, kMostLanes = 128;
  const Words values = mixedWords(n);
  const Launch launch{.name = "probe_shuffle", .spirv = k_probe_shuffle_plain, .wantsFullSubgroups = true};
  const auto ran = run(device.gpu(), std::span(&launch, 1), {values, Words((3 + 2 * kMostLanes) * n)});
  if (!ran) return tell(failed(name, ran.error()));
  const Words& found = ran->buffers[1];

  // The invocation at each workgroup, subgroup and lane.
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> places;
  for (std::uint32_t i = 0; i < n; ++i) places[{i / kGroupSize, found[2 * n + i], found[n + i]}] = i;
  Difference byIndex, byXor, sizes;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (p.hasFullSubgroups && kGroupSize % p.subgroupSize == 0) sizes.add(i, p.subgroupSize, found[i]);
    for (std::uint32_t s = 0; s < std::min(found[i], kMostLanes); ++s) {
      const auto add = [&](Difference& difference, std::uint32_t lane, std::uint32_t row) {
        const auto place = places.find({i / kGroupSize, found[2 * n + i], lane});
        if (place != places.end()) difference.add(i, values[place->second], found[(3 + 2 * s + row) * n + i]);
      };
      add(byIndex, s, 0);
      add(byXor, found[n + i] ^ s, 1);
    }
  }
  tell(sizes.check("subgroups as wide as asked for", ran->compileSeconds));
  tell(byIndex.check(name + ", by index", 0));
  tell(byXor.check(name + ", by xor", 0));
}

// The last value of rows 2 and 3 of probe_loops.comp.
std::uint32_t lastOfLoop(std::uint32_t invocation, std::uint32_t turns,
                         std::span<const std::uint32_t> values) {
  std::uint32_t last = 0, turn = 0;
  do {
    last = 0;
    for (std::uint32_t k = 0; k <= (invocation + turn) % 3; ++k)
      last = std::max(last, values[(turn + k) % 64]);
  } while (++turn < turns && last < 50);
  return last;
}

void probeLoops(const ComputeDevice& device, const Tell& tell) {
  constexpr std::uint32_t n = kInvocations;
  Words values(n + 64);
  for (std::uint32_t i = 0; i < n; ++i) values[i] = 1 + mixed(i) % 40;
  for (std::uint32_t k = 0; k < 64; ++k) values[n + k] = 7 + mixed(k + 5) % 44;
  const Launch launch{.name = "probe_loops", .spirv = k_probe_loops_plain};
  const auto ran = run(device.gpu(), std::span(&launch, 1), {values, Words(4 * n)});
  if (!ran) return tell(failed("loop exits", ran.error()));
  Difference rows[4];
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t last = lastOfLoop(i, values[i], std::span(values).subspan(n));
    const std::uint32_t expected[] = {0, 0, last, last};
    for (std::uint32_t row = 0; row < 4; ++row) rows[row].add(i, expected[row], ran->buffers[1][row * n + i]);
  }
  tell(rows[1].check("loop exits: a sum that is added in an if", ran->compileSeconds));
  tell(rows[3].check("loop exits: a value that is carried from turn to turn", 0));
  tell(rows[0].check("loop exits: a sum that is added by ?: (no kernel does)", 0, Outcome::quirk));
  tell(rows[2].check("loop exits: a value made anew in every turn (no kernel does)", 0, Outcome::quirk));
}

// The plan cuts long loops on devices that are known to end them.
void probeTurns(const ComputeDevice& device, const Tell& tell) {
  for (const std::uint32_t turns : {65'000u, 200'000u}) {
    const std::string name = fmt::format("a loop of {} turns", turns);
    const Launch launch{.name = "probe_turns", .spirv = k_probe_turns_plain, .push = turns};
    const auto ran = run(device.gpu(), std::span(&launch, 1), {Words(4), Words(kInvocations)});
    if (!ran) return tell(failed(name, ran.error()));
    Difference difference;
    for (std::uint32_t i = 0; i < kInvocations; ++i) {
      std::uint32_t x = i;
      for (std::uint32_t turn = 0; turn < turns; ++turn) x = 1664525u * x + 1013904223u;
      difference.add(i, x, ran->buffers[1][i]);
    }
    const bool isKnown = turns > 65'535 && device.limits().endsLoopsEarly;
    tell(difference.check(isKnown ? name + " (the plan cuts them on this device)" : name, ran->compileSeconds,
                          isKnown ? Outcome::quirk : Outcome::wrong));
  }
}

void probeBits(const ComputeDevice& device, const Tell& tell) {
  Words records(4 * kInvocations);
  std::iota(records.begin(), records.end(), 1);
  const Launch launch{.name = "probe_bits", .spirv = k_probe_bits_plain};
  const auto ran = run(device.gpu(), std::span(&launch, 1),
                       {records, Words(records.size()), records, Words(records.size())});
  if (!ran) return tell(failed("bits of small integers", ran.error()));
  Difference integers, floats;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const std::uint32_t expected = records[k / 4 % 2 == 1 ? k / 4 * 4 + 3 - k % 4 : k];
    integers.add(k, expected, ran->buffers[1][k]);
    floats.add(k, expected, ran->buffers[3][k]);
  }
  tell(integers.check("bits of small integers, moved as integers", ran->compileSeconds));
  tell(floats.check("bits of small integers, moved as floats (no kernel does)", 0, Outcome::quirk));
}

void probeScan(const ComputeDevice& device, const Tell& tell) {
  const Words values = mixedWords(kInvocations);
  const Launch launch{.name = "probe_scan", .spirv = k_probe_scan_plain};
  const auto ran = run(device.gpu(), std::span(&launch, 1), {values, Words(kInvocations)});
  if (!ran) return tell(failed("running sums", ran.error()));
  Difference difference;
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < kInvocations; ++i) {
    sum = (i % kGroupSize == 0 ? 0 : sum) + values[i];
    difference.add(i, sum, ran->buffers[1][i]);
  }
  tell(difference.check("running sums through shared memory and barriers", ran->compileSeconds));
}

// The number of workgroups comes from another kernel; atomics count them.
void probeAtomics(const ComputeDevice& device, const Tell& tell) {
  for (const bool isIndirect : {false, true}) {
    const std::string name = isIndirect ? "an indirect dispatch" : "sums, maxima and places by atomics";
    const std::uint32_t groups = isIndirect ? 3 : kGroups, n = groups * kGroupSize;
    const Words values = mixedWords(kInvocations);
    std::vector<Launch> launches;
    if (isIndirect)
      launches.push_back({.name = "probe_groups", .spirv = k_probe_groups_plain, .push = groups});
    launches.push_back({.name = "probe_atomics", .spirv = k_probe_atomics_plain});
    if (isIndirect) launches.back().groupsFrom = 2;
    const auto ran = run(device.gpu(), launches, {values, Words(4 + kInvocations), Words(4)});
    if (!ran) return tell(failed(name, ran.error()));
    const std::span<const std::uint32_t> counted(values.data(), n);
    Words expected(4 + kInvocations);
    expected[0] = n;
    expected[1] = std::accumulate(counted.begin(), counted.end(), 0u);
    expected[2] = *std::ranges::max_element(counted);
    std::fill_n(expected.begin() + 4, n, 1u);
    Difference difference;
    for (std::size_t k = 0; k < expected.size(); ++k) difference.add(k, expected[k], ran->buffers[1][k]);
    tell(difference.check(name, ran->compileSeconds));
  }
}

}  // namespace

void runProbes(const ComputeDevice& device, const Tell& tell) {
  probeShuffles(device, tell);
  probeLoops(device, tell);
  probeTurns(device, tell);
  probeBits(device, tell);
  probeScan(device, tell);
  probeAtomics(device, tell);
}

}  // namespace ringlet::program
