// Graphs that stand in files as two tables, one of nodes and one of edges, each with an id: pairs of CSV files,
// GraphML, GXL. Readers name the columns and hand over the rows; which column means what is decided here, so that all
// of them know the same names, and a person's names (ReadOptions::columns: id, x, y, z, radius, from, to) hold
// everywhere.
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

// The cells of a row that are read; empty: there is none.
using NodeRow = std::array<std::string_view, 9>;
using EdgeRow = std::array<std::string_view, 3>;

// By cell, the column that it stands in.
inline constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();
// All others but what is computed of the geometry (kComputedColumns) are data.
struct DataAt {
    std::vector<std::size_t> at;
    std::vector<std::string> names;
};
struct NodeColumns {
    std::array<std::size_t, std::tuple_size_v<NodeRow>> at{};
    ChosenWidth width;
    DataAt data;
};
struct EdgeColumns {
    std::array<std::size_t, std::tuple_size_v<EdgeRow>> at{};
    ChosenWidth width;
    DataAt data;
};
[[nodiscard]] NodeColumns node_columns(const std::vector<std::string>& names, const ReadOptions& options);
[[nodiscard]] EdgeColumns edge_columns(const std::vector<std::string>& names, const ReadOptions& options);

// Whether a table with these columns is one of nodes, or of edges.
[[nodiscard]] bool has_nodes(const NodeColumns& columns);
[[nodiscard]] bool has_edges(const EdgeColumns& columns);

// The columns that are written, by which files of this program are known again.
inline constexpr std::string_view kSystemColumn = "system", kColourColumn = "system_colour", kRootColumn = "root",
                                  kLabelColumn = "label";
inline constexpr std::string_view kComputedColumns[] = {"id", "degree", "length", "branch"};
// What arrays of data may not be called in these files, since it has a meaning; in small letters.
inline constexpr std::string_view kTakenByNodes[] = {
    "id",     "x",          "y",      "z",      "pos_x",  "pos_y",         "pos_z",       "degree",  "radius",
    "root",   "label",      "system", "branch", "length", "system_colour", "source",      "node1id", "node2id",
    "target", "radius_avg", "from",   "to",     "units",  "space",         "avgradiusavg"};
[[nodiscard]] std::string colour_text(const std::array<std::uint8_t, 3>& colour); // "#d64541"

// Takes all nodes, then all edges. A row that is wrong is refused with its file and line.
class NodeGraph {
public:
    explicit NodeGraph(const TreeInput& input) : input_(input) {}

    [[nodiscard]] Result<void> begin_nodes(const NodeColumns& columns, const std::string& file);
    [[nodiscard]] Result<void> begin_edges(const EdgeColumns& columns, const std::string& file);
    // A node without an id is called by its number, from 0; one without z lies in the plane. `data`: the cells of the
    // columns of data.
    [[nodiscard]] Result<void> add_node(const NodeRow& row, std::size_t line,
                                        std::span<const std::string_view> data = {});
    [[nodiscard]] Result<void> add_edge(const EdgeRow& row, std::size_t line,
                                        std::span<const std::string_view> data = {});

    // Flow runs from the first node of an edge to its second: nodes that no edge leads to are roots, whatever they are
    // called, if no other node has two edges that lead to it.
    void take_roots_from_directions();
    void state(std::optional<LengthUnit> unit, std::optional<Orientation> orientation); // as the file does

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
    std::string node_file_, file_; // of the nodes; of the table that is being read
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
