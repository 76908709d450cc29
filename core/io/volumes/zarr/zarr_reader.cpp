#include "core/io/volumes/zarr/zarr_reader.h"

#include "core/io/volumes/zarr/zarr_chunks.h"
#include "core/io/volumes/zarr/zarr_image.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ramus::io {

Result<volume::Volume> read_zarr_folder(const std::filesystem::path& folder, const ReadVolumeOptions& options,
                                        Job& job) {
    const std::string name = folder.string();
    RAMUS_TRY(image, zarr_image(folder));
    RAMUS_TRY(part, chosen_part(image.parts, options.part, name));
    std::vector<std::int64_t> extents;
    for (const std::uint64_t extent : zarr_extents(image))
        extents.push_back(static_cast<std::int64_t>(
            std::min(extent, static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))));
    VoxelLayout layout;
    RAMUS_TRY(size, checked_size(extents, name));
    layout.size = size;
    layout.type = image.array.type;
    layout.encoding = image.array.swapped ? Encoding::kSwapped : Encoding::kBinary;
    const volume::Keeping keeping = options.keeping();
    const double bytes = static_cast<double>(bytes_of(layout.type)) * static_cast<double>(size.x) *
                         static_cast<double>(size.y) * static_cast<double>(size.z);
    // Missing chunks take no bytes, so the files do not bound the number of voxels; memory does.
    if (auto fits = check_declared_size({size, bytes, bytes, keeping.memory_bytes}, name); !fits)
        return tl::unexpected(fits.error());
    RAMUS_TRY(stage, zarr_stage(image, part, options.memory_bytes, job));
    RAMUS_TRY(source, ByteSource::of_stage(std::move(stage), name, bytes));
    RAMUS_TRY(volume, read_voxels(source, 0, layout, keeping, job));
    if (auto placed = place_by(image.claims, volume, name); !placed) return tl::unexpected(placed.error());
    volume.type =
        image.program + ", " + std::string(name_of(layout.type)) + (part.words.empty() ? "" : ", " + part.words);
    return std::move(volume);
}

} // namespace ramus::io
