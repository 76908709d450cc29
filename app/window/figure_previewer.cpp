#include "app/window/figure_previewer.h"

#include "app/picture/compose_sheet.h"

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

Result<FourViews> FigurePreviewer::views_of(glm::ivec2 size, const FigureOptions& options) const {
    const auto compose = [this](glm::ivec2 part) -> Result<render::Sheet> { return small_sheet(part); };
    if (options.sheet) return four_views(compose, size, options);
    FourViews one{render::Image(size.x, size.y), {{small_sheet(size), glm::ivec2(0)}}};
    render::Sheet& sheet = one.views.front().sheet;
    dress(sheet, options);
    if (options.turntable > 0) look_around(sheet, options, 0);
    return one;
}

void FigurePreviewer::begin(glm::ivec2 size) {
    drawing_.reset();
    FigureOptions options = shown_->options;
    options.supersample = 1;
    options.samples = 4;
    options.text_size *= double(size.x) / shown_->full.x;
    if (auto views = views_of(size, options)) drawing_ = Drawing{std::move(*views), options};
}

// What draw_figure() asks for is drawn before, in parts as the window's picture is.
Result<void> FigurePreviewer::go_on() {
    state_.redraw();
    const FourViews::View& view = drawing_->all.views[drawing_->next];
    const auto drawn =
        sheets_->draw(view.sheet, kUploadBudget, state_.watched() ? kDrawingSeconds : render::kUntilDone);
    if (!drawn) return tl::unexpected(drawn.error());
    if (drawn->unfinished || drawn->pending) return {};
    RAMUS_TRY(figure, draw_figure(*sheets_, view.sheet, drawing_->options));
    drawing_->all.ground.put(figure.image, view.at);
    if (++drawing_->next < drawing_->all.views.size()) return {};
    show(drawing_->all.ground);
    drawing_.reset();
    return {};
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
    drawing_.reset();
    sheets_.reset();
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
    if (shown_ == wanted && !drawing_) return;
    state_.redraw();
    if (!renderer_) { // takes about as long as a preview: in a frame of its own
        if (auto made = render::Renderer::create()) {
            renderer_ = std::move(*made);
            sheets_.emplace(*renderer_);
            return;
        }
    }
    if (shown_ != wanted) {
        shown_ = std::move(wanted);
        if (renderer_) begin(size);
    }
    if (!drawing_) return;
    try {
        if (go_on()) return;
        drawing_.reset();
    } catch (const render::OutOfGraphicsMemory&) {
        drawing_.reset(); // the file is drawn elsewhere; the dialog goes without
        sheets_.reset();
        renderer_.reset();
    }
    preview.texture = 0;
}

} // namespace ramus::app
