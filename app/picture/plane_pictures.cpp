#include "app/picture/plane_pictures.h"

#include "app/picture/slices.h"
#include "render/scene/late_picture.h"
#include "render/slice/slice_painter.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <mutex>

namespace ramus::app {

namespace {

// Pixels across the longer side: a plane among vessels is looked at from aslant, and each takes milliseconds.
constexpr double kMostPixels = 480.0;

// Covers the first scan, or what there is without one, by pixels of the smallest spacing of voxels, or larger ones.
slice::PixelGrid plane_grid(const Session& session, const Assets& assets, slice::Direction direction) {
    const slice::Axes axes = axes_of(session.slices, direction);
    const glm::dvec3 at = crosshair_of(session, assets);
    const slice::PixelGrid fitted =
        zoomed_grid(session, assets, direction, glm::ivec2(static_cast<int>(kMostPixels)), {});
    const auto volume = first_volume(session, assets);
    if (!volume) return fitted;
    return slice::grid_covering(*volume, axes, at,
                                std::max(slice::smallest_spacing_mm(*volume), glm::length(fitted.right)));
}

} // namespace

// One at a time: pictures of a slice share what was sampled for the one before.
class PlanePictures::Painter {
public:
    [[nodiscard]] render::Image paint(const render::SliceView& view) {
        const std::lock_guard lock(one_);
        return painter_.paint_alone(view);
    }

private:
    std::mutex one_;
    render::SlicePainter painter_;
};

std::vector<render::ScanPlane> PlanePictures::planes(const Session& session, const Assets& assets) {
    std::vector<render::ScanPlane> planes;
    for (const auto& [direction, name] : slice::kDirections) {
        std::optional<Kept>& kept = kept_[slice_index(direction)];
        if (!session.slices.in_picture[slice_index(direction)]) {
            kept.reset();
            continue;
        }
        render::SliceView view;
        view.grid = plane_grid(session, assets, direction);
        view.sampling = session.slices.sampling;
        add_scans(view, session, assets);
        if (!kept) kept = Kept{{}, std::make_shared<Painter>(), nullptr};
        if (!kept->picture || kept->of != view) {
            kept->picture = std::make_shared<const render::LatePicture>(
                [painter = kept->painter, view] { return painter->paint(view); });
            kept->of = view;
        }
        const slice::PixelGrid& grid = view.grid;
        const bool any = !view.scans.empty() || !view.masks.empty();
        planes.push_back({grid.place(glm::dvec2(-0.5)), static_cast<double>(grid.size.x) * grid.right,
                          static_cast<double>(grid.size.y) * grid.down, any ? kept->picture : nullptr,
                          slice_colour(direction), 2.0F});
    }
    return planes;
}

} // namespace ramus::app
