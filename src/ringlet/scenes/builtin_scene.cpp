// Implements scenes/builtin_scene.h.
#include "ringlet/scenes/builtin_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {
namespace {

constexpr int kParticles = 64;  // eight a turn of the curl
constexpr int kSwatchColumns = 8, kSwatchRows = 4;
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

// Rows of curls that stand out from a wall, along +Z.
Result<Groom> horizontalSwatch(const SceneOptions& options) {
  SwatchParameters swatch;
  swatch.curl = curlOf(options.particles.value_or(kParticles));
  swatch.columnCount = kSwatchColumns;
  swatch.rowCount = options.strands ? (*options.strands + kSwatchColumns - 1) / kSwatchColumns : kSwatchRows;
  auto groom = makeSwatch(swatch);
  if (!groom) return groom.error();
  for (Vec3f& p : groom->points) p = {p.x, p.z, -p.y};
  return groom;
}

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
};

const std::vector<Recipe>& recipes() {
  const Vec3d side{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
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
  };
  return all;
}

const Recipe* recipeOf(std::string_view name) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.name == name) return &recipe;
  }
  return nullptr;
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

Result<BuiltinScene> makeScene(std::string_view name, const SceneOptions& options) {
  const Recipe* recipe = recipeOf(name);
  if (!recipe) {
    return Error{fmt::format("no scene is called {}; there are {}", name, fmt::join(sceneNames(), ", "))};
  }
  if (Status checked = checkOptions(name, options); !checked) return checked.error();
  auto groom = recipe->groom(options);
  if (!groom) return groom.error();

  BuiltinScene scene{.name = recipe->name,
                     .summary = recipe->summary,
                     .groom = std::move(*groom),
                     .material = recipe->material(),
                     .settings = {},
                     .motion = recipe->motion,
                     .seconds = options.seconds.value_or(recipe->seconds),
                     .showsFrames = recipe->showsFrames,
                     .warnings = {}};
  const auto coarse = coarseCurlWarning(curlOf(options.particles.value_or(kParticles)));
  if (coarse && recipe->groom != foldedStrand) scene.warnings.push_back(*coarse);
  if (!options.core) scene.material.coreStiffness = 0;
  if (!options.smoothedFrames) scene.material.bendSmoothingLength = 0;

  const bool isPaper = options.integrator == Integrator::paper;
  Settings& settings = scene.settings;
  settings.integrator = options.integrator;
  settings.stepsPerFrame =
      options.stepsPerFrame.value_or(isPaper ? kPaperStepsPerFrame : settings.stepsPerFrame);
  settings.gravityPreload = options.preload.value_or(isPaper ? 0 : recipe->preload);
  if (Status checked = checkSettings(settings, scene.material); !checked) return checked.error();
  return scene;
}

}  // namespace ringlet
