#include "render/caster/near_segments.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tuple>

namespace ramus::render::caster {

namespace {

constexpr std::size_t kMostNear = 48; // the others add next to nothing, and take their time

// Segments by the places of their ends.
struct Meetings {
    std::vector<std::uint32_t> first, segments;

    Meetings(std::span<const std::uint32_t> place, std::span<const std::uint32_t> points) : first(place.size() + 1) {
        const auto for_ends = [&](const auto& call) {
            for (std::uint32_t s = 0; s < points.size(); ++s)
                for (const std::uint32_t end : {points[s], points[s] + 1}) call(place[end], s);
        };
        for_ends([&](std::uint32_t at, std::uint32_t) { ++first[at + 1]; });
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        segments.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for_ends([&](std::uint32_t at, std::uint32_t s) { segments[next[at]++] = s; });
    }
    [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t place) const {
        return std::span(segments).subspan(first[place], first[place + 1] - first[place]);
    }
};

float distance_to_segment(glm::vec3 p, glm::vec3 a, glm::vec3 b) {
    const glm::vec3 way = b - a;
    const float squared = glm::dot(way, way);
    const float t = squared > 0.0F ? glm::clamp(glm::dot(p - a, way) / squared, 0.0F, 1.0F) : 0.0F;
    return glm::distance(p, a + t * way);
}

} // namespace

std::vector<std::uint32_t> places_of(const Centerlines& lines) {
    std::vector<std::uint32_t> place(lines.points.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    std::vector<std::uint32_t> ends;
    for (const Centerlines::Run& run : lines.runs) {
        if (run.count == 0) continue;
        ends.push_back(run.first);
        if (run.count > 1) ends.push_back(run.first + run.count - 1);
    }
    const auto key = [&](std::uint32_t i) {
        const glm::vec4& p = lines.points[i];
        return std::tuple(p.x, p.y, p.z, i);
    };
    std::ranges::sort(ends, {}, key);
    for (std::size_t i = 1; i < ends.size(); ++i)
        if (glm::vec3(lines.points[ends[i]]) == glm::vec3(lines.points[ends[i - 1]]))
            place[ends[i]] = place[ends[i - 1]];
    return place;
}

NearSegments find_near_segments(const Centerlines& lines, std::span<const std::uint32_t> place,
                                std::span<const std::uint32_t> points, float support_radii) {
    const Meetings meetings(place, points);
    const auto at = [&](std::uint32_t point) { return glm::vec3(lines.points[point]); };
    const auto radius = [&](std::uint32_t s) {
        return 0.5F * std::max(lines.details[points[s]].diameter_mm, lines.details[points[s] + 1].diameter_mm);
    };
    // Adds what is near a segment to `near`: outward from both ends, as far as anything reaches back.
    const auto add_near = [&](std::uint32_t s, std::vector<std::uint32_t>& near) {
        const auto begin = static_cast<std::ptrdiff_t>(near.size());
        const auto count = [&] { return near.size() - static_cast<std::size_t>(begin); };
        near.push_back(s);
        for (std::size_t next = 0; next < count(); ++next) {
            const std::uint32_t first = points[near[static_cast<std::size_t>(begin) + next]];
            for (const std::uint32_t end : {first, first + 1}) {
                const float away = distance_to_segment(at(end), at(points[s]), at(points[s] + 1));
                for (const std::uint32_t other : meetings.at(place[end])) {
                    if (count() == kMostNear || away > radius(s) + support_radii * radius(other)) continue;
                    if (std::find(near.begin() + begin, near.end(), other) == near.end()) near.push_back(other);
                }
            }
        }
        if (count() % 2 != 0) near.push_back(static_cast<std::uint32_t>(points.size()));
        return static_cast<std::uint32_t>(count());
    };
    NearSegments near;
    near.first.resize(points.size() + 1);
    constexpr std::size_t kChunk = 1024;
    std::vector<std::vector<std::uint32_t>> chunks((points.size() + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        for (std::size_t s = c * kChunk; s < std::min((c + 1) * kChunk, points.size()); ++s)
            near.first[s + 1] = add_near(static_cast<std::uint32_t>(s), chunks[c]);
    });
    for (std::size_t s = 0; s < points.size(); ++s) near.first[s + 1] += near.first[s];
    near.segments.reserve(near.first.back());
    for (const auto& chunk : chunks) near.segments.insert(near.segments.end(), chunk.begin(), chunk.end());
    return near;
}

} // namespace ramus::render::caster
