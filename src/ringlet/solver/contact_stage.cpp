// Implements solver/contact_stage.h.
#include "ringlet/solver/contact_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "ringlet/rest/material.h"
#include "ringlet/solver/contact_kernels.h"
#include "ringlet/solver/device_buffers.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kGroupSize = 64;
// Of a contact particle's list, to begin with.
constexpr std::uint32_t kFirstBlocks = 1, kFirstMostBlocks = 8;
constexpr double kSkinShare = 0.15;  // of R: what may come closer before lists are made anew
// Lists are read as texels where a device sees at least this much, what the smallest storage buffers hold.
constexpr std::uint64_t kLeastTexelBytes = 128ull << 20;

// What a share of a contact changes by in a step.
float changeIn(double seconds, double stepSeconds) {
  return seconds > 0 ? static_cast<float>(stepSeconds / seconds) : 1.0f;
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
                                          const Settings& settings, const RestContacts& contacts,
                                          const DeviceGroom& groom) {
  const ContactParticles& particles = contacts.particles;
  ContactStage self;
  self.device_ = &device;
  self.groom_ = &groom;
  self.settings_ = settings.contacts;
  self.stepSeconds_ = settings.stepSeconds();
  self.particles_ = particles.particles;
  self.strandCount_ = static_cast<std::uint32_t>(rest.strands.size());
  self.everyPair_ = contacts.graph.everyPair;
  self.largestRadius_ = *std::max_element(particles.radii.begin(), particles.radii.end());
  const std::uint64_t count = self.particles_.size();
  if (self.contactGroups() > device.properties().maxGroupCount) {
    return Error{fmt::format(
        "{} contact particles are more than the {} this device takes at once; use a larger radius "
        "or spacing",
        count, std::uint64_t{device.properties().maxGroupCount} * kGroupSize)};
  }
  self.bucketCount_ =
      static_cast<std::uint32_t>(std::bit_ceil(std::max<std::uint64_t>(2 * count, layout::kBucketBlock)));
  const bool texels = isSeenAsTexels(device, kLeastTexelBytes);
  self.largestList_ = device.properties().maxStorageBufferRange;
  if (texels) {
    const std::uint64_t seen = device.properties().maxTexelRecords * sizeof(layout::vec4);
    self.largestList_ = std::min(self.largestList_, seen);
  }
  for (std::size_t k = 0; k < kContactKernelCount; ++k) {
    auto kernel = createContactKernel(device, static_cast<ContactKernel>(k), kGroupSize, texels);
    if (!kernel) return kernel.error();
    self.kernels_.push_back(std::move(*kernel));
  }

  auto rests = createFilled(device, contactRests(rest, settings, particles), "contacts");
  if (!rests) return rests.error();
  auto neighbours = createFilled(device, neighbourTable(contacts.graph), "neighbours");
  if (!neighbours) return neighbours.error();
  const std::uint64_t gridWords =
      2 * self.bucketCount_ + 1 + self.bucketCount_ / layout::kBucketBlock + 1 + 3 * count;
  auto grid = createZero(device, gridWords * sizeof(std::uint32_t), "contact grid");
  if (!grid) return grid.error();
  auto places = createZero(device, count * sizeof(layout::ContactPlace), "contact places");
  if (!places) return places.error();
  auto queue = createZero(device, count * layout::kQueue * 2 * sizeof(float), "contact queue");
  if (!queue) return queue.error();
  self.buffers_.emplace(Buffers{std::move(*rests), std::move(*neighbours), std::move(*grid),
                                std::move(*places), std::move(*queue)});
  self.blockCount_ = static_cast<std::uint32_t>(kFirstBlocks * count);
  self.mostBlocks_ = kFirstMostBlocks;
  if (Status status = self.createLists(); !status) return status.error();
  self.control() = {};
  return self;
}

std::uint32_t ContactStage::contactGroups() const {
  return static_cast<std::uint32_t>((particles_.size() + kGroupSize - 1) / kGroupSize);
}

layout::ContactControl& ContactStage::control() const {
  return *reinterpret_cast<layout::ContactControl*>(groom_->contactControl.mapped().data());
}

// For `blockCount_` blocks and `mostBlocks_` of a list; and what the kernels see of them.
Status ContactStage::createLists() {
  const std::uint64_t entries = std::uint64_t{blockCount_} * layout::kListBlock;
  const auto create = [&](const char* name, std::uint64_t bytes) -> Result<gpu::Buffer> {
    if (bytes <= largestList_) return createZero(*device_, bytes, name);
    return Error{fmt::format(
        "the lists of {} contact particles, {} pairs in all and up to {} for one, need a buffer "
        "of {} MiB, and this device's are {} MiB at most; use a smaller contact radius, or prune more",
        particles_.size(), entries, mostBlocks_ * layout::kListBlock, bytes >> 20, largestList_ >> 20)};
  };
  lists_.reset();
  auto heads = create("contact lists", 2 * particles_.size() * (1 + mostBlocks_) * sizeof(std::uint32_t));
  if (!heads) return heads.error();
  auto pairs = create("contact pairs", entries * sizeof(layout::ContactPair));
  if (!pairs) return pairs.error();
  auto lives = create("contact lives", 2 * entries * sizeof(layout::ContactLife));
  if (!lives) return lives.error();
  auto normals = create("contact normals", entries * sizeof(layout::vec4));
  if (!normals) return normals.error();
  lists_.emplace(Lists{std::move(*heads), std::move(*pairs), std::move(*lives), std::move(*normals)});

  // In the order of layout.h: storage, then texels.
  const auto& [contacts, neighbours, grid, places, queue] = *buffers_;
  auto bindings = gpu::Bindings::create(
      kernels_[0], {groom_->positions, groom_->solved, contacts, neighbours, grid, places, lists_->heads,
                    lists_->pairs, lists_->lives, lists_->normals, groom_->contactSystems,
                    groom_->contactControl, queue, groom_->positions, groom_->solved, contacts, places,
                    lists_->pairs, lists_->lives, lists_->normals});
  if (!bindings) return bindings.error();
  bindings_ = std::move(*bindings);
  return {};
}

layout::ContactParameters ContactStage::parameters(std::uint32_t step) const {
  return {.contactCount = static_cast<std::uint32_t>(particles_.size()),
          .bucketCount = bucketCount_,
          .blockCount = blockCount_,
          .mostBlocks = mostBlocks_,
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
          .seenAhead = static_cast<float>(kContactSeenAhead),
          // lavapipe ends an invocation's loops at 65,535 turns, without a word.
          .mostTurns = device_->properties().type == "cpu" ? 60000u : 0xffffffffu};
}

void ContactStage::dispatch(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                            std::uint32_t groupCount) const {
  recorder.dispatch(kernels_[static_cast<std::size_t>(kernel)], *bindings_, parameters(step), groupCount);
}
void ContactStage::dispatchIndirect(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                                    std::uint64_t offset) const {
  recorder.dispatchIndirect(kernels_[static_cast<std::size_t>(kernel)], *bindings_, parameters(step),
                            groom_->contactControl, offset);
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
  recorder.barrier();
  dispatch(recorder, ContactKernel::check, step, 1);
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

// The lists in use before those that did not fit keep what their pairs remember, in larger buffers; the pairs
// are found anew.
Status ContactStage::makeRoom() {
  if (control().isHalted == layout::kHaltedByTurns) {
    return Error{
        "more contact particles are near one another than this device can look through; use a smaller "
        "contact radius, or fewer strands in one place"};
  }
  const std::uint32_t before = control().parity ^ 1, oldMost = mostBlocks_, oldBlocks = blockCount_;
  const std::size_t heads = 2 * particles_.size();
  auto lists = downloadAll<std::uint32_t>(lists_->heads, heads * (1 + oldMost));
  if (!lists) return lists.error();
  auto lives = downloadAll<layout::ContactLife>(lists_->lives, 2 * std::size_t{oldBlocks} * layout::kListBlock);
  if (!lives) return lives.error();

  // What was wanted, and a quarter more. Each particle's last block is partly empty.
  layout::ContactControl& c = control();
  const auto enough = [](std::uint32_t wanted, std::uint32_t had) {
    return wanted > had ? wanted + wanted / 4 + 1 : had;
  };
  blockCount_ = enough(c.blocks, oldBlocks);
  mostBlocks_ = enough((c.longestList + layout::kListBlock - 1) / layout::kListBlock, oldMost);
  if (Status status = createLists(); !status) return status;

  std::vector<std::uint32_t> newLists(heads * (1 + mostBlocks_));
  for (std::size_t list = before; list < heads; list += 2) {
    std::copy_n(lists->begin() + static_cast<std::ptrdiff_t>(list * (1 + oldMost)), 1 + oldMost,
                newLists.begin() + static_cast<std::ptrdiff_t>(list * (1 + mostBlocks_)));
  }
  std::vector<layout::ContactLife> newLives(2 * std::size_t{blockCount_} * layout::kListBlock);
  std::copy_n(
      lives->begin() + static_cast<std::ptrdiff_t>(before * std::size_t{oldBlocks} * layout::kListBlock),
      std::size_t{oldBlocks} * layout::kListBlock,
      newLives.begin() + static_cast<std::ptrdiff_t>(before * std::size_t{blockCount_} * layout::kListBlock));
  if (Status status = lists_->heads.upload(std::as_bytes(std::span(newLists))); !status) return status;
  if (Status status = lists_->lives.upload(std::as_bytes(std::span(newLives))); !status) return status;

  c.parity = before;
  c.isHalted = c.isListed = c.listed = 0;
  --c.rebuilds;
  return {};
}

std::uint64_t ContactStage::takePairTests() {
  const std::uint64_t tests = control().pairTests;
  control().pairTests = 0;
  return tests;
}

Status ContactStage::forget() {
  control().isListed = 0;
  return lists_->heads.fillZero();
}

Result<std::vector<ListedContact>> ContactStage::listed(const RestState& rest) const {
  const std::size_t count = particles_.size(), parity = control().parity;
  auto lists = downloadAll<std::uint32_t>(lists_->heads, 2 * count * (1 + mostBlocks_));
  if (!lists) return lists.error();
  auto lives = downloadAll<layout::ContactLife>(lists_->lives, 2 * std::size_t{blockCount_} * layout::kListBlock);
  if (!lives) return lives.error();

  const std::vector<std::uint32_t> inGroom = groomIndices(rest);
  std::vector<ListedContact> contacts;
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t list = (2 * c + parity) * (1 + mostBlocks_);
    for (std::uint32_t j = 0; j < (*lists)[list]; ++j) {
      const std::size_t block = (*lists)[list + 1 + j / layout::kListBlock];
      const auto& [shares, particle] =
          (*lives)[(parity * blockCount_ + block) * layout::kListBlock + j % layout::kListBlock];
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
Result<double> ContactStage::momentumError(const RestState& rest) const {
  auto systems = downloadAll<layout::ContactSystem>(groom_->contactSystems, rest.points.size());
  if (!systems) return systems.error();
  auto solved = downloadAll<layout::vec4>(groom_->solved, rest.points.size());
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
