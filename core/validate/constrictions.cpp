#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::validate {

namespace {

constexpr double kNarrow = 0.1;  // a minimum counts where the vessel is wider by this share on both sides of it
constexpr double kAllowed = 0.1; // of the radius
constexpr double kBeside = 1.2;  // closeness of another vessel that changes what is measured
constexpr double kEnd = 1.5;     // radii from a free end, likewise

// The narrowest places of one branch, between places where it is wider by kNarrow.
std::vector<std::size_t> narrow_places(std::size_t first, std::size_t end, const RadiusAt& radius) {
    std::vector<std::size_t> found;
    if (first == end) return found;
    double widest = radius(first); // since the last narrow place
    std::size_t lowest = first;    // since `widest`
    for (std::size_t i = first; i < end; ++i) {
        const double here = radius(i), low = radius(lowest);
        if (here < low) lowest = i;
        if (here >= (1.0 + kNarrow) * radius(lowest) && widest >= (1.0 + kNarrow) * radius(lowest)) {
            found.push_back(lowest);
            widest = here;
            lowest = i;
        }
        if (here > widest) widest = here, lowest = i;
    }
    return found;
}

// The mean over half a radius to either side: what is shorter, no mesh as coarse as is usual can show.
double around(const Reference& reference, std::size_t first, std::size_t end, std::size_t at, const RadiusAt& radius) {
    const std::vector<Place>& places = reference.places();
    const double reach = 0.5 * places[at].radius;
    double sum = 0.0, length = 0.0;
    for (std::size_t i = at; i < end && places[i].along <= places[at].along + reach; ++i)
        sum += radius(i) * places[i].step, length += places[i].step;
    for (std::size_t i = at; i-- > first && places[i].along >= places[at].along - reach;)
        sum += radius(i) * places[i].step, length += places[i].step;
    return sum / length;
}

// The radius of the narrowest of some sections through a place: in a bend the one across its chord is askew.
double narrowest(const Probe& probe, const Place& place) {
    const glm::dvec3& along = place.direction;
    const glm::dvec3 side = glm::normalize(
        glm::cross(along, std::abs(along.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 other = glm::cross(along, side);
    constexpr int kWays = 8;
    const double reach = 4.0 * place.radius;
    double least = probe.cross_section(place.at, along, reach).radius;
    for (const double lean_deg : {15.0, 30.0, 45.0})
        for (int way = 0; way < kWays; ++way) {
            const double lean = lean_deg * std::numbers::pi / 180.0, turn = 2.0 * std::numbers::pi * way / kWays;
            const glm::dvec3 leant =
                std::cos(lean) * along + std::sin(lean) * (std::cos(turn) * side + std::sin(turn) * other);
            least = std::min(least, probe.cross_section(place.at, leant, reach).radius);
        }
    return least;
}

} // namespace

bool is_oblique(const Reference& reference, const Probe& probe, const Constriction& found) {
    if (found.radius_mm <= found.expected_radius_mm) return false;
    const auto branch = static_cast<std::size_t>(found.branch);
    const auto places = reference.places_of(branch);
    const std::size_t first = reference.first_of(branch), end = first + places.size();
    const auto at = static_cast<std::size_t>(std::ranges::find(places, found.at, &Place::at) - places.begin());
    const double wanted =
        around(reference, first, end, first + at, [&](std::size_t i) { return reference.places()[i].radius; });
    const double there = around(reference, first, end, first + at,
                                [&](std::size_t i) { return narrowest(probe, reference.places()[i]); });
    return there <= (1.0 + kAllowed) * wanted;
}

std::vector<Constriction> changed_constrictions(const Reference& reference, const RadiusAt& expected,
                                                const RadiusAt& actual) {
    std::vector<Constriction> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const std::size_t first = reference.first_of(branch);
        const std::size_t end = first + reference.places_of(branch).size();
        for (const std::size_t i : narrow_places(first, end, expected)) {
            const Place& place = reference.places()[i];
            if (place.beside < kBeside || place.to_end < kEnd * place.radius) continue;
            const double wanted = around(reference, first, end, i, expected);
            const double there = around(reference, first, end, i, actual);
            if (std::abs(there - wanted) <= kAllowed * wanted || actual(i) == 0.0) continue;
            found.push_back({place.branch, place.at, expected(i), actual(i)});
        }
    }
    return found;
}

} // namespace ramus::validate
