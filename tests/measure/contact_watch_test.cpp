// measure/contact_watch.h: a line that is pushed into another and through it.
#include "ringlet/measure/contact_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "tests/rest/contact_samples.h"

namespace ringlet::contact_watch_test {
namespace {

using namespace test;

// A line that hangs at x = `x`, and one that lies across it, of spheres 4 mm apart: of one radius, 2.5 mm.
Groom crossedLines(double x) {
  Groom groom = metres();
  groom.addStrand(line({x, 0, 0}, {x, -0.076, 0}, 20));
  groom.addStrand(line({0, -0.038, -0.038}, {0, -0.038, 0.038}, 20));
  return groom;
}

Settings settings() {
  Settings settings;
  settings.contacts.radius = 0.0025;
  settings.contacts.prunePairs = false;
  return settings;
}

ContactWatch watchOf(const Settings& settings) {
  auto watch = ContactWatch::make(crossedLines(0.02), {}, settings);
  EXPECT_TRUE(watch) << watch.error().message;
  return std::move(*watch);
}

TEST(ContactWatch, SumsStepsAndKeepsTheWorstFrame) {
  ContactWatch watch = watchOf(settings());
  watch.addStep(crossedLines(0.02).points);
  EXPECT_EQ(watch.numbers().crossings, 0u);
  EXPECT_TRUE(watch.endFrame()) << "as bad as none before";
  EXPECT_EQ(watch.numbers().deepestOverlap, 0);

  // Near, 3 mm: the four spheres about the middle of either line are 2 mm along from it.
  watch.addStep(crossedLines(0.003).points);
  EXPECT_TRUE(watch.endFrame());
  const ContactNumbers near = watch.numbers();
  EXPECT_EQ(near.crossings, 0u);
  EXPECT_EQ(near.worst.overlapping, 4u);
  EXPECT_NEAR(near.deepestOverlap, 1 - std::sqrt(9.0 + 4 + 4) / 5, 1e-6);
  EXPECT_NEAR(near.worst.overlapBeyondRestSum, 4 * near.deepestOverlap, 1e-6);

  // Through and away in one step, and back in two, as deep as before in between: the frame is the worst
  // again.
  watch.addStep(crossedLines(-0.02).points);
  EXPECT_FALSE(watch.endFrame());
  EXPECT_EQ(watch.numbers().crossings, 1u);
  watch.addStep(crossedLines(-0.003).points);
  watch.addStep(crossedLines(0.003).points);
  EXPECT_TRUE(watch.endFrame());
  EXPECT_EQ(watch.numbers().crossings, 2u);
  EXPECT_EQ(watch.numbers().worst.overlapping, 4u);
  EXPECT_EQ(watch.numbers().deepestOverlap, near.deepestOverlap);
}

TEST(ContactWatch, StrandsOfABundleMayPass) {
  for (const bool isOne : {true, false}) {
    Settings bundled = settings();
    bundled.contacts.on = true;
    using Bundles = std::vector<ContactBundle>;
    bundled.contacts.bundles = std::make_shared<const Bundles>(isOne ? Bundles{{1, 0}} : Bundles{{0}, {1}});
    ContactWatch watch = watchOf(bundled);
    watch.addStep(crossedLines(0.02).points);
    watch.addStep(crossedLines(-0.02).points);
    EXPECT_EQ(watch.numbers().crossings, isOne ? 0u : 1u);
  }
}

TEST(ContactWatch, WarnsOfWhatTheSolverWarnsOf) {
  Settings gappy = settings();
  gappy.contacts.radius = 0.001;
  EXPECT_EQ(watchOf(gappy).warnings().size(), 0u) << "contacts are off";
  gappy.contacts.on = true;
  EXPECT_EQ(watchOf(gappy).warnings().size(), 1u);
  gappy.contacts.prunePairs = true;
  EXPECT_EQ(watchOf(gappy).warnings().size(), 2u) << "and no two may touch";
  gappy.contacts.radius = -1;
  EXPECT_FALSE(ContactWatch::make(crossedLines(0.02), {}, gappy));
}

}  // namespace
}  // namespace ringlet::contact_watch_test
