// ByteFile and ReadFile: a file being written and one being read, in which every failure (no permission, full
// disk) becomes a sentence for a person.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// To be read from its beginning: a regular file; a pipe would make the reader wait.
Result<OpenFile> openToRead(const std::filesystem::path& path);

/// A file being read, any bytes of it at a time.
class ReadFile {
 public:
  /// Errors: those of openToRead; its size cannot be asked for.
  static Result<ReadFile> open(const std::filesystem::path& path);

  /// Whether the file has these bytes.
  bool has(std::uint64_t offset, std::uint64_t count) const;
  /// Those bytes, in place of what `bytes` holds. Errors: the file does not have them, and `bytes` is as it
  /// was; a failing disk.
  Status readAt(std::uint64_t offset, std::size_t count, std::vector<std::byte>& bytes);

  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  OpenFile file_;
  std::filesystem::path path_;
  std::uint64_t size_ = 0;
};

/// Unbuffered: what a call wrote is with the operating system when it returns, so killing the program loses
/// none of it. One process at a time has it (an advisory lock). What one call writes within a page of kPage
/// bytes of the file is seen by others whole or not at all, whenever the program is killed.
class ByteFile {
 public:
  static constexpr std::uint64_t kPage = 4096;

  /// Creates the file, or empties the one that is there. Its folder must exist. Errors: another process is
  /// writing it (Fault::busy); it is no regular file.
  static Result<ByteFile> create(const std::filesystem::path& path);
  /// The one that is there, as it is.
  static Result<ByteFile> open(const std::filesystem::path& path);

  Status writeAt(std::uint64_t offset, std::string_view bytes);
  /// So many bytes, or as many as there are.
  Result<std::string> readAt(std::uint64_t offset, std::size_t count) const;
  /// Cuts the file to its first `size` bytes.
  Status truncate(std::uint64_t size);
  /// Whether the file of its name is still this one: somebody may have moved or removed it.
  bool isThere() const;
  /// Gives it another name, in the same folder.
  Status rename(const std::filesystem::path& name);
  /// What was written is on the disk.
  Status sync();
  /// Closes it, all of it on the disk, and gives it the name of a finished file. Where it cannot have that,
  /// it keeps its own. Some file systems tell only here that the disk is full.
  Status closeAs(const std::filesystem::path& finished);

  /// False once closed, or moved from.
  bool isOpen() const { return file_ != nullptr; }
  const std::filesystem::path& path() const { return path_; }

 private:
  static Result<ByteFile> openLocked(const std::filesystem::path& path, int flags);
  Error failure(const char* what, int code) const;
  int descriptor() const { return fileno(file_.get()); }

  OpenFile file_;
  std::filesystem::path path_;
};

/// A file to be written that will have this name once it is finished (closeAs), and until then PATH.partial.
/// Errors: those of ByteFile::create; the name is that of no regular file.
Result<ByteFile> createPartial(const std::filesystem::path& path);

/// Where one run goes on with what another left: PATH.partial, or, where that one was ended while it gave its
/// files their names, PATH; nothing is changed yet.
Result<ByteFile> openPartial(const std::filesystem::path& path);

}  // namespace ringlet
