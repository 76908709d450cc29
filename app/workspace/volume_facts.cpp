#include "app/workspace/volume_facts.h"

#include "app/session/numbers.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/volume/label_counts.h"

#include <algorithm>

namespace ramus::app {

Result<VolumeFacts> read_volume_facts(const std::filesystem::path& path, const io::ReadOptions& options,
                                      double memory_bytes, Job& job) {
    RAMUS_TRY(volume, io::read_volume(path, {memory_bytes, options.unit}, job));
    VolumeFacts facts;
    facts.size = volume.size;
    facts.spacing_mm = volume::spacing_mm(volume.to_patient);
    facts.claims = io::claims_of(volume, options.unit);
    facts.type = volume.type;
    facts.orientation = volume::says_sides(volume) ? volume::orientation(volume.to_patient) : "";
    facts.minimum = volume.minimum;
    facts.maximum = volume.maximum;
    facts.mask = volume::looks_like_a_mask(volume);
    facts.suspicions = volume.suspicions;
    if (!facts.mask) return facts;
    const double voxel = volume::voxel_volume_mm3(volume.to_patient);
    for (const auto& [label, voxels] : volume::label_counts(volume)) {
        const auto named = std::ranges::find(volume.label_names, label, &volume::LabelName::label);
        facts.labels.push_back({label, named == volume.label_names.end() ? std::string() : named->name, voxels,
                                static_cast<double>(voxels) * voxel});
    }
    return facts;
}

std::string words_for(const VolumeFacts& facts) {
    if (!facts.mask) return "A scan, values from " + rounded(facts.minimum) + " to " + rounded(facts.maximum);
    if (facts.labels.empty() && facts.maximum <= 0.0) return "A mask with nothing in it";
    if (facts.labels.empty()) return "A mask of fractions, inside from 0.5";
    return "A mask with " + counted(facts.labels.size(), "label", "labels");
}

} // namespace ramus::app
