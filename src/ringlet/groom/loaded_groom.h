// LoadedGroom: what a reader returns, the groom and what was odd about its file.
#pragma once

#include <string>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// A groom that can be used, and what a person should hear about its file, a sentence each.
struct LoadedGroom {
  Groom groom;
  std::vector<std::string> warnings;
};

}  // namespace ringlet
