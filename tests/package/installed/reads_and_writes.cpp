// Files by every library that ringlet::io is linked with: TOML, glTF, PNG, zlib and zstd.
#include <cstdio>
#include <string>

#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/motion/gltf_file.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/output/picture.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/version.h"

namespace {

ringlet::Error wrong(const char* what) { return ringlet::Error{what}; }

ringlet::Status readAndWrite() {
  const auto curl = ringlet::makeCurl();
  if (!curl) return curl.error();
  if (auto status = ringlet::writeGroom("curl.hair", *curl); !status) return status;
  const auto groom = ringlet::readGroom("curl.hair");
  if (!groom) return groom.error();
  if (groom->groom.points != curl->points) return wrong("curl.hair came back changed");

  const auto material = ringlet::parseMaterial("preset = \"loose_curl\"\n", "text");
  if (!material) return material.error();

  auto writer = ringlet::CacheWriter::create("curl.rgc", groom->groom, {});
  if (!writer) return writer.error();
  if (auto status = writer->addFrame(groom->groom.points); !status) return status;
  if (auto status = writer->finish(); !status) return status;
  auto reader = ringlet::CacheReader::open("curl.rgc");
  if (!reader) return reader.error();
  if (reader->frameCount() != 1) return wrong("curl.rgc holds another number of frames than 1");

  const std::string gltf = R"({"asset": {"version": "2.0"}, "nodes": [{"name": "Head"}]})";
  const auto file = ringlet::parseGltf(std::as_bytes(std::span(gltf)), ".");
  if (!file) return file.error();
  return ringlet::Picture(4, 4, {255, 128, 0}).writePng("four.png");
}

}  // namespace

int main() {
  const auto status = readAndWrite();
  std::puts(status ? "ringlet " RINGLET_VERSION " reads and writes" : status.error().message.c_str());
  return status ? 0 : 1;
}
