// Which branches meet, of those that are glass and those that are opaque: there a triangle's branch does not say which
// of the two it belongs to, and both passes draw their side of it (shaders/meeting.glsl).
#pragma once

#include "render/gpu_lines.h"
#include "render/gpu_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ramus::render {

struct GlassMeetings {
    std::vector<Layer> away, meeting; // kNone: belongs to the other list; `meeting` is empty when none does
    std::vector<std::array<std::uint32_t, 2>> spans, company; // as in meeting.glsl

    GlassMeetings() = default;
    GlassMeetings(std::vector<Layer> layers, std::size_t count, const GpuLines& lines);
    // All that meets, as if it were of this layer.
    [[nodiscard]] std::vector<Layer> meeting_as(Layer layer) const;
};

} // namespace ramus::render
