// The contact particles of which a step asks whether lists may stay (contact_sample.comp), of divided hair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/rest/rest_contacts.h"

namespace ringlet {

/// For sampledContact (shaders/shared/contact_buffers.glsl).
struct SampledContacts {
  std::vector<std::uint32_t> list;  // where those of each remainder begin in it, the end, and then they
  std::uint32_t most = 0;           // of one remainder
};

/// Contact particles of the first `hereCount` strands of a part, by what their index in the whole groom
/// leaves modulo `stride`: all parts together sample those that undivided hair does. Cost: linear.
SampledContacts sampledContacts(const RestContacts& contacts, std::size_t hereCount, std::uint32_t stride);

}  // namespace ringlet
