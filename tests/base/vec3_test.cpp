// Tests base/vec3.h: rounding to what floats store, in a loop that compilers join components in.
#include "ringlet/base/vec3.h"

#include <gtest/gtest.h>

#include <vector>

namespace ringlet::test::vec3_test {
namespace {

TEST(Vec3, AsStoredIsWhatFloatsHold) {
  std::vector<Vec3d> places;
  std::vector<double> masses;
  for (int i = 1; i < 50; ++i) places.push_back({0.1 * i, 1.0 / i, -0.3 / i}), masses.push_back(i % 3);
  std::vector<Vec3d> stored = places;
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (masses[i] > 0) stored[i] = asStored(stored[i]);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const volatile float x = float(places[i].x), y = float(places[i].y), z = float(places[i].z);
    EXPECT_EQ(stored[i], masses[i] > 0 ? (Vec3d{x, y, z}) : places[i]) << i;
  }
}

}  // namespace
}  // namespace ringlet::test::vec3_test
