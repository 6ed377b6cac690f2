// Reads the structs with an explicit layout out of a SPIR-V module: offsets and sizes of their members, and
// the strides of arrays of them.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace ringlet::test {

struct SpirvMember {
  std::string name;
  std::uint32_t offset = 0, size = 0;  // [bytes]
};
struct SpirvStruct {
  std::string name;
  std::vector<SpirvMember> members;
  std::set<std::uint32_t> strides;  // of the arrays that hold it [bytes]
};

class SpirvModule {
 public:
  explicit SpirvModule(std::span<const std::uint32_t> words) {
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16)
      readInstruction(words.subspan(at, words[at] >> 16));
  }

  /// Blocks, which only wrap what a buffer holds, are left out, and so are structs of local variables.
  std::vector<SpirvStruct> structs() const {
    std::vector<SpirvStruct> found;
    for (const auto& [id, types] : structTypes_) {
      if (blocks_.count(id) || !offsets_.count(id)) continue;
      SpirvStruct& one = found.emplace_back();
      one.name = names_.at(id);
      for (std::uint32_t k = 0; k < types.size(); ++k)
        one.members.push_back({memberNames_.at(id).at(k), offsets_.at(id).at(k), sizeOf(types[k])});
      for (const auto& [array, element] : arrayElements_)
        if (element == id && strides_.count(array)) one.strides.insert(strides_.at(array));
    }
    return found;
  }

 private:
  using Id = std::uint32_t;

  void readInstruction(std::span<const std::uint32_t> word) {
    enum : std::uint32_t { kName = 5, kMemberName = 6, kTypeInt = 21, kTypeFloat = 22, kTypeVector = 23 };
    enum : std::uint32_t { kTypeArray = 28, kTypeRuntimeArray = 29, kTypeStruct = 30, kConstant = 43 };
    enum : std::uint32_t { kDecorate = 71, kMemberDecorate = 72 };
    enum : std::uint32_t { kBlock = 2, kBufferBlock = 3, kArrayStride = 6, kOffset = 35 };
    switch (word[0] & 0xffff) {
      case kName:
        names_[word[1]] = reinterpret_cast<const char*>(&word[2]);
        break;
      case kMemberName:
        memberNames_[word[1]][word[2]] = reinterpret_cast<const char*>(&word[3]);
        break;
      case kTypeInt:
      case kTypeFloat:
        sizes_[word[1]] = word[2] / 8;
        break;
      case kTypeVector:
        vectors_[word[1]] = {word[2], word[3]};
        break;
      case kTypeArray:
        lengths_[word[1]] = word[3];
        [[fallthrough]];
      case kTypeRuntimeArray:
        arrayElements_[word[1]] = word[2];
        break;
      case kTypeStruct:
        structTypes_[word[1]].assign(word.begin() + 2, word.end());
        break;
      case kConstant:
        constants_[word[2]] = word[3];
        break;
      case kDecorate:
        if (word[2] == kArrayStride) strides_[word[1]] = word[3];
        if (word[2] == kBlock || word[2] == kBufferBlock) blocks_.insert(word[1]);
        break;
      case kMemberDecorate:
        if (word[3] == kOffset) offsets_[word[1]][word[2]] = word[4];
        break;
      default:
        break;
    }
  }

  std::uint32_t sizeOf(Id type) const {
    if (lengths_.count(type)) return constants_.at(lengths_.at(type)) * strides_.at(type);
    if (vectors_.count(type)) return vectors_.at(type).count * sizes_.at(vectors_.at(type).component);
    return sizes_.at(type);
  }

  std::map<Id, std::string> names_;
  std::map<Id, std::map<std::uint32_t, std::string>> memberNames_;
  std::map<Id, std::map<std::uint32_t, std::uint32_t>> offsets_;
  std::map<Id, std::vector<Id>> structTypes_;
  std::map<Id, Id> arrayElements_;
  struct Vector {
    Id component;
    std::uint32_t count;
  };
  std::map<Id, Vector> vectors_;
  std::map<Id, Id> lengths_;  // of arrays: the constant
  std::map<Id, std::uint32_t> sizes_, strides_, constants_;
  std::set<Id> blocks_;
};

}  // namespace ringlet::test
