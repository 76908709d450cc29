#include "core/volume/read_volume.h"

#include "core/volume/byte_source.h"
#include "core/volume/nifti_reader.h"

#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <string_view>

namespace ramus::volume {

namespace {

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return text;
}

// Another reader takes its place here, beside NIfTI's.
tl::unexpected<Error> not_yet(const std::string& format, const std::string& name) {
    return fail(format + " volumes are not yet read", name, "convert it to NIfTI (.nii or .nii.gz)");
}

Result<Volume> read(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    auto source = ByteSource::open(path);
    if (!source) return tl::unexpected(source.error());
    if (nifti_version(source->head()) >= 0) return read_nifti(*source, options, job);
    const std::string_view head = source->head();
    const std::string extension = lower_case(path.extension().string());
    if (head.starts_with("NRRD0") || extension == ".nrrd" || extension == ".nhdr")
        return not_yet("NRRD", source->name());
    if (head.starts_with("ObjectType") || head.starts_with("NDims") || extension == ".mha" || extension == ".mhd")
        return not_yet("MetaImage", source->name());
    if (extension == ".img")
        return fail("this is half of a pair of files (.hdr and .img)", source->name(),
                    "convert the pair to one .nii or .nii.gz file");
    if (extension == ".swc" || extension == ".json")
        return fail("this is a vessel tree, where a segmentation mask is needed", source->name(),
                    "name a NIfTI file (.nii or .nii.gz)");
    return fail("this is no NIfTI file, or it is damaged", source->name(),
                "name a segmentation mask as .nii or .nii.gz");
}

} // namespace

Result<Volume> read_volume(const std::filesystem::path& path, const ReadVolumeOptions& options, Job& job) {
    try {
        return read(path, options, job);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this volume", path.string(), "crop it, or free some memory");
    }
}

bool names_volume(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 8> kEndings = {".nii",  ".nii.gz", ".hdr", ".img",
                                                          ".nrrd", ".nhdr",   ".mha", ".mhd"};
    const std::string name = lower_case(path.filename().string());
    return std::ranges::any_of(kEndings, [&](std::string_view ending) { return name.ends_with(ending); });
}

} // namespace ramus::volume
