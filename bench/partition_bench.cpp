// What it would take to send only a halo between the parts of one groom: strands over parts by ranges of the
// curve that orders them in memory, by the paper's greedy swaps from there (Iben et al. 2012, section 4), and
// by METIS where it is installed. Halo: strands of other parts that own ones may touch, over own ones.
// Verified before it is told: every strand is in one part, and the cut is the sum of its edges'. Run:
// build/release/bench/partition_bench [STRANDS [SCALP_RADIUS_M]]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/clocks.h"
#include "ringlet/groom/generate.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/strand_order.h"
#include "ringlet/run/strand_graph.h"
#include "ringlet/run/strand_parts.h"

namespace {

using namespace ringlet;

constexpr double kMostImbalance = 1.03;

using Graph = StrandGraph;
using Parts = std::vector<std::int32_t>;  // of each strand

// Pairs of strands in two parts change places as long as that cuts less and no part becomes too heavy.
Parts swapped(const Graph& graph, int count) {
  constexpr int kPasses = 60;
  constexpr std::size_t kPartners = 12;
  Parts parts = partsAlongCurve(graph, count);
  std::vector<double> weights(std::size_t(count), 0.0);
  for (std::size_t s = 0; s < parts.size(); ++s) weights[std::size_t(parts[s])] += graph.weights[s];
  const double heaviest = kMostImbalance * std::accumulate(weights.begin(), weights.end(), 0.0) / count;
  // Overlaps of a strand with those of a part.
  const auto with = [&](std::size_t s, std::int32_t part) {
    std::int64_t sum = 0;
    for (std::int32_t k = graph.first[s]; k < graph.first[s + 1]; ++k)
      if (parts[std::size_t(graph.neighbours[std::size_t(k)])] == part) sum += graph.overlaps[std::size_t(k)];
    return sum;
  };
  const auto gainOf = [&](std::size_t s, std::int32_t to) { return with(s, to) - with(s, parts[s]); };
  const auto tryPair = [&](std::size_t s, std::size_t t, std::int64_t gainOfS) {
    const auto here = graph.neighboursOf(s);
    const auto at = std::ranges::find(here, std::int32_t(t));
    const std::int64_t between =
        at == here.end() ? 0 : graph.overlaps[std::size_t(graph.first[s] + (at - here.begin()))];
    if (gainOfS + gainOf(t, parts[s]) - 2 * between <= 0) return false;
    const double moved = graph.weights[t] - graph.weights[s];
    double& mine = weights[std::size_t(parts[s])];
    double& others = weights[std::size_t(parts[t])];
    if (mine + moved > heaviest || others - moved > heaviest) return false;
    mine += moved, others -= moved;
    std::swap(parts[s], parts[t]);
    return true;
  };
  for (int pass = 0; pass < kPasses; ++pass) {
    std::size_t swaps = 0;
    for (std::size_t s = 0; s < parts.size(); ++s) {
      std::vector<std::int64_t> withPart(std::size_t(count), 0);
      for (std::int32_t k = graph.first[s]; k < graph.first[s + 1]; ++k)
        withPart[std::size_t(parts[std::size_t(graph.neighbours[std::size_t(k)])])] +=
            graph.overlaps[std::size_t(k)];
      const std::int64_t mine = std::exchange(withPart[std::size_t(parts[s])], 0);
      const auto most = std::ranges::max_element(withPart);
      const auto best = std::int32_t(most - withPart.begin());
      const std::int64_t gain = *most - mine;
      if (*most == 0) continue;
      std::size_t tried = 0;
      for (const std::int32_t t : graph.neighboursOf(s)) {
        if (parts[std::size_t(t)] != best) continue;
        if (tryPair(s, std::size_t(t), gain)) {
          ++swaps;
          break;
        }
        if (++tried == kPartners) break;
      }
    }
    if (swaps * 5000 < parts.size()) break;
  }
  return parts;
}

struct Measures {
  double cut = 0, halo = 0, imbalance = 0;  // shares
};
Result<Measures> measure(const Graph& graph, const Parts& parts, int count) {
  double all = 0, cut = 0, halo = 0;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (parts[s] < 0 || parts[s] >= count) return Error{fmt::format("strand {} is in part {}", s, parts[s])};
    std::vector<bool> isIn(std::size_t(count), false);
    for (std::int32_t k = graph.first[s]; k < graph.first[s + 1]; ++k) {
      const std::int32_t other = parts[std::size_t(graph.neighbours[std::size_t(k)])];
      all += graph.overlaps[std::size_t(k)];
      if (other == parts[s]) continue;
      cut += graph.overlaps[std::size_t(k)];
      halo += isIn[std::size_t(other)] ? 0 : 1;
      isIn[std::size_t(other)] = true;
    }
  }
  return Measures{all > 0 ? cut / all : 0, halo / double(parts.size()), imbalance(graph, parts, count)};
}

struct Way {
  std::string name;
  std::function<Parts(const Graph&, int)> divide;
};
std::vector<Way> ways() {
  std::vector<Way> all{{"curve", partsAlongCurve}, {"swaps", swapped}};
  if (hasMetis()) {
    all.push_back({"METIS", [](const Graph& graph, int count) { return partsByMetis(graph, count, false); }});
    all.push_back(
        {"METIS k-way", [](const Graph& graph, int count) { return partsByMetis(graph, count, true); }});
  } else {
    fmt::print("METIS was not there when this was built (Debian: libmetis-dev): without it.\n");
  }
  return all;
}

Status tell(const Graph& graph, const std::vector<Way>& all) {
  fmt::print("| parts | way | cut | halo | imbalance | ms |\n|---|---|---|---|---|---|\n");
  for (const int count : {2, 4, 8, 16, 64}) {
    if (std::size_t(count) * 4 > graph.strandCount()) break;
    for (const Way& way : all) {
      const double start = bench::wallSeconds();
      const Parts parts = way.divide(graph, count);
      const double seconds = bench::wallSeconds() - start;
      const auto measured = measure(graph, parts, count);
      if (!measured) return measured.error();
      fmt::print("| {} | {} | {:.1f} % | {:.2f} | {:.2f} | {:.0f} |\n", count, way.name, 100 * measured->cut,
                 measured->halo, measured->imbalance, 1e3 * seconds);
    }
  }
  return {};
}

Status run(int strands, double scalpRadius) {
  HeadParameters head{.strandCount = strands};
  head.scalpRadius = scalpRadius;
  const auto groom = makeHead(head);
  if (!groom) return groom.error();
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  const auto rest = buildRestState(*groom, {}, settings, orderAlongCurve(*groom));
  if (!rest) return rest.error();
  const std::vector<Way> all = ways();
  struct Pruning {
    const char* name;
    int minOverlaps, maxNeighbours;
  };
  const ContactSettings usual;
  for (const Pruning& pruning :
       {Pruning{"all that overlap", 1, usual.maxNeighbours},
        Pruning{"as by default", usual.minOverlaps, usual.maxNeighbours},
        Pruning{"32 neighbours", usual.minOverlaps, 32}, Pruning{"8 neighbours", usual.minOverlaps, 8}}) {
    settings.contacts.prunePairs = true;
    settings.contacts.minOverlaps = pruning.minOverlaps;
    settings.contacts.maxNeighbours = pruning.maxNeighbours;
    const RestContacts contacts = buildRestContacts(*rest, settings.contacts);
    const Graph graph = strandGraph(*rest, contacts);
    fmt::print("\n{} strands, {}: {} pairs, {:.1f} neighbours a strand, {} contact particles\n", strands,
               pruning.name, contacts.graph.pairs, double(graph.neighbours.size()) / strands,
               contacts.particleCount);
    if (Status status = tell(graph, all); !status) return status;
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const int strands = argc > 1 ? std::atoi(argv[1]) : 1500;
  const double radius = argc > 2 ? std::atof(argv[2]) : HeadParameters{}.scalpRadius;
  if (const Status status = run(strands, radius); !status) {
    fmt::print(stderr, "partition_bench: {}\n", status.error().message);
    return 1;
  }
}
