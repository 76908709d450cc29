// Reads tables of numbers from HDF5 files, in a separate process (core/base/own_process.h).
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

// Reads the two-dimensional datasets `names` of the root group. `file`: the bytes of the file; `where`: its name in
// messages. A missing dataset has present = false. Fails on anything but plain integers and floats in the file itself,
// and on declared sizes that the file cannot hold.
[[nodiscard]] Result<std::vector<Hdf5Table>>
read_hdf5_tables(std::string_view file, const std::vector<std::string>& names, const std::string& where);

} // namespace ramus::io
