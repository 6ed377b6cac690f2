// Texts of files that are shown command no terminal, whatever is read and whichever stream they go to; and
// nothing prints past the two places that see to it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/motion/gltf_samples.h"
#include "tests/program/run_program.h"
#include "tests/support/test_support.h"

namespace ringlet::terminal_test {
namespace {

namespace fs = std::filesystem;
using test::runProgram;

// ESC, BEL, DEL, CR, backspace; C1 in UTF-8 and as a byte of its own.
const std::string kCommands = "\x1b[2J\x1b]0;x\x07\x7f\r\b\xc2\x9b";

void expectShown(const std::string& text, const std::string& what) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0;
    EXPECT_TRUE((byte >= 0x20 && byte != 0x7f) || byte == '\n' || byte == '\t')
        << what << ": byte " << int{byte} << " in " << testing::PrintToString(text);
    EXPECT_FALSE(byte == 0xc2 && next >= 0x80 && next < 0xa0) << what << ": " << testing::PrintToString(text);
  }
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "groom.obj") << kStrand;
    std::ofstream(folder_ / "joint.bvh")
        << "HIERARCHY\nROOT " << kCommands.substr(0, 4)  // no white space
        << "\x7f\xc2\x9b\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation "
           "Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 3\nFrame "
           "Time: 0.04\n0 0 0\n0 0 0\n0 90 0\n";
    std::ofstream(folder_ / "word.bvh") << "HIERARCHY\n\x1b[2J\n";
    test::GltfBuilder gltf;
    const int head = gltf.node({{"name", kCommands}});
    for (const std::size_t a : {0u, 1u}) {
      gltf.channel(a, head, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0.1, 0, 0});
      gltf.root["animations"][a]["name"] = kCommands;
    }
    std::ofstream(folder_ / "node.gltf") << gltf.text();
    test::GltfBuilder named = gltf;
    named.root["nodes"][0]["name"] = "Head";
    std::ofstream(folder_ / "animation.gltf") << named.text();
    auto uri = nlohmann::json::parse(gltf.textBeside("x"));
    uri["buffers"][0]["uri"] = "/%1b[2J";
    std::ofstream(folder_ / "uri.gltf") << uri.dump();
    std::ofstream(folder_ / "prim.usda")
        << "#usda 1.0\ndef BasisCurves \"" << kCommands << "\"\n{\n int[] curveVertexCounts = [3, 9]\n "
        << "point3f[] points = [(0,0,0),(0,-1,0),(0,-2,0)]\n}\n";
    std::ofstream(folder_ / "words.obj") << "v 0 0 \x1b[2J\n";
    std::ofstream(folder_ / "object.obj") << "o \x1b[2J\ng \x1b[2J\n" << kStrand << "curv 0 1 1 2 \x1b[2J\n";
    std::ofstream(folder_ / "key.toml") << "[groom]\nfile = 'groom.obj'\n[\"\\u001b[2J\"]\n\"\\u009b\" = 1\n";
    std::ofstream(folder_ / "value.toml") << "[groom]\nfile = \"\\u001b[2J\\u009b.obj\"\n";
    std::ofstream(folder_ / "kind.toml") << "[groom]\nfile = 'groom.obj'\n[motion]\nkind = \"\\u001b[2J\"\n";
    std::ofstream(folder_ / "raw.toml") << "[groom]\nfile = '\x1b[2J'\n";
    std::ofstream(folder_ / "group.toml")
        << "[groom]\nfile = 'groom.obj'\n[simulation]\nframes = 2\n[[body]]\nname = "
           "\"\\u001b[2J\\u009b\"\nshape = 'sphere'\nradius = 1\n";
    std::ofstream(folder_ / kNamed) << kStrand;
  }

  const fs::path folder_ = test::scratchFolder("terminal");
  static constexpr const char* kNamed = "\x1b[2J\xc2\x9b.obj";
  static constexpr const char* kStrand = "v 0 0 0\nv 0 -1 0\nv 0 -2 0\nl 1 2 3\n";
};

TEST_F(Terminal, NamesOfFilesAndInFilesCommandNothing) {
  const auto moved = [](const char* file, const char* joint) {
    return std::vector<std::string>{"simulate", "groom.obj", "--motion", file, "--joint", joint};
  };
  const std::vector<std::vector<std::string>> commands{
      moved("joint.bvh", "Head"),
      moved("joint.bvh", "\x1b[2J\x7f\xc2\x9b"),
      moved("word.bvh", "Head"),
      moved("node.gltf", "Head"),
      moved("node.gltf", kCommands.c_str()),
      moved("animation.gltf", "Head"),
      moved("uri.gltf", "Head"),
      moved("\x1b[2J.bvh", "Head"),
      moved("\x1b[2J.fbx", "Head"),
      {"simulate", "prim.usda"},
      {"simulate", "words.obj"},
      {"simulate", "object.obj"},
      {"simulate", "key.toml"},
      {"simulate", "value.toml"},
      {"simulate", "kind.toml"},
      {"simulate", "raw.toml"},
      {"simulate", "group.toml"},
      {"simulate", kNamed},
      {"simulate", "groom.obj", "--motion", "\x1b[2J"},
      {"simulate", "groom.obj", "--\x1b[2J"},
  };
  int shown = 0, k = 0;
  for (const auto& command : commands) {
    for (const bool asJson : {false, true}) {
      std::vector<std::string> all = command;
      all.insert(all.end(), {"--backend", "reference", "--frames", "2", "-o", fmt::format("out{}", ++k)});
      if (asJson) all.push_back("--json");
      const auto result = runProgram(folder_, all);
      EXPECT_GE(result.exitCode, 0);
      const std::string what = fmt::format("{} of {}", k, fmt::join(command, " "));
      expectShown(result.err, what);
      expectShown(result.out, what);
      const std::string both = result.err + result.out;
      shown += both.find("\\x1b[2J") != both.npos || both.find("\\u001b[2J") != both.npos ? 1 : 0;
    }
  }
  EXPECT_GE(shown, 26) << "names are shown, and not left out";
}

TEST_F(Terminal, NamesCommandNothingInAnyCommand) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"info", kNamed},
                                             {"info", kNamed, "--json"},
                                             {"info", "prim.usda"},
                                             {"convert", kNamed, "x.usda"},
                                             {"measure", kNamed},
                                             {"measure", kNamed, "--json"},
                                             {"render", kNamed, "-o", "r"},
                                             {"make", "head", "--strands", "2", "-o", "\x1b[2J.obj"},
                                             {"make", "head", "--strands", "2", "-o", "\x1b[2J.x"},
                                             {"scene", "\x1b[2J"},
                                             {"material", "\x1b[2J"},
                                             {"sweep", "key.toml", "--vary", "\x1b[2J=1,2", "-o", "s"},
                                             {"sweep", "group.toml", "--vary", "material.dials.hold=1,2",
                                              "-o", "\x1b[2J", "--backend", "reference"},
                                             {"\x1b[2J"}}) {
    const auto result = runProgram(folder_, command);
    EXPECT_GE(result.exitCode, 0);
    expectShown(result.err, command[0]);
    expectShown(result.out, command[0]);
  }
}

// JSON stays what it was for who parses it.
TEST_F(Terminal, JsonHasTheNamesAsTheyAre) {
  const auto run = runProgram(folder_, {"simulate", "groom.obj", "--motion", "animation.gltf", "--backend",
                                        "reference", "--frames", "2", "--json", "-o", "json"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NE(nlohmann::json::parse(run.out)["warnings"].dump().find("\\u001b[2J"), std::string::npos);
}

// The program prints by standard_output.h and standard_error.h; what goes on to a process of its own, and
// lines of numbers, are named here.
TEST_F(Terminal, NothingIsPrintedElsewhere) {
  const std::vector<std::string> mayPrint{"standard_output.h", "standard_output.cpp", "standard_error.h",
                                          "kernels_child.cpp", "frame_lines.cpp",     "sweep_run.cpp"};
  int files = 0;
  for (const char* folder : {"src/program", "src/view", "src/ringlet", "src/parity"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RINGLET_SOURCE_DIR) / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".h") continue;
      ++files;
      if (std::ranges::count(mayPrint, entry.path().filename().string()) > 0) continue;
      const std::string text = test::readText(entry.path());
      for (const char* way : {"fmt::print(", "std::cout <<", "std::cerr", "printf(stdout", "std::printf(",
                              "std::puts(", ", stdout)", ", stderr)"})
        EXPECT_EQ(text.find(way), std::string::npos) << entry.path() << " has " << way;
    }
  }
  EXPECT_GT(files, 300);
}

}  // namespace
}  // namespace ringlet::terminal_test
