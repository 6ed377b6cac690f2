// Implements convert_command.h: options to a ConvertPlan. The conversion is convert_run.cpp.
#include "program/convert/convert_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "program/cli/command_line.h"
#include "program/cli/confined_option.h"
#include "program/cli/exit_codes.h"
#include "program/cli/frame_range.h"
#include "program/cli/key_options.h"
#include "program/cli/keys_help.h"
#include "program/cli/standard_output.h"
#include "program/cli/written_groom.h"
#include "program/convert/convert_report.h"
#include "program/convert/convert_run.h"
#include "program/simulate/reference_mover.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/motion/point_cache.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/output/precision_names.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {
namespace {

constexpr const char* kConvertExample =
    "Examples:\n"
    "  ringlet convert out/hair.rgc hair.usda                    the same text as simulate writes\n"
    "  ringlet convert out/hair.rgc small.rgc --precision 16bit\n"
    "  ringlet convert out/hair.usda hair.rgc\n"
    "  ringlet convert out/hair.rgc hair.usdc                    USD in a third of the bytes, any frame at "
    "once\n"
    "  ringlet convert out/hair.rgc hair.abc                     Alembic\n"
    "  ringlet convert out/hair.rgc frames/ --frames 1:24        frames/hair.0001.obj to hair.0024.obj\n"
    "  ringlet convert out/hair.rgc pose.obj --frame 12\n"
    "  ringlet convert out/hair.rgc frames.ply                   frames.0001.ply and so on\n"
    "  ringlet convert out/hair.rgc hair.usda --clips 100        in parts of 100 frames, hair_clips/\n"
    "  ringlet convert out/hair.rgc hair.pc2                     and hair.obj, for Blender 3\n"
    "  ringlet convert out/hair.rgc sheet.png\n"
    "  ringlet convert out/hair.rgc full.usdc --hairs 20000 --groom groom.obj\n"
    "  ringlet convert out/hair.rgc.partial --info               of a run that was cut short, or goes on\n"
    "  ringlet convert groom.usdc groom.hair                     a groom; .hair, .obj, .ply, .abc, .usda or .usdc\n"
    "  ringlet convert groom.hair groom.usdc --unit 1            and to USD, in metres\n"
    "  ringlet convert houdini.usdc hair.abc                     another program's curves that move\n"
    "  ringlet convert frames/hair.####.obj hair.usdc --rate 30  a file a frame\n"
    "  ringlet convert cache.pc2 hair.usdc --groom groom.obj     a point cache over a groom\n"
    "\n"
    "OUT's ending says what becomes of it. .usda, .usdc, .abc, .rgc and .png count frames from 1 again; the names "
    "of .obj\n"
    "files keep the animation's numbers. Damaged frames are refused, whole ones beside them can be had with\n"
    "--frames. A file that was not finished is read as far as it goes, and a warning says so.\n"
    "\n";
constexpr const char* kConvertExitHelp =
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage.";

// The command line as typed.
struct TypedConvert {
  std::filesystem::path input, output;
  SceneReach reach = SceneReach::anywhere;
  std::string frames;
  std::optional<int> frame;
  std::string precision;
  std::vector<std::string> values;
  std::optional<int> clips;
  std::optional<double> tipWidth;
  std::optional<int> hairs;
  TypedKeys keys;
  std::optional<std::string> up;
  std::optional<double> metresPerUnit;
  std::filesystem::path groom, scene;
  std::optional<double> framesPerSecond;
  bool info = false, json = false, quiet = false, overwrite = false;
};

bool has(const TypedConvert& typed, const char* value) {
  return std::ranges::find(typed.values, value) != typed.values.end();
}

// ".usda, .usdc, .rgc, .pc2", with notes or without.
std::string animationList(bool withNotes) {
  std::string list;
  for (const AnimationFormat& format : animationFormats()) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", format.extension);
    if (withNotes && *format.note) list += fmt::format(" ({})", format.note);
  }
  return list;
}

// By the ending of its name; nothing where that says nothing.
std::optional<ConvertTo> kindOf(const TypedConvert& typed) {
  const std::string extension = typed.output.extension().string();
  if (animationFormatOf(typed.output)) return ConvertTo::animation;
  if (extension == ".png") return ConvertTo::sheet;
  if (isFrameFile(typed.output)) return typed.frame ? ConvertTo::frame : ConvertTo::frameSequence;
  std::error_code code;
  if (extension.empty() || std::filesystem::is_directory(typed.output, code)) return ConvertTo::frameSequence;
  return std::nullopt;
}

// The scene that IN was simulated from, where it is named.
Result<std::optional<LoadedScene>> sceneOf(const TypedConvert& typed) {
  if (typed.scene.empty()) return std::optional<LoadedScene>();
  const auto file = readTypedScene(typed.scene, typed.keys, typed.reach);
  if (!file) return file.error();
  auto scene = loadScene(*file);
  if (!scene) return scene.error();
  return std::optional(std::move(*scene));
}

// Hair that follows the strands of IN, where it is asked for.
Result<std::optional<FullHair>> fullHairOf(const TypedConvert& typed, const Groom& rest, double metresPerUnit,
                                           const CutList& cuts = {}) {
  if (!typed.hairs) return std::optional<FullHair>();
  const HairLook look = hairLookOf(typed.keys);
  const auto ground = hairGroundOf(look, metresPerUnit);
  if (!ground) return ground.error();
  auto hair = FullHair::make(rest, metresPerUnit, look.of({.hairCount = *typed.hairs}), followByReference(),
                             {}, *ground, cuts);
  if (!hair) return hair.error();
  return std::optional(std::move(*hair));
}

// The same, of an animation; or the groom's own hairs, where IN has only the guides of the scene.
Result<std::optional<FullHair>> fullHairOf(const TypedConvert& typed, const AnimationReader& source,
                                           const CutList& cuts, const std::optional<LoadedScene>& scene) {
  const bool isOfGuides = scene && scene->level && source.groom().firstPoint == scene->groom.firstPoint;
  if (scene && !typed.hairs && !isOfGuides)
    return Error{fmt::format(
        "the scene {} is needed for --hairs, or where IN has the guides of its groom; IN has {} strands, its "
        "{} {}",
        typed.scene.string(), source.groom().strandCount(), scene->level ? "guides are" : "groom has",
        scene->groom.strandCount())};
  if (!typed.hairs && !isOfGuides) return std::optional<FullHair>();
  if (scene)
    return FullHair::ofScene(*scene, typed.hairs.value_or(0), hairLookOf(typed.keys), followByReference(),
                             cuts);
  const double metresPerUnit = source.header().metresPerUnit;
  const auto rest = readGroom(typed.groom, readingOf(typed.keys));
  if (!rest) return rest.error();
  return fullHairOf(typed, rest->groom, metresPerUnit, cuts);
}

// Throws CLI11's error for what makes no sense together.
void checkOptions(const TypedConvert& typed) {
  if (typed.output.empty() && !typed.info)
    throw CLI::ValidationError("OUT", "name the file to write, or say --info");
  if (typed.info && (!typed.output.empty() || typed.frame || !typed.frames.empty() ||
                     !typed.precision.empty() || typed.hairs))
    throw CLI::ValidationError("--info", "only says what is in IN; leave out OUT and what OUT is to be");
  if (typed.hairs && typed.groom.empty() && typed.scene.empty())
    throw CLI::ValidationError(
        "--hairs", "name with --groom the groom that IN was simulated from, or with --scene the scene");
  if (!typed.groom.empty() && !typed.scene.empty())
    throw CLI::ValidationError("--groom", "the scene names its groom; say one of --scene and --groom");
  if (!typed.hairs && !typed.keys.optionOf("output").empty())
    throw CLI::ValidationError("--hairs", "only such hairs have frizz, clumps and blends; say how many");
  if (!typed.hairs && !typed.groom.empty() && !isPointCache(typed.input))
    throw CLI::ValidationError("--groom", "only --hairs and a point cache need it");
  if (typed.scene.empty() && !typed.keys.sets.empty())
    throw CLI::ValidationError("--set", "is of a scene, and none is named here");
  if (typed.frame && !typed.frames.empty())
    throw CLI::ValidationError("--frame", "is one frame, --frames several; say one of them");
  if (typed.info) return;
  const auto kind = kindOf(typed);
  if (!kind)
    throw CLI::ValidationError(
        "OUT", fmt::format("'{}' must end in {}, .obj, .ply, .hair or .png, or be a folder for .obj files",
                           typed.output.string(), animationList(false)));
  const AnimationFormat* format = animationFormatOf(typed.output);
  if (!typed.precision.empty() && !(format && format->hasPrecisions))
    throw CLI::ValidationError("--precision", "only a cache, .rgc, has one");
  const std::string extension = typed.output.extension().string();
  if (typed.clips && extension != ".usda") throw CLI::ValidationError("--clips", "only a .usda has clips");
  if ((!typed.values.empty() || typed.tipWidth) && !(format && format->hasValues))
    throw CLI::ValidationError(typed.tipWidth ? "--tip-width" : "--usd-values",
                               "only " + animationEndings(&AnimationFormat::hasValues, "and") + " have it");
  if (has(typed, "velocities") && extension == ".usda" && !typed.clips)
    throw CLI::ValidationError("--usd-values", "velocities are written into .usdc, .abc and clips only");
}

// The same where IN is a groom.
void checkGroomOptions(const TypedConvert& typed) {
  if (typed.frame || !typed.frames.empty() || !typed.precision.empty() || typed.clips)
    throw CLI::ValidationError("IN", "a groom has no frames, no clips and no precision");
  if (!typed.info && typed.output.empty())
    throw CLI::ValidationError("OUT", "name the file to write, " + writtenGroomEndings("or"));
  if (!typed.groom.empty() || !typed.scene.empty())
    throw CLI::ValidationError(typed.groom.empty() ? "--scene" : "--groom",
                               "IN is a groom itself; only the hairs of an animation need one");
  if (typed.tipWidth)
    throw CLI::ValidationError("--tip-width", "only an animation has it; a groom's widths are its file's");
  if (has(typed, "velocities"))
    throw CLI::ValidationError("--usd-values", "a groom rests and has no velocities");
  const WrittenGroomFormat* format = writtenGroomFormatOf(typed.output);
  if (!typed.values.empty() && format && !format->isStating)
    throw CLI::ValidationError("--usd-values", "only USD and Alembic have it");
}

UsdExtras usdExtras(const TypedConvert& typed, double metresPerUnit) {
  UsdExtras extras{.ids = has(typed, "id"),
                   .velocities = has(typed, "velocities"),
                   .unreal = has(typed, "unreal"),
                   .clipFrames = typed.clips.value_or(0)};
  if (typed.tipWidth) extras.tipDiameter = static_cast<float>(*typed.tipWidth / metresPerUnit);
  return extras;
}

// Which frames, checked against those there are.
Result<FrameRange> chooseFrames(const TypedConvert& typed, const AnimationReader& source) {
  const int count = source.frameCount();
  if (count == 0) return Error{fmt::format("{} holds no frame", typed.input.string())};
  FrameRange range{1, count};
  if (typed.frame) range = {*typed.frame, *typed.frame};
  if (!typed.frames.empty()) range = *parseFrameRange(typed.frames);
  if (range.last > count)
    return Error{
        fmt::format("{} has frames 1 to {}; there is no frame {}", typed.input.string(), count, range.last)};
  return range;
}

// A writer begins with PATH.partial; that must not be what is read.
Status checkOutput(const TypedConvert& typed) {
  std::error_code code;
  for (const char* suffix : {"", ".partial"}) {
    const std::filesystem::path taken = typed.output.string() + suffix;
    if (std::filesystem::equivalent(taken, typed.input, code))
      return Error{fmt::format("writing {} would overwrite {} while it is read; choose another name",
                               typed.output.string(), typed.input.string())};
  }
  const std::filesystem::path partial = typed.output.string() + ".partial";
  if (!typed.overwrite && std::filesystem::exists(partial, code)) {
    return Error{
        fmt::format(
            "{} holds frames that something left which did not end; choose another name, or begin anew with "
            "--overwrite",
            partial.string()),
        Fault::output};
  }
  return {};
}

void printReport(const TypedConvert& typed, const ConvertReport& report) {
  if (typed.json)
    printJson(convertJson(report));
  else if (!typed.quiet)
    print("{}", convertText(report));
}

// A groom is one pose: another program's, made into what Ringlet writes.
Status runGroomConvert(const TypedConvert& typed) {
  if (typed.info)
    return Error{fmt::format("{} is a groom; `ringlet info` says what is in it", typed.input.string())};
  GroomReading reading = readingOf(typed.keys, typed.up == "Z");
  const WrittenGroomFormat* format = writtenGroomFormatOf(typed.output);
  reading.keepsPrims = !typed.hairs && format && format->isStating;
  auto loaded = readGroom(typed.input, reading);
  if (!loaded) return loaded.error();
  if (typed.metresPerUnit) loaded->groom.metresPerUnit = *typed.metresPerUnit;
  for (const std::string& warning : loaded->warnings) say("ringlet convert: warning: {}\n", warning);
  const auto hair = fullHairOf(typed, loaded->groom, loaded->groom.metresPerUnit);
  if (!hair) return hair.error();
  const Groom& groom = *hair ? (*hair)->groom() : loaded->groom;
  GroomWriting writing{.up = upOf(typed.up, *loaded), .usd = usdExtras(typed, groom.metresPerUnit)};
  if (*hair) {
    writing.usd.closestGuides = (*hair)->closestGuides();
  } else {
    writing.usd.origin = &*loaded;
    writing.usd.originValues = true;
  }
  if (Status written = writeGroom(typed.output, groom, writing); !written) return written;
  for (std::string& lost : lostIn(typed.output, loaded->groom.metresPerUnit, typed.up == "Z")) {
    say("ringlet convert: warning: {}\n", lost);
    loaded->warnings.push_back(std::move(lost));
  }
  std::error_code code;
  printReport(typed, {.groom = groom,
                      .outputs = {typed.output},
                      .byteCount = std::filesystem::file_size(typed.output, code),
                      .warnings = std::move(loaded->warnings)});
  return {};
}

// What files of frames do not hold of an animation.
std::vector<std::string> lostOf(const TypedConvert& typed, const CacheHeader& header) {
  const ConvertTo kind = *kindOf(typed);
  if (kind != ConvertTo::frame && kind != ConvertTo::frameSequence) return {};
  return lostIn(typed.output, header.metresPerUnit, header.up == UpAxis::z);
}

// What was typed of a file that another program wrote.
ForeignReading foreignReadingOf(const TypedConvert& typed) {
  const GroomReading groom = readingOf(typed.keys);
  ForeignReading reading{.metresPerUnit = typed.metresPerUnit,
                         .rootEnd = groom.rootEnd,
                         .pointsPerStrand = groom.pointsPerStrand,
                         .groom = typed.groom};
  if (typed.up) reading.upIsZ = *typed.up == "Z";
  if (typed.framesPerSecond) reading.framesPerSecond = *typed.framesPerSecond;
  return reading;
}

Status runConvert(const TypedConvert& typed) {
  auto source = AnimationReader::open(typed.input, foreignReadingOf(typed));
  if (!source) return source.error();
  for (const std::string& warning : source->warnings()) say("ringlet convert: warning: {}\n", warning);
  if (typed.info) {
    typed.json ? printJson(animationJson(*source)) : print("{}", animationText(typed.input, *source));
    return {};
  }
  if (!source->isFinished())
    say("ringlet convert: warning: {} was not finished; it has {} frames\n", typed.input.string(),
        source->frameCount());
  auto range = chooseFrames(typed, *source);
  if (!range) return range.error();
  if (Status free = checkOutput(typed); !free) return free;
  const auto scene = sceneOf(typed);
  if (!scene) return scene.error();
  const auto cuts = CutList::beside(typed.input);
  if (!cuts) return cuts.error();
  auto hair = fullHairOf(typed, *source, *cuts, *scene);
  if (!hair) return hair.error();
  UsdExtras extras = usdExtras(typed, source->header().metresPerUnit);
  if (*hair) extras.closestGuides = (*hair)->closestGuides();
  const auto outcome = convert(
      *source,
      {.to = *kindOf(typed),
       .output = typed.output,
       .firstFrame = range->first,
       .lastFrame = range->last,
       .precision = typed.precision.empty() ? source->header().precision : precisionByName(typed.precision),
       .usd = std::move(extras),
       .hair = *hair ? &**hair : nullptr,
       .scene = *scene ? &**scene : nullptr,
       .cuts = *hair ? (*hair)->cutsOfHairs(*cuts) : *cuts,
       .showProgress = !typed.quiet});
  if (!outcome) return outcome.error();
  const Groom& written = *hair ? (*hair)->groom() : source->groom();
  std::vector<std::string> warnings = source->warnings();
  for (std::string& lost : lostOf(typed, source->header())) {
    say("ringlet convert: warning: {}\n", lost);
    warnings.push_back(std::move(lost));
  }
  printReport(typed, {.groom = written,
                      .outputs = outcome->outputs,
                      .byteCount = outcome->byteCount,
                      .warnings = std::move(warnings),
                      .frameCount = range->last - range->first + 1,
                      .errorBound = outcome->errorBound});
  return {};
}

int run(const TypedConvert& typed) {
  const bool isGroom = isGroomFile(typed.input) && !holdsAnimation(typed.input);
  const bool isOfStrands =
      typed.up || typed.metresPerUnit || (!typed.keys.optionOf("groom").empty() && typed.groom.empty());
  if (!isGroom && isOfStrands && !holdsForeignFrames(typed.input))
    throw CLI::ValidationError(
        "IN",
        "is an animation of Ringlet's, which says its unit and axis itself; --unit, --up, --root-end and "
        "--points-per-strand are of grooms and of other programs' animations");
  if (typed.framesPerSecond && !isSequence(typed.input) && !isPointCache(typed.input))
    throw CLI::ValidationError("--rate", "only a sequence of files and a point cache do not say it");
  isGroom ? checkGroomOptions(typed) : checkOptions(typed);
  const Status done = isGroom ? runGroomConvert(typed) : runConvert(typed);
  if (done) return kExitFine;
  return fail("convert", done.error());
}

}  // namespace

void addConvertCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedConvert>();
  CLI::App* command =
      app.add_subcommand("convert", "Makes another file of an animation, or says what is in it");
  command->footer(kConvertExample + keysHelp(convertKeys()) +
                  keysHelp(animationKeys(), "--json keys with --info:") + kConvertExitHelp);
  command
      ->add_option(
          "IN", typed->input,
          "An animation: hair.usda, hair.usdc, hair.abc or hair.rgc, or their .partial; of another program "
          ".usda, .usdc, .usd, .usdz, .abc, .pc2, .mdd or hair.####.obj; or a groom")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "OUT", typed->output,
          fmt::format(
              "File to write: {}, .png (six frames side by side), .obj, .ply or .hair (name.0001.obj and so on); or "
              "a folder for .obj files",
              animationList(true)))
      ->type_name("PATH");
  command->add_option("--frames", typed->frames, "First and last frame, from 1, or one (default: all)")
      ->check(isFrameRange())
      ->type_name("A:B");
  command->add_option("--frame", typed->frame, "One frame, from 1; an .obj then has the name of OUT")
      ->check(wholeBetween(1, 1'000'000'000))
      ->type_name("N");
  command
      ->add_option("--precision", typed->precision,
                   "Of an .rgc: float32 (every bit) or 16bit (default: that of IN; of USD float32)")
      ->check(oneOf(precisionNames()))
      ->type_name("PRECISION");
  command
      ->add_option(
          "--usd-values", typed->values,
          "What .usda, .usdc and .abc have beside points and widths, separated by commas: id (a number of each "
          "strand), velocities (.usdc, .abc and clips only), unreal (what Unreal reads of a groom)")
      ->delimiter(',')
      ->check(oneOf({"id", "velocities", "unreal"}))
      ->type_name("LIST");
  command
      ->add_option(
          "--tip-width", typed->tipWidth,
          "Diameter at the tip in .usda, .usdc and .abc, metres: strands are evenly thinner from the root on")
      ->check(between(1e-9, 1))
      ->type_name("METRES");
  command
      ->add_option(
          "--clips", typed->clips,
          "Frames of a value clip: OUT.usda is then a small file beside OUT_clips/, which has them in parts")
      ->check(wholeBetween(1, 1'000'000))
      ->type_name("N");
  command
      ->add_option(
          "--hairs", typed->hairs,
          "Hairs to write in place of the strands of IN, which they follow: about as many strands are what "
          "one sees as locks")
      ->check(wholeBetween(1, 10'000'000))
      ->type_name("N");
  addHairLookOptions(*command, typed->keys);
  command
      ->add_option("--rate", typed->framesPerSecond,
                   "Of a sequence of files and of a point cache: frames a second (default 24)")
      ->check(between(1e-3, 1e6))
      ->type_name("RATE");
  command
      ->add_option(
          "--unit", typed->metresPerUnit,
          "Of a groom and of another program's animation: metres per unit of its file (default: what the "
          "file states, else 0.01)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command
      ->add_option(
          "--up", typed->up,
          "Of a groom and of another program's animation: the axis that is to point up, to which a file that "
          "states another is turned, Y or Z (default: of an animation the file's, else Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS");
  addOptionsOfKeys(*command, typed->keys, {"groom.root_end", "groom.points_per_strand"});
  command
      ->add_option("--groom", typed->groom,
                   "The groom that IN was simulated from, for --hairs; or whose points a point cache moves")
      ->type_name("FILE");
  command
      ->add_option("--scene", typed->scene,
                   "The scene that IN was simulated from: its groom, and its bodies, which hairs stay out of")
      ->type_name("FILE");
  addSetOption(*command, typed->keys);
  addConfinedOption(*command, typed->reach);
  command->add_flag("--overwrite", typed->overwrite,
                    "Begin anew where OUT.partial holds frames of something that did not end");
  command->add_flag("--info", typed->info, "Say what is in IN, and write nothing");
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary");
  command->add_flag("--quiet", typed->quiet, "No progress bar and no summary");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
