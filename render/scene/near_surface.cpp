#include "render/scene/near_surface.h"

#include "render/scene/bent_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <unordered_map>

namespace ramus::render {

namespace {

constexpr int kMostDivisions = 6; // of an edge, each into two
constexpr std::uint32_t kStraight = std::numeric_limits<std::uint32_t>::max();

// Of how many pixels a mm is, for lengths across the line of sight, of an edge whose middle is at `depth`. One that the
// eye is closer to than half its length is seen from there.
float pixels_at(const NearView& view, float depth, float edge_length) {
    return view.flat ? view.pixels : view.pixels / std::max(depth, 0.5F * edge_length);
}

// No edge of the page bends more in the picture than that, pixels.
float most_bend_in_picture(const TrianglePage& page, const NearView& view) {
    const glm::vec3 towards_eye(view.forward.x > 0.0F ? page.lower.x : page.upper.x,
                                view.forward.y > 0.0F ? page.lower.y : page.upper.y,
                                view.forward.z > 0.0F ? page.lower.z : page.upper.z);
    const float depth = glm::dot(towards_eye - view.eye, view.forward);
    return kMostBend * page.longest_edge * pixels_at(view, depth, page.longest_edge);
}

// How far a branch is behind at a vertex, in steps of Dominance: as share() of border.geom.
int behind(std::int32_t branch, const field::Dominance& dominance, std::uint8_t mark) {
    if ((static_cast<std::uint32_t>(branch) & 255U) == mark) return 0;
    return std::max<int>(dominance.rivals[0] == mark ? dominance.over[0] : dominance.over[1], 1);
}

struct Owner {
    std::int32_t branch;
    field::Dominance dominance;
};

// Whose the middle of an edge is, and how clearly: between its ends logarithms of shares are linear, so that borders
// run where they did.
Owner owner_between(const Owner& a, const Owner& b) {
    const std::array<std::int32_t, 2> ends{a.branch, b.branch};
    std::array<std::uint8_t, 6> marks{};
    std::array<int, 6> sums{}; // twice how far behind
    std::size_t count = 0;
    const auto add = [&](std::uint8_t mark) {
        if (std::find(marks.begin(), marks.begin() + static_cast<std::ptrdiff_t>(count), mark) !=
            marks.begin() + static_cast<std::ptrdiff_t>(count))
            return;
        sums.at(count) = behind(a.branch, a.dominance, mark) + behind(b.branch, b.dominance, mark);
        marks.at(count++) = mark;
    };
    for (const std::int32_t branch : ends) add(static_cast<std::uint8_t>(static_cast<std::uint32_t>(branch) & 255U));
    for (const Owner* end : {&a, &b})
        for (const std::uint8_t rival : end->dominance.rivals) add(rival);
    const bool first_leads = ends[0] == ends[1] || count < 2 || sums[0] <= sums[1];
    const std::size_t leader = first_leads ? 0 : 1;
    Owner between{ends.at(leader), {{255, 255}, {0, 0}}};
    for (std::size_t place = 0; place < 2; ++place) { // the two that come next
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < count; ++i) {
            const bool taken = i == leader || (place == 1 && marks.at(i) == between.dominance.rivals[0]);
            if (!taken && (!next || sums.at(i) < sums.at(*next))) next = i;
        }
        if (!next) break;
        between.dominance.rivals.at(place) = marks.at(*next);
        between.dominance.over.at(place) =
            static_cast<std::uint8_t>(std::clamp((sums.at(*next) - sums.at(leader) + 1) / 2, 0, 255));
    }
    return between;
}

EdgeEnd end_of(const GpuVertex& v) {
    const glm::vec3 normal(v.normal[0], v.normal[1], v.normal[2]);
    const float length = glm::length(normal);
    return {v.position, length > 0.0F ? normal / length : glm::vec3(0.0F)};
}

// Corners of the page's triangles whose normals are not those of a smooth surface that the triangles are inscribed in:
// on creases, and beside walls between vessels.
std::vector<std::uint32_t> creased_corners(const PagedMesh& mesh, const TrianglePage& page) {
    // Of a triangle with its normals. Tuned: with 16 cells around a vessel, one vertex of two hundred at a fork is
    // beyond it, and with a wider one walls are crossed that part vessels.
    constexpr float kLeastCosine = 0.9F;
    constexpr float kLeastHeight = 0.001F; // of its longest edge: what is thinner faces any way
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < page.count; ++i) {
        const glm::uvec3& t = page.triangles[i];
        const std::array<EdgeEnd, 3> ends{end_of(mesh.vertex(t.x)), end_of(mesh.vertex(t.y)), end_of(mesh.vertex(t.z))};
        const glm::vec3 ab = ends[1].position - ends[0].position, ac = ends[2].position - ends[0].position;
        const glm::vec3 across = glm::cross(ab, ac);
        if (glm::length(across) <= kLeastHeight * std::max(glm::dot(ab, ab), glm::dot(ac, ac))) continue;
        const float least = kLeastCosine * glm::length(across);
        for (int k = 0; k < 3; ++k)
            if (glm::dot(across, ends.at(std::size_t(k)).normal) < least) found.push_back(t[k]);
    }
    return found;
}

// By vertex of the mesh: creased corners, and what is no more than some triangles away.
using Creased = std::vector<std::uint8_t>;
Creased creased_vertices(const PagedMesh& mesh, const std::vector<std::size_t>& pages) {
    std::vector<std::vector<std::uint32_t>> found(pages.size());
    Creased creased(pages.empty() ? 0 : mesh.vertex_pages().size() * VertexPage::kSize, 0);
    constexpr int kRings = 2;
    const auto mark_found = [&](const auto& find) {
        tbb::parallel_for(std::size_t{0}, pages.size(),
                          [&](std::size_t i) { found[i] = find(*mesh.triangle_pages()[pages[i]]); });
        for (const auto& some : found)
            for (const std::uint32_t vertex : some) creased[vertex] = 1;
    };
    mark_found([&](const TrianglePage& page) { return creased_corners(mesh, page); });
    for (int ring = 0; ring < kRings; ++ring)
        mark_found([&](const TrianglePage& page) {
            std::vector<std::uint32_t> beside;
            for (std::uint32_t i = 0; i < page.count; ++i) {
                const glm::uvec3& t = page.triangles[i];
                if (creased[t.x] + creased[t.y] + creased[t.z] > 0) beside.insert(beside.end(), {t.x, t.y, t.z});
            }
            return beside;
        });
    return creased;
}

// Which edges are divided: those that one can see to be straight.
struct EdgeDivision {
    const NearView& view;
    float most_off; // kMostOffOutline, or more

    [[nodiscard]] bool operator()(const EdgeEnd& a, const EdgeEnd& b) const {
        const glm::vec3 from_eye = 0.5F * (a.position + b.position) - view.eye;
        const float length = glm::distance(a.position, b.position), depth = glm::dot(from_eye, view.forward);
        const float pixels = pixels_at(view, depth, length);
        if (depth < -length || kMostBend * length * pixels <= most_off) return false;
        const glm::vec3 bend = bend_of(a, b), sight = view.flat ? view.forward : glm::normalize(from_eye);
        return pixels * glm::length(bend - glm::dot(bend, sight) * sight) > most_off;
    }
    // Whether one of a page is, both ends of which may be bent to: straight(number) says which vertices are not.
    template <class Straight>
    [[nodiscard]] bool any(const PagedMesh& mesh, const TrianglePage& page, const Straight& straight) const {
        return std::any_of(page.triangles.begin(), page.triangles.begin() + page.count, [&](const glm::uvec3& t) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i], b = t[(i + 1) % 3];
                if (!straight(a) && !straight(b) && (*this)(end_of(mesh.vertex(a)), end_of(mesh.vertex(b))))
                    return true;
            }
            return false;
        });
    }
};

// Divides the triangles of one page.
class PageDivision {
public:
    // What is referred to outlasts it.
    PageDivision(const PagedMesh& mesh, const Creased& creased, const EdgeDivision& is_divided)
        : mesh_(mesh), creased_(creased), is_divided_(is_divided) {}

    // False: there is nothing to divide, and nothing is made.
    bool divide(const TrianglePage& page) {
        if (!is_divided_.any(mesh_, page, [&](std::uint32_t vertex) { return creased_[vertex] != 0; })) return false;
        for (std::uint32_t i = 0; i < page.count; ++i) {
            const glm::uvec3& t = page.triangles[i];
            add({corner(t.x), corner(t.y), corner(t.z)}, 0);
        }
        return true;
    }

    mesh::TriangleMesh made;
    std::vector<float> values; // none where the mesh has none

private:
    std::uint32_t corner(std::uint32_t number) {
        const auto [at, is_new] = corners_.try_emplace(number, static_cast<std::uint32_t>(made.positions.size()));
        if (!is_new) return at->second;
        const GpuVertex& v = mesh_.vertex(number);
        append(end_of(v), {v.branch, v.dominance}, mesh_.has_values() ? mesh_.value(number) : kNotKnown);
        creases_.back() = creased_[number];
        return at->second;
    }
    void append(const EdgeEnd& end, const Owner& owner, float value) {
        made.positions.push_back(end.position);
        made.normals.push_back(end.normal);
        made.branches.push_back(owner.branch);
        made.dominance.push_back(owner.dominance);
        creases_.push_back(0);
        if (mesh_.has_values()) values.push_back(value);
    }
    // The vertex in the middle of an edge; kStraight: it stays as it is.
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
        const auto [at, is_new] = middles_.try_emplace(key, kStraight);
        if (!is_new) return at->second;
        const EdgeEnd one{made.positions[a], made.normals[a]}, other{made.positions[b], made.normals[b]};
        if (creases_[a] + creases_[b] > 0 || !is_divided_(one, other)) return kStraight;
        at->second = static_cast<std::uint32_t>(made.positions.size());
        const float value = mesh_.has_values() ? value_between(values[a], values[b]) : kNotKnown;
        append(middle_of(one, other),
               owner_between({made.branches[a], made.dominance[a]}, {made.branches[b], made.dominance[b]}), value);
        return at->second;
    }
    static float value_between(float a, float b) {
        return std::min(a, b) > 0.5F * kNotKnown ? 0.5F * (a + b) : kNotKnown;
    }

    // An edge is divided as often in each of the triangles that share it: what of it is in a triangle has been divided
    // `depth` times.
    void add(const glm::uvec3& t, int depth) {
        glm::uvec3 m(kStraight);
        if (depth < kMostDivisions)
            for (int i = 0; i < 3; ++i) m[i] = middle(t[i], t[(i + 1) % 3]);
        const auto count = (m.x != kStraight ? 1 : 0) + (m.y != kStraight ? 1 : 0) + (m.z != kStraight ? 1 : 0);
        if (count == 0) return made.triangles.push_back(t);
        if (count == 3) {
            for (int i = 0; i < 3; ++i) add({t[i], m[i], m[(i + 2) % 3]}, depth + 1);
            return add(m, depth + 1);
        }
        int first = 0; // the divided edge, or the one of two that comes before the other
        while (m[first] == kStraight || (count == 2 && m[(first + 1) % 3] == kStraight)) ++first;
        const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
        const std::uint32_t ab = m[first], bc = m[(first + 1) % 3];
        if (count == 1) {
            add({a, ab, c}, depth + 1);
            return add({ab, b, c}, depth + 1);
        }
        add({ab, b, bc}, depth + 1);
        add({a, ab, bc}, depth + 1);
        add({a, bc, c}, depth + 1);
    }

    const PagedMesh& mesh_;
    const Creased& creased_;
    const EdgeDivision& is_divided_;
    std::vector<std::uint8_t> creases_;                        // as `creased`, of what is made
    std::unordered_map<std::uint32_t, std::uint32_t> corners_; // by vertex of the mesh
    std::unordered_map<std::uint64_t, std::uint32_t> middles_; // by the ends of an edge, the lower first
};

std::vector<std::size_t> pages_to_look_at(const PagedMesh& mesh, const NearView& view, float most_off) {
    std::vector<std::size_t> pages;
    // A little beyond the picture: views of it that are shifted show the same.
    constexpr double kWithin = 0.98;
    const glm::dmat4 to_clip = glm::scale(glm::dmat4(1.0), {kWithin, kWithin, 1.0}) * view.to_clip;
    for (std::size_t i = 0; i < mesh.triangle_pages().size(); ++i) {
        const TrianglePage& page = *mesh.triangle_pages()[i];
        if (page.count > 0 && most_bend_in_picture(page, view) > most_off &&
            in_picture(page.lower, page.upper, to_clip))
            pages.push_back(i);
    }
    return pages;
}

// Those of some pages that have an edge to divide, beside a crease or not: from afar none has, which is told without
// looking for creases.
std::vector<std::size_t> pages_to_divide(const PagedMesh& mesh, const std::vector<std::size_t>& pages,
                                         const EdgeDivision& is_divided) {
    std::vector<std::uint8_t> any(pages.size());
    tbb::parallel_for(std::size_t{0}, pages.size(), [&](std::size_t i) {
        any[i] = is_divided.any(mesh, *mesh.triangle_pages()[pages[i]], [](std::uint32_t) { return false; }) ? 1 : 0;
    });
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < pages.size(); ++i)
        if (any[i] != 0) found.push_back(pages[i]);
    return found;
}

template <class T> void append_all(LargeArray<T>& to, const LargeArray<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// One after the other.
NearSurface together(const PagedMesh& mesh, const std::vector<std::size_t>& pages,
                     const std::vector<std::optional<PageDivision>>& divisions) {
    NearSurface surface;
    surface.replaced.assign(mesh.triangle_pages().size(), 0);
    mesh::TriangleMesh all;
    std::vector<float> values;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        if (!divisions[i]) continue;
        surface.replaced[pages[i]] = 1;
        const mesh::TriangleMesh& made = divisions[i]->made;
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        append_all(all.positions, made.positions);
        append_all(all.normals, made.normals);
        append_all(all.branches, made.branches);
        append_all(all.dominance, made.dominance);
        for (const glm::uvec3& t : made.triangles) all.triangles.push_back(t + first);
        values.insert(values.end(), divisions[i]->values.begin(), divisions[i]->values.end());
    }
    if (all.triangles.empty()) return surface;
    PagedMesh paged(all, glm::dvec3(0.0));
    surface.mesh = std::make_shared<const PagedMesh>(mesh.has_values() ? paged.with_values(values) : std::move(paged));
    return surface;
}

} // namespace

NearView near_view(const Camera& camera, const glm::dvec3& origin, const glm::dmat4& to_clip, int height) {
    // In perspective, mm across the line of sight at a depth of 1 mm.
    const double mm = camera.orthographic ? mm_per_pixel(camera, {height, height})
                                          : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / height;
    return {glm::vec3(camera.position - origin), glm::vec3(axes_of(camera).forward), static_cast<float>(1.0 / mm),
            camera.orthographic, glm::translate(to_clip, origin)};
}

NearSurface near_surface(const PagedMesh& mesh, const NearView& view, const NearLimits& most) {
    for (float most_off = kMostOffOutline;; most_off *= 2.0F) {
        const std::vector<std::size_t> pages = pages_to_look_at(mesh, view, most_off);
        std::size_t looked_at = 0;
        for (const std::size_t page : pages) looked_at += mesh.triangle_pages()[page]->count;
        if (looked_at > most.looked_at) continue;
        const EdgeDivision is_divided{view, most_off};
        const std::vector<std::size_t> divided = pages_to_divide(mesh, pages, is_divided);
        if (divided.empty()) return {};
        const Creased creased = creased_vertices(mesh, pages);
        std::vector<std::optional<PageDivision>> divisions(divided.size());
        tbb::parallel_for(std::size_t{0}, divided.size(), [&](std::size_t i) {
            PageDivision division(mesh, creased, is_divided);
            if (division.divide(*mesh.triangle_pages()[divided[i]])) divisions[i].emplace(std::move(division));
        });
        std::size_t triangles = 0;
        for (const auto& division : divisions) triangles += division ? division->made.triangles.size() : 0;
        if (triangles <= most.made) return together(mesh, divided, divisions);
    }
}

} // namespace ramus::render
