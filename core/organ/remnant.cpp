#include "core/organ/remnant.h"

#include "core/base/bounds.h"
#include "core/base/lines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

namespace ramus::organ {

namespace {

// Adds voxels [begin, end).
void add(Remnant& remnant, std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
         std::span<const std::uint8_t> counted, std::size_t begin, std::size_t end) {
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
        if (!counted.empty() && counted[voxel] == 0) continue;
        bool supplied = true, drained = true;
        for (std::size_t s = 0; s < systems.size() && !spans.empty(); ++s) {
            const SystemSupply& system = systems[s];
            const measure::LostSpan& span = spans[static_cast<std::size_t>(system.branch[voxel])];
            const auto at = static_cast<double>(system.at[voxel]);
            if (!span.any() || at < span.from || at > span.to) continue;
            ++remnant.lost[s];
            (system.role == Role::kSupplies ? supplied : drained) = false;
        }
        remnant.supplied += supplied ? 1 : 0;
        remnant.drained += drained ? 1 : 0;
        remnant.both += supplied && drained ? 1 : 0;
    }
}

Remnant sum(Remnant a, const Remnant& b) {
    a.supplied += b.supplied;
    a.drained += b.drained;
    a.both += b.both;
    for (std::size_t s = 0; s < a.lost.size(); ++s) a.lost[s] += b.lost[s];
    return a;
}

} // namespace

Remnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                   std::span<const std::uint8_t> counted) {
    Remnant none;
    none.lost.resize(systems.size());
    if (systems.empty()) return none;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, systems.front().branch.size()), none,
        [&](const tbb::blocked_range<std::size_t>& range, Remnant so_far) {
            add(so_far, systems, spans, counted, range.begin(), range.end());
            return so_far;
        },
        sum);
}

std::vector<std::uint8_t> large_vessels(const Organ& organ, const tree::VesselTree& tree, double least_diameter_mm) {
    std::vector<std::uint8_t> inside(organ.count(), 0);
    const glm::dmat4 to_voxels = glm::inverse(organ.to_patient());
    // How far a ball of radius 1 mm reaches along each voxel axis.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(to_voxels));
    const glm::dvec3 reach(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    const auto voxel_of = [&](const glm::dvec3& at) { return glm::dvec3(to_voxels * glm::dvec4(at, 1.0)); };
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n) {
            const tree::Point &a = tree.points[branch.points[n - 1]], &b = tree.points[branch.points[n]];
            if (a.radius + b.radius < least_diameter_mm) continue;
            Bounds<glm::dvec3> box;
            for (const tree::Point* point : {&a, &b}) {
                box.hold(voxel_of(point->position) - reach * point->radius);
                box.hold(voxel_of(point->position) + reach * point->radius);
            }
            const glm::ivec3 from = glm::clamp(glm::ivec3(glm::ceil(box.least)), glm::ivec3(0), organ.size());
            const glm::ivec3 to = glm::clamp(glm::ivec3(glm::floor(box.most)) + 1, glm::ivec3(0), organ.size());
            organ.for_voxels(from, to, [&](const glm::ivec3& voxel, std::size_t number) {
                const glm::dvec3 ap = organ.centre_mm(voxel) - a.position, ab = b.position - a.position;
                const double t = share_along(ap, ab);
                if (glm::length(ap - t * ab) <= glm::mix(a.radius, b.radius, t)) inside[number] = 1;
            });
        }
    return inside;
}

} // namespace ramus::organ
