// State of the overview panel between frames. The panel, below the picture, shows the tree as a dendrogram
// (app/picture/overview_layout.h), linked with the picture. draw_overview() draws it.
#pragma once

#include "app/picture/overview_layout.h"
#include "app/session/session.h"

#include <glm/vec4.hpp>
#include <imgui.h>
#include <vector>

namespace ramus::app {

// How the picture shows branches, apart from the session's marks.
struct PictureLook {
    std::vector<glm::vec3> colours; // by branch id, sRGB; empty: one colour
    int hovered = tree::kNoBranch;
    std::vector<int> glowing; // dependents of the hovered branch
    std::vector<render::LostPart> lost;
    bool operator==(const PictureLook&) const = default;
};

struct Overview {
    bool open = false;
    OverviewDepth depth = OverviewDepth::kGeneration;
    float height = 190.0F; // points
    [[nodiscard]] float wanted_height() const { return open ? height : 0.0F; }

    // Computed on demand.
    OverviewLayout layout;
    const TreeFacts* layout_of = nullptr;
    OverviewDepth layout_depth = OverviewDepth::kGeneration;
    OverviewView view;
    int shown_selection = tree::kNoBranch; // the view has been moved to it

    // Appearance of each branch's line, and prefix sums over OverviewLayout::order.
    struct Look {
        glm::vec4 colour{0.0F}; // sRGB and opacity
        bool selected = false;
        bool hovered = false;
        float lost_from = 2.0F, lost_to = 2.0F; // fractions of its length; beyond 1: nothing is lost
    };
    std::vector<Look> looks;
    std::vector<glm::dvec4> colour_sums;
    std::vector<int> selected_sums, hovered_sums;
    std::vector<tree::BranchState> looks_states; // the inputs of `looks`
    std::vector<int> looks_selection;
    PictureLook looks_picture;

    // The mouse in the panel.
    enum class Drag { kNone, kPan, kLasso };
    Drag drag = Drag::kNone;
    bool dragged = false; // far enough not to be a click
    ImVec2 last{0.0F, 0.0F};
    std::vector<glm::dvec2> lasso; // unit coordinates
};

// Computes the appearance of lines, as in the picture, with hidden branches faint; only if an input has changed.
void make_looks(Overview& overview, const Marks& marks, const PictureLook& picture);
// The appearance of a line for one branch or several merged ones.
[[nodiscard]] Overview::Look look_of(const Overview& overview, const OverviewPiece& piece);

} // namespace ramus::app
