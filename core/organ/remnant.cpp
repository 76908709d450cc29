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

// Adds voxels [begin, end). share(voxel): how much of the voxel counts.
template <class Number, class Share>
void add(RemnantOf<Number>& remnant, std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
         const Share& share, std::size_t begin, std::size_t end) {
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
        const Number counts = share(voxel);
        if (counts == Number(0)) continue;
        bool supplied = true, drained = true;
        for (std::size_t s = 0; s < systems.size() && !spans.empty(); ++s) {
            if (!is_lost(systems[s], spans, voxel)) continue;
            remnant.lost[s] += counts;
            (systems[s].role == Role::kSupplies ? supplied : drained) = false;
        }
        remnant.supplied += supplied ? counts : Number(0);
        remnant.drained += drained ? counts : Number(0);
        remnant.both += supplied && drained ? counts : Number(0);
    }
}

template <class Number> RemnantOf<Number> sum(RemnantOf<Number> a, const RemnantOf<Number>& b) {
    a.supplied += b.supplied;
    a.drained += b.drained;
    a.both += b.both;
    for (std::size_t s = 0; s < a.lost.size(); ++s) a.lost[s] += b.lost[s];
    return a;
}

template <class Number, class Share>
RemnantOf<Number> remnant_by(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                             const Share& share) {
    RemnantOf<Number> none;
    none.lost.resize(systems.size());
    if (systems.empty()) return none;
    constexpr std::size_t kGrain = 65536; // the same parts for any number of threads, so that sums round alike
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, systems.front().branch.size(), kGrain), none,
        [&](const tbb::blocked_range<std::size_t>& range, RemnantOf<Number> so_far) {
            add(so_far, systems, spans, share, range.begin(), range.end());
            return so_far;
        },
        sum<Number>);
}

} // namespace

Remnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                   std::span<const std::uint8_t> counted) {
    return remnant_by<std::size_t>(systems, spans, [counted](std::size_t voxel) -> std::size_t {
        return counted.empty() || counted[voxel] != 0 ? 1 : 0;
    });
}

PartRemnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                       std::span<const std::uint8_t> counted, std::span<const float> kept) {
    return remnant_by<double>(systems, spans, [counted, kept](std::size_t voxel) {
        return counted.empty() || counted[voxel] != 0 ? static_cast<double>(kept[voxel]) : 0.0;
    });
}

std::vector<std::uint8_t> large_vessels(const Organ& organ, const tree::VesselTree& tree, double least_diameter_mm) {
    std::vector<std::uint8_t> inside(organ.count(), 0);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t n = 1; n < branch.points.size(); ++n) {
            const tree::Point &a = tree.points[branch.points[n - 1]], &b = tree.points[branch.points[n]];
            if (a.radius + b.radius < least_diameter_mm) continue;
            Bounds<glm::dvec3> box;
            for (const tree::Point* point : {&a, &b}) box.hold(point->position, point->radius);
            organ.for_voxels_near(box, [&](const glm::ivec3& voxel, std::size_t number) {
                const glm::dvec3 ap = organ.centre_mm(voxel) - a.position, ab = b.position - a.position;
                const double t = share_along(ap, ab);
                if (glm::length(ap - t * ab) <= glm::mix(a.radius, b.radius, t)) inside[number] = 1;
            });
        }
    return inside;
}

} // namespace ramus::organ
