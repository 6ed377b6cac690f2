// Implements kernels_list.h.
#include "program/device/kernels_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "program/device/planned_shapes.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "ringlet/solver/contacts/volume_kernels.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet::program {
namespace {

// Kinds of work of the strand kernels, with their variants (strand_kernels.cpp).
struct Work {
  const char* name;
  StrandWork shapes;
  StrandKernelOptions options;
};
std::vector<Work> strandWorks() {
  return {{"hair alone", StrandWork::hairAlone, {.oneSmoothing = true}},
          {"stiffness that varies", StrandWork::plain, {.oneSmoothing = true, .bendVaries = true}},
          {"profiles", StrandWork::plain, {.oneSmoothing = true, .bendVaries = true, .profiles = true}},
          {"contacts", StrandWork::plain, {.oneSmoothing = true, .contacts = true}},
          {"a volume",
           StrandWork::volume,
           {.oneSmoothing = true, .contacts = true, .pairs = false, .volume = true}},
          {"air", StrandWork::plain, {.oneSmoothing = true, .air = true, .turbulence = true}},
          {"bodies", StrandWork::bodies, {.oneSmoothing = true, .bodies = true}},
          {"bodies in air",
           StrandWork::bodies,
           {.oneSmoothing = true, .bodies = true, .air = true, .turbulence = true}},
          {"point_jacobi", StrandWork::plain, {.integrator = Integrator::pointJacobi, .oneSmoothing = true}},
          {"paper", StrandWork::plain, {.integrator = Integrator::paper, .oneSmoothing = true}}};
}

}  // namespace

std::vector<ListedKernel> listKernels(const ComputeDevice& device, std::span<const StrandShape> shapes) {
  const bool texels = isSeenAsTexels(device.gpu(), kLeastTexelBytes);
  std::vector<ListedKernel> kernels;
  const StrandShape serial{
      .lanes = 1, .particlesPerLane = std::min(64u, device.limits().longestRunInMemory), .inMemory = true};
  for (Work& work : strandWorks()) {
    work.options.texels = texels && !work.options.contacts;
    std::vector<StrandShape> ofWork(shapes.begin(), shapes.end());
    if (shapes.empty()) {
      ofWork = plannedShapes(device.limits(), work.shapes, kUsualLengths, true);
      if (std::ranges::none_of(ofWork, &StrandShape::serial)) ofWork.push_back(serial);
    }
    for (const StrandShape& shape : ofWork)
      kernels.push_back({fmt::format("strand_step, {}, {}", work.name, shape.describe()),
                         describeStrandKernel(shape, work.options)});
  }
  const auto add = [&](ContactKernel which, ContactTaper taper, const char* what) {
    const auto description = describeContactKernel(
        which, {.taper = taper, .texels = texels, .forGpu = !device.gpu().properties().isCpu});
    kernels.push_back({description.name + std::string(what), description});
  };
  using enum ContactKernel;
  for (std::size_t k = 0; k < contactKernelCount(ContactTaper::distance); ++k)
    add(static_cast<ContactKernel>(k), ContactTaper::distance, "");
  for (const ContactKernel which : {touch, life, check, next})
    add(which, ContactTaper::time, which == touch ? ", time taper" : "");
  for (std::size_t k = 0; k < kVolumeKernelCount; ++k) {
    const auto description =
        describeVolumeKernel(static_cast<VolumeKernel>(k), texels, !device.gpu().properties().isCpu);
    kernels.push_back({description.name, description});
  }
  return kernels;
}

}  // namespace ringlet::program
