// Collects the data arrays (core/tree/data_array.h) of a tree file: named numbers for points and edges. Readers collect
// all arrays of a file with DataColumns or SparseData; settle_data() then decides which of them the tree keeps.
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

// Collects the columns of a table row by row. A column with a cell that is no number does not become an array.
class DataColumns {
public:
    explicit DataColumns(std::vector<std::string> names = {});
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    // The cells of a row, in the order of names(). See data_value() for unknown values.
    void add_row(std::span<const std::string_view> cells);
    // The columns of numbers; the names of the others are added to `left_out`.
    [[nodiscard]] tree::DataArrays arrays(std::vector<std::string>& left_out) const;

private:
    std::vector<std::string> names_;
    std::vector<std::vector<double>> values_;
    std::vector<std::uint8_t> is_text_;
};

// Collects single values for points or edges that do not all have them.
class SparseData {
public:
    static constexpr std::size_t kNoArray = std::numeric_limits<std::size_t>::max();
    // The index of the array with this name; creates it if needed. kNoArray: there are kMostArrays already.
    [[nodiscard]] std::size_t array(std::string_view name);
    // `index`: of a point or an edge. Does nothing if `array` is kNoArray.
    void set(std::size_t array, std::size_t index, double value);
    // All arrays, with `count` values each. Adds a note to `imported` if there were too many arrays.
    [[nodiscard]] tree::DataArrays arrays(std::size_t count, ImportedTree& imported) &&;

private:
    tree::DataArrays arrays_;
    bool too_many_ = false;
};

// The value of a cell. kUnknownValue: empty, "NA", "n/a", "null", "none", or not finite. None: it is no number.
[[nodiscard]] std::optional<double> data_value(std::string_view cell);

// Makes the names of the arrays printable and unique, sorts the arrays by name, and removes arrays without a known
// value and those beyond kMostArrays. Notes the arrays beyond kMostArrays, and those that the reader left out. Fails if
// an array does not have one value for each point or edge.
[[nodiscard]] Result<void> settle_data(ImportedTree& imported);

// The name of an array in a file whose format gives the lower-case names `taken` a meaning: these get the suffix
// "_data".
[[nodiscard]] std::string name_in_file(const std::string& name, std::span<const std::string_view> taken);

} // namespace ramus::io
