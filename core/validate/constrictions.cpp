#include "core/base/across.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <vector>

namespace ramus::validate {

namespace {

using RadiusAt = std::function<double(std::size_t)>; // by index of a place

constexpr double kNarrow = 0.1;  // a minimum counts if the vessel is wider by this share on both sides
constexpr double kAllowed = 0.1; // largest difference, in Place::scale
constexpr double kBeside = 1.2;  // a closer vessel affects the measured radius
constexpr double kEnd = 1.5;     // radii; a nearer free end affects the measured radius
constexpr double kVoxels = 2.0;

// The minima of the radius of one branch, between places that are wider by kNarrow.
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

// A place that is narrower by kNarrow than the mean of the radii at some distance before and after it.
struct Dip {
    std::size_t at = 0;
    double depth = 0.0; // the mean over the radius at the place, minus 1; the largest over all distances
    double reach = 0.0; // the distance of the largest depth, mm
    double trend = 0.0; // the mean of the radii at this distance
};

// The deepest dips of one branch, none within the reach of a deeper one. Finds narrow places of tapering vessels, which
// need not be minima.
std::vector<Dip> dips_of(std::span<const Place> places, std::size_t first, const RadiusAt& radius) {
    constexpr double kFarthest = 8.0; // radii of the vessel: half of what a stenosis of five diameters needs, and more
    std::vector<double> radii;
    for (std::size_t i = 0; i < places.size(); ++i) radii.push_back(radius(first + i));
    std::vector<Dip> dips;
    for (std::size_t i = 1; i + 1 < places.size(); ++i) {
        if (!(radii[i] > 0.0)) continue;
        Dip dip{first + i, 0.0, 0.0, 0.0};
        double widest = radii[i];
        for (std::size_t before = i, after = i + 1; after < places.size(); ++after) {
            const double distance = places[after].along - places[i].along;
            while (before > 0 && places[i].along - places[before].along < distance) --before;
            if (places[i].along - places[before].along < distance) break; // the branch begins nearer
            widest = std::max({widest, radii[before], radii[after]});
            if (distance > kFarthest * widest) break;
            const double trend = 0.5 * (radii[before] + radii[after]);
            if (trend > (1.0 + dip.depth) * radii[i]) dip = {first + i, trend / radii[i] - 1.0, distance, trend};
        }
        if (dip.depth >= kNarrow) dips.push_back(dip);
    }
    std::ranges::stable_sort(dips, std::greater<>(), &Dip::depth);
    std::vector<Dip> deepest;
    const auto along = [&](std::size_t at) { return places[at - first].along; };
    for (const Dip& dip : dips)
        if (std::ranges::none_of(deepest, [&](const Dip& deeper) {
                return std::abs(along(dip.at) - along(deeper.at)) <= std::max(dip.reach, deeper.reach);
            }))
            deepest.push_back(dip);
    return deepest;
}

// The mean over half a radius to either side, since meshes of usual coarseness show no shorter features. For a tree of
// voxels at least over kVoxels to either side, since a single voxel is no narrow place.
double around(const Reference& reference, std::size_t first, std::size_t end, std::size_t at, const RadiusAt& radius) {
    const std::vector<Place>& places = reference.places();
    const double reach = std::max(0.5 * places[at].radius, kVoxels * reference.grain_mm());
    double sum = 0.0, length = 0.0;
    for (std::size_t i = at; i < end && places[i].along <= places[at].along + reach; ++i)
        sum += radius(i) * places[i].step, length += places[i].step;
    for (std::size_t i = at; i-- > first && places[i].along >= places[at].along - reach;)
        sum += radius(i) * places[i].step, length += places[i].step;
    return sum / length;
}

// The least radius of several tilted sections through a place: in a bend the section across the chord is oblique.
double narrowest(const Probe& probe, const Place& place) {
    const glm::dvec3& along = place.direction;
    const auto [side, other] = axes_across(along);
    constexpr int kWays = 16;
    const double reach = 4.0 * place.radius;
    double least = probe.cross_section(place.at, along, reach).radius;
    for (const double lean_deg : {15.0, 30.0, 45.0, 60.0})
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

std::vector<Constriction> changed_constrictions(const Reference& reference, std::span<const Section> sections,
                                                std::span<const MovedStretch> moved) {
    const RadiusAt expected = [&](std::size_t i) { return reference.places()[i].radius; };
    const RadiusAt actual = [&](std::size_t i) { return sections[i].through.radius; };
    std::vector<Constriction> found;
    for (std::size_t branch = 0; branch < reference.branches(); ++branch) {
        const std::size_t first = reference.first_of(branch);
        const std::size_t end = first + reference.places_of(branch).size();
        const auto changed = [&](std::size_t i) {
            const Place& place = reference.places()[i];
            if (place.turns || place.beside < kBeside || place.to_end < kEnd * place.radius) return false;
            if (is_moved(moved, place)) return false;
            const double wanted = around(reference, first, end, i, expected);
            const double there = around(reference, first, end, i, actual);
            return std::abs(there - wanted) > kAllowed * place.scale && actual(i) != 0.0;
        };
        std::vector<std::size_t> at;
        for (const std::size_t i : narrow_places(first, end, expected))
            if (changed(i)) at.push_back(i);
        const auto take_dips = [&](const RadiusAt& radius, const auto& counts) {
            for (const Dip& dip : dips_of(reference.places_of(branch), first, radius)) {
                const auto along = [&](std::size_t i) { return reference.places()[i].along; };
                const auto is_it = [&](std::size_t i) { return std::abs(along(i) - along(dip.at)) <= dip.reach; };
                if (counts(dip) && changed(dip.at) && std::ranges::none_of(at, is_it)) at.push_back(dip.at);
            }
        };
        // A filled narrow place is no wider than the vessel next to it. If the surface is wider, it includes something
        // else.
        take_dips(expected, [&](const Dip& dip) { return actual(dip.at) <= (1.0 + kAllowed) * dip.trend; });
        // A narrow place of the surface only. Below half of the radius it is a lost stretch.
        take_dips(actual, [&](const Dip& dip) {
            const double share = actual(dip.at) / expected(dip.at);
            return share < 1.0 - kAllowed && share >= 0.5;
        });
        std::ranges::sort(at);
        for (const std::size_t i : at)
            found.push_back({static_cast<int>(branch), reference.places()[i].at, expected(i), actual(i)});
    }
    return found;
}

} // namespace ramus::validate
