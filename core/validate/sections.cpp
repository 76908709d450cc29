#include "core/validate/sections.h"

#include "core/base/across.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <optional>

namespace ramus::validate {

namespace {

constexpr double kReach = 4.0; // length of the rays, in radii
constexpr double kHalf = 0.5;

bool wide_enough(const CrossSection& section, const Place& place) {
    return section.inside && section.radius >= kHalf * place.radius;
}

// Searches around a place for the nearest cross-section that belongs to its vessel and not to another one.
std::optional<CrossSection> aside(const Reference& reference, const Probe& probe, const Place& place) {
    const auto [side, other] = axes_across(place.direction);
    constexpr int kWays = 8;
    std::optional<CrossSection> nearest;
    double least = kAside * place.radius;
    for (const double off : {0.0, 0.5, 1.0})
        for (int way = 0; way < (off > 0.0 ? kWays : 1); ++way) {
            const double angle = 2.0 * std::numbers::pi * way / kWays;
            const glm::dvec3 there = place.at + off * place.radius * (std::cos(angle) * side + std::sin(angle) * other);
            const CrossSection section = probe.cross_section(there, place.direction, kReach * place.radius);
            const double away = glm::distance(section.middle, place.at);
            if (!wide_enough(section, place) || away > least) continue;
            if (reference.vessels().nearest({section.middle, 0.0}, kOwn, {}, 0.0).branch != place.branch) continue;
            nearest = section;
            least = away;
        }
    return nearest;
}

// Calls work(i) for `count` places, in chunks, so that the job can be cancelled and reports progress.
template <class Work> void for_places(std::size_t count, const JobRange& job, const Work& work) {
    constexpr std::size_t kStretch = 1U << 13U;
    for (std::size_t first = 0; first < count && !job.cancelled(); first += kStretch) {
        const std::size_t end = std::min(first + kStretch, count);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, 64), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
        });
        job.report(static_cast<float>(end) / static_cast<float>(count));
    }
}

} // namespace

std::vector<CrossSection> cross_sections(const std::vector<Place>& places, const Probe& probe, const JobRange& job) {
    std::vector<double> widest; // of each branch
    for (const Place& place : places) {
        const auto branch = static_cast<std::size_t>(place.branch);
        if (widest.size() <= branch) widest.resize(branch + 1, 0.0);
        widest[branch] = std::max(widest[branch], place.radius);
    }
    std::vector<CrossSection> sections(places.size());
    for_places(places.size(), job, [&](std::size_t i) {
        sections[i] = probe.cross_section(
            places[i].at, places[i].direction,
            std::max(kReach * places[i].radius, 2.0 * widest[static_cast<std::size_t>(places[i].branch)]));
    });
    return sections;
}

std::vector<Section> sections_of(const Reference& reference, const Probe& probe, const JobRange& job) {
    const std::vector<Place>& places = reference.places();
    const std::vector<CrossSection> through = cross_sections(places, probe, job.part(0.0F, 0.8F));
    std::vector<Section> sections(places.size());
    for_places(places.size(), job.part(0.8F, 1.0F), [&](std::size_t i) {
        Section& section = sections[i];
        section.through = section.vessel = through[i];
        section.found = wide_enough(through[i], places[i]);
        if (section.found) return;
        if (const auto vessel = aside(reference, probe, places[i])) section.vessel = *vessel, section.found = true;
    });
    return sections;
}

glm::dvec3 offset_of(const Section& section, const Place& place) {
    const glm::dvec3 way = section.vessel.middle - place.at;
    return way - glm::dot(way, place.direction) * place.direction;
}

} // namespace ramus::validate
