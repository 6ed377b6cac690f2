// Implements scenes/file/scene_fields.h: of what acts on hair beside bodies and air, [[field]], [[hold]]
// and [[cut]].
#include <limits>

#include "ringlet/scenes/file/scene_fields.h"

namespace ringlet {
namespace {

constexpr NumberRange kLength{0, 1000};      // [m]
constexpr NumberRange kTimes{-3600, 36000};  // [s]
constexpr NumberRange kStrength{0, 1e6};

}  // namespace

std::span<const SceneField<SceneForceField>> forceFieldFields() {
  using F = SceneForceField;
  static const SceneField<F> all[] = {
      {"name", "", "its number", "Name for messages and for keys, as in field.NAME.strength.", &F::name},
      {"kind",
       "",
       "required",
       "What it does: uniform pulls along its axis; point and line pull towards themselves; vortex goes "
       "round its axis, right-handed; blast pushes away where its front passes; drag only brakes; grid has "
       "velocities of air from a file.",
       &F::kind,
       {},
       "uniform, point, line, vortex, blast, drag, grid"},
      SceneField<F>{
          "strength",
          "",
          "",
          "Acceleration, m/s^2; with drag the velocity of the air, m/s; of a grid a factor. Below 0 it goes "
          "the other way.",
          &F::strength,
          {-1e6, 1e6},
          "",
          "uniform, point, line, vortex, blast, grid"}
          .live(),
      SceneField<F>{"position", "m", "",
                    "Its place, in the frame that carries it; of a grid, of its first node.", &F::position,
                    kPlace}
          .live(),
      {"rotate_degrees",
       "deg",
       "",
       "Rotation about X, then Y, then Z, the axes of the frame it is placed in.",
       &F::rotateDegrees,
       {-1e6, 1e6}},
      {"axis", "1", "", "Direction of its axis, of any length above 0.", &F::axis, kPlace, "",
       "uniform, line, vortex"},
      SceneField<F>{"reach", "m", "",
                    "Distance from its place, or from its axis, at which it has faded to nothing. 0: it acts "
                    "everywhere.",
                    &F::reach, kLength}
          .live(),
      {"core", "m", "", "Distance within which it fades towards its place or axis.", &F::core, kLength, "",
       "point, line, vortex, blast"},
      SceneField<F>{"drag",
                    "1/s",
                    "20 of drag and grid, else 0",
                    "How fast the field's air takes hair along. With 0 the strength is an acceleration.",
                    &F::drag,
                    {0, 1e6}}
          .live(),
      {"start", "s", "", "When its front leaves its place.", &F::start, kTimes, "", "blast"},
      {"speed", "m/s", "", "Speed of the front.", &F::speed, {0, 1e5}, "", "blast"},
      {"thickness", "m", "", "Half the thickness of the front.", &F::thickness, {1e-4, 1000}, "", "blast"},
      {"file",
       "",
       "none",
       "NumPy file (.npy) of the grid: numbers of 4 or 8 bytes, shape (x, y, z, 3), velocities in m/s.",
       &F::file,
       {},
       "",
       "grid"},
      {"cell", "m", "", "Distance between neighbours in the grid.", &F::cell, {1e-6, 1000}, "", "grid"},
      {"bind",
       "",
       "",
       "Frame it is in: the world, or the head, with which it moves.",
       &F::bind,
       {},
       "world, head"},
      {"joint", "", "none", "Joint of the head's motion file that carries it instead.", &F::joint},
  };
  return all;
}

std::span<const SceneField<SceneHold>> holdFields() {
  using H = SceneHold;
  static const SceneField<H> all[] = {
      {"name", "", "its number", "Name for messages and for keys, as in hold.NAME.strength.", &H::name},
      {"strands", "", "all", "Strands it holds, as in \"0:99, 120\".", &H::strands},
      {"begin", "1", "", "Where on a strand it begins, as a share of the strand's length from the root.",
       &H::begin, kShareRange},
      {"end", "1", "", "Where it ends.", &H::end, kShareRange},
      SceneField<H>{
          "gather", "1", "",
          "How wide the held part is, as a share of its width in the groom: 1 holds hair where it is, 0.2 "
          "ties it together, 0 pulls all to one line.",
          &H::gather, kShareRange}
          .live(),
      {"position", "m", "where it is in the groom",
       "Where the middle of the held hair is put, in the frame that carries it.", &H::position, kPlace},
      {"bind", "", "", "Frame that carries it: the head, or the world.", &H::bind, {}, "head, world"},
      {"joint", "", "none", "Joint of the head's motion file that carries it instead.", &H::joint},
      SceneField<H>{"strength", "1", "",
                    "How firmly it holds; 1 holds a particle's own weight a centimetre from its place.",
                    &H::strength, kStrength}
          .live(),
      {"start", "s", "from the beginning", "When it takes hold.", &H::start, kTimes},
      {"release", "s", "never", "When it lets go.", &H::release, kTimes},
      {"ease", "s", "", "How long taking hold and letting go last.", &H::ease, {0, 3600}},
  };
  return all;
}

std::span<const SceneField<SceneCut>> sceneCutFields() {
  using C = SceneCut;
  static const SceneField<C> all[] = {
      {"name", "", "its number", "Name for messages.", &C::name},
      {"strands", "", "all", "Strands that are cut, as in \"0:99, 120\".", &C::strands},
      {"at", "1", "",
       "Where on a strand, as a share of the strand's length from the root. Two particles stay.", &C::at,
       kShareRange},
      {"time", "s", "", "When. A cut is made at the beginning of the first frame that begins then or later.",
       &C::time, kTimes},
  };
  return all;
}

}  // namespace ringlet
