#include "core/io/volumes/volume_unit.h"

#include "core/io/text_numbers.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>

namespace ramus::io {

namespace {

// Thresholds in mm of suspicions about the unit, not of decisions. The longest side of a patient's volume is between
// kShortestInMm and kLongest. A shorter volume with voxels finer than kFineStep is most likely in cm, or in metres.
constexpr double kShortestInMm = 60.0, kShortestInCm = 2.0, kLongest = 3000.0, kFineStep = 0.2;

void suspect_unit(volume::Volume& volume) {
    const glm::dvec3 step = volume::spacing_mm(volume.to_patient);
    const glm::dvec3 sides = step * glm::dvec3(volume.size);
    const double side = std::max({sides.x, sides.y, sides.z});
    const double finest = std::min({step.x, step.y, step.z});
    const std::string spans = "if a unit is 1 mm, the volume is " + short_number(side) + " mm long, with voxels of " +
                              short_number(finest) + " mm: ";
    if (side > kLongest)
        volume.suspicions.push_back(spans + "that is too large for a patient; --units um may be what is meant");
    else if (side < kShortestInCm && finest < kFineStep / 10.0)
        volume.suspicions.push_back(spans + "if this is a patient, --units m is what is meant");
    else if (side < kShortestInMm && side >= kShortestInCm && finest < kFineStep)
        volume.suspicions.push_back(spans + "if this is a patient, --units cm is what is meant");
}

} // namespace

Result<void> apply_unit(volume::Volume& volume, const std::optional<LengthUnit>& asked, const std::string& name) {
    const std::optional<double> stated = volume.unit_mm;
    if (!asked) {
        if (stated) return {};
        volume.notes.emplace_back("the file names no unit of length: a unit counts as 1 mm");
        suspect_unit(volume);
        return {};
    }
    if (!stated)
        volume.notes.push_back("lengths are in " + name_of(*asked) + " as asked for; the file does not say");
    else if (const LengthUnit said{glm::dvec3(*stated)}; said != *asked)
        volume.notes.push_back("lengths are in " + name_of(*asked) + " as asked for; the file says " + name_of(said));
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) volume.to_patient[column][row] *= asked->mm[row] / stated.value_or(1.0);
    return check_affine(volume.to_patient, volume.size, "geometry, in " + name_of(*asked), "correct --units", name);
}

tree::Claims claims_of(const volume::Volume& volume, const std::optional<LengthUnit>& asked) {
    using tree::SaidBy;
    return {asked            ? SaidBy::kPerson
            : volume.unit_mm ? SaidBy::kFile
                             : SaidBy::kNobody,
            volume::says_sides(volume) ? SaidBy::kFile : SaidBy::kNobody};
}

} // namespace ramus::io
