// Named numbers that the file of a tree gives, besides its geometry: flow, pressure, ids of another program. A list of
// arrays belongs to points or to branches (of a graph: to edges), and every operation that derives a tree from a tree
// carries both.
//
// Guarantees: a point that stays keeps its values; a point that is put between two others has the linear interpolation
// of their values. A branch that is made of parts of others has their common value; where they differ, the mean by
// length, or the value of the greatest length where all values of the array are whole numbers (such as ids, of which no
// mean makes sense). What nothing is known of is kUnknownValue.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace ramus::tree {

inline constexpr double kUnknownValue = std::numeric_limits<double>::quiet_NaN();
[[nodiscard]] inline bool is_known(double value) { return std::isfinite(value); }

inline constexpr std::size_t kMostArrays = 64; // of points and branches together

struct DataArray {
    std::string name;           // unique among all arrays of a tree
    std::vector<double> values; // no unit is claimed; kUnknownValue where there is none
    // Unknown values are equal to each other.
    bool operator==(const DataArray& other) const;
};
using DataArrays = std::vector<DataArray>;

[[nodiscard]] const DataArray* array_named(const DataArrays& arrays, const std::string& name); // null: there is none

// The values at `indices`, in their order; kUnknownValue where an index is negative.
template <class Indices> [[nodiscard]] DataArrays picked(const DataArrays& arrays, const Indices& indices) {
    DataArrays some;
    for (const DataArray& array : arrays) {
        some.push_back({array.name, {}});
        some.back().values.reserve(indices.size());
        for (const auto index : indices)
            some.back().values.push_back(std::cmp_less(index, 0) ? kUnknownValue
                                                                 : array.values[static_cast<std::size_t>(index)]);
    }
    return some;
}

// Add one value to each array.
void append_between(DataArrays& arrays, std::size_t a, std::size_t b, double share); // of the way from `a` to `b`
void append_copy(DataArrays& arrays, std::size_t of);
void append_unknown(DataArrays& arrays);

// What is known of an array: how many values, the least and the largest.
struct DataRange {
    std::size_t known = 0, unknown = 0;
    double least = kUnknownValue, largest = kUnknownValue;
};
[[nodiscard]] DataRange range_of(const DataArray& array);

} // namespace ramus::tree
