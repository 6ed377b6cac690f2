// Hair and its frames: the class, and what steps several.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <string_view>
#include <utility>

#include "python/arrays.h"
#include "python/hair.h"
#include "python/settings.h"
#include "ringlet/output/positions_hash.h"
#include "ringlet/scene/outside_numbers.h"
#include "ringlet/solver/diagnostics.h"

namespace ringlet::python {
namespace {

// A number for all particles, or one for each.
std::vector<float> strengthsIn(const py::object& value, std::size_t count) {
  std::vector<float> strengths;
  for (const double strength : numbersOf(value, "strengths", count)) {
    if (!kGoalStrength.contains(strength))
      throw py::value_error(fmt::format("strengths are from {} to {}, got {}", kGoalStrength.low,
                                        kGoalStrength.high, strength));
    strengths.push_back(static_cast<float>(strength));
  }
  return strengths;
}

// ValueError for the first that is out of its range, or no number.
void demandEach(std::span<const Vec3f> vectors, const char* name, const NumberRange& range,
                const char* unit) {
  demandFinite(vectors, name);
  if (const Status status = checkEach(vectors, name, range, unit); !status)
    throw py::value_error(status.error().message);
}

HairObject::Frame frameOf(const py::object& head, const py::object& bodyPoses, const py::object& rootPoses,
                          const py::object& bodyPoints) {
  return {headWayOf(head), bodyPosesOf(bodyPoses, "body_poses"), bodyPosesOf(rootPoses, "root_poses"),
          bodyPointsOf(bodyPoints)};
}

// As Python gives it.
struct HairStart {
  py::object head, oneStepEarlier, bodyPlaces, roots, rootsEarlier, rootShifts;
};

HairHandle newHair(const AssetHandle& asset, const std::vector<BodyObject>& given, const HairStart& start) {
  const std::size_t strands = asset->asset.strandCount();
  const std::vector<Body> bodies = bodiesOf(given);
  InitialState initial;
  if (!start.head.is_none()) initial.head = poseOf(start.head, "head");
  if (!start.oneStepEarlier.is_none())
    initial.oneStepEarlier = poseOf(start.oneStepEarlier, "one_step_earlier");
  initial.bodies = bodies;
  const auto fits = [](const char* name, std::size_t count, std::size_t wanted, const char* what) {
    if (count != 0 && count != wanted)
      throw py::value_error(
          fmt::format("{} must have one row for each of {} {}, got {}", name, wanted, what, count));
  };
  const std::vector<BodyPose> places = bodyPosesOf(start.bodyPlaces, "body_places");
  fits("body_places", places.size(), bodies.size(), "bodies");
  initial.bodyPlaces = places;
  const std::vector<BodyPose> now = bodyPosesOf(start.roots, "roots");
  std::vector<BodyPose> earlier = bodyPosesOf(start.rootsEarlier, "roots_earlier");
  fits("roots", now.size(), strands, "strands");
  fits("roots_earlier", earlier.size(), strands, "strands");
  if (now.empty() && !earlier.empty()) throw py::value_error("roots_earlier takes roots, where they are now");
  if (earlier.empty()) earlier = now;
  initial.roots = now, initial.rootsEarlier = earlier;
  std::vector<Vec3d> shifts;
  if (!start.rootShifts.is_none()) {
    const Rows rows = rowsOf(start.rootShifts, "root_shifts", 3);
    for (std::size_t s = 0; s < rows.count(3); ++s)
      shifts.push_back({rows.values[3 * s], rows.values[3 * s + 1], rows.values[3 * s + 2]});
    fits("root_shifts", shifts.size(), strands, "strands");
    for (const Vec3d& shift : shifts)
      if (!contains(kOutsidePlace, shift))
        throw py::value_error(fmt::format("root_shifts must be from {} to {} m, got ({}, {}, {})",
                                          kOutsidePlace.low, kOutsidePlace.high, shift.x, shift.y, shift.z));
  }
  initial.rootShifts = shifts;
  return makeHair(asset, initial);
}

py::dict hairReportOf(HairObject& self) {
  const SimulationReport r = self.ask([](Simulation& s) { return valueOf(s.report()); });
  py::dict report;
  report["max_edge_stretch"] = r.maxEdgeStretch;
  report["limited_share"] = r.limitedShare;
  report["nonfinite"] = r.nonfinite;
  report["first_nonfinite_strand"] = r.firstNonfiniteStrand;
  report["first_nonfinite_particle"] = r.firstNonfiniteParticle;
  report["degenerate_edges"] = r.degenerateEdges;
  return report;
}

py::dict contactReportOf(HairObject& self) {
  const ContactReport r = self.ask([](Simulation& s) { return valueOf(s.contactReport()); });
  py::dict report;
  report["contact_particles"] = r.contactParticles;
  report["pairs_unpruned"] = r.pairsUnpruned;
  report["pairs"] = r.pairs;
  report["volume_strands"] = r.volumeStrands;
  report["listed"] = r.listed;
  report["contacts"] = r.contacts;
  report["pair_tests"] = r.pairTests;
  report["rebuilds"] = r.rebuilds;
  report["momentum_error"] = r.momentumError;
  report["volume_cut"] = r.volumeCut;
  report["volume_largest"] = r.volumeLargest;
  report["volume_coarsest"] = r.volumeCoarsest;
  report["ways_changed"] = r.ways.changed, report["ways_tied"] = r.ways.tied;
  report["edges_stretched"] = r.ways.stretched, report["steps_held"] = r.ways.heldSteps;
  report["pairs_unsafe"] = r.ways.unsafe;
  return report;
}

py::dict memoryOf(HairObject& self) {
  const DeviceMemory m = self.ask([](Simulation& s) { return Diagnostics(s).memory(); });
  py::dict memory;
  memory["particles"] = m.particles, memory["strands"] = m.strands, memory["root_poses"] = m.rootPoses;
  memory["contacts"] = m.contacts, memory["contact_lists"] = m.contactLists, memory["volume"] = m.volume;
  memory["world"] = m.world, memory["frames"] = m.frames, memory["shared"] = m.shared;
  memory["total"] = m.total();
  return memory;
}

py::object hairPointsOf(HairObject& self, const py::object& out) {
  demandOut(out, self.asset()->groom->particleCount());
  return givePoints(self.points(), out);
}

void changeMaterial(HairObject& self, const py::object& material, const py::kwargs& numbers) {
  MaterialObject changed;
  if (material.is_none()) {
    changed.material = self.ask([](Simulation& s) { return s.material(); });
  } else if (py::isinstance<MaterialObject>(material)) {
    changed = material.cast<const MaterialObject&>();
  } else {
    throw py::type_error("set_material takes a ringlet.Material, got " + describe(material));
  }
  const py::object holder = py::cast(changed);
  for (const auto& [key, value] : numbers) {
    if (!holder.contains(key)) (void)holder[key];  // raises the KeyError that names the nearest
    holder[key] = value;
  }
  std::vector<std::string> warnings;
  self.setMaterial(dialled(holder.cast<const MaterialObject&>(), warnings));
}

void setGoals(HairObject& self, const py::object& places, const py::object& strengths, double damping) {
  const std::size_t count = self.asset()->groom->particleCount();
  const PointsIn taken(places, "places", count);
  demandEach(taken.points(), "places", kOutsidePlace, "m");
  const std::vector<float> pulls = strengthsIn(strengths, count);
  if (!kGoalDamping.contains(damping))
    throw py::value_error(
        fmt::format("damping is from {} to {}, got {}", kGoalDamping.low, kGoalDamping.high, damping));
  self.ask([&](Simulation& simulation) { demand(simulation.setGoals(taken.points(), pulls, damping)); });
}

// Pairs of strand and the particles that it keeps.
void cutStrands(HairObject& self, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& cuts) {
  std::vector<StrandCut> all;
  for (const auto& [strand, keep] : cuts) all.push_back({strand, keep});
  self.ask([&](Simulation& simulation) {
    self.demandNoneInFlight("cut");
    demand(simulation.cut(all));
  });
}

using HairClass = py::class_<HairObject, HairHandle>;

void addFrameSteps(HairClass& hair) {
  hair.def(
          "step",
          [](HairObject& self, const py::object& head, const py::object& bodyPoses,
             const py::object& rootPoses,
             const py::object& bodyPoints) { self.step(frameOf(head, bodyPoses, rootPoses, bodyPoints)); },
          py::arg("head") = py::none(), py::kw_only(), py::arg("body_poses") = py::none(),
          py::arg("root_poses") = py::none(), py::arg("body_points") = py::none(),
          "A frame, until it is done. head: a Pose, to which it goes by a smooth way; or a pose at the end "
          "of each step, a list or an array (steps, 7); None: it stays. body_poses: (steps, bodies, 7) in "
          "the world; None: bodies go with the head. root_poses: (steps, strands, 7) in the head's frame; "
          "None: roots stay where they are on it. body_points: for each body that deforms, in their order, its "
          "points in the world, (points, 3) at the frame's end or (samples, points, 3) evenly over it; None: "
          "they keep their shape.")
      .def(
          "submit",
          [](HairObject& self, const py::object& head, const py::object& bodyPoses,
             const py::object& rootPoses,
             const py::object& bodyPoints) { self.submit(frameOf(head, bodyPoses, rootPoses, bodyPoints)); },
          py::arg("head") = py::none(), py::kw_only(), py::arg("body_poses") = py::none(),
          py::arg("root_poses") = py::none(), py::arg("body_points") = py::none(),
          "Hands a frame to the device and returns: wait() for it later. Two may be under way. Takes what "
          "step takes, and gives the same bits.")
      .def("wait", &HairObject::wait,
           "Waits for the oldest frame that was submitted; positions() then are that one's.");
}

void addState(HairClass& hair) {
  hair.def(
          "positions",
          [](HairObject& self, const py::object& out) {
            demandOut(out, self.asset()->groom->particleCount());
            return givePoints(self.positions(), out);
          },
          py::arg("out") = py::none(),
          "(particles, 3) float32 [m] in the groom's order, seen from the head's position, along the world's "
          "axes: world = hair.head.position + positions. Of the last frame that was waited for. out: an "
          "array to fill, which is returned.")
      .def("points", &hairPointsOf, py::arg("out") = py::none(),
           "The same as points in the world, in the groom's unit, as files hold them; with no frame under "
           "way.")
      .def(
          "velocities",
          [](HairObject& self, const py::object& out) {
            demandOut(out, self.asset()->groom->particleCount());
            return givePoints(self.velocities(), out);
          },
          py::arg("out") = py::none(),
          "(particles, 3) float32 [m/s], seen from the head. Waits for all frames.")
      .def(
          "set_state",
          [](HairObject& self, const py::object& positions, const py::object& velocities) {
            const std::size_t count = self.asset()->groom->particleCount();
            const PointsIn p(positions, "positions", count), v(velocities, "velocities", count);
            demandEach(p.points(), "positions", kOutsidePlace, "m");
            demandEach(v.points(), "velocities", kOutsideSpeed, "m/s");
            self.setState({{p.points().begin(), p.points().end()}, {v.points().begin(), v.points().end()}});
          },
          py::arg("positions"), py::arg("velocities"),
          "Puts all particles where positions() and velocities() say, (particles, 3) float32 each.");
}

// Its settings, material and kernels.
void addNumbers(HairClass& hair) {
  hair.def_property_readonly(
          "settings", [](HairObject& self) { return self.ask([](Simulation& s) { return s.settings(); }); },
          "A copy of the Settings now: change it and hand it to set_settings.")
      .def_property_readonly(
          "material",
          [](HairObject& self) {
            return MaterialObject{self.ask([](Simulation& s) { return s.material(); }), {}};
          },
          "A copy of the Material now: change it and hand it to set_material.")
      .def(
          "set_settings",
          [](HairObject& self, const py::object& settings, const py::kwargs& named) {
            Settings changed = self.ask([](Simulation& s) { return s.settings(); });
            if (py::isinstance<Settings>(settings)) {
              changed = settings.cast<const Settings&>();
            } else if (!settings.is_none()) {
              throw py::type_error("set_settings takes ringlet.Settings, got " + describe(settings));
            }
            setAll(changed, named);
            self.setSettings(changed);
          },
          py::arg("settings") = py::none(),
          "Other settings from the next frame on: all, or those that are named: set_settings(gravity=(0, 0, "
          "0)). ringlet.Error for one that is not live (Settings.fields()), and nothing changes.")
      .def("set_material", &changeMaterial, py::arg("material") = py::none(),
           "Another material from the next frame on: all, or the numbers that are named: "
           "set_material(bend_stiffness=8). How far hair may lengthen is a setting, max_stretch. "
           "ringlet.Error for a number that cannot change while hair moves, and nothing changes.")
      .def(
          "prepare",
          [](HairObject& self, const std::vector<std::string>& features) {
            const Features wanted = featuresNamed(features);
            self.ask([&](Simulation& simulation) { demand(simulation.prepare(wanted)); });
          },
          py::arg("features"),
          "Adds features (as Asset's) now, which waits for frames in flight and compiles kernels; else their "
          "first use does.");
}

// What acts on it from outside.
void addActing(HairClass& hair) {
  hair.def(
          "set_bodies",
          [](HairObject& self, const std::vector<BodyObject>& bodies, const py::object& places) {
            self.setBodies(bodiesOf(bodies), bodyPosesOf(places, "places"));
          },
          py::arg("bodies"), py::arg("places") = py::none(),
          "Other bodies from the next frame on, any number. places: where they are now in the world, "
          "(bodies, 7); None: with the head.")
      .def(
          "set_forces",
          [](HairObject& self, const py::object& forces) {
            const PointsIn taken(forces, "forces", self.asset()->groom->particleCount());
            demandEach(taken.points(), "forces", kOutsideForce, "m/s^2");
            self.ask([&](Simulation& simulation) { demand(simulation.setForces(taken.points())); });
          },
          py::arg("forces"),
          "Forces from outside from the next frame on, on each kilogram of every particle [m/s^2]: "
          "(particles, 3) float32. They add to gravity and hold until others are set.")
      .def(
          "set_goals", &setGoals, py::arg("places"), py::arg("strengths"), py::arg("damping") = 1.0,
          "Places that particles are pulled to: (particles, 3) float32, in metres in the groom's axes, "
          "carried by the head; groom.points times metres_per_unit is the rest pose. They are reached at the "
          "end of the next frame and hold until others are set. strengths: of all particles, or one of each, "
          "(particles,): weights of the hair a centimetre from its place, 0 or more. damping: ratio about "
          "the place, 1 is critical.")
      .def("cut", &cutStrands, py::arg("cuts"),
           "Cuts strands from the next frame on: pairs (strand, keep); the particles from keep on fall, with "
           "bodies, air, fields and hair that meets pair by pair; strands that are carried rigidly stay "
           "whole. With no frame in flight. ringlet.Error where nothing would fall or fewer than two "
           "particles would stay.")
      .def(
          "set_fields",
          [](HairObject& self, const std::vector<ForceField>& fields, const std::vector<ForceField>& from) {
            if (!from.empty() && from.size() != fields.size())
              throw py::value_error(
                  fmt::format("there are {} fields, and {} that they come from", fields.size(), from.size()));
            self.ask([&](Simulation& simulation) { demand(simulation.setFields(fields, from)); });
          },
          py::arg("fields"), py::arg("come_from") = py::list(),
          "Fields as they are at the end of the next frame, any number up to 64; they hold until others are "
          "set. come_from: the same ones at its start, from where they change evenly; without, they are "
          "there at once.");
}

void addCheckpoints(HairClass& hair) {
  hair.def(
          "checkpoint",
          [](HairObject& self) {
            const std::vector<std::byte> bytes = self.checkpoint();
            return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
          },
          "All that later frames depend on, as bytes for restore(). Neither live settings nor material nor "
          "bodies and forces: set them before it.")
      .def(
          "restore",
          [](HairObject& self, const py::bytes& bytes) {
            const auto text = static_cast<std::string_view>(bytes);
            self.restore(std::as_bytes(std::span(text.data(), text.size())));
          },
          py::arg("checkpoint"),
          "Goes on from a checkpoint of hair of such an asset: the same bits as if it had stepped all frames "
          "itself. ringlet.Error for bytes that are damaged or of other hair.");
}

// What there is to know of it.
void addReports(HairClass& hair) {
  hair.def(
          "report", &hairReportOf,
          "What happened to the numbers since it was made: a dict of max_edge_stretch (longest edge over the "
          "groom's), limited_share (of edges that the stretch limit touched), nonfinite (particles without a "
          "finite place now), first_nonfinite_strand, first_nonfinite_particle, degenerate_edges.")
      .def(
          "contact_report", &contactReportOf,
          "What contacts did: a dict of contact_particles, pairs_unpruned, pairs, volume_strands, listed, "
          "contacts, pair_tests, rebuilds, momentum_error, volume_cut (how often hair as a volume was held "
          "back: its coupling was larger than the sums have room for), volume_largest (the largest coupling "
          "as a share of that room), volume_coarsest (the largest cell as a multiple of that asked for); with "
          "no_crossings, over all steps, ways_changed, ways_tied (particles), edges_stretched (beyond the "
          "limit), steps_held (all hair moved as the head), pairs_unsafe. "
          "Without contacts all is 0.")
      .def("memory", &memoryOf,
           "Bytes of its buffers on the device, by what they are for, and their total: a dict.")
      .def(
          "stage_milliseconds",
          [](HairObject& self) {
            return self.ask([](Simulation& s) { return Diagnostics(s).stageMilliseconds(); });
          },
          "Time spent on the device so far, by stage [ms]: a dict. Frames of step_frames are not counted.")
      .def_property_readonly(
          "head", [](HairObject& self) { return self.ask([](Simulation& s) { return s.head(); }); },
          "Where the head is after the last frame: a Pose.")
      .def_property_readonly(
          "warnings", [](HairObject& self) { return self.ask([](Simulation& s) { return s.warnings(); }); },
          "What one should know of it: a list of sentences.")
      .def_property_readonly(
          "kernel",
          [](HairObject& self) { return self.ask([](Simulation& s) { return Diagnostics(s).kernels(); }); },
          "The kernels in use, as \"lanes 4 x 16 (subgroup 8)\".")
      .def_property_readonly(
          "compile_milliseconds",
          [](HairObject& self) {
            return self.ask([](Simulation& s) { return Diagnostics(s).compileMilliseconds(); });
          },
          "What it took to make the kernels [ms].")
      .def_property_readonly(
          "asset", [](const HairObject& self) { return self.asset(); }, "The Asset.")
      .def(
          "__repr__",
          [](const HairObject& self) {
            const AssetObject& asset = *self.asset();
            return fmt::format("<ringlet.Hair: {} strands, {} particles on {}>", asset.asset.strandCount(),
                               asset.asset.particleCount(), asset.device->device.name());
          },
          "What it is, in a line.");
}

void addHairClass(py::module_& module) {
  HairClass hair(
      module, "Hair",
      "The hair of one head. It is at rest when it is made. A frame is as many steps as the settings say.\n\n"
      "An error of the device loses it: everything that is asked of it then raises ringlet.Error again.");
  hair.def(
      py::init([](const AssetHandle& asset, const py::object& head, const py::object& oneStepEarlier,
                  const std::vector<BodyObject>& bodies, const py::object& bodyPlaces,
                  const py::object& roots, const py::object& rootsEarlier, const py::object& rootShifts) {
        return newHair(asset, bodies,
                       {.head = head,
                        .oneStepEarlier = oneStepEarlier,
                        .bodyPlaces = bodyPlaces,
                        .roots = roots,
                        .rootsEarlier = rootsEarlier,
                        .rootShifts = rootShifts});
      }),
      py::arg("asset").none(false), py::kw_only(), py::arg("head") = py::none(),
      py::arg("one_step_earlier") = py::none(), py::arg("bodies") = std::vector<BodyObject>{},
      py::arg("body_places") = py::none(), py::arg("roots") = py::none(),
      py::arg("roots_earlier") = py::none(), py::arg("root_shifts") = py::none(),
      "head: where the head is, a Pose; one_step_earlier: where it was one step before, so that hair "
      "moves with it. bodies: a list of Body; body_places: where they are "
      "in the world, (bodies, 7); None: where they are at t = 0. roots, roots_earlier: "
      "strands' own poses now and one step before, (strands, 7). root_shifts: how far "
      "each root moves beside the head at shift 1, (strands, 3) [m].");
  addFrameSteps(hair);
  addState(hair);
  addNumbers(hair);
  addActing(hair);
  addCheckpoints(hair);
  addReports(hair);
}

// Each has what Hair.step takes.
void stepAll(const py::iterable& frames) {
  std::vector<py::object> keptAlive;
  std::vector<std::pair<HairObject*, HairObject::Frame>> all;
  for (const py::handle entry : frames) {
    const char* expected =
        "a frame is a tuple (hair, head, body_poses, root_poses, body_points), of which the last three may be "
        "left out";
    if (!py::isinstance<py::tuple>(entry))
      throw py::type_error(fmt::format("{}, got {}", expected, describe(entry)));
    const auto frame = py::reinterpret_borrow<py::tuple>(entry);
    if (frame.size() < 2 || frame.size() > 5 || !py::isinstance<HairObject>(frame[0]))
      throw py::type_error(fmt::format("{}, got {}", expected, describe(entry)));
    const auto at = [&](std::size_t i) { return i < frame.size() ? py::object(frame[i]) : py::none(); };
    keptAlive.push_back(at(0));
    all.emplace_back(&at(0).cast<HairObject&>(), frameOf(at(1), at(2), at(3), at(4)));
  }
  HairObject::stepTogether(all);
}

}  // namespace

void addHair(py::module_& module) {
  addHairClass(module);
  module.def(
      "step_frames", &stepAll, py::arg("frames"),
      "A frame of each of several heads, in one submission, which fills a device better than one after the "
      "other; the same bits. frames: tuples (hair, head, body_poses, root_poses, body_points), as step takes "
      "them, of which the last three may be left out; all on one device, each hair once.");
  module.def(
      "positions_hash",
      [](const py::object& positions) { return positionsHash(PointsIn(positions, "positions").points()); },
      py::arg("positions"),
      "A fingerprint of positions, (particles, 3) float32: those that agree in every bit share it, as "
      "`ringlet simulate --json` tells it.");
}

}  // namespace ringlet::python
