// Finds the array to read in a folder of Zarr's format, version 2: the folder of an array, or of an OME-Zarr image
// (OME-NGFF 0.1 to 0.4), which holds the same image at several levels of detail. The attributes of the image say what
// the axes mean and how far voxels are apart. Paths in the attributes cannot lead out of the folder.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/spatial_claims.h"
#include "core/io/volumes/volume_part.h"
#include "core/io/volumes/zarr/zarr_array.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace ramus::io {

struct ZarrImage {
    std::filesystem::path folder; // of the array
    ZarrArray array;
    std::array<std::size_t, 3> space{}; // axes of the array that are x, y and z
    bool has_z = true;                  // false: space[2] is no axis
    std::optional<std::size_t> channel, time;
    VolumeParts parts;
    SpatialClaims claims;
    std::string program; // "OME-Zarr 0.4"; "Zarr" for a plain array
};

// Whether the folder is an array or a group of Zarr, of version 2 or 3.
[[nodiscard]] bool is_zarr_folder(const std::filesystem::path& folder);

// The finest level of the image, or the level or array whose folder is named. A note says which levels there are. Fails
// on version 3, on groups without an image, on axes that are not known, and on damaged descriptions.
[[nodiscard]] Result<ZarrImage> zarr_image(const std::filesystem::path& folder);

} // namespace ramus::io
