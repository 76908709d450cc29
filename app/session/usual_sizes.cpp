#include "app/session/usual_sizes.h"

#include "render/overlay/scale_bar.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <vector>

namespace ramus::app {

UsualSizes usual_sizes(const tree::VesselTree& tree) {
    constexpr double kOfDiagonal = 0.05; // radius of a lesion, relative to the diagonal
    UsualSizes sizes;
    const render::Box box = render::bounds_of(tree);
    if (box.empty()) return sizes;
    const double diagonal = 2.0 * box.radius(), usual = sizes.lesion_radius_mm;
    sizes.lesion_radius_mm = std::min(usual, render::scale_bar_length_mm(kOfDiagonal * diagonal));
    std::vector<double>& margins = sizes.planning.bands_mm;
    if (!(diagonal > 0.0) || margins.back() < 0.5 * diagonal) return sizes;
    const double share = sizes.lesion_radius_mm / usual;
    for (double& margin : margins) margin *= share;
    sizes.planning.reconstruct_mm *= share;
    sizes.planning.touch_mm *= share;
    sizes.thin_mm *= share;
    return sizes;
}

} // namespace ramus::app
