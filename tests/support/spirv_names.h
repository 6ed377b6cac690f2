// What every reader of SPIR-V needs: the instructions of a module, and the names, structs, pointers and
// constants that they tell of.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace ringlet::test {

/// act(word): the words of each instruction; word[0] & 0xffff says which one it is.
template <class Act>
void eachSpirvInstruction(std::span<const std::uint32_t> module, const Act& act) {
  for (std::size_t at = 5; at < module.size(); at += module[at] >> 16)
    act(module.subspan(at, module[at] >> 16));
}

class SpirvNames {
 protected:
  using Id = std::uint32_t;

  void readInstruction(std::span<const std::uint32_t> word) {
    enum : std::uint32_t { kName = 5, kMemberName = 6, kTypeStruct = 30, kTypePointer = 32, kConstant = 43 };
    switch (word[0] & 0xffff) {
      case kName:
        names_[word[1]] = reinterpret_cast<const char*>(&word[2]);
        break;
      case kMemberName:
        memberNames_[word[1]][word[2]] = reinterpret_cast<const char*>(&word[3]);
        break;
      case kTypeStruct:
        structTypes_[word[1]].assign(word.begin() + 2, word.end());
        break;
      case kTypePointer:
        pointees_[word[1]] = word[3];
        break;
      case kConstant:
        constants_[word[2]] = word[3];
        break;
      default:
        break;
    }
  }

  std::map<Id, std::string> names_;
  std::map<Id, std::map<std::uint32_t, std::string>> memberNames_;
  std::map<Id, std::vector<Id>> structTypes_;
  std::map<Id, Id> pointees_;  // of pointers' types
  std::map<Id, std::uint32_t> constants_;
};

}  // namespace ringlet::test
