// The figures that matter, in less than a minute, as one JSON object: for comparing one state of the code
// with another. Run: build/release/bench/quick_bench FILE
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/clocks.h"
#include "bench/curls.h"
#include "bench/strand_contest.h"

namespace {

using namespace ringlet;
using namespace ringlet::bench;

constexpr int kRounds = 15;

// Without a number, null.
void put(nlohmann::json& json, const std::string& key, double value) {
  if (std::isfinite(value))
    json[key] = value;
  else
    json[key] = nullptr;
}

Status addStrandKernel(const ComputeDevice& device, int steps, const std::string& suffix,
                       nlohmann::json& json) {
  auto contest = Contest::create(device, std::vector<int>(2048, 64), steps);
  if (!contest) return contest.error();
  if (Status status = contest->rounds(kRounds); !status) return status;
  const ContestSamples& s = contest->samples();
  put(json, "strand_kernel_ms_64" + suffix, 1e3 * median(s.kernel));
  put(json, "vectorised_ms_64" + suffix, 1e3 * median(s.hand));
  put(json, "strand_kernel_over_reference_64" + suffix, medianRatio(s.referenceDouble, s.kernel));
  put(json, "strand_kernel_over_vectorised_64" + suffix, medianRatio(s.kernel, s.hand));
  put(json, "strand_kernel_wall_over_vectorised_64" + suffix, medianRatio(s.kernelWall, s.hand));
  put(json, "share_of_fma_peak_64" + suffix, medianRatio(s.peak, s.kernel));
  put(json, "vectorised_share_of_fma_peak_64" + suffix, medianRatio(s.peak, s.hand));
  // By the CPU's own count, which a busy machine disturbs less. It says something where the device is the
  // CPU.
  const double cores = coreCount();
  put(json, "strand_kernel_cpu_ms_per_core_64" + suffix, 1e3 * median(s.kernelCpu) / cores);
  put(json, "strand_kernel_over_reference_64_by_cpu" + suffix,
      cores * medianRatio(s.referenceCpu, s.kernelCpu));
  put(json, "share_of_fma_peak_64_by_cpu" + suffix, cores * medianRatio(s.peak, s.kernelCpu));
  put(json, "strand_kernel_over_vectorised_64_by_cpu" + suffix, medianRatio(s.kernelCpu, s.handCpu));
  return {};
}

// Means of so many samples each.
std::vector<double> meansOf(const std::vector<double>& samples, std::size_t each) {
  std::vector<double> means(samples.size() / each);
  for (std::size_t k = 0; k < means.size() * each; ++k)
    means[k / each] += samples[k] / static_cast<double>(each);
  return means;
}

// Time a particle of one hair over that of another, which is no smaller, their rounds in turn: as many frames
// of the one as take about as long as one of the other, since the first after another wakes threads and
// memory.
Status addRatio(const ComputeDevice& device, const std::string& key, const std::vector<int>& counts,
                const std::vector<int>& others, int rounds, nlohmann::json& json) {
  auto one = Contest::create(device, counts, 4, Baselines::none);
  auto other = Contest::create(device, others, 4, Baselines::none);
  if (!one) return one.error();
  if (!other) return other.error();
  const double perParticle = other->particles() / one->particles();
  const auto frames = static_cast<std::size_t>(std::max(1L, std::lround(perParticle)));
  for (int k = 0; k < rounds; ++k) {
    if (Status status = one->rounds(static_cast<int>(frames)); !status) return status;
    if (Status status = other->round(); !status) return status;
  }
  const ContestSamples &a = one->samples(), &b = other->samples();
  put(json, key, perParticle * medianRatio(meansOf(a.kernel, frames), b.kernel));
  put(json, key + "_by_cpu", perParticle * medianRatio(meansOf(a.kernelCpu, frames), b.kernelCpu));
  return {};
}

Status addAll(const ComputeDevice& device, nlohmann::json& json) {
  json["device"] = device.name();
  json["driver"] = device.driver();
  json["cores"] = coreCount();
  json["vectorised_flags"] = sweepFlags();
  if (Status status = addStrandKernel(device, 4, "", json); !status) return status;
  if (Status status = addStrandKernel(device, 8, "_8_steps", json); !status) return status;
  const auto mixed = mixedCounts(2048);
  // As many particles in strands of 64, whose shape is the fastest, and of the mean length.
  for (const auto& [key, particles] : {std::pair{"mixed_over_uniform", 64}, {"mixed_over_mean_length", 72}}) {
    if (Status status = addRatio(device, key, mixed, uniformCounts(mixed, particles), kRounds, json); !status)
      return status;
  }
  const std::vector<int> few(512, 64), many(32768, 64);
  return addRatio(device, "flatness_512_32768", few, many, 7, json);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "quick_bench: wants the name of a file to write: quick_bench FILE\n");
    return 2;
  }
  auto device = ComputeDevice::open();
  if (!device) {
    fmt::print(stderr, "quick_bench: {}\n", device.error().message);
    return 1;
  }
  nlohmann::json json;
  if (Status status = addAll(*device, json); !status) {
    fmt::print(stderr, "quick_bench: {}\n", status.error().message);
    return 1;
  }
  std::ofstream file(argv[1]);
  file << json.dump(2) << "\n";
  if (!file.flush()) {
    fmt::print(stderr, "quick_bench: could not write {}; is its folder there and writable?\n", argv[1]);
    return 1;
  }
  fmt::print("{}\n", json.dump(2));
  return 0;
}
