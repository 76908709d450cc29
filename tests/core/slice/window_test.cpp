// Windows: values to greys, presets, what a file proposes, and what its values suggest.
#include "core/slice/window.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("a window maps its range from black to white, and is found by name") {
    const slice::Window window{100.0, 50.0};
    CHECK(window.grey(75.0F) == 0.0F);
    CHECK(window.grey(100.0F) == 0.5F);
    CHECK(window.grey(112.5F) == 0.75F);
    CHECK(window.grey(125.0F) == 1.0F);
    CHECK(window.grey(-3000.0F) == 0.0F);
    CHECK(window.grey(3000.0F) == 1.0F);
    CHECK(std::isnan(window.grey(NAN)));
    CHECK(slice::window_named("lung") == slice::Window{-600.0, 1500.0});
    CHECK_FALSE(slice::window_named("Lung "));
}

TEST_CASE("the usual window is what the file proposes, otherwise from percentiles of its values") {
    volume::Volume scan;
    scan.size = {101, 10, 10};
    SparseArray<std::int16_t> values;
    values.resize(10100);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<std::int16_t>(n % 101);
    scan.voxels = std::move(values);
    const slice::Window found = slice::usual_window(scan); // of the values 1 to 100
    CHECK(found.black() == doctest::Approx(2.0).epsilon(0.5));
    CHECK(found.black() + found.width == doctest::Approx(99.0).epsilon(0.02));
    scan.window = volume::DisplayWindow{40.0, 350.0};
    CHECK(slice::usual_window(scan) == slice::Window{40.0, 350.0});
    volume::Volume flat;
    flat.size = {1, 1, 1};
    flat.voxels = SparseArray<float>(1);
    CHECK(slice::usual_window(flat).width > 0.0);
}
