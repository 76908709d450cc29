#include "app/picture/compose.h"

#include "app/assets/assets.h"
#include "app/assets/plan.h"
#include "app/picture/along_picture.h"
#include "app/picture/colouring.h"
#include "app/picture/contact_marks.h"
#include "app/picture/deviation_colours.h"
#include "app/picture/lesion_outlines.h"
#include "app/picture/note_marks.h"
#include "app/picture/scene_objects.h"
#include "app/picture/slices.h"
#include "app/picture/territories.h"
#include "app/session/session.h"
#include "render/overlay/scale_bar.h"
#include "render/scene/frame.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

void show_plan(render::Frame& frame, const Assets& assets, const Marks& marks) {
    const Plan& plan = *assets.plan;
    if (!frame.margins.bands.empty() && assets.lesion_grid.fits(plan.lesions, widest_margin_mm(marks.planning)))
        frame.lesions.distances = assets.lesion_grid.grid;
    for (std::size_t id = 0; id < std::min(plan.cuts.spans.size(), assets.tree->branches.size()); ++id)
        if (const measure::LostSpan& span = plan.cuts.spans[id]; span.any())
            frame.lost.push_back({static_cast<int>(id), span.from, span.to});
}

constexpr glm::vec3 kCutColour{0.94F, 0.95F, 0.97F}, kReconstructColour{1.00F, 0.62F, 0.20F};

// Draws a ring around every cut; needs the frame's centerlines. `plan`: of the same marks; null: no cuts are marked.
void draw_cuts(render::Frame& frame, const Marks& marks, const Plan* plan) {
    for (std::size_t i = 0; i < marks.cuts.size() && frame.centerlines; ++i) {
        const auto& [branch, fraction] = marks.cuts[i];
        const auto place = frame.centerlines->at(branch, fraction);
        if (!place || state_of(marks, branch) == tree::BranchState::kHidden) continue;
        const bool reconstruct = plan != nullptr && i < plan->cuts.cuts.size() && plan->cuts.cuts[i].reconstruct;
        frame.lines.push_back({ring_around(place->position, place->along, 1.35 * place->radius_mm),
                               reconstruct ? kReconstructColour : kCutColour, 2.2F});
    }
}

// Shows the outline in the assets if it fits the session.
void show_outline(render::Frame& frame, const Session& session, const Assets& assets) {
    const Marks& marks = session.marks;
    if (marks.selection.empty()) return;
    SelectionOutline::Of of{assets.tree, frame.centerlines, session.camera, marks.states, marks.selection};
    const bool fits = assets.outline && assets.outline->of == of;
    const std::vector<render::MarkLine> lines = fits ? assets.outline->marks : selection_outline(std::move(of)).marks;
    frame.lines.insert(frame.lines.end(), lines.begin(), lines.end());
}

void show_glass(render::Appearance& appearance, const GlassLook& glass) {
    appearance.glass_opacity = static_cast<float>(glass.opacity);
    // A grey of the given brightness with a cool tint.
    appearance.glass = glm::min(static_cast<float>(glass.grey) * glm::vec3(0.943F, 1.0F, 1.086F), 1.0F);
    // Many thin glass vessels consist mostly of centerlines, which must not be brighter than vessels in focus.
    constexpr float kLineShare = 0.66F; // tuned on a tree of 2,000 branches
    appearance.centerline = kLineShare * appearance.glass;
}

} // namespace

void show_claims(render::Frame& frame, const tree::Claims& claims) {
    frame.overlays.axes = claims.has_sides() ? render::side_letters() : render::plain_axes();
    frame.overlays.unit_known = claims.has_unit();
}

namespace {

// Shows objects without a tree. If all are transparent there are no depths to read back, and the scale is that of their
// middle.
void show_alone(render::Frame& frame, const Assets& assets, const SceneObjects& objects) {
    show_claims(frame, assets.claims_of(objects));
    if (std::ranges::any_of(frame.context, [](const auto& item) { return item.shown() && !item.clear(); })) return;
    const render::Box box = assets.box_of(objects.context);
    const glm::dvec3 half = 0.5 * (box.upper - box.lower), forward = glm::abs(render::axes_of(frame.camera).forward);
    if (!box.empty())
        frame.overlays.scale = render::scale_of(frame.camera, frame.size, {box.centre(), glm::dot(half, forward)});
}

// What lies before a slice, on the viewer's side of its picture, or behind it.
void cut_away(render::Frame& frame, const Session& session, const Assets& assets) {
    if (!session.slices.cut_away) return;
    const slice::Plane plane = plane_of(session, assets, *session.slices.cut_away);
    frame.cut_away = render::CutAway{plane.point, session.slices.cut_behind ? -plane.normal : plane.normal};
}

// A frame with everything that needs no assets: camera, size, states, looks.
render::Frame bare_frame(const Session& session, const Viewing& viewing) {
    render::Frame frame;
    frame.camera = session.camera;
    frame.size = viewing.size;
    frame.pixel_ratio = viewing.pixel_ratio;
    frame.states = session.marks.states;
    frame.selected = session.marks.selection;
    frame.hovered = viewing.hovered;
    frame.quality = viewing.quality;
    for (const DepthCue& cue : depth_cues())
        frame.appearance.*cue.strength = session.marks.depth_cues.has(cue) ? 1.0F : 0.0F;
    put_on(frame, viewing.ground);
    show_glass(frame.appearance, viewing.glass ? *viewing.glass : session.marks.glass);
    return frame;
}

} // namespace

render::Frame compose(const Session& session, const Assets& assets, std::shared_ptr<const render::PagedMesh> mesh,
                      const Viewing& viewing) {
    render::Frame frame = bare_frame(session, viewing);
    frame.mesh = std::move(mesh);
    draw_objects({frame, assets, viewing}, session.marks);
    frame.planes = viewing.planes;
    cut_away(frame, session, assets);
    const bool alone = !assets.tree && std::ranges::any_of(frame.context, &render::ContextMesh::shown);
    frame.overlays.orientation_cube = frame.overlays.scale_bar = frame.mesh || alone; // otherwise nothing to measure
    // In perspective the scale depends on everything in the picture.
    if (viewing.context_awaited && !frame.camera.orthographic) frame.overlays.scale_bar = false;
    if (alone) show_alone(frame, assets, viewing.objects ? *viewing.objects : session.marks);
    if (!assets.tree) return frame;
    const tree::VesselTree& tree = *assets.tree;
    show_claims(frame, tree.claims);
    if (viewing.axes) frame.overlays.axes = *viewing.axes;
    if (viewing.hovered >= 0 && static_cast<std::size_t>(viewing.hovered) < tree.branches.size()) {
        const auto dependents = assets.facts->dependency.dependents(viewing.hovered);
        frame.hovered_dependents.assign(dependents.begin(), dependents.end());
    }
    const Marks& marks = session.marks;
    const Plan* plan = assets.plan.get();
    Colouring colouring = colouring_of(tree, *assets.facts, marks, plan);
    if (colouring.some_unknown) colouring.branches.assign(tree.branches.size(), kUnknownColour);
    frame.colours = std::move(colouring.beyond.empty() ? colouring.branches : colouring.beyond);
    frame.scale = std::move(colouring.scale);
    frame.margins = std::move(colouring.margins);
    if (frame.mesh) frame.overlays.legend = std::move(colouring.legend);
    frame.overlays.legend.title = Lengths(tree.claims).worded(frame.overlays.legend.title);
    if (plan != nullptr) show_plan(frame, assets, marks);
    draw_territories(frame, assets, marks, viewing.territories_opacity);
    const mesh::SurfaceOptions& options = viewing.options ? *viewing.options : marks.options;
    if (frame.mesh && marks.colour_by == ColourBy::kDeviation) {
        const SurfaceDeviation& deviation = assets.deviation;
        const bool known = deviation.fits(deviation_of(assets.tree, marks, options), frame.mesh);
        if (known) frame.mesh = deviation.valued_mesh;
        show_deviation(frame, marks, known ? &deviation : nullptr);
    }
    frame.centerlines = assets.centerlines.lines;
    if (marks.skeleton || frame.camera.inside) frame.skeleton = frame.centerlines;
    frame.cones = assets.centerlines.cones;
    const mesh::Method method = viewing.method.value_or(options.method);
    const DrawnWidth width = drawn_width(options, method);
    frame.width = width.width;
    frame.beyond_ends = width.beyond_ends;
    frame.only_mesh = !drawn_along_lines(options, method);
    frame.bends = method == mesh::Method::kConvolutionSurface;
    show_outline(frame, session, assets);
    draw_cuts(frame, marks, plan);
    mark_followed(frame, session, assets);
    outline_lesions(frame, assets, marks);
    if (plan != nullptr) draw_shortest_distances(frame, *plan, marks, viewing.lesion, tree.claims);
    draw_margins(frame, assets, marks);
    if (viewing.notes) mark_notes(frame, tree, viewing.note);
    if (assets.contacts.fits(options))
        mark_contacts(frame, *assets.contacts.list, marks.contact_marks ? ContactMarks::kAll : ContactMarks::kCurrent,
                      viewing.contact, tree.branches.size(), Lengths(tree.claims));
    return frame;
}

} // namespace ramus::app
