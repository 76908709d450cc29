#include "core/validate/probe.h"

#include "core/base/across.h"
#include "core/base/bounds.h"
#include "core/base/memory.h"
#include "core/validate/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::validate {

namespace {

constexpr int kRays = 32; // of a cross-section

// Not parallel to an axis or a diagonal, since edges of modelled meshes often are; in all directions.
constexpr std::array<glm::dvec3, 5> kWindingRays{{{0.8506508083520400, 0.4472135954999579, 0.2763932022500210},
                                                  {-0.3090169943749474, 0.7639320225002102, -0.5665277804250000},
                                                  {0.1836034948330000, -0.5257311121191336, 0.8305895421000000},
                                                  {-0.6180339887498949, -0.3819660112501051, 0.6871340000000000},
                                                  {0.4370160244488211, 0.2360679774997897, -0.8679420000000000}}};

} // namespace

Probe::Probe(const mesh::TriangleMesh& surface, std::span<const Place> places)
    : surface_(surface), triangles_(surface) {
    // Frees the scratch memory of packing before the next step needs memory.
    if (surface.triangles.size() >= kWorthReleasing) release_unused_memory();
    const Bounds<glm::vec3> box = box_of_points(surface.positions);
    const glm::dvec3 least(box.least), most(box.most);
    middle_ = 0.5 * (least + most);
    size_ = glm::length(most - least);
    constexpr std::size_t kAsked = 200;
    int turned = 0;
    const std::size_t stride = std::max<std::size_t>(1, places.size() / kAsked);
    for (std::size_t i = 0; i < places.size(); i += stride) {
        const int turns = winding(places[i].at);
        turned += (turns < 0 ? 1 : 0) - (turns > 0 ? 1 : 0);
    }
    if (turned > 0) sign_ = -1;
}

// The winding number of the surface around a place: the median over the rays. If the first three agree, the others are
// not needed.
int Probe::winding(const glm::dvec3& at) const {
    thread_local std::vector<measure::Crossing> found;
    constexpr std::size_t kMost = kWindingRays.size() / 2 + 1;
    std::array<int, kWindingRays.size()> turns{};
    for (std::size_t ray = 0; ray < kWindingRays.size(); ++ray) {
        if (ray == kMost && std::ranges::count(turns.begin(), turns.begin() + kMost, turns[0]) == kMost)
            return turns[0];
        triangles_.crossings(at, glm::normalize(kWindingRays[ray]), size_ + glm::distance(at, middle_), found);
        for (const measure::Crossing& crossing : found) turns[ray] += crossing.out ? sign_ : -sign_;
    }
    std::ranges::nth_element(turns, turns.begin() + turns.size() / 2);
    return turns[turns.size() / 2];
}

// The distance along the ray from a triangle to the curved surface above it. Over the middle of a chord, the surface
// rises by an eighth of the chord's length times the turn of the normal, with a parabolic profile; over a triangle the
// heights of its edges add up.
double Probe::bulge(const measure::Crossing& crossing, const glm::dvec3& from, const glm::dvec3& way) const {
    if (surface_.normals.empty()) return 0.0;
    const glm::uvec3& t = surface_.triangles[crossing.triangle];
    std::array<glm::dvec3, 3> corner, normal;
    for (int k = 0; k < 3; ++k) {
        corner[k] = glm::dvec3(surface_.positions[t[k]]);
        normal[k] = glm::dvec3(surface_.normals[t[k]]);
    }
    const glm::dvec3 at = from + crossing.at * way;
    const glm::dvec3 whole = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double area = glm::dot(whole, whole);
    if (!(area > 0.0)) return 0.0;
    std::array<double, 3> share{};
    for (int k = 0; k < 3; ++k)
        share[k] = glm::dot(glm::cross(corner[(k + 1) % 3] - at, corner[(k + 2) % 3] - at), whole) / area;
    double height = 0.0;
    glm::dvec3 out(0.0);
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        height += 0.5 * share[k] * share[next] * glm::dot(normal[next] - normal[k], corner[next] - corner[k]);
        out += share[k] * normal[k];
    }
    const double slope = glm::dot(out, way) / std::max(glm::length(out), 1e-9);
    const double edge = std::sqrt(std::sqrt(area)); // limits the height at creases, where normals are unreliable
    return std::clamp(height / std::max(std::abs(slope), 0.5), -0.1 * edge, 0.1 * edge);
}

bool Probe::inside(const glm::dvec3& at) const { return winding(at) > 0; }

// The first crossing after which the ray is outside. `turns`: the winding number at the start; `far`: the end of the
// ray. Null if there is none.
const measure::Crossing* Probe::way_out(std::span<const measure::Crossing> crossings, int turns,
                                        const glm::dvec3& far) const {
    for (const measure::Crossing& crossing : crossings) {
        turns -= crossing.out ? sign_ : -sign_;
        if (turns <= 0) return &crossing;
    }
    // Overlapping solids may have a common boundary, as adjacent cones do, which counts as one crossing. Then the
    // winding numbers are counted from the far end.
    const measure::Crossing* first = nullptr;
    int behind = crossings.empty() ? 1 : winding(far);
    if (behind > 0) return nullptr;
    for (std::size_t i = crossings.size(); i-- > 0;) {
        if (behind <= 0) first = &crossings[i];
        behind += crossings[i].out ? sign_ : -sign_;
    }
    return first;
}

CrossSection Probe::cross_section(const glm::dvec3& at, const glm::dvec3& direction, double reach) const {
    thread_local std::vector<measure::Crossing> found;
    CrossSection section;
    section.middle = at;
    const int turns = winding(at);
    if (turns <= 0) return section;
    section.inside = true;
    const auto [side, other] = axes_across(direction);
    constexpr double kTurned = 0.0618034; // rays, too, keep away from edges
    double squares = 0.0, flat_squares = 0.0;
    glm::dvec3 moment(0.0);
    for (int ray = 0; ray < kRays; ++ray) {
        const double angle = kTurned + 2.0 * std::numbers::pi * ray / kRays;
        const glm::dvec3 way = std::cos(angle) * side + std::sin(angle) * other;
        triangles_.crossings(at, way, reach, found);
        double end = reach, more = 0.0;
        if (const measure::Crossing* crossing = way_out(found, turns, at + reach * way)) {
            end = crossing->at;
            more = bulge(*crossing, at, way);
        }
        flat_squares += end * end;
        end += more;
        squares += end * end;
        moment += end * end * end / 3.0 * way;
    }
    section.radius = std::sqrt(squares / kRays);
    section.flat_radius = std::sqrt(flat_squares / kRays);
    if (squares > 0.0) section.middle = at + moment / (0.5 * squares);
    return section;
}

bool Probe::sees(const glm::dvec3& from, const glm::dvec3& to) const {
    thread_local std::vector<measure::Crossing> found;
    const double length = glm::distance(from, to);
    if (!(length > 0.0)) return true;
    triangles_.crossings(from, (to - from) / length, length, found);
    return found.empty();
}

} // namespace ramus::validate
