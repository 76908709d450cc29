#include "core/measure/mesh_distance.h"

#include "core/base/infinity.h"
#include "core/base/lines.h"
#include "core/mesh/line_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::measure {

namespace {

using Triangle = std::array<glm::dvec3, 3>;
using Box = MeshDistance::Box;

double square(const glm::dvec3& v) { return glm::dot(v, v); }

// A degenerate triangle is treated as its edges.
glm::dvec3 nearest_on(const glm::dvec3& p, const Triangle& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = square(normal);
    bool over = area > 0.0;
    for (std::size_t i = 0; i < 3 && over; ++i)
        over = glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0.0;
    if (over) return p - glm::dot(p - t[0], normal) / area * normal;
    glm::dvec3 best = nearest_on_line(p, t[0], t[1]);
    for (std::size_t i = 1; i < 3; ++i) {
        const glm::dvec3 other = nearest_on_line(p, t[i], t[(i + 1) % 3]);
        if (square(p - other) < square(p - best)) best = other;
    }
    return best;
}

// The nearest places of two segments: on ab, on cd. C. Ericson, "Real-Time Collision Detection", 2005, 5.1.9.
std::pair<glm::dvec3, glm::dvec3> nearest_on_segments(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                                      const glm::dvec3& d) {
    const glm::dvec3 u = b - a, v = d - c, w = a - c;
    const double uu = square(u), vv = square(v), uv = glm::dot(u, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
    const double crossed = uu * vv - uv * uv;
    const double s = crossed > 0.0 ? std::clamp((uv * vw - uw * vv) / crossed, 0.0, 1.0) : 0.0;
    const glm::dvec3 on_second = nearest_on_line(a + s * u, c, d);
    return {nearest_on_line(on_second, a, b), on_second};
}

// The nearest places of two triangles; one place where they meet.
MeshDistance::Gap gap_between(const Triangle& a, const Triangle& b) {
    MeshDistance::Gap gap{kInfinity, {}, {}};
    const auto consider = [&gap](const glm::dvec3& on_a, const glm::dvec3& on_b) {
        const double squared = square(on_a - on_b);
        if (squared < gap.distance_mm) gap = {squared, on_a, on_b};
    };
    for (std::size_t i = 0; i < 3; ++i) {
        consider(a[i], nearest_on(a[i], b));
        consider(nearest_on(b[i], a), b[i]);
        for (std::size_t j = 0; j < 3; ++j) {
            const auto [on_a, on_b] = nearest_on_segments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
            consider(on_a, on_b);
        }
    }
    // Where an edge of one passes through the other, they meet.
    for (std::size_t i = 0; i < 6 && gap.distance_mm > 0.0; ++i) {
        const Triangle &edges = i < 3 ? a : b, &other = i < 3 ? b : a;
        const glm::dvec3 &from = edges[i % 3], &to = edges[(i + 1) % 3];
        if (!mesh::line_meets(from, to, other)) continue;
        const double before = mesh::signed_volume(other[0], other[1], other[2], from);
        const double after = mesh::signed_volume(other[0], other[1], other[2], to);
        const glm::dvec3 at = glm::mix(from, to, before / (before - after));
        gap = {0.0, at, at};
    }
    gap.distance_mm = std::sqrt(gap.distance_mm);
    return gap;
}

double to_box(const glm::dvec3& p, const Box& box) {
    return square(glm::max(glm::max(box.least - p, p - box.most), glm::dvec3(0.0)));
}

// The minimum of (distance to a convex set) - (radius) along the segment; nearest(p) is the point of the set nearest to
// p. If the minimum is not below `best`, returns some value that is not below `best`. The gap is convex along the
// segment, so it lies above its tangents. The intersection of the tangents at both ends of an interval is a lower bound
// of the gap between them, and the next place to evaluate.
double least_gap(const tree::Point& a, const tree::Point& b, double best, const auto& nearest) {
    const glm::dvec3 along = b.position - a.position;
    const double widening = b.radius - a.radius;
    struct Place {
        double t, gap, slope;
    };
    const auto look = [&](double t) {
        const glm::dvec3 place = a.position + t * along;
        const glm::dvec3 away = place - nearest(place);
        const double distance = glm::length(away);
        return Place{t, distance - (a.radius + t * widening),
                     (distance > 0.0 ? glm::dot(away, along) / distance : 0.0) - widening};
    };
    Place from = look(0.0), to = look(1.0);
    double least = std::min(from.gap, to.gap);
    constexpr int kMostSteps = 60; // four or five do
    for (int i = 0; i < kMostSteps && from.slope < 0.0 && to.slope > 0.0; ++i) {
        const double meet = (to.gap - from.gap + from.slope * from.t - to.slope * to.t) / (from.slope - to.slope);
        const double bound = from.gap + from.slope * (meet - from.t);
        if (!(bound < std::min(best, least) - 1e-9)) break;
        const Place next = look(std::clamp(meet, from.t, to.t));
        least = std::min(least, next.gap);
        (next.slope < 0.0 ? from : to) = next;
        if (next.slope == 0.0) break;
    }
    return least;
}

// The parameters at which a ray enters and leaves the box; the first is larger than the second if it misses the box.
std::pair<double, double> entry_and_exit(const Box& box, const glm::dvec3& from, const glm::dvec3& inverse) {
    const glm::dvec3 near = (box.least - from) * inverse, far = (box.most - from) * inverse;
    const glm::dvec3 enter = glm::min(near, far), leave = glm::max(near, far);
    return {std::max({enter.x, enter.y, enter.z}), std::min({leave.x, leave.y, leave.z})};
}

bool crosses(const Box& box, const glm::dvec3& from, const glm::dvec3& inverse) {
    const auto [first, last] = entry_and_exit(box, from, inverse);
    return last >= 0.0 && first <= last;
}

} // namespace

MeshDistance::MeshDistance(const mesh::TriangleMesh& mesh) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        triangles.push_back(
            {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])});
    const auto hold = [&](Box& box, std::uint32_t triangle) {
        for (const glm::dvec3& corner : triangles[triangle]) box.hold(corner);
    };
    const auto middle = [&](std::uint32_t triangle, int axis) {
        const Triangle& t = triangles[triangle];
        return t[0][axis] + t[1][axis] + t[2][axis];
    };
    HalvedBoxes tree = halved_boxes(static_cast<std::uint32_t>(triangles.size()), hold, middle);
    nodes_ = std::move(tree.nodes);
    corners_.reserve(triangles.size());
    for (const std::uint32_t triangle : tree.order) corners_.push_back(triangles[triangle]);
}

// The minimum of `best` and of_triangle(triangle, best so far) over all triangles. Stops at the first value that is at
// most `enough`. of_box(box, best so far) must be a lower bound for all triangles in the box.
template <class ToBox, class ToTriangle>
double MeshDistance::least(double best, double enough, const ToBox& of_box, const ToTriangle& of_triangle) const {
    const auto look = [&](std::uint32_t at) { return std::pair(at, of_box(nodes_[at].box, best)); };
    std::vector<std::pair<std::uint32_t, double>> open{look(0)};
    while (!open.empty()) {
        const auto [at, bound] = open.back();
        open.pop_back();
        if (bound >= best) continue;
        const BoxNode& node = nodes_[at];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            best = std::min(best, of_triangle(corners_[i], best));
            if (best <= enough) return best;
        }
        if (node.count > 0) continue;
        const auto near = look(at + 1), far = look(node.first);
        open.push_back(near.second < far.second ? far : near);
        open.push_back(near.second < far.second ? near : far);
    }
    return best;
}

double MeshDistance::surface_distance(const glm::dvec3& point) const {
    return std::sqrt(least(
        kInfinity, 0.0, [&](const Box& box, double) { return to_box(point, box); },
        [&](const Triangle& triangle, double) { return square(point - nearest_on(point, triangle)); }));
}

glm::dvec3 MeshDistance::nearest_on_surface(const glm::dvec3& point) const {
    glm::dvec3 nearest(0.0);
    const auto to_triangle = [&](const Triangle& triangle, double so_far) {
        const glm::dvec3 place = nearest_on(point, triangle);
        const double squared = square(point - place);
        if (squared < so_far) nearest = place;
        return squared;
    };
    const auto to_its_box = [&](const Box& box, double) { return to_box(point, box); };
    (void)least(kInfinity, 0.0, to_its_box, to_triangle);
    return nearest;
}

double MeshDistance::wall_distance(const tree::Point& a, const tree::Point& b, double best) const {
    const auto gap_to_box = [&](const Box& box, double so_far) {
        return least_gap(a, b, so_far, [&](const glm::dvec3& p) { return glm::clamp(p, box.least, box.most); });
    };
    const auto gap_to_triangle = [&](const Triangle& triangle, double so_far) {
        return least_gap(a, b, so_far, [&](const glm::dvec3& p) { return nearest_on(p, triangle); });
    };
    return least(best, -std::max(a.radius, b.radius), gap_to_box, gap_to_triangle); // nothing can be less
}

std::optional<MeshDistance::Gap> MeshDistance::triangle_gap(const std::array<glm::dvec3, 3>& triangle,
                                                            double best) const {
    std::optional<Gap> nearest;
    const Box around = box_of_points(triangle);
    const auto between_boxes = [&](const Box& box, double) {
        return glm::length(glm::max(glm::max(box.least - around.most, around.least - box.most), glm::dvec3(0.0)));
    };
    const auto between_triangles = [&](const Triangle& other, double so_far) {
        const Gap gap = gap_between(triangle, other);
        if (gap.distance_mm < so_far) nearest = gap;
        return gap.distance_mm;
    };
    (void)least(best, 0.0, between_boxes, between_triangles);
    return nearest;
}

int MeshDistance::winding(const glm::dvec3& point, const glm::dvec3& direction, bool& grazed) const {
    const glm::dvec3 inverse = 1.0 / direction; // no coordinate of a direction is 0
    int turns = 0;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
        const std::uint32_t at = open.back();
        open.pop_back();
        const BoxNode& node = nodes_[at];
        if (!crosses(node.box, point, inverse)) continue;
        if (node.count == 0) {
            open.push_back(at + 1);
            open.push_back(node.first);
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = corners_[i];
            const glm::dvec3 e1 = t[1] - t[0], e2 = t[2] - t[0];
            const glm::dvec3 across = glm::cross(direction, e2);
            const double volume = glm::dot(e1, across);
            const double scale = std::sqrt(square(e1) * square(e2));
            if (scale == 0.0) continue;
            const glm::dvec3 to_point = point - t[0];
            constexpr double kClose = 1e-10;
            if (std::abs(volume) <= kClose * scale) { // the ray nearly touches an edge: another ray decides
                const glm::dvec3 normal = glm::cross(e1, e2);
                const double off = glm::dot(to_point, normal);
                if (off * off <= 1e-16 * square(normal) * (square(to_point) + scale)) grazed = true;
                continue;
            }
            const double u = glm::dot(to_point, across) / volume;
            const glm::dvec3 q = glm::cross(to_point, e1);
            const double v = glm::dot(direction, q) / volume;
            const double w = 1.0 - u - v;
            if (glm::dot(e2, q) / volume <= 0.0) continue; // behind
            const double least = std::min({u, v, w});
            if (std::abs(least) < kClose) grazed = true;
            if (least > 0.0) turns += volume > 0.0 ? 1 : -1;
        }
    }
    return turns;
}

bool MeshDistance::inside(const glm::dvec3& point) const {
    if (to_box(point, nodes_[0].box) > 0.0) return false;
    // Not parallel to an axis or a diagonal, since edges of modelled meshes often are.
    constexpr std::array<glm::dvec3, 5> kDirections{{{0.8506508, 0.4472136, 0.2763932},
                                                     {-0.3090170, 0.7639320, -0.5665278},
                                                     {0.1836035, -0.5257311, 0.8305895},
                                                     {-0.6180340, -0.3819660, 0.6871340},
                                                     {0.4370160, 0.2360680, -0.8679420}}};
    int turns = 0;
    for (const glm::dvec3& direction : kDirections) {
        bool grazed = false;
        turns = winding(point, direction, grazed);
        if (!grazed) break;
    }
    return turns != 0;
}

double MeshDistance::distance(const glm::dvec3& point) const { return inside(point) ? 0.0 : surface_distance(point); }

} // namespace ramus::measure
