// Rows that a software rasteriser draws at a time.
#include "render/gl/gl_objects.h"

#include <algorithm>
#include <doctest/doctest.h>

using ramus::render::end_of_band;

TEST_CASE("bands of rows lead to the end of any rectangle, and few pixels are in one") {
    for (const int width : {1, 63, 640, 1023, 1024, 1600, 16384})
        for (int first = 0; first < 200; ++first)
            for (const int rows : {1, 2, 63, 64, 65, 200, 1000}) {
                const int end = first + rows;
                int bands = 0;
                for (int at = first; at < end; ++bands) {
                    const int next = end_of_band(at, end, width);
                    REQUIRE(next > at);
                    REQUIRE(next <= end);
                    CHECK((next == end || next % 64 == 0));
                    CHECK((next - at) * width <= std::max(1 << 16, 64 * width));
                    at = next;
                }
                CHECK(bands <= rows / 64 + 2);
            }
}
