// Arrays of branches (core/tree/data_array.h) from arrays of what the branches are made of.
#pragma once

#include "core/tree/build_tree.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::tree {

// `sources`: by segment of `tree` (branches in order, segments along each) the index of its value in each array;
// negative: none.
[[nodiscard]] DataArrays branch_data(const VesselTree& tree, std::span<const int> sources, const DataArrays& arrays);

// The same, of arrays with a value for each of `edges`, which name points of `tree`.
[[nodiscard]] DataArrays branch_data_of_edges(const VesselTree& tree, const std::vector<Edge>& edges,
                                              const DataArrays& arrays);

// Mean along a branch's length of an array of points, of what is known of it; kUnknownValue: nothing is.
[[nodiscard]] double mean_of(const VesselTree& tree, const DataArray& of_points, int branch);

// All data of a branch by name: of points their mean, then those of branches.
[[nodiscard]] std::vector<std::pair<std::string, double>> data_of(const VesselTree& tree, int branch);

} // namespace ramus::tree
