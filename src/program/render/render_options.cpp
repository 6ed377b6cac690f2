// Implements render_options.h.
#include "program/render/render_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <string_view>

#include "program/cli/command_line.h"
#include "program/cli/confined_option.h"
#include "program/cli/frame_range.h"
#include "program/render/picture_options.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_reader.h"

namespace ringlet::program {
namespace {

constexpr const char* kFlagged = "true";  // as CLI11 has a flag without a value

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// A height of the ground; none for the lowest point.
std::optional<double> heightOf(const std::string& text) {
  double height = 0;
  const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), height);
  const bool isNumber = code == std::errc() && stop == text.data() + text.size() && std::abs(height) <= 1e6;
  return isNumber ? std::optional(height) : std::nullopt;
}

// A folder may have any name, but who says x.jpg wants no folder.
void checkOutput(const RenderOptions& options) {
  constexpr auto kForeign = std::to_array<std::string_view>(
      {".jpg",  ".jpeg", ".tif",  ".tiff", ".tga", ".bmp", ".dpx", ".hdr", ".jp2",
       ".heic", ".avif", ".apng", ".svg",  ".pdf", ".ppm", ".mov", ".avi", ".mkv",
       ".webm", ".mpg",  ".mpeg", ".m4v",  ".wmv", ".ogv", ".mxf"});
  std::string ending = options.output.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const bool isForeign = std::ranges::find(kForeign, ending) != kForeign.end();
  const bool isOurs = isPicture("x" + ending) || isFilm("x" + ending);  // but in capitals
  std::error_code code;
  const bool isFine = isPicture(options.output) || isFilm(options.output);
  if (isFine || !(isForeign || isOurs) || std::filesystem::is_directory(options.output, code)) return;
  throw CLI::ValidationError(
      "--output",
      fmt::format(
          "'{}' must end in .png or .exr (one picture) or in .mp4, .webp or .gif (a film); for a folder of "
          "that name make it first",
          options.output.string()));
}

void checkFrames(const RenderOptions& options) {
  const auto range = parseFrameRange(options.frames);
  if (isPicture(options.output) && !options.isGroom && !(range && range->first == range->last))
    throw CLI::ValidationError("--output",
                               "is one picture; say which frame, as --frames 12, or name a folder");
  if (options.format != "png" && (isPicture(options.output) || isFilm(options.output)))
    throw CLI::ValidationError("--format", "is of the pictures in a folder; a file's ending says its own");
  if (options.isGroom && isFilm(options.output))
    throw CLI::ValidationError("--output", "is a film, but IN is a groom, which has no frames");
}

void checkInput(const RenderOptions& options) {
  const bool isFile = isPicture(options.output) || isFilm(options.output);
  if (isSceneFile(options.input) && (isFile || !options.scene.empty() || !options.groom.empty()))
    throw CLI::ValidationError(
        "IN",
        "is a scene, which is simulated into the folder of its pictures: name a folder with -o, and neither "
        "--scene nor --groom");
  if (!options.isGroom && options.up != "Y")
    throw CLI::ValidationError("--up", "is of a groom; animations and scenes say it themselves");
  if (!options.isGroom && options.metresPerUnit)
    throw CLI::ValidationError("--unit", "is of a groom; animations and scenes say it themselves");
  if (!options.isGroom && options.groom.empty() && !options.keys.optionOf("groom").empty())
    throw CLI::ValidationError(options.keys.optionOf("groom"),
                               "is of a groom's file, and none is named here");
  if (!isSceneFile(options.input) && options.scene.empty() && !options.keys.sets.empty())
    throw CLI::ValidationError("--set", "is of a scene, and none is named here");
  if (options.hairs == 0 && !options.keys.optionOf("output").empty())
    throw CLI::ValidationError("--hairs", "0 are no hairs that could have frizz, clumps or blends");
  if (options.isGroom && (!options.frames.empty() || !options.groom.empty() || !options.scene.empty()))
    throw CLI::ValidationError("IN",
                               "is a groom, which has no frames; leave out --frames, --groom and --scene");
  if (!options.scene.empty() && !options.groom.empty())
    throw CLI::ValidationError("--groom", "the scene names its groom; say one of --scene and --groom");
  if (!options.camera.empty() && !isSceneFile(options.input) && options.scene.empty())
    throw CLI::ValidationError("--camera", "is one of a scene's; name the scene with --scene");
}

void checkColours(const RenderOptions& options) {
  const StrandScale* scale = strandScaleNamed(options.colour);
  const bool isError = options.colour == "error";
  if (isError && options.against.empty())
    throw CLI::ValidationError("--colour", "error is the distance from another run; name it with --against");
  if (!isError && !options.against.empty()) throw CLI::ValidationError("--against", "is of --colour error");
  if (scale && options.melanin)
    throw CLI::ValidationError("--melanin",
                               fmt::format("is of hair; leave it out with --colour {}", scale->name));
  if (options.most && !(scale && scale->most > 0))
    throw CLI::ValidationError("--most", "is of --colour stretch, contacts and error");
  if (scale && scale->most > 0 && options.isGroom)
    throw CLI::ValidationError(
        "--colour",
        fmt::format("{} is of hair that has moved; IN is a groom, which is at rest", scale->name));
}

}  // namespace

void checkRenderOptions(const RenderOptions& options) {
  checkOutput(options);
  checkFrames(options);
  checkInput(options);
  checkColours(options);
}

RenderPlan renderPlanOf(const RenderOptions& options) {
  RenderPlan plan;
  plan.target.path = options.output;
  plan.target.isExr = options.format == "exr";
  if (const auto range = parseFrameRange(options.frames))
    plan.firstFrame = range->first, plan.lastFrame = range->last;
  plan.hair = {options.hairs, options.width, hairLookOf(options.keys)};
  const auto size = *parsePair(options.size, 'x');
  plan.size = {size.first, size.second, options.samples};
  if (const StrandScale* scale = strandScaleNamed(options.colour)) {
    plan.colours = {scale, options.most.value_or(scale->most), options.against};
    if (scale->most > 0 && !options.noLegend)
      plan.target.legend = PictureLegend{scale->name, scale->withUnit(plan.colours->most)};
  } else {
    plan.look = *lookByName(options.colour);
  }
  if (options.melanin) {
    // Hairs differ by a fifth of their melanin to either side.
    plan.look.pigments = {absorptionOfMelanin(0.8 * *options.melanin, options.redness),
                          absorptionOfMelanin(std::min(1.2 * *options.melanin, 1.0), options.redness)};
  }
  if (!options.ground.empty()) plan.ground = Ground{heightOf(options.ground)};
  plan.camera.place = {radians(options.azimuth), radians(options.elevation), options.distance};
  plan.camera.orbit = radians(options.orbit);
  plan.moments = options.blur;
  plan.showsSolids = !options.noBodies;
  return plan;
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option(
          "IN", options.input,
          "A folder that simulate wrote, an animation (.rgc, .usdc, .abc, .usda), a scene (.toml) or a groom")
      ->required()
      ->type_name("PATH");
  command
      .add_option("-o,--output", options.output,
                  "Folder for frame.0001.png and so on; one .png or .exr; or a film, .mp4, .webp or .gif")
      ->required()
      ->type_name("PATH");
  command.add_option("--frames", options.frames, "First and last frame, from 1, or one (default: all)")
      ->check(isFrameRange())
      ->type_name("A:B");
  command
      .add_option("--hairs", options.hairs,
                  "Hairs that follow the strands; 0: the strands themselves (default: see below)")
      ->check(wholeBetween(0, 10'000'000))
      ->type_name("N");
  addHairLookOptions(command, options.keys);
  command
      .add_option("--groom", options.groom, "The strands at rest, where IN does not begin so; for --hairs")
      ->type_name("FILE");
  command
      .add_option("--scene", options.scene,
                  "The scene that IN was simulated from: its bodies, and its groom at rest")
      ->type_name("FILE");
  addSetOption(command, options.keys);
  addConfinedOption(command, options.reach);
  command
      .add_option("--width", options.width,
                  "Diameter of hairs at the root, metres (default: by their number)")
      ->check(between(1e-7, 0.1))
      ->type_name("METRES");
  command.add_option("--size", options.size, "Width and height of pictures, pixels")
      ->check(isPair('x', 1, 16384, "960x540"))
      ->capture_default_str()
      ->type_name("WxH");
  addSamplesOption(command, options.samples);
  command.add_option("--format", options.format, "Of the pictures in a folder: png, or exr, in linear light")
      ->check(oneOf({"png", "exr"}))
      ->capture_default_str()
      ->type_name("NAME");
  command
      .add_option("--blur", options.blur,
                  "Moments of each frame that are shown together: motion blur; 1 is none")
      ->check(wholeBetween(1, 64))
      ->capture_default_str()
      ->type_name("N");
  addColourOption(command, options.colour, strandScaleNames());
  command.add_option("--against", options.against, "With --colour error: the run to compare with")
      ->type_name("RUN");
  command
      .add_option("--most", options.most,
                  "What the last colour stands for, a share or metres (default: see below)")
      ->check(between(1e-9, 1e6))
      ->type_name("NUMBER");
  command.add_flag("--no-legend", options.noLegend, "No bar of colours that says what they stand for");
  command.add_option("--melanin", options.melanin, "In place of --colour: from 0, white, to 1, black")
      ->check(between(0, 1))
      ->type_name("SHARE");
  command.add_option("--redness", options.redness, "Share of the melanin that is red")
      ->check(between(0, 1))
      ->capture_default_str()
      ->type_name("SHARE");
  command
      .add_option("--azimuth", options.azimuth,
                  "Camera about the up axis, from the front to the right, degrees")
      ->check(between(-3600, 3600))
      ->capture_default_str()
      ->type_name("DEG");
  command.add_option("--elevation", options.elevation, "Camera above the hair, degrees")
      ->check(between(-89, 89))
      ->capture_default_str()
      ->type_name("DEG");
  command.add_option("--distance", options.distance, "Of the camera, over the one that shows all hair")
      ->check(between(0.05, 100))
      ->capture_default_str()
      ->type_name("FACTOR");
  command
      .add_option("--orbit", options.orbit,
                  "The camera goes round by so much from the first frame to the last, degrees")
      ->check(between(-36000, 36000))
      ->capture_default_str()
      ->type_name("DEG");
  auto* camera =
      command
          .add_option("--camera", options.camera,
                      "One of the scene: of its [[camera]] tables, or of the glTF file of its motion")
          ->type_name("NAME");
  for (const char* other : {"--azimuth", "--elevation", "--distance", "--orbit"}) camera->excludes(other);
  command
      .add_option("--unit", options.metresPerUnit,
                  "Of a groom: metres per unit of its file (default: what the file states, else 0.01)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command.add_option("--up", options.up, "Of a groom: the axis that points up, Y or Z")
      ->check(oneOf({"Y", "Z"}))
      ->capture_default_str()
      ->type_name("AXIS");
  addOptionsOfKeys(command, options.keys, {"groom.root_end", "groom.points_per_strand"});
  command.add_flag("--no-bodies", options.noBodies, "Hair alone: no bodies and no head");
  command
      .add_flag("--ground", options.ground,
                "A ground under everything that is shown; --ground=0.1: at that height, metres")
      ->check(CLI::Validator(
          [](std::string& text) {
            return text == kFlagged || heightOf(text)
                       ? std::string()
                       : fmt::format("must be a height in metres, as --ground=0.1, not '{}'", text);
          },
          ""));
  addDeviceOption(command, options.device);
  command.add_flag("--json", options.json, "Print one JSON object instead of the summary");
  command.add_flag("--quiet", options.quiet, "No progress bar and no summary");
}

}  // namespace ringlet::program
