// Beside an animation of hair that is cut stands a list of the cuts, which goes along with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ringlet/groom/groom_file.h"
#include "ringlet/scenes/frames/cut_list.h"
#include "tests/program/run_program.h"
#include "tests/support/gpu_test.h"
#include "tests/support/test_support.h"

namespace ringlet::cut_list_test {
namespace {

namespace fs = std::filesystem;
using test::readText;

// Two strands of five particles.
const std::string kScene =
    "[groom]\ngenerate = \"swatch\"\ncolumns = 2\nrows = 1\nparticles = 5\nturns = 0\nradius = 0.001\n"
    "length = 0.04\nvary_length = 0\n[motion]\nkind = \"shake\"\n[simulation]\nframes = 6\n";

class CutListTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    folder_ = test::scratchFolder("cut_list");
  }
  void write(const fs::path& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  test::ProgramResult run(const std::vector<std::string>& arguments) {
    return test::runProgram(folder_, arguments);
  }
  fs::path folder_;
};

TEST(CutLists, SayWhichEdgesAreNoMore) {
  LoadedScene scene;
  scene.cuts = {{-1, {{1, 4}}}, {0.1, {{0, 3}, {1, 2}}}, {9, {{0, 2}}}};
  scene.preRollSeconds = 0.2;  // what is cut in it is cut from the first frame on
  const CutList list(SceneFrames(scene), 6);
  ASSERT_EQ(list.all().size(), 3u);  // the last is not of this run
  const std::vector<std::uint32_t> first{0, 5, 10};
  EXPECT_EQ(list.cutBeyond(1, first), (std::vector<std::uint32_t>{8}));
  EXPECT_EQ(list.cutBeyond(3, first), (std::vector<std::uint32_t>{8}));
  EXPECT_EQ(list.cutBeyond(4, first), (std::vector<std::uint32_t>{2, 6, 8}));  // frame 4 begins at 0.125 s
  EXPECT_EQ(list.pieces().at(1), (std::vector<std::uint32_t>{2, 4}));
  EXPECT_EQ(list.from(4).cutBeyond(1, first), (std::vector<std::uint32_t>{2, 6, 8}));
  const CutList foreign({{1, {7, 2}}, {1, {0, 0}}, {1, {0, 5}}});
  EXPECT_TRUE(foreign.cutBeyond(1, first).empty());
}

TEST_F(CutListTest, StandsBesideTheAnimationAndIsConvertedWithIt) {
  write("cut.toml", kScene + "[[cut]]\ntime = 0.1\nat = 0.6\n[[cut]]\ntime = 0\nat = 0.9\nstrands = \"1\"\n");
  const auto made = run({"simulate", "cut.toml", "-o", "out", "--quiet"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  EXPECT_EQ(readText(folder_ / "out/hair.usda.cuts.csv"), "frame,strand,keep\n1,1,4\n4,0,3\n4,1,3\n");
  const auto converted = run({"convert", "out/hair.usda", "late.rgc", "--frames", "3:6"});
  ASSERT_EQ(converted.exitCode, 0) << converted.err;
  EXPECT_EQ(readText(folder_ / "late.rgc.cuts.csv"), "frame,strand,keep\n1,1,4\n2,0,3\n2,1,3\n");
  // Each hair is cut as its strand is, a shorter one beyond more of its points.
  const auto full = run({"convert", "out/hair.usda", "full.rgc", "--scene", "cut.toml", "--hairs", "4"});
  ASSERT_EQ(full.exitCode, 0) << full.err;
  const std::string cuts = readText(folder_ / "full.rgc.cuts.csv");
  for (const char* hair : {"4,0,", "4,1,", "4,2,", "4,3,"})
    EXPECT_NE(cuts.find(std::string("\n") + hair), std::string::npos) << cuts;
  // A strand that there is not counts for nothing.
  write("out/hair.usda.cuts.csv", "frame,strand,keep\n1,4000000000,3\n");
  const auto foreign =
      run({"convert", "out/hair.usda", "foreign.rgc", "--scene", "cut.toml", "--hairs", "4"});
  ASSERT_EQ(foreign.exitCode, 0) << foreign.err;
  EXPECT_FALSE(fs::exists(folder_ / "foreign.rgc.cuts.csv"));
  write("whole.toml", kScene);
  const auto again = run({"simulate", "whole.toml", "-o", "out", "--quiet", "--overwrite"});
  ASSERT_EQ(again.exitCode, 0) << again.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/hair.usda.cuts.csv"));
}

TEST_F(CutListTest, TheReferenceCutsTheSame) {
  for (const char* contacts : {"", "[contacts]\nmethod = \"explicit\"\n"}) {
    write("cut.toml",
          kScene + contacts + "[[cut]]\ntime = 0.1\n[[cut]]\ntime = 0\nat = 0.9\nstrands = \"1\"\n");
    std::vector<Groom> last;
    for (const char* backend : {"gpu", "reference"}) {
      const auto made =
          run({"simulate", "cut.toml", "-o", backend, "--backend", backend, "--quiet", "--overwrite"});
      ASSERT_EQ(made.exitCode, 0) << made.err;
      last.push_back(readGroom(folder_ / backend / "last.obj")->groom);
    }
    ASSERT_EQ(last[0].points.size(), 10u);
    const auto metres = static_cast<float>(last[0].metresPerUnit);
    EXPECT_GT((last[0].points[0].y - last[0].points[9].y) * metres, 0.08f) << "it falls";
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_LT(length(last[0].points[i] - last[1].points[i]) * metres, 1e-6f) << i;
  }
}

TEST_F(CutListTest, AnythingElseOfThatNameIsRefused) {
  for (const char* text : {"", "strand\n", "frame,strand,keep\n1,2\n", "frame,strand,keep\n1,2,x\n",
                           "frame,strand,keep\n1,2,3,4\n", "frame,strand,keep\n1;2;3\n"}) {
    write("hair.rgc.cuts.csv", text);
    const auto read = CutList::beside(folder_ / "hair.rgc.partial");
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().message.find("hair.rgc.cuts.csv"), std::string::npos) << read.error().message;
  }
  EXPECT_TRUE(CutList::beside(folder_ / "other.rgc")->all().empty());
}

}  // namespace
}  // namespace ringlet::cut_list_test
