#include "render/renderer/sheet.h"

#include "core/base/stopwatch.h"
#include "render/gl/within_memory.h"
#include "render/renderer/passes/gl_state.h"
#include "render/renderer/passes/overlay_passes.h"

#include <algorithm>
#include <glad/gl.h>
#include <utility>

namespace ramus::render {

namespace {

// The layout of a sheet, without its contents.
Sheet outline_of(const Sheet& sheet) {
    Sheet outline = sheet;
    for (Sheet::Viewport& viewport : outline.viewports) {
        Frame bare;
        bare.size = viewport.frame.size;
        bare.background = viewport.frame.background;
        viewport.frame = bare;
        if (viewport.slice) viewport.slice.emplace();
    }
    return outline;
}

bool wants_scale(const Sheet::Viewport& viewport) {
    return !viewport.slice && viewport.frame.overlays.scale_bar && !viewport.frame.camera.orthographic;
}

bool is_slice(const Sheet::Viewport& viewport) { return viewport.slice.has_value(); }

std::optional<ScaleBar> scale_bar_in(const Sheet& sheet) {
    for (const Sheet::Viewport& viewport : sheet.viewports)
        if (auto bar = is_slice(viewport) ? std::nullopt : OverlayPainter::scale_bar(SpriteSource(viewport.frame)))
            return bar;
    return {};
}

} // namespace

Sheet sheet_of(Frame frame) {
    Sheet sheet;
    sheet.size = frame.size;
    sheet.viewports.push_back({glm::ivec2(0), std::move(frame)});
    return sheet;
}

std::size_t SheetRenderer::place_of(const Sheet& sheet, std::size_t viewport) {
    const bool slice = is_slice(sheet.viewports[viewport]);
    return static_cast<std::size_t>(std::count_if(sheet.viewports.begin(),
                                                  sheet.viewports.begin() + static_cast<std::ptrdiff_t>(viewport),
                                                  [&](const Sheet::Viewport& one) { return is_slice(one) == slice; }));
}

// Releases renderers before drawing, to free memory. Nothing is shown until drawing has succeeded.
void SheetRenderer::keep(const Sheet& sheet) {
    const auto slices = static_cast<std::size_t>(std::ranges::count_if(sheet.viewports, is_slice));
    if (screens_.size() > slices) screens_.resize(slices);
    const std::size_t frames = std::max<std::size_t>(sheet.viewports.size() - slices, 1);
    if (others_.size() < frames) return;
    others_.resize(frames - 1);
    blend_.reset();
    shown_ = {};
    depths_.clear();
}

void SheetRenderer::draw_slices(const Sheet& sheet, DrawStatistics& sum) {
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        const Sheet::Viewport& viewport = sheet.viewports[i];
        if (!is_slice(viewport)) continue;
        if (const std::size_t place = place_of(sheet, i); place == screens_.size()) screens_.emplace_back();
        sum.shaded |= screen(sheet, i).draw(viewport.frame, *viewport.slice);
    }
}

Result<DrawStatistics> SheetRenderer::draw(const Sheet& sheet, std::size_t upload_budget, double seconds) {
    if (auto fits = check_size(sheet.size.x, sheet.size.y); !fits) return tl::unexpected(fits.error());
    keep(sheet);
    DrawStatistics sum;
    const auto frames = static_cast<std::size_t>(
        std::ranges::count_if(sheet.viewports, [](const auto& viewport) { return !is_slice(viewport); }));
    const bool at_once = seconds == kUntilDone;
    while (others_.size() + 1 < frames) {
        RAMUS_TRY(made, Renderer::create(kGlassBytes, first_.surface_bytes()));
        if (first_.draws_first_in_parts()) made->draw_first_in_parts();
        others_.push_back(std::move(made));
        sum.unfinished = sum.of_before = !at_once;
        if (sum.unfinished) return sum; // linking its programs takes as long as a part
    }
    // A new viewport has no earlier picture to show meanwhile; draws one such picture per call.
    for (std::size_t i = 1; i < sheet.viewports.size() && !at_once; ++i) {
        if (is_slice(sheet.viewports[i]) || place_of(sheet, i) == 0 || renderer(sheet, i).has_picture()) continue;
        auto first = renderer(sheet, i).draw(sheet.viewports[i].frame, upload_budget, seconds);
        if (first) first->unfinished = first->of_before = true;
        return first;
    }
    const auto slices = within_memory(
        "give a smaller size", [&] { screens_.clear(); },
        [&]() -> Result<void> {
            draw_slices(sheet, sum);
            return {};
        });
    if (!slices) return tl::unexpected(slices.error());
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        if (is_slice(sheet.viewports[i])) continue;
        auto done = renderer(sheet, i).draw(sheet.viewports[i].frame, upload_budget, seconds);
        if (!done) return done;
        upload_budget -= upload_budget == kUploadAll ? 0 : std::min<std::size_t>(upload_budget, done->uploaded);
        sum.triangles += done->triangles;
        sum.cones += done->cones;
        sum.uploaded += done->uploaded;
        sum.geometry |= done->geometry;
        sum.shaded |= done->shaded;
        sum.pending |= done->pending;
        sum.unfinished |= done->unfinished;
        sum.coarse |= done->coarse;
        sum.of_before |= done->of_before || (done->unfinished && !done->shaded);
        sum.seconds += done->seconds;
        if (place_of(sheet, i) == 0 || done->quality == Quality::kInteractive) sum.quality = done->quality;
    }
    scale_bar_ = scale_bar_in(sheet);
    Sheet outline = outline_of(sheet);
    const bool arranged = outline != shown_;
    const bool whole =
        first_.picture_size() == sheet.size && (!sheet.mixed() || others_[0]->picture_size() == sheet.size);
    if (!sheet.mixed()) {
        blend_.reset();
    } else if (whole && (sum.shaded || arranged || !blend_)) { // otherwise one has the previous size
        if (auto blended = blend(sheet); !blended) return tl::unexpected(blended.error());
    }
    shown_ = std::move(outline);
    sum.shaded |= arranged;
    return sum;
}

Result<DrawStatistics> SheetRenderer::draw_with_scale(Sheet sheet) {
    auto done = draw(sheet);
    if (!done || std::ranges::none_of(sheet.viewports, wants_scale)) return done;
    std::vector<DepthMap> maps;
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i)
        if (auto map = is_slice(sheet.viewports[i]) ? std::nullopt : renderer(sheet, i).read_depths())
            maps.push_back(std::move(*map));
    const auto visible = visible_in(maps);
    if (!visible) return done;
    for (Sheet::Viewport& viewport : sheet.viewports)
        if (wants_scale(viewport))
            viewport.frame.overlays.scale = scale_of(viewport.frame.camera, viewport.frame.size, *visible);
    const auto again = draw(sheet);
    return again ? done : again;
}

Result<void> SheetRenderer::blend(const Sheet& sheet) {
    const auto mix_them = [&]() -> Result<void> {
        if (!blend_) {
            Blend fresh;
            if (auto made = fresh.make(); !made) return made;
            blend_ = std::move(fresh);
            painter_.emplace();
        }
        const Image heading =
            sheet.heading.empty() ? Image() : painter_->heading(sheet.heading, SpriteSource(sheet.viewports[0].frame));
        const Mix mix{sheet.blend.value_or(0.0), sheet.wipe, sheet.line_width};
        blend_->draw(first_.texture(), others_[0]->texture(), mix, sheet.size, heading, sheet.heading_top);
        return {};
    };
    return within_memory(
        "give a smaller size", [&] { blend_.reset(); }, mix_them);
}

Result<Refined> SheetRenderer::refine(const Sheet& sheet, double seconds) {
    Refined sum;
    if (sheet.viewports.size() != shown_.viewports.size()) return sum; // not drawn, or not yet
    const Stopwatch watch;
    for (std::size_t i = 0; i < sheet.viewports.size() && !sum.more; ++i) {
        if (is_slice(sheet.viewports[i])) continue;
        RAMUS_TRY(done, renderer(sheet, i).refine(seconds - watch.seconds()));
        sum.more = done.more;
        sum.changed |= done.changed;
    }
    if (sum.changed && sheet.mixed())
        if (auto blended = blend(sheet); !blended) return tl::unexpected(blended.error());
    return sum;
}

void SheetRenderer::finish() { glFinish(); }

Image SheetRenderer::read_image() {
    if (blend_) return blend_->picture().read();
    const auto image_of = [&](std::size_t i) {
        return is_slice(shown_.viewports[i]) ? screen(shown_, i).image() : renderer(shown_, i).read_image();
    };
    if (shown_.viewports.size() == 1) return image_of(0);
    Image sheet(shown_.size.x, shown_.size.y);
    const bool clear =
        std::ranges::any_of(shown_.viewports, [](const auto& p) { return p.frame.background.transparent; });
    if (!clear) sheet.fill(shown_.divider);
    for (std::size_t i = 0; i < shown_.viewports.size(); ++i) sheet.put(image_of(i), shown_.viewports[i].at);
    return sheet;
}

std::vector<bool> SheetRenderer::read_covered() {
    const auto width = static_cast<std::size_t>(shown_.size.x);
    std::vector<bool> covered(width * static_cast<std::size_t>(shown_.size.y));
    for (std::size_t i = 0; i < shown_.viewports.size(); ++i) {
        if (is_slice(shown_.viewports[i])) continue; // has no background that could be cropped
        const BranchPicture picture = renderer(shown_, i).read_branches();
        const auto left = static_cast<std::size_t>(shown_.viewports[i].at.x);
        const auto top = static_cast<std::size_t>(shown_.viewports[i].at.y);
        const auto across = static_cast<std::size_t>(picture.width);
        for (std::size_t k = 0; k < picture.branches.size(); ++k)
            if (picture.branches[k] != kNoBranch) covered[(top + k / across) * width + left + k % across] = true;
    }
    return covered;
}

void SheetRenderer::present(unsigned framebuffer, int x, int y) {
    if (blend_) return blend_->picture().present(framebuffer, x, y, shown_.size);
    if (shown_.viewports.size() > 1) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
        glEnable(GL_SCISSOR_TEST);
        glScissor(x, y, shown_.size.x, shown_.size.y);
        glClearColor(shown_.divider.x, shown_.divider.y, shown_.divider.z, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_SCISSOR_TEST);
    }
    for (std::size_t i = 0; i < shown_.viewports.size(); ++i) {
        const Sheet::Viewport& viewport = shown_.viewports[i];
        const int below = y + shown_.size.y - viewport.at.y - viewport.frame.size.y;
        if (is_slice(viewport))
            screen(shown_, i).present(framebuffer, x + viewport.at.x, below, viewport.frame.size);
        else
            renderer(shown_, i).present(framebuffer, x + viewport.at.x, below, viewport.frame.size);
    }
}

std::size_t SheetRenderer::viewport_at(const Sheet& sheet, glm::dvec2 at) {
    if (sheet.mixed()) {
        const bool second = sheet.blend ? *sheet.blend > 0.5 : at.x >= *sheet.wipe * sheet.size.x;
        const std::size_t more = second ? 1 : 0;
        return sheet.viewports[more].has_branches ? more : 1 - more;
    }
    std::size_t nearest = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < sheet.viewports.size(); ++i) {
        const glm::dvec2 from(sheet.viewports[i].at), to = from + glm::dvec2(sheet.viewports[i].frame.size);
        const glm::dvec2 away = glm::max(glm::max(from - at, at - to), glm::dvec2(0.0));
        if (const double squared = away.x * away.x + away.y * away.y; squared < least) least = squared, nearest = i;
    }
    return nearest;
}

// Places on a surface without branches must not be taken for places on vessels.
Pick SheetRenderer::without_branch(const Sheet& outline, std::size_t viewport, Pick pick) {
    if (viewport < outline.viewports.size() && !outline.viewports[viewport].has_branches) pick.branch = kNoBranch;
    return pick;
}

Pick SheetRenderer::pick(glm::dvec2 at) {
    if (shown_.viewports.empty()) return {};
    const std::size_t viewport = viewport_at(shown_, at);
    const glm::dvec2 in = at - glm::dvec2(shown_.viewports[viewport].at);
    if (is_slice(shown_.viewports[viewport])) return screen(shown_, viewport).pick(in);
    return without_branch(shown_, viewport, renderer(shown_, viewport).pick(in.x, in.y));
}

std::optional<Pick> SheetRenderer::pick(glm::dvec2 at, const Seen& of) {
    if (of.outline.viewports.empty()) return Pick{};
    const std::size_t viewport = viewport_at(of.outline, at);
    const Sheet::Viewport& seen = of.outline.viewports[viewport];
    const glm::dvec2 in = at - glm::dvec2(seen.at);
    const std::size_t place = place_of(of.outline, viewport);
    if (is_slice(seen)) return of.outline == shown_ ? std::optional(screens_[place].pick(in)) : std::nullopt;
    if (place > others_.size() || place >= of.numbers.size()) return {};
    const auto pick = renderer(of.outline, viewport).pick(in.x, in.y, of.numbers[place], seen.frame.size);
    if (!pick) return pick;
    return without_branch(of.outline, viewport, *pick);
}

SheetRenderer::Seen SheetRenderer::seen() const {
    Seen seen{shown_, {first_.number()}};
    for (const auto& other : others_) seen.numbers.push_back(other->number());
    return seen;
}

void SheetRenderer::request_pick(glm::dvec2 at) {
    if (shown_.viewports.empty()) return;
    asked_ = viewport_at(shown_, at);
    const glm::dvec2 in = at - glm::dvec2(shown_.viewports[asked_].at);
    slice_pick_.reset();
    if (is_slice(shown_.viewports[asked_]))
        slice_pick_ = screen(shown_, asked_).pick(in);
    else
        renderer(shown_, asked_).request_pick(in.x, in.y);
}

std::optional<Pick> SheetRenderer::poll_pick() {
    if (asked_ >= shown_.viewports.size()) return Pick{};
    if (is_slice(shown_.viewports[asked_])) return std::exchange(slice_pick_, std::nullopt);
    const auto pick = renderer(shown_, asked_).poll_pick();
    if (!pick) return pick;
    return without_branch(shown_, asked_, *pick);
}

bool SheetRenderer::request_depths() {
    depths_.clear();
    for (std::size_t i = 0; i < shown_.viewports.size(); ++i)
        if (!is_slice(shown_.viewports[i]) && !renderer(shown_, i).request_depths()) return false;
    return !shown_.viewports.empty();
}

std::optional<std::vector<DepthMap>> SheetRenderer::poll_depths() {
    while (depths_.size() < shown_.viewports.size()) {
        // A slice has no depths.
        auto map = is_slice(shown_.viewports[depths_.size()]) ? std::optional(DepthMap())
                                                              : renderer(shown_, depths_.size()).poll_depths();
        if (!map) return {};
        depths_.push_back(std::move(*map));
    }
    return std::exchange(depths_, {});
}

Result<void> Blend::make() {
    if (auto made = mix_.make("blend.frag"); !made) return made;
    return overlay_.make("overlay.frag");
}

void Blend::draw(unsigned first, unsigned second, const Mix& mix, glm::ivec2 size, const Image& heading, int top) {
    if (size != picture_.size) picture_.make(size);
    begin_passes(size);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    picture_.bind();
    const auto line = static_cast<float>(mix.line.value_or(0.0) * size.x);
    const bool seen = mix.line && *mix.line > 0.0 && *mix.line < 1.0;
    glProgramUniform1f(mix_, kUniformShare, static_cast<float>(mix.share));
    const int above = heading.width > 0 ? top + heading.height : 0; // the heading covers the line
    glProgramUniform3f(mix_, kUniformLine, mix.line ? line : -1.0F, seen ? 0.5F * mix.line_width : 0.0F,
                       static_cast<float>(size.y - above));
    glBindTextureUnit(kUnitImage, first);
    glBindTextureUnit(kUnitOtherImage, second);
    mix_.draw();
    if (heading.width > 0) {
        begin_blending(Blending::kOver);
        draw_sprite(overlay_, heading, {(size.x - heading.width) / 2, size.y - top - heading.height}, {{}, size});
        glDisable(GL_BLEND);
    }
    end_passes();
}

} // namespace ramus::render
