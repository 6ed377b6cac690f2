// Meshes of Alembic files for tests.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "tests/groom/abc_bytes.h"

namespace ringlet::test {

using AbcTriangles = std::vector<std::array<std::uint32_t, 3>>;

inline std::string abcPoints(const std::vector<Vec3d>& points) {
  std::string bytes;
  for (const Vec3d& p : points)
    for (const double number : {p.x, p.y, p.z}) bytes += abcNumber(static_cast<float>(number));
  return bytes;
}

/// A sample a pose. Of faces with these corners, in the order of the file: clockwise seen from outside.
inline AbcBytes::Object abcMesh(const std::string& name, const std::vector<std::int32_t>& counts,
                                const std::vector<std::int32_t>& corners,
                                const std::vector<std::vector<Vec3d>>& samples, std::uint32_t sampling,
                                const std::string& schema = "AbcGeom_PolyMesh_v1") {
  AbcBytes::Property points{.name = "P",
                            .kind = AbcBytes::array,
                            .type = AbcBytes::f32,
                            .width = 3,
                            .sampling = sampling,
                            .metadata = "geoScope=vtx;interpretation=point"};
  for (const auto& sample : samples) points.samples.push_back(abcPoints(sample));
  const auto integers = [&](const char* property, const std::vector<std::int32_t>& values) {
    return AbcBytes::Property{.name = property,
                              .kind = AbcBytes::array,
                              .type = AbcBytes::i32,
                              .samples = {abcNumbers(values)},
                              .sampling = sampling,
                              .count = static_cast<std::uint32_t>(samples.size())};
  };
  return {.name = name,
          .metadata = "schema=" + schema + ";schemaBaseType=AbcGeom_GeomBase_v1",
          .properties = {
              {.name = ".geom",
               .metadata = "schema=" + schema,
               .parts = {points, integers(".faceIndices", corners), integers(".faceCounts", counts)}}}};
}

/// Of triangles wound as ours.
inline AbcBytes::Object abcMesh(const std::string& name, const AbcTriangles& triangles,
                                const std::vector<std::vector<Vec3d>>& samples, std::uint32_t sampling) {
  std::vector<std::int32_t> corners;
  for (const auto& [a, b, c] : triangles)
    for (const std::uint32_t corner : {a, c, b}) corners.push_back(static_cast<std::int32_t>(corner));
  return abcMesh(name, std::vector<std::int32_t>(triangles.size(), 3), corners, samples, sampling);
}

/// An Xform object: its operations (0x10 translates, and so on) and their numbers, a sample a vector.
inline AbcBytes::Object abcXform(const std::string& name, const std::vector<std::uint8_t>& ops,
                                 const std::vector<std::vector<double>>& values, std::uint32_t sampling,
                                 std::vector<AbcBytes::Object> children) {
  std::vector<std::string> samples;
  for (const auto& sample : values) samples.push_back(abcNumbers(sample));
  return {.name = name,
          .metadata = "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform",
          .properties = {{.name = ".xform",
                          .parts = {{.name = ".inherits", .kind = AbcBytes::scalar, .samples = {"\1"}},
                                    {.name = ".ops",
                                     .kind = AbcBytes::scalar,
                                     .type = AbcBytes::u8,
                                     .width = static_cast<std::uint32_t>(ops.size()),
                                     .samples = {abcNumbers(ops)}},
                                    {.name = ".vals",
                                     .kind = AbcBytes::scalar,
                                     .type = AbcBytes::f64,
                                     .width = static_cast<std::uint32_t>(values[0].size()),
                                     .samples = samples,
                                     .sampling = sampling}}}},
          .children = std::move(children)};
}

/// A mesh "M" in a file, with samples from 0 s on.
inline std::string abcMeshBytes(const AbcTriangles& triangles, const std::vector<std::vector<Vec3d>>& samples,
                                double framesPerSecond) {
  AbcBytes file;
  file.samplings.push_back({1 / framesPerSecond, {0}});
  file.objects = {abcMesh("M", triangles, samples, 1)};
  return file.bytes();
}

}  // namespace ringlet::test
