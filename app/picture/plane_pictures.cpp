#include "app/picture/plane_pictures.h"

#include "app/picture/slices.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

// Pixels across the longer side: a plane among vessels is looked at from aslant, and each takes milliseconds.
constexpr double kMostPixels = 480.0;

// Covers the bounds of the scan with pixels of its smallest spacing, or larger ones.
slice::PixelGrid plane_grid(const Session& session, const Assets& assets, slice::Direction direction) {
    Session whole = session;
    whole.slices.zooms[index_of(direction)] = {};
    constexpr glm::ivec2 kShape(1000);
    const slice::PixelGrid fitted = grid_of(whole, assets, direction, kShape);
    const double extent = kShape.x * glm::length(fitted.right);
    const double mm = std::max(step_mm_of_pixels(session, assets), extent / kMostPixels);
    const auto side = static_cast<int>(std::ceil(extent / mm));
    return slice::grid_around(axes_of(session.slices, direction), fitted.middle(), mm, glm::ivec2(std::max(side, 1)));
}

} // namespace

std::vector<render::ScanPlane> PlanePictures::planes(const Session& session, const Assets& assets) {
    std::vector<render::ScanPlane> planes;
    for (const auto& [direction, name] : slice::kDirections) {
        std::optional<Kept>& kept = kept_[index_of(direction)];
        if (!session.slices.in_picture[index_of(direction)]) {
            kept.reset();
            continue;
        }
        render::SliceView view;
        view.grid = plane_grid(session, assets, direction);
        view.sampling = session.slices.sampling;
        add_scans(view, session, assets);
        if (!kept) kept.emplace();
        if (!kept->picture || kept->of != view) {
            kept->picture = std::make_shared<const render::Image>(kept->painter.paint_alone(view));
            kept->of = view;
        }
        const slice::PixelGrid& grid = view.grid;
        const bool any = !view.scans.empty() || !view.masks.empty();
        planes.push_back({grid.place(glm::dvec2(-0.5)), static_cast<double>(grid.size.x) * grid.right,
                          static_cast<double>(grid.size.y) * grid.down, any ? kept->picture : nullptr,
                          colour_of(direction), 2.0F});
    }
    return planes;
}

} // namespace ramus::app
