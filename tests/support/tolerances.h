// The names of parity/tolerances.h for tests.
#pragma once

#include "parity/tolerances.h"

namespace ringlet::test {
using namespace parity;
}
