// Implements solver/contacts/contact_stage.h.
#include "ringlet/solver/contacts/contact_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "layout/strands.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/scene/packed_contacts.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "ringlet/solver/contacts/neighbour_table.h"
#include "ringlet/solver/contacts/sampled_contacts.h"

namespace ringlet {
namespace {

// Initial limit of the blocks in a contact particle's list.
constexpr std::uint32_t kFirstMostNearBlocks = 4;
// Most workgroups of contact_motion.comp; a lane loops over the particles that exceed them. Fewer workgroups
// mean fewer atomics for the maximum, and, on a CPU device, fewer barriers, which are slow there.
constexpr std::uint32_t kMotionGroups = 4096, kMotionGroupsOfCpu = 64;

// Offsets of the group counts that the device writes for indirect dispatches.
constexpr std::uint64_t kPerContact = offsetof(layout::ContactControl, indirectContacts),
                        kPerBlock = offsetof(layout::ContactControl, indirectBuckets),
                        kSample = offsetof(layout::ContactControl, indirectSample),
                        kQuery = offsetof(layout::ContactControl, indirectQuery),
                        kMeeting = offsetof(layout::ContactControl, indirectMeeting);

std::vector<layout::ContactRest> contactRests(const RestState& rest, const Settings& settings,
                                              const ContactParticles& particles) {
  std::vector<layout::ContactRest> rests;
  for (std::size_t c = 0; c < particles.particles.size(); ++c) {
    const std::uint32_t particle = particles.particles[c], strand = particles.strands[c];
    const layout::StrandRest& s = rest.strands[strand];
    const bool isPinned = particle - s.firstParticle < static_cast<std::uint32_t>(settings.rootCount);
    const Vec3f p = rest.points[particle];
    rests.push_back({.point = {p.x, p.y, p.z},
                     .radius = particles.radii[strand],
                     .particle = particle,
                     .strand = strand,
                     .mass = particles.masses[strand],
                     .inverseMassUnit = isPinned ? 0.0f : 1 / s.massUnit});
  }
  return rests;
}

// Dense hair has more neighbours than this per contact particle at rest, nearer than 1.5 R. There a sample of
// contact particles decides how long lists are kept.
constexpr double kDenseNeighbours = 16;
// Reach of the lists of dense hair, in r0. Pairs that approach faster are found one step later. The cost of
// the search grows with the cube of the reach.
constexpr double kDenseAhead = 1.3;

// The sample takes one contact particle in this many; 0 if hair is not dense. overlapsPerParticle was counted
// with enlarged radii.
std::uint32_t sampleStride(const RestContacts& contacts, const ContactSettings& settings) {
  const double neighbours = 2 * contacts.overlapsPerParticle * std::pow(1.5 / settings.enlargement, 3);
  constexpr double kMostStride = 32;
  return neighbours > kDenseNeighbours ? static_cast<std::uint32_t>(std::min(neighbours / 2, kMostStride))
                                       : 0;
}

// The contact particle of each particle; 0 if it has none.
std::vector<std::uint32_t> contactIndices(const RestState& rest, const ContactParticles& particles) {
  std::vector<std::uint32_t> indices((rest.points.size() + 3) / 4 * 4);
  for (std::size_t c = 0; c < particles.particles.size(); ++c)
    indices[particles.particles[c]] = static_cast<std::uint32_t>(c);
  return indices;
}

}  // namespace

Result<ContactStage> ContactStage::create(gpu::Device& device, const RestState& rest,
                                          const Settings& settings, const RestContacts& contacts,
                                          DeviceGroom& groom, int room) {
  const ContactParticles& particles = contacts.particles;
  const bool divided = !contacts.inWhole.empty();
  ContactStage self;
  self.device_ = &device;
  self.groom_ = &groom;
  self.settings_ = settings.contacts;
  self.stepSeconds_ = settings.stepSeconds();
  self.particles_ = particles.particles;
  self.everyPair_ = contacts.graph.everyPair;
  self.isDivided_ = divided;
  self.mostMotionGroups_ = device.properties().isCpu ? kMotionGroupsOfCpu : kMotionGroups;
  // If some hair is in contact as a volume, few contact particles are in pairs, and a sample may contain none
  // of these.
  const bool inGroups = contacts.volume.hasGroups();
  self.sampleStride_ = inGroups ? 0 : sampleStride(contacts, settings.contacts);
  self.largestRadius_ = contacts.largestRadius;
  const std::uint64_t count = self.particles_.size();
  SampledContacts samples{{0}, 0};  // the list is needed only for divided hair
  if (self.sampleStride_ > 0) {
    const std::uint32_t stride = self.sampleStride_;
    samples.most = static_cast<std::uint32_t>((count + stride - 1) / stride);
    if (divided) samples = sampledContacts(contacts, hereCount(rest), stride);
  }
  self.mostSampled_ = samples.most;
  if (self.contactGroups() > device.properties().maxGroupCount) {
    return Error{fmt::format(
        "{} contact particles are more than the {} this device takes at once; use a larger radius or spacing",
        count, std::uint64_t{device.properties().maxGroupCount} * kContactGroupSize)};
  }
  self.bucketCount_ =
      static_cast<std::uint32_t>(std::bit_ceil(std::max<std::uint64_t>(2 * count, layout::kBucketBlock)));
  if (Status made = self.makeKernels(device, inGroups); !made) return made.error();
  if (Status made = self.makeBuffers(device, rest, settings, contacts, samples.list); !made)
    return made.error();
  self.near_ = ListRoom{static_cast<std::uint32_t>(count), kFirstMostNearBlocks}.times(room);
  if (self.settings_.taper == ContactTaper::time) {
    auto lives = ContactLives::create(self.listMaker(), room);
    if (!lives) return lives.error();
    self.lives_.emplace(std::move(*lives));
  }
  if (Status status = self.createLists(); !status) return status.error();
  if (Status status = self.bindLists(); !status) return status.error();
  return self;
}

Status ContactStage::makeKernels(gpu::Device& device, bool inGroups) {
  const bool texels = isSeenAsTexels(device, kLeastTexelBytes);
  largestList_ = device.properties().maxStorageBufferRange;
  if (texels) {
    const std::uint64_t seen = device.properties().maxTexelRecords * sizeof(layout::vec4);
    largestList_ = std::min(largestList_, seen);
  }
  const ContactKernelForm form{.taper = settings_.taper,
                               .inGroups = inGroups,
                               .texels = texels,
                               .forGpu = !device.properties().isCpu,
                               .divided = isDivided_};
  for (std::size_t k = 0; k < contactKernelCount(settings_.taper); ++k) {
    const auto description = describeContactKernel(static_cast<ContactKernel>(k), form);
    if (!gpu::Kernel::isCompiled(device, description)) newKernels_.push_back(k);
    auto kernel = gpu::Kernel::create(device, description);
    if (!kernel) return kernel.error();
    kernels_.push_back(std::move(*kernel));
  }
  return {};
}

Status ContactStage::makeBuffers(gpu::Device& device, const RestState& rest, const Settings& settings,
                                 const RestContacts& contacts, const std::vector<std::uint32_t>& ofSamples) {
  const std::uint64_t count = particles_.size();
  const auto table = neighbourTable(contacts.graph, contacts.volume, rest.haloCount);
  const std::uint64_t gridWords = (contacts.volume.hasGroups() ? 4 : 2) * bucketCount_ + 1 +
                                  bucketCount_ / layout::kBucketBlock + 1 + 3 * count;
  const std::uint64_t needed =
      count * (sizeof(layout::ContactRest) + sizeof(layout::ContactPlace) + sizeof(layout::ContactHistory)) +
      gridWords * sizeof(std::uint32_t) + table.size() * sizeof(table[0]) +
      rest.points.size() * (sizeof(std::uint32_t) + sizeof(layout::vec4));
  if (Status status = checkMemory(fmt::format("the contacts of {} particles", count), needed,
                                  gpu::availableStorageBytes(device));
      !status)
    return status.error();

  auto rests = createFilled(device, contactRests(rest, settings, contacts.particles), "contacts");
  if (!rests) return rests.error();
  auto neighbours = createFilled(device, table, "neighbours");
  if (!neighbours) return neighbours.error();
  auto indices = createFilled(device, contactIndices(rest, contacts.particles), "contact indices");
  if (!indices) return indices.error();
  auto grid = createZero(device, gridWords * sizeof(std::uint32_t), "contact grid");
  if (!grid) return grid.error();
  auto places = createZero(device, count * sizeof(layout::ContactPlace), "contact places");
  if (!places) return places.error();
  auto histories = createZero(device, count * sizeof(layout::ContactHistory), "contact histories");
  if (!histories) return histories.error();
  auto guesses = createZero(device, rest.points.size() * sizeof(layout::vec4), "contact guesses");
  if (!guesses) return guesses.error();
  auto sampled = createFilled(device, ofSamples, "contacts of samples");
  if (!sampled) return sampled.error();
  auto numbers = createZero(device, sizeof(layout::ContactNumbers), "contact numbers");
  if (!numbers) return numbers.error();
  buffers_.emplace(Buffers{std::move(*rests), std::move(*neighbours), std::move(*indices), std::move(*grid),
                           std::move(*places), std::move(*histories), std::move(*guesses),
                           std::move(*sampled), std::move(*numbers)});
  return {};
}

std::uint64_t ContactStage::bytes() const {
  const Buffers& b = *buffers_;
  return b.contacts.bytes() + b.neighbours.bytes() + b.indices.bytes() + b.grid.bytes() + b.places.bytes() +
         b.histories.bytes() + b.guesses.bytes() + b.sampled.bytes() + b.numbers.bytes();
}
std::uint64_t ContactStage::listBytes() const {
  return lists_[kHeads].bytes() + lists_[kPairs].bytes() + (lives_ ? lives_->bytes() : 0);
}

std::uint32_t ContactStage::contactGroups() const {
  return static_cast<std::uint32_t>((particles_.size() + kContactGroupSize - 1) / kContactGroupSize);
}

void ContactStage::readControl() {
  const std::uint32_t testsBefore = control_.pairTests;
  control_ = groom_->control();
  pairTests_ += control_.pairTests - testsBefore;
}

Status ContactStage::writeControl() {
  return groom_->contactControl.upload(std::as_bytes(std::span(&control_, 1)));
}

// Uploads the numbers. No kernel may be reading them.
Status ContactStage::writeNumbers() {
  const layout::ContactNumbers now = numbers();
  return buffers_->numbers.upload(std::as_bytes(std::span(&now, 1)));
}

// Makes lists of the size that `near_` says. The old ones are freed first.
Status ContactStage::createLists() {
  lists_.clear();
  const ListMaker::Part parts[] = {
      {"contact lists", particles_.size() * (3 + 2 * near_.most) * sizeof(std::uint32_t)},
      {"contact pairs", std::uint64_t{near_.blocks} * layout::kListBlock * sizeof(layout::ContactPair)}};
  auto made = listMaker().make(parts, near_.most * layout::kListBlock);
  if (!made) return made.error();
  lists_ = std::move(*made);
  return {};
}

// Binds the lists, and writes their room into the numbers.
Status ContactStage::bindLists() {
  bindings_.clear();
  for (const auto& kernel : kernels_) {
    auto bindings = gpu::Bindings::create(*kernel, bufferTable());
    if (!bindings) return bindings.error();
    bindings_.push_back(std::move(*bindings));
  }
  return writeNumbers();
}

// The table of bindings: buffers as storage, and some of them as texels too.
gpu::BufferTable ContactStage::bufferTable() const {
  using namespace layout;
  const auto& [contacts, neighbours, indices, grid, places, histories, guesses, sampled, ofNumbers] =
      *buffers_;
  gpu::BufferTable table{{kBindContactPositions, hair().positions},
                         {kBindContactVelocities, hair().velocities},
                         {kBindContactSolved, hair().solved},
                         {kBindContacts, contacts},
                         {kBindNeighbours, neighbours},
                         {kBindIndices, indices},
                         {kBindGrid, grid},
                         {kBindPlaces, places},
                         {kBindHistories, histories},
                         {kBindGuesses, guesses},
                         {kBindSampled, sampled},
                         {kBindContactNumbers, ofNumbers},
                         {kBindLists, lists_[kHeads]},
                         {kBindPairs, lists_[kPairs]},
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
                         {kBindPairTexels, lists_[kPairs]}};
  if (lives_) lives_->addTo(table);
  return table;
}

double ContactStage::skin() const { return kContactMargin * 2 * largestRadius_; }
double ContactStage::listedAhead() const { return sampleStride_ > 0 ? kDenseAhead : kContactSeenAhead; }

layout::ContactNumbers ContactStage::numbers() const {
  const ListRoom live = lives_ ? lives_->room() : ListRoom{};
  layout::ContactNumbers n = packed(settings_, stepSeconds_);
  n.contactCount = static_cast<std::uint32_t>(particles_.size());
  n.bucketCount = bucketCount_;
  n.blockCount = near_.blocks;
  n.mostBlocks = near_.most;
  n.liveBlockCount = live.blocks;
  n.mostLiveBlocks = live.most;
  n.everyPair = everyPair_ ? 1u : 0u;
  n.skin = static_cast<float>(skin());
  n.largestRadius = largestRadius_;
  n.listedAhead = static_cast<float>(listedAhead());
  n.sampleStride = sampleStride_;
  n.mostSampled = mostSampled_;
  n.cellsPerMetre = static_cast<float>(1 / (1.01 * (listedAhead() * 2 * largestRadius_ + skin())));
  return n;
}

void ContactStage::dispatch(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                            std::uint32_t groupCount) const {
  const auto at = static_cast<std::size_t>(kernel);
  list.dispatch(*kernels_[at], bindings_[at], layout::ContactParameters{step, layout::kOfAll}, groupCount);
}
void ContactStage::dispatchIndirect(gpu::CommandList& list, ContactKernel kernel, std::uint32_t step,
                                    std::uint64_t offset) const {
  const auto at = static_cast<std::size_t>(kernel);
  list.dispatchIndirect(*kernels_[at], bindings_[at], layout::ContactParameters{step, layout::kOfAll},
                        groom_->contactControl, offset);
}

void ContactStage::recordNothing(gpu::CommandList& list) const {
  for (const std::size_t k : newKernels_) list.dispatchNothing(*kernels_[k], bindings_[k]);
}

void ContactStage::recordMotion(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step,
                                std::uint32_t whose) const {
  const auto at = static_cast<std::size_t>(ContactKernel::motion);
  pace.beginStage(list, "contact_motion");
  list.dispatch(*kernels_[at], bindings_[at], layout::ContactParameters{step, whose},
                std::min(contactGroups(), mostMotionGroups_));
  list.endStage();
}

void ContactStage::recordGrid(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const {
  pace.beginStage(list, "contact_grid");
  using enum ContactKernel;
  const std::pair<ContactKernel, std::uint64_t> grid[] = {
      {count, kPerContact}, {scan, kPerBlock}, {scatter, kPerContact}, {order, kPerContact}};
  for (const auto& [kernel, offset] : grid) {
    dispatchIndirect(list, kernel, step, offset);
    list.barrier();
  }
  list.endStage();

  pace.beginStage(list, "contact_sample");
  dispatchIndirect(list, ContactKernel::sample, step, kSample);
  list.endStage();
}

void ContactStage::recordLists(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const {
  pace.beginStage(list, "contact_query");
  if (isDivided_ && samples()) {
    dispatch(list, ContactKernel::judge, step, 1);
    list.barrier();
  }
  dispatchIndirect(list, ContactKernel::query, step, kQuery);
  list.endStage();
}

void ContactStage::recordFirst(gpu::CommandList& list, SubmissionPace& pace) const {
  pace.beginStage(list, "contact_touch");
  dispatch(list, ContactKernel::touch, 0, contactGroups());
  list.endStage();
  if (!lives_) return;
  list.barrier();
  pace.beginStage(list, "contact_life");
  dispatchIndirect(list, ContactKernel::life, 0, kMeeting);
  list.barrier();
  dispatch(list, ContactKernel::check, 0, 1);
  list.endStage();
}

void ContactStage::recordNext(gpu::CommandList& list, SubmissionPace& pace) const {
  pace.beginStage(list, lives_ ? "contact_gather" : "contact_system");
  dispatchIndirect(list, ContactKernel::next, 0, kMeeting);
  list.endStage();
}

ContactStage::Largest ContactStage::largest() const {
  return {std::bit_cast<std::int32_t>(control_.motion), std::bit_cast<std::int32_t>(control_.speed)};
}
Status ContactStage::setLargest(const Largest& largest) {
  control_.motion = std::bit_cast<std::uint32_t>(largest[0]);
  control_.speed = std::bit_cast<std::uint32_t>(largest[1]);
  return writeControl();
}

Status ContactStage::setSample(const Sample& sample) {
  control_.sampled = sample.sampled, control_.missed = sample.missed;
  return writeControl();
}

// Prepares to repeat the step in larger buffers, from the contacts of the last step. Lists that were large
// enough are kept, so that their content does not depend on how large the others were.
Status ContactStage::makeRoom() {
  layout::ContactControl& c = control_;
  if (lives_) {
    if (Status status = lives_->makeRoom(c); !status) return status;
  }
  if (const ListRoom near = near_.grownTo(c.blocks, c.longestList, layout::kListBlock); near != near_) {
    near_ = near;
    c.isListed = c.listed = 0;
    --c.rebuilds;
    if (Status status = createLists(); !status) return status;
    // The new lists do not say which particles had contacts, so no kernel would clear their systems.
    if (Status status = groom_->chunks[0].contactSystems.fillZero(); !status) return status;
  }
  if (Status status = bindLists(); !status) return status;
  c.parity ^= 1;
  c.isHalted = 0;
  --c.steps;
  return writeControl();
}

Status ContactStage::setSettings(const Settings& settings) {
  const bool sameSprings = settings.contacts.stiffness == settings_.stiffness &&
                           settings.contacts.dampingRatio == settings_.dampingRatio;
  settings_ = settings.contacts;
  stepSeconds_ = settings.stepSeconds();
  if (Status status = writeNumbers(); !status) return status;
  if (sameSprings) return {};
  control_.isListed = 0;
  return writeControl();
}

Status ContactStage::forget() {
  control_.isListed = control_.steps = 0;
  if (Status status = writeControl(); !status) return status;
  if (Status status = groom_->chunks[0].contactSystems.fillZero(); !status) return status;
  if (Status status = lists_[kHeads].fillZero(); !status) return status;
  return lives_ ? lives_->forget() : Status{};
}

Status ContactStage::archive(Archive& archive) {
  archive.value(control_);
  archive.value(pairTests_);
  ListRoom near = near_;
  archive.value(near);
  if (archive.isShort()) return {};
  if (near != near_) {
    near_ = near;
    if (Status status = createLists(); !status) return status;
  }
  for (gpu::Buffer* buffer : {&lists_[kHeads], &lists_[kPairs], &buffers_->histories}) {
    if (Status status = archiveBuffer(archive, *buffer); !status) return status;
  }
  if (lives_) {
    if (Status status = lives_->archive(archive); !status) return status;
  }
  if (!archive.isReading()) return {};
  if (Status status = bindLists(); !status) return status;
  return writeControl();
}

// Calls tell(contact particle, index of the block, number of pairs in it, bits of the pairs) for each block
// of each list.
Status ContactStage::eachBlock(const EachBlock& tell) const {
  auto heads = downloadAll<std::uint32_t>(lists_[kHeads], particles_.size() * (1 + 2 * near_.most));
  if (!heads) return heads.error();
  for (std::size_t c = 0; c < particles_.size(); ++c) {
    const std::uint32_t* list = heads->data() + c * (1 + 2 * near_.most);
    for (std::uint32_t begin = 0; begin < list[0]; begin += layout::kListBlock) {
      const std::uint32_t* block = list + 1 + 2 * (begin / layout::kListBlock);
      tell(c, block[0], std::min(list[0] - begin, layout::kListBlock), block[1]);
    }
  }
  return {};
}

Result<std::uint64_t> ContactStage::contactSides() const {
  std::uint64_t sides = 0;
  if (lives_) {
    auto counted = lives_->count(control_.parity);
    if (!counted) return counted.error();
    return *counted;
  }
  const Status status = eachBlock([&](std::size_t, std::uint32_t, std::uint32_t, std::uint32_t bits) {
    sides += static_cast<std::uint64_t>(std::popcount(bits >> layout::kListBlock));
  });
  if (!status) return status.error();
  return sides;
}

Result<std::vector<ListedContact>> ContactStage::listed(const RestState& rest) const {
  auto pairs =
      downloadAll<layout::ContactPair>(lists_[kPairs], std::size_t{near_.blocks} * layout::kListBlock);
  if (!pairs) return pairs.error();

  // Contacts come first: if a pair is also in a list, unique() keeps the contact.
  const std::vector<std::uint32_t> inGroom = groomIndices(rest);
  std::vector<ListedContact> contacts;
  const auto add = [&](std::size_t c, std::uint32_t other, float stiffnessShare, float dampingShare) {
    const std::uint32_t a = inGroom[particles_[c]], b = inGroom[other];
    if (a < b) contacts.push_back({a, b, stiffnessShare, dampingShare});
  };
  if (lives_) {
    const Status told = lives_->each(control_.parity, [&](std::size_t c, const layout::ContactLife& life) {
      const float shares = life.shares;
      add(c, life.particle, std::max(0.0f, -shares), shares < 0 ? 1.0f : shares);
    });
    if (!told) return told.error();
  }
  const Status told =
      eachBlock([&](std::size_t c, std::uint32_t block, std::uint32_t count, std::uint32_t bits) {
        for (std::uint32_t k = 0; k < count; ++k) {
          const bool acts = !lives_ && (bits >> k & 1) != 0;
          const bool pushes = acts && (bits >> (layout::kListBlock + k) & 1) != 0;
          add(c, (*pairs)[block * layout::kListBlock + k].particle, pushes ? 1.0f : 0.0f, acts ? 1.0f : 0.0f);
        }
      });
  if (!told) return told.error();
  const auto place = [](const ListedContact& x) { return std::pair(x.a, x.b); };
  std::ranges::stable_sort(contacts, {}, place);
  const auto isSame = [&](const ListedContact& x, const ListedContact& y) { return place(x) == place(y); };
  contacts.erase(std::unique(contacts.begin(), contacts.end(), isSame), contacts.end());
  return contacts;
}

}  // namespace ringlet
