// Reads the volumes that slices show (Scan in app/session/objects.h).
#pragma once

#include "app/assets/shapes.h"
#include "app/session/objects.h"
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
    auto operator<=>(const ScanSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};
[[nodiscard]] inline ScanSource source_of(const Scan& scan) { return {scan.file, scan.units}; }

struct ScanFile {
    std::shared_ptr<const volume::Volume> volume;
    slice::Window window;             // that the file proposes, otherwise from its values
    std::vector<std::int32_t> labels; // of a segmentation, ascending; empty: it is none
    tree::Claims claims;
    std::string checksum;
};

// Returns `before` if the file is unmodified (null: not read before). `memory_bytes`: most that the process may take;
// 0: half of the machine's. If `job` is cancelled, the error's `what` is "cancelled", and the result must not be kept.
// Thread-safe.
[[nodiscard]] Loaded<ScanFile> read_scan(const ScanSource& source, const Loaded<ScanFile>* before,
                                         std::uint64_t memory_bytes, Job& job);

} // namespace ramus::app
