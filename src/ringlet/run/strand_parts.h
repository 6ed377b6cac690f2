// How strands are divided into parts among devices (solver/part_link.h). Strands that may touch stay
// together, so that parts exchange little data (rest/rest_halo.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/whole_rest.h"
#include "ringlet/run/strand_graph.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// Whether this build has METIS (Debian: libmetis-dev).
bool hasMetis();

/// The part of each strand, device order: consecutive ranges of about equal weight.
std::vector<std::int32_t> partsAlongCurve(const StrandGraph& graph, int count);
/// The part of each strand by METIS, with a fixed seed: recursive bisection, or k-way (byWays). Needs
/// hasMetis() and at least two parts.
std::vector<std::int32_t> partsByMetis(const StrandGraph& graph, int count, bool byWays);

/// The weight of the heaviest part over the mean.
double imbalance(const StrandGraph& graph, std::span<const std::int32_t> parts, int count);

/// The strands of each of `count` parts, groom order, each strand in one part. With contacts pair by pair: by
/// METIS, k-way if bisection leaves an imbalance above 1.05; without METIS in ranges of device order.
/// Otherwise they are dealt out by length. `rest`: of the groom with these settings. Errors: fewer strands
/// than parts. Cost with contacts: that of METIS, 10 ms for 1,500 strands, 0.3 s for 20,000.
Result<std::vector<std::vector<std::uint32_t>>> divideStrands(const Groom& groom, const Settings& settings,
                                                              const WholeRest& rest, std::size_t count);

}  // namespace ringlet
