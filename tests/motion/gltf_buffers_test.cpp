// motion/gltf_buffers.h, and what readGltf makes of it: a file reads the buffers of its own folder and below
// it, and nothing else, however it names them.
#include "ringlet/motion/gltf_buffers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ringlet/motion/gltf_file.h"
#include "tests/motion/gltf_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::gltf_buffers_test {
namespace {

namespace fs = std::filesystem;

// folder/in/m.gltf; folder/secret.bin, which would be its buffer.
class GltfBuffers : public testing::Test {
 protected:
  void SetUp() override {
    const int head = file_.node({{"name", "Head"}});
    file_.channel(0, head, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 2, 3});
    fs::create_directories(in_ / "sub");
    write(folder_ / "secret.bin");
  }
  void write(const fs::path& path) const { std::ofstream(path, std::ios::binary) << file_.bytes(); }
  Result<GltfFile> read(const std::string& uri) const {
    std::ofstream(in_ / "m.gltf") << file_.textBeside(uri);
    return readGltf(in_ / "m.gltf");
  }

  const fs::path folder_ = scratchFolder("gltf_buffers"), in_ = folder_ / "in";
  GltfBuilder file_;
};

TEST_F(GltfBuffers, OwnFolderAndBelowAreRead) {
  write(in_ / "way.bin");
  write(in_ / "sub/way.bin");
  write(in_ / "a way.bin");
  write(in_ / "a:way.bin");
  fs::create_symlink("way.bin", in_ / "link.bin");
  fs::create_symlink(in_ / "sub", in_ / "linked");
  for (const char* uri : {"way.bin", "./way.bin", "sub/way.bin", "sub/../way.bin", "sub/%2e%2e/way.bin",
                          "a%20way.bin", "link.bin", "linked/way.bin", "./a:way.bin"}) {
    const auto file = read(uri);
    EXPECT_TRUE(file) << uri << ": " << file.error().message;
    const auto files = gltfBufferFiles(in_ / "m.gltf");
    ASSERT_EQ(files.size(), 1u) << uri;
    EXPECT_EQ(fs::file_size(files[0]), file_.bytes().size());
  }
  // The folder itself may be a link.
  fs::create_directory_symlink("in", folder_ / "other");
  EXPECT_TRUE(readGltf(folder_ / "other/m.gltf"));
}

TEST_F(GltfBuffers, NothingElseIsRead) {
  fs::create_symlink("../secret.bin", in_ / "link.bin");
  fs::create_symlink("..", in_ / "up");
  fs::create_symlink(folder_ / "secret.bin", in_ / "sub/absolute.bin");
  const std::string absolute = (folder_ / "secret.bin").string();
  std::string encoded;
  for (const char c : absolute) encoded += c == '/' ? "%2F" : std::string(1, c);
  const std::pair<std::string, const char*> uris[] = {
      {"../secret.bin", "leads out of the folder"},
      {"../../gltf_buffers/secret.bin", "leads out of the folder"},
      {"sub/../../secret.bin", "leads out of the folder"},
      {"./../secret.bin", "leads out of the folder"},
      {"%2e%2e/secret.bin", "leads out of the folder"},
      {"%2E%2E%2Fsecret.bin", "leads out of the folder"},
      {"..%2fsecret.bin", "leads out of the folder"},
      {absolute, "is absolute"},
      {encoded, "is absolute"},
      {"//host" + absolute, "is absolute"},
      {"file://" + absolute, "is an address"},
      {"http://host/secret.bin", "is an address"},
      {"C:/secret.bin", "is an address"},
      {"..\\secret.bin", "has a backslash"},
      {"%2e%2e%5csecret.bin", "has a backslash"},
      {"C:\\secret.bin", "has a backslash"},
      {"link.bin%00", "holds a NUL"},
      {"link.bin", "by a symbolic link"},
      {"up/secret.bin", "by a symbolic link"},
      {"sub/absolute.bin", "by a symbolic link"},
  };
  for (const auto& [uri, why] : uris) {
    const auto file = read(uri);
    ASSERT_FALSE(file) << uri;
    EXPECT_NE(file.error().message.find(why), std::string::npos) << uri << ": " << file.error().message;
    EXPECT_NE(file.error().message.find("from the folder of the glTF file and below it"), std::string::npos)
        << uri << ": " << file.error().message;
    EXPECT_EQ(file.error().message.find(fmt::format("{} bytes", file_.bytes().size())), std::string::npos);
    EXPECT_TRUE(gltfBufferFiles(in_ / "m.gltf").empty()) << uri;
  }
}

// As a name is typed in the folder itself, in which a path has no folder.
TEST_F(GltfBuffers, TheCurrentFolderIsAFolderToo) {
  const std::string absolute = (folder_ / "secret.bin").string();
  for (const std::string& uri : {absolute, std::string("../secret.bin")}) {
    const auto file = parseGltf(bytesOf(file_.textBeside(uri)), "");
    ASSERT_FALSE(file) << uri;
    EXPECT_NE(file.error().message.find("and from nowhere else"), std::string::npos) << file.error().message;
  }
}

// Sizes are compared before a byte is read: this file would not fit into memory, nor be read in a second.
TEST_F(GltfBuffers, SizesAreAskedFirst) {
  std::ofstream(in_ / "way.bin").put('x');
  fs::resize_file(in_ / "way.bin", std::uintmax_t{1} << 35);
  const auto large = read("way.bin");
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("has 34359738368 bytes, where byteLength is"), std::string::npos)
      << large.error().message;
  fs::resize_file(in_ / "way.bin", 1);
  EXPECT_FALSE(read("way.bin"));
  const auto missing = read("none.bin");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().fault, Fault::input);
  EXPECT_NE(missing.error().message.find("none.bin is not there"), std::string::npos)
      << missing.error().message;
  const auto folder = read("sub");
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().message.find("not a regular file"), std::string::npos) << folder.error().message;
}

}  // namespace
}  // namespace ringlet::test::gltf_buffers_test
