// Where a point of a hair is that follows a guide. The guide's curl is its particles less its core, seen from
// the frame F that parallel transport carries along the core; a hair has that curl, turned and scaled, about
// a core of its own, the guide's shifted by its offset d. With s the share of the way from root to tip,
//
//     r = smoothstep(0, 1/5, s),   k = 1 + (spread - 1) smoothstep(0, 2/5, s)
//     x = c + F Rz(r phase) z (1 + (radius - 1) r) + k ((1 - r) e + r F d)
//
// At the root x is the guide's root + e: a hair's root stays where it is on the scalp, however its guide
// bends there. e is F_root d, with F_root the frame at rest carried by the head, or what a scalp that bends
// makes of it. The idea is Choe and Ko's (2005, wisps: a master strand and variation about it).
//
// A hair may follow up to three guides. Blended positions of curls would be no curls, so what is blended are
// cores: guides 2 and 3, with shares w_j, the hair's offsets d_j and e_j from them and z_j, F_j as they have
// them at the same share of their own way, move x by
//
//     sum_j w_j (y_j - y_1),   y_j = c_j + (1 - r) F_j z_j + k ((1 - r) e_j + r F_j d_j)
//
// Beyond the first fifth the hair has the curl of guide 1 about the blended core. At the root every y_j is
// the hair's root, as e_j goes from guide j's root to it: there nothing moves.
//
// A hair of a groom has its own shape at rest and its own points (OwnPoints): x moves by F q beside it, with
// q what at rest is left between the hair's point and where the above has it, along F.
//
// Bodies hold guides out, and hairs are beside them. With d_x, D, D_root the distances of the body's surface
// from the point, from the guide beside it (between two particles, what is between theirs, since particles
// are what bodies hold out) and from the hair's root, negative inside, the point goes out of the body by
//
//     max(h - d_x, 0),  h = min(0, D, (1 - r) D_root)
//
// where D of several guides is the sum of w_j D_j. So it goes no further than its guide is out: a guide that
// passes through a body takes its hairs along, where a hair of its own mind would jump. Roots stay on the
// scalp, which may be some way inside. Distances in a grid lead out of it only roughly from far inside, so
// that points leave it in three such moves.
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/fields.h"
#include "ringlet/follow/follow_hairs.h"

namespace ringlet::reference {

/// Of a guide, at one place along it.
template <class Real>
struct GuidePlace {
  Vector3<Real> core;    // [m]
  Vector3<Real> curl;    // of the strand from its core, along `frame` [m]
  Rotation<Real> frame;  // takes normal, binormal, tangent to the world's axes
};

/// 0 up to 0, 1 from `end` on, smooth between.
template <class Real>
Real risesOver(Real end, Real share) {
  const Real x = std::clamp(share / end, Real(0), Real(1));
  return x * x * (3 - 2 * x);
}

/// Between two places; frames the shorter way. A curl turns from place to place, so its length goes from one
/// to the other too: a straight way between them would cut the corners of every turn.
template <class Real>
GuidePlace<Real> placeBetween(const GuidePlace<Real>& a, const GuidePlace<Real>& b, Real share) {
  const Real sign = a.frame.dot(b.frame) < 0 ? Real(-1) : Real(1);
  Rotation<Real> frame;
  frame.coeffs() = (1 - share) * a.frame.coeffs() + share * sign * b.frame.coeffs();
  const Vector3<Real> curl = (1 - share) * a.curl + share * b.curl;
  const Real length = (1 - share) * a.curl.norm() + share * b.curl.norm();
  return {(1 - share) * a.core + share * b.core, length * directionOr(curl, Vector3<Real>::Zero()),
          frame.normalized()};
}

/// `share`: of the way from root to tip. `rootOffset`: e [m]. [m]
template <class Real>
Vector3<Real> followedPoint(const FollowHair& hair, const GuidePlace<Real>& place,
                            const Vector3<Real>& rootOffset, Real share) {
  const Real r = risesOver(Real(1) / 5, share);
  const Real angle = r * static_cast<Real>(hair.phase);
  const Real scale = 1 + (static_cast<Real>(hair.radius) - 1) * r;
  const Real spread = 1 + (static_cast<Real>(hair.spread) - 1) * risesOver(Real(2) / 5, share);
  const Vector3<Real>& z = place.curl;
  const Vector3<Real> curl = {std::cos(angle) * z.x() - std::sin(angle) * z.y(),
                              std::sin(angle) * z.x() + std::cos(angle) * z.y(), z.z()};
  const Vector3<Real> offset = toEigen<Real>(hair.offset);
  return place.core + place.frame * (scale * curl) +
         spread * ((1 - r) * rootOffset + r * (place.frame * offset));
}

/// Of one of several guides: y [m]. `offset`: d_j [m]; `rootOffset`: e_j [m].
template <class Real>
Vector3<Real> blendedPoint(const FollowHair& hair, const Vector3<Real>& offset, const GuidePlace<Real>& place,
                           const Vector3<Real>& rootOffset, Real share) {
  const Real r = risesOver(Real(1) / 5, share);
  const Real spread = 1 + (static_cast<Real>(hair.spread) - 1) * risesOver(Real(2) / 5, share);
  return place.core + (1 - r) * (place.frame * place.curl) +
         spread * ((1 - r) * rootOffset + r * (place.frame * offset));
}

/// h, from distances [m] from the surface of a body, negative inside: of the guide beside a point, and of the
/// root.
template <class Real>
Real keptBesideGuide(Real ofGuide, Real ofRoot, Real share) {
  return std::min({Real(0), ofGuide, (1 - risesOver(Real(1) / 5, share)) * ofRoot});
}

}  // namespace ringlet::reference
