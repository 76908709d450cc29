#include "core/io/volumes/volume_file.h"

#include "core/io/trees/tree_file.h"
#include "core/io/volumes/nifti_reader.h"

#include <new>

namespace ramus::io {

namespace {

bool is_nrrd(std::string_view head) { return head.starts_with("NRRD0"); }
bool is_meta_image(std::string_view head) { return head.starts_with("ObjectType") || head.starts_with("NDims"); }

Result<volume::Volume> read_any(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    RAMUS_TRY(source, ByteSource::open(path));
    const std::string extensions = readable_volume_extensions();
    const VolumeFormat* format = find_format(volume_formats(), source.head(), path);
    // A name alone does not make a volume that can be read.
    if (format != nullptr && is_read(*format) && format->has_signature(source.head()))
        return format->read(source, options, job);
    if (format != nullptr && !is_read(*format) && format->has_signature == nullptr)
        return fail("this is half of a " + std::string(format->name), source.name(),
                    "convert the pair to one " + extensions + " file");
    if (format != nullptr && !is_read(*format))
        return fail(std::string(format->name) + " volumes are not yet read", source.name(),
                    "convert it to NIfTI (" + extensions + ")");
    if (find_format(tree_formats(), source.head(), path) != nullptr)
        return fail("this is a vessel tree, where a segmentation mask is needed", source.name(),
                    "name a NIfTI file (" + extensions + ")");
    return fail("this is no NIfTI file, or it is damaged", source.name(), "name a segmentation mask as " + extensions);
}

} // namespace

const std::vector<VolumeFormat>& volume_formats() {
    static const std::vector<VolumeFormat> table = {
        {{.name = "NIfTI",
          .extensions = {".nii", ".nii.gz"},
          .has_signature = is_nifti,
          .states_unit = true,
          .states_orientation = true,
          .help = "NIfTI-1 and NIfTI-2 in one file, compressed or not."},
         read_nifti},
        // One of these alone says too little; the reader says what to do.
        {{.name = "pair of files (.hdr and .img)",
          .extensions = {".hdr", ".img"},
          .help = "ANALYZE 7.5, or NIfTI in two files: known, but not read."}},
        {{.name = "NRRD",
          .extensions = {".nrrd", ".nhdr"},
          .has_signature = is_nrrd,
          .states_unit = true,
          .states_orientation = true,
          .help = "Known, but not read."}},
        {{.name = "MetaImage",
          .extensions = {".mha", ".mhd"},
          .has_signature = is_meta_image,
          .states_orientation = true,
          .help = "Known, but not read."}},
    };
    return table;
}

std::string readable_volume_extensions() { return listed(readable_extensions(volume_formats())); }

bool names_volume(const std::filesystem::path& path) { return format_by_name(volume_formats(), path) != nullptr; }

Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    try {
        return read_any(path, options, job);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this volume", path.string(), "crop it, or free some memory");
    }
}

} // namespace ramus::io
