// Implements scenes/builtin_scene.h.
#include "ringlet/scenes/builtin_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/bending_body.h"
#include "ringlet/scenes/load/idle_dials.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/scenes/load/scene_scalp.h"
#include "ringlet/scenes/scene_grooms.h"

namespace ringlet {
namespace {

// Of contacts where curls meet: two of these cover the 10 mm and less between the particles of a curl of
// eight a turn [m].
constexpr double kMeetingRadius = 0.0055;
constexpr double kBendingRadius = 0.0075;  // where they bend sharply particles are 14.5 mm apart
constexpr int kPaperStepsPerFrame = 30;    // Iben et al. 2012, section 5
constexpr double kLongestScene = 36'000;   // [s]
constexpr int kMostStrands = 100'000;

Material ringletMaterial() { return materialPreset("ringlet").value(); }

// Softer than any preset: what unwinds without a core spring. That acts in full from its rest length on, as a
// hard shake needs.
Material softMaterial() {
  Material material;
  material.bendStiffness = 0.5;
  material.coreRelaxedShare = 1;
  return material;
}

Material usualMaterial() { return {}; }

// Swings and falls freely: hair that meets hair which it is not beside at rest.
Material limpMaterial() {
  Material material;
  material.bendStiffness = 1;
  return material;
}

// Gives way along its edges, so that a hard bounce reaches the stretch limit.
Material stretchyMaterial() {
  Material material = ringletMaterial();
  material.stretchStiffness = 10;
  return material;
}

// What is below the hair: a head that it carries, or a bust that carries it.
enum class Below { nothing, head, bust };

struct Recipe {
  const char* name;
  const char* summary;
  Result<Groom> (*groom)(const SceneOptions&);
  Material (*material)();
  Motion motion;
  double preload, seconds;
  bool showsFrames = false;
  bool showsContacts = false;
  Vec3d rootShift{};  // of the roots of the first half of the strands; the others go the other way [m]
  ContactSettings contacts{};  // but on, which is for the asking
  Below below = Below::nothing;
};

// Hair that meets hair: nothing slips between particles.
ContactSettings meeting() {
  ContactSettings contacts;
  contacts.radius = kMeetingRadius;
  contacts.fillGaps = true;
  return contacts;
}

// Curls that bend over a shoulder.
ContactSettings bending() {
  ContactSettings contacts = meeting();
  contacts.radius = kBendingRadius;
  return contacts;
}

const std::vector<Recipe>& recipes() {
  const Vec3d side{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  constexpr double forever = std::numeric_limits<double>::infinity();
  static const std::vector<Recipe> all = {
      {"hanging_curl",
       "A curl that hangs: it must not sag, at any resolution or step.",
       hangingCurls,
       ringletMaterial,
       {},
       1,
       10},
      {"walk_cycle", "A curl on a walking head: it must not spin about itself (the paper's figure 2).",
       hangingCurls, ringletMaterial, motionByName("walk", up).value(), 1, 10},
      {"head_shake",
       "A soft curl shaken by 10 cm, twice a second: its core spring keeps it from unwinding.",
       hangingCurls,
       softMaterial,
       {.kind = MotionKind::shake, .axis = side, .amplitude = 0.1, .frequency = 2},
       0,
       4},
      {"bounce",
       "A stretchy curl on a head that goes up and down by 4 cm for 2 s, into the stretch limit.",
       hangingCurls,
       stretchyMaterial,
       {.kind = MotionKind::shake, .axis = up, .amplitude = 0.04, .frequency = 3, .untilSeconds = 2},
       1,
       8},
      {"twist_jump",
       "A strand with a nearly flat fold: its frames must turn smoothly, not jump.",
       foldedStrand,
       softMaterial,
       {.kind = MotionKind::shake, .axis = forward, .amplitude = 0.1, .frequency = 2},
       1,
       2,
       true},
      {"release",
       "A swatch of curls that stands out from a wall, let go under gravity.",
       horizontalSwatch,
       ringletMaterial,
       {},
       0,
       10},
      {"two_curls",
       "Two curls pushed to 1 cm from core to core and apart again: they give way, and come to rest.",
       twoCurls, usualMaterial, Motion{.roots = {.easeSeconds = 1, .untilSeconds = 3}}, 1, 10, false, true,
       Vec3d{0.02, 0, 0}, meeting()},
      {"curtain", "Two sheets of limp curls that swing into each other for 6 s and do not pass.", curtain,
       limpMaterial, Motion{.roots = {.frequency = 1, .easeSeconds = 0.5, .untilSeconds = 6}}, 0.5, 10, false,
       true, Vec3d{0, 0, 0.04}, meeting()},
      {"pile", "A swatch pressed crosswise into a swatch by 5 cm and held there: it bends, and lies still.",
       pile, usualMaterial, Motion{.roots = {.easeSeconds = 2, .untilSeconds = forever}}, 1, 10, false, true,
       Vec3d{0, 0.025, 0}, meeting()},
      {"fall",
       "A swatch that stands out from a wall is let go and falls on another below it.",
       oneAboveTheOther,
       ringletMaterial,
       {},
       0,
       10,
       false,
       true,
       {},
       meeting()},
      {"flip",
       "A head of limp hair turned over in 1 s: hair meets hair that it was not beside at rest, which "
       "pruning does not see.",
       sparseHead,
       limpMaterial,
       Motion{.kind = MotionKind::turn, .axis = forward, .amplitude = std::numbers::pi, .easeSeconds = 1},
       0.3,
       2,
       false,
       true,
       {},
       meeting()},
      {"head",
       "The generated head of 1,500 curls, shaken by 10 cm twice a second.",
       wholeHead,
       ringletMaterial,
       {.kind = MotionKind::shake, .axis = side, .amplitude = 0.1, .frequency = 2},
       1,
       2,
       false,
       true},
      {"walk_head",
       "The generated head of 1,500 curls on a head of its own that walks: hair stays out of it.",
       wholeHead,
       ringletMaterial,
       motionByName("walk", up).value(),
       1,
       4.4,
       false,
       true,
       {},
       {},
       Below::head},
      {"bust",
       "Hair falls on the shoulders of a bust that nods and shrugs, and stays out of a body that bends.",
       bustHair,
       ringletMaterial,
       {},
       0.3,
       4,
       false,
       true,
       {},
       bending(),
       Below::bust},
  };
  return all;
}

const Recipe* recipeOf(std::string_view name) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.name == name) return &recipe;
  }
  return nullptr;
}

// The generated head as a body; the scalp's radius is that of the groom, which has the default one.
Result<Body> headBody() {
  auto made = makeDistanceGrid(makeHeadMesh());
  if (!made) return made.error();
  return Body{.name = "head",
              .shape = BodyShape::grid,
              .grid = std::make_shared<const DistanceGrid>(std::move(made->grid))};
}

// The bust as a body, with the roots on it.
Status addBust(BuiltinScene& scene) {
  SceneFile file;
  file.bodies.push_back(bustBody());
  file.scalp.body = "bust";
  scene.bodies.push_back(bodyOf(file.bodies[0], 0, {0, 1, 0}));
  if (Status loaded = loadBendingBody(file, 0, scene); !loaded) return loaded;
  return loadScalp(file, scene);
}

Status checkOptions(std::string_view name, const SceneOptions& options) {
  if (options.strands && (*options.strands < 1 || *options.strands > kMostStrands)) {
    return Error{fmt::format("{} with {} strands: it takes 1 to {}", name, *options.strands, kMostStrands)};
  }
  if (options.seconds && !(*options.seconds > 0 && *options.seconds <= kLongestScene)) {
    return Error{fmt::format("{} of {} seconds: it takes more than 0 and at most {}", name, *options.seconds,
                             kLongestScene)};
  }
  if (options.integrator != Integrator::paper) return {};
  if (!options.core || !options.smoothedFrames) {
    return Error{fmt::format(
        "{} by the paper's loops, which take their springs as printed, has a core and smoothed frames; leave "
        "the switch out",
        name)};
  }
  if (options.preload.value_or(0) != 0) {
    return Error{fmt::format("{} by the paper's loops, which have no preload: leave it out or 0", name)};
  }
  if (options.bendStiffness) {
    return Error{fmt::format(
        "{} by the paper's loops, which have a bending of their own: leave the stiffness out", name)};
  }
  return {};
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) names.push_back(recipe.name);
  return names;
}

std::string sceneSummary(std::string_view name) {
  const Recipe* recipe = recipeOf(name);
  return recipe ? recipe->summary : "";
}

bool sceneShowsContacts(std::string_view name) {
  const Recipe* recipe = recipeOf(name);
  return recipe && recipe->showsContacts;
}

Result<BuiltinScene> makeScene(std::string_view name, const SceneOptions& options) {
  const Recipe* recipe = recipeOf(name);
  if (!recipe) {
    return Error{fmt::format("no scene is called {}; there are {}", name, fmt::join(sceneNames(), ", "))};
  }
  if (Status checked = checkOptions(name, options); !checked) return checked.error();
  auto groom = recipe->groom(options);
  if (!groom) return groom.error();

  const std::size_t strandCount = groom->strandCount();
  BuiltinScene scene{{.groom = std::move(*groom),
                      .material = recipe->material(),
                      .settings = {},
                      .motion = recipe->motion,
                      .rootShifts = rootShiftsOf(recipe->rootShift, strandCount)}};
  scene.name = recipe->name;
  scene.summary = recipe->summary;
  scene.seconds = options.seconds.value_or(recipe->seconds);
  scene.frameCount =
      static_cast<int>(std::max(1L, std::lround(scene.seconds * scene.settings.framesPerSecond)));
  scene.showsContacts = recipe->showsContacts;
  scene.showsFrames = recipe->showsFrames;
  const auto coarse = coarseCurlWarning(sceneCurl(options));
  if (coarse && recipe->groom != foldedStrand) scene.warnings.push_back(*coarse);
  if (!options.core) scene.material.coreStiffness = 0;
  if (options.bendStiffness) scene.material.bendStiffness = *options.bendStiffness;
  if (!options.smoothedFrames) scene.material.bendSmoothingLength = 0;
  if (Status checked = checkDials(options.dials); !checked) return checked.error();
  if (auto warning = applyDials(options.dials, scene.material)) scene.warnings.push_back(std::move(*warning));

  if (recipe->below != Below::nothing && options.integrator != Integrator::jacobi)
    return Error{kBodiesNeedJacobi};
  if (recipe->below == Below::head) {
    auto head = headBody();
    if (!head) return head.error();
    scene.bodies.push_back(std::move(*head));
  }

  const bool isPaper = options.integrator == Integrator::paper;
  Settings& settings = scene.settings;
  settings.integrator = options.integrator;
  settings.stepsPerFrame =
      options.stepsPerFrame.value_or(isPaper ? kPaperStepsPerFrame : settings.stepsPerFrame);
  settings.contacts = recipe->contacts;
  settings.contacts.on = options.contacts.value_or(recipe->showsContacts);
  settings.gravityPreload = options.preload.value_or(isPaper ? 0 : recipe->preload);
  if (Status checked = checkSettings(settings, scene.material); !checked) return checked.error();
  if (recipe->below == Below::bust) {
    if (Status added = addBust(scene); !added) return added.error();
  }
  for (std::string& sentence :
       idleDials(options.dials, scene.material, scene.groom, settings, scene.motion, scene.seconds))
    scene.warnings.push_back(std::move(sentence));
  return scene;
}

}  // namespace ringlet
