// compose_sheet(): the picture of a session including its comparison of surfaces or plans: the layout of the viewports,
// their surfaces and frames. Without a comparison there is one viewport with the frame of compose(). Used by the
// window, its mouse and headless pictures.
#pragma once

#include "app/picture/compose.h"
#include "app/picture/shown_surfaces.h"
#include "render/renderer/sheet.h"

#include <vector>

namespace ramus::app {

// A part of the picture that shows one surface, or one plan.
struct Viewport {
    glm::ivec2 at{0}, size{1}; // pixels; all viewports of a picture have one size
    Compared surface = Compared::kConvolutionSurface;
    std::string title;                       // UTF-8; empty: no comparison
    bool has_branches = true;                // false for masks
    std::optional<std::size_t> plan{};       // of the session, where plans are compared
    std::optional<slice::Direction> slice{}; // shows this slice instead of the tree
    bool along = false;                      // `slice` is set, but the picture is along the vessel that slices follow
    bool operator==(const Viewport&) const = default;
};

// Viewports of a picture of `size`: those of the layout of slices, unless surfaces or plans are compared. Then: side by
// side, or below each other if the picture is higher than wide, separated by a thin line; plans that are compared, in
// their order. Two viewports at the same place are blended or wiped. Superimposed surfaces share the first one's
// viewport.
[[nodiscard]] std::vector<Viewport> viewports_of(const Session& session, glm::ivec2 size, float pixel_ratio);

inline constexpr glm::vec3 kDividerColour{0.24F, 0.26F, 0.29F}; // sRGB

struct SheetViewing {
    int heading_top = 0;           // pixels at the top that are occupied
    std::optional<double> blend{}; // trial value that replaces the session's
    std::optional<double> wipe{};  // trial value
};

// `viewing.size`: of the whole picture.
[[nodiscard]] render::Sheet compose_sheet(const Session& session, const Assets& assets, const ShownSurfaces& surfaces,
                                          const Viewing& viewing, const SheetViewing& sheet_viewing = {});

} // namespace ramus::app
