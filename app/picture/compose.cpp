#include "app/picture/compose.h"

#include "app/picture/centerlines.h"
#include "app/picture/colouring.h"
#include "app/picture/distance_grid.h"
#include "app/picture/marks_drawing.h"
#include "app/session/context_shapes.h"
#include "core/field/convolution_field.h"

#include <algorithm>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

void show_plan(render::Frame& frame, const tree::VesselTree& tree, const Marks& marks, const Plan& plan) {
    for (const auto& [x, y, z, radius] : marks.lesions) frame.lesions.spheres.emplace_back(x, y, z, radius);
    for (const auto& lesion : plan.meshes)
        if (lesion) frame.lesions.meshes.emplace_back(lesion, &lesion->mesh);
    if (!frame.margins.bands.empty() && !plan.measuring)
        frame.lesions.distances = distance_grid(plan.lesions, frame.margins.bands.back().within_mm);
    for (std::size_t id = 0; id < std::min(plan.cuts.spans.size(), tree.branches.size()); ++id)
        if (const measure::LostSpan& span = plan.cuts.spans[id]; span.any())
            frame.lost.push_back({static_cast<int>(id), span.from, span.to});
}

// What has been read of it.
void show_context(render::Frame& frame, const std::vector<ContextItem>& context) {
    for (const ContextItem& item : context) {
        const auto shape = item.visible ? context_shape_read_before(source_of(item)) : nullptr;
        if (!shape) continue;
        const glm::vec3 colour(item.colour[0], item.colour[1], item.colour[2]);
        frame.context.push_back(
            {shape->mesh, shape->preview, colour / 255.0F, static_cast<float>(item.opacity), item.wireframe});
    }
}

} // namespace

render::Frame compose(const Session& session, const std::shared_ptr<const tree::VesselTree>& tree,
                      std::shared_ptr<const render::PagedMesh> mesh, const Viewing& viewing) {
    render::Frame frame;
    frame.mesh = std::move(mesh);
    frame.camera = session.camera;
    frame.overlays.orientation_cube = frame.overlays.scale_bar = frame.mesh != nullptr; // nothing to measure
    frame.size = viewing.size;
    frame.pixel_ratio = viewing.pixel_ratio;
    frame.states = session.marks.states;
    frame.selected = session.marks.selection;
    frame.hovered = viewing.hovered;
    frame.hovered_dependents.assign(viewing.hovered_dependents.begin(), viewing.hovered_dependents.end());
    frame.background.transparent = viewing.transparent;
    frame.quality = viewing.quality;
    const auto strength = [&](DepthCue cue) { return session.marks.depth_cues.has(cue) ? 1.0F : 0.0F; };
    frame.appearance.occlusion = strength(DepthCue::kOcclusion);
    frame.appearance.depth_cue = strength(DepthCue::kFog);
    frame.appearance.halos = strength(DepthCue::kHalos);
    frame.appearance.contours = strength(DepthCue::kContours);
    frame.appearance.shadows = strength(DepthCue::kShadows);
    frame.appearance.chromadepth = strength(DepthCue::kChromadepth);
    const GlassLook& glass = viewing.glass ? *viewing.glass : session.marks.glass;
    frame.appearance.glass_opacity = static_cast<float>(glass.opacity);
    // A grey with a cool tint, as bright as it says.
    frame.appearance.glass = glm::min(static_cast<float>(glass.grey) * glm::vec3(0.943F, 1.0F, 1.086F), 1.0F);
    show_context(frame, viewing.context ? *viewing.context : session.marks.context);
    if (!tree) return frame;
    const Marks& marks = session.marks;
    const Plan* plan = viewing.plan.get();
    Colouring colouring = colouring_of(*tree, marks, plan);
    frame.colours = std::move(colouring.branches);
    frame.scale = std::move(colouring.scale);
    frame.margins = std::move(colouring.margins);
    if (frame.mesh) frame.overlays.legend = std::move(colouring.legend);
    if (plan != nullptr) show_plan(frame, *tree, marks, *plan);
    const mesh::SurfaceOptions& options = viewing.options ? *viewing.options : marks.options;
    frame.centerlines = centerlines_of(tree, options);
    if (marks.skeleton) frame.skeleton = frame.centerlines;
    const bool cones = viewing.method.value_or(options.method) == mesh::Method::kTruncatedCones;
    frame.width = cones ? 0.0F : static_cast<float>(options.width);
    frame.beyond_ends = cones ? 1.0F : static_cast<float>(field::reach_beyond_end(options.width));
    draw_cuts(frame, marks, plan);
    if (viewing.measurements) draw_measurements(frame, *viewing.measurements);
    return frame;
}

render::Frame compose(const Document& document, std::shared_ptr<const render::PagedMesh> mesh, Viewing viewing) {
    viewing.plan = document.plan_so_far();
    viewing.measurements = document.measurements();
    if (viewing.hovered >= 0 && viewing.hovered < document.branch_count())
        viewing.hovered_dependents = document.dependency().dependents(viewing.hovered);
    return compose(document.session(), document.tree(), std::move(mesh), viewing);
}

} // namespace ramus::app
