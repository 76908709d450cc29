// VMV, the text format of VessMorphoVis: blocks of parameters, of vertices (index, x, y, z, radius and more) and of
// strands, each a list of vertices. Strands hang together where they share a vertex. Indices need not begin at 1 or be
// in order; blocks of other names are passed over.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

// Lines that this program writes above the blocks, where other readers look for nothing. Its claims stand behind the
// first: "(mm, RAS)".
inline constexpr std::string_view kVmvColumns = "# index x y z radius ";
inline constexpr std::string_view kVmvRoots = "# roots:"; // and their indices

[[nodiscard]] bool is_vmv(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_vmv(const TreeInput& input);

// A strand a branch, from the root outward; vertices in the order of the tree's points. Numbers are the shortest that
// read back exactly. VMV holds neither labels nor systems.
[[nodiscard]] Result<void> write_vmv(const tree::VesselTree& tree, const std::filesystem::path& file,
                                     const std::vector<std::string>& comments = {});

} // namespace ramus::io
