#include "render/caster/neighbours.h"

#include "core/base/grouped.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tbb/parallel_for.h>
#include <tuple>

namespace ramus::render::caster {

namespace {

constexpr std::size_t kMaxNeighbours = 48; // the others add next to nothing, and take their time

float distance_to_segment(glm::vec3 p, glm::vec3 a, glm::vec3 b) {
    const glm::vec3 axis = b - a;
    const float squared = glm::dot(axis, axis);
    const float t = squared > 0.0F ? glm::clamp(glm::dot(p - a, axis) / squared, 0.0F, 1.0F) : 0.0F;
    return glm::distance(p, a + t * axis);
}

} // namespace

std::vector<std::uint32_t> coincident_points(const Centerlines& lines) {
    std::vector<std::uint32_t> first(lines.points.size());
    std::iota(first.begin(), first.end(), 0U);
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
            first[ends[i]] = first[ends[i - 1]];
    return first;
}

Neighbours find_neighbours(const Centerlines& lines, std::span<const std::uint32_t> coincident,
                           std::span<const std::uint32_t> points, float support_radii) {
    const Grouped<std::uint32_t> segments_at(coincident.size(), [&](const auto& put) { // by their ends
        for (std::uint32_t s = 0; s < points.size(); ++s)
            for (const std::uint32_t end : {points[s], points[s] + 1}) put(coincident[end], s);
    });
    const auto at = [&](std::uint32_t point) { return glm::vec3(lines.points[point]); };
    const auto radius = [&](std::uint32_t s) {
        return 0.5F * std::max(lines.details[points[s]].diameter_mm, lines.details[points[s] + 1].diameter_mm);
    };
    // Adds the neighbours of a segment to `found`: outward from both ends, as far as anything reaches back.
    const auto add_neighbours = [&](std::uint32_t s, std::vector<std::uint32_t>& found) {
        const auto begin = static_cast<std::ptrdiff_t>(found.size());
        const auto count = [&] { return found.size() - static_cast<std::size_t>(begin); };
        found.push_back(s);
        for (std::size_t next = 0; next < count(); ++next) {
            const std::uint32_t first = points[found[static_cast<std::size_t>(begin) + next]];
            for (const std::uint32_t end : {first, first + 1}) {
                const float away = distance_to_segment(at(end), at(points[s]), at(points[s] + 1));
                for (const std::uint32_t other : segments_at.of(coincident[end])) {
                    if (count() == kMaxNeighbours || away > radius(s) + support_radii * radius(other)) continue;
                    if (std::find(found.begin() + begin, found.end(), other) == found.end()) found.push_back(other);
                }
            }
        }
        if (count() % 2 != 0) found.push_back(static_cast<std::uint32_t>(points.size()));
        return static_cast<std::uint32_t>(count());
    };
    Neighbours neighbours;
    neighbours.first.resize(points.size() + 1);
    constexpr std::size_t kChunk = 1024;
    std::vector<std::vector<std::uint32_t>> chunks((points.size() + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        for (std::size_t s = c * kChunk; s < std::min((c + 1) * kChunk, points.size()); ++s)
            neighbours.first[s + 1] = add_neighbours(static_cast<std::uint32_t>(s), chunks[c]);
    });
    for (std::size_t s = 0; s < points.size(); ++s) neighbours.first[s + 1] += neighbours.first[s];
    neighbours.segments.reserve(neighbours.first.back());
    for (const auto& chunk : chunks) neighbours.segments.insert(neighbours.segments.end(), chunk.begin(), chunk.end());
    return neighbours;
}

} // namespace ramus::render::caster
