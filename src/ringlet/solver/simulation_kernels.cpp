// Implements the strand kernels of solver/simulation.h: their choice, creation and bindings.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {
namespace {

// Ranges of one shape are consecutive.
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

// Notifies the observer, if there are one and a kernel to compile, of the beginning and, even on failure, of
// the end.
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
  const bool profiles = !rest.edgeFactors.empty();
  const bool bendVaries =
      profiles || (!material.bendStiffnessProfile.points.empty() && settings.integrator != Integrator::paper);
  const bool fitsTexels = isSeenAsTexels(
      device.gpu(), std::max({buffers.largestTexels(), world.largestBuffer(), roots.largestBuffer(),
                              forces.largestBuffer(), goals.largestBuffer(), fields.largestBuffer()}));
  return {.integrator = settings.integrator,
          .oneSmoothing = rest.oneSmoothing,
          .bendVaries = bendVaries,
          .profiles = profiles,
          .taps = choice.taps,
          .contacts = settings.contacts.on,
          .pairs = contacts.has_value(),
          .volume = volume.has_value(),
          .texels = fitsTexels,
          .residual = choice.residual,
          .bodies = asset->bodies == BodyUse::some,
          .air = settings.air.on,
          .turbulence = world.isTurbulent(),
          .movingRoots = choice.movingRoots,
          .forces = choice.forces,
          .goals = choice.goals,
          .goalShape = settings.goal.shape,
          .fields = choice.fields,
          .heads = buffers.place.has_value(),
          .subgroupSize = askedWidth(device.gpu().properties(), choice),
          .groupSize = asset->groupSize};
}

// Of what was cut off: no root carries it, and it is pulled to no place and no part of the volume.
StrandKernelOptions Simulation::Implementation::fallenOptions() const {
  StrandKernelOptions options = kernelOptions();
  options.falls = true;
  options.volume = options.movingRoots = options.goals = options.goalShape = options.heads = false;
  return options;
}

// The shapes whose kernels no earlier simulation has made on this device.
std::vector<std::size_t> Simulation::Implementation::newKernels(const StrandKernels& of,
                                                                const StrandKernelOptions& options) const {
  const std::vector<StrandShape> shapes = shapesOf(of.ranges);
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (!gpu::Kernel::isCompiled(device.gpu(), describeStrandKernel(shapes[k], options))) found.push_back(k);
  }
  return found;
}

// Compiles several kernels at a time.
Status Simulation::Implementation::create(StrandKernels& of, const StrandKernelOptions& options) const {
  if (of.ranges.empty()) return {};
  const std::vector<StrandShape> shapes = shapesOf(of.ranges);
  auto made = createStrandKernels(device.gpu(), shapes, options);
  if (!made) return made.error();
  of.kernels = std::move(*made);
  of.areOfHeads = options.heads;
  of.areFallen = options.falls;
  of.kernelOf.clear();
  for (const StrandRange& range : of.ranges)
    of.kernelOf.push_back(static_cast<std::size_t>(std::ranges::find(shapes, range.shape) - shapes.begin()));
  return {};
}

// Makes the kernels and compiles them by an empty dispatch, since some drivers compile only then. Kernels
// that an earlier simulation has made on this device are ready.
Status Simulation::Implementation::makeKernels() {
  if (ranges.empty()) return {};
  const auto start = std::chrono::steady_clock::now();
  const StrandKernelOptions options = kernelOptions();
  StrandKernelOptions ofFirstSolve = options;
  ofFirstSolve.bodies = false;
  const std::vector<std::size_t> newOnes = newKernels(strandKernels, options);
  const std::vector<std::size_t> newFirst = newKernels(firstSolveKernels, ofFirstSolve);
  const std::size_t newCount = newOnes.size() + newFirst.size() +
                               (contacts ? contacts->newKernelCount() : 0) +
                               (volume ? volume->newKernelCount() : 0);
  const CompileNotice notice(choice.observer, newCount);
  if (Status status = create(strandKernels, options); !status) return status;
  if (Status status = create(firstSolveKernels, ofFirstSolve); !status) return status;
  if (Status status = bindKernels(); !status) return status;

  if (newCount > 0) {
    auto recorder = gpu::Recorder::create(device.gpu(), "compile");
    if (!recorder) return recorder.error();
    if (Status status = recorder->begin(); !status) return status;
    dispatchNothing(*recorder, strandKernels, newOnes);
    dispatchNothing(*recorder, firstSolveKernels, newFirst);
    if (contacts) contacts->recordNothing(*recorder);
    if (volume) volume->recordNothing(*recorder);
    if (Status status = recorder->submitAndWait(); !status) return status;
  }
  compileMilliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return {};
}

Status Simulation::Implementation::bindKernels() {
  if (Status status = bindKernels(strandKernels); !status) return status;
  if (Status status = bindKernels(firstSolveKernels); !status) return status;
  return bindKernels(fallenKernels);
}

gpu::BufferTable Simulation::Implementation::bufferTable(std::size_t chunk) const {
  gpu::BufferTable table = buffers.bufferTable(chunk);
  table.merge(world.bufferTable());
  table.merge(roots.bufferTable(chunk));
  table.merge(forces.bufferTable(chunk));
  table.merge(goals.bufferTable(chunk));
  table.merge(fields.bufferTable());
  return table;
}

Status Simulation::Implementation::bindKernels(StrandKernels& of) {
  of.bindings.clear();
  of.ofHeads.clear();
  for (std::size_t r = 0; r < of.ranges.size(); ++r) {
    const std::size_t chunk = of.ranges[r].chunk;
    gpu::BufferTable table;
    if (of.areFallen)
      table = {{layout::kBindStrands, fallenChunks[chunk].strands},
               {layout::kBindStrandTexels, fallenChunks[chunk].strands},
               {layout::kBindReports, fallenChunks[chunk].reports}};
    table.merge(bufferTable(chunk));
    auto bound = gpu::Bindings::create(*of.kernels[of.kernelOf[r]], table);
    if (!bound) return bound.error();
    of.bindings.push_back(std::move(*bound));
  }
  return {};
}

Status Simulation::Implementation::bindHeads(std::uint32_t heads) {
  if (heads < 2 || strandKernels.ofHeads.contains(heads)) return {};
  auto part = buffers.place->part(heads);
  if (!part) return part.error();
  BoundHeads bound{std::move(*part), {}};
  gpu::BufferTable table = bound.buffers.bufferTable();
  table.merge(bufferTable(0));
  for (const std::size_t kernel : strandKernels.kernelOf) {
    auto bindings = gpu::Bindings::create(*strandKernels.kernels[kernel], table);
    if (!bindings) return bindings.error();
    bound.bindings.push_back(std::move(*bindings));
  }
  strandKernels.ofHeads.emplace(heads, std::move(bound));
  return {};
}

void Simulation::Implementation::dispatchNothing(gpu::CommandList& list, const StrandKernels& of,
                                                 std::span<const std::size_t> newKernels) const {
  for (const std::size_t k : newKernels) {
    const auto range = static_cast<std::size_t>(std::ranges::find(of.kernelOf, k) - of.kernelOf.begin());
    list.dispatchNothing(*of.kernels[k], of.bindings[range]);
  }
}

double Simulation::compileMilliseconds() const { return self_->compileMilliseconds; }

std::string Simulation::kernelDescription() const {
  if (self_->ranges.empty()) return "none: all strands are carried rigidly";
  const auto width = static_cast<std::uint32_t>(self_->choice.subgroupSize);
  return describe(shapesOf(self_->ranges), width ? width : self_->device.gpu().properties().subgroupSize);
}

}  // namespace ringlet
