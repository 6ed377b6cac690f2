// Measures of a tip's path: how fast it bounces and sways, and when it comes to rest. Pure functions of a
// path sampled at a constant rate.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// The number of closing frames, which represent the end of a sequence: those of the last second, at most
/// half of all.
std::size_t closingFrameCount(std::size_t frameCount, double framesPerSecond);

/// The strongest frequency of a signal that oscillates about 0 from its first value, decaying or not [Hz]:
/// the highest peak of its power spectrum, if it has at least a twentieth of the greatest power and 1.5
/// periods in the signal. For a damped oscillation of five periods or more this is the undamped frequency
/// within about 1 %. None if it does not oscillate: no such peak, or fewer than 8 frames. Cost: one Fourier
/// transform of at least 8 times the signal's length.
std::optional<double> strongestFrequency(std::span<const double> signal, double framesPerSecond);

/// How fast a curl bounces [Hz]: the strongest frequency of its core's length about its final mean. The
/// length is used and not the tip's height, because a curl that hangs at a slant also rises and falls as it
/// sways. Also none if the length changes by no more than `smallest` [m].
std::optional<double> bounceFrequency(std::span<const double> coreLengths, double framesPerSecond,
                                      double smallest);

/// How fast a tip sways [Hz]: the strongest frequency of its path, relative to the root, about its final
/// mean, perpendicular to the axis from the root to there, in the direction in which it moves most. Also none
/// if it moves by no more than `smallest` [m].
std::optional<double> swayFrequency(std::span<const Vec3d> path, double framesPerSecond, double smallest);

/// When the path came to rest [s], from `freeFrame`: the last time it was farther from its final position
/// (the mean of its closing frames) than a hundredth of its greatest distance from there, or than `smallest`
/// [m] if that is more. 0 for a path at rest. None if that was within the closing frames, or if these begin
/// before freeFrame: it has not come to rest.
std::optional<double> settleSeconds(std::span<const Vec3d> path, double framesPerSecond,
                                    std::size_t freeFrame, double smallest);

}  // namespace ringlet
