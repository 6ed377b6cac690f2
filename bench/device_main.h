// The main of a benchmark on the default device.
#pragma once

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "ringlet/solver/compute_device.h"

namespace ringlet::bench {

/// Opens the device, and runs what `begin` registers, which may first print what else is to be known. Returns
/// what main returns.
template <class Device, class Begin>
int runOnDevice(int argc, char** argv, const char* name, Device*& device, const Begin& begin) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  auto opened = ComputeDevice::open();
  if (!opened) {
    fmt::print(stderr, "{}: {}\n", name, opened.error().message);
    return 1;
  }
  device = &*opened;
  fmt::print("device: {} ({})\n", device->name(), device->driver());
  begin();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace ringlet::bench
