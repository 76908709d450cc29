// Reads the volumes that slices show (Scan in app/session/objects.h).
#pragma once

#include "app/assets/shapes.h"
#include "app/session/objects.h"
#include "core/io/volumes/volume_part.h"
#include "core/slice/window.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct ScanSource {
    std::string file;
    std::string units{};                                 // of its lengths; empty: as the file says
    io::VolumePart part{};                               // of a file that holds several volumes
    auto operator<=>(const ScanSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline ScanSource source_of(const Scan& scan) { return {scan.file, scan.units, scan.part}; }

// The labels of a segmentation, ascending; empty: it is none.
[[nodiscard]] std::vector<std::int32_t> segmentation_labels(const volume::Volume& volume);
// A scan of 8 bits has more values than a segmentation has labels.
inline constexpr std::size_t kMostShownLabels = 64;
// Whether somebody who says nothing sees labels, not grey values. `labels`: as segmentation_labels() returns them.
[[nodiscard]] bool holds_labels(const volume::Volume& volume, const std::vector<std::int32_t>& labels);

struct ScanFile {
    std::shared_ptr<const volume::Volume> volume;
    slice::Window window; // that the file proposes, otherwise from its values
    std::vector<std::int32_t> labels;
    tree::Claims claims;
    std::string checksum;
};

// Returns `before` if the file is unmodified (null: not read before). `memory_bytes`: most that the process may take;
// 0: half of the machine's. If `job` is cancelled, the error's `what` is "cancelled", and the result must not be kept.
// Thread-safe.
[[nodiscard]] Loaded<ScanFile> read_scan(const ScanSource& source, const Loaded<ScanFile>* before,
                                         std::uint64_t memory_bytes, Job& job);

} // namespace ramus::app
