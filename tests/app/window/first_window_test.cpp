#include "app/window/first_window.h"

#include <doctest/doctest.h>
#include <initializer_list>

using namespace ramus::app;

TEST_CASE("text follows the desktop's scale, and is larger on large monitors without a scale") {
    CHECK(suggested_scale({{1920, 1080}, 1.0F, 0.0F}) == 1.0F);
    CHECK(suggested_scale({{2560, 1440}, 1.0F, 0.0F}) == 1.0F);
    CHECK(suggested_scale({{1440, 2560}, 1.0F, 0.0F}) == 1.0F); // upright
    CHECK(suggested_scale({{1024, 768}, 1.0F, 0.0F}) == 1.0F);
    CHECK(suggested_scale({{3840, 2160}, 1.0F, 0.0F}) == 1.5F);
    CHECK(suggested_scale({{3840, 2128}, 1.0F, 0.0F}) == 1.5F); // with a panel
    CHECK(suggested_scale({{5120, 2880}, 1.0F, 0.0F}) == 2.0F);
    CHECK(suggested_scale({{3840, 2160}, 2.0F, 0.0F}) == 2.0F);
    CHECK(suggested_scale({{3840, 2160}, 1.25F, 0.0F}) == 1.25F);
    CHECK(suggested_scale({{1920, 1080}, 2.0F, 0.0F}) == 2.0F);
    constexpr float kMmInInch = 25.4F;
    CHECK(suggested_scale({{3840, 2160}, 1.0F, 192.0F / kMmInInch}) == 2.0F);
    CHECK(suggested_scale({{3840, 2110}, 1.0F, 163.0F / kMmInInch}) == 1.5F);  // 27 inches
    CHECK(suggested_scale({{3840, 2160}, 1.0F, 102.0F / kMmInInch}) == 1.5F);  // 43 inches
    CHECK(suggested_scale({{2560, 1440}, 1.0F, 109.0F / kMmInInch}) == 1.0F);  // 27 inches
    CHECK(suggested_scale({{1920, 1080}, 1.0F, 157.0F / kMmInInch}) == 1.0F);  // 14 inches
    CHECK(suggested_scale({{2560, 1600}, 1.0F, 189.0F / kMmInInch}) == 1.25F); // 16 inches
    CHECK(suggested_scale({{0, 0}, 1.0F, 0.0F}) == 1.0F);                      // nothing is known
    CHECK(suggested_scale({{1920, 1080}, 0.2F, 0.0F}) == 0.75F);
    CHECK(suggested_scale({{1920, 1080}, 9.0F, 0.0F}) == 4.0F);
}

TEST_CASE("the size of text follows the scale of the monitor when the window moves") {
    CHECK(scale_after_move(1.0F, 1.5F, 1.0F) == 1.5F); // the first monitor
    CHECK(scale_after_move(2.0F, 1.5F, 1.0F) == 2.0F);
    CHECK(scale_after_move(1.0F, 2.0F, 2.0F) == 1.0F);
    CHECK(scale_after_move(2.0F, 2.0F, 2.0F) == 2.0F);
    CHECK(scale_after_move(12.0F, 2.0F, 2.0F) == 4.0F);
}

TEST_CASE("a first window fits the monitor, and is not tiny on a large one") {
    CHECK(window_pixels({{3840, 2160}, 2.0F, 0.0F}, 2.0F, {0, 0}) == glm::ivec2(2880, 1800));
    CHECK(window_pixels({{3840, 2160}, 1.0F, 0.0F}, 1.5F, {0, 0}) == glm::ivec2(2688, 1512)); // 70 %
    CHECK(window_pixels({{1920, 1080}, 1.0F, 0.0F}, 1.0F, {0, 0}) == glm::ivec2(1440, 900));
    CHECK(window_pixels({{0, 0}, 1.0F, 0.0F}, 1.0F, {0, 0}) == glm::ivec2(1440, 900));
    for (const glm::ivec2 area : {glm::ivec2(1024, 768), glm::ivec2(1024, 740), glm::ivec2(1366, 768)})
        for (const float scale : {1.0F, 1.5F, 2.0F})
            for (const glm::ivec2 chosen : {glm::ivec2(0), glm::ivec2(1440, 900), glm::ivec2(4000, 3000)}) {
                const glm::ivec2 size = window_pixels({area, scale, 0.0F}, scale, chosen);
                CHECK(size.x < area.x);
                CHECK(size.y <= area.y - 36 * scale); // its title bar has room
                CHECK(size.x > 900);
                CHECK(size.y > 600);
            }
}

TEST_CASE("a window size that the user chose is kept") {
    CHECK(window_pixels({{1920, 1080}, 1.0F, 0.0F}, 1.0F, {1100, 700}) == glm::ivec2(1100, 700));
    CHECK(window_pixels({{3840, 2160}, 2.0F, 0.0F}, 2.0F, {1100, 700}) == glm::ivec2(2200, 1400));
    CHECK(window_pixels({{3840, 2160}, 2.0F, 0.0F}, 1.0F, {1100, 700}) == glm::ivec2(1100, 700));
    CHECK(window_pixels({{0, 0}, 1.0F, 0.0F}, 1.0F, {600, 400}) == glm::ivec2(600, 400));
}
