// Projection: moves points near the surface onto it, and tells what the field is like there. Vectorised over the
// points.
#pragma once

#include "core/field/lead.h"
#include "core/field/local_segments.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

// First guesses of points on the surface. Positions are relative to the corner of the local segments, in mm; each point
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
    // Adds `count` points to be filled in, and returns the first. There is room for a whole vector behind the last.
    std::size_t extend(std::size_t count) {
        constexpr std::size_t kWidestVector = 16;
        const std::size_t first = size_;
        size_ += count;
        if (size_ + kWidestVector > x.size()) grow(2 * size_ + 64);
        return first;
    }
    void grow(std::size_t capacity);

private:
    std::size_t size_ = 0;
};

// Where the points go, with room for kProjectionPadding more than there are.
struct SurfacePoints {
    glm::vec3* positions;   // mm
    glm::vec3* normals;     // unit length, outward
    float* radii;           // local radius, mm: of the strongest segment there
    std::int32_t* branches; // that contribute most
    Lead* leads;
};

inline constexpr std::size_t kProjectionPadding = 32; // points are read and written by whole vectors, two at most
inline constexpr int kProjectionSteps = 2;            // at most
// Moves the points of `points` onto the surface and writes them to `to`. Returns the number of kernels evaluated.
std::uint64_t project(const LocalSegments& local, Projection& points, const SurfacePoints& to);

} // namespace ramus::field
