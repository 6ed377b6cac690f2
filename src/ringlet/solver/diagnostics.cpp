// Implements solver/diagnostics.h.
#include "ringlet/solver/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {

Result<std::vector<ListedContact>> Diagnostics::listedContacts() const {
  Simulation::Implementation& self = *hair_->self_;
  if (!self.contacts.pairs) return std::vector<ListedContact>{};
  if (Status status = self.finishFrames(); !status) return status.error();
  return self.contacts.pairs->listed(self.rest());
}

Result<std::vector<std::array<float, 4>>> Diagnostics::tap(std::uint32_t field) const {
  Simulation::Implementation& self = *hair_->self_;
  RINGLET_ASSERT(self.asset->choice.taps && field < layout::kTapCount,
                 "taps are written only with KernelChoice::taps");
  if (Status status = self.finishFrames(); !status) return status.error();
  std::vector<std::array<float, 4>> values(self.rest().groomParticleCount);
  GroomPlaces place(self.rest());
  const auto take = [&](std::size_t i, layout::vec4 v) { values[place(i)] = {v.x, v.y, v.z, v.w}; };
  if (Status status = self.buffers.downloadEach(&DeviceChunk::taps, take, field); !status)
    return status.error();
  return values;
}

Result<std::vector<BufferContent>> Diagnostics::bufferContents() const {
  Simulation::Implementation& self = *hair_->self_;
  if (Status status = self.finishFrames(); !status) return status.error();
  std::map<std::string, const gpu::Buffer*> buffers;
  const auto add = [&](const gpu::BufferTable& table, const std::string& ending) {
    for (const auto& [binding, buffer] : table)
      if (buffer.get().bytes() > 0) buffers.try_emplace(buffer.get().name() + ending, &buffer.get());
  };
  for (std::size_t chunk = 0; chunk < self.buffers.chunks.size(); ++chunk)
    add(self.bufferTable(chunk), chunk > 0 ? fmt::format("_{}", chunk) : "");
  if (self.contacts.pairs) add(self.contacts.pairs->bufferTable(), "");
  if (self.contacts.volume) add(self.contacts.volume->bufferTable(), "");
  std::vector<BufferContent> contents;
  for (const auto& [name, buffer] : buffers) {
    std::vector<std::byte> bytes(buffer->bytes());
    if (Status read = buffer->download(bytes); !read) return read.error();
    contents.push_back({name, std::move(bytes)});
  }
  return contents;
}

std::vector<std::string> Diagnostics::recordedFrame() const {
  FramesInFlight& frames = hair_->self_->frames;
  return frames.slotOf(std::max<std::uint64_t>(frames.submitted, 1) - 1).recorder.recorded();
}

DeviceMemory Diagnostics::memory() const {
  const Simulation::Implementation& self = *hair_->self_;
  DeviceMemory memory;
  for (const FrameInput* input : self.inputs.each()) input->addTo(memory);
  memory.particles += self.buffers.particleBytes();
  memory.strands += self.buffers.strandBytes();
  memory.shared = self.buffers.sharedBytes();
  const HairContacts& contacts = self.contacts;
  if (contacts.pairs)
    memory.contacts = contacts.pairs->bytes(), memory.contactLists = contacts.pairs->listBytes();
  if (contacts.volume) memory.volume = contacts.volume->bytes();
  if (contacts.divided) memory.frames += contacts.divided->bytes();
  memory.world += self.buffers.contactControl.bytes();
  for (const FrameSlot& slot : self.frames.slots) memory.frames += slot.bytes();
  return memory;
}

std::string Diagnostics::kernels() const { return hair_->self_->describeKernels(); }
std::size_t Diagnostics::rigidStrandCount() const {
  return hair_->self_->inputs.get<RigidHair>().strandCount();
}

std::map<std::string, double> Diagnostics::stageMilliseconds() const { return hair_->self_->times.stages; }
HostMilliseconds Diagnostics::hostMilliseconds() const { return hair_->self_->times.host; }
double Diagnostics::compileMilliseconds() const { return hair_->self_->times.compileMilliseconds; }

std::vector<StageSpan> Diagnostics::frameStages() const {
  const gpu::Recorder& recorder = hair_->self_->waitedSlot().recorder;
  std::vector<StageSpan> spans;
  for (std::size_t i = 0; i < recorder.stageStarts().size(); ++i) {
    const auto& [stage, milliseconds] = recorder.stageMilliseconds()[i];
    spans.push_back({stage, recorder.stageStarts()[i], milliseconds});
  }
  return spans;
}

}  // namespace ringlet
