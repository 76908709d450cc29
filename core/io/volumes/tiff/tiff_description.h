// Reads what programs for microscopes write into the description of a TIFF file: ImageJ's lines ("images=120",
// "spacing=2.0", "unit=micron") and OME-XML (Open Microscopy Environment, schema 2016-06). It says which plane a page
// is and how far voxels are apart. Without it, pages are slices, and distances come from the resolution tags.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/spatial_claims.h"
#include "core/io/volumes/tiff/tiff_layout.h"
#include "core/io/volumes/volume_part.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct TiffDescription {
    std::string program; // "ImageJ", "OME"; empty: neither
    VolumeParts parts;
    std::uint64_t slices = 1;
    // The axes of the planes, the one that changes fastest first: 'C', 'Z', 'T'.
    std::string order = "CZT";
    // Pages that hold planes, as OME-XML lists them: planes from number `plane` on, in `order`. Ascending by `plane`.
    // Empty: all pages, in order.
    struct Run {
        std::uint64_t plane = 0, page = 0, count = 0;
    };
    std::vector<Run> runs;
    SpatialClaims claims;

    // The number of planes; the largest number if it overflows.
    [[nodiscard]] std::uint64_t planes() const;
    // The number of a plane, in `order`.
    [[nodiscard]] std::uint64_t plane_at(std::uint64_t channel, std::uint64_t slice, std::uint64_t time) const;
};

// The description of a file whose pages are known. Fails on invalid XML, on sizes below 1, and if the planes are in
// several files.
[[nodiscard]] Result<TiffDescription> tiff_description(const TiffLayout& layout, const std::string& name);

} // namespace ramus::io
