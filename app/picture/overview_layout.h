// The tree as a flat picture, a dendrogram: every branch a line that runs down from its parent's end, the deeper the
// further from the root. Leaves stand evenly across; a parent stands in the middle of its children, so lines never
// cross. Left and right are as the anterior view has them. Branches that close a loop are thin links between two ends.
//
// Pure geometry in a unit square, x across and y down, without pixels, colours or ImGui; time is linear in the branches
// but for sorting siblings, nothing recurses. What the window draws of it follows from visible_pieces(), whose number
// is bounded by the pixels there are and not by the branches.
#pragma once

#include "app/session/branch_facts.h"
#include "core/tree/vessel_tree.h"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace ramus::app {

// What "down" means.
enum class OverviewDepth { kGeneration, kDistance }; // branchings, or mm along the vessels

struct OverviewLine {
    double at = 0.0;                // across
    double from = 0.0, to = 0.0;    // down, of the branch itself
    double first = 0.0, last = 0.0; // extent across of it and all below
    double deepest = 0.0;           // down, of it and all below
    double mean_end = 0.0;          // down, mean of the leaves below
    int begin = -1, end = -1;       // indices into OverviewLayout::order of it and all below; -1: a link
};

// A branch that closes a loop: from where it begins to where it ends.
struct OverviewLink {
    int branch = tree::kNoBranch;
    glm::dvec2 from{0.0}, to{0.0};
};

struct OverviewLayout {
    std::vector<OverviewLine> lines; // by branch id
    std::vector<OverviewLink> links;
    std::vector<int> order;          // branches but links, each before all below it, from left to right
    std::vector<int> children;       // but links, from left to right: of branch id those from
    std::vector<int> first_child;    // first_child[id] up to first_child[id + 1]
    std::vector<int> roots;          // branches at a root, from left to right
    std::vector<double> root_middle; // of these: where their root stands, across
    int leaves = 0;
    double depth = 0.0; // what y = 1 means: generations, or mm
};

[[nodiscard]] OverviewLayout overview_layout(const tree::VesselTree& tree, const TreeFacts& facts, OverviewDepth depth);

// The part of the unit square that is seen, and on how many pixels.
struct OverviewView {
    glm::dvec2 least{0.0}, most{1.0};
    glm::dvec2 pixels{1.0};
    bool operator==(const OverviewView&) const = default;

    [[nodiscard]] glm::dvec2 to_pixel(glm::dvec2 unit) const { return (unit - least) / (most - least) * pixels; }
    [[nodiscard]] glm::dvec2 to_unit(glm::dvec2 pixel) const { return least + pixel / pixels * (most - least); }
};

// Magnified about a pixel that stays where it is, and moved by pixels; never beyond the whole, nor closer than makes
// sense for so many leaves.
[[nodiscard]] OverviewView zoomed(const OverviewView& view, const OverviewLayout& layout, glm::dvec2 pixel,
                                  glm::dvec2 factors);
[[nodiscard]] OverviewView panned(const OverviewView& view, glm::dvec2 by);

// A branch, or one with all below it where that is too narrow to be told apart.
struct OverviewPiece {
    int branch = tree::kNoBranch;
    bool merged = false;
};
[[nodiscard]] std::vector<OverviewPiece> visible_pieces(const OverviewLayout& layout, const OverviewView& view);

// The branch whose line is nearest to a pixel, no farther than `reach` pixels; kNoBranch when none is.
[[nodiscard]] int branch_near(const OverviewLayout& layout, const OverviewView& view, glm::dvec2 pixel, double reach);

// The branches that have at least half of their line within a closed polygon in the unit square (even-odd), ascending.
[[nodiscard]] std::vector<int> branches_within(const OverviewLayout& layout, std::span<const glm::dvec2> polygon);

} // namespace ramus::app
