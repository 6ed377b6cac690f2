// Implements crossings/crossing_step.h.
#include "ringlet/crossings/crossing_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ringlet/base/in_parallel.h"
#include "ringlet/crossings/crossing_spread.h"
#include "ringlet/crossings/crossing_ties.h"

namespace ringlet {
namespace {

constexpr double kGap = 1e-4;   // that pairs keep, if they had it [m]
constexpr double kSlack = 0.5;  // share of what it aims at that a pair which cannot cross may lack
// A pair that ends nearer, and at less than half of what it had, may cross [m].
constexpr double kLeastGap = 1e-5;
constexpr double kCrossingReach = 1e-3;  // of lists [m]
constexpr double kListRound = 1e-6;      // of it, for rounding [m]
constexpr double kWidestSpread = 0.25;   // of a strand's edges: in the first passes
constexpr int kSpreadLevels = 5;         // each half as wide; the last spreads nothing
constexpr double kRelax = 1.9;           // below 2
constexpr int kLastRounds = 4;           // times as many rounds in all, the last without pushes
constexpr double kUnchanged = 1e-7;      // [m]: a way that differs by less counts as it was
constexpr double kNoShortfall = 1e-9;    // [m]
constexpr double kLeastShare = 1e-3;  // of a pair's four shares, 2 in all: less that is free cannot be pushed

// Which way p goes, q the other way; by how much, and the shares of p's ends and q's.
struct Push {
  Vec3d along{};
  double shortfall = 0;  // [m]; 0: it does not push
  std::array<double, 4> shares{};
};

// work(begin, end) for all pairs, on as many threads as they are worth.
template <class Work>
void eachPart(std::size_t pairs, const Work& work) {
  constexpr std::size_t kPart = 1024;
  SharedParts parts(pairs, kPart);
  const auto worth = static_cast<unsigned>(std::min<std::size_t>(pairs / kPart + 1, coreCount()));
  inParallel(worth, [&] { parts.take(work); });
}

class CrossingStep {
 public:
  CrossingStep(const CrossingHair& hair, const Quatd& turn, const std::vector<Vec3d>& from,
               const std::vector<Vec3d>& wanted, const CrossingEffort& effort)
      : effort_(effort),
        hair_(hair),
        turn_(turn),
        from_(from),
        wanted_(wanted),
        to_(wanted),
        ties_(hair, turn, from) {}

  void push();
  // Whether nothing may cross.
  bool tie();
  void moveAsHead();
  void measure();

  const std::vector<Vec3d>& placed() const { return to_; }
  CrossingReport report;

 private:
  PairVerdict judge(const EdgePair& pair) const {
    const CrossingWays ways{from_, to_};
    return judgePair(ways.of(pair.p), ways.of(pair.q), pair.demand);
  }
  Push pushOf(const EdgePair& pair) const;
  std::vector<Push> pushes() const;
  double spreadOf(int pass) const;
  bool pushOnce(double share);
  double longestOf(std::size_t edge) const;
  void shorten(std::vector<Vec3d>& to) const;
  void keepListed();
  void place();
  std::vector<EdgePair> unsafePairs() const;

  const CrossingEffort& effort_;
  const CrossingHair& hair_;
  Quatd turn_;
  const std::vector<Vec3d>&from_, &wanted_;
  std::vector<Vec3d> to_;      // the ways so far [m]
  std::vector<Vec3d> listed_;  // those that the list was made for [m]
  std::vector<EdgePair> pairs_;
  CrossingTies ties_;
};

void CrossingStep::keepListed() {
  bool holds = !listed_.empty();
  for (std::size_t i = 0; holds && i < to_.size(); ++i)
    holds = length(to_[i] - listed_[i]) <= kCrossingReach - kListRound;
  if (holds) return;
  pairs_ = listCrossingPairs(hair_, {from_, to_}, kCrossingReach, kGap, kLeastGap);
  listed_ = to_;
}

Push CrossingStep::pushOf(const EdgePair& pair) const {
  const PairVerdict verdict = judge(pair);
  const double onP = verdict.at.onP, onQ = verdict.at.onQ;
  Push push{.along = verdict.at.normal, .shares = {1 - onP, onP, 1 - onQ, onQ}};
  double free = 0;
  for (std::size_t e = 0; e < 4; ++e) {
    if (!ties_.isFree(pair.ends()[e])) push.shares[e] = 0;
    free += push.shares[e];
  }
  const double allowed = verdict.isSafe ? kSlack * pair.demand.aim : kNoShortfall;
  if (verdict.shortfall > allowed && free > kLeastShare && !ties_.movesAsOne(pair))
    push.shortfall = verdict.shortfall;
  return push;
}

std::vector<Push> CrossingStep::pushes() const {
  std::vector<Push> all(pairs_.size());
  eachPart(pairs_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) all[k] = pushOf(pairs_[k]);
  });
  return all;
}

double CrossingStep::spreadOf(int pass) const {
  const int level = pass * kSpreadLevels / std::max(effort_.pushPasses, 1);
  return level + 1 < kSpreadLevels ? kWidestSpread / (1 << level) : 0;
}

// Whether any pair pushed.
bool CrossingStep::pushOnce(double share) {
  const std::vector<Push> pushes = this->pushes();
  std::vector<double> rows(from_.size());
  bool pushed = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (pushes[k].shortfall == 0) continue;
    pushed = true;
    for (std::size_t e = 0; e < 4; ++e) rows[pairs_[k].ends()[e]] += pushes[k].shares[e];
  }
  if (!pushed) return false;
  spreadAlong(hair_, share, rows);
  ties_.share(rows);
  std::vector<Vec3d> changes(from_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto ends = pairs_[k].ends();
    const Push& push = pushes[k];
    double row = 0;
    for (std::size_t e = 0; e < 4; ++e) row += push.shares[e] * rows[ends[e]];
    if (push.shortfall == 0 || !(row > 0)) continue;
    const Vec3d impulse = kRelax * push.shortfall / row * push.along;
    for (std::size_t e = 0; e < 4; ++e) changes[ends[e]] += (e < 2 ? 1 : -1) * push.shares[e] * impulse;
  }
  spreadAlong(hair_, share, changes);
  std::vector<Vec3d> next = to_;
  for (std::size_t i = 0; i < next.size(); ++i) next[i] += changes[i];
  shorten(next);
  to_ = std::move(next);
  return true;
}

// What an edge may be, or what it was without the changes.
double CrossingStep::longestOf(std::size_t edge) const {
  return std::max(hair_.maxStretch * hair_.lengths[edge], length(wanted_[edge + 1] - wanted_[edge]));
}

// Edges that are longer than they may be pull their ends together; from ways before the last push, halved
// where both edges of a particle do.
void CrossingStep::shorten(std::vector<Vec3d>& to) const {
  const auto inverse = [&](std::size_t i) { return hair_.masses[i] > 0 ? 1 / hair_.masses[i] : 0; };
  for (std::size_t s = 0; s + 1 < hair_.firstPoint.size(); ++s) {
    for (std::size_t i = hair_.firstPoint[s]; i + 1 < hair_.firstPoint[s + 1]; ++i) {
      const Vec3d edge = to_[i + 1] - to_[i];
      const double now = length(edge), longest = longestOf(i), sum = inverse(i) + inverse(i + 1);
      if (!(now > longest + kNoShortfall) || !(sum > 0)) continue;
      const Vec3d pull = 0.5 / sum * (1 - longest / now) * edge;
      to[i] += inverse(i) * pull;
      to[i + 1] -= inverse(i + 1) * pull;
    }
  }
}

void CrossingStep::push() {
  for (int pass = 0; pass < effort_.pushPasses; ++pass) {
    keepListed();
    if (!pushOnce(spreadOf(pass))) break;
  }
}

// As they will be stored.
void CrossingStep::place() {
  ties_.apply(to_);
  if (!effort_.storesFloat) return;
  for (std::size_t i = 0; i < to_.size(); ++i)
    if (hair_.masses[i] > 0) to_[i] = asStored(to_[i]);
}

std::vector<EdgePair> CrossingStep::unsafePairs() const {
  std::vector<char> isUnsafe(pairs_.size());
  eachPart(pairs_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      isUnsafe[k] = !ties_.movesAsOne(pairs_[k]) && !judge(pairs_[k]).isSafe;
  });
  std::vector<EdgePair> unsafe;
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (isUnsafe[k]) unsafe.push_back(pairs_[k]);
  return unsafe;
}

bool CrossingStep::tie() {
  for (int turn = 0, round = 0;; ++turn) {
    place();
    keepListed();
    const std::vector<EdgePair> unsafe = unsafePairs();
    if (unsafe.empty()) return true;
    const bool pushes = turn % (effort_.turnsBetweenTies + 1) < effort_.turnsBetweenTies;
    if (pushes && round < effort_.tieRounds) {
      pushOnce(0);
    } else if (round++ == kLastRounds * effort_.tieRounds) {
      return false;
    } else {
      ties_.add(unsafe, to_);
    }
  }
}

// Or leaves ways as they are, where that helps no more: roots that are moved through hair.
void CrossingStep::moveAsHead() {
  const std::vector<Vec3d> before = to_;
  const std::size_t unsafeBefore = unsafePairs().size();
  ties_.clear();
  for (std::size_t s = 0; s + 1 < hair_.firstPoint.size(); ++s) {
    if (!hair_.takes(s)) continue;
    for (std::uint32_t i = hair_.firstPoint[s]; i < hair_.firstPoint[s + 1]; ++i)
      if (hair_.masses[i] > 0) to_[i] = rotate(turn_, from_[i]);
  }
  place();
  keepListed();
  report.unsafe = unsafePairs().size();
  report.heldSteps = report.unsafe < unsafeBefore ? 1 : 0;
  if (report.heldSteps > 0) return;
  to_ = before;
  report.unsafe = unsafeBefore;
}

void CrossingStep::measure() {
  report.tied = ties_.tiedCount();
  for (std::size_t i = 0; i < to_.size(); ++i) {
    if (hair_.masses[i] == 0) continue;
    ++report.particles;
    const double change = length(to_[i] - wanted_[i]);
    if (!(change > kUnchanged)) continue;
    ++report.changed;
    report.changes += change;
    report.mostChange = std::max(report.mostChange, change);
  }
  for (std::size_t i = 0; i + 1 < to_.size(); ++i) {
    const double now = length(to_[i + 1] - to_[i]);
    if (!(hair_.lengths[i] > 0) || !(now > longestOf(i) + kUnchanged)) continue;
    ++report.stretched;
    report.mostStretch = std::max(report.mostStretch, now / hair_.lengths[i]);
  }
}

}  // namespace

void CrossingReport::add(const CrossingReport& other) {
  particles += other.particles, changed += other.changed, changes += other.changes;
  mostChange = std::max(mostChange, other.mostChange);
  tied += other.tied, stretched += other.stretched;
  mostStretch = std::max(mostStretch, other.mostStretch);
  heldSteps += other.heldSteps, unsafe += other.unsafe;
}

CrossingReport keepFromCrossing(const CrossingHair& hair, const Quatd& turn, const std::vector<Vec3d>& from,
                                std::vector<Vec3d>& to, const CrossingEffort& effort) {
  CrossingStep step(hair, turn, from, to, effort);
  step.push();
  if (!step.tie()) step.moveAsHead();
  step.measure();
  to = step.placed();
  return step.report;
}

}  // namespace ringlet
