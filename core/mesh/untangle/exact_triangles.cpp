#include "core/mesh/untangle/exact_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::mesh {

namespace {

// A number as a sum of nonoverlapping doubles, smallest first, without zeros (an expansion; Shewchuk 1997).
class ExactSum {
public:
    ExactSum() = default;
    static ExactSum difference(double a, double b) {
        ExactSum sum;
        sum.add(a), sum.add(-b);
        return sum;
    }
    void add(double more) {
        std::size_t kept = 0;
        for (const double term : terms_) {
            const double high = more + term;
            const double part = high - more;
            const double low = (more - (high - part)) + (term - part);
            if (low != 0.0) terms_[kept++] = low;
            more = high;
        }
        terms_.resize(kept);
        if (more != 0.0) terms_.push_back(more);
    }
    void add(const ExactSum& more, double sign = 1.0) {
        for (const double term : more.terms_) add(sign * term);
    }
    [[nodiscard]] ExactSum times(const ExactSum& other) const {
        ExactSum product;
        for (const double a : terms_) {
            for (const double b : other.terms_) {
                const double high = a * b;
                product.add(std::fma(a, b, -high));
                product.add(high);
            }
        }
        return product;
    }
    [[nodiscard]] int sign() const { return terms_.empty() ? 0 : terms_.back() > 0.0 ? 1 : -1; }

private:
    std::vector<double> terms_;
};

} // namespace

namespace exact {

int Plane::exact_side(const Corner& p) const {
    const auto row = [&](const Corner& to) {
        std::array<ExactSum, 3> parts;
        for (int i = 0; i < 3; ++i)
            parts[static_cast<std::size_t>(i)] =
                ExactSum::difference(static_cast<double>(to[i]), static_cast<double>(a_[i]));
        return parts;
    };
    const auto r = row(b_);
    const auto s = row(c_);
    const auto t = row(p);
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        sum.add(r[i].times(s[j]).times(t[k]));
        sum.add(r[i].times(s[k]).times(t[j]), -1.0);
    }
    return sum.sign();
}

int side_of_plane(const Corner& a, const Corner& b, const Corner& c, const Corner& p) { return Plane(a, b, c).side(p); }

int turn(const Corner& a, const Corner& b, const Corner& c, int axis) {
    const int x = (axis + 1) % 3;
    const int y = (axis + 2) % 3;
    const auto at = [](const Corner& p, int i) { return static_cast<double>(p[i]); };
    const double left = (at(b, x) - at(a, x)) * (at(c, y) - at(a, y));
    const double right = (at(b, y) - at(a, y)) * (at(c, x) - at(a, x));
    const double det = left - right;
    const double error = (3.0 + 16.0 * kRounding) * kRounding * (std::abs(left) + std::abs(right)); // of orient2d
    if (det > error) return 1;
    if (det < -error) return -1;
    const auto part = [&](const Corner& p, int i) { return ExactSum::difference(at(p, i), at(a, i)); };
    ExactSum sum = part(b, x).times(part(c, y));
    sum.add(part(b, y).times(part(c, x)), -1.0);
    return sum.sign();
}

} // namespace exact

namespace {

using exact::Corner, exact::Plane, exact::side_of_plane, exact::turn;

bool on_a_line(const Corner& a, const Corner& b, const Corner& c) {
    return turn(a, b, c, 0) == 0 && turn(a, b, c, 1) == 0 && turn(a, b, c, 2) == 0;
}

// Seen along an axis.
bool lines_meet_seen(const Corner& a, const Corner& b, const Corner& c, const Corner& d, int axis) {
    for (int i = 0; i < 3; ++i)
        if (i != axis && (std::max(a[i], b[i]) < std::min(c[i], d[i]) || std::max(c[i], d[i]) < std::min(a[i], b[i])))
            return false;
    return turn(a, b, c, axis) * turn(a, b, d, axis) <= 0 && turn(c, d, a, axis) * turn(c, d, b, axis) <= 0;
}

// Whether the segments a b and c d intersect.
bool lines_meet(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    if (side_of_plane(a, b, c, d) != 0) return false;
    // Along at least one of the axes the projection of their plane is one-to-one.
    return lines_meet_seen(a, b, c, d, 0) && lines_meet_seen(a, b, c, d, 1) && lines_meet_seen(a, b, c, d, 2);
}

struct Triangle {
    std::array<Corner, 3> at;
    [[nodiscard]] bool flat() const { return on_a_line(at[0], at[1], at[2]); } // without area
};

// Whether the triangle contains a point of its plane. The triangle must not be degenerate.
bool contains_in_plane(const Triangle& t, const Corner& p) {
    for (int axis = 0; axis < 3; ++axis) {
        const int whole = turn(t.at[0], t.at[1], t.at[2], axis);
        if (whole == 0) continue;
        for (std::size_t i = 0; i < 3; ++i)
            if (turn(t.at[i], t.at[(i + 1) % 3], p, axis) == -whole) return false;
    }
    return true;
}

bool line_meets(const Corner& p, const Corner& q, const Triangle& t) {
    const auto& [a, b, c] = t.at;
    const Plane plane(a, b, c);
    const int from = plane.side(p), to = plane.side(q);
    if (from * to > 0) return false;
    if (from == 0 && to == 0) { // the segment is in the plane, or the triangle is degenerate
        if (lines_meet(p, q, a, b) || lines_meet(p, q, b, c) || lines_meet(p, q, c, a)) return true;
        return !t.flat() && contains_in_plane(t, p);
    }
    const int first = side_of_plane(p, q, a, b);
    const int second = side_of_plane(p, q, b, c);
    const int third = side_of_plane(p, q, c, a);
    return (first >= 0 && second >= 0 && third >= 0) || (first <= 0 && second <= 0 && third <= 0);
}

// Whether the corners of `s`, from the index `first` on, are all on one side of the plane of `t`.
bool is_beside(const Triangle& s, const Triangle& t, std::size_t first) {
    const Plane plane(t.at[0], t.at[1], t.at[2]);
    const int side = plane.side(s.at[first]);
    for (std::size_t i = first + 1; i < 3 && side != 0; ++i)
        if (plane.side(s.at[i]) != side) return false;
    return side != 0;
}

// Whether the segments from a corner to two others have the same direction.
bool same_direction(const Corner& from, const Corner& a, const Corner& b) {
    if (!on_a_line(from, a, b)) return false;
    for (int i = 0; i < 3; ++i)
        if ((a[i] > from[i] && b[i] > from[i]) || (a[i] < from[i] && b[i] < from[i])) return true;
    return false;
}

// Whether the segment from the first corner to p intersects the triangle beyond that corner.
bool line_from_corner_meets(const Corner& p, const Triangle& t) {
    const auto& [corner, c, d] = t.at;
    if (t.flat()) return same_direction(corner, p, c) || same_direction(corner, p, d);
    if (p == corner || side_of_plane(corner, c, d, p) != 0) return false;
    return contains_in_plane(t, p) || lines_meet(corner, p, c, d);
}

// For triangles with a common first corner. If they intersect beyond it, they have a common segment from there, which
// ends on the opposite side of one of them.
bool meet_beyond_corner(const Triangle& s, const Triangle& t) {
    if (is_beside(s, t, 1) || is_beside(t, s, 1)) return false;
    if (s.flat()) return line_from_corner_meets(s.at[1], t) || line_from_corner_meets(s.at[2], t);
    if (t.flat()) return meet_beyond_corner(t, s);
    return line_meets(s.at[1], s.at[2], t) || line_meets(t.at[1], t.at[2], s);
}

// For triangles with common first two corners: they intersect if they are coplanar and overlap.
bool meet_beyond_edge(const Triangle& s, const Triangle& t) {
    const auto& [a, b, c] = s.at;
    const Corner& d = t.at[2];
    if (s.flat() && t.flat()) return same_direction(a, c, d) || same_direction(b, c, d);
    for (int axis = 0; axis < 3; ++axis)
        if (turn(a, b, c, axis) * turn(a, b, d, axis) < 0) return false;
    return side_of_plane(a, b, c, d) == 0 && !s.flat() && !t.flat();
}

bool meet(const Triangle& s, const Triangle& t) {
    if (is_beside(s, t, 0) || is_beside(t, s, 0)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (line_meets(s.at[i], s.at[(i + 1) % 3], t) || line_meets(t.at[i], t.at[(i + 1) % 3], s)) return true;
    return false;
}

} // namespace

bool triangles_meet(std::span<const glm::vec3> positions, const glm::uvec3& s, const glm::uvec3& t) {
    // Shared corners first, in the same order.
    std::array<std::uint32_t, 3> first{}, second{};
    int shared = 0;
    std::array<bool, 3> taken_s{}, taken_t{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const auto a = static_cast<std::size_t>(i);
            const auto b = static_cast<std::size_t>(j);
            if (s[i] != t[j] || taken_s[a] || taken_t[b]) continue;
            first[static_cast<std::size_t>(shared)] = second[static_cast<std::size_t>(shared)] = s[i];
            taken_s[a] = taken_t[b] = true;
            ++shared;
        }
    }
    std::size_t rest_s = static_cast<std::size_t>(shared), rest_t = rest_s;
    for (int i = 0; i < 3; ++i) {
        if (!taken_s[static_cast<std::size_t>(i)]) first[rest_s++] = s[i];
        if (!taken_t[static_cast<std::size_t>(i)]) second[rest_t++] = t[i];
    }
    const auto triangle = [&](const std::array<std::uint32_t, 3>& corners) {
        return Triangle{{positions[corners[0]], positions[corners[1]], positions[corners[2]]}};
    };
    switch (shared) {
    case 0:
        return meet(triangle(first), triangle(second));
    case 1:
        return meet_beyond_corner(triangle(first), triangle(second));
    case 2:
        return meet_beyond_edge(triangle(first), triangle(second));
    default:
        return true;
    }
}

// Triangles with a common edge intersect only if they are coplanar. For others this is the first test of
// triangles_meet().
bool surely_beside(std::span<const glm::vec3> positions, const Plane& plane, const glm::uvec3& s, const glm::uvec3& t) {
    int side = 0;
    for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t n = t[corner];
        if (n == s.x || n == s.y || n == s.z) continue;
        const int its = plane.sure_side(positions[n]);
        if (its == 0 || its == -side) return false;
        side = its;
    }
    return side != 0;
}

} // namespace ramus::mesh
