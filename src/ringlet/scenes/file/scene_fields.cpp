// Implements scenes/file/scene_fields.h.
#include "ringlet/scenes/file/scene_fields.h"

#include <algorithm>
#include <limits>

#include "ringlet/base/assert.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/motion/file_axis.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/load/scene_maps.h"

namespace ringlet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr NumberRange kDegrees{-1e6, 1e6};  // any turn
constexpr NumberRange kUnit{1e-6, 1000};    // [m]
constexpr NumberRange kSeconds{0, 3600};
constexpr NumberRange kBindFrames{1, 1e6};
constexpr NumberRange kStartFrames{1, 1e9};
constexpr NumberRange kPointsPerStrand{2, kMostPointsPerStrand};
constexpr NumberRange kGuides{1, 1e6};
constexpr const char* kGenerated = "curl, swatch, head";
constexpr const char* kVarying = "swatch, head";
constexpr const char* kToAndFro = "shake, nod, walk, jump";
// The files that a run may write: animations, but for the cache, whose precision is a key of its own; and
// others.
std::string outputFiles() {
  std::string files;
  for (const AnimationFormat& format : animationFormats())
    if (!format.hasPrecisions) files += std::string("hair") + format.extension + ", ";
  return files + "last.obj, sheet.png";
}

// A setting of a run as scene files have it, which may leave it open: then it is `standard`.
SceneField<SceneSimulation> as(std::string_view key, auto member, const char* standard = "") {
  const auto* found = fieldNamed(settingsFields(), key);
  RINGLET_ASSERT(found, "a scene's key is no setting");
  return {found->key, found->unit,    standard,       found->effect,
          member,     found->allowed, found->choices, found->onlyWith};
}

constexpr const char* kTurnHelp = "Rotation about X, then Y, then Z, the axes of the frame it is placed in.";

}  // namespace

std::span<const SceneField<SceneGroom>> groomFields() {
  using G = SceneGroom;
  static const SceneField<G> all[] = {
      {"file", "", "none",
       "File of the strands: .hair, .obj, .usd, .abc or another format that `ringlet simulate` reads.",
       &G::file},
      {"generate",
       "",
       "none",
       "Generated groom in place of a file, as `ringlet make` makes it.",
       &G::generate,
       {},
       kGenerated},
      {"unit", "m", "what the file states, else 0.01: centimetres",
       "Metres per unit of the file and of the results.", &G::metresPerUnit, kUnit},
      {"up",
       "",
       "",
       "Up axis of the groom. All positions of the scene are along the groom's axes.",
       &G::up,
       {},
       "Y, Z"},
      {"root_end",
       "",
       "",
       "Which end of each strand of the file is its root: its first point, its last, or of each the one on "
       "the head, a ball on which most strands have an end.",
       &G::rootEnd,
       {},
       "first, last, head",
       "file"},
      {"points_per_strand", "", "none",
       "Points of each strand, of a file that holds points and nothing else.", &G::pointsPerStrand,
       kPointsPerStrand, "", "file"},
      {"guides", "", "none",
       "Number of the groom's strands that are simulated: its guides, which are picked. All its hairs follow "
       "them, keep their own shape beside them, and are what is written. None: every strand is simulated.",
       &G::guides, kGuides},
      {"guides_file", "", "none", "File of the guides, in place of picked ones: in the groom's frame.",
       &G::guidesFile},
      {"guides_primvar",
       "",
       "none",
       "Primvar of the groom's file, such as groom_guide, that is not 0 for the strands that are guides.",
       &G::guidesPrimvar,
       {},
       "",
       "file"},
      {"guides_sample",
       "",
       "",
       "Number of hairs that are simulated beside the guides, to measure how far hairs that follow are from "
       "where they would be: follow_error of the report.",
       &G::guidesSample,
       {0, 1e6}},
      {"scale",
       "1",
       "",
       "Scale of the groom in the head's frame, relative to the file.",
       &G::scale,
       {1e-6, 1e6}},
      {"rotate_degrees", "deg", "", "Rotation of the groom in the head's frame, about X, then Y, then Z.",
       &G::rotateDegrees, kDegrees},
      {"offset", "m", "", "Translation of the groom in the head's frame, after its rotation.", &G::offset,
       kPlace},
      {"bind",
       "",
       "",
       "head: the groom is in the frame of the head's joint. world: it stands where it was modelled at the "
       "bind frame, whatever axes the joint has.",
       &G::bind,
       {},
       "head, world"},
      {"bind_frame", "", "",
       "Frame of the motion, at the run's fps, at which what is bound to the world stands so; 1 is its first "
       "pose.",
       &G::bindFrame, kBindFrames},
      {"style",
       "",
       "none",
       "Hair style: sets length, radius, turns, locks and [groom.cut], whose keys beside it go before.",
       &G::style,
       {},
       kHairStyles,
       "head"},
      {"strands", "", "", "Number.", &G::strands, {1, 1e6}, "", "head"},
      {"locks",
       "",
       "",
       "Number of locks, of strands that wind alike; 0: every strand is a curl of its own.",
       &G::locks,
       {0, 10000},
       "",
       "head"},
      {"particles",
       "",
       "",
       "Particles of a strand. A curl needs four a turn to keep its shape.",
       &G::particles,
       {2, 65536},
       "",
       kGenerated},
      {"columns", "", "", "Number of curls along X.", &G::columns, {1, 10000}, "", "swatch"},
      {"rows", "", "", "Number of curls along Z.", &G::rows, {1, 10000}, "", "swatch"},
      {"spacing", "m", "", "Distance between neighbouring roots.", &G::spacing, {1e-6, 10}, "", "swatch"},
      {"scalp_radius", "m", "", "Radius of the scalp.", &G::scalpRadius, {1e-6, 10}, "", "head"},
      {"scalp",
       "",
       "a sphere",
       "Mesh on which hair grows above the hairline: an OBJ file in the groom's unit, about the origin.",
       &G::scalp,
       {},
       "",
       "head"},
      {"radius", "m", "", "Radius of a curl.", &G::radius, {1e-6, 1}, "", kGenerated},
      {"turns",
       "",
       "",
       "Turns of a curl from root to tip; 0 for straight hair.",
       &G::turns,
       {0, 1000},
       "",
       kGenerated},
      {"length",
       "m",
       "",
       "Length of a curl along its axis; its strand is longer.",
       &G::length,
       {1e-6, 10},
       "",
       kGenerated},
      {"phase",
       "rad",
       "",
       "Angle about its axis at which a curl begins.",
       &G::phase,
       {-1e6, 1e6},
       "",
       kGenerated},
      {"hand", "", "", "Handedness of the curls.", &G::hand, {}, "right, left", kGenerated},
      {"vary_radius",
       "1",
       "",
       "Largest relative variation of the radius.",
       &G::varyRadius,
       {0, 0.9},
       "",
       kVarying},
      {"vary_length",
       "1",
       "",
       "Largest relative variation of the length.",
       &G::varyLength,
       {0, 0.9},
       "",
       kVarying},
      {"vary_phase", "1", "", "Largest variation of the phase, as a share of a turn.", &G::varyPhase,
       kShareRange, "", kVarying},
      {"other_hand", "1", "", "Share of strands with the other handedness.", &G::otherHand, kShareRange, "",
       kVarying},
      {"seed", "", "", "Seed of the variation.", &G::seed, kSeedRange, "", kVarying},
  };
  return all;
}

std::span<const SceneField<SceneMotion>> motionFields() {
  using M = SceneMotion;
  static const SceneField<M> all[] = {
      {"kind",
       "",
       "none",
       "Built-in motion. Without kind, file or keys the head is still.",
       &M::kind,
       {},
       motionNames()},
      {"amplitude",
       "m, rad or rad/s",
       "the kind's",
       "Amplitude: of shake, walk and jump in m; of nod, turn and whip in rad; of spin in rad/s; of glide in "
       "m/s.",
       &M::amplitude,
       {-1000, 1000},
       "",
       "shake, nod, spin, glide, walk, turn, jump, whip"},
      {"frequency",
       "Hz",
       "the kind's",
       "Shakes, nods, jumps or strides per second.",
       &M::frequency,
       {0, 1000},
       "",
       kToAndFro},
      {"axis",
       "",
       "the kind's",
       "Direction of travel or axis of rotation, of any length above 0.",
       &M::axis,
       {-1e6, 1e6},
       "",
       "shake, nod, spin, glide, walk, turn, jump, whip"},
      {"ease", "s", "the kind's",
       "Time over which the amplitude grows smoothly from 0. A turn lasts this long, a whip twice as long.",
       &M::easeSeconds, kSeconds, "", "shake, nod, spin, walk, turn, jump, whip"},
      {"until",
       "s",
       "never",
       "Time at which the motion has ended; it eases out as it eased in.",
       &M::untilSeconds,
       {0, kInfinity},
       "",
       kToAndFro},
      {"file", "", "none",
       "A .bvh, .gltf, .glb or .vrm file in place of a kind. The head follows a joint of it in world space.",
       &M::file},
      {"joint", "", "", "Joint of the file (a node in glTF).", &M::joint, {}, "", "file"},
      {"animation",
       "",
       "the first",
       "Animation of a glTF file, by name or number from 0.",
       &M::animation,
       {},
       "",
       "file"},
      {"unit", "m", "a BVH person is 1.7 m tall, glTF is in metres", "Metres per unit of the file.",
       &M::metresPerUnit, kUnit, "", "file"},
      {"up",
       "",
       "the axis along which a BVH person stands; glTF's is Y",
       "Up axis of the file, which is turned to the groom's.",
       &M::up,
       {},
       kFileAxisNames,
       "file"},
      {"skip_frames",
       "",
       "",
       "Frames to leave out at the start of the file, such as a T-pose.",
       &M::skipFrames,
       {0, 1e6},
       "",
       "file"},
      {"interpolation",
       "",
       "",
       "Interpolation between keys: cubic has continuous velocity, linear is piecewise straight.",
       &M::interpolation,
       {},
       "cubic, linear",
       "keys"},
      {"start", "m", "", "Offset that is added to every position.", &M::start, kPlace},
  };
  return all;
}

std::span<const SceneField<SceneMotion>> headMotionFields() {
  using M = SceneMotion;
  static const SceneField<M> all[] = {
      {"pre_roll", "s", "", "Time that is simulated before the first frame, so that hair begins settled.",
       &M::preRollSeconds, kSeconds},
  };
  return all;
}

std::span<const SceneField<SceneKeyframe>> keyframeFields() {
  using K = SceneKeyframe;
  static const SceneField<K> all[] = {
      {"time", "s", "required", "Time of the key, later than that of the key before.", &K::time, {-1e6, 1e6}},
      {"position", "m", "", "Position at that time.", &K::position, kPlace},
      {"rotate_degrees", "deg", "[0, 0, 0]", kTurnHelp, &K::rotateDegrees, kDegrees},
      {"quaternion",
       "",
       "none",
       "Rotation as [x, y, z, w] in place of rotate_degrees, of any length above 0.",
       &K::quaternion,
       {-1e6, 1e6}},
  };
  return all;
}

std::span<const SceneField<SceneRoots>> rootsFields() {
  using R = SceneRoots;
  static const SceneField<R> all[] = {
      {"shift", "m", "",
       "Displacement of the roots of the first half of the strands, relative to the head; the other half "
       "moves in the opposite direction.",
       &R::shift, kPlace},
      {"frequency",
       "Hz",
       "",
       "Frequency of a sine motion; 0: the roots move there once and stay.",
       &R::frequency,
       {0, 1000}},
      {"ease", "s", "", "Time over which the displacement grows smoothly from 0, and shrinks at the end.",
       &R::easeSeconds, kSeconds},
      {"until",
       "s",
       "",
       "Time at which the roots are back in place; inf: never.",
       &R::untilSeconds,
       {0, kInfinity}},
  };
  return all;
}

std::span<const SceneField<SceneStart>> startFields() {
  using S = SceneStart;
  static const SceneField<S> all[] = {
      {"from", "", "none: at rest",
       "Another run, whose hair this one begins with: the folder or file of an animation, of Ringlet or of another "
       "program, with the groom's strands. Places and velocities are those seen from the head, which its roots "
       "say.",
       &S::from},
      {"frame", "", "the last", "Frame of that run, from 1.", &S::frame, kStartFrames},
      {"blend",
       "",
       "",
       "Frames over which hair is held to the shape it began with, ever less: for a groom of another rest shape. "
       "Its own motion is damped meanwhile.",
       &S::blend,
       {0, 1e6}},
  };
  return all;
}

std::span<const SceneField<SceneScalp>> scalpFields() {
  using S = SceneScalp;
  static const SceneField<S> all[] = {
      {"file", "", "none",
       "File of the mesh whose nearest triangles the roots follow: a .gltf, .glb or .vrm file, which may be "
       "motion.file where the head follows a joint of it; a .usda, .usdc, .usd, .usdz or .abc file whose mesh "
       "moves; an .obj file with a cache; or a sequence of .obj files, as body.####.obj, where each # stands "
       "for a digit of the frame's number.",
       &S::file},
      {"body", "", "none", "In place of a file: name of a body that deforms, whose mesh it is.", &S::body},
      {"cache", "", "none",
       "Point cache of an .obj file, .pc2 or .mdd: its points over time, in the same order, in the world.",
       &S::cache},
      {"mesh", "", "the only one",
       "Name of the mesh: glTF's own or its node's; a USD prim's or an Alembic object's name or path.",
       &S::mesh},
      {"animation", "", "the head's where it is the same file, else the first",
       "glTF: animation, by name or number from 0.", &S::animation},
      {"unit", "m", "the head's where it is the same file, else the file's; the groom's of .obj and .abc",
       "Metres per unit of the file.", &S::metresPerUnit, kUnit},
      {"up",
       "",
       "the head's where it is the same file, else the file's; the groom's of .obj and .abc",
       "The axis of the file that points up.",
       &S::up,
       {},
       kFileAxisNames},
      {"cache_fps",
       "1/s",
       "the run's",
       "Frames per second of a .pc2 file or a sequence.",
       &S::framesPerSecond,
       {0.001, 1e6}},
      {"farthest",
       "m",
       "",
       "Largest distance of a root from its triangle; a root farther away is refused.",
       &S::farthest,
       {0, 1000}},
      {"start",
       "s",
       "",
       "Time of the first key, sample or file. Roots are bound at that time, at the head's pose of that time; "
       "before it they move with the head.",
       &S::start,
       {-3600, 3600}},
  };
  return all;
}

std::span<const SceneField<SceneSimulation>> simulationFields() {
  using S = SceneSimulation;
  static const SceneField<S> all[] = {
      as("fps", &S::framesPerSecond),
      {"frames",
       "",
       "48, or the length of the motion's file or keys",
       "Number of frames.",
       &S::frames,
       {1, 1e6}},
      {"seconds", "s", "none", "Length of the run, in place of frames.", &S::seconds, {0.001, 36000}},
      as("steps_per_frame", &S::stepsPerFrame, "enough for this groom and material"),
      {"gravity", "m/s^2", "", "Gravity against the up axis.", &S::gravity, {-1000, 1000}},
      as("preload", &S::preload, "1; 0 for paper"),
      as("max_stretch", &S::maxStretch),
      as("teleport_distance", &S::teleportDistance),
      as("sleep_speed", &S::sleepSpeed),
      as("roots", &S::roots),
      {"integrator",
       "",
       "",
       "Scheme by which a step finds the new velocities.",
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
  using F = SceneField<B>;
  static const std::vector<F> all = [] {
    std::vector<F> fields{
        {.key = "name",
         .unit = "",
         .standard = "its number",
         .effect = "Name for messages.",
         .member = &B::name},
        {.key = "shape",
         .unit = "",
         .standard = "required",
         .effect =
             "Shape of the solid. A plane is the half space below Y = 0; the axis of a capsule is along Y.",
         .member = &B::shape,
         .choices = shapeNames()}};
    for (const SettingField<Body>& number : bodyNumbers()) fields.push_back(number.of<B>());
    const F others[] = {
        {.key = "file",
         .unit = "",
         .standard = "none",
         .effect =
             "File of closed surfaces: an .obj file, or a .gltf, .glb, .vrm, .usda, .usdc, .usd, .usdz or "
             ".abc file, of which a mesh is taken as it is at its first key or sample.",
         .member = &B::file,
         .onlyWith = "mesh"},
        {.key = "mesh",
         .unit = "",
         .standard = "the only one",
         .effect =
             "Name of the mesh: glTF's own or its node's; a USD prim's or an Alembic object's name or path.",
         .member = &B::mesh,
         .onlyWith = "mesh"},
        {.key = "generate",
         .unit = "",
         .standard = "none",
         .effect =
             "Generated mesh in place of a file: the head of generated grooms; a bust that nods and shrugs, "
             "with deforms; or the cape that it wears, with sides = \"both\", too.",
         .member = &B::generate,
         .choices = "head, bust, cape",
         .onlyWith = "mesh"},
        {.key = "unit",
         .unit = "m",
         .standard = "the groom's of .obj and .abc, else the file's",
         .effect = "Metres per unit of the mesh's file.",
         .member = &B::metresPerUnit,
         .allowed = kUnit,
         .onlyWith = "mesh"},
        {.key = "cells",
         .unit = "",
         .standard = "",
         .effect = "Cells of the mesh's distance grid along its longest side. More cells are finer and take "
                   "longer to build.",
         .member = &B::cells,
         .allowed = {8, 256},
         .onlyWith = "mesh"},
        {.key = "scale",
         .unit = "1",
         .standard = "",
         .effect = "Scale of the mesh, relative to the file.",
         .member = &B::scale,
         .allowed = {1e-6, 1e6},
         .onlyWith = "mesh"},
        {.key = "deforms",
         .unit = "",
         .standard = "",
         .effect =
             "Whether the mesh bends, as its file says: a skin, morph targets, samples of points, a cache or a "
             "sequence, as scalp.file. Its points are in the world; what carries the body is only what its "
             "grid moves with.",
         .member = &B::deforms,
         .onlyWith = "mesh"},
        {.key = "cache",
         .unit = "",
         .standard = "none",
         .effect = "Point cache of an .obj file that deforms, .pc2 or .mdd.",
         .member = &B::cache,
         .onlyWith = "mesh"},
        {.key = "cache_fps",
         .unit = "1/s",
         .standard = "the run's",
         .effect = "Frames per second of a .pc2 file or a sequence.",
         .member = &B::framesPerSecond,
         .allowed = {0.001, 1e6},
         .onlyWith = "mesh"},
        {.key = "animation",
         .unit = "",
         .standard = "the head's where it is the same file, else the first",
         .effect = "glTF: animation of a mesh that deforms, by name or number from 0.",
         .member = &B::animation,
         .onlyWith = "mesh"},
        {.key = "start",
         .unit = "s",
         .standard = "",
         .effect =
             "Time of the first key, sample or file of a mesh that deforms; before it the mesh moves with what "
             "carries the body.",
         .member = &B::start,
         .allowed = {-3600, 3600},
         .onlyWith = "mesh"},
        {.key = "region",
         .unit = "",
         .standard = "",
         .effect =
             "Part of a mesh that deforms that has a grid, and so holds hair off. hair: where hair comes to that "
             "is as far from its roots as the longest strand is long.",
         .member = &B::region,
         .choices = "hair, all",
         .onlyWith = "mesh"},
        {.key = "sides",
         .unit = "",
         .standard = "",
         .effect =
             "Sides of a mesh that deforms that hold hair off. out: those its triangles face; it is closed. both: "
             "it is cloth, open or closed, which has no grid (cells, region), and keeps thickness, at least 0.0005 m.",
         .member = &B::sides,
         .choices = "out, both",
         .onlyWith = "mesh"},
        {.key = "position",
         .unit = "m",
         .standard = "",
         .effect = "Position of its origin, in the frame that carries it.",
         .member = &B::position,
         .allowed = kPlace},
        {.key = "rotate_degrees",
         .unit = "deg",
         .standard = "",
         .effect = kTurnHelp,
         .member = &B::rotateDegrees,
         .allowed = kDegrees},
        {.key = "bind",
         .unit = "",
         .standard = "",
         .effect =
             "carrier: the body is in the frame that carries it. world: it stands where it is placed in "
             "the world at the bind frame, whatever axes its carrier has.",
         .member = &B::bind,
         .choices = "carrier, world"},
        {.key = "bind_frame",
         .unit = "",
         .standard = "the groom's",
         .effect = "Frame of the motion at which it stands so; 1 is its first pose.",
         .member = &B::bindFrame,
         .allowed = kBindFrames},
        {.key = "joint",
         .unit = "",
         .standard = "none",
         .effect =
             "Joint of the head's motion file that carries it, in place of the head; the grid of a mesh that "
             "deforms in place of what most of it moves with.",
         .member = &B::joint},
    };
    fields.insert(fields.end(), std::begin(others), std::end(others));
    return fields;
  }();
  return all;
}

std::span<const SceneField<SceneMap>> mapFields() {
  using M = SceneMap;
  static const std::string numbers = [] {
    std::string list;
    for (const auto& parameter : mappedParameters()) list += std::string(parameter.key) + ", ";
    for (const std::string_view other : kOtherMaps) list += std::string(other) + ", ";
    return list.substr(0, list.size() - 2);
  }();
  static const SceneField<M> all[] = {
      {"number",
       "",
       "none",
       "Number of the material that differs from strand to strand; or the strength of [goal], the radius in "
       "contacts, the width in pictures and USD files; of hairs that follow the share that is there (up to "
       "1), and `clump`.",
       &M::number,
       {},
       numbers},
      {"preset",
       "",
       "none",
       "In place of a number: all numbers that may differ are as this preset has them, for `strands`.",
       &M::preset,
       {},
       "straight, wavy, loose_curl, ringlet, coil"},
      {"file", "", "none",
       "Factors on the number: lines strand,factor, strands numbered from 0 in groom order; others keep 1.",
       &M::file},
      {"strands", "", "none",
       "In place of a file: the strands, as \"0:99, 120\", from 0 in groom order, or names of groups.",
       &M::strands},
      {"primvar", "", "none",
       "In place of a file: a primvar of a USD groom or a parameter of an Alembic one, of each curve or at its "
       "root; of a colour the mean.",
       &M::primvar},
      {"texture", "", "none", "In place of a file: a PNG file, whose grey is read at each strand's UVs.",
       &M::texture},
      {"uv", "", "", "Primvar of a USD or Alembic groom that has the UVs.", &M::uv, {}, "", "texture"},
      {"factor",
       "1",
       "",
       "Factor on the number for the strands.",
       &M::factor,
       {kLeastStrandFactor, kMostStrandFactor},
       "",
       "strands"},
      {"low",
       "1",
       "",
       "Factor where the primvar or the texture is 0; at least 0.001.",
       &M::low,
       {0, kMostStrandFactor},
       "",
       "primvar, texture"},
      {"high", "1", "", "Factor where it is 1.", &M::high, {0, kMostStrandFactor}, "", "primvar, texture"},
  };
  return all;
}

std::span<const SceneField<HairCut>> cutFields() {
  using C = HairCut;
  static const SceneField<C> all[] = {
      {"hairline",
       "",
       "",
       "Where hair begins: a cap, or with bays at the temples and room for the ears.",
       &C::hairline,
       {},
       kHairlines},
      {"parting",
       "",
       "",
       "Parting, on the head's own left, middle or right; hair falls to either side.",
       &C::parting,
       {},
       kPartings},
      {"fringe",
       "m",
       "",
       "Length of hair above the brow that is combed over it; 0: no fringe.",
       &C::fringe,
       {0, 10}},
      {"top", "1", "", "Factor on the length of hair on top.", &C::top, {0.05, 10}},
      {"sides", "1", "", "Factor on the length of hair at the sides.", &C::sides, {0.05, 10}},
      {"back", "1", "", "Factor on the length of hair behind.", &C::back, {0.05, 10}},
      {"layers",
       "1",
       "",
       "Share by which hair from the crown is shorter than hair from the nape.",
       &C::layers,
       {0, 0.95}},
      {"level",
       "m",
       "ends are not cut",
       "Height below the head's middle at which ends are cut.",
       &C::level,
       {-1, 10}},
      {"straight_root", "1", "", "Share of the length before a curl begins.", &C::straightRoot, {0, 0.95}},
      {"clump",
       "1",
       "",
       "Share by which strands of a lock come together towards their tips.",
       &C::clump,
       {0, 1}},
  };
  return all;
}

std::span<const SceneField<SceneGroup>> groupFields() {
  using G = SceneGroup;
  static const SceneField<G> all[] = {
      {"name", "", "required", "Name of the group, for the strands of maps and holds.", &G::name},
      {"strands", "", "required",
       "Its strands, as \"0:99, 120\", from 0 in groom order, or groups before it.", &G::strands},
      {"touch", "", "true",
       "Whether its strands touch each other where contacts are on; false for a braid or a bun that a goal "
       "keeps.",
       &G::touch},
  };
  return all;
}

std::span<const SceneField<SceneCamera>> cameraFields() {
  using C = SceneCamera;
  static const SceneField<C> all[] = {
      {"name", "", "required", "Name for `ringlet render --camera`; of a file, the name of its node.",
       &C::name},
      {"eye", "m", "none", "Position of the camera.", &C::eye, kPlace, "", "eye"},
      {"target", "m", "", "Position it looks at.", &C::target, kPlace, "", "eye"},
      {"up", "1", "the groom's up axis", "Direction that is up in the picture.", &C::up, kPlace, "", "eye"},
      {"field_of_view",
       "deg",
       "",
       "Angle from the top of the picture to its bottom.",
       &C::fieldOfView,
       {1, 170},
       "",
       "eye"},
      {"bind",
       "",
       "",
       "Frame that eye, target and up are in: the world, or the head, with which the camera moves.",
       &C::bind,
       {},
       "world, head",
       "eye"},
      {"joint",
       "",
       "none",
       "Joint of the head's motion file in whose frame they are instead.",
       &C::joint,
       {},
       "",
       "eye"},
      {"file", "", "none",
       "File in place of eye: a .gltf, .glb or .vrm file whose camera it is, as its animation moves it.",
       &C::file},
  };
  return all;
}

std::span<const SceneField<SceneOutput>> outputFields() {
  using O = SceneOutput;
  static const SceneField<O> all[] = {
      {"folder", "", "none; -o says it", "Folder for the results; it is created if missing.", &O::folder},
      {"width", "m", "", "Diameter of strands in what is written.", &O::width, {1e-9, 1}},
      {"tip_width",
       "m",
       "as width",
       "Diameter at the tip in USD and Alembic files, metres: strands are evenly thinner from the root on.",
       &O::tipWidth,
       {1e-9, 1}},
      {"files", "", "hair.usda, last.obj, sheet.png", "Files to write.", &O::files, {}, outputFiles()},
      {"values",
       "",
       "none",
       "What USD and Alembic files have beside points and widths: a number of each strand, its rest positions, "
       "velocities (hair.usdc, hair.abc and clips only), what a USD or Alembic groom says of its curves (widths, ids, "
       "colours and other primvars), what Unreal reads of a groom (docs/unreal.md).",
       &O::values,
       {},
       "id, rest, velocities, groom, unreal"},
      {"head",
       "",
       "",
       "Where USD and Alembic files have the head's motion: in the points; in a transform beside points that are seen "
       "from the head; nowhere, where something else carries these.",
       &O::head,
       {},
       "baked, transform, none"},
      {"hairs",
       "",
       "none; the strands themselves",
       "Hairs that animations have in place of the strands, which they follow; last.obj and sheet.png show "
       "the strands.",
       &O::hairs,
       {1, 1e7}},
      {"hair_scalp", "", "none; the mesh of [scalp], else around the strands' roots",
       "Name of a [[body]] of shape mesh: these hairs' roots are on it, evenly spread where strands stand.",
       &O::hairScalp},
      {"hair_scalp_file", "", "none",
       "In place of hair_scalp: an OBJ file of the mesh, in the groom's axes and unit.", &O::hairScalpFile},
      {"frizz",
       "",
       "",
       "How far these hairs differ from their strands, a factor; 0: each curls just as its strand.",
       &O::frizz,
       {0, 10}},
      {"clump",
       "",
       "",
       "Mean share by which these hairs come together beyond their roots.",
       &O::clump,
       {0, 1}},
      {"blend",
       "",
       "",
       "Share of what the nearest strands beside a hair's own have in its course; its curl stays that of its "
       "own. 1 for straight and wavy hair.",
       &O::blend,
       {0, 1}},
      {"clip_frames",
       "",
       "none; hair.usda is one file",
       "Frames of a value clip: hair.usda is then a small file beside hair_clips/, which has them in parts.",
       &O::clipFrames,
       {1, 1e6}},
      {"prims",
       "",
       "",
       "Whose prims hair.usdc has: one for all hair, or those of the groom's USD file, as changes to lay "
       "over it.",
       &O::prims,
       {},
       "hair, groom"},
      {"cache",
       "",
       "none",
       "Precision of hair.rgc, an additional cache of the animation.",
       &O::cache,
       {},
       "float32, 16bit"},
  };
  return all;
}

}  // namespace ringlet
