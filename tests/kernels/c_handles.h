// Handles of the C interface for its tests, and grooms and poses as it takes them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/c/handles.h"
#include "ringlet/c/ringlet.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {

// Handles of C, released at the end.
struct Handles {
  ringlet_device* device = nullptr;
  ringlet_settings* settings = nullptr;
  ringlet_material* material = nullptr;
  ringlet_asset* asset = nullptr;
  std::vector<ringlet_hair*> hairs;
  ~Handles() {
    ringlet_device_release(device);  // in any order
    for (ringlet_hair* hair : hairs) ringlet_hair_release(hair);
    ringlet_asset_release(asset);
    ringlet_material_release(material);
    ringlet_settings_release(settings);
  }
};

class CTest : public GpuTest {
 protected:
  // Opened by the fixture, so that the validation layer is watched.
  void open(Handles& c) {
    c.device = new ringlet_device{device(), device().name()};
    ASSERT_EQ(ringlet_settings_create(&c.settings), RINGLET_OK);
    ASSERT_EQ(ringlet_material_create(nullptr, &c.material), RINGLET_OK);
  }
};

struct CGroom {
  std::vector<std::uint32_t> sizes;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  explicit CGroom(const Groom& from) {
    for (std::size_t s = 0; s < from.strandCount(); ++s)
      sizes.push_back(static_cast<std::uint32_t>(from.strand(s).size()));
    groom.points = &from.points[0].x, groom.strand_sizes = sizes.data();
    groom.strand_count = static_cast<std::uint32_t>(sizes.size());
    groom.metres_per_unit = from.metresPerUnit;
  }
};

inline ringlet_pose poseOf(const HeadPose& head) {
  return {{head.position.x, head.position.y, head.position.z},
          {head.rotation.x, head.rotation.y, head.rotation.z, head.rotation.w}};
}

inline std::vector<Vec3f> positionsOf(const ringlet_hair* hair, std::size_t count) {
  std::vector<Vec3f> points(count);
  EXPECT_EQ(ringlet_positions(hair, &points[0].x, count), RINGLET_OK) << ringlet_error_message();
  return points;
}

inline void expectInvalid(ringlet_result result, const char* part) {
  EXPECT_EQ(result, RINGLET_ERROR_INVALID_ARGUMENT) << part;
  EXPECT_NE(std::string(ringlet_error_message()).find(part), std::string::npos) << ringlet_error_message();
}

}  // namespace ringlet::test
