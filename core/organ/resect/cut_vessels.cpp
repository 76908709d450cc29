#include "core/organ/resect/cut_vessels.h"

#include "core/base/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <tuple>

namespace ramus::organ {

namespace {

// Whether the centre of an organ voxel is within `reach` (mm) of a point.
bool voxel_within(const Organ& organ, const glm::dmat4& to_voxels, const glm::dvec3& p, double reach) {
    const glm::dmat3 rows = glm::transpose(glm::dmat3(to_voxels));
    const glm::dvec3 index(to_voxels * glm::dvec4(p, 1.0));
    const glm::dvec3 half = reach * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    const glm::dvec3 size(organ.size());
    const glm::ivec3 from(glm::clamp(glm::ceil(index - half), glm::dvec3(0.0), size));
    const glm::ivec3 to(glm::clamp(glm::floor(index + half) + 1.0, glm::dvec3(0.0), size));
    bool found = false;
    organ.for_voxels(from, to, [&](const glm::ivec3& voxel, std::size_t) {
        found = found || glm::distance(organ.centre_mm(voxel), p) <= reach;
    });
    return found;
}

// Adds where a branch passes the surface of a resection, unless another resection removes the place.
void add_of_branch(const tree::VesselTree& tree, int id, std::span<const Resection> resections, std::size_t resection,
                   std::vector<CutVessel>& found) {
    const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
    const Resection& one = resections[resection];
    const double whole = tree::length_mm(tree, branch);
    double behind = 0.0;
    for (std::size_t n = 1; n < branch.points.size(); ++n) {
        const tree::Point &a = tree.points[branch.points[n - 1]], &b = tree.points[branch.points[n]];
        const double length = glm::distance(a.position, b.position);
        const double steepest = steepest_in(one, box_of_points(std::array{a.position, b.position}));
        for (const double t : crossings_of(one, a.position, b.position, steepest)) {
            CutVessel vessel;
            vessel.at = glm::mix(a.position, b.position, t);
            bool inside = false; // of what another resection removes
            for (std::size_t other = 0; other < resections.size() && !inside; ++other) {
                constexpr double kSame = 1e-9; // mm; where two surfaces coincide, the first counts
                inside = other != resection &&
                         value_at(resections[other], vessel.at) <= (other > resection ? -kSame : kSame);
            }
            if (inside) continue;
            vessel.place = {id, whole > 0.0 ? std::min(1.0, (behind + t * length) / whole) : 0.0};
            vessel.resection = resection;
            vessel.diameter_mm = 2.0 * std::lerp(a.radius, b.radius, t);
            const double across = std::abs(glm::dot((b.position - a.position) / length, normal_at(one, vessel.at)));
            vessel.angle_deg = glm::degrees(std::asin(std::min(1.0, across)));
            found.push_back(vessel);
        }
        behind += length;
    }
}

bool spares(const Resection& resection, std::size_t branch) {
    const auto* around = std::get_if<Around>(&resection);
    return around != nullptr && around->spared != nullptr && (*around->spared)[branch] != 0;
}

} // namespace

std::vector<std::uint8_t> spared_by(const tree::VesselTree& tree, std::span<const measure::Cut> cuts) {
    std::vector<std::uint8_t> spared(tree.branches.size(), 0);
    const std::vector<measure::LostSpan> spans = measure::lost_spans(tree, cuts);
    for (std::size_t id = 0; id < spans.size(); ++id) spared[id] = spans[id].any() ? 1 : 0;
    for (const measure::Cut& cut : cuts)
        for (int id = cut.first; id != tree::kNoBranch; id = tree.branches[static_cast<std::size_t>(id)].parent)
            spared[static_cast<std::size_t>(id)] = 1;
    return spared;
}

CutVessel vessel_at(const tree::VesselTree& tree, const measure::Cut& cut) {
    const measure::BranchPoint point = measure::point_on(tree, cut.first, cut.second);
    CutVessel vessel;
    vessel.place = {cut.first, cut.second};
    vessel.at = point.position;
    vessel.diameter_mm = 2.0 * point.radius_mm;
    vessel.angle_deg = 90.0;
    vessel.in_organ = true;
    return vessel;
}

void sort_vessels(std::vector<CutVessel>& vessels) {
    std::ranges::stable_sort(vessels, [](const CutVessel& a, const CutVessel& b) {
        return std::tuple(-a.diameter_mm, a.place.branch, a.place.fraction) <
               std::tuple(-b.diameter_mm, b.place.branch, b.place.fraction);
    });
}

std::vector<CutVessel> vessels_cut(const Organ& organ, const tree::VesselTree& tree,
                                   std::span<const Resection> resections) {
    const glm::dmat4 to_voxels = glm::inverse(organ.to_patient());
    const double diagonal = glm::length(volume::spacing_mm(organ.to_patient()));
    std::vector<std::vector<CutVessel>> by_branch(tree.branches.size());
    tbb::parallel_for(std::size_t{0}, by_branch.size(), [&](std::size_t id) {
        for (std::size_t n = 0; n < resections.size(); ++n)
            if (!spares(resections[n], id)) add_of_branch(tree, static_cast<int>(id), resections, n, by_branch[id]);
        for (CutVessel& vessel : by_branch[id])
            vessel.in_organ = voxel_within(organ, to_voxels, vessel.at, 0.5 * vessel.diameter_mm + diagonal);
    });
    std::vector<CutVessel> all;
    for (const std::vector<CutVessel>& some : by_branch) all.insert(all.end(), some.begin(), some.end());
    sort_vessels(all);
    return all;
}

std::vector<measure::Cut> cuts_of(std::span<const CutVessel> vessels) {
    std::vector<measure::Cut> cuts;
    for (const CutVessel& vessel : vessels)
        if (vessel.in_organ) cuts.emplace_back(vessel.place.branch, vessel.place.fraction);
    return cuts;
}

} // namespace ramus::organ
