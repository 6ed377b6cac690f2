// A tool: a head of curls, shaken for a second.
#include <cstdio>

#include "ringlet/groom/generate.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/simulation.h"

int main() {
  const auto groom = ringlet::makeHead();
  const auto device = ringlet::ComputeDevice::open();
  if (!groom || !device) return std::puts((groom ? device.error() : groom.error()).message.c_str()), 1;
  auto simulation = ringlet::Simulation::create(*device, *groom, ringlet::Material{}, ringlet::Settings{});
  if (!simulation) return std::puts(simulation.error().message.c_str()), 1;
  const auto shake = *ringlet::motionByName("shake", {0, 1, 0});
  for (int frame = 1; frame <= 24; ++frame) {
    if (auto status = simulation->stepFrame(shake.poseAt(frame / 24.0)); !status)
      return std::puts(status.error().message.c_str()), 1;
  }
  const auto positions = simulation->positions();  // metres, groom order, relative to simulation->head()
  if (!positions) return std::puts(positions.error().message.c_str()), 1;
  std::printf("%zu strands on %s; the last tip is at y = %.3f m\n", groom->strandCount(),
              device->name().c_str(), positions->back().y);
}
