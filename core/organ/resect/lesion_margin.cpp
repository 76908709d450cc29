#include "core/organ/resect/lesion_margin.h"

#include "core/base/infinity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <queue>
#include <utility>

namespace ramus::organ {

namespace {

using Corners = std::array<glm::dvec3, 3>;

double distance_to_box(const glm::dvec3& p, const Bounds<glm::dvec3>& box) {
    return glm::length(glm::max(glm::max(box.least - p, p - box.most), glm::dvec3(0.0)));
}

bool holds_around(const Resection& resection) { return std::holds_alternative<Around>(resection); }

// Whether the resection removes a margin around voxels that the lesion is part of. All of its surface is then at least
// as far from the lesion as the margin, and its vertices are exactly so far from the voxels.
bool surrounds(const Resection& resection, const VoxelSolid& lesion) {
    const auto* around = std::get_if<Around>(&resection);
    if (around == nullptr) return false;
    bool inside = true;
    lesion.voxels().for_voxels([&](const glm::ivec3& voxel, std::size_t) {
        inside = inside && around->solid->contains(lesion.voxels().centre_mm(voxel));
    });
    return inside;
}

// The search for the nearest place of one lesion.
class MarginSearch {
public:
    MarginSearch(const Organ& organ, std::span<const Resection> resections, const ResectionSurface& surface,
                 const VoxelSolid& lesion)
        : organ_(organ), resections_(resections), surface_(surface), lesion_(lesion) {}

    [[nodiscard]] Margin run() {
        Margin margin;
        margin.removed = removed();
        if (surface_.triangles.empty()) return margin;
        find_vertices();
        for (const Resection& one : resections_) {
            constexpr double kRounding = 1e-3; // mm
            surrounds_.push_back(surrounds(one, lesion_) && nearest_ <= std::get<Around>(one).margin_mm + kRounding);
        }
        const measure::MeshDistance::Gap gap = nearest_ == 0.0 ? of_vertices() : refined();
        margin.distance_mm = gap.distance_mm;
        margin.on_surface = gap.on_triangle;
        margin.on_lesion = gap.on_surface;
        return margin;
    }

private:
    // Part of the surface in a box: a voxel or a part of it.
    struct Cell {
        double least = 0.0; // no place of the exact surface in the box is nearer
        double off = 0.0;   // distance of the triangles from the exact surface, at most
        glm::dvec3 from{0.0};
        double size = 1.0; // voxels
        std::size_t resection = 0;
        measure::MeshDistance::Gap gap;
        bool operator<(const Cell& other) const { return least > other.least; } // the nearest first
    };

    [[nodiscard]] Removed removed() const {
        std::size_t count = 0;
        lesion_.voxels().for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            const glm::dvec3 centre = lesion_.voxels().centre_mm(voxel);
            count += std::ranges::any_of(resections_, [&](const Resection& one) { return removes(one, centre); });
        });
        return count == 0 ? Removed::kNone : count == lesion_.voxels().count() ? Removed::kWhole : Removed::kPart;
    }

    // Distances of vertices; of those that cannot be the nearest only a lower bound.
    void find_vertices() {
        const Bounds<glm::dvec3>& box = lesion_.to_surface().bounds();
        distances_.resize(surface_.places.size());
        std::size_t first = 0;
        for (std::size_t n = 0; n < distances_.size(); ++n) {
            distances_[n] = distance_to_box(surface_.places[n], box);
            if (distances_[n] < distances_[first]) first = n;
        }
        const double enough = lesion_.distance(surface_.places[first]);
        tbb::parallel_for(std::size_t{0}, distances_.size(), [&](std::size_t n) {
            if (distances_[n] <= enough) distances_[n] = lesion_.distance(surface_.places[n]);
        });
        nearest_ = *std::ranges::min_element(distances_);
    }

    // The vertex that is nearest to the lesion.
    [[nodiscard]] measure::MeshDistance::Gap of_vertices() const {
        const auto at = std::ranges::min_element(distances_) - distances_.begin();
        const glm::dvec3& place = surface_.places[static_cast<std::size_t>(at)];
        return {nearest_, place, nearest_ > 0.0 ? lesion_.to_surface().nearest_on_surface(place) : place};
    }

    // How far the exact surface may be from a triangle: from the values at its middle and those of its sides.
    [[nodiscard]] double off_of(const Corners& corners, std::size_t resection) const {
        if (std::holds_alternative<HalfSpace>(resections_[resection])) return 0.0;
        double most = std::abs(value_at(resections_[resection], (corners[0] + corners[1] + corners[2]) / 3.0));
        for (std::size_t n = 0; n < 3; ++n)
            most =
                std::max(most, std::abs(value_at(resections_[resection], 0.5 * (corners[n] + corners[(n + 1) % 3]))));
        constexpr double kSafe = 2.0;
        return kSafe * most;
    }

    // Adds a triangle to a cell, if it may be nearer than `best`.
    void hold(Cell& cell, const Corners& corners, double& best) const {
        const double off = off_of(corners, cell.resection);
        const auto gap = lesion_.to_surface().triangle_gap(corners, std::min(cell.gap.distance_mm, best + off));
        if (gap && gap->distance_mm < cell.gap.distance_mm) cell.gap = *gap;
        cell.off = std::max(cell.off, off);
        cell.least = std::max(0.0, cell.gap.distance_mm - cell.off);
        best = std::min(best, cell.gap.distance_mm + cell.off);
    }

    // The voxels whose triangles may hold the nearest place.
    void first_cells(std::priority_queue<Cell>& open, double& best) const {
        Cell cell;
        cell.gap.distance_mm = kInfinity;
        const auto close = [&] {
            if (cell.gap.distance_mm < kInfinity) open.push(cell);
        };
        glm::ivec3 voxel(-1);
        for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
            const glm::uvec3& t = surface_.triangles[n];
            const Corners corners{surface_.places[t.x], surface_.places[t.y], surface_.places[t.z]};
            const double longest =
                std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                          glm::distance(corners[2], corners[0])});
            constexpr double kOff = 0.2; // mm; more than the exact surface is from a triangle
            if (surrounds_[surface_.resections[n]]) continue;
            if (std::min({distances_[t.x], distances_[t.y], distances_[t.z]}) - longest - kOff > best) continue;
            if (surface_.voxels[n] != voxel || surface_.resections[n] != cell.resection) {
                close();
                voxel = surface_.voxels[n];
                cell = {kInfinity, 0.0, glm::dvec3(voxel) - 0.5, 1.0, surface_.resections[n], {kInfinity, {}, {}}};
            }
            hold(cell, corners, best);
        }
        close();
    }

    [[nodiscard]] measure::MeshDistance::Gap refined() const {
        constexpr double kFine = 1e-5; // mm
        std::priority_queue<Cell> open;
        double best = nearest_;
        first_cells(open, best);
        measure::MeshDistance::Gap gap = of_vertices();
        // Around a lesion all places are about equally near, and the vertices exactly.
        int may_divide = std::ranges::any_of(resections_, holds_around) ? 40 : 400; // cells
        while (!open.empty() && open.top().least < gap.distance_mm - kFine) {
            const Cell cell = open.top();
            open.pop();
            if (cell.off <= kFine) {
                if (cell.gap.distance_mm < gap.distance_mm) gap = cell.gap;
                continue;
            }
            if (may_divide-- == 0) break;
            for (int part = 0; part < 8; ++part) {
                const double size = 0.5 * cell.size;
                Cell half{kInfinity,
                          0.0,
                          cell.from + size * glm::dvec3(part & 1, part >> 1 & 1, part >> 2),
                          size,
                          cell.resection,
                          {kInfinity, {}, {}}};
                for (const Corners& corners : surface_in_box(organ_, resections_, half.resection, half.from, size))
                    hold(half, corners, best);
                if (half.gap.distance_mm < kInfinity) open.push(half);
            }
        }
        return gap;
    }

    const Organ& organ_;
    std::span<const Resection> resections_;
    const ResectionSurface& surface_;
    const VoxelSolid& lesion_;
    std::vector<double> distances_; // by vertex
    double nearest_ = kInfinity;
    std::vector<bool> surrounds_; // by resection: no place of its surface is nearer than its vertices
};

} // namespace

std::string_view name_of(Removed removed) {
    constexpr std::array<std::string_view, 3> kNames{"none", "part", "whole"};
    return kNames[static_cast<std::size_t>(removed)];
}

std::vector<Margin> margins_of(const Organ& organ, std::span<const Resection> resections,
                               const ResectionSurface& surface, std::span<const VoxelLesion> lesions) {
    std::vector<Margin> margins(lesions.size());
    tbb::parallel_for(std::size_t{0}, lesions.size(), [&](std::size_t n) {
        margins[n] = MarginSearch(organ, resections, surface, *lesions[n].solid).run();
    });
    return margins;
}

std::vector<float> lesion_distances(const ResectionSurface& surface, std::span<const VoxelLesion> lesions) {
    std::vector<float> distances(surface.places.size());
    tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t n) {
        double least = kInfinity;
        for (const VoxelLesion& lesion : lesions)
            if (distance_to_box(surface.places[n], lesion.solid->to_surface().bounds()) < least)
                least = std::min(least, lesion.solid->distance(surface.places[n]));
        distances[n] = static_cast<float>(least);
    });
    return distances;
}

} // namespace ramus::organ
