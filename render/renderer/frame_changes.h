// Compares two frames to find what can be reused of the first one's picture, and answers questions of passes about a
// frame.
#pragma once

#include "render/scene/frame.h"
#include "render/scene/layer.h"

#include <vector>

namespace ramus::render {

// Layers by branch id; branches without an entry are opaque.
[[nodiscard]] std::vector<Layer> layers_of(const std::vector<BranchState>& states);

// Whether the picture has lines that are fainter behind vessels, and so need depths; for pictures of the ray caster.
[[nodiscard]] bool lies_over_depths(const Frame& frame);
[[nodiscard]] bool outlines_selection(const Frame& frame);

// True if only overlays differ.
[[nodiscard]] bool differs_in_overlays_only(const Frame& before, const Frame& after);
// True if only planes, lines, labels and overlays differ, and both frames have planes: surfaces are shaded the same.
[[nodiscard]] bool differs_in_planes_only(const Frame& before, const Frame& after);
[[nodiscard]] bool differs_in_hover_and_overlays_only(const Frame& before, const Frame& after);
// Whether the passes up to the occlusion produce the same for both frames.
[[nodiscard]] bool same_geometry(const Frame& a, const Frame& b, bool has_glass);

} // namespace ramus::render
