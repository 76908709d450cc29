#include "core/io/volumes/volume_format.h"

#include "core/io/volumes/nifti_reader.h"

namespace ramus::io {

namespace {

bool is_nrrd(std::string_view head) { return head.starts_with("NRRD0"); }
bool is_meta_image(std::string_view head) { return head.starts_with("ObjectType") || head.starts_with("NDims"); }

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

} // namespace ramus::io
