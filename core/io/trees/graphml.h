// GraphML (.graphml) as VesselVio writes it through igraph, or NetworkX: nodes with X, Y, Z, edges with radius_avg.
// Keys say what a piece of data is called; columns of other names are those of core/io/trees/node_graph.h. What is
// written has a node for each point of the tree, with its radius, and says its unit and axes; read again it is the same
// tree.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_graphml(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_graphml(const TreeInput& input);
[[nodiscard]] Result<void> write_graphml(const tree::VesselTree& tree, const std::filesystem::path& file,
                                         const std::vector<std::string>& comments);

// The data of the whole graph by which a file says where it stands.
inline constexpr std::string_view kGraphmlUnits = "units", kGraphmlSpace = "space";

} // namespace ramus::io
