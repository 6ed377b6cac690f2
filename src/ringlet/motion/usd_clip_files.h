// UsdClipFiles: where the value clips of a USD layer are read from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

class UsdClipFiles {
 public:
  virtual ~UsdClipFiles() = default;

  /// An Error where a clip of this name may not be read.
  virtual Status check(const std::string& name) const = 0;
  /// How messages call the file that the layer names.
  virtual std::string pathOf(const std::string& name) const = 0;
  /// Whether it is there. Of this and the following the name is one that check() lets through.
  virtual bool has(const std::string& name) const = 0;
  /// All its bytes. An Error, which names it, where it cannot be read.
  virtual Result<std::vector<std::byte>> read(const std::string& name) const = 0;
};

/// Those in the folder of the layer and below it ("": the current one), and no others.
class UsdClipFolder final : public UsdClipFiles {
 public:
  explicit UsdClipFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Status check(const std::string& name) const override;
  std::string pathOf(const std::string& name) const override;
  bool has(const std::string& name) const override;
  Result<std::vector<std::byte>> read(const std::string& name) const override;

 private:
  std::filesystem::path folder_;
};

/// The clips that a USD file names, whether they are there or not. None where it cannot be read or has none,
/// which its reader says. Reads the file, and no clip.
std::vector<std::filesystem::path> usdClipFilesOf(const std::filesystem::path& path);

}  // namespace ringlet
