#include "core/io/volumes/zarr/zarr_chunks.h"

#include "core/base/mapped_pages.h"
#include "core/base/memory.h"
#include "core/io/volumes/zarr/zarr_decoder.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fstream>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;

constexpr const char* kZarrCopyAgain = "copy or write it again";

// Bytes between neighbours along each axis of a chunk.
std::vector<std::uint64_t> chunk_strides(const ZarrArray& array) {
    std::vector<std::uint64_t> strides(array.chunks.size());
    std::uint64_t stride = bytes_of(array.type);
    for (std::size_t n = 0; n < strides.size(); ++n) {
        const std::size_t axis = array.first_fastest ? n : strides.size() - 1 - n;
        strides[axis] = stride;
        stride *= array.chunks[axis];
    }
    return strides;
}

// The file of a chunk, in full. Missing files are chunks of the fill value.
Result<EncodedChunk> encoded_chunk(const ZarrImage& image, const std::vector<std::uint64_t>& chunk) {
    fs::path path = image.folder / zarr_chunk_name(chunk, image.array.separator);
    std::error_code error;
    auto status = fs::status(path, error);
    const auto is_missing = [&] { return status.type() == fs::file_type::not_found; };
    if (is_missing() && !image.array.states_separator) {
        path = image.folder / zarr_chunk_name(chunk, '/');
        status = fs::status(path, error);
    }
    if (is_missing()) return EncodedChunk{path.string(), {}};
    if (!fs::is_regular_file(status))
        return fail("a chunk is no file, or cannot be read", path.string(), "check its permissions, or copy it again");
    const std::uint64_t bytes = fs::file_size(path, error);
    if (error || bytes == 0) return fail("a chunk is empty", path.string(), kZarrCopyAgain);
    if (bytes > most_chunk_file_bytes(image.array))
        return fail("a chunk has " + std::to_string(bytes) + " bytes, and its numbers take " +
                        std::to_string(image.array.chunk_bytes()),
                    path.string(), kZarrCopyAgain);
    EncodedChunk encoded{path.string(), std::string(bytes, '\0')};
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(encoded.bytes.data(), static_cast<std::streamsize>(bytes)))
        return fail("a chunk cannot be read", path.string(), "check its permissions, and the medium");
    return encoded;
}

class ZarrStage : public ByteStage {
public:
    ZarrStage(ZarrImage image, const ChosenPart& part, double memory_bytes, const Job& job)
        : image_(std::move(image)), part_(part), memory_bytes_(memory_bytes), job_(job),
          strides_(chunk_strides(image_.array)), extents_(zarr_extents(image_)), number_(bytes_of(image_.array.type)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool there = axis < 2 || image_.has_z;
            chunk_[axis] = there ? image_.array.chunks[image_.space[axis]] : 1;
            stride_[axis] = there ? strides_[image_.space[axis]] : 0;
        }
        std::uint64_t offset = 0;
        if (image_.channel) offset += part.channel % image_.array.chunks[*image_.channel] * strides_[*image_.channel];
        if (image_.time) offset += part.time % image_.array.chunks[*image_.time] * strides_[*image_.time];
        offset_ = offset;
        fill_ = image_.array.fill;
        if (image_.array.swapped) std::ranges::reverse(fill_);
    }

    Result<std::size_t> read(char* into, std::size_t bytes) override {
        if (at_ == layer_.size()) {
            if (next_z_ == extents_[2]) return std::size_t{0};
            if (auto filled = fill_layer(); !filled) return fail(of_chunk(filled.error()), {}, filled.error().hint);
        }
        const std::size_t part = std::min(bytes, layer_.size() - at_);
        std::memcpy(into, layer_.data() + at_, part);
        at_ += part;
        return part;
    }

private:
    // The place of the error within the message: the reader of the stage names the folder.
    static std::string of_chunk(const Error& error) {
        return error.where.empty() ? error.what : error.what + " (" + error.where + ")";
    }

    struct Place {
        std::uint64_t x, y; // numbers of chunks
    };

    // Reads all chunks of the next layer. Memory: the layer without zeros, and some chunks for each thread.
    Result<void> fill_layer() {
        const std::uint64_t depth = std::min(chunk_[2], extents_[2] - next_z_);
        layer_ = SparseArray<char>(); // new pages: all 0
        layer_.resize(depth * extents_[1] * extents_[0] * number_);
        at_ = 0;
        constexpr std::uint64_t kBatchBytes = std::uint64_t{8} << 20;
        const std::uint64_t each = std::max<std::uint64_t>(kBatchBytes / image_.array.chunk_bytes(), 1);
        const auto threads = static_cast<std::uint64_t>(std::clamp(tbb::info::default_concurrency(), 1, 8));
        const std::uint64_t across = (extents_[0] + chunk_[0] - 1) / chunk_[0];
        const std::uint64_t all = across * ((extents_[1] + chunk_[1] - 1) / chunk_[1]);
        const std::uint64_t batches = all / each + (all % each > 0 ? 1 : 0);
        for (std::uint64_t first = 0; first < batches; first += threads) {
            if (job_.cancelled()) return fail("cancelled");
            const std::uint64_t count = std::min(threads, batches - first);
            if (memory_left(memory_bytes_) < static_cast<double>(count) * decoding_bytes(image_.array))
                return fail("a layer of its chunks takes more memory than is left to it", {},
                            "write it with chunks of fewer planes, or allow more with --memory");
            std::vector<Result<void>> done(count);
            tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t n) {
                const std::uint64_t begin = (first + n) * each;
                std::vector<Place> places;
                for (std::uint64_t at = begin; at < std::min(begin + each, all); ++at)
                    places.push_back({at % across, at / across});
                done[n] = read_chunks(places, depth);
            });
            for (const auto& result : done)
                if (!result) return result;
        }
        next_z_ += depth;
        if (next_z_ == extents_[2] && !any_) return fail("none of its chunks is there", {}, "copy all of the folder");
        return {};
    }

    [[nodiscard]] std::vector<std::uint64_t> chunk_at(const Place& place) const {
        std::vector<std::uint64_t> chunk(image_.array.shape.size(), 0);
        chunk[image_.space[0]] = place.x;
        chunk[image_.space[1]] = place.y;
        if (image_.has_z) chunk[image_.space[2]] = next_z_ / chunk_[2];
        if (image_.channel) chunk[*image_.channel] = part_.channel / image_.array.chunks[*image_.channel];
        if (image_.time) chunk[*image_.time] = part_.time / image_.array.chunks[*image_.time];
        return chunk;
    }

    Result<void> read_chunks(const std::vector<Place>& places, std::uint64_t depth) {
        std::vector<EncodedChunk> encoded;
        for (const Place& place : places) {
            RAMUS_TRY(chunk, encoded_chunk(image_, chunk_at(place)));
            if (!chunk.bytes.empty()) any_ = true;
            encoded.push_back(std::move(chunk));
        }
        RAMUS_TRY(decoded, decode_chunks(image_.array, std::move(encoded)));
        for (std::size_t n = 0; n < places.size(); ++n) place_chunk(places[n], depth, decoded[n]);
        return {};
    }

    // Copies the part of a chunk that is in the volume into the layer. Chunks do not overlap, so threads do not meet.
    void place_chunk(const Place& place, std::uint64_t depth, const std::string& numbers) {
        const bool fill_is_zero = std::ranges::count(fill_, '\0') == static_cast<std::ptrdiff_t>(fill_.size());
        if (numbers.empty() && fill_is_zero) return;
        const std::uint64_t x = place.x * chunk_[0], y = place.y * chunk_[1];
        const std::uint64_t columns = std::min(chunk_[0], extents_[0] - x), rows = std::min(chunk_[1], extents_[1] - y);
        std::string row(columns * number_, '\0');
        for (std::uint64_t k = 0; k < depth; ++k)
            for (std::uint64_t j = 0; j < rows; ++j) {
                const char* from =
                    numbers.empty() ? nullptr : numbers.data() + offset_ + j * stride_[1] + k * stride_[2];
                if (from == nullptr || stride_[0] != number_) {
                    for (std::uint64_t i = 0; i < columns; ++i)
                        std::memcpy(row.data() + i * number_, from == nullptr ? fill_.data() : from + i * stride_[0],
                                    number_);
                    from = row.data();
                }
                // Pages of the layer that stay 0 take no memory.
                if (std::string_view(from, row.size()).find_first_not_of('\0') == std::string_view::npos) continue;
                std::memcpy(layer_.data() + ((k * extents_[1] + y + j) * extents_[0] + x) * number_, from, row.size());
            }
    }

public:
    // Bytes of a batch of one chunk while it is decoded: encoded, decoded, and on the way between two processes.
    static double decoding_bytes(const ZarrArray& array) { return 4.0 * static_cast<double>(array.chunk_bytes()); }

private:
    ZarrImage image_;
    ChosenPart part_;
    double memory_bytes_;
    const Job& job_;
    std::vector<std::uint64_t> strides_;
    std::array<std::uint64_t, 3> extents_, chunk_{}, stride_{}; // along x, y and z; stride_ in bytes
    std::uint64_t number_, offset_ = 0, next_z_ = 0;
    std::string fill_;
    SparseArray<char> layer_;
    std::size_t at_ = 0;
    std::atomic<bool> any_ = false; // whether a chunk was there
};

} // namespace

std::array<std::uint64_t, 3> zarr_extents(const ZarrImage& image) {
    const auto& shape = image.array.shape;
    return {shape[image.space[0]], shape[image.space[1]], image.has_z ? shape[image.space[2]] : 1};
}

Result<std::unique_ptr<ByteStage>> zarr_stage(const ZarrImage& image, const ChosenPart& part, double memory_bytes,
                                              const Job& job) {
    const std::string name = image.folder.string();
    double chunks = 1.0;
    for (std::size_t axis = 0; axis < (image.has_z ? 3 : 2); ++axis)
        chunks *= static_cast<double>(image.array.chunks_along(image.space[axis]));
    constexpr double kMostChunks = 1 << 24;
    if (chunks > kMostChunks) return fail("it has more than 16 million chunks", name, "write it with larger chunks");
    const double left = memory_left(memory_bytes);
    if (const double bytes = ZarrStage::decoding_bytes(image.array); bytes > left)
        return fail(takes_too_much("one of its chunks", bytes, left), name,
                    "write it with smaller chunks, or allow more with --memory");
    return std::make_unique<ZarrStage>(image, part, memory_bytes, job);
}

} // namespace ramus::io
