// What goes into projecting points onto the surface, and what comes out: first guesses, and for each its point on the
// surface with normal, local radius and branch. Side by side in memory, padded to whole vectors.
#pragma once

#include "core/field/dominance.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::field {

inline constexpr std::size_t kProjectionPadding = 32; // points are read and written by whole vectors, two at most
inline constexpr int kProjectionSteps = 2;            // at most

// First guesses of points on the surface. Positions are relative to the brick's corner, in mm; each point
// stays within `reach` of its centre along every axis. The arrays are longer than size(): they are kept from use to use
// and padded to whole vectors.
struct Projection {
    std::vector<float> x, y, z;
    std::vector<float> cx, cy, cz, reach;

    [[nodiscard]] std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    void add(glm::vec3 guess, glm::vec3 centre, float half_extent) {
        if (size_ == x.size()) grow(2 * size_ + 64);
        x[size_] = guess.x, y[size_] = guess.y, z[size_] = guess.z;
        cx[size_] = centre.x, cy[size_] = centre.y, cz[size_] = centre.z;
        reach[size_++] = half_extent;
    }
    // Adds `count` points to be filled in, and returns the first. The arrays go on for a whole vector behind the last.
    std::size_t extend(std::size_t count) {
        constexpr std::size_t kWidestVector = 16;
        const std::size_t first = size_;
        size_ += count;
        if (size_ + kWidestVector > x.size()) grow(2 * size_ + 64);
        return first;
    }
    void grow(std::size_t capacity);
    // Repeats the last point behind the end, kProjectionPadding times. Not of none.
    void pad();

private:
    std::size_t size_ = 0;
};

// Where the points go, arrays that go on for kProjectionPadding more than there are.
struct SurfacePoints {
    glm::vec3* positions;   // mm
    glm::vec3* normals;     // unit length, outward
    float* radii;           // local radius, mm: of the strongest segment there
    std::int32_t* branches; // that contribute most
    Dominance* dominance;
};

} // namespace ramus::field
