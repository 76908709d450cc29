// Pairs of tables as text (.csv), one of nodes and one of edges, as VesselGraph, Voreen and VesselVio write them.
// Whichever of both is opened, the other one is looked for beside it, by its name: liver_vertices.csv and
// liver_edges.csv, nodes_7.csv and edges_7.csv, liver.csv and liver_edges.csv. Cells are parted by what parts those of
// the first line: semicolons, commas or tabs. Names of columns are those of core/io/trees/node_graph.h.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// What the other table may be called, the likeliest first. `nodes`: the file at `path` is the table of nodes.
[[nodiscard]] std::vector<std::filesystem::path> partner_names(const std::filesystem::path& path, bool nodes);

// Whether the first line names columns of nodes or of edges.
[[nodiscard]] bool is_csv_pair(std::string_view head);

// Fails also when the other table is missing, or when `input` has no place where it could lie.
[[nodiscard]] Result<ImportedTree> parse_csv_pair(const TreeInput& input);

// Both tables, or none: nodes to `file` and edges beside it as *_edges.csv, or the other way round if `file` is called
// edges. One node for each point, so that the same network is read again. Comments have no place in them.
[[nodiscard]] Result<void> write_csv_pair(const tree::VesselTree& tree, const std::filesystem::path& file,
                                          const std::vector<std::string>& comments);

} // namespace ramus::io
