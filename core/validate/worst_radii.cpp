#include "core/validate/worst_radii.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace ramus::validate {

namespace {

double error_at(const RadiusPlace& place) { return std::abs(place.surface_mm - place.input_mm) / place.input_mm; }

} // namespace

std::vector<BranchError> worst_branches(const Validation& found, std::size_t most) {
    std::vector<BranchError> branches;
    const std::vector<RadiusPlace>& places = found.radii;
    for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
        BranchError branch{places[first].branch, first, 0, places.size(), -1.0};
        for (end = first; end < places.size() && places[end].branch == branch.branch; ++end) {
            if (!places[end].alone || error_at(places[end]) <= branch.error) continue;
            branch.worst = end;
            branch.error = error_at(places[end]);
        }
        branch.count = end - first;
        if (branch.worst < places.size()) branches.push_back(branch);
    }
    std::ranges::stable_sort(branches, std::greater<>(), &BranchError::error);
    if (branches.size() > most) branches.resize(most);
    return branches;
}

const RadiusPlace* nearest_place(const Validation& found, const glm::dvec3& at) {
    const auto nearest = std::ranges::min_element(found.radii, {}, [&](const RadiusPlace& place) {
        const glm::dvec3 way = place.at - at;
        return glm::dot(way, way);
    });
    return nearest == found.radii.end() ? nullptr : &*nearest;
}

} // namespace ramus::validate
