#include "core/tree/data_array.h"

#include <algorithm>

namespace ramus::tree {

bool DataArray::operator==(const DataArray& other) const {
    return name == other.name && std::ranges::equal(values, other.values, [](double a, double b) {
               return a == b || (!is_known(a) && !is_known(b));
           });
}

const DataArray* array_named(const DataArrays& arrays, const std::string& name) {
    const auto found = std::ranges::find(arrays, name, &DataArray::name);
    return found == arrays.end() ? nullptr : &*found;
}

void append_between(DataArrays& arrays, std::size_t a, std::size_t b, double share) {
    for (DataArray& array : arrays) array.values.push_back(std::lerp(array.values[a], array.values[b], share));
}

void append_copy(DataArrays& arrays, std::size_t of) {
    for (DataArray& array : arrays) array.values.push_back(array.values[of]);
}

void append_unknown(DataArrays& arrays) {
    for (DataArray& array : arrays) array.values.push_back(kUnknownValue);
}

DataRange range_of(const DataArray& array) {
    DataRange range;
    for (const double value : array.values) {
        if (!is_known(value)) {
            ++range.unknown;
            continue;
        }
        if (range.known++ == 0) range.least = range.largest = value;
        range.least = std::min(range.least, value), range.largest = std::max(range.largest, value);
    }
    return range;
}

} // namespace ramus::tree
