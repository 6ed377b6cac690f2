// Implements solver/inputs/device_world.h.
#include "ringlet/solver/inputs/device_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/packed_bodies.h"

namespace ringlet {
Result<DeviceWorld> DeviceWorld::create(gpu::Device& device, std::span<const Body> bodies,
                                        const Settings& settings, const HeadPose& start, std::size_t slots) {
  for (const Body& body : bodies) {
    if (Status status = checkBody(body); !status) return status.error();
  }
  PackedBodies packedBodies = packBodies(bodies);
  const std::uint64_t steps = static_cast<std::uint64_t>(settings.stepsPerFrame);
  auto restBuffer = createFilled(device, packedBodies.rests, "bodies");
  if (!restBuffer) return restBuffer.error();
  auto poses =
      FrameInput::create(device, (steps + 1) * bodies.size() * sizeof(layout::BodyPose), slots, "body poses");
  if (!poses) return poses.error();
  auto cellBuffer = createFilled(device, packedBodies.cells, "distance grids");
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
  world.packed_ = std::move(packedBodies.rests);
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
      // The motion of its origin, and of the point farthest from that by the turn.
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

// A step uses the air at its end, about the place of the head at its start, to which positions are relative.
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
