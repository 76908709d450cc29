// Tables of numbers out of HDF5 files.
#pragma once

#include "core/base/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct Hdf5Table {
    bool present = false;
    std::size_t rows = 0, columns = 0;
    std::vector<double> values; // row by row

    [[nodiscard]] double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

// The two-dimensional datasets of these names in the root group, of the file whose bytes are `file`. Fails on anything
// but plain integers and floats that lie in the file itself, and on sizes that the file cannot have.
[[nodiscard]] Result<std::vector<Hdf5Table>>
read_hdf5_tables(std::string_view file, const std::vector<std::string>& names, const std::string& where);

} // namespace ramus::io
