// LoadedGroom: what a reader returns, the groom and what was odd about its file.
#pragma once

#include <string>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// How a groom is wanted.
struct GroomReading {
  bool upIsZ = false;  // a file that states its up axis is turned to this one, Y or Z
};

/// A groom that can be used, and what a person should hear about its file, a sentence each.
struct LoadedGroom {
  Groom groom;
  std::vector<std::string> warnings;
  bool statesUnit = false;  // groom.metresPerUnit is what the file says; else it is only the usual one
  bool statesUp = false;    // the file says which axis points up
};

}  // namespace ringlet
