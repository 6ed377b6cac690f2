// Tests reference/equations/cloth_contact.h: particles that meet cloth, against the side of its triangles on
// which they are.
#include "reference/equations/cloth_contact.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace ringlet::reference::test::cloth_contact_test {
namespace {

using Vector = Vector3<double>;

constexpr double kKept = 5e-4;
constexpr double kStep = 1.0 / 192;

// A sheet that waves, and travels along X.
struct Sheet {
  static constexpr std::uint32_t kCells = 14;
  double speed = 0;  // [m/s]

  Vector at(double u, double v, double t) const {
    const double x = 0.4 * (u - 0.5), z = 0.4 * (v - 0.5);
    return {x + speed * t, 0.03 * std::sin(12 * x + 20 * t) * std::cos(9 * z - 14 * t), z};
  }
  template <class Real>
  Field<Real> pointsAt(double t) const {
    Field<Real> points;
    for (std::uint32_t j = 0; j <= kCells; ++j)
      for (std::uint32_t i = 0; i <= kCells; ++i)
        points.push_back(at(double(i) / kCells, double(j) / kCells, t).cast<Real>());
    return points;
  }
  static std::vector<ClothTriangle> triangles() {
    std::vector<ClothTriangle> all;
    for (std::uint32_t j = 0; j < kCells; ++j) {
      for (std::uint32_t i = 0; i < kCells; ++i) {
        const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
        all.push_back({a, c, b});
        all.push_back({b, c, d});
      }
    }
    return all;
  }
};

// How far above the triangle that is over or under y, along Y; none: not a number.
template <class Real>
double heightAbove(const Cloth<Real>& cloth, const Vector& y) {
  for (const ClothTriangle& triangle : Sheet::triangles()) {
    const Vector a = cloth.points[triangle[0]].template cast<double>();
    const Vector ab = cloth.points[triangle[1]].template cast<double>() - a;
    const Vector ac = cloth.points[triangle[2]].template cast<double>() - a, way = y - a;
    const double area = ab.x() * ac.z() - ac.x() * ab.z();
    const double v = (way.x() * ac.z() - ac.x() * way.z()) / area;
    const double w = (ab.x() * way.z() - way.x() * ab.z()) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return way.y() - v * ab.y() - w * ac.y();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// A list of which nothing is missing.
template <class Real>
ClothList<Real> everything(const std::vector<ClothTriangle>& triangles) {
  return {.reach = Real(1e3), .triangles = triangles};
}

struct Counts {
  int all = 0, would = 0, crossed = 0, slid = 0, stuck = 0;
  double nearest = 1;  // [m]
};

// Particles on both sides of the sheet, near it and further away, that go with it and besides at `speed`
// [m/s] to all sides, most of them against it, for a step.
template <class Real>
Counts throwAt(const Sheet& sheet, double speed) {
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto triangles = Sheet::triangles();
  Counts counts;
  for (int step = 0; step < 6; ++step) {
    const double t = 0.05 * step;
    const auto points = sheet.pointsAt<Real>(t), next = sheet.pointsAt<Real>(t + kStep);
    const ClothList<Real> all = everything<Real>(triangles);
    const Cloth<Real> cloth{points, next, {&all, &all}}, after{next, next, {&all, &all}};
    for (int k = 0; k < 40; ++k) {
      const double side = uniform(0, 1) < 0.5 ? -1 : 1;
      Vector start = sheet.at(uniform(0.15, 0.85), uniform(0.15, 0.85), t);
      start.y() += side * 1.3 * (kKept + std::pow(10, uniform(-5, -2))) - heightAbove(cloth, start);
      if (nearestOfCloth<Real>(cloth, 0, start.cast<Real>()).distance < Real(kKept)) continue;
      const Vector way = Vector(uniform(-1, 1), -side * uniform(0, 1.5), uniform(-1, 1)).normalized() * speed;
      const Vector carried(sheet.speed * kStep, 0, 0), end = start + carried + way * kStep;
      const ClothWay<Real> whole{start.cast<Real>(), end.cast<Real>(), Real(0), Real(1)};
      const ClothList<Real> list = clothList<Real>(cloth, triangles, whole, kClothListed);
      const auto kept = keptOff<Real>({points, next, {&list, &list}}, whole, Real(kKept));
      const Vector place = kept.place.template cast<double>();
      ++counts.all;
      counts.would += heightAbove(after, end) * side < 0;
      counts.crossed += heightAbove(after, place) * side < 0;
      counts.nearest = std::min(counts.nearest, double(nearestOfCloth<Real>(after, 0, kept.place).distance));
      // What it wanted to go along the cloth, and what it went.
      const Vector n = kept.normal.template cast<double>(), wanted = end - carried - start;
      const Vector along = wanted - n.dot(wanted) * n;
      if (!kept.moved || along.norm() < 1e-4) continue;
      ++counts.slid;
      counts.stuck += (place - carried - start).dot(along) < 0.3 * along.squaredNorm();
    }
  }
  return counts;
}

// The way of a step is up to 10 cm long, over several waves of the sheet.
TEST(ClothContact, NothingCrossesAndLittleSticks) {
  for (const double carried : {0.0, 3.0}) {
    for (const double speed : {0.05, 1.0, 5.0, 20.0}) {
      for (const Counts& counts : {throwAt<double>({carried}, speed), throwAt<float>({carried}, speed)}) {
        const auto text =
            fmt::format("{} m/s, sheet {} m/s: {} of {} would cross, {} do; {} of {} that slide stick", speed,
                        carried, counts.would, counts.all, counts.crossed, counts.stuck, counts.slid);
        fmt::print("{}; {:.3f} mm at least\n", text, 1e3 * counts.nearest);
        EXPECT_GT(counts.would, counts.all / 5) << text;
        EXPECT_EQ(counts.crossed, 0) << text;
        EXPECT_LE(counts.stuck, counts.slid / 20) << text;
        EXPECT_GT(counts.nearest, 0.9 * kKept) << text;
      }
    }
  }
}

// One that begins nearer than is kept stays on its side, and no nearer.
TEST(ClothContact, WhatBeginsNearerStaysOnItsSide) {
  const Sheet sheet;
  const auto triangles = Sheet::triangles();
  const auto points = sheet.pointsAt<double>(0), next = sheet.pointsAt<double>(kStep);
  const ClothList<double> all = everything<double>(triangles);
  const Cloth<double> cloth{points, next, {&all, &all}}, after{next, next, {&all, &all}};
  for (const double side : {-1.0, 1.0}) {
    for (const double above : {1e-5, 1e-4, 3e-4}) {
      Vector start = sheet.at(0.42, 0.57, 0);
      start.y() += side * above - heightAbove(cloth, start);
      const double before = nearestOfCloth<double>(cloth, 0, start).distance;
      const Vector end = start + Vector(0.002, -0.03 * side, 0.001);
      const ClothList<double> list = clothList<double>(cloth, triangles, {start, end, 0, 1}, kClothListed);
      const auto kept = keptOff<double>({points, next, {&list, &list}}, {start, end, 0, 1}, kKept);
      EXPECT_GT(heightAbove(after, kept.place) * side, 0) << above;
      EXPECT_GT(nearestOfCloth<double>(after, 0, kept.place).distance, before - 3e-5) << above;
    }
  }
}

}  // namespace
}  // namespace ringlet::reference::test::cloth_contact_test
