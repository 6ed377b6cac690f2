// `ringlet render`: films, pictures in linear light, a ground, cameras of the scene; and the sheet of a run
// that it draws.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/motion/gltf_samples.h"
#include "tests/program/rendered_run.h"

namespace ringlet::render_files_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::differing;
using test::Image;

class RenderFiles : public test::RenderedRun {
 protected:
  static bool hasFfmpeg() { return std::system("command -v ffmpeg > /dev/null") == 0; }
  // A PNG of what ffmpeg reads in a file.
  Image asFfmpegReads(const fs::path& file, const std::string& options = "") {
    const fs::path png = folder_ / "read.png";
    const std::string command =
        "ffmpeg -loglevel error -y -i " + (folder_ / file).string() + " " + options + " " + png.string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    return test::readPng(png);
  }
};

TEST_F(RenderFiles, FilmsHaveEveryFrame) {
  if (!hasFfmpeg()) GTEST_SKIP() << "SKIPPED: ffmpeg is not installed, no film was made";
  render({"out", "-o", "frames"});
  for (const char* file : {"film.mp4", "film.gif", "it's a film.webp"}) {
    const json said = render({"out", "-o", file});
    EXPECT_EQ(said["frames"], test::kRenderedFrames) << file;
    EXPECT_EQ(said["outputs"], json({file}));
    EXPECT_TRUE(fs::exists(folder_ / file));
    EXPECT_FALSE(fs::exists(folder_ / (std::string(file) + ".partial"))) << file;
  }
  // The last frame, but for what the film's format loses.
  const Image last = asFfmpegReads("film.mp4", "-vf 'select=eq(n\\,3)' -frames:v 1");
  const double same = test::rmsDifference(last, picture("frames/frame.0004.png"));
  EXPECT_LT(same, 15);
  EXPECT_LT(same, 0.7 * test::rmsDifference(last, picture("frames/frame.0001.png")));
}

// Without a program that makes films nothing is begun, and a sentence says what to do.
TEST_F(RenderFiles, FilmsNeedFfmpeg) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const auto result = run({"render", "out", "-o", "none.mp4"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exitCode, 1);
  for (const char* part : {"films are made by ffmpeg", "Debian: ffmpeg", "PNG", "folder"})
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "none.mp4.partial"));
}

// What fails leaves nothing behind.
TEST_F(RenderFiles, AFilmThatFailsLeavesNothing) {
  std::ofstream(folder_ / "ffmpeg") << "#!/bin/sh\nexit 1\n";
  fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const auto result = run({"render", "out", "-o", "bad.mp4", "--size", "96x54", "--samples", "1"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exitCode, 5) << result.err;
  EXPECT_NE(result.err.find("ffmpeg could not do its work"), std::string::npos) << result.err;
  for (const char* file : {"bad.mp4", "bad.mp4.partial"}) EXPECT_FALSE(fs::exists(folder_ / file));
}

TEST_F(RenderFiles, LightIsWrittenAsExr) {
  EXPECT_EQ(render({"out", "-o", "light", "--format", "exr"})["outputs"],
            json({"light/frame.0001.exr", "light/frame.0004.exr"}));
  EXPECT_EQ(render({"out", "-o", "one.exr", "--frames", "4:4"})["outputs"], json({"one.exr"}));
  if (!hasFfmpeg()) GTEST_SKIP() << "SKIPPED: ffmpeg is not installed, which would read the picture";
  // Brighter hair is brighter light.
  render({"out", "-o", "blond.exr", "--frames", "4:4", "--colour", "white"});
  const auto sum = [](const Image& image) {
    double total = 0;
    for (const auto byte : image.bytes) total += byte;
    return total;
  };
  const Image brown = asFfmpegReads("one.exr");
  EXPECT_EQ(brown.width, 96);
  EXPECT_EQ(brown.height, 54);
  EXPECT_GT(sum(asFfmpegReads("blond.exr")), 1.1 * sum(brown));
}

TEST_F(RenderFiles, AGroundIsUnderEverything) {
  const json said = render({"head.obj", "-o", "ground.png", "--ground", "--no-bodies"});
  render({"head.obj", "-o", "none.png", "--no-bodies"});
  double lowest = 1e9;
  std::ifstream obj(folder_ / "head.obj");
  for (std::string word; obj >> word;) {
    double x = 0, y = 0;
    if (word == "v" && obj >> x >> y) lowest = std::min(lowest, 0.01 * y);
  }
  EXPECT_NEAR(said["ground_m"].get<double>(), lowest, 1e-6);
  EXPECT_GT(differing(picture("ground.png"), picture("none.png")), 1000);
  EXPECT_EQ(render({"head.obj", "-o", "b.png", "--ground=-0.5"})["ground_m"], -0.5);
  // A head below its hair stands on it.
  ASSERT_EQ(run({"make", "head", "--strands", "120", "--length", "0.02", "-o", "short.obj"}).exitCode, 0);
  EXPECT_LT(render({"short.obj", "-o", "b.png", "--ground"})["ground_m"].get<double>(),
            render({"short.obj", "-o", "b.png", "--ground", "--no-bodies"})["ground_m"].get<double>() - 0.02);
  // Seen from all sides of a world whose Z is up.
  const json up = render({"head.obj", "-o", "z.png", "--ground", "--up", "Z", "--no-bodies"});
  EXPECT_GT(up["ground_m"].get<double>(), said["ground_m"].get<double>());
}

// The same hair seen by a camera of the scene, and by one that looks away.
TEST_F(RenderFiles, CamerasAreOfTheScene) {
  test::GltfBuilder gltf;
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
  const int head = gltf.node({{"name", "Head"}});
  const int shot = gltf.node({{"name", "Shot"}, {"camera", 0}, {"translation", {0, 0, 1}}});
  // Over a sixth of a second, four frames, to the side.
  for (const int node : {head, shot}) {
    const double way = node == shot ? 0.2 : 0.0001;
    gltf.channel(0, node, "translation", "LINEAR", {0, 1.0 / 6},
                 {0, 0, node == shot ? 1.0 : 0, way, 0, node == shot ? 1.0 : 0});
  }
  std::ofstream(folder_ / "shot.gltf") << gltf.text();
  std::ofstream(folder_ / "cameras.toml")
      << "groom.file = 'head.obj'\nmotion.file = 'shot.gltf'\n"
         "[[camera]]\nname = 'front'\neye = [0, 0, 1]\nfield_of_view = 28.64788975654116\n"
         "[[camera]]\nname = 'away'\neye = [0, 0, 1]\ntarget = [0, 0, 2]\n"
         "[[camera]]\nname = 'Shot'\nfile = 'shot.gltf'\n";
  ASSERT_EQ(run({"simulate", "cameras.toml", "--frames", "4", "--cache", "float32", "--no-usd", "--no-sheet",
                 "-o", "shots"})
                .exitCode,
            0);
  for (const char* camera : {"front", "away", "Shot"})
    render({"shots", "--scene", "cameras.toml", "-o", camera, "--camera", camera, "--no-bodies"});
  const Image front = picture("front/frame.0004.png"), away = picture("away/frame.0004.png");
  EXPECT_EQ(away, picture("away/frame.0001.png")) << "there is nothing";
  EXPECT_GT(differing(front, away), 300);
  EXPECT_GT(differing(picture("Shot/frame.0004.png"), away), 300);
  const int moved = differing(picture("Shot/frame.0004.png"), picture("Shot/frame.0001.png"));
  EXPECT_GT(moved, 300);
  // One that stands still sees hair that swings.
  EXPECT_LT(differing(front, picture("front/frame.0001.png")), moved / 2);
  expectRefused({"shots", "--scene", "cameras.toml", "-o", "x", "--camera", "fronts"}, 1,
                {"no camera fronts", "did you mean front?", "away", "Shot"});
  expectRefused({"shots", "-o", "x", "--camera", "front"}, 2, {"--scene"});
  expectRefused({"shots", "--scene", "cameras.toml", "-o", "x", "--camera", "front", "--orbit", "90"}, 2,
                {"--orbit"});
}

TEST_F(RenderFiles, TheSheetOfARunCanBeRendered) {
  const std::vector<std::string> simulate = {"simulate", "head.obj", "--motion",  "shake",
                                             "--frames", "8",        "--no-last", "--overwrite"};
  const auto sheetOf = [&](const std::string& folder, std::vector<std::string> more, int exitCode = 0) {
    std::vector<std::string> arguments = simulate;
    arguments.insert(arguments.end(), {"-o", folder});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = run(arguments);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    return exitCode == 0 ? picture(folder + "/sheet.png") : Image{};
  };
  const Image drawn = sheetOf("drawn", {}), rendered = sheetOf("rendered", {"--sheet", "rendered"});
  EXPECT_EQ(rendered.width, drawn.width);
  EXPECT_EQ(rendered.height, drawn.height);
  EXPECT_GT(differing(rendered, drawn), drawn.width * drawn.height / 10);
  // Six frames of eight, the first and the last among them: panels differ from their neighbours.
  const auto panel = [&](int k) {
    Image one{rendered.width / 6, rendered.height, {}};
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < 3 * one.width; ++x)
        one.bytes.push_back(
            rendered.bytes[static_cast<std::size_t>(3 * (y * rendered.width + k * one.width) + x)]);
    return one;
  };
  for (int k = 1; k < 6; ++k) EXPECT_GT(differing(panel(k), panel(k - 1)), 1000) << k;
  // An animation that can be drawn is needed, and that is said before anything is done.
  sheetOf("none", {"--sheet", "rendered", "--no-usd"}, 1);
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(RenderFiles, WhatMakesNoSenseIsRefused) {
  expectRefused({"head.obj", "-o", "x.mp4"}, 2, {"is a film", "no frames"});
  expectRefused({"out", "-o", "x.exr"}, 2, {"one picture"});
  expectRefused({"out", "-o", "x.mp4", "--format", "exr"}, 2, {"--format"});
  expectRefused({"out", "-o", "x", "--ground=low"}, 2, {"--ground=0.1", "low"});
  std::ofstream(folder_ / "scene.toml") << "[groom]\n";
  expectRefused({"scene.toml", "-o", "x.webp"}, 2, {"folder"});
}

}  // namespace
}  // namespace ringlet::render_files_test
