// Layout of the overview: the tree as a dendrogram. Each branch is a line that runs down from its parent's end; depth
// increases with the distance from the root. Leaves are evenly spaced; parents are centred above their children, so
// lines never cross. Left and right are those of the anterior view. Branches that close a loop are thin links between
// two ends.
//
// Pure geometry in a unit square, x to the right and y down, without pixels, colours or ImGui. Time is linear in the
// number of branches except for sorting siblings; no recursion. The window draws visible_pieces(), whose number is
// bounded by the number of pixels, not of branches.
#pragma once

#include "app/session/branch_facts.h"
#include "core/tree/vessel_tree.h"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace ramus::app {

// The vertical axis.
enum class OverviewDepth { kGeneration, kDistance }; // number of branchings, or mm along the vessels

struct OverviewLine {
    double at = 0.0;                // x
    double from = 0.0, to = 0.0;    // y, of the branch
    double first = 0.0, last = 0.0; // range in x of the branch and its subtree
    double deepest = 0.0;           // largest y of the branch and its subtree
    double mean_end = 0.0;          // mean y of the leaves of its subtree
    int begin = -1, end = -1;       // range in OverviewLayout::order of the branch and its subtree; -1: a link
};

// A branch that closes a loop: its two ends.
struct OverviewLink {
    int branch = tree::kNoBranch;
    glm::dvec2 from{0.0}, to{0.0};
};

struct OverviewLayout {
    std::vector<OverviewLine> lines; // by branch id
    std::vector<OverviewLink> links;
    std::vector<int> order;          // branches except links, parents before children, from left to right
    std::vector<int> children;       // except links, from left to right; those of branch id are from
    std::vector<int> first_child;    // first_child[id] up to, not including, first_child[id + 1]
    std::vector<int> roots;          // branches at a root, from left to right
    std::vector<double> root_middle; // x of the root of each of `roots`
    int leaves = 0;
    double depth = 0.0; // value of y = 1: generations, or mm
};

[[nodiscard]] OverviewLayout overview_layout(const tree::VesselTree& tree, const TreeFacts& facts, OverviewDepth depth);

// The visible part of the unit square, and its size in pixels.
struct OverviewView {
    glm::dvec2 least{0.0}, most{1.0};
    glm::dvec2 pixels{1.0};
    bool operator==(const OverviewView&) const = default;

    [[nodiscard]] glm::dvec2 to_pixel(glm::dvec2 unit) const { return (unit - least) / (most - least) * pixels; }
    [[nodiscard]] glm::dvec2 to_unit(glm::dvec2 pixel) const { return least + pixel / pixels * (most - least); }
};

// Zooms about a fixed pixel, and pans by pixels. Both stay within the unit square; the largest zoom depends on the
// number of leaves.
[[nodiscard]] OverviewView zoomed(const OverviewView& view, const OverviewLayout& layout, glm::dvec2 pixel,
                                  glm::dvec2 factors);
[[nodiscard]] OverviewView panned(const OverviewView& view, glm::dvec2 by);

// A branch, or a branch merged with its subtree if that is too narrow to distinguish.
struct OverviewPiece {
    int branch = tree::kNoBranch;
    bool merged = false;
};
[[nodiscard]] std::vector<OverviewPiece> visible_pieces(const OverviewLayout& layout, const OverviewView& view);

// The branch whose line is nearest to a pixel, within `reach` pixels; kNoBranch: none.
[[nodiscard]] int branch_near(const OverviewLayout& layout, const OverviewView& view, glm::dvec2 pixel, double reach);

// The branches with at least half of their line inside a closed polygon (even-odd) in the unit square, ascending.
[[nodiscard]] std::vector<int> branches_within(const OverviewLayout& layout, std::span<const glm::dvec2> polygon);

} // namespace ramus::app
