// Implements the strand kernels of solver/simulation.h: their choice, creation and bindings, and adding
// features to them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {
namespace {

// The shapes of the ranges; ranges of equal shape are consecutive.
std::vector<StrandShape> shapesOf(std::span<const StrandRange> ranges) {
  std::vector<StrandShape> shapes;
  for (const StrandRange& range : ranges) {
    if (shapes.empty() || shapes.back() != range.shape) shapes.push_back(range.shape);
  }
  return shapes;
}

std::string describe(std::span<const StrandShape> shapes, std::uint32_t subgroupSize) {
  std::string text;
  for (const StrandShape& shape : shapes) text += (text.empty() ? "" : ", ") + shape.describe();
  return fmt::format("{} (subgroup {})", text, subgroupSize);
}

// The subgroup width that kernels ask the driver for; 0 for the device's default.
std::uint32_t askedWidth(const gpu::DeviceProperties& device, const KernelChoice& choice) {
  const auto width = static_cast<std::uint32_t>(choice.subgroupSize);
  return device.canChooseSubgroupSize && width != device.subgroupSize ? width : 0;
}

// Notifies the observer of the beginning and, even after a failure, of the end; only if there is an observer
// and a kernel to compile.
class CompileNotice {
 public:
  CompileNotice(CompileObserver* observer, std::size_t kernelCount)
      : observer_(kernelCount > 0 ? observer : nullptr) {
    if (observer_) observer_->begin(kernelCount);
  }
  ~CompileNotice() {
    if (observer_) observer_->end();
  }
  CompileNotice(const CompileNotice&) = delete;

 private:
  CompileObserver* observer_;
};

}  // namespace

StrandKernelOptions Simulation::Implementation::kernelOptions() const {
  const bool profiles = !rest().edgeFactors.empty();
  const bool bendVaries =
      profiles || (!material.bendStiffnessProfile.points.empty() && settings.integrator != Integrator::paper);
  const Features& uses = featurePlan->features;
  std::uint64_t largest = buffers.largestTexels();
  for (const FrameInput* input : inputs.each()) largest = std::max(largest, input->largestBuffer());
  return {.integrator = settings.integrator,
          .oneSmoothing = rest().oneSmoothing,
          .bendVaries = bendVaries,
          .profiles = profiles,
          .taps = asset->choice.taps,
          .contacts = settings.contacts.on,
          .pairs = contacts.pairs.has_value(),
          .volume = contacts.volume.has_value(),
          .texels = isSeenAsTexels(device().gpu(), largest),
          .residual = asset->choice.residual,
          .bodies = uses.bodies,
          .bends = inputs.get<BodiesInput>().bends(),
          .clothTurns = inputs.get<BodiesInput>().isCloth() ? clothTurns(asset->limits) : 0,
          .air = settings.air.on,
          .turbulence = inputs.get<AirInput>().isTurbulent(),
          .movingRoots = uses.roots,
          .forces = uses.forces,
          .goals = uses.goals,
          .goalShape = settings.goal.shape,
          .fields = uses.fields,
          .heads = buffers.place.has_value() && !uses.any(),
          .subgroupSize = askedWidth(device().gpu().properties(), asset->choice),
          .groupSize = featurePlan->groupSize};
}

// Options for fallen hair: it has no root pose and no goal, and is not part of the volume.
StrandKernelOptions Simulation::Implementation::fallenOptions() const {
  StrandKernelOptions options = kernelOptions();
  options.falls = true;
  options.volume = options.movingRoots = options.goals = options.goalShape = options.heads = false;
  return options;
}

// Indices of the shapes whose kernels no earlier simulation has made on this device.
std::vector<std::size_t> Simulation::Implementation::newKernels(const StrandKernels& of,
                                                                const StrandKernelOptions& options) const {
  const std::vector<StrandShape> shapes = shapesOf(*of.ranges);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!gpu::Kernel::isCompiled(device().gpu(), describeStrandKernel(shapes[k], options)))
      found.push_back(k);
  }
  return found;
}

// Makes the kernels, compiling several at a time.
Status Simulation::Implementation::create(StrandKernels& of, const StrandKernelOptions& options) const {
  if (of.ranges->empty()) return {};
  const std::vector<StrandShape> shapes = shapesOf(*of.ranges);
  auto made = createStrandKernels(device().gpu(), shapes, options);
  if (!made) return made.error();
  of.kernels = std::move(*made);
  of.cloth = nullptr;
  if (options.bodies && options.clothTurns > 0) {
    auto cloth = createClothKernel(device().gpu(), options);
    if (!cloth) return cloth.error();
    of.cloth = std::move(*cloth);
  }
  of.areOfHeads = options.heads;
  of.areFallen = options.falls;
  of.kernelOf.clear();
  for (const StrandRange& range : *of.ranges)
    of.kernelOf.push_back(static_cast<std::size_t>(std::ranges::find(shapes, range.shape) - shapes.begin()));
  return {};
}

// Makes the kernels and compiles them by an empty dispatch, since some drivers compile only then. Kernels
// that an earlier simulation has made on this device are ready.
Status Simulation::Implementation::makeKernels() {
  if (featurePlan->ranges.empty()) return {};
  const auto start = std::chrono::steady_clock::now();
  const StrandKernelOptions options = kernelOptions();
  StrandKernelOptions ofFirstSolve = options;
  ofFirstSolve.bodies = false;
  const std::vector<std::size_t> newOnes = newKernels(kernels.strands, options);
  const std::vector<std::size_t> newFirst = newKernels(kernels.firstSolve, ofFirstSolve);
  const bool isFirst = !kernels.strands.areThere();  // then the kernels of contacts may be new too
  const std::size_t newCount = newOnes.size() + newFirst.size() +
                               (isFirst && contacts.pairs ? contacts.pairs->newKernelCount() : 0) +
                               (isFirst && contacts.volume ? contacts.volume->newKernelCount() : 0);
  const CompileNotice notice(asset->choice.observer, newCount);
  if (Status status = create(kernels.strands, options); !status) return status;
  if (Status status = create(kernels.firstSolve, ofFirstSolve); !status) return status;
  if (Status status = create(kernels.fallen, fallenOptions()); !status) return status;
  if (Status status = bindKernels(); !status) return status;

  if (newCount > 0) {
    auto recorder = gpu::Recorder::create(device().gpu(), "compile");
    if (!recorder) return recorder.error();
    if (Status status = recorder->begin(); !status) return status;
    dispatchNothing(*recorder, kernels.strands, newOnes);
    dispatchNothing(*recorder, kernels.firstSolve, newFirst);
    if (isFirst && contacts.pairs) contacts.pairs->recordNothing(*recorder);
    if (isFirst && contacts.volume) contacts.volume->recordNothing(*recorder);
    if (Status status = recorder->submitAndWait(); !status) return status;
  }
  times.compileMilliseconds +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return {};
}

// Adds features to those that this hair uses already.
Status Simulation::Implementation::prepare(const Features& wanted) {
  const Features all = featurePlan->features | wanted;
  if (all == featurePlan->features) return {};
  auto grown = asset->plan(all);
  if (!grown) return grown.error();
  if (Status status = finishFrames(); !status) return status;
  featurePlan = std::move(*grown);
  Status status = grow();
  if (!status) frames.lost = status.error();
  return status;
}

// Makes what the new plan of features needs and the old one did not.
Status Simulation::Implementation::grow() {
  for (FrameInput* input : inputs.each()) {
    if (Status status = input->prepare(inputSource()); !status) return status;
  }
  if (Status status = inputs.get<FallenHair>().reshape(device().gpu(), featurePlan->ranges); !status)
    return status;
  kernels.strands.ranges = &featurePlan->ranges;
  kernels.firstSolve.ranges = &featurePlan->firstRanges;
  if (Status status = makeKernels(); !status) return status;
  stillness.wake();
  frames.forgetRecordings();
  return fallen().pieces().empty() ? Status{} : renewConstants();
}

Status Simulation::Implementation::bindKernels() {
  if (Status status = bindKernels(kernels.strands); !status) return status;
  if (Status status = bindKernels(kernels.firstSolve); !status) return status;
  return bindKernels(kernels.fallen);
}

gpu::BufferTable Simulation::Implementation::bufferTable(std::size_t chunk) const {
  gpu::BufferTable table = buffers.bufferTable(chunk);
  for (const FrameInput* input : inputs.each()) table.merge(input->bufferTable(chunk));
  return table;
}

Status Simulation::Implementation::bindKernels(StrandKernels& of) {
  of.bindings.clear();
  of.clothBindings.clear();
  of.ofHeads.clear();
  for (std::size_t r = 0; r < of.ranges->size(); ++r) {
    const std::size_t chunk = (*of.ranges)[r].chunk;
    gpu::BufferTable table = of.areFallen ? fallen().pieceTable(chunk) : gpu::BufferTable{};
    table.merge(bufferTable(chunk));
    auto bound = gpu::Bindings::create(*of.kernels[of.kernelOf[r]], table);
    if (!bound) return bound.error();
    of.bindings.push_back(std::move(*bound));
    if (!of.cloth) continue;
    auto ofCloth = gpu::Bindings::create(*of.cloth, table);
    if (!ofCloth) return ofCloth.error();
    of.clothBindings.push_back(std::move(*ofCloth));
  }
  return {};
}

Status Simulation::Implementation::bindHeads(std::uint32_t heads) {
  if (heads < 2 || kernels.strands.ofHeads.contains(heads)) return {};
  auto part = buffers.place->part(heads);
  if (!part) return part.error();
  BoundHeads bound{std::move(*part), {}};
  gpu::BufferTable table = bound.buffers.bufferTable();
  table.merge(bufferTable(0));
  for (const std::size_t kernel : kernels.strands.kernelOf) {
    auto bindings = gpu::Bindings::create(*kernels.strands.kernels[kernel], table);
    if (!bindings) return bindings.error();
    bound.bindings.push_back(std::move(*bindings));
  }
  kernels.strands.ofHeads.emplace(heads, std::move(bound));
  return {};
}

void Simulation::Implementation::dispatchNothing(gpu::CommandList& list, const StrandKernels& of,
                                                 std::span<const std::size_t> newKernels) const {
  for (const std::size_t k : newKernels) {
    const auto range = static_cast<std::size_t>(std::ranges::find(of.kernelOf, k) - of.kernelOf.begin());
    list.dispatchNothing(*of.kernels[k], of.bindings[range]);
  }
}

std::string Simulation::Implementation::describeKernels() const {
  if (featurePlan->ranges.empty()) return "none: all strands are carried rigidly";
  const auto width = static_cast<std::uint32_t>(asset->choice.subgroupSize);
  return describe(shapesOf(featurePlan->ranges), width ? width : device().gpu().properties().subgroupSize);
}

}  // namespace ringlet
