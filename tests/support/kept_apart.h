// The segments of a prepared tree that are kept apart from others, and which places that can concern.
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace ramus::test {

struct KeptApart {
    glm::dvec3 start{0.0}, end{0.0};
    double start_radius = 0.0, end_radius = 0.0;
    std::uint32_t piece = 0;
    int branch = 0; // in the file's tree

    struct Near {
        double distance, radius; // mm: of the axis, and at the foot there
    };
    [[nodiscard]] Near near(const glm::dvec3& p) const {
        const glm::dvec3 line = end - start;
        const double share = glm::clamp(glm::dot(p - start, line) / glm::dot(line, line), 0.0, 1.0);
        return {glm::distance(p, start + share * line), glm::mix(start_radius, end_radius, share)};
    }
};

// With partners of contacts, and of near misses too where they are asked for.
[[nodiscard]] inline std::vector<KeptApart> kept_apart(const tree::PreparedTree& prepared,
                                                       const tree::Contacts& contacts, bool near_misses) {
    std::vector<KeptApart> all;
    std::size_t segment = 0;
    for (const tree::Branch& branch : prepared.tree.branches) {
        for (std::size_t n = 1; n < branch.points.size(); ++n, ++segment) {
            if (contacts.piece_of_segment.empty()) continue;
            const std::size_t index = prepared.segment_index.empty() ? segment : prepared.segment_index[segment];
            const std::uint32_t piece = contacts.piece_of_segment[index];
            const auto counts = [&](const tree::Contacts::Partner& p) { return near_misses || p.apart_from > 0.0F; };
            if (std::ranges::none_of(contacts.partners_of(piece), counts)) continue;
            const tree::Point& a = prepared.tree.points[branch.points[n - 1]];
            const tree::Point& b = prepared.tree.points[branch.points[n]];
            all.push_back({a.position, b.position, a.radius, b.radius, piece, prepared.segment_source[segment]});
        }
    }
    return all;
}

// Finds places that contacts can concern: both axes of a pair that is kept apart are within `reach` times the larger
// radius of the two. A grid of cubes holds the segments near each cube. Keeps references to its arguments.
class Concern {
public:
    Concern(const std::vector<KeptApart>& all, const tree::Contacts& contacts, double reach)
        : all_(all), contacts_(contacts), reach_(reach) {
        double thickest = 0.0;
        for (const KeptApart& segment : all) thickest = std::max({thickest, segment.start_radius, segment.end_radius});
        farthest_ = reach * thickest;
        for (std::uint32_t n = 0; n < all.size(); ++n) {
            const Cube lower = cube_at(glm::min(all[n].start, all[n].end) - farthest_);
            const Cube upper = cube_at(glm::max(all[n].start, all[n].end) + farthest_);
            for (int x = lower[0]; x <= upper[0]; ++x)
                for (int y = lower[1]; y <= upper[1]; ++y)
                    for (int z = lower[2]; z <= upper[2]; ++z) near_[{x, y, z}].push_back(n);
        }
    }

    [[nodiscard]] bool at(const glm::dvec3& place) const {
        const auto cube = near_.find(cube_at(place));
        if (cube == near_.end()) return false;
        std::vector<std::pair<std::uint32_t, KeptApart::Near>> near; // by piece
        for (const std::uint32_t n : cube->second)
            if (const auto found = all_[n].near(place); found.distance <= farthest_)
                near.emplace_back(all_[n].piece, found);
        for (const auto& [piece, own] : near)
            for (const auto& partner : contacts_.partners_of(piece))
                for (const auto& [other, its] : near)
                    if (other == partner.piece &&
                        std::max(own.distance, its.distance) <= reach_ * std::max(own.radius, its.radius))
                        return true;
        return false;
    }

private:
    using Cube = std::array<int, 3>;
    [[nodiscard]] Cube cube_at(const glm::dvec3& place) const {
        const glm::dvec3 at = glm::floor(place / farthest_);
        return {static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)};
    }

    const std::vector<KeptApart>& all_;
    const tree::Contacts& contacts_;
    double reach_, farthest_ = 0.0;                   // the second in mm, the side of a cube too
    std::map<Cube, std::vector<std::uint32_t>> near_; // segments by cube
};

} // namespace ramus::test
