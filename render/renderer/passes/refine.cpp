// Pictures finer than four samples a pixel, once nothing else is to be done: further views, each shifted by less than a
// quarter of a pixel, are drawn beside the picture, into passes of their own, and added to it. What the first view was
// drawn into stays, for whoever points at it meanwhile.
#include "core/base/stopwatch.h"
#include "render/renderer/renderer_impl.h"

#include <utility>

namespace ramus::render {

// What `lit_` shows.
void Renderer::Impl::add_to_sum() {
    glBindFramebuffer(GL_FRAMEBUFFER, refinement_->sum_target);
    glViewport(0, 0, inner_.x, inner_.y);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glBindTextureUnit(kUnitImage, lit_);
    fullscreen(add_view_);
    glDisable(GL_BLEND);
    ++refinement_->views;
}

// Draws on at the next view; true: it is in the sum. Whatever stops it leaves the picture as it is: throws, or fails.
Result<bool> Renderer::Impl::add_view(double seconds) {
    Refinement& refinement = *refinement_;
    if (passes_ != inner_) make_passes(static_cast<int>(refinement.passes.view_.picture.z)); // as the first view's
    begin_state();
    if (!refinement.next) {
        shift_ = refinement.views;
        refinement.next = std::make_unique<Unfinished>();
        refinement.next->frame = *last_;
        refinement.next->layers = last_layers_;
        refinement.next->geometry = draw_geometry(refinement.next->frame, drawn_, refinement.next->layers);
    }
    if (!draw_parts(*refinement.next, seconds)) return false;
    if (const auto& drawn = refinement.next->geometry->result(); !drawn) return tl::unexpected(drawn.error());
    if (const auto shaded = shade(*last_, drawn_, Extent::kAll); !shaded) return tl::unexpected(shaded.error());
    add_to_sum();
    refinement.next.reset();
    return true;
}

// The sum of views begins with the one that is there.
Result<void> Renderer::Impl::begin_refinement() {
    refinement_ = std::make_unique<Refinement>();
    refinement_->sum = make_texture(GL_RGBA16F, inner_.x, inner_.y);
    refinement_->sum_target = make_framebuffer({refinement_->sum});
    begin_state();
    if (lit_is_mean_) // but for branches that were pointed at since
        if (auto shaded = shade(*last_, drawn_, Extent::kAll); !shaded) return shaded;
    lit_is_mean_ = false;
    glBindFramebuffer(GL_FRAMEBUFFER, refinement_->sum_target);
    const std::array<GLfloat, 4> nothing{};
    glClearBufferfv(GL_COLOR, 0, nothing.data());
    add_to_sum();
    return {};
}

// Draws on at further views, in passes of their own; true: there is one more in the sum.
Result<bool> Renderer::Impl::add_views(double seconds) {
    const Stopwatch watch;
    if (!refinement_)
        if (auto begun = begin_refinement(); !begun) return tl::unexpected(begun.error());
    struct Elsewhere {
        explicit Elsewhere(Impl& of) : impl(of) { swap(); }
        ~Elsewhere() { swap(); }
        void swap() const {
            std::swap<Passes>(impl, impl.refinement_->passes);
            glNamedBufferSubData(impl.view_block_, 0, sizeof impl.view_, &impl.view_);
        }
        Impl& impl;
    } const elsewhere(*this);
    bool any = false;
    do {
        const auto added = add_view(seconds - watch.seconds());
        if (!added) return added;
        any |= *added;
    } while (refinement_->views < kFineViews && watch.seconds() < seconds);
    return any;
}

Refined Renderer::Impl::refine(double seconds) {
    if (!last_ || refined_ || unfinished_ || cast_ || !holds_last_ || last_->quality != Quality::kFull) return {};
    Refined done;
    const auto stop = [&] { // as far as it goes
        refinement_.reset();
        refined_ = true;
        restore_state();
        return Refined{};
    };
    try {
        const auto added = add_views(seconds);
        if (!added || gl_ran_out_of_memory()) return stop();
        done.changed = *added;
    } catch (const OutOfGraphicsMemory&) {
        return stop();
    }
    if (done.changed) {
        glBindFramebuffer(GL_FRAMEBUFFER, lit_target_);
        glViewport(0, 0, inner_.x, inner_.y);
        glBindTextureUnit(kUnitImage, refinement_->sum);
        glProgramUniform1f(mean_view_, kUniformShare, 1.0F / static_cast<float>(refinement_->views));
        fullscreen(mean_view_);
        lit_is_mean_ = true;
        region_at_ = glm::ivec2(0);
        region_size_ = inner_;
        draw_overlays(*last_, last_layers_);
        note_gl_errors("a finer picture");
    }
    restore_state();
    if (refinement_->views == kFineViews) {
        refinement_.reset();
        refined_ = true;
    }
    done.more = !refined_;
    return done;
}

} // namespace ramus::render
