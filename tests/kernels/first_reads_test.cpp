// A number of a storage buffer that is one for all lanes is read at the top of main. Behind a branch,
// lavapipe reads it lane by lane, with a store and a reload of the whole vector for each; at the top it is
// one load. The SPIR-V itself says where each such read is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "embedded_modules.h"
#include "tests/support/spirv_names.h"

namespace ringlet::test::first_reads_test {
namespace {

// A place in the code: a function and the number of the block in it.
struct Place {
  std::uint32_t function = 0;
  int block = 0;
};
struct Read {
  Place place;
  std::string what;  // buffer.member
};

class Code : SpirvNames {
 public:
  explicit Code(std::span<const std::uint32_t> words) {
    eachSpirvInstruction(words, [this](std::span<const std::uint32_t> word) { readInstruction(word); });
  }

  // Reads behind a branch, as "function: buffer.member".
  std::set<std::string> lateReads() const {
    std::set<std::string> late;
    for (const Read& read : reads_) {
      if (isCalled(read.place.function) && !isAtTop(read.place))
        late.insert(nameOf(read.place.function) + ": " + read.what);
    }
    return late;
  }
  std::size_t readCount() const { return reads_.size(); }

 private:
  void readInstruction(std::span<const std::uint32_t> word) {
    SpirvNames::readInstruction(word);
    enum : std::uint32_t { kEntryPoint = 15, kFunction = 54, kFunctionCall = 57, kVariable = 59, kLoad = 61 };
    enum : std::uint32_t { kAccessChain = 65, kLabel = 248, kStorageBuffer = 12 };
    switch (word[0] & 0xffff) {
      case kEntryPoint:
        main_ = word[2];
        break;
      case kVariable:
        if (word[3] == kStorageBuffer) buffers_[word[2]] = pointees_.at(word[1]);
        break;
      case kFunction:
        here_ = {word[2], -1};
        break;
      case kLabel:
        ++here_.block;
        break;
      case kFunctionCall:
        calls_[word[3]].push_back(here_);
        break;
      case kAccessChain:
        if (buffers_.count(word[3]) && areConstants(word.subspan(4))) chains_[word[2]] = memberOf(word);
        break;
      case kLoad:
        if (const auto chain = chains_.find(word[3]); chain != chains_.end())
          reads_.push_back({here_, chain->second});
        break;
      default:
        break;
    }
  }

  // The member that an access chain leads to: of a block that wraps one struct, that struct's.
  std::string memberOf(std::span<const std::uint32_t> chain) const {
    Id type = buffers_.at(chain[3]);
    std::string name = nameOf(type);
    for (const Id index : chain.subspan(4)) {
      const auto members = memberNames_.find(type);
      if (members == memberNames_.end()) break;
      name += "." + members->second.at(constants_.at(index));
      const auto types = structTypes_.find(type);
      type = types == structTypes_.end() ? 0 : types->second.at(constants_.at(index));
    }
    return name;
  }
  bool areConstants(std::span<const std::uint32_t> ids) const {
    return std::ranges::all_of(ids, [&](Id id) { return constants_.count(id) != 0; });
  }
  bool isCalled(Id function) const { return function == main_ || calls_.count(function) != 0; }
  bool isAtTop(const Place& place) const {
    if (place.block > 0) return false;
    if (place.function == main_) return true;
    return std::ranges::all_of(calls_.at(place.function), [&](const Place& call) { return isAtTop(call); });
  }
  std::string nameOf(Id id) const {
    const auto name = names_.find(id);
    return name == names_.end() ? std::to_string(id) : name->second;
  }

  Id main_ = 0;
  Place here_;
  std::map<Id, Id> buffers_;          // the type of the block
  std::map<Id, std::string> chains_;  // to numbers that are one for all lanes
  std::map<Id, std::vector<Place>> calls_;
  std::vector<Read> reads_;
};

// Reads that may be late: of code that one invocation runs, of the largest value so far after a loop that
// makes a larger one, and of what a kernel without contacts has no buffer for, behind a constant of the
// pipeline.
bool mayBeLate(std::string_view module, std::string_view read) {
  for (const std::string_view kernel : {"contact_check", "volume_box"})
    if (module.starts_with(kernel)) return true;
  for (const std::string_view function : {"decideLists(", "judgeLists(", "endLists("})
    if (read.starts_with(function)) return true;
  if (module.starts_with("contact_touch") && read.starts_with("listsHadRoom(")) return true;  // checkLists
  if (read.ends_with(".motion") || read.ends_with(".speed")) return true;
  return read == "main: Control.control.isHalted";
}

TEST(FirstReads, WhatIsOneForAllLanesIsReadFirst) {
  std::size_t reads = 0, late = 0;
  for (const EmbeddedModule& module : kEmbeddedModules) {
    const Code code(module.words);
    reads += code.readCount();
    for (const std::string& read : code.lateReads()) {
      ++late;
      EXPECT_TRUE(mayBeLate(module.name, read)) << module.name << ", " << read;
    }
  }
  EXPECT_GT(reads, 50u);
  EXPECT_GT(late, 5u) << "late reads are not found, and nothing is tested";
}

}  // namespace
}  // namespace ringlet::test::first_reads_test
