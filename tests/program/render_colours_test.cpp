// `ringlet render --colour stretch|contacts|strand|error`: colours that are a number of each strand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/rendered_run.h"

namespace ringlet::render_colours_test {
namespace {

using nlohmann::json;
using test::differing;
using test::Image;

// Blue is the first colour of a scale, red the last; what is neither is background.
struct Seen {
  int blue = 0, red = 0;
};
Seen seenIn(const Image& image) {
  Seen seen;
  for (std::size_t i = 0; i + 2 < image.bytes.size(); i += 3) {
    seen.blue += image.bytes[i + 2] > image.bytes[i] + 40;
    seen.red += image.bytes[i] > image.bytes[i + 2] + 40;
  }
  return seen;
}

class RenderColours : public test::RenderedRun {
 protected:
  // The strands of frame 4, alone.
  Image coloured(const std::string& colour, std::vector<std::string> more, json* said = nullptr) {
    std::vector<std::string> arguments = {"out", "-o",          "a.png",       "--frames", "4:4", "--hairs",
                                          "0",   "--no-bodies", "--no-legend", "--colour", colour};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const json found = render(arguments);
    if (said) *said = found["colours"];
    return picture("a.png");
  }

  // A scale that ends at next to nothing is all red where there is anything, one that ends far away all blue.
  void expectScale(const std::string& colour, const std::vector<std::string>& more) {
    for (const auto& [most, isRed] : {std::pair{"0.000001", true}, std::pair{"1000", false}}) {
      std::vector<std::string> arguments = {"--most", most};
      arguments.insert(arguments.end(), more.begin(), more.end());
      json said;
      const Seen seen = seenIn(coloured(colour, arguments, &said));
      EXPECT_GT(isRed ? seen.red : seen.blue, 100) << colour << " " << most;
      EXPECT_LT(isRed ? seen.blue : seen.red, 5) << colour << " " << most;
      EXPECT_EQ(said["of"], colour);
      EXPECT_EQ(said["from"], 0);
      EXPECT_EQ(said["to"], std::stod(most));
    }
  }
};

TEST_F(RenderColours, StretchAndContactsAreOfTheFrame) {
  expectScale("stretch", {});
  expectScale("contacts", {});
}

TEST_F(RenderColours, ALegendIsInTheCornerUnlessItIsLeftOut) {
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render",  "out",    "-o",      "a.png",     "--frames",
                                          "4:4",     "--size", "400x300", "--samples", "1",
                                          "--hairs", "0",      "--colour"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exitCode, 0);
    return picture("a.png");
  };
  const Image with = drawn({"stretch"}), without = drawn({"stretch", "--no-legend"});
  int changed = 0;
  for (std::size_t i = 0; i < with.bytes.size(); ++i) {
    if (with.bytes[i] == without.bytes[i]) continue;
    const std::size_t x = i / 3 % 400, y = i / 3 / 400;
    EXPECT_TRUE(x < 120 && y > 240) << x << " " << y;
    ++changed;
  }
  EXPECT_GT(changed, 1000);
  EXPECT_EQ(differing(drawn({"strand"}), drawn({"strand", "--no-legend"})), 0);  // is no scale
}

TEST_F(RenderColours, ErrorIsTheDistanceFromAnotherRun) {
  ASSERT_EQ(run({"simulate", "head.obj", "--motion", "nod", "--frames", "4", "--cache", "float32", "--no-usd",
                 "--no-sheet", "-o", "other"})
                .exitCode,
            0);
  expectScale("error", {"--against", "other"});
  const Seen same = seenIn(coloured("error", {"--against", "out/hair.usda", "--most", "0.00001"}));
  EXPECT_GT(same.blue, 100) << "a run is as far as its precision from itself";
  EXPECT_EQ(same.red, 0);
  json said;
  coloured("error", {"--against", "other"}, &said);
  EXPECT_EQ(said, json::parse(R"({"of": "error", "from": 0, "to": 0.01, "unit": "m"})"));
}

TEST_F(RenderColours, EachStrandHasItsOwn) {
  json said;
  const Seen seen = seenIn(coloured("strand", {}, &said));
  EXPECT_GT(seen.blue, 50);
  EXPECT_GT(seen.red, 50);
  EXPECT_EQ(said, json::parse(R"({"of": "strand"})"));
  // Hairs have the colour of the strand that they follow, in every frame.
  render({"out", "-o", "some", "--colour", "strand", "--no-bodies"});
  EXPECT_GT(seenIn(picture("some/frame.0001.png")).red, 50);
  // And so has a groom, which has not moved.
  render({"head.obj", "-o", "groom.png", "--colour", "strand", "--no-bodies"});
  EXPECT_GT(seenIn(picture("groom.png")).blue, 50);
}

TEST_F(RenderColours, TheEndsOfTheScaleAreSaid) {
  const auto result = run({"render", "out", "-o", "a.png", "--frames", "4:4", "--size", "64x36", "--samples",
                           "1", "--colour", "stretch"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_NE(result.out.find("colours: blue 0, red 5 % and more: "), std::string::npos) << result.out;
}

TEST_F(RenderColours, WhatMakesNoSenseIsRefused) {
  expectRefused({"out", "-o", "x", "--colour", "error"}, 2, {"--against"});
  expectRefused({"out", "-o", "x", "--against", "out"}, 2, {"--colour error"});
  expectRefused({"out", "-o", "x", "--colour", "strand", "--most", "1"}, 2, {"--most"});
  expectRefused({"out", "-o", "x", "--colour", "stretch", "--melanin", "0.5"}, 2, {"--melanin"});
  expectRefused({"head.obj", "-o", "x", "--colour", "stretch"}, 2, {"at rest"});
  expectRefused({"out", "-o", "x", "--colour", "strech"}, 2, {"auburn", "stretch, contacts, strand, error"});
  ASSERT_EQ(run({"simulate", "head.obj", "--frames", "2", "--cache", "float32", "--no-usd", "--no-sheet",
                 "-o", "short"})
                .exitCode,
            0);
  expectRefused({"out", "-o", "x", "--colour", "error", "--against", "short"}, 1,
                {"has 2 frames", "no frame 3"});
  ASSERT_EQ(run({"make", "head", "--strands", "130", "--particles", "24", "-o", "many.obj"}).exitCode, 0);
  ASSERT_EQ(run({"simulate", "many.obj", "--frames", "1", "--cache", "float32", "--no-usd", "--no-sheet",
                 "-o", "many"})
                .exitCode,
            0);
  expectRefused({"out", "-o", "x", "--colour", "error", "--against", "many"}, 1, {"only the same strands"});
}

}  // namespace
}  // namespace ringlet::render_colours_test
