// Vec3 and Quat: the little mathematics the public interface needs (heavier work uses Eigen, in reference/
// only).
#pragma once

#include <cmath>

namespace ringlet {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  Vec3 operator+(Vec3 o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec3 operator-(Vec3 o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec3 operator-() const { return {-x, -y, -z}; }
  Vec3 operator*(T s) const { return {x * s, y * s, z * s}; }
  Vec3 operator/(T s) const { return {x / s, y / s, z / s}; }
  Vec3& operator+=(Vec3 o) { return *this = *this + o; }
  Vec3& operator-=(Vec3 o) { return *this = *this - o; }
  bool operator==(const Vec3&) const = default;

  template <class U>
  explicit operator Vec3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};
template <class T>
Vec3<T> operator*(T s, Vec3<T> v) {
  return v * s;
}
template <class T>
T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
bool isFinite(Vec3<T> v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
template <class T>
T length(Vec3<T> v) {
  return std::sqrt(dot(v, v));
}
/// v / |v|, or `fallback` for the zero vector.
template <class T>
Vec3<T> normalizedOr(Vec3<T> v, Vec3<T> fallback) {
  T l = length(v);
  return l > T(0) ? v / l : fallback;
}

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

/// v as floats store it. `volatile`: GCC 12 takes a pair of doubles that is rounded to floats and back for
/// the pair itself.
inline Vec3d asStored(Vec3d v) {
  const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
  return {double{x}, double{y}, double{z}};
}

/// Any unit vector across a unit vector, always the same for the same one.
inline Vec3d anyNormal(Vec3d direction) {
  const Vec3d axis = std::abs(direction.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  return normalizedOr(cross(direction, axis), Vec3d{0, 0, 1});
}

/// A unit quaternion; rotates column vectors. (a * b) turns by b first, then by a.
template <class T>
struct Quat {
  T x{}, y{}, z{}, w{1};

  Quat operator*(Quat b) const {
    return {w * b.x + x * b.w + y * b.z - z * b.y, w * b.y - x * b.z + y * b.w + z * b.x,
            w * b.z + x * b.y - y * b.x + z * b.w, w * b.w - x * b.x - y * b.y - z * b.z};
  }
  Quat conjugate() const { return {-x, -y, -z, w}; }
  bool operator==(const Quat&) const = default;

  template <class U>
  explicit operator Quat<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z), static_cast<U>(w)};
  }
};
template <class T>
Vec3<T> rotate(Quat<T> q, Vec3<T> v) {
  Vec3<T> u{q.x, q.y, q.z}, t = cross(u, v) * T(2);
  return v + t * q.w + cross(u, t);
}
template <class T>
Quat<T> normalized(Quat<T> q) {
  T l = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x / l, q.y / l, q.z / l, q.w / l};
}
/// The turn by |rotation| radians about its direction.
template <class T>
Quat<T> fromRotationVector(Vec3<T> rotation) {
  T angle = length(rotation);
  if (angle == T(0)) return {};
  Vec3<T> u = rotation * (std::sin(angle / 2) / angle);
  return {u.x, u.y, u.z, std::cos(angle / 2)};
}
/// Spherical interpolation by the shorter way, s in [0, 1].
template <class T>
Quat<T> slerp(Quat<T> a, Quat<T> b, T s) {
  T c = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  if (c < 0) {
    b = {-b.x, -b.y, -b.z, -b.w};
    c = -c;
  }
  T wa = 1 - s, wb = s;
  if (c < T(0.9999)) {
    T angle = std::acos(c);
    wa = std::sin(wa * angle) / std::sin(angle);
    wb = std::sin(wb * angle) / std::sin(angle);
  }
  return normalized(
      Quat<T>{wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z, wa * a.w + wb * b.w});
}

using Quatf = Quat<float>;
using Quatd = Quat<double>;

}  // namespace ringlet
