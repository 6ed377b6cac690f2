// Small USD text.
#pragma once

#include <string>

namespace ringlet::test {

/// A file with one BasisCurves prim, /Hair, of these attributes; `metadata` is the layer's.
inline std::string curves(const std::string& attributes, const std::string& metadata = "") {
  return "#usda 1.0\n" + metadata + "def BasisCurves \"Hair\" {\n" + attributes + "\n}\n";
}

/// Three particles and two.
inline const std::string kTwoStrands =
    "uniform token type = \"linear\"\nint[] curveVertexCounts = [3, 2]\npoint3f[] points = [(0, 0, 0), (0, "
    "-1, 0), (0, "
    "-2, 0.5), (1, 0, 0), (1, -1.5, 0)]";

}  // namespace ringlet::test
