// NodeGraph: builds an ImportedTree from a table of nodes and a table of edges, as pairs of CSV files, GraphML and GXL
// have them. A reader passes the names of the columns and then the rows. The meaning of the columns is decided here, so
// all three formats know the same names, and the names that a person gives (ReadOptions::columns) apply to all.
#pragma once

#include "core/io/trees/tree_data.h"
#include "core/io/trees/tree_file.h"
#include "core/io/trees/width_names.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ramus::io {

enum class NodeCell : std::uint8_t { kId, kX, kY, kZ, kRadius, kLabel, kSystem, kColour, kRoot };
enum class EdgeCell : std::uint8_t { kFrom, kTo, kRadius };

// The cells of a row by their meaning; empty: not there.
using NodeRow = std::array<std::string_view, 9>;
using EdgeRow = std::array<std::string_view, 3>;

inline constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();
// The columns of further data: all without another meaning, except kComputedColumns, which follow from the geometry.
struct DataAt {
    std::vector<std::size_t> at;
    std::vector<std::string> names;
};
struct NodeColumns {
    std::array<std::size_t, std::tuple_size_v<NodeRow>> at{}; // by NodeCell, its column
    ChosenWidth width;
    DataAt data;
};
struct EdgeColumns {
    std::array<std::size_t, std::tuple_size_v<EdgeRow>> at{}; // by EdgeCell, its column
    ChosenWidth width;
    DataAt data;
};
[[nodiscard]] NodeColumns node_columns(const std::vector<std::string>& names, const ReadOptions& options);
[[nodiscard]] EdgeColumns edge_columns(const std::vector<std::string>& names, const ReadOptions& options);

// Whether a table with these columns is a table of nodes, or of edges.
[[nodiscard]] bool has_nodes(const NodeColumns& columns);
[[nodiscard]] bool has_edges(const EdgeColumns& columns);

// Columns that ramus writes and recognises.
inline constexpr std::string_view kSystemColumn = "system", kColourColumn = "system_colour", kRootColumn = "root",
                                  kLabelColumn = "label";
inline constexpr std::string_view kComputedColumns[] = {"id", "degree", "length", "branch"};
// Lower-case names that arrays of data cannot have in these files, because they have a meaning.
inline constexpr std::string_view kTakenByNodes[] = {
    "id",     "x",          "y",      "z",      "pos_x",  "pos_y",         "pos_z",       "degree",  "radius",
    "root",   "label",      "system", "branch", "length", "system_colour", "source",      "node1id", "node2id",
    "target", "radius_avg", "from",   "to",     "units",  "space",         "avgradiusavg"};
[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#d64541"

// Call order: begin_nodes(), add_node() for all nodes, begin_edges(), add_edge() for all edges, finish(). Errors in a
// row name its file and line.
class NodeGraph {
public:
    explicit NodeGraph(const TreeInput& input) : input_(input) {}

    [[nodiscard]] Result<void> begin_nodes(const NodeColumns& columns, const std::string& file);
    [[nodiscard]] Result<void> begin_edges(const EdgeColumns& columns, const std::string& file);
    // The id of a node without one is its number, from 0. A missing z is 0. `data`: the cells of the data columns.
    [[nodiscard]] Result<void> add_node(const NodeRow& row, std::size_t line,
                                        std::span<const std::string_view> data = {});
    [[nodiscard]] Result<void> add_edge(const EdgeRow& row, std::size_t line,
                                        std::span<const std::string_view> data = {});

    // Takes edges as directed along the flow: nodes without an incoming edge become the roots. Does nothing if a node
    // has more than one incoming edge.
    void take_roots_from_directions();
    void state(std::optional<LengthUnit> unit, std::optional<Orientation> orientation); // what the file states

    [[nodiscard]] Result<ImportedTree> finish();

private:
    [[nodiscard]] Result<double> number(std::string_view cell, std::string_view what, std::size_t line) const;
    [[nodiscard]] Result<std::uint32_t> node_called(std::string_view id, std::size_t line) const;
    [[nodiscard]] std::string place(std::size_t line) const;
    [[nodiscard]] Result<void> add_marks(const NodeRow& row, std::size_t line);
    [[nodiscard]] Result<void> choose_radii();
    void keep_systems();
    void suspect_voxels();

    const TreeInput& input_;
    ImportedTree imported_;
    std::string node_file_, file_; // file of the nodes, and of the current table
    NodeColumns nodes_;
    EdgeColumns edges_;
    std::unordered_map<std::string, std::uint32_t> by_id_;
    std::unordered_map<std::string, int> system_by_name_;
    std::vector<std::size_t> lines_; // by node
    std::vector<double> edge_radii_;
    DataColumns node_data_, edge_data_;
    std::size_t rings_ = 0; // edges from a node to itself
    bool all_labelled_ = true, whole_positions_ = true;
};

} // namespace ramus::io
