// Pictures for papers and slides: drawn larger and reduced, with a caption and letters. Those from several sides are
// in several_views.h.
#pragma once

#include "core/base/error.h"
#include "render/renderer/sheet.h"

#include <CLI/CLI.hpp>
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

// The picture, drawn `supersample` times as large and reduced; all headings that stand beside each other stand below
// the caption. Fails where that is too large.
[[nodiscard]] Result<render::Image> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet,
                                                const FigureFlags& flags);

} // namespace ramus::app
