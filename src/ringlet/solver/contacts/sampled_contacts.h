// The sample of contact particles that decides in each step whether lists are kept (contact_sample.comp), for
// divided hair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/rest/rest_contacts.h"

namespace ringlet {

/// The argument of sampledContact (shaders/shared/contact_buffers.glsl).
struct SampledContacts {
  std::vector<std::uint32_t> list;  // for each remainder the index in `list` of its first contact particle;
                                    // the end; then the contact particles
  std::uint32_t most = 0;           // contact particles of one remainder
};

/// Contact particles of the first `hereCount` strands of a part, by their index in the whole groom modulo
/// `stride`, so that all parts together sample the same ones as undivided hair. Cost: linear.
SampledContacts sampledContacts(const RestContacts& contacts, std::size_t hereCount, std::uint32_t stride);

}  // namespace ringlet
