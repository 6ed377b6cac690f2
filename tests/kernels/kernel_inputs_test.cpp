// What parity's cases never set, the tests never see. So: every input of every kernel that steps hair, found
// in its code, and the case of parity/input_cases.h that sets it, read from what reached the device. An input
// is a number of a buffer or of push constants that no kernel writes; a case sets it to something that is
// neither neutral nor what plain hair has. One that no case sets fails, and so does an exception that is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "embedded_modules.h"
#include "parity/input_cases.h"
#include "tests/kernels/spirv_structs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/kernel_spy.h"

namespace ringlet::test {
namespace {

// Kernels whose inputs other tests set, with their reason.
struct Elsewhere {
  const char* begin;  // of their names
  const char* reason;
};
const Elsewhere kElsewhere[] = {
    {"probe_", "no hair: conform_probes.cpp has each bit of what they must say"},
    {"render_", "pictures, which the reference has not: tests/render"},
    {"follow_", "hairs that follow: tests/follow holds them against reference/follow_guide.h"},
    {"pose_", "they hand positions on: tests/follow"},
    {"part_", "divided hair: kernels/DividedHair has the bits of the whole"},
    {"contact_sample", "decides how long lists stay, which changes no bits: kernels/ContactLists"},
    {"contact_judge", "likewise"},
};

// What no case needs to set: "record.member" or "block", with a number in brackets one number of it.
struct Exception {
  const char* input;
  const char* reason;
};
const Exception kExceptions[] = {
    {"TODO", "TODO"},
};

// What does nothing, where that is not 0.
std::optional<float> neutralOf(const std::string& member, std::uint32_t word) {
  const bool isQuaternion = member == "rotation" || member == "turn";
  if (isQuaternion && word == 3) return 1.f;
  if (member == "inertiaFactor" || member == "bendFactor") return 1.f;
  return std::nullopt;
}

struct Input {
  std::string kernel, owner, member;  // the owner: a record, or a block of numbers
  std::uint32_t word = 0;
  auto operator<=>(const Input&) const = default;
  std::string withoutKernel() const { return member.empty() ? owner : owner + "." + member; }
};
struct Found {
  std::optional<std::uint32_t> first;  // value that was ever seen
  std::string setBy;                   // the first case
};

std::vector<std::string> kernelStems() {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(RINGLET_SOURCE_DIR "/shaders/kernels"))
    stems.push_back(entry.path().stem().string());
  return stems;
}

// Of a module, whose name goes on with its definitions.
std::string stemOf(std::string_view module) {
  static const std::vector<std::string> stems = kernelStems();
  std::string longest;
  for (const std::string& stem : stems)
    if (module.starts_with(stem) && stem.size() > longest.size()) longest = stem;
  return longest;
}

const Elsewhere* elsewhere(const std::string& kernel) {
  const auto found =
      std::ranges::find_if(kElsewhere, [&](const Elsewhere& e) { return kernel.starts_with(e.begin); });
  return found == std::end(kElsewhere) ? nullptr : &*found;
}

const Exception* exceptionOf(const Input& input) {
  const std::string whole = input.withoutKernel(), one = fmt::format("{}[{}]", whole, input.word);
  const auto found = std::ranges::find_if(
      kExceptions, [&](const Exception& e) { return whole == e.input || one == e.input; });
  return found == std::end(kExceptions) ? nullptr : &*found;
}

// The inputs of all kernels, and what was seen of each.
class InputTable {
 public:
  InputTable() {
    std::set<std::string> written;  // blocks that some kernel writes
    for (const EmbeddedModule& module : kEmbeddedModules) {
      for (const SpirvBlock& block : SpirvModule(module.words).blocks())
        if (block.isWritten && !elsewhere(stemOf(module.name))) written.insert(block.name);
    }
    for (const EmbeddedModule& module : kEmbeddedModules) {
      const std::string stem = stemOf(module.name);
      if (elsewhere(stem)) continue;
      Code& code = codes_.emplace_back(Code{stem, {module.words.begin(), module.words.end()}, {}});
      for (const SpirvBlock& block : SpirvModule(module.words).blocks()) {
        if (!written.contains(block.name)) code.blocks.push_back(block);
      }
      for (const SpirvBlock& block : code.blocks) {
        for (const SpirvMember& member : block.members)
          for (std::uint32_t w = 0; w < member.size / 4; ++w) inputs_[inputOf(stem, block, member, w)];
      }
    }
  }

  void look(const KernelSpy& spy, const SpiedCommands& commands, const std::string& caseName) {
    for (const SpiedCommand& command : commands) {
      if (command.kind != SpiedCommand::Kind::dispatch) continue;
      const Code* code = codeOf(spy.codeOf(command.pipeline));
      if (!code) continue;
      const auto buffers = spy.buffersOf(command.set);
      for (const SpirvBlock& block : code->blocks) {
        const auto buffer = buffers.find(block.binding);
        if (block.isPushed) {
          look(code->stem, block, command.pushConstants, caseName);
        } else if (buffer != buffers.end()) {
          look(code->stem, block, buffer->second, caseName);
        }
      }
    }
  }

  const std::map<Input, Found>& inputs() const { return inputs_; }

 private:
  struct Code {
    std::string stem;
    std::vector<std::uint32_t> words;
    std::vector<SpirvBlock> blocks;  // that are inputs
  };

  static Input inputOf(const std::string& stem, const SpirvBlock& block, const SpirvMember& member,
                       std::uint32_t word) {
    return {stem, block.record.empty() ? block.name : block.record, member.name, word};
  }

  const Code* codeOf(const std::vector<std::uint32_t>& words) const {
    const auto found = std::ranges::find(codes_, words, &Code::words);
    return found == codes_.end() ? nullptr : &*found;
  }

  void look(const std::string& stem, const SpirvBlock& block, std::span<const std::byte> bytes,
            const std::string& caseName) {
    const std::size_t stride = block.stride > 0 ? block.stride : bytes.size();
    for (const SpirvMember& member : block.members) {
      for (std::uint32_t w = 0; w < member.size / 4; ++w) {
        Found& found = inputs_.at(inputOf(stem, block, member, w));
        const std::optional<float> neutral = neutralOf(member.name, w);
        for (std::size_t at = member.offset + 4 * w; found.setBy.empty() && at + 4 <= bytes.size();
             at += stride) {
          std::uint32_t value = 0;
          std::memcpy(&value, bytes.data() + at, 4);
          if (!found.first) found.first = value;
          const bool isNeutral =
              value == 0 || (neutral && std::abs(std::bit_cast<float>(value) - *neutral) < 1e-6f);
          if (!isNeutral && value != *found.first) found.setBy = caseName;
        }
      }
    }
  }

  std::vector<Code> codes_;
  std::map<Input, Found> inputs_;
};

// A row a member of a kernel's inputs: the cases that set its numbers.
void print(const InputTable& table) {
  std::map<std::string, std::set<std::string>> rows;
  for (const auto& [input, found] : table.inputs()) {
    const Exception* exception = exceptionOf(input);
    rows[fmt::format("{:<18} {}", input.kernel, input.withoutKernel())].insert(
        !found.setBy.empty() ? found.setBy
        : exception          ? fmt::format("(none: {})", exception->reason)
                             : "NONE");
  }
  for (const auto& [row, cases] : rows) {
    fmt::print("{:<60}", row);
    for (const std::string& name : cases) fmt::print(" | {}", name);
    fmt::print("\n");
  }
}

class KernelInputs : public GpuTest {};

TEST_F(KernelInputs, EachIsSetBySomeCase) {
  const auto opened = gpu::Device::open();
  ASSERT_TRUE(opened) << opened.error().message;
  if (!(*opened)->properties().isCpu) GTEST_SKIP() << "the host sees no buffers of this device";
  InputTable table;
  {
    KernelSpy spy(**opened);
    const ComputeDevice device = ComputeDevice::over(*opened);
    for (const parity::InputCase& c : parity::inputCases()) {
      SCOPED_TRACE(c.name);
      spy.onDone = [&](const SpiedCommands& commands) { table.look(spy, commands, c.name); };
      const parity::FieldError e = c.error(device);
      fmt::print("{:<45} {:.1e} of {:.1e}, {}\n", c.name, e.error, c.tolerance, e.field);
      EXPECT_LE(e.error, c.tolerance) << e.field << "\n" << e.where;
    }
  }
  expectNoMessages(*(*opened)->validationLog());
  print(table);
  std::set<const Exception*> used;
  for (const auto& [input, found] : table.inputs()) {
    const Exception* exception = exceptionOf(input);
    if (exception && found.setBy.empty()) used.insert(exception);
    EXPECT_TRUE(exception || !found.setBy.empty())
        << input.kernel << ": no case of parity/input_cases.cpp sets " << input.withoutKernel() << "["
        << input.word << "]" << (found.first ? "" : ", and none runs the kernel");
  }
  for (const Exception& exception : kExceptions)
    EXPECT_TRUE(used.contains(&exception)) << exception.input << " is set: it is no exception";
}

TEST(KernelInputs_, EveryKernelIsTriedHereOrElsewhere) {
  for (const Elsewhere& family : kElsewhere) {
    EXPECT_TRUE(std::ranges::any_of(kernelStems(), [&](const std::string& stem) {
      return stem.starts_with(family.begin);
    })) << family.begin << " begins no kernel's name";
  }
}

}  // namespace
}  // namespace ringlet::test
