// Reads and writes trees as pairs of CSV tables, one of nodes and one of edges, as VesselGraph, Voreen and VesselVio
// write them. Either file can be opened; the other is found in the same folder by its name: liver_vertices.csv and
// liver_edges.csv, nodes_7.csv and edges_7.csv, liver.csv and liver_edges.csv. The first line decides the separator:
// semicolon, comma or tab. node_graph.h lists the names of columns.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// Possible names of the other table, the most likely first. `nodes`: `path` is the table of nodes.
[[nodiscard]] std::vector<std::filesystem::path> partner_names(const std::filesystem::path& path, bool nodes);

// Whether the first line names columns of nodes or of edges.
[[nodiscard]] bool is_csv_pair(std::string_view head);

// Also fails if the other table is missing, or if `input` has no path.
[[nodiscard]] Result<ImportedTree> parse_csv_pair(const TreeInput& input);

// Writes both tables or none: nodes to `file` and edges to *_edges.csv next to it, or the reverse if `file` is named as
// edges. Each point becomes a node, so reading gives the same network. Comments are not written.
[[nodiscard]] Result<void> write_csv_pair(const tree::VesselTree& tree, const std::filesystem::path& file,
                                          const std::vector<std::string>& comments);

} // namespace ramus::io
