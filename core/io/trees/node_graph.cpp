#include "core/io/trees/node_graph.h"

#include "core/io/text_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

namespace ramus::io {

namespace {

using ColumnNames = std::span<const std::string_view>;

// Lower-case names of columns: of VesselGraph and Voreen (pos_x, node1id, avgRadiusAvg), of VesselVio (X, source,
// radius_avg), and common names in handwritten tables.
constexpr std::string_view kIdNames[] = {"id", "node_id", "nodeid", "vertex_id", "index", ""};
constexpr std::string_view kXNames[] = {"pos_x", "x", "posx", "position_x", "coord_x", "x_mm"};
constexpr std::string_view kYNames[] = {"pos_y", "y", "posy", "position_y", "coord_y", "y_mm"};
constexpr std::string_view kZNames[] = {"pos_z", "z", "posz", "position_z", "coord_z", "z_mm"};
constexpr std::string_view kFromNames[] = {"node1id", "node1", "source", "from", "node1_id", "id1", "start", "vertex1"};
constexpr std::string_view kToNames[] = {"node2id", "node2", "target", "to", "node2_id", "id2", "end", "vertex2"};
// Names of the mean radius; files may also have the least and largest radius and the deviation.
constexpr std::string_view kMeanRadiusNames[] = {"radius",      "avgradiusavg", "radius_avg", "avg_radius",
                                                 "mean_radius", "radius_mean",  "radius_mm"};

// The column that a person chose for `key`, else the first column with one of the `known` names.
std::size_t column_called(const std::vector<std::string>& names, const ReadOptions& options, const std::string& key,
                          ColumnNames known) {
    const auto index = [&](std::string_view wanted, bool exactly) {
        const auto at = std::ranges::find_if(
            names, [&](const std::string& name) { return exactly ? name == wanted : lower_case(name) == wanted; });
        return at == names.end() ? kNoColumn : static_cast<std::size_t>(at - names.begin());
    };
    if (const auto asked = options.columns.find(key); asked != options.columns.end()) return index(asked->second, true);
    for (const std::string_view name : known)
        if (const std::size_t at = index(name, false); at != kNoColumn) return at;
    return kNoColumn;
}

std::size_t radius_column(const std::vector<std::string>& names, const ReadOptions& options, ChosenWidth& width) {
    const std::size_t at = column_called(names, options, "radius", kMeanRadiusNames);
    const auto word = at == kNoColumn ? std::nullopt : width_by_word(names[at]);
    if (at != kNoColumn) {
        width = {at, word ? word->is : RadiusIs::kRadius, options.columns.contains("radius") && (!word || word->open)};
        return at;
    }
    if (options.columns.contains("radius")) return kNoColumn;
    const auto chosen = choose_width(names, options);
    if (!chosen) return kNoColumn;
    width = *chosen;
    return chosen->index;
}

// The columns without another meaning. Further columns of widths, such as the least or the largest, are data.
template <class Columns> DataAt data_columns(const std::vector<std::string>& names, const Columns& columns) {
    DataAt data;
    for (std::size_t c = 0; c < names.size() && data.at.size() < tree::kMostArrays; ++c) {
        if (std::ranges::find(columns.at, c) != columns.at.end() || names[c].empty()) continue;
        if (std::ranges::find(kComputedColumns, lower_case(names[c])) != std::end(kComputedColumns)) continue;
        data.at.push_back(c);
        data.names.push_back(names[c]);
    }
    return data;
}

bool is_yes(std::string_view cell) {
    const std::string word = lower_case(cell);
    return word == "1" || word == "true" || word == "yes";
}

std::optional<std::array<std::uint8_t, 3>> colour_of(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const char* digits = text.data() + 1 + 2 * c;
        if (std::from_chars(digits, digits + 2, colour[c], 16).ptr != digits + 2) return std::nullopt;
    }
    return colour;
}

constexpr std::size_t cell(NodeCell one) { return static_cast<std::size_t>(one); }
constexpr std::size_t cell(EdgeCell one) { return static_cast<std::size_t>(one); }

} // namespace

NodeColumns node_columns(const std::vector<std::string>& names, const ReadOptions& options) {
    NodeColumns columns;
    columns.at = {column_called(names, options, "id", kIdNames),     column_called(names, options, "x", kXNames),
                  column_called(names, options, "y", kYNames),       column_called(names, options, "z", kZNames),
                  radius_column(names, options, columns.width),      column_called(names, {}, {}, {&kLabelColumn, 1}),
                  column_called(names, {}, {}, {&kSystemColumn, 1}), column_called(names, {}, {}, {&kColourColumn, 1}),
                  column_called(names, {}, {}, {&kRootColumn, 1})};
    columns.data = data_columns(names, columns);
    return columns;
}

EdgeColumns edge_columns(const std::vector<std::string>& names, const ReadOptions& options) {
    EdgeColumns columns;
    columns.at = {column_called(names, options, "from", kFromNames), column_called(names, options, "to", kToNames),
                  radius_column(names, options, columns.width)};
    columns.data = data_columns(names, columns);
    return columns;
}

bool has_nodes(const NodeColumns& columns) {
    return columns.at[cell(NodeCell::kX)] != kNoColumn && columns.at[cell(NodeCell::kY)] != kNoColumn;
}
bool has_edges(const EdgeColumns& columns) {
    return columns.at[cell(EdgeCell::kFrom)] != kNoColumn && columns.at[cell(EdgeCell::kTo)] != kNoColumn;
}

std::string colour_text(const std::array<std::uint8_t, 3>& colour) {
    constexpr std::string_view kHexDigits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t part : colour) text += {kHexDigits[part >> 4], kHexDigits[part & 15]};
    return text;
}

std::string NodeGraph::place(std::size_t line) const { return file_ + ":" + std::to_string(line); }

Result<void> NodeGraph::begin_nodes(const NodeColumns& columns, const std::string& file) {
    node_file_ = file_ = file;
    nodes_ = columns;
    node_data_ = DataColumns(columns.data.names);
    if (!has_nodes(columns))
        return fail("no columns give the positions of nodes", file, "they are called pos_x, pos_y, pos_z, or X, Y, Z");
    return {};
}

Result<void> NodeGraph::begin_edges(const EdgeColumns& columns, const std::string& file) {
    file_ = file;
    edges_ = columns;
    edge_data_ = DataColumns(columns.data.names);
    if (!has_edges(columns))
        return fail("no columns name the two nodes of an edge", file, "they are called node1id and node2id");
    return {};
}

Result<double> NodeGraph::number(std::string_view cell, std::string_view what, std::size_t line) const {
    const auto value = to_real(trimmed(cell));
    if (value) return *value;
    if (trimmed(cell).empty()) return fail(std::string(what) + " is missing", place(line), "complete the file");
    return fail(std::string(what) + " " + shown(cell) + " is not a number", place(line),
                cell.find(',') != std::string_view::npos ? "write numbers with a decimal point" : "correct the file");
}

Result<void> NodeGraph::add_node(const NodeRow& row, std::size_t line, std::span<const std::string_view> data) {
    tree::Graph& graph = imported_.graph;
    const auto index = static_cast<std::uint32_t>(graph.points.size());
    tree::Point point;
    RAMUS_TRY(x, number(row[cell(NodeCell::kX)], "x", line));
    RAMUS_TRY(y, number(row[cell(NodeCell::kY)], "y", line));
    point.position = {x, y, 0.0};
    if (nodes_.at[cell(NodeCell::kZ)] != kNoColumn) {
        RAMUS_TRY(z, number(row[cell(NodeCell::kZ)], "z", line));
        point.position.z = z;
    }
    if (nodes_.at[cell(NodeCell::kRadius)] != kNoColumn) {
        RAMUS_TRY(radius, number(row[cell(NodeCell::kRadius)], "the radius", line));
        point.radius = radius;
    }
    for (int d = 0; d < 3; ++d) whole_positions_ &= std::floor(2.0 * point.position[d]) == 2.0 * point.position[d];
    const std::string id = nodes_.at[cell(NodeCell::kId)] == kNoColumn ? std::to_string(index)
                                                                       : std::string(trimmed(row[cell(NodeCell::kId)]));
    if (!by_id_.emplace(id, index).second)
        return fail("the node " + shown(id) + " is there twice", place(line), "give each node an id of its own");
    graph.points.push_back(point);
    node_data_.add_row(data);
    lines_.push_back(line);
    return add_marks(row, line);
}

// Reads columns that only files written by ramus have.
Result<void> NodeGraph::add_marks(const NodeRow& row, std::size_t line) {
    tree::Graph& graph = imported_.graph;
    if (is_yes(trimmed(row[cell(NodeCell::kRoot)])))
        graph.roots.push_back(static_cast<std::uint32_t>(graph.points.size() - 1));
    const auto label = to_whole(trimmed(row[cell(NodeCell::kLabel)]));
    all_labelled_ &= label && std::abs(static_cast<double>(*label)) < 2147483648.0;
    if (all_labelled_) graph.labels.push_back(static_cast<int>(*label));
    if (nodes_.at[cell(NodeCell::kSystem)] == kNoColumn || nodes_.at[cell(NodeCell::kColour)] == kNoColumn) return {};
    const auto colour = colour_of(trimmed(row[cell(NodeCell::kColour)]));
    if (!colour)
        return fail("the colour " + shown(row[cell(NodeCell::kColour)]) + " is not like #d64541", place(line),
                    "correct the file");
    const std::string name(row[cell(NodeCell::kSystem)]);
    const auto [known, is_new] = system_by_name_.emplace(name, static_cast<int>(graph.systems.size()));
    if (is_new) graph.systems.push_back({name, *colour});
    graph.point_systems.push_back(known->second);
    return {};
}

Result<std::uint32_t> NodeGraph::node_called(std::string_view id, std::size_t line) const {
    id = trimmed(id);
    auto found = by_id_.find(std::string(id));
    // Some programs write the ids of edges' nodes with a decimal point.
    if (found == by_id_.end() && id.find('.') != std::string_view::npos)
        if (const auto whole = to_whole(id)) found = by_id_.find(std::to_string(*whole));
    if (found != by_id_.end()) return found->second;
    return fail("the edge names the node " + shown(id) + ", which is not there", place(line),
                "the file is incomplete, or its nodes are another network's");
}

Result<void> NodeGraph::add_edge(const EdgeRow& row, std::size_t line, std::span<const std::string_view> data) {
    RAMUS_TRY(from, node_called(row[cell(EdgeCell::kFrom)], line));
    RAMUS_TRY(to, node_called(row[cell(EdgeCell::kTo)], line));
    if (from == to) {
        ++rings_;
        return {};
    }
    // Radii of edges are ignored if nodes have radii, which are more precise.
    if (edges_.at[cell(EdgeCell::kRadius)] != kNoColumn && nodes_.at[cell(NodeCell::kRadius)] == kNoColumn) {
        RAMUS_TRY(radius, number(row[cell(EdgeCell::kRadius)], "the radius", line));
        if (!std::isfinite(radius) || (radius < 0.0 && radius != -1.0)) // -1: not measured
            return fail("the radius " + shown(row[cell(EdgeCell::kRadius)]) + " is not positive", place(line),
                        "correct the file");
        edge_radii_.push_back(radius);
    }
    imported_.graph.edges.emplace_back(from, to);
    edge_data_.add_row(data);
    return {};
}

void NodeGraph::take_roots_from_directions() {
    tree::Graph& graph = imported_.graph;
    std::vector<int> in(graph.points.size(), 0), out(graph.points.size(), 0);
    for (const auto& [from, to] : graph.edges) ++out[from], ++in[to];
    if (std::ranges::any_of(in, [](int edges) { return edges > 1; })) return;
    graph.roots.clear();
    for (std::uint32_t p = 0; p < in.size(); ++p)
        if (in[p] == 0 && out[p] > 0) graph.roots.push_back(p);
}

void NodeGraph::state(std::optional<LengthUnit> unit, std::optional<Orientation> orientation) {
    imported_.unit = unit;
    imported_.orientation = orientation;
}

Result<void> NodeGraph::choose_radii() {
    const bool of_nodes = nodes_.at[cell(NodeCell::kRadius)] != kNoColumn;
    const bool of_edges = edges_.at[cell(EdgeCell::kRadius)] != kNoColumn;
    if (!of_nodes && !of_edges && input_.options.radius_mm) return {};
    if (!of_nodes && !of_edges)
        return fail("no column of the nodes or the edges gives the radius", file_,
                    "call it radius, or avgRadiusAvg as VesselGraph does, or give all points the same radius with "
                    "--radius MM");
    const ChosenWidth& width = of_nodes ? nodes_.width : edges_.width;
    imported_.radius_is = width.is;
    if (width.open) imported_.radius_name = width.is == RadiusIs::kDiameter ? "diameter" : "radius";
    if (!of_nodes) imported_.edge_radii = std::move(edge_radii_);
    return {};
}

void NodeGraph::keep_systems() {
    tree::Graph& graph = imported_.graph;
    if (graph.point_systems.empty()) return;
    for (const auto& [a, b] : graph.edges)
        if (graph.point_systems[a] != graph.point_systems[b]) {
            imported_.assume("systems", "edges connect nodes of different systems, which were not told apart");
            graph.systems.clear();
            graph.point_systems.clear();
            return;
        }
}

// Positions that are all whole or half numbers are most likely voxel indices.
void NodeGraph::suspect_voxels() {
    constexpr std::size_t kFewNodes = 20;
    if (!whole_positions_ || imported_.unit || input_.options.unit || imported_.graph.points.size() < kFewNodes) return;
    imported_.notes.push_back({tree::Note::Kind::kSuspect,
                               "units",
                               "all positions are whole or half numbers, as those of voxels are: --units with the size "
                               "of a voxel in mm (0.5 or 0.5x0.5x1.2) may be what is meant",
                               {}});
}

Result<ImportedTree> NodeGraph::finish() {
    tree::Graph& graph = imported_.graph;
    if (graph.points.empty()) return fail("there are no nodes", node_file_, "choose another file");
    if (graph.edges.empty()) return fail("there are no edges between different nodes", file_, "choose another file");
    if (auto good = choose_radii(); !good) return tl::unexpected(good.error());
    if (!all_labelled_) graph.labels.clear();
    graph.point_data = node_data_.arrays(imported_.left_out);
    graph.edge_data = edge_data_.arrays(imported_.left_out);
    keep_systems();
    suspect_voxels();
    if (rings_ > 0)
        imported_.assume("joining", counted(rings_, "edge") +
                                        " from a node to itself were left out: the file does not say where they run");
    imported_.edges_are_vessels = true;
    imported_.place_of = [file = node_file_, lines = std::move(lines_)](std::uint32_t node) {
        return file + ":" + std::to_string(lines[node]);
    };
    return std::move(imported_);
}

} // namespace ramus::io
