// PixelGrid: the pixels of a slice through the patient. Its axes follow the conventions of radiology: in axial and
// coronal slices the patient's left is on the right side of the picture, in sagittal slices anterior is on its left.
//
// Units: mm, RAS.
#pragma once

#include "core/base/bounds.h"
#include "core/volume/volume.h"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <utility>

namespace ramus::slice {

enum class Direction : std::uint8_t { kAxial, kCoronal, kSagittal, kOblique };
inline constexpr std::array<std::pair<Direction, std::string_view>, 4> kDirections{{{Direction::kAxial, "axial"},
                                                                                    {Direction::kCoronal, "coronal"},
                                                                                    {Direction::kSagittal, "sagittal"},
                                                                                    {Direction::kOblique, "oblique"}}};
[[nodiscard]] std::string_view name_of(Direction direction);
[[nodiscard]] std::optional<Direction> direction_named(std::string_view name);

struct Plane {
    glm::dvec3 point{0.0}, normal{0.0, 0.0, 1.0}; // the normal is of unit length
    [[nodiscard]] double height(const glm::dvec3& at) const { return glm::dot(at - point, normal); }
    bool operator==(const Plane&) const = default;
};

// The directions of a picture's rows and columns, of unit length and at right angles.
struct Axes {
    glm::dvec3 right{-1.0, 0.0, 0.0}, down{0.0, -1.0, 0.0};
    [[nodiscard]] glm::dvec3 to_viewer() const { return glm::cross(down, right); }
    bool operator==(const Axes&) const = default;
};

// Axial from the feet, coronal from the front, sagittal from the patient's left side. kOblique: as axial.
[[nodiscard]] Axes axes_of(Direction direction);
// For a plane across `normal` (of any length but 0, either sign): the axes of the nearest of the three directions,
// turned by the smallest angle.
[[nodiscard]] Axes axes_across(const glm::dvec3& normal);

struct PixelGrid {
    glm::dvec3 corner{0.0};                                 // centre of the upper left pixel
    glm::dvec3 right{-1.0, 0.0, 0.0}, down{0.0, -1.0, 0.0}; // steps from pixel to pixel, at right angles
    glm::ivec2 size{1};                                     // pixels

    // The place of a pixel; its centre for whole numbers.
    [[nodiscard]] glm::dvec3 place(const glm::dvec2& pixel) const { return corner + pixel.x * right + pixel.y * down; }
    // The pixel whose place is the foot of a point on the plane.
    [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& at) const {
        return {glm::dot(at - corner, right) / glm::dot(right, right),
                glm::dot(at - corner, down) / glm::dot(down, down)};
    }
    // Its normal points towards the viewer.
    [[nodiscard]] Plane plane() const { return {corner, glm::normalize(glm::cross(down, right))}; }
    [[nodiscard]] glm::dvec3 middle() const { return place(0.5 * glm::dvec2(size - 1)); }
    bool operator==(const PixelGrid&) const = default;
};

// A grid of square pixels whose middle is `middle`.
[[nodiscard]] PixelGrid grid_around(const Axes& axes, const glm::dvec3& middle, double mm_per_pixel, glm::ivec2 size);
// The smallest grid of square pixels through `at` that covers all voxel centres, seen across the plane. Where the axes
// are those of the volume and `at` is a voxel centre, pixel centres are voxel centres if voxels are as large as pixels.
[[nodiscard]] PixelGrid grid_covering(const volume::Volume& volume, const Axes& axes, const glm::dvec3& at,
                                      double mm_per_pixel);

// The centre of the middle voxel.
[[nodiscard]] glm::dvec3 middle_of(const volume::Volume& volume);
[[nodiscard]] double smallest_spacing_mm(const volume::Volume& volume);
// The box around all voxels, with their whole extent.
[[nodiscard]] Bounds<glm::dvec3> bounds_of(const volume::Volume& volume);

} // namespace ramus::slice
