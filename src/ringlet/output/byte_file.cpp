// Implements output/byte_file.h.
#include "ringlet/output/byte_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "ringlet/base/file_fault.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

namespace fs = std::filesystem;

Error cannot(const char* what, const fs::path& path, int code) {
  const char* advice = "";
  if (code == ENOSPC || code == EDQUOT) advice = "; free some space or choose another folder";
  if (code == EFBIG) advice = "; it may not grow further here: choose another folder, or write less";
  if (code == EACCES || code == EPERM || code == EROFS) advice = "; choose a folder you may write to";
  return {
      fmt::format("cannot {} {}: {}{}", what, path.string(), std::generic_category().message(code), advice),
      writeFault(code)};
}

Error cannotRead(const fs::path& path, const std::string& why) {
  return {fmt::format("cannot read {}: {}", path.string(), why), Fault::input};
}

bool isRegular(int file) {
  struct stat found {};
  return fstat(file, &found) == 0 && S_ISREG(found.st_mode);
}

// Whether the file of that name is still this one: its writer may have given it another between our opening
// and our lock.
bool isNamed(const fs::path& path, int file) {
  struct stat named {
  }, open{};
  return stat(path.c_str(), &named) == 0 && fstat(file, &open) == 0 && named.st_ino == open.st_ino &&
         named.st_dev == open.st_dev;
}

}  // namespace

Result<OpenFile> openToRead(const fs::path& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) return cannotRead(path, "it is a folder");
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return cannotRead(path, std::generic_category().message(errno));
  if (!isRegular(file)) {
    close(file);
    return cannotRead(path, "it is not a regular file");
  }
  OpenFile opened(fdopen(file, "rb"));
  if (!opened) close(file);
  return opened ? Result<OpenFile>(std::move(opened)) : cannotRead(path, "not enough memory");
}

Result<ReadFile> ReadFile::open(const fs::path& path) {
  auto opened = openToRead(path);
  if (!opened) return opened.error();
  ReadFile file;
  file.file_ = std::move(*opened);
  file.path_ = path;
  std::error_code code;
  file.size_ = fs::file_size(path, code);
  if (code) return cannotRead(path, code.message());
  return file;
}

bool ReadFile::has(std::uint64_t offset, std::uint64_t count) const {
  return offset <= size_ && count <= size_ - offset;
}

Status ReadFile::readAt(std::uint64_t offset, std::size_t count, std::vector<std::byte>& bytes) {
  const auto failed = [&] {
    return Error{fmt::format("cannot read bytes {} to {} of {}", offset, offset + count, path_.string()),
                 Fault::input};
  };
  if (!has(offset, count)) return failed();
  bytes.resize(count);
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
      std::fread(bytes.data(), 1, count, file_.get()) != count)
    return failed();
  return {};
}

Result<ByteFile> ByteFile::create(const fs::path& path) {
  auto file = openLocked(path, O_CREAT);
  if (!file) return file;
  if (ftruncate(file->descriptor(), 0) != 0) return file->failure("empty", errno);
  return file;
}

Result<ByteFile> ByteFile::open(const fs::path& path) { return openLocked(path, 0); }

Result<ByteFile> ByteFile::openLocked(const fs::path& path, int flags) {
  while (true) {
    // Without O_NONBLOCK a pipe of that name would make the program wait; without O_NOFOLLOW whoever may
    // write into the folder could name any file of ours to be emptied.
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW | flags, 0666);
    if (file < 0 && errno == ELOOP)
      return Error{fmt::format("cannot write {}: it is a symbolic link; remove it", path.string()),
                   Fault::output};
    if (file < 0) return cannot(flags & O_CREAT ? "create" : "open", path, errno);
    ByteFile made;
    made.path_ = path;
    made.file_.reset(fdopen(file, "r+b"));
    if (!isRegular(file))
      return Error{fmt::format("cannot write {}: it is not a regular file", path.string()), Fault::output};
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      return Error{fmt::format("cannot write {}: another process is writing it", path.string()), Fault::busy};
    if (!isNamed(path, file)) continue;
    std::setvbuf(made.file_.get(), nullptr, _IONBF, 0);
    return made;
  }
}

Error ByteFile::failure(const char* what, int code) const { return cannot(what, path_, code); }

Status ByteFile::writeAt(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failure("write", written == 0 ? ENOSPC : errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
  return {};
}

Result<std::string> ByteFile::readAt(std::uint64_t offset, std::size_t count) const {
  std::string bytes(count, '\0');
  std::size_t found = 0;
  while (found < count) {
    const ssize_t read =
        pread(descriptor(), bytes.data() + found, count - found, static_cast<off_t>(offset + found));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return failure("read", errno);
    if (read == 0) break;
    found += static_cast<std::size_t>(read);
  }
  bytes.resize(found);
  return bytes;
}

Status ByteFile::truncate(std::uint64_t size) {
  while (ftruncate(descriptor(), static_cast<off_t>(size)) != 0) {
    if (errno != EINTR) return failure("shorten", errno);
  }
  return {};
}

bool ByteFile::isThere() const { return isNamed(path_, descriptor()); }

Status ByteFile::rename(const fs::path& name) {
  if (Status can = checkReplaceable(name); !can)
    return Error{fmt::format("{}; what was written is kept as {}", can.error().message, path_.string()),
                 Fault::output};
  std::error_code code;
  if (isThere()) fs::rename(path_, name, code);
  if (code || !isNamed(name, descriptor())) {
    const std::string why = code ? code.message() + "; what was written is kept under the first name"
                                 : "it is no longer there; somebody removed or moved it";
    return Error{fmt::format("cannot name {} as {}: {}", path_.string(), name.string(), why), Fault::output};
  }
  path_ = name;
  return {};
}

Status ByteFile::sync() {
  while (fdatasync(descriptor()) != 0) {
    if (errno != EINTR) return failure("write", errno);
  }
  return {};
}

// Renamed while it is open and locked, so that no other process takes it for an unfinished one in between;
// and once all of it is on the disk, so that what has the name is whole.
Status ByteFile::closeAs(const fs::path& finished) {
  if (Status synced = sync(); !synced) return synced;
  if (Status renamed = rename(finished); !renamed) return renamed;
  if (std::fclose(file_.release()) != 0) return failure("finish writing", errno);
  return {};
}

Result<ByteFile> createPartial(const fs::path& path) {
  if (Status can = checkReplaceable(path); !can) return can.error();
  return ByteFile::create(path.string() + ".partial");
}

Result<ByteFile> openPartial(const fs::path& path) {
  const fs::path partial = path.string() + ".partial";
  std::error_code code;
  return ByteFile::open(!fs::exists(partial, code) && fs::exists(path, code) ? path : partial);
}

}  // namespace ringlet
