// Look: what hair, bodies and light look like in a picture.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Light that a fibre absorbs over its radius, for red, green and blue; above 0.
using Absorption = Vec3d;

/// Of hair with so much melanin, 0 to 1, of which so much is red (pheomelanin); d'Eon et al. 2011.
Absorption absorptionOfMelanin(double melanin, double redness);
/// Of light that passes a fibre's middle so much is left, each in (0, 1).
Absorption absorptionOfColour(Vec3d colour);

struct Look {
  std::vector<Absorption> pigments = {absorptionOfColour({0.30, 0.13, 0.05}),
                                      absorptionOfColour({0.17, 0.07, 0.028})};  // 2 to 8; hairs are between
  double roughnessAlong = 0.3, roughnessAbout = 0.3;                             // of fibres, in [0.1, 1]
  double tilt = 0.035;                                                           // of their scales [rad]
  double tipRadius = 0.4;      // share of a hair's radius at its tip
  double shadowOpacity = 0.8;  // share of light that a hair keeps from what is behind it
  double throughHair = 0.3;    // brightness of light that came through other hairs
  Vec3d key{4.4, 4.1, 3.7};    // light from the camera's upper left, in front [irradiance]
  Vec3d rim{0.8, 0.88, 1.0};   // and from its upper right, behind
  Vec3d skyAbove{0.65, 0.72, 0.85}, skyBelow{0.30, 0.26, 0.24};         // [radiance]
  Vec3d solid{0.34, 0.27, 0.235};                                       // share that bodies reflect
  Vec3d ground{0.10, 0.10, 0.105};                                      // a ground
  Vec3d cloth{0.045, 0.06, 0.095};                                      // and cloth
  Vec3d backMiddle{0.115, 0.12, 0.132}, backEdge{0.018, 0.020, 0.024};  // behind all [radiance]
  double exposure = 1.15;
};

/// Names of hair colours, separated by commas.
std::string hairColourNames();
/// The look with that colour of hair; none for an unknown name.
std::optional<Look> lookByName(std::string_view colour);

/// Colours of hair that stand for a number of its strand: blue the first, then green and yellow, red the
/// last.
std::vector<Absorption> scalePigments();
/// What hair of each lets through, linear light: from which scalePigments are.
std::vector<Vec3d> scaleColours();
/// The colours of the rainbow, so that strands can be told apart.
std::vector<Absorption> rainbowPigments();

/// Diameter of hairs where nothing says it [m]: 0.18 mm where there are 30,000, and so that any number of
/// them covers as much; at most 1.5 mm.
double widthOfHairs(double count);

}  // namespace ringlet
