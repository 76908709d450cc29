#include "core/volume/skeletonize/branch_voxels.h"

#include <algorithm>
#include <utility>

namespace ramus::volume {

namespace {

using Address = VoxelSet::Address;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// A point of a line. places_of() numbers the points of all lines.
struct Place {
    std::uint32_t line, point;
};

std::vector<Place> places_of(const VoxelGraph& graph, LargeArray<std::uint32_t>& place_of) {
    std::vector<Place> places;
    const auto add = [&](std::size_t line, std::size_t point, std::uint32_t voxel) {
        place_of[voxel] = static_cast<std::uint32_t>(places.size());
        places.push_back({static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(point)});
    };
    for (std::size_t l = 0; l < graph.lines.size(); ++l) {
        const VoxelGraph::Line& line = graph.lines[l];
        add(l, 0, graph.nodes[static_cast<std::size_t>(line.from)].voxel);
        for (std::size_t p = 0; p < line.points.size(); ++p) add(l, p + 1, line.points[p].voxel);
        add(l, line.points.size() + 1, graph.nodes[static_cast<std::size_t>(line.to)].voxel);
    }
    return places;
}

// Voxels of the skeleton that are on no line get the place of their nearest neighbour along the skeleton.
void spread_along(const SparseMask& skeleton, const VoxelSet& set, LargeArray<std::uint32_t>& place_of) {
    std::vector<Address> open;
    const auto for_neighbours = [&](Address at, const auto& call) {
        for (Neighbourhood left = neighbourhood(skeleton, at) & kNeighbours; left != 0; left &= left - 1)
            call(static_cast<Address>(static_cast<std::int64_t>(at) + set.step(std::countr_zero(left))));
    };
    set.for_each([&](Address at) {
        if (place_of[set.number(at)] == kNone) return;
        bool has_open = false;
        for_neighbours(at, [&](Address to) { has_open |= place_of[set.number(to)] == kNone; });
        if (has_open) open.push_back(at);
    });
    for (std::size_t n = 0; n < open.size(); ++n)
        for_neighbours(open[n], [&](Address to) {
            std::uint32_t& place = place_of[set.number(to)];
            if (place != kNone) return;
            place = place_of[set.number(open[n])];
            open.push_back(to);
        });
}

} // namespace

BranchVoxels::BranchVoxels(const VoxelSet& set, const Thinned& thinned, const VoxelGraph& graph)
    : members_(set.memory()), firsts_(graph.lines.size() + 1, 0) {
    LargeArray<std::uint32_t> place_of(set.count(), kNone, set.memory());
    const std::vector<Place> places = places_of(graph, place_of);
    spread_along(thinned.skeleton, set, place_of);
    std::vector<std::uint32_t> way;
    set.for_each([&](Address at) {
        way.clear();
        std::uint32_t number = set.number(at);
        while (place_of[number] == kNone && thinned.uphill[number] != kCentreBit) {
            way.push_back(number);
            at = static_cast<Address>(static_cast<std::int64_t>(at) + set.step(thinned.uphill[number]));
            number = set.number(at);
        }
        for (const std::uint32_t passed : way) place_of[passed] = place_of[number];
        // No line: a piece of one voxel, or thinning was cancelled.
        if (place_of[number] == kNone) return;
        ++firsts_[places[place_of[number]].line + 1];
    });
    for (std::size_t l = 1; l < firsts_.size(); ++l) firsts_[l] += firsts_[l - 1];
    members_.resize(firsts_.back());
    std::vector<std::size_t> next(firsts_.begin(), firsts_.end() - 1);
    set.for_each([&](Address at) {
        const std::uint32_t found = place_of[set.number(at)];
        if (found == kNone) return;
        const Place& place = places[found];
        members_[next[place.line]++] = {at, place.point};
    });
}

} // namespace ramus::volume
