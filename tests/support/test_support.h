// What tests of all folders need: where the real data is, and how to skip loudly.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace ringlet::test {

/// The path of a file of the shared real data ($RINGLET_DATA, else ../shared/data beside the checkout), if it
/// is there.
std::optional<std::filesystem::path> dataFile(const std::string& relative);

/// A fresh empty folder for this test, below the system's temporary one.
std::filesystem::path scratchFolder(const std::string& name);

}  // namespace ringlet::test

// Skips the test, saying which file was missing. Use as the first line: RINGLET_NEEDS_DATA(path,
// "hair/straight.hair").
#define RINGLET_NEEDS_DATA(variable, relative)                                                             \
  const auto variable##Found = ::ringlet::test::dataFile(relative);                                        \
  if (!variable##Found)                                                                                    \
    GTEST_SKIP() << "SKIPPED: real data not found: " << (relative) << " (set RINGLET_DATA to its folder)"; \
  const std::filesystem::path& variable = *variable##Found
