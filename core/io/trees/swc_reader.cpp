#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/swc.h"
#include "core/io/trees/tree_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <vector>

namespace ramus::io {

namespace {

struct Row {
    std::int64_t id = 0;
    std::int64_t parent = 0;
    int type = 0;
    tree::Point point;
    std::size_t line = 0;
};

constexpr const char* kLayout = "a line is: id type x y z radius parent";

// The column of each of the seven values.
enum SwcValue : std::size_t { kSwcId, kSwcType, kSwcX, kSwcY, kSwcZ, kSwcRadius, kSwcParent, kSwcValueCount };
struct SwcColumns {
    std::array<std::size_t, kSwcValueCount> at{kSwcId, kSwcType, kSwcX, kSwcY, kSwcZ, kSwcRadius, kSwcParent};
    std::size_t count = kSwcValueCount; // of a line
    bool named = false;
    std::vector<std::string> data; // the names of further columns, in their order
    std::vector<std::size_t> data_at;
};

// Lower-case names of columns in files of pandas, navis and CATMAID.
constexpr std::pair<std::string_view, SwcValue> kSwcColumnNames[] = {{"id", kSwcId},
                                                                     {"n", kSwcId},
                                                                     {"node_id", kSwcId},
                                                                     {"point_no", kSwcId},
                                                                     {"pointno", kSwcId},
                                                                     {"type", kSwcType},
                                                                     {"t", kSwcType},
                                                                     {"label", kSwcType},
                                                                     {"x", kSwcX},
                                                                     {"y", kSwcY},
                                                                     {"z", kSwcZ},
                                                                     {"radius", kSwcRadius},
                                                                     {"r", kSwcRadius},
                                                                     {"rad", kSwcRadius},
                                                                     {"parent", kSwcParent},
                                                                     {"pid", kSwcParent},
                                                                     {"parent_id", kSwcParent},
                                                                     {"parent_node_id", kSwcParent}};

// The columns by these names. None: a necessary column is missing. Without a column for it, every radius is 0.
std::optional<SwcColumns> swc_columns_named(const std::vector<std::string_view>& fields) {
    constexpr std::size_t kMissing = 0xFFFFFFFFU;
    SwcColumns columns{{}, fields.size(), true, {}, {}};
    columns.at.fill(kMissing);
    for (std::size_t column = 0; column < fields.size(); ++column) {
        std::string name = lower_case(fields[column]);
        std::erase(name, '"');
        if (const auto value = paired(kSwcColumnNames, std::string_view(name))) {
            columns.at[*value] = column;
            continue;
        }
        std::string own(fields[column]);
        std::erase(own, '"');
        if (columns.data.size() == tree::kMostArrays) continue;
        columns.data.push_back(own);
        columns.data_at.push_back(column);
    }
    for (const std::size_t value : {kSwcId, kSwcX, kSwcY, kSwcZ, kSwcParent})
        if (columns.at[value] == kMissing) return std::nullopt;
    return columns;
}

bool looks_binary(std::string_view text) { return text.substr(0, 4096).find('\0') != std::string_view::npos; }

// Iterates over the lines that are more than a comment.
class SwcLines {
public:
    explicit SwcLines(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }
    // Splits the next such line into words. False: end of the text.
    bool next() {
        for (fields.clear(); fields.empty() && at_ < text_.size();) {
            std::size_t end = text_.find_first_of("\r\n", at_); // a lone CR ends a line too: old Macintosh files
            if (end == std::string_view::npos) end = text_.size();
            const std::string_view line = text_.substr(at_, end - at_);
            if (line.starts_with('#')) comment = line.substr(1);
            content = line.substr(0, line.find('#'));
            at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
            ++number;
            split_words(content, " \t\r\f\v,;", fields);
        }
        return !fields.empty();
    }

    std::vector<std::string_view> fields;
    std::string_view content, comment; // without its comment; the last line that is one, without its sign
    std::size_t number = 0;            // of the line, from 1

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

// Parsed as integers, because doubles cannot distinguish ids of 18 digits.
std::optional<std::int64_t> to_id(std::string_view field) {
    const auto exact = parsed<std::int64_t>(field);
    return exact ? exact : to_whole(field);
}

Result<Row> row_of(const SwcLines& line, const SwcColumns& columns, const std::string& where) {
    const std::vector<std::string_view>& fields = line.fields;
    const std::string expected = "expected " + std::to_string(columns.count) + " columns, found ";
    if (fields.size() < columns.count) return fail(expected + std::to_string(fields.size()), where, kLayout);
    // Some programs add columns of their own, but a comma in an extra column is more likely a decimal comma.
    if (fields.size() > columns.count && line.content.find(',') != std::string_view::npos)
        return fail(expected + std::to_string(fields.size()) + " columns between commas", where,
                    std::string(kLayout) + "; numbers take a decimal point");
    const auto field = [&](SwcValue value) {
        return columns.at[value] < fields.size() ? fields[columns.at[value]] : std::string_view("0");
    };
    const auto id = to_id(field(kSwcId));
    const auto type = to_whole(field(kSwcType));
    const auto parent = to_id(field(kSwcParent));
    if (!id || *id < 0) return fail("the id " + shown(field(kSwcId)) + " is not a whole number from 0", where, kLayout);
    if (!type || std::abs(static_cast<double>(*type)) > 2147483647.0)
        return fail("the type " + shown(field(kSwcType)) + " is not a whole number", where, kLayout);
    if (!parent) return fail("the parent " + shown(field(kSwcParent)) + " is not a whole number", where, kLayout);
    Row row{*id, *parent, static_cast<int>(*type), {}, line.number};
    constexpr std::pair<SwcValue, const char*> kNumbers[] = {
        {kSwcX, "x"}, {kSwcY, "y"}, {kSwcZ, "z"}, {kSwcRadius, "radius"}};
    for (const auto& [value, name] : kNumbers) {
        const auto number = to_real(field(value));
        const std::string named = std::string("the ") + name + " " + shown(field(value));
        if (!number) return fail(named + " is not a number", where, kLayout);
        const bool is_radius = value == kSwcRadius; // NaN means: not measured
        if (!std::isfinite(*number) && !(is_radius && std::isnan(*number)))
            return fail(named + " is not finite", where,
                        is_radius ? "write a positive radius" : "correct or remove the point");
        (is_radius ? row.point.radius : row.point.position[static_cast<int>(value - kSwcX)]) = *number;
    }
    return row;
}

// The usual columns, and further columns of the first point, with the names in the comment above it.
SwcColumns usual_columns(const SwcLines& lines) {
    SwcColumns usual;
    std::vector<std::string_view> words;
    split_words(lines.comment, " \t\r\f\v,;", words);
    const auto named = words.size() == lines.fields.size() ? swc_columns_named(words) : std::nullopt;
    for (std::size_t column = kSwcValueCount;
         column < std::min(lines.fields.size(), kSwcValueCount + tree::kMostArrays); ++column) {
        const bool has_name = named && named->at == usual.at && usual.data.size() < named->data.size();
        usual.data.push_back(has_name ? named->data[usual.data.size()] : "column_" + std::to_string(column + 1));
        usual.data_at.push_back(column);
    }
    return usual;
}

// The columns that the first line names, which is then consumed, or the usual columns. pandas may write an unnamed
// column of row numbers first.
SwcColumns take_columns(SwcLines& lines) {
    auto columns = swc_columns_named(lines.fields);
    if (!columns) return usual_columns(lines);
    if (!lines.next() || lines.fields.size() != columns->count + 1) return *columns;
    for (std::size_t& at : columns->at) ++at;
    for (std::size_t& at : columns->data_at) ++at;
    ++columns->count;
    return *columns;
}

// The cells of further columns, for DataColumns; empty if a line has none.
std::vector<std::string_view> data_of(const SwcLines& line, const SwcColumns& columns) {
    std::vector<std::string_view> cells;
    for (const std::size_t at : columns.data_at)
        cells.push_back(at < line.fields.size() ? line.fields[at] : std::string_view());
    return cells;
}

// All points of the file, in its order, and their further columns.
Result<std::vector<Row>> rows_of(std::string_view text, const std::string& name, DataColumns& data) {
    std::vector<Row> rows;
    SwcLines lines(text);
    lines.next();
    const SwcColumns columns = take_columns(lines);
    data = DataColumns(columns.data);
    for (; !lines.fields.empty(); lines.next()) {
        RAMUS_TRY(row, row_of(lines, columns, name + ":" + std::to_string(lines.number)));
        rows.push_back(row);
        data.add_row(data_of(lines, columns));
    }
    if (rows.empty()) return fail("the file has no points, only comments or blank lines", name, "choose another file");
    return rows;
}

// A row on a cycle of parents, if there is one.
std::optional<std::uint32_t> find_cycle(const std::vector<std::uint32_t>& parent, std::uint32_t none) {
    enum class Mark : std::uint8_t { kNew, kOpen, kDone };
    std::vector<Mark> mark(parent.size(), Mark::kNew);
    std::vector<std::uint32_t> path;
    for (std::uint32_t start = 0; start < parent.size(); ++start) {
        std::uint32_t at = start;
        path.clear();
        while (at != none && mark[at] == Mark::kNew) {
            mark[at] = Mark::kOpen;
            path.push_back(at);
            at = parent[at];
        }
        if (at != none && mark[at] == Mark::kOpen) return at;
        for (const std::uint32_t p : path) mark[p] = Mark::kDone;
    }
    return std::nullopt;
}

// Points, labels, roots, and an edge from every parent. `line_of(point)`: the line of a point.
template <class LineOf>
Result<tree::Graph> graph_of(const std::vector<Row>& rows, const LineOf& line_of, tree::Repair repair,
                             std::vector<tree::Note>& notes) {
    tree::Graph graph;
    for (const Row& row : rows) {
        graph.points.push_back(row.point);
        graph.labels.push_back(row.type);
    }
    using Entry = std::pair<std::int64_t, std::uint32_t>; // id, row
    std::vector<Entry> by_id;
    for (std::uint32_t i = 0; i < rows.size(); ++i) by_id.emplace_back(rows[i].id, i);
    std::ranges::sort(by_id);
    const auto twin = std::ranges::adjacent_find(by_id, {}, &Entry::first);
    if (twin != by_id.end())
        return fail("id " + std::to_string(twin->first) + " was given before, in line " +
                        std::to_string(rows[twin->second].line),
                    line_of(std::next(twin)->second), "give every point its own id");
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::vector<std::uint32_t> parents(rows.size(), kNone);
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        if (rows[i].parent < 0) {
            graph.roots.push_back(i);
            continue;
        }
        const auto parent = std::ranges::lower_bound(by_id, rows[i].parent, {}, &Entry::first);
        if (parent == by_id.end() || parent->first != rows[i].parent) {
            const std::string missing = "parent " + std::to_string(rows[i].parent) + " does not exist";
            if (!tree::allows(repair, tree::Repair::kOrphans))
                return fail(missing, line_of(i), "name an existing id, or -1 for a root; --repair all makes it a root");
            graph.roots.push_back(i);
            notes.push_back({tree::Note::Kind::kRepaired, std::string(name_of(tree::Repair::kOrphans)),
                             line_of(i) + ": " + missing + "; the point became a root", rows[i].point.position});
            continue;
        }
        parents[i] = parent->second;
        graph.edges.emplace_back(parent->second, i);
    }
    if (const auto on_cycle = find_cycle(parents, kNone))
        return fail("following the parents of point " + std::to_string(rows[*on_cycle].id) + " leads back to it",
                    line_of(*on_cycle), "break the cycle: one of its points needs parent -1 or another parent");
    return graph;
}

} // namespace

bool is_swc(std::string_view head) {
    if (looks_binary(head)) return false;
    SwcLines lines(head);
    lines.next();
    const SwcColumns columns = take_columns(lines);
    return !lines.fields.empty() && row_of(lines, columns, {}).has_value();
}

Result<ImportedTree> parse_swc(const TreeInput& input) {
    const std::string_view text = input.text;
    const std::string& name = input.name;
    if (text.empty()) return fail("the file is empty", name, "choose another file");
    if (looks_binary(text)) return fail("this is a binary file, not SWC text", name, "check the file's format");
    DataColumns data;
    RAMUS_TRY(rows, rows_of(text, name, data));
    std::vector<std::size_t> lines;
    for (const Row& row : rows) lines.push_back(row.line);
    ImportedTree imported;
    imported.place_of = [name, lines = std::move(lines)](std::uint32_t point) {
        return name + ":" + std::to_string(lines[point]);
    };
    RAMUS_TRY(graph, graph_of(rows, imported.place_of, input.options.repair, imported.notes));
    if (rows.size() == 1)
        return fail("the tree has a single point", imported.place_of(0), "a vessel needs two points at least");
    imported.graph = std::move(graph);
    imported.graph.point_data = data.arrays(imported.left_out);
    if (const std::size_t at = text.find(kSwcColumns); at != std::string_view::npos)
        take_claims(text.substr(at + kSwcColumns.size()), imported);
    return imported;
}

} // namespace ramus::io
