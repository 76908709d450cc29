#include "core/slice/window.h"

#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace ramus;

TEST_CASE("a window maps its range from black to white, and is found by name and by percentiles") {
    const slice::Window window{100.0, 50.0};
    CHECK(window.grey(75.0) == 0.0);
    CHECK(window.grey(100.0) == 0.5);
    CHECK(window.grey(112.5) == 0.75);
    CHECK(window.grey(125.0) == 1.0);
    CHECK(window.grey(-3000.0) == 0.0);
    CHECK(window.grey(3000.0) == 1.0);
    CHECK(std::isnan(window.grey(NAN)));
    CHECK(slice::window_named("lung") == slice::Window{-600.0, 1500.0});
    CHECK_FALSE(slice::window_named("Lung "));
    std::vector<float> values{NAN, NAN};
    for (int n = 0; n <= 1000; ++n) values.push_back(static_cast<float>((n * 5) % 1001));
    const slice::Window found = slice::window_of(values);
    CHECK(found.level == 500.0);
    CHECK(found.width == 980.0);
    CHECK(slice::window_of(std::vector<float>{3.0F, 3.0F}).grey(3.0) == 0.5);
    CHECK(slice::window_of({}) == slice::Window{});
}
