// How right are territories of a tree of which only the thick branches are seen? Grows organs whose supply is known to
// the last leaf, prunes the tree to its N thickest branches (as they are counted then), and compares territories of the
// pruned tree with the truth.
//
//     ramus_bench_territories [--leaves 30000] [--seeds 6] [--voxel 2] [--noise 0.15] [--missing 0.25]
#include "core/organ/supply.h"
#include "core/organ/territories.h"
#include "core/tree/build_tree.h"
#include "core/tree/grow/grow.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <numeric>
#include <random>

using namespace ramus;

namespace {

// An organ, the whole tree in it, and the leaf that each voxel belongs to.
struct Truth {
    tree::VesselTree tree;
    organ::Organ organ;
    std::vector<std::int32_t> leaf; // by voxel: branch id
};

organ::Organ organ_of(const tree::GrowOptions& options, const tree::VesselTree& tree, double voxel) {
    glm::dvec3 least(HUGE_VAL), most(-HUGE_VAL);
    for (const tree::Point& point : tree.points) {
        least = glm::min(least, point.position - 10.0);
        most = glm::max(most, point.position + 10.0);
    }
    const glm::ivec3 size(glm::ceil((most - least) / voxel));
    std::vector<tree::Point> centres;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) centres.push_back({least + voxel * glm::dvec3(i, j, k), 0.0});
    const std::vector<double> depths = tree::organ_depths_mm(options, centres);
    volume::BitMask mask(size);
    for (std::size_t n = 0; n < depths.size(); ++n)
        if (depths[n] > 0.0)
            mask.set({static_cast<int>(n) % size.x, static_cast<int>(n) / size.x % size.y,
                      static_cast<int>(n) / size.x / size.y});
    glm::dmat4 to_patient(voxel);
    to_patient[3] = glm::dvec4(least, 1.0);
    return {std::move(mask), to_patient};
}

// The nearest tip of a leaf, at each voxel.
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

// What is seen of a tree, and for each of its branches the visible branch that it is a part of, or hangs on.
struct Visible {
    tree::VesselTree tree;
    std::vector<int> shown_by;
};

Visible visible_part(const tree::VesselTree& whole, std::size_t count, double missing, double noise,
                     std::mt19937_64& random) {
    std::vector<std::size_t> order(whole.branches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto radius = [&](std::size_t id) { return whole.points[whole.branches[id].points.back()].radius; };
    std::ranges::stable_sort(order, std::greater(), radius);
    std::vector<char> kept(whole.branches.size(), 0);
    // A branch of which one child is seen is one with that in the visible tree, so branches are counted by their ends.
    std::size_t ends = 0;
    std::vector<int> seen_children(kept.size(), 0);
    for (std::size_t n = 0; n < order.size() && 2 * ends < count + 1; ++n) {
        kept[order[n]] = 1;
        ++ends;
        const int parent = whole.branches[order[n]].parent;
        if (parent != tree::kNoBranch && seen_children[static_cast<std::size_t>(parent)]++ == 0) --ends;
    }
    // A scan that misses branches misses what hangs on them, too; the two first generations are always seen.
    std::bernoulli_distribution misses(missing);
    std::ranges::stable_sort(order, std::less(), [&](std::size_t id) { return whole.branches[id].generation; });
    for (const std::size_t id : order) {
        const tree::Branch& branch = whole.branches[id];
        if (branch.parent != tree::kNoBranch && kept[static_cast<std::size_t>(branch.parent)] == 0) kept[id] = 0;
        if (branch.children.empty() || branch.generation > 4)
            if (kept[id] != 0 && misses(random)) kept[id] = 0;
    }
    tree::Graph graph;
    std::map<std::uint32_t, std::uint32_t> number; // of the points in the graph
    std::vector<std::uint32_t> old;
    const auto add = [&](std::uint32_t point) {
        const auto [at, is_new] = number.try_emplace(point, static_cast<std::uint32_t>(old.size()));
        if (is_new) {
            old.push_back(point);
            graph.points.push_back(whole.points[point]);
            std::normal_distribution<double> spread(0.0, noise);
            graph.points.back().radius *= std::exp(spread(random));
        }
        return at->second;
    };
    for (std::size_t id = 0; id < kept.size(); ++id)
        for (std::size_t n = 1; kept[id] != 0 && n < whole.branches[id].points.size(); ++n) {
            const std::uint32_t from = add(whole.branches[id].points[n - 1]), to = add(whole.branches[id].points[n]);
            graph.edges.emplace_back(from, to);
        }
    graph.roots = {number.at(whole.roots.front())};
    Visible visible{
        tree::build_tree(std::move(graph), tree::Repair::kNone, [](std::uint32_t) { return std::string(); }).value(),
        std::vector<int>(whole.branches.size(), tree::kNoBranch)};
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> of_edge;
    for (std::size_t id = 0; id < visible.tree.branches.size(); ++id) {
        const auto& points = visible.tree.branches[id].points;
        for (std::size_t n = 1; n < points.size(); ++n)
            of_edge[{old[points[n - 1]], old[points[n]]}] = static_cast<int>(id);
    }
    for (const std::size_t id : order) { // parents first
        const tree::Branch& branch = whole.branches[id];
        visible.shown_by[id] = kept[id] != 0
                                   ? of_edge.at({branch.points[branch.points.size() - 2], branch.points.back()})
                                   : visible.shown_by[static_cast<std::size_t>(branch.parent)];
    }
    return visible;
}

// The heads of `count` parts of a tree: the part with the most flow (radius cubed) is divided at its next fork, again
// and again. Side branches with less than a quarter of the flow do not make a fork.
std::vector<int> heads_of(const tree::VesselTree& tree, std::size_t count) {
    const auto flow = [&](int id) {
        return std::pow(tree.points[tree.branches[static_cast<std::size_t>(id)].points.back()].radius, 3.0);
    };
    const auto fork_of = [&](int id) {
        while (true) {
            std::vector<int> children = tree.branches[static_cast<std::size_t>(id)].children;
            std::ranges::stable_sort(children, std::greater(), flow);
            if (children.empty()) return children;
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

struct Score {
    double dice = 0.0, volume_error = 0.0;
    int groups = 0;
};

// Voxels whose leaf hangs on the trunk in front of all groups, or on a side branch of it, have no true territory and
// are not compared.
Score score_of(const Truth& truth, const Visible& visible, std::size_t count, organ::Rule rule) {
    const organ::Grouping grouping =
        organ::by_branches(visible.tree, tree::Dependency(visible.tree), heads_of(visible.tree, count));
    Job job;
    const auto supply =
        organ::supply_of(truth.organ, visible.tree, {rule}, organ::trunk_of(grouping), JobRange(job, 0.0F, 1.0F))
            .value();
    const std::size_t groups = grouping.names.size() - 1; // without the rest
    std::vector<double> is(groups, 0.0), said(groups, 0.0), both(groups, 0.0);
    for (std::size_t voxel = 0; voxel < truth.leaf.size(); ++voxel) {
        const int shown = visible.shown_by[static_cast<std::size_t>(truth.leaf[voxel])];
        const int right = grouping.branches[static_cast<std::size_t>(shown)].group;
        if (right == organ::kNoGroup || right == static_cast<int>(groups)) continue;
        const int found = grouping.branches[static_cast<std::size_t>(supply.branch[voxel])].group;
        ++is[static_cast<std::size_t>(right)];
        if (found < static_cast<int>(groups)) ++said[static_cast<std::size_t>(found)];
        if (right == found) ++both[static_cast<std::size_t>(right)];
    }
    Score score;
    for (std::size_t n = 0; n < groups; ++n) {
        if (is[n] == 0.0) continue;
        score.dice += 2.0 * both[n] / (is[n] + said[n]);
        score.volume_error += std::abs(said[n] - is[n]) / is[n];
        ++score.groups;
    }
    score.dice /= score.groups;
    score.volume_error /= score.groups;
    return score;
}

} // namespace

int main(int argc, char** argv) {
    int leaves = 30000, seeds = 6;
    double voxel = 2.0, noise = 0.0, missing = 0.0;
    CLI::App app("Territories against organs whose supply is known");
    app.add_option("--leaves", leaves);
    app.add_option("--seeds", seeds);
    app.add_option("--voxel", voxel);
    app.add_option("--noise", noise);
    app.add_option("--missing", missing);
    CLI11_PARSE(app, argc, argv);
    std::printf("seed visible wanted groups rule dice volume_error\n");
    for (int seed = 1; seed <= seeds; ++seed) {
        tree::GrowOptions options;
        options.branches = 2 * leaves - 1;
        options.seed = static_cast<std::uint64_t>(seed);
        Job job;
        tree::VesselTree tree = tree::vessel_tree_of(tree::grow(options, job).value());
        organ::Organ organ = organ_of(options, tree, voxel);
        std::vector<std::int32_t> leaf = nearest_leaves(organ, tree);
        const Truth truth{std::move(tree), std::move(organ), std::move(leaf)};
        for (const std::size_t visible : {60, 300, 1000}) {
            std::mt19937_64 random(static_cast<std::uint64_t>(seed));
            const Visible seen = visible_part(truth.tree, visible, missing, noise, random);
            for (const std::size_t count : {2, 4, 8})
                for (const organ::Rule rule : {organ::Rule::kTips, organ::Rule::kAxis, organ::Rule::kWall}) {
                    const Score score = score_of(truth, seen, count, rule);
                    std::printf("%d %zu %zu %d %s %.4f %.4f\n", seed, visible, count, score.groups,
                                std::string(organ::name_of(rule)).c_str(), score.dice, score.volume_error);
                    std::fflush(stdout);
                }
        }
    }
}
