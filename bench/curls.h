// The groom benchmarks run on, and how its head is shaken for verification.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"

namespace ringlet::bench {

inline constexpr double kCurlLength = 0.25;  // from root to tip [m]

/// Curls of 1 cm radius, 8 turns (at least 4 particles a turn) and 25 cm, side by side, one for each count of
/// particles [m].
inline Groom curls(std::span<const int> particleCounts) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (std::size_t s = 0; s < particleCounts.size(); ++s) {
    const int particles = particleCounts[s];
    const double turns = std::min(8.0, particles / 4.0), x = 0.001 * double(s % 64),
                 z = 0.001 * double(s / 64);
    std::vector<Vec3f> points;
    for (int i = 0; i < particles; ++i) {
      const double u = double(i) / (particles - 1), angle = 2 * std::numbers::pi * turns * u;
      points.push_back({static_cast<float>(0.01 * std::cos(angle) + x), static_cast<float>(-kCurlLength * u),
                        static_cast<float>(0.01 * std::sin(angle) + z)});
    }
    groom.addStrand(points);
  }
  return groom;
}
inline Groom curls(int strands, int particles) {
  return curls(std::vector<int>(static_cast<std::size_t>(strands), particles));
}

/// Particles of strands, from 16 to 128, each as likely.
inline std::vector<int> mixedCounts(int strands) {
  std::mt19937 random(7);
  std::vector<int> counts;
  for (int s = 0; s < strands; ++s) counts.push_back(16 + static_cast<int>(random() % 113));
  return counts;
}
/// As many particles in all, `particles` a strand.
inline std::vector<int> uniformCounts(const std::vector<int>& like, int particles) {
  return std::vector<int>(static_cast<std::size_t>(std::accumulate(like.begin(), like.end(), 0) / particles),
                          particles);
}

/// A frame's poses, from `firstStep` on: the head is pulled aside ever faster, swings, and turns.
inline std::vector<HeadPose> shaken(const Settings& settings, int firstStep = 0) {
  std::vector<HeadPose> poses;
  for (int k = 1; k <= settings.stepsPerFrame; ++k) {
    const double t = (firstStep + k) * settings.stepSeconds(), half = 0.75 * t;
    poses.push_back(
        {{0.5 * t * t + 0.02 * std::sin(20 * t), 0, 0.1 * t}, {0, std::sin(half), 0, std::cos(half)}});
  }
  return poses;
}

}  // namespace ringlet::bench
