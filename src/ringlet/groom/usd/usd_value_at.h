// usdValueAt: what samples of a USD attribute say between them.
#pragma once

#include <vector>

#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// Of one sample or more, by rising time: straight between numbers, of one quaternion the shorter way. Before
/// the first and after the last these hold, and between two of other sizes the one before.
UsdValue usdValueAt(const std::vector<UsdSample>& samples, double time);

}  // namespace ringlet
