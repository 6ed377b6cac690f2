// program/run_report.h and measure_report.h: every number of the JSON in its unit. The values told apart from
// each other by their size are exact in binary, so that whole objects can be compared.
#include "program/simulate/run_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "program/measure/measure_report.h"
#include "tests/measure/strand_samples.h"

namespace ringlet::program::run_report_test {
namespace {

using nlohmann::json;

// As the program prints it: the order of keys does not count.
json printed(const nlohmann::ordered_json& object) { return json::parse(object.dump()); }

// Every number is another, in the unit its declaration says: metres, milliseconds, seconds, shares.
RunOutcome outcome() {
  RunOutcome outcome;
  outcome.frameCount = 7;
  outcome.strandCount = 11;
  outcome.particleCount = 88;
  outcome.hair.rigidStrandCount = 2;
  outcome.millisecondsPerFrame = 2.5;
  outcome.stages = {{"strand_step", 2.25}, {"readback", 0.5}, {"write", 0.75}};
  outcome.wall = {.start = 3.5, .frames = 4.5, .finish = 5.5};
  outcome.computeShare = 0.625;
  outcome.waitedForDevice = 1.25;
  outcome.waitedForWriter = 1.75;
  outcome.report.maxEdgeStretch = 1.0625;
  outcome.report.limitedShare = 0.03125;
  outcome.report.nonfinite = 3;
  outcome.velocityResidual = 0.0078125;
  outcome.contacts = ContactReport{.contactParticles = 101,
                                   .pairsUnpruned = 102,
                                   .pairs = 103,
                                   .volumeStrands = 110,
                                   .listed = 104,
                                   .contacts = 105,
                                   .pairTests = 106,
                                   .rebuilds = 107,
                                   .momentumError = 0.015625,
                                   .volumeCut = 111,
                                   .volumeLargest = 1.125,
                                   .ways = {.particles = 1000,
                                            .changed = 250,
                                            .changes = 0.125,
                                            .mostChange = 0.0625,
                                            .tied = 125,
                                            .stretched = 112,
                                            .mostStretch = 1.25,
                                            .heldSteps = 113,
                                            .unsafe = 114}};
  outcome.contactNumbers = ContactNumbers{
      .crossings = 108,
      .worst = {.overlapping = 109, .rawRecall = 0.875, .overlapBeyondRestSum = 12.5, .deepestOverlap = 0.25},
      .deepestOverlap = 0.375};
  outcome.bodyNumbers = BodyNumbers{.deepest = 0.0625, .strand = 4, .particle = 5, .frame = 6, .inside = 9};
  outcome.hair.device = "a device";
  outcome.hair.driver = "a driver";
  outcome.frameTimes = {.first = 8.5, .median = 2.125, .least = 2};
  outcome.host = {.submit = 0.0625, .fence = 1.125};
  outcome.copied = 0.375;
  outcome.hair.kernel = "a kernel";
  outcome.bodies = {{.name = "a body",
                     .shape = "mesh",
                     .bends = true,
                     .cell = 0.0025,
                     .within = 0.001375,
                     .numbers = {.deepest = 0.0625, .inside = 9, .caught = 12}}};
  outcome.hair.isTuned = true;
  outcome.hair.deviceBytes = 123456;
  outcome.hair.compileMilliseconds = 1500;
  outcome.positionsHash = "0123456789abcdef";
  outcome.resumedFrom = 3;
  outcome.interrupted = true;
  outcome.warnings = {"a warning"};
  outcome.notes = {"a note"};
  outcome.outputs = {"out/hair.usda", "out/hair.rgc"};
  outcome.cacheErrorBound = 0.000244140625;
  outcome.hairCount = 2000;
  outcome.follow = {.hairs = 30, .rms = 0.0625, .worst = 0.25};
  return outcome;
}

Settings settings() {
  Settings settings;
  settings.stepsPerFrame = 10;
  settings.framesPerSecond = 30;
  settings.contacts.noCrossings = true;
  return settings;
}

const RunNames kNames{.integrator = "point_jacobi", .backend = "reference", .material = "fine"};

TEST(RunReport, EveryNumberIsInItsUnit) {
  const json expected{
      {"frames", 7},
      {"strands", 11},
      {"particles", 88},
      {"rigid_strands", 2},
      {"ms_per_frame", 2.5},
      {"frame_ms", {{"first", 8.5}, {"median", 2.125}, {"least", 2.0}}},
      {"stages_ms", {{"strand_step", 2.25}, {"readback", 0.5}, {"write", 0.75}}},
      {"wall_s", {{"start", 3.5}, {"frames", 4.5}, {"finish", 5.5}}},
      {"compute_share", 0.625},
      {"waits_ms",
       {{"device", 1.25}, {"writer", 1.75}, {"submit", 0.0625}, {"fence", 1.125}, {"copy", 0.375}}},
      {"max_edge_stretch", 1.0625},
      {"limited_share", 0.03125},
      {"nonfinite", 3},
      {"velocity_residual", 0.0078125},
      {"contacts", 105},
      {"volume_strands", 110},
      {"contact_particles", 101},
      {"pairs_unpruned", 102},
      {"pairs", 103},
      {"pair_tests", 106},
      {"rebuilds", 107},
      {"momentum_error", 0.015625},
      {"volume_cut", 111},
      {"volume_largest", 1.125},
      {"no_crossings",
       {{"changed_share", 0.25},
        {"mean_change_mm", 0.5},
        {"most_change_mm", 62.5},
        {"tied_share", 0.125},
        {"stretched", 112},
        {"most_stretch", 1.25},
        {"held_steps", 113},
        {"unsafe", 114}}},
      {"raw_recall", 0.875},
      {"overlap_beyond_rest_sum", 12.5},
      {"deepest_overlap_all", 0.375},
      {"crossings", 108},
      {"deepest_penetration_mm", 62.5},
      {"inside_bodies", 9},
      {"bodies",
       {{{"name", "a body"},
         {"shape", "mesh"},
         {"deforms", true},
         {"sides", "outside"},
         {"cell_mm", 2.5},
         {"within_mm", 1.375},
         {"deepest_mm", 62.5},
         {"inside", 9},
         {"caught", 12}}}},
      {"device", "a device"},
      {"driver", "a driver"},
      {"kernel", "a kernel"},
      {"tuned", true},
      {"device_bytes", 123456},
      {"cache_error_bound_m", 0.000244140625},
      {"hairs", 2000},
      {"follow_error", 0.0625},
      {"follow_error_worst", 0.25},
      {"compile_ms", 1500.0},
      {"backend", "reference"},
      {"positions_hash", "0123456789abcdef"},
      {"integrator", "point_jacobi"},
      {"material", "fine"},
      {"steps_per_frame", 10},
      {"fps", 30.0},
      {"resumed_from", 3},
      {"interrupted", true},
      {"warnings", {"a warning"}},
      {"notes", {"a note"}},
      {"outputs", {"out/hair.usda", "out/hair.rgc"}},
  };
  EXPECT_EQ(printed(runJson(kNames, settings(), outcome())), expected);
}

TEST(RunReport, WhatIsNotKnownIsNull) {
  RunOutcome unknown = outcome();
  unknown.velocityResidual.reset();
  unknown.contacts.reset();
  unknown.contactNumbers.reset();
  unknown.bodyNumbers.reset();
  unknown.hair.deviceBytes.reset();
  unknown.cacheErrorBound.reset();
  unknown.follow.reset();
  const json found = printed(runJson(kNames, settings(), unknown));
  const json whole = printed(runJson(kNames, settings(), outcome()));
  std::set<std::string> nulls;
  for (const auto& [key, value] : found.items()) {
    if (value.is_null())
      nulls.insert(key);
    else
      EXPECT_EQ(value, whole[key]) << key;
  }
  EXPECT_EQ(found.size(), whole.size());
  EXPECT_EQ(nulls, (std::set<std::string>{"velocity_residual",
                                          "volume_strands",
                                          "contact_particles",
                                          "contacts",
                                          "pairs_unpruned",
                                          "pairs",
                                          "pair_tests",
                                          "rebuilds",
                                          "momentum_error",
                                          "volume_cut",
                                          "volume_largest",
                                          "no_crossings",
                                          "raw_recall",
                                          "overlap_beyond_rest_sum",
                                          "deepest_overlap_all",
                                          "crossings",
                                          "deepest_penetration_mm",
                                          "inside_bodies",
                                          "device_bytes",
                                          "cache_error_bound_m",
                                          "follow_error",
                                          "follow_error_worst"}));
}

TEST(RunReport, TheTextHasTheSameNumbers) {
  const std::string text = runText(kNames, settings(), outcome());
  for (const char* part :
       {"7 frames of 11 strands, 88 particles (interrupted)", "point_jacobi, 10 steps a frame, on a device",
        "2.50 ms to step, 0.50 ms to read back, 0.75 ms to write",
        "4.50 s, 62 % of it stepping; 3.50 s before, 5.50 s after",
        "1.0625 x its length in the groom; the limit touched 3.12 % of edges",
        "105 in the worst frame, momentum error 0.016; 106 pair tests, 107 rebuilds",
        "103 of 102 pairs of strands", "110 strands meet as a volume, with up to 1.1 of its range",
        "25 % of ways were changed, by 0.5 mm on the mean and 62.5 mm at most; 12 % of particles were tied",
        "this stretched 112 edges beyond the limit, to 1.25 x their length",
        "in 113 steps all hair had to move as the head does",
        "0.3750 of the radii beyond rest at the deepest, 12.5 in all", "recall 0.875", "crossings     108",
        "deepest 62.5 mm (strand 4 particle 5, frame 7)",
        "a body: cells of 2.5 mm, keeps hair out within 1.38 mm", "9 particles began inside",
        "note          a note", "off by at most 0.244 mm"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in:\n" << text;
}

TEST(RunReport, BodiesThatHairDidNotMeetAreNoSuccess) {
  RunOutcome far = outcome();
  far.bodyNumbers = BodyNumbers{.nearest = 0.4};
  const std::string text = runText(kNames, settings(), far);
  EXPECT_NE(text.find("hair did not meet them"), std::string::npos) << text;
  EXPECT_EQ(text.find("deepest 0 mm"), std::string::npos) << text;
  // Near and not in it, or in it.
  far.bodyNumbers->nearest = 0.001;
  EXPECT_NE(runText(kNames, settings(), far).find("deepest 0 mm"), std::string::npos);
  far.bodyNumbers = BodyNumbers{.deepest = 0.002, .nearest = 0.4};
  EXPECT_NE(runText(kNames, settings(), far).find("deepest 2 mm"), std::string::npos);
}

// Of the second strand they are three times the first's, so that mean, least and largest differ.
StrandMeasure strandMeasure(double by) {
  return {.droop = 0.0625 * by,
          .relativeDroop = 0.125 * by,
          .chord = 0.1875 * by,
          .chordElongation = 0.25 * by,
          .coreLength = 0.3125 * by,
          .coreElongation = 0.375 * by,
          .arcDrift = 0.4375 * by,
          .maxEdgeStretch = 0.5 * by,
          .turns = 0.5625 * by,
          .winding = 0.625 * by,
          .meanRadius = 0.6875 * by,
          .handedness = -1,
          .handednessKept = 0.25 * by,
          .tipRotation = 0.8125 * by};
}
StrandMotion strandMotion(double by) {
  StrandMotion made;
  made.bounceHz = 2.5 * by, made.swayHz = 3.5 * by, made.settleSeconds = 4.5 * by;
  made.energyRatio = 0.125 * by;
  return made;
}
ShapeDistance distance(double by) {
  return {.particles = 0.0625 * by,
          .tip = 0.125 * by,
          .core = 0.1875 * by,
          .direction = 0.25 * by,
          .turns = 0.3125 * by,
          .radius = 0.375 * by};
}
Measured measured() {
  const Groom rest = test::groomOf({test::cut({.radius = 0}, 5), test::cut({.radius = 0}, 9)});
  auto ruler = GroomRuler::make(rest);
  EXPECT_TRUE(ruler) << ruler.error().message;
  const CurlNumbers numbers{.strandCount = 2,
                            .particleCount = 14,
                            .frameCount = 96,
                            .droop = 0.03125,
                            .coreElongation = 1.125,
                            .turns = 7.5,
                            .meanRadius = 0.015625,
                            .handednessKept = false,
                            .arcDrift = -0.25,
                            .maxEdgeStretch = 1.25,
                            .tipRotation = -45,
                            .bounceHz = 3.5,
                            .swayHz = 1.5,
                            .settleSeconds = 2.5,
                            .energyRatio = 0.0625,
                            .worstDroop = -0.0625,
                            .worstCoreElongation = 1.5,
                            .worstTipRotation = 90};
  return {.ruler = std::move(*ruler),
          .strands = {strandMeasure(1), strandMeasure(3)},
          .motions = {strandMotion(1), strandMotion(3)},
          .distances = {distance(1), distance(3)},
          .against = "other.obj",
          .numbers = numbers,
          .seconds = 4,
          .freeSeconds = 1};
}

template <class Of>
json keysOf(Of&& of) {
  return json{{"droop_mm", of(62.5)},          {"relative_droop", of(0.125)}, {"core_elongation", of(0.375)},
              {"chord_elongation", of(0.25)},  {"core_length_mm", of(312.5)}, {"chord_mm", of(187.5)},
              {"turns", of(0.5625)},           {"winding", of(0.625)},        {"mean_radius_mm", of(687.5)},
              {"handedness_share", of(0.25)},  {"arc_drift", of(0.4375)},     {"max_edge_stretch", of(0.5)},
              {"tip_rotation_deg", of(0.8125)}};
}
template <class Of>
json distancesOf(Of&& of) {
  return json{{"particles", of(0.0625)},   {"tip", of(0.125)},    {"core", of(0.1875)},
              {"direction_deg", of(0.25)}, {"turns", of(0.3125)}, {"radius", of(0.375)}};
}

TEST(MeasureReport, EveryNumberIsInItsUnit) {
  // Mean, least, largest of b and 3 b.
  const auto spread = [](double b) { return json{2 * b, b, 3 * b}; };
  json expected{{"strands", 2},
                {"particles", 14},
                {"frames", 96},
                {"droop_mm", 31.25},
                {"core_elongation", 1.125},
                {"turns", 7.5},
                {"mean_radius_mm", 15.625},
                {"handedness_kept", false},
                {"arc_drift", -0.25},
                {"max_edge_stretch", 1.25},
                {"tip_rotation_deg", -45.0},
                {"bounce_hz", 3.5},
                {"sway_hz", 1.5},
                {"settle_s", 2.5},
                {"energy_ratio", 0.0625},
                {"worst", {{"droop_mm", -62.5}, {"core_elongation", 1.5}, {"tip_rotation_deg", 90.0}}},
                {"limited_share", nullptr},
                {"velocity_residual", nullptr},
                {"spread", keysOf(spread)},
                {"against", distancesOf(spread)}};
  EXPECT_EQ(printed(measuredJson(measured(), false)), expected);

  for (double by : {1.0, 3.0}) {
    const auto of = [by](double b) { return b * by; };
    json entry = keysOf(of);
    entry.update({{"particles", by == 1 ? 5 : 9},
                  {"turns_at_rest", 0.0},
                  {"handedness", -1},
                  {"handedness_kept", false},
                  {"bounce_hz", of(2.5)},
                  {"sway_hz", of(3.5)},
                  {"settle_s", of(4.5)},
                  {"energy_ratio", of(0.125)},
                  {"against", distancesOf(of)}});
    expected["per_strand"].push_back(entry);
  }
  EXPECT_EQ(printed(measuredJson(measured(), true)), expected);
}

}  // namespace
}  // namespace ringlet::program::run_report_test
