// The names of parity/parity.h for tests.
#pragma once

#include "parity/parity.h"

namespace ringlet::test {
using namespace parity;
}
