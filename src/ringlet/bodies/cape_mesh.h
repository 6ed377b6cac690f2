// A cape for the bust: a collar that stands up, cloth on the shoulders, and a hem that hangs below them.
#pragma once

#include <vector>

#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

/// In the bust's axes [m] (bodies/bust_mesh.h); open in front.
struct CapeMesh {
  TriangleMesh mesh;
  std::vector<double> hang;  // of each point, its share of the way from the shoulders, 0, to the hem, 1
};

/// 4 mm off the bust where it lies on it.
CapeMesh makeCapeMesh();

}  // namespace ringlet
