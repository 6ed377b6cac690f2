// A groom as Python holds it: checked once, constant from then on.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "python/binding.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet::python {

/// Has a strand, two particles in each, all finite, and a unit above 0: what the library takes for granted.
class GroomObject {
 public:
  /// Throws ValueError for one that is not so.
  explicit GroomObject(LoadedGroom loaded);

  const Groom& groom() const { return loaded_.groom; }
  const std::vector<std::string>& warnings() const { return loaded_.warnings; }
  std::size_t particleCount() const { return groom().points.size(); }

 private:
  LoadedGroom loaded_;
};
using GroomHandle = std::shared_ptr<GroomObject>;

}  // namespace ringlet::python
