// The joints that a person of 1.8 m has in BVH files of widely used programs, after their public
// descriptions: names, parents and places.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

inline constexpr double kPersonTall = 1.8, kPersonHead = 1.6;  // of the top, and the joint [m]

/// What a joint is to a posture.
enum class Role { other, head, leftArm, rightArm, leftThigh, rightThigh, leftShin, rightShin };

struct SampleJoint {
  std::string name;
  int parent;   // -1: of the first joint, the hips, and of what hangs beside them off a root that stays
  Vec3d place;  // standing with arms to the sides, Y up, looking along Z [m]
  Role role = Role::other;
};

/// Places of a person, those of the left side [m].
inline const std::map<std::string, Vec3d>& personPlaces() {
  static const std::map<std::string, Vec3d> all{
      {"hips", {0, 0.95, 0}},      {"spine", {0, 1.07, 0}},     {"chest", {0, 1.30, 0}},
      {"chest2", {0, 1.40, 0}},    {"neck", {0, 1.50, 0}},      {"neck1", {0, 1.55, 0}},
      {"head", {0, 1.60, 0}},      {"top", {0, 1.80, 0}},       {"eye", {0.03, 1.67, 0.09}},
      {"collar", {0.05, 1.45, 0}}, {"arm", {0.18, 1.45, 0}},    {"fore", {0.48, 1.45, 0}},
      {"hand", {0.74, 1.45, 0}},   {"finger", {0.82, 1.45, 0}}, {"thigh", {0.10, 0.90, 0}},
      {"twist", {0.10, 0.69, 0}},  {"shin", {0.10, 0.48, 0}},   {"foot", {0.10, 0.08, 0}},
      {"ball", {0.10, 0.02, 0.1}}, {"toe", {0.10, 0, 0.14}},    {"heel", {0.10, 0, -0.06}},
      {"floor", {0, 0, 0}}};
  return all;
}

/// '@' stands for left and right. The first is the hips; a joint without a parent hangs beside them.
struct Hierarchy {
  struct Joint {
    const char *name, *parent, *place;
  };
  const char *left, *right;
  std::vector<Joint> joints;
};

inline const std::map<std::string, Hierarchy> kHierarchies{
    {"plain",
     {"Left",
      "Right",
      {{"Hips", "", "hips"},
       {"Spine", "Hips", "spine"},
       {"Chest", "Spine", "chest"},
       {"Neck", "Chest", "neck"},
       {"Head", "Neck", "head"},
       {"HeadTop", "Head", "top"},
       {"@Collar", "Chest", "collar"},
       {"@UpArm", "@Collar", "arm"},
       {"@LowArm", "@UpArm", "fore"},
       {"@Hand", "@LowArm", "hand"},
       {"@UpLeg", "Hips", "thigh"},
       {"@LowLeg", "@UpLeg", "shin"},
       {"@Foot", "@LowLeg", "foot"},
       {"@Toe", "@Foot", "toe"}}}},
    {"mixamo",
     {"mixamorig:Left",
      "mixamorig:Right",
      {{"mixamorig:Hips", "", "hips"},
       {"mixamorig:Spine", "mixamorig:Hips", "spine"},
       {"mixamorig:Spine1", "mixamorig:Spine", "chest"},
       {"mixamorig:Neck", "mixamorig:Spine1", "neck"},
       {"mixamorig:Head", "mixamorig:Neck", "head"},
       {"mixamorig:HeadTop_End", "mixamorig:Head", "top"},
       {"@Shoulder", "mixamorig:Spine1", "collar"},
       {"@Arm", "@Shoulder", "arm"},
       {"@ForeArm", "@Arm", "fore"},
       {"@Hand", "@ForeArm", "hand"},
       {"@UpLeg", "mixamorig:Hips", "thigh"},
       {"@Leg", "@UpLeg", "shin"},
       {"@Foot", "@Leg", "foot"},
       {"@ToeBase", "@Foot", "toe"}}}},
    // Bones of no length at the hips, of which legs and trunk begin.
    {"cmu",
     {"Left",
      "Right",
      {{"Hips", "", "hips"},
       {"@HipJoint", "Hips", "hips"},
       {"@UpLeg", "@HipJoint", "thigh"},
       {"@Leg", "@UpLeg", "shin"},
       {"@Foot", "@Leg", "foot"},
       {"@ToeBase", "@Foot", "toe"},
       {"LowerBack", "Hips", "hips"},
       {"Spine", "LowerBack", "spine"},
       {"Spine1", "Spine", "chest"},
       {"Neck", "Spine1", "chest"},
       {"Neck1", "Neck", "neck1"},
       {"Head", "Neck1", "head"},
       {"HeadEnd", "Head", "top"},
       {"@Shoulder", "Spine1", "chest"},
       {"@Arm", "@Shoulder", "arm"},
       {"@ForeArm", "@Arm", "fore"},
       {"@Hand", "@ForeArm", "hand"},
       {"@FingerBase", "@Hand", "hand"},
       {"@HandIndex1", "@FingerBase", "finger"}}}},
    // Ends at the joint of the head.
    {"xsens",
     {"Left",
      "Right",
      {{"Hips", "", "hips"},
       {"Chest", "Hips", "spine"},
       {"Chest2", "Chest", "chest"},
       {"Chest4", "Chest2", "chest2"},
       {"Neck", "Chest4", "neck"},
       {"Head", "Neck", "head"},
       {"@Collar", "Chest4", "collar"},
       {"@Shoulder", "@Collar", "arm"},
       {"@Elbow", "@Shoulder", "fore"},
       {"@Wrist", "@Elbow", "hand"},
       {"@Hip", "Hips", "thigh"},
       {"@Knee", "@Hip", "shin"},
       {"@Ankle", "@Knee", "foot"},
       {"@Toe", "@Ankle", "ball"}}}},
    {"neuron",
     {"Robot_Left",
      "Robot_Right",
      {{"Robot_Hips", "", "hips"},
       {"@UpLeg", "Robot_Hips", "thigh"},
       {"@Leg", "@UpLeg", "shin"},
       {"@Foot", "@Leg", "foot"},
       {"@FootEnd", "@Foot", "toe"},
       {"Robot_Spine", "Robot_Hips", "spine"},
       {"Robot_Spine1", "Robot_Spine", "chest"},
       {"Robot_Neck", "Robot_Spine1", "neck"},
       {"Robot_Head", "Robot_Neck", "head"},
       {"@Shoulder", "Robot_Spine1", "collar"},
       {"@Arm", "@Shoulder", "arm"},
       {"@ForeArm", "@Arm", "fore"},
       {"@Hand", "@ForeArm", "hand"},
       {"@HandThumb1", "@Hand", "finger"}}}},
    // Beside the hips targets that stay.
    {"unreal",
     {"_l",
      "_r",
      {{"pelvis", "", "hips"},
       {"spine_01", "pelvis", "spine"},
       {"spine_02", "spine_01", "chest"},
       {"clavicle@", "spine_02", "collar"},
       {"upperarm@", "clavicle@", "arm"},
       {"lowerarm@", "upperarm@", "fore"},
       {"hand@", "lowerarm@", "hand"},
       {"neck_01", "spine_02", "neck"},
       {"head", "neck_01", "head"},
       {"thigh@", "pelvis", "thigh"},
       {"thigh_twist_01@", "thigh@", "twist"},
       {"calf@", "thigh@", "shin"},
       {"foot@", "calf@", "foot"},
       {"ball@", "foot@", "ball"},
       {"ik_foot_root", "", "floor"},
       {"ik_foot@", "ik_foot_root", "foot"},
       {"ik_hand_root", "", "floor"},
       {"ik_hand@", "ik_hand_root", "hand"}}}},
    // Legs begin below hips of their own, and thighs are of two bones; the head ends at the eyes.
    {"daz",
     {"l",
      "r",
      {{"hip", "", "hips"},
       {"pelvis", "hip", "hips"},
       {"@ThighBend", "pelvis", "thigh"},
       {"@ThighTwist", "@ThighBend", "twist"},
       {"@Shin", "@ThighTwist", "shin"},
       {"@Foot", "@Shin", "foot"},
       {"@Toe", "@Foot", "toe"},
       {"@Heel", "@Foot", "heel"},
       {"abdomenLower", "hip", "spine"},
       {"chestLower", "abdomenLower", "chest"},
       {"@Collar", "chestLower", "collar"},
       {"@ShldrBend", "@Collar", "arm"},
       {"@ForearmBend", "@ShldrBend", "fore"},
       {"@Hand", "@ForearmBend", "hand"},
       {"neckLower", "chestLower", "neck"},
       {"head", "neckLower", "head"},
       {"@Eye", "head", "eye"}}}},
    {"poser",
     {"Left ",
      "Right ",
      {{"Hip", "", "hips"},
       {"Abdomen", "Hip", "spine"},
       {"Chest", "Abdomen", "chest"},
       {"Neck", "Chest", "neck"},
       {"Head", "Neck", "head"},
       {"@Eye", "Head", "eye"},
       {"@Collar", "Chest", "collar"},
       {"@Shoulder", "@Collar", "arm"},
       {"@Forearm", "@Shoulder", "fore"},
       {"@Hand", "@Forearm", "hand"},
       {"@Buttock", "Hip", "hips"},
       {"@Thigh", "@Buttock", "thigh"},
       {"@Shin", "@Thigh", "shin"},
       {"@Foot", "@Shin", "foot"},
       {"@Toe", "@Foot", "toe"}}}},
    // Nothing is called a head, or hips.
    {"rigify",
     {".L",
      ".R",
      {{"spine", "", "hips"},
       {"spine.001", "spine", "spine"},
       {"spine.002", "spine.001", "chest"},
       {"spine.004", "spine.002", "neck"},
       {"spine.006", "spine.004", "head"},
       {"face", "spine.006", "head"},
       {"skull", "face", "top"},
       {"shoulder@", "spine.002", "collar"},
       {"upper_arm@", "shoulder@", "arm"},
       {"forearm@", "upper_arm@", "fore"},
       {"hand@", "forearm@", "hand"},
       {"pelvis@", "spine", "hips"},
       {"thigh@", "spine", "thigh"},
       {"shin@", "thigh@", "shin"},
       {"foot@", "shin@", "foot"},
       {"toe@", "foot@", "toe"},
       {"heel.02@", "foot@", "heel"}}}},
    {"blender",
     {".L",
      ".R",
      {{"hips", "", "hips"},
       {"spine", "hips", "spine"},
       {"chest", "spine", "chest"},
       {"neck", "chest", "neck"},
       {"head", "neck", "head"},
       {"head_end", "head", "top"},
       {"shoulder@", "chest", "collar"},
       {"upper_arm@", "shoulder@", "arm"},
       {"forearm@", "upper_arm@", "fore"},
       {"hand@", "forearm@", "hand"},
       {"thigh@", "hips", "thigh"},
       {"shin@", "thigh@", "shin"},
       {"foot@", "shin@", "foot"},
       {"toe@", "foot@", "toe"}}}},
    {"smpl",
     {"L_",
      "R_",
      {{"Pelvis", "", "hips"},
       {"@Hip", "Pelvis", "thigh"},
       {"@Knee", "@Hip", "shin"},
       {"@Ankle", "@Knee", "foot"},
       {"@Foot", "@Ankle", "ball"},
       {"Spine1", "Pelvis", "spine"},
       {"Spine3", "Spine1", "chest"},
       {"Neck", "Spine3", "neck"},
       {"Head", "Neck", "head"},
       {"@Collar", "Spine3", "collar"},
       {"@Shoulder", "@Collar", "arm"},
       {"@Elbow", "@Shoulder", "fore"},
       {"@Wrist", "@Elbow", "hand"},
       {"@Hand", "@Wrist", "finger"}}}},
    // Legs hang off the spine, arms off the neck.
    {"biped",
     {" L",
      " R",
      {{"Bip01", "", "hips"},
       {"Bip01 Pelvis", "Bip01", "hips"},
       {"Bip01 Spine", "Bip01 Pelvis", "spine"},
       {"Bip01 Spine1", "Bip01 Spine", "chest"},
       {"Bip01 Neck", "Bip01 Spine1", "neck"},
       {"Bip01@ Clavicle", "Bip01 Neck", "collar"},
       {"Bip01@ UpperArm", "Bip01@ Clavicle", "arm"},
       {"Bip01@ Forearm", "Bip01@ UpperArm", "fore"},
       {"Bip01@ Hand", "Bip01@ Forearm", "hand"},
       {"Bip01 Head", "Bip01 Neck", "head"},
       {"Bip01 HeadNub", "Bip01 Head", "top"},
       {"Bip01@ Thigh", "Bip01 Spine", "thigh"},
       {"Bip01@ Calf", "Bip01@ Thigh", "shin"},
       {"Bip01@ Foot", "Bip01@ Calf", "foot"},
       {"Bip01@ Toe0", "Bip01@ Foot", "toe"}}}}};

inline Role roleOf(const std::string& place, bool isLeft) {
  if (place == "arm") return isLeft ? Role::leftArm : Role::rightArm;
  if (place == "thigh") return isLeft ? Role::leftThigh : Role::rightThigh;
  return place == "shin" ? (isLeft ? Role::leftShin : Role::rightShin) : Role::other;
}

/// In an order in which parents stand before their children.
inline std::vector<SampleJoint> personJoints(const std::string& names) {
  const Hierarchy& hierarchy = kHierarchies.at(names);
  std::vector<SampleJoint> joints;
  const auto add = [&](const Hierarchy::Joint& joint, bool isLeft) {
    const auto sided = [&](std::string name) {
      if (const auto at = name.find('@'); at != name.npos)
        name.replace(at, 1, isLeft ? hierarchy.left : hierarchy.right);
      return name;
    };
    const auto parent = std::ranges::find(joints, sided(joint.parent), &SampleJoint::name);
    Vec3d place = personPlaces().at(joint.place);
    if (!isLeft) place.x = -place.x;
    const bool isHead = joint.place == std::string("head") &&
                        std::ranges::find(joints, Role::head, &SampleJoint::role) == joints.end();
    joints.push_back({sided(joint.name),
                      parent == joints.end() ? -1 : static_cast<int>(parent - joints.begin()), place,
                      isHead ? Role::head : roleOf(joint.place, isLeft)});
  };
  const auto isSided = [](const Hierarchy::Joint& joint) {
    return std::string(joint.name).find('@') != std::string::npos;
  };
  for (std::size_t k = 0; k < hierarchy.joints.size();) {
    std::size_t end = k + 1;
    if (!isSided(hierarchy.joints[k])) {
      add(hierarchy.joints[k], true);
    } else {
      while (end < hierarchy.joints.size() && isSided(hierarchy.joints[end])) ++end;
      for (const bool isLeft : {true, false})
        for (std::size_t j = k; j < end; ++j) add(hierarchy.joints[j], isLeft);
    }
    k = end;
  }
  return joints;
}

}  // namespace ringlet::test
