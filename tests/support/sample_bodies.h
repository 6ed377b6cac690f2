// The names of parity/sample_bodies.h for tests.
#pragma once

#include "parity/sample_bodies.h"

namespace ringlet::test {
using namespace parity;
}
