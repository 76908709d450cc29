#include "core/io/volumes/dicom/dicom_pixels.h"

#include "core/base/memory.h"
#include "core/base/own_process.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <gdcmImageReader.h>
#include <sstream>

namespace ramus::io {

namespace {

constexpr const char* kExportAgain = "copy or export it again";

bool is_big_endian(const DicomImage& image) { return image.layout.transfer_syntax == kDicomBigEndian; }

double claimed_bytes(const DicomImage& image) {
    return static_cast<double>(image.rows) * image.columns * image.bits_allocated / 8.0 *
           static_cast<double>(image.frames.size());
}

// Extracts the stored bits of each number, in this machine's byte order.
template <class Number> void keep_stored_bits(const DicomImage& image, std::string& pixels) {
    const std::size_t count = pixels.size() / sizeof(Number);
    auto* numbers = reinterpret_cast<Number*>(pixels.data());
    const bool swapped = is_big_endian(image) && !image.layout.encapsulated;
    if (swapped && sizeof(Number) > 1)
        for (std::size_t n = 0; n < count; ++n) {
            auto* bytes = reinterpret_cast<char*>(numbers + n);
            std::reverse(bytes, bytes + sizeof(Number));
        }
    if (image.bits_stored == image.bits_allocated) return;
    using Bits = std::make_unsigned_t<Number>;
    constexpr int kBits = 8 * static_cast<int>(sizeof(Number));
    const int left = kBits - 1 - image.high_bit;
    const int right = kBits - image.bits_stored;
    // Shifting to the left and back extends the sign of signed numbers.
    for (std::size_t n = 0; n < count; ++n)
        numbers[n] =
            static_cast<Number>(static_cast<Number>(static_cast<Bits>(static_cast<Bits>(numbers[n]) << left)) >> right);
}

template <class Number>
Result<void> append_numbers(const DicomImage& image, const volume::Scaling& scaling, std::string& pixels,
                            volume::VoxelStore& store) {
    keep_stored_bits<Number>(image, pixels);
    return store.append(reinterpret_cast<const Number*>(pixels.data()), pixels.size() / sizeof(Number), scaling);
}

struct PixelType {
    int bits;
    bool is_signed;
    const char* name;
    Result<void> (*append)(const DicomImage&, const volume::Scaling&, std::string&, volume::VoxelStore&);
};
constexpr std::array<PixelType, 6> kPixelTypes = {{{8, false, "uint8", append_numbers<std::uint8_t>},
                                                   {8, true, "int8", append_numbers<std::int8_t>},
                                                   {16, false, "uint16", append_numbers<std::uint16_t>},
                                                   {16, true, "int16", append_numbers<std::int16_t>},
                                                   {32, false, "uint32", append_numbers<std::uint32_t>},
                                                   {32, true, "int32", append_numbers<std::int32_t>}}};

const PixelType* pixel_type(const DicomImage& image) {
    for (const PixelType& type : kPixelTypes)
        if (type.bits == image.bits_allocated && type.is_signed == image.is_signed) return &type;
    return nullptr;
}

// `input`: the expected number of bytes of the pixels, and the file. Empty: damaged, or different from the header.
std::string decode(std::string_view input) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, input.data(), sizeof(bytes));
    std::istringstream stream(std::string(input.substr(sizeof(bytes))));
    gdcm::ImageReader reader;
    reader.SetStream(stream);
    if (!reader.Read()) return {};
    const gdcm::Image& picture = reader.GetImage();
    if (picture.GetBufferLength() != bytes) return {};
    std::string pixels(bytes, '\0');
    return picture.GetBuffer(pixels.data()) ? pixels : std::string();
}

// The input of decode().
Result<std::string> for_decoding(const DicomImage& image, std::uint64_t pixel_bytes) {
    RAMUS_TRY(size, image.file.size());
    RAMUS_TRY(stream, image.file.open());
    std::string input(sizeof(pixel_bytes) + size, '\0');
    std::memcpy(input.data(), &pixel_bytes, sizeof(pixel_bytes));
    if (!stream->read(input.data() + sizeof(pixel_bytes), static_cast<std::streamsize>(size)))
        return fail("reading stopped with an error", image.file.name, "check the medium");
    return input;
}

} // namespace

std::uint64_t frame_bytes(const DicomImage& image) {
    return static_cast<std::uint64_t>(image.rows) * static_cast<std::uint64_t>(image.columns) *
           static_cast<std::uint64_t>(image.bits_allocated / 8);
}

const char* number_type_name(const DicomImage& image) {
    const PixelType* type = pixel_type(image);
    return type == nullptr ? "bits" : type->name;
}

Result<void> check_pixels(const DicomImage& image, double memory_bytes) {
    const std::string& name = image.file.name;
    const double claimed = claimed_bytes(image);
    // An empty slice in JPEG 2000 or JPEG-LS takes a few dozen bytes.
    constexpr double kMostCompression = 1e5;
    const double possible =
        static_cast<double>(image.layout.pixel_bytes) * (image.layout.encapsulated ? kMostCompression : 1.0);
    if (claimed > possible) return fail("its header claims more pixels than the file can hold", name, kExportAgain);
    const double held = claimed + (image.layout.encapsulated ? static_cast<double>(image.layout.pixel_bytes) : 0.0);
    if (held > memory_bytes)
        return fail("its pixels take " + megabytes(held) + " of memory; " + megabytes(memory_bytes) +
                        " are left to them",
                    name, "allow more with --memory");
    return {};
}

Result<std::string> read_pixel_bytes(const DicomImage& image, std::uint64_t begin, std::uint64_t bytes) {
    if (begin > image.layout.pixel_bytes || bytes > image.layout.pixel_bytes - begin)
        return fail("its header claims more pixels than the file can hold", image.file.name, kExportAgain);
    RAMUS_TRY(stream, image.file.open());
    std::string pixels(bytes, '\0');
    stream->seekg(static_cast<std::streamoff>(image.layout.pixel_begin + begin));
    if (!stream->read(pixels.data(), static_cast<std::streamsize>(bytes)))
        return fail("reading stopped with an error", image.file.name, "check the medium");
    return pixels;
}

Result<std::string> decode_pixels(const DicomImage& image) {
    // On damaged pixels GDCM and its decoders can end the process.
    ProcessLimits limits;
    const std::uint64_t bytes = frame_bytes(image) * image.frames.size();
    limits.memory += 4 * bytes;
    limits.answer = bytes + 1;
    RAMUS_TRY(input, for_decoding(image, bytes));
    limits.memory += 2 * input.size();
    auto pixels = run_in_own_process(decode, input, limits);
    if (!pixels || pixels->empty())
        return fail("its compressed pixels cannot be decoded: they are damaged, of an unknown kind, or other than the "
                    "header says",
                    image.file.name, "copy or export it again, or export it uncompressed");
    return pixels;
}

Result<std::string> frame_pixels(const DicomImage& image, std::size_t frame, const std::string* decoded) {
    const std::uint64_t bytes = frame_bytes(image);
    if (decoded != nullptr) return decoded->substr(frame * bytes, bytes);
    if (image.layout.encapsulated) return decode_pixels(image);
    return read_pixel_bytes(image, frame * bytes, bytes);
}

Result<void> append_frame(const DicomImage& image, const volume::Scaling& scaling, std::string& pixels,
                          volume::VoxelStore& store) {
    const PixelType* type = pixel_type(image);
    if (type == nullptr)
        return fail("its pixels are single bits, and it is no segmentation", image.file.name, "export it as NIfTI");
    return type->append(image, scaling, pixels, store);
}

} // namespace ramus::io
