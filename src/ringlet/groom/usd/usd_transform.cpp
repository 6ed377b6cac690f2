// Implements groom/usd/usd_transform.h.
#include "ringlet/groom/usd/usd_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "ringlet/base/quoted.h"

namespace ringlet {
namespace {

constexpr std::string_view kPrefix = "xformOp:", kInvert = "!invert!", kReset = "!resetXformStack!";

// About x, y or z (0, 1, 2), in rows.
UsdTransform turnAbout(std::size_t axis, double degrees) {
  const double angle = degrees * (std::numbers::pi / 180), c = std::cos(angle), s = std::sin(angle);
  if (axis == 0) return {{Vec3d{1, 0, 0}, Vec3d{0, c, s}, Vec3d{0, -s, c}}, {}};
  if (axis == 1) return {{Vec3d{c, 0, -s}, Vec3d{0, 1, 0}, Vec3d{s, 0, c}}, {}};
  return {{Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}}, {}};
}

UsdTransform turnBy(Quatd q) {
  return {{rotate(q, Vec3d{1, 0, 0}), rotate(q, Vec3d{0, 1, 0}), rotate(q, Vec3d{0, 0, 1})}, {}};
}

std::optional<UsdTransform> inverseOf(const UsdTransform& t) {
  const auto& [a, b, c] = t.rows;
  const Vec3d bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = dot(a, bc);
  if (!(std::abs(determinant) > 0) || !std::isfinite(1 / determinant)) return std::nullopt;
  UsdTransform inverse{{Vec3d{bc.x, ca.x, ab.x} / determinant, Vec3d{bc.y, ca.y, ab.y} / determinant,
                        Vec3d{bc.z, ca.z, ab.z} / determinant},
                       {}};
  inverse.move = -inverse.turned(t.move);
  return inverse;
}

std::size_t axisOf(char letter) { return static_cast<std::size_t>(letter - 'X'); }

// "rotateZXY" -> {2, 0, 1}.
bool isTurn(std::string_view kind) {
  std::string axes(kind.substr(std::min<std::size_t>(6, kind.size())));
  if (!kind.starts_with("rotate")) return false;
  if (axes.size() == 1) return axes[0] >= 'X' && axes[0] <= 'Z';
  std::ranges::sort(axes);
  return axes == "XYZ";
}

// How many numbers an op has; 0: there is no such op.
std::size_t widthOf(std::string_view kind) {
  if (kind == "translate" || kind == "scale") return 3;
  if (kind == "orient") return 4;
  if (kind == "transform") return 16;
  if (isTurn(kind)) return kind.size() == 7 ? 1 : 3;
  const bool isOneAxis = kind.size() > 1 && kind.back() >= 'X' && kind.back() <= 'Z';
  const std::string_view all = kind.substr(0, kind.size() - isOneAxis);
  return isOneAxis && (all == "translate" || all == "scale") ? 1 : 0;
}

// Of an op with as many numbers as it needs.
Result<UsdTransform> transformOf(std::string_view kind, const std::vector<double>& n) {
  UsdTransform t;
  if (kind == "transform") {
    if (n[3] != 0 || n[7] != 0 || n[11] != 0 || n[15] != 1)
      return Error{"found a matrix whose last column is not 0, 0, 0, 1; expected an affine one"};
    return UsdTransform{{Vec3d{n[0], n[1], n[2]}, Vec3d{n[4], n[5], n[6]}, Vec3d{n[8], n[9], n[10]}},
                        Vec3d{n[12], n[13], n[14]}};
  }
  if (kind == "orient") {
    const Quatd q{n[1], n[2], n[3], n[0]};
    const double size = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
    if (!(size > 0)) return Error{"found a quaternion of 0; expected a turn"};
    return turnBy({q.x / size, q.y / size, q.z / size, q.w / size});
  }
  if (isTurn(kind)) {
    const std::string_view axes = kind.substr(6);
    for (char letter : axes) {
      const std::size_t axis = axisOf(letter);
      t = t.then(turnAbout(axis, n[axes.size() == 1 ? 0 : axis]));
    }
    return t;
  }
  const bool moves = kind.starts_with("translate");
  Vec3d v = moves ? Vec3d{} : Vec3d{1, 1, 1};
  if (n.size() == 3) {
    v = {n[0], n[1], n[2]};
  } else {
    (kind.back() == 'X' ? v.x : kind.back() == 'Y' ? v.y : v.z) = n[0];
  }
  if (moves) return UsdTransform{t.rows, v};
  return UsdTransform{{Vec3d{v.x, 0, 0}, Vec3d{0, v.y, 0}, Vec3d{0, 0, v.z}}, {}};
}

// An entry of the order; nothing where it has no value.
Result<std::optional<UsdTransform>> opOf(const UsdPrim& prim, std::string_view entry) {
  const std::string shown = quoted(entry);
  const bool isInverse = entry.starts_with(kInvert);
  const std::string_view name = entry.substr(isInverse ? kInvert.size() : 0);
  const auto found = std::ranges::find(prim.attributes, name, &UsdAttribute::name);
  if (found == prim.attributes.end()) return std::optional<UsdTransform>();
  std::string_view kind = name.substr(std::min(name.starts_with(kPrefix) ? kPrefix.size() : 0, name.size()));
  kind = kind.substr(0, kind.find(':'));
  const std::size_t width = name.starts_with(kPrefix) ? widthOf(kind) : 0;
  if (width == 0) {
    return Error{fmt::format(
        "{} is not known; expected translate, scale, rotateX, rotateXYZ and the like, orient or transform "
        "after 'xformOp:'",
        shown)};
  }
  if (!found->drivenBy.empty()) {
    return Error{
        fmt::format("{} is given by {}, which is not followed; expected numbers", shown, found->drivenBy)};
  }
  const std::vector<double>& numbers = found->value.numbers;
  if (numbers.empty()) return std::optional<UsdTransform>();
  if (numbers.size() != width)
    return Error{fmt::format("{} has {} numbers; expected {}", shown, numbers.size(), width)};
  for (double number : numbers) {
    if (!std::isfinite(number))
      return Error{fmt::format("{} has {}; expected finite numbers", shown, number)};
  }
  auto transform = transformOf(kind, numbers);
  if (!transform) return Error{fmt::format("{}: {}", shown, transform.error().message)};
  if (!isInverse) return std::optional(*transform);
  const auto inverse = inverseOf(*transform);
  if (!inverse) return Error{fmt::format("{} has no inverse", shown)};
  return inverse;
}

}  // namespace

Result<UsdPlacement> usdPlacementOf(const UsdPrim& prim) {
  UsdPlacement placement;
  const auto order = std::ranges::find(prim.attributes, "xformOpOrder", &UsdAttribute::name);
  if (order == prim.attributes.end()) return placement;
  if (!order->drivenBy.empty())
    return Error{fmt::format("'xformOpOrder' is given by {}, which is not followed", order->drivenBy)};
  if (order->value.texts.size() > kMostUsdAttributes) {
    return Error{fmt::format("'xformOpOrder' has {} entries; at most {} are read", order->value.texts.size(),
                             kMostUsdAttributes)};
  }
  for (const std::string_view entry : order->value.texts) {
    if (entry == kReset) {
      placement = {};
      placement.isOfWorld = true;
      continue;
    }
    const auto op = opOf(prim, entry);
    if (!op) return op.error();
    if (!*op) {
      placement.valueless.push_back(quoted(entry));
    } else {
      placement.transform = (*op)->then(placement.transform);
    }
  }
  return placement;
}

}  // namespace ringlet
