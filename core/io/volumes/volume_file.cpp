#include "core/io/volumes/volume_file.h"

#include "core/base/memory.h"
#include "core/base/printable.h"
#include "core/io/recognise.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/dicom/dicom_reader.h"
#include "core/io/volumes/label_names.h"
#include "core/io/volumes/meta_image_reader.h"
#include "core/io/volumes/nifti_reader.h"
#include "core/io/volumes/nrrd_reader.h"
#include "core/io/volumes/tiff/tiff_reader.h"
#include "core/io/volumes/volume_unit.h"
#include "core/io/volumes/zarr/zarr_image.h"
#include "core/io/volumes/zarr/zarr_reader.h"

#include <new>
#include <system_error>

namespace ramus::io {

namespace {

Result<volume::Volume> read_any(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        if (const VolumeFormat* format = recognised(path).volume) return format->read_folder(path, options, job);
        return fail("this folder holds no DICOM image, no TIFF file and no Zarr array", path.string(),
                    "name a file in it");
    }
    RAMUS_TRY(source, ByteSource::open(path));
    const std::string extensions = readable_volume_extensions();
    const Recognised found = recognised(source.head(), path);
    const VolumeFormat* format = found.volume;
    // A name alone does not make a volume that can be read.
    if (format != nullptr && found.by_content) return format->read(source, options, job);
    if (format != nullptr && is_read(*format) && format->read == nullptr)
        return fail("this is a file, and " + std::string(format->name) + " is read as a folder", source.name(),
                    "unpack it if it is an archive, and name the folder");
    if (format != nullptr && !is_read(*format))
        return fail("this is half of a " + std::string(format->name), source.name(),
                    "convert the pair to one file: " + extensions);
    if (format != nullptr)
        return fail("this is no " + std::string(format->name) + " file, or it is damaged", source.name(),
                    "name a segmentation mask or a scan as " + extensions);
    if (found)
        return fail(std::string("this is a ") + (found.tree != nullptr ? "vessel tree" : "surface mesh") +
                        ", where a segmentation mask is needed",
                    source.name(), "name a file as " + extensions);
    return fail("this is no volume that can be read, or it is damaged", source.name(),
                "name a segmentation mask or a scan as " + extensions);
}

} // namespace

const std::vector<VolumeFormat>& volume_formats() {
    static const std::vector<VolumeFormat> table = {
        {{.name = "NIfTI",
          .extensions = {".nii", ".nii.gz"},
          .has_signature = is_nifti,
          .certainty = Certainty::kHeader,
          .help = "NIfTI-1 and NIfTI-2 in one file, compressed or not."},
         read_nifti},
        // Refused with a message: one file of a pair is not enough.
        {{.name = "pair of files (.hdr and .img)",
          .extensions = {".hdr", ".img"},
          .help = "ANALYZE 7.5, or NIfTI in two files: known, but not read."}},
        {{.name = "NRRD",
          .extensions = {".nrrd", ".nhdr"},
          .has_signature = is_nrrd,
          .help = "A header of text, and values behind it or in another file, compressed or not."},
         read_nrrd},
        {{.name = "MetaImage",
          .extensions = {".mha", ".mhd"},
          .has_signature = is_meta_image,
          .certainty = Certainty::kHeader,
          .help = "A header of fields, and values behind it or in another file, compressed or not."},
         read_meta_image},
        {{.name = "Zarr",
          .extensions = {".zarr"},
          .help = "The folder of an OME-Zarr image, of one of its levels, or of an array (Zarr 2)."},
         nullptr,
         is_zarr_folder,
         read_zarr_folder},
        {{.name = "DICOM",
          .extensions = {".dcm", ".dicom", ".ima"},
          .has_signature = is_dicom,
          .help = "A series of images in a folder, named by the folder or one of them, or a segmentation."},
         read_dicom,
         holds_dicom,
         read_dicom_folder},
        {{.name = "TIFF",
          .extensions = {".tif", ".tiff"},
          .has_signature = is_tiff,
          .help =
              "TIFF and BigTIFF: the pages of a file (ImageJ, OME), or a stack of files, named by the folder or one of "
              "them."},
         read_tiff,
         holds_tiff,
         read_tiff_folder},
    };
    return table;
}

std::string readable_volume_extensions() { return listed(readable_extensions(volume_formats())); }

bool names_volume(const std::filesystem::path& path) {
    return format_by_name(volume_formats(), without_gz(path)) != nullptr;
}

bool is_volume(const std::filesystem::path& path) { return recognised(path).volume != nullptr; }

volume::Keeping ReadVolumeOptions::keeping() const { return {memory_left(memory_bytes), threshold}; }

Result<volume::Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    try {
        RAMUS_TRY(volume, read_any(path, options, job));
        take_described_names(path, volume);
        for (volume::LabelName& each : volume.label_names) each.name = printable(each.name);
        volume.value_unit = printable(volume.value_unit);
        volume.modality = printable(volume.modality);
        if (auto applied = apply_unit(volume, options.unit, input_name(path)); !applied)
            return tl::unexpected(applied.error());
        return std::move(volume); // a reference: would be copied
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this volume", input_name(path), "crop it, or free some memory");
    }
}

} // namespace ramus::io
