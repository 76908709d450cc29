// Voreen's vessel graphs (.vvg), as JSON: nodes with a radius, and edges whose skeleton's voxels know their distance to
// the vessel's surface. The mean distance is the radius; voxels that know none (Voreen says Infinity) take it from
// their neighbours along the vessel.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_voreen(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_voreen(const TreeInput& input);

} // namespace ramus::io
