// The plan of a frame: its stages, in order. This is the only place that knows the order; one loop records it
// (simulation_frames.cpp), and frames of divided hair end a submission at each exchange (divided_frames.cpp).
// Pure: no device. Mirrored by reference/kernels/contact_step.h and volume_step.h, which keep an order of
// their own to check this one.
//
//   inputs -> solve v^0 -> motion, grid, lists, touch, sums, means -> solve v^1
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
  inputs,    // copies of what the host wrote for the frame
  steps,     // all steps of strands that touch no others
  solve,     // a pass of the strand kernels
  motion,    // how far contact particles have moved since their lists were made
  grid,      // contact particles in a search grid, where lists are to be made
  lists,     // who is near whom
  touch,     // who touches whom; contact weights and momenta; may halt the frame for want of room
  next,      // the same contacts after another solve
  brought,   // what each particle of the volume contributes
  sort,      // the volume's particles by cell
  sums,      // contributions at the volume's nodes
  means,     // what the means give the particles
  rowsOut,   // divided: rows of the own contact particles for other parts
  rowsIn,    // divided: rows of the others'
  reach,     // divided: the cells that all parts' particles are in
  exchange,  // divided: the submission ends, and parts exchange (Exchange)
  end,       // positions and the control block to the host
};

/// What parts of divided hair exchange where a submission ends.
enum class Exchange : std::uint8_t {
  rows,    // of contact particles, while the next submission runs
  starts,  // at the start of a step: the largest motion, and the volume's reach
  sample,  // counts of the sample by which parts decide whether lists are made anew
  sums,    // of the volume, and in a step that sorts its densities
};

/// Which strands of a part a solve is of: those that other parts may touch (RestHalo), the others, or all.
enum class StrandsOf : std::uint8_t { all, border, inner };

/// Rows of contact particles: at a step's start x, v and v^0 of each, 36 bytes; after a solve v^k, 12 bytes.
enum class Rows : std::uint8_t { step, solve };

struct PlannedStage {
  FrameStage stage = FrameStage::end;
  std::uint32_t step = 0;
  bool barrier = true;   // a barrier follows
  bool isFirst = false;  // brought, sums, exchange of sums: of the first iteration of a step
  // Of motion: layout::kOfAll, kOfHere or kOfElsewhere, which is of all in a step that is repeated.
  std::uint32_t whose = 0;
  SolvePass pass{};
  StrandsOf strands = StrandsOf::all;
  bool withoutBodies = false;  // a solve by the kernels that know no bodies
  Rows rows = Rows::step;      // rowsOut, rowsIn, exchange of rows
  Exchange exchange = Exchange::starts;
};

/// What the order of a frame depends on.
struct FrameNeeds {
  std::uint32_t steps = 1;
  std::uint32_t iterations = 1;  // solves of a step with contacts
  ContactKinds contacts{};
  bool sleeps = false;  // hair at rest: no steps
  // The first solve of a step is by kernels that know no bodies: of hair as a volume among bodies. It is a
  // prediction for the coupling; neighbours see what bodies do one step late (kContactWarmth).
  bool predictsWithoutBodies = false;
  std::function<bool(std::uint32_t step)> sorts{};  // whether the volume sorts in this step; none: never
  bool isDivided = false, samples = false;          // divided: ContactStage::samples
};

std::vector<PlannedStage> stagesOf(const FrameNeeds& needs);

/// Of a plan, where the contacts of a step begin: a frame that halted in it goes on from there.
std::size_t contactsBegin(std::span<const PlannedStage> plan, std::uint32_t step);

}  // namespace ringlet
