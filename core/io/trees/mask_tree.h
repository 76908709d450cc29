// The tree of a segmentation mask, the same for all commands and the window: which labels become which systems, what
// the tree says of its unit and axes, and the notes of the mask, which become the tree's.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/imported_tree.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "core/volume/volume.h"

#include <filesystem>

namespace ramus::io {

// Makes the tree of `mask`, which was read from `path` with `options.unit`. Each label is a system of its own unless
// `options.mask` says otherwise. `memory_bytes`: most that the process may take; 0 = half of the machine's. Fails like
// volume::systems_of() and volume::skeletonize(), with `path` as the place, and where `options` give axes, which are
// those of the file. `figures`: what was found on the way; may be null.
[[nodiscard]] Result<tree::VesselTree> tree_of_mask(volume::Volume&& mask, const std::filesystem::path& path,
                                                    const ReadOptions& options, double memory_bytes, Job& job,
                                                    volume::SkeletonizeFigures* figures = nullptr);

} // namespace ramus::io
