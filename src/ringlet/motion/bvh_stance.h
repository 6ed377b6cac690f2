// How the person of a BVH file stands: which of the file's axes is up, and how tall the person is. A file
// says neither; its frames show both. The offsets of its joints do not: many programs lay bones along their
// own axes, so that the pose at zero angles stands nowhere.
//
// The trunk is the way from the hips to the head, and the person the trunk, the head and the legs; arms are
// left out, which may be raised. Of up to 200 frames:
//
//   up      the axis along which the trunk lies in most frames. Y, or the axis along which the skeleton
//           stands at zero angles, is up where a fifth of the frames say so: people lie down and get up. Not
//           so where these frames lie on the floor of another axis that a fifth of the frames say is up.
//           Where none does, the person lies, or another axis is up. That other axis is taken where the feet
//           are at its 0, as on a floor, or where nothing stands at zero angles; else the person is taken to
//           lie.
//   height  the median over the frames in which the person stands: the trunk along the up axis, and the
//           person's extent along it 0.85 to 1.15 times the straightened length. Where there is none
//           (sitting, lying): the straightened length itself, the trunk's and that of the legs' bones. Where
//           a person with legs ends at the joint of its head, an eighth of what is below it is added.
#pragma once

#include <cstddef>
#include <optional>

#include "ringlet/motion/bvh_file.h"
#include "ringlet/motion/file_axis.h"

namespace ringlet {

struct BvhStance {
  enum class Sight {
    stated,   // the axis was given
    unseen,   // no head above hips: Y is taken
    upright,  // along `up`, which is Y or where the skeleton stands at zero angles
    taken,    // along `up`, which nothing else confirms
    lying,    // along `along`, and `up` is taken for up
  };
  Sight sight = Sight::unseen;
  FileAxis up = FileAxis::plusY;
  FileAxis along = FileAxis::plusY;  // of the trunk in most frames
  bool hasTrunk = false;             // hips and a head apart from them
  bool hasLegs = false;
  bool everStands = false;
  double height = 0;     // in the file's unit; 0 for a skeleton of one point
  double addedHead = 0;  // of it, what is not in the file
};

/// Of the frames from a first one on, which must be there; `stated`: the up axis, where it is known; `head`:
/// the joint that is the head where none is called head or neck. Cost: linear in joints.
BvhStance stanceOf(const BvhFile& file, std::size_t firstFrame, std::optional<FileAxis> stated,
                   std::optional<std::size_t> head = {});

}  // namespace ringlet
