#include "core/base/disjoint_sets.h"
#include "core/tree/contacts/contacts.h"
#include "core/tree/curves.h"
#include "core/tree/smooth.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::validate {

namespace {

// Share of the closeness from which two vessels count as together again. Above it, in the crotch of a fork, merged
// vessels and joined vessels look the same. The same holds for daughters that diverge (Partner::parting).
constexpr double kNearlyTogether = 0.97;
constexpr double kThird = 1.25; // radii: a place this near to a third vessel belongs to it, since joints bulge

// Two links that are kept apart, at their closest places.
struct PassingPair {
    std::uint32_t a = 0, b = 0; // links, ascending
    tree::Point at_a, at_b;
    glm::dvec3 seen_from{0.0}, seen_to{0.0}; // the same places on the moved axes (core/tree/contacts/spread_axes.h)
    bool merged = false;
    bool sure = false; // no third vessel is involved
};

// Whether a third vessel lies between the two. Then both may be merged with it, and not with each other.
bool third_between(const Axes& axes, const PassingPair& pair) {
    const tree::Links& links = axes.links;
    constexpr int kAsked = 5;
    for (int i = 0; i < kAsked; ++i) {
        const glm::dvec3 at = glm::mix(pair.seen_from, pair.seen_to, (i + 0.5) / kAsked);
        const auto third =
            axes.vessels.nearest({at, 0.0}, kThird, {{links[pair.a].branch, links[pair.b].branch}}, kThird);
        if (third.branch != tree::kNoBranch) return true;
    }
    return false;
}

std::vector<PassingPair> passing_pairs(const Axes& axes, const tree::ContactLimits& limits) {
    const tree::Contacts contacts = tree::find_contacts(axes.prepared, limits);
    const tree::Links& links = axes.links;
    std::vector<PassingPair> pairs;
    for (std::uint32_t a = 0; a < links.size(); ++a)
        for (const tree::Contacts::Partner& partner : contacts.partners_of(a)) {
            if (partner.piece <= a || partner.parting) continue;
            const std::uint32_t b = partner.piece;
            const tree::Approach approach = tree::closest_approach(links[a], links[b]);
            if (partner.apart_from > 0.0F && approach.closeness > kNearlyTogether * double(partner.apart_from))
                continue;
            PassingPair pair{
                a, b, tree::point_on(links[a], approach.share_a), tree::point_on(links[b], approach.share_b), {}, {}};
            pair.seen_from = pair.at_a.position + contacts.move_of(a).at(approach.share_a);
            pair.seen_to = pair.at_b.position + contacts.move_of(b).at(approach.share_b);
            pairs.push_back(pair);
        }
    return pairs;
}

double gap_of(const PassingPair& pair) {
    return glm::distance(pair.at_a.position, pair.at_b.position) - pair.at_a.radius - pair.at_b.radius;
}

// The set of each pair. Two pairs belong to one set if both of their links are equal or adjacent.
std::vector<std::uint32_t> sets_of(const std::vector<PassingPair>& pairs, const tree::Links& links) {
    DisjointSets sets(pairs.size());
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_link;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) by_link[pairs[i].a].push_back(i), by_link[pairs[i].b].push_back(i);
    const auto meet = [&](std::uint32_t p, std::uint32_t q) { return p == q || links.joined(p, q); };
    for (std::uint32_t i = 0; i < pairs.size(); ++i)
        for (const std::uint32_t point : {links[pairs[i].a].from, links[pairs[i].a].to})
            for (const std::uint32_t link : links.at(point))
                if (const auto there = by_link.find(link); there != by_link.end())
                    for (const std::uint32_t other : there->second)
                        if ((meet(pairs[i].a, pairs[other].a) && meet(pairs[i].b, pairs[other].b)) ||
                            (meet(pairs[i].a, pairs[other].b) && meet(pairs[i].b, pairs[other].a)))
                            sets.join(i, other);
    std::vector<std::uint32_t> set(pairs.size());
    for (std::uint32_t i = 0; i < pairs.size(); ++i) set[i] = sets.find(i);
    return set;
}

// Whether a place on a branch is in one of its lost stretches.
bool is_lost(const Reference& reference, int branch, const glm::dvec3& at, std::span<const LostStretch> lost) {
    if (std::ranges::find(lost, branch, [](const LostStretch& one) { return one.lost.branch; }) == lost.end())
        return false;
    const auto place = std::ranges::min_element(reference.places_of(static_cast<std::size_t>(branch)), {},
                                                [&](const Place& one) { return glm::distance(one.at, at); });
    return std::ranges::any_of(lost, [&](const LostStretch& one) {
        return one.lost.branch == branch && place->along >= one.from && place->along <= one.to;
    });
}

std::vector<Merged> merged_along(const Axes& axes, const Reference& reference, const Probe& probe,
                                 const tree::ContactLimits& limits, std::span<const LostStretch> lost) {
    std::vector<PassingPair> pairs = passing_pairs(axes, limits);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pairs.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            PassingPair& pair = pairs[i];
            pair.merged =
                probe.sees(pair.seen_from, pair.seen_to) && probe.inside(pair.seen_from) && probe.inside(pair.seen_to);
            pair.sure = pair.merged && !third_between(axes, pair);
        }
    });
    std::erase_if(pairs, [](const PassingPair& pair) { return !pair.merged; });
    std::erase_if(pairs, [&](const PassingPair& pair) {
        return is_lost(reference, axes.links[pair.a].branch, pair.at_a.position, lost) ||
               is_lost(reference, axes.links[pair.b].branch, pair.at_b.position, lost);
    });
    const std::vector<std::uint32_t> sets = sets_of(pairs, axes.links);
    std::map<std::uint32_t, std::size_t> closest; // of each set
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [found, fresh] = closest.try_emplace(sets[i], i);
        if (!fresh && gap_of(pairs[i]) < gap_of(pairs[found->second])) found->second = i;
    }
    std::vector<std::uint8_t> sure(pairs.size(), 0); // by set
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].sure) sure[sets[i]] = 1;
    std::vector<Merged> merged;
    for (const auto& [set, i] : closest) {
        if (sure[set] == 0) continue;
        const PassingPair& pair = pairs[i];
        const auto [low, high] = std::minmax({axes.links[pair.a].branch, axes.links[pair.b].branch});
        merged.push_back({{low, high}, 0.5 * (pair.at_a.position + pair.at_b.position), gap_of(pair)});
    }
    std::ranges::stable_sort(merged, {}, &Merged::gap_mm);
    return merged;
}

// The centerlines as a surface may have them: smoothed, with rounded corners.
tree::PreparedTree rounded(const Reference& reference) {
    tree::PreparedTree prepared = reference.axes().prepared;
    prepared.tree = tree::smooth(std::move(prepared.tree), 1);
    const std::vector<tree::CurvePieces> pieces = tree::pieces_of_curves(prepared.tree);
    return tree::along_curves(std::move(prepared), pieces);
}

} // namespace

// A wall lies midway between two axes. If the axes nearly cross, its place depends on their last bits. So two vessels
// count as merged only if they see each other from the axes as read and from the rounded ones.
std::vector<Merged> merged_vessels(const Reference& reference, const Probe& probe, const tree::ContactLimits& limits,
                                   std::span<const LostStretch> lost) {
    constexpr double kSamePlace = 3.0; // radii: rounding moves where two are closest along both
    std::vector<Merged> merged = merged_along(reference.axes(), reference, probe, limits, lost);
    if (merged.empty()) return merged;
    const Axes round(rounded(reference));
    const std::vector<Merged> again = merged_along(round, reference, probe, limits, lost);
    std::erase_if(merged, [&](const Merged& one) {
        const double radius = reference.vessels().nearest({one.at, 0.0}, kOwn, {}, 0.0).radius;
        return std::ranges::none_of(again, [&](const Merged& other) {
            return other.branches == one.branches &&
                   glm::distance(other.at, one.at) <= kSamePlace * radius + 2.0 * reference.grain_mm();
        });
    });
    return merged;
}

} // namespace ramus::validate
