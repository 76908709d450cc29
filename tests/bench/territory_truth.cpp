#include "tests/bench/territory_truth.h"

#include "core/organ/grow_in.h"
#include "core/organ/supply.h"
#include "core/tree/build_tree.h"
#include "core/tree/grow/grow.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace ramus::bench {

namespace {

organ::Organ liver_of(const tree::GrowOptions& options, const tree::VesselTree& tree, double voxel) {
    glm::dvec3 least(HUGE_VAL), most(-HUGE_VAL);
    for (const tree::Point& point : tree.points) {
        least = glm::min(least, point.position - 10.0);
        most = glm::max(most, point.position + 10.0);
    }
    const glm::ivec3 size(glm::ceil((most - least) / voxel));
    volume::BitMask mask(size);
    constexpr int kSlices = 16; // at a time: each call prepares the liver anew, and all voxels take much memory
    for (int first = 0; first < size.z; first += kSlices) {
        std::vector<tree::Point> centres;
        for (int k = first; k < std::min(first + kSlices, size.z); ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) centres.push_back({least + voxel * glm::dvec3(i, j, k), 0.0});
        const std::vector<double> depths = tree::organ_depths_mm(options, centres);
        for (std::size_t n = 0; n < depths.size(); ++n) {
            const int at = static_cast<int>(n);
            if (depths[n] > 0.0) mask.set({at % size.x, at / size.x % size.y, first + at / size.x / size.y});
        }
    }
    glm::dmat4 to_patient(voxel);
    to_patient[3] = glm::dvec4(least, 1.0);
    return {std::move(mask), to_patient};
}

std::vector<std::int32_t> nearest_leaves(const organ::Organ& organ, const tree::VesselTree& tree) {
    tree::VesselTree tips;
    std::vector<std::int32_t> leaves;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        if (!tree.branches[id].children.empty()) continue;
        const auto first = static_cast<std::uint32_t>(tips.points.size());
        tips.points.push_back(tree.points[tree.branches[id].points.back()]);
        tips.points.push_back(tips.points.back());
        tips.points.back().position.x += 1e-6;
        tips.branches.emplace_back();
        tips.branches.back().points = {first, first + 1};
        leaves.push_back(static_cast<std::int32_t>(id));
    }
    Job job;
    auto supply = organ::supply_of(organ, tips, {organ::Rule::kAxis}, {}, JobRange(job, 0.0F, 1.0F)).value();
    for (std::int32_t& branch : supply.branch) branch = leaves[static_cast<std::size_t>(branch)];
    return supply.branch;
}

double radius_of(const tree::VesselTree& tree, std::size_t id) {
    return tree.points[tree.branches[id].points.back()].radius;
}

std::vector<int> visible_children(const tree::VesselTree& whole, const std::vector<char>& visible, int id) {
    std::vector<int> children;
    for (const int child : whole.branches[static_cast<std::size_t>(id)].children)
        if (visible[static_cast<std::size_t>(child)] != 0) children.push_back(child);
    return children;
}

} // namespace

Truth grown_liver(int leaves, std::uint64_t seed, double voxel) {
    tree::GrowOptions options;
    options.branches = 2 * leaves - 1;
    options.seed = seed;
    Job job;
    tree::VesselTree tree = tree::vessel_tree_of(tree::grow(options, job).value());
    organ::Organ organ = liver_of(options, tree, voxel);
    std::vector<std::int32_t> leaf = nearest_leaves(organ, tree);
    return {"seed " + std::to_string(seed), std::move(tree), std::move(organ), std::move(leaf)};
}

Truth grown_in(const std::string& name, const organ::Organ& organ, int leaves, std::uint64_t seed) {
    organ::Organ part = organ::largest_part(organ);
    tree::GrowOptions options = organ::grow_options_for(part);
    options.branches = 2 * leaves - 1;
    options.seed = seed;
    Job job;
    tree::VesselTree tree = tree::vessel_tree_of(organ::grow_in(part, options, job).value());
    std::vector<std::int32_t> leaf = nearest_leaves(part, tree);
    return {name, std::move(tree), std::move(part), std::move(leaf)};
}

std::vector<char> thickest(const tree::VesselTree& whole, std::size_t count) {
    std::vector<std::size_t> order(whole.branches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t id) { return radius_of(whole, id); });
    std::vector<char> visible(order.size(), 0);
    std::vector<int> shown_children(order.size(), 0);
    std::size_t ends = 0;
    for (std::size_t n = 0; n < order.size() && 2 * ends < count + 1; ++n) {
        visible[order[n]] = 1;
        ++ends;
        const int parent = whole.branches[order[n]].parent;
        if (parent != tree::kNoBranch && shown_children[static_cast<std::size_t>(parent)]++ == 0) --ends;
    }
    return visible;
}

void lose_ends(const tree::VesselTree& whole, std::vector<char>& visible, double probability, std::mt19937_64& random) {
    std::bernoulli_distribution loses(probability);
    const std::vector<char> before = visible;
    for (std::size_t id = 0; id < before.size(); ++id) {
        if (before[id] == 0 || !visible_children(whole, before, static_cast<int>(id)).empty() || !loses(random))
            continue;
        // The whole end branch, back to the fork of the visible tree that it begins at.
        for (int at = static_cast<int>(id); at != tree::kNoBranch;) {
            visible[static_cast<std::size_t>(at)] = 0;
            at = whole.branches[static_cast<std::size_t>(at)].parent;
            if (at == tree::kNoBranch || visible_children(whole, before, at).size() > 1) break;
        }
    }
}

std::vector<int> heads_of(const tree::VesselTree& whole, const std::vector<char>& visible, std::size_t count) {
    const auto flow = [&](int id) { return std::pow(radius_of(whole, static_cast<std::size_t>(id)), 3.0); };
    const auto fork_of = [&](int id) {
        while (true) {
            std::vector<int> children = visible_children(whole, visible, id);
            if (children.empty()) return children;
            std::ranges::stable_sort(children, std::greater(), flow);
            double all = 0.0;
            for (const int child : children) all += flow(child);
            std::erase_if(children, [&](int child) { return flow(child) < all / 4.0; });
            if (children.size() > 1) return children;
            id = children.front();
        }
    };
    std::vector<int> heads{0};
    while (heads.size() < count) {
        std::ranges::stable_sort(heads, std::greater(), flow);
        const auto divided = std::ranges::find_if(heads, [&](int id) { return !fork_of(id).empty(); });
        if (divided == heads.end()) break;
        const std::vector<int> parts = fork_of(*divided);
        heads.erase(divided);
        heads.insert(heads.end(), parts.begin(), parts.end());
    }
    return heads;
}

std::vector<int> groups_of(const tree::VesselTree& whole, const std::vector<int>& heads) {
    std::vector<int> groups(whole.branches.size(), organ::kNoGroup);
    for (std::size_t n = 0; n < heads.size(); ++n)
        for (std::vector<int> open{heads[n]}; !open.empty();) {
            const auto id = static_cast<std::size_t>(open.back());
            open.pop_back();
            groups[id] = static_cast<int>(n);
            open.insert(open.end(), whole.branches[id].children.begin(), whole.branches[id].children.end());
        }
    return groups;
}

Seen seen_of(const tree::VesselTree& whole, const std::vector<char>& visible, double noise, std::mt19937_64& random) {
    std::normal_distribution<double> spread(0.0, noise);
    tree::Graph graph;
    std::map<std::uint32_t, std::uint32_t> number; // of the points in the graph
    std::vector<std::uint32_t> old;
    const auto add = [&](std::uint32_t point) {
        const auto [at, is_new] = number.try_emplace(point, static_cast<std::uint32_t>(old.size()));
        if (is_new) {
            old.push_back(point);
            graph.points.push_back(whole.points[point]);
        }
        return at->second;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> of_edge; // the branch of the whole tree
    for (std::size_t id = 0; id < visible.size(); ++id) {
        if (visible[id] == 0) continue;
        const double factor = noise > 0.0 ? std::exp(spread(random)) : 1.0;
        const auto& points = whole.branches[id].points;
        for (std::size_t n = 1; n < points.size(); ++n) {
            const std::uint32_t from = add(points[n - 1]), to = add(points[n]);
            graph.points[to].radius = whole.points[points[n]].radius * factor;
            graph.edges.emplace_back(from, to);
            of_edge[{from, to}] = static_cast<int>(id);
        }
    }
    graph.roots = {number.at(whole.roots.front())};
    Seen seen{
        tree::build_tree(std::move(graph), tree::Repair::kNone, [](std::uint32_t) { return std::string(); }).value(),
        {}};
    for (const tree::Branch& branch : seen.tree.branches) {
        std::vector<int>& parts = seen.parts.emplace_back();
        for (std::size_t n = 1; n < branch.points.size(); ++n)
            if (const int id = of_edge.at({branch.points[n - 1], branch.points[n]});
                parts.empty() || parts.back() != id)
                parts.push_back(id);
    }
    return seen;
}

organ::Grouping grouping_of(const Seen& seen, const tree::VesselTree& whole, const std::vector<int>& groups,
                            std::size_t heads) {
    organ::Grouping grouping;
    for (std::size_t n = 0; n < heads; ++n) grouping.names.push_back(std::to_string(n));
    for (const std::vector<int>& parts : seen.parts) {
        // A head that lost its siblings continues the branch in front of it.
        const int group = groups[static_cast<std::size_t>(parts.back())],
                  before = groups[static_cast<std::size_t>(parts.front())];
        double length = 0.0, from = 0.0;
        for (const int id : parts) {
            if (groups[static_cast<std::size_t>(id)] != group)
                from += tree::length_mm(whole, whole.branches[static_cast<std::size_t>(id)]);
            length += tree::length_mm(whole, whole.branches[static_cast<std::size_t>(id)]);
        }
        grouping.branches.push_back({group, from / length, before});
    }
    return grouping;
}

Score score_of(const Truth& truth, const std::vector<int>& groups, const std::vector<int>& found, std::size_t heads) {
    std::vector<double> is(heads, 0.0), said(heads, 0.0), both(heads, 0.0);
    for (std::size_t voxel = 0; voxel < truth.leaf.size(); ++voxel) {
        const int right = groups[static_cast<std::size_t>(truth.leaf[voxel])];
        if (right == organ::kNoGroup) continue;
        ++is[static_cast<std::size_t>(right)];
        if (found[voxel] != organ::kNoGroup) ++said[static_cast<std::size_t>(found[voxel])];
        if (right == found[voxel]) ++both[static_cast<std::size_t>(right)];
    }
    Score score;
    double counted = 0.0;
    for (std::size_t n = 0; n < heads; ++n) {
        if (is[n] == 0.0) continue;
        score.dice += 2.0 * both[n] / (is[n] + said[n]);
        score.volume_error += std::abs(said[n] - is[n]) / is[n];
        ++counted;
    }
    score.dice /= counted;
    score.volume_error /= counted;
    return score;
}

} // namespace ramus::bench
