// A person of 1.8 m as BVH texts: what it does, and in which unit, up axis, order of angles, axes of bones
// and places of positions a file says so. Which joints it has: skeleton_hierarchies.h.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/motion/affine.h"
#include "tests/motion/skeleton_hierarchies.h"

namespace ringlet::test {

/// What the person does.
enum class Posture { walks, armsUp, sits, lies, getsUp, jumps, kicks, turnsHead };

/// Of the axes of joints.
enum class BoneAxes {
  files,   // the file's: the skeleton stands at zero angles
  yUp,     // of Y up, where the file has another axis: the root is turned
  alongX,  // each bone lies along its joint's X
};

struct Convention {
  const char* name = "";
  double unitsPerMetre = 100;
  char up = 'Y';  // 'y': Y is down
  BoneAxes axes = BoneAxes::files;
  std::string order = "ZXY";  // of angles
  std::string names = "plain";
  bool hasAllPositions = false;  // in every joint
  bool hasOffsets = true;        // false: all 0, so that only positions place joints
  bool hasReference = false;     // a root at the origin that does not move
  bool hasReferenceChannels = true;
  bool hasTPose = false;  // first
  int excessFrames = 0;   // beyond those stated
};

inline constexpr int kPersonFrames = 48;

inline Quatd turnAbout(Vec3d axis, double degrees) {
  return fromRotationVector(axis * (degrees * std::numbers::pi / 180));
}

/// How a head turns about the up axis at a frame [degrees].
inline double headTurn(int frame) { return 30 * std::sin(2 * std::numbers::pi * frame / 24); }

/// Each joint's turn in the world, of a world that is Y up, from the standing pose; and where the hips are.
struct PersonPose {
  std::vector<Quatd> turns;
  Vec3d hips;
};

inline PersonPose personPose(const std::vector<SampleJoint>& joints, Posture posture, int frame) {
  const double swing = std::sin(2 * std::numbers::pi * frame / 24);
  PersonPose pose{std::vector<Quatd>(joints.size()), joints[0].place};
  std::map<Role, Quatd> own;  // turns among the parent's
  const auto arms = [&](double down) {
    own[Role::leftArm] = turnAbout({0, 0, 1}, -down), own[Role::rightArm] = turnAbout({0, 0, 1}, down);
  };
  const auto thighs = [&](double left, double right) {
    own[Role::leftThigh] = turnAbout({1, 0, 0}, -left), own[Role::rightThigh] = turnAbout({1, 0, 0}, -right);
  };
  arms(75);
  own[Role::head] = turnAbout({0, 1, 0}, headTurn(frame));
  Quatd whole;
  switch (posture) {
    case Posture::walks:
      thighs(15 * swing, -15 * swing);
      pose.hips += Vec3d{0, 0.01 * swing * swing, 0.05 * frame};
      break;
    case Posture::armsUp:
      arms(-80);
      break;
    case Posture::sits:
      thighs(90, 90);
      own[Role::leftShin] = own[Role::rightShin] = turnAbout({1, 0, 0}, 90);
      pose.hips.y = 0.5;
      break;
    case Posture::lies:
      whole = turnAbout({1, 0, 0}, -90);
      pose.hips = {0, 0.12, -0.3};
      break;
    case Posture::getsUp:  // in the middle
      if (frame >= kPersonFrames / 2) break;
      whole = turnAbout({1, 0, 0}, -90);
      pose.hips = {0, 0.12, -0.3};
      break;
    case Posture::jumps:
      pose.hips.y += std::max(0.0, 0.5 * swing);
      break;
    case Posture::kicks:
      if (frame % 12 >= 8) thighs(150, 0);
      break;
    case Posture::turnsHead:
      break;
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (j > 0 && joints[j].parent < 0) continue;  // stays with the root
    const Quatd before = j == 0 ? whole : pose.turns[static_cast<std::size_t>(joints[j].parent)];
    const auto turn = joints[j].role == Role::other ? own.end() : own.find(joints[j].role);
    pose.turns[j] = turn == own.end() ? before : before * turn->second;
  }
  return pose;
}

/// The three angles about axes in an order, "ZXY", whose product is the rotation [degrees].
inline std::array<double, 3> anglesOf(Quatd rotation, const std::string& order) {
  const Vec3d columns[3] = {rotate(rotation, Vec3d{1, 0, 0}), rotate(rotation, Vec3d{0, 1, 0}),
                            rotate(rotation, Vec3d{0, 0, 1})};
  const auto entry = [&](int row, int column) {
    const Vec3d v = columns[column];
    return row == 0 ? v.x : row == 1 ? v.y : v.z;
  };
  const int i = order[0] - 'X', j = order[1] - 'X', k = order[2] - 'X';
  const double sign = (j - i + 3) % 3 == 1 ? 1 : -1, sine = sign * entry(i, k);
  const double degrees = 180 / std::numbers::pi;
  if (std::abs(sine) > 1 - 1e-12) {
    return {std::atan2(sign * entry(k, j), entry(j, j)) * degrees, std::copysign(90.0, sine), 0};
  }
  return {std::atan2(-sign * entry(j, k), entry(k, k)) * degrees, std::asin(sine) * degrees,
          std::atan2(-sign * entry(i, j), entry(i, i)) * degrees};
}

inline std::string bvhNumbers(Vec3d v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); }

/// From a world of Y up into the file's.
inline Quatd intoFile(char up) {
  return up == 'Z'   ? turnAbout({1, 0, 0}, 90)
         : up == 'X' ? turnAbout({0, 0, 1}, -90)
         : up == 'y' ? turnAbout({1, 0, 0}, 180)
                     : Quatd{};
}

/// Of each joint: its axes in the standing pose, in the file's world.
inline std::vector<Quatd> jointAxes(const Convention& convention, const std::vector<SampleJoint>& joints) {
  const Quatd world = intoFile(convention.up);
  std::vector<Quatd> axes(joints.size());
  if (convention.axes == BoneAxes::files) return axes;
  if (convention.axes == BoneAxes::yUp) return std::vector<Quatd>(joints.size(), world);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Vec3d bone;
    for (std::size_t c = joints.size(); c-- > j + 1;)
      if (joints[c].parent == static_cast<int>(j)) bone = joints[c].place - joints[j].place;
    const Vec3d x = normalizedOr(rotate(world, bone), Vec3d{1, 0, 0});
    const Vec3d z = anyNormal(x);
    axes[j] = rotationOf(x, cross(z, x), z);
  }
  return axes;
}

/// The text of a file.
inline std::string bvhOf(const Convention& convention, Posture posture, int frames = kPersonFrames) {
  const std::vector<SampleJoint> joints = personJoints(convention.names);
  const Quatd world = intoFile(convention.up);
  const std::vector<Quatd> axes = jointAxes(convention, joints);
  const double scale = convention.unitsPerMetre;
  const auto parentOf = [&](std::size_t j) { return static_cast<std::size_t>(joints[j].parent); };
  const auto offsetOf = [&](std::size_t j) {
    if (j == 0) return Vec3d{};
    if (joints[j].parent < 0) return rotate(world, joints[j].place) * scale;
    return rotate(axes[parentOf(j)].conjugate(), rotate(world, joints[j].place - joints[parentOf(j)].place)) *
           scale;
  };
  const std::string angles = fmt::format("{}rotation {}rotation {}rotation", convention.order[0],
                                         convention.order[1], convention.order[2]);
  const std::string positions = "Xposition Yposition Zposition";

  std::string text = "HIERARCHY\n";
  if (convention.hasReference)
    text += fmt::format("ROOT Reference\n{{\nOFFSET 0 0 0\nCHANNELS {}\n",
                        convention.hasReferenceChannels ? "6 " + positions + " " + angles : "0");
  std::vector<std::size_t> order;  // of the numbers of a frame
  const std::function<void(std::size_t)> write = [&](std::size_t j) {
    order.push_back(j);
    const bool isFirst = j == 0 && !convention.hasReference;
    const bool hasPositions = j == 0 || convention.hasAllPositions;
    text += fmt::format("{} {}\n{{\nOFFSET {}\nCHANNELS {}{}\n", isFirst ? "ROOT" : "JOINT", joints[j].name,
                        bvhNumbers(convention.hasOffsets ? offsetOf(j) : Vec3d{}),
                        hasPositions ? "6 " + positions + " " : "3 ", angles);
    bool isEnd = true;
    for (std::size_t c = j + 1; c < joints.size(); ++c) {
      if (joints[c].parent != static_cast<int>(j)) continue;
      isEnd = false;
      write(c);
    }
    if (isEnd) text += "End Site\n{\nOFFSET 0 0 0\n}\n";
    text += "}\n";
  };
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].parent < 0) write(j);
  if (convention.hasReference) text += "}\n";
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: 0.0416667\n", frames);

  for (int frame = 0; frame < frames + convention.excessFrames; ++frame) {
    PersonPose pose = personPose(joints, posture, frame);
    if (frame == 0 && convention.hasTPose) pose = {std::vector<Quatd>(joints.size()), joints[0].place};
    if (convention.hasReference && convention.hasReferenceChannels) text += "0 0 0 0 0 0 ";
    std::string line;
    for (const std::size_t j : order) {
      // G = W M W^-1 B: moved in the world, from the standing axes; then among the parent's.
      const auto global = [&](std::size_t k) { return world * pose.turns[k] * world.conjugate() * axes[k]; };
      const Quatd local = joints[j].parent < 0 ? global(j) : global(parentOf(j)).conjugate() * global(j);
      if (j == 0 || convention.hasAllPositions)
        line += bvhNumbers(j == 0 ? rotate(world, pose.hips) * scale : offsetOf(j)) + " ";
      const auto degrees = anglesOf(normalized(local), convention.order);
      line += bvhNumbers({degrees[0], degrees[1], degrees[2]}) + " ";
    }
    text += line + "\n";
  }
  return text;
}

/// The head's joint.
inline std::string headOf(const Convention& convention) {
  const auto joints = personJoints(convention.names);
  return std::ranges::find(joints, Role::head, &SampleJoint::role)->name;
}

/// Kinds of files.
inline const std::vector<Convention> kConventions{
    {.name = "inches over 0.45, a T-pose first",
     .unitsPerMetre = 0.45 / 0.0254,
     .order = "ZYX",
     .hasTPose = true},
    {.name = "centimetres, names with a namespace", .order = "XYZ", .names = "mixamo"},
    {.name = "centimetres, a frame more than stated", .order = "YXZ", .excessFrames = 1},
    {.name = "centimetres, positions in all joints", .order = "YXZ", .hasAllPositions = true},
    {.name = "centimetres, positions only, no offsets", .hasAllPositions = true, .hasOffsets = false},
    {.name = "centimetres, a root that stays", .hasReference = true},
    {.name = "inches, bones along X",
     .unitsPerMetre = 1 / 0.0254,
     .axes = BoneAxes::alongX,
     .order = "ZXY",
     .names = "biped"},
    {.name = "centimetres, bones along X, Z up", .up = 'Z', .axes = BoneAxes::alongX, .names = "biped"},
    {.name = "metres, Z up", .unitsPerMetre = 1, .up = 'Z', .order = "XYZ", .names = "blender"},
    {.name = "metres, Y up", .unitsPerMetre = 1, .order = "XYZ", .names = "blender"},
    {.name = "millimetres, Z up", .unitsPerMetre = 1000, .up = 'Z', .order = "ZXY"},
    {.name = "millimetres, Y up", .unitsPerMetre = 1000, .order = "ZXY"},
    {.name = "metres, made Y up, the root turned to Z up",
     .unitsPerMetre = 1,
     .up = 'Z',
     .axes = BoneAxes::yUp},
    {.name = "centimetres, X up", .up = 'X', .names = "mixamo"},
    {.name = "metres, Y down as cameras see", .unitsPerMetre = 1, .up = 'y', .axes = BoneAxes::yUp},
    {.name = "CMU, inches over 0.45, a T-pose first",
     .unitsPerMetre = 0.45 / 0.0254,
     .order = "ZYX",
     .names = "cmu",
     .hasTPose = true},
    {.name = "CMU, inches", .unitsPerMetre = 1 / 0.0254, .order = "ZXY", .names = "cmu"},
    {.name = "Xsens, centimetres", .order = "YXZ", .names = "xsens"},
    {.name = "Xsens, metres, Z up", .unitsPerMetre = 1, .up = 'Z', .order = "YXZ", .names = "xsens"},
    {.name = "Perception Neuron, positions, a frame more than stated",
     .order = "YXZ",
     .names = "neuron",
     .hasAllPositions = true,
     .excessFrames = 1},
    {.name = "Perception Neuron, inches, positions only",
     .unitsPerMetre = 1 / 0.0254,
     .order = "YXZ",
     .names = "neuron",
     .hasAllPositions = true,
     .hasOffsets = false},
    {.name = "Unreal, centimetres, bones along X, Z up",
     .up = 'Z',
     .axes = BoneAxes::alongX,
     .order = "XYZ",
     .names = "unreal",
     .hasReference = true},
    {.name = "Unreal, inches, bones along X",
     .unitsPerMetre = 1 / 0.0254,
     .axes = BoneAxes::alongX,
     .order = "XYZ",
     .names = "unreal",
     .hasReference = true},
    {.name = "Daz, centimetres", .order = "YZX", .names = "daz"},
    {.name = "Daz, inches, made Y up, the root turned to Z up",
     .unitsPerMetre = 1 / 0.0254,
     .up = 'Z',
     .axes = BoneAxes::yUp,
     .order = "XYZ",
     .names = "daz"},
    {.name = "Poser, 2.62 m", .unitsPerMetre = 1 / 2.62, .names = "poser"},
    {.name = "Poser, inches", .unitsPerMetre = 1 / 0.0254, .names = "poser"},
    {.name = "Rigify, metres, Z up, a root without channels",
     .unitsPerMetre = 1,
     .up = 'Z',
     .order = "XYZ",
     .names = "rigify",
     .hasReference = true,
     .hasReferenceChannels = false},
    {.name = "Rigify, centimetres, Y up", .order = "XYZ", .names = "rigify"},
    {.name = "SMPL, metres, a root that stays",
     .unitsPerMetre = 1,
     .order = "ZYX",
     .names = "smpl",
     .hasReference = true},
    {.name = "SMPL, metres, Y down as cameras see",
     .unitsPerMetre = 1,
     .up = 'y',
     .axes = BoneAxes::yUp,
     .order = "ZYX",
     .names = "smpl"}};

}  // namespace ringlet::test
