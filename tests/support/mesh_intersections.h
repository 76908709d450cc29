// The pairs of triangles of a mesh that intersect beyond the corners that they share (exact_triangles.h), found with a
// tree of boxes, in threads.
#pragma once

#include "core/base/lists_by_thread.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/exact_triangles.h"
#include "core/mesh/untangle/intersecting_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <utility>
#include <vector>

namespace ramus::test {

struct Box {
    glm::vec3 lower{std::numeric_limits<float>::max()}, upper{std::numeric_limits<float>::lowest()};
    void add(const Box& more) { lower = glm::min(lower, more.lower), upper = glm::max(upper, more.upper); }
    [[nodiscard]] bool meets(const Box& other) const {
        return lower.x <= other.upper.x && other.lower.x <= upper.x && lower.y <= other.upper.y &&
               other.lower.y <= upper.y && lower.z <= other.upper.z && other.lower.z <= upper.z;
    }
};

// Boxes around a mesh's triangles, in groups along a curve that fills space, and around ever more of these groups.
class BoxTree {
public:
    explicit BoxTree(const mesh::TriangleMesh& mesh) {
        const std::size_t count = mesh.triangles.size();
        Box all;
        boxes_.resize(count);
        for (std::size_t n = 0; n < count; ++n) {
            Box& box = boxes_[n];
            for (int i = 0; i < 3; ++i) {
                const glm::vec3& p = mesh.positions[mesh.triangles[n][i]];
                box.add({p, p});
            }
            all.add(box);
        }
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order(count);
        const glm::vec3 size = glm::max(all.upper - all.lower, glm::vec3(1e-30F));
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
            const glm::vec3 middle = 0.5F * (boxes_[n].lower + boxes_[n].upper);
            order[n] = {place_on_curve((middle - all.lower) / size), static_cast<std::uint32_t>(n)};
        });
        tbb::parallel_sort(order);
        triangles_.resize(count);
        for (std::size_t n = 0; n < count; ++n) triangles_[n] = order[n].second;
        while ((std::size_t{kGroup} << levels_) < count) ++levels_;
        nodes_.resize(std::size_t{2} << levels_);
        for (std::size_t n = 0; n < count; ++n)
            nodes_[(std::size_t{1} << levels_) + n / kGroup].add(boxes_[triangles_[n]]);
        for (std::size_t n = (std::size_t{1} << levels_) - 1; n > 0; --n)
            nodes_[n].add(nodes_[2 * n]), nodes_[n].add(nodes_[2 * n + 1]);
    }
    [[nodiscard]] const Box& box(std::uint32_t triangle) const { return boxes_[triangle]; }

    // Calls call(triangle) for those whose boxes meet this one.
    template <class Call> void for_each_in(const Box& box, const Call& call) const {
        if (triangles_.empty()) return;
        std::array<std::size_t, 128> stack;
        std::size_t depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const std::size_t node = stack[--depth];
            if (!nodes_[node].meets(box)) continue;
            if (node >> levels_ == 0) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            const std::size_t first = (node - (std::size_t{1} << levels_)) * kGroup;
            for (std::size_t n = first; n < std::min(first + kGroup, triangles_.size()); ++n)
                if (boxes_[triangles_[n]].meets(box)) call(triangles_[n]);
        }
    }

    // Calls call(a, b), once, for the triangles of each pair whose boxes meet. One is in this group, the other in it or
    // in a later group. A search of one group at a time visits a quarter of the nodes.
    template <class Call> void for_each_pair(std::size_t group, const Call& call) const {
        const std::size_t groups_begin = std::size_t{1} << levels_;
        const Box& box = nodes_[groups_begin + group];
        std::array<std::size_t, 128> stack;
        std::size_t depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const std::size_t node = stack[--depth];
            const int below = levels_ + 1 - std::bit_width(node);
            const std::size_t last = ((node + 1) << below) - 1 - groups_begin; // group
            if (last < group || !nodes_[node].meets(box)) continue;
            if (below > 0) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            for (std::size_t n = group * kGroup; n < end_of(group); ++n)
                for (std::size_t m = last == group ? n + 1 : last * kGroup; m < end_of(last); ++m)
                    if (boxes_[triangles_[n]].meets(boxes_[triangles_[m]])) call(triangles_[n], triangles_[m]);
        }
    }
    [[nodiscard]] std::size_t groups() const { return (triangles_.size() + kGroup - 1) / kGroup; }

private:
    static constexpr std::size_t kGroup = 8;
    [[nodiscard]] std::size_t end_of(std::size_t group) const {
        return std::min((group + 1) * kGroup, triangles_.size());
    }
    static std::uint64_t place_on_curve(const glm::vec3& at) { // 0 to 1 each
        std::uint64_t place = 0;
        for (int i = 0; i < 3; ++i) {
            const auto whole = static_cast<std::uint64_t>(glm::clamp(at[i], 0.0F, 1.0F) * 2097151.0F);
            for (int bit = 0; bit < 21; ++bit) place |= (whole >> bit & 1) << (3 * bit + i);
        }
        return place;
    }
    std::vector<Box> boxes_;               // by triangle
    std::vector<std::uint32_t> triangles_; // along the curve
    int levels_ = 0;
    std::vector<Box> nodes_; // the root at 1, those below n at 2 n and 2 n + 1, groups from 1 << levels_ on
};

using IntersectingPair = mesh::TrianglePair; // triangles, the lower first

[[nodiscard]] inline std::vector<IntersectingPair> intersecting_triangles(const mesh::TriangleMesh& mesh) {
    const BoxTree tree(mesh);
    ListsByThread<IntersectingPair> found;
    tbb::parallel_for(std::size_t{0}, tree.groups(), [&](std::size_t group) {
        tree.for_each_pair(group, [&](std::uint32_t a, std::uint32_t b) {
            if (a > b) std::swap(a, b);
            if (mesh::triangles_meet(mesh.positions, mesh.triangles[a], mesh.triangles[b]))
                found.local().push_back({a, b});
        });
    });
    return found.sorted();
}

// The middle of the two triangles of a pair, mm.
[[nodiscard]] inline glm::dvec3 middle_of(const mesh::TriangleMesh& mesh, const IntersectingPair& pair) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t triangle : {pair.first, pair.second})
        for (int i = 0; i < 3; ++i) sum += glm::dvec3(mesh.positions[mesh.triangles[triangle][i]]);
    return sum / 6.0;
}

} // namespace ramus::test
