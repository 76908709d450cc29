#include "render/renderer/card.h"

#include "render/gl/gl_context.h"
#include "render/renderer/passes/gl_state.h"

namespace ramus::render {

namespace {

constexpr std::uint64_t kMostMovingTriangles = 40'000; // larger surfaces are drawn as cones while the view moves

} // namespace

Result<void> Passes::make(For what) {
    const auto make_all = [](auto&... passes) {
        Result<void> made;
        (void)((made = passes.make()) && ...);
        return made;
    };
    if (!made_for_cast_) {
        view_block_ = make_buffer(sizeof(ViewBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
        if (auto made = make_all(marks, sprites); !made) return made;
        made_for_cast_ = true;
    }
    if (what == For::kCast || made_) return {};
    auto made = make_all(surface, centerlines, context, resolve, occlusion, shade, mean, copy);
    if (made) made = gl_has_lists() ? lists.make() : layers.make();
    made_ = made.has_value();
    return made;
}

void Passes::send(const ViewSetup& view) const {
    glNamedBufferSubData(view_block_, 0, sizeof view.block, &view.block);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockView, view_block_);
}

void Passes::begin(const ViewSetup& view) const {
    begin_passes(view.size);
    send(view);
}

InParts<std::uint64_t> Passes::draw_caps(const Subject& subject, ViewTargets& targets) {
    targets.make_caps();
    InParts<std::uint64_t> context_caps = context.draw_caps(subject, targets.view, targets.samples);
    while (context_caps.resume()) co_await kPartEnds;
    std::uint64_t triangles = context_caps.result();
    if (subject.has_mesh()) {
        InParts<std::uint64_t> caps = surface.draw_caps(subject, targets.view, targets.samples);
        while (caps.resume()) co_await kPartEnds;
        triangles += caps.result();
    }
    co_return triangles;
}

// Resolves what is opaque, with the glass over it.
InParts<Result<std::uint64_t>> Passes::draw_glass(const Subject& subject, ViewTargets& targets) {
    if (!targets.has_glass) {
        co_await kPartEnds;
        resolve.draw(ResolvePass::What::kOpaque, targets, {0, targets.view.size.y});
        co_return 0;
    }
    if (!gl_has_lists()) co_return layers.draw_first(subject, targets);
    InParts<Result<std::uint64_t>> glass = lists.draw(subject, targets);
    while (glass.resume()) co_await kPartEnds;
    co_return glass.result();
}

InParts<Result<std::uint64_t>> Passes::draw_view(Subject subject, ViewTargets& targets, bool moving) {
    const Frame& frame = subject.frame;
    SceneOnCard& scene = subject.scene;
    ViewSetup& view = targets.view;
    view.look(frame, subject.has_mesh() ? subject.mesh.shown()->bounds() : scene.shapes().bounds(frame.context),
              scene.beside_tree(frame));
    send(view);
    if (view.cap_values)
        if (auto made = resolve.make_capped(); !made) co_return tl::unexpected(made.error());
    scene.divide_near_surface(frame, view);
    co_await kPartEnds;
    targets.has_glass = subject.has_glass();
    if (subject.has_mesh()) scene.branch_layers().send(*subject.mesh.shown(), subject.layers);

    std::uint64_t triangles = 0;
    if (subject.has_values()) targets.make_values();
    draw_opaque_into(targets.samples);
    clear_samples();
    const bool has_lines = scene.lines().shown() != nullptr;
    const bool as_cones = moving && subject.has_mesh() && has_lines && !subject.has_glass_vessels() &&
                          !subject.has_values() && !frame.only_mesh && !frame.cut_away &&
                          subject.mesh.triangles_in_picture(subject.mesh_to_clip(view)) > kMostMovingTriangles;
    if (as_cones) {
        triangles += centerlines.draw_cones(subject);
    } else if (subject.has_mesh()) {
        InParts<std::uint64_t> vessels = surface.draw(subject, view, targets.samples);
        while (vessels.resume()) co_await kPartEnds;
        triangles += vessels.result();
    }
    InParts<std::uint64_t> opaque_context = context.draw_opaque(subject, view, targets.samples);
    while (opaque_context.resume()) co_await kPartEnds;
    triangles += opaque_context.result();
    draw_opaque_into(targets.samples);
    glDisable(GL_CULL_FACE);
    if (targets.has_glass && has_lines) {
        InParts<std::uint64_t> lines = centerlines.draw_lines(subject, view, targets.samples);
        while (lines.resume()) co_await kPartEnds;
    }

    if (view.cap_values) {
        InParts<std::uint64_t> caps = draw_caps(subject, targets);
        while (caps.resume()) co_await kPartEnds;
        triangles += caps.result();
    }
    InParts<Result<std::uint64_t>> glass = draw_glass(subject, targets);
    while (glass.resume()) co_await kPartEnds;
    if (!glass.result()) co_return glass.result();
    triangles += *glass.result();
    co_await kPartEnds;
    note_gl_errors("drawing surfaces");
    if (frame.appearance.occlusion > 0.0F || frame.appearance.shadows > 0.0F)
        occlusion.draw(frame, view, targets.resolved, targets.occlusion);
    note_gl_errors("the occlusion");
    co_return triangles;
}

void Passes::draw_overlays(const Subject& subject, const ViewTargets& targets, const PictureTarget& to,
                           const Region& region, GLuint ids) {
    const GLuint depth = targets.seen_depth();
    begin_blending(Blending::kOver);
    skeleton.draw(subject, targets.view, depth);
    marks.draw(subject, targets, ids, shade.records().table());
    sprites.draw(subject.frame, targets.view.enlarged() ? Region{glm::ivec2(0), to.size} : region);
    glDisable(GL_BLEND);
}

void Card::release() {
    end_passes();
    scene.release();
    passes.shade.release();
    targets = {};
    picture = {};
}

} // namespace ramus::render
