// Tables of further numbers of branches, which a person joins to a tree: a CSV file whose first line names its columns.
// The ids of branches stand in the column "branch", "branch_id" or "id", else in the first; every other column of
// numbers becomes an array of branches. Branches that the table leaves out are unknown.
#pragma once

#include "core/io/trees/imported_tree.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct BranchTable {
    tree::DataArrays arrays;           // with a value for each branch
    std::vector<std::string> left_out; // columns that are no numbers
    std::size_t rows = 0;
};

// Of a tree of so many branches. Fails, with file and line, on ids that are no ids of it or stand there twice, rows of
// another length than the first, numbers with a decimal comma, and where no column has numbers.
[[nodiscard]] Result<BranchTable> parse_branch_table(std::string_view text, const std::string& name,
                                                     std::size_t branches);

// Adds what `options.data` has to the tree, with a note; nothing where it names no file. Fails as parse_branch_table,
// and where the file is not the one that options.data_checksum is of.
[[nodiscard]] Result<void> join_branch_table(tree::VesselTree& tree, const ReadOptions& options);

} // namespace ramus::io
