// Writes volumes of values: a scan, slices of it, or distances. The values are given slice by slice, so that the volume
// need not be in memory. label_map_file.h writes label maps by it.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace ramus::io {

// Fills slice k; x fastest. All values are 0 before.
template <class T> using FillSlice = std::function<void(int k, std::span<T> values)>;

struct ValueMap {
    glm::ivec3 size{0};
    glm::dmat4 to_patient{1.0}; // from voxel indices to mm (RAS); any invertible matrix
    tree::Claims claims;        // what is not known is not written
    // Its alternative is the type of the file.
    std::variant<FillSlice<std::uint8_t>, FillSlice<std::uint16_t>, FillSlice<std::int16_t>, FillSlice<std::int32_t>,
                 FillSlice<float>>
        fill_slice;
    std::string value_unit = {};                        // "HU"; only NRRD can state it
    std::optional<volume::DisplayWindow> window = {};   // only NIfTI can state it
    std::string nifti_extension = {}, nrrd_fields = {}; // further content of the header, complete
    int nifti_intent = 0;
};

// The values of a volume, in its own type, with its unit and window. `volume` must outlive the result.
[[nodiscard]] ValueMap value_map(const volume::Volume& volume, const tree::Claims& claims);

// The kinds of files, for help: ".nii.gz, .nii or .nrrd".
[[nodiscard]] std::string value_map_extensions();
[[nodiscard]] bool names_value_map(const std::filesystem::path& target); // by its extension
// Fails if no format has this extension, or the file cannot be written.
[[nodiscard]] Result<void> check_value_map_output(const std::filesystem::path& target);

// Writes NIfTI-1 or NRRD; voxels are compressed except in .nii. NIfTI keeps `to_patient` in single precision. Fails if
// the file cannot be written, if a side has more than 32,767 voxels, and when cancelled (what == "cancelled").
[[nodiscard]] Result<void> write_value_map(const ValueMap& map, const std::filesystem::path& target,
                                           const JobRange& job);

} // namespace ramus::io
