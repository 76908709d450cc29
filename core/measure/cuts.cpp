#include "core/measure/cuts.h"

#include "core/measure/branch_point.h"
#include "core/tree/network.h"

#include <algorithm>
#include <limits>

namespace ramus::measure {

std::vector<LostSpan> lost_spans(const tree::VesselTree& tree, std::span<const Cut> cuts) {
    if (cuts.empty()) return {};
    struct Extent {
        double first = std::numeric_limits<double>::max(), last = -1.0;
        [[nodiscard]] bool none() const { return last < 0.0; }
    };
    std::vector<Extent> cut(tree.branches.size());
    for (const auto& [branch, where] : cuts) {
        Extent& extent = cut[static_cast<std::size_t>(branch)];
        extent.first = std::min(extent.first, std::clamp(where, 0.0, 1.0));
        extent.last = std::max(extent.last, std::clamp(where, 0.0, 1.0));
    }
    const tree::Network network(tree);
    std::vector<char> reached(static_cast<std::size_t>(network.node_count()), 0);
    std::vector<int> open;
    const auto reach = [&](int node) {
        char& known = reached[static_cast<std::size_t>(node)];
        if (known == 0) open.push_back(node);
        known = 1;
    };
    for (const int root : network.roots) reach(root);
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        for (const int b : network.at(node))
            if (cut[static_cast<std::size_t>(b)].none()) reach(network.across(b, node));
    }
    std::vector<LostSpan> spans(tree.branches.size());
    for (std::size_t b = 0; b < spans.size(); ++b) {
        const auto& [start, end] = network.ends[b];
        const bool from_start = reached[static_cast<std::size_t>(start)] != 0;
        const bool from_end = reached[static_cast<std::size_t>(end)] != 0;
        if (cut[b].none()) {
            if (!from_start) spans[b] = {0.0, 1.0}; // nor from its end, or the walk would have come through
            continue;
        }
        spans[b] = {from_start ? cut[b].first : 0.0, from_end ? cut[b].last : 1.0};
        if (!spans[b].any()) spans[b] = {};
    }
    return spans;
}

CutReport cut_report(const tree::VesselTree& tree, const tree::Dependency& dependency,
                     std::span<const Amount> dependents, std::span<const Cut> cuts, double reconstruct_mm) {
    CutReport report;
    report.spans = lost_spans(tree, cuts);
    if (cuts.empty()) return report;
    const std::vector<char> free = free_ends(tree);
    const auto lost_of = [&](std::size_t b, const LostSpan& span) {
        if (!span.any()) return Amount{};
        const BranchPart part = part_of(tree, static_cast<int>(b), span.from, span.to);
        return Amount{1, part.length_mm, part.volume_mm3, span.to >= 1.0 ? free[b] : 0};
    };
    for (const auto& [branch, where] : cuts) {
        const auto b = static_cast<std::size_t>(branch);
        CutFigures figures;
        figures.diameter_mm = 2.0 * point_on(tree, branch, where).radius_mm;
        figures.reconstruct = figures.diameter_mm > reconstruct_mm;
        if (dependency.is_bridge(branch)) {
            figures.lost = dependents[b];
            figures.lost += lost_of(b, {std::clamp(where, 0.0, 1.0), 1.0});
        }
        report.cuts.push_back(figures);
    }
    for (std::size_t b = 0; b < report.spans.size(); ++b) {
        if (!report.spans[b].any()) continue;
        report.together += lost_of(b, report.spans[b]);
        report.in_part += report.spans[b].whole() ? 0 : 1;
    }
    return report;
}

} // namespace ramus::measure
