// output/groom_writer.h: every format by the ending, what it says beside points, files that cannot be
// written, and nothing half-written.
#include "ringlet/output/groom_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <limits>
#include <string>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/output/animation_reader.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::groom_writer_test {
namespace {

using test::contains;

LoadedGroom readBack(const std::filesystem::path& path, const GroomReading& reading = {}) {
  auto loaded = readGroom(path, reading);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? std::move(*loaded) : LoadedGroom{};
}

void expectWriteError(const std::filesystem::path& path, const Groom& groom, const std::string& part) {
  const Status status = writeGroom(path, groom);
  ASSERT_FALSE(status) << path;
  EXPECT_TRUE(contains(status.error().message, part)) << status.error().message;
  EXPECT_TRUE(contains(status.error().message, path.string())) << status.error().message;
}

// "a" and the ending, and "A" and that in upper case.
std::vector<std::string> namesOfEveryFormat() {
  std::vector<std::string> names;
  for (const std::string& ending : writtenGroomEndings()) {
    std::string upper = "A" + ending;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    names.push_back("a" + ending);
    names.push_back(upper);
  }
  return names;
}

TEST(GroomWriter, EveryFormatGivesTheSameBits) {
  const auto folder = test::scratchFolder("groom_writer");
  for (const std::string& name : namesOfEveryFormat()) {
    for (const Groom& groom : {test::awkwardGroom(), test::randomGroom(7, 40)}) {
      ASSERT_TRUE(writeGroom(folder / name, groom)) << name;
      const LoadedGroom back = readBack(folder / name);
      EXPECT_TRUE(test::hasSameBits(back.groom, groom)) << name;
      EXPECT_TRUE(back.warnings.empty()) << name << ": " << back.warnings.front();
      EXPECT_FALSE(holdsAnimation(folder / name)) << name;
    }
  }
  EXPECT_EQ(test::readText(folder / "A.HAIR").substr(0, 4), "HAIR");
  EXPECT_EQ(test::readText(folder / "a.usda").substr(0, 9), "#usda 1.0");
  EXPECT_EQ(test::readText(folder / "a.usdc").substr(0, 8), "PXR-USDC");
}

TEST(GroomWriter, SaysUnitAndAxisWhereTheFormatCan) {
  const auto folder = test::scratchFolder("groom_measures");
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{1, 2, 3}, {1, 0, 3.5f}});
  groom.metresPerUnit = 0.0254;
  for (const WrittenGroomFormat& format : writtenGroomFormats()) {
    const auto path = folder / ("a" + std::string(format.ending));
    SCOPED_TRACE(format.ending);
    ASSERT_TRUE(writeGroom(path, groom));
    const LoadedGroom unknown = readBack(path, {.upIsZ = true});
    EXPECT_EQ(unknown.statesUnit, format.isStating);
    EXPECT_EQ(unknown.groom.metresPerUnit, format.isStating ? 0.0254 : Groom{}.metresPerUnit);
    EXPECT_FALSE(unknown.statesUp);
    EXPECT_EQ(unknown.groom.points, groom.points) << "an axis that is not stated turns nothing";
    if (!format.isStating) continue;

    ASSERT_TRUE(writeGroom(path, groom, {.up = UpAxis::z}));
    const LoadedGroom kept = readBack(path, {.upIsZ = true}), turned = readBack(path);
    EXPECT_TRUE(kept.statesUp && turned.statesUp && turned.isTurned && !kept.isTurned);
    EXPECT_EQ(kept.groom.points, groom.points);
    EXPECT_EQ(turned.groom.points[1], (Vec3f{1, 3.5f, 0}));
    ASSERT_EQ(turned.warnings.size(), 1u);
    EXPECT_TRUE(contains(turned.warnings[0], "turned from Z up, which it states, to Y up"));
    ASSERT_TRUE(writeGroom(path, groom, {.up = UpAxis::y}));
    EXPECT_EQ(readBack(path).groom.points, groom.points);
    EXPECT_EQ(readBack(path, {.upIsZ = true}).groom.points[1], (Vec3f{1, -3.5f, 0}));
  }
}

TEST(GroomWriter, AUnitThatNoHairHasIsLeftAside) {
  const auto folder = test::scratchFolder("groom_unit");
  Groom groom = test::awkwardGroom();
  groom.metresPerUnit = 1e9;
  for (const char* name : {"a.abc", "a.usda", "a.usdc"}) {
    ASSERT_TRUE(writeGroom(folder / name, groom));
    const LoadedGroom back = readBack(folder / name);
    EXPECT_FALSE(back.statesUnit);
    EXPECT_EQ(back.groom.metresPerUnit, Groom{}.metresPerUnit);
    ASSERT_EQ(back.warnings.size(), 1u) << name;
    EXPECT_TRUE(contains(back.warnings[0], "which no hair has")) << back.warnings[0];
  }
}

// What a file says of two curves, in each scope; groups as strings.
constexpr const char* kSaid = R"(uniform token type = "linear"
int[] curveVertexCounts = [3, 2]
point3f[] points = [(0, 0, 0), (0, -1, 0.25), (0.5, -2, 0), (1, 0, 0), (1, -1.5, 0)]
float[] widths = [0.5, 0.25, 0.125, 0.5, 0.25] (interpolation = "vertex")
color3f[] primvars:displayColor = [(1, 0, 0.5), (0.25, 1, 0)] (interpolation = "uniform")
int[] primvars:id = [42, 7] (interpolation = "uniform")
texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
string[] primvars:group = ["fringe", "left \"and\\or\" back"] (interpolation = "uniform")
float[] primvars:frizz = [0.125, 0.25, 0.375, 0.5, 1] (interpolation = "vertex")
)";

const GroomValue* valueOf(const LoadedGroom& loaded, std::string_view name) {
  if (loaded.prims.size() != 1) return nullptr;
  const auto& values = loaded.prims.front().values;
  const auto found = std::ranges::find(values, name, &GroomValue::name);
  return found == values.end() ? nullptr : &*found;
}

TEST(GroomWriter, KeepsWhatTheFileSaidOfItsCurves) {
  const auto folder = test::scratchFolder("groom_values");
  const auto said = readUsd(test::bytesOf(test::curves(kSaid)), "said.usda", {.keepsPrims = true});
  ASSERT_TRUE(said) << said.error().message;
  ASSERT_EQ(said->prims.front().values.size(), 6u);
  EXPECT_EQ(valueOf(*said, "primvars:group")->texts[1], "left \"and\\or\" back");
  for (const WrittenGroomFormat& format : writtenGroomFormats()) {
    if (!format.isStating) continue;
    const auto path = folder / ("a" + std::string(format.ending));
    ASSERT_TRUE(writeGroom(path, said->groom, {.usd = {.origin = &*said, .originValues = true}}));
    const LoadedGroom back = readBack(path, {.keepsPrims = true});
    EXPECT_TRUE(test::hasSameBits(back.groom, said->groom)) << path;
    for (const GroomValue& value : said->prims.front().values) {
      const GroomValue* found = valueOf(back, value.name);
      ASSERT_TRUE(found) << path << " has no " << value.name;
      EXPECT_EQ(found->interpolation, value.interpolation) << path << value.name;
      EXPECT_EQ(found->numbers, value.numbers) << path << value.name;
      EXPECT_EQ(found->texts, value.texts) << path << value.name;
    }
    EXPECT_EQ(back.prims.front().values.size(), 6u) << path << " says more";
  }
}

// Without widths none are made up; the extent reaches as far as the points do, or half a width farther.
TEST(GroomWriter, AnExtentHoldsTheStrands) {
  const auto folder = test::scratchFolder("groom_extent");
  const auto said = readUsd(test::bytesOf(test::curves(kSaid)), "said.usda", {.keepsPrims = true});
  ASSERT_TRUE(said) << said.error().message;
  ASSERT_TRUE(writeGroom(folder / "a.usda", said->groom));
  const std::string bare = test::readText(folder / "a.usda");
  EXPECT_TRUE(contains(bare, "float3[] extent = [(0, -2, 0), (1, 0, 0.25)]")) << bare;
  EXPECT_FALSE(contains(bare, "widths")) << bare;
  EXPECT_FALSE(contains(bare, "timeSamples")) << bare;
  ASSERT_TRUE(writeGroom(folder / "a.usda", said->groom, {.usd = {.origin = &*said, .originValues = true}}));
  const std::string wide = test::readText(folder / "a.usda");
  EXPECT_TRUE(contains(wide, "float3[] extent = [(-0.25, -2.25, -0.25), (1.25, 0.25, 0.5)]")) << wide;
}

TEST(GroomWriter, UnrealsNamesAreOfGroomsAsWell) {
  const auto folder = test::scratchFolder("groom_unreal");
  const auto said = readUsd(test::bytesOf(test::curves(kSaid)), "said.usda", {.keepsPrims = true});
  ASSERT_TRUE(said) << said.error().message;
  for (const char* name : {"a.usda", "a.usdc", "a.abc"}) {
    ASSERT_TRUE(writeGroom(folder / name, said->groom,
                           {.usd = {.unreal = true, .origin = &*said, .originValues = true}}));
    const LoadedGroom back = readBack(folder / name, {.keepsPrims = true});
    const GroomValue *ids = valueOf(back, "primvars:groom_id"),
                     *uvs = valueOf(back, "primvars:groom_root_uv");
    ASSERT_TRUE(ids && uvs) << name;
    EXPECT_EQ(ids->numbers, (std::vector<double>{42, 7}));
    EXPECT_EQ(uvs->numbers, (std::vector<double>{0, 1, 0.5, 0.75}));
  }
  EXPECT_TRUE(contains(test::readText(folder / "a.usda"), "prepend apiSchemas = [\"GroomAPI\"]"));
}

TEST(GroomWriter, SaysWhatIsSupported) {
  EXPECT_EQ(writtenGroomEndings("and"), ".hair, .obj, .ply, .abc, .usda and .usdc");
  for (const char* name : {"a.xyz", "a", ".hair", "a.hair.gz", ""})
    expectWriteError(name, test::awkwardGroom(), "supported are .hair, .obj, .ply, .abc, .usda and .usdc");
  for (const char* name : {"a.tfx", "a.USD", "a.usdz", "a.data", "a.bin"})
    expectWriteError(name, test::awkwardGroom(), "is only read; supported are .hair");
}

TEST(GroomWriter, RefusesToWriteWhatCannotBeReadBack) {
  const auto folder = test::scratchFolder("groom_bad");
  for (const std::string& name : namesOfEveryFormat()) {
    expectWriteError(folder / name, Groom{}, "no strands");
    Groom point = test::awkwardGroom();
    point.addStrand(std::vector<Vec3f>{{1, 2, 3}});
    expectWriteError(folder / name, point, "strand 3 has 1 particles");
    Groom nothing = test::awkwardGroom();
    nothing.addStrand({});
    expectWriteError(folder / name, nothing, "strand 3 has 0 particles");
    Groom infinite = test::awkwardGroom();
    infinite.points[4].z = std::numeric_limits<float>::infinity();
    expectWriteError(folder / name, infinite, "strand 1, particle 2");
  }
  EXPECT_EQ(test::fileCount(folder), 0);
}

TEST(GroomWriter, ReportsWhereItCannotWrite) {
  const auto folder = test::scratchFolder("groom_unwritable");
  for (const std::string& name : namesOfEveryFormat()) {
    expectWriteError(folder / "nowhere" / name, test::awkwardGroom(), "No such file");
    const auto taken = test::scratchFolder("groom_taken") / name;
    std::filesystem::create_directory(taken);
    test::writeText(taken / "inside", "x");
    expectWriteError(taken, test::awkwardGroom(), "is a folder");
    EXPECT_EQ(test::fileCount(taken.parent_path()), 1);  // no temporary is left
  }
  EXPECT_EQ(test::fileCount(folder), 0);
}

TEST(GroomWriter, AFullDiskIsReportedAndLeavesTheOldFile) {
  // A limit on file sizes stands in for a full disk: writing fails in the middle.
  const auto folder = test::scratchFolder("groom_full");
  const Result<Groom> groom = makeSwatch({.columnCount = 20, .rowCount = 20});
  ASSERT_TRUE(groom);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const std::string& ending : writtenGroomEndings()) {
    const auto path = folder / ("a" + ending);
    ASSERT_TRUE(writeGroom(path, test::awkwardGroom()));
    const std::string old = test::readText(path);
    const rlimit small{10000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status = writeGroom(path, *groom);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(status);
    EXPECT_TRUE(contains(status.error().message, "cannot write its")) << status.error().message;
    EXPECT_TRUE(contains(status.error().message, "File too large")) << status.error().message;
    EXPECT_EQ(test::readText(path), old);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(test::fileCount(folder), static_cast<long>(writtenGroomFormats().size()));
}

}  // namespace
}  // namespace ringlet::groom_writer_test
