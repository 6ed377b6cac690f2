// Every struct of shaders/layout lies the same in C++ and in every embedded shader. Offsets, sizes and array
// strides are read from the SPIR-V itself, and which structs and members there are from the layout's files.
#include "layout/bodies.h"
#include "layout/contacts.h"
#include "layout/fields.h"
#include "layout/follow.h"
#include "layout/frame.h"
#include "layout/mesh_fields.h"
#include "layout/parts.h"
#include "layout/picture.h"
#include "layout/pose.h"
#include "layout/strands.h"
#include "layout/volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "embedded_modules.h"
#include "tests/support/spirv_structs.h"

namespace ringlet::test::layout_test {
namespace {

struct CppStruct {
  std::string name;
  std::uint32_t size;                // [bytes]
  std::vector<SpirvMember> members;  // in order
};

// The one list of the C++ side, which cmake/list_layout.cmake makes of shaders/layout.
const std::vector<CppStruct> kCppStructs = {
#define RINGLET_MEMBER(member) \
  SpirvMember { #member, offsetof(S, member), sizeof(S::member) }
#define RINGLET_STRUCT(name, ...)                      \
  [] {                                                 \
    using S = layout::name;                            \
    return CppStruct{#name, sizeof(S), {__VA_ARGS__}}; \
  }(),
#include "layout_structs.inc"
};

const CppStruct* cppStruct(const std::string& name) {
  const auto found = std::ranges::find(kCppStructs, name, &CppStruct::name);
  return found == kCppStructs.end() ? nullptr : &*found;
}

void expectSame(const SpirvStruct& shader, const CppStruct& cpp) {
  SCOPED_TRACE("struct " + cpp.name);
  ASSERT_EQ(shader.members.size(), cpp.members.size());
  for (std::size_t k = 0; k < cpp.members.size(); ++k) {
    EXPECT_EQ(shader.members[k].name, cpp.members[k].name);
    EXPECT_EQ(shader.members[k].offset, cpp.members[k].offset) << cpp.members[k].name;
    EXPECT_EQ(shader.members[k].size, cpp.members[k].size) << cpp.members[k].name;
  }
  for (const std::uint32_t stride : shader.strides) EXPECT_EQ(stride, cpp.size);
}

TEST(Layout, EmbeddedShadersAgreeWithCpp) {
  std::set<std::string> seen;
  for (const EmbeddedModule& module : kEmbeddedModules) {
    SCOPED_TRACE(module.name);
    for (const SpirvStruct& shader : SpirvModule(module.words).structs()) {
      const CppStruct* cpp = cppStruct(shader.name);
      ASSERT_TRUE(cpp) << "struct " << shader.name << " is not in shaders/layout";
      expectSame(shader, *cpp);
      seen.insert(shader.name);
    }
  }
  for (const CppStruct& cpp : kCppStructs)
    EXPECT_TRUE(seen.count(cpp.name)) << "no shader holds struct " << cpp.name << " in a buffer";
}

TEST(Layout, PushConstantsFitEveryDevice) {
  EXPECT_LE(sizeof(layout::StepParameters), 48u) << "ranges and steps only; settings are in HairNumbers";
  EXPECT_LE(sizeof(layout::ContactParameters), 48u);
  EXPECT_LE(sizeof(layout::VolumeParameters), 48u);
  EXPECT_LE(sizeof(layout::FollowParameters), 128u);
}

// They are read as texels of 16 bytes (shared/texels.glsl).
TEST(Layout, TexelRecordsAreWholeTexels) {
  for (const char* name :
       {"ParticleRest",  "StrandRest",   "RootPose",       "BodyRest",       "BodyPose",    "StepAir",
        "StepField",     "WindWave",     "ContactRest",    "ContactPair",    "ContactLife", "ContactForce",
        "ContactSystem", "ContactPlace", "ContactHistory", "VolumeParticle", "VolumeState", "VolumeParcel",
        "VolumeBrought", "CoreRow",      "FollowGuide",    "FollowHair",     "FollowBlend"})
    EXPECT_EQ(cppStruct(name)->size % sizeof(layout::vec4), 0u) << name;
}

}  // namespace
}  // namespace ringlet::test::layout_test
