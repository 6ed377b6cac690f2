// The types a strand is written in here: a field is one vector per particle or per edge, root first.
// Mirrors nothing; the shaders have vec3 and buffers instead.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <type_traits>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet::reference {

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
template <class Real>
using Rotation = Eigen::Quaternion<Real>;

template <class Real>
using Field = std::vector<Vector3<Real>>;
template <class Real>
using Scalars = std::vector<Real>;
/// A strand's part of a field that holds all strands. type_identity, so that a Field may be handed over as it
/// is.
template <class Real>
using FieldView = std::type_identity_t<std::span<Vector3<Real>>>;

template <class Real, class T>
Vector3<Real> toEigen(const Vec3<T>& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}
template <class Real, class T>
Rotation<Real> toEigen(const Quat<T>& q) {
  return {static_cast<Real>(q.w), static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z)};
}

/// The numbers of a field, one after the other.
template <class Real>
std::span<Real> numbersOf(Field<Real>& field) {
  return {field.empty() ? nullptr : field.front().data(), 3 * field.size()};
}

/// v / |v|; for the zero vector `fallback`.
template <class Real>
Vector3<Real> directionOr(const Vector3<Real>& v, const std::type_identity_t<Vector3<Real>>& fallback) {
  const Real length = v.norm();
  return length > Real(0) ? Vector3<Real>(v / length) : fallback;
}

}  // namespace ringlet::reference
