// Measures: hair in motion and at rest, as numbers.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "python/arrays.h"
#include "python/grooms.h"
#include "python/materials.h"
#include "python/poses.h"
#include "python/words.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/measure/contact_watch.h"
#include "ringlet/measure/crossings.h"
#include "ringlet/measure/groom_measure.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/measure/placement_check.h"
#include "ringlet/measure/shape_distance.h"

namespace ringlet::python {
namespace {

Vec3d upOf(const py::object& value) {
  const Vec3d up = vectorOf(value, "up");
  if (!(length(up) > 0)) throw py::value_error("up must have a length above 0");
  return normalizedOr(up, Vec3d{0, 1, 0});
}

double unitOf(const std::optional<double>& metresPerUnit, const GroomObject& groom) {
  const double unit = metresPerUnit.value_or(groom.groom().metresPerUnit);
  if (!(unit > 0) || !std::isfinite(unit))
    throw py::value_error(fmt::format("metres_per_unit must be above 0, got {}", unit));
  return unit;
}

std::optional<Quatd> headRotationOf(const py::object& value) {
  if (value.is_none()) return std::nullopt;
  if (py::isinstance<HeadPose>(value)) return value.cast<const HeadPose&>().rotation;
  return rotationOf(value, "head_rotation");
}

// An array a number, a value a strand.
template <class Each, class Of>
void put(py::dict& arrays, const char* name, const std::vector<Each>& all, Of&& of) {
  std::vector<double> values;
  for (const Each& each : all) values.push_back(static_cast<double>(of(each)));
  arrays[name] = arrayOf(values);
}

py::dict dictOf(const std::vector<StrandMeasure>& all) {
  using M = StrandMeasure;
  py::dict arrays;
  put(arrays, "droop", all, [](const M& m) { return m.droop; });
  put(arrays, "relative_droop", all, [](const M& m) { return m.relativeDroop; });
  put(arrays, "chord", all, [](const M& m) { return m.chord; });
  put(arrays, "chord_elongation", all, [](const M& m) { return m.chordElongation; });
  put(arrays, "core_length", all, [](const M& m) { return m.coreLength; });
  put(arrays, "core_elongation", all, [](const M& m) { return m.coreElongation; });
  put(arrays, "arc_drift", all, [](const M& m) { return m.arcDrift; });
  put(arrays, "max_edge_stretch", all, [](const M& m) { return m.maxEdgeStretch; });
  put(arrays, "turns", all, [](const M& m) { return m.turns; });
  put(arrays, "winding", all, [](const M& m) { return m.winding; });
  put(arrays, "mean_radius", all, [](const M& m) { return m.meanRadius; });
  put(arrays, "handedness", all, [](const M& m) { return m.handedness; });
  put(arrays, "handedness_kept", all, [](const M& m) { return m.handednessKept; });
  put(arrays, "tip_rotation_deg", all, [](const M& m) { return m.tipRotation; });
  return arrays;
}

py::dict dictOf(const std::vector<ShapeDistance>& all) {
  using D = ShapeDistance;
  py::dict arrays;
  put(arrays, "particles", all, [](const D& d) { return d.particles; });
  put(arrays, "tip", all, [](const D& d) { return d.tip; });
  put(arrays, "core", all, [](const D& d) { return d.core; });
  put(arrays, "direction_deg", all, [](const D& d) { return d.direction; });
  put(arrays, "turns", all, [](const D& d) { return d.turns; });
  put(arrays, "radius", all, [](const D& d) { return d.radius; });
  return arrays;
}

py::dict dictOf(const CurlNumbers& n) {
  py::dict numbers;
  numbers["strands"] = n.strandCount, numbers["particles"] = n.particleCount,
  numbers["frames"] = n.frameCount;
  numbers["droop"] = n.droop, numbers["core_elongation"] = n.coreElongation;
  numbers["turns"] = n.turns, numbers["mean_radius"] = n.meanRadius;
  numbers["handedness_kept"] = n.handednessKept, numbers["arc_drift"] = n.arcDrift;
  numbers["max_edge_stretch"] = n.maxEdgeStretch, numbers["tip_rotation_deg"] = n.tipRotation;
  numbers["bounce_hz"] = n.bounceHz, numbers["sway_hz"] = n.swayHz;
  numbers["settle_seconds"] = n.settleSeconds, numbers["energy_ratio"] = n.energyRatio;
  numbers["worst_droop"] = n.worstDroop, numbers["worst_core_elongation"] = n.worstCoreElongation;
  numbers["worst_tip_rotation_deg"] = n.worstTipRotation;
  return numbers;
}

py::dict measureShape(const GroomObject& groom, const py::object& points, const py::object& up,
                      const py::object& headRotation, const std::optional<double>& metresPerUnit) {
  const PointsIn in(points, "points", groom.particleCount());
  const double unit = unitOf(metresPerUnit, groom);
  const Vec3d upwards = upOf(up);
  const auto rotation = headRotationOf(headRotation);
  return dictOf(withoutGil([&] {
    const GroomRuler ruler = valueOf(GroomRuler::make(groom.groom()));
    demandFinite(in.points(), "points");
    const Quatd head = rotation ? *rotation : ruler.headRotationOf(in.points(), unit);
    return valueOf(ruler.measure(in.points(), unit, upwards, head));
  }));
}

py::dict distanceBetween(const GroomObject& groom, const py::object& points, const py::object& other,
                         const std::optional<double>& metresPerUnit) {
  const PointsIn a(points, "points", groom.particleCount()), b(other, "other", groom.particleCount());
  const double unit = unitOf(metresPerUnit, groom);
  demandFinite(a.points(), "points");
  demandFinite(b.points(), "other");
  return dictOf(withoutGil([&] {
    const GroomRuler ruler = valueOf(GroomRuler::make(groom.groom()));
    return valueOf(shapeDistances(ruler, a.points(), b.points(), unit));
  }));
}

struct MotionMeasureObject {
  GroomHandle groom;
  MotionMeasure measure;
};

using MotionMeasureClass = py::class_<MotionMeasureObject>;

void addMotionFrames(MotionMeasureClass& motion) {
  motion.def(
      "add_frame",
      [](MotionMeasureObject& self, const py::object& points, const py::object& headRotation,
         const py::object& velocities, const std::optional<double>& metresPerUnit) {
        const std::size_t count = self.groom->particleCount();
        const PointsIn in(points, "points", count);
        const double unit = unitOf(metresPerUnit, *self.groom);
        const auto rotation = headRotationOf(headRotation);
        demandFinite(in.points(), "points");
        if (velocities.is_none()) {
          demand(self.measure.addFrame(in.points(), unit, rotation));
        } else {
          const PointsIn v(velocities, "velocities", count);
          demandFinite(v.points(), "velocities");
          demand(self.measure.addFrame(in.points(), unit, rotation, v.points()));
        }
      },
      py::arg("points"), py::kw_only(), py::arg("head_rotation") = py::none(),
      py::arg("velocities") = py::none(), py::arg("metres_per_unit") = py::none(),
      "points: (particles, 3) float32 in the groom's unit, or in metres_per_unit: 1 for positions(). "
      "head_rotation: against the groom, a Pose or a quaternion; None: fitted to the roots. velocities: "
      "(particles, 3) float32 [m/s], if they are known.");
}

void addMotionNumbers(MotionMeasureClass& motion) {
  motion
      .def(
          "report",
          [](const MotionMeasureObject& self) {
            if (self.measure.frameCount() == 0)
              throw Failure({"nothing to report: add_frame() was not called yet"});
            return dictOf(curlNumbers(self.measure.ruler(), self.measure.report()));
          },
          "Numbers of the whole groom: a dict of strands, particles, frames; droop [m], core_elongation, "
          "turns, mean_radius [m] (means, last frame); handedness_kept (whether all did); arc_drift, "
          "max_edge_stretch, tip_rotation_deg (worst); bounce_hz, sway_hz, settle_seconds, energy_ratio "
          "(None: none was found); worst_droop, worst_core_elongation, worst_tip_rotation_deg.")
      .def(
          "strands",
          [](const MotionMeasureObject& self) {
            if (self.measure.frameCount() == 0)
              throw Failure({"nothing to report: add_frame() was not called yet"});
            std::vector<StrandMeasure> last;
            for (const StrandMotion& strand : self.measure.report().strands) last.push_back(strand.last);
            return dictOf(last);
          },
          "The last frame strand by strand: a dict as measure_shape gives it, tip_rotation_deg over all "
          "frames.")
      .def_property_readonly(
          "frame_count", [](const MotionMeasureObject& self) { return self.measure.frameCount(); },
          "How many frames were added.")
      .def(
          "__repr__",
          [](const MotionMeasureObject& self) {
            return fmt::format("<ringlet.MotionMeasure: {} strands, {} frames>",
                               self.groom->groom().strandCount(), self.measure.frameCount());
          },
          "What it is, in a line.");
}

void addMotionMeasure(py::module_& module) {
  MotionMeasureClass motion(
      module, "MotionMeasure",
      "Hair in motion: how it looks at the end and at its worst, how fast it bounces, when it comes to rest. "
      "Is fed every frame, then asked.");
  motion.def(py::init([](const GroomHandle& groom, double fps, const py::object& up, double lineDensity) {
               if (!(fps > 0) || !std::isfinite(fps))
                 throw py::value_error(fmt::format("fps must be above 0, got {}", fps));
               if (!(lineDensity > 0) || !std::isfinite(lineDensity))
                 throw py::value_error(fmt::format("line_density must be above 0, got {}", lineDensity));
               const MotionOptions options{
                   .framesPerSecond = fps, .up = upOf(up), .lineDensity = lineDensity};
               return MotionMeasureObject{groom, valueOf(MotionMeasure::make(groom->groom(), options))};
             }),
             py::arg("groom").none(false), py::kw_only(), py::arg("fps") = 24.0,
             py::arg("up") = py::make_tuple(0, 1, 0), py::arg("line_density") = Material{}.lineDensity,
             "groom: at rest. fps: of the frames that will come; up: against gravity; line_density: of the "
             "material, for energies [kg/m].");
  addMotionFrames(motion);
  addMotionNumbers(motion);
}

struct ContactWatchObject {
  std::size_t particleCount;
  ContactWatch watch;
  bool hasSteps = false;
};

void addContactWatch(py::module_& module) {
  py::class_<ContactWatchObject>(
      module, "ContactWatch",
      "What hairs do to each other, from positions alone: how often they go through one another, how deep in "
      "each other they are. Is fed every step, and told where a frame ends.")
      .def(py::init([](const GroomHandle& groom, const std::optional<MaterialObject>& material,
                       const std::optional<Settings>& settings) {
             const Settings given = settings.value_or(Settings{});
             std::vector<std::string> warnings;
             const Material made = dialled(material.value_or(MaterialObject{}), warnings);
             return ContactWatchObject{groom->particleCount(), withoutGil([&] {
                                         return valueOf(ContactWatch::make(groom->groom(), made, given));
                                       })};
           }),
           py::arg("groom").none(false), py::arg("material") = py::none(), py::arg("settings") = py::none(),
           "Radii are those of settings.contacts, on or off.")
      .def(
          "add_step",
          [](ContactWatchObject& self, const py::object& positions) {
            const PointsIn in(positions, "positions", self.particleCount);
            self.watch.addStep(in.points());
            self.hasSteps = true;
          },
          py::arg("positions"),
          "(particles, 3) float32 [m], as positions() gives them: at first where the run starts from.")
      .def(
          "end_frame",
          [](ContactWatchObject& self) {
            if (!self.hasSteps) throw Failure({"a frame ends with a step: add_step() first"});
            return self.watch.endFrame();
          },
          "The step added last ends a frame. Whether it is the worst so far.")
      .def(
          "numbers",
          [](const ContactWatchObject& self) {
            const ContactNumbers n = self.watch.numbers();
            py::dict numbers;
            numbers["crossings"] = n.crossings, numbers["deepest_overlap"] = n.deepestOverlap;
            numbers["worst_overlapping"] = n.worst.overlapping,
            numbers["worst_raw_recall"] = n.worst.rawRecall;
            numbers["worst_overlap_sum"] = n.worst.overlapBeyondRestSum;
            numbers["worst_deepest_overlap"] = n.worst.deepestOverlap;
            return numbers;
          },
          "Over all steps and frames: a dict of crossings, deepest_overlap (beyond rest, a share of two "
          "radii); of the worst frame worst_overlapping (pairs of spheres), worst_raw_recall (share of them "
          "whose strands may touch), worst_overlap_sum, worst_deepest_overlap.")
      .def(
          "__repr__",
          [](const ContactWatchObject& self) {
            return fmt::format("<ringlet.ContactWatch: {} particles>", self.particleCount);
          },
          "What it is, in a line.");
}

struct BodyWatchObject {
  std::size_t particleCount;
  std::vector<Body> bodies;
  BodyWatch watch;
};

void addBodyWatch(py::module_& module) {
  py::class_<BodyWatchObject>(module, "BodyWatch", "How deep hair gets into bodies. Is shown every frame.")
      .def(py::init([](const GroomHandle& groom, const std::vector<BodyObject>& given, int roots) {
             if (roots < 1) throw py::value_error(fmt::format("roots must be 1 or more, got {}", roots));
             const std::vector<Body> bodies = bodiesOf(given);
             return BodyWatchObject{groom->particleCount(), bodies, BodyWatch(groom->groom(), bodies, roots)};
           }),
           py::arg("groom").none(false), py::arg("bodies"), py::kw_only(), py::arg("roots") = 1,
           "bodies: a list of Body. roots: of settings, whose particles follow the head and do not count.")
      .def(
          "look",
          [](BodyWatchObject& self, const py::object& positions, const py::object& head,
             const py::object& bodyPoses, const py::object& bodyPoints) {
            const PointsIn in(positions, "positions", self.particleCount);
            const HeadPose at = head.is_none() ? HeadPose{} : poseOf(head, "head");
            std::vector<BodyPose> poses = bodyPosesOf(bodyPoses, "body_poses");
            if (bodyPoses.is_none())
              for (const Body& body : self.bodies) poses.push_back(body.poseAt(0, at));
            if (poses.size() != self.bodies.size())
              throw py::value_error(fmt::format("body_poses must have a pose for each of {} bodies, got {}",
                                                self.bodies.size(), poses.size()));
            const std::vector<std::vector<Vec3d>> given = bodyPointsOf(bodyPoints);
            const std::vector<std::span<const Vec3d>> points(given.begin(), given.end());
            if (const Status checked = checkBodyPoints(bendingPointCounts(self.bodies), points); !checked)
              throw py::value_error(checked.error().message);
            self.watch.look(in.points(), at, poses, points);
          },
          py::arg("positions"), py::arg("head") = py::none(), py::arg("body_poses") = py::none(),
          py::arg("body_points") = py::none(),
          "positions: (particles, 3) float32 [m], as positions() gives them; head: where it is, a Pose; "
          "body_poses: (bodies, 7) in the world; None: with the head. body_points: of each body that deforms, "
          "(points, 3) in the world; None: as they were at first.")
      .def(
          "numbers",
          [](const BodyWatchObject& self) {
            const BodyNumbers n = self.watch.numbers();
            py::dict numbers;
            numbers["deepest"] = n.deepest, numbers["strand"] = n.strand, numbers["particle"] = n.particle;
            numbers["frame"] = n.frame, numbers["inside"] = n.inside;
            return numbers;
          },
          "Over all frames: a dict of deepest [m], of which strand, particle and frame (-1: none), and "
          "inside: particles that began in a body and have not been outside.")
      .def(
          "__repr__",
          [](const BodyWatchObject& self) {
            return fmt::format("<ringlet.BodyWatch: {} particles, {} bodies>", self.particleCount,
                               self.bodies.size());
          },
          "What it is, in a line.");
}

}  // namespace

void addMeasures(py::module_& module) {
  module.def(
      "measure_shape", &measureShape, py::arg("groom"), py::arg("points"), py::kw_only(),
      py::arg("up") = py::make_tuple(0, 1, 0), py::arg("head_rotation") = py::none(),
      py::arg("metres_per_unit") = py::none(),
      "How strands look beside their rest shape: a dict of arrays, one number a strand: droop (of the tip "
      "[m]), relative_droop, chord, chord_elongation, core_length, core_elongation, arc_drift, "
      "max_edge_stretch, turns, winding, mean_radius, handedness, handedness_kept, tip_rotation_deg. points: "
      "(particles, 3) float32 in the groom's unit, or in metres_per_unit: 1 for positions(). head_rotation: "
      "a Pose or quaternion; None: fitted to the roots.");
  module.def(
      "shape_distance", &distanceBetween, py::arg("groom"), py::arg("points"), py::arg("other"),
      py::kw_only(), py::arg("metres_per_unit") = py::none(),
      "How far one pose of the strands is from another, without a scale: a dict of arrays, one number a "
      "strand: particles, tip and core as shares of the length, direction_deg, turns and radius as shares. "
      "points, other: (particles, 3) float32 in one unit.");
  module.def(
      "count_crossings",
      [](const GroomObject& groom, const py::object& before, const py::object& after) {
        const PointsIn a(before, "before", groom.particleCount()), b(after, "after", groom.particleCount());
        return withoutGil([&] { return countCrossings(groom.groom().firstPoint, a.points(), b.points()); });
      },
      py::arg("groom"), py::arg("before"), py::arg("after"),
      "How often an edge of one strand went through an edge of another while all particles went straight "
      "from before to after, (particles, 3) float32 each.");
  module.def(
      "check_placement",
      [](const GroomObject& groom, const std::vector<BodyObject>& bodies, const py::object& head) {
        const std::vector<Body> carried = bodiesOf(bodies);
        const HeadPose pose = head.is_none() ? HeadPose{} : poseOf(head, "head");
        std::vector<std::string> doubts = checkPlacement(groom.groom(), carried, pose);
        if (auto ends = checkRootEnds(groom.groom(), carried, pose)) doubts.push_back(std::move(*ends));
        return inWords(kGroomWords, std::move(doubts));
      },
      py::arg("groom"), py::arg("bodies") = py::tuple(), py::arg("head") = py::none(),
      "Whether the groom and the bodies that the head carries have the sizes and places of hair and a head, "
      "and strands begin on it: a list of sentences, each with the likely cause; empty where nothing is odd. "
      "Scene.load does this.");
  addMotionMeasure(module);
  addContactWatch(module);
  addBodyWatch(module);
}

}  // namespace ringlet::python
