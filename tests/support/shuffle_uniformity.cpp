// Implements shuffle_uniformity.h, by the numbers of the SPIR-V specification.
#include "tests/support/shuffle_uniformity.h"

#include <algorithm>
#include <map>
#include <set>

namespace ringlet::test {
namespace {

using Id = std::uint32_t;

enum Op : std::uint32_t {
  opName = 5,
  opExtInst = 12,
  opEntryPoint = 15,
  opFunction = 54,
  opFunctionParameter = 55,
  opFunctionEnd = 56,
  opFunctionCall = 57,
  opVariable = 59,
  opLoad = 61,
  opStore = 62,
  opAccessChain = 65,
  opInBoundsAccessChain = 66,
  opDecorate = 71,
  opVectorShuffle = 79,
  opCompositeExtract = 81,
  opCompositeInsert = 82,
  opAtomicFirst = 227,
  opAtomicLast = 242,
  opPhi = 245,
  opLoopMerge = 246,
  opSelectionMerge = 247,
  opLabel = 248,
  opBranch = 249,
  opBranchConditional = 250,
  opSwitch = 251,
  opReturn = 253,
  opReturnValue = 254,
  opShuffle = 345,
  opShuffleXor = 346,
};
constexpr std::uint32_t kBuiltIn = 11, kInput = 1, kPrivate = 6, kFunction = 7;
// Built-ins that are the same in a subgroup: NumWorkgroups, WorkgroupSize, WorkgroupId, SubgroupSize,
// NumSubgroups, SubgroupId.
const std::set<std::uint32_t> kSame{24, 25, 26, 36, 38, 40};
// Without a result, as far as glslang writes them: lines, stores, barriers and what ends blocks.
bool hasResult(std::uint32_t op) {
  static const std::set<std::uint32_t> none{8,   62,  63,  99,  224, 225, 228, 246, 247,
                                            249, 250, 251, 252, 253, 254, 255, 317};
  return !none.contains(op);
}

// Where the operands of what has a result are numbers and no ids: from `first` on, `count` of them.
struct Literals {
  std::size_t first = ~std::size_t{0}, count = ~std::size_t{0};
  bool contains(std::size_t word) const { return word >= first && word - first < count; }
};
Literals literalsOf(std::uint32_t op) {
  if (op == opExtInst) return {3, 1};
  if (op == opLoad || op == opCompositeExtract) return {.first = 3};
  if (op == opVectorShuffle || op == opCompositeInsert) return {.first = 4};
  return {};
}

struct Instruction {
  std::uint32_t op = 0;
  std::vector<std::uint32_t> words{};  // after the first
};
struct Block {
  Id label = 0;
  std::vector<Instruction> body{};
  Id merge = 0, next = 0;  // of a selection or loop that begins here; a loop's continue target
  bool isLoop = false;
};
struct Function {
  Id id = 0;
  std::string name{};
  std::vector<Id> parameters{};
  std::vector<Block> blocks{};
};

std::vector<Id> targetsOf(const Block& block) {
  const Instruction& last = block.body.back();
  if (last.op == opBranch) return {last.words[0]};
  if (last.op == opBranchConditional) return {last.words[1], last.words[2]};
  std::vector<Id> all;
  if (last.op == opSwitch) {
    all.push_back(last.words[1]);
    for (std::size_t k = 3; k < last.words.size(); k += 2) all.push_back(last.words[k]);
  }
  return all;
}
bool returns(const Block& block) {
  return block.body.back().op == opReturn || block.body.back().op == opReturnValue;
}

class Analysis {
 public:
  explicit Analysis(std::span<const std::uint32_t> spirv) {
    read(spirv);
    findShuffling();
  }
  std::vector<std::string> divergent() {
    do changed_ = false, pass();
    while (changed_);
    std::vector<std::string> found;
    for (const Function& f : functions_)
      for (const Block& block : f.blocks)
        for (const Instruction& one : block.body)
          if (asks(one) && skipped_.contains(block.label)) found.push_back(f.name);
    return found;
  }

 private:
  void read(std::span<const std::uint32_t> spirv);
  void findShuffling();
  void pass();
  void markSkipped(const Function& f);
  void markBeyond(const Function& f, const std::set<Id>& from, const std::set<Id>& stops);
  void step(const Function& f, const Block& block, const Instruction& one);
  void call(const Instruction& one, bool isSkipped);

  bool asks(const Instruction& one) const {
    return one.op == opShuffle || one.op == opShuffleXor ||
           (one.op == opFunctionCall && shuffling_.contains(one.words[2]));
  }
  void add(std::set<Id>& set, Id id) { changed_ = set.insert(id).second || changed_; }
  Id rootOf(Id pointer) const {
    for (auto at = base_.find(pointer); at != base_.end(); at = base_.find(pointer)) pointer = at->second;
    return pointer;
  }

  std::vector<Function> functions_;
  std::map<Id, const Function*> byId_;
  std::map<Id, std::string> names_;
  std::map<Id, std::uint32_t> builtIns_, storage_;  // of variables
  std::map<Id, Id> base_;                           // of an access chain
  std::set<Id> shuffling_;                          // functions
  std::set<Id> differs_;  // values, variables and functions' results that differ between lanes
  std::set<Id> written_;  // parameters that a function stores what differs to
  std::set<Id> skipped_;  // blocks that some lanes may leave out
  std::set<Id> partly_;   // functions that some lanes may not call
  bool changed_ = false;
};

void Analysis::read(std::span<const std::uint32_t> spirv) {
  for (std::size_t at = 5; at < spirv.size();) {
    const std::uint32_t op = spirv[at] & 0xffff, length = spirv[at] >> 16;
    const auto words = spirv.subspan(at + 1, length - 1);
    at += length;
    if (op == opName) {
      names_[words[0]] = reinterpret_cast<const char*>(words.data() + 1);
    } else if (op == opDecorate && words[1] == kBuiltIn) {
      builtIns_[words[0]] = words[2];
    } else if (op == opFunction) {
      functions_.push_back({.id = words[1]});
    } else if (op == opFunctionParameter) {
      functions_.back().parameters.push_back(words[1]);
    } else if (op == opLabel) {
      functions_.back().blocks.push_back({.label = words[0]});
    } else if (op == opVariable) {
      storage_[words[1]] = words[2];
    } else if (!functions_.empty() && op != opFunctionEnd && !functions_.back().blocks.empty()) {
      Block& block = functions_.back().blocks.back();
      if (op == opSelectionMerge) block.merge = words[0];
      if (op == opLoopMerge) block.merge = words[0], block.next = words[1], block.isLoop = true;
      if (op == opAccessChain || op == opInBoundsAccessChain) base_[words[1]] = words[2];
      block.body.push_back({op, {words.begin(), words.end()}});
    }
  }
  for (Function& f : functions_) f.name = names_[f.id], byId_[f.id] = &f;
  for (const auto& [id, storage] : storage_) {
    const auto builtIn = builtIns_.find(id);
    if (storage == kInput && (builtIn == builtIns_.end() || !kSame.contains(builtIn->second)))
      differs_.insert(id);
  }
}

void Analysis::findShuffling() {
  do {
    changed_ = false;
    for (const Function& f : functions_)
      for (const Block& block : f.blocks)
        for (const Instruction& one : block.body)
          if (asks(one)) add(shuffling_, f.id);
  } while (changed_);
}

// What some of the lanes come to from `from` before one of `stops`.
void Analysis::markBeyond(const Function& f, const std::set<Id>& from, const std::set<Id>& stops) {
  std::set<Id> open = from, seen;
  while (!open.empty()) {
    const Id label = *open.begin();
    open.erase(open.begin());
    if (stops.contains(label) || !seen.insert(label).second) continue;
    add(skipped_, label);
    for (const Block& block : f.blocks)
      if (block.label == label)
        for (const Id target : targetsOf(block)) open.insert(target);
  }
}

void Analysis::markSkipped(const Function& f) {
  std::set<Id> ofLoops;  // where `continue` and `break` lead
  for (const Block& block : f.blocks)
    if (block.isLoop) ofLoops.insert({block.merge, block.next});
  for (const Block& block : f.blocks) {
    const Instruction& last = block.body.back();
    if ((last.op != opBranchConditional && last.op != opSwitch) || !differs_.contains(last.words[0]))
      continue;
    const std::vector<Id> targets = targetsOf(block);
    if (block.merge == 0 || block.isLoop) {  // a loop that lanes leave at different turns
      for (const Block& head : f.blocks)
        if (head.isLoop && std::ranges::find(targets, head.merge) != targets.end())
          markBeyond(f, {head.label}, {head.merge});
      continue;
    }
    std::set<Id> stops = ofLoops;
    stops.insert(block.merge);
    markBeyond(f, {targets.begin(), targets.end()}, stops);
    for (const Block& inside : f.blocks)
      if (skipped_.contains(inside.label) && returns(inside)) markBeyond(f, {block.merge}, {});
  }
}

void Analysis::call(const Instruction& one, bool isSkipped) {
  const Function& callee = *byId_.at(one.words[2]);
  if (isSkipped) add(partly_, callee.id);
  for (std::size_t k = 0; k < callee.parameters.size(); ++k) {
    const Id argument = rootOf(one.words[3 + k]);
    if (differs_.contains(argument) || differs_.contains(one.words[3 + k]))
      add(differs_, callee.parameters[k]);
    if (written_.contains(callee.parameters[k])) add(differs_, argument);
  }
  if (differs_.contains(callee.id) && !callee.name.starts_with("isAnyOfSubgroup("))
    add(differs_, one.words[1]);
}

void Analysis::step(const Function& f, const Block& block, const Instruction& one) {
  const bool isSkipped = skipped_.contains(block.label) || partly_.contains(f.id);
  if (one.op == opFunctionCall) return call(one, isSkipped);
  if (one.op == opStore) {
    const Id root = rootOf(one.words[0]);
    const auto storage = storage_.find(root);
    const bool isOwn =
        storage == storage_.end() || storage->second == kPrivate || storage->second == kFunction;
    if (isOwn && (isSkipped || differs_.contains(one.words[0]) || differs_.contains(one.words[1]))) {
      add(differs_, root);
      if (storage == storage_.end()) add(written_, root);  // a parameter
    }
    return;
  }
  if (one.op == opReturnValue) {
    if (isSkipped || differs_.contains(one.words[0])) add(differs_, f.id);
    return;
  }
  if (!hasResult(one.op) || one.words.size() < 2) return;
  bool differs =
      asks(one) || (one.op >= opAtomicFirst && one.op <= opAtomicLast) || (one.op == opPhi && isSkipped);
  const Literals literals = literalsOf(one.op);
  for (std::size_t k = 2; k < one.words.size(); ++k)
    differs = differs || (!literals.contains(k) && differs_.contains(one.words[k]));
  if (one.op == opLoad) differs = differs || differs_.contains(rootOf(one.words[2]));
  if (differs) add(differs_, one.words[1]);
}

void Analysis::pass() {
  for (const Function& f : functions_) {
    markSkipped(f);
    for (const Block& block : f.blocks)
      for (const Instruction& one : block.body) step(f, block, one);
  }
}

}  // namespace

std::vector<std::string> divergentShuffles(std::span<const std::uint32_t> spirv) {
  return Analysis(spirv).divergent();
}

}  // namespace ringlet::test
