#include "app/workspace/volume_facts.h"

#include "app/session/numbers.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/volume/label_counts.h"

#include <algorithm>

namespace ramus::app {

namespace {

// Numbers of different values except 0. Masks of whole bodies have more than a hundred labels, 8-bit scans nearly all
// 255 values; in between the user must decide.
constexpr std::size_t kSurelyLabels = 64, kRatherLabels = 150, kMostLabels = 255;

std::vector<LabelFacts> labels_of(const volume::Volume& volume, const std::vector<volume::LabelCount>& counts) {
    const double voxel = volume::voxel_volume_mm3(volume.to_patient);
    std::vector<LabelFacts> labels;
    for (const auto& [label, voxels] : counts) {
        const volume::LabelName* named = volume::name_of_label(volume, label);
        labels.push_back({.label = label,
                          .name = named == nullptr ? std::string() : named->name,
                          .voxels = voxels,
                          .volume_mm3 = static_cast<double>(voxels) * voxel});
    }
    return labels;
}

} // namespace

Result<VolumeFacts> read_volume_facts(const std::filesystem::path& path, const io::ReadOptions& options,
                                      double memory_bytes, Job& job) {
    RAMUS_TRY(volume, io::read_volume(path, {memory_bytes, options.unit, options.part}, job));
    VolumeFacts facts;
    facts.size = volume.size;
    facts.spacing_mm = volume::spacing_mm(volume.to_patient);
    facts.voxel_mm3 = volume::voxel_volume_mm3(volume.to_patient);
    facts.claims = io::claims_of(volume, options.unit);
    facts.type = volume.type;
    facts.orientation = volume::says_sides(volume) ? volume::orientation(volume.to_patient) : "";
    facts.minimum = volume.minimum;
    facts.maximum = volume.maximum;
    facts.suspicions = volume.suspicions;
    facts.all_at_once = volume::looks_like_a_mask(volume);
    const std::vector<volume::LabelCount> counts = volume::label_counts(volume);
    facts.mask = volume::holds_whole_numbers(volume)
                     ? volume.segmentation || counts.size() <= kSurelyLabels ||
                           (counts.size() <= kMostLabels && !volume.label_names.empty()) ||
                           (counts.size() <= kRatherLabels && facts.all_at_once)
                     : facts.all_at_once;
    if (volume.segmentation || counts.size() <= kMostLabels) facts.labels = labels_of(volume, counts);
    if (facts.mask && (volume.segmentation || counts.size() <= kSurelyLabels)) return facts;
    auto curve = volume::threshold_curve(volume, JobRange(job, 0.0F, 1.0F));
    if (job.cancelled()) return fail("cancelled");
    if (curve) facts.curve = std::make_shared<const volume::ThresholdCurve>(std::move(*curve));
    return facts;
}

std::string words_for(const VolumeFacts& facts) {
    if (!facts.mask) return "A scan, values from " + rounded(facts.minimum) + " to " + rounded(facts.maximum);
    if (facts.labels.empty() && facts.maximum <= 0.0) return "A mask with nothing in it";
    if (facts.labels.empty()) return "A mask of fractions, inside from 0.5";
    return "A mask with " + counted(facts.labels.size(), "label", "labels");
}

} // namespace ramus::app
