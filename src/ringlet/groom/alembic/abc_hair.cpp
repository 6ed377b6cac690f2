// Implements groom/alembic/abc_hair.h.
#include "ringlet/groom/alembic/abc_hair.h"

#include <bit>
#include <cstring>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr const char
    *kAbcTransform = "schema=AbcGeom_Xform_v3",
    *kAbcTransformObject = "schema=AbcGeom_Xform_v3;schemaObjTitle=AbcGeom_Xform_v3:.xform",
    *kAbcCurves = "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1",
    *kAbcCurvesObject =
        "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1;schemaObjTitle=AbcGeom_Curve_v2:."
        "geom";

// Linear; not closed; of B-splines, which says nothing of linear curves.
constexpr std::string_view kLinearCurves("\1\0\2\2", 4);

}  // namespace

AbcOutArchive abcHairOf(const Groom& topology) {
  std::string counts;
  for (std::size_t s = 0; s < topology.strandCount(); ++s)
    putAbcU32(counts, topology.firstPoint[s + 1] - topology.firstPoint[s]);
  AbcOutObject shape{.name = "HairShape", .metadata = kAbcCurvesObject};
  shape.properties = {{.name = ".geom", .metadata = kAbcCurves}};
  shape.properties.front().parts = {{.name = ".selfBnds",
                                     .metadata = "interpretation=box",
                                     .kind = AbcKind::scalar,
                                     .type = AbcType::f64,
                                     .width = 6},
                                    {.name = kAbcPoints,
                                     .metadata = "geoScope=vtx;interpretation=point",
                                     .kind = AbcKind::array,
                                     .type = AbcType::f32,
                                     .width = 3},
                                    {.name = "nVertices",
                                     .kind = AbcKind::array,
                                     .type = AbcType::i32,
                                     .values = std::move(counts),
                                     .isCounted = true},
                                    {.name = "curveBasisAndType",
                                     .kind = AbcKind::scalar,
                                     .type = AbcType::u8,
                                     .width = 4,
                                     .values = std::string(kLinearCurves),
                                     .isCounted = true}};
  AbcOutObject hair{.name = "Hair", .metadata = kAbcTransformObject};
  hair.properties = {{.name = ".xform", .metadata = kAbcTransform}};
  hair.children.push_back(std::move(shape));
  AbcOutArchive archive{.metadata = "_ai_Application=Ringlet"};
  archive.objects.push_back(std::move(hair));
  return archive;
}

std::vector<AbcOutProperty>& abcTransformOf(AbcOutArchive& hair) {
  return hair.objects.front().properties.front().parts;
}

std::vector<AbcOutProperty>& abcGeometryOf(AbcOutArchive& hair) {
  return hair.objects.front().children.front().properties.front().parts;
}

void putAbcPoints(std::span<const Vec3f> points, std::string& bytes, std::size_t at) {
  static_assert(sizeof(Vec3f) == 12, "a point is three floats");
  RINGLET_ASSERT(at + points.size_bytes() <= bytes.size(), "there is room for the points");
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(bytes.data() + at, points.data(), points.size_bytes());
  } else {
    std::string numbers;
    for (const Vec3f p : points) {
      for (const float number : {p.x, p.y, p.z}) putAbcU32(numbers, std::bit_cast<std::uint32_t>(number));
    }
    bytes.replace(at, numbers.size(), numbers);
  }
}

std::string abcBoxBytes(const std::array<Vec3f, 2>& corners) {
  std::string bytes;
  for (const Vec3f corner : corners) {
    for (const float number : {corner.x, corner.y, corner.z}) putAbcF64(bytes, number);
  }
  return bytes;
}

}  // namespace ringlet
