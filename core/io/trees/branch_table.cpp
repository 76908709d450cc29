#include "core/io/trees/branch_table.h"

#include "core/base/printable.h"
#include "core/io/checksum.h"
#include "core/io/inflate.h"
#include "core/io/input_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/csv_rows.h"
#include "core/io/trees/tree_data.h"

#include <algorithm>
#include <filesystem>

namespace ramus::io {

namespace {

std::size_t id_column(const std::vector<std::string>& names) {
    for (const std::string_view wanted : {"branch", "branch_id", "id"})
        for (std::size_t c = 0; c < names.size(); ++c)
            if (lower_case(names[c]) == wanted) return c;
    return 0;
}

// Whether the text is a number with a decimal comma: "1,5".
bool has_decimal_comma(std::string_view cell) {
    const std::size_t comma = cell.find(',');
    if (comma == std::string_view::npos) return false;
    std::string point(trimmed(cell));
    std::ranges::replace(point, ',', '.');
    return to_real(point).has_value();
}

bool is_there(const tree::VesselTree& tree, const std::string& name) {
    return array_named(tree.point_data, name) != nullptr || array_named(tree.branch_data, name) != nullptr;
}

} // namespace

Result<BranchTable> parse_branch_table(std::string_view text, const std::string& name, std::size_t branches) {
    CsvRows rows(text, name);
    std::vector<std::string_view> cells;
    RAMUS_TRY(any, rows.next(cells));
    if (!any) return fail("the table is empty", name, "its first line names the columns: branch,flow");
    const std::vector<std::string> names(cells.begin(), cells.end());
    if (std::ranges::all_of(names, [](const std::string& cell) { return to_real(cell).has_value(); }))
        return fail("the first line has numbers where the names of the columns should stand", rows.place(),
                    "begin the table with a line as branch,flow");
    if (names.size() < 2)
        return fail("the table has only one column", rows.place(),
                    "the ids of branches and a column of numbers, between commas, semicolons or tabs");
    if (names.size() > tree::kMostArrays + 1)
        return fail("the table has " + counted(names.size(), "column") + ", more than " +
                        std::to_string(tree::kMostArrays) + " beside the ids",
                    rows.place(), "split it");
    const std::size_t ids = id_column(names);
    std::vector<std::string> data_names = names;
    data_names.erase(data_names.begin() + static_cast<std::ptrdiff_t>(ids));
    DataColumns columns(data_names);
    constexpr std::size_t kNoRow = 0;
    std::vector<std::size_t> line_of(branches, kNoRow); // by branch; lines count from 1
    std::vector<int> row_of(branches, -1);
    BranchTable table;
    while (true) {
        RAMUS_TRY(more, rows.next(cells));
        if (!more) break;
        if (cells.size() == names.size() + 1 && cells.back().empty()) cells.pop_back(); // a separator at the end
        if (cells.size() != names.size())
            return fail("the row has " + counted(cells.size(), "cell") + ", the first line names " +
                            counted(names.size(), "column"),
                        rows.place(), "correct the table");
        const auto id = to_whole(trimmed(cells[ids]));
        if (!id || *id < 0)
            return fail("the id " + shown(cells[ids]) + " in the column " + shown(names[ids]) + " is no branch",
                        rows.place(), "ids are whole numbers from 0, as ramus info --branches lists them");
        const auto branch = static_cast<std::size_t>(*id);
        if (branch >= branches)
            return fail("there is no branch " + std::to_string(branch) + " in a tree of " + std::to_string(branches),
                        rows.place(), "ids are those of ramus info --branches; the table may be of another tree");
        if (line_of[branch] != kNoRow)
            return fail("branch " + std::to_string(branch) + " is there twice, first in line " +
                            std::to_string(line_of[branch]),
                        rows.place(), "leave one of the rows out");
        line_of[branch] = rows.line();
        row_of[branch] = static_cast<int>(table.rows++);
        cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(ids));
        for (const std::string_view cell : cells)
            if (has_decimal_comma(cell))
                return fail("the number " + shown(cell) + " has a decimal comma", rows.place(),
                            "write numbers with a decimal point");
        columns.add_row(cells);
    }
    if (table.rows == 0) return fail("the table names no branch", name, "give it a row for each branch");
    tree::DataArrays by_row = columns.arrays(table.left_out);
    std::erase_if(by_row, [](const tree::DataArray& array) { return tree::range_of(array).known == 0; });
    if (by_row.empty()) return fail("no column of the table has numbers", name, "choose another table");
    table.arrays = picked(by_row, row_of);
    return table;
}

Result<void> join_branch_table(tree::VesselTree& tree, const ReadOptions& options) {
    if (options.data.empty()) return {};
    const std::string& name = options.data;
    RAMUS_TRY(text, read_file(name));
    if (!options.data_checksum.empty()) {
        RAMUS_TRY(checksum, sha256_of(name));
        if (checksum != options.data_checksum)
            return fail("the table has changed since the session was saved", name,
                        "read it anew with --data, or remove \"data_checksum\" from the session");
    }
    if (is_gzip(text)) {
        RAMUS_TRY(plain, inflated(text, inflation_limit(text.size()), name));
        text = std::move(plain);
    }
    RAMUS_TRY(table, parse_branch_table(text, name, tree.branches.size()));
    if (tree.point_data.size() + tree.branch_data.size() + table.arrays.size() > tree::kMostArrays)
        return fail("the tree would have more than " + std::to_string(tree::kMostArrays) + " arrays of data", name,
                    "leave columns of the table out");
    std::string list;
    for (tree::DataArray& array : table.arrays) {
        const std::string own = printable(array.name.empty() ? "unnamed" : array.name);
        array.name = own;
        for (int n = 2; is_there(tree, array.name); ++n) array.name = own + "_" + std::to_string(n);
        list += (list.empty() ? "" : ", ") + array.name;
        tree.branch_data.push_back(std::move(array));
    }
    std::string text_of_note = "joined from " + std::filesystem::path(name).filename().string() + ", for " +
                               std::to_string(table.rows) + " of " + std::to_string(tree.branches.size()) +
                               " branches: " + list;
    if (!table.left_out.empty()) {
        text_of_note += "; left out, since they are no numbers: ";
        for (std::size_t n = 0; n < table.left_out.size(); ++n)
            text_of_note += (n > 0 ? ", " : "") + printable(table.left_out[n]);
    }
    tree.notes.push_back({tree::Note::Kind::kAssumed, "data", std::move(text_of_note), {}});
    return {};
}

} // namespace ramus::io
