// The plan of a frame: its stages, in order. Only this file knows the order: simulation_frames.cpp records
// the plan in one loop, and frames of divided hair end a submission at each exchange (divided_frames.cpp).
// Pure: no device. Mirrored by reference/kernels/contact_step.h and volume_step.h, which keep an order of
// their own to check this one.
//   inputs -> bodies -> solve v^0 -> motion, grid, lists, touch, sums, means -> solve v^1
//          -> next, sums, means -> solve v^2 ... -> move, and the next step's v^0 -> motion ...
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "ringlet/rest/rest_contacts.h"
#include "ringlet/solver/plan/dispatch_plan.h"

namespace ringlet {

enum class FrameStage : std::uint8_t {
  inputs,    // copies what the host wrote for the frame to the device
  bodies,    // fields of bodies that bend, for the times of the frame
  steps,     // all steps of strands without contacts, if there is no cloth
  solve,     // a pass of the strand kernels
  motion,    // how far contact particles have moved since their lists were made
  grid,      // sorts contact particles into a search grid, if lists are to be made
  lists,     // makes the lists of neighbours
  touch,     // finds contacts, their weights and momenta; may halt the frame if a list is too short
  next,      // updates the same contacts after another solve
  brought,   // what each particle of the volume contributes
  sort,      // sorts the volume's particles into cells
  sums,      // sums the contributions at the volume's nodes
  means,     // interpolates the means back to the particles
  rowsOut,   // divided: packs rows of this part's contact particles for other parts
  rowsIn,    // divided: unpacks the rows of other parts
  reach,     // divided: writes the range of cells of all parts' particles
  exchange,  // ends the submission: the host exchanges data with other parts, or changes them (Exchange)
  end,       // copies positions and the control block to the host
};

/// What the host does where a submission ends: what parts of divided hair exchange; or what it changes.
enum class Exchange : std::uint8_t {
  rows,    // of contact particles, while the next submission runs
  starts,  // at the start of a step: the largest motion, and the volume's reach
  sample,  // counts of the sample that decides whether lists are made anew
  sums,    // of the volume, and of its densities in a step that sorts
  ways,    // after a step's move: keeps hair from going through hair (ringlet/crossings)
};

/// The strands that a solve is of: those that other parts may touch (RestHalo), the others, or all.
enum class StrandsOf : std::uint8_t { all, border, inner };

/// Kinds of rows of contact particles: at a step's start x, v and v^0, 36 bytes each; after a solve v^k, 12
/// bytes.
enum class Rows : std::uint8_t { step, solve };

struct PlannedStage {
  FrameStage stage = FrameStage::end;
  std::uint32_t step = 0;
  bool barrier = true;   // a barrier follows
  bool isFirst = false;  // for brought, sums, their exchange and means: in the first iteration of a step
  // For motion: layout::kOfAll, kOfHere or kOfElsewhere; a repeated step takes kOfAll in place of
  // kOfElsewhere.
  std::uint32_t whose = 0;
  SolvePass pass{};
  StrandsOf strands = StrandsOf::all;
  bool withoutBodies = false;  // a solve by the kernels without bodies
  bool listsCloth = false;     // of a step: before it, the cloth near to particles is found
  Rows rows = Rows::step;      // for rowsOut, rowsIn and the exchange of rows
  Exchange exchange = Exchange::starts;
};

/// What the order of a frame depends on.
struct FrameNeeds {
  std::uint32_t steps = 1;
  std::uint32_t iterations = 1;  // solves of a step with contacts
  ContactKinds contacts{};
  bool sleeps = false;  // hair at rest: no steps
  bool bends = false;   // a body bends
  bool hasCloth =
      false;  // and one is cloth: a dispatch is of one step, for which the cloth near to hair is found
  // The first solve of a step leaves bodies out; for hair as a volume among bodies. It is a prediction for
  // the coupling; neighbours see what bodies do one step late (kContactWarmth).
  bool predictsWithoutBodies = false;
  std::function<bool(std::uint32_t step)> sorts{};  // whether the volume sorts in this step; none: never
  bool isDivided = false, samples = false;          // divided: ContactStage::samples
  bool keepsApart = false;                          // ContactSettings::noCrossings
};

std::vector<PlannedStage> stagesOf(const FrameNeeds& needs);

/// Index of the stage at which the contacts of a step begin: a frame that halted in the step continues there.
std::size_t contactsBegin(std::span<const PlannedStage> plan, std::uint32_t step);

}  // namespace ringlet
