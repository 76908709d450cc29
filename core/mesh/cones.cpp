#include "core/mesh/cones.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh {

namespace {

struct Piece {
    glm::dvec3 a, b;
    double ra, rb;
    std::int32_t branch;
};

// All pieces have the same rings, so their indices are known in advance: a pole, `cap` rings from the pole to the
// circle of tangency, and the same mirrored at the other end.
struct Layout {
    int sides;
    int cap; // rings per end, the touching circle included
    [[nodiscard]] std::size_t vertices() const { return static_cast<std::size_t>(2 * cap * sides + 2); }
    [[nodiscard]] std::size_t triangles() const {
        return static_cast<std::size_t>(2 * sides * (2 * cap - 1) + 2 * sides);
    }
};

std::vector<Piece> collect(const PreparedTree& prepared) {
    std::vector<Piece> pieces;
    pieces.reserve(prepared.tree.segment_count());
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : prepared.tree.branches) {
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            const tree::Point& from = prepared.tree.points[branch.points[i - 1]];
            const tree::Point& to = prepared.tree.points[branch.points[i]];
            pieces.push_back({from.position, to.position, from.radius, to.radius, prepared.segment_source[ordinal]});
        }
    }
    return pieces;
}

class PieceWriter {
public:
    PieceWriter(const Layout& layout, TriangleMesh& mesh) : layout_(layout), mesh_(mesh) {
        for (int s = 0; s < layout.sides; ++s) {
            const double angle = 2.0 * std::numbers::pi * s / layout.sides;
            circle_.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
        }
    }

    void write(const Piece& piece, std::size_t index) const {
        const glm::dvec3 along = piece.b - piece.a;
        const double length = glm::length(along);
        const glm::vec3 u = length > 0.0 ? glm::vec3(along / length) : glm::vec3(0.0F, 0.0F, 1.0F);
        const glm::vec3 helper = std::abs(u.x) < 0.6F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
        const glm::vec3 v = glm::normalize(glm::cross(u, helper));
        const glm::vec3 w = glm::cross(u, v);
        // The latitude of the circles of tangency on both spheres. If one sphere contains the other, it is drawn whole,
        // and the circles are near its pole.
        const double sine = length > 0.0 ? std::clamp((piece.ra - piece.rb) / length, -0.999, 0.999) : 0.0;
        const double touching = std::asin(sine);

        const std::size_t first = index * layout_.vertices();
        std::size_t at = first;
        const auto put = [&](glm::dvec3 centre, double radius, const glm::vec3& normal) {
            mesh_.positions[at] = glm::vec3(centre) + static_cast<float>(radius) * normal;
            mesh_.normals[at] = normal;
            mesh_.radii[at] = static_cast<float>(radius);
            mesh_.dominance[at] = {{255, 255}, {0, 0}};
            mesh_.branches[at++] = piece.branch;
        };
        const auto put_ring = [&](glm::dvec3 centre, double radius, double latitude) {
            const auto up = static_cast<float>(std::sin(latitude));
            const auto out = static_cast<float>(std::cos(latitude));
            for (const glm::vec2& c : circle_) put(centre, radius, up * u + out * (c.x * v + c.y * w));
        };
        constexpr double kQuarter = 0.5 * std::numbers::pi;
        put(piece.a, piece.ra, -u);
        for (int n = 1; n <= layout_.cap; ++n)
            put_ring(piece.a, piece.ra, -kQuarter + (touching + kQuarter) * n / layout_.cap);
        for (int n = layout_.cap; n >= 1; --n)
            put_ring(piece.b, piece.rb, kQuarter + (touching - kQuarter) * n / layout_.cap);
        put(piece.b, piece.rb, u);
        write_triangles(static_cast<std::uint32_t>(first), index * layout_.triangles());
    }

private:
    void write_triangles(std::uint32_t first, std::size_t at) const {
        const auto sides = static_cast<std::uint32_t>(layout_.sides);
        const auto rings = static_cast<std::uint32_t>(2 * layout_.cap);
        const std::uint32_t last = first + 1 + rings * sides;
        for (std::uint32_t s = 0; s < sides; ++s) {
            const std::uint32_t t = s + 1 == sides ? 0 : s + 1;
            mesh_.triangles[at++] = {first, first + 1 + t, first + 1 + s};
            for (std::uint32_t r = 0; r + 1 < rings; ++r) {
                const std::uint32_t low = first + 1 + r * sides;
                const std::uint32_t high = low + sides;
                mesh_.triangles[at++] = {low + s, low + t, high + t};
                mesh_.triangles[at++] = {low + s, high + t, high + s};
            }
            mesh_.triangles[at++] = {last, last - sides + s, last - sides + t};
        }
    }

    Layout layout_;
    TriangleMesh& mesh_;
    std::vector<glm::vec2> circle_;
};

} // namespace

Result<TriangleMesh> cones(const PreparedTree& prepared, int detail, Job& job) {
    const std::vector<Piece> pieces = collect(prepared);
    const Layout layout{std::max(6, detail), detail < 8 ? 1 : std::max(2, detail / 8)};
    if (pieces.size() * layout.vertices() > 0xFFFFFFF0U)
        return fail("the cones would need more vertices than a mesh can number", {}, "lower --detail");
    TriangleMesh mesh;
    mesh.resize_vertices(pieces.size() * layout.vertices());
    mesh.triangles.resize(pieces.size() * layout.triangles());
    const PieceWriter writer(layout, mesh);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pieces.size(), 256), [&](const auto& range) {
        if (job.cancelled()) return;
        for (std::size_t i = range.begin(); i < range.end(); ++i) writer.write(pieces[i], i);
    });
    if (job.cancelled()) return fail("cancelled");
    job.report(1.0F);
    return mesh;
}

} // namespace ramus::mesh
