// What kind of file it is that someone wants to open, its tree, and where the demo tree is that ships with ramus.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/tree_file.h"

#include <filesystem>
#include <optional>

namespace ramus::app {

// Whether the file says that it is a session, not a tree. False when it cannot be read: reading it then says why.
[[nodiscard]] bool is_session_file(const std::filesystem::path& path);

// The tree in a file; of a segmentation mask the one that io::tree_of_mask() makes of it. `memory_bytes`: most that the
// process may take for that; 0 = half of the machine's. Fails like io::read_tree(), io::read_volume() and
// io::tree_of_mask().
[[nodiscard]] Result<tree::VesselTree> read_tree_or_mask(const std::filesystem::path& path,
                                                         const io::ReadOptions& options, double memory_bytes, Job& job);

// The demo tree: in $RAMUS_ASSETS, beside the program's installation, or in the sources it was built from.
[[nodiscard]] std::optional<std::filesystem::path> demo_tree();

} // namespace ramus::app
