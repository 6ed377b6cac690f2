// `ringlet render`: pictures of everything that it takes, what it says of them, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/program/rendered_run.h"

namespace ringlet::render_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::differing;
using test::greatestDifference;
using test::Image;

constexpr int kFrames = test::kRenderedFrames;

using Render = test::RenderedRun;

TEST_F(Render, ARunIsAPictureAFrame) {
  const json said = render({"out", "-o", "pictures"});
  EXPECT_EQ(said["frames"], kFrames);
  EXPECT_EQ(said["strands"], 120);
  EXPECT_EQ(said["hairs"], 30000);
  EXPECT_EQ(said["points"], 30000 * 24);
  EXPECT_NEAR(said["width_m"].get<double>(), 0.00018, 1e-9);
  EXPECT_TRUE(said["head"]);
  EXPECT_GT(said["seconds_per_frame"].get<double>(), 0);
  EXPECT_GT(said["cpu_seconds_per_frame"].get<double>(), 0);
  EXPECT_GT(said["device_bytes"].get<double>(), 30000 * 24 * 16);
  for (const char* stage : {"follow", "shadows", "draw", "shade", "tone"})
    EXPECT_TRUE(said["stages_ms"].contains(stage)) << stage;
  EXPECT_EQ(said["outputs"], json({"pictures/frame.0001.png", "pictures/frame.0004.png"}));
  for (int frame = 1; frame <= kFrames; ++frame) {
    const Image image = picture("pictures/frame.000" + std::to_string(frame) + ".png");
    EXPECT_EQ(image.width, 96);
    EXPECT_EQ(image.height, 54);
    if (frame > 1) {
      EXPECT_GT(differing(image, picture("pictures/frame.0001.png")), 100);
    }
  }
}

// One picture, whichever file it comes from; and the same again.
TEST_F(Render, EveryFormatGivesTheSamePicture) {
  render({"out/hair.rgc", "-o", "rgc.png", "--frames", "3:3"});
  const Image image = picture("rgc.png");
  for (const char* source : {"out/hair.usdc", "out/hair.usda", "out", "out/hair.rgc"}) {
    render({source, "-o", "other.png", "--frames", "3:3"});
    EXPECT_EQ(picture("other.png"), image) << source;
  }
}

// A map of a scene; hairs are as wide as the strand that they follow.
TEST_F(Render, StrandsAreAsWideAsAMapSays) {
  const auto drawn = [&](const char* strands, const char* factor, const char* hairs) {
    std::ofstream(folder_ / "widths.toml") << "[groom]\nfile = \"head.obj\"\n[[map]]\nnumber = "
                                              "\"output.width\"\nstrands = \""
                                           << strands << "\"\nfactor = " << factor << "\n";
    render({"out", "-o", "widths.png", "--frames", "3:3", "--scene", "widths.toml", "--hairs", hairs});
    return picture("widths.png");
  };
  for (const char* hairs : {"0", "2000"}) {
    const Image plain = drawn("0:119", "1", hairs), some = drawn("0:39", "8", hairs),
                all = drawn("0:119", "8", hairs);
    EXPECT_GT(differing(some, plain), 30) << hairs;
    EXPECT_GT(differing(all, plain), differing(some, plain) + 30) << hairs;
  }
  ASSERT_EQ(run({"simulate", "widths.toml", "--motion", "nod", "--frames", "2", "--no-sheet", "-o", "wide"})
                .exitCode,
            0);
  const std::string text = test::readText(folder_ / "wide/hair.usda");
  EXPECT_NE(text.find("interpolation = \"uniform\""), std::string::npos);
  (void)drawn("0:39", "8", "0");
  ASSERT_EQ(run({"simulate", "widths.toml", "--motion", "nod", "--frames", "2", "--no-sheet", "--hairs",
                 "500", "-o", "full"})
                .exitCode,
            0);
  const std::string full = test::readText(folder_ / "full/hair.usda");
  std::istringstream widths(full.substr(full.find("float[] widths = [") + 18));
  int wide = 0, count = 0;
  for (char comma = ','; comma == ',' && widths; widths >> comma, ++count) {
    double width = 0;
    widths >> width;
    wide += width > 0.1;  // [cm]; 0.05 but for the factor
  }
  EXPECT_EQ(count, 500);
  // Four or five hairs follow each strand.
  EXPECT_GE(wide, 4 * 40);
  EXPECT_LE(wide, 5 * 40);
}

TEST_F(Render, AGroomIsOnePicture) {
  const json said = render({"head.obj", "-o", "head.png"});
  EXPECT_EQ(said["frames"], 1);
  EXPECT_EQ(said["outputs"], json({"head.png"}));
  EXPECT_EQ(render({"head.obj", "-o", "folder"})["outputs"], json({"folder/frame.0001.png"}));
  EXPECT_EQ(picture("folder/frame.0001.png"), picture("head.png"));
}

TEST_F(Render, ASceneIsSimulatedFirst) {
  std::ofstream(folder_ / "scene.toml")
      << "[groom]\nfile = \"head.obj\"\n[motion]\nkind = \"shake\"\n"
         "[simulation]\nframes = 3\n[[body]]\nshape = \"sphere\"\nradius = 0.085\n";
  const json said = render({"scene.toml", "-o", "shot"});
  EXPECT_EQ(said["frames"], 3);
  EXPECT_FALSE(said["head"]);
  EXPECT_TRUE(fs::exists(folder_ / "shot/hair.rgc"));
  // The same from the animation, with the scene's body and groom.
  render({"shot", "--scene", "scene.toml", "-o", "again"});
  for (const char* frame : {"frame.0001.png", "frame.0003.png"})
    EXPECT_EQ(picture(fs::path("again") / frame), picture(fs::path("shot") / frame));
  render({"shot", "--scene", "scene.toml", "-o", "alone", "--no-bodies"});
  EXPECT_GT(differing(picture("alone/frame.0003.png"), picture("shot/frame.0003.png")), 100);
}

// Hair too thin to be seen: what differs is the border of the body, which jumps with the head.
TEST_F(Render, BodiesAreBlurredAsHairIs) {
  std::ofstream(folder_ / "jump.toml")
      << "[groom]\nfile = \"head.obj\"\n[motion]\nkind = \"jump\"\n"
         "[simulation]\nframes = 4\n[[body]]\nshape = \"sphere\"\nradius = 0.085\n";
  render({"jump.toml", "--hairs", "0", "--width", "0.0000001", "-o", "sharp_body"});
  render({"sharp_body", "--scene", "jump.toml", "--hairs", "0", "--width", "0.0000001", "--blur", "4", "-o",
          "blurred_body"});
  EXPECT_GT(greatestDifference(picture("blurred_body/frame.0004.png"), picture("sharp_body/frame.0004.png")),
            20);
}

// Few strands are shown as locks, many as they are; long ones get fewer hairs.
TEST_F(Render, HairsThatNobodyAskedFor) {
  struct Case {
    const char *strands, *particles;
    int hairs;
    double width;
  };
  for (const Case& c :
       {Case{"2", "16", 600, 0.00018}, Case{"99", "100", 99 * 202, 0.00018}, Case{"100", "8", 30000, 0.00018},
        Case{"10000", "2", 10000, 0.00018 * std::sqrt(3)}}) {
    ASSERT_EQ(
        run({"make", "head", "--strands", c.strands, "--particles", c.particles, "-o", "some.obj"}).exitCode,
        0);
    const json said = render({"some.obj", "-o", "some.png"});
    EXPECT_EQ(said["hairs"], c.hairs) << c.strands;
    EXPECT_NEAR(said["width_m"].get<double>(), c.width, 1e-9) << c.strands;
  }
}

TEST_F(Render, OptionsChangeThePicture) {
  const std::vector<std::string> base = {"head.obj", "-o", "a.png"};
  render(base);
  const Image image = picture("a.png");
  const std::vector<std::vector<std::string>> changes = {
      {"--hairs", "0"},     {"--hairs", "2000"}, {"--width", "0.001"},  {"--colour", "blond"},
      {"--melanin", "0.9"}, {"--azimuth", "90"}, {"--elevation", "40"}, {"--distance", "2"},
      {"--no-bodies"},      {"--up", "Z"}};
  for (const auto& change : changes) {
    std::vector<std::string> arguments = {"head.obj", "-o", "b.png"};
    arguments.insert(arguments.end(), change.begin(), change.end());
    render(arguments);
    EXPECT_GT(differing(picture("b.png"), image), 50) << change.front();
  }
  EXPECT_EQ(render({"head.obj", "-o", "b.png", "--hairs", "0"})["hairs"], 120);
  EXPECT_EQ(render({"head.obj", "-o", "b.png", "--no-bodies"})["head"], false);
}

TEST_F(Render, BlurAndOrbitAreOfAnimations) {
  render({"out", "-o", "sharp"});
  render({"out", "-o", "blurred", "--blur", "3"});
  EXPECT_EQ(picture("blurred/frame.0001.png"), picture("sharp/frame.0001.png"))
      << "nothing is before frame 1";
  EXPECT_GT(differing(picture("blurred/frame.0003.png"), picture("sharp/frame.0003.png")), 100);
  render({"out", "-o", "round", "--orbit", "180"});
  EXPECT_EQ(picture("round/frame.0001.png"), picture("sharp/frame.0001.png"));
  EXPECT_GT(differing(picture("round/frame.0004.png"), picture("sharp/frame.0004.png")), 500);
}

// A picture of a later frame does not depend on which others are drawn, but for the camera, which shows them
// all.
TEST_F(Render, FramesAreThoseAskedFor) {
  EXPECT_EQ(render({"out", "-o", "some", "--frames", "2:3"})["frames"], 2);
  EXPECT_EQ(render({"out", "-o", "one", "--frames", "3"})["frames"], 1);
  EXPECT_FALSE(fs::exists(folder_ / "some/frame.0001.png"));
  EXPECT_TRUE(fs::exists(folder_ / "some/frame.0002.png"));
  EXPECT_FALSE(fs::exists(folder_ / "some/frame.0004.png"));
}

TEST_F(Render, WhatMakesNoSenseIsRefused) {
  expectRefused({"out", "-o", "x.png"}, 2, {"one picture", "--frames 12,"});
  for (const char* frames : {"3:2", "0", "2:", ":2", "two", "1:2:3"})
    expectRefused({"out", "-o", "x", "--frames", frames}, 2, {"as 12, or the first and the last, as 1:24"});
  expectRefused({"nothing", "-o", "x.png"}, 4, {"nothing: there is no such file or folder"});
  for (const char* file : {"x.jpg", "x.JPG", "x.tif", "x.tga", "x.mov", "x.PNG"}) {
    expectRefused({"out", "-o", file}, 2,
                  {file, "must end in .png or .exr", "for a folder of that name make it first"});
    std::filesystem::create_directory(folder_ / file);
    render({"out", "-o", file, "--frames", "1"});
    EXPECT_TRUE(std::filesystem::exists(folder_ / file / "frame.0001.png"));
    std::filesystem::remove_all(folder_ / file);
  }
  render({"out", "-o", "take.v2", "--frames", "1"});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "take.v2/frame.0001.png"));
  expectRefused({"out", "-o", "x", "--frames", "2:9"}, 1, {"has 4 frames", "2 to 9"});
  expectRefused({"out", "-o", "x", "--size", "10by10"}, 2, {"960x540", "10by10"});
  expectRefused({"out", "-o", "x", "--colour", "bleu"}, 2, {"auburn", "bleu"});
  expectRefused({"out", "-o", "x", "--up", "Z"}, 2, {"--up"});
  expectRefused({"head.obj", "-o", "x", "--frames", "1:1"}, 2, {"is a groom"});
  expectRefused({"out", "-o", "x", "--scene", "a.toml", "--groom", "head.obj"}, 2, {"--groom"});
  fs::create_directory(folder_ / "empty");
  expectRefused({"empty", "-o", "x"}, 4, {"hair.rgc", "simulate"});
  expectRefused({"out", "-o", "x", "--groom", "other.obj"}, 4, {"other.obj"});
  ASSERT_EQ(run({"make", "head", "--strands", "130", "-o", "other.obj"}).exitCode, 0);
  expectRefused({"out", "-o", "x", "--groom", "other.obj"}, 1, {"do not belong together"});
  EXPECT_FALSE(fs::exists(folder_ / "x/frame.0001.png"));
}

}  // namespace
}  // namespace ringlet::render_test
