// Tiny kernels (shaders/kernels/probe_*.comp) that hold a driver against what Ringlet's kernels rely on:
// plain integer formulas, compared bit by bit.
#pragma once

#include "program/device/conform_check.h"
#include "ringlet/solver/compute_device.h"

namespace ringlet::program {

/// Runs every probe and hands each line to `tell` when it is there.
void runProbes(const ComputeDevice& device, const Tell& tell);

}  // namespace ringlet::program
