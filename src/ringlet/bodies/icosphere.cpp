// Implements bodies/icosphere.h.
#include "ringlet/bodies/icosphere.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr double kGolden = std::numbers::phi;
constexpr std::array<Vec3d, 12> kCorners{{{-1, kGolden, 0},
                                          {1, kGolden, 0},
                                          {-1, -kGolden, 0},
                                          {1, -kGolden, 0},
                                          {0, -1, kGolden},
                                          {0, 1, kGolden},
                                          {0, -1, -kGolden},
                                          {0, 1, -kGolden},
                                          {kGolden, 0, -1},
                                          {kGolden, 0, 1},
                                          {-kGolden, 0, -1},
                                          {-kGolden, 0, 1}}};
constexpr std::array<std::array<std::uint32_t, 3>, 20> kFaces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

}  // namespace

TriangleMesh makeIcosphere(int frequency) {
  RINGLET_ASSERT(frequency >= 1, "makeIcosphere needs a frequency of 1 or more");
  TriangleMesh mesh;
  // A point by its weights of the icosahedron's corners, in order: neighbouring faces then share it exactly.
  using Weights = std::array<std::pair<std::uint32_t, int>, 3>;
  std::map<Weights, std::uint32_t> known;
  auto pointAt = [&](const std::array<std::uint32_t, 3>& face, int i, int j) {
    Weights weights{{{face[0], frequency - i - j}, {face[1], i}, {face[2], j}}};
    for (auto& weight : weights) {
      if (weight.second == 0) weight.first = 0;  // whose corner does not matter
    }
    std::ranges::sort(weights);
    const auto [entry, isNew] = known.try_emplace(weights, static_cast<std::uint32_t>(mesh.points.size()));
    if (isNew) {
      Vec3d sum{};
      for (const auto& [corner, weight] : weights) sum += kCorners[corner] * weight;
      mesh.points.push_back(sum / length(sum));
    }
    return entry->second;
  };
  for (const auto& face : kFaces) {
    for (int i = 0; i < frequency; ++i) {
      for (int j = 0; i + j < frequency; ++j) {
        mesh.triangles.push_back({pointAt(face, i, j), pointAt(face, i + 1, j), pointAt(face, i, j + 1)});
        if (i + j + 1 == frequency) continue;
        mesh.triangles.push_back(
            {pointAt(face, i + 1, j), pointAt(face, i + 1, j + 1), pointAt(face, i, j + 1)});
      }
    }
  }
  return mesh;
}

}  // namespace ringlet
