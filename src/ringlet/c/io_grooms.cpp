// Implements c/ringlet_io.h: grooms, materials and meshes.
#include <fmt/format.h>

#include <cmath>

#include "ringlet/base/host_words.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/c/io_handles.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/measure/groom_doubts.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/rest/material_parameters.h"

namespace ringlet::c {
namespace {

static_assert(int(RootEnd::first) == RINGLET_ROOT_FIRST && int(RootEnd::last) == RINGLET_ROOT_LAST &&
              int(RootEnd::head) == RINGLET_ROOT_ON_HEAD);

constexpr NumberRange kUnit{1e-6, 1000};  // [m]

// What ringlet_groom_reading has.
constexpr HostWord kWords[] = {
    {"unit", "metres_per_unit", "metres_per_unit = {}"},
    {"up", "up_is_z", "up_is_z = 1", "Z"},
    {"up", "up_is_z", "up_is_z = 0"},
    {"root-end", "root_end", "root_end = RINGLET_ROOT_LAST", "last"},
    {"root-end", "root_end", "root_end = RINGLET_ROOT_ON_HEAD"},
    {"points-per-strand", "points_per_strand", "points_per_strand = {}"},
};

// Whether the host says of a groom what can be.
Outcome checkReading(const ringlet_groom_reading& reading) {
  if (reading.points_per_strand == 1 || reading.points_per_strand > kMostPointsPerStrand)
    return Outcome::invalid(fmt::format("points_per_strand is {}; it takes 2 to {}, or 0",
                                        reading.points_per_strand, kMostPointsPerStrand));
  if (reading.root_end < RINGLET_ROOT_FIRST || reading.root_end > RINGLET_ROOT_ON_HEAD)
    return Outcome::invalid(
        fmt::format("root_end is {}; it takes one of ringlet_root_end", static_cast<int>(reading.root_end)));
  return {};
}

Outcome checkUnit(double metresPerUnit) {
  if (kUnit.contains(metresPerUnit)) return {};
  return Outcome::invalid(
      fmt::format("a unit is from {} to {} m; found {}", kUnit.low, kUnit.high, metresPerUnit));
}

}  // namespace

ShownGroom::ShownGroom(Groom of) : groom(std::move(of)) {
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    sizes.push_back(static_cast<std::uint32_t>(groom.strand(s).size()));
}

ringlet_groom ShownGroom::show() const {
  return {sizeof(ringlet_groom), groom.points.empty() ? nullptr : &groom.points[0].x, sizes.data(),
          static_cast<std::uint32_t>(sizes.size()), groom.metresPerUnit};
}

}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_groom_read(const char* path, const ringlet_groom_reading* reading,
                                  ringlet_loaded_groom** groom) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_groom_read takes a path, how to read and a place for the groom",
                           {given("path", path), sizedOrNull("reading", reading), given("groom", groom)});
        !wrong.isFine())
      return wrong;
    const ringlet_groom_reading how = taken(reading);
    if (how.metres_per_unit != 0) {
      if (Outcome wrong = checkUnit(how.metres_per_unit); !wrong.isFine()) return wrong;
    }
    if (Outcome wrong = checkReading(how); !wrong.isFine()) return wrong;
    const GroomReading wanted{.upIsZ = how.up_is_z != 0,
                              .pointsPerStrand = how.points_per_strand,
                              .rootEnd = static_cast<RootEnd>(how.root_end)};
    auto loaded = readGroom(path, wanted);
    if (!loaded) return Error{inHostWords(loaded.error().message, kWords), loaded.error().fault};
    if (how.metres_per_unit != 0) loaded->groom.metresPerUnit = how.metres_per_unit;
    for (std::string& doubt : doubtsOf(*loaded, wanted)) loaded->warnings.push_back(std::move(doubt));
    for (std::string& sentence : loaded->warnings) sentence = inHostWords(sentence, kWords);
    warnOf(loaded->warnings, how.warn, how.user);
    *groom = new ringlet_loaded_groom{ShownGroom(std::move(loaded->groom))};
    return {};
  });
}

ringlet_result ringlet_loaded_groom_get(const ringlet_loaded_groom* from, ringlet_groom* groom) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_loaded_groom_get takes a groom of a file, and one to fill",
                                       {given("from", from), sized("groom", groom)});
        !wrong.isFine())
      return wrong;
    give(groom, from->shown.show());
    return {};
  });
}

void ringlet_loaded_groom_release(ringlet_loaded_groom* groom) { delete groom; }

ringlet_result ringlet_groom_write(const char* path, const ringlet_groom* groom) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_groom_write takes a path and a groom",
                                       {given("path", path), sized("groom", groom)});
        !wrong.isFine())
      return wrong;
    Groom made;
    if (Outcome wrong = takeGroom(taken(groom), made); !wrong.isFine()) return wrong;
    return writeGroom(path, made);
  });
}

ringlet_result ringlet_material_read(const char* preset_or_path, ringlet_warn warn, void* user,
                                     ringlet_material** material) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_material_read takes a preset or a path, and a place for the material",
                           {given("preset_or_path", preset_or_path), given("material", material)});
        !wrong.isFine())
      return wrong;
    auto loaded = loadMaterial(preset_or_path);
    if (!loaded) return loaded.error();
    std::vector<std::string> warnings = std::move(loaded->warnings);
    if (const auto warning = applyDials(loaded->dials, loaded->material)) warnings.push_back(*warning);
    if (Status checked = checkMaterial(loaded->material); !checked) return checked;
    warnOf(warnings, warn, user);
    *material = new ringlet_material{std::move(loaded->material)};
    return {};
  });
}

ringlet_result ringlet_material_write(const char* path, const ringlet_material* material) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_material_write takes a path and a material",
                                       {given("path", path), given("material", material)});
        !wrong.isFine())
      return wrong;
    return writeMaterial(path, material->material);
  });
}

ringlet_result ringlet_mesh_read(const char* path, double metres_per_unit, ringlet_mesh** mesh) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_mesh_read takes a path and a place for the mesh",
                                       {given("path", path), given("mesh", mesh)});
        !wrong.isFine())
      return wrong;
    if (Outcome wrong = checkUnit(metres_per_unit); !wrong.isFine()) return wrong;
    const auto read = readObjMesh(path, metres_per_unit);
    if (!read) return read.error();
    auto made = std::make_unique<ringlet_mesh>();
    for (const Vec3d& p : read->points)
      for (const double number : {p.x, p.y, p.z}) made->vertices.push_back(static_cast<float>(number));
    for (const auto& triangle : read->triangles)
      made->triangles.insert(made->triangles.end(), triangle.begin(), triangle.end());
    *mesh = made.release();
    return {};
  });
}

ringlet_result ringlet_mesh_get(const ringlet_mesh* from, ringlet_body* body) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_mesh_get takes a mesh and a body to fill",
                                       {given("from", from), sized("body", body)});
        !wrong.isFine())
      return wrong;
    ringlet_body filled = taken(body);
    filled.shape = "mesh";
    filled.vertices = from->vertices.data(), filled.triangles = from->triangles.data();
    filled.vertex_count = static_cast<std::uint32_t>(from->vertices.size() / 3);
    filled.triangle_count = static_cast<std::uint32_t>(from->triangles.size() / 3);
    give(body, filled);
    return {};
  });
}

void ringlet_mesh_release(ringlet_mesh* mesh) { delete mesh; }
