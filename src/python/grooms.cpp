// Grooms: read, made, handed over as arrays, looked at.
#include "python/grooms.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "python/arrays.h"
#include "python/words.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/measure/groom_doubts.h"
#include "ringlet/measure/groom_measure.h"
#include "ringlet/output/groom_writer.h"

namespace ringlet::python {
namespace {

GroomHandle handleOf(Groom groom) { return std::make_shared<GroomObject>(LoadedGroom{std::move(groom), {}}); }

// Strands by where each begins, or by how many particles each has.
std::vector<std::uint32_t> firstPointsOf(const py::object& firstPoint, const py::object& counts,
                                         std::size_t particleCount) {
  if (firstPoint.is_none() == counts.is_none())
    throw py::type_error(
        "a groom takes first_point (strands + 1 indices) or counts (particles of each strand)");
  if (!firstPoint.is_none()) return wholeNumbersOf(firstPoint, "first_point");
  std::vector<std::uint32_t> first{0};
  std::uint64_t sum = 0;
  for (const std::uint32_t count : wholeNumbersOf(counts, "counts")) {
    if (count < 2)
      throw py::value_error(fmt::format("a strand has at least 2 particles; strand {} of counts has {}",
                                        first.size() - 1, count));
    sum += count;
    if (sum > std::numeric_limits<std::uint32_t>::max())
      throw py::value_error("counts: there are more particles than 32 bits count");
    first.push_back(static_cast<std::uint32_t>(sum));
  }
  if (sum != particleCount)
    throw py::value_error(
        fmt::format("counts must add up to {}, the number of points; they add up to {}", particleCount, sum));
  return first;
}

GroomHandle makeGroom(const py::object& points, const py::object& firstPoint, const py::object& counts,
                      double metresPerUnit) {
  const PointsIn in(points, "points");
  Groom groom;
  groom.points.assign(in.points().begin(), in.points().end());
  groom.firstPoint = firstPointsOf(firstPoint, counts, groom.points.size());
  groom.metresPerUnit = metresPerUnit;
  return handleOf(std::move(groom));
}

GroomReading readingOf(std::optional<std::int64_t> pointsPerStrand, const std::string& rootEnd,
                       const std::string& up) {
  if (pointsPerStrand && (*pointsPerStrand < 2 || *pointsPerStrand > kMostPointsPerStrand))
    throw py::value_error(fmt::format("points_per_strand must be from 2 to {}, got {}", kMostPointsPerStrand,
                                      *pointsPerStrand));
  const auto end = rootEndOf(rootEnd);
  if (!end) throw py::value_error(unknownName("root_end", rootEnd, {"first", "last", "head"}));
  if (up != "Y" && up != "Z") throw py::value_error(unknownName("up axis", up, {"Y", "Z"}));
  return {.upIsZ = up == "Z",
          .pointsPerStrand = static_cast<std::uint32_t>(pointsPerStrand.value_or(0)),
          .rootEnd = *end};
}

// What seems wrong with it is among its warnings, as in a scene's.
GroomHandle readGroomFile(const std::filesystem::path& path, std::optional<double> metresPerUnit,
                          std::optional<std::int64_t> pointsPerStrand, const std::string& rootEnd,
                          const std::string& up) {
  const GroomReading reading = readingOf(pointsPerStrand, rootEnd, up);
  LoadedGroom loaded = withoutGil([&] {
    LoadedGroom read = valueOf(inWords(kGroomWords, readGroom(path, reading)));
    if (metresPerUnit) read.groom.metresPerUnit = *metresPerUnit;
    for (std::string& doubt : doubtsOf(read, reading)) read.warnings.push_back(std::move(doubt));
    read.warnings = inWords(kGroomWords, std::move(read.warnings));
    return read;
  });
  return std::make_shared<GroomObject>(std::move(loaded));
}

std::vector<std::uint32_t> countsOf(const Groom& groom) {
  std::vector<std::uint32_t> counts;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    counts.push_back(groom.firstPoint[s + 1] - groom.firstPoint[s]);
  return counts;
}

std::vector<Vec3d> strandInMetres(const Groom& groom, std::size_t strand) {
  std::vector<Vec3d> points;
  for (const Vec3f& p : groom.strand(strand)) points.push_back(Vec3d(p) * groom.metresPerUnit);
  return points;
}

double arcLength(std::span<const Vec3d> strand) {
  std::vector<double> arcs(strand.size() - 1);
  measureArcs(strand, arcs);
  double length = 0;
  for (const double arc : arcs) length += arc;
  return length;
}

py::dict spread(const std::vector<double>& values) {
  const Spread of = spreadOf(values);
  py::dict numbers;
  numbers["mean"] = of.mean, numbers["min"] = of.min, numbers["max"] = of.max;
  return numbers;
}

// Of every strand, in metres.
struct Curls {
  std::vector<double> length, turns, turnLength, radius, pitch;
  std::vector<int> handedness, perversions;
};
Curls measureCurls(const Groom& groom) {
  Curls curls;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::vector<Vec3d> strand = strandInMetres(groom, s);
    const CurlShape shape = measureCurl(strand);
    curls.length.push_back(arcLength(strand));
    curls.turns.push_back(shape.turns);
    curls.turnLength.push_back(shape.turnLength);
    curls.radius.push_back(shape.radius);
    curls.pitch.push_back(shape.pitch);
    curls.handedness.push_back(shape.handedness);
    curls.perversions.push_back(shape.perversions);
  }
  return curls;
}

py::dict curlsOf(const GroomObject& self) {
  const Curls curls = withoutGil([&] { return measureCurls(self.groom()); });
  py::dict arrays;
  arrays["length"] = arrayOf(curls.length);
  arrays["turns"] = arrayOf(curls.turns);
  arrays["turn_length"] = arrayOf(curls.turnLength);
  arrays["radius"] = arrayOf(curls.radius);
  arrays["pitch"] = arrayOf(curls.pitch);
  arrays["handedness"] = py::array_t<int>(py::cast(curls.handedness));
  arrays["perversions"] = py::array_t<int>(py::cast(curls.perversions));
  return arrays;
}

py::dict infoOf(const GroomObject& self) {
  const Groom& groom = self.groom();
  const Curls curls = withoutGil([&] { return measureCurls(groom); });
  std::vector<double> particles, turns, radii;
  for (const std::uint32_t count : countsOf(groom)) particles.push_back(count);
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    if (curls.turns[s] > 0) turns.push_back(curls.turns[s]), radii.push_back(curls.radius[s]);
  py::dict info;
  info["strands"] = groom.strandCount();
  info["particles"] = groom.points.size();
  info["particles_per_strand"] = spread(particles);
  info["length"] = spread(curls.length);
  info["curled"] = turns.size();
  info["turns"] = spread(turns);
  info["radius"] = spread(radii);
  info["right_handed"] = std::ranges::count(curls.handedness, 1);
  info["left_handed"] = std::ranges::count(curls.handedness, -1);
  return info;
}

py::array strandOf(const py::object& self, long long index) {
  const Groom& groom = self.cast<const GroomObject&>().groom();
  const auto count = static_cast<long long>(groom.strandCount());
  if (index < -count || index >= count)
    throw py::index_error(fmt::format("there is no strand {}; the groom has {}", index, count));
  return viewOf(groom.strand(static_cast<std::size_t>(index < 0 ? index + count : index)), self);
}

std::string groomReprOf(const GroomObject& self) {
  return fmt::format("<ringlet.Groom: {} strands, {} particles, {} m a unit>", self.groom().strandCount(),
                     self.particleCount(), self.groom().metresPerUnit);
}

Variation variationOf(double radius, double length, double phase, double leftHandedShare,
                      std::uint64_t seed) {
  return {
      .radius = radius, .length = length, .phase = phase, .leftHandedShare = leftHandedShare, .seed = seed};
}
CurlParameters curlOf(double radius, double turns, double length, int particles, int handedness, double phase,
                      double metresPerUnit) {
  return {.radius = radius,
          .turns = turns,
          .length = length,
          .particleCount = particles,
          .handedness = handedness,
          .phase = phase,
          .metresPerUnit = metresPerUnit};
}
GroomHandle generated(Result<Groom> made, const CurlParameters& curl) {
  LoadedGroom loaded{valueOf(std::move(made)), {}};
  if (const auto warning = coarseCurlWarning(curl)) loaded.warnings.push_back(*warning);
  return std::make_shared<GroomObject>(std::move(loaded));
}

using GroomClass = py::class_<GroomObject, GroomHandle>;

// Its points and counts.
void addGroomArrays(GroomClass& groomClass) {
  groomClass
      .def_property_readonly(
          "points",
          [](const py::object& self) { return viewOf(self.cast<const GroomObject&>().groom().points, self); },
          "(particles, 3) float32, in the groom's unit. A view that cannot be written to; it keeps the groom "
          "alive.")
      .def_property_readonly(
          "first_point",
          [](const py::object& self) {
            return viewOf(self.cast<const GroomObject&>().groom().firstPoint, self);
          },
          "(strands + 1,) uint32: where each strand begins in points, and the end of the last. A view.")
      .def_property_readonly(
          "counts",
          [](const GroomObject& self) {
            const std::vector<std::uint32_t> counts = countsOf(self.groom());
            return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(counts.size()), counts.data());
          },
          "(strands,) uint32: the particles of each strand.")
      .def_property_readonly(
          "metres_per_unit", [](const GroomObject& self) { return self.groom().metresPerUnit; },
          "The unit of points [m].")
      .def_property_readonly(
          "strand_count", [](const GroomObject& self) { return self.groom().strandCount(); },
          "How many strands there are.")
      .def_property_readonly("particle_count", &GroomObject::particleCount,
                             "How many particles all strands have.")
      .def_property_readonly("warnings", &GroomObject::warnings,
                             "What was odd about its file or its curls: a list of sentences.");
}

// What can be done with it.
void addGroomUses(GroomClass& groomClass) {
  groomClass
      .def("strand", &strandOf, py::arg("index"),
           "The points of one strand: a view, (its particles, 3) float32. IndexError beyond the last.")
      .def(
          "with_points",
          [](const GroomObject& self, const py::object& points) {
            const PointsIn in(points, "points", self.particleCount());
            Groom groom = self.groom();
            groom.points.assign(in.points().begin(), in.points().end());
            return handleOf(std::move(groom));
          },
          py::arg("points"),
          "A groom of the same strands at other points, (particles, 3) float32 in the groom's unit.")
      .def(
          "write",
          [](const GroomObject& self, const std::filesystem::path& path) {
            withoutGil([&] { demand(writeGroom(path, self.groom())); });
          },
          py::arg("path"),
          "Writes a .hair, .obj, .ply, .abc, .usda or .usdc file; reading it gives the same bits, and of the last three "
          "the unit. ringlet.Error for another extension, a full disk.")
      .def("info", &infoOf,
           "What the groom is like, in metres: a dict of strands, particles, particles_per_strand, length "
           "(along the strand), curled (strands that are not straight), of these turns and radius, "
           "right_handed, left_handed. Spreads are dicts of mean, min and max.")
      .def("curls", &curlsOf,
           "The curl of every strand, in metres: a dict of arrays, one number a strand: length, turns, "
           "turn_length, radius, pitch, handedness (1, -1 or 0), perversions. Of a straight strand turns, "
           "turn_length, radius and pitch are 0.")
      .def(
          "__len__", [](const GroomObject& self) { return self.groom().strandCount(); },
          "How many strands there are.")
      .def("__repr__", &groomReprOf, "What it is, in a line.");
}

void addGroomClass(py::module_& module) {
  GroomClass groomClass(
      module, "Groom",
      "Strands at rest: points of all of them, root first, one strand after the other. Constant.");
  groomClass.def(
      py::init(&makeGroom), py::arg("points"), py::arg("first_point") = py::none(), py::kw_only(),
      py::arg("counts") = py::none(), py::arg("metres_per_unit") = 0.01,
      "A groom of arrays; they are copied.\n\n"
      "points: (particles, 3) float32, in a unit of metres_per_unit metres. Strand s is "
      "points[first_point[s]:first_point[s + 1]]: first_point has strands + 1 whole numbers, from 0 to "
      "the number of particles; or say counts, the particles of each strand, two at least.\n\n"
      "TypeError for another type of array, ValueError for another shape, strands that do not fit, a "
      "point that is not finite.");
  addGroomArrays(groomClass);
  addGroomUses(groomClass);
}

void addCurlMakers(py::module_& module) {
  const CurlParameters c;
  const Variation v;
  const SwatchParameters w;
  module.def(
      "make_curl",
      [](double radius, double turns, double length, int particles, int handedness, double phase,
         double metresPerUnit) {
        const CurlParameters curl =
            curlOf(radius, turns, length, particles, handedness, phase, metresPerUnit);
        return generated(makeCurl(curl), curl);
      },
      py::kw_only(), py::arg("radius") = c.radius, py::arg("turns") = c.turns, py::arg("length") = c.length,
      py::arg("particles") = c.particleCount, py::arg("handedness") = c.handedness,
      py::arg("phase") = c.phase, py::arg("metres_per_unit") = c.metresPerUnit,
      "One curl that hangs from the origin: a helix of this radius about its core [m], with so many turns "
      "over the core's length [m]. handedness: 1 or -1; phase: where about the core it begins [rad]. "
      "ringlet.Error for a number out of its range.");
  module.def(
      "make_swatch",
      [](int columns, int rows, double spacing, double radius, double turns, double length, int particles,
         int handedness, double phase, double varyRadius, double varyLength, double varyPhase,
         double leftHandedShare, std::uint64_t seed, double metresPerUnit) {
        const CurlParameters curl =
            curlOf(radius, turns, length, particles, handedness, phase, metresPerUnit);
        return withoutGil([&] {
          return generated(
              makeSwatch({.curl = curl,
                          .variation = variationOf(varyRadius, varyLength, varyPhase, leftHandedShare, seed),
                          .columnCount = columns,
                          .rowCount = rows,
                          .spacing = spacing}),
              curl);
        });
      },
      py::kw_only(), py::arg("columns") = w.columnCount, py::arg("rows") = w.rowCount,
      py::arg("spacing") = w.spacing, py::arg("radius") = c.radius, py::arg("turns") = c.turns,
      py::arg("length") = c.length, py::arg("particles") = c.particleCount,
      py::arg("handedness") = c.handedness, py::arg("phase") = c.phase, py::arg("vary_radius") = v.radius,
      py::arg("vary_length") = v.length, py::arg("vary_phase") = v.phase,
      py::arg("left_handed_share") = v.leftHandedShare, py::arg("seed") = v.seed,
      py::arg("metres_per_unit") = c.metresPerUnit,
      "Curls that hang side by side, spacing apart [m], in columns along X and rows along Z. vary_radius and "
      "vary_length: largest differences, as shares; vary_phase: a share of a turn; left_handed_share: of the "
      "strands that wind the other way. Everything else as in make_curl.");
}

GroomHandle styledHead(const std::string& style, int strands, int particles, std::uint64_t seed,
                       double metresPerUnit) {
  auto head = headOfStyle(style);
  if (!head) throw py::value_error(fmt::format("style must be one of {}, got '{}'", kHairStyles, style));
  head->strandCount = strands;
  head->curl.particleCount = particles;
  head->curl.metresPerUnit = metresPerUnit;
  head->variation.seed = seed;
  return withoutGil([&] { return generated(makeHead(*head), head->curl); });
}

void addHeadMakers(py::module_& module) {
  const CurlParameters c;
  const Variation v;
  const HeadParameters h;
  module.def(
      "make_head",
      [](int strands, int locks, double scalpRadius, double browElevation, double napeElevation,
         double bendLength, double rampShare, double radius, double turns, double length, int particles,
         int handedness, double phase, double varyRadius, double varyLength, double varyPhase,
         double leftHandedShare, std::uint64_t seed, double metresPerUnit) {
        const CurlParameters curl =
            curlOf(radius, turns, length, particles, handedness, phase, metresPerUnit);
        return withoutGil([&] {
          return generated(
              makeHead({.curl = curl,
                        .variation = variationOf(varyRadius, varyLength, varyPhase, leftHandedShare, seed),
                        .strandCount = strands,
                        .lockCount = locks,
                        .scalpRadius = scalpRadius,
                        .browElevation = browElevation,
                        .napeElevation = napeElevation,
                        .bendLength = bendLength,
                        .rampShare = rampShare}),
              curl);
        });
      },
      py::kw_only(), py::arg("strands") = h.strandCount, py::arg("locks") = h.lockCount,
      py::arg("scalp_radius") = h.scalpRadius, py::arg("brow_elevation") = h.browElevation,
      py::arg("nape_elevation") = h.napeElevation, py::arg("bend_length") = h.bendLength,
      py::arg("ramp_share") = h.rampShare, py::arg("radius") = c.radius, py::arg("turns") = c.turns,
      py::arg("length") = c.length, py::arg("particles") = c.particleCount,
      py::arg("handedness") = c.handedness, py::arg("phase") = c.phase, py::arg("vary_radius") = v.radius,
      py::arg("vary_length") = v.length, py::arg("vary_phase") = v.phase,
      py::arg("left_handed_share") = v.leftHandedShare, py::arg("seed") = v.seed,
      py::arg("metres_per_unit") = c.metresPerUnit,
      "A head of curls: a sphere of scalp_radius [m] about the origin whose hair grows above a hairline, "
      "brow_elevation high in front and nape_elevation behind [rad]. A strand turns from the scalp's normal "
      "to hanging within bend_length [m]; its curl grows to its radius over ramp_share of its length. locks: "
      "of curls that wind alike; 0: each for itself. Y is up, the face looks along +Z. Everything else as in "
      "make_swatch.");
  module.def(
      "make_styled_head", &styledHead, py::arg("style"), py::kw_only(), py::arg("strands") = h.strandCount,
      py::arg("particles") = c.particleCount, py::arg("seed") = v.seed,
      py::arg("metres_per_unit") = c.metresPerUnit,
      "A head of a hair style, cut and combed: a name that `ringlet make head --help` lists. ValueError for "
      "another one, ringlet.Error for a number out of its range.");
}

}  // namespace

GroomObject::GroomObject(LoadedGroom loaded) : loaded_(std::move(loaded)) {
  const Groom& groom = loaded_.groom;
  const std::vector<std::uint32_t>& first = groom.firstPoint;
  if (!(groom.metresPerUnit > 0) || !std::isfinite(groom.metresPerUnit))
    throw py::value_error(
        fmt::format("metres_per_unit must be a number above 0, got {}", groom.metresPerUnit));
  if (first.size() < 2) throw py::value_error("a groom has at least one strand; this one has none");
  if (first.front() != 0 || first.back() != groom.points.size())
    throw py::value_error(
        fmt::format("first_point must go from 0 to {}, the number of particles; it goes from {} to {}",
                    groom.points.size(), first.front(), first.back()));
  for (std::size_t s = 0; s + 1 < first.size(); ++s) {
    if (first[s + 1] >= first[s] + std::uint64_t{2}) continue;
    throw py::value_error(
        fmt::format("a strand has at least 2 particles; strand {} goes from particle {} to {}", s, first[s],
                    first[s + 1]));
  }
  demandFinite(groom.points, "points");
}

void addGrooms(py::module_& module) {
  addGroomClass(module);
  module.def(
      "read_groom", &readGroomFile, py::arg("path"), py::arg("metres_per_unit") = py::none(), py::kw_only(),
      py::arg("points_per_strand") = py::none(), py::arg("root_end") = "first", py::arg("up") = "Y",
      "Reads a groom from a file of any format of docs/formats.md. metres_per_unit: None takes what the "
      "file states, else 0.01. points_per_strand: of a file that holds points and nothing else. root_end: "
      "which end of each strand is its root, first, last, or head, the one on a ball on which most strands "
      "have an end. up: the axis that is to point up, Y or Z, to which a file that states another is turned. What was odd "
      "about the file, or seems wrong with the groom, is in its warnings. ringlet.Error for a file that is "
      "missing or broken.");
  addCurlMakers(module);
  addHeadMakers(module);
  module.def(
      "write_obj",
      [](const std::filesystem::path& path, const GroomObject& groom, const py::object& points) {
        const PointsIn in(points, "points", groom.particleCount());
        withoutGil([&] { demand(writeObj(path, groom.groom(), in.points())); });
      },
      py::arg("path"), py::arg("groom"), py::arg("points"),
      "Writes the groom's strands at other points, (particles, 3) float32 in the groom's unit, as an .obj "
      "file: one frame, as Hair.points() gives it. ringlet.Error for a point that is not finite, a full "
      "disk.");
}

}  // namespace ringlet::python
