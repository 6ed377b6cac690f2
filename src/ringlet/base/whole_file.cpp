// Implements base/whole_file.h.
#include "ringlet/base/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "ringlet/base/file_fault.h"

namespace ringlet {
namespace {

// Beyond any groom (2^32 points take 48 GiB), and refused before memory is asked for: some systems promise
// memory they do not have and end the program that uses it.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 36;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reasonOf(int code) { return std::generic_category().message(code); }

// A name beside `path` that no other writer uses: the time, and a count for two writers in one process.
std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
  static std::atomic<unsigned> count{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{:x}-{:x}.partial", static_cast<std::uint64_t>(now), count.fetch_add(1));
  return temporary;
}

// So that its names are on the disk as well; where that cannot be done the file is there all the same.
void syncFolder(const std::filesystem::path& folder) {
  const int file = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  (void)fsync(file);
  close(file);
}

}  // namespace

Result<std::vector<std::byte>> readWholeFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) {
    return Error{fmt::format("{}: cannot read it: {}", name, code ? code.message() : "no such file"),
                 Fault::input};
  }
  if (std::filesystem::is_directory(status))
    return Error{fmt::format("{}: is a folder; expected a file", name), Fault::input};
  if (!std::filesystem::is_regular_file(status))
    return Error{fmt::format("{}: is not a regular file", name), Fault::input};
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return Error{fmt::format("{}: cannot tell its size: {}", name, code.message()), Fault::input};

  if (size > kLargestFile) {
    return Error{fmt::format("{}: has {} bytes; at most {} can be read", name, size, kLargestFile),
                 Fault::input};
  }

  const File file(std::fopen(name.c_str(), "rb"));
  if (!file) return Error{fmt::format("{}: cannot open it: {}", name, reasonOf(errno)), Fault::input};
  std::vector<std::byte> bytes;
  bytes.resize(static_cast<std::size_t>(size));
  const std::size_t found = bytes.empty() ? 0 : std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (found != bytes.size()) {
    return Error{fmt::format("{}: read {} of {} bytes: {}", name, found, size,
                             std::ferror(file.get()) ? reasonOf(errno) : "the file became shorter meanwhile"),
                 Fault::input};
  }
  return bytes;
}

Status writeWholeFile(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string name = path.string();
  const std::filesystem::path temporary = temporaryBeside(path);
  File file(std::fopen(temporary.string().c_str(), "wbx"));
  if (!file)
    return Error{fmt::format("{}: cannot write into its folder: {}", name, reasonOf(errno)),
                 writeFault(errno)};

  // A full disk shows at any of the four: the write, the flush, the way to the disk or the close.
  errno = 0;
  bool isWritten = bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  isWritten = isWritten && std::fflush(file.get()) == 0 && fdatasync(fileno(file.get())) == 0;
  int reason = errno;
  if (std::fclose(file.release()) != 0 && isWritten) {
    isWritten = false;
    reason = errno;
  }

  std::error_code ignored;
  if (!isWritten) {
    std::filesystem::remove(temporary, ignored);
    return Error{fmt::format("{}: cannot write its {} bytes: {}", name, bytes.size(), reasonOf(reason)),
                 writeFault(reason)};
  }
  std::error_code code;
  std::filesystem::rename(temporary, path, code);
  if (code) {
    std::filesystem::remove(temporary, ignored);
    return Error{fmt::format("{}: cannot put the finished file in place: {}", name, code.message()),
                 writeFault(code.value())};
  }
  syncFolder(path.parent_path());
  return {};
}

std::optional<std::filesystem::path> fileOfTemporary(const std::filesystem::path& path) {
  // NAME.TIME-COUNT.partial, both in hexadecimal: see temporaryBeside.
  if (path.extension() != ".partial") return std::nullopt;
  const std::filesystem::path named = path.parent_path() / path.stem();
  const std::string mark = named.extension().string();
  constexpr std::string_view kHex = "0123456789abcdef";
  const std::size_t dash = mark.find_first_not_of(kHex, 1);
  const bool isMark = dash != std::string::npos && dash > 1 && mark[dash] == '-' && dash + 1 < mark.size() &&
                      mark.find_first_not_of(kHex, dash + 1) == std::string::npos;
  return isMark ? std::optional(named.parent_path() / named.stem()) : std::nullopt;
}

}  // namespace ringlet
