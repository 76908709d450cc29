// The outline of selected vessels where others hide them: two lines along each vessel, a radius to either side of the
// centerline as seen by the eye. Pictures show them only where something that is not selected is in front
// (render::MarkLine::of_selection). The number of points is limited; branches with the largest radii come first.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/camera.h"
#include "render/scene/centerlines.h"
#include "render/scene/frame.h"

#include <memory>
#include <vector>

namespace ramus::app {

struct SelectionOutline {
    struct Of {
        std::shared_ptr<const tree::VesselTree> tree;
        std::shared_ptr<const render::Centerlines> lines; // null: no outline
        render::Camera camera;
        std::vector<tree::BranchState> states; // by branch id; branches without an entry are normal
        std::vector<int> selection;            // branch ids
        bool operator==(const Of&) const = default;
    };
    Of of;
    std::vector<render::MarkLine> marks;
};

// Takes some milliseconds for large selections: callers that draw repeatedly should keep the result.
[[nodiscard]] SelectionOutline selection_outline(SelectionOutline::Of of);

} // namespace ramus::app
