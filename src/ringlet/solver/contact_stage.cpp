// Implements solver/contact_stage.h.
#include "ringlet/solver/contact_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "ringlet/rest/material.h"
#include "ringlet/solver/contact_kernels.h"
#include "ringlet/solver/device_buffers.h"
#include "ringlet/solver/neighbour_table.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kGroupSize = kContactGroupSize;
// Blocks of a contact particle's lists at most, to begin with.
constexpr std::uint32_t kFirstMostBlocks = 4;
constexpr double kSkinShare = 0.15;  // of R: what may come closer before lists are made anew

// Where the device writes how many workgroups run.
constexpr std::uint64_t kPerContact = offsetof(layout::ContactControl, indirectContacts),
                        kPerBlock = offsetof(layout::ContactControl, indirectBuckets),
                        kOne = offsetof(layout::ContactControl, indirectOne),
                        kMeeting = offsetof(layout::ContactControl, indirectMeeting);

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

// The contact particle of each particle; 0 where there is none.
std::vector<std::uint32_t> contactIndices(const RestState& rest, const ContactParticles& particles) {
  std::vector<std::uint32_t> indices((rest.points.size() + 3) / 4 * 4);
  for (std::size_t c = 0; c < particles.particles.size(); ++c)
    indices[particles.particles[c]] = static_cast<std::uint32_t>(c);
  return indices;
}

}  // namespace

Result<ContactStage> ContactStage::create(gpu::Device& device, const RestState& rest,
                                          const Settings& settings, const RestContacts& contacts,
                                          DeviceGroom& groom) {
  const ContactParticles& particles = contacts.particles;
  ContactStage self;
  self.device_ = &device;
  self.groom_ = &groom;
  self.settings_ = settings.contacts;
  self.stepSeconds_ = settings.stepSeconds();
  self.particles_ = particles.particles;
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
    const auto description = describeContactKernel(static_cast<ContactKernel>(k), kGroupSize, texels);
    if (!gpu::Kernel::isCompiled(device, description)) self.newKernels_.push_back(k);
    auto kernel = gpu::Kernel::create(device, description);
    if (!kernel) return kernel.error();
    self.kernels_.push_back(std::move(*kernel));
  }

  const auto table = neighbourTable(contacts.graph);
  const std::uint64_t gridWords =
      2 * self.bucketCount_ + 1 + self.bucketCount_ / layout::kBucketBlock + 1 + 3 * count;
  const std::uint64_t needed =
      count * (sizeof(layout::ContactRest) + sizeof(layout::ContactPlace) + sizeof(layout::ContactHistory)) +
      gridWords * sizeof(std::uint32_t) + table.size() * sizeof(table[0]) +
      rest.points.size() * (sizeof(std::uint32_t) + sizeof(layout::vec4));
  if (Status status = checkMemory(fmt::format("the contacts of {} particles", count), needed,
                                  gpu::availableStorageBytes(device));
      !status)
    return status.error();

  auto rests = createFilled(device, contactRests(rest, settings, particles), "contacts");
  if (!rests) return rests.error();
  auto neighbours = createFilled(device, table, "neighbours");
  if (!neighbours) return neighbours.error();
  auto indices = createFilled(device, contactIndices(rest, particles), "contact indices");
  if (!indices) return indices.error();
  auto grid = createZero(device, gridWords * sizeof(std::uint32_t), "contact grid");
  if (!grid) return grid.error();
  auto places = createZero(device, count * sizeof(layout::ContactPlace), "contact places");
  if (!places) return places.error();
  auto histories = createZero(device, count * sizeof(layout::ContactHistory), "contact histories");
  if (!histories) return histories.error();
  auto guesses = createZero(device, rest.points.size() * sizeof(layout::vec4), "contact guesses");
  if (!guesses) return guesses.error();
  auto controlRead = gpu::Buffer::create(device, sizeof(layout::ContactControl), gpu::BufferKind::stream,
                                         "contact control read back");
  if (!controlRead) return controlRead.error();
  self.buffers_.emplace(Buffers{std::move(*rests), std::move(*neighbours), std::move(*indices),
                                std::move(*grid), std::move(*places), std::move(*histories),
                                std::move(*guesses), std::move(*controlRead)});
  self.near_ = {static_cast<std::uint32_t>(count), kFirstMostBlocks};
  self.live_ = {static_cast<std::uint32_t>(count / 4 + 1), kFirstMostBlocks};
  if (Status status = self.createLists(); !status) return status.error();
  return self;
}

std::uint64_t ContactStage::bytes() const {
  const Buffers& b = *buffers_;
  return b.contacts.bytes() + b.neighbours.bytes() + b.indices.bytes() + b.grid.bytes() + b.places.bytes() +
         b.histories.bytes() + b.guesses.bytes();
}
std::uint64_t ContactStage::listBytes() const {
  const Lists& l = *lists_;
  return l.heads.bytes() + l.pairs.bytes() + l.liveHeads.bytes() + l.lives.bytes() + l.forces.bytes();
}

std::uint32_t ContactStage::contactGroups() const {
  return static_cast<std::uint32_t>((particles_.size() + kGroupSize - 1) / kGroupSize);
}

void ContactStage::recordControl(gpu::Recorder& recorder) const {
  recorder.copyBuffer(groom_->contactControl, buffers_->controlRead, sizeof(layout::ContactControl));
}

void ContactStage::readControl() {
  const std::uint32_t testsBefore = control_.pairTests;
  control_ = *reinterpret_cast<const layout::ContactControl*>(buffers_->controlRead.mapped().data());
  pairTests_ += control_.pairTests - testsBefore;
}

Status ContactStage::writeControl() {
  return groom_->contactControl.upload(std::as_bytes(std::span(&control_, 1)));
}

// As large as `near_` and `live_` say; and what the kernels see of them. Those there were are gone before the
// new ones are made.
Status ContactStage::createLists() {
  const std::uint64_t count = particles_.size();
  const std::uint64_t liveCount = std::uint64_t{live_.blocks} * layout::kLiveBlock;
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  const std::pair<const char*, std::uint64_t> sizes[] = {
      {"contact lists", count * (2 + 2 * near_.most) * kWord},
      {"contact pairs", std::uint64_t{near_.blocks} * layout::kListBlock * sizeof(layout::ContactPair)},
      {"live contacts' lists", 2 * count * (1 + live_.most) * kWord},
      {"live contacts", 2 * liveCount * sizeof(layout::ContactLife)},
      {"contact forces", liveCount * sizeof(layout::ContactForce)}};
  lists_.reset();
  std::uint64_t total = 0;
  for (const auto& [name, bytes] : sizes) {
    total += bytes;
    if (bytes <= largestList_) continue;
    return Error{fmt::format(
        "the {} of {} contact particles, up to {} for one, need a buffer of {} MiB, and this device's are {} "
        "MiB at most; use a smaller contact radius, or prune more",
        name, count, near_.most * layout::kListBlock, bytes >> 20, largestList_ >> 20)};
  }
  const std::string what = fmt::format("the lists of {} contact particles", count);
  if (Status status = checkMemory(what, total, gpu::availableStorageBytes(*device_)); !status) return status;
  std::vector<gpu::Buffer> made;
  for (const auto& [name, bytes] : sizes) {
    auto list = createZero(*device_, bytes, name);
    if (!list) return list.error();
    made.push_back(std::move(*list));
  }
  lists_.emplace(Lists{std::move(made[0]), std::move(made[1]), std::move(made[2]), std::move(made[3]),
                       std::move(made[4])});

  bindings_.clear();
  for (const auto& kernel : kernels_) {
    auto bindings = gpu::Bindings::create(*kernel, bufferTable());
    if (!bindings) return bindings.error();
    bindings_.push_back(std::move(*bindings));
  }
  return {};
}

// What contact kernels see: as storage, and as texels.
gpu::BufferTable ContactStage::bufferTable() const {
  using namespace layout;
  const auto& [contacts, neighbours, indices, grid, places, histories, guesses, controlRead] = *buffers_;
  const Lists& lists = *lists_;
  return {{kBindContactPositions, hair().positions},
          {kBindContactVelocities, hair().velocities},
          {kBindContactSolved, hair().solved},
          {kBindContacts, contacts},
          {kBindNeighbours, neighbours},
          {kBindIndices, indices},
          {kBindGrid, grid},
          {kBindPlaces, places},
          {kBindHistories, histories},
          {kBindGuesses, guesses},
          {kBindLists, lists.heads},
          {kBindPairs, lists.pairs},
          {kBindLiveLists, lists.liveHeads},
          {kBindLives, lists.lives},
          {kBindForces, lists.forces},
          {kBindSystems, hair().contactSystems},
          {kBindControl, groom_->contactControl},
          {kBindContactPositionTexels, hair().positions},
          {kBindContactVelocityTexels, hair().velocities},
          {kBindContactSolvedTexels, hair().solved},
          {kBindContactTexels, contacts},
          {kBindNeighbourTexels, neighbours},
          {kBindIndexTexels, indices},
          {kBindPlaceTexels, places},
          {kBindHistoryTexels, histories},
          {kBindGuessTexels, guesses},
          {kBindPairTexels, lists.pairs},
          {kBindLifeTexels, lists.lives},
          {kBindForceTexels, lists.forces}};
}

layout::ContactParameters ContactStage::parameters(std::uint32_t step) const {
  return {.contactCount = static_cast<std::uint32_t>(particles_.size()),
          .bucketCount = bucketCount_,
          .blockCount = near_.blocks,
          .mostBlocks = near_.most,
          .liveBlockCount = live_.blocks,
          .mostLiveBlocks = live_.most,
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
          .warmth = static_cast<float>(kContactWarmth)};
}

void ContactStage::dispatch(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                            std::uint32_t groupCount) const {
  const auto at = static_cast<std::size_t>(kernel);
  recorder.dispatch(*kernels_[at], bindings_[at], parameters(step), groupCount);
}
void ContactStage::dispatchIndirect(gpu::Recorder& recorder, ContactKernel kernel, std::uint32_t step,
                                    std::uint64_t offset) const {
  const auto at = static_cast<std::size_t>(kernel);
  recorder.dispatchIndirect(*kernels_[at], bindings_[at], parameters(step), groom_->contactControl, offset);
}

void ContactStage::recordNothing(gpu::Recorder& recorder) const {
  for (const std::size_t k : newKernels_) recorder.dispatchNothing(*kernels_[k], bindings_[k]);
}

void ContactStage::recordLists(gpu::Recorder& recorder, SubmissionPace& pace, std::uint32_t step) const {
  pace.beginStage(recorder, "contact_motion");
  dispatch(recorder, ContactKernel::motion, step, contactGroups());
  recorder.barrier();
  dispatch(recorder, ContactKernel::decide, step, 1);
  recorder.barrier();
  recorder.endStage();

  pace.beginStage(recorder, "contact_grid");
  using enum ContactKernel;
  const std::pair<ContactKernel, std::uint64_t> grid[] = {
      {count, kPerContact}, {scan, kPerBlock}, {sum, kOne}, {scatter, kPerContact}, {order, kPerContact}};
  for (const auto& [kernel, offset] : grid) {
    dispatchIndirect(recorder, kernel, step, offset);
    recorder.barrier();
  }
  recorder.endStage();

  pace.beginStage(recorder, "contact_query");
  dispatchIndirect(recorder, ContactKernel::query, step, kPerContact);
  recorder.endStage();
}

void ContactStage::recordLife(gpu::Recorder& recorder, SubmissionPace& pace) const {
  pace.beginStage(recorder, "contact_touch");
  dispatch(recorder, ContactKernel::touch, 0, contactGroups());
  recorder.barrier();
  recorder.endStage();

  pace.beginStage(recorder, "contact_life");
  dispatchIndirect(recorder, ContactKernel::life, 0, kMeeting);
  recorder.barrier();
  dispatch(recorder, ContactKernel::check, 0, 1);
  recorder.endStage();
}

void ContactStage::recordGather(gpu::Recorder& recorder, SubmissionPace& pace) const {
  pace.beginStage(recorder, "contact_gather");
  dispatchIndirect(recorder, ContactKernel::gather, 0, kMeeting);
  recorder.endStage();
}

// The step begins anew, from the contacts of the step before, in larger buffers; pairs are found anew.
Status ContactStage::makeRoom() {
  layout::ContactControl& c = control_;
  if (c.isHalted == layout::kHaltedByTurns) {
    return Error{
        "more contact particles are near one another than this device can look through; use a smaller "
        "contact radius, or fewer strands in one place"};
  }
  const std::uint32_t before = c.parity ^ 1;
  const Room old = live_;
  const std::size_t count = particles_.size();
  auto heads = downloadAll<std::uint32_t>(lists_->liveHeads, 2 * count * (1 + old.most));
  if (!heads) return heads.error();
  const std::size_t rowSize = std::size_t{old.blocks} * layout::kLiveBlock;
  auto lives = downloadAll<layout::ContactLife>(lists_->lives, rowSize, before * rowSize);
  if (!lives) return lives.error();

  // What was wanted, and a quarter more. Each particle's last block is partly empty.
  const auto enough = [](Room had, std::uint32_t blocks, std::uint32_t longest, std::uint32_t blockSize) {
    const auto larger = [](std::uint32_t wanted, std::uint32_t now) {
      return wanted > now ? wanted + wanted / 4 + 1 : now;
    };
    return Room{larger(blocks, had.blocks), larger((longest + blockSize - 1) / blockSize, had.most)};
  };
  near_ = enough(near_, c.blocks, c.longestList, layout::kListBlock);
  live_ = enough(live_, c.liveBlocks, c.longestLive, layout::kLiveBlock);
  if (Status status = createLists(); !status) return status;

  std::vector<std::uint32_t> newHeads(2 * count * (1 + live_.most));
  for (std::size_t list = before; list < 2 * count; list += 2) {
    std::copy_n(heads->begin() + static_cast<std::ptrdiff_t>(list * (1 + old.most)), 1 + old.most,
                newHeads.begin() + static_cast<std::ptrdiff_t>(list * (1 + live_.most)));
  }
  if (Status status = lists_->liveHeads.upload(std::as_bytes(std::span(newHeads))); !status) return status;
  const std::uint64_t rowBegin =
      before * std::uint64_t{live_.blocks} * layout::kLiveBlock * sizeof(layout::ContactLife);
  if (Status status = lists_->lives.upload(std::as_bytes(std::span(*lives)), rowBegin); !status)
    return status;

  c.parity = before;
  c.isHalted = c.isListed = c.listed = 0;
  --c.rebuilds;
  --c.steps;
  return writeControl();
}

Status ContactStage::forget() {
  control_.isListed = control_.steps = 0;
  if (Status status = writeControl(); !status) return status;
  if (Status status = groom_->chunks[0].contactSystems.fillZero(); !status) return status;
  return lists_->liveHeads.fillZero();
}

Status ContactStage::archive(Archive& archive) {
  archive.value(control_);
  archive.value(pairTests_);
  Room near = near_, live = live_;
  archive.value(near);
  archive.value(live);
  if (archive.isShort()) return {};
  if (near != near_ || live != live_) {
    near_ = near, live_ = live;
    if (Status status = createLists(); !status) return status;
  }
  DeviceChunk& chunk = groom_->chunks[0];
  for (gpu::Buffer* buffer : {&lists_->heads, &lists_->pairs, &lists_->liveHeads, &lists_->lives,
                              &buffers_->histories, &chunk.contactSystems, &chunk.solved}) {
    if (Status status = archiveBuffer(archive, *buffer); !status) return status;
  }
  return archive.isReading() ? writeControl() : Status{};
}

Result<std::uint64_t> ContactStage::contactCount() const {
  auto heads = downloadAll<std::uint32_t>(lists_->liveHeads, 2 * particles_.size() * (1 + live_.most));
  if (!heads) return heads.error();
  std::uint64_t sides = 0;
  for (std::size_t list = control_.parity; list < 2 * particles_.size(); list += 2)
    sides += (*heads)[list * (1 + live_.most)];
  return sides / 2;
}

Result<std::vector<ListedContact>> ContactStage::listed(const RestState& rest) const {
  const std::size_t count = particles_.size(), parity = control_.parity;
  auto heads = downloadAll<std::uint32_t>(lists_->heads, count * (1 + 2 * near_.most));
  if (!heads) return heads.error();
  auto pairs =
      downloadAll<layout::ContactPair>(lists_->pairs, std::size_t{near_.blocks} * layout::kListBlock);
  if (!pairs) return pairs.error();
  auto liveHeads = downloadAll<std::uint32_t>(lists_->liveHeads, 2 * count * (1 + live_.most));
  if (!liveHeads) return liveHeads.error();
  const std::size_t rowSize = std::size_t{live_.blocks} * layout::kLiveBlock;
  auto lives = downloadAll<layout::ContactLife>(lists_->lives, rowSize, parity * rowSize);
  if (!lives) return lives.error();

  // Contacts first: of a pair that is in both lists, the contact stays.
  const std::vector<std::uint32_t> inGroom = groomIndices(rest);
  std::vector<ListedContact> contacts;
  const auto add = [&](std::size_t c, std::uint32_t other, float shares) {
    const std::uint32_t a = inGroom[particles_[c]], b = inGroom[other];
    if (a < b) contacts.push_back({a, b, std::max(0.0f, -shares), shares < 0 ? 1.0f : shares});
  };
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t live = (2 * c + parity) * (1 + live_.most), near = c * (1 + 2 * near_.most);
    for (std::uint32_t j = 0; j < (*liveHeads)[live]; ++j) {
      const std::size_t block = (*liveHeads)[live + 1 + j / layout::kLiveBlock];
      const layout::ContactLife& life = (*lives)[block * layout::kLiveBlock + j % layout::kLiveBlock];
      add(c, life.particle, life.shares);
    }
    for (std::uint32_t j = 0; j < (*heads)[near]; ++j) {
      const std::size_t block = (*heads)[near + 1 + 2 * (j / layout::kListBlock)];
      add(c, (*pairs)[block * layout::kListBlock + j % layout::kListBlock].particle, 0);
    }
  }
  const auto place = [](const ListedContact& x) { return std::pair(x.a, x.b); };
  std::ranges::stable_sort(contacts, {}, place);
  const auto isSame = [&](const ListedContact& x, const ListedContact& y) { return place(x) == place(y); };
  contacts.erase(std::unique(contacts.begin(), contacts.end(), isSame), contacts.end());
  return contacts;
}

// J_a = momentum - 2 D v of the last iterate, in kg m/s. What a pinned particle received is not known, and
// left out.
Result<double> ContactStage::momentumError(const RestState& rest) const {
  auto systems = downloadAll<layout::ContactSystem>(hair().contactSystems, rest.points.size());
  if (!systems) return systems.error();
  auto solved = downloadAll<layout::vec4>(hair().solved, rest.points.size());
  if (!solved) return solved.error();
  Vec3d sum{};
  double sizes = 0;
  for (const layout::StrandRest& strand : rest.strands) {
    for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i) {
      const auto& [d, o, m] = (*systems)[i];
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
