#include "core/io/volumes/volume_file.h"

#include "core/io/trees/tree_format.h"

#include <new>

namespace ramus::io {

namespace {

Result<volume::Volume> read_any(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    auto source = ByteSource::open(path);
    if (!source) return tl::unexpected(source.error());
    const std::string extensions = readable_volume_extensions();
    const VolumeFormat* format = find_format(volume_formats(), source->head(), path);
    // A name alone does not make a volume that can be read.
    if (format != nullptr && is_read(*format) && format->has_signature(source->head()))
        return format->read(*source, options, job);
    if (format != nullptr && !is_read(*format) && format->has_signature == nullptr)
        return fail("this is half of a " + std::string(format->name), source->name(),
                    "convert the pair to one " + extensions + " file");
    if (format != nullptr && !is_read(*format))
        return fail(std::string(format->name) + " volumes are not yet read", source->name(),
                    "convert it to NIfTI (" + extensions + ")");
    if (find_format(tree_formats(), source->head(), path) != nullptr)
        return fail("this is a vessel tree, where a segmentation mask is needed", source->name(),
                    "name a NIfTI file (" + extensions + ")");
    return fail("this is no NIfTI file, or it is damaged", source->name(), "name a segmentation mask as " + extensions);
}

} // namespace

Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    try {
        return read_any(path, options, job);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this volume", path.string(), "crop it, or free some memory");
    }
}

} // namespace ramus::io
