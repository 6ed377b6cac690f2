// The hair of `ringlet conform`: planned shapes, fallbacks, contacts, bodies and air, each compared with the
// reference by parity/, with the tolerances of the tests.
#pragma once

#include "program/device/conform_check.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

struct ConformCases {
  const ComputeDevice& device;
  const ComputeDevice& withoutTexels;  // the same device, opened such that kernels read storage buffers only
  bool quick = false;
};

/// Calls `tell` with each check as soon as it is done.
void runCases(const ConformCases& cases, const Tell& tell);

}  // namespace ringlet::program
