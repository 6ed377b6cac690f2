// Measured costs of strand shapes as a file, a table a device:
//
//   [[device]]
//   name = "llvmpipe (LLVM 15.0.6, 256 bits)"
//   driver = "llvmpipe 22.3.6"
//   kernels = "9c0f3a51e2d47b68"
//   subgroup = 8
//   shapes = [
//     { lanes = 4, run = 16, nanoseconds = 612.5 },
//     { serial = true, nanoseconds = 46.1 },
//   ]
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// What was measured once, hair alone, and what it is true of.
struct DeviceCosts {
  std::string device, driver;  // ComputeDevice::name, driver
  std::string kernels;         // strandKernelHash
  std::vector<ShapeCost> costs;
  std::uint32_t subgroupSize = 0;  // they were measured at; 0: the device's default

  bool isOf(const DeviceCosts& other) const {
    return device == other.device && driver == other.driver && kernels == other.kernels;
  }
};

/// Errors, with the line: as for readWholeFile; no TOML, more than 1 MiB, a value that is missing or out of
/// range, as `subgroup` is in files of older versions. Keys it does not know it leaves alone.
Result<std::vector<DeviceCosts>> readShapeCosts(const std::filesystem::path& path);

/// Replaces the file, whole or not at all, and makes its folder. Errors: as for writeWholeFile.
Status writeShapeCosts(const std::filesystem::path& path, const std::vector<DeviceCosts>& devices);

}  // namespace ringlet
