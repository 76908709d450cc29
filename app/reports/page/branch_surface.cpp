#include "app/reports/page/branch_surface.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace ramus::app {

namespace {

using mesh::TriangleMesh;

// How far the branch of vertex `b` is behind that of vertex `a` at `a`, in steps of field::Dominance.
float behind(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
    if (mesh.dominance.empty()) return 1.0F;
    const field::Dominance& at = mesh.dominance[a];
    const auto mark = static_cast<std::uint8_t>(static_cast<std::uint32_t>(mesh.branches[b]) & 255U);
    return std::max(1.0F, static_cast<float>(at.rivals[0] == mark ? at.over[0] : at.over[1]));
}

bool has_area(const glm::uvec3& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

class Divider {
public:
    Divider(const TriangleMesh& mesh, std::vector<glm::vec3>& positions) : mesh_(mesh), positions_(positions) {}

    // Calls put(branch, a, b, c) for each part of the triangle.
    template <class Put> void divide(const glm::uvec3& t, const Put& put) {
        const std::array<std::int32_t, 3> of{mesh_.branches[t[0]], mesh_.branches[t[1]], mesh_.branches[t[2]]};
        if (of[0] == of[1] && of[1] == of[2]) return put(of[0], t[0], t[1], t[2]);
        if (of[0] != of[1] && of[1] != of[2] && of[2] != of[0]) return divide_in_three(t, of, put);
        const int odd = of[1] == of[2] ? 0 : of[2] == of[0] ? 1 : 2; // the corner that differs from the other two
        const std::uint32_t a = t[odd], b = t[(odd + 1) % 3], c = t[(odd + 2) % 3];
        const std::uint32_t ab = crossing(a, b), ca = crossing(c, a);
        const auto own = of.at(static_cast<std::size_t>(odd)), other = of.at(static_cast<std::size_t>((odd + 1) % 3));
        put_part(put, own, {a, ab, ca});
        // The other part has four corners. Where one of the crossings is the corner itself, the line between two
        // corners of it must not run along an edge.
        const std::uint32_t from = ca == a ? ab : ca;
        put_part(put, other, {ab, b, from == ab ? c : ca});
        put_part(put, other, {from, from == ab ? c : b, from == ab ? ca : c});
    }

private:
    template <class Put> static void put_part(const Put& put, std::int32_t branch, const glm::uvec3& t) {
        if (has_area(t)) put(branch, t[0], t[1], t[2]);
    }

    template <class Put>
    void divide_in_three(const glm::uvec3& t, const std::array<std::int32_t, 3>& of, const Put& put) {
        const std::array<std::uint32_t, 3> across{crossing(t[0], t[1]), crossing(t[1], t[2]), crossing(t[2], t[0])};
        const auto middle = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back((positions_[across[0]] + positions_[across[1]] + positions_[across[2]]) / 3.0F);
        for (int corner = 0; corner < 3; ++corner) {
            const auto here = static_cast<std::size_t>(corner);
            put_part(put, of.at(here), {t[corner], across.at(here), middle});
            put_part(put, of.at(here), {t[corner], middle, across.at((here + 2) % 3)});
        }
    }

    // The vertex where the border crosses an edge: shares of branches are linear along it.
    std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b); // both triangles of an edge compute the same place
        const auto [at, is_new] = known_.try_emplace(std::uint64_t{a} << 32U | b, 0);
        if (!is_new) return at->second;
        constexpr float kFromCorner = 0.2F; // of the edge; tuned: thinner parts are slivers
        const float from_a = behind(mesh_, a, b), from_b = behind(mesh_, b, a);
        const float share = from_a / (from_a + from_b);
        if (share < kFromCorner) return at->second = a;
        if (share > 1.0F - kFromCorner) return at->second = b;
        at->second = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(mesh_.positions[a] + share * (mesh_.positions[b] - mesh_.positions[a]));
        return at->second;
    }

    const TriangleMesh& mesh_;
    std::vector<glm::vec3>& positions_;
    std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

void take_least(float& least, float radius) {
    if (radius > 0.0F && (least == 0.0F || radius < least)) least = radius;
}

} // namespace

BranchSurface divided_by_branch(const mesh::TriangleMesh& mesh, const tree::Dependency& dependency) {
    BranchSurface made;
    made.positions.assign(mesh.positions.begin(), mesh.positions.end());
    const auto ranks = static_cast<std::size_t>(dependency.branch_count());
    std::vector<std::uint32_t> rank(ranks);
    for (std::size_t i = 0; i < ranks; ++i)
        rank[static_cast<std::size_t>(dependency.order()[i])] = static_cast<std::uint32_t>(i);
    Divider divider(mesh, made.positions);
    std::vector<std::uint32_t> parts; // three corners for each part of a triangle, in the order of the mesh
    std::vector<std::uint32_t> rank_of;
    parts.reserve(3 * mesh.triangles.size());
    rank_of.reserve(mesh.triangles.size());
    made.radius_mm.assign(ranks, 0.0F);
    for (const glm::uvec3& t : mesh.triangles) {
        if (!has_area(t)) continue;
        divider.divide(t, [&](std::int32_t branch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            rank_of.push_back(rank[static_cast<std::size_t>(branch)]);
            parts.insert(parts.end(), {a, b, c});
        });
        for (int corner = 0; corner < 3 && !mesh.radii.empty(); ++corner)
            take_least(made.radius_mm[rank[static_cast<std::size_t>(mesh.branches[t[corner]])]], mesh.radii[t[corner]]);
    }
    made.first.assign(ranks + 1, 0);
    for (const std::uint32_t r : rank_of) ++made.first[r + 1];
    for (std::size_t i = 0; i < ranks; ++i) made.first[i + 1] += made.first[i];
    std::vector<std::uint32_t> next(made.first.begin(), made.first.end() - 1);
    made.indices.resize(parts.size());
    for (std::size_t i = 0; i < rank_of.size(); ++i)
        std::copy_n(parts.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                    made.indices.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{next[rank_of[i]]++}));
    return made;
}

BranchSurface undivided(const mesh::TriangleMesh& mesh) {
    BranchSurface made;
    made.positions.assign(mesh.positions.begin(), mesh.positions.end());
    for (const glm::uvec3& t : mesh.triangles)
        if (has_area(t)) made.indices.insert(made.indices.end(), {t[0], t[1], t[2]});
    made.first = {0, static_cast<std::uint32_t>(made.triangles())};
    made.radius_mm = {0.0F};
    return made;
}

} // namespace ramus::app
