// From a groom to an animation: film GROOM ANIMATION
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/solver/simulation.h"

void check(const auto& result) {
  if (!result) std::puts(result.error().message.c_str()), std::exit(1);
}

int main(int argc, char** argv) {
  if (argc != 3) return std::puts("film GROOM ANIMATION"), 1;
  const auto read = ringlet::readGroom(argv[1]);
  check(read);
  const auto device = ringlet::ComputeDevice::open();
  check(device);
  const ringlet::Groom& groom = read->groom;
  auto hair = ringlet::Simulation::create(*device, groom, ringlet::Material{}, ringlet::Settings{});
  check(hair);
  const double unit = groom.metresPerUnit;
  auto film = ringlet::createAnimation(argv[2], groom, {.metresPerUnit = unit, .frameCount = 24});
  check(film);
  for (int frame = 1; frame <= 24; ++frame) {
    check(hair->stepFrame({{0.05 * std::sin(0.5 * frame), 0, 0}, {}}));
    auto points = hair->positions();  // metres, seen from the head
    check(points);
    for (auto& p : *points)
      p = static_cast<ringlet::Vec3f>((hair->head().position + ringlet::Vec3d(p)) / unit);
    check((*film)->addFrame(*points));
  }
  check((*film)->finish());
}
