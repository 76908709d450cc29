// What eyes tell apart, and what they do not.
#include "render/image/perceived.h"

#include <cmath>
#include <doctest/doctest.h>
#include <utility>

using namespace ramus::render;

namespace {

Image plain(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[0] = red, p[1] = green, p[2] = blue, p[3] = 255;
        }
    return image;
}

} // namespace

TEST_CASE("even colours are as far apart as L*a*b* has them") {
    CHECK(perceived_difference(plain(40, 30, 9, 90, 200), plain(40, 30, 9, 90, 200))->largest == 0.0);
    // Black and white; sRGB's red and green as tables have them: (53.24, 80.09, 67.20), (87.73, -86.18, 83.18).
    CHECK(perceived_difference(plain(40, 30, 0, 0, 0), plain(40, 30, 255, 255, 255))->mean ==
          doctest::Approx(100.0).epsilon(1e-3));
    const auto found = perceived_difference(plain(40, 30, 255, 0, 0), plain(40, 30, 0, 255, 0));
    CHECK(found->mean == doctest::Approx(std::sqrt(34.49 * 34.49 + 166.27 * 166.27 + 15.98 * 15.98)).epsilon(2e-3));
    CHECK(found->noticeable == 1200);
}

TEST_CASE("eyes see a tint that counting does not, and not what lies below their sharpness") {
    // Six of 255 everywhere: no pixel is beyond 8 of 255, and everyone sees it side by side.
    const Image grey = plain(64, 64, 120, 120, 120), tinted = plain(64, 64, 126, 120, 114);
    CHECK(compare(grey, tinted)->differing == 0);
    CHECK(perceived_difference(grey, tinted)->noticeable == 64 * 64);
    // Red and green checks of single pixels against the other way round: all pixels differ, nobody sees it from afar.
    Image checks = plain(96, 96, 150, 110, 110), turned = checks;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            std::swap((((x + y) & 1) == 0 ? checks : turned).pixel(x, y)[0],
                      (((x + y) & 1) == 0 ? checks : turned).pixel(x, y)[1]);
    CHECK(compare(checks, turned)->fraction() == 1.0);
    const auto near = perceived_difference(checks, turned, 10.0), far = perceived_difference(checks, turned, 120.0);
    CHECK(near->mean > 10.0 * far->mean);
    CHECK(far->fraction() < 0.2); // at the edges, where the picture goes on as it ends
    CHECK_FALSE(perceived_difference(grey, checks).has_value());
}
