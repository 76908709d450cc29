// Pictures for papers and slides: drawn larger and reduced, with a caption and letters, four views on one sheet, a
// turntable of pictures.
#pragma once

#include "core/base/error.h"
#include "render/sheet.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace ramus::app {

struct FigureFlags {
    int supersample = 1; // pixels a side that become one
    int turntable = 0;   // pictures once around; 0: one picture
    bool sheet = false;
    std::string caption;               // UTF-8
    std::vector<std::string> overlays; // of kOverlayNames; "none"
    bool overlays_given = false;
};

void add_figure_flags(CLI::App& command, FigureFlags& flags);

// What the flags say about what lies over the tree.
void dress(render::Frame& frame, const FigureFlags& flags);

// The picture, drawn `supersample` times as large and reduced. Fails where that is too large.
[[nodiscard]] Result<render::Image> draw_figure(render::Renderer& renderer, render::Frame frame,
                                                const FigureFlags& flags);

// The same of a sheet.
void dress(render::Sheet& sheet, const FigureFlags& flags);
[[nodiscard]] Result<render::Image> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet,
                                                const FigureFlags& flags);

// Four views in the size of the frame: anterior, left, posterior, superior; all at one scale.
[[nodiscard]] Result<render::Image> draw_sheet(render::Renderer& renderer, const render::Frame& frame,
                                               const FigureFlags& flags);

// name.png becomes name_001.png, ...: once around the tree to the viewer's right, which stays whole in all of them
// unless `keep_camera`. Returns the files.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_turntable(render::Renderer& renderer,
                                                                         const render::Frame& frame,
                                                                         const FigureFlags& flags, bool keep_camera,
                                                                         const std::filesystem::path& output);

} // namespace ramus::app
