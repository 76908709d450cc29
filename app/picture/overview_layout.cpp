#include "app/picture/overview_layout.h"

#include "core/base/bounds.h"
#include "core/base/lines.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

namespace ramus::app {

namespace {

std::size_t index(int id) { return static_cast<std::size_t>(id); }

// For each branch that closes a loop: the branch that ends at the same place; kNoBranch: at a root.
struct Links {
    std::vector<char> is_link;
    std::vector<int> target;
};

// A branch closes a loop if it ends where an earlier one ends, or at a root. A branch that returns to its own start is
// drawn as a line.
Links find_links(const tree::VesselTree& tree) {
    constexpr int kNobody = -2;
    Links links{std::vector<char>(tree.branches.size(), 0), std::vector<int>(tree.branches.size(), tree::kNoBranch)};
    std::vector<int> owner(tree.points.size(), kNobody);
    for (const auto root : tree.roots) owner[root] = tree::kNoBranch;
    const auto end_of = [&](std::size_t id) { return tree.branches[id].points.back(); };
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (!tree.branches[id].children.empty()) owner[end_of(id)] = static_cast<int>(id);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        if (!tree.branches[id].children.empty()) continue;
        int& here = owner[end_of(id)];
        if (here == kNobody) {
            here = static_cast<int>(id);
        } else if (end_of(id) != tree.branches[id].points.front()) {
            links.is_link[id] = 1;
            links.target[id] = here;
        }
    }
    return links;
}

// Horizontal position of subtrees in the anterior view: the mean of their ends.
std::vector<double> places_across(const tree::VesselTree& tree) {
    std::vector<double> sum(tree.branches.size(), 0.0);
    std::vector<int> ends(tree.branches.size(), 0);
    const std::vector<int> order = parents_first(tree);
    for (std::size_t i = order.size(); i-- > 0;) {
        const std::size_t id = index(order[i]);
        const tree::Branch& branch = tree.branches[id];
        if (ends[id] == 0) sum[id] = -tree.points[branch.points.back()].position.x, ends[id] = 1;
        if (branch.parent == tree::kNoBranch) continue;
        sum[index(branch.parent)] += sum[id];
        ends[index(branch.parent)] += ends[id];
    }
    for (std::size_t id = 0; id < sum.size(); ++id) sum[id] /= std::max(1, ends[id]);
    return sum;
}

std::span<const int> children_in(const OverviewLayout& layout, int id) {
    const auto first = static_cast<std::size_t>(layout.first_child[index(id)]);
    const auto last = static_cast<std::size_t>(layout.first_child[index(id) + 1]);
    return std::span(layout.children).subspan(first, last - first);
}

class Builder {
public:
    Builder(const tree::VesselTree& tree, const TreeFacts& facts, OverviewDepth depth)
        : tree_(tree), facts_(facts), depth_(depth), links_(find_links(tree)) {}

    OverviewLayout build() {
        layout_.lines.resize(tree_.branches.size());
        sort_children();
        order_branches();
        set_depths();
        place_across();
        place_links();
        return std::move(layout_);
    }

private:
    [[nodiscard]] std::span<const int> children_of(int id) const { return children_in(layout_, id); }
    [[nodiscard]] std::uint32_t root_point(int id) const { return tree_.branches[index(id)].points.front(); }

    void sort_children() {
        const std::vector<double> across = places_across(tree_);
        const auto sort = [&](auto first, auto last) {
            std::stable_sort(first, last, [&](int a, int b) { return across[index(a)] < across[index(b)]; });
        };
        for (std::size_t id = 0; id < tree_.branches.size(); ++id) {
            layout_.first_child.push_back(static_cast<int>(layout_.children.size()));
            const auto before = static_cast<std::ptrdiff_t>(layout_.children.size());
            for (const int child : tree_.branches[id].children)
                if (links_.is_link[index(child)] == 0) layout_.children.push_back(child);
            sort(layout_.children.begin() + before, layout_.children.end());
        }
        layout_.first_child.push_back(static_cast<int>(layout_.children.size()));

        // Trees are side by side, from left to right as well.
        layout_.roots = branches_where(tree_.branches.size(), [&](std::size_t id) {
            return tree_.branches[id].parent == tree::kNoBranch && links_.is_link[id] == 0;
        });
        std::map<std::uint32_t, std::pair<double, int>> trees; // by root: sum over its branches, and how many
        for (const int id : layout_.roots)
            trees[root_point(id)].first += across[index(id)], ++trees[root_point(id)].second;
        const auto key = [&](int id) {
            const auto& [sum, count] = trees.at(root_point(id));
            return std::pair(sum / count, root_point(id));
        };
        sort(layout_.roots.begin(), layout_.roots.end());
        std::ranges::stable_sort(layout_.roots, [&](int a, int b) { return key(a) < key(b); });
    }

    void order_branches() {
        std::vector<int> open(layout_.roots.rbegin(), layout_.roots.rend());
        while (!open.empty()) {
            const int id = open.back();
            open.pop_back();
            layout_.lines[index(id)].begin = static_cast<int>(layout_.order.size());
            layout_.order.push_back(id);
            const auto children = children_of(id);
            open.insert(open.end(), children.rbegin(), children.rend());
        }
    }

    void set_depths() {
        const auto span = [&](std::size_t id) -> std::pair<double, double> {
            if (depth_ == OverviewDepth::kGeneration) {
                const int generation = tree_.branches[id].generation;
                return {generation, generation + 1};
            }
            const BranchFacts& own = facts_.branches[id];
            return {own.root_distance_mm, own.root_distance_mm + own.length_mm};
        };
        for (const int id : layout_.order) layout_.depth = std::max(layout_.depth, span(index(id)).second);
        for (const int id : layout_.order) {
            const auto [from, to] = span(index(id));
            layout_.lines[index(id)].from = from / layout_.depth;
            layout_.lines[index(id)].to = to / layout_.depth;
        }
    }

    void place_across() {
        int slots = 0;
        std::uint32_t last_root = 0;
        for (const int id : layout_.order) {
            OverviewLine& line = layout_.lines[index(id)];
            if (tree_.branches[index(id)].parent == tree::kNoBranch) {
                if (slots > 0 && root_point(id) != last_root) ++slots; // a gap between trees
                last_root = root_point(id);
            }
            if (!children_of(id).empty()) continue;
            line.first = slots++;
            line.last = slots;
            ++layout_.leaves;
        }
        for (const int id : layout_.order) {
            OverviewLine& line = layout_.lines[index(id)];
            line.first /= slots, line.last /= slots;
        }
        std::vector<int> leaves(layout_.lines.size(), 1);
        for (std::size_t i = layout_.order.size(); i-- > 0;) {
            const int id = layout_.order[i];
            OverviewLine& line = layout_.lines[index(id)];
            const auto children = children_of(id);
            line.deepest = line.mean_end = line.to;
            if (children.empty()) {
                line.at = 0.5 * (line.first + line.last);
                line.end = line.begin + 1;
                continue;
            }
            const OverviewLine& left = layout_.lines[index(children.front())];
            const OverviewLine& right = layout_.lines[index(children.back())];
            line.first = left.first;
            line.last = right.last;
            line.at = 0.5 * (left.at + right.at);
            line.end = right.end;
            int count = 0;
            double sum = 0.0;
            for (const int child : children) {
                const OverviewLine& below = layout_.lines[index(child)];
                line.deepest = std::max(line.deepest, below.deepest);
                sum += below.mean_end * leaves[index(child)];
                count += leaves[index(child)];
            }
            leaves[index(id)] = count;
            line.mean_end = sum / count;
        }
        for (std::size_t i = 0; i < layout_.roots.size();) {
            std::size_t last = i;
            while (last + 1 < layout_.roots.size() &&
                   root_point(layout_.roots[last + 1]) == root_point(layout_.roots[i]))
                ++last;
            const double middle =
                0.5 * (layout_.lines[index(layout_.roots[i])].at + layout_.lines[index(layout_.roots[last])].at);
            layout_.root_middle.resize(last + 1, middle);
            i = last + 1;
        }
    }

    void place_links() {
        std::vector<double> middle(tree_.points.size(), 0.0);
        for (std::size_t i = 0; i < layout_.roots.size(); ++i)
            middle[root_point(layout_.roots[i])] = layout_.root_middle[i];
        const auto end_of = [&](int id, std::uint32_t root) {
            if (id == tree::kNoBranch) return glm::dvec2(middle[root], 0.0);
            const OverviewLine& line = layout_.lines[index(id)];
            return glm::dvec2(line.at, line.to);
        };
        for (std::size_t id = 0; id < tree_.branches.size(); ++id) {
            if (links_.is_link[id] == 0) continue;
            const tree::Branch& branch = tree_.branches[id];
            const OverviewLink link{static_cast<int>(id), end_of(branch.parent, branch.points.front()),
                                    end_of(links_.target[id], branch.points.back())};
            layout_.links.push_back(link);
            OverviewLine& line = layout_.lines[id]; // its index in the whole tree
            line.at = line.first = line.last = 0.5 * (link.from.x + link.to.x);
            line.from = std::min(link.from.y, link.to.y);
            line.to = line.deepest = line.mean_end = std::max(link.from.y, link.to.y);
        }
    }

    const tree::VesselTree& tree_;
    const TreeFacts& facts_;
    OverviewDepth depth_;
    Links links_;
    OverviewLayout layout_;
};

constexpr double kNarrow = 1.5; // pixels: narrower subtrees are merged

OverviewView clamped(OverviewView view) {
    for (int axis = 0; axis < 2; ++axis) {
        const double span = std::min(view.most[axis] - view.least[axis], 1.0);
        view.least[axis] = std::clamp(view.least[axis], 0.0, 1.0 - span);
        view.most[axis] = view.least[axis] + span;
    }
    return view;
}

} // namespace

OverviewLayout overview_layout(const tree::VesselTree& tree, const TreeFacts& facts, OverviewDepth depth) {
    if (tree.branches.empty()) return {};
    return Builder(tree, facts, depth).build();
}

OverviewView zoomed(const OverviewView& view, const OverviewLayout& layout, glm::dvec2 pixel, glm::dvec2 factors) {
    constexpr double kWidestLeaf = 160.0; // pixels
    constexpr double kTallest = 30.0;     // of the whole depth
    const glm::dvec2 fixed = view.to_unit(pixel);
    const glm::dvec2 least{std::min(1.0, view.pixels.x / kWidestLeaf / std::max(1, layout.leaves)), 1.0 / kTallest};
    OverviewView next = view;
    for (int axis = 0; axis < 2; ++axis) {
        const double before = view.most[axis] - view.least[axis];
        const double span = std::clamp(before / factors[axis], least[axis], 1.0);
        next.least[axis] = fixed[axis] - (fixed[axis] - view.least[axis]) * span / before;
        next.most[axis] = next.least[axis] + span;
    }
    return clamped(next);
}

OverviewView panned(const OverviewView& view, glm::dvec2 by) {
    const glm::dvec2 shift = by / view.pixels * (view.most - view.least);
    OverviewView next = view;
    next.least -= shift;
    next.most -= shift;
    return clamped(next);
}

std::vector<OverviewPiece> visible_pieces(const OverviewLayout& layout, const OverviewView& view) {
    std::vector<OverviewPiece> pieces;
    const double scale = view.pixels.x / (view.most.x - view.least.x);
    std::vector<int> open(layout.roots.rbegin(), layout.roots.rend());
    while (!open.empty()) {
        const int id = open.back();
        open.pop_back();
        const OverviewLine& line = layout.lines[index(id)];
        if (line.last < view.least.x || line.first > view.most.x || line.from > view.most.y ||
            line.deepest < view.least.y)
            continue;
        const bool merged = line.end - line.begin > 1 && (line.last - line.first) * scale < kNarrow;
        pieces.push_back({id, merged});
        if (merged) continue;
        const auto children = children_in(layout, id);
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return pieces;
}

int branch_near(const OverviewLayout& layout, const OverviewView& view, glm::dvec2 pixel, double reach) {
    int nearest = tree::kNoBranch;
    double best = reach;
    const auto consider = [&](int id, double distance) {
        if (distance > best || (distance == best && nearest != tree::kNoBranch)) return;
        best = distance;
        nearest = id;
    };
    const double scale = view.pixels.x / (view.most.x - view.least.x);
    const double slack = reach / scale;
    const double across = view.to_unit(pixel).x;
    std::vector<int> open;
    for (std::size_t i = layout.roots.size(); i-- > 0;) {
        const int id = layout.roots[i];
        const OverviewLine& line = layout.lines[index(id)];
        if (line.first - slack > std::max(across, layout.root_middle[i]) ||
            line.last + slack < std::min(across, layout.root_middle[i]))
            continue;
        // The bar at a root belongs to the branches it connects.
        consider(id, distance_to_line(pixel, view.to_pixel({line.at, line.from}),
                                      view.to_pixel({layout.root_middle[i], line.from})));
        open.push_back(id);
    }
    while (!open.empty()) {
        const int id = open.back();
        open.pop_back();
        const OverviewLine& line = layout.lines[index(id)];
        if (across < line.first - slack || across > line.last + slack) continue;
        const bool merged = line.end - line.begin > 1 && (line.last - line.first) * scale < kNarrow;
        consider(id, distance_to_line(pixel, view.to_pixel({line.at, line.from}),
                                      view.to_pixel({line.at, merged ? line.deepest : line.to})));
        if (merged) continue;
        for (const int child : children_in(layout, id)) {
            const OverviewLine& below = layout.lines[index(child)];
            consider(child, distance_to_line(pixel, view.to_pixel({below.at, below.from}),
                                             view.to_pixel({line.at, below.from})));
            open.push_back(child);
        }
    }
    for (const OverviewLink& link : layout.links)
        consider(link.branch, distance_to_line(pixel, view.to_pixel(link.from), view.to_pixel(link.to)));
    return nearest;
}

std::vector<int> branches_within(const OverviewLayout& layout, std::span<const glm::dvec2> polygon) {
    std::vector<int> ids;
    if (polygon.size() < 3) return ids;
    const Bounds<glm::dvec2> around = box_of_points(polygon);
    std::vector<double> crossings; // of the polygon with the branch's line, as fractions of the branch
    const auto inside = [&](glm::dvec2 a, glm::dvec2 b) {
        if (!around.meets({glm::min(a, b), glm::max(a, b)})) return false;
        const glm::dvec2 along = b - a;
        const auto side = [&](glm::dvec2 p) { return along.x * (p.y - a.y) - along.y * (p.x - a.x); };
        crossings.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 p = polygon[i];
            const glm::dvec2 q = polygon[(i + 1) % polygon.size()];
            const double s = side(p);
            const double t = side(q);
            if ((s >= 0.0) == (t >= 0.0)) continue;
            const glm::dvec2 at = p + (q - p) * (s / (s - t));
            crossings.push_back(glm::dot(at - a, along) / glm::dot(along, along));
        }
        std::ranges::sort(crossings);
        double covered = 0.0;
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            covered += std::max(0.0, std::min(crossings[i + 1], 1.0) - std::max(crossings[i], 0.0));
        return covered >= 0.5;
    };
    for (const int id : layout.order) {
        const OverviewLine& line = layout.lines[index(id)];
        if (inside({line.at, line.from}, {line.at, line.to})) ids.push_back(id);
    }
    for (const OverviewLink& link : layout.links)
        if (link.from != link.to && inside(link.from, link.to)) ids.push_back(link.branch);
    std::ranges::sort(ids);
    return ids;
}

} // namespace ramus::app
