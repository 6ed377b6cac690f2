// ByteFile: a file being written, in which every failure (no permission, full disk) becomes a sentence for a
// person.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "ringlet/base/result.h"

namespace ringlet {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// To be read from its beginning.
Result<OpenFile> openToRead(const std::filesystem::path& path);

/// Unbuffered: what a call wrote is with the operating system when it returns, so killing the program loses
/// none of it.
class ByteFile {
 public:
  /// Creates the file, or empties the one that is there. Its folder must exist.
  static Result<ByteFile> create(const std::filesystem::path& path);

  Status writeAt(std::uint64_t offset, std::string_view bytes);
  /// Cuts the file to its first `size` bytes.
  Status truncate(std::uint64_t size);
  /// Some file systems tell only here that the disk is full.
  Status close();
  /// Closes it and gives it the name of a finished file. Where it cannot have that, it keeps its own.
  Status closeAs(const std::filesystem::path& finished);

  /// False once closed, or moved from.
  bool isOpen() const { return file_ != nullptr; }
  const std::filesystem::path& path() const { return path_; }

 private:
  OpenFile file_;
  std::filesystem::path path_;
};

}  // namespace ringlet
