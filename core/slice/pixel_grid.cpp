#include "core/slice/pixel_grid.h"

#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>

namespace ramus::slice {

namespace {

constexpr std::array kPatientDirections{Direction::kAxial, Direction::kCoronal, Direction::kSagittal};

// Calls `call(place)` for the eight corners of a box of voxel indices.
template <class Call>
void for_corners(const volume::Volume& volume, const glm::dvec3& first, const glm::dvec3& last, const Call& call) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 index((corner & 1) != 0 ? last.x : first.x, (corner & 2) != 0 ? last.y : first.y,
                               (corner & 4) != 0 ? last.z : first.z);
        call(glm::dvec3(volume.to_patient * glm::dvec4(index, 1.0)));
    }
}

} // namespace

std::string_view name_of(Direction direction) { return kDirections[static_cast<std::size_t>(direction)].second; }

std::optional<Direction> direction_named(std::string_view name) { return paired_with(kDirections, name); }

Axes axes_of(Direction direction) {
    switch (direction) {
    case Direction::kCoronal:
        return {{-1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
    case Direction::kSagittal:
        return {{0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}};
    case Direction::kAxial:
    case Direction::kOblique:
        break;
    }
    return {{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
}

Axes axes_across(const glm::dvec3& normal) {
    const glm::dvec3 unit = glm::normalize(normal);
    Axes axes;
    double nearest = -1.0;
    for (const Direction direction : kPatientDirections) {
        const Axes candidate = axes_of(direction);
        const double cosine = std::abs(glm::dot(candidate.to_viewer(), unit));
        if (cosine > nearest) nearest = cosine, axes = candidate;
    }
    const glm::dvec3 from = axes.to_viewer();
    const glm::dvec3 to = glm::dot(from, unit) < 0.0 ? -unit : unit;
    // Rodrigues' rotation from `from` to `to`; they are never opposite.
    const glm::dvec3 axis = glm::cross(from, to);
    const double share = 1.0 / (1.0 + glm::dot(from, to));
    const auto turned = [&](const glm::dvec3& v) {
        return glm::normalize(v + glm::cross(axis, v) + share * glm::cross(axis, glm::cross(axis, v)));
    };
    axes.right = turned(axes.right);
    axes.down = glm::cross(axes.right, to);
    return axes;
}

PixelGrid grid_around(const Axes& axes, const glm::dvec3& middle, double mm_per_pixel, glm::ivec2 size) {
    PixelGrid grid{{}, mm_per_pixel * axes.right, mm_per_pixel * axes.down, size};
    grid.corner = middle - 0.5 * (size.x - 1) * grid.right - 0.5 * (size.y - 1) * grid.down;
    return grid;
}

PixelGrid grid_covering(const volume::Volume& volume, const Axes& axes, const glm::dvec3& at, double mm_per_pixel) {
    glm::dvec2 least(HUGE_VAL);
    glm::dvec2 most(-HUGE_VAL);
    for_corners(volume, glm::dvec3(0.0), glm::dvec3(volume.size - 1), [&](const glm::dvec3& place) {
        const glm::dvec2 on(glm::dot(place - at, axes.right), glm::dot(place - at, axes.down));
        least = glm::min(least, on);
        most = glm::max(most, on);
    });
    // Rounding must not add a row.
    constexpr double kLess = 1e-6;
    const glm::dvec2 steps = (most - least) / mm_per_pixel - kLess;
    return {at + least.x * axes.right + least.y * axes.down, mm_per_pixel * axes.right, mm_per_pixel * axes.down,
            glm::ivec2(std::max(0.0, std::ceil(steps.x)), std::max(0.0, std::ceil(steps.y))) + 1};
}

glm::dvec3 middle_of(const volume::Volume& volume) {
    return glm::dvec3(volume.to_patient * glm::dvec4(glm::dvec3(volume.size / 2), 1.0));
}

double smallest_spacing_mm(const volume::Volume& volume) {
    const glm::dvec3 spacing = volume::spacing_mm(volume.to_patient);
    return std::min({spacing.x, spacing.y, spacing.z});
}

Bounds<glm::dvec3> bounds_of(const volume::Volume& volume) {
    Bounds<glm::dvec3> bounds;
    for_corners(volume, glm::dvec3(-0.5), glm::dvec3(volume.size) - 0.5,
                [&](const glm::dvec3& at) { bounds.hold(at); });
    return bounds;
}

} // namespace ramus::slice
