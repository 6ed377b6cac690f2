// Implements output/checkpoint_file.h.
#include "ringlet/output/checkpoint_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "ringlet/base/archive.h"
#include "ringlet/base/checksum.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

// No text, as a cache's magic (cache_format.h).
constexpr std::string_view kMagic = "\x89RGK\r\n\x1a\n";
constexpr std::uint64_t kVersion = 5;
constexpr std::size_t kHeaderBytes = 32;
constexpr std::size_t kMostDifferences = 4;  // told of

void archiveAll(Archive& archive, Checkpoint& checkpoint) {
  std::uint64_t count = checkpoint.facts.size();
  archive.value(count);
  if (archive.isReading()) checkpoint.facts.clear();
  for (std::uint64_t k = 0; k < count && !archive.isShort(); ++k) {
    if (archive.isReading()) checkpoint.facts.emplace_back();
    archive.text(checkpoint.facts[k].name);
    archive.text(checkpoint.facts[k].value);
  }
  archive.value(checkpoint.everyFrames);
  archive.value(checkpoint.frame);
  archive.list(checkpoint.computed);
  archive.list(checkpoint.written);
}

Error refused(const std::filesystem::path& path, std::string_view why) {
  return {fmt::format("{}: {}; the run can only begin anew, with --overwrite", path.string(), why),
          Fault::input};
}

// Of `name` in the list, or nothing.
const RunFact* find(const std::vector<RunFact>& facts, const std::string& name) {
  const auto at = std::ranges::find(facts, name, &RunFact::name);
  return at == facts.end() ? nullptr : &*at;
}

}  // namespace

Status writeCheckpoint(const std::filesystem::path& path, Checkpoint checkpoint) {
  Archive archive = Archive::writing();
  archive.room(kHeaderBytes);  // filled in below
  archiveAll(archive, checkpoint);
  std::vector<std::byte> file = archive.take();
  const std::span<const std::byte> content = std::span(file).subspan(kHeaderBytes);
  std::vector<std::byte> header;
  for (const char c : kMagic) header.push_back(static_cast<std::byte>(c));
  appendU64(header, kVersion);
  appendU64(header, checksum64(content));
  appendU64(header, content.size());
  std::ranges::copy(header, file.begin());
  return writeWholeFile(path, file);
}

Result<Checkpoint> readCheckpoint(const std::filesystem::path& path) {
  const auto file = readWholeFile(path);
  if (!file) return file.error();
  const std::span<const std::byte> bytes(*file);
  const bool isOurs =
      bytes.size() >= kHeaderBytes && std::ranges::equal(bytes.first(kMagic.size()), kMagic, {}, {},
                                                         [](char c) { return static_cast<std::byte>(c); });
  if (!isOurs) return refused(path, "is no checkpoint of Ringlet");
  if (const std::uint64_t version = readU64(bytes, 8); version != kVersion)
    return refused(
        path, fmt::format("is a checkpoint of version {}, and this program reads {}", version, kVersion));
  const auto content = bytes.subspan(kHeaderBytes);
  if (readU64(bytes, 24) != content.size() || readU64(bytes, 16) != checksum64(content))
    return refused(path, "is damaged");
  Checkpoint checkpoint;
  Archive archive = Archive::reading(content);
  archiveAll(archive, checkpoint);
  if (!archive.isWhole() || checkpoint.frame < 0) return refused(path, "is damaged");
  return checkpoint;
}

std::string differencesOf(const std::vector<RunFact>& now, const std::vector<RunFact>& before) {
  std::vector<std::string> differences;
  for (const RunFact& fact : now) {
    const RunFact* was = find(before, fact.name);
    if (!was) differences.push_back(fmt::format("{} is {} and was not given", fact.name, fact.value));
    if (was && was->value != fact.value)
      differences.push_back(fmt::format("{} is {} and was {}", fact.name, fact.value, was->value));
  }
  for (const RunFact& fact : before) {
    if (!find(now, fact.name))
      differences.push_back(fmt::format("{} is not given and was {}", fact.name, fact.value));
  }
  const std::size_t told = std::min(differences.size(), kMostDifferences);
  std::string text = fmt::format("{}", fmt::join(std::span(differences).first(told), "; "));
  if (told < differences.size()) text += fmt::format("; and {} more", differences.size() - told);
  return text;
}

}  // namespace ringlet
