#include "core/volume/voxelise.h"

#include "core/base/bounds.h"
#include "core/base/lines.h"
#include "core/base/memory.h"
#include "core/volume/isosurface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::volume {

namespace {

constexpr double kMostVoxelsASide = 768.0;

using Box = Bounds<glm::dvec3>;

Box bounds_of(const tree::VesselTree& tree) {
    Box box;
    for (const tree::Point& point : tree.points) box.hold(point.position, point.radius);
    return tree.points.empty() ? Box{glm::dvec3(0.0), glm::dvec3(0.0)} : box;
}

// A grid of voxels: the centre of the first, and their sizes, in mm.
struct VoxelGrid {
    glm::dvec3 origin, voxel_mm;
};

// Sets the voxels of one segment.
void fill(BitMask& mask, const VoxelGrid& grid, const tree::Point& a, const tree::Point& b, const Job& job) {
    const glm::dvec3 ab = b.position - a.position;
    const glm::ivec3 last = mask.size() - 1;
    Box box;
    for (const tree::Point& end : {a, b}) box.hold(end.position, end.radius);
    const auto cell = [&](const glm::dvec3& at) { return (at - grid.origin) / grid.voxel_mm; };
    const glm::ivec3 from = glm::clamp(glm::ivec3(glm::ceil(cell(box.least))), glm::ivec3(0), last);
    const glm::ivec3 to = glm::clamp(glm::ivec3(glm::floor(cell(box.most))), glm::ivec3(0), last);
    for (int k = from.z; k <= to.z && !job.cancelled(); ++k)
        for (int j = from.y; j <= to.y; ++j)
            for (int i = from.x; i <= to.x; ++i) {
                const glm::dvec3 ap = grid.origin + glm::dvec3(i, j, k) * grid.voxel_mm - a.position;
                const double t = share_along(ap, ab);
                const glm::dvec3 away = ap - t * ab;
                const double radius = a.radius + t * (b.radius - a.radius);
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
    const Box box = bounds_of(tree);
    const glm::dvec3 extent = box.size();
    return std::max(*tenth, std::max({extent.x, extent.y, extent.z}) / kMostVoxelsASide);
}

Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm) {
    Job job;
    return voxelised(tree, voxel_mm, 0.0, job);
}

Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm, double memory_bytes, Job& job) {
    return voxelised(tree, glm::dvec3(voxel_mm), memory_bytes, job);
}

Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, const glm::dvec3& voxel_mm, double memory_bytes,
                                Job& job) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(voxel_mm[axis]) || voxel_mm[axis] <= 0.0)
            return fail("a voxel has no size", {}, "give millimetres, such as 0.5");
    const Box box = bounds_of(tree);
    const glm::dvec3 sides = glm::floor(box.size() / voxel_mm) + 3.0; // with an outside voxel on each side
    const double bytes = sides.x * sides.y * sides.z / 8.0;
    const double most = memory_limit(memory_bytes);
    const std::string least = std::to_string(std::min({voxel_mm.x, voxel_mm.y, voxel_mm.z}));
    if (std::max({sides.x, sides.y, sides.z}) > 30000.0 || bytes > most)
        return fail("voxels of " + least + " mm are too fine for this tree", {},
                    "give a larger size, or more --memory");
    const VoxelGrid grid{0.5 * (box.least + box.most - voxel_mm * (sides - 1.0)), voxel_mm};
    const glm::dmat4 to_patient = glm::scale(glm::translate(glm::dmat4(1.0), grid.origin), voxel_mm);
    if (auto precise = check_mask_precision(glm::ivec3(sides), to_patient); !precise)
        return tl::unexpected(precise.error());
    VoxelisedTree made{BitMask(glm::ivec3(sides)), to_patient};
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i)
            fill(made.mask, grid, tree.points[branch.points[i]], tree.points[branch.points[i + 1]], job);
    if (job.cancelled()) return fail("cancelled");
    if (made.mask.count() == 0)
        return fail("no voxel of " + least + " mm lies within a vessel", {}, "give a smaller size");
    return made;
}

} // namespace ramus::volume
