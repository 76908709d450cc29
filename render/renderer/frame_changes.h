// What two frames have in common, and so what of one's picture serves the other's; and what passes ask of a frame.
#pragma once

#include "render/scene/frame.h"
#include "render/scene/layer.h"

#include <vector>

namespace ramus::render {

// By branch id, as the passes draw them; what is not named is opaque.
[[nodiscard]] std::vector<Layer> layers_of(const std::vector<BranchState>& states);

// Whether anything over the picture is fainter behind vessels while these are the ray caster's.
[[nodiscard]] bool lies_over_depths(const Frame& frame);
[[nodiscard]] bool outlines_selection(const Frame& frame);

// What lies over a picture is painted anew, and nothing under it.
[[nodiscard]] bool differs_in_overlays_only(const Frame& before, const Frame& after);
[[nodiscard]] bool differs_in_hover_and_overlays_only(const Frame& before, const Frame& after);
// Whether the passes up to the occlusion would make the same of both, where all else is the same.
[[nodiscard]] bool same_geometry(const Frame& a, const Frame& b, bool has_glass);

} // namespace ramus::render
