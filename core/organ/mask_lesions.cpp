#include "core/organ/mask_lesions.h"

#include "core/base/sort_unique.h"
#include "core/organ/label_surfaces.h"
#include "core/organ/organ.h"
#include "core/volume/bit_mask.h"
#include "core/volume/label_counts.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

namespace ramus::organ {

namespace {

using Labels = std::vector<volume::LabelChoice>;

// What is divided on its own, one or no label each.
Result<std::vector<Labels>> divided(const volume::Volume& volume, const Labels& labels) {
    std::vector<std::int32_t> numbers;
    if (labels.empty()) {
        for (const volume::LabelCount& count : volume::label_counts(volume)) numbers.push_back(count.label);
    } else {
        RAMUS_TRY(found, volume::label_numbers(volume, labels));
        numbers = std::move(found);
        sort_unique(numbers);
    }
    std::vector<Labels> each;
    for (const std::int32_t number : numbers) each.push_back({volume::LabelChoice(number)});
    if (each.empty()) each.emplace_back();
    return each;
}

// Without the voxels of other parts, which can be as many as a noisy mask has specks.
std::pair<Organ, std::vector<int>> kept_parts(const Organ& whole, const std::vector<std::uint32_t>& parts,
                                              std::size_t most) {
    volume::BitMask mask(whole.size());
    std::vector<int> labels;
    whole.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        if (parts[number] >= most) return;
        mask.set(voxel);
        labels.push_back(static_cast<int>(parts[number]));
    });
    return {Organ(std::move(mask), whole.to_patient()), std::move(labels)};
}

Result<MaskLesions> lesions_of_label(const Organ& whole, const std::string& name, std::size_t most,
                                     const JobRange& job) {
    const std::vector<std::uint32_t> parts = parts_of_voxels(whole);
    std::vector<std::size_t> voxels(1 + *std::ranges::max_element(parts));
    for (const std::uint32_t part : parts) ++voxels[part];
    const std::size_t count = std::min(most, voxels.size());
    const auto [kept, labels] = kept_parts(whole, parts, count);
    RAMUS_TRY(surfaces, label_surfaces(kept, labels, job));
    const auto solids = solids_of(kept, labels, count);
    MaskLesions found{{}, voxels.size() - count};
    for (std::size_t n = 0; n < count; ++n)
        found.lesions.push_back({name.empty() || voxels.size() == 1 ? name : name + ' ' + std::to_string(n + 1),
                                 surface_of(surfaces, static_cast<int>(n)), solids[n], voxels[n],
                                 1000.0 * whole.voxel_ml() * static_cast<double>(voxels[n])});
    return found;
}

} // namespace

Result<MaskLesions> mask_lesions(const volume::Volume& volume, const Labels& labels, std::size_t most,
                                 const JobRange& job) {
    RAMUS_TRY(each, divided(volume, labels));
    MaskLesions all;
    for (std::size_t n = 0; n < each.size(); ++n) {
        const float step = 1.0F / static_cast<float>(each.size()), from = step * static_cast<float>(n);
        RAMUS_TRY(whole, organ_of(volume, {each[n], {}}, job.part(from, from + 0.5F * step)));
        const volume::LabelName* name =
            each[n].empty() ? nullptr : volume::name_of_label(volume, each[n].front().number);
        RAMUS_TRY(found, lesions_of_label(whole, name != nullptr ? name->name : std::string(), most,
                                          job.part(from + 0.5F * step, from + step)));
        std::ranges::move(found.lesions, std::back_inserter(all.lesions));
        all.more += found.more;
    }
    std::ranges::stable_sort(all.lesions, std::ranges::greater{}, &MaskLesion::voxels);
    if (all.lesions.size() > most) {
        all.more += all.lesions.size() - most;
        all.lesions.erase(all.lesions.begin() + static_cast<std::ptrdiff_t>(most), all.lesions.end());
    }
    return all;
}

} // namespace ramus::organ
