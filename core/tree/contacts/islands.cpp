#include "core/tree/contacts/islands.h"

#include "core/base/disjoint_sets.h"
#include "core/tree/contacts/gaps.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <set>
#include <span>
#include <utility>

namespace ramus::tree {

namespace {

using PairId = std::uint32_t;
// The target of a step that brings the walkers to one place, or onto links that are together (touching_links.h).
constexpr PairId kJoint = TouchingLinks::kNone;

// A step from one pair to the next: one of the walkers goes on through a point of the tree, while the other waits.
struct Step {
    PairId to = kJoint;
    bool moves_first = false; // whether the walker on the lower link of the pair moves
    double closeness = 0.0;   // at the point between the two links
};

// The graph of all pairs, with the steps on which the two walkers stay closer than `limit`.
class Walks {
public:
    Walks(const Links& links, const TouchingLinks& touching, double limit, const LargeAllocator<std::byte>& memory)
        : links_(links), touching_(touching), limit_(limit), low_(touching.size(), memory),
          first_step_(touching.size() + 1, 0, memory), steps_(memory) {
        tbb::parallel_for(std::size_t{0}, links.size(), [&](std::size_t a) {
            for (PairId pair = touching.first(a); pair < touching.first(a + 1); ++pair) {
                low_[pair] = static_cast<std::uint32_t>(a);
                for_each_step(pair, [&](std::uint32_t, std::uint32_t, bool, double) { ++first_step_[pair + 1]; });
            }
        });
        std::partial_sum(first_step_.begin(), first_step_.end(), first_step_.begin());
        steps_.resize(first_step_.back());
        tbb::parallel_for(PairId{0}, static_cast<PairId>(size()), [&](PairId pair) {
            Step* step = steps_.data() + first_step_[pair];
            for_each_step(pair, [&](std::uint32_t moved, std::uint32_t waiting, bool first, double closeness) {
                *step++ = {touching_.find(moved, waiting), first, closeness};
            });
        });
    }

    [[nodiscard]] std::size_t size() const { return low_.size(); }
    [[nodiscard]] std::uint32_t low(PairId pair) const { return low_[pair]; }
    [[nodiscard]] std::uint32_t high(PairId pair) const { return touching_.other(pair).link; }
    [[nodiscard]] double closeness(PairId pair) const { return static_cast<double>(touching_.other(pair).closeness); }
    [[nodiscard]] std::span<const Step> steps(PairId pair) const {
        return std::span(steps_).subspan(first_step_[pair], first_step_[pair + 1] - first_step_[pair]);
    }

private:
    // Calls call(the link to which one walker goes on, the link of the other, whether the first one moves, the
    // closeness on the way).
    template <class Call> void for_each_step(PairId pair, const Call& call) const {
        for (const bool first : {true, false}) {
            const std::uint32_t moving = first ? low(pair) : high(pair), waiting = first ? high(pair) : low(pair);
            const Link link = links_[moving];
            for (const bool at_end : {false, true}) {
                const double on_the_way = tree::closeness(at_end ? link.b : link.a, links_[waiting]);
                if (on_the_way >= limit_) continue;
                for (const std::uint32_t next : links_.at(at_end ? link.to : link.from))
                    if (next != moving) call(next, waiting, first, on_the_way);
            }
        }
    }

    const Links& links_;
    const TouchingLinks& touching_;
    double limit_;
    LargeArray<std::uint32_t> low_;        // by pair: its lower link
    LargeArray<std::uint32_t> first_step_; // by pair, and the end
    LargeArray<Step> steps_;
};

enum class Mark : std::uint8_t { kUnknown, kTogether, kInRegion }; // of pairs
using Marks = LargeArray<Mark>;

// Marks the pairs from which a joint can be reached while the two walkers stay closer than `limit`.
Marks mark_together(const Walks& walks, double limit, const LargeAllocator<std::byte>& memory) {
    Marks mark(walks.size(), Mark::kUnknown, memory);
    std::vector<PairId> open;
    const auto reach = [&](PairId pair) {
        if (mark[pair] == Mark::kUnknown) mark[pair] = Mark::kTogether, open.push_back(pair);
    };
    for (PairId pair = 0; pair < walks.size(); ++pair)
        for (const Step& step : walks.steps(pair))
            if (step.to == kJoint && step.closeness < limit) reach(pair);
    while (!open.empty()) {
        const PairId pair = open.back();
        open.pop_back();
        for (const Step& step : walks.steps(pair))
            if (step.to != kJoint && step.closeness < limit) reach(step.to);
    }
    return mark;
}

// Vessels that are bent, or of unequal radii, merge at a slightly larger closeness than straight ones: up to kMayMerge
// times `merged`. A basin of such a closeness is a contact if the way from it to the joints is farther by kPass.
constexpr double kMayMerge = 1.03, kPass = 0.01;

struct Region {
    std::vector<PairId> pairs;
    double closest = std::numeric_limits<double>::max();
    bool reaches_joint = false;
    bool may_hold_basins = false; // whether some pair may be closer than the way from it to the joints
};

// All unmarked pairs that can be reached from a pair. Marks them.
Region region_of(const Walks& walks, PairId start, double merged, Marks& mark) {
    Region region;
    region.pairs.push_back(start);
    mark[start] = Mark::kInRegion;
    for (std::size_t n = 0; n < region.pairs.size(); ++n) {
        const double closeness = walks.closeness(region.pairs[n]);
        double to_joint = std::numeric_limits<double>::max();
        for (const Step& step : walks.steps(region.pairs[n])) {
            if (step.to == kJoint || mark[step.to] == Mark::kTogether)
                to_joint = std::min(to_joint, step.closeness);
            else if (mark[step.to] == Mark::kUnknown)
                mark[step.to] = Mark::kInRegion, region.pairs.push_back(step.to);
        }
        region.closest = std::min(region.closest, closeness);
        region.reaches_joint |= to_joint < std::numeric_limits<double>::max();
        region.may_hold_basins |= closeness < kMayMerge * merged && to_joint >= std::max(merged, closeness + kPass);
    }
    return region;
}

struct Edge {
    double closeness;
    std::uint32_t a, b; // numbers within the region; the last: together
};

// Divides a region from which joints can be reached into basins, as a watershed transform does: visits the steps in the
// order of closeness and joins the basins that they connect. A basin that goes below `merged`, but meets the basin of
// the joints only above `merged`, stays separate: it is a contact. Returns the basin of each pair of the region (the
// size of the region stands for the joints), and for each separate basin the closeness at which it met the joints.
struct Basins {
    std::vector<std::uint32_t> of_pair;
    std::map<std::uint32_t, double> met;
};
Basins flood(const Walks& walks, const Region& region, const Marks& mark, double merged) {
    const auto count = static_cast<std::uint32_t>(region.pairs.size());
    std::map<PairId, std::uint32_t> number;
    for (std::uint32_t n = 0; n < count; ++n) number[region.pairs[n]] = n;
    std::vector<Edge> edges;
    for (std::uint32_t n = 0; n < count; ++n)
        for (const Step& step : walks.steps(region.pairs[n])) {
            if (step.to == kJoint || mark[step.to] == Mark::kTogether)
                edges.push_back({step.closeness, n, count});
            else if (const auto other = number.find(step.to); other != number.end() && other->second > n)
                edges.push_back({step.closeness, n, other->second});
        }
    std::ranges::stable_sort(edges, {}, &Edge::closeness);
    // The lowest member represents a set, so the representative of the joints changes as sets are joined.
    DisjointSets sets(count + 1);
    std::vector<double> closest(count + 1);
    for (std::uint32_t n = 0; n < count; ++n) closest[n] = walks.closeness(region.pairs[n]);
    closest[count] = 0.0;
    std::map<std::uint32_t, double> met;
    for (const Edge& edge : edges) {
        const std::uint32_t a = sets.find(edge.a);
        const std::uint32_t b = sets.find(edge.b);
        if (a == b) continue;
        const std::uint32_t joints = sets.find(count);
        const bool kept_a = met.contains(a);
        const bool kept_b = met.contains(b);
        if (a == joints || b == joints) {
            const std::uint32_t other = a == joints ? b : a;
            if (met.contains(other)) continue;
            if (closest[other] < kMayMerge * merged && edge.closeness >= std::max(merged, closest[other] + kPass)) {
                met[other] = edge.closeness;
                continue;
            }
        } else if (kept_a && kept_b) {
            continue;
        }
        const double least = std::min(closest[a], closest[b]);
        const auto kept = met.extract(kept_a ? a : b);
        sets.join(a, b);
        const std::uint32_t stands = sets.find(a);
        closest[stands] = least;
        if (!kept.empty()) met[stands] = kept.mapped();
    }
    Basins basins{std::vector<std::uint32_t>(count), met};
    const std::uint32_t joints = sets.find(count);
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::uint32_t set = sets.find(n);
        basins.of_pair[n] = set == joints ? count : set;
    }
    return basins;
}

// Orders the links of each pair of an island so that all first links belong to one vessel. A step moves only one
// walker, so the other link shows which side is which.
std::vector<OrientedPair> orient(const Walks& walks, const std::vector<PairId>& pairs) {
    std::map<PairId, int> swapped; // -1: not known yet
    for (const PairId pair : pairs) swapped[pair] = -1;
    std::vector<PairId> open;
    for (const PairId start : pairs) {
        if (swapped[start] >= 0) continue;
        swapped[start] = 0;
        open.assign(1, start);
        while (!open.empty()) {
            const PairId pair = open.back();
            open.pop_back();
            const int here = swapped[pair];
            for (const Step& step : walks.steps(pair)) {
                const auto next = swapped.find(step.to);
                if (next == swapped.end() || next->second >= 0) continue;
                // The one that waits keeps its side.
                const std::uint32_t waits = step.moves_first ? walks.high(pair) : walks.low(pair);
                const int side_of_waiting = step.moves_first ? 1 - here : here;
                next->second = walks.low(step.to) == waits ? side_of_waiting : 1 - side_of_waiting;
                open.push_back(step.to);
            }
        }
    }
    std::vector<OrientedPair> oriented;
    for (const auto& [pair, other_way] : swapped) {
        const std::uint32_t low = walks.low(pair);
        const std::uint32_t high = walks.high(pair);
        if (other_way == 1)
            oriented.push_back({{high, low}});
        else
            oriented.push_back({{low, high}});
    }
    return oriented;
}

// The islands of one region.
class RegionIslands {
public:
    RegionIslands(const Links& links, const Walks& walks, const Marks& mark, const ContactLimits& limits)
        : walks_(walks), mark_(mark), limits_(limits), gaps_(links, limits.reach) {}

    [[nodiscard]] std::vector<Island> of(const Region& region) {
        if (!region.reaches_joint)
            add(region.pairs, region.closest < limits_.bundled, limits_.reach);
        else if (!region.may_hold_basins)
            add_gaps(region.pairs);
        else
            add_basins(region);
        return std::exchange(found_, {});
    }

private:
    void add(const std::vector<PairId>& pairs, bool contact, double apart_from) {
        found_.push_back({orient(walks_, pairs), contact, false, apart_from});
    }
    // Adds the gaps between daughters among pairs that belong to the joints.
    void add_gaps(std::vector<PairId> pairs) {
        std::erase_if(pairs, [&](PairId pair) {
            return walks_.closeness(pair) < limits_.merged || !gaps_.between(walks_.low(pair), walks_.high(pair));
        });
        if (!pairs.empty()) found_.push_back({orient(walks_, pairs), false, true, 0.0});
    }
    void add_basins(const Region& region) {
        const Basins basins = flood(walks_, region, mark_, limits_.merged);
        std::map<std::uint32_t, std::vector<PairId>> members;
        for (std::size_t n = 0; n < region.pairs.size(); ++n) members[basins.of_pair[n]].push_back(region.pairs[n]);
        for (const auto& [basin, pairs] : members) {
            const auto met = basins.met.find(basin);
            if (basin == region.pairs.size())
                add_gaps(pairs);
            else
                add(pairs, true, met == basins.met.end() ? limits_.reach : met->second);
        }
    }

    const Walks& walks_;
    const Marks& mark_;
    const ContactLimits& limits_;
    Gaps gaps_;
    std::vector<Island> found_;
};

// Folds: a vessel diverges from one of the branches that meet at a node, and comes so close to another one of them that
// the plain sum merges the two, although a gap is open between their tubes. The sum would fill the gap to a crease, and
// a wall toward the first branch would end where the second one is nearer. So the vessel is kept apart from all of
// these branches, as in a contact.
class Folds {
public:
    Folds(const Links& links, const TouchingLinks& touching, const Marks& mark, const ContactLimits& limits)
        : links_(links), touching_(touching), mark_(mark), limits_(limits), gaps_(links, limits.reach) {}

    // Replaces the pairs of a gap between daughters by those of a fold, if the island is one.
    void complete(Island& island) {
        std::array<std::set<std::uint32_t>, 2> sides;
        const std::vector<OrientedPair> found = pairs_beside(island.pairs);
        for (const auto* const some : {&std::as_const(island.pairs), &found})
            for (const OrientedPair& pair : *some)
                for (std::size_t side = 0; side < 2; ++side) sides[side].insert(pair.link[side]);
        const auto on_both_sides = [&](std::uint32_t link) { return sides[1].contains(link); };
        if (found.empty() || std::ranges::any_of(sides[0], on_both_sides)) return;
        island.apart_from = limits_.reach;
        island.pairs.clear();
        for (const std::uint32_t a : sides[0])
            for (const std::uint32_t b : sides[1]) {
                const double closeness = closest_approach(links_[a], links_[b]).closeness;
                if (!links_.joined(a, b) && closeness >= 1.0 && closeness < limits_.reach)
                    island.pairs.push_back({{a, b}});
            }
    }

private:
    // Pairs that lie against each other: starts at `pairs`, steps to other branches at their nodes, and follows these.
    [[nodiscard]] std::vector<OrientedPair> pairs_beside(const std::vector<OrientedPair>& pairs) {
        std::vector<OrientedPair> found;
        std::set<std::array<std::uint32_t, 2>> known;
        const auto go_on_from = [&](const OrientedPair& pair, bool to_other_branches) {
            for (std::size_t side = 0; side < 2; ++side) {
                const Link link = links_[pair.link[side]];
                for (const std::uint32_t point : {link.from, link.to})
                    for (const std::uint32_t next : links_.at(point)) {
                        if (to_other_branches && links_[next].branch == link.branch) continue;
                        OrientedPair other = pair;
                        other.link[side] = next;
                        if (lie_against(next, pair.link[1 - side]) && known.insert(other.link).second)
                            found.push_back(other);
                    }
            }
        };
        for (const OrientedPair& pair : pairs) go_on_from(pair, true);
        for (std::size_t n = 0; n < found.size(); ++n) go_on_from(OrientedPair(found[n]), false);
        return found;
    }
    // Whether two links are together along the tree, but side by side with a gap between their tubes.
    [[nodiscard]] bool lie_against(std::uint32_t a, std::uint32_t b) {
        if (a == b || links_.joined(a, b)) return false;
        const PairId known = touching_.find(a, b);
        if (known != TouchingLinks::kNone && mark_[known] != Mark::kTogether) return false;
        const double closeness = closest_approach(links_[a], links_[b]).closeness;
        return closeness >= 1.0 && closeness < limits_.merged && gaps_.between(a, b);
    }

    const Links& links_;
    const TouchingLinks& touching_;
    const Marks& mark_;
    const ContactLimits& limits_;
    Gaps gaps_;
};

} // namespace

Islands find_islands(const Links& links, const TouchingLinks& touching, const ContactLimits& limits,
                     const LargeAllocator<std::byte>& memory) {
    constexpr std::size_t kRegionsAtOnce = std::size_t{1} << 16; // most have no island
    const Walks walks(links, touching, limits.reach, memory);
    Marks mark = mark_together(walks, limits.merged, memory);
    tbb::enumerable_thread_specific<RegionIslands> threads([&] { return RegionIslands(links, walks, mark, limits); });
    Folds folds(links, touching, mark, limits);
    Islands islands;
    std::vector<Region> regions;
    const auto look = [&] {
        std::vector<std::vector<Island>> found(regions.size());
        tbb::parallel_for(std::size_t{0}, regions.size(),
                          [&](std::size_t n) { found[n] = threads.local().of(regions[n]); });
        regions.clear();
        for (std::vector<Island>& some : found)
            for (Island& island : some) {
                if (island.parting) folds.complete(island);
                islands.all.push_back(std::move(island));
            }
    };
    for (PairId start = 0; start < walks.size(); ++start) {
        if (mark[start] != Mark::kUnknown) continue;
        regions.push_back(region_of(walks, start, limits.merged, mark));
        if (regions.size() == kRegionsAtOnce) look();
    }
    look();
    return islands;
}

} // namespace ramus::tree
