// Implements benchmark_score.h.
#include "program/measure/benchmark_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "program/measure/benchmark_cases.h"
#include "program/measure/measure_report.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/measure/contact_quality.h"
#include "ringlet/measure/crossings.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/run/report_rows.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/scene_frames.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Score = BenchmarkScore;

// Looks at a run frame by frame.
class BenchmarkRuler {
 public:
  static Result<BenchmarkRuler> make(const LoadedScene& scene) {
    auto motion = MotionMeasure::make(scene.groom, {.framesPerSecond = scene.settings.framesPerSecond});
    if (!motion) return motion.error();
    BenchmarkRuler ruler(scene, std::move(*motion));
    if (scene.groom.strandCount() > 1) {
      auto contacts = ContactRuler::make(scene.groom, scene.material, scene.settings);
      if (!contacts) return contacts.error();
      ruler.contacts_.emplace(std::move(*contacts));
    }
    if (!scene.bodies.empty()) ruler.bodies_.emplace(scene.groom, scene.bodies, scene.settings.rootCount);
    if (Status rest = ruler.look(0, carriedPoints(scene, ruler.frames_.placesAt(0).head)); !rest)
      return rest.error();
    ruler.restTurns_ = curlNumbers(ruler.motion_.ruler(), ruler.motion_.report()).turns;
    return ruler;
  }

  // Points in the world [m].
  Status look(int frame, std::vector<Vec3f> points) {
    const ScenePlaces places = frames_.placesAt(frame);
    if (Status added = motion_.addFrame(points, 1, places.head.rotation); !added)
      return Error{fmt::format("frame {}: {}", frame, added.error().message)};
    const std::vector<Vec3f> carried = carriedPoints(*scene_, places.head);
    for (std::size_t s = 0; s < scene_->groom.strandCount(); ++s) {
      const std::uint32_t root = scene_->groom.firstPoint[s];
      score_.roots = std::max(score_.roots, length(Vec3d(points[root]) - Vec3d(carried[root])));
    }
    if (contacts_) {
      deepest_ = std::max(deepest_, contacts_->measure(points).deepestOverlap);
      if (!last_.empty()) crossings_ += countCrossings(scene_->groom.firstPoint, last_, points);
    }
    if (bodies_) {
      std::vector<Vec3f> seen = points;
      for (Vec3f& p : seen) p = Vec3f(Vec3d(p) - places.head.position);
      bodies_->look(seen, places.head, places.bodies);
    }
    score_.motion = 0;
    for (std::size_t i = 0; i < last_.size(); ++i)
      score_.motion = std::max(score_.motion, length(Vec3d(points[i]) - Vec3d(last_[i])));
    last_ = std::move(points);
    return {};
  }

  Score score() const {
    Score score = score_;
    const CurlNumbers numbers = curlNumbers(motion_.ruler(), motion_.report());
    score.stretch = numbers.maxEdgeStretch - 1;
    score.droop = numbers.droop;
    score.turns = restTurns_ > 0 ? numbers.turns / restTurns_ : 1;
    score.settle = numbers.settleSeconds;
    if (contacts_) {
      score.overlap = deepest_;
      score.crossings = static_cast<double>(crossings_) / static_cast<double>(scene_->groom.strandCount());
    }
    if (bodies_) score.depth = bodies_->numbers().deepest;
    return score;
  }

 private:
  BenchmarkRuler(const LoadedScene& scene, MotionMeasure motion)
      : scene_(&scene), frames_(scene), motion_(std::move(motion)) {}

  const LoadedScene* scene_;
  SceneFrames frames_;
  MotionMeasure motion_;
  std::optional<ContactRuler> contacts_{};
  std::optional<BodyWatch> bodies_{};
  std::vector<Vec3f> last_{};
  Score score_{};
  double deepest_ = 0, restTurns_ = 0;
  std::uint64_t crossings_ = 0;
};

Result<LoadedScene> sceneIn(const fs::path& folder) {
  const auto file = readScene(folder / "scene.toml");
  if (!file) return file.error();
  return loadScene(*file);
}

Result<Score> scoreOf(const LoadedScene& scene, const fs::path& file) {
  const Groom& groom = scene.groom;
  ForeignReading reading{.upIsZ = false, .framesPerSecond = scene.settings.framesPerSecond};
  reading.groom = file.parent_path() / "rest.obj";
  auto run = AnimationReader::open(file, reading);
  if (run && !run->statesUnit()) {
    reading.metresPerUnit = groom.metresPerUnit;
    run = AnimationReader::open(file, reading);
  }
  if (!run) return run.error();
  if (run->groom().firstPoint != groom.firstPoint)
    return Error{fmt::format("has {} strands of {} points in all; expected {} of {}, as rest.obj has",
                             run->groom().strandCount(), run->groom().firstPoint.back(), groom.strandCount(),
                             groom.points.size())};
  const int expected = scene.frameCount, rest = run->frameCount() == expected + 1 ? 1 : 0;
  if (std::abs(run->header().framesPerSecond / scene.settings.framesPerSecond - 1) > 1e-3)
    return Error{fmt::format("has {} frames a second; expected {}", run->header().framesPerSecond,
                             scene.settings.framesPerSecond)};
  auto ruler = BenchmarkRuler::make(scene);
  if (!ruler) return ruler.error();
  const int count = std::min(run->frameCount() - rest, expected);
  for (int frame = 1; frame <= count; ++frame) {
    if (Status read = run->readFrame(frame + rest); !read) return read.error();
    std::vector<Vec3f> points = run->groom().points;
    for (Vec3f& p : points) p = Vec3f(Vec3d(p) * run->header().metresPerUnit);
    if (Status looked = ruler->look(frame, std::move(points)); !looked) return looked.error();
  }
  Score score = ruler->score();
  score.frameCount = count;
  score.expectedCount = expected;
  if (count < expected) score.problem = fmt::format("has {} frames; expected {}", count, expected);
  return score;
}

Score scoreCase(const fs::path& folder, const LoadedScene& scene) {
  const auto file = animationFileOf(folder);
  if (!file) return {.problem = "no hair.usda, .usdc, .abc, .pc2 or .rgc", .expectedCount = scene.frameCount};
  auto score = scoreOf(scene, *file);
  if (!score) return {.file = file->filename().string(), .problem = score.error().message};
  score->file = file->filename().string();
  return *score;
}

std::optional<double> inMillimetres(std::optional<double> metres) {
  return metres ? std::optional(1000 * *metres) : std::nullopt;
}

constexpr ReportRow<Score> kScoreRows[] = {
    {{"case", "", "Its folder."}, [](const Score& s) -> Json { return s.name; }},
    {{"file", "", "The animation in it."}, [](const Score& s) -> Json { return s.file; }},
    {{"problem", "", "What is wrong with that; empty: nothing."},
     [](const Score& s) -> Json { return s.problem; }},
    {{"frames", "", "Frames."}, [](const Score& s) -> Json { return s.frameCount; }},
    {{"expected_frames", "", "Frames of the case."}, [](const Score& s) -> Json { return s.expectedCount; }},
    {{"roots_mm", "mm", "Farthest of a root from where it should be."},
     [](const Score& s) { return orNull(inMillimetres(s.roots)); }},
    {{"stretch", "1", "Of the longest edge of all frames, beyond rest."},
     [](const Score& s) -> Json { return s.stretch; }},
    {{"droop_mm", "mm", "How far tips have sunk at last, mean."},
     [](const Score& s) { return orNull(inMillimetres(s.droop)); }},
    {{"turns", "1", "Turns of curls at last, as a share of those at rest."},
     [](const Score& s) -> Json { return s.turns; }},
    {{"motion_mm", "mm", "Farthest way of a particle in the last frame."},
     [](const Score& s) { return orNull(inMillimetres(s.motion)); }},
    {{"settle_s", "s", "Until hair is at rest after the head's last motion; null: it is not."},
     [](const Score& s) { return orNull(s.settle); }},
    {{"crossings", "1", "Passes of hairs through each other, a strand; null: of one strand."},
     [](const Score& s) { return orNull(s.crossings); }},
    {{"overlap", "1", "Deepest overlap beyond rest, as a share of the hairs' width; null: of one strand."},
     [](const Score& s) { return orNull(s.overlap); }},
    {{"depth_mm", "mm", "Deepest place of a particle in the body; null without one."},
     [](const Score& s) { return orNull(inMillimetres(s.depth)); }},
};

std::vector<ReportKey> scoreKeys() { return keysOf<kScoreRows>(); }

constexpr ReportRow<BenchmarkScores> kBenchmarkRows[] = {
    {{"cases", "", "Of each case:", scoreKeys},
     [](const BenchmarkScores& s) {
       Json cases = Json::array();
       for (const Score& score : s.cases) cases.push_back(objectOf<kScoreRows>(score));
       return cases;
     }},
    {{"resolution_mm", "mm",
      "How far the tips of the hanging curl are apart in height, at 8 to 128 points; null: not all were run."},
     [](const BenchmarkScores& s) { return orNull(inMillimetres(s.resolution)); }},
};

std::optional<double> resolutionOf(const std::vector<Score>& scores) {
  double low = 1e300, high = -1e300;
  for (const Score& score : scores) {
    if (!std::string_view(score.name).starts_with("hang_")) continue;
    if (!score.problem.empty()) return std::nullopt;
    low = std::min(low, score.droop);
    high = std::max(high, score.droop);
  }
  return high >= low ? std::optional(high - low) : std::nullopt;
}

}  // namespace

Result<BenchmarkScores> scoreBenchmark(const fs::path& folder) {
  BenchmarkScores scores;
  std::size_t missing = 0;
  for (const BenchmarkCase& of : benchmarkCases()) {
    const auto scene = sceneIn(folder / of.name);
    if (!scene)
      return Error{fmt::format("{} (`ringlet measure --benchmark {} --write` writes the cases)",
                               scene.error().message, folder.string()),
                   Fault::input};
    Score score = scoreCase(folder / of.name, *scene);
    score.name = of.name;
    missing += score.file.empty();
    scores.cases.push_back(std::move(score));
  }
  if (missing == scores.cases.size())
    return Error{
        fmt::format("{}: no case has a run yet; expected hair.usda, hair.usdc, hair.abc, hair.pc2 or "
                    "hair.rgc in its folder, as `ringlet simulate {}/hang_8/scene.toml -o {}/hang_8` makes",
                    folder.string(), folder.string(), folder.string()),
        Fault::input};
  scores.resolution = resolutionOf(scores.cases);
  return scores;
}

nlohmann::ordered_json benchmarkJson(const BenchmarkScores& scores) {
  return objectOf<kBenchmarkRows>(scores);
}

std::vector<ReportKey> benchmarkKeys() { return keysOf<kBenchmarkRows>(); }

std::string benchmarkText(const BenchmarkScores& scores) {
  std::string text = fmt::format("{:<10} {:>9} {:>9} {:>9} {:>7} {:>10} {:>8} {:>9} {:>8} {:>9}\n", "case",
                                 "roots mm", "stretch %", "droop mm", "turns", "motion mm", "settle s",
                                 "crossings", "overlap", "depth mm");
  for (const Score& s : scores.cases) {
    if (!s.problem.empty()) {
      text += fmt::format("{:<10} {}{}{}\n", s.name, s.file, s.file.empty() ? "" : ": ", s.problem);
      continue;
    }
    text += fmt::format("{:<10} {:>9} {:>9} {:>9} {:>7} {:>10} {:>8} {:>9} {:>8} {:>9}\n", s.name,
                        shown(1000 * s.roots, 3), shown(100 * s.stretch, 2), shown(1000 * s.droop, 3),
                        shown(s.turns, 3), shown(1000 * s.motion, 4), shown(s.settle, 2),
                        shown(s.crossings, 2), shown(s.overlap, 3), shown(inMillimetres(s.depth), 3));
  }
  return text + fmt::format("\nhanging curl at 8 to 128 points: tips {} mm apart in height\n",
                            shown(inMillimetres(scores.resolution), 3));
}

}  // namespace ringlet::program
