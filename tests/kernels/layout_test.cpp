// The structs of shaders/shared/layout.h lie the same in C++ and in the compiled shaders: offsets and strides
// are read from the SPIR-V itself.
#include "shared/layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "ringlet_shaders/strand_step_serial_surroundings.h"
#include "ringlet_shaders/strand_step_surroundings.h"

namespace ringlet::test {
namespace {

// Member offsets of every struct of a module, by struct and member name; array strides by the struct they
// hold.
struct Reflection {
  std::map<std::string, std::map<std::string, std::uint32_t>> offsets;
  std::map<std::string, std::uint32_t> strides;

  explicit Reflection(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t kOpName = 5, kOpMemberName = 6, kOpDecorate = 71, kOpMemberDecorate = 72,
                            kOffset = 35, kArrayStride = 6, kOpTypeArray = 28, kOpTypeRuntimeArray = 29;
    std::map<std::uint32_t, std::string> names;
    std::map<std::uint32_t, std::map<std::uint32_t, std::string>> memberNames;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> memberOffsets;
    std::map<std::uint32_t, std::uint32_t> arrayStrides;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> 16) {
      const auto* word = &spirv[at];
      switch (word[0] & 0xffff) {
        case kOpName:
          names[word[1]] = reinterpret_cast<const char*>(word + 2);
          break;
        case kOpMemberName:
          memberNames[word[1]][word[2]] = reinterpret_cast<const char*>(word + 3);
          break;
        case kOpDecorate:
          if (word[2] == kArrayStride) arrayStrides[word[1]] = word[3];
          break;
        case kOpMemberDecorate:
          if (word[3] == kOffset) memberOffsets[word[1]][word[2]] = word[4];
          break;
        case kOpTypeArray:
        case kOpTypeRuntimeArray:
          if (arrayStrides.count(word[1])) strides[names[word[2]]] = arrayStrides[word[1]];
          break;
        default:
          break;
      }
    }
    for (const auto& [id, members] : memberOffsets) {
      for (const auto& [member, offset] : members) offsets[names[id]][memberNames[id][member]] = offset;
    }
  }
};

#define EXPECT_SAME_OFFSET(Struct, member) \
  EXPECT_EQ(offsets.at(#Struct).at(#member), offsetof(layout::Struct, member)) << #Struct "::" #member

void expectSameLayout(std::span<const std::uint32_t> spirv) {
  const Reflection reflection(spirv);
  const auto& offsets = reflection.offsets;
  EXPECT_SAME_OFFSET(ParticleRest, target);
  EXPECT_SAME_OFFSET(ParticleRest, mass);
  EXPECT_SAME_OFFSET(ParticleRest, edgeLength);
  EXPECT_SAME_OFFSET(ParticleRest, coreEdgeLength);
  EXPECT_SAME_OFFSET(ParticleRest, bendFactor);
  EXPECT_EQ(offsets.at("ParticleRest").size(), 5u);
  EXPECT_EQ(reflection.strides.at("ParticleRest"), sizeof(layout::ParticleRest));

  EXPECT_SAME_OFFSET(StrandRest, firstParticle);
  EXPECT_SAME_OFFSET(StrandRest, particleCount);
  EXPECT_SAME_OFFSET(StrandRest, bendBeta);
  EXPECT_SAME_OFFSET(StrandRest, coreBeta);
  EXPECT_SAME_OFFSET(StrandRest, stretchStiffness);
  EXPECT_SAME_OFFSET(StrandRest, stretchDamping);
  EXPECT_SAME_OFFSET(StrandRest, bendStiffness);
  EXPECT_SAME_OFFSET(StrandRest, bendDamping);
  EXPECT_SAME_OFFSET(StrandRest, coreStiffness);
  EXPECT_SAME_OFFSET(StrandRest, coreDamping);
  EXPECT_SAME_OFFSET(StrandRest, restCoreLength);
  EXPECT_SAME_OFFSET(StrandRest, jacobiGap);
  EXPECT_SAME_OFFSET(StrandRest, firstEdge);
  EXPECT_SAME_OFFSET(StrandRest, pins);
  EXPECT_EQ(offsets.at("StrandRest").size(), 14u);
  EXPECT_EQ(reflection.strides.at("StrandRest"), sizeof(layout::StrandRest));

  EXPECT_SAME_OFFSET(StrandReport, maxStretch);
  EXPECT_SAME_OFFSET(StrandReport, limitedEdges);
  EXPECT_SAME_OFFSET(StrandReport, degenerateEdges);
  EXPECT_SAME_OFFSET(StrandReport, nonfiniteParticles);
  EXPECT_SAME_OFFSET(StrandReport, firstNonfinite);
  EXPECT_SAME_OFFSET(StrandReport, velocityResidual);
  EXPECT_EQ(offsets.at("StrandReport").size(), 6u);
  EXPECT_EQ(reflection.strides.at("StrandReport"), sizeof(layout::StrandReport));

  EXPECT_SAME_OFFSET(StepPose, rotation);
  EXPECT_SAME_OFFSET(StepPose, turn);
  EXPECT_SAME_OFFSET(StepPose, velocityChange);
  EXPECT_EQ(offsets.at("StepPose").size(), 3u);
  EXPECT_EQ(reflection.strides.at("StepPose"), sizeof(layout::StepPose));

  EXPECT_SAME_OFFSET(BodyRest, halfExtents);
  EXPECT_SAME_OFFSET(BodyRest, bounds);
  EXPECT_SAME_OFFSET(BodyRest, gridOrigin);
  EXPECT_SAME_OFFSET(BodyRest, cells);
  EXPECT_SAME_OFFSET(BodyRest, firstCell);
  EXPECT_SAME_OFFSET(BodyRest, friction);
  EXPECT_SAME_OFFSET(BodyRest, shape);
  EXPECT_SAME_OFFSET(BodyRest, unused);
  EXPECT_EQ(offsets.at("BodyRest").size(), 8u);
  EXPECT_EQ(reflection.strides.at("BodyRest"), sizeof(layout::BodyRest));
  EXPECT_EQ(sizeof(layout::BodyRest), 5 * sizeof(layout::vec4)) << "read as texels";

  EXPECT_SAME_OFFSET(BodyPose, position);
  EXPECT_SAME_OFFSET(BodyPose, rotation);
  EXPECT_SAME_OFFSET(BodyPose, turn);
  EXPECT_SAME_OFFSET(BodyPose, velocity);
  EXPECT_EQ(offsets.at("BodyPose").size(), 4u);
  EXPECT_EQ(reflection.strides.at("BodyPose"), sizeof(layout::BodyPose));

  EXPECT_SAME_OFFSET(StepAir, wind);
  EXPECT_SAME_OFFSET(StepAir, phases);
  EXPECT_EQ(offsets.at("StepAir").size(), 2u);
  EXPECT_EQ(reflection.strides.at("StepAir"), sizeof(layout::StepAir));
  EXPECT_SAME_OFFSET(WindWave, wave);
  EXPECT_SAME_OFFSET(WindWave, amplitude);
  EXPECT_EQ(offsets.at("WindWave").size(), 2u);
  EXPECT_EQ(reflection.strides.at("WindWave"), sizeof(layout::WindWave));

  EXPECT_SAME_OFFSET(RootPose, position);
  EXPECT_SAME_OFFSET(RootPose, rotation);
  EXPECT_SAME_OFFSET(RootPose, turn);
  EXPECT_SAME_OFFSET(RootPose, velocity);
  EXPECT_EQ(offsets.at("RootPose").size(), 4u);
  EXPECT_EQ(reflection.strides.at("RootPose"), sizeof(layout::RootPose));

  EXPECT_SAME_OFFSET(StepParameters, gravity);
  EXPECT_SAME_OFFSET(StepParameters, maxStretch);
  EXPECT_SAME_OFFSET(StepParameters, coreRelaxedShare);
  EXPECT_SAME_OFFSET(StepParameters, coreElongationLow);
  EXPECT_SAME_OFFSET(StepParameters, coreElongationHigh);
  EXPECT_SAME_OFFSET(StepParameters, strandBegin);
  EXPECT_SAME_OFFSET(StepParameters, strandEnd);
  EXPECT_SAME_OFFSET(StepParameters, stepBegin);
  EXPECT_SAME_OFFSET(StepParameters, stepEnd);
  EXPECT_SAME_OFFSET(StepParameters, rootCount);
  EXPECT_SAME_OFFSET(StepParameters, pointIterations);
  EXPECT_SAME_OFFSET(StepParameters, chebyshev);
  EXPECT_SAME_OFFSET(StepParameters, forceLoops);
  EXPECT_SAME_OFFSET(StepParameters, dampingLoops);
  EXPECT_SAME_OFFSET(StepParameters, particleCount);
  EXPECT_SAME_OFFSET(StepParameters, phases);
  EXPECT_SAME_OFFSET(StepParameters, loopBegin);
  EXPECT_SAME_OFFSET(StepParameters, loopEnd);
  EXPECT_SAME_OFFSET(StepParameters, bodyCount);
  EXPECT_SAME_OFFSET(StepParameters, dragStrength);
  EXPECT_SAME_OFFSET(StepParameters, dragAlong);
  EXPECT_SAME_OFFSET(StepParameters, strandCount);
  EXPECT_EQ(offsets.at("StepParameters").size(), 22u);
  EXPECT_LE(sizeof(layout::StepParameters), 128u) << "Vulkan guarantees 128 bytes of push constants";
}

TEST(Layout, LanesKernelAgreesWithCpp) { expectSameLayout(k_strand_step_surroundings); }
TEST(Layout, SerialKernelAgreesWithCpp) { expectSameLayout(k_strand_step_serial_surroundings); }

}  // namespace
}  // namespace ringlet::test
