// Computes data of branches (core/tree/data_array.h) from data of the segments, edges or points that form the branches.
#pragma once

#include "core/tree/build_tree.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::tree {

// One value for each branch of `tree`. `sources`: by segment of `tree` (branches in order, segments along each), the
// index of its value in each array; negative: unknown.
[[nodiscard]] DataArrays branch_data(const VesselTree& tree, std::span<const int> sources, const DataArrays& arrays);

// The same from arrays with one value for each of `edges`, whose points are those of `tree`.
[[nodiscard]] DataArrays branch_data_of_edges(const VesselTree& tree, const std::vector<Edge>& edges,
                                              const DataArrays& arrays);

// The mean of an array of points along a branch, weighted by length, over known values; kUnknownValue if there are
// none.
[[nodiscard]] double mean_of(const VesselTree& tree, const DataArray& of_points, int branch);

// All data of a branch by name: the means of point arrays, then the values of branch arrays.
[[nodiscard]] std::vector<std::pair<std::string, double>> data_of(const VesselTree& tree, int branch);

} // namespace ramus::tree
