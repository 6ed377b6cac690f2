// Archive: values to bytes and back, by one function for both ways, so that what is read is what was written:
//
//   void Part::archive(Archive& a) { a.value(count_); a.list(points_); }
//
// Values have the bytes of the machine's memory: they are read by the same program on the same kind of
// machine. Whoever keeps the bytes guards them against damage (base/checksum.h); a reader checks only their
// number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace ringlet {

class Archive {
 public:
  /// Into bytes, which take() gives.
  static Archive writing() { return Archive(); }
  /// Reads from bytes, which must live as long.
  static Archive reading(std::span<const std::byte> bytes) {
    Archive archive;
    archive.from_ = bytes;
    archive.isReading_ = true;
    return archive;
  }

  bool isReading() const { return isReading_; }
  std::vector<std::byte> take() { return std::move(written_); }
  /// Whether all bytes were read, and none was missing. Where one was, everything from there on is unread.
  bool isWhole() const { return !isShort_ && from_.empty(); }
  bool isShort() const { return isShort_; }

  template <class T>
  void value(T& value) {
    values(std::span(&value, 1));
  }
  /// As many as there are, on both ways.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void values(std::span<T> values) { bytes(std::as_writable_bytes(values)); }
  /// The number of elements, and the elements; reading restores the length.
  template <class T>
  void list(std::vector<T>& list) {
    std::uint64_t count = list.size();
    value(count);
    if (isReading_) {
      if (count > from_.size() / sizeof(T)) return fail();
      list.resize(static_cast<std::size_t>(count));
    }
    values(std::span<T>(list));
  }
  void text(std::string& text) {
    std::vector<char> letters(text.begin(), text.end());
    list(letters);
    if (isReading_) text.assign(letters.begin(), letters.end());
  }
  void bytes(std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    if (!isReading_) {
      written_.insert(written_.end(), bytes.begin(), bytes.end());
      return;
    }
    if (bytes.size() > from_.size()) return fail();
    std::memcpy(bytes.data(), from_.data(), bytes.size());
    from_ = from_.subspan(bytes.size());
  }

  // For memory that the caller fills or reads itself: this number of bytes.
  std::span<std::byte> room(std::size_t count) {
    written_.resize(written_.size() + count);
    return std::span(written_).last(count);
  }
  std::span<const std::byte> next(std::size_t count) {
    if (count > from_.size()) {
      fail();
      return {};
    }
    const auto bytes = from_.first(count);
    from_ = from_.subspan(count);
    return bytes;
  }

 private:
  void fail() {
    isShort_ = true;
    from_ = {};
  }

  std::vector<std::byte> written_;
  std::span<const std::byte> from_;
  bool isReading_ = false, isShort_ = false;
};

}  // namespace ringlet
