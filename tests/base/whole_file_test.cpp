// Files that are replaced at once: never a folder, a device or a pipe, by whatever name.
#include "ringlet/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "tests/support/test_support.h"

namespace ringlet::test::whole_file_test {
namespace {

namespace fs = std::filesystem;

constexpr std::byte kBytes[] = {std::byte{7}};

TEST(WholeFile, WhatIsNoFileIsNotReplaced) {
  const fs::path folder = scratchFolder("whole_file");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0644), 0);
  fs::create_directory(folder / "folder");
  fs::create_symlink("pipe", folder / "to_pipe");
  fs::create_symlink("/dev/full", folder / "to_device");
  fs::create_symlink("folder", folder / "to_folder");
  for (const char* name : {"pipe", "folder", "to_pipe", "to_device", "to_folder"}) {
    const fs::file_status before = fs::symlink_status(folder / name);
    for (const Status& status : {checkReplaceable(folder / name), writeWholeFile(folder / name, kBytes)}) {
      ASSERT_FALSE(status) << name;
      EXPECT_EQ(status.error().fault, Fault::output) << name;
      EXPECT_NE(status.error().message.find((folder / name).string()), std::string::npos)
          << status.error().message;
    }
    EXPECT_EQ(fs::symlink_status(folder / name).type(), before.type()) << name << " was replaced";
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 5)
      << "no temporary is left";
}

TEST(WholeFile, FilesAndNewNamesAreReplaced) {
  const fs::path folder = scratchFolder("whole_file");
  for (int times = 0; times < 2; ++times) {
    ASSERT_TRUE(checkReplaceable(folder / "file"));
    ASSERT_TRUE(writeWholeFile(folder / "file", kBytes));
  }
  const auto read = readWholeFile(folder / "file");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, std::vector<std::byte>({std::byte{7}}));
}

}  // namespace
}  // namespace ringlet::test::whole_file_test
