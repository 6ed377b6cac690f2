// The hair of `ringlet conform`: planned shapes, fallbacks, contacts, bodies and air, each held against the
// reference by parity/ with the tests' tolerances.
#pragma once

#include "program/device/conform_check.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

struct ConformCases {
  const ComputeDevice& device;
  const ComputeDevice& withoutTexels;  // the same device, opened so that kernels see storage buffers only
  bool quick = false;
};

/// Hands each line to `tell` when it is there.
void runCases(const ConformCases& cases, const Tell& tell);

}  // namespace ringlet::program
