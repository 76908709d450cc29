// What kind of file it is that someone wants to open, its tree, and where the demo tree is that ships with ramus.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/tree_file.h"
#include "core/volume/skeletonize/skeletonize.h"

#include <filesystem>
#include <optional>

namespace ramus::app {

// Whether the file says that it is a session, not a tree. False when it cannot be read: reading it then says why.
[[nodiscard]] bool is_session_file(const std::filesystem::path& path);

// What people say of a mask, over what is usual.
[[nodiscard]] volume::SkeletonizeOptions skeletonize_options(const io::MaskReading& mask, double memory_bytes);

// Said of a tree that a threshold has made of a scan.
[[nodiscard]] tree::Note threshold_note(double isovalue);

// The tree in a file; of a segmentation mask the one that ramus::volume::skeletonize() makes of it as `options` say,
// each label a system of its own where they say nothing. `memory_bytes`: most that the process shall take for that; 0 =
// half of the machine's. Fails like io::read_tree(), io::read_volume() and skeletonize().
[[nodiscard]] Result<tree::VesselTree> read_tree_or_mask(const std::filesystem::path& path,
                                                         const io::ReadOptions& options, double memory_bytes, Job& job);

// The demo tree: in $RAMUS_ASSETS, beside the program's installation, or in the sources it was built from.
[[nodiscard]] std::optional<std::filesystem::path> demo_tree();

} // namespace ramus::app
