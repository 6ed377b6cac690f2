// Implements frame_plan.h.
#include "ringlet/solver/plan/frame_plan.h"

#include <algorithm>

#include "layout/contacts.h"

namespace ringlet {
namespace {

class FramePlanner {
 public:
  explicit FramePlanner(const FrameNeeds& needs) : needs_(needs) {}

  std::vector<PlannedStage> plan() {
    if (!needs_.sleeps) {
      add({.stage = FrameStage::inputs});
      if (needs_.bends) add({.stage = FrameStage::bodies, .barrier = false});
      if (needs_.contacts.any()) {
        contactFrame();
      } else if (needs_.hasCloth || needs_.keepsApart) {
        for (std::uint32_t step = 0; step < needs_.steps; ++step) {
          solve({.step = step, .moves = true});
          keepApart(step);
        }
      } else {
        add({.stage = FrameStage::steps, .barrier = false});
      }
    }
    add({.stage = FrameStage::end, .barrier = false});
    return std::move(stages_);
  }

 private:
  void contactFrame() {
    solve({.step = 0});
    for (std::uint32_t step = 0; step < needs_.steps; ++step) {
      contactsOf(step);
      for (std::uint32_t iteration = 1; iteration <= needs_.iterations; ++iteration) {
        const bool isLast = iteration == needs_.iterations;
        if (iteration > 1) nextContacts(step);
        if (needs_.contacts.volume)
          add({.stage = FrameStage::means, .step = step, .isFirst = iteration == 1});
        const bool goesOn = isLast && step + 1 < needs_.steps;
        solve({step, true, isLast, goesOn && !needs_.keepsApart}, iteration == 1);
        if (isLast) keepApart(step);
        if (goesOn && needs_.keepsApart) solve({.step = step + 1});
      }
    }
  }

  // Ends the submission, for the host.
  void keepApart(std::uint32_t step) {
    if (!needs_.keepsApart) return;
    add({.stage = FrameStage::exchange, .step = step, .barrier = false, .exchange = Exchange::ways});
  }

  // The stages of a step before its first solve with contacts, without the volume's means. Pairs come first:
  // they may halt the frame, and then the volume must not go on.
  void contactsOf(std::uint32_t step) {
    if (needs_.contacts.pairs) {
      if (needs_.isDivided) add({.stage = FrameStage::rowsIn, .step = step});
      const std::uint32_t whose = needs_.isDivided ? layout::kOfElsewhere : layout::kOfAll;
      add({.stage = FrameStage::motion, .step = step, .whose = whose});
      add({.stage = FrameStage::grid, .step = step});
      if (needs_.isDivided && needs_.samples) exchange({.step = step, .exchange = Exchange::sample});
    }
    if (needs_.isDivided && needs_.contacts.volume) add({.stage = FrameStage::reach, .step = step});
    if (needs_.contacts.pairs) {
      add({.stage = FrameStage::lists, .step = step});
      add({.stage = FrameStage::touch, .step = step});
    }
    if (!needs_.contacts.volume) return;
    if (needs_.sorts && needs_.sorts(step)) add({.stage = FrameStage::sort, .step = step});
    add({.stage = FrameStage::sums, .step = step, .isFirst = true});
    // The means need the sums of all parts.
    exchange({.step = step, .isFirst = true, .exchange = Exchange::sums});
  }

  void nextContacts(std::uint32_t step) {
    if (!needs_.contacts.pairs) return;
    if (needs_.isDivided) add({.stage = FrameStage::rowsIn, .step = step, .rows = Rows::solve});
    add({.stage = FrameStage::next, .step = step});
  }

  // A solve pass, and the measurements after it. A part steps its border strands first, and steps the others
  // while the border's rows are being exchanged.
  // isFirst: the first with contacts in its step.
  void solve(const SolvePass& pass, bool isFirst = false) {
    const bool endsFrame = pass.moves && !pass.goesOn;
    const Rows rows = pass.withContacts && !pass.moves ? Rows::solve : Rows::step;
    if (needs_.isDivided && needs_.contacts.pairs && !endsFrame) {
      solveOf(pass, StrandsOf::border, isFirst);
      add({.stage = FrameStage::rowsOut, .step = pass.step, .rows = rows});
      exchange({.step = pass.step, .rows = rows, .exchange = Exchange::rows});
      solveOf(pass, StrandsOf::inner, isFirst);
    } else {
      solveOf(pass, StrandsOf::all, isFirst);
    }
    if (!endsFrame) measure(pass.goesOn ? pass.step + 1 : pass.step, rows == Rows::step);
  }

  // Measurements that need no data of other parts, at the start of a step or between its solves.
  void measure(std::uint32_t step, bool isStart) {
    if (needs_.contacts.volume) {
      add({.stage = FrameStage::brought, .step = step, .isFirst = isStart});
      if (!isStart) add({.stage = FrameStage::sums, .step = step});
    }
    if (needs_.isDivided && needs_.contacts.pairs && isStart)
      add({.stage = FrameStage::motion, .step = step, .whose = layout::kOfHere});
    exchange({.step = step, .exchange = isStart ? Exchange::starts : Exchange::sums});
  }

  // The strand dispatches of a pass. If the first solve leaves bodies out, or the cloth near to hair is found
  // at the step's start, a pass that goes on becomes two dispatches.
  void solveOf(const SolvePass& pass, StrandsOf strands, bool isFirst) {
    PlannedStage one{.stage = FrameStage::solve, .step = pass.step, .pass = pass, .strands = strands};
    one.withoutBodies = needs_.predictsWithoutBodies && !pass.withContacts;
    const bool isFirstAmongBodies = needs_.predictsWithoutBodies ? isFirst : !pass.withContacts;
    one.listsCloth = needs_.hasCloth && isFirstAmongBodies;
    if (!needs_.predictsWithoutBodies && !needs_.hasCloth) return add(one);
    one.pass.goesOn = false;
    add(one);
    if (pass.goesOn) solveOf({.step = pass.step + 1}, strands, false);
  }

  void exchange(PlannedStage stage) {
    if (!needs_.isDivided) return;
    stage.stage = FrameStage::exchange;
    stage.barrier = false;
    add(stage);
  }
  void add(const PlannedStage& stage) { stages_.push_back(stage); }

  const FrameNeeds& needs_;
  std::vector<PlannedStage> stages_;
};

}  // namespace

std::vector<PlannedStage> stagesOf(const FrameNeeds& needs) { return FramePlanner(needs).plan(); }

std::size_t contactsBegin(std::span<const PlannedStage> plan, std::uint32_t step) {
  const auto begins = [&](const PlannedStage& stage) {
    const bool isBegin = stage.stage == FrameStage::rowsIn
                             ? stage.rows == Rows::step
                             : stage.stage == FrameStage::motion && stage.whose != layout::kOfHere;
    return isBegin && stage.step == step;
  };
  return static_cast<std::size_t>(std::ranges::find_if(plan, begins) - plan.begin());
}

}  // namespace ringlet
