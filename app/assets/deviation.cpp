#include "app/assets/deviation.h"

#include <utility>

namespace ramus::app {

DeviationOf deviation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks,
                         const mesh::SurfaceOptions& options) {
    DeviationOf of;
    of.tree = std::move(tree);
    of.from = marks.deviation.from;
    switch (of.from) {
    case DeviationChoice::From::kCones:
        of.options = options;
        of.hidden = branches_in_state(marks, tree::BranchState::kHidden);
        break;
    case DeviationChoice::From::kIsosurface:
        of.file = marks.comparison.mask;
        if (!of.file.empty()) of.units = marks.comparison.mask_units, of.labels = marks.comparison.labels;
        break;
    case DeviationChoice::From::kFile:
        of.file = marks.deviation.file;
        of.axes = marks.deviation.axes;
        break;
    }
    return of;
}

} // namespace ramus::app
