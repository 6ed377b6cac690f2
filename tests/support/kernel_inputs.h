// KernelInputs: what parity's cases never set, the tests never see. So: every input of some kernels, found in
// their code, and the case that sets it, read from what reached the device. An input is a number of push
// constants, or of a record of a buffer that no kernel writes, that the code asks for. A case sets it to
// something that is neither neutral nor the first that was ever seen of it. One that no case sets fails a
// test, and so does an exception that is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/kernel_spy.h"
#include "tests/support/spirv_structs.h"

namespace ringlet::test {

/// Kernels by the beginning of their names, with the test whose cases set their inputs, or why none does.
struct KernelFamily {
  const char* begin;
  const char* where;
};
inline constexpr const char *kStepInputs = "kernels/KernelInputsTest",
                            *kFollowInputs = "follow/FollowStageTest";
inline constexpr KernelFamily kKernelFamilies[] = {
    {"strand_", kStepInputs},
    {"contact_judge", "divided hair has the bits of the whole: kernels/DividedHair"},
    {"contact_", kStepInputs},
    {"volume_mean", "divided hair has the bits of the whole: kernels/DividedHair"},
    {"volume_", kStepInputs},
    {"frame_", kStepInputs},
    {"follow_", kFollowInputs},
    {"pose_", "they hand positions on: follow/DevicePose compares the bits"},
    {"part_", "divided hair has the bits of the whole: kernels/DividedHair"},
    {"mesh_", "grids of bodies that bend, against the reference's: kernels/MeshField"},
    {"cloth_", "lists of cloth, frames with which agree with the reference: kernels/BendingBodies"},
    {"render_", "pictures, of which the reference has none: tests/render"},
    {"probe_", "no hair: program/conform_probes.cpp has each bit of what they must say"},
};

/// What no case sets: "record.member" or "block", with a number in brackets one number of it; before it, with
/// a slash, the kernel, if it is of one.
struct InputException {
  const char* input;
  const char* reason;
};

class KernelInputs {
 public:
  /// Of the modules (embedded_modules.h) whose family names this test.
  template <class Modules>
  KernelInputs(const Modules& modules, const char* test) : test_(test) {
    for (const auto& module : modules) add(module.name, module.words);
    forgetWritten();
  }

  /// What a submission of a case used.
  void look(const KernelSpy& spy, const SpiedCommands& commands, const std::string& caseName);
  /// Fails for what no case set, and prints the table: a row a member, with the cases that set its numbers.
  void expectAllSet(std::span<const InputException> exceptions) const;

 private:
  struct Code {
    std::string kernel;
    std::vector<std::uint32_t> words;
    std::vector<SpirvBlock> blocks;  // that are inputs
  };
  struct Input {
    std::string kernel, owner, member;  // the owner: a record, or a block of numbers
    std::uint32_t word = 0;
    auto operator<=>(const Input&) const = default;
    std::string name() const { return member.empty() ? owner : owner + "." + member; }
  };
  struct Seen {
    std::optional<std::uint32_t> first;
    std::string setBy;  // the first case
  };

  void add(std::string_view module, std::span<const std::uint32_t> words);
  void forgetWritten();
  void look(const std::string& kernel, const SpirvBlock& block, std::span<const std::byte> bytes,
            const std::string& caseName);
  static Input inputOf(const std::string& kernel, const SpirvBlock& block, const SpirvMember& member,
                       std::uint32_t word);

  std::string test_;
  std::vector<Code> codes_;
  std::map<Input, Seen> inputs_;
};

/// The stems of shaders/kernels.
std::vector<std::string> kernelStems();

}  // namespace ringlet::test
