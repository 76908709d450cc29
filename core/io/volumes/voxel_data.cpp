#include "core/io/volumes/voxel_data.h"

#include "core/base/memory.h"
#include "core/io/volumes/slicer_segments.h"
#include "core/tree/build_tree.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_pipeline.h>

namespace ramus::io {

namespace {

struct Reading {
    ByteSource& source;
    const VoxelLayout& layout;
    std::size_t voxels; // numbers, of layers several for each voxel
    Job& job;

    void report(std::size_t done) const { job.report(static_cast<float>(done) / static_cast<float>(voxels)); }
};

template <class Raw>
Result<void> keep(const Reading& reading, const Raw* raw, std::size_t count, volume::VoxelStore& store) {
    if (reading.layout.layers == nullptr) return store.append(raw, count, reading.layout.scaling);
    RAMUS_TRY(values, reading.layout.layers->merged({raw, raw + count}, reading.source.name()));
    return values.empty() ? Result<void>{} : store.append(values.data(), values.size(), {});
}

template <class Raw> void swap_bytes(std::vector<Raw>& raw, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) {
        auto* bytes = reinterpret_cast<char*>(&raw[n]);
        std::reverse(bytes, bytes + sizeof(Raw));
    }
}

// Reads a megabyte at a time, because even the declared size of one slice may be too large.
constexpr std::size_t kAtOnce = std::size_t{1} << 20;

// Reads (and decompresses) on one thread while another stores what was read before.
template <class Raw> Result<void> read_binary(const Reading& reading, volume::VoxelStore& store) {
    struct Piece {
        std::vector<Raw> raw;
        std::size_t count = 0;
    };
    constexpr std::size_t kPieces = 3;
    std::array<Piece, kPieces> pieces;
    const std::size_t most = std::min(kAtOnce / sizeof(Raw), reading.voxels);
    std::size_t begun = 0, next = 0, done = 0;
    Result<void> read, kept;
    std::atomic<bool> failed = false; // to store; ends reading
    const auto read_piece = [&](tbb::flow_control& flow) -> Piece* {
        if (begun == reading.voxels || failed || reading.job.cancelled()) {
            flow.stop();
            return nullptr;
        }
        Piece& piece = pieces[next++ % kPieces];
        piece.raw.resize(most);
        piece.count = std::min(most, reading.voxels - begun);
        begun += piece.count;
        read = reading.source.read(piece.raw.data(), piece.count * sizeof(Raw));
        if (read && reading.layout.encoding == Encoding::kSwapped && sizeof(Raw) > 1)
            swap_bytes(piece.raw, piece.count);
        if (!read) flow.stop();
        return &piece;
    };
    const auto keep_piece = [&](Piece* piece) {
        if (failed) return;
        kept = keep(reading, piece->raw.data(), piece->count, store);
        failed = !kept;
        done += piece->count;
        reading.report(done);
    };
    constexpr auto kInOrder = tbb::filter_mode::serial_in_order;
    tbb::parallel_pipeline(kPieces, tbb::make_filter<void, Piece*>(kInOrder, read_piece) &
                                        tbb::make_filter<Piece*, void>(kInOrder, keep_piece));
    if (!kept) return kept;
    if (!read) return read;
    return done < reading.voxels ? fail("cancelled") : Result<void>{};
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }

// Parses up to `count` numbers at the beginning of `text`, and returns the number of bytes used. Unless `is_all`,
// leaves the last word, which may continue after `text`.
template <class Raw>
Result<std::size_t> parse_numbers(std::string_view text, bool is_all, std::vector<Raw>& raw, std::size_t count) {
    std::size_t used = 0;
    while (raw.size() < count) {
        std::size_t begin = used;
        while (begin < text.size() && is_blank(text[begin])) ++begin;
        std::size_t end = begin;
        while (end < text.size() && !is_blank(text[end])) ++end;
        if (begin == end || (end == text.size() && !is_all)) return begin;
        if (text[begin] == '+') ++begin;
        Raw value{};
        const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, value);
        if (error != std::errc() || stop != text.data() + end)
            return fail("one of its values is no number of its type: " +
                            std::string(text.substr(begin, std::min<std::size_t>(end - begin, 40))),
                        {}, "write the file again");
        raw.push_back(value);
        used = end;
    }
    return used;
}

template <class Raw> Result<void> read_text(const Reading& reading, volume::VoxelStore& store) {
    std::string text;
    std::vector<Raw> raw;
    bool is_all = false;
    for (std::size_t done = 0; done < reading.voxels;) {
        if (reading.job.cancelled()) return fail("cancelled");
        const std::size_t before = text.size();
        if (before > kAtOnce)
            return fail("one of its values is longer than a million characters", reading.source.name(),
                        "write the file again");
        text.resize(before + kAtOnce);
        RAMUS_TRY(got, reading.source.read_some(text.data() + before, kAtOnce));
        text.resize(before + got);
        is_all = got < kAtOnce;
        raw.clear();
        auto used = parse_numbers(text, is_all, raw, reading.voxels - done);
        if (!used) return fail(used.error().what, reading.source.name(), used.error().hint);
        text.erase(0, *used);
        if (auto kept = keep(reading, raw.data(), raw.size(), store); !kept) return kept;
        done += raw.size();
        reading.report(done);
        if (is_all && done < reading.voxels)
            return fail("the file ends before all that its header promises", reading.source.name(),
                        "copy or write it again");
    }
    return {};
}

struct NumberRow {
    std::string_view name;
    std::size_t bytes;
    Result<void> (*binary)(const Reading&, volume::VoxelStore&);
    Result<void> (*text)(const Reading&, volume::VoxelStore&);
};
// In the order of VoxelType.
constexpr std::array<NumberRow, 10> kNumbers = {{{"uint8", 1, read_binary<std::uint8_t>, read_text<std::uint8_t>},
                                                 {"int8", 1, read_binary<std::int8_t>, read_text<std::int8_t>},
                                                 {"uint16", 2, read_binary<std::uint16_t>, read_text<std::uint16_t>},
                                                 {"int16", 2, read_binary<std::int16_t>, read_text<std::int16_t>},
                                                 {"uint32", 4, read_binary<std::uint32_t>, read_text<std::uint32_t>},
                                                 {"int32", 4, read_binary<std::int32_t>, read_text<std::int32_t>},
                                                 {"uint64", 8, read_binary<std::uint64_t>, read_text<std::uint64_t>},
                                                 {"int64", 8, read_binary<std::int64_t>, read_text<std::int64_t>},
                                                 {"float32", 4, read_binary<float>, read_text<float>},
                                                 {"float64", 8, read_binary<double>, read_text<double>}}};

const NumberRow& row_of(VoxelType type) { return kNumbers[static_cast<std::size_t>(type)]; }

double count_of(const glm::ivec3& size) { return double(size.x) * double(size.y) * double(size.z); }

std::size_t layers_of(const VoxelLayout& layout) { return layout.layers == nullptr ? 1 : layout.layers->count(); }

// Least bytes in the file. Text needs a digit and a blank for each number; the last needs no blank.
double bytes_in_file(const VoxelLayout& layout) {
    const double numbers = static_cast<double>(layers_of(layout)) * count_of(layout.size);
    return layout.encoding == Encoding::kText ? 2.0 * numbers - 1.0
                                              : static_cast<double>(bytes_of(layout.type)) * numbers;
}

} // namespace

std::string_view name_of(VoxelType type) { return row_of(type).name; }
std::size_t bytes_of(VoxelType type) { return row_of(type).bytes; }

Result<glm::ivec3> checked_size(const std::vector<std::int64_t>& extents, const std::string& name) {
    glm::ivec3 size(1);
    for (std::size_t axis = 0; axis < extents.size(); ++axis) {
        const std::int64_t extent = extents[axis];
        if (extent < 1 || extent > 2147483647)
            return fail("its extent along axis " + std::to_string(axis + 1) + " is " + std::to_string(extent), name,
                        "write the file again");
        if (axis < 3)
            size[static_cast<int>(axis)] = static_cast<int>(extent);
        else if (extent > 1)
            return fail("it holds " + std::to_string(extent) + " volumes, along axis " + std::to_string(axis + 1), name,
                        "write the one that is meant to a file of its own");
    }
    return size;
}

Result<void> check_declared_size(const DeclaredVoxels& declared, const std::string& name) {
    const glm::ivec3& size = declared.size;
    const double voxels = count_of(size);
    const std::string words = "its header claims " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                              std::to_string(size.z) + " voxels";
    if (declared.file_bytes > declared.most_bytes)
        return fail(words + ", more than the file can hold", name, "copy or write it again");
    // A mask takes at least a bit for each voxel, whatever their values.
    const double bytes = voxels / 8.0;
    if (bytes > declared.memory_bytes)
        return fail(words + ", which take " + megabytes(bytes) + " of memory or more; " +
                        megabytes(declared.memory_bytes) + " are left to them",
                    name, "crop it, or allow more with --memory");
    return {};
}

Result<volume::Volume> read_voxels(ByteSource& source, std::uint64_t offset, const VoxelLayout& layout,
                                   const volume::Keeping& keeping, Job& job) {
    const double needed = static_cast<double>(offset) + bytes_in_file(layout);
    if (auto fits =
            check_declared_size({layout.size, needed, source.most_bytes(), keeping.memory_bytes}, source.name());
        !fits)
        return tl::unexpected(fits.error());
    volume::VoxelStore store(layout.size, keeping, source.name());
    if (auto skipped = source.skip(offset); !skipped) return tl::unexpected(skipped.error());
    const NumberRow& type = row_of(layout.type);
    const std::size_t voxels = volume::voxel_count(layout.size) * layers_of(layout);
    const auto read = layout.encoding == Encoding::kText ? type.text : type.binary;
    if (auto all = read({source, layout, voxels, job}, store); !all) return tl::unexpected(all.error());
    if (auto sound = source.check_end(); !sound) return tl::unexpected(sound.error());
    if (auto settled = store.settle_nan(); !settled) return tl::unexpected(settled.error());
    volume::Volume volume;
    std::move(store).finish(volume);
    return volume;
}

Result<void> check_affine(const glm::dmat4& affine, const glm::ivec3& size, const std::string& form,
                          const std::string& remedy, const std::string& name) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 voxel((corner & 1) != 0 ? size.x : 0, (corner & 2) != 0 ? size.y : 0,
                               (corner & 4) != 0 ? size.z : 0, 1.0);
        const glm::dvec4 place = affine * voxel;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(place[axis]) <= tree::kMaximumCoordinate))
                return fail("its " + form + " puts voxels where no patient is, " +
                                (std::isfinite(place[axis]) ? "10 km away or farther" : "at no number"),
                            name, remedy);
    }
    const glm::dvec3 spacing = volume::spacing_mm(affine);
    constexpr double kFlat = 1e-9;          // of the volume that the axes would span at right angles
    constexpr double kLeastSpacing = 1e-12; // mm, far less than an atom
    if (!(std::min({spacing.x, spacing.y, spacing.z}) >= kLeastSpacing) ||
        !(volume::voxel_volume_mm3(affine) > kFlat * spacing.x * spacing.y * spacing.z))
        return fail("its " + form + " puts all voxels into one plane", name, remedy);
    return {};
}

glm::dmat4 lps_to_ras(glm::dmat4 affine) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 2; ++row) affine[column][row] = -affine[column][row];
    return affine;
}

glm::dvec3 slice_axis(const glm::dvec3& x, const glm::dvec3& y) {
    const glm::dvec3 normal = glm::cross(x, y);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

} // namespace ramus::io
