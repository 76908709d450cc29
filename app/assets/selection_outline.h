// The outline of selected vessels where others hide them: two lines along each, a radius to either side of the
// centerline as the eye sees it. The picture shows them only where something that is not selected lies before them
// (render::MarkLine::of_selection). Of so many points at the most: the branches with the largest radii come first.
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
        std::shared_ptr<const render::Centerlines> lines; // null: there is no outline
        render::Camera camera;
        std::vector<render::BranchState> states; // by branch id; branches beyond its end are normal
        std::vector<int> selection;              // branch ids
        bool operator==(const Of&) const = default;
    };
    Of of;
    std::vector<render::MarkLine> marks;
};

// Some milliseconds where much is selected: who draws picture after picture keeps it.
[[nodiscard]] SelectionOutline selection_outline(SelectionOutline::Of of);

} // namespace ramus::app
