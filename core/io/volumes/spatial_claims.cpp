#include "core/io/volumes/spatial_claims.h"

#include "core/io/length_unit.h"
#include "core/io/text_numbers.h"
#include "core/io/volumes/voxel_data.h"

#include <cmath>

namespace ramus::io {

bool can_be_spacing(double value) { return std::isfinite(value) && value > 0.0; }

std::optional<double> microscopy_unit_mm(std::string_view unit) {
    unit = trimmed(unit);
    // "\u00B5m" is written out by ImageJ, or as one byte of Latin-1.
    if (unit == "\\u00B5m" || unit == "\\u00b5m" || unit == "\xB5m") return named_unit_mm("um");
    return named_unit_mm(unit);
}

Result<void> place_by(const SpatialClaims& claims, volume::Volume& volume, const std::string& name) {
    std::vector<std::string> notes = claims.notes;
    notes.push_back(std::string(volume::kLeavesSidesOpen) + ": axes taken as left, posterior, superior");
    const auto& [x, y, z] = claims.spacing;
    const double across = x.value_or(y.value_or(z.value_or(1.0)));
    const glm::dvec3 spacing(across, y.value_or(across), z.value_or(across));
    if (!x && !y && !z)
        notes.emplace_back("the file does not say how far voxels are apart: taken as 1 mm");
    else if ((!x || !y || !z) && volume.size.z > 1)
        notes.push_back(std::string("the file does not say how far voxels are apart along ") +
                        (!z   ? "z"
                         : !y ? "y"
                              : "x") +
                        ": taken as " + short_number(across) + " as along another axis");
    glm::dmat4 affine(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        affine[axis][axis] = spacing[axis];
        affine[3][axis] = claims.origin[axis];
    }
    volume.to_patient = lps_to_ras(affine);
    volume.unit_mm = claims.unit_mm;
    volume.notes.insert(volume.notes.begin(), notes.begin(), notes.end());
    volume.suspicions.insert(volume.suspicions.end(), claims.suspicions.begin(), claims.suspicions.end());
    return check_affine(volume.to_patient, volume.size, "spacing",
                        "correct how far its voxels are apart and write it again", name);
}

} // namespace ramus::io
