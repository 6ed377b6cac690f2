// Implements solver/checkpoint_guard.h.
#include "ringlet/solver/checkpoint_guard.h"

#include <fmt/format.h>

#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/checksum.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scene/settings_fields.h"
#include "ringlet/solver/hair_asset_implementation.h"
#include "ringlet/version.h"

namespace ringlet {
namespace {

constexpr std::string_view kMagic = "RGLHAIR1";
constexpr std::size_t kHashed = 16;  // the checksum covers the bytes from here on

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

// Settings contain none of the types that this function does not handle.
template <class T>
void add(Archive& facts, T value) {
  if constexpr (IsOptional<T>::value) {
    add(facts, value.has_value());
    if (value) add(facts, *value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    facts.text(value);
  } else if constexpr (std::is_trivially_copyable_v<T>) {
    facts.value(value);
  }
}

template <class Fields, class Owner>
void addFields(Archive& facts, const Fields& fields, const Owner& owner) {
  for (const auto& field : fields) std::visit([&](auto member) { add(facts, owner.*member); }, field.member);
}

void addSettings(Archive& facts, const Settings& settings) {
  add(facts, static_cast<int>(settings.integrator));
  addFields(facts, settingsFields(), settings);
  addFields(facts, contactFields(), settings.contacts);
  addFields(facts, airFields(), settings.air);
  addFields(facts, goalFields(), settings.goal);
}

// The strands' own factors are left out: the rest state, which is hashed too, contains their effect.
void addMaterial(Archive& facts, const Material& material) {
  addFields(facts, materialParameters(), material);
  addFields(facts, variationParameters(), material.variation);
  for (const ProfileParameter& parameter : profileParameters()) {
    std::vector<Profile::Point> points = (material.*parameter.member).points;
    facts.list(points);
  }
}

template <class T>
std::uint64_t checksumOf(const std::vector<T>& list) {
  return checksum64(std::as_bytes(std::span(list)));
}

std::uint64_t wordAt(std::span<const std::byte> bytes, std::size_t at) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

Error refused(const char* why) { return {why, Fault::input}; }

}  // namespace

std::uint64_t HairAsset::Implementation::fingerprint() const {
  Archive facts = Archive::writing();
  add(facts, std::string(RINGLET_VERSION));
  add(facts, device.name());
  add(facts, device.driver());
  addSettings(facts, settings);
  addMaterial(facts, material);
  add(facts, choice.link != nullptr);
  for (const std::uint64_t fact : {checksumOf(rest.strands), checksumOf(rest.points),
                                   checksumOf(rest.strandInGroom), std::uint64_t{rest.groomParticleCount}})
    add(facts, fact);
  for (const RigidStrand& strand : rest.rigid) add(facts, checksumOf(strand.points));
  return checksumOf(facts.take());
}

void guardCheckpoint(std::span<std::byte> checkpoint, const CheckpointOwner& owner) {
  const auto put = [&](std::size_t at, std::uint64_t word) {
    std::memcpy(checkpoint.data() + at, &word, sizeof word);
  };
  std::memcpy(checkpoint.data(), kMagic.data(), kMagic.size());
  put(16, owner.hair), put(24, owner.cuts), put(32, owner.bodies);
  put(8, checksum64(checkpoint.subspan(kHashed)));
}

Result<std::span<const std::byte>> stateOfCheckpoint(std::span<const std::byte> checkpoint,
                                                     const CheckpointOwner& owner) {
  const bool isWhole = checkpoint.size() >= kCheckpointGuardBytes &&
                       std::memcmp(checkpoint.data(), kMagic.data(), kMagic.size()) == 0 &&
                       wordAt(checkpoint, 8) == checksum64(checkpoint.subspan(kHashed));
  if (!isWhole)
    return Error{
        fmt::format(
            "these {} bytes are no checkpoint of hair, or a damaged one: hand over what was given as a "
            "checkpoint, whole",
            checkpoint.size()),
        Fault::input};
  if (wordAt(checkpoint, 16) != owner.hair)
    return refused(
        "the checkpoint is of other hair: it takes the groom, material, settings, device and version of "
        "Ringlet that it was made with");
  if (wordAt(checkpoint, 24) != owner.cuts)
    return refused(
        "the checkpoint is of hair that was cut otherwise: make the same cuts before it is restored");
  if (wordAt(checkpoint, 32) != owner.bodies)
    return refused("the checkpoint is of hair with another number of bodies: set them before it is restored");
  return checkpoint.subspan(kCheckpointGuardBytes);
}

}  // namespace ringlet
