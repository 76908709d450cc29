// Projection: moves points near the surface onto it, and tells what the field is like there. Vectorised over the
// points.
#pragma once

#include "core/field/convolution_field.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

// Points to be moved onto the surface. Positions are relative to `origin`, in mm; each stays within `reach` of its
// centre along every axis. The arrays are longer than size(): they are kept from use to use and padded to whole
// vectors.
struct Projection {
    glm::dvec3 origin{0.0};
    std::vector<float> x, y, z;           // in: first guess; out: point on the surface
    std::vector<float> cx, cy, cz, reach; // box that a point must not leave
    std::vector<float> nx, ny, nz;        // out: unit normal, outward
    std::vector<float> radius;            // out: local radius, mm
    std::vector<std::int32_t> segment;    // out: strongest contributor
    std::vector<float> starts;            // scratch: of the segments, relative to origin
    std::vector<std::uint8_t> ends;       // scratch: of the segments, those that points may be near

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
inline constexpr int kProjectionSteps = 2; // at most
// Returns the number of points at which the field was taken, padding included.
std::uint64_t project(const ConvolutionField& field, std::span<const std::uint32_t> list, Projection& points);

} // namespace ramus::field
