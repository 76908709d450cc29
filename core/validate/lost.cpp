#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::validate {

namespace {

constexpr double kHalf = 0.5;
constexpr double kShortest = 1.0; // of a stretch, in radii: less is the mesh's coarseness

bool wide_enough(const CrossSection& section, const Place& place) {
    return section.inside && section.radius >= kHalf * std::min(place.radius, place.input_radius);
}

// Whether the vessel is there after all, with its centerline within a radius of `at`. What is found has to be this
// vessel, not one beside it: `vessels` has it at `at`.
bool is_near(const glm::dvec3& at, const NearbyVessels& vessels, const Probe& probe, const Place& place) {
    const glm::dvec3 side = glm::normalize(glm::cross(
        place.direction, std::abs(place.direction.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 other = glm::cross(place.direction, side);
    constexpr int kWays = 8;
    for (const double off : {0.0, 0.5, 1.0})
        for (int way = 0; way < (off > 0.0 ? kWays : 1); ++way) {
            const double angle = 2.0 * std::numbers::pi * way / kWays;
            const glm::dvec3 there = at + off * place.radius * (std::cos(angle) * side + std::sin(angle) * other);
            const CrossSection section = probe.cross_section(there, place.direction, 4.0 * place.radius);
            if (!wide_enough(section, place) || glm::distance(section.middle, at) > 1.5 * place.radius) continue;
            if (vessels.nearest({section.middle, 0.0}, kOwn, {}, 0.0).branch == place.branch) return true;
        }
    return false;
}

// Its centerline in the surface is another one where whoever made the surface smoothed in another way, or not at all.
bool is_aside(const Reference& reference, const Probe& probe, const Place& place) {
    return is_near(place.at, reference.vessels(), probe, place) ||
           is_near(place.input_at, reference.input_vessels(), probe, place);
}

// Within another vessel, where nobody can tell whether this one is there, too.
bool is_covered(const Place& place) { return place.beside < 1.0; }

// Whether all that is so long about `at` lies within the joint's reach.
bool reaches(const MovedJoint& joint, const glm::dvec3& at, double length_mm) {
    return glm::distance(at, joint.at) + 0.5 * length_mm <= joint.reach;
}

} // namespace

std::vector<MovedJoint> moved_joints(const Reference& reference, std::span<const LostStretch> lost) {
    if (lost.empty()) return {};
    const tree::VesselTree& tree = reference.prepared().tree;
    std::vector<double> beside(tree.points.size(), 0.0); // mm from a branch's end to the farthest point next to it
    const auto take = [&](std::uint32_t end, std::uint32_t next) {
        beside[end] = std::max(beside[end], glm::distance(tree.points[end].position, tree.points[next].position));
    };
    for (const tree::Branch& branch : tree.branches) {
        take(branch.points.front(), branch.points[1]);
        take(branch.points.back(), branch.points[branch.points.size() - 2]);
    }
    std::vector<MovedJoint> joints;
    for (std::size_t n = 0; n < lost.size(); ++n) {
        const LostStretch& one = lost[n];
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(one.lost.branch)];
        for (const auto& [point, is_gone] :
             {std::pair{branch.points.front(), one.from <= 0.0},
              std::pair{branch.points.back(), one.to >= tree::length_mm(tree, branch) * (1.0 - 1e-9)}})
            if (is_gone)
                joints.push_back({tree.points[point].position,
                                  beside[point] * reference.smooth_passes() + kOwn * tree.points[point].radius, n});
    }
    return joints;
}

bool is_moved(std::span<const MovedJoint> joints, const glm::dvec3& at, double length_mm) {
    return std::ranges::any_of(joints, [&](const MovedJoint& joint) { return reaches(joint, at, length_mm); });
}

std::vector<LostStretch> lost_stretches(const Reference& reference, const Probe& probe,
                                        std::span<const CrossSection> sections) {
    const std::vector<Place>& places = reference.places();
    std::vector<std::uint8_t> gone(places.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            gone[i] = !wide_enough(sections[i], places[i]) && !is_aside(reference, probe, places[i]) ? 1 : 0;
    });
    std::vector<LostStretch> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const std::size_t begin = reference.first_of(branch), end = begin + reference.places_of(branch).size();
        for (std::size_t i = begin; i < end;) {
            if (gone[i] == 0) {
                ++i;
                continue;
            }
            std::size_t last = i, past = i + 1; // what is covered belongs to the stretch where it goes on behind
            for (; past < end && (gone[past] != 0 || is_covered(places[past])); ++past)
                if (gone[past] != 0) last = past;
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
    // Of stretches at one joint, the longest is what is lost.
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
