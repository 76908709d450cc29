// Builds cones from centerlines, and finds which vessels continue into which.
#include "render/caster/fitted_cones.h"

#include "core/base/grouped.h"
#include "core/base/lines.h"
#include "core/field/kernels/gaussian.h"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tbb/parallel_for.h>
#include <tuple>
#include <utility>

namespace ramus::render::caster {

namespace {

constexpr std::size_t kMaxNeighbours = 48; // further ones contribute next to nothing, and cost time

constexpr double kThinnedShare = 5e-5; // of the tree's extent: a twentieth of a pixel if it fills the window

// Adds a point before each free end with room for it, because the surface becomes thinner there. In radii: the distance
// at which it is as wide as the vessel, to 0.3 % at width 5.
constexpr float kBeforeEnd = 0.8F;
Centerlines with_ends(const Centerlines& lines) {
    const std::vector<std::uint32_t> coincident = coincident_points(lines);
    std::vector<int> ends(coincident.size(), 0); // number of ends of branches, by point
    for (const Centerlines::Run& run : lines.runs)
        if (run.count > 1) ++ends[coincident[run.first]], ++ends[coincident[run.first + run.count - 1]];
    Centerlines more;
    more.origin = lines.origin;
    const auto keep = [&](const glm::vec4& point, const Centerlines::Detail& detail) {
        more.points.push_back(point);
        more.details.push_back(detail);
    };
    const auto keep_before = [&](std::uint32_t end, std::uint32_t inward) {
        const glm::vec4 &a = lines.points[end], &b = lines.points[inward];
        const Centerlines::Detail& detail = lines.details[end];
        const float before = 0.5F * kBeforeEnd * detail.diameter_mm;
        const float whole = glm::distance(glm::vec3(a), glm::vec3(b));
        if (ends[coincident[end]] > 1 || whole < 1.8F * before) return;
        const float t = before / whole;
        keep(glm::mix(a, b, t), {glm::mix(detail.diameter_mm, lines.details[inward].diameter_mm, t), detail.branch});
    };
    for (const Centerlines::Run& run : lines.runs) {
        const auto first = static_cast<std::uint32_t>(more.points.size());
        const std::uint32_t last = run.first + run.count - 1;
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            if (i == last && i > run.first) keep_before(i, i - 1);
            keep(lines.points[i], lines.details[i]);
            if (i == run.first && i < last) keep_before(i, i + 1);
        }
        more.runs.push_back({first, static_cast<std::uint32_t>(more.points.size()) - first});
    }
    return more;
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
    const Grouped<std::uint32_t> segments_at(coincident.size(), [&](const auto& put) { // segments by their ends
        for (std::uint32_t s = 0; s < points.size(); ++s)
            for (const std::uint32_t end : {points[s], points[s] + 1}) put(coincident[end], s);
    });
    const auto at = [&](std::uint32_t point) { return glm::vec3(lines.points[point]); };
    const auto radius = [&](std::uint32_t s) {
        return 0.5F * std::max(lines.details[points[s]].diameter_mm, lines.details[points[s] + 1].diameter_mm);
    };
    // Adds the neighbours of a segment to `found`, searching outward from both ends as far as kernels reach back.
    const auto add_neighbours = [&](std::uint32_t s, std::vector<std::uint32_t>& found) {
        const auto begin = static_cast<std::ptrdiff_t>(found.size());
        const auto count = [&] { return found.size() - static_cast<std::size_t>(begin); };
        found.push_back(s);
        for (std::size_t next = 0; next < count(); ++next) {
            const std::uint32_t first = points[found[static_cast<std::size_t>(begin) + next]];
            for (const std::uint32_t end : {first, first + 1}) {
                const float away = distance_to_line(at(end), at(points[s]), at(points[s] + 1));
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

// Connected branches have an end at the same position. The two widest continue into each other unless they turn back;
// the others join them.
void find_joints(FittedCones& cones, std::span<const std::uint32_t> coincident) {
    using Segment = FittedCones::Segment;
    const Centerlines& thinned = cones.thinned;
    struct End {
        std::uint32_t* beyond;       // output
        std::uint32_t joint, inward; // points
    };
    std::map<std::uint32_t, std::vector<End>> joints;
    const auto add = [&](std::uint32_t& beyond, std::uint32_t joint, std::uint32_t inward) {
        if (beyond == Segment::kFree) joints[coincident[joint]].push_back({&beyond, joint, inward});
    };
    for (Segment& segment : cones.segments) {
        add(segment.previous, segment.point, segment.point + 1);
        add(segment.next, segment.point + 1, segment.point);
    }
    for (auto& [at, ends] : joints) {
        if (ends.size() < 2) continue;
        std::ranges::stable_sort(ends, std::greater<>(), [&](const End& end) {
            return thinned.details[end.joint].diameter_mm + thinned.details[end.inward].diameter_mm;
        });
        for (const End& end : ends) *end.beyond = Segment::kJoins;
        const auto inward = [&](const End& end) {
            return glm::vec3(thinned.points[end.inward]) - glm::vec3(thinned.points[end.joint]);
        };
        if (glm::dot(inward(ends[0]), inward(ends[1])) >= 0.0F) continue;
        *ends[0].beyond = ends[1].inward;
        *ends[1].beyond = ends[0].inward;
    }
}

std::shared_ptr<const FittedCones> fitted_cones(std::shared_ptr<const Centerlines> lines, float width,
                                                float beyond_ends) {
    using Segment = FittedCones::Segment;
    auto made = std::make_shared<FittedCones>();
    FittedCones& cones = *made;
    cones.lines = std::move(lines);
    cones.width = width;
    cones.beyond_ends = beyond_ends;
    if (!cones.lines || cones.lines->points.empty()) return made;
    cones.thinned = cones.lines->thinned(kThinnedShare * cones.lines->extent_mm());
    if (width > 0.0F) cones.thinned = with_ends(cones.thinned);
    const Centerlines& thinned = cones.thinned;
    const std::vector<std::uint32_t> coincident = coincident_points(thinned);
    cones.on_line = thinned.points;
    for (glm::vec4& point : cones.on_line) point.w = 0.0F;
    for (std::size_t branch = 0; branch < thinned.runs.size(); ++branch) {
        const Centerlines::Run run = thinned.runs[branch];
        for (std::uint32_t i = run.first; i + 1 < run.first + run.count; ++i) {
            const bool first = i == run.first, last = i + 2 == run.first + run.count;
            cones.segments.push_back(
                {i, static_cast<std::int32_t>(branch), first ? Segment::kFree : i - 1, last ? Segment::kFree : i + 2});
        }
    }
    cones.segment_branches.assign(cones.segments.size() + 1, 0);
    std::ranges::transform(cones.segments, cones.segment_branches.begin(),
                           [](const Segment& segment) { return static_cast<std::uint32_t>(segment.branch); });
    find_joints(cones, coincident);
    // The vessels of larger trees are thinner than pixels, and their look during the short wait does not matter.
    constexpr std::size_t kMostSegments = 250'000;
    cones.neighbours_width = cones.segments.size() > kMostSegments ? 0.0F : width;
    if (cones.neighbours_width > 0.0F) {
        std::vector<std::uint32_t> points(cones.segments.size());
        std::ranges::transform(cones.segments, points.begin(), &Segment::point);
        const double reach = field::gaussian(cones.neighbours_width).support_radii;
        cones.neighbours = find_neighbours(thinned, coincident, points, static_cast<float>(reach));
    }
    fit_balls(cones);
    return made;
}

} // namespace ramus::render::caster
