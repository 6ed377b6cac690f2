// Value clips: the parts of an animation, read one by one; what a killed run leaves; going on with it.
#include "ringlet/output/usd/usd_clips_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/output/usd/usdc_reader.h"
#include "tests/support/test_support.h"

namespace ringlet::usd_clips_test {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::scratchFolder;

constexpr int kClipFrames = 4, kFrames = 10;

Groom groomAt(int frame) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, static_cast<float>(frame)}, {0, -1, 0.25f}, {0.5f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, static_cast<float>(frame) / 3}});
  return groom;
}

AnimationOptions options() {
  return {.frameCount = kFrames, .usd = {.ids = true, .velocities = true, .clipFrames = kClipFrames}};
}

// Every file below a folder, by its name there.
std::map<std::string, std::string> filesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).string()] = readText(entry.path());
  return files;
}
std::vector<std::string> namesOf(const std::map<std::string, std::string>& files) {
  std::vector<std::string> names;
  for (const auto& [name, text] : files) names.push_back(name);
  return names;
}

void write(const fs::path& path, int from, int to, bool finishes) {
  auto writer = animationFormatOf(path)->resume(path, groomAt(0), options(), from);
  ASSERT_TRUE(writer) << writer.error().message;
  for (int frame = from + 1; frame <= to; ++frame) ASSERT_TRUE((*writer)->addFrame(groomAt(frame).points));
  EXPECT_EQ((*writer)->frameCount(), to);
  if (finishes) {
    ASSERT_TRUE((*writer)->finish());
  }
}

TEST(UsdClips, EveryFrameIsInItsClip) {
  const fs::path path = scratchFolder("clips") / "hair.usda";
  write(path, 0, kFrames, true);
  EXPECT_EQ(namesOf(filesOf(path.parent_path())),
            (std::vector<std::string>{"hair.usda", "hair_clips/hair.0001.usdc", "hair_clips/hair.0002.usdc",
                                      "hair_clips/hair.0003.usdc", "hair_clips/manifest.usda"}));
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= kFrames; ++frame) {
    const int clip = (frame - 1) / kClipFrames + 1;
    auto reader = UsdcReader::open(UsdClipsWriter::clipPath(path, clip));
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->frameCount(), clip == 3 ? 2 : 4);
    ASSERT_TRUE(reader->readFrame((frame - 1) % kClipFrames + 1, points));
    EXPECT_EQ(points, groomAt(frame).points) << frame;
  }
  // Clips count as the whole does.
  for (int clip = 1; clip <= 3; ++clip) {
    const std::string bytes = readText(UsdClipsWriter::clipPath(path, clip));
    const auto layer = readUsdc(std::as_bytes(std::span(bytes)), "clip", {.keepsPlaces = true});
    ASSERT_TRUE(layer) << layer.error().message;
    for (const UsdAttribute& attribute : layer->prims.front().attributes) {
      if (attribute.places.empty()) continue;
      EXPECT_EQ(attribute.places.front().time, kClipFrames * (clip - 1) + 1) << attribute.name;
      EXPECT_EQ(attribute.places.back().time, std::min(kClipFrames * clip, kFrames)) << attribute.name;
    }
  }

  const std::string top = readText(path);
  for (const char* part :
       {"endTimeCode = 10\n", "startTimeCode = 1\n", "double2[] active = [(1, 0), (5, 1), (9, 2)]",
        "asset[] assetPaths = [@./hair_clips/hair.0001.usdc@, @./hair_clips/hair.0002.usdc@, "
        "@./hair_clips/hair.0003.usdc@]",
        "asset manifestAssetPath = @./hair_clips/manifest.usda@", "string primPath = \"/Hair\"",
        "double2[] times = [(1, 1), (10, 10)]", "int[] curveVertexCounts = [3, 2]",
        "int[] primvars:id = [0, 1]", "\n    point3f[] points\n", "\n    float3[] extent\n",
        "\n    vector3f[] velocities\n"})
    EXPECT_NE(top.find(part), std::string::npos) << part << " is missing in\n" << top;
  const auto clipped = readUsda(top, "top", UsdContent::meshes);
  ASSERT_TRUE(clipped) << clipped.error().message;
  ASSERT_EQ(clipped->prims.front().clips.size(), 1u);
  std::map<std::string_view, UsdValue> entries;
  for (const UsdEntry& entry : clipped->prims.front().clips.front().entries) entries[entry.key] = entry.value;
  EXPECT_EQ(entries["active"].numbers, (std::vector<double>{1, 0, 5, 1, 9, 2}));
  EXPECT_EQ(entries["times"].numbers, (std::vector<double>{1, 1, 10, 10}));
  EXPECT_EQ(entries["assetPaths"].texts,
            (std::vector<std::string_view>{"./hair_clips/hair.0001.usdc", "./hair_clips/hair.0002.usdc",
                                           "./hair_clips/hair.0003.usdc"}));
  EXPECT_EQ(entries["primPath"].texts, (std::vector<std::string_view>{"/Hair"}));
  const std::string manifest = readText(path.parent_path() / "hair_clips" / "manifest.usda");
  for (const std::string& text : {top, manifest}) {
    const auto layer = readUsda(text, "text");
    ASSERT_TRUE(layer) << layer.error().message;
    ASSERT_EQ(layer->prims.size(), 1u);
    EXPECT_EQ(layer->prims.front().name, "Hair");
  }
}

// Clips that are whole are listed, and what is after them is in the next clip's own `.partial`.
TEST(UsdClips, AKilledRunLeavesItsClipsAndFrames) {
  for (int frames = 1; frames <= kFrames; ++frames) {
    const fs::path path = scratchFolder("clips_killed") / "hair.usda";
    write(path, 0, frames, false);
    EXPECT_FALSE(fs::exists(path));
    const std::string top = readText(path.string() + ".partial");
    const int whole = frames / kClipFrames;
    EXPECT_NE(top.find("endTimeCode = " + std::to_string(whole * kClipFrames) + "\n"), std::string::npos)
        << top;
    int found = 0;
    for (int clip = 1; clip <= whole + 1; ++clip) {
      fs::path file = UsdClipsWriter::clipPath(path, clip);
      if (clip > whole) file += ".partial";
      if (!fs::exists(file)) continue;
      EXPECT_EQ(top.find(file.filename().string()) != std::string::npos, clip <= whole) << clip;
      const auto reader = UsdcReader::open(file);
      ASSERT_TRUE(reader) << reader.error().message;
      found += reader->frameCount();
    }
    EXPECT_EQ(found, frames);
  }
}

TEST(UsdClips, AreGoneOnWithToTheSameBytes) {
  const fs::path path = scratchFolder("clips_resume") / "hair.usda";
  write(path, 0, kFrames, true);
  const auto whole = filesOf(path.parent_path());
  for (int killed = 1; killed <= kFrames; ++killed) {
    for (int from = 1; from <= killed; ++from) {
      fs::remove_all(path.parent_path());
      fs::create_directories(path.parent_path());
      write(path, 0, killed, false);
      write(path, from, kFrames, true);
      EXPECT_TRUE(filesOf(path.parent_path()) == whole) << killed << " frames, on from " << from;
    }
  }
}

TEST(UsdClips, FewerFramesThanAnnounced) {
  const fs::path path = scratchFolder("clips_few") / "hair.usda";
  write(path, 0, 6, true);
  EXPECT_NE(readText(path).find("endTimeCode = 6\n"), std::string::npos);
  const auto reader = UsdcReader::open(UsdClipsWriter::clipPath(path, 2));
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->frameCount(), 2);
}

TEST(UsdClips, ClipsOfALongerRunGo) {
  const fs::path path = scratchFolder("clips_stale") / "hair.usda";
  write(path, 0, kFrames, true);
  write(path, 0, 3, true);
  EXPECT_EQ(namesOf(filesOf(path.parent_path())),
            (std::vector<std::string>{"hair.usda", "hair_clips/hair.0001.usdc", "hair_clips/manifest.usda"}));
}

TEST(UsdClips, NothingIsLeftWithoutFrames) {
  const fs::path path = scratchFolder("clips_none") / "hair.usda";
  { ASSERT_TRUE(animationFormatOf(path)->resume(path, groomAt(0), options(), 0)); }
  EXPECT_TRUE(fs::is_empty(path.parent_path()));
}

}  // namespace
}  // namespace ringlet::usd_clips_test
