#include "core/validate/questions.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::validate {

namespace {

constexpr double kShortest = 1.0; // least length of a stretch, in radii: shorter gaps come from coarse triangles

// Whether a place is within another vessel, so that the surface does not show whether this vessel is there.
bool is_covered(const Place& place) { return place.beside < 1.0; }

// Whether an object of this length around `at` lies within the joint's reach.
bool reaches(const MovedJoint& joint, const glm::dvec3& at, double length_mm) {
    return glm::distance(at, joint.at) + 0.5 * length_mm <= joint.reach;
}

} // namespace

std::vector<MovedJoint> moved_joints(const Reference& reference, std::span<const LostStretch> lost) {
    const tree::VesselTree& tree = reference.tree();
    std::vector<MovedJoint> joints;
    for (std::size_t n = 0; n < lost.size(); ++n) {
        const LostStretch& one = lost[n];
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(one.lost.branch)];
        for (const auto& [point, is_gone] :
             {std::pair{branch.points.front(), one.from <= 0.0},
              std::pair{branch.points.back(), one.to >= tree::length_mm(tree, branch) * (1.0 - 1e-9)}})
            if (is_gone)
                joints.push_back(
                    {tree.points[point].position, reference.grain_mm() + kOwn * tree.points[point].radius, n});
    }
    return joints;
}

bool is_moved(std::span<const MovedJoint> joints, const glm::dvec3& at, double length_mm) {
    return std::ranges::any_of(joints, [&](const MovedJoint& joint) { return reaches(joint, at, length_mm); });
}

std::vector<LostStretch> lost_stretches(const Reference& reference, std::span<const Section> sections) {
    const std::vector<Place>& places = reference.places();
    std::vector<LostStretch> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const std::size_t begin = reference.first_of(branch), end = begin + reference.places_of(branch).size();
        for (std::size_t i = begin; i < end;) {
            if (sections[i].found) {
                ++i;
                continue;
            }
            std::size_t last = i, past = i + 1; // covered places belong to the stretch if it continues behind them
            for (; past < end && (!sections[past].found || is_covered(places[past])); ++past)
                if (!sections[past].found) last = past;
            std::size_t before = i;
            while (before > begin && is_covered(places[before - 1])) --before;
            const double from = places[i].along, to = places[last].along + places[last].step;
            const auto middle = std::ranges::lower_bound(places.begin() + static_cast<std::ptrdiff_t>(i),
                                                         places.begin() + static_cast<std::ptrdiff_t>(last),
                                                         0.5 * (from + to), {}, &Place::along);
            if (to - from >= kShortest * middle->radius)
                found.push_back({{static_cast<int>(branch), middle->at, to - from},
                                 places[before].along,
                                 places[past - 1].along + places[past - 1].step});
            i = past;
        }
    }
    // If several stretches meet at a joint, only the longest one is reported.
    const std::vector<MovedJoint> joints = moved_joints(reference, found);
    std::vector<LostStretch> kept;
    for (const LostStretch& one : found) {
        const auto is_of_longer = [&](const MovedJoint& joint) {
            const Lost& other = found[joint.of].lost;
            return other.branch != one.lost.branch && other.length_mm > one.lost.length_mm;
        };
        if (std::ranges::none_of(joints, [&](const MovedJoint& joint) {
                return is_of_longer(joint) && reaches(joint, one.lost.at, one.lost.length_mm);
            }))
            kept.push_back(one);
    }
    return kept;
}

} // namespace ramus::validate
