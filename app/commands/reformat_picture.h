// The pictures of `ramus reformat`: a reformation with the walls of the vessel and a ruler along its axis, and a
// contact sheet of cross-sections. Painted on the processor.
#pragma once

#include "app/reports/section_tables.h"
#include "app/session/numbers.h"
#include "core/slice/cross_section.h"
#include "core/slice/reformation.h"
#include "core/slice/walls.h"
#include "core/slice/window.h"
#include "core/volume/volume.h"
#include "render/image/image.h"

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace ramus::app {

// A painted picture, and where the pixels of the scan are in it.
struct PaintedSlices {
    render::Image image;
    glm::ivec2 corner{0}, size{0}; // of the first slice, pixels
    glm::ivec2 tiles{1};           // slices in a row and in a column
    int gap = 0;                   // pixels between slices
    double mm_per_pixel = 0.0;
    slice::Window window;
};

// Fails if the picture is too large. Walls have the colours of their branches, those of the mask are white. Without a
// window, that of the scan is used (core/slice/window.h).
[[nodiscard]] Result<PaintedSlices> painted_reformation(const volume::Volume& scan, const slice::VesselPath& path,
                                                        const slice::Reformation& picture, const Outlines& outlines,
                                                        const std::optional<slice::Window>& window,
                                                        const Lengths& lengths);

// The sections at `samples`, `width_mm` wide.
[[nodiscard]] Result<PaintedSlices>
painted_sections(const volume::Volume& scan, std::span<const slice::PathSample> samples, double width_mm,
                 const Outlines& outlines, const std::optional<slice::Window>& window, const Lengths& lengths);

} // namespace ramus::app
