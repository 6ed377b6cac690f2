// Implements c/ringlet.h: assets, hair and its frames.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/c/handles.h"
#include "ringlet/c/poses.h"
#include "ringlet/c/setting_values.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/hair_frames.h"

namespace ringlet::c {
namespace {

// Poses of a frame; nothing to take is fine.
template <class Pose>
bool takePoses(const ringlet_pose* from, std::size_t count, std::vector<Pose>& poses) {
  for (std::size_t k = 0; from && k < count; ++k) {
    const auto pose = poseOf<Pose>(from[k]);
    if (!pose) return false;
    poses.push_back(*pose);
  }
  return true;
}

// A frame of the caller's, as the solver takes it.
struct TakenFrame {
  ringlet_hair* hair = nullptr;
  std::vector<HeadPose> head;
  std::vector<BodyPose> bodies, roots;
  std::vector<std::vector<Vec3d>> points;
  std::vector<std::span<const Vec3d>> bodyPoints;
};

// Of the bodies that bend; nothing to take is fine.
Outcome takePoints(const ringlet_frame& frame, TakenFrame& taken) {
  if (!frame.body_points) return {};
  const std::vector<std::size_t>& counts = taken.hair->bendingPoints;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (!frame.body_points[b] || frame.point_samples == 0)
      return Outcome::invalid(fmt::format("a frame has no points of bending body {}", b));
    std::vector<Vec3d>& points = taken.points.emplace_back(counts[b] * frame.point_samples);
    const double* xyz = frame.body_points[b];
    for (Vec3d& point : points) point = {xyz[0], xyz[1], xyz[2]}, xyz += 3;
  }
  taken.bodyPoints.assign(taken.points.begin(), taken.points.end());
  return checkBodyPoints(counts, taken.bodyPoints);
}

Outcome take(const ringlet_frame& frame, TakenFrame& taken) {
  if (!frame.hair || !frame.step_poses)
    return Outcome::invalid("a frame has no hair, or no poses of the head");
  ringlet_hair& hair = *frame.hair;
  const auto steps = static_cast<std::uint32_t>(hair.simulation.settings().stepsPerFrame);
  if (frame.step_count != steps)
    return Outcome::invalid(fmt::format(
        "a frame has {} poses of the head; its settings have {} steps a frame", frame.step_count, steps));
  taken.hair = &hair;
  const std::size_t bodies = std::size_t{steps} * hair.bodyCount;
  const std::size_t roots = std::size_t{steps} * hair.strandCount;
  if (!takePoses(frame.step_poses, steps, taken.head) || !takePoses(frame.body_poses, bodies, taken.bodies) ||
      !takePoses(frame.root_poses, roots, taken.roots))
    return notFinite("a frame");
  return takePoints(frame, taken);
}

Outcome takeAll(const ringlet_frame* frames, uint32_t count, std::vector<TakenFrame>& taken) {
  if (count == 0) return {};
  if (!hasSize(frames)) return Outcome::invalid("there are no frames that say their size");
  std::set<const ringlet_hair*> hairs;
  taken.resize(count);
  for (uint32_t k = 0; k < count; ++k) {
    if (Outcome outcome = take(c::taken(frames, k), taken[k]); !outcome.isFine()) return outcome;
    if (Outcome outcome = checkProcess(*taken[k].hair); !outcome.isFine()) return outcome;
    if (!hairs.insert(taken[k].hair).second) return Outcome::invalid("a hair stands twice among the frames");
    if (&taken[k].hair->device.gpu() != &taken[0].hair->device.gpu())
      return Outcome::invalid("the frames are of hair on several devices");
  }
  return {};
}

std::vector<HairFrame> hairFramesOf(const std::vector<TakenFrame>& taken) {
  std::vector<HairFrame> frames;
  for (const TakenFrame& frame : taken)
    frames.push_back({&frame.hair->simulation, frame.head, frame.bodies, frame.roots, frame.bodyPoints});
  return frames;
}

TriangleMesh meshOf(const ringlet_body& from) {
  TriangleMesh mesh;
  for (std::size_t v = 0; from.vertices && v < from.vertex_count; ++v)
    mesh.points.push_back({from.vertices[3 * v], from.vertices[3 * v + 1], from.vertices[3 * v + 2]});
  for (std::size_t t = 0; from.triangles && t < from.triangle_count; ++t)
    mesh.triangles.push_back({from.triangles[3 * t], from.triangles[3 * t + 1], from.triangles[3 * t + 2]});
  return mesh;
}

// The grid, or grids, of a mesh of the caller's.
Status makeGrid(const ringlet_body& from, Body& body, std::vector<std::string>& warnings) {
  TriangleMesh mesh = meshOf(from);
  const int cells = from.cells == 0 ? 64 : from.cells;
  if (from.deforms) {
    std::optional<Bounds> grid = Bounds{{from.grid_low[0], from.grid_low[1], from.grid_low[2]},
                                        {from.grid_high[0], from.grid_high[1], from.grid_high[2]}};
    if (*grid == Bounds{}) grid.reset();
    const BendingRoom room = bendingRoomOf(mesh.points, grid, cells, from.both_sides != 0);
    return makeBendingMesh(std::move(mesh), room, body, warnings);
  }
  if (from.both_sides) return Error{"a mesh has hair on both sides only if it deforms; expected deforms 1"};
  auto grid = makeDistanceGrid(mesh, {.cells = cells});
  if (!grid) return grid.error();
  body.grid = std::make_shared<const DistanceGrid>(std::move(grid->grid));
  warnings = std::move(grid->warnings);
  return {};
}

Outcome takeBody(const ringlet_body& from, std::uint32_t index, Body& body) {
  body.name = fmt::format("body {}", index);
  const BodyForm* form = formNamed(from.shape ? from.shape : "");
  if (!form) return unknown("shape of a body", from.shape ? from.shape : "", namesIn(shapeNames()));
  body.shape = form->shape;
  const std::vector<SettingField<Body>> rows = bodyNumbersOf(*form);
  Outcome taken = takeNumbers<Body>(rows, from.shape, body.name, from.numbers, from.number_count, body);
  if (!taken.isFine()) return taken;
  const auto place = poseOf<BodyPose>(from.pose);
  if (!place) return Error{fmt::format("{} {}", body.name, kWrongPose)};
  body.place = *place;
  if (body.shape != BodyShape::grid) return {};
  std::vector<std::string> warnings;
  if (Status made = makeGrid(from, body, warnings); !made)
    return Error{fmt::format("{}: {}", body.name, made.error().message), made.error().fault};
  for (std::string& sentence : warnings) sentence = fmt::format("{}: {}", body.name, sentence);
  warnOf(warnings, from.warn, from.user);
  return {};
}

// All of an array; an empty one may be null.
Outcome takeBodies(const ringlet_body* from, std::uint32_t count, std::vector<Body>& bodies) {
  if (count > 0 && !hasSize(from)) return Outcome::invalid("there are no bodies that say their size");
  for (std::uint32_t b = 0; b < count; ++b) {
    if (Outcome outcome = takeBody(taken(from, b), b, bodies.emplace_back()); !outcome.isFine())
      return outcome;
  }
  return {};
}

Outcome fill(const std::vector<Vec3f>& values, float* xyz, std::uint64_t particleCount) {
  if (!xyz || particleCount != values.size())
    return Outcome::invalid(fmt::format("there is room for {} particles, and the hair has {}",
                                        xyz ? particleCount : 0, values.size()));
  for (const Vec3f& v : values) *xyz++ = v.x, *xyz++ = v.y, *xyz++ = v.z;
  return {};
}

}  // namespace

Outcome takeGroom(const ringlet_groom& from, Groom& made) {
  if (!from.points || !from.strand_sizes)
    return Outcome::invalid("the groom has no points, or no sizes of strands");
  made.metresPerUnit = from.metres_per_unit == 0 ? 1 : from.metres_per_unit;
  std::uint64_t count = 0;
  for (std::uint32_t s = 0; s < from.strand_count; ++s) {
    count += from.strand_sizes[s];
    if (count > 0xffffffffu) return Outcome::invalid("the groom has more particles than 32 bits count");
    made.firstPoint.push_back(static_cast<std::uint32_t>(count));
  }
  made.points.resize(count);
  for (std::uint64_t i = 0; i < count; ++i)
    made.points[i] = {from.points[3 * i], from.points[3 * i + 1], from.points[3 * i + 2]};
  return {};
}

Outcome checkStrands(const Groom& groom) {
  if (groom.strandCount() == 0) return Outcome::invalid("the groom has no strands");
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (groom.strand(s).size() < 2)
      return Outcome::invalid(
          fmt::format("strand {} has {} particles; a strand has 2 at least", s, groom.strand(s).size()));
  }
  return {};
}

Outcome buildAsset(const ComputeDevice& device, const Groom& groom, const Settings& settings,
                   const Material& material, const ringlet_asset_options& options, ringlet_asset** asset) {
  KernelChoice kernel;
  if (Outcome outcome = takeFeatures(options.features, kernel.features); !outcome.isFine()) return outcome;
  kernel.heads = std::max(1, options.heads);
  auto built = HairAsset::build(device, groom, material, settings, kernel);
  if (!built) return built.error();
  warnOf(built->warnings(), options.warn, options.user);
  *asset = new ringlet_asset{std::move(*built), device};
  return {};
}

Outcome createHair(const ringlet_asset& asset, const InitialState& initial, ringlet_hair** hair) {
  auto made = Simulation::create(asset.asset, initial);
  if (!made) return made.error();
  std::vector<DevicePositions> positions = made->devicePositions();
  *hair = new ringlet_hair{.simulation = std::move(*made),
                           .device = asset.device,
                           .particleCount = asset.asset.particleCount(),
                           .strandCount = asset.asset.strandCount(),
                           .bodyCount = static_cast<std::uint32_t>(initial.bodies.size()),
                           .bendingPoints = bendingPointCounts(initial.bodies),
                           .devicePositions = std::move(positions),
                           .scene = asset.scene};
  return {};
}

}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

static_assert(kFeatureNames[0].member == &Features::bodies && kFeatureNames[1].member == &Features::roots &&
              kFeatureNames[2].member == &Features::forces && kFeatureNames[3].member == &Features::goals &&
              kFeatureNames[4].member == &Features::fields && RINGLET_FIELDS == 1 << 4);

ringlet_result ringlet_asset_build(ringlet_device* device, const ringlet_groom* groom,
                                   const ringlet_settings* settings, const ringlet_material* material,
                                   const ringlet_asset_options* options, ringlet_asset** asset) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_asset_build takes a device, a groom and options that say their size, and a place for "
            "the asset",
            {given("device", device), sized("groom", groom), sizedOrNull("options", options),
             given("asset", asset)});
        !wrong.isFine())
      return wrong;
    Groom made;
    if (Outcome outcome = takeGroom(taken(groom), made); !outcome.isFine()) return outcome;
    return buildAsset(device->device, made, settings ? settings->settings : Settings{},
                      material ? material->material : Material{}, taken(options), asset);
  });
}

uint64_t ringlet_asset_particle_count(const ringlet_asset* asset) {
  return asset ? asset->asset.particleCount() : 0;
}
uint32_t ringlet_asset_strand_count(const ringlet_asset* asset) {
  return asset ? static_cast<uint32_t>(asset->asset.strandCount()) : 0;
}
void ringlet_asset_release(ringlet_asset* asset) { delete asset; }

ringlet_result ringlet_hair_create(ringlet_asset* asset, const ringlet_initial_state* initial,
                                   ringlet_hair** hair) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_hair_create takes an asset, a state that says its size, and a place for the hair",
            {given("asset", asset), sizedOrNull("initial", initial), given("hair", hair)});
        !wrong.isFine())
      return wrong;
    const ringlet_initial_state from = taken(initial);
    const auto head = poseOf<HeadPose>(from.head);
    if (!head) return notFinite("the head");
    std::vector<Body> bodies;
    if (Outcome outcome = takeBodies(from.bodies, from.body_count, bodies); !outcome.isFine()) return outcome;
    return createHair(*asset, {.head = *head, .bodies = bodies, .readsBack = from.keeps_on_device == 0},
                      hair);
  });
}

void ringlet_hair_release(ringlet_hair* hair) { delete hair; }

ringlet_result ringlet_step(const ringlet_frame* frames, uint32_t frame_count) {
  return guarded([&]() -> Outcome {
    std::vector<TakenFrame> all;
    if (Outcome outcome = takeAll(frames, frame_count, all); !outcome.isFine()) return outcome;
    for (const TakenFrame& frame : all)
      if (Outcome outcome = checkFree(*frame.hair); !outcome.isFine()) return outcome;
    return stepFrames(hairFramesOf(all));
  });
}

ringlet_result ringlet_step_to(ringlet_hair* hair, const ringlet_pose* head) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_step_to takes hair and a pose",
                                       {given("hair", hair), given("head", head)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    const auto end = poseOf<HeadPose>(*head);
    if (!end) return notFinite("the head");
    return hair->simulation.stepFrame(*end);
  });
}

ringlet_result ringlet_record(const ringlet_frame* frames, uint32_t frame_count, void* command_buffer) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_record takes a command buffer",
                                       {given("command_buffer", command_buffer)});
        !wrong.isFine())
      return wrong;
    std::vector<TakenFrame> all;
    if (Outcome outcome = takeAll(frames, frame_count, all); !outcome.isFine()) return outcome;
    if (Status status = recordFrames(hairFramesOf(all), command_buffer); !status) return status;
    for (const TakenFrame& frame : all) ++frame.hair->recordedFrames;
    return {};
  });
}

ringlet_result ringlet_frame_is_over(ringlet_hair* hair) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_frame_is_over takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkProcess(*hair); !outcome.isFine()) return outcome;
    hair->recordedFrames = std::max(0, hair->recordedFrames - 1);
    return frameIsOver(hair->simulation);
  });
}

ringlet_result ringlet_positions(const ringlet_hair* hair, float* xyz, uint64_t particle_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_positions takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    const auto values = hair->simulation.positions();
    return values ? fill(*values, xyz, particle_count) : values.error();
  });
}

ringlet_result ringlet_velocities(const ringlet_hair* hair, float* xyz, uint64_t particle_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_velocities takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    const auto state = hair->simulation.state();
    return state ? fill(state->velocities, xyz, particle_count) : state.error();
  });
}

uint32_t ringlet_device_positions_count(const ringlet_hair* hair) {
  return hair ? static_cast<uint32_t>(hair->devicePositions.size()) : 0;
}

ringlet_result ringlet_get_device_positions(const ringlet_hair* hair, uint32_t index,
                                            ringlet_device_positions* positions) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_get_device_positions takes hair, one of its buffers, and a struct that says its size",
            {given("hair", hair), sized("positions", positions)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkProcess(*hair); !outcome.isFine()) return outcome;
    if (index >= hair->devicePositions.size())
      return Outcome::invalid(
          fmt::format("there is no buffer {}; the hair has {}", index, hair->devicePositions.size()));
    const DevicePositions& from = hair->devicePositions[index];
    give(positions, {0, from.buffer, from.bytes, from.particles.data(), from.particles.size()});
    return {};
  });
}

ringlet_result ringlet_hair_set_settings(ringlet_hair* hair, const ringlet_settings* settings) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_hair_set_settings takes hair and settings",
                                       {given("hair", hair), given("settings", settings)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    return hair->simulation.setSettings(settings->settings);
  });
}

ringlet_result ringlet_hair_set_material(ringlet_hair* hair, const ringlet_material* material) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_hair_set_material takes hair and a material",
                                       {given("hair", hair), given("material", material)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    return hair->simulation.setMaterial(material->material);
  });
}

ringlet_result ringlet_hair_cut(ringlet_hair* hair, const ringlet_cut* cuts, uint32_t cut_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments(
            "ringlet_hair_cut takes hair and cuts",
            {given("hair", hair), Argument{"cuts", cuts || cut_count == 0 ? nullptr : "is NULL"}});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    std::vector<StrandCut> taken;
    for (uint32_t i = 0; i < cut_count; ++i) taken.push_back({cuts[i].strand, cuts[i].keep});
    return hair->simulation.cut(taken);
  });
}

ringlet_result ringlet_hair_prepare(ringlet_hair* hair, uint32_t features) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_hair_prepare takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    Features wanted;
    if (Outcome outcome = takeFeatures(features, wanted); !outcome.isFine()) return outcome;
    return hair->simulation.prepare(wanted);
  });
}

ringlet_result ringlet_hair_set_bodies(ringlet_hair* hair, const ringlet_body* bodies, uint32_t body_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_hair_set_bodies takes hair", {given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    std::vector<Body> taken;
    if (Outcome outcome = takeBodies(bodies, body_count, taken); !outcome.isFine()) return outcome;
    if (Status status = hair->simulation.setBodies(taken); !status) return status;
    hair->bodyCount = body_count;
    hair->bendingPoints = bendingPointCounts(taken);
    return {};
  });
}

ringlet_result ringlet_get_report(const ringlet_hair* hair, ringlet_report* report) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_get_report takes hair, and a report that says its size",
                                       {given("hair", hair), sized("report", report)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    const auto told = hair->simulation.report();
    if (!told) return told.error();
    const auto contacts = hair->simulation.contactReport();
    if (!contacts) return contacts.error();
    give(report, {0, told->maxEdgeStretch, told->nonfinite, contacts->contacts,
                  Diagnostics(hair->simulation).memory().total()});
    return {};
  });
}

ringlet_result ringlet_checkpoint(ringlet_hair* hair, void* bytes, size_t* size) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_checkpoint takes hair, and a place for the size",
                                       {given("hair", hair), given("size", size)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    const auto made = hair->simulation.checkpoint();
    if (!made) return made.error();
    const std::size_t room = std::exchange(*size, made->size());
    if (!bytes) return {};
    if (room < made->size())
      return Outcome::invalid(
          fmt::format("a checkpoint has {} bytes, and there is room for {}", made->size(), room));
    std::memcpy(bytes, made->data(), made->size());
    return {};
  });
}

ringlet_result ringlet_restore(ringlet_hair* hair, const void* bytes, size_t size) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_restore takes hair and a checkpoint",
                                       {given("hair", hair), given("bytes", bytes)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    return hair->simulation.restore({static_cast<const std::byte*>(bytes), size});
  });
}
