// A hair's scattering on the device against the reference, over directions, colours and roughness.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "layout/types.h"
#include "reference/equations/hair_scattering.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet_shaders/scatter_probe_test.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::scatter_probe_test {
namespace {

using layout::vec4;
using reference::HairFibre;

struct Case {
  HairFibre fibre;
  double in, out, phi;
};

std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (const double along : {0.01, 0.085, 0.4})
    for (const double absorption : {0.0, 0.4, 2.0})
      for (const double in : {-1.5, -1.1, -0.4, 0.0, 0.7, 1.3})
        for (const double out : {-1.4, -0.3, 0.0, 0.4, 1.0})
          for (const double phi : {0.0, 0.3, 1.2, 2.4, 3.1})
            cases.push_back({{{absorption, 2 * absorption, 0.1}, along, 0.3, 0.04}, in, out, phi});
  return cases;
}

vec4 direction(double elevation, double azimuth) {
  return {static_cast<float>(std::cos(elevation) * std::cos(azimuth)),
          static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
          static_cast<float>(std::sin(elevation)), 0};
}

using ScatterProbe = GpuTest;

TEST_F(ScatterProbe, IsTheReference) {
  const std::vector<Case> cases = allCases();
  std::vector<vec4> inputs;
  for (const Case& each : cases) {
    const auto a = each.fibre.absorption.cast<float>();
    inputs.push_back(direction(each.in, 0.5));
    inputs.push_back(direction(each.out, 0.5 + each.phi));
    inputs.push_back({a.x(), a.y(), a.z(), static_cast<float>(each.fibre.along)});
    inputs.push_back({static_cast<float>(each.fibre.about), static_cast<float>(each.fibre.tilt), 0, 0});
  }
  const auto given = createFilled(gpu(), inputs, "cases"),
             found = createZero(gpu(), 16 * cases.size(), "found");
  ASSERT_TRUE(given && found);
  gpu::KernelDescription description;
  description.name = "scatter_probe";
  description.spirv = k_scatter_probe_test;
  const auto kernel = gpu::Kernel::create(gpu(), description);
  ASSERT_TRUE(kernel) << kernel.error().message;
  const auto bindings = gpu::Bindings::create(**kernel, {{0, *given}, {1, *found}});
  auto recorder = gpu::Recorder::create(gpu(), "probe");
  ASSERT_TRUE(bindings && recorder && recorder->begin());
  recorder->dispatch(**kernel, *bindings, std::span<const std::byte>(),
                     static_cast<std::uint32_t>((cases.size() + 63) / 64));
  ASSERT_TRUE(recorder->submitAndWait());
  const auto results = downloadAll<vec4>(*found, cases.size());
  ASSERT_TRUE(results);

  // The Bessel function is a fit to 0.4 %, angles are right to 7e-5 of lobes of 0.1 rad, and Vulkan owes
  // exp() some units in the last place of exponents up to 50.
  double brightest = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& each = cases[i];
    const auto expected = scatteredByHair(each.fibre, each.in, each.out, each.phi);
    const reference::Vector3<double> device{(*results)[i].x, (*results)[i].y, (*results)[i].z};
    const double tolerance = 0.006 * expected.norm() + 1e-4;
    ASSERT_LT((device - expected).norm(), tolerance)
        << each.fibre.along << " in " << each.in << " out " << each.out << " phi " << each.phi << ": "
        << device.transpose() << ", expected " << expected.transpose();
    brightest = std::max(brightest, expected.norm());
  }
  EXPECT_GT(brightest, 1);
}

}  // namespace
}  // namespace ringlet::test::scatter_probe_test
