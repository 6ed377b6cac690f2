// Meshes that move in USD files, text and crates. A file may name itself as its value clip: "self", or
// "self.#".
#include "ringlet/motion/usd_mesh.h"

#include "tests/fuzz/demand_mesh.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

namespace {

class OnlyItself final : public UsdClipFiles {
 public:
  explicit OnlyItself(std::span<const std::byte> bytes) : bytes_(bytes) {}

  Status check(const std::string&) const override { return {}; }
  std::string pathOf(const std::string& name) const override { return name; }
  // A template has nine of it.
  bool has(const std::string& name) const override {
    return name == "self" ||
           (name.size() == 6 && name.starts_with("self.") && name[5] >= '1' && name[5] <= '9');
  }
  Result<std::vector<std::byte>> read(const std::string& name) const override {
    if (!has(name)) return Error{"there is no such clip"};
    return std::vector<std::byte>(bytes_.begin(), bytes_.end());
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  const OnlyItself clips(bytes);
  if (const auto read = readUsdMesh(bytes, "fuzz.usd", {.upIsZ = true, .clips = &clips})) demandMesh(**read);
}

}  // namespace ringlet::fuzz
