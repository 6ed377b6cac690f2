// groom/alembic/abc_archive.h and ogawa_file.h: objects, properties and samples of files as AbcBytes makes
// them and as the Alembic library wrote them, and what is refused.
#include "ringlet/groom/alembic/abc_archive.h"

#include <gtest/gtest.h>

#include <limits>

#include "ringlet/base/whole_file.h"
#include "tests/groom/abc_bytes.h"
#include "tests/support/test_support.h"

namespace ringlet::test::abc_archive_test {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string problemOf(const std::string& bytes) {
  const auto archive = AbcArchive::of(bytesOf(bytes), "a.abc");
  return archive ? "" : archive.error().message;
}
void expectProblem(const std::string& problem, const std::string& expected) {
  EXPECT_NE(problem.find(expected), std::string::npos) << "found: " << problem << "\nexpected: " << expected;
}

// An object with one property.
AbcBytes fileOf(const AbcBytes::Property& property) {
  AbcBytes file;
  file.objects = {{.name = "a", .metadata = "schema=S", .properties = {property}}};
  return file;
}

// What it has, of a file that is read.
struct Read {
  std::string bytes;
  AbcArchive archive;
  AbcProperty property;
};
Read readOf(AbcBytes file) {
  std::string bytes = file.bytes();
  auto archive = AbcArchive::of(bytesOf(bytes), "a.abc");
  EXPECT_TRUE(archive) << archive.error().message;
  const auto properties = archive->propertiesOf(1);
  EXPECT_TRUE(properties) << properties.error().message;
  const AbcProperty property = properties->at(0);
  return {std::move(bytes), std::move(*archive), property};
}
template <class T>
std::string sampleProblem(const Result<T>& result) {
  return result ? "" : result.error().message;
}

TEST(AbcArchive, ObjectsHavePathsAndMetadata) {
  for (const bool isInPlace : {false, true}) {
    AbcBytes file;
    file.isInPlace = isInPlace;
    const AbcBytes::Object inner{.name = "inner", .metadata = "schema=B;a=b=c;x"};
    file.objects = {{.name = "one", .metadata = "schema=A", .children = {inner, {.name = "last"}}},
                    {.name = "two", .metadata = "schema=" + std::string(300, 'z'), .children = {inner}}};
    const std::string bytes = file.bytes();
    const auto archive = AbcArchive::of(bytesOf(bytes), "a.abc");
    ASSERT_TRUE(archive) << archive.error().message;
    std::vector<std::string> paths;
    for (std::uint32_t k = 0; k < archive->objects().size(); ++k) paths.push_back(archive->pathOf(k));
    EXPECT_EQ(paths,
              (std::vector<std::string>{"/", "/one", "/two", "/one/inner", "/one/last", "/two/inner"}));
    const std::string_view metadata = archive->objects()[3].metadata;
    EXPECT_EQ(abcValueOf(metadata, "schema"), "B");
    EXPECT_EQ(abcValueOf(metadata, "a"), "b=c");
    EXPECT_EQ(abcValueOf(metadata, "x"), "");
    EXPECT_EQ(abcValueOf(archive->objects()[2].metadata, "schema").size(), 300u);
    EXPECT_EQ(archive->objects()[4].metadata, "");
    const auto none = archive->propertiesOf(1);
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->empty());
  }
}

TEST(AbcArchive, NumbersOfEveryTypeAreRead) {
  struct Case {
    std::uint32_t type;
    std::string bytes;
    std::vector<double> numbers;
  };
  for (const Case& c :
       {Case{0, std::string("\0\1", 2), {0, 1}}, Case{1, "\x05\xff", {5, 255}}, Case{2, "\x05\xff", {5, -1}},
        Case{3, abcNumbers<std::uint16_t>({7, 65535}), {7, 65535}},
        Case{4, abcNumbers<std::int16_t>({7, -2}), {7, -2}},
        Case{5, abcNumbers<std::uint32_t>({9, 4294967295u}), {9, 4294967295.0}},
        Case{6, abcNumbers<std::int32_t>({9, -3}), {9, -3}},
        Case{7, abcNumbers<std::uint64_t>({1ull << 40, 2}), {1099511627776.0, 2}},
        Case{8, abcNumbers<std::int64_t>({-(1ll << 40), 2}), {-1099511627776.0, 2}},
        Case{9, abcNumbers<std::uint16_t>({0x3c00, 0xc100}), {1, -2.5}},
        Case{10, abcNumbers<float>({0.5f, -8}), {0.5, -8}},
        Case{11, abcNumbers<double>({0.1, -8}), {0.1, -8}}}) {
    for (const AbcBytes::Kind kind : {AbcBytes::scalar, AbcBytes::array}) {
      const Read read = readOf(fileOf({.name = "p",
                                       .kind = kind,
                                       .type = static_cast<AbcBytes::Type>(c.type),
                                       .width = 2,
                                       .samples = {c.bytes}}));
      EXPECT_EQ(static_cast<std::uint32_t>(read.property.type), c.type);
      const auto sample = read.archive.stored(read.property, 0);
      ASSERT_TRUE(sample) << sample.error().message;
      ASSERT_EQ(sample->numberCount(), 2u);
      EXPECT_EQ(sample->elementCount(), 1u);
      EXPECT_EQ(sample->number(0), c.numbers[0]);
      EXPECT_EQ(sample->number(1), c.numbers[1]);
    }
  }
  const Read read = readOf(fileOf({.name = "names",
                                   .kind = AbcBytes::array,
                                   .type = AbcBytes::text,
                                   .samples = {std::string("left\0\0right\0", 12)},
                                   .dimensions = {3}}));
  const auto sample = read.archive.stored(read.property, 0);
  ASSERT_TRUE(sample) << sample.error().message;
  EXPECT_EQ(sample->texts(), (std::vector<std::string_view>{"left", "", "right"}));
}

// The course of 8 samples of which 3 to 5 (from 0) are stored, at times of three kinds.
TEST(AbcArchive, KnotsSayTheCourseOfRepeatedSamples) {
  const auto number = [](float value) { return abcNumber(value); };
  AbcBytes file = fileOf({.name = "p",
                          .kind = AbcBytes::scalar,
                          .type = AbcBytes::f32,
                          .samples = {number(1), number(2), number(3), number(2)},
                          .sampling = 1,
                          .count = 8,
                          .firstChanged = 3,
                          .lastChanged = 5});
  const std::vector<std::uint32_t> samples{0, 2, 3, 4, 5, 7}, stored{0, 0, 1, 2, 3, 3};
  const std::vector<double> acyclic{0, 1, 4, 9, 16, 25, 36, 49};
  const AbcBytes::Sampling kinds[] = {{0.5, {10}}, {1, {2, 2.25}}, {AbcBytes::kNoCycle, acyclic}};
  for (std::size_t kind = 0; kind < 3; ++kind) {
    file.samplings = {{}, kinds[kind]};
    const Read read = readOf(file);
    const auto knots = read.archive.knotsOf(read.property);
    ASSERT_TRUE(knots) << knots.error().message;
    ASSERT_EQ(knots->size(), samples.size());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const std::uint32_t s = samples[k];
      const double seconds = kind == 0 ? 10 + 0.5 * s : kind == 1 ? 2 + s / 2 + 0.25 * (s % 2) : acyclic[s];
      EXPECT_EQ((*knots)[k].sample, s);
      EXPECT_EQ((*knots)[k].stored, stored[k]);
      EXPECT_EQ((*knots)[k].seconds, seconds) << "sample " << s << " of kind " << kind;
    }
    EXPECT_EQ(*read.archive.placeOfStored(read.property, 1), *read.archive.placeOfStored(read.property, 3));
  }
}

TEST(AbcArchive, SaysWhichSamplesItCannotUse) {
  const AbcBytes::Property good{.name = "p",
                                .kind = AbcBytes::array,
                                .type = AbcBytes::f32,
                                .width = 3,
                                .samples = {abcNumbers<float>({1, 2, 3}), abcNumbers<float>({1, 2, 4})}};
  const auto problem = [&](AbcBytes::Property property, AbcBytes::Sampling sampling = {}) {
    AbcBytes file = fileOf(property);
    file.samplings.push_back(sampling);
    const Read read = readOf(file);
    const std::string knots = sampleProblem(read.archive.knotsOf(read.property));
    return knots.empty() ? sampleProblem(read.archive.stored(read.property, 1)) : knots;
  };
  EXPECT_EQ(problem(good), "");
  const auto with = [&](auto change) {
    AbcBytes::Property changed = good;
    change(changed);
    return changed;
  };
  using P = AbcBytes::Property;
  expectProblem(problem(with([](P& p) { p.samples[1].pop_back(); })),
                "a.abc: /a: p: found 11 bytes in sample 2; expected whole elements of 12");
  expectProblem(problem(with([](P& p) { p.dimensions = {2}; })),
                "found 1 elements in sample 2; its dimensions");
  expectProblem(problem(with([](P& p) { p.dimensions = {1ull << 63, 2}; })), "its dimensions say another");
  EXPECT_EQ(problem(with([](P& p) { p.dimensions = {1, 1}; })), "");
  expectProblem(problem(with([](P& p) {
                  p.kind = AbcBytes::scalar;
                  p.samples[1] += p.samples[1];
                })),
                "found 2 elements in sample 2; expected 1");
  expectProblem(problem(with([](P& p) { p.count = 5; })), "found 2 stored samples; expected 5");
  expectProblem(problem(with([](P& p) { p.samples.clear(); })), "p: has no samples");
  expectProblem(problem(with([](P& p) { p.sampling = 9; })), "found time sampling 9; expected less than 2");
  const AbcBytes::Property timed = with([](P& p) { p.sampling = 1; });
  expectProblem(problem(timed, {AbcBytes::kNoCycle, {0}}), "found 1 times for 2 samples");
  expectProblem(problem(timed, {0, {3}}), "sample 2 is at 3 s; expected a time after");
  expectProblem(problem(timed, {1, {std::numeric_limits<double>::quiet_NaN()}}), "sample 1 is at nan s");
  const auto badHeader = [&](auto change) {
    const std::string bytes = fileOf(with(change)).bytes();
    const auto archive = AbcArchive::of(bytesOf(bytes), "a.abc");
    return archive ? sampleProblem(archive->propertiesOf(1)) : archive.error().message;
  };
  expectProblem(badHeader([](P& p) { p.firstChanged = 1, p.lastChanged = 2; }), "that change from 1 to 2");
  expectProblem(badHeader([](P& p) { p.width = 0; }), "found 0 values an element");
  expectProblem(badHeader([](P& p) { p.name = std::string(2000, 'n'); }), "name of 2000 bytes");
}

TEST(AbcArchive, RefusesOtherFilesByName) {
  AbcBytes file;
  file.objects = {{.name = "a"}};
  const std::string good = file.bytes();
  EXPECT_EQ(problemOf(good), "");
  expectProblem(problemOf("\x89HDF\r\n\x1a\n and more"), "a.abc: is an Alembic file of the older kind, HDF5");
  expectProblem(problemOf(""), "expected 'Ogawa'");
  expectProblem(problemOf("PXR-USDC"), "found 'PXR-USDC'; expected 'Ogawa'");
  std::string open = good;
  open[5] = 0;
  expectProblem(problemOf(open), "was not closed by the program that wrote it");
  std::string newer = good;
  newer[7] = 2;
  expectProblem(problemOf(newer), "found version 2 of Ogawa; expected version 1");
  file.version = 1;
  expectProblem(problemOf(file.bytes()), "found version 1 of Alembic archives; expected 0");
  file.version = 0;
  file.library = 900;
  expectProblem(problemOf(file.bytes()), "found library version 900; expected 9999");
}

// A group or data may end with the file, and no byte later.
TEST(AbcArchive, RefusesWhatReachesBeyondTheFile) {
  std::string file = AbcBytes{}.bytes();
  const auto childOf = [](std::uint64_t place, bool isData) {
    return OgawaChild{place | (std::uint64_t{isData} << 63)};
  };
  const std::uint64_t end = file.size();
  for (const bool isData : {false, true}) {
    for (const std::uint64_t count : {2u, 3u}) {
      std::string bytes = file + abcNumber<std::uint64_t>(isData ? 8 * count : count) + std::string(16, '\0');
      const auto ogawa = OgawaFile::of(bytesOf(bytes), "a.abc");
      ASSERT_TRUE(ogawa) << ogawa.error().message;
      const std::string problem = isData ? sampleProblem(ogawa->data(childOf(end, true)))
                                         : sampleProblem(ogawa->group(childOf(end, false)));
      EXPECT_EQ(problem.empty(), count == 2) << problem;
      if (count > 2) expectProblem(problem, isData ? "data of 24 bytes" : "a group of 3 children");
    }
  }
}

// Children that are their own parent, as no program writes them, and objects deeper than is read.
TEST(AbcArchive, RefusesCirclesAndDepths) {
  AbcBytes::Object chain{.name = "end"};
  for (int k = 0; k < 70; ++k) {
    AbcBytes::Object above{.name = "o"};
    above.children.push_back(std::move(chain));
    chain = std::move(above);
  }
  AbcBytes file;
  file.objects = {chain};
  expectProblem(problemOf(file.bytes()), "found objects more than 64 deep");

  const std::string filler(2000, 'f');
  file.objects = {{.name = "a", .metadata = filler, .children = {{.name = "b"}, {.name = "c"}}}};
  std::string bytes = file.bytes();
  // The group of /a: its compound (0), b, c, headers. Both children become /a.
  const std::string header = abcNumber<std::uint64_t>(4) + abcNumber<std::uint64_t>(0);
  const std::size_t at = bytes.find(header);
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t child : {at + 16, at + 24}) bytes.replace(child, 8, abcNumber<std::uint64_t>(at));
  expectProblem(problemOf(bytes), "objects in");
}

// Every shorter file is refused; every changed byte is refused or read to its end.
TEST(AbcArchive, SurvivesBrokenFiles) {
  AbcBytes file = fileOf({.name = "p",
                          .kind = AbcBytes::array,
                          .type = AbcBytes::f32,
                          .samples = {abcNumber(1.0f), abcNumber(2.0f)},
                          .dimensions = {1}});
  const std::string whole = file.bytes();
  const auto readAll = [](const std::string& bytes) {
    const auto archive = AbcArchive::of(bytesOf(bytes), "a.abc");
    if (!archive) return false;
    for (std::uint32_t k = 0; k < archive->objects().size(); ++k) {
      const auto properties = archive->propertiesOf(k);
      if (!properties) continue;
      for (const AbcProperty& property : *properties) {
        if (const auto knots = archive->knotsOf(property); !knots) continue;
        if (const auto sample = archive->stored(property, property.storedCount() - 1); sample)
          for (std::size_t n = 0; n < sample->numberCount(); ++n) (void)sample->number(n);
      }
    }
    return true;
  };
  ASSERT_TRUE(readAll(whole));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(readAll(whole.substr(0, size))) << size << " bytes";
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char flip : {'\x01', '\x40', '\x80', '\xff'}) {
      std::string broken = whole;
      broken[at] = static_cast<char>(broken[at] ^ flip);
      (void)readAll(broken);
    }
}

// As the library's own reader says of it (README.md beside it).
TEST(AbcArchive, ReadsHairOfTheAlembicLibrary) {
  RINGLET_NEEDS_DATA(path, "abc/curves_linear_animated.abc");
  const auto bytes = readWholeFile(path);
  ASSERT_TRUE(bytes);
  const auto archive = AbcArchive::of(*bytes, path.string());
  ASSERT_TRUE(archive) << archive.error().message;
  ASSERT_EQ(archive->objects().size(), 4u);
  EXPECT_EQ(archive->pathOf(3), "/groom/head/curls");
  EXPECT_EQ(abcValueOf(archive->objects()[3].metadata, "schema"), "AbcGeom_Curve_v2");
  const auto all = archive->propertiesOf(3);
  ASSERT_TRUE(all) << all.error().message;
  const auto geometry = archive->propertiesOf(*abcPropertyNamed(*all, ".geom"));
  ASSERT_TRUE(geometry) << geometry.error().message;
  const auto arbitrary = archive->propertiesOf(*abcPropertyNamed(*geometry, ".arbGeomParams"));
  ASSERT_TRUE(arbitrary) << arbitrary.error().message;
  const AbcProperty& points = *abcPropertyNamed(*geometry, "P");
  const auto knots = archive->knotsOf(points);
  ASSERT_TRUE(knots) << knots.error().message;
  ASSERT_EQ(knots->size(), 12u);
  EXPECT_NEAR(knots->front().seconds, 41.708333, 1e-6);
  EXPECT_NEAR(knots->back().seconds, 42.166667, 1e-6);
  const auto last = archive->stored(points, 11);
  ASSERT_TRUE(last) << last.error().message;
  ASSERT_EQ(last->elementCount(), 264u);
  EXPECT_NEAR(last->number(789), 7.09357, 1e-5);
  const auto names = archive->stored(*abcPropertyNamed(*arbitrary, "groom_group_name"), 0);
  ASSERT_TRUE(names);
  ASSERT_EQ(names->texts().size(), 8u);
  EXPECT_EQ(names->texts()[3], "left");
  EXPECT_EQ(names->texts()[4], "right");
  const auto minor = archive->stored(*abcPropertyNamed(*arbitrary, "groom_version_minor"), 0);
  ASSERT_TRUE(minor);
  EXPECT_EQ(minor->number(0), 5);
}

}  // namespace
}  // namespace ringlet::test::abc_archive_test
