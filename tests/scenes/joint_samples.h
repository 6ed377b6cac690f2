// Skeletons whose head joint has any axis up, as files: many programs lay bones along +X.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "ringlet/base/vec3.h"
#include "tests/motion/gltf_samples.h"

namespace ringlet::test {

struct JointAxis {
  const char* name;
  Vec3d up;                       // in the joint's frame
  std::array<double, 3> degrees;  // about Z, then X, then Y in its parent's: they take that axis to Y
};
inline constexpr JointAxis kJointAxes[] = {{"+X", {1, 0, 0}, {90, 0, 0}},  {"-X", {-1, 0, 0}, {-90, 0, 0}},
                                           {"+Y", {0, 1, 0}, {0, 0, 0}},   {"-Y", {0, -1, 0}, {180, 0, 0}},
                                           {"+Z", {0, 0, 1}, {0, -90, 0}}, {"-Z", {0, 0, -1}, {0, 90, 0}}};

inline constexpr int kJointFrames = 13;
/// How the head turns about the world's Z from frame 0 on [degrees], and goes along X [m].
inline double jointTurn(int frame) { return 2.5 * frame; }
inline double jointWay(int frame) { return 0.01 * frame; }
inline constexpr double kJointHeight = 1.5;  // [m]

/// A BVH in centimetres, of 24 frames a second; its skeleton is 170 tall.
inline void writeBvhOf(const JointAxis& axis, const std::filesystem::path& path) {
  std::ofstream bvh(path);
  bvh << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
         "Xrotation "
         "Yrotation\nJOINT Head\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n"
         "OFFSET 0 170 0\n}\n}\n}\nMOTION\nFrames: 13\nFrame Time: 0.0416666667\n";
  for (int k = 0; k < kJointFrames; ++k) {
    bvh << 100 * jointWay(k) << " " << 100 * kJointHeight << " 0 " << jointTurn(k) << " 0 0 "
        << axis.degrees[0] << " " << axis.degrees[1] << " " << axis.degrees[2] << "\n";
  }
}

/// The same in metres.
inline void writeGltfOf(const JointAxis& axis, const std::filesystem::path& path) {
  GltfBuilder file;
  const auto turn = [](double degrees, Vec3d about) {
    return fromRotationVector(about * (degrees * std::numbers::pi / 180));
  };
  const Quatd local =
      turn(axis.degrees[0], {0, 0, 1}) * turn(axis.degrees[1], {1, 0, 0}) * turn(axis.degrees[2], {0, 1, 0});
  const int head = file.node({{"name", "Head"}, {"rotation", {local.x, local.y, local.z, local.w}}});
  const int hips = file.node({{"name", "Hips"}, {"children", {head}}});
  std::vector<double> seconds, places, turns;
  for (int k = 0; k < kJointFrames; ++k) {
    const Quatd q = turn(jointTurn(k), {0, 0, 1});
    seconds.push_back(k / 24.0);
    places.insert(places.end(), {jointWay(k), kJointHeight, 0});
    turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
  }
  file.channel(0, hips, "translation", "LINEAR", seconds, places);
  file.channel(0, hips, "rotation", "LINEAR", seconds, turns);
  std::ofstream(path) << file.text();
}

}  // namespace ringlet::test
