// Tiny kernels (shaders/kernels/probe_*.comp) that test a driver for what Ringlet's kernels rely on: plain
// integer formulas, compared bit by bit.
#pragma once

#include "program/device/conform_check.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// Runs every probe and calls `tell` with each check as soon as it is done.
void runProbes(const ComputeDevice& device, const Tell& tell);

}  // namespace ringlet::program
