// Pictures of the caster: synchronous, or on a worker thread while the previous picture is shown.
#include "render/renderer/frame_changes.h"
#include "render/renderer/renderer.h"

#include <utility>

namespace ramus::render {

// The caster draws every pixel, whatever the passes' resolution.
ViewSetup Renderer::cast_view(const Subject& subject) const {
    ViewSetup view = card_.targets.view;
    view.size = view.picture = subject.frame.size;
    view.look(subject.frame, subject.has_mesh() ? subject.mesh.shown()->bounds() : card_.scene.lines().bounds(),
              card_.scene.beside_tree(subject.frame));
    return view;
}

std::uint64_t Renderer::cast(const Subject& subject) {
    card_.targets.view = cast_view(subject);
    card_.passes.begin(card_.targets.view);
    return card_.passes.cast.draw(subject, card_.targets.view, card_.passes.shade.records());
}

Result<bool> Renderer::cast_in_time(const Subject& subject, double seconds, DrawStatistics& done) {
    CastPass& pass = card_.passes.cast;
    const auto begin_cast = [&] { pass.begin(subject, cast_view(subject), card_.passes.shade.records()); };
    if (!pass.busy()) begin_cast();
    auto made = pass.take(seconds);
    done.unfinished = !made || made->frame != subject.frame || made->layers != subject.layers;
    done.of_before = made && made->frame.centerlines != subject.frame.centerlines;
    const bool another = made && done.unfinished && !differs_in_overlays_only(made->frame, subject.frame);
    if (!made) return false;
    done.cones = made->cones;
    done.seconds = made->seconds;
    done.geometry = true;
    if (auto shown = show_cast(std::move(*made)); !shown) return tl::unexpected(shown.error());
    if (another) begin_cast();
    return true;
}

Result<void> Renderer::show_cast(CastPass::Made made) {
    if (auto fits = resize(made.frame, Plan::kCast); !fits) return tl::unexpected(fits.error());
    if (auto fits = fit_picture(made.frame.size); !fits) return fits;
    card_.targets.view = made.view;
    card_.passes.begin(made.view);
    state_.cast();
    in_cast_ = next_pick_source(made.frame, made.view);
    show(subject_of(made.frame, made.layers), {glm::ivec2(0), made.view.size});
    last_ = std::move(made.frame);
    last_layers_ = std::move(made.layers);
    shown_view_ = made.view;
    return {};
}

// Discards a pending picture of another size or camera.
Result<void> Renderer::back_to_cast() {
    if (auto fits = resize(*last_, Plan::kCast); !fits) return tl::unexpected(fits.error());
    card_.targets.view = shown_view_;
    return {};
}

} // namespace ramus::render
