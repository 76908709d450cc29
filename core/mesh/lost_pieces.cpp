#include "core/mesh/lost_pieces.h"

#include "core/base/disjoint_sets.h"

#include <map>

namespace ramus::mesh {

void SeenBranches::add(std::span<const std::int32_t> vertex_branches) {
    for (const std::int32_t branch : vertex_branches)
        if (branch >= 0 && static_cast<std::size_t>(branch) < seen_.size()) seen_[static_cast<std::size_t>(branch)] = 1;
}

std::vector<std::vector<int>> lost_pieces(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden,
                                          const SeenBranches& seen) {
    const auto shown = [&](std::size_t branch) { return branch >= hidden.size() || hidden[branch] == 0; };
    DisjointSets points(tree.points.size());
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
        if (const auto& of = tree.branches[b].points; shown(b) && !of.empty())
            for (const std::uint32_t point : of) points.join(of.front(), point);
    struct Piece {
        std::vector<int> branches;
        bool seen = false;
    };
    std::map<std::uint32_t, Piece> pieces; // by the point that stands for it
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        if (!shown(b) || tree.branches[b].points.empty()) continue;
        Piece& piece = pieces[points.find(tree.branches[b].points.front())];
        piece.branches.push_back(static_cast<int>(b));
        piece.seen = piece.seen || seen.has(b);
    }
    std::map<int, std::vector<int>> lost;
    for (auto& [point, piece] : pieces)
        if (!piece.seen) lost[piece.branches.front()] = std::move(piece.branches);
    std::vector<std::vector<int>> all;
    for (auto& [first, branches] : lost) all.push_back(std::move(branches));
    return all;
}

} // namespace ramus::mesh
