// Narrowings of vessels of known sections.
#include "core/slice/cross_section.h"
#include "core/slice/stenosis.h"
#include "tests/core/slice/swept_tube.h"

#include <doctest/doctest.h>

using namespace ramus;

TEST_CASE("a waist of half the diameter is a narrowing by 50 percent of the diameter and 75 of the area") {
    // Across the axis an ellipse: half axes 4 and 3, in the waist half of that.
    const auto waist = [](double z) { return 1.0 - 0.5 * std::exp(-z * z / 18.0); };
    const auto mesh = test::swept_tube(
        [&](double t, double angle) {
            const double z = 60.0 * t - 30.0;
            return glm::dvec3(4.0 * waist(z) * std::cos(angle), 3.0 * waist(z) * std::sin(angle), z);
        },
        601, 128);
    const auto tree = test::vessel_of([](double t) { return glm::dvec3(0.0, 0.0, 60.0 * t - 30.0); }, 61, 3.0);
    const auto path = slice::path_of_branch(tree, 0, 0.25);
    REQUIRE(path);
    const slice::MeshBlocks blocks(mesh);
    const auto lumens = slice::lumens_along(
        path->samples, [&](const slice::Plane& plane) { return slice::section(blocks, plane); },
        slice::OtherBranches(tree, *path));
    std::vector<slice::SectionFigures> figures;
    for (const auto& lumen : lumens)
        figures.push_back(lumen && lumen->closed ? slice::SectionFigures(lumen->figures) : std::nullopt);
    const slice::SampleRange whole{2, figures.size() - 3};
    const auto check = [&](const slice::Stenosis& found, double least, double equivalent, double area) {
        CHECK(std::abs(found.least_diameter.percent - least) < 0.6);
        CHECK(std::abs(found.equivalent_diameter.percent - equivalent) < 0.6);
        CHECK(std::abs(found.area.percent - area) < 0.6);
        CHECK(path->samples[found.area.sample].at.z == doctest::Approx(0.0));
        CHECK(path->samples[found.least_diameter.sample].at.z == doctest::Approx(0.0));
    };
    // A place, a stretch and a diameter as the reference.
    const std::size_t far = path->nearest(8.0);
    const auto place = slice::reference_of(figures, {far, far});
    REQUIRE(place);
    check(*slice::stenosis_of(figures, whole, *place), 50.0, 50.0, 75.0);
    const auto stretch = slice::reference_of(figures, {path->nearest(3.0), path->nearest(12.0)});
    REQUIRE(stretch);
    CHECK(stretch->area_mm2 == doctest::Approx(test::kPi * 12.0).epsilon(0.01));
    check(*slice::stenosis_of(figures, whole, *stretch), 50.0, 50.0, 75.0);
    const double diameter = 8.0; // the waist's least is 3, its equivalent sqrt(12)
    check(*slice::stenosis_of(figures, {whole.last, whole.first}, slice::figures_of_disc(diameter)), 62.5,
          100.0 * (1.0 - std::sqrt(12.0) / 8.0), 100.0 * (1.0 - 12.0 / 64.0));
    // Away from the waist the vessel is wider than a thin reference.
    CHECK(slice::stenosis_of(figures, {path->nearest(4.0), path->nearest(9.0)}, slice::figures_of_disc(3.0))
              ->area.percent < 0.0);
    CHECK_FALSE(slice::stenosis_of(figures, whole, slice::ShapeFigures{}));
    const std::vector<slice::SectionFigures> none(figures.size());
    CHECK_FALSE(slice::stenosis_of(none, whole, *place));
    CHECK_FALSE(slice::reference_of(none, whole));
}
