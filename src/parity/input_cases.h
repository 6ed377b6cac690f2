// Cases that between them set every input of the kernels that step hair: small grooms, each held against the
// reference. tests/kernels/kernel_inputs_test.cpp reads from the device which case sets what.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "parity/parity.h"

namespace ringlet::parity {

struct InputCase {
  std::string name;
  double tolerance = 0;  // of the error
  std::function<FieldError(const ComputeDevice&)> error;
};

/// The first is plain hair: what all others have in common with it, none of them sets.
std::vector<InputCase> inputCases();
/// Of what brings positions back, in the form that GPUs have.
std::vector<InputCase> readbackCases();

}  // namespace ringlet::parity
