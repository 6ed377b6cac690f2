// Curls as real hair has them: their hand, tightness or radius changes along the strand.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet::test {

/// A curl along -Y whose rate [turns per share of the strand; negative: left-handed] and radius [m] vary with
/// the share s of the strand from its root.
struct VaryingCurl {
  const char* name;
  double (*rate)(double s);
  double (*radius)(double s);
};

/// From a to b at s = 0.5, over a tenth of the strand.
inline double change(double s, double a, double b) {
  return a + (b - a) * std::clamp(10 * (s - 0.45), 0.0, 1.0);
}
inline double full(double) { return 0.01; }

inline const std::vector<VaryingCurl>& varyingCurls() {
  static const std::vector<VaryingCurl> curls{
      {"a perversion", [](double s) { return change(s, 8, -8); }, full},
      {"a tight perversion", [](double s) { return change(s, 16, -16); }, full},
      {"three perversions", [](double s) { return change(s < 0.5 ? 2 * s : 2 - 2 * s, 12, -12); }, full},
      {"tighter to the tip", [](double s) { return change(s, 5, 15); }, full},
      {"looser to the tip", [](double s) { return change(s, 15, 5); }, full},
      {"wider to the tip", [](double) { return 8.0; }, [](double s) { return 0.004 + 0.012 * s; }},
      {"narrower to the tip", [](double) { return 8.0; }, [](double s) { return 0.016 - 0.012 * s; }},
      {"a straight root", [](double) { return 10.0; }, [](double s) { return change(s, 0, 0.01); }},
      {"a straight tip", [](double) { return 10.0; }, [](double s) { return change(s, 0.01, 0); }},
  };
  return curls;
}

/// One strand of each, 25 cm long.
inline Groom varyingGroom(int particles) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (const VaryingCurl& curl : varyingCurls()) {
    std::vector<Vec3f> strand;
    double angle = 0;
    for (int i = 0; i < particles; ++i) {
      const double s = double(i) / (particles - 1);
      strand.push_back(
          Vec3f(Vec3d{curl.radius(s) * std::cos(angle), -0.25 * s, curl.radius(s) * std::sin(angle)}));
      angle += 2 * std::numbers::pi * curl.rate(s) / (particles - 1);
    }
    groom.addStrand(strand);
  }
  return groom;
}

}  // namespace ringlet::test
