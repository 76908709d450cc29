#include "core/io/volumes/tiff/tiff_pixels.h"

#include "core/base/memory.h"
#include "core/io/volumes/tiff/tiff_decoder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::io {

namespace {

constexpr const char* kTiffPlain = "write it with one number for each pixel: grey, or labels";
constexpr const char* kTiffDamaged = "copy or write it again";

std::uint64_t parts_of(std::uint64_t whole, std::uint64_t part) { return whole / part + (whole % part > 0 ? 1 : 0); }

// The strips or tiles of a page, from its tags.
struct Grid {
    std::uint64_t width, height; // pixels of a strip or tile
    std::uint64_t across, down;  // their numbers
    std::uint64_t row_bytes;     // of a row of the page
    std::uint64_t encoded_row;   // of a row of a strip or tile
    [[nodiscard]] std::uint64_t rows(std::uint64_t band, const TiffPage& page) const {
        return std::min(height, page.height - band * height);
    }
};

Grid grid_of(const TiffPage& page) {
    Grid grid{};
    grid.width = page.tiled() ? page.tile_width : page.width;
    grid.height = page.tiled() ? page.tile_height : std::min(page.rows_per_strip, page.height);
    grid.across = parts_of(page.width, grid.width);
    grid.down = parts_of(page.height, grid.height);
    grid.row_bytes = (page.width * page.bits + 7) / 8;
    grid.encoded_row = (grid.width * page.bits + 7) / 8;
    return grid;
}

std::uint8_t reversed_bits(std::uint8_t byte) {
    std::uint8_t reversed = 0;
    for (int bit = 0; bit < 8; ++bit) reversed = static_cast<std::uint8_t>(reversed << 1 | (byte >> bit & 1));
    return reversed;
}

// Swaps the bytes of each number.
void swap_numbers(std::string& bytes, std::size_t each) {
    for (std::size_t at = 0; at + each <= bytes.size(); at += each)
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at + each));
}

// Rows of single bits, the first in the highest bit, as bytes of 0 and 1.
std::string bits_as_bytes(const std::string& rows, std::uint64_t columns) {
    const std::uint64_t row_bytes = (columns + 7) / 8;
    std::string bytes;
    bytes.reserve(rows.size() / row_bytes * columns);
    for (std::uint64_t row = 0; row < rows.size(); row += row_bytes)
        for (std::uint64_t n = 0; n < columns; ++n)
            bytes += static_cast<char>(static_cast<std::uint8_t>(rows[row + n / 8]) >> (7 - n % 8) & 1);
    return bytes;
}

// Bytes that the encoded segments and their tags take.
std::uint64_t bytes_held(const TiffSegments& segments) {
    std::uint64_t bytes = 0;
    for (const std::string& each : segments.encoded) bytes += each.size();
    for (const TiffSegments::Tag& tag : segments.decoding) bytes += tag.bytes.size();
    return bytes;
}

// Reads the strips and rows of tiles of all planes in order, and decodes several at a time on all threads.
class TiffStage : public ByteStage {
public:
    TiffStage(std::vector<TiffFile> files, std::vector<TiffPlane> planes)
        : files_(std::move(files)), planes_(std::move(planes)) {}

    Result<std::size_t> read(char* into, std::size_t bytes) override {
        while (at_ == ready_.size()) {
            ready_.clear();
            at_ = 0;
            if (plane_ == planes_.size()) return std::size_t{0};
            if (auto filled = fill(); !filled) return tl::unexpected(filled.error());
        }
        const std::size_t part = std::min(bytes, ready_.size() - at_);
        std::memcpy(into, ready_.data() + at_, part);
        at_ += part;
        return part;
    }

private:
    // Reads encoded strips and tiles until they are enough for all threads, and appends their numbers to `ready_`.
    Result<void> fill() {
        constexpr std::uint64_t kBatchBytes = std::uint64_t{4} << 20;
        const auto threads = static_cast<std::size_t>(std::clamp(tbb::info::default_concurrency(), 1, 8));
        std::vector<std::vector<TiffSegments>> batches(1);
        std::uint64_t in_batch = 0;
        while (plane_ < planes_.size()) {
            if (in_batch >= kBatchBytes) {
                if (batches.size() == threads) break;
                batches.emplace_back();
                in_batch = 0;
            }
            RAMUS_TRY(segments, next_segments());
            in_batch += segments.decoded_bytes() + bytes_held(segments);
            batches.back().push_back(std::move(segments));
        }
        std::vector<Result<std::string>> numbers(batches.size(), std::string());
        tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t n) { numbers[n] = numbers_of(batches[n]); });
        for (const auto& each : numbers) {
            if (!each) return fail(each.error().what, {}, each.error().hint);
            ready_ += *each;
        }
        return {};
    }

    // The next strip or row of tiles, still encoded. Moves on.
    Result<TiffSegments> next_segments() {
        const TiffPlane& plane = planes_[plane_];
        TiffFile& file = files_[plane.file];
        const TiffPage& page = file.layout.pages[plane.page];
        if (band_ == 0)
            if (auto opened = open_page(plane); !opened) return fail(opened.error().what, {}, opened.error().hint);
        const Grid grid = grid_of(page);
        TiffSegments segments;
        segments.columns = page.width;
        segments.rows = grid.rows(band_, page);
        segments.width = grid.width;
        segments.height = grid.height;
        segments.tiled = page.tiled();
        segments.big_endian = file.layout.big_endian;
        segments.bits = page.bits;
        segments.sample_format = page.sample_format;
        segments.compression = page.compression;
        segments.photometric = page.photometric;
        segments.fill_order = page.fill_order;
        segments.predictor = page.predictor;
        segments.decoding = decoding_;
        std::uint64_t encoded_bytes = 0;
        for (std::uint64_t n = 0; n < grid.across; ++n) {
            const std::uint64_t index = band_ * grid.across + n;
            const std::uint64_t rows = page.tiled() ? grid.height : segments.rows;
            auto encoded = encoded_at(plane, index, page.compression == 1 ? rows * grid.encoded_row : 0);
            if (!encoded) return fail(page_name(plane) + encoded.error().what, {}, encoded.error().hint);
            encoded_bytes += encoded->size();
            if (encoded_bytes > file.layout.file_bytes)
                return fail(page_name(plane) + "its tiles overlap in the file", {}, kTiffDamaged);
            segments.encoded.push_back(std::move(*encoded));
        }
        if (++band_ == grid.down) ++plane_, band_ = 0;
        return segments;
    }

    [[nodiscard]] std::string page_name(const TiffPlane& plane) const {
        const std::string file = files_.size() > 1 ? files_[plane.file].bytes.path.filename().string() + ": " : "";
        return file + "page " + std::to_string(plane.page + 1) + ": ";
    }

    Result<void> open_page(const TiffPlane& plane) {
        const TiffFile& file = files_[plane.file];
        const TiffPage& page = file.layout.pages[plane.page];
        if (!stream_ || opened_ != plane.file) {
            RAMUS_TRY(stream, file.bytes.open());
            stream_ = std::move(stream);
            opened_ = plane.file;
        }
        RAMUS_TRY(offsets, tiff_numbers(*stream_, file.layout, *page.offsets, file.bytes.name));
        offsets_ = std::move(offsets);
        counts_.clear();
        if (page.counts) {
            RAMUS_TRY(counts, tiff_numbers(*stream_, file.layout, *page.counts, file.bytes.name));
            counts_ = std::move(counts);
        }
        decoding_.clear();
        for (std::size_t n = 0; n < kTiffDecodingTags.size(); ++n) {
            const auto& field = page.decoding[n];
            if (!field) continue;
            constexpr std::uint64_t kMostTables = std::uint64_t{1} << 16;
            if (bytes_of(*field) > kMostTables || field->position > file.layout.file_bytes ||
                bytes_of(*field) > file.layout.file_bytes - field->position)
                return fail("a tag for its compression is damaged", {}, kTiffDamaged);
            RAMUS_TRY(bytes, tiff_bytes(*stream_, *field, file.bytes.name));
            decoding_.push_back({kTiffDecodingTags[n], field->type, field->count, std::move(bytes)});
        }
        return {};
    }

    // The bytes of a strip or tile. `needed`: those of an uncompressed one; 0: compressed.
    Result<std::string> encoded_at(const TiffPlane& plane, std::uint64_t index, std::uint64_t needed) {
        const std::uint64_t file_bytes = files_[plane.file].layout.file_bytes;
        const std::uint64_t offset = offsets_[index] + plane.skipped_bytes;
        std::uint64_t count = counts_.empty() ? needed : counts_[index];
        const std::string part = "strip or tile " + std::to_string(index + 1);
        if (count < needed)
            return fail(part + " has " + std::to_string(count) + " bytes, and its pixels take " +
                            std::to_string(needed),
                        {}, kTiffDamaged);
        if (needed > 0) count = needed;
        if (count == 0) return fail(part + " is empty", {}, kTiffDamaged);
        if (offset < plane.skipped_bytes || offset > file_bytes || count > file_bytes - offset)
            return fail(part + " lies beyond the end of the file", {}, kTiffDamaged);
        return bytes_at(*stream_, offset, count, files_[plane.file].bytes.name);
    }

    // The numbers of strips and rows of tiles, in order.
    [[nodiscard]] Result<std::string> numbers_of(std::vector<TiffSegments>& batch) const {
        std::string numbers;
        std::vector<TiffSegments> compressed;
        const auto decode = [&]() -> Result<void> {
            if (compressed.empty()) return {};
            RAMUS_TRY(rows, decode_tiff(compressed, {}));
            for (std::size_t n = 0; n < rows.size(); ++n)
                numbers += compressed[n].bits == 1 ? bits_as_bytes(rows[n], compressed[n].columns) : rows[n];
            compressed.clear();
            return {};
        };
        for (TiffSegments& each : batch) {
            if (each.compression != 1) {
                compressed.push_back(std::move(each));
                continue;
            }
            if (auto decoded = decode(); !decoded) return tl::unexpected(decoded.error());
            numbers += uncompressed(each);
        }
        if (auto decoded = decode(); !decoded) return tl::unexpected(decoded.error());
        return numbers;
    }

    static std::string uncompressed(TiffSegments& from) {
        const std::uint64_t encoded_row = (from.width * from.bits + 7) / 8, row_bytes = from.row_bytes();
        std::string rows;
        if (from.tiled) {
            rows.resize(from.decoded_bytes());
            for (std::size_t n = 0; n < from.encoded.size(); ++n) {
                const std::uint64_t first = n * encoded_row, part = std::min(encoded_row, row_bytes - first);
                for (std::uint64_t row = 0; row < from.rows; ++row)
                    std::memcpy(rows.data() + row * row_bytes + first, from.encoded[n].data() + row * encoded_row,
                                part);
            }
        } else {
            rows = std::move(from.encoded.front());
        }
        if (from.fill_order == 2)
            for (char& byte : rows) byte = static_cast<char>(reversed_bits(static_cast<std::uint8_t>(byte)));
        if (from.bits == 1) return bits_as_bytes(rows, from.columns);
        if (from.bits > 8 && from.big_endian != (std::endian::native == std::endian::big))
            swap_numbers(rows, from.bits / 8);
        return rows;
    }

    std::vector<TiffFile> files_;
    std::vector<TiffPlane> planes_;
    std::size_t plane_ = 0, opened_ = 0;
    std::uint64_t band_ = 0;
    std::unique_ptr<std::istream> stream_; // of file opened_
    std::vector<std::uint64_t> offsets_, counts_;
    std::vector<TiffSegments::Tag> decoding_;
    std::string ready_;
    std::size_t at_ = 0;
};

} // namespace

Result<VoxelType> tiff_voxel_type(const TiffPage& page, const std::string& name) {
    if (page.samples != 1)
        return fail("its pages are in colour: each pixel has " + std::to_string(page.samples) + " numbers", name,
                    kTiffPlain);
    constexpr std::uint64_t kPalette = 3;
    if (page.photometric == kPalette) return fail("its numbers stand for the colours of a palette", name, kTiffPlain);
    if (page.photometric > 1) return fail("its pages are in colour", name, kTiffPlain);
    constexpr std::uint64_t kUnsigned = 1, kSigned = 2, kReal = 3, kUndefined = 4;
    const bool whole = page.sample_format == kUnsigned || page.sample_format == kUndefined;
    for (const auto& [bits, format, type] :
         {std::tuple(1U, kUnsigned, VoxelType::kUint8), std::tuple(8U, kUnsigned, VoxelType::kUint8),
          std::tuple(8U, kSigned, VoxelType::kInt8), std::tuple(16U, kUnsigned, VoxelType::kUint16),
          std::tuple(16U, kSigned, VoxelType::kInt16), std::tuple(32U, kUnsigned, VoxelType::kUint32),
          std::tuple(32U, kSigned, VoxelType::kInt32), std::tuple(32U, kReal, VoxelType::kFloat32),
          std::tuple(64U, kUnsigned, VoxelType::kUint64), std::tuple(64U, kSigned, VoxelType::kInt64),
          std::tuple(64U, kReal, VoxelType::kFloat64)})
        if (page.bits == bits && (format == kUnsigned ? whole : page.sample_format == format)) return type;
    return fail("its pixels are numbers of " + std::to_string(page.bits) + " bits" +
                    (page.sample_format == kReal  ? " with fractions"
                     : page.sample_format > kReal ? ", complex"
                                                  : ""),
                name, "write it with 8, 16 or 32 bits");
}

Result<void> check_tiff_page(const TiffPage& page, double memory_bytes, const std::string& name) {
    constexpr std::uint64_t kMostPixels = 0x7FFFFFFF;
    if (page.width < 1 || page.width > kMostPixels || page.height < 1 || page.height > kMostPixels)
        return fail("it claims " + std::to_string(page.width) + " x " + std::to_string(page.height) + " pixels", name,
                    kTiffDamaged);
    const bool tile_missing = page.tiled() != (page.tile_height > 0);
    if (tile_missing || page.rows_per_strip < 1 || page.tile_width > kMostPixels || page.tile_height > kMostPixels ||
        page.tile_width % 8 != 0)
        return fail("its strips or tiles make no sense", name, kTiffDamaged);
    const Grid grid = grid_of(page);
    const std::uint64_t needed = grid.across * grid.down;
    const std::uint64_t offsets = page.offsets ? page.offsets->count : 0;
    const std::uint64_t counts = page.counts ? page.counts->count : 0;
    if (offsets != needed)
        return fail("it has " + std::to_string(offsets) + (page.tiled() ? " tiles" : " strips") +
                        " where its size needs " + std::to_string(needed),
                    name, kTiffDamaged);
    const bool may_leave_out = page.compression == 1; // some old programs write no sizes then
    if (counts != needed && !(may_leave_out && !page.counts))
        return fail("it has the sizes of " + std::to_string(counts) + (page.tiled() ? " tiles" : " strips") +
                        " where it needs " + std::to_string(needed),
                    name, kTiffDamaged);
    if (page.compression != 1 && !can_decode_tiff(page.compression))
        return fail("its compression, " + tiff_compression_name(page.compression) + ", is not read", name,
                    "write it without compression, or with Deflate or LZW");
    // Encoded, decoded, and on the way between two processes.
    const double band = 4.0 * static_cast<double>(grid.height) * static_cast<double>(grid.across) *
                        static_cast<double>(grid.encoded_row);
    if (band > memory_bytes)
        return fail(takes_too_much(page.tiled() ? "a row of its tiles" : "one of its strips", band, memory_bytes), name,
                    "write it with smaller strips or tiles, or allow more with --memory");
    return {};
}

double most_tiff_bytes(const TiffFile& file) {
    // Empty rows in CCITT, LERC or Zstandard take next to nothing.
    constexpr double kMostTiffCompression = 1e5;
    const bool packed = std::ranges::any_of(
        file.layout.pages, [](const TiffPage& page) { return page.compression != 1 || page.bits == 1; });
    return static_cast<double>(file.layout.file_bytes) * (packed ? kMostTiffCompression : 1.0);
}

std::unique_ptr<ByteStage> tiff_stage(std::vector<TiffFile> files, std::vector<TiffPlane> planes) {
    return std::make_unique<TiffStage>(std::move(files), std::move(planes));
}

} // namespace ramus::io
