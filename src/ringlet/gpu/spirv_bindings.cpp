// Implements gpu/spirv_bindings.h. Numbers are those of the SPIR-V specification, sections 2.3 and 3.
#include "ringlet/gpu/spirv_bindings.h"

#include <algorithm>
#include <map>
#include <set>

#include "ringlet/base/assert.h"

namespace ringlet::gpu {
namespace {

using Id = std::uint32_t;

enum Op : std::uint32_t {
  kEntryPoint = 15,
  kTypePointer = 32,
  kFunction = 54,
  kFunctionCall = 57,
  kVariable = 59,
  kImageTexelPointer = 60,
  kLoad = 61,
  kStore = 62,
  kCopyMemory = 63,
  kAccessChain = 65,
  kInBoundsAccessChain = 66,
  kArrayLength = 68,
  kDecorate = 71,
  kCopyObject = 83,
};
constexpr std::uint32_t kDecorationBufferBlock = 3, kDecorationBinding = 33;
constexpr std::uint32_t kStorageClassUniformConstant = 0, kStorageClassUniform = 2;

struct Variable {
  Id pointerType = 0;
  std::uint32_t storageClass = 0;
};

struct Module {
  Id entryPoint = 0;
  std::map<Id, std::uint32_t> numbers;  // of variables with a binding
  std::set<Id> bufferBlocks;            // structs that make a uniform block one of storage, before SPIR-V 1.3
  std::map<Id, Id> pointees;            // of pointer types
  std::map<Id, Variable> variables;
  std::map<Id, std::vector<Id>> mentions;  // what each function's body may refer to: variables and functions
};

// The operands of a function's instruction that may be a variable or a function.
std::span<const Id> mentionedBy(std::span<const Id> instruction) {
  switch (instruction[0] & 0xffff) {
    case kFunctionCall:
    case kImageTexelPointer:
    case kLoad:
    case kAccessChain:
    case kInBoundsAccessChain:
    case kArrayLength:
    case kCopyObject:
      return instruction.subspan(3);
    case kStore:
    case kCopyMemory:
      return instruction.subspan(1);
    default:
      return {};
  }
}

Module read(std::span<const std::uint32_t> spirv) {
  Module module;
  std::vector<Id>* body = nullptr;
  constexpr std::size_t kHeaderWords = 5;
  for (std::size_t at = kHeaderWords; at < spirv.size();) {
    const std::size_t length = spirv[at] >> 16;
    RINGLET_ASSERT(length > 0 && length <= spirv.size() - at, "SPIR-V that ends within an instruction");
    const auto word = spirv.subspan(at, length);
    at += length;
    switch (word[0] & 0xffff) {
      case kEntryPoint:
        module.entryPoint = word[2];
        break;
      case kDecorate:
        if (word[2] == kDecorationBinding) module.numbers[word[1]] = word[3];
        if (word[2] == kDecorationBufferBlock) module.bufferBlocks.insert(word[1]);
        break;
      case kTypePointer:
        module.pointees[word[1]] = word[3];
        break;
      case kVariable:
        module.variables[word[2]] = {word[1], word[3]};
        break;
      case kFunction:
        body = &module.mentions[word[2]];
        break;
      default:
        break;
    }
    if (!body) continue;
    const auto mentioned = mentionedBy(word);
    body->insert(body->end(), mentioned.begin(), mentioned.end());
  }
  return module;
}

// Buffers are all that kernels here bind: a uniform constant is a texel buffer.
BindingKind kindOf(const Module& module, const Variable& variable) {
  if (variable.storageClass == kStorageClassUniformConstant) return BindingKind::texels;
  const bool isUniform = variable.storageClass == kStorageClassUniform &&
                         !module.bufferBlocks.contains(module.pointees.at(variable.pointerType));
  return isUniform ? BindingKind::uniform : BindingKind::storage;
}

}  // namespace

std::vector<KernelBinding> bindingsOf(std::span<const std::uint32_t> spirv) {
  const Module module = read(spirv);
  std::vector<KernelBinding> bindings;
  std::set<Id> seen{module.entryPoint};
  std::vector<Id> open{module.entryPoint};
  while (!open.empty()) {
    const auto found = module.mentions.find(open.back());
    open.pop_back();
    if (found == module.mentions.end()) continue;
    for (const Id id : found->second) {
      if (!seen.insert(id).second) continue;
      open.push_back(id);
      if (const auto number = module.numbers.find(id); number != module.numbers.end())
        bindings.push_back({number->second, kindOf(module, module.variables.at(id))});
    }
  }
  std::ranges::sort(bindings, {}, &KernelBinding::number);
  return bindings;
}

}  // namespace ringlet::gpu
