// DataArray: a named array of numbers that a file gives for the points or branches of a tree (for a graph: its edges),
// such as flow, pressure, or ids of another program. Every operation that derives a tree from a tree keeps both lists.
//
// Guarantees: a point that stays keeps its values; a new point between two others has the linear interpolation of their
// values. A branch made of parts of other branches has their common value. Where the values differ it has the mean
// weighted by length; if all values of the array are whole numbers (such as ids), it has the value with the greatest
// length. Unknown values are kUnknownValue.
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
    std::vector<double> values; // in the file's unit, which is not known; kUnknownValue: no value
    // Unknown values are equal to each other.
    bool operator==(const DataArray& other) const;
};
using DataArrays = std::vector<DataArray>;

[[nodiscard]] const DataArray* array_named(const DataArrays& arrays, const std::string& name); // null: not found

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

// The numbers of known and unknown values of an array, and the least and largest known value.
struct DataRange {
    std::size_t known = 0, unknown = 0;
    double least = kUnknownValue, largest = kUnknownValue;
};
[[nodiscard]] DataRange range_of(const DataArray& array);

} // namespace ramus::tree
