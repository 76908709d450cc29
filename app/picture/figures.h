// Draws pictures for papers and slides: supersampled, with caption and letters, from several sides, or as a turntable.
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

// Applies the options' background and overlays to a sheet.
void dress(render::Sheet& sheet, const FigureOptions& options);

// A picture and its scale bar, in the picture's pixels; for several views only if all have the same bar.
struct Figure {
    render::Image image;
    std::optional<render::ScaleBar> scale_bar; // none: no bar, or different ones
};

// Draws the sheet `supersample` times as large and reduces it. Headings side by side are placed below the caption.
// Fails if the picture is too large to draw.
[[nodiscard]] Result<Figure> draw_figure(render::SheetRenderer& renderer, render::Sheet sheet,
                                         const FigureOptions& options);

// Pictures from several sides: four views on one sheet, and once around. Surfaces that are compared are in every one of
// them, seen by one camera.

// The document's picture in another size, with its viewports arranged for that size.
using ComposeSheet = std::function<Result<render::Sheet>(glm::ivec2 size)>;

// Four views (anterior, left, posterior, superior) at one scale in a picture of this size: two by two. If surfaces are
// compared side by side, each view has a column with the surfaces below each other, or a row in a picture that is
// higher than wide. Headings common to a row or column appear once.
struct FourViews {
    render::Image ground; // of the whole size, with everything between the views
    struct View {
        render::Sheet sheet; // for draw_figure()
        glm::ivec2 at;       // its upper left pixel
    };
    std::vector<View> views;
};
[[nodiscard]] Result<FourViews> four_views(const ComposeSheet& compose, glm::ivec2 size, const FigureOptions& options);
[[nodiscard]] Result<Figure> draw_four_views(render::SheetRenderer& renderer, const ComposeSheet& compose,
                                             glm::ivec2 size, const FigureOptions& options);

// The file of picture `index` of `count` of a turntable, counted from 0: name_001.png.
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& output, int index, int count);
// Turns the sheet's cameras to this picture of a turntable, counted from 0.
void look_around(render::Sheet& sheet, const FigureOptions& options, std::size_t picture);

// Writes pictures once around the tree, turning to the viewer's right; with `options.whole` the tree stays completely
// in all of them. name.png becomes name_001.png, ...; name.mp4 is a video and requires ffmpeg. Files appear after all
// pictures are drawn; a cancelled job leaves none.
struct Turntable {
    std::vector<std::filesystem::path> files;
    std::optional<render::ScaleBar> scale_bar; // see Figure
};
[[nodiscard]] Result<Turntable> write_turntable(render::SheetRenderer& renderer, const render::Sheet& sheet,
                                                const FigureOptions& options, const std::filesystem::path& output,
                                                Job& job);

// Writes the file or files of a request. `size`: of the document's picture, used if the request has none.
[[nodiscard]] Result<void> write_figure(render::SheetRenderer& renderer, const ComposeSheet& compose, glm::ivec2 size,
                                        const FigureRequest& request, Job& job);

} // namespace ramus::app
