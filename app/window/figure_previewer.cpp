#include "app/window/figure_previewer.h"

#include "app/picture/compose_sheet.h"
#include "app/picture/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glad/gl.h>

namespace ramus::app {

namespace {

// The largest of the shape of `full` in `most`.
glm::ivec2 fitting(glm::ivec2 full, glm::ivec2 most) {
    const double shrink = std::min(double(most.x) / full.x, double(most.y) / full.y);
    return glm::max(glm::ivec2(glm::dvec2(full) * shrink + 0.5), glm::ivec2(1));
}

// Of large trees even the coarser surface takes longer to send and draw than a window may: centerlines are cast then,
// as while the view moves.
void cast_if_large(render::Frame& frame) {
    constexpr std::uint64_t kMostDrawn = 300'000; // triangles
    const bool needs_mesh = frame.only_mesh || frame.scale.value == render::ColourScale::Value::kSurface;
    if (needs_mesh || !frame.centerlines || !frame.mesh || frame.mesh->triangle_count() <= kMostDrawn) return;
    frame.surface_awaited = true;
    frame.quality = render::Quality::kInteractive;
}

} // namespace

// The coarser surface is as good as the fine one, so small.
render::Sheet FigurePreviewer::small_sheet(glm::ivec2 size) const {
    Workspace& workspace = state_.workspace;
    const ShownSurfaces surfaces = workspace.surfaces();
    render::Sheet sheet =
        compose_sheet(workspace.document.session(), workspace.current_assets(), surfaces, {.size = size});
    const auto viewports = viewports_of(workspace.document.marks(), size, 1.0F);
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        if (auto preview = surfaces.preview_of(viewports[i].surface))
            sheet.viewports[i].frame.mesh = std::move(preview);
        if (sheet.viewports[i].has_branches) cast_if_large(sheet.viewports[i].frame);
    }
    return sheet;
}

Result<render::Image> FigurePreviewer::drawn(glm::ivec2 size) {
    render::SheetRenderer sheets(*renderer_);
    FigureOptions options = shown_->options;
    options.supersample = 1;
    options.samples = 4;
    options.text_size *= double(size.x) / shown_->full.x;
    const auto compose = [this](glm::ivec2 part) -> Result<render::Sheet> { return small_sheet(part); };
    const auto image_of = [](Result<Figure> figure) -> Result<render::Image> {
        if (!figure) return tl::unexpected(figure.error());
        return std::move(figure->image);
    };
    if (options.sheet) return image_of(draw_four_views(sheets, compose, size, options));
    render::Sheet sheet = small_sheet(size);
    dress(sheet, options);
    if (options.turntable > 0) look_around(sheet, options, 0);
    return image_of(draw_figure(sheets, std::move(sheet), options));
}

void FigurePreviewer::show(const render::Image& image) {
    texture_ = render::make_texture(GL_RGBA8, image.width, image.height);
    glTextureSubImage2D(texture_, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    FigurePreview& preview = state_.interface.preview;
    preview.texture = texture_;
    preview.size = {image.width, image.height};
}

void FigurePreviewer::let_go() {
    renderer_.reset();
    texture_ = {};
    shown_.reset();
    state_.interface.preview.texture = 0;
}

void FigurePreviewer::update() {
    FigurePreview& preview = state_.interface.preview;
    if (!preview.wanted || !preview.request.size || !state_.workspace.shown().mesh) {
        if (renderer_) let_go();
        return;
    }
    const glm::ivec2 full = *preview.request.size;
    if (!render::check_size(full.x, full.y)) return;
    const glm::ivec2 size = fitting(full, preview.most);
    Wanted wanted{small_sheet(size), preview.request.options, full};
    if (shown_ == wanted) return;
    state_.redraw();
    if (!renderer_) { // takes about as long as a preview: in a frame of its own
        if (auto made = render::Renderer::create()) {
            renderer_ = std::move(*made);
            return;
        }
    }
    shown_ = std::move(wanted);
    preview.texture = 0;
    if (!renderer_) return;
    try {
        if (auto image = drawn(size)) return show(*image);
    } catch (const render::OutOfGraphicsMemory&) {
        renderer_.reset(); // the file is drawn elsewhere; the dialog goes without
    }
}

} // namespace ramus::app
