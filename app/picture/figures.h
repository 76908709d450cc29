// Pictures for papers and slides: drawn larger and reduced, with a caption and letters, and from several sides.
#pragma once

#include "app/picture/figure_options.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "render/renderer/sheet.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace ramus::app {

// What the options say about what lies behind the tree and over it.
void dress(render::Sheet& sheet, const FigureOptions& options);

// A picture, and the scale bar that it has, in its own pixels: of several views the one that all of them have.
struct Figure {
    render::Image image;
    std::optional<render::ScaleBar> scale_bar; // none: there is none, or they differ
};

// The picture, drawn `supersample` times as large and reduced; all headings that stand beside each other stand below
// the caption. Fails where that is too large.
[[nodiscard]] Result<Figure> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet,
                                         const FigureOptions& options);

// Pictures from several sides: four views on one sheet, and once around. Surfaces that are compared are in every one of
// them, seen by one camera.

// The document's picture in another size: its viewports are where that has room for them.
using ComposeSheet = std::function<Result<render::Sheet>(glm::ivec2 size)>;

// Anterior, left, posterior and superior, all at one scale, in a picture of this size: two and two; where surfaces are
// compared side by side a column each, with the surfaces below each other, or a row each in a picture that is higher
// than wide. What stands over all of a row or a column stands there once.
struct FourViews {
    render::Image ground; // of the whole size, what lies between the views in it
    struct View {
        render::Sheet sheet; // for draw_figure()
        glm::ivec2 at;       // its upper left pixel
    };
    std::vector<View> views;
};
[[nodiscard]] Result<FourViews> four_views(const ComposeSheet& compose, glm::ivec2 size, const FigureOptions& options);
[[nodiscard]] Result<Figure> draw_four_views(render::SheetRenderer& renderer, const ComposeSheet& compose,
                                             glm::ivec2 size, const FigureOptions& options);

// name_001.png: the file of this picture of a turntable of so many, from 0.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& output, int index, int count);
// The sheet as this picture of a turntable has it, from 0.
void look_around(render::Sheet& sheet, const FigureOptions& options, std::size_t picture);

// Once around the tree to the viewer's right, which stays whole in all of them where `options.whole`. name.png becomes
// name_001.png, ...; name.mp4 is a video, which takes ffmpeg. Files appear when all are drawn; cancelled before, none
// does.
struct Turntable {
    std::vector<std::filesystem::path> files;
    std::optional<render::ScaleBar> scale_bar; // as of Figure
};
[[nodiscard]] Result<Turntable> write_turntable(render::SheetRenderer& renderer, const render::Sheet& sheet,
                                                const FigureOptions& options, const std::filesystem::path& output,
                                                Job& job);

// The file or files of a request, of a document's picture that would have this size.
[[nodiscard]] Result<void> write_figure(render::SheetRenderer& renderer, const ComposeSheet& compose, glm::ivec2 size,
                                        const FigureRequest& request, Job& job);

} // namespace ramus::app
