// The reference simulation of a whole groom on the CPU, one thread: the same stages in the same order as the
// GPU's list, in float or double. The oracle of the kernel tests, the baseline of the benchmarks, and
// `--backend reference`. Mirrors src/ringlet/solver/simulation.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/bending_motion.h"
#include "reference/kernels/contact_step.h"
#include "reference/kernels/strand_step.h"
#include "ringlet/base/archive.h"
#include "ringlet/crossings/crossing_report.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/strand_cut.h"

namespace ringlet::reference {

/// What happened to the numbers since the simulation began.
struct Report {
  double maxEdgeStretch = 0;          // longest edge over the groom's edge, over every outer step [1]
  std::uint64_t limitedEdges = 0;     // edges, times steps, the stretch limit touched
  std::uint64_t edgeSteps = 0;        // all edges, times steps
  std::uint64_t degenerateEdges = 0;  // edges, times steps, that had no direction
  std::uint64_t nonfinite = 0;        // particles whose position or velocity is not finite now
  std::uint64_t steps = 0;            // outer steps
  std::uint64_t contacts = 0;         // pairs that touch or have not yet broken, now
  double momentumError = 0;           // of the last step's contacts: |sum| over sum of magnitudes [1]
  double freeMomentumError = 0;       // without pinned particles, as a device reports it

  double limitedShare() const {
    return edgeSteps > 0 ? static_cast<double>(limitedEdges) / static_cast<double>(edgeSteps) : 0;
  }
};

template <class Real>
class Simulation {
 public:
  /// The head starts at `start`, coming from `oneStepEarlier` (one outer step before), and the hair moves
  /// with it.
  Simulation(const Groom& groom, const Material& material, const Settings& settings, const HeadPose& start,
             const HeadPose& oneStepEarlier, const PaperMaterial& paper = {},
             std::span<const Body> bodies = {});
  Simulation(const Groom& groom, const Material& material, const Settings& settings,
             const HeadPose& start = {})
      : Simulation(groom, material, settings, start, start) {}

  /// Outer steps; stepPoses[k] is the head's pose at the end of step k. A frame is settings.stepsPerFrame of
  /// them. bodyPoses: as bodyPosesOf gives them; without, all bodies are the head's. rootPoses[step * strands
  /// + strand]: each strand's own pose in the head's frame; without, they stay.
  void stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses = {},
                 std::span<const BodyPose> rootPoses = {}, BodyPoints bodyPoints = {});
  /// Strands' own poses before the first step and one step earlier; puts the hair there, at rest.
  void placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier);
  /// Where bodies are before the first step; without, where they are at t = 0.
  void placeBodies(std::span<const BodyPose> poses) { bodyPoses_.assign(poses.begin(), poses.end()); }

  /// Groom order, relative to the head's origin and its translation, along world axes.
  const Field<Real>& positions() const { return positions_; }    // [m]
  const Field<Real>& velocities() const { return velocities_; }  // [m/s]
  void setState(const Field<Real>& positions, const Field<Real>& velocities);

  /// How far each strand's root moves beside the head, when the head's pose has `shift` 1: in the groom's
  /// axes [m]. Before the first frame.
  void setRootShifts(std::span<const Vec3d> shifts);

  /// Forces from outside on each kilogram of every particle, groom order [m/s^2], until others are set.
  void setForces(std::span<const Vec3f> forces);

  /// Places that particles are pulled to, as Simulation::setGoals of the solver has them: reached at the end
  /// of the next frame.
  void setGoals(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                std::span<const Vec3f> from = {});
  /// As Simulation::setFields of the solver has them.
  void setFields(std::span<const ForceField> fields, std::span<const ForceField> from = {});

  /// Other settings and another material from the next frame on, of the groom it was made from; what may
  /// differ is what the solver's setSettings and setMaterial take, but for contacts. The rest pose stays
  /// balanced against the gravity it began with.
  void change(const Groom& groom, const Material& material, const Settings& settings);

  /// As Simulation::cut of the solver has it, of the groom and material it has: what is cut off is a strand
  /// of its own from then on, behind the one that it was cut from.
  void cut(const Groom& groom, const Material& material, std::span<const StrandCut> cuts);

  /// These strands are carried by their roots in their rest shape, and take no part in anything. The list is
  /// the caller's (RestState::rigid). Before all else; puts the hair at rest.
  void carryRigidly(std::span<const std::uint32_t> strands);

  const HeadPose& head() const { return head_; }
  const Settings& settings() const { return settings_; }
  /// Pieces of a strand that was cut are strands of their own here and in taps().
  const std::vector<RestStrand<Real>>& restStrands() const { return rest_; }
  /// Of each of them, groom order, and one more.
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }
  /// The contacts, with the results of the last outer step; empty unless settings.contacts.on.
  const Contacts<Real>& contacts() const { return contacts_; }
  /// Of settings.contacts.noCrossings, over all steps.
  const CrossingReport& ways() const { return ways_; }
  /// Intermediates of the last outer step, one entry per strand.
  const std::vector<StrandTaps<Real>>& taps() const { return taps_; }

  Report report() const;

  /// All that later frames depend on, as Simulation::checkpoint of the solver has it, and back.
  void archive(Archive& archive);

 private:
  void placeAtRest();
  void findContacts();
  // A rigid strand, with the pose of its root now and one step earlier.
  void placeRigid(std::size_t s);

  // A strand, by the head and its own pose: x = origin + rotation x_groom, relative to the head's origin.
  struct Carried {
    Rotation<double> rotation;
    Vector3<double> origin;
  };
  static Carried carried(const HeadPose& head, const BodyPose& root);

  // Rigidly: seen from the head, hair and head go on as they were. What was cut off stays in the world.
  void carryTo(const HeadPose& next);

  // Step k of a frame of so many.
  void stepOnce(std::size_t k, std::size_t steps, const HeadPose& next, std::span<const BodyPose> bodyPoses,
                const std::vector<BodyPose>& roots);

  void aimAtGroom(const Groom& groom);
  // Before any was cut.
  const std::vector<RestStrand<Real>>& wholeStrands() const { return whole_.empty() ? rest_ : whole_; }
  // Poses of strands as poses of pieces.
  std::vector<BodyPose> ofPieces(std::span<const BodyPose> poses) const;

  RestStrand<Real> restOf(const Groom& groom, const Material& material, const Settings& settings,
                          std::size_t s) const;

  AirStep<Real> airStep(const HeadPose& next) const;
  // Of strand s, in step k of the frame's.
  GoalStep goalStep(std::size_t s, std::size_t k, std::size_t steps) const;
  std::vector<ForceField> fieldsAtStep(std::size_t k, std::size_t steps) const;

  // In double, as headStep.
  std::vector<BodyStep<Real>> bodySteps(std::size_t k, const HeadPose& next,
                                        std::span<const BodyPose> poses) const;

  // For strand s. In double: the head's velocity is a small difference of positions that may be large.
  HeadStep<Real> headStep(const HeadPose& next, std::size_t s, const BodyPose& nextRoot) const;

  std::span<Vector3<Real>> strandOf(Field<Real>& field, std::size_t s) const {
    return std::span(field).subspan(firstPoint_[s], firstPoint_[s + 1] - firstPoint_[s]);
  }

  void record(const RestStrand<Real>& rest, const StrandTaps<Real>& taps);
  // ContactSettings::noCrossings: after the move, from where particles were at the step's start. By the code
  // that the solver has: no kernel does it.
  void keepApart(const HeadPose& next, const Field<Real>& starts);

  Settings settings_;
  Vec3d balancedGravity_;  // of the rest pose [m/s^2]
  PaperMaterial paper_;
  HeadPose previousHead_, head_;                         // poses n - 1 and n
  Field<double> rootShifts_;                             // at HeadPose::shift 1 [m]
  std::vector<BodyPose> previousRootPoses_, rootPoses_;  // of strands in the head's frame, n - 1 and n
  std::vector<std::uint32_t> firstPoint_;                // as in Groom, of pieces
  std::vector<std::uint32_t> strandInGroom_;             // of each piece
  std::vector<StrandPiece> pieces_;                      // likewise, of that strand
  std::vector<Rotation<double>> restTurns_;              // likewise, RestStrand::restTurn
  std::vector<bool> isRigid_;                            // of each strand
  std::vector<Body> bodies_;
  BendingMotion<Real> bending_;
  std::vector<WindMode> windModes_;
  Field<double> forces_;               // from outside; empty: none
  Field<double> goalsBefore_, goals_;  // at the frame's start and end, in the groom's axes [m]; empty: none
  std::vector<double> goalStiffness_, goalDamping_;
  std::vector<ForceField> fieldsBefore_, fields_;  // at the frame's start and end
  std::vector<BodyPose> bodyPoses_;                // at pose n, in the world
  std::vector<RestStrand<Real>> rest_;
  std::vector<RestStrand<Real>> whole_;  // once some were cut
  Field<Real> positions_, velocities_;
  std::vector<StrandSystem> systems_;  // of the current step
  std::vector<StrandTaps<Real>> taps_;
  Contacts<Real> contacts_;
  CrossingReport ways_;
  StepScratch<Real> scratch_;
  Report report_;
};

}  // namespace ringlet::reference
