// Implements benchmark_cases.h.
#include "program/measure/benchmark_cases.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <system_error>

#include "ringlet/base/whole_file.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/scenes/file/scene_text.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::program {
namespace {

namespace fs = std::filesystem;

constexpr BenchmarkCase kBenchmarkCases[] = {
    {"hang_8", "hanging_curl", 8, 1, 4, 0, "A curl of 8 points hangs and must not sag."},
    {"hang_16", "hanging_curl", 16, 1, 4, 0, "The same curl of 16 points."},
    {"hang_32", "hanging_curl", 32, 1, 4, 0, "The same curl of 32 points."},
    {"hang_64", "hanging_curl", 64, 1, 4, 0, "The same curl of 64 points."},
    {"hang_128", "hanging_curl", 128, 1, 4, 0, "The same curl of 128 points."},
    {"shake", "head_shake", 64, 1, 4, 2,
     "A soft curl is shaken by 10 cm, twice a second for 2 s: it must not unwind, and comes to rest."},
    {"release", "release", 64, 32, 6, 0, "A swatch that stands out from a wall is let go: it comes to rest."},
    {"flip", "flip", 64, 100, 2, 0, "A head of limp hair is turned over: hair meets other hair."},
    {"two_curls", "two_curls", 64, 0, 6, 0, "Two curls are pushed into each other and apart: they give way."},
    {"walk", "walk_head", 64, 100, 4, 0, "Hair on a head that walks stays out of it."}};

// Of a mesh [m], in a groom's unit.
Status writeMesh(const fs::path& path, const TriangleMesh& mesh, double metresPerUnit) {
  std::string text;
  for (const Vec3d& p : mesh.points) {
    const Vec3d q = p * (1 / metresPerUnit);
    text += fmt::format("v {} {} {}\n", q.x, q.y, q.z);
  }
  for (const auto& corners : mesh.triangles)
    text += fmt::format("f {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
  return writeWholeFile(path, std::as_bytes(std::span<const char>(text)));
}

Status writeCarried(const fs::path& path, const LoadedScene& scene) {
  const double unit = scene.groom.metresPerUnit;
  const auto writer = createAnimation(path, scene.groom,
                                      {.framesPerSecond = scene.settings.framesPerSecond,
                                       .metresPerUnit = unit,
                                       .diameter = static_cast<float>(0.0005 / unit),
                                       .frameCount = scene.frameCount});
  if (!writer) return writer.error();
  const SceneFrames frames(scene);
  for (int frame = 1; frame <= scene.frameCount; ++frame) {
    std::vector<Vec3f> points = carriedPoints(scene, frames.placesAt(frame).head);
    for (Vec3f& p : points) p = Vec3f(Vec3d(p) * (1 / unit));
    if (Status added = (*writer)->addFrame(points); !added) return added;
  }
  return (*writer)->finish();
}

Status writeCase(const fs::path& folder, const BenchmarkCase& of) {
  SceneOptions options{.particles = of.particles, .seconds = of.seconds};
  if (of.strands > 0) options.strands = of.strands;
  if (of.strands != 1) options.contacts = true;
  auto scene = makeScene(of.scene, options);
  if (!scene) return scene.error();
  if (of.until > 0) scene->motion.untilSeconds = of.until;
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    return Error{fmt::format("cannot create the folder {}: {}", folder.string(), code.message()),
                 Fault::output};
  const std::string heading = fmt::format("# {} (docs/benchmark.md)\n", of.summary);
  const std::string text = sceneText(sceneFileOf(*scene, folder / "rest.obj"), folder, heading);
  for (const char* name : {"rest.obj", "rest.abc"})
    if (Status written = writeGroom(folder / name, scene->groom, {.up = UpAxis::y}); !written) return written;
  if (Status written = writeWholeFile(folder / "scene.toml", std::as_bytes(std::span<const char>(text)));
      !written)
    return written;
  for (const char* name : {"carried.usdc", "carried.abc"})
    if (Status written = writeCarried(folder / name, *scene); !written) return written;
  return scene->bodies.empty() ? Status{}
                               : writeMesh(folder / "body.obj", makeHeadMesh(), scene->groom.metresPerUnit);
}

}  // namespace

std::span<const BenchmarkCase> benchmarkCases() { return kBenchmarkCases; }

std::vector<Vec3f> carriedPoints(const LoadedScene& scene, const HeadPose& head) {
  const Groom& groom = scene.groom;
  std::vector<Vec3f> points;
  points.reserve(groom.points.size());
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const Vec3d shift = scene.rootShifts.empty() ? Vec3d{} : scene.rootShifts[s] * head.shift;
    for (const Vec3f& p : groom.strand(s))
      points.push_back(Vec3f(head.position + rotate(head.rotation, Vec3d(p) * groom.metresPerUnit + shift)));
  }
  return points;
}

Status writeBenchmark(const fs::path& folder) {
  for (const BenchmarkCase& of : kBenchmarkCases)
    if (Status written = writeCase(folder / of.name, of); !written)
      return Error{fmt::format("{}: {}", of.name, written.error().message), written.error().fault};
  return {};
}

}  // namespace ringlet::program
