#include "core/io/input_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/swc.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace ramus::io {

namespace {

struct Row {
    long long id = 0;
    long long parent = 0;
    int type = 0;
    tree::Point point;
    std::size_t line = 0;
};

constexpr const char* kLayout = "a line is: id type x y z radius parent";

bool looks_binary(std::string_view text) { return text.substr(0, 4096).find('\0') != std::string_view::npos; }

// `content`: the line that `fields` are of; `where`: the file and the line's number.
Result<Row> row_of(const std::vector<std::string_view>& fields, std::string_view content, const std::string& where) {
    if (fields.size() < 7) return fail("expected 7 columns, found " + std::to_string(fields.size()), where, kLayout);
    // Some programs add columns of their own, but a comma in one too many is more likely half a number.
    if (fields.size() > 7 && content.substr(0, content.find('#')).find(',') != std::string_view::npos)
        return fail("expected 7 columns, found " + std::to_string(fields.size()) + " columns between commas", where,
                    std::string(kLayout) + "; numbers take a decimal point");
    const auto id = to_whole(fields[0]);
    const auto type = to_whole(fields[1]);
    const auto parent = to_whole(fields[6]);
    if (!id || *id < 0) return fail("the id " + shown(fields[0]) + " is not a whole number from 0", where, kLayout);
    if (!type || std::abs(*type) > 2147483647LL)
        return fail("the type " + shown(fields[1]) + " is not a whole number", where, kLayout);
    if (!parent) return fail("the parent " + shown(fields[6]) + " is not a whole number", where, kLayout);
    Row row{*id, *parent, static_cast<int>(*type), {}, 0};
    constexpr const char* kNames[4] = {"x", "y", "z", "radius"};
    for (std::size_t column = 0; column < 4; ++column) {
        const std::string_view field = fields[2 + column];
        const auto value = to_real(field);
        const bool is_radius = column == 3;
        const std::string named = std::string("the ") + kNames[column] + " " + shown(field);
        if (!value) return fail(named + " is not a number", where, kLayout);
        if (!std::isfinite(*value))
            return fail(named + " is not finite", where,
                        is_radius ? "write a positive radius" : "correct or remove the point");
        (is_radius ? row.point.radius : row.point.position[static_cast<int>(column)]) = *value;
    }
    return row;
}

// All points of the file, in its order.
Result<std::vector<Row>> rows_of(std::string_view text, const std::string& name) {
    std::vector<Row> rows;
    std::vector<std::string_view> fields;
    std::size_t number = 0;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = text.find_first_of("\r\n", at); // a lone CR ends a line too: old Macintosh files
        if (end == std::string_view::npos) end = text.size();
        const std::string_view content = text.substr(at, end - at);
        at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
        ++number;
        split_words(content.substr(0, content.find('#')), " \t\r\f\v,;", fields);
        if (fields.empty()) continue;
        RAMUS_TRY(row, row_of(fields, content, name + ":" + std::to_string(number)));
        row.line = number;
        rows.push_back(row);
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

// Points, labels, roots, and edges from every parent. `line_of(point)` says where a point stands.
template <class LineOf>
Result<tree::Graph> graph_of(const std::vector<Row>& rows, const LineOf& line_of, tree::Repair repair,
                             std::vector<tree::Note>& notes) {
    tree::Graph graph;
    for (const Row& row : rows) {
        graph.points.push_back(row.point);
        graph.labels.push_back(row.type);
    }
    using Entry = std::pair<long long, std::uint32_t>; // id, row
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

Result<ImportedTree> parse_swc(const TreeInput& input) {
    std::string_view text = input.text;
    const std::string& name = input.name;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.empty()) return fail("the file is empty", name, "choose another file");
    if (looks_binary(text)) return fail("this is a binary file, not SWC text", name, "check the file's format");
    RAMUS_TRY(rows, rows_of(text, name));
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
    if (const std::size_t at = text.find(kSwcColumns); at != std::string_view::npos)
        take_claims(text.substr(at + kSwcColumns.size()), imported);
    return imported;
}

} // namespace ramus::io
