// Planes and sheets of resections on a slice: their section lines, and what the pointer grabs of them.
#pragma once

#include "app/session/objects.h"
#include "app/tools/tool.h"

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::app {

// A place of the section line of a resection.
struct SectionHold {
    std::size_t resection = 0; // index
    glm::dvec3 at{0.0};        // mm
    double pixels = 0.0;       // from the pointer
};

// The place of a visible plane's or sheet's section line that is nearest to the pointer, within `reach` pixels.
// `sheets_only`: not of planes. `pointing` must be on a slice.
[[nodiscard]] std::optional<SectionHold> section_under(const Pointing& pointing, double reach,
                                                       bool sheets_only = false);

// The section line of a plane or a sheet, in pixels of the slice; it may have parts.
[[nodiscard]] std::vector<ToolDrawing::Line> section_lines(const Pointing& pointing, const Resection& resection,
                                                           const glm::vec4& colour);

} // namespace ramus::app
