#include "app/assets/scans.h"

#include "app/session/session_file.h"
#include "core/io/length_unit.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/volume/label_counts.h"

#include <new>
#include <utility>

namespace ramus::app {

namespace {

Result<std::shared_ptr<const ScanFile>> read_volume_of(const ScanSource& source, std::uint64_t memory_bytes, Job& job) {
    try {
        const auto unit = io::length_unit(source.units);
        RAMUS_TRY(volume, io::read_volume(source.file, {static_cast<double>(memory_bytes), unit, source.part}, job));
        RAMUS_TRY(checksum, checksum_of(source.file));
        ScanFile scan;
        scan.claims = io::claims_of(volume, unit);
        scan.window = slice::usual_window(volume);
        scan.labels = segmentation_labels(volume);
        scan.checksum = std::move(checksum);
        scan.volume = std::make_shared<const volume::Volume>(std::move(volume));
        return std::make_shared<const ScanFile>(std::move(scan));
    } catch (const std::bad_alloc&) {
        return fail("there is not enough memory for it", source.file,
                    "give a coarser scan, or allow more with --memory");
    }
}

} // namespace

std::vector<std::int32_t> segmentation_labels(const volume::Volume& volume) {
    std::vector<std::int32_t> labels;
    if (!volume::looks_like_a_mask(volume) || !volume::holds_whole_numbers(volume)) return labels;
    for (const volume::LabelCount& count : volume::label_counts(volume)) labels.push_back(count.label);
    return labels;
}

bool holds_labels(const volume::Volume& volume, const std::vector<std::int32_t>& labels) {
    return volume.segmentation || !volume.overlaps.empty() || (!labels.empty() && labels.size() <= kMostShownLabels);
}

Loaded<ScanFile> read_scan(const ScanSource& source, const Loaded<ScanFile>* before, std::uint64_t memory_bytes,
                           Job& job) {
    auto loaded =
        read_if_written(source.file, before, "the scan", [&] { return read_volume_of(source, memory_bytes, job); });
    if (job.cancelled()) loaded.value = fail("cancelled");
    return loaded;
}

} // namespace ramus::app
