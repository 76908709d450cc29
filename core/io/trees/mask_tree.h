// Makes the tree of a segmentation mask, in the same way for all commands and the window: assigns labels to systems,
// sets the tree's claims about unit and axes, and keeps the notes of the mask.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/trees/imported_tree.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "core/volume/volume.h"

#include <filesystem>

namespace ramus::io {

// `mask` must have been read from `path` with `options.unit`. Each label is a system of its own unless `options.mask`
// says otherwise. `memory_bytes`: limit for the process; 0: half of the machine's memory. `figures`: statistics; may be
// null. Fails like volume::systems_of() and volume::skeletonize(), with `path` as the place, and if `options` state an
// orientation, because the mask's file states it.
[[nodiscard]] Result<tree::VesselTree> tree_of_mask(volume::Volume&& mask, const std::filesystem::path& path,
                                                    const ReadOptions& options, double memory_bytes, Job& job,
                                                    volume::SkeletonizeFigures* figures = nullptr);

} // namespace ramus::io
