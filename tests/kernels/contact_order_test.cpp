// The order of contact particles inside a bucket of the grid: by index, whichever thread came first. Mirrors
// shaders/kernels/contact_order.comp.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <utility>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::contact_order_test {
namespace {

constexpr std::uint32_t kContacts = 500, kBuckets = layout::kBucketBlock, kUsedBuckets = 9;

// The grid as contact_scatter.comp leaves it (shared/contact_buffers.glsl), with the particles of each bucket
// in an order of their own; and, of each place, the particle that should stand there.
struct Grid {
  std::vector<std::uint32_t> words;
  std::vector<std::uint32_t> ascending;
};
Grid shuffledGrid() {
  std::mt19937 random(3);
  std::vector<std::vector<std::uint32_t>> buckets(kBuckets);
  std::vector<std::uint32_t> bucketOf, entries;
  for (std::uint32_t c = 0; c < kContacts; ++c) {
    bucketOf.push_back(static_cast<std::uint32_t>(random() % kUsedBuckets));
    buckets[bucketOf.back()].push_back(c);
  }
  Grid grid;
  grid.words.resize(kBuckets);  // counts, zero again
  for (std::vector<std::uint32_t>& bucket : buckets) {
    grid.words.push_back(static_cast<std::uint32_t>(entries.size()));
    grid.ascending.insert(grid.ascending.end(), bucket.begin(), bucket.end());
    std::shuffle(bucket.begin(), bucket.end(), random);
    entries.insert(entries.end(), bucket.begin(), bucket.end());
  }
  const std::vector<std::uint32_t> ends{0, 0, kContacts};  // start beyond the last bucket; blocks' sums
  const std::vector<std::uint32_t> ranks(kContacts);       // used up
  for (const auto* part : {&ends, &std::as_const(bucketOf), &ranks, &std::as_const(entries)})
    grid.words.insert(grid.words.end(), part->begin(), part->end());
  return grid;
}

class ContactOrder : public GpuTest {
 protected:
  // The places after one dispatch.
  std::vector<layout::ContactPlace> order(const Grid& grid, bool texels) {
    std::vector<layout::vec4> positions;
    std::vector<layout::ContactRest> rests;
    for (std::uint32_t c = 0; c < kContacts; ++c) {
      positions.push_back({float(c), 1, 2, 0});
      layout::ContactRest& rest = rests.emplace_back();
      rest.particle = c, rest.strand = c / 2;
    }
    auto kernel = gpu::Kernel::create(gpu(), describeContactKernel(ContactKernel::order, {.texels = texels}));
    auto unused = createZero(gpu(), kContacts * sizeof(layout::ContactPlace), "unused");
    auto position = createFilled(gpu(), positions, "positions");
    auto rest = createFilled(gpu(), rests, "contacts");
    auto words = createFilled(gpu(), grid.words, "grid");
    auto places = createZero(gpu(), kContacts * sizeof(layout::ContactPlace), "places");
    EXPECT_TRUE(kernel && unused && position && rest && words && places);
    gpu::BufferTable buffers{{layout::kBindContactPositions, *position},
                             {layout::kBindContactPositionTexels, *position},
                             {layout::kBindContactSolved, *position},
                             {layout::kBindContactSolvedTexels, *position},
                             {layout::kBindContacts, *rest},
                             {layout::kBindContactTexels, *rest},
                             {layout::kBindGrid, *words},
                             {layout::kBindPlaces, *places}};
    layout::ContactNumbers numbers{};
    numbers.contactCount = kContacts, numbers.bucketCount = kBuckets;
    auto ofNumbers = createFilled(gpu(), std::vector{numbers}, "numbers");
    EXPECT_TRUE(ofNumbers);
    buffers.emplace(layout::kBindContactNumbers, *ofNumbers);
    for (const auto& [number, kind] : (*kernel)->bindings()) buffers.emplace(number, *unused);
    auto bindings = gpu::Bindings::create(**kernel, buffers);
    auto recorder = gpu::Recorder::create(gpu(), "order");
    EXPECT_TRUE(bindings && recorder && recorder->begin());
    recorder->dispatch(**kernel, *bindings, layout::ContactParameters{}, (kContacts + 63) / 64);
    EXPECT_TRUE(recorder->submitAndWait());
    return *downloadAll<layout::ContactPlace>(*places, kContacts);
  }
};

TEST_F(ContactOrder, IsByIndexInEveryBucket) {
  const Grid grid = shuffledGrid();
  for (const bool texels : {false, true}) {
    const auto places = order(grid, texels);
    for (std::uint32_t i = 0; i < kContacts; ++i) {
      const std::uint32_t c = grid.ascending[i];
      ASSERT_EQ(places[i].velocity.w, c) << "place " << i;
      EXPECT_EQ(std::bit_cast<float>(places[i].position.x), float(c)) << "place " << i;
      EXPECT_EQ(places[i].position.w, c / 2) << "place " << i;
    }
  }
}

}  // namespace
}  // namespace ringlet::test::contact_order_test
