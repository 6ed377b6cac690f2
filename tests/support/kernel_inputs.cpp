// Implements support/kernel_inputs.h.
#include "tests/support/kernel_inputs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

#include "ringlet/gpu/spirv_bindings.h"

namespace ringlet::test {
namespace {

// Of a module, whose name goes on with its definitions.
std::string stemOf(std::string_view module) {
  static const std::vector<std::string> stems = kernelStems();
  std::string longest;
  for (const std::string& stem : stems)
    if (module.starts_with(stem) && stem.size() > longest.size()) longest = stem;
  return longest;
}

std::string familyOf(const std::string& kernel) {
  const auto found = std::ranges::find_if(
      kKernelFamilies, [&](const KernelFamily& family) { return kernel.starts_with(family.begin); });
  return found == std::end(kKernelFamilies) ? "" : found->where;
}

// Whether a number does nothing: 0, or what its member says.
bool isNeutral(const SpirvMember& member, std::uint32_t word, std::uint32_t value) {
  if (value == 0) return true;
  const bool isTurn = (member.name == "rotation" || member.name == "turn") && word == 3;
  const bool isFactor = member.name == "inertiaFactor" || member.name == "bendFactor";
  return (isTurn || isFactor) && std::abs(std::bit_cast<float>(value) - 1) < 1e-6f;
}

}  // namespace

std::vector<std::string> kernelStems() {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(RINGLET_SOURCE_DIR "/shaders/kernels"))
    stems.push_back(entry.path().stem().string());
  return stems;
}

void KernelInputs::add(std::string_view module, std::span<const std::uint32_t> words) {
  const std::string kernel = stemOf(module);
  EXPECT_NE(familyOf(kernel), "") << kernel << " is in no row of kKernelFamilies";
  if (familyOf(kernel) != test_) return;
  Code& code = codes_.emplace_back(Code{kernel, {words.begin(), words.end()}, SpirvModule(words).blocks()});
  const std::vector<gpu::KernelBinding> bound = gpu::bindingsOf(words);
  std::erase_if(code.blocks, [&](const SpirvBlock& block) {
    return !block.isPushed &&
           std::ranges::find(bound, block.binding, &gpu::KernelBinding::number) == bound.end();
  });
}

// A block that some kernel writes is no input of the host's.
void KernelInputs::forgetWritten() {
  std::set<std::string> written;
  for (const Code& code : codes_) {
    for (const SpirvBlock& block : code.blocks)
      if (block.isWritten) written.insert(block.name);
  }
  for (Code& code : codes_) {
    std::erase_if(code.blocks, [&](const SpirvBlock& block) { return written.contains(block.name); });
    for (const SpirvBlock& block : code.blocks) {
      for (const SpirvMember& member : block.members)
        for (std::uint32_t w = 0; w < member.size / 4; ++w) inputs_[inputOf(code.kernel, block, member, w)];
    }
  }
}

KernelInputs::Input KernelInputs::inputOf(const std::string& kernel, const SpirvBlock& block,
                                          const SpirvMember& member, std::uint32_t word) {
  return {kernel, block.record.empty() ? block.name : block.record, member.name, word};
}

void KernelInputs::look(const KernelSpy& spy, const SpiedCommands& commands, const std::string& caseName) {
  for (const SpiedCommand& command : commands) {
    if (command.kind != SpiedCommand::Kind::dispatch) continue;
    const auto code = std::ranges::find(codes_, spy.codeOf(command.pipeline), &Code::words);
    if (code == codes_.end()) continue;
    const auto buffers = spy.buffersOf(command.set);
    for (const SpirvBlock& block : code->blocks) {
      const auto buffer = buffers.find(block.binding);
      if (block.isPushed) {
        look(code->kernel, block, command.pushConstants, caseName);
      } else if (buffer != buffers.end()) {
        look(code->kernel, block, buffer->second, caseName);
      }
    }
  }
}

void KernelInputs::look(const std::string& kernel, const SpirvBlock& block, std::span<const std::byte> bytes,
                        const std::string& caseName) {
  if (bytes.empty()) return;
  const std::size_t stride = block.stride > 0 ? block.stride : bytes.size();
  for (const SpirvMember& member : block.members) {
    for (std::uint32_t w = 0; w < member.size / 4; ++w) {
      Seen& seen = inputs_.at(inputOf(kernel, block, member, w));
      for (std::size_t at = member.offset + 4 * w; seen.setBy.empty() && at + 4 <= bytes.size();
           at += stride) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        if (!seen.first) seen.first = value;
        const bool isNew = value != *seen.first;
        const bool isAllInUse = block.isPushed || block.isUniform;
        if (isNew && (isAllInUse || !isNeutral(member, w, value))) seen.setBy = caseName;
      }
    }
  }
}

void KernelInputs::expectAllSet(std::span<const InputException> exceptions) const {
  std::set<const InputException*> used;
  std::map<std::string, std::set<std::string>> rows;
  for (const auto& row : inputs_) {
    const auto& input = row.first;
    const auto& seen = row.second;
    const std::string name = input.name(), one = fmt::format("{}[{}]", name, input.word);
    const auto exception = std::ranges::find_if(exceptions, [&](const InputException& e) {
      const std::string_view text = e.input;
      return text == name || text == one || text == input.kernel + "/" + name ||
             text == input.kernel + "/" + one;
    });
    const bool isExcused = exception != exceptions.end();
    if (isExcused && seen.setBy.empty()) used.insert(&*exception);
    EXPECT_TRUE(isExcused || !seen.setBy.empty())
        << input.kernel << ": no case sets " << one
        << (seen.first ? fmt::format(" to something else than {:#x}", *seen.first) : ", nor runs the kernel");
    rows[fmt::format("{:<18} {}", input.kernel, name)].insert(
        !seen.setBy.empty() ? seen.setBy
                            : fmt::format("(no: {})", isExcused ? exception->reason : "MISSING"));
  }
  for (const InputException& exception : exceptions)
    EXPECT_TRUE(used.contains(&exception)) << exception.input << " is set, or gone: it is no exception";
  for (const auto& [row, cases] : rows) fmt::print("{:<56} {}\n", row, fmt::join(cases, " | "));
}

}  // namespace ringlet::test
