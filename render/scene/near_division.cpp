#include "render/scene/near_division.h"

#include "core/field/surface_projector.h"
#include "render/scene/creased.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <tuple>

namespace ramus::render {

namespace {

constexpr int kMostDivisions = 8; // bisections of an edge: with 16 edges around a vessel, 4096
constexpr std::uint32_t kStraight = std::numeric_limits<std::uint32_t>::max();
// An edge is evaluated on the exact surface if its bend by normals is at least this share of the tolerance.
constexpr float kLeastGuess = 0.3F;
constexpr float kLeastCosine = 0.4F; // between normals that determine a bend
// In lengths of the edge: points farther away are on another part of the surface.
constexpr float kMostMove = 0.35F;
// Creases amplify the errors of the surfaces that meet there: their tolerance as a share of that of other surfaces.
constexpr float kShareAtCreases = 0.25F;
// In lengths of the edge: a middle at most this far below its vessel's own surface is moved onto it.
constexpr float kOnward = 1.2F;
// Longest edge around a vertex in pixels: with shorter edges, bending by normals is precise enough.
constexpr float kExactFrom = 6.0F;
constexpr float kCreasePixels = 1.0F; // shorter edges across a crease are not divided

// Whether a vessel's surface enters another vessel between two vertices.
bool cross_crease(NearPlace a, NearPlace b) {
    return (a == NearPlace::kCovered && b != NearPlace::kCovered && b != NearPlace::kWall) ||
           (b == NearPlace::kCovered && a != NearPlace::kCovered && a != NearPlace::kWall);
}

NearPlace place_of(const field::SurfaceProjector::Point& point) {
    if (!point.beside_contact) return NearPlace::kSmooth;
    switch (point.place) {
    case field::DrawnPoint::Place::kOwn:
        return NearPlace::kOwn;
    case field::DrawnPoint::Place::kCovered:
        return NearPlace::kCovered;
    case field::DrawnPoint::Place::kWall:
        break;
    }
    return NearPlace::kWall;
}

// Whether a vessel's own surface ends at a visible wall or cut between two vertices.
bool end_on_wall(NearPlace a, NearPlace b) {
    const auto is_seen = [](NearPlace place) { return place == NearPlace::kSmooth || place == NearPlace::kOwn; };
    return (a == NearPlace::kWall && is_seen(b)) || (b == NearPlace::kWall && is_seen(a));
}

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32U | std::uint64_t{std::max(a, b)};
}

float value_between(float a, float b) { return std::min(a, b) > 0.5F * kNotKnown ? 0.5F * (a + b) : kNotKnown; }

} // namespace

// Pixels per mm at a place.
float NearDivision::pixels_of(const glm::vec3& place, float length) const {
    return view_.pixels_at(glm::dot(place - view_.eye, view_.forward), length);
}

// Whether an edge may need division, judged by its ends.
bool NearDivision::may_bend(const Vertex& a, const Vertex& b) const {
    if (a.place == NearPlace::kCrease || b.place == NearPlace::kCrease) return false;
    const EdgeEnd &one = a.end, &other = b.end;
    const glm::vec3 from_eye = 0.5F * (one.position + other.position) - view_.eye;
    const float length = glm::distance(one.position, other.position), depth = glm::dot(from_eye, view_.forward);
    const float pixels = view_.pixels_at(depth, length);
    if (depth < -length || kMostBend * length * pixels <= most_off_ || !view_.shows(from_eye + view_.eye, length))
        return false;
    if (a.place == NearPlace::kWall || b.place == NearPlace::kWall) return end_on_wall(a.place, b.place);
    if (cross_crease(a.place, b.place)) return true;
    const glm::vec3 bend = bend_of(one, other), sight = view_.flat ? view_.forward : glm::normalize(from_eye);
    const bool exact = a.exact && b.exact;
    return pixels * glm::length(bend - glm::dot(bend, sight) * sight) > (exact ? kLeastGuess : 1.0F) * most_off_ ||
           (exact && glm::dot(one.normal, other.normal) < kLeastCosine);
}

bool NearDivision::is_divided(const Vertex& a, const Vertex& b, const Vertex& middle) const {
    const glm::vec3 straight = 0.5F * (a.end.position + b.end.position), off = middle.end.position - straight;
    const float length = glm::distance(a.end.position, b.end.position);
    const float pixels = pixels_of(straight, length);
    // Towards a wall a vessel's own surface continues inside the other vessel. The rim that an obstacle cuts stays.
    if (a.place == NearPlace::kWall || b.place == NearPlace::kWall)
        return middle.place == NearPlace::kCovered && pixels * length > kCreasePixels;
    if (middle.place == NearPlace::kWall) return false;
    if (glm::length(off) > kMostMove * length) return false;
    if (cross_crease(a.place, b.place)) return pixels * glm::length(off) > kShareAtCreases * most_off_;
    const glm::vec3 sight = view_.flat ? view_.forward : glm::normalize(straight - view_.eye);
    return pixels * glm::length(off - glm::dot(off, sight) * sight) > most_off_;
}

bool NearDivision::concerns(const TrianglePage& page) const {
    return std::any_of(page.triangles.begin(), page.triangles.begin() + page.count, [&](const glm::uvec3& t) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            if (may_bend({end_of(mesh_.vertex(a))}, {end_of(mesh_.vertex(b))})) return true;
        }
        return false;
    });
}

// Collects the vertices and triangles of the pages.
void NearDivision::take(const std::vector<std::size_t>& pages) {
    numbers_.assign(mesh_.vertex_pages().size() * VertexPage::kSize, kStraight);
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const TrianglePage& page = *mesh_.triangle_pages()[pages[i]];
        for (std::uint32_t n = 0; n < page.count; ++n) {
            Triangle triangle;
            triangle.page = static_cast<std::uint32_t>(i);
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& number = numbers_[page.triangles[n][k]];
                if (number == kStraight) {
                    const GpuVertex& v = mesh_.vertex(page.triangles[n][k]);
                    number = static_cast<std::uint32_t>(vertices_.size());
                    vertices_.push_back({end_of(v),
                                         {v.branch, v.dominance},
                                         mesh_.has_values() ? mesh_.value(page.triangles[n][k]) : kNotKnown});
                }
                triangle.corners[k] = number;
            }
            for (int k = 0; k < 3; ++k) {
                Vertex &a = vertices_[triangle.corners[k]], &b = vertices_[triangle.corners[(k + 1) % 3]];
                const float length = glm::distance(a.end.position, b.end.position);
                a.edge = std::max(a.edge, length), b.edge = std::max(b.edge, length);
            }
            active_.push_back(triangle);
        }
    }
    changed_.assign(pages.size(), 0);
}

// Marks creases where the exact surface is not evaluated.
void NearDivision::mark_creases(const std::vector<std::size_t>& shown) {
    const std::vector<std::uint8_t> creased = creased_vertices(mesh_, shown);
    for (std::size_t n = 0; n < creased.size(); ++n)
        if (creased[n] != 0 && numbers_[n] != kStraight && !vertices_[numbers_[n]].exact)
            vertices_[numbers_[n]].place = NearPlace::kCrease;
}

// Moves vertices onto the surface if their error is visible, except vertices shared with shown pages that stay.
void NearDivision::move_vertices(const std::vector<std::size_t>& pages, const std::vector<std::size_t>& shown) {
    constexpr float kReach = 0.5F; // in lengths of the longest edge there
    // In lengths of that edge; tuned on a contact in a brain: farther points are on another surface.
    constexpr float kMostAtRims = 0.45F;
    std::vector<field::SurfaceProjector::Point> points;
    std::vector<std::uint32_t> exact;
    for (std::uint32_t n = 0; n < vertices_.size(); ++n) {
        Vertex& v = vertices_[n];
        v.exact = v.edge * pixels_of(v.end.position, v.edge) > kExactFrom && view_.shows(v.end.position, v.edge);
        if (!v.exact) continue;
        exact.push_back(n);
        points.push_back({.at = mesh_.origin() + glm::dvec3(v.end.position),
                          .branch = v.owner.branch,
                          .cell = v.edge,
                          .reach = kReach * v.edge});
    }
    mesh_.projector()->move(points);
    std::vector<std::uint8_t> stays(vertices_.size(), 0), moved(vertices_.size(), 0);
    for (const std::size_t number : shown) {
        if (std::ranges::binary_search(pages, number)) continue;
        const TrianglePage& page = *mesh_.triangle_pages()[number];
        for (const glm::uvec3& t : page.triangles.first(page.count))
            for (int k = 0; k < 3; ++k)
                if (numbers_[t[k]] != kStraight) stays[numbers_[t[k]]] = 1;
    }
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const std::uint32_t n = exact[i];
        Vertex& v = vertices_[n];
        v.place = place_of(points[i]);
        const glm::vec3 at(points[i].at - mesh_.origin());
        v.end.normal = points[i].normal;
        const float off = glm::distance(at, v.end.position) * pixels_of(at, v.edge);
        const bool is_rim = v.place == NearPlace::kOwn;
        if (is_rim && glm::distance(at, v.end.position) > kMostAtRims * v.edge) continue;
        if (stays[n] != 0 || !(off > kShareAtCreases * most_off_)) continue;
        v.end.position = at;
        moved[n] = 1;
    }
    for (const Triangle& t : active_)
        if (moved[t.corners.x] + moved[t.corners.y] + moved[t.corners.z] > 0) changed_[t.page] = 1;
}

// The edges of active triangles that may need division, each once, ordered by their ends; and their sides in the same
// order.
std::vector<NearDivision::Edge> NearDivision::find_edges(std::vector<Side>& sides) {
    tbb::parallel_for(std::size_t{0}, active_.size(), [&](std::size_t n) {
        Triangle& t = active_[n];
        for (int k = 0; k < 3; ++k) {
            const Vertex &a = vertices_[t.corners[k]], &b = vertices_[t.corners[(k + 1) % 3]];
            if ((t.settled >> k & 1) == 0 && !may_bend(a, b))
                t.settled = static_cast<std::uint8_t>(t.settled | 1U << k);
        }
    });
    for (std::uint32_t n = 0; n < active_.size(); ++n)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Triangle& t = active_[n];
            if ((t.settled >> k & 1U) == 0)
                sides.push_back({key_of(t.corners[int(k)], t.corners[int((k + 1) % 3)]), n, k});
        }
    tbb::parallel_sort(sides, [](const Side& a, const Side& b) {
        return std::tuple(a.edge, a.triangle, a.number) < std::tuple(b.edge, b.triangle, b.number);
    });
    std::vector<Edge> edges;
    for (std::size_t n = 0; n < sides.size(); ++n)
        if (n == 0 || sides[n].edge != sides[n - 1].edge)
            edges.push_back(
                {static_cast<std::uint32_t>(sides[n].edge >> 32U), static_cast<std::uint32_t>(sides[n].edge)});
    return edges;
}

void NearDivision::place_middles(std::vector<Edge>& edges) const {
    constexpr float kReach = 0.5F; // of the edge
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t n) {
        Edge& edge = edges[n];
        const Vertex &a = vertices_[edge.a], &b = vertices_[edge.b];
        edge.middle.end = middle_of(a.end, b.end);
        edge.middle.owner = owner_between(a.owner, b.owner);
        edge.middle.value = mesh_.has_values() ? value_between(a.value, b.value) : kNotKnown;
        edge.middle.edge = 0.5F * (a.edge + b.edge);
        edge.middle.exact = a.exact && b.exact;
    });
    std::vector<field::SurfaceProjector::Point> points;
    std::vector<std::size_t> exact;
    for (std::size_t n = 0; n < edges.size(); ++n) {
        const Edge& edge = edges[n];
        if (!edge.middle.exact) continue;
        const glm::dvec3 a(vertices_[edge.a].end.position), b(vertices_[edge.b].end.position);
        const auto length = static_cast<float>(glm::distance(a, b));
        exact.push_back(n);
        points.push_back({.at = mesh_.origin() + 0.5 * (a + b),
                          .branch = edge.middle.owner.branch,
                          .cell = edge.middle.edge,
                          .reach = kReach * length,
                          .onward = kOnward * length});
    }
    if (!points.empty()) mesh_.projector()->move(points);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        Vertex& middle = edges[exact[i]].middle;
        middle.end = {glm::vec3(points[i].at - mesh_.origin()), points[i].normal};
        middle.place = place_of(points[i]);
    }
    for (Edge& edge : edges) edge.divided = is_divided(vertices_[edge.a], vertices_[edge.b], edge.middle);
}

void NearDivision::split(const Triangle& triangle, const glm::uvec3& m) {
    const glm::uvec3& t = triangle.corners;
    const auto settled = [&](int k) { return triangle.settled >> k & 1; };
    const auto add = [&](const glm::uvec3& corners, int first, int second, int third) {
        const auto bits = static_cast<std::uint8_t>(first | second << 1 | third << 2);
        next_.push_back({corners, triangle.page, bits});
    };
    const auto count = (m.x != kStraight ? 1 : 0) + (m.y != kStraight ? 1 : 0) + (m.z != kStraight ? 1 : 0);
    if (count == 0) return done_.push_back(triangle);
    changed_[triangle.page] = 1;
    if (count == 3) {
        for (int i = 0; i < 3; ++i) add({t[i], m[i], m[(i + 2) % 3]}, 0, 0, 0);
        return add(m, 0, 0, 0);
    }
    int first = 0; // the divided edge, or the first of two in order
    while (m[first] == kStraight || (count == 2 && m[(first + 1) % 3] == kStraight)) ++first;
    const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const std::uint32_t ab = m[first], bc = m[(first + 1) % 3];
    const int straight_bc = settled((first + 1) % 3), straight_ca = settled((first + 2) % 3);
    if (count == 1) {
        add({a, ab, c}, 0, 0, straight_ca);
        return add({ab, b, c}, 0, straight_bc, 0);
    }
    add({ab, b, bc}, 0, 0, 0);
    add({a, ab, bc}, 0, 0, 0);
    add({a, bc, c}, 0, 0, straight_ca);
}

// False: nothing was divided.
bool NearDivision::divide_once() {
    std::vector<Side> sides;
    std::vector<Edge> edges = find_edges(sides);
    place_middles(edges);
    std::vector<glm::uvec3> middles(active_.size(), glm::uvec3(kStraight));
    std::size_t at = 0;
    bool any = false;
    for (const Edge& edge : edges) {
        const std::uint64_t key = key_of(edge.a, edge.b);
        const auto number = static_cast<std::uint32_t>(vertices_.size());
        if (edge.divided) vertices_.push_back(edge.middle);
        any = any || edge.divided;
        for (; at < sides.size() && sides[at].edge == key; ++at) {
            const auto side = static_cast<int>(sides[at].number);
            Triangle& t = active_[sides[at].triangle];
            if (edge.divided)
                middles[sides[at].triangle][side] = number;
            else
                t.settled = static_cast<std::uint8_t>(t.settled | 1U << side);
        }
    }
    next_.clear();
    for (std::size_t n = 0; n < active_.size(); ++n) split(active_[n], middles[n]);
    active_.swap(next_);
    return any;
}

bool NearDivision::divide(const std::vector<std::size_t>& pages, const std::vector<std::size_t>& shown,
                          std::size_t most) {
    take(pages);
    if (mesh_.projector()) move_vertices(pages, shown);
    mark_creases(shown);
    const std::size_t most_in_all = most + active_.size();
    for (int depth = 0; depth < kMostDivisions && divide_once(); ++depth)
        if (done_.size() + active_.size() > most_in_all) return false;
    done_.insert(done_.end(), active_.begin(), active_.end());
    std::size_t count = 0;
    for (const Triangle& t : done_) count += changed_[t.page];
    if (count > most) return false;
    write(pages);
    return true;
}

// Writes the changed pages in their order, to keep locality.
void NearDivision::write(const std::vector<std::size_t>& pages) {
    for (std::size_t i = 0; i < pages.size(); ++i)
        if (changed_[i] != 0) replaced.push_back(pages[i]);
    std::vector<std::size_t> first(pages.size() + 1, 0);
    for (const Triangle& t : done_) first[t.page + 1] += changed_[t.page];
    for (std::size_t i = 0; i < pages.size(); ++i) first[i + 1] += first[i];
    made.triangles.resize(first.back());
    for (const Triangle& t : done_)
        if (changed_[t.page] != 0) made.triangles[first[t.page]++] = t.corners;
    std::vector<std::uint32_t> number(vertices_.size(), kStraight);
    for (glm::uvec3& t : made.triangles)
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& n = number[t[k]];
            if (n == kStraight) {
                const Vertex& v = vertices_[t[k]];
                n = static_cast<std::uint32_t>(made.positions.size());
                made.positions.push_back(v.end.position);
                made.normals.push_back(v.end.normal);
                made.branches.push_back(v.owner.branch);
                made.dominance.push_back(v.owner.dominance);
                if (mesh_.has_values()) values.push_back(v.value);
            }
            t[k] = n;
        }
}

} // namespace ramus::render
