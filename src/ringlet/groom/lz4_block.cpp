// Implements groom/lz4_block.h.
//
//   a sequence:  token, whose high four bits count literals and whose low four bits a repeat less 4; 15 means
//                that bytes to be added follow, up to the first that is not 255
//                the literals
//                u16 how far back the repeat begins
//   The last sequence ends with its literals.
#include "ringlet/groom/lz4_block.h"

#include <algorithm>
#include <cstdint>

namespace ringlet {
namespace {

constexpr std::size_t kShortestRepeat = 4;

class Lz4Reader {
 public:
  explicit Lz4Reader(std::span<const std::byte> block) : block_(block) {}

  std::size_t left() const { return block_.size() - at_; }
  std::size_t next() { return std::to_integer<std::size_t>(block_[at_++]); }
  std::span<const std::byte> take(std::size_t count) {
    at_ += count;
    return block_.subspan(at_ - count, count);
  }

  // Of four bits, and the bytes after them; nothing where the block ends within, or at a length beyond
  // `most`.
  std::optional<std::size_t> length(std::size_t bits, std::size_t most) {
    std::size_t sum = bits;
    for (std::size_t more = bits == 15 ? 255 : 0; more == 255;) {
      if (left() == 0) return std::nullopt;
      more = next();
      sum += more;
      if (sum > most) return std::nullopt;
    }
    return sum;
  }

 private:
  std::span<const std::byte> block_;
  std::size_t at_ = 0;
};

}  // namespace

bool appendLz4Block(std::span<const std::byte> block, std::size_t mostBytes, std::vector<std::byte>& out) {
  Lz4Reader reader(block);
  const std::size_t begin = out.size();
  while (reader.left() > 0) {
    const std::size_t token = reader.next();
    const auto literals = reader.length(token >> 4, block.size());
    if (!literals || *literals > reader.left() || out.size() + *literals > mostBytes) return false;
    const auto bytes = reader.take(*literals);
    out.insert(out.end(), bytes.begin(), bytes.end());
    if (reader.left() == 0) return true;

    if (reader.left() < 2) return false;
    const std::size_t low = reader.next(), distance = low | reader.next() << 8;
    const auto extra = reader.length(token & 15, mostLz4Bytes(block.size()));
    if (!extra || distance == 0 || distance > out.size() - begin) return false;
    const std::size_t count = *extra + kShortestRepeat;
    if (out.size() + count > mostBytes) return false;
    // It may run into what it appends.
    for (std::size_t from = out.size() - distance, i = 0; i < count; ++i) {
      const std::byte value = out[from + i];
      out.push_back(value);
    }
  }
  return false;
}

void appendLz4Literals(std::span<const std::byte> bytes, std::vector<std::byte>& out) {
  std::size_t count = bytes.size();
  out.push_back(static_cast<std::byte>(std::min<std::size_t>(count, 15) << 4));
  if (count >= 15) {
    for (count -= 15; count >= 255; count -= 255) out.push_back(std::byte{255});
    out.push_back(static_cast<std::byte>(count));
  }
  out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace ringlet
