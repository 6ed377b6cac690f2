// Simulation::cut of hair with contacts: what is cut off and what is kept go on meeting, pair by pair, and
// what is cut off leaves the volume.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parity/contacts.h"
#include "reference/step.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test {
namespace {

using namespace parity;

using CutContacts = GpuTest;

// Every third strand, near the middle; then some of them again.
std::vector<StrandCut> cutsAt(const Groom& groom, int frame) {
  std::vector<StrandCut> cuts;
  for (std::uint32_t s = frame == 3 ? 1 : 4; s < groom.strandCount(); s += frame == 3 ? 3 : 9) {
    const auto half = static_cast<std::uint32_t>(groom.strand(s).size() / 2);
    cuts.push_back({s, frame == 3 ? half + s % 5 : half / 2});
  }
  return frame == 3 || frame == 4 ? cuts : std::vector<StrandCut>{};
}

// A few frames: pieces that hit each other while they fall take differences along, threefold a frame.
TEST_F(CutContacts, FramesAgreeWithDouble) {
  using Form = KernelChoice::Form;
  struct Case {
    const char* name;
    Groom groom;
    ContactMethod method = ContactMethod::explicitPairs;
    KernelChoice kernel{};
    ContactTaper taper = ContactTaper::distance;
  };
  const Groom swatch = denseSwatch(32);
  const KernelChoice serial{Form::serial}, memory{Form::memory, 9, 4};
  for (const Case& c : {Case{"pairs", swatch},
                        {"pairs, serial", swatch, ContactMethod::explicitPairs, serial},
                        {"pairs, memory", swatch, ContactMethod::explicitPairs, memory},
                        {"pairs, time", swatch, ContactMethod::explicitPairs, {}, ContactTaper::time},
                        {"volume", swatch, ContactMethod::volume},
                        {"volume, serial", swatch, ContactMethod::volume, serial},
                        {"both", bunchAndStrands(), ContactMethod::automatic}}) {
    SCOPED_TRACE(c.name);
    Settings settings = meetingSettings();
    settings.contacts.method = c.method;
    settings.contacts.taper = c.taper;
    int frame = 0;
    std::uint64_t met = 0;
    const auto worst = shakenError(device(), c.groom, settings, c.kernel, 5,
                                   [&](Simulation& simulation, reference::Simulation<double>& reference) {
                                     met = simulation.contactReport()->contacts;
                                     EXPECT_EQ(met, reference.report().contacts) << frame;
                                     const auto cuts = cutsAt(c.groom, ++frame);
                                     if (cuts.empty()) return;
                                     const Status cut = simulation.cut(cuts);
                                     EXPECT_TRUE(cut) << cut.error().message;
                                     reference.cut(c.groom, {}, cuts);
                                   });
    ASSERT_TRUE(worst) << worst.error().message;
    fmt::print("{}: {:.1e} m apart; {} contacts at the end\n", c.name, *worst, met);
    EXPECT_LE(*worst, kMeetingMetres);
  }
}

}  // namespace
}  // namespace ringlet::test
