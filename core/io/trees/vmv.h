// Reads and writes VMV, the text format of VessMorphoVis: blocks of parameters, of vertices (index, x, y, z, radius and
// more) and of strands, which are lists of vertices. Strands are connected by shared vertices. Indices need not begin
// at 1 or be in order. Other blocks are skipped.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// Lines that ramus writes above the blocks, where other readers ignore them. The tree's claims follow the first line:
// "(mm, RAS)".
inline constexpr std::string_view kVmvColumns = "# index x y z radius ";
inline constexpr std::string_view kVmvRoots = "# roots:"; // followed by their indices

[[nodiscard]] bool is_vmv(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_vmv(const TreeInput& input);

// Writes each branch as a strand from the root outward, and vertices in the order of the tree's points. Numbers read
// back exactly. Labels and systems are lost.
[[nodiscard]] Result<void> write_vmv(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
