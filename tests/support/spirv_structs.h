// Reads the structs with an explicit layout out of a SPIR-V module: offsets and sizes of their members, and
// the strides of arrays of them; and what its kernel sees, the push constants and the buffers.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tests/support/spirv_names.h"

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

/// A storage or uniform buffer, or the push constants.
struct SpirvBlock {
  std::string name;                  // of the block, as the shader has it
  std::uint32_t binding = 0;         // of a buffer
  bool isWritten = false;            // not declared readonly
  bool isPushed = false;             // push constants
  bool isUniform = false;            // a uniform buffer
  std::uint32_t stride = 0;          // from one record to the next [bytes]; 0: there is one
  std::string record;                // the struct that it holds; of numbers and vectors: empty
  std::vector<SpirvMember> members;  // of a record, those that the code reads or writes
};

class SpirvModule : SpirvNames {
 public:
  explicit SpirvModule(std::span<const std::uint32_t> words) {
    eachSpirvInstruction(words, [this](std::span<const std::uint32_t> word) { readInstruction(word); });
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

  /// Those that its code refers to.
  std::vector<SpirvBlock> blocks() const {
    std::vector<SpirvBlock> found;
    for (const auto& [variable, pointer] : variables_) {
      const Id block = pointees_.at(pointer);
      if (!blocks_.count(block) || !chains_.count(variable)) continue;
      SpirvBlock& one = found.emplace_back();
      one.name = names_.at(block);
      one.isPushed = pushed_.count(variable) != 0;
      if (bindings_.count(variable)) one.binding = bindings_.at(variable);
      one.isUniform = uniform_.count(variable) != 0;
      one.isWritten =
          !one.isPushed && !one.isUniform && !readonly_.count(variable) && !readonly_.count(block);
      Id inner = structTypes_.at(block).front();
      std::size_t depth = 0;  // of the index that says which member
      if (arrayElements_.count(inner) && structTypes_.at(block).size() == 1) {
        one.stride = strides_.at(inner);
        inner = arrayElements_.at(inner);
        depth = 2;
      }
      const bool isPlain = !structTypes_.count(inner);
      if (!isPlain) one.record = names_.at(inner);
      if (!isPlain && depth == 0) depth = 1;
      const Id fields = isPlain && one.stride == 0 ? block : inner;  // of plain members the block itself
      if (!structTypes_.count(fields)) {
        one.members.push_back({"", 0, sizeOf(fields)});
        continue;
      }
      const std::vector<Id>& types = structTypes_.at(fields);
      for (std::uint32_t k = 0; k < types.size(); ++k) {
        const bool isSized = lengths_.count(types[k]) || !arrayElements_.count(types[k]);
        if (isSized && isAsked(variable, depth, k))
          one.members.push_back({memberNames_.at(fields).at(k), offsets_.at(fields).at(k), sizeOf(types[k])});
      }
    }
    return found;
  }

 private:
  void readInstruction(std::span<const std::uint32_t> word) {
    SpirvNames::readInstruction(word);
    enum : std::uint32_t { kTypeInt = 21, kTypeFloat = 22, kTypeVector = 23 };
    enum : std::uint32_t { kTypeArray = 28, kTypeRuntimeArray = 29 };
    enum : std::uint32_t { kLoad = 61, kAccessChain = 65, kInBoundsAccessChain = 66 };
    enum : std::uint32_t { kVariable = 59, kDecorate = 71, kMemberDecorate = 72 };
    enum : std::uint32_t { kBlock = 2, kBufferBlock = 3, kArrayStride = 6, kNonWritable = 24, kBinding = 33 };
    enum : std::uint32_t { kOffset = 35, kUniform = 2, kPushConstant = 9 };
    switch (word[0] & 0xffff) {
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
      case kVariable:
        variables_[word[2]] = word[1];
        if (word[3] == kPushConstant) pushed_.insert(word[2]);
        if (word[3] == kUniform) uniform_.insert(word[2]);  // storage buffers are of a class of their own
        break;
      case kAccessChain:
      case kInBoundsAccessChain:
        if (variables_.count(word[3])) chains_[word[3]].emplace_back(word.begin() + 4, word.end());
        break;
      case kLoad:
        if (variables_.count(word[3])) chains_[word[3]].emplace_back();  // all of it
        break;
      case kDecorate:
        if (word[2] == kArrayStride) strides_[word[1]] = word[3];
        if (word[2] == kBinding) bindings_[word[1]] = word[3];
        if (word[2] == kNonWritable) readonly_.insert(word[1]);
        if (word[2] == kBlock || word[2] == kBufferBlock) blocks_.insert(word[1]);
        break;
      case kMemberDecorate:
        if (word[3] == kNonWritable) readonly_.insert(word[1]);  // all of a block, or none
        if (word[3] == kOffset) offsets_[word[1]][word[2]] = word[4];
        break;
      default:
        break;
    }
  }

  // Whether code asks for member k, or for all, of what a variable leads to by so many indices.
  bool isAsked(Id variable, std::size_t depth, std::uint32_t k) const {
    for (const std::vector<Id>& chain : chains_.at(variable))
      if (chain.size() <= depth || constants_.at(chain[depth]) == k) return true;
    return false;
  }

  std::uint32_t sizeOf(Id type) const {
    if (lengths_.count(type)) return constants_.at(lengths_.at(type)) * strides_.at(type);
    if (vectors_.count(type)) return vectors_.at(type).count * sizes_.at(vectors_.at(type).component);
    return sizes_.at(type);
  }

  std::map<Id, std::map<std::uint32_t, std::uint32_t>> offsets_;
  std::map<Id, Id> arrayElements_;
  struct Vector {
    Id component;
    std::uint32_t count;
  };
  std::map<Id, Vector> vectors_;
  std::map<Id, Id> lengths_;  // of arrays: the constant
  std::map<Id, std::uint32_t> sizes_, strides_;
  std::set<Id> blocks_, pushed_, uniform_, readonly_;
  std::map<Id, Id> variables_;  // the pointer's type
  std::map<Id, std::uint32_t> bindings_;
  std::map<Id, std::vector<std::vector<Id>>> chains_;  // of variables: the indices that code asks by
};

}  // namespace ringlet::test
