#include "render/image/image.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>

using namespace ramus::render;

namespace {

std::filesystem::path fresh_folder(const std::string& name) {
    auto folder = std::filesystem::path(RAMUS_TEST_OUTPUT) / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(x), p[1] = static_cast<std::uint8_t>(3 * y), p[2] = 77;
            p[3] = static_cast<std::uint8_t>(255 - x);
        }
    return image;
}

} // namespace

TEST_CASE("a PNG gives back the very pixels, alpha included, and leaves nothing else in the folder") {
    const auto folder = fresh_folder("png");
    const Image image = gradient(37, 23);
    REQUIRE(write_png(image, folder / "a.png").has_value());
    const auto again = read_png(folder / "a.png");
    REQUIRE(again.has_value());
    CHECK(*again == image);
    CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
}

TEST_CASE("pictures that cannot be read or written are errors with the file's name") {
    const auto folder = fresh_folder("png_errors");
    std::ofstream(folder / "junk.png") << "this is no picture";
    std::ofstream(folder / "empty.png") << "";
    CHECK(read_png(folder / "junk.png").error().where == (folder / "junk.png").string());
    CHECK_FALSE(read_png(folder / "empty.png").has_value());
    CHECK_FALSE(read_png(folder / "missing.png").has_value());
    CHECK_FALSE(read_png(folder).has_value());
    CHECK_FALSE(write_png(gradient(2, 2), folder / "no" / "such" / "folder.png").has_value());
    CHECK_FALSE(write_png(gradient(2, 2), folder).has_value());
    // A truncated file.
    REQUIRE(write_png(gradient(64, 64), folder / "whole.png").has_value());
    std::filesystem::resize_file(folder / "whole.png", std::filesystem::file_size(folder / "whole.png") / 2);
    CHECK_FALSE(read_png(folder / "whole.png").has_value());
}

TEST_CASE("comparing counts the pixels beyond the threshold") {
    Image a(10, 10), b(10, 10);
    for (std::size_t i = 3; i < a.rgba.size(); i += 4) a.rgba[i] = b.rgba[i] = 255;
    CHECK(compare(a, b)->differing == 0);
    b.pixel(4, 4)[1] = 8;
    b.pixel(5, 4)[1] = 9;
    b.pixel(6, 4)[2] = 200;
    const auto comparison = compare(a, b, 8);
    REQUIRE(comparison.has_value());
    CHECK(comparison->differing == 2);
    CHECK(comparison->largest == 200);
    CHECK(comparison->fraction() == doctest::Approx(0.02));
    CHECK_FALSE(compare(a, Image(9, 10)).has_value());
    CHECK(difference(a, b).pixel(6, 4)[0] == 255);
    CHECK(difference(a, b).pixel(4, 4)[0] < 10);
    CHECK(difference(a, Image(12, 9)).width == 12);
}

TEST_CASE("the colour of what is transparent does not count") {
    Image a(1, 1), b(1, 1);
    a.pixel(0, 0)[0] = 255;
    CHECK(compare(a, b)->differing == 0);
    a.pixel(0, 0)[3] = 255;
    CHECK(compare(a, b)->differing == 1);
}

TEST_CASE("a reduced picture is the mean of its pixels in linear light, weighted by their alpha") {
    Image image(4, 2);
    for (int x = 0; x < 2; ++x)
        for (int y = 0; y < 2; ++y) {
            std::uint8_t* left = image.pixel(x, y);
            left[0] = left[1] = left[2] = (x + y) % 2 == 0 ? 255 : 0;
            left[3] = 255;
            std::uint8_t* right = image.pixel(2 + x, y);
            right[0] = x == 0 ? 200 : 17;
            right[3] = x == 0 ? 255 : 0; // its colour counts for nothing
        }
    const Image half = reduced(image, 2);
    REQUIRE(half.width == 2);
    REQUIRE(half.height == 1);
    CHECK(half.pixel(0, 0)[0] == 188); // half of the light: 255 (1.055 * 0.5^(1/2.4) - 0.055)
    CHECK(half.pixel(0, 0)[3] == 255);
    CHECK(half.pixel(1, 0)[0] == 200);
    CHECK(half.pixel(1, 0)[3] == 128);
    CHECK(reduced(image, 1) == image);
}
