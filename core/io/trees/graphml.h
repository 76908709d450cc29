// Reads and writes GraphML (.graphml) as VesselVio (through igraph) and NetworkX write it: nodes with X, Y, Z, edges
// with radius_avg. Keys name the data; node_graph.h lists the names. A written file has a node with its radius for each
// point of the tree, states unit and axes, and reads back as the same tree.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_graphml(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_graphml(const TreeInput& input);
[[nodiscard]] Result<void> write_graphml(const tree::VesselTree& tree, const std::filesystem::path& file,
                                         const std::vector<std::string>& comments);

// Keys of the graph's own data that state unit and axes.
inline constexpr std::string_view kGraphmlUnits = "units", kGraphmlSpace = "space";

} // namespace ramus::io
