// Morphologies in HDF5, as MorphIO and its relatives write them: /points (x, y, z, diameter), /structure (first point
// and type of each section) and /connectivity (parent and child section), or a third column of /structure with the
// parent. The library that parses HDF5 was not made for damaged files: it runs in a process of its own
// (core/base/own_process.h) and is given plain tables only, whose claims fit the size of the file.
#pragma once

#include "core/io/trees/tree_file.h"

namespace ramus::io {

[[nodiscard]] bool is_hdf5(std::string_view head);
[[nodiscard]] Result<ImportedTree> parse_hdf5_morphology(const TreeInput& input);

} // namespace ramus::io
