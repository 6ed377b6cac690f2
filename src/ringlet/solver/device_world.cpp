// Implements solver/device_world.h.
#include "ringlet/solver/device_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/base/half.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/packed.h"

namespace ringlet {
namespace {

constexpr double kEndless = 1e15;  // [m]: a plane's bounds; its square is still a float

layout::BodyRest restOf(const Body& body, std::uint32_t firstCell) {
  layout::BodyRest rest{};
  rest.friction = static_cast<float>(body.friction);
  rest.shape = layout::kShapeBox;
  const double kept = body.thickness;
  switch (body.shape) {
    case BodyShape::sphere:
      rest.halfExtents = packed3({});
      rest.rounding = static_cast<float>(body.radius + kept);
      rest.bounds = packed({}, body.radius + kept);
      break;
    case BodyShape::capsule:
      rest.halfExtents = packed3({0, body.length / 2, 0});
      rest.rounding = static_cast<float>(body.radius + kept);
      rest.bounds = packed({}, body.length / 2 + body.radius + kept);
      break;
    case BodyShape::box:
      rest.halfExtents = packed3(body.halfExtents);
      rest.rounding = static_cast<float>(kept);
      rest.bounds = packed({}, length(body.halfExtents) + kept);
      break;
    case BodyShape::plane:
      rest.shape = layout::kShapePlane;
      rest.halfExtents = packed3({});
      rest.rounding = static_cast<float>(kept);
      rest.bounds = packed({}, kEndless);
      break;
    case BodyShape::grid: {
      const DistanceGrid& grid = *body.grid;
      const Vec3d size =
          Vec3d{double(grid.counts[0]), double(grid.counts[1]), double(grid.counts[2])} * grid.cell;
      rest.shape = layout::kShapeGrid;
      rest.halfExtents = packed3({});
      rest.rounding = static_cast<float>(kept);
      rest.bounds = packed(grid.origin + size * 0.5, length(size) / 2 + kept);
      rest.gridOrigin = packed3(grid.origin);
      rest.cell = static_cast<float>(grid.cell);
      std::copy(grid.counts.begin(), grid.counts.end(), rest.cells);
      rest.firstCell = firstCell;
      break;
    }
  }
  return rest;
}

// A cell's eight corners, as gridDistance (shaders/equations/body_distance.glsl) wants them.
using PackedCell = std::array<std::uint32_t, 4>;
void packCells(const DistanceGrid& grid, std::vector<PackedCell>& cells) {
  const float cell = static_cast<float>(grid.cell);
  const auto half = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return std::uint32_t{halfBits(grid.distances[grid.cornerIndex(x, y, z)] / cell)};
  };
  for (std::uint32_t z = 0; z < grid.counts[2]; ++z)
    for (std::uint32_t y = 0; y < grid.counts[1]; ++y)
      for (std::uint32_t x = 0; x < grid.counts[0]; ++x) {
        const auto pair = [&](std::uint32_t dy, std::uint32_t dz) {
          return half(x, y + dy, z + dz) | half(x + 1, y + dy, z + dz) << 16;
        };
        cells.push_back({pair(0, 0), pair(1, 0), pair(0, 1), pair(1, 1)});
      }
}

}  // namespace

Result<DeviceWorld> DeviceWorld::create(gpu::Device& device, std::span<const Body> bodies,
                                        const Settings& settings, const HeadPose& start, std::size_t slots) {
  std::vector<layout::BodyRest> rests;
  std::vector<PackedCell> cells;
  for (const Body& body : bodies) {
    if (Status status = checkBody(body); !status) return status.error();
    rests.push_back(restOf(body, static_cast<std::uint32_t>(cells.size())));
    if (body.shape == BodyShape::grid) packCells(*body.grid, cells);
  }
  const std::uint64_t steps = static_cast<std::uint64_t>(settings.stepsPerFrame);
  auto restBuffer = createFilled(device, rests, "bodies");
  if (!restBuffer) return restBuffer.error();
  auto poses =
      FrameInput::create(device, (steps + 1) * bodies.size() * sizeof(layout::BodyPose), slots, "body poses");
  if (!poses) return poses.error();
  auto cellBuffer = createFilled(device, cells, "distance grids");
  if (!cellBuffer) return cellBuffer.error();
  auto air = FrameInput::create(device, settings.air.on ? steps * sizeof(layout::StepAir) : 0, slots, "air");
  if (!air) return air.error();

  const std::vector<WindMode> waves = settings.air.on ? windModes(settings.air) : std::vector<WindMode>{};
  RINGLET_ASSERT(waves.empty() || waves.size() == layout::kWindWaves,
                 "turbulence has as many waves as kernels add");
  std::vector<layout::WindWave> packedWaves;
  for (const WindMode& wave : waves) packedWaves.push_back({packed(wave.wave), packed(wave.amplitude)});
  auto waveBuffer = createFilled(device, packedWaves, "turbulence");
  if (!waveBuffer) return waveBuffer.error();

  DeviceWorld world(std::move(*restBuffer), std::move(*poses), std::move(*cellBuffer), std::move(*air),
                    std::move(*waveBuffer));
  world.bodies_.assign(bodies.begin(), bodies.end());
  world.packed_ = std::move(rests);
  for (const Body& body : bodies) world.now_.push_back(body.poseAt(0, start));
  world.waves_ = waves;
  world.airSettings_ = settings.air;
  world.stepSeconds_ = settings.stepSeconds();
  return world;
}

void DeviceWorld::writeFrame(std::size_t slot, std::span<const HeadPose> heads,
                             std::span<const BodyPose> poses, double seconds) {
  if (airSettings_.on) writeAir(air_.of<layout::StepAir>(slot), heads, seconds);
  const std::size_t count = bodies_.size();
  if (count == 0) return;
  RINGLET_ASSERT(poses.empty() || poses.size() == (heads.size() - 1) * count,
                 "every body has a pose in every step");
  const auto out = poses_.of<layout::BodyPose>(slot);
  for (std::size_t b = 0; b < count; ++b) {
    out[b] = {
        packed3(now_[b].position - heads[0].position), 0, packed(now_[b].rotation), packed(Quatd{}), {}};
  }
  for (std::size_t k = 1; k < heads.size(); ++k) {
    for (std::size_t b = 0; b < count; ++b) {
      const BodyPose next = poses.empty() ? bodies_[b].poseAt(0, heads[k]) : poses[(k - 1) * count + b];
      const Vec3d from = now_[b].position - heads[k - 1].position, to = next.position - heads[k].position;
      const Quatd turn = next.rotation * now_[b].rotation.conjugate();
      // Its origin, and what is furthest from that by the turn.
      const layout::vec4& bounds = packed_[b].bounds;
      const double arm = length(Vec3d{bounds.x, bounds.y, bounds.z}) + bounds.w;
      const double moves = length(to - from) + 2 * arm * length(Vec3d{turn.x, turn.y, turn.z});
      out[k * count + b] = {packed3(to), static_cast<float>(moves), packed(next.rotation), packed(turn),
                            packed((to - from) / stepSeconds_)};
      now_[b] = next;
    }
  }
}

bool DeviceWorld::isQuiet(std::span<const BodyPose> poses) const {
  if (airSettings_.on && (airSettings_.gust > 0 || !waves_.empty())) return false;
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (poses[k] != now_[k % now_.size()]) return false;
  return true;
}

void DeviceWorld::endFrame(const HeadPose& head, std::span<const BodyPose> poses) {
  const std::size_t count = bodies_.size();
  for (std::size_t b = 0; b < count; ++b)
    now_[b] = poses.empty() ? bodies_[b].poseAt(0, head) : poses[poses.size() - count + b];
}

// Of a step the air at its end, where the head was when it began: that is where positions are from.
void DeviceWorld::writeAir(std::span<layout::StepAir> out, std::span<const HeadPose> heads,
                           double seconds) const {
  for (std::size_t k = 0; k + 1 < heads.size(); ++k) {
    const double t = seconds + static_cast<double>(k + 1) * stepSeconds_;
    const Vec3d travel = (heads[k + 1].position - heads[k].position) / stepSeconds_;
    layout::StepAir air{};
    air.wind = packed(evenWindAt(airSettings_, t) - travel);
    float phases[layout::kWindWaves] = {};
    for (std::size_t wave = 0; wave < waves_.size(); ++wave)
      phases[wave] = static_cast<float>(phaseAt(waves_[wave], heads[k].position, t));
    for (std::size_t part = 0; part < 3; ++part)
      air.phases[part] = {phases[4 * part], phases[4 * part + 1], phases[4 * part + 2], phases[4 * part + 3]};
    out[k] = air;
  }
}

}  // namespace ringlet
