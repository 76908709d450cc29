#include "core/io/inflate.h"
#include "core/io/input_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/csv_pair.h"
#include "core/io/trees/csv_rows.h"
#include "core/io/trees/node_graph.h"

#include <algorithm>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNodeWords[] = {"vertices", "nodes", "vertex", "node", "points"};
constexpr std::string_view kEdgeWords[] = {"edges", "edge", "segments", "links"};

// `word` with the capitalisation of `like`.
std::string in_case_of(std::string_view like, std::string word) {
    const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
    const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    const bool all = std::ranges::all_of(like, is_upper);
    for (std::size_t c = 0; c < word.size(); ++c)
        if (all || (c == 0 && is_upper(like.front()))) word[c] = upper(word[c]);
    return word;
}

// One of the two tables.
struct CsvTable {
    std::string text, name;
    std::vector<std::string> columns;
};

Result<std::vector<std::string>> columns_in(std::string_view text, const std::string& name) {
    CsvRows rows(text, name);
    std::vector<std::string_view> cells;
    RAMUS_TRY(any, rows.next(cells));
    if (!any) return fail("the file is empty", name, "choose another file");
    return std::vector<std::string>(cells.begin(), cells.end());
}

Result<CsvTable> other_table(const TreeInput& input, bool nodes) {
    const std::string what = nodes ? "edges" : "nodes";
    if (input.path.empty())
        return fail("this is a table of " + std::string(nodes ? "nodes" : "edges") + ", the one of " + what +
                        " stands in another file",
                    input.name, "name its file, where both lie");
    const std::vector<fs::path> names = partner_names(input.path, nodes);
    const auto found = std::ranges::find_if(names, [](const fs::path& path) {
        std::error_code error;
        return fs::exists(path, error);
    });
    if (found == names.end())
        return fail("the table of " + what + " that belongs to it is missing", input.name,
                    "put it beside this one as " + names.front().filename().string());
    CsvTable table{{}, found->string(), {}};
    RAMUS_TRY(text, read_file(*found));
    if (is_gzip(text)) {
        RAMUS_TRY(plain, inflated(text, inflation_limit(text.size()), table.name));
        text = std::move(plain);
    }
    table.text = std::move(text);
    RAMUS_TRY(columns, columns_in(table.text, table.name));
    table.columns = std::move(columns);
    return table;
}

// Calls `take` with the cells of each row that `columns` selects.
template <class Row, class Columns, class Take>
Result<void> for_each_row(std::string_view text, const std::string& name, const Columns& columns, const Take& take) {
    CsvRows rows(text, name);
    std::vector<std::string_view> cells, data(columns.data.at.size());
    std::size_t width = 0;
    for (bool first = true;; first = false) {
        RAMUS_TRY(more, rows.next(cells));
        if (!more) return {};
        if (first) {
            width = cells.size();
            continue;
        }
        if (cells.size() == width + 1 && cells.back().empty()) cells.pop_back(); // a separator at the end
        if (cells.size() != width)
            return fail("the row has " + counted(cells.size(), "cell") + ", the first line names " +
                            counted(width, "column"),
                        rows.place(), "the file is incomplete or damaged; get it again");
        Row row{};
        for (std::size_t c = 0; c < columns.at.size(); ++c)
            if (columns.at[c] < cells.size()) row[c] = cells[columns.at[c]];
        for (std::size_t d = 0; d < data.size(); ++d) data[d] = cells[columns.data.at[d]];
        if (auto good = take(row, rows.line(), data); !good) return good;
    }
}

} // namespace

std::vector<fs::path> partner_names(const fs::path& path, bool nodes) {
    const std::string file = path.filename().string(), lower = lower_case(file);
    const std::size_t dot = lower.ends_with(".gz") ? lower.rfind('.', lower.size() - 4) : lower.rfind('.');
    const std::string stem = file.substr(0, dot), ending = dot == std::string::npos ? "" : file.substr(dot);
    std::vector<std::string> stems;
    const auto add = [&](const std::string& one) {
        if (!one.empty() && one != stem && std::ranges::find(stems, one) == stems.end()) stems.push_back(one);
    };
    const auto replace = [&](const auto& own, const auto& others) {
        for (const std::string_view word : own) {
            const std::size_t at = lower.substr(0, stem.size()).rfind(word);
            if (at == std::string::npos) continue;
            const std::string before = stem.substr(0, at), after = stem.substr(at + word.size());
            for (const std::string_view other : others)
                add(before + in_case_of(stem.substr(at, word.size()), std::string(other)) + after);
            if (!nodes && before.size() > 1 && std::string_view("_-. ").find(before.back()) != std::string_view::npos)
                add(before.substr(0, before.size() - 1) + after); // for liver_edges: liver
        }
        for (const std::string_view other : others) add(stem + "_" + std::string(other));
    };
    if (nodes)
        replace(kNodeWords, kEdgeWords);
    else
        replace(kEdgeWords, kNodeWords);
    std::vector<fs::path> paths;
    for (const std::string& one : stems) paths.push_back(path.parent_path() / (one + ending));
    // One of the files may be compressed and the other not.
    const bool packed = lower.ends_with(".gz");
    for (const std::string& one : stems)
        paths.push_back(path.parent_path() / (one + (packed ? ending.substr(0, ending.size() - 3) : ending + ".gz")));
    return paths;
}

bool is_csv_pair(std::string_view head) {
    const auto columns = columns_in(head, {});
    return columns && (has_nodes(node_columns(*columns, {})) || has_edges(edge_columns(*columns, {})));
}

Result<ImportedTree> parse_csv_pair(const TreeInput& input) {
    RAMUS_TRY(columns, columns_in(input.text, input.name));
    const bool is_nodes = has_nodes(node_columns(columns, input.options));
    if (!is_nodes && !has_edges(edge_columns(columns, input.options)))
        return fail(
            "the first line names neither positions of nodes nor the two nodes of an edge", input.name,
            "columns of nodes are called id, pos_x, pos_y, pos_z, those of edges node1id, node2id, avgRadiusAvg");
    RAMUS_TRY(other, other_table(input, is_nodes));
    const std::string_view node_text = is_nodes ? input.text : other.text,
                           edge_text = is_nodes ? other.text : input.text;
    const std::string &node_file = is_nodes ? input.name : other.name, &edge_file = is_nodes ? other.name : input.name;
    NodeGraph graph(input);
    const NodeColumns nodes = node_columns(is_nodes ? columns : other.columns, input.options);
    if (auto good = graph.begin_nodes(nodes, node_file); !good) return tl::unexpected(good.error());
    const auto add_node = [&](const NodeRow& row, std::size_t line, std::span<const std::string_view> data) {
        return graph.add_node(row, line, data);
    };
    if (auto good = for_each_row<NodeRow>(node_text, node_file, nodes, add_node); !good)
        return tl::unexpected(good.error());
    const EdgeColumns edges = edge_columns(is_nodes ? other.columns : columns, input.options);
    if (auto good = graph.begin_edges(edges, edge_file); !good) return tl::unexpected(good.error());
    const auto add_edge = [&](const EdgeRow& row, std::size_t line, std::span<const std::string_view> data) {
        return graph.add_edge(row, line, data);
    };
    if (auto good = for_each_row<EdgeRow>(edge_text, edge_file, edges, add_edge); !good)
        return tl::unexpected(good.error());
    return graph.finish();
}

} // namespace ramus::io
