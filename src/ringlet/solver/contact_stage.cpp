// Implements solver/contact_stage.h.
#include "ringlet/solver/contact_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "ringlet/rest/material.h"
#include "ringlet/solver/contact_kernels.h"

namespace ringlet {
namespace {

using gpu::Buffer;
using gpu::BufferKind;

constexpr std::uint32_t kGroupSize = 64;
constexpr std::uint32_t kBlock = 1024;  // buckets summed together, as in contact_buffers.glsl
constexpr std::uint64_t kMostTexelBytes = 2ull << 30;
constexpr std::uint32_t kFirstStride = 16;  // room in a list to begin with
constexpr double kSkinShare = 0.15;         // of R: what may come closer before lists are made anew

// What a share of a contact changes by in a step.
float changeIn(double seconds, double stepSeconds) {
  return seconds > 0 ? static_cast<float>(stepSeconds / seconds) : 1.0f;
}

Result<Buffer> createFrom(gpu::Device& device, std::span<const std::byte> bytes, const std::string& name) {
  auto buffer = Buffer::create(device, bytes.size(), BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->upload(bytes); !status) return status.error();
  return buffer;
}

Result<Buffer> createZero(gpu::Device& device, std::uint64_t bytes, const std::string& name) {
  auto buffer = Buffer::create(device, bytes, BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->fillZero(); !status) return status.error();
  return buffer;
}

std::vector<layout::ContactRest> contactRests(const RestState& rest, const Settings& settings,
                                              const ContactParticles& particles) {
  std::vector<layout::ContactRest> rests;
  for (std::size_t c = 0; c < particles.particles.size(); ++c) {
    const std::uint32_t particle = particles.particles[c], strand = particles.strands[c];
    const layout::StrandRest& s = rest.strands[strand];
    const bool isPinned = particle - s.firstParticle < static_cast<std::uint32_t>(settings.rootCount);
    const Vec3f p = rest.points[particle];
    rests.push_back({.point = {p.x, p.y, p.z, particles.radii[strand]},
                     .particle = particle,
                     .strand = strand,
                     .mass = particles.masses[strand],
                     .inverseMassUnit = isPinned ? 0.0f : 1 / s.firstEdge.w});
  }
  return rests;
}

std::vector<std::uint32_t> neighbourTable(const ContactGraph& graph) {
  std::vector<std::uint32_t> table = graph.firstNeighbour;
  table.insert(table.end(), graph.neighbours.begin(), graph.neighbours.end());
  return table;
}

}  // namespace

Result<ContactStage> ContactStage::create(gpu::Device& device, const RestState& rest,
                                          const Settings& settings, const ContactParticles& particles,
                                          const ContactGraph& graph, const DeviceGroom& groom) {
  ContactStage self;
  self.device_ = &device;
  self.settings_ = settings.contacts;
  self.stepSeconds_ = settings.stepSeconds();
  self.particles_ = particles.particles;
  self.strandCount_ = static_cast<std::uint32_t>(rest.strands.size());
  self.everyPair_ = graph.everyPair;
  self.largestRadius_ = *std::max_element(particles.radii.begin(), particles.radii.end());
  const std::uint64_t count = self.particles_.size();
  if (self.contactGroups() > device.properties().maxGroupCount) {
    return Error{fmt::format(
        "{} contact particles are more than the {} this device takes at once; use a larger radius "
        "or spacing",
        count, std::uint64_t{device.properties().maxGroupCount} * kGroupSize)};
  }
  self.bucketCount_ = static_cast<std::uint32_t>(std::bit_ceil(std::max<std::uint64_t>(2 * count, kBlock)));
  // The lists are the longest; they never exceed maxStorageBufferRange.
  const bool texels = device.properties().maxTexelRecords * sizeof(layout::vec4) >=
                      std::min(device.properties().maxStorageBufferRange, kMostTexelBytes);
  for (std::size_t k = 0; k < kContactKernelCount; ++k) {
    auto kernel = createContactKernel(device, static_cast<ContactKernel>(k), kGroupSize, texels);
    if (!kernel) return kernel.error();
    self.kernels_.push_back(std::move(*kernel));
  }

  const auto rests = contactRests(rest, settings, particles);
  const auto table = neighbourTable(graph);
  auto contacts = createFrom(device, std::as_bytes(std::span(rests)), "contacts");
  if (!contacts) return contacts.error();
  auto neighbours = createFrom(device, std::as_bytes(std::span(table)), "neighbours");
  if (!neighbours) return neighbours.error();
  const std::uint64_t gridWords = 2 * self.bucketCount_ + 1 + self.bucketCount_ / kBlock + 1 + 3 * count;
  auto grid = createZero(device, gridWords * sizeof(std::uint32_t), "contact grid");
  if (!grid) return grid.error();
  auto places = createZero(device, count * sizeof(layout::ContactPlace), "contact places");
  if (!places) return places.error();
  self.constant_.push_back(std::move(*contacts));
  self.constant_.push_back(std::move(*neighbours));
  self.working_.push_back(std::move(*grid));
  self.working_.push_back(std::move(*places));

  self.stride_ = kFirstStride;
  if (Status status = self.createLists(device); !status) return status.error();
  if (Status status = self.bindAll(groom); !status) return status.error();
  self.control() = {};
  return self;
}

std::uint32_t ContactStage::contactGroups() const {
  return static_cast<std::uint32_t>((particles_.size() + kGroupSize - 1) / kGroupSize);
}

layout::ContactControl& ContactStage::control() const {
  return *reinterpret_cast<layout::ContactControl*>(control_->mapped().data());
}

// The longest lists the device has room for.
std::uint32_t ContactStage::mostStride() const {
  return static_cast<std::uint32_t>(device_->properties().maxStorageBufferRange /
                                    (particles_.size() * sizeof(layout::ContactPair))) &
         ~1u;  // even: two lives are a texel
}

// Counts, pairs, lives, normals: for `stride_` pairs a contact particle; two rows of counts and lives.
Status ContactStage::createLists(gpu::Device& device) {
  const std::uint64_t rows = 2 * particles_.size(), entries = particles_.size() * stride_;
  lists_.clear();
  const std::uint64_t largest = entries * sizeof(layout::ContactPair);
  if (largest > device.properties().maxStorageBufferRange) {
    return Error{fmt::format(
        "lists of up to {} contacts for each of {} contact particles need a buffer of {} MiB, and "
        "this device's are {} MiB at most; use a smaller contact radius, or prune more",
        stride_, particles_.size(), largest >> 20, device.properties().maxStorageBufferRange >> 20)};
  }
  const std::pair<const char*, std::uint64_t> buffers[] = {
      {"contact counts", rows * sizeof(std::uint32_t)},
      {"contact pairs", largest},
      {"contact lives", 2 * entries * sizeof(layout::ContactLife)},
      {"contact normals", entries * sizeof(layout::vec4)},
  };
  for (const auto& [name, bytes] : buffers) {
    auto buffer = createZero(device, bytes, name);
    if (!buffer) return buffer.error();
    lists_.push_back(std::move(*buffer));
  }
  return {};
}

Status ContactStage::bindAll(const DeviceGroom& groom) {
  control_ = &groom.contactControl;
  bindings_.clear();
  auto bindings = gpu::Bindings::create(
      kernels_[0],
      {groom.positions, groom.solved, constant_[0], constant_[1], working_[0], working_[1], lists_[0],
       lists_[1], lists_[2], lists_[3], groom.contactSystems, groom.contactControl, groom.positions,
       groom.solved, constant_[0], working_[1], lists_[1], lists_[2], lists_[3]});
  if (!bindings) return bindings.error();
  bindings_.push_back(std::move(*bindings));
  return {};
}

layout::ContactParameters ContactStage::parameters(std::uint32_t step) const {
  return {.contactCount = static_cast<std::uint32_t>(particles_.size()),
          .bucketCount = bucketCount_,
          .stride = stride_,
          .strandCount = strandCount_,
          .everyPair = everyPair_ ? 1u : 0u,
          .step = step,
          .seconds = static_cast<float>(stepSeconds_),
          .skin = static_cast<float>(kSkinShare * 2 * largestRadius_),
          .largestRadius = largestRadius_,
          .stiffness = static_cast<float>(settings_.stiffness * kStandardGravity),
          .dampingRatio = static_cast<float>(settings_.dampingRatio),
          .friction = static_cast<float>(settings_.friction),
          .ramp = changeIn(settings_.rampSeconds, stepSeconds_),
          .stiffnessRelease = changeIn(settings_.stiffnessReleaseSeconds, stepSeconds_),
          .dampingRelease = changeIn(settings_.dampingReleaseSeconds, stepSeconds_),
          .breakFactor = static_cast<float>(settings_.breakFactor),
          .seenAhead = static_cast<float>(kContactSeenAhead)};
}

void ContactStage::dispatch(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                            std::uint32_t groupCount) const {
  recorder.dispatch(kernels_[static_cast<std::size_t>(kernel)], bindings_[0], parameters(step), groupCount);
}
void ContactStage::dispatchIndirect(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                                    std::uint64_t offset) const {
  recorder.dispatchIndirect(kernels_[static_cast<std::size_t>(kernel)], bindings_[0], parameters(step),
                            *control_, offset);
}

void ContactStage::recordLists(gpu::Recorder& recorder, std::uint32_t step) const {
  constexpr std::uint64_t perContact = offsetof(layout::ContactControl, indirectContacts),
                          perBlock = offsetof(layout::ContactControl, indirectBuckets),
                          one = offsetof(layout::ContactControl, indirectOne);
  recorder.beginStage("contact_motion");
  dispatch(recorder, ContactKernel::motion, step, contactGroups());
  recorder.barrier();
  dispatch(recorder, ContactKernel::decide, step, 1);
  recorder.barrier();
  recorder.endStage();

  recorder.beginStage("contact_grid");
  using enum ContactKernel;
  const std::pair<ContactKernel, std::uint64_t> grid[] = {
      {count, perContact}, {scan, perBlock}, {sum, one}, {scatter, perContact}, {order, perContact}};
  for (const auto& [kernel, offset] : grid) {
    dispatchIndirect(recorder, kernel, step, offset);
    recorder.barrier();
  }
  recorder.endStage();

  recorder.beginStage("contact_query");
  dispatchIndirect(recorder, ContactKernel::query, step, perContact);
  recorder.endStage();
}

void ContactStage::recordLife(gpu::Recorder& recorder) const {
  recorder.beginStage("contact_life");
  dispatch(recorder, ContactKernel::life, 0, contactGroups());
  recorder.endStage();
}

void ContactStage::recordGather(gpu::Recorder& recorder) const {
  recorder.beginStage("contact_gather");
  dispatch(recorder, ContactKernel::gather, 0, contactGroups());
  recorder.endStage();
}

// The lives of the row in use before the lists were made that did not fit go to their places in longer ones;
// the pairs are found anew.
Status ContactStage::makeRoom(const DeviceGroom& groom) {
  const std::uint32_t before = stride_, row = control().parity ^ 1;
  const std::size_t count = particles_.size();
  auto counts = downloadAll<std::uint32_t>(lists_[0], 2 * count);
  if (!counts) return counts.error();
  auto lives = downloadAll<layout::ContactLife>(lists_[2], 2 * count * before);
  if (!lives) return lives.error();

  stride_ = (before + std::max(before / 4, 8u)) & ~1u;
  if (before < mostStride()) stride_ = std::min(stride_, mostStride());
  if (Status status = createLists(*device_); !status) return status;
  std::vector<layout::ContactLife> longer(2 * count * stride_);
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t from = (2 * c + row) * before, to = (2 * c + row) * stride_;
    std::copy_n(lives->begin() + static_cast<std::ptrdiff_t>(from), (*counts)[2 * c + row],
                longer.begin() + static_cast<std::ptrdiff_t>(to));
  }
  if (Status status = lists_[0].upload(std::as_bytes(std::span(*counts))); !status) return status;
  if (Status status = lists_[2].upload(std::as_bytes(std::span(longer))); !status) return status;

  layout::ContactControl& c = control();
  c.parity = row;
  c.isHalted = c.isListed = c.longestList = c.listed = 0;
  --c.rebuilds;
  return bindAll(groom);
}

std::uint64_t ContactStage::takePairTests() {
  const std::uint64_t tests = control().pairTests;
  control().pairTests = 0;
  return tests;
}

Status ContactStage::forget() {
  control().isListed = 0;
  return lists_[0].fillZero();
}

Result<std::vector<ListedContact>> ContactStage::listed(const RestState& rest) const {
  const std::size_t count = particles_.size();
  auto counts = downloadAll<std::uint32_t>(lists_[0], 2 * count);
  if (!counts) return counts.error();
  auto lives = downloadAll<layout::ContactLife>(lists_[2], 2 * count * stride_);
  if (!lives) return lives.error();

  std::vector<std::uint32_t> inGroom(rest.points.size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    for (std::uint32_t i = 0; i < rest.strands[s].particleCount; ++i)
      inGroom[rest.strands[s].firstParticle + i] = rest.firstInGroom[s] + i;
  }
  std::vector<ListedContact> contacts;
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t row = 2 * c + control().parity;
    for (std::uint32_t j = 0; j < (*counts)[row]; ++j) {
      const auto& [shares, particle] = (*lives)[row * stride_ + j];
      const std::uint32_t a = inGroom[particles_[c]], b = inGroom[particle];
      if (a < b) contacts.push_back({a, b, std::max(0.0f, -shares), shares < 0 ? 1.0f : shares});
    }
  }
  std::sort(contacts.begin(), contacts.end(), [](const ListedContact& x, const ListedContact& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  return contacts;
}

// J_a = momentum - 2 D v of the last iterate, in kg m/s. What a pinned particle received is not known, and
// left out.
Result<double> ContactStage::momentumError(const RestState& rest, const DeviceGroom& groom) const {
  auto systems = downloadAll<layout::ContactSystem>(groom.contactSystems, rest.points.size());
  if (!systems) return systems.error();
  auto solved = downloadAll<layout::vec4>(groom.solved, rest.points.size());
  if (!solved) return solved.error();
  Vec3d sum{};
  double sizes = 0;
  for (const layout::StrandRest& strand : rest.strands) {
    for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i) {
      const auto& [d, o, push, m] = (*systems)[i];
      const layout::vec4 v = (*solved)[i];
      const Vec3d Dv{double(d.x) * v.x + double(o.z) * v.y + double(o.y) * v.z,
                     double(o.z) * v.x + double(d.y) * v.y + double(o.x) * v.z,
                     double(o.y) * v.x + double(o.x) * v.y + double(d.z) * v.z};
      const Vec3d J = (Vec3d{m.x, m.y, m.z} - Dv * 2.0) * double(strand.firstEdge.w);
      sum = sum + J;
      sizes += length(J);
    }
  }
  return sizes > 0 ? length(sum) / sizes : 0;
}

}  // namespace ringlet
