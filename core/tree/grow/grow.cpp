#include "core/tree/grow/grow.h"

#include "core/tree/build_tree.h"
#include "core/tree/grow/centerlines.h"
#include "core/tree/grow/colonise.h"

#include <algorithm>
#include <utility>

namespace ramus::tree {

namespace {

using namespace growth;

// Parents before children; of siblings the one with more blood first.
GrownTree assemble(const Skeleton& tree, const Centerlines& lines) {
    GrownTree grown;
    const auto stem = static_cast<std::size_t>(tree.nodes.front().children.front());
    grown.points.push_back({lines[stem].front(), tree.radius_mm(0)});
    grown.parents.push_back(-1);
    std::vector<int> point_of(tree.nodes.size(), 0);
    std::vector<int> stack{0};
    int leaves = 0;
    while (!stack.empty()) {
        const int id = stack.back();
        stack.pop_back();
        const Node& node = tree.at(id);
        if (id > 0) {
            int before = point_of[static_cast<std::size_t>(node.parent)];
            const auto& line = lines[static_cast<std::size_t>(id)];
            for (std::size_t k = 1; k < line.size(); ++k) {
                grown.points.push_back({line[k], tree.radius_mm(id)});
                grown.parents.push_back(before);
                before = static_cast<int>(grown.points.size()) - 1;
            }
            point_of[static_cast<std::size_t>(id)] = before;
        }
        if (node.child_count == 0) {
            grown.terminal_radius_mm += tree.radius_mm(id);
            ++leaves;
        }
        std::vector<int> children(node.children.begin(), node.children.begin() + node.child_count);
        std::stable_sort(children.begin(), children.end(),
                         [&](int a, int b) { return tree.at(a).flow < tree.at(b).flow; });
        stack.insert(stack.end(), children.begin(), children.end());
    }
    grown.terminal_radius_mm /= leaves;
    return grown;
}

} // namespace

std::optional<Error> wrong_with(const GrowOptions& options) {
    const auto bad = [](std::string what, std::string hint) { return Error{std::move(what), {}, std::move(hint)}; };
    if (options.branches < 1 || options.branches == 2 || options.branches > kMaxGrownBranches)
        return bad("a tree of " + std::to_string(options.branches) + " branches cannot be grown",
                   "ask for 1, or for 3 to " + std::to_string(kMaxGrownBranches));
    const auto sound = [](double value, double low, double high) { return value >= low && value <= high; };
    if (!sound(options.organ_width_mm, 1.0, 1e5)) return bad("the organ's size is not from 1 to 100,000 mm", {});
    if (!sound(options.root_radius_mm, 1e-4 * options.organ_width_mm, 0.05 * options.organ_width_mm))
        return bad("the root's radius does not suit the organ", "use 0.01 % to 5 % of the organ's size");
    if (!sound(options.spacing_mm, 1e-4 * options.organ_width_mm, options.organ_width_mm))
        return bad("the spacing of the points does not suit the organ", "use 0.01 % to 100 % of the organ's size");
    if (!sound(options.tortuosity, 0.0, 3.0)) return bad("the tortuosity is not from 0 to 3", {});
    return std::nullopt;
}

Result<GrownTree> grow(const GrowOptions& options, Job& job) {
    if (const auto error = wrong_with(options)) return tl::unexpected<Error>(*error);
    Random random(options.seed);
    const Liver liver(options.organ_width_mm, random);
    return grow(options, liver, random, job);
}

Result<GrownTree> grow(const GrowOptions& options, const growth::Organ& organ, growth::Random& random, Job& job) {
    BentTree bent;
    const auto misplaced = [&](const Skeleton& tree) {
        bent = bend(tree, organ, options.spacing_mm, options.tortuosity, kJointReach, options.seed);
        return bent.misplaced;
    };
    const Result<Skeleton> skeleton = colonise(organ, options.root_radius_mm, options.branches, random, misplaced, job);
    if (!skeleton) return tl::unexpected<Error>(skeleton.error());
    GrownTree grown = assemble(*skeleton, bent.lines);
    grown.organ_volume_mm3 = organ.volume_mm3();
    job.report(1.0F);
    return grown;
}

VesselTree vessel_tree_of(GrownTree grown) {
    std::vector<Edge> edges;
    edges.reserve(grown.points.size());
    for (std::uint32_t point = 1; point < grown.points.size(); ++point)
        edges.emplace_back(static_cast<std::uint32_t>(grown.parents[point]), point);
    return tree::assemble(std::move(grown.points), {}, edges, {0});
}

std::vector<double> organ_depths_mm(const GrowOptions& options, const std::vector<Point>& points) {
    Random random(options.seed);
    const Liver organ(options.organ_width_mm, random);
    std::vector<double> depths;
    depths.reserve(points.size());
    for (const Point& point : points) depths.push_back(organ.depth_mm(point.position));
    return depths;
}

} // namespace ramus::tree
