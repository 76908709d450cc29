#include "core/volume/voxelise.h"

#include "core/base/memory.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::volume {

namespace {

constexpr double kMostVoxelsASide = 768.0;

struct Bounds {
    glm::dvec3 lower{0.0}, upper{0.0};
};

Bounds bounds_of(const tree::VesselTree& tree) {
    Bounds box{glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (const tree::Point& point : tree.points) {
        box.lower = glm::min(box.lower, point.position - point.radius);
        box.upper = glm::max(box.upper, point.position + point.radius);
    }
    return tree.points.empty() ? Bounds{} : box;
}

// Sets the voxels of one segment; places in voxels.
void fill(BitMask& mask, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb) {
    const glm::dvec3 ab = b - a;
    const double squared = glm::dot(ab, ab);
    const glm::ivec3 last = mask.size() - 1;
    const glm::ivec3 from = glm::clamp(glm::ivec3(glm::ceil(glm::min(a - ra, b - rb))), glm::ivec3(0), last);
    const glm::ivec3 to = glm::clamp(glm::ivec3(glm::floor(glm::max(a + ra, b + rb))), glm::ivec3(0), last);
    for (int k = from.z; k <= to.z; ++k)
        for (int j = from.y; j <= to.y; ++j)
            for (int i = from.x; i <= to.x; ++i) {
                const glm::dvec3 ap = glm::dvec3(i, j, k) - a;
                const double t = squared > 0.0 ? std::clamp(glm::dot(ap, ab) / squared, 0.0, 1.0) : 0.0;
                const glm::dvec3 away = ap - t * ab;
                const double radius = ra + t * (rb - ra);
                if (glm::dot(away, away) <= radius * radius) mask.set({i, j, k});
            }
}

} // namespace

double sensible_voxel_mm(const tree::VesselTree& tree) {
    std::vector<double> radii;
    for (const tree::Point& point : tree.points) radii.push_back(point.radius);
    if (radii.empty()) return 1.0;
    const auto tenth = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 10);
    std::ranges::nth_element(radii, tenth);
    const Bounds box = bounds_of(tree);
    const glm::dvec3 extent = box.upper - box.lower;
    return std::max(*tenth, std::max({extent.x, extent.y, extent.z}) / kMostVoxelsASide);
}

Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm, double memory_bytes) {
    if (!std::isfinite(voxel_mm) || voxel_mm <= 0.0)
        return fail("a voxel has no size", {}, "give millimetres, such as 0.5");
    const Bounds box = bounds_of(tree);
    const glm::dvec3 sides = glm::floor((box.upper - box.lower) / voxel_mm) + 3.0; // one of outside all around
    const double bytes = sides.x * sides.y * sides.z / 8.0;
    const double most = memory_limit(memory_bytes);
    if (std::max({sides.x, sides.y, sides.z}) > 30000.0 || bytes > most)
        return fail("voxels of " + std::to_string(voxel_mm) + " mm are too fine for this tree", {},
                    "give a larger size, or more --memory");
    const glm::dvec3 origin = 0.5 * (box.lower + box.upper - voxel_mm * (sides - 1.0)); // of voxel 0, 0, 0
    VoxelisedTree made{BitMask(glm::ivec3(sides)),
                       glm::scale(glm::translate(glm::dmat4(1.0), origin), glm::dvec3(voxel_mm))};
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i) {
            const tree::Point &a = tree.points[branch.points[i]], &b = tree.points[branch.points[i + 1]];
            fill(made.mask, (a.position - origin) / voxel_mm, (b.position - origin) / voxel_mm, a.radius / voxel_mm,
                 b.radius / voxel_mm);
        }
    if (made.mask.count() == 0)
        return fail("no voxel of " + std::to_string(voxel_mm) + " mm lies within a vessel", {}, "give a smaller size");
    return made;
}

} // namespace ramus::volume
