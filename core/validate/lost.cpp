#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::validate {

namespace {

constexpr double kHalf = 0.5;
constexpr double kShortest = 1.0; // of a stretch, in radii: less is the mesh's coarseness

bool wide_enough(const CrossSection& section, const Place& place) {
    return section.inside && section.radius >= kHalf * std::min(place.radius, place.input_radius);
}

// Whether the vessel is there after all, a little aside: its centerline in the surface is another one where whoever
// made the surface smoothed in another way. What is found has to be this vessel, not one beside it.
bool is_aside(const Reference& reference, const Probe& probe, const Place& place) {
    const glm::dvec3 side = glm::normalize(glm::cross(
        place.direction, std::abs(place.direction.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 other = glm::cross(place.direction, side);
    constexpr int kWays = 8;
    for (const double off : {0.5, 1.0})
        for (int way = 0; way < kWays; ++way) {
            const double angle = 2.0 * std::numbers::pi * way / kWays;
            const glm::dvec3 at = place.at + off * place.radius * (std::cos(angle) * side + std::sin(angle) * other);
            const CrossSection section = probe.cross_section(at, place.direction, 4.0 * place.radius);
            if (!wide_enough(section, place)) continue;
            const double moved = glm::distance(section.middle, place.at);
            if (moved > 1.5 * place.radius) continue;
            const auto owner = reference.vessels().nearest({section.middle, 0.0}, kOwn, kNoBranches, 0.0);
            if (owner.branch == place.branch) return true;
        }
    return false;
}

} // namespace

std::vector<Lost> lost_stretches(const Reference& reference, const Probe& probe,
                                 std::span<const CrossSection> sections) {
    const std::vector<Place>& places = reference.places();
    std::vector<std::uint8_t> gone(places.size(), 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            gone[i] = !wide_enough(sections[i], places[i]) && !is_aside(reference, probe, places[i]) ? 1 : 0;
    });
    std::vector<Lost> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const std::size_t end = reference.first_of(branch) + reference.places_of(branch).size();
        for (std::size_t i = reference.first_of(branch); i < end;) {
            if (gone[i] == 0) {
                ++i;
                continue;
            }
            const std::size_t first = i;
            double length = 0.0;
            for (; i < end && gone[i] != 0; ++i) length += places[i].step;
            const Place& middle = places[first + (i - first) / 2];
            if (length >= kShortest * middle.radius) found.push_back({static_cast<int>(branch), middle.at, length});
        }
    }
    return found;
}

} // namespace ramus::validate
