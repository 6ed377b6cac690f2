// Scene files: TOML that says all of a simulation, the groom, what it is made of, how the head moves, bodies,
// air, and what is written. `ringlet scene --keys` prints every key; they stand in scene_fields.cpp, once.
//
//     [groom]
//     file = "head.obj"           # paths are relative to the scene file
//
//     [material]                  # all that a material file may hold
//     preset = "ringlet"
//
//     [motion]
//     kind = "nod"
//
//     [[body]]
//     shape = "sphere"
//     radius = 0.088
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/number_range.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/generate.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/scene/air.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/contact_settings.h"
#include "ringlet/scene/goal.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// Where the hair comes from, and where in the head's frame it is. Names are those of the file's keys.
struct SceneGroom {
  std::filesystem::path file;
  std::string generate;  // curl, swatch or head, in place of a file
  std::string style{};   // of a head, whose numbers hold where none are given (groom/hair_styles.h)

  // Generated (groom/generate.h).
  int strands = HeadParameters{}.strandCount, locks = HeadParameters{}.lockCount;
  int particles = CurlParameters{}.particleCount;
  int columns = SwatchParameters{}.columnCount, rows = SwatchParameters{}.rowCount;
  double radius = CurlParameters{}.radius, turns = CurlParameters{}.turns, length = CurlParameters{}.length;
  double phase = CurlParameters{}.phase;
  std::string hand = "right";
  double spacing = SwatchParameters{}.spacing, scalpRadius = HeadParameters{}.scalpRadius;
  double varyRadius = Variation{}.radius, varyLength = Variation{}.length, varyPhase = Variation{}.phase;
  double otherHand = Variation{}.leftHandedShare;
  HairCut cut{};
  std::filesystem::path scalp{};
  std::uint32_t seed = 1;

  std::optional<double> metresPerUnit{};  // unset: the file's, where it states one, else centimetres
  std::string up = "Y";                   // or Z
  std::string rootEnd = "first";          // of each strand of a file: or last, or head (groom/loaded_groom.h)
  int pointsPerStrand = 0;                // of a file of points only; 0: of none

  // Strands that are simulated, which all others follow: so many, those of a file, or those whose primvar is
  // not 0; nothing: all.
  int guides = 0;
  std::filesystem::path guidesFile{};
  std::string guidesPrimvar{};
  int guidesSample = 0;  // other strands that are simulated as well, to measure how well they follow

  // Into the head's frame, or the world: scaled, then turned, then moved.
  double scale = 1;
  Vec3d rotateDegrees{}, offset{};  // [m]

  std::string bind = "head";  // the frame it is in; or world: where it stands at bindFrame of the motion
  int bindFrame = 1;

  bool operator==(const SceneGroom&) const = default;
};

struct SceneKeyframe {
  double time = 0;   // [s]
  Vec3d position{};  // [m]
  std::optional<Vec3d> rotateDegrees{};
  std::optional<Quatd> quaternion{};  // in its place, of any length above 0
};

/// Roots that move beside the head (scene/motion.h).
struct SceneRoots {
  Vec3d shift{};  // of the roots of the first half of the strands; the others' go the other way [m]
  double frequency = 0, easeSeconds = 1, untilSeconds = 0;
};

/// One of three: a built-in motion, a file, keys. What is unset is the built-in motion's own.
struct SceneMotion {
  std::string kind{};
  std::optional<double> amplitude{}, frequency{}, easeSeconds{}, untilSeconds{};
  std::optional<Vec3d> axis{};

  std::filesystem::path file{};
  std::string joint = "Head";
  std::string animation{};  // of a glTF file: a name or a number; empty: the first
  std::optional<double> metresPerUnit{};
  std::string up{};  // axis of the file, a name of motion/file_axis.h; empty: as the file's person stands
  int skipFrames = 0;

  std::vector<SceneKeyframe> keys{};  // by rising time
  std::string interpolation = "cubic";

  Vec3d start{};  // [m], added to all

  // Of the head's only.
  double preRollSeconds = 0;
  SceneRoots roots{};
};

/// The mesh that roots follow (motion/head_scalp.h); none where there is no file and no body.
struct SceneScalp {
  std::string body{};                     // name of one that deforms, whose mesh it is; in place of all
                                          // that says which mesh
  std::filesystem::path file{}, cache{};  // as for motion/mesh_motion_file.h
  std::string mesh{};                     // empty: the only one
  std::string animation{};                // empty: the head's where it is the same file, else the first
  std::optional<double> metresPerUnit{}, framesPerSecond{};
  std::string up{};  // axis of the file, a name of motion/file_axis.h; empty: as the kind of file has it
  double farthest = 0.01;  // [m]
  double start = 0;        // when its first key is [s]

  bool isThere() const { return !file.empty() || !body.empty(); }
};

/// How hair begins: as it was at a frame of another run, seen from the head.
struct SceneStart {
  std::filesystem::path from{};  // an animation, or a run's folder; empty: hair begins at rest
  std::optional<int> frame{};    // unset: the last
  int blend = 0;                 // frames over which hair is held to how it began, ever less
};

struct SceneSimulation {
  double framesPerSecond = Settings{}.framesPerSecond;
  std::optional<int> frames;
  std::optional<double> seconds;  // in its place
  std::optional<int> stepsPerFrame;
  double gravity = 9.81;  // downwards [m/s^2]
  std::optional<double> preload;
  double maxStretch = Settings{}.maxStretch;
  std::string integrator = "jacobi";
  int roots = Settings{}.rootCount;
  double teleportDistance = Settings{}.teleportDistance;
  double sleepSpeed = Settings{}.sleepSpeed;
  int iterations = Settings{}.pointIterations;
  bool chebyshev = Settings{}.chebyshev;
  int forceLoops = Settings{}.forceLoops, dampingLoops = Settings{}.dampingLoops;
};

/// Its place, grid and motion are made of what stands here (bodyOf in load/scene_parts.h).
struct SceneBody : Body {
  // Of a mesh.
  std::filesystem::path file;
  std::string mesh{};                   // of several in the file; empty: the only one
  std::string generate;                 // head; or bust and cape, which deform; in place of a file
  std::optional<double> metresPerUnit;  // unset: the groom's
  int cells = 64;                       // of its distance grid, along its longest side
  double scale = 1;

  // Of a mesh that bends: it is in the world, as motion/mesh_motion_file.h reads it, and moves by its points.
  bool deforms = false;
  std::filesystem::path cache{};  // of an .obj file
  std::string animation{};        // empty: the head's where it is the same file, else the first
  std::optional<double> framesPerSecond{};
  double start = 0;             // when its first key is [s]
  std::string region = "hair";  // or all: what of it has a grid
  std::string sides = "out";    // or both: cloth

  Vec3d position{}, rotateDegrees{};  // [m]
  std::string bind = "carrier";       // or world, as the groom's
  std::optional<int> bindFrame;       // unset: the groom's

  std::string joint;                 // of the head's motion file; or
  std::optional<SceneMotion> moves;  // its own motion, in the world; neither: the head carries it,
                                     // and a mesh that bends what most of it moves with
};

/// A camera for pictures: at a place, or of a glTF file.
struct SceneCamera {
  std::string name;
  std::optional<Vec3d> eye{};  // [m]; none: `file` has it
  Vec3d target{};              // [m]
  std::optional<Vec3d> up{};   // unset: the groom's up axis
  double fieldOfView = 26;     // from top to bottom [degrees]
  std::string bind = "world";  // the frame it is in; or head
  std::string joint{};         // of the head's motion file, in whose frame it is instead
  std::filesystem::path file{};

  bool operator==(const SceneCamera&) const = default;
};

/// [[field]]: see scene/force_field.h.
struct SceneForceField {
  std::string name, kind;
  double strength = 0;  // [m/s^2]; with drag [m/s]; of a grid a factor
  Vec3d position{}, rotateDegrees{}, axis{0, 1, 0};
  double reach = 0, core = 0.02;       // [m]
  std::optional<double> drag;          // unset: 20 of drag and grid, else 0 [1/s]
  double start = 0;                    // [s]
  double speed = 10, thickness = 0.1;  // [m/s], [m]
  std::filesystem::path file;
  double cell = 0.1;           // [m]
  std::string bind = "world";  // or head
  std::string joint;           // of the head's motion file, in place of either

  bool operator==(const SceneForceField&) const = default;
};

/// [[hold]]: hair that is tied, clipped or pinned to something that moves.
struct SceneHold {
  std::string name;
  std::string strands;            // empty: all
  double begin = 0.4, end = 0.6;  // shares of the arc
  double gather = 1;
  std::optional<Vec3d> position;  // of the middle [m]; none: where it is in the groom
  std::string bind = "head";      // or world
  std::string joint;              // of the head's motion file, in place of either
  double strength = 100;
  std::optional<double> start, release;  // [s]
  double ease = 0.05;                    // [s]

  bool operator==(const SceneHold&) const = default;
};

/// [[cut]]: strands that are cut at a time; what is cut off falls.
struct SceneCut {
  std::string name;
  std::string strands;  // empty: all
  double at = 0.5;      // share of the arc
  double time = 0;      // [s]

  bool operator==(const SceneCut&) const = default;
};

struct SceneOutput {
  std::filesystem::path folder;
  double width = 0.0005;
  std::optional<double> tipWidth;  // none: strands are as wide everywhere
  std::optional<int> hairs;        // that follow the strands, in animations; none: the strands themselves
  std::string hairScalp;           // name of a body of shape mesh that their roots are on; none: empty
  std::filesystem::path hairScalpFile;        // in its place: an OBJ file in the groom's axes and unit
  double frizz = 1, clump = 0.25, blend = 0;  // of these hairs
  std::vector<std::string> files{"hair.usda", "last.obj", "sheet.png"};
  std::vector<std::string> values;  // that USD files have beside points and widths
  std::string head = "baked";       // into the points; "transform": beside them; "none": left out
  std::optional<int> clipFrames;    // none: hair.usda is one file
  std::string prims = "hair";       // one, /Hair; or "groom": those of the groom's file
  std::string cache;                // precision of hair.rgc; empty: it is not written
};

/// A factor on a number of the material for some strands, or from a file for each; or another preset for
/// some.
struct SceneMap {
  std::string number;  // one of mappedParameters()
  std::string preset;  // in its place: all these numbers are as the preset has them
  // One of four:
  std::filesystem::path file;     // of factors by strand
  std::string strands;            // "0:99, fringe"
  std::string primvar;            // of a USD or Alembic groom
  std::filesystem::path texture;  // at the UVs of one
  double factor = 1;              // of `strands`
  std::string uv = "st";          // primvar that has them
  double low = 0, high = 1;       // factors where primvar or texture are 0 and 1
  bool operator==(const SceneMap&) const = default;
};

/// [[group]]: strands with a name.
struct SceneGroup {
  std::string name;
  std::string strands;  // "0:99, 120"
  bool touch = true;    // each other
  bool operator==(const SceneGroup&) const = default;
};

/// A number, or three, that the scene has at a time (scene_keys.h says which may be).
struct SceneKeyedValue {
  std::string key;  // with its table: "air.wind"
  Vec3d value{};    // one number: x
  bool operator==(const SceneKeyedValue&) const = default;
};

struct SceneTimeKey {
  double time = 0;  // [s]
  std::vector<SceneKeyedValue> values{};
  bool operator==(const SceneTimeKey&) const = default;
};

/// What a file says, checked as far as one can without opening what it names (but a material's file).
struct SceneFile {
  SceneGroom groom;
  LoadedMaterial material;
  bool hasMaterial = false;  // false: the default one
  SceneMotion motion{.kind = "still"};
  SceneScalp scalp;
  SceneStart start;
  SceneSimulation simulation;
  ContactSettings contacts;
  AirSettings air;
  GoalSettings goal;
  std::filesystem::path goalFile;  // an animation or a groom in place of the groom itself; none: empty
  std::vector<SceneBody> bodies;
  std::vector<SceneCamera> cameras;
  std::vector<SceneForceField> fields;
  std::vector<SceneHold> holds;
  std::vector<SceneCut> cuts;
  std::vector<SceneGroup> groups;
  std::vector<SceneMap> maps;          // worked into the material
  std::vector<SceneTimeKey> timeKeys;  // by rising time
  SceneOutput output;
  std::vector<std::string> warnings;  // sentences for a person, each with the file's name
};

/// A key, as a person wants to know it.
struct SceneKey {
  std::string table, key;
  std::string type;       // "number", "[x, y, z]", "one of Y, Z"
  std::string unit;       // "" for none
  std::string range;      // "from 0 to 1 m", "" for any
  std::string standard;   // what holds without it, in words where it is no value
  std::string onlyWith;   // the kinds, shapes or sources that have it, "" for all
  std::string effect;     // one sentence
  NumberRange allowed{};  // of numbers; from 0 to 0 for any
  std::string choices{};  // of texts, separated by commas; "" for any
};

/// Every key but a material's own (rest/material_parameters.h), table by table.
std::vector<SceneKey> sceneKeys();

/// Whether a path names a scene file: it ends in .toml.
bool isSceneFile(const std::filesystem::path& path);

/// A key that is set before a scene is read, whether or not the file has it. Tables of a list have numbers
/// from 1: "body.2.radius".
struct SceneChange {
  enum class Form {
    toml,  // as a file has it, or a text without its quotes
    text,  // a text, whatever it looks like
    path,  // relative to the working directory, and in reach wherever it is
  };

  std::string key;  // with its table: "material.dials.hold"
  std::string value;
  Form form = Form::toml;
  std::vector<std::string> without{};  // keys of its table, and tables in it, that go first
};

/// Which files a scene may name.
enum class SceneReach {
  anywhere,
  ownFolder,  // those in or below the folder of the scene file, symbolic links followed: for scenes of
              // strangers
};

/// Paths are relative to the file. Errors, each with file and line, what was found and what was expected: no
/// file or no TOML, an unknown key (with the nearest known one), a value of another type or out of its range,
/// keys that make no sense together, a file out of reach. Of several the topmost; those of changes come
/// first, without a line.
Result<SceneFile> readScene(const std::filesystem::path& path, std::span<const SceneChange> changes = {},
                            SceneReach reach = SceneReach::anywhere);

/// The same from text; `name` stands for the file in messages, paths are relative to `folder`.
Result<SceneFile> parseScene(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder = {},
                             std::span<const SceneChange> changes = {},
                             SceneReach reach = SceneReach::anywhere);

/// TOML of all that is not the default, every key with its comment, below the lines of `heading`; parseScene
/// gives back the same bits. Paths below `folder` are written relative to it. Not for a preset's or a file's
/// name: the material's numbers stand in their place.
std::string sceneText(const SceneFile& scene, const std::filesystem::path& folder = {},
                      const std::string& heading = "");

}  // namespace ringlet
