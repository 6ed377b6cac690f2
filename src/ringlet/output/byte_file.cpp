// Implements output/byte_file.h.
#include "ringlet/output/byte_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace ringlet {
namespace {

Error failure(const char* what, const std::filesystem::path& path, int code) {
  const char* advice = "";
  if (code == ENOSPC || code == EDQUOT) advice = "; free some space or choose another folder";
  if (code == EACCES || code == EPERM || code == EROFS) advice = "; choose a folder you may write to";
  return Error{
      fmt::format("cannot {} {}: {}{}", what, path.string(), std::generic_category().message(code), advice)};
}

}  // namespace

Result<OpenFile> openToRead(const std::filesystem::path& path) {
  errno = 0;
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return Error{fmt::format("cannot read {}: it is a folder", path.string())};
  OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file)
    return Error{fmt::format("cannot read {}: {}", path.string(), std::generic_category().message(errno))};
  return file;
}

Result<ByteFile> ByteFile::create(const std::filesystem::path& path) {
  ByteFile made;
  made.path_ = path;
  made.file_.reset(std::fopen(path.c_str(), "wb"));
  if (!made.file_) return failure("create", path, errno);
  std::setvbuf(made.file_.get(), nullptr, _IONBF, 0);
  return made;
}

Status ByteFile::writeAt(std::uint64_t offset, std::string_view bytes) {
  errno = 0;
  if (fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    int code = errno;
    std::clearerr(file_.get());
    return failure("write", path_, code);
  }
  return {};
}

Status ByteFile::truncate(std::uint64_t size) {
  std::error_code code;
  std::filesystem::resize_file(path_, size, code);
  if (code) return failure("shorten", path_, code.value());
  return {};
}

Status ByteFile::close() {
  errno = 0;
  if (std::fclose(file_.release()) != 0) return failure("finish writing", path_, errno);
  return {};
}

Status ByteFile::closeAs(const std::filesystem::path& finished) {
  if (Status closed = close(); !closed) return closed;
  std::error_code code;
  std::filesystem::rename(path_, finished, code);
  if (code) {
    return Error{fmt::format("cannot name {} as {}: {}; all frames are kept under the first name",
                             path_.string(), finished.string(), code.message())};
  }
  return {};
}

}  // namespace ringlet
