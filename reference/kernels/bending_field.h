// A body that bends: its field at one time, and the surface carried on from there. Mirrors
// shaders/shared/bending_buffers.glsl and mesh_ways.comp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/equations/body_distance.h"
#include "reference/equations/cloth_contact.h"
#include "reference/fields.h"
#include "reference/kernels/mesh_field.h"
#include "ringlet/scene/body.h"

namespace ringlet::reference {

/// The field of a body for its points at one time, and how its triangles move to the next time.
template <class Real>
struct BendingField {
  DistanceGrid grid;
  std::vector<std::uint32_t> triangles;  // nearest to each corner, or none
  std::vector<Vector3<Real>> ways;       // of each triangle, the mean of its points [m]
  // Of cloth, which has no grid:
  const BendingMesh* cloth = nullptr;
  Field<Real> points, next;

  /// Of the triangle nearest to the corner nearest to y; none may be near.
  Vector3<Real> wayNear(const Vector3<Real>& y) const {
    const std::uint32_t triangle = nearest(y);
    return triangle == MeshField<Real>::kNone ? Vector3<Real>(Vector3<Real>::Zero()) : ways[triangle];
  }
  bool isNear(const Vector3<Real>& y) const { return nearest(y) != MeshField<Real>::kNone; }
  std::uint32_t nearest(const Vector3<Real>& y) const {
    const Vector3<Real> inCells = (y - toEigen<Real>(grid.origin)) / static_cast<Real>(grid.cell);
    std::uint32_t corner[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Real most = static_cast<Real>(grid.counts[std::size_t(axis)]);
      corner[axis] = static_cast<std::uint32_t>(std::clamp(std::nearbyint(inCells[axis]), Real(0), most));
    }
    return triangles[grid.cornerIndex(corner[0], corner[1], corner[2])];
  }
};

/// points, next: of the surface at this time and at the next, in the frame of what carries it [m].
template <class Real>
BendingField<Real> bendingField(const BendingMesh& mesh, std::span<const Vec3d> points,
                                std::span<const Vec3d> next, Real band);

/// A body at a time: the one of its field, moved on by a share of the way to the next field. Of a body that
/// does not bend there is no field.
template <class Real>
struct BodyShapeAt {
  const Body* body = nullptr;
  const BendingField<Real>* field = nullptr;
  Real share = 0;
  std::array<const ClothList<Real>*, 2> lists{};  // of cloth, what is known of it
  Real later = 0;                                 // see Cloth

  bool isCloth() const { return field && field->cloth; }
  Cloth<Real> asCloth() const { return {field->points, field->next, lists, later}; }
  /// How the surface near y moves to the next time [m]; of cloth, near the start of the particle that it is
  /// about.
  Vector3<Real> wayNear(const Vector3<Real>& y) const {
    return isCloth() ? lists[0]->way : field->wayNear(y);
  }
  bool isNear(const Vector3<Real>& y) const { return isCloth() || field->isNear(y); }
};
template <class Real>
Surface<Real> bodyDistance(const BodyShapeAt<Real>& at, const Vector3<Real>& y) {
  if (!at.field) return bodyDistance<Real>(*at.body, y);
  if (at.isCloth()) {
    const ClothPlace<Real> place = nearestOfCloth<Real>(at.asCloth(), at.share, y);
    return {place.distance - static_cast<Real>(at.body->thickness), place.normal};
  }
  Surface<Real> surface =
      gridDistance<Real>(at.field->grid, Vector3<Real>(y - at.share * at.field->wayNear(y)));
  surface.distance -= static_cast<Real>(at.body->thickness);
  return surface;
}

/// Of cloth that an edge dips into, the way back to the side of its ends, if both are on one.
template <class Real>
Surface<Real> distanceBetween(const BodyShapeAt<Real>& at, const Vector3<Real>& y,
                              const Vector3<Real>& side) {
  const Surface<Real> surface = bodyDistance<Real>(at, y);
  const bool dips = side.squaredNorm() > Real(kOneSide) && surface.normal.dot(side) < Real(0);
  if (!at.isCloth() || !dips) return surface;
  return {-surface.distance - 2 * static_cast<Real>(at.body->thickness), -surface.normal};
}

template <class Real>
bool goesThrough(const BodyShapeAt<Real>& at, const Surface<Real>& surface, const Vector3<Real>& side) {
  return at.isCloth() && side.squaredNorm() <= Real(kOneSide) &&
         surface.distance + static_cast<Real>(at.body->thickness) < Real(kThrough);
}

}  // namespace ringlet::reference
