// Sampling a ConvolutionField: values on small grids and at lattice points, projection of points onto the surface, and
// bounds over boxes. Everything is vectorised with run-time dispatch over the machine's instruction sets; within one
// instruction set a point's value has the same bits in whichever call it is computed, provided that the list holds
// every segment whose support contains the point, in ascending order.
#pragma once

#include "core/field/convolution_field.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

// Grid of 5 x 5 x 5 points, x fastest; values are padded to kGridStride entries.
inline constexpr int kGridSide = 5;
inline constexpr int kGridPoints = kGridSide * kGridSide * kGridSide;
inline constexpr int kGridStride = 128;

struct GridAxes {
    std::array<double, kGridSide> x, y, z; // mm
};
// Returns one bit per point: is the value at or above the isovalue?
std::array<std::uint64_t, 2> sample_grid(const ConvolutionField& field, std::span<const std::uint32_t> list,
                                         const GridAxes& axes, std::span<float, kGridStride> values);

// Points given by indices into small tables of coordinates; at most kLatticeSide entries an axis.
inline constexpr int kLatticeSide = 17;
struct LatticeAxes {
    std::array<double, kLatticeSide> x, y, z; // mm
};
struct LatticePoint {
    std::uint8_t i, j, k;
};
void sample_lattice(const ConvolutionField& field, std::span<const std::uint32_t> list, const LatticeAxes& axes,
                    std::span<const LatticePoint> points, std::span<float> values);

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
    std::vector<float> local;             // scratch: segment starts relative to origin

    [[nodiscard]] std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    void add(glm::vec3 guess, glm::vec3 centre, float half_extent) {
        if (size_ == x.size()) grow(2 * size_ + 64);
        x[size_] = guess.x, y[size_] = guess.y, z[size_] = guess.z;
        cx[size_] = centre.x, cy[size_] = centre.y, cz[size_] = centre.z;
        reach[size_++] = half_extent;
    }
    void grow(std::size_t capacity);

private:
    std::size_t size_ = 0;
};
inline constexpr int kProjectionSteps = 2;
// Returns the number of kernel evaluations it took: kProjectionSteps for every point and segment.
std::uint64_t project(const ConvolutionField& field, std::span<const std::uint32_t> list, Projection& points);

// Bounds of F over the ball around `centre`, from the segments in `list`; `kept` receives those of the list whose
// support reaches the ball, in order. `centre` is relative to `field_origin`, to which `relative` starts refer.
struct Bounds {
    float lower = 0.0F;
    float upper = 0.0F;
};

// Segment starts in single precision relative to one origin, for culling only.
struct CullingArrays {
    glm::dvec3 origin{0.0};
    std::vector<float> ax, ay, az;
    explicit CullingArrays(const ConvolutionField& field);
};
Bounds cull(const ConvolutionField& field, const CullingArrays& culling, std::span<const std::uint32_t> list,
            glm::vec3 centre, float ball_radius, std::vector<std::uint32_t>& kept);

// Name of the instruction set in use, such as "AVX3".
const char* instruction_set();

} // namespace ramus::field
