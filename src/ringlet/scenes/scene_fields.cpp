// Implements scenes/scene_fields.h.
#include "ringlet/scenes/scene_fields.h"

#include <algorithm>
#include <limits>

#include "ringlet/base/assert.h"
#include "ringlet/scene/motion.h"

namespace ringlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr NumberRange kPlace{-1e6, 1e6};    // [m]
constexpr NumberRange kDegrees{-1e6, 1e6};  // any turn
constexpr NumberRange kUnit{1e-6, 1000};    // [m]
constexpr NumberRange kSeed{0, 4294967295.0};
constexpr NumberRange kShare{0, 1};
constexpr NumberRange kSeconds{0, 3600};
constexpr const char* kGenerated = "curl, swatch, head";
constexpr const char* kVarying = "swatch, head";
constexpr const char* kToAndFro = "shake, nod, walk, jump";
// A setting of a run as scene files have it, which may leave it open: then it is `standard`.
SceneField<SceneSimulation> as(std::string_view key, auto member, const char* standard = "") {
  const auto* found = fieldNamed(settingsFields(), key);
  RINGLET_ASSERT(found, "a scene's key is no setting");
  return {found->key, found->unit,    standard,       found->effect,
          member,     found->allowed, found->choices, found->onlyWith};
}

constexpr const char* kTurnHelp = "Turned about X first, then Y, then Z, the axes of what it is placed in.";

}  // namespace

std::span<const SceneField<SceneGroom>> groomFields() {
  using G = SceneGroom;
  static const SceneField<G> all[] = {
      {"file", "", "none", "The strands: a .hair, .obj, .usd or other file, as `ringlet simulate` takes it.",
       &G::file},
      {"generate",
       "",
       "none",
       "In place of a file: what `ringlet make` makes.",
       &G::generate,
       {},
       kGenerated},
      {"unit", "m", "what a USD file states, else 0.01",
       "Metres per unit of the file, and of what is written.", &G::metresPerUnit, kUnit},
      {"up",
       "",
       "",
       "The axis of the groom that points up; all positions of the scene are along its axes.",
       &G::up,
       {},
       "Y, Z"},
      {"scale",
       "1",
       "",
       "Size of the groom in the head's frame, a factor on the file's.",
       &G::scale,
       {1e-6, 1e6}},
      {"rotate_degrees", "deg", "",
       "How the groom is turned in the head's frame, about X first, then Y, then Z.", &G::rotateDegrees,
       kDegrees},
      {"offset", "m", "", "How the groom is then moved in the head's frame.", &G::offset, kPlace},
      {"strands", "", "", "How many.", &G::strands, {1, 1e6}, "", "head"},
      {"particles",
       "",
       "",
       "Of each strand; a curl keeps its shape from four a turn on.",
       &G::particles,
       {2, 65536},
       "",
       kGenerated},
      {"columns", "", "", "Curls along X.", &G::columns, {1, 10000}, "", "swatch"},
      {"rows", "", "", "Curls along Z.", &G::rows, {1, 10000}, "", "swatch"},
      {"spacing", "m", "", "Distance between neighbours.", &G::spacing, {1e-6, 10}, "", "swatch"},
      {"scalp_radius", "m", "", "Radius of the head.", &G::scalpRadius, {1e-6, 10}, "", "head"},
      {"radius", "m", "", "Radius of a curl.", &G::radius, {1e-6, 1}, "", kGenerated},
      {"turns",
       "",
       "",
       "Of a curl, from root to tip; 0 for straight hair.",
       &G::turns,
       {0, 1000},
       "",
       kGenerated},
      {"length", "m", "", "Of a curl, not of its wound strand.", &G::length, {1e-6, 10}, "", kGenerated},
      {"phase", "rad", "", "Where about its axis a curl begins.", &G::phase, {-1e6, 1e6}, "", kGenerated},
      {"hand", "", "", "Which way curls wind.", &G::hand, {}, "right, left", kGenerated},
      {"vary_radius",
       "1",
       "",
       "Largest relative difference of the radius.",
       &G::varyRadius,
       {0, 0.9},
       "",
       kVarying},
      {"vary_length",
       "1",
       "",
       "Largest relative difference of the length.",
       &G::varyLength,
       {0, 0.9},
       "",
       kVarying},
      {"vary_phase", "1", "", "Largest difference of the phase, as a share of a turn.", &G::varyPhase, kShare,
       "", kVarying},
      {"other_hand", "1", "", "Share of strands that wind the other way.", &G::otherHand, kShare, "",
       kVarying},
      {"seed", "", "", "Another seed, another groom.", &G::seed, kSeed, "", kVarying},
  };
  return all;
}

std::span<const SceneField<SceneMotion>> motionFields() {
  using M = SceneMotion;
  static const SceneField<M> all[] = {
      {"kind",
       "",
       "none",
       "A built-in motion; with none of kind, file and keys the head is still.",
       &M::kind,
       {},
       motionNames()},
      {"amplitude",
       "m, rad or rad/s",
       "the kind's",
       "Its size: shake, walk, jump m; nod, turn, whip rad; spin rad/s; glide m/s.",
       &M::amplitude,
       {-1000, 1000},
       "",
       "shake, nod, spin, glide, walk, turn, jump, whip"},
      {"frequency",
       "Hz",
       "the kind's",
       "How often: shakes, nods, jumps, strides.",
       &M::frequency,
       {0, 1000},
       "",
       kToAndFro},
      {"axis",
       "",
       "the kind's",
       "Direction of travel, or axis of turning; of any length above 0.",
       &M::axis,
       {-1e6, 1e6},
       "",
       "shake, nod, spin, glide, walk, turn, jump, whip"},
      {"ease", "s", "the kind's",
       "The size grows smoothly from 0 over this time; a turn takes it, a whip twice.", &M::easeSeconds,
       kSeconds, "", "shake, nod, spin, walk, turn, jump, whip"},
      {"until",
       "s",
       "never",
       "Over by then, eased out as it eased in.",
       &M::untilSeconds,
       {0, kInfinity},
       "",
       kToAndFro},
      {"file", "", "none",
       "In place of a kind: a .bvh, .gltf or .glb file, whose joint is followed through the world.",
       &M::file},
      {"joint", "", "", "Joint of the file; glTF calls it a node.", &M::joint, {}, "", "file"},
      {"animation",
       "",
       "the first",
       "Of a glTF file: which, by name or number from 0.",
       &M::animation,
       {},
       "",
       "file"},
      {"unit", "m", "a BVH skeleton is 1.7 m tall, glTF is in metres", "Metres per unit of the file.",
       &M::metresPerUnit, kUnit, "", "file"},
      {"skip_frames",
       "",
       "",
       "Frames at the start of the file to leave out, as a T-pose is.",
       &M::skipFrames,
       {0, 1e6},
       "",
       "file"},
      {"interpolation",
       "",
       "",
       "Between keys: cubic passes them without a jolt, linear goes straight.",
       &M::interpolation,
       {},
       "cubic, linear",
       "keys"},
      {"start", "m", "", "Added to every position.", &M::start, kPlace},
  };
  return all;
}

std::span<const SceneField<SceneMotion>> headMotionFields() {
  using M = SceneMotion;
  static const SceneField<M> all[] = {
      {"pre_roll", "s", "", "How long hair moves before the first frame, so that it begins settled.",
       &M::preRollSeconds, kSeconds},
  };
  return all;
}

std::span<const SceneField<SceneKeyframe>> keyframeFields() {
  using K = SceneKeyframe;
  static const SceneField<K> all[] = {
      {"time", "s", "required", "When; later than that of the key before.", &K::time, {-1e6, 1e6}},
      {"position", "m", "", "Where.", &K::position, kPlace},
      {"rotate_degrees", "deg", "[0, 0, 0]", kTurnHelp, &K::rotateDegrees, kDegrees},
      {"quaternion",
       "",
       "none",
       "[x, y, z, w] in place of rotate_degrees, of any length above 0.",
       &K::quaternion,
       {-1e6, 1e6}},
  };
  return all;
}

std::span<const SceneField<SceneRoots>> rootsFields() {
  using R = SceneRoots;
  static const SceneField<R> all[] = {
      {"shift", "m", "",
       "How far the roots of the first half of the strands go beside the head; the others' go the other way.",
       &R::shift, kPlace},
      {"frequency", "Hz", "", "To and fro as a sine; 0: there, and stays.", &R::frequency, {0, 1000}},
      {"ease", "s", "", "The shift grows smoothly from 0 over this time, and shrinks so at the end.",
       &R::easeSeconds, kSeconds},
      {"until",
       "s",
       "",
       "Roots are back in their places by then; inf: never.",
       &R::untilSeconds,
       {0, kInfinity}},
  };
  return all;
}

std::span<const SceneField<SceneScalp>> scalpFields() {
  using S = SceneScalp;
  static const SceneField<S> all[] = {
      {"file", "", "required",
       "A .gltf or .glb file with the mesh that roots follow, each the triangle nearest to it; the same as "
       "motion.file where the head follows a joint of it.",
       &S::file},
      {"mesh", "", "the only one", "Node that has the mesh, or the mesh's own name.", &S::mesh},
      {"animation", "", "the head's where it is the same file, else the first",
       "Which, by name or number from 0.", &S::animation},
      {"unit", "m", "the head's where it is the same file, else glTF's metre", "Metres per unit of the file.",
       &S::metresPerUnit, kUnit},
      {"farthest",
       "m",
       "",
       "A root further than this from every triangle is refused.",
       &S::farthest,
       {0, 1000}},
      {"start",
       "s",
       "",
       "When the animation's first key is; roots are bound there and then, with the head at its pose of that "
       "time, "
       "and go with the head before.",
       &S::start,
       {-3600, 3600}},
  };
  return all;
}

std::span<const SceneField<SceneSimulation>> simulationFields() {
  using S = SceneSimulation;
  static const SceneField<S> all[] = {
      as("fps", &S::framesPerSecond),
      {"frames", "", "48, or the length of the motion's file or keys", "How many.", &S::frames, {1, 1e6}},
      {"seconds", "s", "none", "In place of frames: how long.", &S::seconds, {0.001, 36000}},
      as("steps_per_frame", &S::stepsPerFrame, "enough for this groom and material"),
      {"gravity", "m/s^2", "", "Downwards.", &S::gravity, {-1000, 1000}},
      as("preload", &S::preload, "1; 0 for paper"),
      as("max_stretch", &S::maxStretch, "1 + material.dials.bounce"),
      as("teleport_distance", &S::teleportDistance),
      as("sleep_speed", &S::sleepSpeed),
      as("roots", &S::roots),
      {"integrator",
       "",
       "",
       "How a step finds the new velocities.",
       &S::integrator,
       {},
       "jacobi, point_jacobi, paper"},
      as("iterations", &S::iterations),
      as("chebyshev", &S::chebyshev),
      as("force_loops", &S::forceLoops),
      as("damping_loops", &S::dampingLoops),
  };
  return all;
}

std::span<const SceneField<SceneBody>> bodyFields() {
  using B = SceneBody;
  static const SceneField<B> all[] = {
      {"name", "", "its number", "For messages.", &B::name},
      {"shape",
       "",
       "required",
       "A plane is the half space below Y = 0, a capsule's line is along Y; all are solid.",
       &B::shape,
       {},
       "sphere, capsule, plane, box, mesh"},
      {"radius",
       "m",
       "",
       "Of a sphere, or about a capsule's line.",
       &B::radius,
       {1e-6, 1000},
       "",
       "sphere, capsule"},
      {"length",
       "m",
       "",
       "Of a capsule's line, its middle at the origin.",
       &B::length,
       {0, 1000},
       "",
       "capsule"},
      {"half_extents",
       "m",
       "",
       "Of a box, to either side of the origin.",
       &B::halfExtents,
       {1e-6, 1000},
       "",
       "box"},
      {"file",
       "",
       "none",
       "The mesh: an .obj file of closed surfaces, or a .gltf or .glb whose only mesh is taken as it is at "
       "its first key.",
       &B::file,
       {},
       "",
       "mesh"},
      {"generate",
       "",
       "none",
       "In place of a file: the mesh of the generated head.",
       &B::generate,
       {},
       "head",
       "mesh"},
      {"unit", "m", "the groom's; glTF is in metres", "Metres per unit of the mesh's file.",
       &B::metresPerUnit, kUnit, "", "mesh"},
      {"cells",
       "",
       "",
       "Of the mesh's distance grid, along its longest side: more is finer and slower to make.",
       &B::cells,
       {8, 256},
       "",
       "mesh"},
      {"scale", "1", "", "Size of the mesh, a factor on the file's.", &B::scale, {1e-6, 1e6}, "", "mesh"},
      {"thickness", "m", "", "Hair keeps this much further away.", &B::thickness, kShare},
      {"friction", "1", "", "Coulomb's coefficient of hair on it.", &B::friction, {0, 100}},
      {"position", "m", "", "Where its origin is, in the frame of what carries it.", &B::position, kPlace},
      {"rotate_degrees", "deg", "", kTurnHelp, &B::rotateDegrees, kDegrees},
      {"joint", "", "none", "The joint of the head's motion file that carries it, in place of the head.",
       &B::joint},
  };
  return all;
}

std::span<const SceneField<SceneOutput>> outputFields() {
  using O = SceneOutput;
  static const SceneField<O> all[] = {
      {"folder", "", "none; -o says it", "For the results, made if it is not there.", &O::folder},
      {"width", "m", "", "Diameter of strands in hair.usda and hair.rgc.", &O::width, {1e-9, 1}},
      {"files", "", "all", "What is written.", &O::files, {}, "hair.usda, last.obj, sheet.png"},
      {"cache",
       "",
       "none",
       "Writes the animation as hair.rgc too, with this precision.",
       &O::cache,
       {},
       "float32, 16bit"},
  };
  return all;
}

}  // namespace ringlet
