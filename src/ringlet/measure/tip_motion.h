// What the path of a tip says: how fast it bounces and sways, when it comes to rest. Pure functions of a path
// sampled at a constant rate.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// How many of the last frames stand for the end of a sequence: those of the last second, at most the last
/// half.
std::size_t closingFrameCount(std::size_t frameCount, double framesPerSecond);

/// The strongest frequency in a signal that decays or goes on about 0 from its first value [Hz]: the highest
/// peak of its power spectrum, if it has a twentieth of the spectrum's greatest power and 1.5 periods in the
/// signal. Of a damped oscillation of five periods or more this is its undamped frequency within about 1 %.
/// Nothing where it does not oscillate: no such peak, or fewer than 8 frames. Cost: one Fourier transform of
/// at least 8 times the signal.
std::optional<double> strongestFrequency(std::span<const double> signal, double framesPerSecond);

/// How fast a curl bounces [Hz]: the strongest frequency of its core's length about its final mean. By the
/// length and not by the tip's height, because a curl that hangs at a slant also rises and falls as it sways.
/// Nothing also where the length changes by no more than `smallest` [m].
std::optional<double> bounceFrequency(std::span<const double> coreLengths, double framesPerSecond,
                                      double smallest);

/// How fast a tip sways [Hz]: the strongest frequency of its path, seen from the root, about its final mean,
/// across the axis from the root to there, in the direction in which it moves most. Nothing also where it
/// moves by no more than `smallest` [m].
std::optional<double> swayFrequency(std::span<const Vec3d> path, double framesPerSecond, double smallest);

/// When the path came to rest [s]: from `freeFrame` to the last time it was farther from its final position
/// (the mean of its closing frames) than a hundredth of its greatest distance from there, or than `smallest`
/// [m] where that is more. 0 for a path that rests. Nothing if that was among the closing frames, or if
/// these began before freeFrame: it has not come to rest.
std::optional<double> settleSeconds(std::span<const Vec3d> path, double framesPerSecond,
                                    std::size_t freeFrame, double smallest);

}  // namespace ringlet
