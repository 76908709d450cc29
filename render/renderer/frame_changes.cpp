#include "render/renderer/frame_changes.h"

#include <algorithm>
#include <tuple>

namespace ramus::render {

namespace {

// Colours and the degree of transparency affect only shading.
bool same_shapes(const std::vector<ContextMesh>& a, const std::vector<ContextMesh>& b) {
    const auto shape = [](const ContextMesh& m) {
        return std::tuple(m.shown() ? m.mesh : nullptr, m.shown() ? m.preview : nullptr, m.clear(), m.wireframe);
    };
    return std::ranges::equal(a, b, {}, shape, shape);
}

} // namespace

bool lies_over_depths(const Frame& frame) { return frame.skeleton || !frame.lines.empty(); }

bool outlines_selection(const Frame& frame) {
    return std::ranges::any_of(frame.lines, [](const MarkLine& line) { return line.of_selection; });
}

std::vector<Layer> layers_of(const std::vector<BranchState>& states) {
    std::vector<Layer> layers(states.size());
    std::ranges::transform(states, layers.begin(), [](BranchState state) {
        if (state == BranchState::kHidden) return Layer::kNone;
        return state == BranchState::kDefocused ? Layer::kGlass : Layer::kOpaque;
    });
    while (!layers.empty() && layers.back() == Layer::kOpaque) layers.pop_back();
    return layers;
}

bool differs_in_overlays_only(const Frame& before, const Frame& after) {
    Frame same = before;
    same.overlays = after.overlays;
    return same == after;
}

bool differs_in_planes_only(const Frame& before, const Frame& after) {
    if (before.planes.empty() || after.planes.empty()) return false;
    Frame same = before;
    same.overlays = after.overlays;
    same.planes = after.planes;
    same.lines = after.lines;
    same.labels = after.labels;
    return same == after;
}

bool differs_in_hover_and_overlays_only(const Frame& before, const Frame& after) {
    Frame same = before;
    same.overlays = after.overlays;
    same.hovered = after.hovered;
    same.hovered_dependents = after.hovered_dependents;
    return same == after;
}

bool same_geometry(const Frame& a, const Frame& b, bool has_glass) {
    return a.mesh == b.mesh && a.bends == b.bends && a.camera == b.camera && a.size == b.size &&
           a.quality == b.quality && a.lesions == b.lesions && same_shapes(a.context, b.context) &&
           a.cut_away == b.cut_away && a.pixel_ratio == b.pixel_ratio &&
           (!has_glass || a.centerlines == b.centerlines) &&
           (a.appearance.shadows > 0.0F || !(b.appearance.shadows > 0.0F)) &&
           (a.appearance.occlusion > 0.0F || !(b.appearance.occlusion > 0.0F));
}

} // namespace ramus::render
