// Implements motion/bust_motion.h: linear blend skinning by joints of the neck, the head and the shoulders,
// with weights that are functions of a point's place at rest.
#include "ringlet/motion/bust_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ringlet/bodies/bust_mesh.h"
#include "ringlet/bodies/cape_mesh.h"

namespace ringlet {
namespace {

// By eye, in the axes of the mesh [m].
constexpr Vec3d kNeckJoint{0, -0.165, -0.035}, kHeadJoint{0, -0.08, -0.01};
constexpr double kNeckNod = 15 * std::numbers::pi / 180, kHeadNod = 20 * std::numbers::pi / 180;
constexpr Vec3d kShrug{0.008, 0.04, 0};  // of a shoulder, inwards and up
// A joint's share grows from 0 to 1 along a height, and of a shoulder along the width. Heights lean: the chin
// is the head's, and so is the nape, which is as high.
constexpr double kLean = 0.3;
constexpr double kNeckFrom = -0.21, kNeckTo = -0.13, kHeadFrom = -0.155, kHeadTo = -0.085;
constexpr double kShoulderFrom = 0.01, kShoulderTo = 0.16, kChestFrom = -0.36, kChestTo = -0.23;

constexpr double kNodStart = 0.25, kNodHeld = 0.4, kShrugStart = 2.1, kShrugHeld = 0.2, kRise = 0.6;  // [s]
constexpr double kEnd = kShrugStart + 2 * kRise + kShrugHeld;

// A wind lifts the cape's hem: so far at most [m], in waves that run down it and round it.
constexpr double kBillow = 0.07, kWindStart = 0.1, kWindHeld = 2.1, kWavesASecond = 1.2;
constexpr double kWavesDown = 0.7, kWavesRound = 3;

// From 0 to 1, without a jolt at either end.
double eased(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

double share(double low, double high, double x) { return eased((x - low) / (high - low)); }

// Rises, is held, sinks.
double pulse(double t, double start, double held) {
  return eased((t - start) / kRise) - eased((t - start - kRise - held) / kRise);
}

Vec3d turnedAbout(Vec3d joint, double angle, Vec3d p) {
  return joint + rotate(fromRotationVector(Vec3d{angle, 0, 0}), p - joint);
}

// What the bust wears moves with it.
class BustMotion final : public MeshMotion {
 public:
  // hang: of each point, how much of the wind it has; empty: there is none.
  explicit BustMotion(TriangleMesh rest, std::vector<double> hang = {})
      : rest_(std::move(rest)), hang_(std::move(hang)) {}

  const std::vector<Triangle>& triangles() const override { return rest_.triangles; }
  std::size_t pointCount() const override { return rest_.points.size(); }
  double firstSeconds() const override { return 0; }
  double lastSeconds() const override { return kEnd; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

  std::vector<Vec3d> pointsAt(double t) const override {
    const double nod = pulse(t, kNodStart, kNodHeld), shrug = pulse(t, kShrugStart, kShrugHeld);
    std::vector<Vec3d> points = rest_.points;
    for (std::size_t i = 0; i < hang_.size(); ++i) points[i] += billow(rest_.points[i], hang_[i], t);
    for (Vec3d& p : points) {
      const double height = p.y + kLean * p.z;
      const double byNeck = share(kNeckFrom, kNeckTo, height), byHead = share(kHeadFrom, kHeadTo, height);
      const double byShoulder = shrug * share(kShoulderFrom, kShoulderTo, std::abs(p.x)) *
                                share(kChestFrom, kChestTo, p.y) * (1 - byNeck);
      const Vec3d withNeck = turnedAbout(kNeckJoint, nod * kNeckNod, p);
      const Vec3d withHead =
          turnedAbout(kNeckJoint, nod * kNeckNod, turnedAbout(kHeadJoint, nod * kHeadNod, p));
      const Vec3d raised{-std::copysign(kShrug.x, p.x), kShrug.y, kShrug.z};
      p +=
          (withNeck - p) * (byNeck * (1 - byHead)) + (withHead - p) * (byNeck * byHead) + raised * byShoulder;
    }
    return points;
  }

 private:
  static Vec3d billow(Vec3d p, double hang, double t) {
    const double round = std::atan2(p.x, p.z), wind = pulse(t, kWindStart, kWindHeld);
    const double phase = 2 * std::numbers::pi * (kWavesASecond * t - kWavesDown * hang) + kWavesRound * round;
    return Vec3d{std::sin(round), 0, std::cos(round)} * (kBillow * hang * wind * (1 + std::sin(phase)) / 2);
  }

  TriangleMesh rest_;
  std::vector<double> hang_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::shared_ptr<const MeshMotion> generatedMotion(std::string_view name) {
  if (name == "bust") return std::make_shared<const BustMotion>(makeBustMesh());
  if (name != "cape") return nullptr;
  CapeMesh cape = makeCapeMesh();
  return std::make_shared<const BustMotion>(std::move(cape.mesh), std::move(cape.hang));
}

}  // namespace ringlet
