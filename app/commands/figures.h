// Pictures for papers and slides: drawn larger and reduced, with a caption and letters, and from several sides.
#pragma once

#include "core/base/error.h"
#include "render/renderer/sheet.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct FigureFlags {
    int supersample = 1; // pixels a side that become one
    int samples = 16;    // of each pixel, where nothing is drawn larger
    int turntable = 0;   // pictures once around; 0: one picture
    bool sheet = false;
    std::string caption;               // UTF-8
    std::vector<std::string> overlays; // of kOverlayNames; "none"
    bool overlays_given = false;
};

void add_figure_flags(CLI::App& command, FigureFlags& flags);

// What the flags say about what lies over the tree.
void dress(render::Sheet& sheet, const FigureFlags& flags);

// A picture, and the scale bar that it has, in its own pixels: of several views the one that all of them have.
struct Figure {
    render::Image image;
    std::optional<render::ScaleBar> scale_bar; // none: there is none, or they differ
};

// The picture, drawn `supersample` times as large and reduced; all headings that stand beside each other stand below
// the caption. Fails where that is too large.
[[nodiscard]] Result<Figure> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet,
                                         const FigureFlags& flags);

// Pictures from several sides: four views on one sheet, and once around. Surfaces that are compared are in every one of
// them, seen by one camera.

// The document's picture in another size: its viewports are where that has room for them.
using ComposeSheet = std::function<Result<render::Sheet>(glm::ivec2 size)>;

// Anterior, left, posterior and superior, all at one scale, in a picture of this size: two and two; where surfaces are
// compared side by side a column each, with the surfaces below each other, or a row each in a picture that is higher
// than wide. What stands over all of a row or a column stands there once.
[[nodiscard]] Result<Figure> draw_four_views(render::SheetRenderer& renderer, const ComposeSheet& compose,
                                             glm::ivec2 size, const FigureFlags& flags);

// name.png becomes name_001.png, ...: once around the tree to the viewer's right, which stays whole in all of them
// unless `keep_camera`.
struct Turntable {
    std::vector<std::filesystem::path> files;
    std::optional<render::ScaleBar> scale_bar; // as of Figure
};
[[nodiscard]] Result<Turntable> write_turntable(render::SheetRenderer& renderer, const render::Sheet& sheet,
                                                const FigureFlags& flags, bool keep_camera,
                                                const std::filesystem::path& output);

} // namespace ramus::app
