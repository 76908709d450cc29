// The overview panel under the picture: the tree as a dendrogram (app/picture/overview_layout.h), linked both ways with
// the picture. This is what it remembers between frames; draw_overview() does the rest.
#pragma once

#include "app/picture/overview_layout.h"
#include "app/session/session.h"

#include <glm/vec4.hpp>
#include <imgui.h>
#include <vector>

namespace ramus::app {

// How the picture shows branches beyond what the session says.
struct PictureLook {
    std::vector<glm::vec3> colours; // by branch id, sRGB; empty: all alike
    int hovered = tree::kNoBranch;
    std::vector<int> glowing; // with the hovered one
    std::vector<render::LostPart> lost;
    bool operator==(const PictureLook&) const = default;
};

struct Overview {
    bool open = false;
    OverviewDepth depth = OverviewDepth::kGeneration;
    float height = 190.0F; // points
    [[nodiscard]] float wanted_height() const { return open ? height : 0.0F; }

    // Made when needed.
    OverviewLayout layout;
    const TreeFacts* layout_of = nullptr;
    OverviewDepth layout_depth = OverviewDepth::kGeneration;
    OverviewView view;
    int shown_selection = tree::kNoBranch; // the view was moved to it

    // A line's colour, of every branch and summed up over OverviewLayout::order.
    struct Look {
        glm::vec4 colour{0.0F}; // sRGB and opacity
        bool selected = false;
        bool hovered = false;
        float lost_from = 2.0F, lost_to = 2.0F; // of its length; beyond 1: none
    };
    std::vector<Look> looks;
    std::vector<glm::dvec4> colour_sums;
    std::vector<int> selected_sums, hovered_sums;
    std::vector<render::BranchState> looks_states; // what they were made of
    std::vector<int> looks_selection;
    PictureLook looks_picture;

    // The mouse in it.
    enum class Drag { kNone, kPan, kLasso };
    Drag drag = Drag::kNone;
    bool dragged = false; // far enough not to be a click
    ImVec2 last{0.0F, 0.0F};
    std::vector<glm::dvec2> lasso; // unit coordinates
};

// How lines look, as branches do in the picture, hidden ones faint; made anew when something of it has changed.
void make_looks(Overview& overview, const Marks& marks, const PictureLook& picture);
// Of a line that stands for one branch, or for several.
[[nodiscard]] Overview::Look look_of(const Overview& overview, const OverviewPiece& piece);

} // namespace ramus::app
