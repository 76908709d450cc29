#include "core/io/volumes/dicom/dicom_folder.h"

#include "core/io/file_format.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <map>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <system_error>
#include <tuple>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

std::size_t slices_of(const DicomImage& image) {
    if (image.segments == SegmentKind::kNone) return image.frames.size();
    std::vector<std::array<double, 3>> places;
    for (const DicomFrame& frame : image.frames)
        if (frame.position) places.push_back({frame.position->x, frame.position->y, frame.position->z});
    std::ranges::sort(places);
    return static_cast<std::size_t>(std::unique(places.begin(), places.end()) - places.begin());
}

} // namespace

bool begins_as_dicom(const fs::path& file) {
    std::array<char, kHeadBytes> head{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), head.size());
    return is_dicom({head.data(), static_cast<std::size_t>(stream.gcount())});
}

Result<DicomFolder> read_dicom_headers(const fs::path& folder, const JobRange& job) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator each(folder.empty() ? "." : folder, error); !error && each != fs::directory_iterator();
         each.increment(error)) {
        std::error_code ignored;
        if (each->is_regular_file(ignored)) files.push_back(folder / each->path().filename());
    }
    if (error) return fail("cannot be listed: " + error.message(), folder.string(), "check its permissions");
    std::ranges::sort(files);

    std::vector<Result<std::optional<DicomImage>>> read(files.size(), std::nullopt);
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t n) {
        if (job.cancelled() || !begins_as_dicom(files[n])) return;
        read[n] = read_dicom_image({files[n], nullptr, files[n].string()});
        job.report(static_cast<float>(++done) / static_cast<float>(files.size()));
    });
    if (job.cancelled()) return fail("cancelled");
    DicomFolder found;
    for (auto& image : read) {
        if (!image)
            found.unreadable.push_back(image.error());
        else if (*image)
            found.images.push_back(std::move(**image));
    }
    return found;
}

std::vector<DicomSeries> series_of(std::vector<DicomImage> images) {
    std::map<std::tuple<std::string, std::string>, DicomSeries> groups;
    for (DicomImage& image : images) {
        const bool alone = image.frames.size() > 1 || image.segments != SegmentKind::kNone || image.series_uid.empty();
        DicomSeries& series = groups[{image.series_uid, alone ? image.file.name : std::string()}];
        series.slices += slices_of(image);
        series.images.push_back(std::move(image));
    }
    std::vector<DicomSeries> all;
    for (auto& [key, series] : groups) all.push_back(std::move(series));
    // Among equals, a scan comes before its segmentation.
    std::ranges::stable_sort(all, [](const DicomSeries& a, const DicomSeries& b) {
        const bool marks_a = a.images.front().segments != SegmentKind::kNone;
        const bool marks_b = b.images.front().segments != SegmentKind::kNone;
        return a.slices != b.slices ? a.slices > b.slices : marks_a < marks_b;
    });
    return all;
}

} // namespace ramus::io
