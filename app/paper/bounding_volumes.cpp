#include "app/paper/bounding_volumes.h"

#include "core/base/lines.h"
#include "core/field/kernels/gaussian.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <tuple>

namespace ramus::app::paper {

namespace {

glm::dvec3 grown_extent(const RoundSegment& segment, double reach) {
    return glm::abs(segment.to - segment.from) + 2.0 * reach;
}

void add_quad(mesh::TriangleMesh& mesh, const std::array<glm::dvec3, 4>& corners,
              const std::array<glm::dvec3, 4>& normals) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.positions.push_back(glm::vec3(corners[i]));
        mesh.normals.push_back(glm::vec3(normals[i]));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(mesh::TriangleMesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<glm::dvec3, 4> corners{};
            glm::dvec3 normal(0.0);
            normal[axis] = side == 1 ? 1.0 : -1.0;
            for (int i = 0; i < 4; ++i) {
                const int n = side == 1 ? i : 3 - i; // counter-clockwise from outside
                glm::dvec3& corner = corners[static_cast<std::size_t>(i)];
                corner[axis] = side == 1 ? high[axis] : low[axis];
                corner[u] = n == 1 || n == 2 ? high[u] : low[u];
                corner[v] = n >= 2 ? high[v] : low[v];
            }
            add_quad(mesh, corners, {normal, normal, normal, normal});
        }
}

// A surface of revolution around a segment: `profile` has the way along it, the distance from it, and the normal.
struct ProfilePoint {
    double along, across, normal_along, normal_across;
};

void add_turned(mesh::TriangleMesh& mesh, const RoundSegment& segment, const std::vector<ProfilePoint>& profile) {
    constexpr int kSides = 64;
    const glm::dvec3 way = glm::normalize(segment.to - segment.from);
    const glm::dvec3 side =
        glm::normalize(glm::cross(way, std::abs(way.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(way, side);
    for (std::size_t i = 1; i < profile.size(); ++i)
        for (int n = 0; n < kSides; ++n) {
            std::array<glm::dvec3, 4> corners{}, normals{};
            for (int c = 0; c < 4; ++c) {
                const ProfilePoint& point = profile[c == 1 || c == 2 ? i : i - 1];
                const double turn = 2.0 * std::numbers::pi * (c >= 2 ? n : n + 1) / kSides;
                const glm::dvec3 out = std::cos(turn) * side + std::sin(turn) * up;
                const auto at = static_cast<std::size_t>(c);
                corners[at] = segment.from + point.along * way + point.across * out;
                normals[at] = point.normal_along * way + point.normal_across * out;
            }
            add_quad(mesh, corners, normals);
        }
}

std::vector<ProfilePoint> cylinder_profile(double length, double reach) {
    return {{-reach, 0.0, -1.0, 0.0},          {-reach, reach, -1.0, 0.0},        {-reach, reach, 0.0, 1.0},
            {length + reach, reach, 0.0, 1.0}, {length + reach, reach, 1.0, 0.0}, {length + reach, 0.0, 1.0, 0.0}};
}

std::vector<ProfilePoint> capsule_profile(double length, double reach) {
    constexpr int kSteps = 24; // of a quarter circle
    std::vector<ProfilePoint> profile;
    for (int n = 0; n <= 2 * kSteps + 1; ++n) {
        const bool behind = n > kSteps;
        const double turn = 0.5 * std::numbers::pi * (behind ? n - 1 : n) / kSteps; // 0: before the first end
        const double along = -std::cos(turn), across = std::sin(turn);
        profile.push_back({(behind ? length : 0.0) + reach * along, reach * across, along, across});
    }
    return profile;
}

} // namespace

const std::array<BoundRow, 3>& bounds_of_segments() {
    static const std::array<BoundRow, 3> rows{
        BoundRow{Bound::kBox, "Boxes", kPaperReach}, BoundRow{Bound::kCylinder, "Cylinders (CBV)", kPaperReach},
        BoundRow{Bound::kSupport, "Support of the fading kernel (ramus)", field::gaussian(5.0).support_radii}};
    return rows;
}

std::vector<RoundSegment> segments_of(const tree::VesselTree& tree) {
    std::vector<RoundSegment> segments;
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const tree::Point& from = tree.points[branch.points[i - 1]];
            segments.push_back({from.position, tree.points[branch.points[i]].position, from.radius});
        }
    return segments;
}

bool covers(const BoundRow& row, const RoundSegment& segment, const glm::dvec3& point) {
    const double reach = row.reach_radii * segment.radius;
    switch (row.bound) {
    case Bound::kBox: {
        const glm::dvec3 off = glm::abs(point - 0.5 * (segment.from + segment.to));
        return glm::all(glm::lessThanEqual(off, 0.5 * grown_extent(segment, reach)));
    }
    case Bound::kCylinder: {
        const double length = glm::distance(segment.from, segment.to);
        const glm::dvec3 way = (segment.to - segment.from) / length, off = point - segment.from;
        const double along = glm::dot(off, way);
        return glm::length(off - along * way) <= reach && along >= -reach && along <= length + reach;
    }
    case Bound::kSupport:
        return distance_to_line(point, segment.from, segment.to) <= reach;
    }
    return false;
}

double volume_mm3(const BoundRow& row, const RoundSegment& segment) {
    const double reach = row.reach_radii * segment.radius, length = glm::distance(segment.from, segment.to);
    const glm::dvec3 extent = grown_extent(segment, reach);
    switch (row.bound) {
    case Bound::kBox:
        return extent.x * extent.y * extent.z;
    case Bound::kCylinder:
        return std::numbers::pi * reach * reach * (length + 2.0 * reach);
    case Bound::kSupport:
        return std::numbers::pi * reach * reach * (length + 4.0 / 3.0 * reach);
    }
    return 0.0;
}

CoveredCells covered_cells(const BoundRow& row, const std::vector<RoundSegment>& segments, double cell_mm) {
    CoveredCells covered;
    std::set<std::tuple<int, int, int>> cells;
    for (const RoundSegment& segment : segments) {
        const double reach = row.reach_radii * segment.radius;
        // The corners of a cylinder reach farther than its radius.
        const glm::dvec3 half = 0.5 * grown_extent(segment, std::sqrt(2.0) * reach),
                         middle = 0.5 * (segment.from + segment.to);
        const glm::ivec3 low(glm::floor((middle - half) / cell_mm)), high(glm::ceil((middle + half) / cell_mm));
        for (int k = low.z; k < high.z; ++k)
            for (int j = low.y; j < high.y; ++j)
                for (int i = low.x; i < high.x; ++i) {
                    if (!covers(row, segment, cell_mm * (glm::dvec3(i, j, k) + 0.5))) continue;
                    ++covered.evaluations;
                    cells.emplace(i, j, k);
                }
    }
    for (const auto& [i, j, k] : cells) covered.cells.emplace_back(i, j, k);
    return covered;
}

mesh::TriangleMesh shape_of(const BoundRow& row, const RoundSegment& segment) {
    mesh::TriangleMesh mesh;
    const double reach = row.reach_radii * segment.radius, length = glm::distance(segment.from, segment.to);
    const glm::dvec3 half = 0.5 * grown_extent(segment, reach), middle = 0.5 * (segment.from + segment.to);
    if (row.bound == Bound::kBox)
        add_box(mesh, middle - half, middle + half);
    else
        add_turned(mesh, segment,
                   row.bound == Bound::kCylinder ? cylinder_profile(length, reach) : capsule_profile(length, reach));
    return mesh;
}

mesh::TriangleMesh cubes_of(const std::vector<glm::ivec3>& cells, double cell_mm) {
    constexpr double kGap = 0.06; // of a cell, on each side
    mesh::TriangleMesh mesh;
    for (const glm::ivec3& cell : cells)
        add_box(mesh, cell_mm * (glm::dvec3(cell) + kGap), cell_mm * (glm::dvec3(cell) + 1.0 - kGap));
    return mesh;
}

} // namespace ramus::app::paper
