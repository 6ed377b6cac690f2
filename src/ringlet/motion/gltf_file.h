// GltfFile: what moves in a glTF 2.0 file: its nodes, their animations, the skins, meshes and cameras they
// carry; and the way of one of its nodes through the world. Everything is checked when it is read, so nothing
// here points beyond anything. Pictures and materials are not looked at.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/motion/affine.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/scene/keyframes.h"

namespace ringlet {

struct GltfNode {
  std::string name;                   // may be empty, or another's too
  std::optional<std::size_t> parent;  // nodes without one stand in the world
  Vec3d translation, scale{1, 1, 1};
  Quatd rotation;
  std::optional<Affine> matrix;  // in place of the three; such a node is not animated
  std::optional<std::size_t> mesh, skin, camera;
  std::vector<double> weights{};  // of its mesh's morph targets; none: the mesh's own
};

/// One quantity of one node over time.
struct GltfChannel {
  enum class Path { translation, rotation, scale, weights };
  enum class Interpolation { linear, step, cubicSpline };

  std::size_t node = 0;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> seconds;  // at least one, none before the one before it
  std::vector<double> values;   // of key k: `width`; cubicSpline: tangent in, value, tangent out
  std::size_t width = 3;        // a rotation's 4; of weights one for each morph target

  /// As appendix C of the specification says; before the first key and after the last what they hold.
  /// Rotations are of unit length. Not for weights.
  std::array<double, 4> valueAt(double t) const;
  /// The same of weights.
  std::vector<double> weightsAt(double t) const;

 private:
  template <class Values, class Linear>
  Values mixedAt(double t, const Values& zero, Linear linear) const;
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfChannel> channels;  // that move nodes
  std::vector<GltfChannel> weights;   // of morph targets
  double firstSeconds = 0;            // the earliest key of all that move nodes, and the last; of weights
  double lastSeconds = 0;             // where there are no others
  std::vector<std::array<std::optional<std::size_t>, 3>> ofNode;  // channels by node and Path
};

struct GltfSkin {
  std::vector<std::size_t> joints;   // nodes
  std::vector<Affine> inverseBinds;  // of each joint: its frame from the mesh's
};

/// All triangles of a mesh together; primitives of other modes are left out.
struct GltfMesh {
  struct Influence {
    std::uint32_t joint = 0;  // of the skin
    double weight = 0;        // above 0; of a point they sum to 1
  };

  /// Added to a point, times the target's weight.
  struct Delta {
    std::uint32_t point = 0;
    Vec3d shift{};  // not 0
  };

  std::string name;
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Influence> influences;            // point after point
  std::vector<std::uint32_t> influencesBefore;  // of point p: from [p] to [p + 1]; none: its node carries it
  std::uint32_t jointCount = 0;                 // that a skin must have at least
  std::vector<std::vector<Delta>> morphs;       // of each morph target
  std::vector<double> weights;                  // of these, at rest
  std::vector<std::string> warnings;            // about parts that were left out
  std::optional<Error> problem;                 // why it could not be read; then it is empty
};

/// Looks along its node's -Z; Y is up.
struct GltfCamera {
  std::optional<double> heightAngle;  // from top to bottom [rad]; none: it is not perspective
};

/// How a file's world lies in ours.
struct GltfPlacement {
  double metresPerUnit = 1;           // glTF is in metres
  bool upIsZ = false;                 // of ours
  FileAxis up = FileAxis::plusY;      // of the file, which glTF says
  std::optional<FileAxis> jointUp{};  // of a node's own axes, that is a groom's up; unset: as `up`
  /// Applied to the file's world.
  Affine map() const;
};

struct GltfFile {
  std::vector<GltfNode> nodes;
  std::vector<std::size_t> parentsFirst;  // all nodes
  std::vector<GltfAnimation> animations;
  std::vector<GltfSkin> skins;
  std::vector<GltfMesh> meshes;
  std::vector<GltfCamera> cameras;

  std::vector<std::string> names() const;  // of all nodes
  /// A node by its name, as findJoint does; of several with exactly that name a skin's joint goes before.
  std::optional<std::size_t> find(std::string_view name) const;
  /// By name, or by number from 0; the first for an empty word; nothing where the file has none at all and
  /// none is asked for. An Error lists what there is.
  Result<const GltfAnimation*> animationNamed(const std::string& word) const;
  /// A node's frame among its parent's, without the animation if that is null.
  Affine localAt(std::size_t node, const GltfAnimation* animation, double t) const;
  /// A node in the file's world. Cost: its depth.
  Affine worldAt(std::size_t node, const GltfAnimation* animation, double t) const;
  /// All of them. Cost: linear.
  std::vector<Affine> worldsAt(const GltfAnimation* animation, double t) const;
  /// Whether an animation has a channel of the node or of one above it.
  bool moves(std::size_t node, const GltfAnimation* animation) const;

  /// The node's poses from the animation's first key to its last, or a little beyond: its position, and the
  /// rotation nearest to its frame, as parents may be scaled. Without an animation: one pose. Keys as close
  /// as frames are taken as they are; between keys further apart it is sampled. Errors: a frame that is flat
  /// (a scale of 0) or not finite, more than a million poses.
  Result<Keyframes> motionOf(std::size_t node, const GltfAnimation* animation, const GltfPlacement& placement,
                             std::optional<double> samplesPerSecond) const;
};

/// .gltf with its buffers inside or beside it, or .glb. Errors: what TinyGLTF refuses; a buffer that is not
/// in the file's folder or below it (gltf_buffers.h); an index, accessor or buffer view beyond what there is;
/// numbers that are not finite; nodes that are their own parents; times that fall. A mesh that cannot be read
/// (Draco) is no error until it is asked for.
Result<GltfFile> readGltf(const std::filesystem::path& path);
/// `folder` is where buffers beside the file are.
Result<GltfFile> parseGltf(std::span<const std::byte> bytes, const std::filesystem::path& folder);

struct GltfMotionChoice {
  std::string node = "Head";
  std::string animation{};  // a name or a number from 0; empty: the first
  GltfPlacement placement{};
  std::optional<double> samplesPerSecond{};  // about; unset: as motionOf says
};

/// The node's motion, from the animation's first key on. The message for a node that is not there names the
/// nearest and lists those that have names.
Result<Keyframes> readGltfMotion(const std::filesystem::path& path, const GltfMotionChoice& choice = {});

}  // namespace ringlet
