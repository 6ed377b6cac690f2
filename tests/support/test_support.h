// What tests of all folders need: where the real data is, how to skip loudly, how far states are apart.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "ringlet/base/vec3.h"

namespace ringlet::test {

/// The path of a file of the shared real data ($RINGLET_DATA, else ../shared/data beside the checkout), if it
/// is there.
std::optional<std::filesystem::path> dataFile(const std::string& relative);

/// A fresh empty folder for this test, below the system's temporary one.
std::filesystem::path scratchFolder(const std::string& name);

/// All bytes of a file; none where it cannot be read.
std::string readText(const std::filesystem::path& path);

/// The largest distance of two that stand in the same place of a and b; not a number where one is none.
double farthestApart(std::span<const Vec3f> a, std::span<const Vec3f> b);

}  // namespace ringlet::test

// Skips the test, saying which file was missing. Use as the first line: RINGLET_NEEDS_DATA(path,
// "hair/straight.hair").
#define RINGLET_NEEDS_DATA(variable, relative)                                                             \
  const auto variable##Found = ::ringlet::test::dataFile(relative);                                        \
  if (!variable##Found)                                                                                    \
    GTEST_SKIP() << "SKIPPED: real data not found: " << (relative) << " (set RINGLET_DATA to its folder)"; \
  const std::filesystem::path& variable = *variable##Found
