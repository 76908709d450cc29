#include "core/mesh/polygonize/cells/fans.h"

#include "core/base/bounds.h"
#include "core/mesh/line_triangle.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::mesh::bricks {

namespace {

using Triangle = std::array<glm::dvec3, 3>;

using Box = Bounds<glm::vec3>;

Box box_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

bool meet(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.least, b.most)) && glm::all(glm::lessThanEqual(b.least, a.most));
}

// Which of a triangle's corners are above the plane of another one: a bit each.
unsigned above(const Triangle& of, const Triangle& plane) {
    const glm::dvec3 normal = glm::cross(plane[1] - plane[0], plane[2] - plane[0]);
    unsigned bits = 0;
    for (unsigned n = 0; n < 3; ++n) bits |= (glm::dot(normal, of[n] - plane[0]) > 0.0 ? 1U : 0U) << n;
    return bits;
}

// Whether some edge of a triangle meets another one, of whose plane these of its corners are above.
bool edges_meet(const Triangle& of, unsigned above, const Triangle& other) {
    if (above == 0 || above == 7) return false; // as for most
    for (unsigned n = 0; n < 3; ++n) {
        const unsigned next = (n + 1) % 3;
        if ((above >> n & 1U) != (above >> next & 1U) && passes_within(of[n], of[next], other)) return true;
    }
    return false;
}

// What lies in a triangle's plane meets it where the other triangle's edges are looked at.
bool meet(const Triangle& s, const Triangle& t) {
    return edges_meet(s, above(s, t), t) || edges_meet(t, above(t, s), s);
}

glm::vec3 middle_of(const Fan& fan) {
    glm::vec3 sum(0.0F);
    for (const auto& [from, to] : fan.edges) sum += 0.5F * (from + to);
    return sum / static_cast<float>(std::max<std::size_t>(fan.edges.size(), 1));
}

} // namespace

bool lines_meet(const std::array<glm::vec3, 3>& a, const std::array<glm::vec3, 3>& b, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto side = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
        const glm::dvec3 pq(q - p), pr(r - p);
        return pq[u] * pr[v] - pq[v] * pr[u];
    };
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const bool parts_b = (side(a[i], a[i + 1], b[j]) > 0.0) != (side(a[i], a[i + 1], b[j + 1]) > 0.0);
            const bool parts_a = (side(b[j], b[j + 1], a[i]) > 0.0) != (side(b[j], b[j + 1], a[i + 1]) > 0.0);
            if (parts_a && parts_b) return true;
        }
    return false;
}

bool fans_meet(const Fan& a, const glm::vec3& from_a, const Fan& b, const glm::vec3& from_b) {
    Box all_of_b{from_b, from_b};
    for (const auto& [t, t2] : b.edges) all_of_b.hold(box_of(t, t2, t));
    for (const auto& [s, s2] : a.edges) {
        const Box box = box_of(from_a, s, s2);
        if (!meet(box, all_of_b)) continue;
        for (const auto& [t, t2] : b.edges)
            if (meet(box, box_of(from_b, t, t2)) && meet({glm::dvec3(from_a), glm::dvec3(s), glm::dvec3(s2)},
                                                         {glm::dvec3(from_b), glm::dvec3(t), glm::dvec3(t2)}))
                return true;
    }
    return false;
}

namespace {

// Two fans of several, and places for their vertices.
class FanParter {
public:
    FanParter(std::span<const Fan> fans, const glm::vec3& lower, const glm::vec3& upper, std::span<glm::vec3> vertices)
        : fans_(fans), lower_(lower), upper_(upper), vertices_(vertices) {}

    [[nodiscard]] bool meet(std::size_t a, std::size_t b) const {
        // So close together, in sizes of the box, that they may meet when positions are rounded.
        constexpr float kTooClose = 0.002F;
        return glm::distance(vertices_[a], vertices_[b]) < kTooClose * glm::length(upper_ - lower_) ||
               fans_meet(fans_[a], vertices_[a], fans_[b], vertices_[b]);
    }
    // `way`: from b to a.
    bool part(std::size_t a, std::size_t b, const glm::vec3& way) {
        const glm::vec3 was_a = vertices_[a], was_b = vertices_[b];
        const glm::vec3 middle_a = middle_of(fans_[a]), middle_b = middle_of(fans_[b]);
        const glm::vec3 centres[]{0.5F * (was_a + was_b), 0.5F * (middle_a + middle_b)};
        const std::size_t before = meetings(a, b);
        const auto works = [&](const glm::vec3& at_a, const glm::vec3& at_b) {
            vertices_[a] = glm::clamp(at_a, lower_, upper_), vertices_[b] = glm::clamp(at_b, lower_, upper_);
            return !meet(a, b) && meetings(a, b) < before;
        };
        for (const float share : {0.01F, 0.03F, 0.1F}) // of the box
            for (const glm::vec3& centre : centres) {
                const glm::vec3 off = share * glm::length(upper_ - lower_) * way;
                if (works(centre + off, centre - off)) return true;
            }
        for (const float share : {0.25F, 0.5F, 0.75F, 1.0F}) {
            const glm::vec3 at_a = glm::mix(was_a, middle_a, share), at_b = glm::mix(was_b, middle_b, share);
            if (works(at_a, at_b) || works(at_a, was_b) || works(was_a, at_b)) return true;
        }
        // From one vertex no fans meet: a little off it, in some direction, they do not either.
        for (int n = 0; n < 27; ++n)
            for (const glm::vec3& centre : centres) {
                const glm::vec3 off = 0.005F * (upper_ - lower_) * glm::vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
                if (works(centre + off, centre - off)) return true;
            }
        vertices_[a] = was_a, vertices_[b] = was_b;
        return false;
    }

private:
    // How many others either of the two meets, and each other.
    [[nodiscard]] std::size_t meetings(std::size_t a, std::size_t b) const {
        std::size_t count = 0;
        for (const std::size_t one : {a, b})
            for (std::size_t other = 0; other < fans_.size(); ++other)
                count += other != one && meet(one, other) ? 1 : 0;
        return count;
    }

    std::span<const Fan> fans_;
    glm::vec3 lower_, upper_;
    std::span<glm::vec3> vertices_;
};

} // namespace

bool part_fans(std::span<const Fan> fans, std::span<const glm::vec3> toward, const glm::vec3& lower,
               const glm::vec3& upper, std::span<glm::vec3> vertices) {
    FanParter parter(fans, lower, upper, vertices);
    bool parted = true;
    for (std::size_t a = 0; a < fans.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (!parter.meet(a, b)) continue;
            glm::vec3 way = toward[a] - toward[b];
            if (!(glm::length(way) > 0.0F)) way = middle_of(fans[a]) - middle_of(fans[b]);
            const float length = glm::length(way);
            parted = parter.part(a, b, length > 0.0F ? way / length : way) && parted;
        }
    return parted;
}

} // namespace ramus::mesh::bricks
