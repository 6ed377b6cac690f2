// Curves of Alembic files for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "tests/groom/abc_bytes.h"
#include "tests/motion/abc_samples.h"

namespace ringlet::test {

inline constexpr std::uint8_t kAbcCubic = 0, kAbcLinear = 1, kAbcVariable = 2;

/// How curves are written: curveBasisAndType, and what stands in .geom and in .arbGeomParams beside it.
struct AbcCurveForm {
  std::uint8_t type = kAbcLinear, wrap = 0, basis = 0;
  std::vector<AbcBytes::Property> more{}, params{};
  std::uint32_t sampling = 0;
};

/// An array that is the same at all times.
inline AbcBytes::Property abcArray(const std::string& name, AbcBytes::Type type, const std::string& bytes,
                                   std::uint32_t width = 1, const std::string& metadata = "") {
  return {.name = name,
          .kind = AbcBytes::array,
          .type = type,
          .width = width,
          .samples = {bytes},
          .metadata = metadata};
}

/// A sample a pose, of as many curves each.
inline AbcBytes::Object abcMovingCurves(const std::string& name,
                                        const std::vector<std::vector<std::int32_t>>& counts,
                                        const std::vector<std::vector<Vec3d>>& poses,
                                        const AbcCurveForm& form = {}) {
  AbcBytes::Property points = abcArray("P", AbcBytes::f32, "", 3, "geoScope=vtx;interpretation=point");
  AbcBytes::Property each = abcArray("nVertices", AbcBytes::i32, "");
  points.samples.clear();
  each.samples.clear();
  for (const auto& pose : poses) points.samples.push_back(abcPoints(pose));
  for (const auto& of : counts) each.samples.push_back(abcNumbers(of));
  points.sampling = each.sampling = form.sampling;
  each.count = static_cast<std::uint32_t>(poses.size());
  std::vector<AbcBytes::Property> parts{
      points,
      each,
      {.name = "curveBasisAndType",
       .kind = AbcBytes::scalar,
       .type = AbcBytes::u8,
       .width = 4,
       .samples = {abcNumbers<std::uint8_t>({form.type, form.wrap, form.basis, form.basis})}}};
  parts.insert(parts.end(), form.more.begin(), form.more.end());
  if (!form.params.empty()) parts.push_back({.name = ".arbGeomParams", .parts = form.params});
  return {.name = name,
          .metadata = "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1",
          .properties = {{.name = ".geom", .metadata = "schema=AbcGeom_Curve_v2", .parts = parts}}};
}
inline AbcBytes::Object abcCurves(const std::string& name, const std::vector<std::int32_t>& counts,
                                  const std::vector<Vec3d>& points, const AbcCurveForm& form = {}) {
  return abcMovingCurves(name, {counts}, {points}, form);
}

/// Curves in the order of the points, each of so many: whatever bends.
inline std::vector<Vec3d> abcCurl(const std::vector<std::int32_t>& counts) {
  std::vector<Vec3d> points;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    for (int i = 0; i < counts[c]; ++i) {
      const double t = 0.7 * i;
      points.push_back({static_cast<double>(c) + 0.5 * std::cos(t), 10 - 0.4 * i, 0.5 * std::sin(t)});
    }
  }
  return points;
}

/// The file's bytes; samplings above 0 are 24 a second, from 1 s on.
inline std::string abcFile(const std::vector<AbcBytes::Object>& objects) {
  AbcBytes file;
  file.samplings.push_back({1.0 / 24, {1}});
  file.objects = objects;
  return file.bytes();
}

}  // namespace ringlet::test
