// The metadata of value clips in USD layers, text and crates: what readers of meshes get of it, and its
// bounds.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "ringlet/groom/usd/usd_file.h"
#include "tests/groom/crate_bytes.h"

namespace ringlet::usd_clip_sets_test {
namespace {

using test::CrateBytes;

Result<UsdLayer> read(const std::string& bytes, UsdContent content = UsdContent::meshes) {
  return readUsdLayer(std::as_bytes(std::span(bytes)), "layer", content);
}

const std::string kText = R"(#usda 1.0
def Mesh "M" (
    active = true
    clips = {
        dictionary default = {
            double2[] active = [(1, 0), (5, 1)]
            asset[] assetPaths = [@./a.usd@, @@@b @ c.usd@@@]; asset manifestAssetPath = @./m.usda@
            string "primPath" = "/Hair"
            bool interpolateMissingClipValues = true
            dictionary customData = { dictionary deep = { int a = 1 } }
            double2[] times = [(1, 1), (10, 10)]
            double templateStride = 2.5
        }
        double wrong = 3
        dictionary empty = {}
    }
    prepend clipSets = ["default", "empty"]
)
{
}
)";

std::string crate() {
  CrateBytes crate;
  crate.name("M");
  crate.addRoot({"M"});
  const auto set = crate.dictionary({{"active", crate.array<double>(19, {1, 0, 5, 1}, 2)},
                                     {"assetPaths", crate.assets({"./a.usd", "b @ c.usd"})},
                                     {"manifestAssetPath", crate.asset("./m.usda")},
                                     {"primPath", crate.string("/Hair")},
                                     {"interpolateMissingClipValues", crate.flag(true)},
                                     {"customData", crate.dictionary({{"deep", crate.dictionary({})}})},
                                     {"times", crate.array<double>(19, {1, 1, 10, 10}, 2)},
                                     {"templateStride", crate.scalar<double>(9, {2.5})}});
  const auto clips =
      crate.dictionary({{"default", set}, {"wrong", crate.real(3)}, {"empty", CrateBytes::inlined(31, 0)}});
  crate.addPrim("/M", "Mesh", {},
                {{"clips", clips}, {"clipSets", crate.stringList({"default", "empty"}, 32)}});
  return crate.bytes();
}

TEST(UsdClipSets, AreReadFromTextAndCrates) {
  for (const std::string& bytes : {kText, crate()}) {
    const auto layer = read(bytes);
    ASSERT_TRUE(layer) << layer.error().message;
    const UsdPrim& prim = layer->prims.front();
    EXPECT_EQ(prim.composedBy, "");
    ASSERT_EQ(prim.clips.size(), 3u);
    EXPECT_EQ(prim.clips[1].name, "wrong");
    EXPECT_FALSE(prim.clips[1].isDictionary);
    EXPECT_EQ(prim.clips[2].name, "empty");
    EXPECT_TRUE(prim.clips[2].isDictionary && prim.clips[2].entries.empty());
    const UsdClipSet& set = prim.clips[0];
    EXPECT_EQ(set.name, "default");
    ASSERT_EQ(set.entries.size(), 8u);
    const auto valueOf = [&](std::string_view key) {
      const auto found = std::ranges::find(set.entries, key, &UsdEntry::key);
      return found == set.entries.end() ? UsdEntry{} : *found;
    };
    EXPECT_EQ(valueOf("active").value.numbers, (std::vector<double>{1, 0, 5, 1}));
    EXPECT_EQ(valueOf("active").value.width, 2u);
    EXPECT_EQ(valueOf("times").value.numbers, (std::vector<double>{1, 1, 10, 10}));
    EXPECT_EQ(valueOf("assetPaths").value.texts, (std::vector<std::string_view>{"./a.usd", "b @ c.usd"}));
    EXPECT_EQ(valueOf("manifestAssetPath").value.texts, (std::vector<std::string_view>{"./m.usda"}));
    EXPECT_EQ(valueOf("primPath").value.texts, (std::vector<std::string_view>{"/Hair"}));
    EXPECT_EQ(valueOf("interpolateMissingClipValues").value.numbers, (std::vector<double>{1}));
    EXPECT_EQ(valueOf("templateStride").value.numbers, (std::vector<double>{2.5}));
    EXPECT_TRUE(valueOf("customData").isDictionary);
    ASSERT_EQ(prim.clipSets.size(), 1u);
    EXPECT_EQ(prim.clipSets[0].edit, "prepend");
    EXPECT_EQ(prim.clipSets[0].names, (std::vector<std::string_view>{"default", "empty"}));
    // To who reads strands they are other files.
    const auto strands = read(bytes, UsdContent::strands);
    ASSERT_TRUE(strands) << strands.error().message;
    EXPECT_EQ(strands->prims.front().composedBy, "clips");
    EXPECT_TRUE(strands->prims.front().clips.empty());
  }
}

TEST(UsdClipSets, NoneIsNone) {
  for (const char* clips : {"clips = None", "clips = {}"}) {
    const auto layer = read(fmt::format("#usda 1.0\ndef \"M\" ( {} ) {{}}\n", clips));
    ASSERT_TRUE(layer) << layer.error().message;
    EXPECT_TRUE(layer->prims.front().clips.empty());
  }
}

TEST(UsdClipSets, TextHasBounds) {
  std::string many;
  for (std::size_t k = 0; k <= kMostUsdEntries; ++k) many += fmt::format("int a{} = 1\n", k);
  const auto text = [](const std::string& clips) {
    return "#usda 1.0\ndef \"M\" ( clips = { dictionary default = { " + clips + " } } ) {}\n";
  };
  const std::string deep(300, '{');
  struct Case {
    std::string text, message;
  };
  for (const Case& c :
       {Case{text(many), "expected at most 256 entries of a dictionary"}, Case{text("int a"), "expected '='"},
        Case{text("int = 3"), "expected the name of an entry"}, Case{text("int[ a = 3"), "expected ']'"},
        Case{text("= 3"), "expected the type of an entry, or '}'"},
        Case{text("dictionary a = " + deep), "expected at most 256 brackets in each other"},
        Case{text("int a = "), "expected a number"},
        Case{"#usda 1.0\ndef \"M\" ( clips = { int a = 1", "the type of an entry"}}) {
    const auto layer = read(c.text);
    ASSERT_FALSE(layer) << c.text;
    EXPECT_NE(layer.error().message.find(c.message), std::string::npos) << layer.error().message;
  }
}

// One dictionary that many prims have, and one of many entries.
TEST(UsdClipSets, CratesHaveBounds) {
  struct Case {
    std::size_t primCount, entryCount;
    const char* message;
  };
  for (const Case& c : {Case{1, 257, "found a dictionary of 257 entries; expected at most 256"},
                        Case{400, 256, "more entries of dictionaries; expected at most"}}) {
    CrateBytes crate;
    CrateBytes::Fields entries;
    for (std::size_t k = 0; k < c.entryCount; ++k) entries.push_back({"a", crate.flag(true)});
    const auto clips = crate.dictionary({{"default", crate.dictionary(entries)}});
    std::vector<std::string> names;
    for (std::size_t k = 0; k < c.primCount; ++k) names.push_back(fmt::format("M{}", k));
    for (const std::string& name : names) crate.name(name);
    crate.addRoot(names);
    for (const std::string& name : names) crate.addPrim("/" + name, "Mesh", {}, {{"clips", clips}});
    const auto layer = read(crate.bytes());
    ASSERT_FALSE(layer);
    EXPECT_NE(layer.error().message.find(c.message), std::string::npos) << layer.error().message;
  }
}

// Every shorter crate and every changed byte is read or refused.
TEST(UsdClipSets, SurviveBrokenCrates) {
  const std::string whole = crate();
  std::size_t readCount = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) readCount += read(whole.substr(0, size)) ? 1 : 0;
  EXPECT_EQ(readCount, 0u);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char flip : {'\x01', '\x80', '\xff'}) {
      std::string broken = whole;
      broken[at] = static_cast<char>(broken[at] ^ flip);
      readCount += read(broken) ? 1 : 0;
    }
  }
  EXPECT_GT(readCount, 0u);
}

}  // namespace
}  // namespace ringlet::usd_clip_sets_test
