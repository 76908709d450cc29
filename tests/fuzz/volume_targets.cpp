// The readers of volumes, by the table of formats, and headers whose values stand in another file.
#include "core/base/memory.h"
#include "core/io/volumes/label_names.h"
#include "core/io/volumes/volume_file.h"
#include "core/volume/label_counts.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/mat4x4.hpp>

namespace ramus::fuzz {

namespace {

void check_volume(const volume::Volume& volume) {
    must(volume.size.x > 0 && volume.size.y > 0 && volume.size.z > 0, "a volume is empty");
    must(volume.minimum <= volume.maximum, "the least value is above the greatest");
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) must(std::isfinite(volume.to_patient[column][row]), "a volume lies nowhere");
    must(glm::determinant(volume.to_patient) != 0.0, "the voxels of a volume are flat");
    for (const glm::ivec3& voxel : {glm::ivec3(0), volume.size / 2, volume.size - 1}) {
        // Fractions are kept in single precision; the range is that of the file's numbers.
        const auto value = static_cast<float>(value_at(volume, voxel));
        must(value >= static_cast<float>(volume.minimum) && value <= static_cast<float>(volume.maximum),
             "a value is out of range");
    }
    const auto counts = volume::label_counts(volume);
    for (const volume::Overlap& overlap : volume.overlaps) {
        must(overlap.labels.size() > 1 && overlap.labels.back() < overlap.value, "an overlap is none");
        for (const std::int32_t label : overlap.labels)
            must(std::ranges::count(counts, label, &volume::LabelCount::label) == 1, "a label of an overlap is lost");
    }
}

void read_from(const io::VolumeFormat& format, Result<io::ByteSource> source, const std::string& name) {
    if (!source) return check_error(source.error(), name);
    if (!format.has_signature(source->head())) return; // as read_volume() sees to
    constexpr double kMemory = 256e6;
    Job job;
    const auto volume = format.read(*source, {process_memory() + kMemory, {}}, job);
    if (volume) return check_volume(*volume);
    must(!volume.error().what.empty() && !volume.error().where.empty() && !volume.error().hint.empty(),
         "an error does not say enough: " + volume.error().message());
}

void read_names(std::string_view bytes) {
    const auto table = io::label_table_names(bytes);
    const auto described = io::described_names(bytes);
    for (const auto& names : {table, described.value_or(table)})
        for (std::size_t n = 0; n < names.size(); ++n)
            must(names[n].label != 0 && (n == 0 || names[n - 1].label < names[n].label), "labels are not in order");
}

// A group with attributes and one array of one chunk: .zarray, .zattrs and the chunk, one behind the other.
void read_zarr(std::string_view bytes) {
    namespace fs = std::filesystem;
    const auto [array, rest] = two_files(bytes);
    const auto [attributes, chunk] = two_files(rest);
    const fs::path folder = fs::path(written_file("volume.zarr.txt", {})).replace_extension();
    fs::remove_all(folder);
    fs::create_directories(folder / "0");
    (void)written_file("volume.zarr/.zgroup", "{}");
    (void)written_file("volume.zarr/.zattrs", attributes);
    (void)written_file("volume.zarr/0/.zarray", array);
    for (const char* name : {"0.0", "0.0.0", "0.0.0.0.0"})
        (void)written_file("volume.zarr/0/" + std::string(name), chunk);
    constexpr double kMemory = 256e6;
    for (const fs::path& path : {folder, folder / "0"}) {
        Job job;
        const auto volume = io::read_volume(path, {process_memory() + kMemory, {}, {}}, job);
        if (volume)
            check_volume(*volume);
        else
            check_error(volume.error(), folder.string());
    }
}

} // namespace

std::vector<Target> volume_targets() {
    std::vector<Target> targets{{"labels", read_names}};
    for (const io::VolumeFormat& format : io::volume_formats()) {
        if (format.read == nullptr) continue;
        const std::string extension(format.extensions.front());
        targets.push_back({extension.substr(1), [&format, name = "volume" + extension](std::string_view bytes) {
                               read_from(format, io::ByteSource::of_memory(bytes, name), name);
                           }});
        if (extension != ".nrrd" && extension != ".mha") continue;
        // A header, and the values beside it as "values.raw".
        const std::string detached(format.extensions.back());
        targets.push_back({detached.substr(1), [&format, detached](std::string_view bytes) {
                               const auto [header, values] = two_files(bytes);
                               (void)written_file("values.raw", values);
                               const std::string path = written_file("volume" + detached, header);
                               read_from(format, io::ByteSource::open(path), path);
                           }});
    }
    targets.push_back({"zarr", read_zarr});
    return targets;
}

} // namespace ramus::fuzz
