// Implements reference/follow_guide.h.
#include "reference/follow_guide.h"

#include <algorithm>

#include "reference/equations/body_distance.h"
#include "reference/kernels/mesh_field.h"
#include "ringlet/follow/posed_bodies.h"
#include "ringlet/measure/core.h"

namespace ringlet::reference {
namespace {

Rotation<double> rotationOf(const MeasuringFrame& frame) {
  Matrix3<double> axes;
  axes << toEigen<double>(frame.normal), toEigen<double>(frame.binormal), toEigen<double>(frame.tangent);
  return Rotation<double>(axes);
}

Vector3<double> pointOf(const GuidePlace<double>& place) { return place.core + place.frame * place.curl; }

// Beside a point of a hair: a guide's particles, and where between those.
struct Beside {
  double weight = 1;  // of several guides
  const GuidePlace<double>*before = nullptr, *after = nullptr;
  double between = 0;

  GuidePlace<double> place() const { return placeBetween(*before, *after, between); }
};
Beside besideOf(const GuidePose& guide, double along, double weight) {
  const std::size_t k = std::min(static_cast<std::size_t>(along), guide.places.size() - 2);
  double between = along - static_cast<double>(k);
  if (std::ranges::count(guide.pieces, k + 1) > 0) between = between < 0.5 ? 0 : 1;  // beside a cut
  return {weight, &guide.places[k], &guide.places[k + 1], between};
}

// A point of a hair, a share of the way along it.
struct HairPoint {
  Vector3<double> x, root;  // [m]
  double share = 0;
  std::vector<Beside> guides;  // whose weights add up to 1
};

constexpr int kRoundsOutOfGrid = 3;  // from far inside, distances in a grid lead out of it roughly

Vector3<double> outOfBodies(const HairPoint& point, std::span<const Body> bodies,
                            std::span<const BodyPose> poses) {
  Vector3<double> x = point.x;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vector3<double> origin = toEigen<double>(poses[b].position);
    const Rotation<double> turn = toEigen<double>(poses[b].rotation);
    const auto surfaceAt = [&](const Vector3<double>& p) {
      return bodyDistance<double>(bodies[b], turn.conjugate() * (p - origin));
    };
    double ofGuides = 0;
    for (const Beside& guide : point.guides)
      ofGuides += guide.weight * ((1 - guide.between) * surfaceAt(pointOf(*guide.before)).distance +
                                  guide.between * surfaceAt(pointOf(*guide.after)).distance);
    const double kept = keptBesideGuide(ofGuides, surfaceAt(point.root).distance, point.share);
    const int rounds = bodies[b].shape == BodyShape::grid ? kRoundsOutOfGrid : 1;
    for (int round = 0; round < rounds; ++round) {
      const Surface<double> there = surfaceAt(x);
      x += std::max(kept - there.distance, 0.0) * (turn * there.normal);
    }
  }
  return x;
}

// Where on its guide point i of a hair is [particles]. A shorter hair lags behind its guide, but for the
// root; one with points of its own has been told.
double alongGuide(std::size_t i, const FollowHair& hair, std::size_t last, std::span<const OwnPoint> own) {
  if (!own.empty()) return static_cast<double>(own[i].along);
  const double share = static_cast<double>(i) / static_cast<double>(last);
  return static_cast<double>(i) * (1 + (static_cast<double>(hair.length) - 1) * risesOver(0.2, share));
}

}  // namespace

std::size_t pointsBefore(std::size_t begin, const FollowHair& hair, std::size_t points,
                         std::span<const OwnPoint> own) {
  std::size_t i = 0;
  while (i < points && alongGuide(i, hair, points - 1, own) < static_cast<double>(begin) - 0.5) ++i;
  return i;
}

std::vector<Body> bodiesMetAt(std::span<const Body> bodies, std::span<const std::vector<Vec3d>> points) {
  std::vector<Body> met = metByFollowers(bodies);
  const std::vector<std::vector<Vec3d>> metPoints = metByFollowers(bodies, points);
  std::size_t m = 0;
  for (Body& body : met) {
    if (!body.bends()) continue;
    const BendingMesh& mesh = *body.mesh;
    const auto surface = mesh.surface.pointsOf(metPoints.empty() ? mesh.points : metPoints[m++]);
    auto grid = std::make_shared<DistanceGrid>(
        DistanceGrid{.origin = mesh.origin, .cell = mesh.cell, .counts = mesh.counts});
    for (const double cells : meshField<double>(mesh, surface, kMeshBand).distances)
      grid->distances.push_back(static_cast<float>(cells * mesh.cell));
    body.grid = std::move(grid);
    body.mesh = nullptr;
  }
  return met;
}

GuidePose poseGuide(const GuideRest& rest, std::span<const Vec3d> positions, Quatd head) {
  const MeasuringFrame root = rotated(rest.frame, head);
  std::vector<Vec3d> core;
  std::vector<MeasuringFrame> frames;
  for (const GuidePiece& piece : piecesOf(rest)) {
    const auto own = positions.subspan(piece.begin, piece.end - piece.begin);
    const MeasuringFrame before = frames.empty() ? root : frames.back();
    if (piece.window == 0) {  // nothing says which way it goes
      core.insert(core.end(), own.begin(), own.end());
      frames.resize(piece.end, before);
      continue;
    }
    const std::vector<Vec3d> smooth = smoothCore(own, arcsOf(rest, piece), piece.window);
    const std::vector<MeasuringFrame> along = framesAlong(smooth, before);
    core.insert(core.end(), smooth.begin(), smooth.end());
    frames.insert(frames.end(), along.begin(), along.end());
  }
  GuidePose pose{{}, rotationOf(root), rest.pieces};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d curl = positions[i] - core[i];
    const MeasuringFrame& frame = frames[i];
    pose.places.push_back({toEigen<double>(core[i]),
                           {dot(curl, frame.normal), dot(curl, frame.binormal), dot(curl, frame.tangent)},
                           rotationOf(frame)});
  }
  return pose;
}

std::vector<Vec3d> followGuide(const FollowHair& hair, const GuidePose& guide, std::span<const Body> bodies,
                               std::span<const BodyPose> poses, std::optional<Vec3d> rootOnScalp,
                               const OtherPoses& others, std::span<const OwnPoint> own) {
  const std::size_t lastOfGuide = guide.places.size() - 1;
  const std::size_t last = own.empty() ? lastOfGuide : own.size() - 1;
  const Vector3<double> guideRoot = pointOf(guide.places.front());
  const Vector3<double> rootOffset = rootOnScalp
                                         ? Vector3<double>(toEigen<double>(*rootOnScalp) - guideRoot)
                                         : Vector3<double>(guide.rootFrame * toEigen<double>(hair.offset));
  const Vector3<double> root = guideRoot + rootOffset;
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i <= last; ++i) {
    const double along = alongGuide(i, hair, last, own);
    const double share =
        own.empty()
            ? static_cast<double>(i) / static_cast<double>(last)
            : std::min(along / (static_cast<double>(hair.length) * static_cast<double>(lastOfGuide)), 1.0);
    HairPoint point{{}, root, share, {besideOf(guide, along, 1)}};
    const GuidePlace<double> beside = point.guides.front().place();
    point.x = followedPoint(hair, beside, rootOffset, share);
    if (!own.empty()) point.x += beside.frame * toEigen<double>(own[i].shift);
    const Vector3<double> withOwn =
        blendedPoint(hair, toEigen<double>(hair.offset), beside, rootOffset, share);
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (!others[k]) continue;
      const FollowHair::Other& other = hair.others[k];
      const auto weight = static_cast<double>(other.share);
      const double itsLast = static_cast<double>(others[k]->places.size() - 1);
      const Beside besideIt =
          besideOf(*others[k], along / static_cast<double>(lastOfGuide) * itsLast, weight);
      const Vector3<double> fromIts = root - pointOf(others[k]->places.front());
      point.x +=
          weight *
          (blendedPoint(hair, toEigen<double>(other.offset), besideIt.place(), fromIts, share) - withOwn);
      point.guides.front().weight -= weight;
      point.guides.push_back(besideIt);
    }
    const Vector3<double> x = outOfBodies(point, bodies, poses);
    points.push_back({x.x(), x.y(), x.z()});
  }
  return points;
}

std::vector<Vec3d> followGuides(const FollowHair& hair, std::span<const GuidePose> guides,
                                std::span<const Body> bodies, std::span<const BodyPose> poses,
                                std::optional<Vec3d> rootOnScalp, std::span<const OwnPoint> own) {
  OtherPoses others{};
  for (std::size_t k = 0; k < others.size(); ++k)
    if (hair.others[k].share > 0) others[k] = &guides[hair.others[k].guide];
  return followGuide(hair, guides[hair.guide], bodies, poses, rootOnScalp, others, own);
}

}  // namespace ringlet::reference
