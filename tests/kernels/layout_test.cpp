// Every struct of shaders/layout lies the same in C++ and in every embedded shader. Offsets, sizes
// and array strides are read from the SPIR-V itself, and which structs there are is read from its files.
#include "layout/bodies.h"
#include "layout/contacts.h"
#include "layout/fields.h"
#include "layout/follow.h"
#include "layout/frame.h"
#include "layout/parts.h"
#include "layout/picture.h"
#include "layout/pose.h"
#include "layout/strands.h"
#include "layout/volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <regex>

#include "embedded_modules.h"
#include "tests/support/spirv_structs.h"

namespace ringlet::test::layout_test {
namespace {

struct CppStruct {
  std::string name;
  std::uint32_t size;                // [bytes]
  std::vector<SpirvMember> members;  // in order
};

#define RINGLET_MEMBER(member) \
  SpirvMember { #member, offsetof(S, member), sizeof(S::member) }

// The one list of the C++ side.
const std::vector<CppStruct> kCppStructs = {
    [] {
      using S = layout::ParticleRest;
      return CppStruct{
          "ParticleRest",
          sizeof(S),
          {RINGLET_MEMBER(target), RINGLET_MEMBER(stretchRestLength), RINGLET_MEMBER(mass),
           RINGLET_MEMBER(edgeLength), RINGLET_MEMBER(coreEdgeLength), RINGLET_MEMBER(bendFactor)}};
    }(),
    [] {
      using S = layout::StrandRest;
      return CppStruct{
          "StrandRest",
          sizeof(S),
          {RINGLET_MEMBER(firstParticle), RINGLET_MEMBER(particleCount), RINGLET_MEMBER(bendBeta),
           RINGLET_MEMBER(coreBeta), RINGLET_MEMBER(stretchStiffness), RINGLET_MEMBER(stretchDamping),
           RINGLET_MEMBER(bendStiffness), RINGLET_MEMBER(bendDamping), RINGLET_MEMBER(coreStiffness),
           RINGLET_MEMBER(coreDamping), RINGLET_MEMBER(restCoreLength), RINGLET_MEMBER(jacobiGap),
           RINGLET_MEMBER(firstEdge), RINGLET_MEMBER(massUnit), RINGLET_MEMBER(pins)}};
    }(),
    [] {
      using S = layout::StrandReport;
      return CppStruct{"StrandReport",
                       sizeof(S),
                       {RINGLET_MEMBER(maxStretch), RINGLET_MEMBER(limitedEdges),
                        RINGLET_MEMBER(degenerateEdges), RINGLET_MEMBER(nonfiniteParticles),
                        RINGLET_MEMBER(firstNonfinite), RINGLET_MEMBER(velocityResidual)}};
    }(),
    [] {
      using S = layout::StepPose;
      return CppStruct{"StepPose",
                       sizeof(S),
                       {RINGLET_MEMBER(rotation), RINGLET_MEMBER(turn), RINGLET_MEMBER(velocityChange),
                        RINGLET_MEMBER(shiftedShare)}};
    }(),
    [] {
      using S = layout::RootPose;
      return CppStruct{"RootPose",
                       sizeof(S),
                       {RINGLET_MEMBER(position), RINGLET_MEMBER(rotation), RINGLET_MEMBER(turn),
                        RINGLET_MEMBER(velocity)}};
    }(),
    [] {
      using S = layout::BodyRest;
      return CppStruct{
          "BodyRest",
          sizeof(S),
          {RINGLET_MEMBER(halfExtents), RINGLET_MEMBER(rounding), RINGLET_MEMBER(bounds),
           RINGLET_MEMBER(gridOrigin), RINGLET_MEMBER(cell), RINGLET_MEMBER(cells), RINGLET_MEMBER(firstCell),
           RINGLET_MEMBER(friction), RINGLET_MEMBER(shape), RINGLET_MEMBER(unused)}};
    }(),
    [] {
      using S = layout::BodyPose;
      return CppStruct{"BodyPose",
                       sizeof(S),
                       {RINGLET_MEMBER(position), RINGLET_MEMBER(moves), RINGLET_MEMBER(rotation),
                        RINGLET_MEMBER(turn), RINGLET_MEMBER(velocity)}};
    }(),
    [] {
      using S = layout::StepAir;
      return CppStruct{"StepAir", sizeof(S), {RINGLET_MEMBER(wind), RINGLET_MEMBER(phases)}};
    }(),
    [] {
      using S = layout::WindWave;
      return CppStruct{"WindWave", sizeof(S), {RINGLET_MEMBER(wave), RINGLET_MEMBER(amplitude)}};
    }(),
    [] {
      using S = layout::StepField;
      return CppStruct{
          "StepField",
          sizeof(S),
          {RINGLET_MEMBER(place), RINGLET_MEMBER(axial), RINGLET_MEMBER(axis), RINGLET_MEMBER(radial),
           RINGLET_MEMBER(still), RINGLET_MEMBER(around), RINGLET_MEMBER(aboutAxis), RINGLET_MEMBER(core),
           RINGLET_MEMBER(perReach), RINGLET_MEMBER(drag), RINGLET_MEMBER(front),
           RINGLET_MEMBER(perThickness), RINGLET_MEMBER(gridShare), RINGLET_MEMBER(cell),
           RINGLET_MEMBER(rotation), RINGLET_MEMBER(nodes), RINGLET_MEMBER(firstNode)}};
    }(),
    [] {
      using S = layout::StepParameters;
      return CppStruct{"StepParameters",
                       sizeof(S),
                       {RINGLET_MEMBER(gravity),
                        RINGLET_MEMBER(seconds),
                        RINGLET_MEMBER(maxStretch),
                        RINGLET_MEMBER(coreRelaxedShare),
                        RINGLET_MEMBER(coreElongationLow),
                        RINGLET_MEMBER(coreElongationHigh),
                        RINGLET_MEMBER(strandBegin),
                        RINGLET_MEMBER(strandEnd),
                        RINGLET_MEMBER(stepBegin),
                        RINGLET_MEMBER(stepEnd),
                        RINGLET_MEMBER(rootCount),
                        RINGLET_MEMBER(pointIterations),
                        RINGLET_MEMBER(chebyshev),
                        RINGLET_MEMBER(forceLoops),
                        RINGLET_MEMBER(dampingLoops),
                        RINGLET_MEMBER(particleCount),
                        RINGLET_MEMBER(phases),
                        RINGLET_MEMBER(bodyCount),
                        RINGLET_MEMBER(dragStrength),
                        RINGLET_MEMBER(dragAlong),
                        RINGLET_MEMBER(strandCount),
                        RINGLET_MEMBER(stepCount),
                        RINGLET_MEMBER(fieldCount),
                        RINGLET_MEMBER(headCount),
                        RINGLET_MEMBER(headParticles),
                        RINGLET_MEMBER(headStrands),
                        RINGLET_MEMBER(headPoses),
                        RINGLET_MEMBER(inertiaFactor)}};
    }(),
    [] {
      using S = layout::ContactRest;
      return CppStruct{"ContactRest",
                       sizeof(S),
                       {RINGLET_MEMBER(point), RINGLET_MEMBER(radius), RINGLET_MEMBER(particle),
                        RINGLET_MEMBER(strand), RINGLET_MEMBER(mass), RINGLET_MEMBER(inverseMassUnit)}};
    }(),
    [] {
      using S = layout::ContactPair;
      return CppStruct{"ContactPair",
                       sizeof(S),
                       {RINGLET_MEMBER(particle), RINGLET_MEMBER(restLength), RINGLET_MEMBER(stiffness),
                        RINGLET_MEMBER(damping)}};
    }(),
    [] {
      using S = layout::ContactLife;
      return CppStruct{"ContactLife",
                       sizeof(S),
                       {RINGLET_MEMBER(particle), RINGLET_MEMBER(shares), RINGLET_MEMBER(restLength),
                        RINGLET_MEMBER(stiffness)}};
    }(),
    [] {
      using S = layout::ContactForce;
      return CppStruct{"ContactForce",
                       sizeof(S),
                       {RINGLET_MEMBER(normal), RINGLET_MEMBER(particle), RINGLET_MEMBER(damping),
                        RINGLET_MEMBER(gap), RINGLET_MEMBER(unused)}};
    }(),
    [] {
      using S = layout::ContactSystem;
      return CppStruct{"ContactSystem",
                       sizeof(S),
                       {RINGLET_MEMBER(diagonal), RINGLET_MEMBER(offDiagonal), RINGLET_MEMBER(momentum)}};
    }(),
    [] {
      using S = layout::VolumeParticle;
      return CppStruct{"VolumeParticle",
                       sizeof(S),
                       {RINGLET_MEMBER(particle), RINGLET_MEMBER(mass), RINGLET_MEMBER(ownDensity),
                        RINGLET_MEMBER(inverseMassUnit)}};
    }(),
    [] {
      using S = layout::VolumeState;
      return CppStruct{"VolumeState",
                       sizeof(S),
                       {RINGLET_MEMBER(memory), RINGLET_MEMBER(place), RINGLET_MEMBER(predicted)}};
    }(),
    [] {
      using S = layout::VolumeParcel;
      return CppStruct{"VolumeParcel", sizeof(S), {RINGLET_MEMBER(rate), RINGLET_MEMBER(place)}};
    }(),
    [] {
      using S = layout::VolumeControl;
      return CppStruct{
          "VolumeControl",
          sizeof(S),
          {RINGLET_MEMBER(indirectBlocks), RINGLET_MEMBER(cellCount), RINGLET_MEMBER(indirectNodes),
           RINGLET_MEMBER(cut), RINGLET_MEMBER(least), RINGLET_MEMBER(cellsPerMetre),
           RINGLET_MEMBER(greatest), RINGLET_MEMBER(cell), RINGLET_MEMBER(low), RINGLET_MEMBER(largest),
           RINGLET_MEMBER(size), RINGLET_MEMBER(largestCell), RINGLET_MEMBER(finished)}};
    }(),
    [] {
      using S = layout::VolumeParameters;
      return CppStruct{
          "VolumeParameters",
          sizeof(S),
          {RINGLET_MEMBER(count), RINGLET_MEMBER(cellCapacity), RINGLET_MEMBER(step), RINGLET_MEMBER(seconds),
           RINGLET_MEMBER(cell), RINGLET_MEMBER(drag), RINGLET_MEMBER(stiffness), RINGLET_MEMBER(kept),
           RINGLET_MEMBER(warmth), RINGLET_MEMBER(sorts), RINGLET_MEMBER(mostRate),
           RINGLET_MEMBER(unitsPerGain), RINGLET_MEMBER(unitsPerMass)}};
    }(),
    [] {
      using S = layout::FrameParameters;
      return CppStruct{
          "FrameParameters", sizeof(S), {RINGLET_MEMBER(count), RINGLET_MEMBER(begin), RINGLET_MEMBER(end)}};
    }(),
    [] {
      using S = layout::PartParameters;
      return CppStruct{"PartParameters", sizeof(S), {RINGLET_MEMBER(count), RINGLET_MEMBER(isStep)}};
    }(),
    [] {
      using S = layout::ContactPlace;
      return CppStruct{"ContactPlace", sizeof(S), {RINGLET_MEMBER(position), RINGLET_MEMBER(velocity)}};
    }(),
    [] {
      using S = layout::ContactHistory;
      return CppStruct{"ContactHistory",
                       sizeof(S),
                       {RINGLET_MEMBER(position), RINGLET_MEMBER(velocity), RINGLET_MEMBER(predicted)}};
    }(),
    [] {
      using S = layout::ContactControl;
      return CppStruct{"ContactControl",
                       sizeof(S),
                       {RINGLET_MEMBER(indirectContacts),
                        RINGLET_MEMBER(isListed),
                        RINGLET_MEMBER(indirectBuckets),
                        RINGLET_MEMBER(parity),
                        RINGLET_MEMBER(isHalted),
                        RINGLET_MEMBER(finished),
                        RINGLET_MEMBER(indirectSample),
                        RINGLET_MEMBER(isDue),
                        RINGLET_MEMBER(indirectQuery),
                        RINGLET_MEMBER(sampled),
                        RINGLET_MEMBER(indirectMeeting),
                        RINGLET_MEMBER(meetingCount),
                        RINGLET_MEMBER(motion),
                        RINGLET_MEMBER(speed),
                        RINGLET_MEMBER(cellSize),
                        RINGLET_MEMBER(cellsPerMetre),
                        RINGLET_MEMBER(longestList),
                        RINGLET_MEMBER(blocks),
                        RINGLET_MEMBER(longestLive),
                        RINGLET_MEMBER(liveBlocks),
                        RINGLET_MEMBER(missed),
                        RINGLET_MEMBER(step),
                        RINGLET_MEMBER(steps),
                        RINGLET_MEMBER(rebuilds),
                        RINGLET_MEMBER(listed),
                        RINGLET_MEMBER(pairTests)}};
    }(),
    [] {
      using S = layout::ContactParameters;
      return CppStruct{
          "ContactParameters", sizeof(S), {RINGLET_MEMBER(contactCount),   RINGLET_MEMBER(bucketCount),
                                           RINGLET_MEMBER(blockCount),     RINGLET_MEMBER(mostBlocks),
                                           RINGLET_MEMBER(liveBlockCount), RINGLET_MEMBER(mostLiveBlocks),
                                           RINGLET_MEMBER(everyPair),      RINGLET_MEMBER(step),
                                           RINGLET_MEMBER(seconds),        RINGLET_MEMBER(skin),
                                           RINGLET_MEMBER(largestRadius),  RINGLET_MEMBER(stiffness),
                                           RINGLET_MEMBER(dampingRatio),   RINGLET_MEMBER(friction),
                                           RINGLET_MEMBER(ramp),           RINGLET_MEMBER(stiffnessRelease),
                                           RINGLET_MEMBER(dampingRelease), RINGLET_MEMBER(reachFactor),
                                           RINGLET_MEMBER(breakFactor),    RINGLET_MEMBER(seenAhead),
                                           RINGLET_MEMBER(listedAhead),    RINGLET_MEMBER(whose),
                                           RINGLET_MEMBER(mostSampled),    RINGLET_MEMBER(sampleStride),
                                           RINGLET_MEMBER(warmth),         RINGLET_MEMBER(cellsPerMetre)}};
    }(),
    [] {
      using S = layout::CoreRow;
      return CppStruct{"CoreRow",
                       sizeof(S),
                       {RINGLET_MEMBER(firstParticle), RINGLET_MEMBER(firstRecord),
                        RINGLET_MEMBER(recordCount), RINGLET_MEMBER(beginsPiece)}};
    }(),
    [] {
      using S = layout::FollowGuide;
      return CppStruct{"FollowGuide",
                       sizeof(S),
                       {RINGLET_MEMBER(restFrame), RINGLET_MEMBER(firstParticle),
                        RINGLET_MEMBER(particleCount), RINGLET_MEMBER(unused)}};
    }(),
    [] {
      using S = layout::FollowHair;
      return CppStruct{"FollowHair",
                       sizeof(S),
                       {RINGLET_MEMBER(offset), RINGLET_MEMBER(guide), RINGLET_MEMBER(phase),
                        RINGLET_MEMBER(radius), RINGLET_MEMBER(lengthShare), RINGLET_MEMBER(spread),
                        RINGLET_MEMBER(firstPoint), RINGLET_MEMBER(rootOffset)}};
    }(),
    [] {
      using S = layout::FollowBlend;
      return CppStruct{"FollowBlend",
                       sizeof(S),
                       {RINGLET_MEMBER(offsets), RINGLET_MEMBER(guides), RINGLET_MEMBER(unused)}};
    }(),
    [] {
      using S = layout::NearCount;
      return CppStruct{"NearCount", sizeof(S), {RINGLET_MEMBER(indirect), RINGLET_MEMBER(points)}};
    }(),
    [] {
      using S = layout::FollowParameters;
      return CppStruct{"FollowParameters",
                       sizeof(S),
                       {RINGLET_MEMBER(head), RINGLET_MEMBER(count), RINGLET_MEMBER(stride),
                        RINGLET_MEMBER(particles), RINGLET_MEMBER(bodyCount)}};
    }(),
    [] {
      using S = layout::PosePlace;
      return CppStruct{"PosePlace", sizeof(S), {RINGLET_MEMBER(point), RINGLET_MEMBER(tag)}};
    }(),
    [] {
      using S = layout::PoseParameters;
      return CppStruct{"PoseParameters",
                       sizeof(S),
                       {RINGLET_MEMBER(turn), RINGLET_MEMBER(count), RINGLET_MEMBER(isTurned)}};
    }(),
    [] {
      using S = layout::PoseBounds;
      return CppStruct{"PoseBounds", sizeof(S), {RINGLET_MEMBER(high), RINGLET_MEMBER(low)}};
    }(),
    [] {
      using S = layout::Picture;
      return CppStruct{"Picture", sizeof(S), {RINGLET_MEMBER(view),          RINGLET_MEMBER(eye),
                                              RINGLET_MEMBER(lightAxes),     RINGLET_MEMBER(lightDirection),
                                              RINGLET_MEMBER(lightColour),   RINGLET_MEMBER(skyAbove),
                                              RINGLET_MEMBER(skyBelow),      RINGLET_MEMBER(densityBox),
                                              RINGLET_MEMBER(pigments),      RINGLET_MEMBER(solidColour),
                                              RINGLET_MEMBER(groundColour),  RINGLET_MEMBER(backColours),
                                              RINGLET_MEMBER(width),         RINGLET_MEMBER(height),
                                              RINGLET_MEMBER(side),          RINGLET_MEMBER(hairCount),
                                              RINGLET_MEMBER(pointsPerHair), RINGLET_MEMBER(pointCount),
                                              RINGLET_MEMBER(triangleCount), RINGLET_MEMBER(shadowCells),
                                              RINGLET_MEMBER(shadowSlices),  RINGLET_MEMBER(densityCells),
                                              RINGLET_MEMBER(shadowStride),  RINGLET_MEMBER(focus),
                                              RINGLET_MEMBER(near),          RINGLET_MEMBER(shadowCellArea),
                                              RINGLET_MEMBER(fixedPoint),    RINGLET_MEMBER(shadowOpacity),
                                              RINGLET_MEMBER(along),         RINGLET_MEMBER(about),
                                              RINGLET_MEMBER(tilt),          RINGLET_MEMBER(exposure),
                                              RINGLET_MEMBER(tipRadius),     RINGLET_MEMBER(throughHair),
                                              RINGLET_MEMBER(pigmentCount)}};
    }(),
    [] {
      using S = layout::DrawnHair;
      return CppStruct{"DrawnHair",
                       sizeof(S),
                       {RINGLET_MEMBER(firstPoint), RINGLET_MEMBER(pointCount), RINGLET_MEMBER(radius),
                        RINGLET_MEMBER(pigment)}};
    }(),
    [] {
      using S = layout::SolidPoint;
      return CppStruct{"SolidPoint", sizeof(S), {RINGLET_MEMBER(position), RINGLET_MEMBER(normal)}};
    }(),
    [] {
      using S = layout::SolidTriangle;
      return CppStruct{"SolidTriangle", sizeof(S), {RINGLET_MEMBER(points), RINGLET_MEMBER(unused)}};
    }(),
    [] {
      using S = layout::SeenCounts;
      return CppStruct{"SeenCounts",
                       sizeof(S),
                       {RINGLET_MEMBER(indirectHairs), RINGLET_MEMBER(hairs), RINGLET_MEMBER(indirectSolids),
                        RINGLET_MEMBER(solids)}};
    }(),
    [] {
      using S = layout::StretchStrand;
      return CppStruct{"StretchStrand", sizeof(S), {RINGLET_MEMBER(firstPoint), RINGLET_MEMBER(pointCount)}};
    }(),
    [] {
      using S = layout::StretchParameters;
      return CppStruct{"StretchParameters", sizeof(S), {RINGLET_MEMBER(count), RINGLET_MEMBER(most)}};
    }(),
    [] {
      using S = layout::PictureBand;
      return CppStruct{"PictureBand", sizeof(S), {RINGLET_MEMBER(firstRow), RINGLET_MEMBER(rowCount)}};
    }(),
};

const CppStruct* cppStruct(const std::string& name) {
  const auto found = std::ranges::find(kCppStructs, name, &CppStruct::name);
  return found == kCppStructs.end() ? nullptr : &*found;
}

std::set<std::string> structsOfLayoutFiles() {
  static const std::regex pattern(R"(^struct (\w+) \{)");
  std::set<std::string> names;
  std::smatch match;
  for (const auto& entry : std::filesystem::directory_iterator(RINGLET_SOURCE_DIR "/shaders/layout")) {
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, pattern)) names.insert(match[1]);
  }
  return names;
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
      ASSERT_TRUE(cpp) << "struct " << shader.name << " has no row in kCppStructs";
      expectSame(shader, *cpp);
      seen.insert(shader.name);
    }
  }
  EXPECT_EQ(seen, structsOfLayoutFiles())
      << "structs that shaders hold in buffers, and structs of shaders/layout";
}

TEST(Layout, PushConstantsFitEveryDevice) {
  EXPECT_LE(sizeof(layout::StepParameters), 128u) << "Vulkan guarantees 128 bytes";
  EXPECT_LE(sizeof(layout::ContactParameters), 128u);
  EXPECT_LE(sizeof(layout::VolumeParameters), 128u);
  EXPECT_LE(sizeof(layout::FollowParameters), 128u);
}

// They are read as texels of 16 bytes (shared/texels.glsl).
TEST(Layout, TexelRecordsAreWholeTexels) {
  for (const char* name :
       {"ParticleRest",  "StrandRest",   "RootPose",       "BodyRest",       "BodyPose",    "StepAir",
        "StepField",     "WindWave",     "ContactRest",    "ContactPair",    "ContactLife", "ContactForce",
        "ContactSystem", "ContactPlace", "ContactHistory", "VolumeParticle", "VolumeState", "VolumeParcel",
        "CoreRow",       "FollowGuide",  "FollowHair",     "FollowBlend"})
    EXPECT_EQ(cppStruct(name)->size % sizeof(layout::vec4), 0u) << name;
}

}  // namespace
}  // namespace ringlet::test::layout_test
