// Implements measure_run.h.
#include "program/measure/measure_run.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "program/cli/standard_error.h"
#include "program/measure/measure_beside.h"
#include "program/measure/measure_plot.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/contact_quality.h"
#include "ringlet/measure/shape_distance.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"

namespace ringlet::program {
namespace {

void warn(const std::string& sentence) { say("ringlet measure: warning: {}\n", sentence); }

// A groom with its up axis where `upIsZ` says, in its file's unit or the one plan, or brought to `unit`. An
// animation of Ringlet's (`isRun`) is in the unit of a groom that states none.
Result<Groom> read(const std::filesystem::path& path, const MeasurePlan& plan, bool upIsZ,
                   std::optional<double> unit = {}, bool isRun = true) {
  auto loaded = readGroom(path, readingOf(plan.reading, upIsZ));
  if (!loaded) return loaded.error();
  for (const std::string& warning : loaded->warnings) warn(warning);
  Groom& groom = loaded->groom;
  if (plan.metresPerUnit) groom.metresPerUnit = *plan.metresPerUnit;
  if (!unit || groom.metresPerUnit == *unit) return std::move(groom);
  if (!isRun || (loaded->statesUnit && !plan.metresPerUnit)) {
    warn(fmt::format("{} is in units of {} m, and measured in {} m", path.string(), groom.metresPerUnit,
                     *unit));
    for (Vec3f& p : groom.points) p = Vec3f(Vec3d(p) * (groom.metresPerUnit / *unit));
  }
  groom.metresPerUnit = *unit;
  return std::move(groom);
}

// Whether the file `path` holds the same strands as REST, particle for particle.
Status checkSameStrands(const Groom& rest, const std::vector<std::uint32_t>& counts, const MeasurePlan& plan,
                        const std::filesystem::path& path) {
  const std::string files = fmt::format("{} and {}", plan.rest.string(), path.string());
  if (counts.size() != rest.strandCount()) {
    return Error{fmt::format("{} hold {} and {} strands; only the same strands can be compared", files,
                             rest.strandCount(), counts.size())};
  }
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] == rest.strand(s).size()) continue;
    return Error{
        fmt::format("strand {} has {} particles in {} and {} in {}; only the same strands can be compared", s,
                    rest.strand(s).size(), plan.rest.string(), counts[s], path.string())};
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
Result<Groom> readPose(const Groom& rest, const MeasurePlan& plan, bool upIsZ,
                       const std::filesystem::path& path) {
  auto pose = read(path, plan, upIsZ, rest.metresPerUnit);
  if (!pose) return pose.error();
  if (Status same = checkSameStrands(rest, countsOf(*pose), plan, path); !same) return same.error();
  return pose;
}

// How far `points` are from the pose `other` of --against, both in REST's unit.
Result<std::vector<ShapeDistance>> distancesFrom(const GroomRuler& ruler, const Groom& rest,
                                                 std::span<const Vec3f> points, std::span<const Vec3f> other,
                                                 const MeasurePlan& plan) {
  auto distances = shapeDistances(ruler, points, other, rest.metresPerUnit);
  if (!distances) return Error{fmt::format("{}: {}", plan.against.string(), distances.error().message)};
  return distances;
}
// The same where the pose is in a groom's file, if there is one.
Result<std::vector<ShapeDistance>> measureAgainst(const GroomRuler& ruler, const Groom& rest,
                                                  std::span<const Vec3f> points, const MeasurePlan& plan,
                                                  bool upIsZ) {
  if (plan.against.empty()) return std::vector<ShapeDistance>{};
  auto pose = readPose(rest, plan, upIsZ, plan.against);
  if (!pose) return pose.error();
  return distancesFrom(ruler, rest, points, pose->points, plan);
}

bool isUpZ(const MeasurePlan& plan, UpAxis otherwise) {
  return plan.up ? *plan.up == "Z" : otherwise == UpAxis::z;
}
Vec3d upOf(bool isZ) { return isZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }

// Of another program's files, where they do not say their unit, it is `unit`, or the usual one.
Result<AnimationReader> openAnimation(const std::filesystem::path& path, const MeasurePlan& plan,
                                      std::optional<double> unit) {
  const GroomReading groom = readingOf(plan.reading);
  ForeignReading reading{
      .rootEnd = groom.rootEnd, .pointsPerStrand = groom.pointsPerStrand, .groom = plan.rest};
  if (plan.up) reading.upIsZ = *plan.up == "Z";
  auto source = AnimationReader::open(path, reading);
  if (!source || source->statesUnit() || !unit) return source;
  reading.metresPerUnit = unit;
  return AnimationReader::open(path, reading);
}

// Another run of REST's strands, of the same rate as the one that is measured.
Result<AnimationReader> openRun(const Groom& rest, const MeasurePlan& plan, const std::filesystem::path& path,
                                double framesPerSecond) {
  const auto file = animationFileOf(path);
  if (!file) return file.error();
  auto run = openAnimation(*file, plan, rest.metresPerUnit);
  if (!run) return run.error();
  for (const std::string& warning : run->warnings()) warn(warning);
  if (Status same = checkSameStrands(rest, countsOf(run->groom()), plan, *file); !same) return same.error();
  const CacheHeader& header = run->header();
  if (header.framesPerSecond != framesPerSecond)
    return Error{fmt::format(
        "{} has {} frames a second, and what is compared with it {}; only runs of one rate can be "
        "compared",
        file->string(), header.framesPerSecond, framesPerSecond)};
  return run;
}

// The runs of --against and --without, if the first is one.
Result<std::optional<MeasureBeside>> openBeside(const Groom& rest, const MeasurePlan& plan, int frameCount,
                                                double framesPerSecond) {
  if (plan.against.empty()) return std::optional<MeasureBeside>{};
  const auto file = animationFileOf(plan.against);
  if (!file) return file.error();
  if (!holdsAnimation(*file)) {
    if (plan.without.empty()) return std::optional<MeasureBeside>{};
    return Error{
        fmt::format("--without compares animations, and --against names {}, a pose", plan.against.string())};
  }
  auto against = openRun(rest, plan, plan.against, framesPerSecond);
  if (!against) return against.error();
  std::optional<AnimationReader> without;
  if (!plan.without.empty()) {
    auto opened = openRun(rest, plan, plan.without, framesPerSecond);
    if (!opened) return opened.error();
    without.emplace(std::move(*opened));
  }
  for (const AnimationReader* run : {&*against, without ? &*without : nullptr}) {
    if (run && run->frameCount() != frameCount)
      warn(fmt::format("one run has {} frames and another {}; those that both have are compared", frameCount,
                       run->frameCount()));
  }
  auto beside = MeasureBeside::make(rest, std::move(*against), std::move(without));
  if (!beside) return Error{fmt::format("{}: {}", plan.rest.string(), beside.error().message)};
  return std::optional(std::move(*beside));
}

Result<Measured> measureGroom(const MeasurePlan& plan, const std::filesystem::path& otherPath) {
  if (!plan.without.empty())
    return Error{fmt::format("--without compares animations, and what is measured is {}, a pose",
                             otherPath.empty() ? plan.rest.string() : otherPath.string())};
  const bool upIsZ = isUpZ(plan, UpAxis::y);
  auto rest = read(plan.rest, plan, upIsZ);
  if (!rest) return rest.error();
  const double unit = rest->metresPerUnit;
  auto ruler = GroomRuler::make(*rest);
  if (!ruler) return Error{fmt::format("{}: {}", plan.rest.string(), ruler.error().message)};
  std::vector<StrandMeasure> strands = ruler->rest();

  // The same strands elsewhere.
  std::vector<Vec3f> points = rest->points;
  if (!otherPath.empty()) {
    auto other = readPose(*rest, plan, upIsZ, otherPath);
    if (!other) return other.error();
    auto measured =
        ruler->measure(other->points, unit, upOf(upIsZ), ruler->headRotationOf(other->points, unit));
    if (!measured) return Error{fmt::format("{}: {}", otherPath.string(), measured.error().message)};
    strands = std::move(*measured);
    points = std::move(other->points);
  }
  auto distances = measureAgainst(*ruler, *rest, points, plan, upIsZ);
  if (!distances) return distances.error();

  const CurlNumbers numbers = curlNumbers(*ruler, strands);
  Measured measured{.ruler = std::move(*ruler),
                    .strands = std::move(strands),
                    .motions = {},
                    .distances = std::move(*distances),
                    .against = plan.against.string(),
                    .numbers = numbers};
  measured.isPose = !otherPath.empty();
  return measured;
}

std::vector<Vec3f> inMetres(std::span<const Vec3f> points, double metresPerUnit) {
  std::vector<Vec3f> metres;
  for (const Vec3f& p : points) metres.push_back(Vec3f(Vec3d(p) * metresPerUnit));
  return metres;
}

Result<Measured> measureAnimation(const MeasurePlan& plan, const std::filesystem::path& path) {
  auto source = openAnimation(path, plan, plan.metresPerUnit);
  if (source && !source->statesUnit()) {
    const auto groom = read(plan.rest, plan, isUpZ(plan, source->header().up));
    if (!groom) return groom.error();
    source = openAnimation(path, plan, groom->metresPerUnit);
  }
  if (!source) return source.error();
  for (const std::string& warning : source->warnings()) warn(warning);
  const double unit = source->header().metresPerUnit;
  const bool isRun = !source->isForeign();
  if (isRun && plan.metresPerUnit && std::abs(*plan.metresPerUnit / unit - 1) > 1e-9) {
    return Error{fmt::format("--unit {} does not fit {}, which was written in units of {} m; leave it out",
                             *plan.metresPerUnit, path.string(), unit)};
  }
  const bool upIsZ = isUpZ(plan, source->header().up);
  auto rest = read(plan.rest, plan, upIsZ, unit, isRun);
  if (!rest) return rest.error();
  if (Status same = checkSameStrands(*rest, countsOf(source->groom()), plan, path); !same)
    return same.error();

  // Frame by frame, from the groom itself on.
  auto motion =
      MotionMeasure::make(*rest, {.framesPerSecond = source->header().framesPerSecond, .up = upOf(upIsZ)});
  if (!motion) return Error{fmt::format("{}: {}", plan.rest.string(), motion.error().message)};
  std::optional<ContactRuler> contactRuler;
  if (!plan.plot.empty()) {
    auto made = ContactRuler::make(*rest, {}, {});
    if (!made) return Error{fmt::format("{}: {}", plan.rest.string(), made.error().message)};
    contactRuler.emplace(std::move(*made));
  }
  auto beside = openBeside(*rest, plan, source->frameCount(), source->header().framesPerSecond);
  if (!beside) return beside.error();
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
    if (!*beside || frame == 0) continue;
    if (Status added = (*beside)->addFrame(frame, motion->ruler(), points); !added)
      return Error{fmt::format("{}, compared with {}: frame {}: {}", path.string(), plan.against.string(),
                               frame, added.error().message)};
  }

  auto distances =
      *beside ? distancesFrom(motion->ruler(), *rest, (*beside)->lastPoints(), (*beside)->lastAgainst(), plan)
              : measureAgainst(motion->ruler(), *rest, source->groom().points, plan, upIsZ);
  if (!distances) return distances.error();

  MotionReport report = motion->report();
  Measured measured{.ruler = motion->ruler(),
                    .strands = {},
                    .motions = {},
                    .distances = std::move(*distances),
                    .against = plan.against.string(),
                    .numbers = {}};
  measured.numbers = curlNumbers(motion->ruler(), report);
  --measured.numbers.frameCount;  // the groom itself is none of the file's
  if (*beside) measured.beside = (*beside)->result();
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

// What became of REST: a folder stands for the animation in it.
Result<Measured> measure(const MeasurePlan& plan, const std::filesystem::path& other) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (fs::is_directory(plan.rest, code) || (isAnimation(plan.rest) && !isGroomFile(plan.rest))) {
    return Error{fmt::format(
        "{} is what became of a groom, which it does not hold; name the groom first, as in `ringlet measure "
        "groom.obj {}`",
        plan.rest.string(), plan.rest.string())};
  }
  const auto path = animationFileOf(other);
  if (!path) return path.error();
  return holdsAnimation(*path) ? measureAnimation(plan, *path) : measureGroom(plan, *path);
}

Status plot(const MeasurePlan& plan, const Measured& measured) {
  if (plan.plot.empty()) return {};
  std::vector<MotionSeries> runs;
  const auto add = [&](const Measured& run, const std::filesystem::path& path) -> Status {
    if (!run.series)
      return Error{
          fmt::format("--plot draws what changes over time, and {} is one pose; name a folder that `ringlet "
                      "simulate` wrote, or its animation",
                      path.empty() ? "a groom alone" : path.string()),
          Fault::input};
    runs.push_back(*run.series);
    runs.back().name = path.string();
    return {};
  };
  if (Status added = add(measured, plan.other); !added) return added;
  for (const std::filesystem::path& path : plan.over) {
    auto more = measure(plan, path);
    if (!more) return more.error();
    if (Status added = add(*more, path); !added) return added;
  }
  return drawPlot(plan.plot, runs);
}

}  // namespace

Result<Measured> runMeasure(const MeasurePlan& plan) {
  auto measured = measure(plan, plan.other);
  if (!measured) return measured.error();
  if (Status drawn = plot(plan, *measured); !drawn) return drawn.error();
  if (measured->isUnfinished) warn("the animation was not finished; its frames so far were measured");
  return measured;
}

}  // namespace ringlet::program
