// Implements measure_command.h: reads a groom and what became of it. The measuring is src/ringlet/measure,
// the telling measure_report.h.
#include "program/measure_command.h"
#include "program/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "program/command_line.h"
#include "program/exit_codes.h"
#include "program/measure_plot.h"
#include "program/measure_report.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/contact_quality.h"
#include "ringlet/measure/shape_distance.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet::program {
namespace {

constexpr const char* kExample =
    "Examples:\n"
    "  ringlet measure groom.obj                     the curls of a groom\n"
    "  ringlet measure groom.obj settled.obj         what is left of them in another pose\n"
    "  ringlet measure groom.obj out --json          and in what `ringlet simulate` wrote\n"
    "  ringlet measure groom.obj out --against settled.obj\n"
    "                                                and how far that is from one more pose\n"
    "  ringlet measure groom.obj out --plot out.svg --over softer --over stiffer\n"
    "                                                three motions of it over each other\n"
    "\n"
    "A USD file (.usda, .usdc, .usd, .usdz) states its unit and its up axis; --unit and --up go before "
    "them.\n"
    "OTHER is a groom with the same strands, a folder that `ringlet simulate` wrote, or its hair.usda or\n"
    "hair.rgc.\n"
    "A hair.usda may be the groom as well: its first frame is.\n"
    "In an animation the groom counts as the frame before the first; tables show the last frame.\n"
    "Everything is seen from the head: each strand from its root, turned as the roots together turn (one\n"
    "root, or roots on a line, cannot show every turn; the head then turns as little as they allow).\n"
    "Bounce (of the core's length), sway and settling are those after the head last drove the hair.\n"
    "--against compares that pose, or the last frame, with one more pose, in REST's unit. With their roots\n"
    "put together it says how far particles and cores (root mean square) and tips are apart, the angle\n"
    "between the cores' chords, and by how much turns and mean radius are more.\n"
    "--plot draws over time, of OTHER and of each --over: mean droop, core elongation and turns, kinetic\n"
    "energy of hair of 10 mg/m, and how far hairs are in each other beyond rest, the deepest and the mean,\n"
    "as shares of their reach (1: two centres in one place); hairs are as thick as contacts have them\n"
    "unasked. It needs gnuplot.\n"
    "\n"
    "--json keys: strands particles frames; over strands of the last frame, means: droop_mm\n"
    "core_elongation, and of the curled: turns mean_radius_mm; handedness_kept: by all;\n"
    "tip_rotation_deg: the largest; over all frames, the largest: arc_drift max_edge_stretch worst\n"
    "{droop_mm core_elongation tip_rotation_deg}; of the motion: bounce_hz sway_hz (means) settle_s (the\n"
    "last to settle) energy_ratio (last second over peak); spread {KEY: [mean, min, max]} of the last\n"
    "frame; against {KEY: [mean, min, max]} with --against: particles tip core (shares of the arc length)\n"
    "direction_deg turns radius (shares of those at rest); per_strand with --strands; series with --plot:\n"
    "seconds droop_mm core_elongation turns energy_uj deepest_contact mean_contact, a number a frame. null: "
    "nothing to\n"
    "measure; so are limited_share and velocity_residual, which only a run knows (`ringlet simulate "
    "--json`,\n"
    "`ringlet scene --json`).\n"
    "\n"
    "Exit status: 0 done, 1 something failed, 2 wrong usage.";

// The command line as typed.
struct Typed {
  std::filesystem::path rest, other, against, plot;
  std::vector<std::filesystem::path> over;
  std::optional<double> metresPerUnit;
  std::optional<std::string> up;
  bool json = false, strands = false;
};

void warn(const std::string& sentence) { say("ringlet measure: warning: {}\n", sentence); }

// A groom with its up axis where `upIsZ` says, in its file's unit or the one typed, and in no other than
// `unit` where that is known.
Result<Groom> read(const std::filesystem::path& path, const Typed& typed, bool upIsZ,
                   std::optional<double> unit = {}) {
  auto loaded = readGroom(path, {.upIsZ = upIsZ});
  if (!loaded) return loaded.error();
  for (const std::string& warning : loaded->warnings) warn(warning);
  Groom& groom = loaded->groom;
  if (typed.metresPerUnit) groom.metresPerUnit = *typed.metresPerUnit;
  if (!unit || groom.metresPerUnit == *unit) return std::move(groom);
  if (loaded->statesUnit && !typed.metresPerUnit) {
    warn(fmt::format("{} is in units of {} m, and measured in {} m", path.string(), groom.metresPerUnit,
                     *unit));
    for (Vec3f& p : groom.points) p = Vec3f(Vec3d(p) * (groom.metresPerUnit / *unit));
  }
  groom.metresPerUnit = *unit;
  return std::move(groom);
}

// Whether the file `path` holds the same strands as REST, particle for particle.
Status checkSameStrands(const Groom& rest, const std::vector<std::uint32_t>& counts, const Typed& typed,
                        const std::filesystem::path& path) {
  const std::string files = fmt::format("{} and {}", typed.rest.string(), path.string());
  if (counts.size() != rest.strandCount()) {
    return Error{fmt::format("{} hold {} and {} strands; only the same strands can be compared", files,
                             rest.strandCount(), counts.size())};
  }
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] == rest.strand(s).size()) continue;
    return Error{
        fmt::format("strand {} has {} particles in {} and {} in {}; only the same strands can be compared", s,
                    rest.strand(s).size(), typed.rest.string(), counts[s], path.string())};
  }
  return {};
}

std::vector<std::uint32_t> countsOf(const Groom& groom) {
  std::vector<std::uint32_t> counts;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    counts.push_back(groom.firstPoint[s + 1] - groom.firstPoint[s]);
  return counts;
}

// Another pose of REST's strands.
Result<Groom> readPose(const Groom& rest, const Typed& typed, bool upIsZ, const std::filesystem::path& path) {
  auto pose = read(path, typed, upIsZ, rest.metresPerUnit);
  if (!pose) return pose.error();
  if (Status same = checkSameStrands(rest, countsOf(*pose), typed, path); !same) return same.error();
  return pose;
}

// How far `points`, in REST's unit, are from the pose of --against, if there is one.
Result<std::vector<ShapeDistance>> measureAgainst(const GroomRuler& ruler, const Groom& rest,
                                                  std::span<const Vec3f> points, const Typed& typed,
                                                  bool upIsZ) {
  if (typed.against.empty()) return std::vector<ShapeDistance>{};
  auto pose = readPose(rest, typed, upIsZ, typed.against);
  if (!pose) return pose.error();
  auto distances = shapeDistances(ruler, points, pose->points, rest.metresPerUnit);
  if (!distances) return Error{fmt::format("{}: {}", typed.against.string(), distances.error().message)};
  return distances;
}

bool isUpZ(const Typed& typed, UpAxis otherwise) {
  return typed.up ? *typed.up == "Z" : otherwise == UpAxis::z;
}
Vec3d upOf(bool isZ) { return isZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }

Result<Measured> measureGroom(const Typed& typed, const std::filesystem::path& otherPath) {
  const bool upIsZ = isUpZ(typed, UpAxis::y);
  auto rest = read(typed.rest, typed, upIsZ);
  if (!rest) return rest.error();
  const double unit = rest->metresPerUnit;
  auto ruler = GroomRuler::make(*rest);
  if (!ruler) return Error{fmt::format("{}: {}", typed.rest.string(), ruler.error().message)};
  std::vector<StrandMeasure> strands = ruler->rest();

  // The same strands elsewhere.
  std::vector<Vec3f> points = rest->points;
  if (!otherPath.empty()) {
    auto other = readPose(*rest, typed, upIsZ, otherPath);
    if (!other) return other.error();
    auto measured =
        ruler->measure(other->points, unit, upOf(upIsZ), ruler->headRotationOf(other->points, unit));
    if (!measured) return Error{fmt::format("{}: {}", otherPath.string(), measured.error().message)};
    strands = std::move(*measured);
    points = std::move(other->points);
  }
  auto distances = measureAgainst(*ruler, *rest, points, typed, upIsZ);
  if (!distances) return distances.error();

  const CurlNumbers numbers = curlNumbers(*ruler, strands);
  Measured measured{.ruler = std::move(*ruler),
                    .strands = std::move(strands),
                    .motions = {},
                    .distances = std::move(*distances),
                    .against = typed.against.string(),
                    .numbers = numbers};
  measured.isPose = !otherPath.empty();
  return measured;
}

std::vector<Vec3f> inMetres(std::span<const Vec3f> points, double metresPerUnit) {
  std::vector<Vec3f> metres;
  for (const Vec3f& p : points) metres.push_back(Vec3f(Vec3d(p) * metresPerUnit));
  return metres;
}

Result<Measured> measureAnimation(const Typed& typed, const std::filesystem::path& path) {
  auto source = AnimationReader::open(path);
  if (!source) return source.error();
  for (const std::string& warning : source->warnings()) warn(warning);
  const double unit = source->header().metresPerUnit;
  if (typed.metresPerUnit && std::abs(*typed.metresPerUnit / unit - 1) > 1e-9) {
    return Error{fmt::format("--unit {} does not fit {}, which was written in units of {} m; leave it out",
                             *typed.metresPerUnit, path.string(), unit)};
  }
  const bool upIsZ = isUpZ(typed, source->header().up);
  auto rest = read(typed.rest, typed, upIsZ, unit);
  if (!rest) return rest.error();
  if (Status same = checkSameStrands(*rest, countsOf(source->groom()), typed, path); !same)
    return same.error();

  // Frame by frame, from the groom itself on.
  auto motion =
      MotionMeasure::make(*rest, {.framesPerSecond = source->header().framesPerSecond, .up = upOf(upIsZ)});
  if (!motion) return Error{fmt::format("{}: {}", typed.rest.string(), motion.error().message)};
  std::optional<ContactRuler> contactRuler;
  if (!typed.plot.empty()) {
    auto made = ContactRuler::make(*rest, {}, {});
    if (!made) return Error{fmt::format("{}: {}", typed.rest.string(), made.error().message)};
    contactRuler.emplace(std::move(*made));
  }
  std::vector<ContactQuality> contacts;
  if (source->frameCount() == 0) return Error{fmt::format("{} holds no frame", path.string())};
  for (int frame = 0; frame <= source->frameCount(); ++frame) {
    if (frame > 0) {
      if (Status read = source->readFrame(frame); !read) return read.error();
    }
    const auto& points = frame == 0 ? rest->points : source->groom().points;
    if (Status added = motion->addFrame(points, unit); !added)
      return Error{fmt::format("{}: frame {}: {}", path.string(), frame, added.error().message)};
    if (contactRuler) contacts.push_back(contactRuler->measure(inMetres(points, unit)));
  }

  auto distances = measureAgainst(motion->ruler(), *rest, source->groom().points, typed, upIsZ);
  if (!distances) return distances.error();

  MotionReport report = motion->report();
  Measured measured{.ruler = motion->ruler(),
                    .strands = {},
                    .motions = {},
                    .distances = std::move(*distances),
                    .against = typed.against.string(),
                    .numbers = {}};
  measured.numbers = curlNumbers(motion->ruler(), report);
  --measured.numbers.frameCount;  // the groom itself is none of the file's
  for (const StrandMotion& strand : report.strands) measured.strands.push_back(strand.last);
  measured.motions = std::move(report.strands);
  if (contactRuler) {
    measured.series = MotionSeries{.name = path.string(),
                                   .framesPerSecond = source->header().framesPerSecond,
                                   .frames = std::move(report.frames),
                                   .contacts = std::move(contacts)};
  }
  measured.seconds = report.seconds;
  measured.freeSeconds = report.freeSeconds;
  measured.isPose = true;
  measured.isUnfinished = !source->isFinished();
  return measured;
}

// What `ringlet simulate` wrote into a folder, a finished file rather than one that is not; or nothing.
std::filesystem::path animationIn(const std::filesystem::path& folder) {
  std::error_code code;
  for (const char* suffix : {"", ".partial"}) {
    for (const AnimationFormat& format : animationFormats()) {
      const std::filesystem::path path = folder / fmt::format("hair{}{}", format.extension, suffix);
      if (std::filesystem::exists(path, code)) return path;
    }
  }
  return {};
}

// What became of REST: a folder stands for the animation in it.
Result<Measured> measure(const Typed& typed, const std::filesystem::path& other) {
  namespace fs = std::filesystem;
  fs::path path = other;
  std::error_code code;
  if (fs::is_directory(typed.rest, code) || (isAnimation(typed.rest) && !isGroomFile(typed.rest))) {
    return Error{
        fmt::format("{} is what became of a groom, which it does not hold; name the groom first, as in "
                    "`ringlet measure groom.obj {}`",
                    typed.rest.string(), typed.rest.string())};
  }
  if (fs::is_directory(path, code)) {
    path = animationIn(other);
    if (path.empty())
      return Error{
          fmt::format("{} holds no hair.usda, hair.usdc or hair.rgc; is it a folder that `ringlet simulate` "
                      "wrote?",
                      other.string())};
  }
  return holdsAnimation(path) ? measureAnimation(typed, path) : measureGroom(typed, path);
}

Status plot(const Typed& typed, const Measured& measured) {
  if (typed.plot.empty()) return {};
  std::vector<MotionSeries> runs;
  const auto add = [&](const Measured& run, const std::filesystem::path& path) -> Status {
    if (!run.series)
      return Error{fmt::format("--plot draws what changes over time, and {} is one pose; name a folder that "
                               "`ringlet simulate` wrote, or its animation",
                               path.empty() ? "a groom alone" : path.string()),
                   Fault::input};
    runs.push_back(*run.series);
    runs.back().name = path.string();
    return {};
  };
  if (Status added = add(measured, typed.other); !added) return added;
  for (const std::filesystem::path& path : typed.over) {
    auto more = measure(typed, path);
    if (!more) return more.error();
    if (Status added = add(*more, path); !added) return added;
  }
  return drawPlot(typed.plot, runs);
}

int run(const Typed& typed) {
  auto measured = measure(typed, typed.other);
  if (!measured) {
    say("ringlet measure: {}\n", measured.error().message);
    return exitCodeOf(measured.error());
  }
  if (Status drawn = plot(typed, *measured); !drawn) {
    say("ringlet measure: {}\n", drawn.error().message);
    return exitCodeOf(drawn.error());
  }
  if (measured->isUnfinished) warn("the animation was not finished; its frames so far were measured");
  if (typed.json) {
    fmt::print("{}\n", measuredJson(*measured, typed.strands).dump(2));
  } else {
    fmt::print("{}{}", measuredText(*measured), typed.strands ? strandsText(*measured) : "");
  }
  return kExitFine;
}

}  // namespace

void addMeasureCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<Typed>();
  CLI::App* command = app.add_subcommand("measure", "Measures the curl of a groom, and what became of it");
  command->footer(kExample);
  command
      ->add_option("REST", typed->rest,
                   "The groom at rest: a .hair, .obj, .usd, .tfx, .ply, .data or .bin file")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("OTHER", typed->other,
                   "What became of it: a pose (a groom's file), a folder, a hair.usda or hair.rgc")
      ->type_name("PATH");
  command
      ->add_option(
          "--unit", typed->metresPerUnit,
          "Metres per unit of the files (default: the animation's, else what a USD file states, else 0.01: "
          "centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command->add_option("--up", typed->up, "The files' up axis, Y or Z (default: the animation's, else Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS");
  command
      ->add_option("--against", typed->against,
                   "Another pose of these strands (a groom's file), to compare with")
      ->type_name("FILE");
  CLI::Option* plotted = command
                             ->add_option("--plot", typed->plot,
                                          "Draws what changes over time into a .svg or .png (needs gnuplot)")
                             ->check(CLI::Validator(
                                 [](const std::string& path) {
                                   return canPlotInto(path) ? "" : "a plot is a .svg or .png file";
                                 },
                                 ""))
                             ->type_name("FILE");
  command->add_option("--over", typed->over, "One more run of REST in the plot; may be repeated")
      ->needs(plotted)
      ->type_name("PATH")
      ->allow_extra_args(false);
  command->add_flag("--strands", typed->strands, "Every strand by itself too");
  command->add_flag("--json", typed->json, "Print one JSON object instead of tables");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
