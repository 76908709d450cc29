// Image: 8-bit RGBA pixels, sRGB, straight (not premultiplied) alpha, rows from the top. Reads and writes PNG, and
// compares images for golden pictures and `ramus render --reference`. Writing is atomic: a file is complete or absent.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace ramus::io {
class OutputSet;
}

namespace ramus::render {

struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba; // 4 * width * height

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    [[nodiscard]] std::uint8_t* pixel(int x, int y) {
        return rgba.data() +
               4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
    [[nodiscard]] const std::uint8_t* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }
    void fill(const glm::vec3& srgb);            // opaque
    void put(const Image& other, glm::ivec2 at); // `at`: its upper left corner; it must fit
    bool operator==(const Image&) const = default;
};

// Downsamples: each pixel is the mean of factor x factor pixels in linear light. Width and height must be multiples of
// `factor`.
[[nodiscard]] Image reduced(const Image& image, int factor);

// Converts from premultiplied to straight alpha.
void straighten(Image& image);

// Any PNG (grey, palette, 16 bit, ...) as 8-bit RGBA.
[[nodiscard]] Result<Image> read_png(const std::filesystem::path& path);
[[nodiscard]] Result<std::string> encode_png(const Image& image);
// Refuses names with another format's extension (.jpg, .gif), which would misstate the content.
[[nodiscard]] Result<void> check_png_name(const std::filesystem::path& path);
// `together`: a set of files that are put in place together.
[[nodiscard]] Result<void> write_png(const Image& image, const std::filesystem::path& path,
                                     io::OutputSet* together = nullptr);

struct Comparison {
    std::uint64_t pixels = 0;    // in total
    std::uint64_t differing = 0; // with a channel that differs by more than the threshold
    int largest = 0;             // largest difference of any channel, 0 to 255
    [[nodiscard]] double fraction() const { return pixels == 0 ? 0.0 : double(differing) / double(pixels); }
};

// Compares premultiplied colours and alpha. Fails if the sizes differ.
[[nodiscard]] Result<Comparison> compare(const Image& actual, const Image& reference, int threshold = 8);
// Shows where and how much two images differ: the picture in grey, differences above the threshold from red to yellow.
// Has the larger size if the sizes differ.
[[nodiscard]] Image difference(const Image& actual, const Image& reference, int threshold = 8);

} // namespace ramus::render
