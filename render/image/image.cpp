#include "render/image/image.h"

#include "core/io/output_file.h"
#include "core/io/text_numbers.h"
#include "render/scene/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <png.h>

namespace ramus::render {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

constexpr std::uint32_t kLargestPngSide = 32768;

// A premultiplied channel.
int premultiplied(const std::uint8_t* pixel, int channel) {
    return channel == 3 ? pixel[3] : (pixel[channel] * pixel[3] + 127) / 255;
}

int largest_difference(const std::uint8_t* a, const std::uint8_t* b) {
    int largest = 0;
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(premultiplied(a, c) - premultiplied(b, c)));
    return largest;
}

} // namespace

void Image::fill(const glm::vec3& srgb) {
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        for (int k = 0; k < 3; ++k)
            rgba[i + static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(255.0F * srgb[k]));
        rgba[i + 3] = 255;
    }
}

void Image::put(const Image& other, glm::ivec2 at) {
    for (int y = 0; y < other.height; ++y) std::copy_n(other.pixel(0, y), 4 * other.width, pixel(at.x, at.y + y));
}

Result<Image> read_png(const std::filesystem::path& path) {
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) return fail("cannot be opened", path.string(), "check the path");
    io::note_input(path);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    const auto refuse = [&] {
        std::string message = png.message;
        png_image_free(&png);
        return fail("not a PNG picture (" + message + ")", path.string(), "give a PNG file");
    };
    if (png_image_begin_read_from_stdio(&png, file.get()) == 0) return refuse();
    if (png.width > kLargestPngSide || png.height > kLargestPngSide) {
        png_image_free(&png);
        return fail("picture is too large", path.string(), "give one of at most 32768 pixels a side");
    }
    // A pixel has at least one bit, and a byte of a PNG expands to at most 1032.
    constexpr std::uint64_t kMostPixelsAByte = 8 * 1032;
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (!error && std::uint64_t{png.width} * png.height / kMostPixelsAByte > bytes) {
        png_image_free(&png);
        return fail("the picture claims more pixels than the file can hold", path.string(), "give another PNG file");
    }
    png.format = PNG_FORMAT_RGBA;
    Image image(static_cast<int>(png.width), static_cast<int>(png.height));
    if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) return refuse();
    return image;
}

Result<std::string> encode_png(const Image& image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGBA;
    const auto refuse = [&] { return fail(std::string("the picture could not be encoded: ") + png.message); };
    png_alloc_size_t bytes = 0;
    if (png_image_write_get_memory_size(png, bytes, 0, image.rgba.data(), 0, nullptr) == 0) return refuse();
    std::string encoded(bytes, '\0');
    if (png_image_write_to_memory(&png, encoded.data(), &bytes, 0, image.rgba.data(), 0, nullptr) == 0) return refuse();
    encoded.resize(bytes);
    return encoded;
}

Result<void> check_png_name(const std::filesystem::path& path) {
    const std::string ending = io::lower_case(path.extension().string());
    if (ending.empty() || ending == ".png") return {};
    std::filesystem::path better = path.filename();
    return fail("pictures are written as PNG", path.string(),
                "give the name " + better.replace_extension(".png").string());
}

Result<void> write_png(const Image& image, const std::filesystem::path& path, io::OutputSet* together) {
    if (auto possible = io::check_output(path); !possible) return possible; // checks first
    if (auto fits = check_png_name(path); !fits) return fits;
    auto encoded = encode_png(image);
    if (encoded) return together != nullptr ? together->add(path, *encoded) : io::write_file(path, *encoded);
    encoded.error().where = path.string();
    return tl::unexpected(encoded.error());
}

Result<Comparison> compare(const Image& actual, const Image& reference, int threshold) {
    if (actual.width != reference.width || actual.height != reference.height)
        return fail(
            "the picture has " + std::to_string(actual.width) + "x" + std::to_string(actual.height) +
                " pixels, the reference " + std::to_string(reference.width) + "x" + std::to_string(reference.height),
            {}, "render with --size " + std::to_string(reference.width) + "x" + std::to_string(reference.height));
    Comparison result;
    result.pixels = actual.rgba.size() / 4;
    for (std::size_t i = 0; i < actual.rgba.size(); i += 4) {
        const int d = largest_difference(&actual.rgba[i], &reference.rgba[i]);
        result.largest = std::max(result.largest, d);
        result.differing += d > threshold ? 1 : 0;
    }
    return result;
}

Image difference(const Image& actual, const Image& reference, int threshold) {
    Image result(std::max(actual.width, reference.width), std::max(actual.height, reference.height));
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            std::uint8_t* out = result.pixel(x, y);
            out[3] = 255;
            const bool in_both = x < actual.width && y < actual.height && x < reference.width && y < reference.height;
            if (!in_both) {
                out[0] = out[2] = 255;
                continue;
            }
            const std::uint8_t* a = actual.pixel(x, y);
            const int d = largest_difference(a, reference.pixel(x, y));
            if (d > threshold) {
                out[0] = 255;
                out[1] = static_cast<std::uint8_t>(std::min(255, 2 * (d - threshold)));
            } else {
                const int grey = (premultiplied(a, 0) + premultiplied(a, 1) + premultiplied(a, 2)) / 6;
                out[0] = out[1] = out[2] = static_cast<std::uint8_t>(grey);
            }
        }
    }
    return result;
}

void straighten(Image& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t k = i; k < i + 3; ++k)
            image.rgba[k] = static_cast<std::uint8_t>(std::min(255, (image.rgba[k] * 255 + alpha / 2) / alpha));
    }
}

Image reduced(const Image& image, int factor) {
    if (factor <= 1) return image;
    const auto light = linear_of_bytes();
    Image result(image.width / factor, image.height / factor);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            float sum[3]{}, alpha = 0.0F;
            for (int dy = 0; dy < factor; ++dy) {
                const std::uint8_t* in = image.pixel(x * factor, y * factor + dy);
                for (int dx = 0; dx < factor; ++dx, in += 4) {
                    for (int k = 0; k < 3; ++k) sum[k] += light[in[k]] * in[3];
                    alpha += in[3];
                }
            }
            std::uint8_t* out = result.pixel(x, y);
            for (int k = 0; k < 3 && alpha > 0.0F; ++k) out[k] = srgb_byte(sum[k] / alpha);
            out[3] = static_cast<std::uint8_t>(std::lround(alpha / static_cast<float>(factor * factor)));
        }
    return result;
}

} // namespace ramus::render
