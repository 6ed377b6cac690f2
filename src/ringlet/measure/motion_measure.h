// MotionMeasure: measures of hair in motion: its final and its worst shape, how fast it bounces, when it
// comes to rest, and how much energy is left.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet {

struct MotionOptions {
  double framesPerSecond = 24;
  Vec3d up{0, 1, 0};          // unit vector
  double lineDensity = 1e-5;  // [kg/m]; cancels from every ratio
};

/// The worst values of a strand over all frames.
struct WorstMeasure {
  double droop = 0;           // greatest magnitude [m]
  double coreElongation = 1;  // largest
  double arcDrift = 0;        // greatest magnitude
  double maxEdgeStretch = 0;  // largest
  double tipRotation = 0;     // greatest magnitude, unwrapped [degrees]
};

struct StrandMotion {
  StrandMeasure last;  // of the last frame; tipRotation unwrapped over all frames
  WorstMeasure worst;
  std::optional<double> bounceHz, swayHz;  // in frames that the head does not drive (tip_motion.h)
  std::optional<double> settleSeconds;     // since the head last drove it; unset: not settled
  double peakEnergy = 0;                   // kinetic, relative to the root [J]
  double energyRatio = 0;  // mean over the closing frames / peak; 0 if the tip moved no more than rounding
                           // does
};

/// Measures of a frame over all strands.
struct FrameMeasure {
  double droop = 0;           // mean [m]
  double coreElongation = 1;  // mean
  double turns = 0;           // mean over strands that are curled at rest
  double energy = 0;          // kinetic, each strand relative to its root [J]
};

struct MotionReport {
  std::size_t frameCount = 0;
  double seconds = 0;      // from the first frame to the last
  double freeSeconds = 0;  // time at which the head last drove the hair; 0: never
  std::vector<StrandMotion> strands;
  std::vector<FrameMeasure> frames;
  GroomMeasure last;       // of the last frame, over strands
  double peakEnergy = 0;   // of the whole groom [J]
  double energyRatio = 0;  // of the whole groom
};

/// Feed every frame, then ask for the report. The tip is watched and energy counted as seen from the strand's
/// root in the head's turning frame, so that a head that moves evenly gives no motion of the hair. The head
/// drives the hair in frames in which its roots change velocity or it changes its rate of turning; bounce and
/// settling are measured after the last of these.
///
/// Memory: 40 bytes a strand and frame, 32 a frame, 24 a particle. Cost of a frame: some 0.3 us a particle.
class MotionMeasure {
 public:
  /// Errors: those of GroomRuler::make.
  static Result<MotionMeasure> make(const Groom& rest, const MotionOptions& options);

  /// points: as many as in the groom, in its order; metresPerUnit: of these points, 1 for what a Simulation
  /// returns. headRotation: against the rest pose; without one it is fitted to the roots (head_fit.h).
  /// velocities [m/s], of all particles, if they are known; else the energy is that of the mean velocity
  /// since the frame before, and the first frame has none. Errors: a particle that is not finite, with strand
  /// and number; the frame is then left out.
  Status addFrame(std::span<const Vec3f> points, double metresPerUnit,
                  std::optional<Quatd> headRotation = std::nullopt, std::span<const Vec3f> velocities = {});

  /// The report on the frames so far, at least one.
  MotionReport report() const;

  const GroomRuler& ruler() const { return ruler_; }
  std::size_t frameCount() const { return frameCount_; }

 private:
  MotionMeasure(GroomRuler ruler, const MotionOptions& options);
  FrameMeasure summary(std::span<const StrandMeasure> measures, double energy) const;
  void watchHead(Vec3d meanRoot, Quatd headRotation);

  struct StrandHistory {
    StrandMeasure last;
    WorstMeasure worst;
    std::vector<Vec3d> tips;          // relative to the root, in the head's frame [m]
    std::vector<double> coreLengths;  // [m]
    std::vector<double> energies;     // [J]; one a frame, or one fewer without velocities
    std::vector<Vec3d> particles;     // of the last frame, relative to the root, in the head's frame [m]
  };

  GroomRuler ruler_;
  MotionOptions options_;
  std::vector<StrandHistory> strands_;
  std::vector<FrameMeasure> frames_;
  std::size_t frameCount_ = 0;
  std::size_t freeFrame_ = 0;  // the last frame in which the head drove the hair
  Vec3d meanRoots_[2];         // of the last two frames, the later one first [m]
  Quatd headRotations_[2];     // likewise
};

/// The numbers that summarise a whole groom, one for each key of the program's JSON.
struct CurlNumbers {
  std::size_t strandCount = 0, particleCount = 0, frameCount = 0;
  double droop = 0;                     // mean over strands, last frame [m]
  double coreElongation = 1;            // mean over strands, last frame
  double turns = 0;                     // mean over strands that are curled at rest, last frame
  double meanRadius = 0;                // mean over strands that are curled at rest, last frame [m]
  bool handednessKept = true;           // every strand over kHandKeptShare of its curled length, last frame
  double arcDrift = 0;                  // worst strand and frame, signed
  double maxEdgeStretch = 1;            // worst strand and frame
  double tipRotation = 0;               // worst strand of the last frame, signed, unwrapped [degrees]
  std::optional<double> bounceHz;       // mean over the strands that bounce
  std::optional<double> swayHz;         // mean over the strands that sway
  std::optional<double> settleSeconds;  // of the last strand to settle; unset if some strand has not
  std::optional<double> energyRatio;    // of the whole groom; unset without motion
  double worstDroop = 0;                // greatest magnitude over strands and frames, signed [m]
  double worstCoreElongation = 1;       // largest over strands and frames
  double worstTipRotation = 0;          // greatest magnitude over strands and frames, signed [degrees]
};

/// A strand has kept its handedness if this share of its curled length has; where it changes hand at rest,
/// that place may move a little.
inline constexpr double kHandKeptShare = 0.95;

/// The report on a single pose, without frames and motion.
CurlNumbers curlNumbers(const GroomRuler& ruler, std::span<const StrandMeasure> measures);
/// The report on a motion.
CurlNumbers curlNumbers(const GroomRuler& ruler, const MotionReport& report);

}  // namespace ringlet
