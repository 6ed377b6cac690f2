// The order of a frame's stages, for every kind of frame. No device needed.
#include "ringlet/solver/plan/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "layout/contacts.h"

namespace ringlet::test::frame_plan_test {
namespace {

using Plan = std::vector<PlannedStage>;

const char* nameOf(FrameStage stage) {
  static constexpr const char* kNames[] = {"inputs", "bodies",   "steps",   "solve",   "motion",   "grid",
                                           "lists",  "touch",    "next",    "brought", "sort",     "sums",
                                           "means",  "rows out", "rows in", "reach",   "exchange", "end"};
  return kNames[static_cast<std::size_t>(stage)];
}
const char* nameOf(Exchange what) {
  static constexpr const char* kNames[] = {"rows", "starts", "sample", "sums", "ways"};
  return kNames[static_cast<std::size_t>(what)];
}

// As "solve 0 move goes on", "motion 1 elsewhere", "exchange 0 rows".
std::string textOf(const PlannedStage& s) {
  std::string text = nameOf(s.stage);
  if (s.stage == FrameStage::inputs || s.stage == FrameStage::end || s.stage == FrameStage::steps ||
      s.stage == FrameStage::bodies)
    return text;
  text += " " + std::to_string(s.step);
  if (s.stage == FrameStage::solve) {
    text += s.pass.withContacts ? s.pass.moves ? " move" : " contacts" : s.withoutBodies ? " bare" : " first";
    if (s.pass.goesOn) text += " goes on";
    if (s.listsCloth) text += " by cloth";
    if (s.strands != StrandsOf::all) text += s.strands == StrandsOf::border ? " border" : " inner";
  }
  if (s.stage == FrameStage::motion)
    text += s.whose == layout::kOfAll ? "" : s.whose == layout::kOfHere ? " here" : " elsewhere";
  if (s.stage == FrameStage::exchange) text += std::string(" ") + nameOf(s.exchange);
  const bool isOfRows = s.stage == FrameStage::rowsOut || s.stage == FrameStage::rowsIn ||
                        (s.stage == FrameStage::exchange && s.exchange == Exchange::rows);
  if (isOfRows) text += s.rows == Rows::step ? " of the step" : " of the solve";
  if (s.isFirst) text += ", first";
  return text;
}
std::vector<std::string> textsOf(const Plan& plan) {
  std::vector<std::string> texts;
  std::ranges::transform(plan, std::back_inserter(texts), textOf);
  return texts;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// Every kind of frame with contacts.
std::vector<FrameNeeds> everyNeed() {
  std::vector<FrameNeeds> all;
  for (const ContactKinds kinds : {ContactKinds{true, false}, {false, true}, {true, true}})
    for (const std::uint32_t steps : {1u, 2u, 3u})
      for (const std::uint32_t iterations : {1u, 2u, 3u})
        for (const bool predicts : {false, true})
          for (const bool samples : {false, true})
            all.push_back({.steps = steps,
                           .iterations = iterations,
                           .contacts = kinds,
                           .predictsWithoutBodies = predicts && kinds.volume,
                           .sorts = [](std::uint32_t step) { return step % 2 == 0; },
                           .samples = samples});
  return all;
}
Plan planOf(FrameNeeds needs, bool isDivided) {
  needs.isDivided = isDivided;
  return stagesOf(needs);
}

TEST(FramePlan, StrandsThatTouchNoOthersAreOneStage) {
  EXPECT_EQ(textsOf(stagesOf({.steps = 3})), (std::vector<std::string>{"inputs", "steps", "end"}));
  EXPECT_EQ(textsOf(stagesOf({.steps = 3, .contacts = {true, true}, .sleeps = true})),
            std::vector<std::string>{"end"});
}

TEST(FramePlan, FieldsOfBodiesThatBendAreMadeBeforeTheSteps) {
  EXPECT_EQ(textsOf(stagesOf({.steps = 3, .bends = true})),
            (std::vector<std::string>{"inputs", "bodies", "steps", "end"}));
  EXPECT_EQ(textsOf(stagesOf({.steps = 3, .sleeps = true, .bends = true})), std::vector<std::string>{"end"});
  const Plan contacts = stagesOf({.steps = 2, .contacts = {true, false}, .bends = true});
  EXPECT_EQ(textOf(contacts[1]), "bodies");
}

TEST(FramePlan, ContactsStandBetweenTheSolvesOfAStep) {
  const FrameNeeds needs{
      .steps = 2, .iterations = 2, .contacts = {true, true}, .sorts = [](std::uint32_t step) {
        return step == 0;
      }};
  const std::vector<std::string> expected{"inputs",           "solve 0 first",
                                          "brought 0, first", "motion 0",
                                          "grid 0",           "lists 0",
                                          "touch 0",          "sort 0",
                                          "sums 0, first",    "means 0, first",
                                          "solve 0 contacts", "brought 0",
                                          "sums 0",           "next 0",
                                          "means 0",          "solve 0 move goes on",
                                          "brought 1, first", "motion 1",
                                          "grid 1",           "lists 1",
                                          "touch 1",          "sums 1, first",
                                          "means 1, first",   "solve 1 contacts",
                                          "brought 1",        "sums 1",
                                          "next 1",           "means 1",
                                          "solve 1 move",     "end"};
  EXPECT_EQ(textsOf(stagesOf(needs)), expected);
}

TEST(FramePlan, AFirstSolveWithoutBodiesIsAPassOfItsOwn) {
  const Plan plan = stagesOf({.steps = 2, .contacts = {false, true}, .predictsWithoutBodies = true});
  const std::vector<std::string> expected{"inputs",         "solve 0 bare",     "brought 0, first",
                                          "sums 0, first",  "means 0, first",   "solve 0 move",
                                          "solve 1 bare",   "brought 1, first", "sums 1, first",
                                          "means 1, first", "solve 1 move",     "end"};
  EXPECT_EQ(textsOf(plan), expected);
}

// The host changes ways after a step's move, before the next step's first solve.
TEST(FramePlan, HairThatIsKeptApartEndsASubmissionWithEachStep) {
  EXPECT_EQ(
      textsOf(stagesOf({.steps = 2, .contacts = {true, false}, .keepsApart = true})),
      (std::vector<std::string>{"inputs", "solve 0 first", "motion 0", "grid 0", "lists 0", "touch 0",
                                "solve 0 move", "exchange 0 ways", "solve 1 first", "motion 1", "grid 1",
                                "lists 1", "touch 1", "solve 1 move", "exchange 1 ways", "end"}));
  EXPECT_EQ(textsOf(stagesOf({.steps = 2, .keepsApart = true})),
            (std::vector<std::string>{"inputs", "solve 0 first", "exchange 0 ways", "solve 1 first",
                                      "exchange 1 ways", "end"}));
}

// The cloth near to hair is found once a step, before the first solve that knows bodies.
TEST(FramePlan, AmongClothADispatchIsOfOneStep) {
  EXPECT_EQ(textsOf(stagesOf({.steps = 2, .bends = true, .hasCloth = true})),
            (std::vector<std::string>{"inputs", "bodies", "solve 0 first by cloth", "solve 1 first by cloth",
                                      "end"}));
  const std::vector<std::string> pairs{"inputs",   "bodies",       "solve 0 first by cloth",
                                       "motion 0", "grid 0",       "lists 0",
                                       "touch 0",  "solve 0 move", "solve 1 first by cloth",
                                       "motion 1", "grid 1",       "lists 1",
                                       "touch 1",  "solve 1 move", "end"};
  EXPECT_EQ(textsOf(stagesOf({.steps = 2, .contacts = {true, false}, .bends = true, .hasCloth = true})),
            pairs);
  for (FrameNeeds needs : everyNeed()) {
    needs.hasCloth = needs.bends = true;
    std::vector<std::uint32_t> steps;
    for (const PlannedStage& stage : stagesOf(needs)) {
      EXPECT_FALSE(stage.stage == FrameStage::solve && stage.pass.goesOn);
      if (stage.listsCloth) steps.push_back(stage.step);
      const bool knowsBodies = stage.stage == FrameStage::solve && !stage.withoutBodies;
      EXPECT_TRUE(!knowsBodies || (!steps.empty() && steps.back() == stage.step)) << textOf(stage);
    }
    for (std::uint32_t step = 0; step < needs.steps; ++step) EXPECT_EQ(std::ranges::count(steps, step), 1);
  }
}

TEST(FramePlan, ADividedFrameHasTheStagesOfAWholeOne) {
  for (const FrameNeeds& needs : everyNeed()) {
    Plan divided;
    for (PlannedStage stage : planOf(needs, true)) {
      const bool isOfParts = stage.stage == FrameStage::rowsOut || stage.stage == FrameStage::rowsIn ||
                             stage.stage == FrameStage::reach || stage.stage == FrameStage::exchange;
      if (isOfParts || stage.strands == StrandsOf::border || stage.whose == layout::kOfHere) continue;
      stage.strands = StrandsOf::all;
      stage.whose = layout::kOfAll;
      divided.push_back(stage);
    }
    EXPECT_EQ(textsOf(divided), textsOf(planOf(needs, false)));
  }
}

// Rows that go out come in: packed, sent while the next submission runs, which ends, and unpacked; of the
// same kind, and nothing reads contacts of others before that.
TEST(FramePlan, RowsAreSentBesideTheNextSubmission) {
  for (const FrameNeeds& needs : everyNeed()) {
    const std::vector<std::string> texts = textsOf(planOf(needs, true));
    SCOPED_TRACE(testing::PrintToString(texts));
    std::vector<std::string> ofRows;  // and where submissions end
    for (const std::string& text : texts)
      if (has(text, "rows") || text.starts_with("exchange")) ofRows.push_back(text);
    std::size_t out = 0;
    for (std::size_t k = 0; k < ofRows.size(); ++k) {
      if (!ofRows[k].starts_with("rows out")) continue;
      ++out;
      ASSERT_LT(k + 3, ofRows.size());
      const std::string kind = ofRows[k].substr(ofRows[k].find("of the"));
      EXPECT_TRUE(has(ofRows[k + 1], "rows") && ofRows[k + 1].ends_with(kind)) << ofRows[k + 1];
      EXPECT_TRUE(ofRows[k + 2].starts_with("exchange") && !has(ofRows[k + 2], "rows")) << ofRows[k + 2];
      EXPECT_TRUE(ofRows[k + 3].starts_with("rows in") && ofRows[k + 3].ends_with(kind)) << ofRows[k + 3];
    }
    EXPECT_EQ(out, needs.contacts.pairs ? std::size_t{needs.steps} * needs.iterations : 0);
    EXPECT_EQ(std::ranges::count_if(texts, [](const auto& t) { return t.starts_with("rows in"); }),
              static_cast<std::ptrdiff_t>(out));
  }
}

TEST(FramePlan, AHaltedStepGoesOnBeforeItsLists) {
  for (FrameNeeds needs : everyNeed()) {
    if (!needs.contacts.pairs) continue;
    for (const bool isDivided : {false, true}) {
      const Plan plan = planOf(needs, isDivided);
      for (std::uint32_t step = 0; step < needs.steps; ++step) {
        const std::size_t begin = contactsBegin(plan, step);
        ASSERT_LT(begin, plan.size());
        EXPECT_EQ(plan[begin].stage, isDivided ? FrameStage::rowsIn : FrameStage::motion);
        EXPECT_EQ(plan[begin].step, step);
        // What was done before the contacts of the step is not done again.
        const auto touch = std::ranges::find(plan.begin() + static_cast<std::ptrdiff_t>(begin), plan.end(),
                                             FrameStage::touch, &PlannedStage::stage);
        ASSERT_NE(touch, plan.end());
        EXPECT_EQ(touch->step, step);
        for (auto stage = plan.begin() + static_cast<std::ptrdiff_t>(begin); stage != touch; ++stage)
          EXPECT_TRUE(stage->stage != FrameStage::solve && stage->stage != FrameStage::brought)
              << textOf(*stage);
      }
    }
  }
}

// Stages share buffers that several of them write.
TEST(FramePlan, ABarrierFollowsEveryStageThatAnotherReads) {
  for (const FrameNeeds& needs : everyNeed())
    for (const bool isDivided : {false, true})
      for (const PlannedStage& stage : planOf(needs, isDivided))
        EXPECT_EQ(stage.barrier, stage.stage != FrameStage::end && stage.stage != FrameStage::exchange)
            << textOf(stage);
}

}  // namespace
}  // namespace ringlet::test::frame_plan_test
