// A person of 1.8 m as BVH texts, after the public descriptions of what exporters write: units, up axes,
// names, orders of angles, axes of bones, where positions are.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/motion/affine.h"

namespace ringlet::test {

/// What the person does.
enum class Posture { walks, armsUp, sits, lies, jumps, kicks, turnsHead };

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
  bool hasTPose = false;         // first
  int excessFrames = 0;          // beyond those stated
};

inline constexpr double kPersonTall = 1.8, kPersonHead = 1.6;  // of the top, and the joint [m]
inline constexpr int kPersonFrames = 48;

struct SampleJoint {
  std::string name;
  int parent;
  Vec3d place;  // standing with arms to the sides, Y up, looking along Z [m]
};

// In the order of the file; names by convention.
inline std::vector<SampleJoint> personJoints(const std::string& names) {
  using Names = std::array<const char*, 15>;
  static const std::map<std::string, Names> all{
      {"plain", Names{"Hips", "Spine", "Chest", "Neck", "Head", "HeadTop", "LeftCollar", "LeftUpArm",
                      "LeftLowArm", "LeftHand", "LeftUpLeg", "LeftLowLeg", "LeftFoot", "LeftToe", "Right"}},
      {"mixamo",
       Names{"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Neck", "mixamorig:Head",
             "mixamorig:HeadTop_End", "mixamorig:LeftShoulder", "mixamorig:LeftArm", "mixamorig:LeftForeArm",
             "mixamorig:LeftHand", "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot",
             "mixamorig:LeftToeBase", "mixamorig:Right"}},
      {"biped",
       Names{"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Neck", "Bip01 Head", "Bip01 HeadNub",
             "Bip01 L Clavicle", "Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 L Thigh",
             "Bip01 L Calf", "Bip01 L Foot", "Bip01 L Toe0", "Bip01 R"}},
      {"blender", Names{"hips", "spine", "chest", "neck", "head", "head_end", "shoulder.L", "upper_arm.L",
                        "forearm.L", "hand.L", "thigh.L", "shin.L", "foot.L", "toe.L", "right"}}};
  const Names& n = all.at(names);
  std::vector<SampleJoint> joints{{n[0], -1, {0, 0.95, 0}}, {n[1], 0, {0, 1.07, 0}}, {n[2], 1, {0, 1.30, 0}},
                                  {n[3], 2, {0, 1.50, 0}},  {n[4], 3, {0, 1.60, 0}}, {n[5], 4, {0, 1.80, 0}}};
  const std::array<Vec3d, 8> side{{{0.05, 1.45, 0},
                                   {0.18, 1.45, 0},
                                   {0.48, 1.45, 0},
                                   {0.74, 1.45, 0},
                                   {0.10, 0.90, 0},
                                   {0.10, 0.48, 0},
                                   {0.10, 0.08, 0},
                                   {0.10, 0, 0.14}}};
  for (const double sign : {1.0, -1.0}) {
    const int first = static_cast<int>(joints.size());
    for (int k = 0; k < 8; ++k) {
      const Vec3d at = side[static_cast<std::size_t>(k)];
      const int parent = k == 0 ? 2 : k == 4 ? 0 : first + k - 1;
      const std::string name = n[static_cast<std::size_t>(6 + k)];
      joints.push_back({sign > 0 ? name : fmt::format("{} {}", n[14], k), parent, {sign * at.x, at.y, at.z}});
    }
  }
  // The other side by names that say as much.
  for (std::size_t k = 14; k < joints.size(); ++k) {
    std::string name = joints[k - 8].name;
    const auto replace = [&](const std::string& left, const std::string& right) {
      if (const auto at = name.find(left); at != std::string::npos) name.replace(at, left.size(), right);
    };
    replace("Left", "Right"), replace(" L ", " R "), replace(".L", ".R");
    joints[k].name = name;
  }
  return joints;
}

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
  // Local turns of: left and right upper arm, left and right thigh and shin.
  std::map<std::size_t, Quatd> own;
  const auto arms = [&](double down) {
    own[7] = turnAbout({0, 0, 1}, -down), own[15] = turnAbout({0, 0, 1}, down);
  };
  const auto thighs = [&](double left, double right) {
    own[10] = turnAbout({1, 0, 0}, -left), own[18] = turnAbout({1, 0, 0}, -right);
  };
  arms(75);
  own[4] = turnAbout({0, 1, 0}, headTurn(frame));
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
      own[11] = turnAbout({1, 0, 0}, 90), own[19] = turnAbout({1, 0, 0}, 90);
      pose.hips.y = 0.5;
      break;
    case Posture::lies:
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
    const Quatd before = j == 0 ? whole : pose.turns[static_cast<std::size_t>(joints[j].parent)];
    pose.turns[j] = own.contains(j) ? before * own[j] : before;
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
    return rotate(axes[parentOf(j)].conjugate(), rotate(world, joints[j].place - joints[parentOf(j)].place)) *
           scale;
  };
  const std::string angles = fmt::format("{}rotation {}rotation {}rotation", convention.order[0],
                                         convention.order[1], convention.order[2]);
  const std::string positions = "Xposition Yposition Zposition";
  const auto numbers = [](Vec3d v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); };

  std::string text = "HIERARCHY\n";
  if (convention.hasReference)
    text += fmt::format("ROOT Reference\n{{\nOFFSET 0 0 0\nCHANNELS 6 {} {}\n", positions, angles);
  std::vector<std::size_t> order;  // of the numbers of a frame
  const std::function<void(std::size_t)> write = [&](std::size_t j) {
    order.push_back(j);
    const bool isFirst = j == 0 && !convention.hasReference;
    const bool hasPositions = j == 0 || convention.hasAllPositions;
    text += fmt::format("{} {}\n{{\nOFFSET {}\nCHANNELS {}{}\n", isFirst ? "ROOT" : "JOINT", joints[j].name,
                        numbers(convention.hasOffsets ? offsetOf(j) : Vec3d{}),
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
  write(0);
  if (convention.hasReference) text += "}\n";
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: 0.0416667\n", frames);

  for (int frame = 0; frame < frames + convention.excessFrames; ++frame) {
    PersonPose pose = personPose(joints, posture, frame);
    if (frame == 0 && convention.hasTPose) pose = {std::vector<Quatd>(joints.size()), joints[0].place};
    if (convention.hasReference) text += "0 0 0 0 0 0 ";
    std::string line;
    for (const std::size_t j : order) {
      // G = W M W^-1 B: moved in the world, from the standing axes; then among the parent's.
      const auto global = [&](std::size_t k) { return world * pose.turns[k] * world.conjugate() * axes[k]; };
      const Quatd local = j == 0 ? global(0) : global(parentOf(j)).conjugate() * global(j);
      if (j == 0 || convention.hasAllPositions)
        line += numbers(j == 0 ? rotate(world, pose.hips) * scale : offsetOf(j)) + " ";
      const auto degrees = anglesOf(normalized(local), convention.order);
      line += numbers({degrees[0], degrees[1], degrees[2]}) + " ";
    }
    text += line + "\n";
  }
  return text;
}

/// Fifteen kinds of files.
inline const std::vector<Convention>& conventions() {
  static const std::vector<Convention> all{
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
      {.name = "metres, Y down as cameras see", .unitsPerMetre = 1, .up = 'y', .axes = BoneAxes::yUp}};
  return all;
}

}  // namespace ringlet::test
