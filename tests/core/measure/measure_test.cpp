#include "core/io/trees/swc.h"
#include "core/measure/tree_measure.h"

#include <doctest/doctest.h>
#include <numbers>

using namespace ramus;

TEST_CASE("a cone's figures are those of geometry, however finely it is sampled") {
    const char* coarse = "1 0 0 0 0 3 -1\n2 0 0 0 12 1 1\n";
    const char* fine = "1 0 0 0 0 3 -1\n2 0 0 0 0.6 2.9 1\n3 0 0 0 1.2 2.8 2\n4 0 0 0 12 1 3\n";
    for (const char* text : {coarse, fine}) {
        const auto tree = io::parse_tree(text, "cone.swc");
        REQUIRE(tree);
        const measure::TreeStatistics figures = measure::tree_statistics(*tree);
        CHECK(figures.length_mm == doctest::Approx(12.0));
        CHECK(figures.volume_mm3 == doctest::Approx(std::numbers::pi / 3.0 * 12.0 * (9.0 + 3.0 + 1.0)));
        CHECK(figures.radius_mm.min == 1.0);
        CHECK(figures.radius_mm.mean == doctest::Approx(2.0));
        CHECK(figures.radius_mm.max == 3.0);
        REQUIRE(figures.branches.size() == 1);
        CHECK(figures.branches[0].diameter_mm.mean == doctest::Approx(4.0));
        CHECK(figures.generations == 1);
        CHECK(figures.leaves == 1);
    }
}
