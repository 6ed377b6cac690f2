// Implements scenes/builtin_scene.h.
#include "ringlet/scenes/builtin_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {
namespace {

constexpr int kParticles = 64;  // eight a turn of the curl
constexpr int kSwatchColumns = 8, kSwatchRows = 4;
// Of contacts where curls meet: two of these cover the 10 mm and less between the particles of a curl of
// eight a turn [m].
constexpr double kMeetingRadius = 0.0055;
constexpr double kSpacing = 0.025;        // between the roots of copies [m]
constexpr int kPaperStepsPerFrame = 30;   // Iben et al. 2012, section 5
constexpr double kLongestScene = 36'000;  // [s]
constexpr int kMostStrands = 100'000;
constexpr double kCentimetre = 0.01;  // unit of the grooms' points [m]

// The curl of all measurements: radius 1 cm, 8 turns, 25 cm, which is what CurlParameters has by default.
CurlParameters curlOf(int particles) {
  CurlParameters curl;
  curl.particleCount = particles;
  return curl;
}

// Copies of the strands of a groom, along X and then along Z.
Groom sideBySide(const Groom& groom, int count) {
  Groom copies;
  copies.metresPerUnit = groom.metresPerUnit;
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int k = 0; k < count; ++k) {
    const Vec3f shift =
        Vec3f(Vec3d{double(k % columns), 0, double(k / columns)} * (kSpacing / groom.metresPerUnit));
    std::vector<Vec3f> strand;
    for (Vec3f p : groom.strand(0)) strand.push_back(p + shift);
    copies.addStrand(strand);
  }
  return copies;
}

Result<Groom> hangingCurls(const SceneOptions& options) {
  auto curl = makeCurl(curlOf(options.particles.value_or(kParticles)));
  if (!curl) return curl.error();
  return sideBySide(*curl, options.strands.value_or(1));
}

// Columns along X, rows along Z, hanging.
Result<Groom> hangingSwatch(const SceneOptions& options, int columns, int rows, std::uint64_t seed = 1) {
  SwatchParameters swatch;
  swatch.curl = curlOf(options.particles.value_or(kParticles));
  swatch.columnCount = columns;
  swatch.rowCount = options.strands ? (*options.strands + columns - 1) / columns : rows;
  swatch.variation.seed = seed;
  return makeSwatch(swatch);
}

// How a swatch that hangs comes to stand out from a wall, by where its hair then points; its rows are one
// above the other.
Vec3f alongZ(Vec3f p) { return {p.x, p.z, -p.y}; }
Vec3f againstZ(Vec3f p) { return {-p.x, p.z, p.y}; }
Vec3f alongX(Vec3f p) { return {-p.y, p.z, -p.x}; }

// Rows of curls that stand out from a wall, along +Z.
Result<Groom> horizontalSwatch(const SceneOptions& options) {
  auto groom = hangingSwatch(options, kSwatchColumns, kSwatchRows);
  if (!groom) return groom.error();
  for (Vec3f& p : groom->points) p = alongZ(p);
  return groom;
}

// Two grooms in one, the second after the first.
Groom joined(Groom first, const Groom& second) {
  for (std::size_t s = 0; s < second.strandCount(); ++s) first.addStrand(second.strand(s));
  return first;
}

void move(Groom& groom, Vec3d by) {
  for (Vec3f& p : groom.points) p += Vec3f(by / groom.metresPerUnit);
}

// Two curls of one hand, half a turn about their cores from each other, 5 cm apart: pushed together they
// would cross twice a turn. (Of one phase they would lie in each other like spoons.) Their roots, which
// nothing stops, pass beside each other.
Result<Groom> twoCurls(const SceneOptions& options) {
  constexpr double kApart = 0.05;  // of their cores [m]
  if (options.strands) return Error{"two_curls has its two strands; leave the number of strands out"};
  CurlParameters curl = curlOf(options.particles.value_or(kParticles));
  curl.phase = -std::numbers::pi / 2;
  auto first = makeCurl(curl);
  if (!first) return first.error();
  curl.phase = std::numbers::pi / 2;
  auto second = makeCurl(curl);
  if (!second) return second.error();
  move(*first, {-kApart / 2, 0, 0});
  move(*second, {kApart / 2, 0, 0});
  return joined(std::move(*first), *second);
}

// Two hanging sheets of 10 x 5 curls, the nearest rows 10 cm apart.
Result<Groom> curtain(const SceneOptions& options) {
  constexpr double kApart = 0.1;  // of the nearest cores [m]
  auto first = hangingSwatch(options, 10, 5, 1), second = hangingSwatch(options, 10, 5, 2);
  if (!first || !second) return first ? second.error() : first.error();
  const double rows = static_cast<double>(first->strandCount()) / 10;
  const double middle = (kApart + (rows - 1) * kSpacing) / 2;
  move(*first, {0, 0, -middle});
  move(*second, {0, 0, middle});
  return joined(std::move(*first), *second);
}

// Two swatches that stand out from walls, crosswise: the second 4 cm above the first and across its middle.
//
//       | ======   second, along X
//             o o o    first, along Z
Result<Groom> pile(const SceneOptions& options) {
  constexpr double kApart = 0.04;  // of the nearest cores [m]
  auto first = hangingSwatch(options, 6, 2, 1), second = hangingSwatch(options, 6, 2, 2);
  if (!first || !second) return first ? second.error() : first.error();
  const double rows = static_cast<double>(first->strandCount()) / 6;
  const double middle = (kApart + (rows - 1) * kSpacing) / 2;
  for (Vec3f& p : first->points) p = alongZ(p);
  for (Vec3f& p : second->points) p = alongX(p);
  move(*first, {0, -middle, -0.125});
  move(*second, {-0.125, middle, 0});
  return joined(std::move(*first), *second);
}

// Two swatches that stand out from facing walls, the first 6 cm above the second: it droops onto what stands
// firm near the other's roots.
//
//       | ========      first
//           ======== |  second
Result<Groom> oneAboveTheOther(const SceneOptions& options) {
  constexpr double kApart = 0.06;  // of the nearest cores [m]
  auto first = hangingSwatch(options, 6, 2, 1), second = hangingSwatch(options, 6, 2, 2);
  if (!first || !second) return first ? second.error() : first.error();
  const double rows = static_cast<double>(first->strandCount()) / 6;
  const double middle = (kApart + (rows - 1) * kSpacing) / 2;
  for (Vec3f& p : first->points) p = alongZ(p);
  for (Vec3f& p : second->points) p = againstZ(p);
  move(*first, {0, middle, -0.15});
  move(*second, {0, -middle, 0.15});
  return joined(std::move(*first), *second);
}

Result<Groom> headOf(const SceneOptions& options, int strands) {
  HeadParameters head;
  head.curl = curlOf(options.particles.value_or(kParticles));
  head.strandCount = options.strands.value_or(strands);
  return makeHead(head);
}
Result<Groom> wholeHead(const SceneOptions& options) { return headOf(options, 1500); }
Result<Groom> sparseHead(const SceneOptions& options) { return headOf(options, 100); }

// A straight strand with one fold: two joints of nearly 180 degrees, a twentieth apart, that the smoothed
// curve glides over.
//
//      root o---->----->-----o       the fold's edges run back at an angle of kFoldTilt; drawn lying,
//                 o<----<---'        hangs along -Y
//                  `---->----->-----o tip
Result<Groom> foldedStrand(const SceneOptions& options) {
  constexpr double kLength = 0.25;    // along the strand [m]
  constexpr double kFoldTilt = 0.01;  // from folded flat [rad]
  const int particles = options.particles.value_or(kParticles);
  if (particles < 16 || particles > 65536) {
    return Error{
        fmt::format("twist_jump with {} particles: it takes 16 to 65536, to hold its fold", particles)};
  }
  const int edges = particles - 1, foldStart = edges / 3;
  const int foldEdges = std::max(2, static_cast<int>(std::lround(0.05 * edges)));
  const double edge = kLength / edges / kCentimetre;
  std::vector<Vec3f> strand;
  Vec3d p{};
  for (int i = 0; i < particles; ++i) {
    strand.push_back(Vec3f(p));
    const bool isFold = i >= foldStart && i < foldStart + foldEdges;
    p += isFold ? Vec3d{std::sin(kFoldTilt), std::cos(kFoldTilt), 0} * edge : Vec3d{0, -edge, 0};
  }
  Groom groom;
  groom.metresPerUnit = kCentimetre;
  groom.addStrand(strand);
  return sideBySide(groom, options.strands.value_or(1));
}

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
};

// Hair that meets hair: nothing slips between particles, and where it comes together from apart, every pair
// may touch.
ContactSettings meeting(bool prunePairs = false) {
  ContactSettings contacts;
  contacts.radius = kMeetingRadius;
  contacts.fillGaps = true;
  contacts.prunePairs = prunePairs;
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
       meeting(true)},
      {"head",
       "The generated head of 1,500 curls, shaken by 10 cm twice a second: what pruning is for.",
       wholeHead,
       ringletMaterial,
       {.kind = MotionKind::shake, .axis = side, .amplitude = 0.1, .frequency = 2},
       1,
       2,
       false,
       true},
  };
  return all;
}

const Recipe* recipeOf(std::string_view name) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.name == name) return &recipe;
  }
  return nullptr;
}

// The roots of the first half go one way, the others the other; none where nothing moves.
std::vector<Vec3d> shiftsOf(Vec3d shift, std::size_t strandCount) {
  std::vector<Vec3d> shifts;
  if (length(shift) == 0) return shifts;
  for (std::size_t s = 0; s < strandCount; ++s) shifts.push_back(2 * s < strandCount ? shift : shift * -1.0);
  return shifts;
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
    return Error{
        fmt::format("{} by the paper's loops, which take their springs as printed, has a core and "
                    "smoothed frames; leave the switch out",
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

int BuiltinScene::frameCount() const {
  return static_cast<int>(std::max(1L, std::lround(seconds * settings.framesPerSecond)));
}

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
  BuiltinScene scene{.name = recipe->name,
                     .summary = recipe->summary,
                     .groom = std::move(*groom),
                     .material = recipe->material(),
                     .settings = {},
                     .motion = recipe->motion,
                     .rootShifts = shiftsOf(recipe->rootShift, strandCount),
                     .seconds = options.seconds.value_or(recipe->seconds),
                     .showsContacts = recipe->showsContacts,
                     .showsFrames = recipe->showsFrames,
                     .warnings = {}};
  const auto coarse = coarseCurlWarning(curlOf(options.particles.value_or(kParticles)));
  if (coarse && recipe->groom != foldedStrand) scene.warnings.push_back(*coarse);
  if (!options.core) scene.material.coreStiffness = 0;
  if (options.bendStiffness) scene.material.bendStiffness = *options.bendStiffness;
  if (!options.smoothedFrames) scene.material.bendSmoothingLength = 0;

  const bool isPaper = options.integrator == Integrator::paper;
  Settings& settings = scene.settings;
  settings.integrator = options.integrator;
  settings.stepsPerFrame =
      options.stepsPerFrame.value_or(isPaper ? kPaperStepsPerFrame : settings.stepsPerFrame);
  settings.contacts = recipe->contacts;
  settings.contacts.on = options.contacts.value_or(recipe->showsContacts);
  settings.gravityPreload = options.preload.value_or(isPaper ? 0 : recipe->preload);
  if (Status checked = checkSettings(settings, scene.material); !checked) return checked.error();
  return scene;
}

}  // namespace ringlet
