// Reads a table of further numbers for branches (`--data`): a CSV file whose first line names the columns. The column
// "branch", "branch_id" or "id", else the first one, has the ids of the branches. Every other column of numbers becomes
// an array of branch data. Branches without a row have unknown values.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct BranchTable {
    tree::DataArrays arrays;           // a value for each branch
    std::vector<std::string> left_out; // names of columns that are not numbers
    std::size_t rows = 0;
};

// Parses the table for a tree of `branches` branches. Fails, with file and line, on an id that the tree does not have
// or that is there twice, on a row of another length than the first, on numbers with a decimal comma, and if no column
// has numbers.
[[nodiscard]] Result<BranchTable> parse_branch_table(std::string_view text, const std::string& name,
                                                     std::size_t branches);

// Adds the arrays of the file `options.data` to the tree, with a note. Does nothing if it names no file. Fails like
// parse_branch_table(), and if the checksum of the file is not options.data_checksum.
[[nodiscard]] Result<void> join_branch_table(tree::VesselTree& tree, const ReadOptions& options);

} // namespace ramus::io
