#include "app/window/figure_previewer.h"

#include "app/panels/figure_preview.h"
#include "app/picture/compose_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glad/gl.h>

namespace ramus::app {

namespace {

// The largest size with the aspect ratio of `full` within `most`.
glm::ivec2 fitting(glm::ivec2 full, glm::ivec2 most) {
    const double shrink = std::min(double(most.x) / full.x, double(most.y) / full.y);
    return glm::max(glm::ivec2(glm::dvec2(full) * shrink + 0.5), glm::ivec2(1));
}

// For large trees even the preview takes a window too long to send and draw: casts centerlines instead, as in moving
// views.
void cast_if_large(render::Frame& frame) {
    constexpr std::uint64_t kMostDrawn = 300'000; // triangles
    const bool needs_mesh = frame.only_mesh || frame.scale.value == render::ColourScale::Value::kSurface;
    if (needs_mesh || !frame.centerlines || !frame.mesh || frame.mesh->triangle_count() <= kMostDrawn) return;
    frame.surface_awaited = true;
    frame.quality = render::Quality::kInteractive;
}

} // namespace

// At this size the preview mesh looks like the full one.
render::Sheet FigurePreviewer::small_sheet(glm::ivec2 size) const {
    Workspace& workspace = state_.workspace;
    const ShownSurfaces surfaces = workspace.surfaces();
    render::Sheet sheet =
        compose_sheet(workspace.document().session(), workspace.current_assets(), surfaces, {.size = size});
    const auto viewports = viewports_of(workspace.document().session(), size, 1.0F);
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

// Draws the sheet in parts before draw_figure() needs it, as for the window's picture.
Result<FigurePreviewer::Part> FigurePreviewer::draw_part(Drawer& drawer, const render::Sheet& sheet,
                                                         const FigureOptions& options, double seconds) {
    try {
        if (!drawer.renderer) { // takes about as long as a part
            RAMUS_TRY(made, render::Renderer::create());
            drawer.renderer = std::move(made);
            drawer.renderer->draw_first_in_parts();
            drawer.sheets.emplace(*drawer.renderer);
            return Part();
        }
        const auto drawn = drawer.sheets->draw(sheet, kUploadBudget, seconds);
        if (!drawn) return tl::unexpected(drawn.error());
        if (drawn->unfinished || drawn->pending) return Part();
        RAMUS_TRY(figure, draw_figure(*drawer.sheets, sheet, options));
        return Part(std::move(figure.image));
    } catch (const render::OutOfGraphicsMemory& error) {
        drawer.sheets.reset(); // the export itself is drawn elsewhere; only the preview is missing
        drawer.renderer.reset();
        return fail(error.what());
    }
}

void FigurePreviewer::begin_part() {
    if (!drawer_) drawer_ = std::make_shared<Drawer>();
    const double seconds = state_.watched() ? kDrawingSeconds : render::kUntilDone;
    part_ =
        thread_.begin([drawer = drawer_, sheet = drawing_->all.views[drawing_->next].sheet, options = drawing_->options,
                       seconds] { return draw_part(*drawer, sheet, options, seconds); });
}

void FigurePreviewer::take_part(double seconds) {
    if (!part_.valid() || !thread_.done(part_, seconds)) return;
    state_.redraw();
    const auto part = part_.get();
    if (!part) return give_up();
    if (!*part) return;
    drawing_->all.ground.put(**part, drawing_->all.views[drawing_->next].at);
    if (++drawing_->next < drawing_->all.views.size()) return;
    try {
        show(drawing_->all.ground);
        drawing_.reset();
    } catch (const render::OutOfGraphicsMemory&) {
        give_up();
    }
}

void FigurePreviewer::give_up() {
    drawing_.reset();
    state_.interface.of<FigurePreview>().texture = 0;
}

void FigurePreviewer::show(const render::Image& image) {
    texture_ = render::make_texture(GL_RGBA8, image.width, image.height);
    glTextureSubImage2D(texture_, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    glTextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    FigurePreview& preview = state_.interface.of<FigurePreview>();
    preview.texture = texture_;
    preview.size = {image.width, image.height};
}

// A part in progress finishes, and its result is dropped.
void FigurePreviewer::release() {
    drawing_.reset();
    part_ = {};
    if (drawer_)
        thread_.post([drawer = std::move(drawer_)] {
            drawer->sheets.reset();
            drawer->renderer.reset();
        });
    drawer_ = nullptr;
    texture_ = {};
    shown_.reset();
    state_.interface.of<FigurePreview>().texture = 0;
}

void FigurePreviewer::update() {
    FigurePreview& preview = state_.interface.of<FigurePreview>();
    if (!preview.wanted || !preview.request.size || !state_.workspace.shown().mesh) {
        if (drawer_ || shown_) release();
        return;
    }
    take_part(0.0);
    const glm::ivec2 full = *preview.request.size;
    if (part_.valid() || !render::check_size(full.x, full.y)) return;
    const glm::ivec2 size = fitting(full, preview.most);
    Wanted wanted{small_sheet(size), preview.request.options, full};
    if (shown_ == wanted && !drawing_) return;
    state_.redraw();
    if (shown_ != wanted) {
        shown_ = std::move(wanted);
        begin(size);
    }
    if (!drawing_) return give_up();
    begin_part();
    if (!thread_.has_thread()) take_part(0.0);
}

} // namespace ramus::app
