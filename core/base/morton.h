// The Morton curve (Z-order): positions with near codes are mostly near each other in space.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus {

// Interleaves the lowest ten bits of each coordinate; x has the lowest bit of each triple.
inline std::uint32_t morton(const glm::uvec3& n) {
    const auto spread = [](std::uint32_t b) {
        b = (b | b << 16U) & 0x030000FFU;
        b = (b | b << 8U) & 0x0300F00FU;
        b = (b | b << 4U) & 0x030C30C3U;
        return (b | b << 2U) & 0x09249249U;
    };
    return spread(n.x) | spread(n.y) << 1U | spread(n.z) << 2U;
}

} // namespace ramus
