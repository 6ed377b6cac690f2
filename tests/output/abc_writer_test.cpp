// hair.abc: what an archive of ours holds, read as any archive is; against the crate of the same frames; its
// size; and what is refused.
#include "ringlet/output/alembic/abc_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_groom.h"
#include "ringlet/groom/alembic/abc_transform.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/output/alembic/abc_reader.h"
#include "ringlet/output/usd/usdc_writer.h"
#include "tests/support/test_support.h"

namespace ringlet::abc_writer_test {
namespace {

namespace fs = std::filesystem;
using test::scratchFolder;

constexpr std::uint32_t kCurves = 2, kTransform = 1;  // objects of ours

Groom smallGroom() {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0.25f}, {0.5f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, 0}});
  return groom;
}
constexpr std::size_t kPoints = 5;

std::vector<Vec3f> pointsAt(const Groom& groom, int frame) {
  auto points = groom.points;
  for (Vec3f& p : points) p.x += 0.25f * static_cast<float>(frame * frame);
  return points;
}
UsdTransform headAt(int frame) {
  const double angle = 0.5 * frame;
  return {{Vec3d{std::cos(angle), 0, -std::sin(angle)}, Vec3d{0, 1, 0},
           Vec3d{std::sin(angle), 0, std::cos(angle)}},
          {3.0 * frame, 1, 0}};
}

// So many frames in a file of that name; not finished: its .partial.
fs::path write(const fs::path& path, const Groom& groom, const AnimationOptions& options, int frames,
               bool finishes = true) {
  auto writer = animationFormatOf(path)->resume(path, groom, options, 0);
  EXPECT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= frames; ++frame)
    EXPECT_TRUE((*writer)->addFrame(pointsAt(groom, frame), headAt(frame)));
  if (!finishes) return path.string() + ".partial";
  EXPECT_TRUE((*writer)->finish());
  return path;
}

// An archive with the properties of its objects, by their paths: ".geom/P", ".arbGeomParams/id".
struct Archive {
  explicit Archive(const fs::path& path) {
    const std::string text = test::readText(path);
    bytes.resize(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    auto read = AbcArchive::of(bytes, path.string());
    EXPECT_TRUE(read) << read.error().message;
    archive.emplace(std::move(*read));
    for (std::uint32_t object = 0; object < archive->objects().size(); ++object)
      addAll(archive->propertiesOf(object));
  }
  const AbcProperty& property(const std::string& path) const {
    for (const AbcProperty& each : properties)
      if (each.path() == path) return each;
    throw std::runtime_error("no property " + path);
  }
  bool has(const std::string& path) const {
    return std::ranges::any_of(properties, [&](const AbcProperty& each) { return each.path() == path; });
  }
  std::vector<double> numbers(const std::string& path, std::uint32_t stored = 0) const {
    const auto sample = archive->stored(property(path), stored);
    EXPECT_TRUE(sample) << sample.error().message;
    std::vector<double> all;
    for (std::size_t k = 0; sample && k < sample->numberCount(); ++k) all.push_back(sample->number(k));
    return all;
  }
  std::string digest(const std::string& path, std::uint32_t stored) const {
    const auto place = archive->placeOfStored(property(path), stored);
    EXPECT_TRUE(place);
    return {reinterpret_cast<const char*>(bytes.data()) + place->place() + 8, 16};
  }

  std::vector<std::byte> bytes;
  std::optional<AbcArchive> archive;
  std::vector<AbcProperty> properties;

 private:
  void addAll(const Result<std::vector<AbcProperty>>& found) {
    ASSERT_TRUE(found) << found.error().message;
    for (const AbcProperty& each : *found) {
      properties.push_back(each);
      if (each.kind == AbcKind::compound) addAll(archive->propertiesOf(each));
    }
  }
};

std::vector<double> flat(std::span<const Vec3f> points) {
  std::vector<double> all;
  for (const Vec3f p : points) all.insert(all.end(), {p.x, p.y, p.z});
  return all;
}

TEST(AbcWriter, SaysWhatReadersNeed) {
  const Groom groom = smallGroom();
  const Archive abc(write(scratchFolder("abc_all") / "hair.abc", groom,
                          {.framesPerSecond = 25,
                           .metresPerUnit = 0.001,
                           .up = UpAxis::z,
                           .diameter = 0.5f,
                           .frameCount = 4,
                           .usd = {.ids = true, .rest = true, .firstTimeCode = 101}},
                          4));
  EXPECT_EQ(abc.archive->metadata(),
            "_ai_Application=Ringlet;_ai_DCC_FPS=25;ringlet_metresPerUnit=0.001;ringlet_upAxis=Z");
  EXPECT_EQ(abc.archive->pathOf(kTransform), "/Hair");
  EXPECT_EQ(abc.archive->pathOf(kCurves), "/Hair/HairShape");
  EXPECT_EQ(abcValueOf(abc.archive->objects()[kTransform].metadata, "schema"), "AbcGeom_Xform_v3");
  EXPECT_EQ(abcValueOf(abc.archive->objects()[kCurves].metadata, "schema"), "AbcGeom_Curve_v2");
  EXPECT_EQ(abc.numbers(".geom/nVertices"), (std::vector<double>{3, 2}));
  EXPECT_EQ(abc.numbers(".geom/curveBasisAndType"), (std::vector<double>{1, 0, 2, 2}));
  EXPECT_EQ(abc.numbers(".geom/width"), std::vector<double>{0.5});
  EXPECT_EQ(abc.numbers(".arbGeomParams/id"), (std::vector<double>{0, 1}));
  EXPECT_EQ(abc.property(".arbGeomParams/id").metadata,
            "arrayExtent=1;geoScope=uni;isGeomParam=true;podExtent=1;podName=int32_t");
  EXPECT_EQ(abc.numbers(".arbGeomParams/rest"), flat(groom.points));
  EXPECT_EQ(abc.property(".arbGeomParams/rest").metadata,
            "arrayExtent=1;geoScope=vtx;interpretation=point;isGeomParam=true;podExtent=3;podName=float32_t");
  EXPECT_FALSE(abc.has(".xform/.vals"));
  for (const char* moving : {".geom/P", ".geom/.selfBnds"}) {
    const auto knots = abc.archive->knotsOf(abc.property(moving));
    ASSERT_TRUE(knots) << knots.error().message;
    ASSERT_EQ(knots->size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR((*knots)[k].seconds, (101.0 + static_cast<double>(k)) / 25, 1e-12) << moving;
  }
  for (int frame = 1; frame <= 4; ++frame) {
    const auto stored = static_cast<std::uint32_t>(frame - 1);
    const float by = 0.25f * static_cast<float>(frame * frame);
    EXPECT_EQ(abc.numbers(".geom/P", stored), flat(pointsAt(groom, frame)));
    EXPECT_EQ(abc.numbers(".geom/.selfBnds", stored),
              (std::vector<double>{-0.25 + by, -2.25, -0.25, 1.25 + by, 0.25, 0.5}));
  }
}

// What never changes has as many samples as what does, as Alembic's library writes them; and digests are
// those of the content.
TEST(AbcWriter, SamplesAreCountedAndToldApart) {
  const fs::path path = scratchFolder("abc_digests") / "hair.abc";
  auto writer = AbcWriter::create(path, smallGroom(), {.frameCount = 3});
  ASSERT_TRUE(writer);
  for (const int frame : {1, 2, 1}) ASSERT_TRUE(writer->addFrame(pointsAt(smallGroom(), frame)));
  ASSERT_TRUE(writer->finish());
  const Archive abc(path);
  for (const char* counted : {".geom/P", ".geom/.selfBnds", ".geom/nVertices", ".geom/curveBasisAndType"}) {
    EXPECT_EQ(abc.property(counted).sampleCount, 3u) << counted;
    EXPECT_EQ(abc.property(counted).sampling, 1u) << counted;
  }
  EXPECT_EQ(abc.property(".geom/nVertices").storedCount(), 1u);
  EXPECT_EQ(abc.digest(".geom/P", 0), abc.digest(".geom/P", 2));
  EXPECT_NE(abc.digest(".geom/P", 0), abc.digest(".geom/P", 1));
  EXPECT_NE(abc.digest(".geom/P", 0), abc.digest(".geom/.selfBnds", 0));
}

// Hashes of objects, by which programs know what they have read: they differ where a frame does, also one
// before the last, or a value.
TEST(AbcWriter, HashesOfObjectsDifferWhereFramesDo) {
  const fs::path folder = scratchFolder("abc_hashes");
  const auto hashesOf = [&](const std::vector<int>& frames, float diameter, bool velocities) {
    const fs::path path = folder / "hair.abc";
    auto writer = AbcWriter::create(
        path, smallGroom(), {.diameter = diameter, .frameCount = 3, .usd = {.velocities = velocities}});
    EXPECT_TRUE(writer);
    for (const int frame : frames) EXPECT_TRUE(writer->addFrame(pointsAt(smallGroom(), frame)));
    EXPECT_TRUE(writer->finish());
    const Archive abc(path);
    const OgawaGroup parts = abc.archive->objects()[kCurves].parts;
    const std::uint64_t place = parts[parts.size() - 1].place(), size = readU64(abc.bytes, place);
    return std::string(reinterpret_cast<const char*>(abc.bytes.data()) + place + 8 + size - 32, 32);
  };
  std::set<std::string> all;
  for (const auto& frames : {std::vector<int>{1, 2, 3}, {1, 4, 3}, {2, 2, 3}, {1, 2}, {1}}) {
    for (const float diameter : {0.05f, 0.06f}) {
      for (const bool velocities : {false, true}) all.insert(hashesOf(frames, diameter, velocities));
    }
  }
  EXPECT_EQ(all.size(), 20u);
  EXPECT_EQ(hashesOf({1, 2, 3}, 0.05f, true), hashesOf({1, 2, 3}, 0.05f, true));
}

// Two prims: one moved and of twice the size. Every kind of value, and one with indices of one prim only.
constexpr const char* kGroomText = R"(#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def BasisCurves "Left"
{
    uniform token type = "linear"
    int[] curveVertexCounts = [3, 2]
    point3f[] points = [(0, 0, 0), (0, -1, 0.25), (0.5, -2, 0), (1, 0, 0), (1, -1.5, 0)]
    float[] widths = [0.5, 0.25, 0.125, 0.5, 0.25] (interpolation = "vertex")
    int64[] ids = [9007199254740991, 7]
    color3f[] primvars:displayColor = [(1, 0, 0.5), (0.25, 1, 0)] (interpolation = "uniform")
    int[] primvars:id = [42, 7] (interpolation = "uniform")
    texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
    string[] primvars:group = ["left", "the \"other\" one"] (interpolation = "uniform")
    string primvars:look = "fair"
    half3[] primvars:odd = [(1, 2, 3)]
    double primvars:alone = 0.1
    bool[] primvars:isTied = [1, 0] (interpolation = "uniform")
    float4[] primvars:four = [(1, 2, 3, 4)]
    normal3f[] primvars:lean = [(0, 1, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1), (0, 1, 0)] (interpolation = "vertex")
    float[] primvars:named = [0.5, 2] (interpolation = "vertex")
    int[] primvars:named:indices = [0, 1, 1, 0, 1]
}
)";

std::vector<std::byte> bytesOf(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}
GroomPrim primOf(const Result<LoadedGroom>& read) {
  EXPECT_TRUE(read) << read.error().message;
  if (!read || read->prims.size() != 1) {
    ADD_FAILURE() << "not one prim";
    return {};
  }
  return read->prims.front();
}
const GroomValue* find(const GroomPrim& prim, std::string_view name) {
  const auto found = std::ranges::find(prim.values, name, &GroomValue::name);
  return found == prim.values.end() ? nullptr : &*found;
}

// With the same options crate and archive say the same of their curves. Alembic has arrays where USD has
// single values, and parameters of all names where USD has attributes.
TEST(AbcWriter, SaysWhatACrateSays) {
  auto groom = readUsd(bytesOf(kGroomText), "groom.usda", {.keepsPrims = true});
  ASSERT_TRUE(groom) << groom.error().message;
  const fs::path folder = scratchFolder("abc_values");
  const UsdExtras all{.ids = true, .rest = true, .origin = &*groom, .originValues = true};
  UsdExtras own = all, tapered = {.tipDiameter = 0.01f, .ids = true, .rest = true};
  own.originValues = false;
  UsdExtras factors = {.widthFactors = {1, 0.5f}};
  for (const UsdExtras& extras : {all, own, tapered, factors, UsdExtras{}}) {
    const AnimationOptions options{.frameCount = 1, .usd = extras};
    const GroomPrim crate =
        primOf(readUsd(bytesOf(test::readText(write(folder / "hair.usdc", groom->groom, options, 1))), "a",
                       {.keepsPrims = true}));
    const GroomPrim archive =
        primOf(readAbcGroom(bytesOf(test::readText(write(folder / "hair.abc", groom->groom, options, 1))),
                            "a", {.keepsPrims = true}));
    std::set<std::string> seen;
    for (const GroomValue& value : crate.values) {
      if (value.name.ends_with(":indices")) continue;
      SCOPED_TRACE(value.name);
      const std::string name = value.name == "ids" ? "primvars:ids" : value.name;
      const GroomValue* other = find(archive, name);
      ASSERT_TRUE(other);
      seen.insert(name);
      EXPECT_EQ(other->type, value.type.ends_with("[]") ? value.type : value.type + "[]");
      const std::string per =
          value.interpolation.empty() ? (value.name == "ids" ? "uniform" : "constant") : value.interpolation;
      EXPECT_EQ(other->interpolation, per);
      EXPECT_EQ(other->texts, value.texts);
      const GroomValue* indices = find(crate, value.name + ":indices");
      if (!indices) {
        EXPECT_EQ(other->numbers, value.numbers);
        continue;
      }
      std::vector<double> resolved;
      for (const double k : indices->numbers) resolved.push_back(value.numbers[static_cast<std::size_t>(k)]);
      EXPECT_EQ(other->numbers, resolved);
    }
    EXPECT_EQ(seen.size(), archive.values.size());
    EXPECT_GE(seen.size(), extras.originValues ? 14u : 1u);
  }
  const Archive abc(write(folder / "hair.abc", groom->groom, {.frameCount = 1, .usd = all}, 1));
  EXPECT_EQ(abc.property(".geom/uv").width, 2u) << "the curves' own";
  EXPECT_TRUE(abc.has("named/.indices"));
}

// Bits of velocities and of points, and the transform's matrix, are a crate's, wherever the head is.
TEST(AbcWriter, MovesAsACrateDoes) {
  const fs::path folder = scratchFolder("abc_moves");
  const Groom groom = smallGroom();
  for (const UsdHead head : {UsdHead::baked, UsdHead::transform, UsdHead::none}) {
    for (const int frames : {1, 2, 5}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(head) << ", " << frames);
      const AnimationOptions options{.frameCount = 7, .usd = {.velocities = true, .head = head}};
      const Archive abc(write(folder / "hair.abc", groom, options, frames));
      const std::string crate = test::readText(write(folder / "hair.usdc", groom, options, frames));
      const auto isInCrate = [&](const std::vector<float>& values) {
        return crate.find(std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size())) !=
               std::string::npos;
      };
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(frames); ++k) {
        for (const char* moving : {".geom/P", ".geom/.velocities"}) {
          const std::vector<double> found = abc.numbers(moving, k);
          ASSERT_EQ(found.size(), 3 * kPoints);
          EXPECT_TRUE(isInCrate({found.begin(), found.end()})) << moving << " " << k;
        }
        if (head != UsdHead::transform) continue;
        const UsdTransform at = headAt(static_cast<int>(k) + 1);
        const std::vector<double> expected{
            at.rows[0].x, at.rows[0].y, at.rows[0].z, 0, at.rows[1].x, at.rows[1].y, at.rows[1].z, 0,
            at.rows[2].x, at.rows[2].y, at.rows[2].z, 0, at.move.x,    at.move.y,    at.move.z,    1};
        EXPECT_EQ(abc.numbers(".xform/.vals", k), expected);
      }
      EXPECT_EQ(abc.has(".xform/.vals"), head == UsdHead::transform);
      for (const AbcProperty& property : abc.properties) {
        if (property.sampling == 1) {
          EXPECT_EQ(property.sampleCount, static_cast<std::uint32_t>(frames)) << property.path();
        }
      }
      if (head != UsdHead::transform) continue;
      const auto transforms = AbcTransforms::of(*abc.archive, kCurves);
      ASSERT_TRUE(transforms) << transforms.error().message;
      const UsdTransform last = transforms->at((1.0 + frames - 1) / 24), expected = headAt(frames);
      EXPECT_LT(length(last(Vec3d{1, 2, 3}) - expected(Vec3d{1, 2, 3})), 1e-12);
    }
  }
}

// 12 bytes a point and frame, and of each frame two sizes and digests, a box, and a word of each that moves.
TEST(AbcWriter, TakesTwelveBytesAPoint) {
  const fs::path folder = scratchFolder("abc_size");
  const auto bytesOfFrames = [&](int frames) {
    return fs::file_size(write(folder / "hair.abc", smallGroom(), {.frameCount = frames}, frames));
  };
  const auto padded = [](std::uint64_t bytes) { return (bytes + 7) / 8 * 8; };
  EXPECT_EQ(bytesOfFrames(200) - bytesOfFrames(100), 100 * (padded(24 + 12 * kPoints) + 24 + 48 + 16 + 8));
}

TEST(AbcReader, AnyFrameIsReadAtOnce) {
  const fs::path path = write(scratchFolder("abc_any") / "hair.abc", smallGroom(), {.frameCount = 20}, 20);
  auto reader = AbcReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  std::vector<Vec3f> points;
  for (const int frame : {20, 1, 13, 13, 2}) {
    ASSERT_TRUE(reader->readFrame(frame, points));
    EXPECT_EQ(points, pointsAt(smallGroom(), frame));
  }
}

// As a groom it is its first frame, also while it is written.
TEST(AbcWriter, IsAGroomAsWell) {
  for (const bool finishes : {true, false}) {
    const fs::path path = write(scratchFolder("abc_groom") / "hair.abc", smallGroom(),
                                {.metresPerUnit = 0.0254, .frameCount = 4}, 3, finishes);
    const auto groom = readAbcGroom(bytesOf(test::readText(path)), path);
    ASSERT_TRUE(groom) << groom.error().message;
    EXPECT_EQ(groom->groom.points, pointsAt(smallGroom(), 1));
    EXPECT_EQ(groom->groom.firstPoint, smallGroom().firstPoint);
    EXPECT_TRUE(groom->statesUnit && groom->statesUp && !groom->isTurned);
    EXPECT_EQ(groom->groom.metresPerUnit, 0.0254);
  }
}

// The head's transform stands between the points and the world, in which the axis points up.
TEST(AbcWriter, AGroomIsTurnedToTheAxisThatIsWanted) {
  const fs::path path = write(scratchFolder("abc_turned") / "hair.abc", smallGroom(),
                              {.up = UpAxis::z, .frameCount = 1, .usd = {.head = UsdHead::transform}}, 1);
  const std::string bytes = test::readText(path);
  const auto kept = readAbcGroom(bytesOf(bytes), path, {.upIsZ = true}),
             turned = readAbcGroom(bytesOf(bytes), path);
  ASSERT_TRUE(kept && turned);
  EXPECT_TRUE(turned->isTurned && !kept->isTurned);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3f p = kept->groom.points[i], q = turned->groom.points[i];
    EXPECT_NEAR(q.x, p.x, 1e-6);
    EXPECT_NEAR(q.y, p.z, 1e-6);
    EXPECT_NEAR(q.z, -p.y, 1e-6);
  }
}

// Another rate, unit, thickness, or other values: another animation, which is not gone on with.
TEST(AbcWriter, GoesOnWithItsOwnOnly) {
  const fs::path path = scratchFolder("abc_other") / "hair.abc";
  const AnimationOptions plain{.frameCount = 4};
  std::vector<AnimationOptions> others(6, plain);
  others[0].framesPerSecond = 25;
  others[1].metresPerUnit = 1;
  others[2].up = UpAxis::z;
  others[3].diameter = 1;
  others[4].usd.ids = true;
  others[5].frameCount = 5;
  for (std::size_t k = 0; k < others.size(); ++k) {
    write(path, smallGroom(), plain, 2, false);
    const std::string before = test::readText(path.string() + ".partial");
    const auto resumed = AbcWriter::resume(path, smallGroom(), others[k], 2);
    ASSERT_FALSE(resumed) << k;
    EXPECT_NE(resumed.error().message.find("found another file or fewer"), std::string::npos)
        << resumed.error().message;
    EXPECT_EQ(test::readText(path.string() + ".partial"), before) << k;
  }
  EXPECT_TRUE(AbcWriter::resume(path, smallGroom(), plain, 2));
}

TEST(AbcReader, RefusesArchivesOfOthers) {
  const fs::path path = write(scratchFolder("abc_foreign") / "hair.abc", smallGroom(), {.frameCount = 1}, 1);
  EXPECT_TRUE(AbcReader::isOurs(path));
  std::string text = test::readText(path);
  text[kAbcMarkAt] = 'r';  // of "Ringlet frames 1"
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  const auto reader = AbcReader::open(path);
  ASSERT_FALSE(reader);
  EXPECT_NE(reader.error().message.find("only animations that Ringlet wrote"), std::string::npos)
      << reader.error().message;
  EXPECT_FALSE(AbcReader::isOurs(path));
  EXPECT_FALSE(AbcReader::isOurs(path.string() + "no"));
}

}  // namespace
}  // namespace ringlet::abc_writer_test
