// Mirrors program/device/conform_facts.h: each number of the report is the device's.
#include "program/device/conform_facts.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "ringlet/gpu/device.h"
#include "tests/support/gpu_test.h"

namespace ringlet::program::conform_facts_test {
namespace {

class ConformFacts : public test::GpuTest {};

TEST_F(ConformFacts, AreTheDevices) {
  const gpu::DeviceProperties& p = gpu().properties();
  const auto facts = factsOf(device());
  EXPECT_EQ(facts["type"], p.type);
  const std::pair<const char*, std::uint64_t> numbers[] = {{"workgroups", p.maxGroupCount},
                                                           {"storage_buffer_bytes", p.maxStorageBufferRange},
                                                           {"uniform_buffer_bytes", p.maxUniformBufferRange},
                                                           {"texel_records", p.maxTexelRecords},
                                                           {"allocation_bytes", p.maxAllocationBytes},
                                                           {"shared_memory_bytes", p.maxSharedMemoryBytes}};
  for (const auto& [name, number] : numbers) EXPECT_EQ(facts.at(name), number) << name;
  EXPECT_NE(p.maxStorageBufferRange, p.maxUniformBufferRange) << "or the two may be exchanged unseen";
}

}  // namespace
}  // namespace ringlet::program::conform_facts_test
