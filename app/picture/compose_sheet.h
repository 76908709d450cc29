// compose_sheet(): a session's picture with what it is compared with: where the viewports are, what each of them shows,
// and their frames. Nothing is compared: one viewport, whose frame is compose()'s. The window, its mouse and pictures
// without a window share it.
#pragma once

#include "app/picture/compose.h"
#include "app/picture/shown_surfaces.h"
#include "render/renderer/sheet.h"

#include <vector>

namespace ramus::app {

// A part of the picture that shows one surface.
struct Viewport {
    glm::ivec2 at{0}, size{1}; // pixels; all viewports of a picture have one size
    Compared surface = Compared::kConvolutionSurface;
    std::string title;        // UTF-8; empty: nothing is compared
    bool has_branches = true; // a mask has none
    bool operator==(const Viewport&) const = default;
};

// Of a picture of `size`. Beside each other, or below each other where the picture is higher than wide; a thin line is
// left between them. Two that cover the same place are blended, or parted by a line. Superimposed surfaces share one
// viewport, the first's.
[[nodiscard]] std::vector<Viewport> viewports_of(const Marks& marks, glm::ivec2 size, float pixel_ratio);

inline constexpr glm::vec3 kDividerColour{0.24F, 0.26F, 0.29F}; // sRGB

struct SheetViewing {
    int heading_top = 0;           // pixels at the top that something else takes
    std::optional<double> blend{}; // instead of the session's, while it is being tried
    std::optional<double> wipe{};  // likewise
};

// `viewing.size` is the whole picture's.
[[nodiscard]] render::Sheet compose_sheet(const Session& session, const Assets& assets, const ShownSurfaces& surfaces,
                                          const Viewing& viewing, const SheetViewing& sheet_viewing = {});

} // namespace ramus::app
