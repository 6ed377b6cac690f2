// A file of measured costs of strand shapes, one table per device:
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

/// One measurement, of hair alone, and the device and kernels it holds for.
struct DeviceCosts {
  std::string device, driver;  // ComputeDevice::name, driver
  std::string kernels;         // strandKernelHash
  std::vector<ShapeCost> costs;
  std::uint32_t subgroupSize = 0;  // with which it was measured; 0: the device's default

  bool isOf(const DeviceCosts& other) const {
    return device == other.device && driver == other.driver && kernels == other.kernels;
  }
};

/// Errors: as for readWholeFile; and, with the line, invalid TOML, more than 1 MiB, and values that are
/// missing or out of range (files of older versions lack `subgroup`). Unknown keys are ignored.
Result<std::vector<DeviceCosts>> readShapeCosts(const std::filesystem::path& path);

/// Replaces the file as a whole and creates its folder. Errors: as for writeWholeFile.
Status writeShapeCosts(const std::filesystem::path& path, const std::vector<DeviceCosts>& devices);

}  // namespace ringlet
