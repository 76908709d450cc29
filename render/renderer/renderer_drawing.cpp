// Draws the next frame: selects the passes to run, and the state that they leave.
#include "core/base/stopwatch.h"
#include "render/gl/gl_context.h"
#include "render/gl/within_memory.h"
#include "render/renderer/frame_changes.h"
#include "render/renderer/passes/gl_state.h"
#include "render/renderer/renderer.h"

#include <algorithm>
#include <string>

namespace ramus::render {

namespace {

constexpr const char* kLessMemory = "give a smaller size or a coarser --detail";

constexpr int kInteractiveDivisor = 2; // divides width and height

// The picture will be complete in a later call.
DrawStatistics later(DrawStatistics done) {
    end_passes();
    done.unfinished = true;
    return done;
}

bool is_complete(unsigned framebuffer) {
    return glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

tl::unexpected<Error> cannot_draw(glm::ivec2 size) {
    return fail("this graphics driver cannot draw a picture of " + std::to_string(size.x) + "x" +
                    std::to_string(size.y) + " pixels",
                gl_description(), "give a smaller size, or use another driver: ramus render --backend osmesa");
}

int most_samples() {
    GLint integer_samples = 0;
    glGetIntegerv(GL_MAX_INTEGER_SAMPLES, &integer_samples);
    return std::clamp(integer_samples, 1, kMostSamples);
}

} // namespace

// Any pass may run out of memory: then the picture and its data are released, so that the next draw(), perhaps of less,
// starts from the initial state.
Result<DrawStatistics> Renderer::draw(const Frame& wanted, std::size_t upload_budget, double seconds) {
    if (auto fits = check_size(wanted.size.x, wanted.size.y); !fits) return tl::unexpected(fits.error());
    return or_release([&] { return draw_all(wanted, upload_budget, seconds); });
}

template <class Work> auto Renderer::or_release(const Work& work) -> decltype(work()) {
    return within_memory(
        kLessMemory, [this] { release(); }, work);
}

// Only the view or the size changes: cones may then replace the surface, until the view rests.
bool Renderer::moves(const Frame& wanted, const Frame& frame) const {
    return frame.quality == Quality::kInteractive && last_ && wanted_mesh_ == wanted.mesh &&
           last_->states == frame.states &&
           (state_.by_caster() || last_->camera != frame.camera || last_->size != frame.size);
}

Renderer::Plan Renderer::plan_for(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) const {
    // The picture must also answer picks; otherwise it is drawn again.
    if (last_ && *last_ == frame && state_.answers()) return Plan::kNothing;
    if (unfinished_ && unfinished_->view.layers() == layers &&
        same_geometry(unfinished_->view.frame(), frame, unfinished_->view.subject().has_glass()))
        return Plan::kGoOn;
    if (last_ && state_.answers() && differs_in_overlays_only(*last_, frame)) return Plan::kShow;
    const bool may_cast = frame.quality == Quality::kInteractive && card_.scene.mesh().shown() != nullptr &&
                          (moves(wanted, frame) || (state_.by_caster() && last_));
    if (frame.surface_awaited || (may_cast && card_.scene.casts(frame))) return Plan::kCast;
    if (state_.held() && last_layers_ == layers && same_geometry(*last_, frame, card_.targets.has_glass))
        return card_.targets.has_planes && differs_in_planes_only(*last_, frame) ? Plan::kSlice : Plan::kShade;
    return Plan::kDraw;
}

// Programs and targets are created on first use: a window's first picture is the caster's, and appears earlier that
// way.
Result<bool> Renderer::resize(const Frame& frame, Plan plan) {
    const auto what = plan == Plan::kDraw ? Passes::For::kAll : Passes::For::kCast;
    if (auto made = card_.passes.make(what); !made) return tl::unexpected(made.error());
    const bool full = plan == Plan::kCast || frame.quality == Quality::kFull;
    const int divisor = full ? 1 : kInteractiveDivisor, samples = full ? most_samples() : 1;
    const bool reads_depths = lies_over_depths(frame);
    ViewTargets& targets = card_.targets;
    targets.view.picture = frame.size;
    targets.view.size = (frame.size + divisor - 1) / divisor;
    const bool passes = plan == Plan::kDraw || reads_depths;
    const bool make_targets = passes && !targets.fit(targets.view.size, samples);
    if (card_.picture.size == frame.size && !make_targets) return false;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(frame.size.x, frame.size.y) > largest)
        return fail("this graphics driver draws at most " + std::to_string(largest) + " pixels a side", {},
                    "give a smaller size");
    if (!make_targets) return false;
    in_targets_ = {};
    targets.make(samples);
    if (is_complete(targets.samples.framebuffer)) return true;
    release();
    return cannot_draw(frame.size);
}

// The previous picture stays until the next one is ready.
Result<void> Renderer::fit_picture(glm::ivec2 size) {
    if (card_.picture.size == size) return {};
    card_.picture.make(size);
    if (is_complete(card_.picture.framebuffer)) return {};
    release();
    return cannot_draw(size);
}

// Continues the picture in progress; true: its geometry is complete.
Result<bool> Renderer::draw_parts(double seconds, DrawStatistics& done) {
    if (!unfinished_->view.draw_on(seconds)) return false;
    const auto& triangles = unfinished_->view.triangles();
    if (!triangles) return tl::unexpected(triangles.error());
    done.triangles = *triangles;
    done.geometry = true;
    done.seconds = unfinished_->seconds;
    return true;
}

// Continues the picture in progress if it fits the plan.
void Renderer::go_on_or_give_up(Plan plan, const Frame& wanted, const Frame& frame) {
    if (plan == Plan::kGoOn) {
        unfinished_->wanted = wanted;
        unfinished_->view.shade_as(frame);
    } else if ((plan != Plan::kNothing && plan != Plan::kShow) || state_.partial()) {
        give_up();
    }
    if (plan != Plan::kCast) card_.passes.cast.forget();
}

Result<bool> Renderer::make_room(Plan plan, const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) {
    if (plan == Plan::kShow && state_.by_caster()) {
        if (auto back = back_to_cast(); !back) return tl::unexpected(back.error());
    }
    if (plan != Plan::kCast && plan != Plan::kDraw) return false;
    card_.passes.cast.forget();
    if (plan == Plan::kDraw) keep_pick_source();
    const bool other_size = card_.picture.size != frame.size;
    RAMUS_TRY(made_targets, resize(frame, plan));
    if (plan == Plan::kDraw) begin(wanted, frame, layers);
    // While the user resizes the window, every frame has another size, and otherwise no picture would ever be finished.
    return plan == Plan::kDraw && made_targets && !other_size;
}

Result<DrawStatistics> Renderer::draw_all(const Frame& wanted, std::size_t upload_budget, double seconds) {
    const Stopwatch watch;
    DrawStatistics done;
    card_.scene.set_in_time(seconds != kUntilDone);
    const auto taken = card_.scene.take_up(wanted, upload_budget, done);
    if (!taken) {
        give_up();
        return tl::unexpected(taken.error());
    }
    const Frame& frame = *taken;
    std::vector<Layer> layers = layers_of(frame.states);
    const Plan plan = plan_for(wanted, frame, layers);
    go_on_or_give_up(plan, wanted, frame);
    if (plan == Plan::kNothing) return done;
    // The caster may use the worker thread; the shown picture answers picks meanwhile.
    const bool in_time = plan == Plan::kCast && seconds != kUntilDone && last_;
    if (!in_time) {
        const auto took_long = make_room(plan, wanted, frame, layers);
        if (!took_long) return failed(took_long.error());
        if (!last_ && !first_in_parts_) seconds = kUntilDone; // no picture to show meanwhile
        if (*took_long && seconds != kUntilDone) return later(done);
    }
    card_.passes.begin(card_.targets.view);
    const Subject subject = subject_of(frame, layers);
    Region region{glm::ivec2(0), card_.targets.view.size};
    if (in_time) {
        const auto shown = cast_in_time(subject, seconds - watch.seconds(), done);
        if (!shown) return failed(shown.error());
        done.shaded = *shown;
        if (!done.shaded) end_passes();
        if (gl_ran_out_of_memory()) throw OutOfGraphicsMemory(0);
        return done;
    }
    if (plan == Plan::kCast) {
        done.cones = cast(subject), done.geometry = true;
        state_.cast();
        in_cast_ = next_pick_source(frame, card_.targets.view);
    } else if (plan != Plan::kShow) {
        if (unfinished_) {
            const auto whole = draw_parts(seconds - watch.seconds(), done);
            if (!whole) return failed(whole.error());
            if (!*whole) return unfinished_->seconds += watch.seconds(), later(done);
            unfinished_.reset();
            in_targets_ = next_pick_source(frame, card_.targets.view);
        }
        const auto shaded = shade(subject, plan);
        if (!shaded) return failed(shaded.error());
        if (last_ && last_->overlays == frame.overlays) region = *shaded;
        // Picks must answer for the planes that are shown.
        if (last_ && last_->planes != frame.planes) in_targets_ = next_pick_source(frame, card_.targets.view);
    }
    if (auto fits = fit_picture(frame.size); !fits) return failed(fits.error());
    show(subject, region);
    done.shaded = true;
    last_ = frame;
    last_layers_ = std::move(layers);
    shown_view_ = card_.targets.view;
    if (gl_ran_out_of_memory()) throw OutOfGraphicsMemory(0); // drivers may report it late
    done.seconds += watch.seconds();
    return done;
}

void Renderer::begin(const Frame& wanted, const Frame& frame, const std::vector<Layer>& layers) {
    const bool moving = moves(wanted, frame);
    wanted_mesh_ = wanted.mesh;
    unfinished_.reset(
        new Unfinished{wanted, PartialView(card_.passes, card_.scene, card_.targets, frame, layers, moving), 0.0});
    state_.begin();
}

Result<Region> Renderer::shade(const Subject& subject, Plan plan) {
    // Hovering changes few pixels, and a software rasteriser is slow for all. Layers of glass are not kept.
    const bool can_change_parts = plan == Plan::kShade && (!card_.targets.has_glass || gl_has_lists());
    const bool part = can_change_parts && differs_in_hover_and_overlays_only(*last_, subject.frame);
    const auto extent = part ? ShadePass::Extent::kChanged : ShadePass::Extent::kAll;
    ShadePass& pass = card_.passes.shade;
    Result<Region> shaded = plan == Plan::kSlice ? Region{glm::ivec2(0), card_.targets.view.size}
                                                 : pass.draw(subject, card_.targets, extent);
    if (shaded && !subject.frame.planes.empty())
        if (auto sliced = pass.draw_planes(subject, card_.targets, *shaded); !sliced)
            shaded = tl::unexpected(sliced.error());
    note_gl_errors("shading");
    if (!shaded) return shaded;
    if (state_.partial())
        state_.finish();
    else if (part)
        state_.shade_changed();
    else
        state_.shade();
    return shaded;
}

// Composes the lit image, or the caster's picture, with the overlays.
void Renderer::show(const Subject& subject, const Region& region) {
    const ViewTargets& targets = card_.targets;
    const PictureTarget& picture = card_.picture;
    picture.bind();
    if (state_.by_caster()) {
        card_.passes.cast.send_picture(picture);
        if (lies_over_depths(subject.frame)) card_.passes.cast.send_depths(picture, targets.resolved);
        if (outlines_selection(subject.frame)) card_.passes.cast.send_ids(picture);
    } else {
        card_.passes.copy.draw(targets.view, targets.picture(), picture, region);
    }
    const GLuint ids = state_.by_caster() ? card_.passes.cast.ids() : targets.resolved.id_normal;
    card_.passes.draw_overlays(subject, targets, picture, region, ids);
    note_gl_errors("the overlays");
    end_passes();
}

// If memory does not suffice for further views, the picture stays as it is. If it does not suffice for showing their
// mean with overlays, the picture is lost.
Result<Refined> Renderer::refine(double seconds) {
    if (!last_ || !state_.can_refine() || last_->quality != Quality::kFull) return Refined{};
    const auto added = within_memory(
        {}, [] {}, [&] { return add_views(seconds); });
    if (!added || gl_ran_out_of_memory()) {
        refinement_.reset();
        state_.end_refining();
        end_passes();
        return Refined{};
    }
    Refined done;
    done.changed = *added;
    if (!done.changed)
        end_passes();
    else if (auto shown = or_release([&] { return show_mean(); }); !shown)
        return tl::unexpected(shown.error());
    if (refinement_->whole()) {
        refinement_.reset();
        state_.end_refining();
    }
    done.more = state_.can_refine();
    return done;
}

// The sum starts with the current view.
Result<void> Renderer::begin_refinement() {
    card_.passes.begin(card_.targets.view);
    if (state_.stage() == PictureState::Stage::kFineInParts) {
        const Subject subject = subject_of(*last_, last_layers_);
        if (auto shaded = card_.passes.shade.draw_all(subject, card_.targets); !shaded) return shaded;
    }
    refinement_ = std::make_unique<Refinement>(card_, *last_, last_layers_);
    state_.begin_refining();
    return {};
}

Result<bool> Renderer::add_views(double seconds) {
    if (!refinement_)
        if (auto begun = begin_refinement(); !begun) return tl::unexpected(begun.error());
    return refinement_->add_views(seconds);
}

Result<void> Renderer::show_mean() {
    const ViewSetup& view = card_.targets.view;
    card_.passes.begin(view);
    card_.passes.mean.show(view, refinement_->mean(), card_.targets.picture());
    state_.show_mean();
    show(subject_of(*last_, last_layers_), {glm::ivec2(0), view.size});
    return {};
}

// An error is ignored here: without memory there is no picture.
void Renderer::finish() {
    (void)or_release([&]() -> Result<void> {
        auto made = card_.passes.cast.take(kUntilDone);
        if (!made) return {};
        return show_cast(std::move(*made));
    });
    if (!unfinished_) return;
    const Frame wanted = unfinished_->wanted;
    (void)draw(wanted, 0, kUntilDone);
}

void Renderer::give_up() {
    unfinished_.reset();
    refinement_.reset();
    state_.interrupt();
}

tl::unexpected<Error> Renderer::failed(const Error& error) {
    tl::unexpected<Error> result(error);
    give_up();
    last_.reset();
    state_.lose();
    return result;
}

// After running out of memory.
void Renderer::release() {
    give_up();
    last_.reset();
    state_.lose();
    card_.passes.cast.forget();
    wanted_mesh_ = nullptr;
    in_targets_ = in_kept_ = in_cast_ = {};
    kept_ = {};
    card_.release();
}

} // namespace ramus::render
