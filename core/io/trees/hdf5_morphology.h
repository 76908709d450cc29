// Reads morphologies in HDF5 as MorphIO and related programs write them: /points (x, y, z, diameter), /structure (first
// point and type of each section) and /connectivity (parent and child section), or the parent in a third column of
// /structure. The HDF5 library may crash on damaged files, so it runs in a separate process (core/base/own_process.h).
// Only plain tables are read whose declared sizes fit the size of the file.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_hdf5(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_hdf5_morphology(const TreeInput& input);

} // namespace ramus::io
