#include "core/tree/branch_data.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

namespace ramus::tree {

namespace {

// The total length (mm) of each value along one branch.
double settled(const std::map<double, double>& lengths, bool whole) {
    if (lengths.empty()) return kUnknownValue;
    if (whole || lengths.size() == 1)
        return std::ranges::max_element(lengths, {}, [](const auto& one) { return one.second; })->first;
    double sum = 0.0, length = 0.0;
    for (const auto& [value, mm] : lengths) sum += mm * value, length += mm;
    return length > 0.0 ? sum / length : lengths.begin()->first;
}

} // namespace

DataArrays branch_data(const VesselTree& tree, std::span<const int> sources, const DataArrays& arrays) {
    DataArrays result;
    for (const DataArray& array : arrays) {
        const bool whole =
            std::ranges::all_of(array.values, [](double v) { return !is_known(v) || v == std::floor(v); });
        DataArray of_branches{array.name, {}};
        std::size_t segment = 0;
        for (const Branch& branch : tree.branches) {
            std::map<double, double> lengths;
            for (std::size_t i = 1; i < branch.points.size(); ++i, ++segment) {
                const int source = sources[segment];
                const double value = source < 0 ? kUnknownValue : array.values[static_cast<std::size_t>(source)];
                if (is_known(value))
                    lengths[value] += glm::distance(tree.points[branch.points[i - 1]].position,
                                                    tree.points[branch.points[i]].position);
            }
            of_branches.values.push_back(settled(lengths, whole));
        }
        result.push_back(std::move(of_branches));
    }
    return result;
}

double mean_of(const VesselTree& tree, const DataArray& of_points, int branch) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(branch)].points;
    double sum = 0.0, length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double mean = 0.5 * (of_points.values[points[i - 1]] + of_points.values[points[i]]);
        if (!is_known(mean)) continue;
        const double step = glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        sum += step * mean, length += step;
    }
    if (length > 0.0) return sum / length;
    for (const std::uint32_t point : points)
        if (is_known(of_points.values[point])) return of_points.values[point];
    return kUnknownValue;
}

DataArrays branch_data_of_edges(const VesselTree& tree, const std::vector<Edge>& edges, const DataArrays& arrays) {
    if (arrays.empty()) return {};
    using Known = std::tuple<std::uint32_t, std::uint32_t, int>;
    std::vector<Known> known;
    known.reserve(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e)
        known.emplace_back(std::min(edges[e].first, edges[e].second), std::max(edges[e].first, edges[e].second),
                           static_cast<int>(e));
    std::ranges::sort(known);
    std::vector<int> sources;
    for (const Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const auto [low, high] = std::minmax(branch.points[i - 1], branch.points[i]);
            const auto found = std::ranges::lower_bound(known, Known(low, high, 0));
            const bool is_there = found != known.end() && std::get<0>(*found) == low && std::get<1>(*found) == high;
            sources.push_back(is_there ? std::get<2>(*found) : -1);
        }
    return branch_data(tree, sources, arrays);
}

std::vector<std::pair<std::string, double>> data_of(const VesselTree& tree, int branch) {
    std::vector<std::pair<std::string, double>> values;
    for (const DataArray& array : tree.point_data) values.emplace_back(array.name, mean_of(tree, array, branch));
    for (const DataArray& array : tree.branch_data)
        values.emplace_back(array.name, array.values[static_cast<std::size_t>(branch)]);
    return values;
}

} // namespace ramus::tree
