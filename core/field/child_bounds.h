// The eight children of a cube, and bounds of a field over each: what decides where the surface can be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

// Numbered by bits: 1 = upper x, 2 = upper y, 4 = upper z.
inline constexpr int kChildren = 8;

// Eight cubes of edge `side` around `middle`: mm, relative to the middle of the field's frame.
struct ChildCubes {
    glm::vec3 middle{0.0F};
    float side = 0.0F;
};

struct ChildCentres {
    alignas(32) std::array<float, kChildren> x, y, z;
    explicit ChildCentres(const ChildCubes& cubes) {
        for (std::size_t c = 0; c < kChildren; ++c) {
            x[c] = cubes.middle.x + ((c & 1) != 0 ? 0.5F : -0.5F) * cubes.side;
            y[c] = cubes.middle.y + ((c & 2) != 0 ? 0.5F : -0.5F) * cubes.side;
            z[c] = cubes.middle.z + ((c & 4) != 0 ? 0.5F : -0.5F) * cubes.side;
        }
    }
};

// Where the field may reach the isovalue, the upper bound says only that.
struct ChildBounds {
    std::array<float, kChildren> lower{}, upper{};
};

} // namespace ramus::field
