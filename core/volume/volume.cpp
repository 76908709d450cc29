#include "core/volume/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace ramus::volume {

std::size_t voxel_count(const glm::ivec3& size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}

bool says_sides(const Volume& volume) {
    return std::ranges::none_of(volume.notes,
                                [](const std::string& note) { return note.starts_with(kLeavesSidesOpen); });
}

bool holds_whole_numbers(const Volume& volume) {
    return !std::holds_alternative<SparseArray<float>>(volume.voxels) &&
           !std::holds_alternative<FractionRuns>(volume.voxels);
}

double value_at(const Volume& volume, const glm::ivec3& voxel) {
    const auto at = static_cast<std::size_t>(voxel.x) +
                    static_cast<std::size_t>(volume.size.x) *
                        (static_cast<std::size_t>(voxel.y) +
                         static_cast<std::size_t>(volume.size.y) * static_cast<std::size_t>(voxel.z));
    const double value = std::visit([&](const auto& values) { return static_cast<double>(values[at]); }, volume.voxels);
    const auto overlap = std::ranges::find(volume.overlaps, value, &Overlap::value);
    return overlap == volume.overlaps.end() ? value : overlap->labels.back();
}

const LabelName* name_of_label(const Volume& volume, std::int32_t label) {
    const auto found = std::ranges::find(volume.label_names, label, &LabelName::label);
    return found == volume.label_names.end() ? nullptr : &*found;
}

bool looks_like_a_mask(const Volume& volume) {
    return volume.segmentation ||
           (volume.minimum >= 0.0 && volume.maximum <= (holds_whole_numbers(volume) ? 255.0 : 1.0));
}

glm::dvec3 spacing_mm(const glm::dmat4& to_patient) {
    return {glm::length(glm::dvec3(to_patient[0])), glm::length(glm::dvec3(to_patient[1])),
            glm::length(glm::dvec3(to_patient[2]))};
}

double voxel_volume_mm3(const glm::dmat4& to_patient) { return std::abs(glm::determinant(glm::dmat3(to_patient))); }

bool mirrors(const glm::dmat4& to_patient) { return glm::determinant(glm::dmat3(to_patient)) < 0.0; }

std::string orientation(const glm::dmat4& to_patient) {
    // The assignment of the three axes to the patient's axes with the least rotation.
    std::array<int, 3> order{0, 1, 2};
    std::array<int, 3> best = order;
    double most = -1.0;
    do {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            sum += std::abs(glm::normalize(glm::dvec3(to_patient[axis]))[order[static_cast<std::size_t>(axis)]]);
        if (sum > most) most = sum, best = order;
    } while (std::ranges::next_permutation(order).found);
    std::string letters;
    for (int axis = 0; axis < 3; ++axis) {
        const int patient_axis = best[static_cast<std::size_t>(axis)];
        letters += (to_patient[axis][patient_axis] < 0.0 ? "LPI" : "RAS")[patient_axis];
    }
    return letters;
}

} // namespace ramus::volume
