// Named numbers (core/tree/data_array.h) in the files of trees: columns of tables, and what is kept of what a file
// gives. Readers put arrays into the graph of an ImportedTree as they stand in the file; settle_data() decides.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Columns of a table as they come, row by row. A column where a cell is no number is no array.
class DataColumns {
public:
    explicit DataColumns(std::vector<std::string> names = {});
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    // One for each column. An empty cell, "nan" and "NA" are unknown.
    void add_row(std::span<const std::string_view> cells);
    // The columns of numbers; the names of the others are added to `left_out`.
    [[nodiscard]] tree::DataArrays arrays(std::vector<std::string>& left_out) const;

private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> values_;
    std::vector<std::uint8_t> is_text_;
};

// Values that come one by one, of points or edges that do not all have them.
class SparseData {
public:
    static constexpr std::size_t kNoArray = std::numeric_limits<std::size_t>::max();
    // The array with this name, a new one if there is none yet; kNoArray where there are kMostArrays already.
    [[nodiscard]] std::size_t array(std::string_view name);
    // `index`: of a point or an edge; nothing happens to kNoArray.
    void set(std::size_t array, std::size_t index, double value);
    // With `count` values each. Notes that there were too many.
    [[nodiscard]] tree::DataArrays arrays(std::size_t count, ImportedTree& imported) &&;

private:
    tree::DataArrays arrays_;
    bool too_many_ = false;
};

// The value of a cell; an unknown one is kUnknownValue. None: it is no number.
[[nodiscard]] std::optional<double> data_value(std::string_view cell);

// Checks that arrays have a value for each point or edge, gives each a printable name of its own, sorts them by it, and
// leaves out what is known of nothing, and what is beyond kMostArrays. What is left out is noted, with what the reader
// left out.
[[nodiscard]] Result<void> settle_data(ImportedTree& imported);

// The names of a tree's arrays in a file whose format gives some names (`taken`, in small letters) a meaning: those get
// "_data" behind them.
[[nodiscard]] std::string name_in_file(const std::string& name, std::span<const std::string_view> taken);

} // namespace ramus::io
