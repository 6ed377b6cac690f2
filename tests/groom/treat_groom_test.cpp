// groom/treat_groom.h and what it mends: faults that are planted into clean grooms are named, each in its
// strands and nothing else, and are mended; what is right keeps its bits.
#include "ringlet/groom/treat_groom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_scalp.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/measure/groom_inspection.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/style_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::treat_groom_test {
namespace {

using Strand = std::vector<Vec3f>;
using Fault = GroomFault GroomInspection::*;

struct Named {
  const char* name;
  Fault fault;
  bool isMended;
};
constexpr Named kFaults[] = {{"repeated", &GroomInspection::repeatedParticles, true},
                             {"short edges", &GroomInspection::shortEdges, false},
                             {"long edges", &GroomInspection::longEdges, false},
                             {"strays", &GroomInspection::strayParticles, true},
                             {"thrown", &GroomInspection::thrownParticles, true},
                             {"shared", &GroomInspection::sharedParticles, false},
                             {"reversed", &GroomInspection::reversedStrands, true},
                             {"floating", &GroomInspection::floatingRoots, true},
                             {"sunk", &GroomInspection::sunkRoots, true},
                             {"points", &GroomInspection::pointStrands, true},
                             {"duplicates", &GroomInspection::duplicates, true},
                             {"twins", &GroomInspection::twins, true},
                             {"too short", &GroomInspection::tooShort, false},
                             {"too long", &GroomInspection::tooLong, true},
                             {"far away", &GroomInspection::farAway, true},
                             {"coarse", &GroomInspection::coarseCurls, false}};

// "" without any.
std::string faultsOf(const GroomInspection& found) {
  std::string text;
  for (const Named& named : kFaults) {
    const GroomFault& fault = found.*named.fault;
    if (fault.count > 0)
      text += fmt::format("{}: {} from strand {}; ", named.name, fault.count, fault.firstStrand);
  }
  return text;
}

Strand strandOf(const Groom& groom, std::size_t s) {
  return Strand(groom.strand(s).begin(), groom.strand(s).end());
}

// --- Clean grooms [cm].

Groom swatch(double turns) { return *makeSwatch({.curl = {.radius = 0.01, .turns = turns, .length = 0.25}}); }
// Flat waves, hanging from a board that is bent.
Groom wavy() {
  Groom groom;
  for (int s = 0; s < 100; ++s) {
    const double x = s % 10, z = s / 10;
    Strand strand;
    for (int i = 0; i < 40; ++i) {
      const double y = 0.008 * x * x - 0.5 * i;
      strand.push_back(Vec3f(Vec3d{x + 0.4 * std::sin(0.5 * i + 0.3 * s) * i / 40, y, z}));
    }
    groom.addStrand(strand);
  }
  return groom;
}
Groom fewLong() {
  Groom groom;
  for (int s = 0; s < 10; ++s) {
    Strand strand;
    for (int i = 0; i < 60; ++i)
      strand.push_back(Vec3f(Vec3d{2.0 * (s % 5) + 0.01 * i * s, -1.0 * i, 2.0 * (s / 5)}));
    groom.addStrand(strand);
  }
  return groom;
}
Groom denseHead() {
  HeadParameters parameters = *headOfStyle("long");
  parameters.strandCount = 700;
  return *makeHead(parameters);
}
Groom inOtherOrder(const Groom& groom) {
  Groom other;
  for (std::size_t s = groom.strandCount(); s-- > 0;) other.addStrand(groom.strand(s));
  return other;
}

struct Clean {
  std::string name;
  Groom groom;
};
const std::vector<Clean>& cleanGrooms() {
  static const std::vector<Clean> kClean = [] {
    std::vector<Clean> clean{{"straight", swatch(0)},
                             {"curly", swatch(8)},
                             {"wavy", wavy()},
                             {"dense head", denseHead()},
                             {"few long", fewLong()}};
    for (std::size_t i = 0; i < 5; ++i)
      clean.push_back({clean[i].name + ", last first", inOtherOrder(clean[i].groom)});
    return clean;
  }();
  return kClean;
}

// --- Faults.

// Strands that are changed are to be mended to what they were, are to be dropped, or are dropped as they were
// added.
enum class Becomes { asBefore, gone, moved };

struct Kind {
  const char* name;
  Fault fault;
  double share;  // of the strands, at most, that may have it
  Becomes becomes;
  std::function<void(std::size_t which, Strand& strand)> change{};  // or
  std::function<void(std::size_t which, Strand& strand)> add{};     // a changed copy at the end
};

void shift(Strand& strand, Vec3f by) {
  for (Vec3f& p : strand) p = p + by;
}
void scaleUp(Strand& strand, float factor) {
  for (Vec3f& p : strand) p = strand.front() + (p - strand.front()) * factor;
}
float lengthOf(const Strand& strand) {
  float whole = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) whole += length(strand[i] - strand[i - 1]);
  return whole;
}
// Everywhere by a 50,000th of the length, in ways that differ.
void jitter(std::size_t which, Strand& strand) {
  const float size = 2e-5f * lengthOf(strand);
  for (std::size_t i = 0; i < strand.size(); ++i) {
    const auto turn = static_cast<float>(i + 3 * which);
    strand[i] = strand[i] + Vec3f{std::sin(turn), std::cos(turn), std::sin(2 * turn)} * (size / 2);
  }
}
// Outward at a root of a head about the origin; above a board, whose hair hangs, that is down.
Vec3f outwardOf(const Strand& strand, bool isHead) {
  const Vec3f root = strand.front();
  return isHead ? root * (1 / length(root)) : Vec3f{0, -1, 0};
}
void throwOff(std::size_t at, Strand& strand) {
  const float edge = lengthOf(strand) / static_cast<float>(strand.size() - 1);
  strand.insert(strand.begin() + static_cast<std::ptrdiff_t>(at),
                strand[std::min(at, strand.size() - 1)] + Vec3f{30, 11, 17} * (edge * 1.3f));
}

std::vector<Kind> kinds(bool isHead) {
  return {
      {"reversed", &GroomInspection::reversedStrands, 0.25, Becomes::asBefore,
       [](std::size_t, Strand& strand) { std::ranges::reverse(strand); }},
      {"floating", &GroomInspection::floatingRoots, 0.1, Becomes::moved,
       [=](std::size_t, Strand& strand) { shift(strand, outwardOf(strand, isHead) * 3.f); }},
      {"sunk", &GroomInspection::sunkRoots, 0.1, Becomes::moved,
       [=](std::size_t, Strand& strand) { shift(strand, outwardOf(strand, isHead) * -3.f); }},
      {"twins", &GroomInspection::twins, 0.25, Becomes::gone, {}, jitter},
      {"twins from the tip",
       &GroomInspection::twins,
       0.25,
       Becomes::gone,
       {},
       [](std::size_t which, Strand& strand) {
         jitter(which, strand);
         std::ranges::reverse(strand);
       }},
      {"duplicates", &GroomInspection::duplicates, 0.25, Becomes::gone, {}, [](std::size_t, Strand&) {}},
      {"too long", &GroomInspection::tooLong, 0.05, Becomes::gone,
       [](std::size_t, Strand& strand) { scaleUp(strand, 4); }},
      {"far away", &GroomInspection::farAway, 0.1, Becomes::gone,
       [](std::size_t, Strand& strand) {
         shift(strand, {400, 100, 0});
       }},
      {"thrown in the middle", &GroomInspection::thrownParticles, 0.25, Becomes::asBefore,
       [](std::size_t which, Strand& strand) { throwOff(3 + which % 5, strand); }},
      {"thrown at the root", &GroomInspection::thrownParticles, 0.25, Becomes::asBefore,
       [](std::size_t, Strand& strand) { throwOff(0, strand); }},
      {"thrown at the tip", &GroomInspection::thrownParticles, 0.25, Becomes::asBefore,
       [](std::size_t, Strand& strand) { throwOff(strand.size(), strand); }},
      {"at the origin", &GroomInspection::strayParticles, 0.25, Becomes::asBefore,
       [](std::size_t, Strand& strand) {
         strand.insert(strand.begin() + 4, strand[4] + Vec3f{9e4f, 9e4f, 0});
       }},
  };
}

struct Planted {
  Groom groom, wanted;  // as it is, and as it should become
  std::vector<std::uint32_t> strands;
};

Planted plant(const Groom& clean, const Kind& kind, const std::vector<std::size_t>& which) {
  Planted planted;
  std::vector<Strand> added;
  for (std::size_t s = 0; s < clean.strandCount(); ++s) {
    Strand strand = strandOf(clean, s);
    const bool isOne = std::ranges::find(which, s) != which.end();
    if (isOne && kind.change) {
      kind.change(s, strand);
      planted.strands.push_back(static_cast<std::uint32_t>(s));
    }
    planted.groom.addStrand(strand);
    if (!isOne || kind.add || kind.becomes != Becomes::gone) planted.wanted.addStrand(clean.strand(s));
    if (!isOne || !kind.add) continue;
    added.push_back(strandOf(clean, s));
    kind.add(s, added.back());
  }
  for (const Strand& strand : added) {
    planted.strands.push_back(static_cast<std::uint32_t>(planted.groom.strandCount()));
    planted.groom.addStrand(strand);
  }
  return planted;
}

// The same bits but for strands that were moved, which are near where they were.
void expectMended(const Groom& mended, const Planted& planted, const Kind& kind) {
  if (kind.becomes != Becomes::moved) {
    EXPECT_TRUE(test::hasSameBits(mended, planted.wanted));
    return;
  }
  ASSERT_EQ(mended.strandCount(), planted.wanted.strandCount());
  for (std::size_t s = 0; s < mended.strandCount(); ++s) {
    const Strand is = strandOf(mended, s), was = strandOf(planted.wanted, s);
    ASSERT_EQ(is.size(), was.size());
    if (std::ranges::binary_search(planted.strands, static_cast<std::uint32_t>(s))) {
      EXPECT_LT(length(is.front() - was.front()), 0.6f) << s;
      for (std::size_t i = 1; i < is.size(); ++i)
        EXPECT_LT(length((is[i] - is[0]) - (was[i] - was[0])), 1e-4f) << s << " keeps its shape";
    } else {
      EXPECT_EQ(is, was) << s;
    }
  }
}

// One, then several that are spread, then as many that follow each other.
std::vector<std::vector<std::size_t>> choices(std::size_t strands, double share) {
  const auto most = std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(strands)));
  std::vector<std::vector<std::size_t>> chosen{{strands / 2}, {}, {}};
  for (std::size_t k = 0; k < most; ++k) {
    chosen[1].push_back(k * strands / most);
    chosen[2].push_back(strands / 5 + k);
  }
  return chosen;
}

TEST(TreatGroom, CleanGroomsHaveNoFaults) {
  for (const Clean& clean : cleanGrooms()) {
    EXPECT_EQ(faultsOf(inspectGroom(clean.groom)), "") << clean.name;
    EXPECT_TRUE(test::hasSameBits(treatGroom(clean.groom).groom, clean.groom)) << clean.name;
  }
}

TEST(TreatGroom, PlantedFaultsAreNamedAloneAndMended) {
  int count = 0;
  for (const Clean& clean : cleanGrooms()) {
    for (const Kind& kind : kinds(clean.name.starts_with("dense"))) {
      const bool isOfRoots = kind.becomes == Becomes::moved;
      if (isOfRoots && clean.groom.strandCount() < 20) continue;  // which span no scalp
      for (const auto& which : choices(clean.groom.strandCount(), kind.share)) {
        SCOPED_TRACE(
            fmt::format("{} of {}, {} strands from {}", kind.name, clean.name, which.size(), which[0]));
        const Planted planted = plant(clean.groom, kind, which);
        const GroomInspection found = inspectGroom(planted.groom);
        EXPECT_EQ((found.*kind.fault).strands, planted.strands) << faultsOf(found);
        for (const Named& named : kFaults) {
          if (named.fault == kind.fault) continue;
          // Edges to a particle that is out of its place are long, and others short beside them.
          if (named.fault == &GroomInspection::longEdges || named.fault == &GroomInspection::shortEdges)
            continue;
          EXPECT_EQ((found.*named.fault).count, 0u) << named.name << ": " << faultsOf(found);
        }
        const TreatedGroom mended = treatGroom(planted.groom);
        EXPECT_EQ(faultsOf(inspectGroom(mended.groom)), "");
        expectMended(mended.groom, planted, kind);
        EXPECT_TRUE(test::hasSameBits(treatGroom(mended.groom).groom, mended.groom)) << "mended at once";
        ++count;
      }
    }
  }
  EXPECT_GE(count, 300);
}

// Every kind at once.
TEST(TreatGroom, MendsAllThatIsWrongTogether) {
  const Groom clean = denseHead();
  Groom bad = clean;
  std::size_t at = 5;
  for (const Kind& kind : kinds(true)) bad = plant(bad, kind, {at += 50}).groom;
  const TreatedGroom mended = treatGroom(bad);
  EXPECT_EQ(faultsOf(inspectGroom(mended.groom)), "");
  EXPECT_EQ(mended.turnedCount, 1u);
  EXPECT_EQ(mended.movedCount, 2u);
  EXPECT_EQ(mended.twinCount, 2u);
  EXPECT_EQ(mended.duplicateCount, 1u);
  EXPECT_EQ(mended.strayStrandCount, 2u);
  EXPECT_EQ(mended.thrownCount, 3u);
  EXPECT_EQ(mended.strayCount, 1u);
  EXPECT_EQ(mended.groom.strandCount(), clean.strandCount() - 2);
}

TEST(TreatGroom, AMeshSaysWhichRootsAreOff) {
  HeadParameters parameters;
  parameters.strandCount = 300;
  const auto scalp = makeMeshScalp(makeHeadMesh({}));
  ASSERT_TRUE(scalp) << scalp.error().message;
  parameters.scalp = *scalp;
  const Groom clean = *makeHead(parameters);
  EXPECT_EQ(faultsOf(inspectGroom(clean, scalp->get())), "");
  for (const std::size_t most : {1u, 40u, 140u}) {
    for (const float by : {2.f, -2.f}) {
      Groom bad;
      std::vector<std::uint32_t> strands;
      for (std::size_t s = 0; s < clean.strandCount(); ++s) {
        Strand strand = strandOf(clean, s);
        if (s < most) {
          shift(strand, outwardOf(strand, true) * by);
          strands.push_back(static_cast<std::uint32_t>(s));
        }
        bad.addStrand(strand);
      }
      const GroomInspection found = inspectGroom(bad, scalp->get());
      EXPECT_EQ((by > 0 ? found.floatingRoots : found.sunkRoots).strands, strands) << faultsOf(found);
      const TreatedGroom mended = treatGroom(bad, {.scalp = scalp->get()});
      EXPECT_EQ(mended.movedCount, most);
      EXPECT_EQ(faultsOf(inspectGroom(mended.groom, scalp->get())), "");
    }
  }
  // All of them: the mesh is elsewhere, and hair stays.
  Groom moved;
  for (std::size_t s = 0; s < clean.strandCount(); ++s) {
    Strand strand = strandOf(clean, s);
    shift(strand, {0, 4, 0});
    moved.addStrand(strand);
  }
  EXPECT_GT(inspectGroom(moved, scalp->get()).floatingRoots.count, 150u);
  EXPECT_TRUE(test::hasSameBits(treatGroom(moved, {.scalp = scalp->get()}).groom, moved));
}

TEST(TreatGroom, CurlsThatAreTooCoarseAreNamedAndStay) {
  for (const double perTurn : {1.7, 2.2, 2.7, 3.3, 3.7, 4.0, 5.0, 8.0}) {
    for (const double turns : {6.0, 11.0, 20.0}) {
      for (const double radius : {0.005, 0.01}) {
        const auto curl = makeCurl({.radius = radius,
                                    .turns = turns,
                                    .length = 0.004 * turns,
                                    .particleCount = static_cast<int>(std::lround(perTurn * turns)) + 1});
        ASSERT_TRUE(curl);
        const GroomInspection found = inspectGroom(*curl);
        EXPECT_EQ(found.coarseCurls.count, perTurn < 3.9 ? 1u : 0u)
            << perTurn << " " << turns << " " << radius;
        EXPECT_TRUE(test::hasSameBits(treatGroom(*curl).groom, *curl));
      }
    }
  }
}

TEST(TreatGroom, GeneratedHeadsOfEveryStyleAreClean) {
  for (const std::string& style : test::styleNames()) {
    for (const int strands : {60, 300, 1500}) {
      HeadParameters parameters = *headOfStyle(style);
      parameters.strandCount = strands;
      const auto head = makeHead(parameters);
      ASSERT_TRUE(head) << style;
      EXPECT_EQ(faultsOf(inspectGroom(*head)), "") << style << " " << strands;
      EXPECT_TRUE(test::hasSameBits(treatGroom(*head).groom, *head)) << style << " " << strands;
    }
  }
}

// Whatever there is of them, once.
TEST(TreatGroom, BrokenGroomsAreMendedAtOnce) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Groom groom = test::randomGroom(seed, 3 + static_cast<int>(seed));
    const TreatedGroom mended = treatGroom(groom);
    EXPECT_LE(mended.groom.points.size(), groom.points.size());
  }
  EXPECT_EQ(treatGroom(Groom{}).groom.strandCount(), 0u);
}

TEST(TreatGroom, RealGroomsAreNotTornApart) {
  for (const char* name : {"hair/straight.hair", "curlycue/frame_000.obj", "curlycue/frame_070_settled.obj",
                           "sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", "usd/hair-blender-3.0.1.usda",
                           "usd/hair.usda", "usd/curves.usda", "abc/curves_linear_animated.abc"}) {
    RINGLET_NEEDS_DATA(path, name);
    const auto loaded = readGroom(path);
    ASSERT_TRUE(loaded) << name;
    const TreatedGroom mended = treatGroom(loaded->groom);
    EXPECT_EQ(mended.turnedCount, 0u) << name;
    for (const Named& named : kFaults) {
      if (named.isMended) {
        EXPECT_EQ((inspectGroom(mended.groom).*named.fault).count, 0u) << name << ": " << named.name;
      }
    }
    RecordProperty(name, faultsOf(inspectGroom(loaded->groom)));
    std::printf("%s: %s\n", name, faultsOf(inspectGroom(loaded->groom)).c_str());
  }
}

}  // namespace
}  // namespace ringlet::treat_groom_test
