// The kernels beside the Gaussian: what they promise, against integrals that are reckoned step by step.
#include "core/field/kernels/kernel_kind.h"
#include "core/field/kernels/polynomial.h"
#include "core/field/kernels/powers.h"
#include "tests/support/field_samples.h"
#include "tests/support/line_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

using namespace ramus;
using namespace ramus::test;

namespace {

struct KernelCase {
    field::KernelKind kind;
    double width;
    [[nodiscard]] field::Kernel kernel() const { return field::make_kernel(kind, width); }
};

constexpr std::array<KernelCase, 8> kKernelCases = {{
    {field::KernelKind::kInverseSquare, 5.0},
    {field::KernelKind::kInverseCubic, 5.0},
    {field::KernelKind::kCauchy, 0.5},
    {field::KernelKind::kCauchy, 5.0},
    {field::KernelKind::kCauchy, 10.0},
    {field::KernelKind::kPolynomial, 1.0},
    {field::KernelKind::kPolynomial, 5.0},
    {field::KernelKind::kPolynomial, 10.0},
}};

constexpr std::size_t kEvery = 5; // of a grid's points

field::ConvolutionField line_field_of(const tree::PreparedTree& prepared, const field::Kernel& kernel) {
    return {field::Skeleton(prepared, kernel.support_radii), kernel};
}

// Radii that go on beyond the ends, too.
tree::PreparedTree crooked_tree_with(tree::Centerline centerline) {
    tree::PreparedTree prepared = crooked_tree();
    prepared.centerline = centerline;
    return prepared;
}

struct Reckoned {
    double value = 0.0, largest = 0.0; // the sum; what an endless vessel would make of the nearest segment
    bool any = false;
};
Reckoned reckon_field(const field::ConvolutionField& field, const LineKernel& witness, const glm::dvec3& p) {
    Reckoned sum;
    for (const field::FieldSegment& s : field.segments()) {
        double rho = 0.0;
        sum.value += witness.of(s, p, rho);
        const bool reaches = rho < std::pow(field.kernel().support_radii, 2.0);
        sum.any = sum.any || reaches;
        if (!reaches) continue;
        const glm::dvec3 u(s.ux, s.uy, s.uz), offset = p - glm::dvec3(s.ax, s.ay, s.az);
        const double off = glm::length(offset - glm::dot(offset, u) * u) / std::max(s.radius, s.end_radius());
        sum.largest = std::max(sum.largest, field.kernel().long_vessel->value(field.kernel(), off * off));
    }
    return sum;
}

} // namespace

TEST_CASE("the field of a long straight vessel is the isovalue at its radius, and 1 on its axis") {
    for (const field::KernelRow& row : field::kernel_rows())
        for (const double width : {0.5, 1.0, 3.0, 5.0, 10.0}) {
            CAPTURE(row.key);
            CAPTURE(width);
            const field::Kernel kernel = field::make_kernel(row.kind, width);
            const auto value = [&](double radii) { return kernel.long_vessel->value(kernel, radii * radii); };
            CHECK(value(0.0) == doctest::Approx(1.0).epsilon(1e-12));
            CHECK(value(1.0) == doctest::Approx(kernel.isovalue).epsilon(1e-12));
            // What says how far out a value is agrees with that at the surface, and how fast it falls there.
            const auto at = kernel.long_vessel->place(kernel, kernel.isovalue);
            const auto less = kernel.long_vessel->place(kernel, kernel.isovalue * (1.0 - 1e-6));
            CHECK((less.measure - at.measure) * at.fall == doctest::Approx(kernel.isovalue * 1e-6).epsilon(1e-3));
            if (row.most_width > 0.0) CHECK(kernel.isovalue == doctest::Approx(std::exp2(-width)).epsilon(1e-9));
            if (row.kind == field::KernelKind::kGaussian) continue;
            const LineKernel witness(row.kind, kernel);
            for (const double radii : {0.0, 0.3, 1.0, 1.4, 0.99 * kernel.support_radii, kernel.support_radii})
                CHECK(value(radii) == doctest::Approx(witness.long_vessel(radii)).epsilon(1e-6));
        }
}

TEST_CASE("a cut kernel is as far from the whole one as is said, and vessels merge where it is said") {
    struct Whole {
        field::KernelKind kind;
        double power, least, most; // what the cut takes, of the isovalue, at most
        double merged, merged_whole;
    };
    for (const Whole& whole : {Whole{field::KernelKind::kInverseSquare, 1.0, 0.21, 0.22, 1.58, 2.00},
                               Whole{field::KernelKind::kInverseCubic, 1.5, 0.073, 0.074, 1.35, 1.41},
                               Whole{field::KernelKind::kCauchy, 2.0, 0.036, 0.038, 1.26, 1.29}}) {
        const field::Kernel kernel = field::make_kernel(whole.kind, 5.0);
        const double soft = kernel.numbers[2];
        const auto uncut = [&](double radii) {
            return std::pow((radii * radii + soft) / (1.0 + soft), 0.5 - whole.power);
        };
        double worst = 0.0;
        for (double radii = 1.0; radii < 20.0; radii += 0.01)
            worst = std::max(
                worst, std::abs(uncut(radii) - kernel.long_vessel->value(kernel, radii * radii) / kernel.isovalue));
        CHECK(worst > whole.least);
        CHECK(worst < whole.most);
        CHECK(kernel.limits.merged == doctest::Approx(whole.merged).epsilon(0.005));
        CHECK(uncut(whole.merged_whole) == doctest::Approx(0.5).epsilon(0.01));
    }
    CHECK(field::polynomial(5.0).support_radii == doctest::Approx(1.1547).epsilon(1e-4));
    CHECK(field::polynomial(1.0).support_radii == doctest::Approx(2.0322).epsilon(1e-4));
}

TEST_CASE("samples of line integrals agree with sums step by step, and are nothing beyond the support" *
          doctest::test_suite("slow")) {
    for (const KernelCase& one : kKernelCases)
        for (const tree::Centerline centerline : {tree::Centerline::kLines, tree::Centerline::kSmooth}) {
            CAPTURE(field::row_of(one.kind).key);
            CAPTURE(one.width);
            const LineKernel witness(one.kind, one.kernel());
            const field::ConvolutionField reckoned = line_field_of(crooked_tree_with(centerline), one.kernel());
            std::mt19937 random(1);
            std::vector<PointsAround> places;
            std::vector<std::vector<Reckoned>> exact; // of some points of each place
            for (int trial = 0; trial < 4; ++trial) {
                const PointsAround& around =
                    places.emplace_back(near_the_vessels(reckoned, random), trial % 2 == 0 ? 0.05 : 0.6);
                auto& there = exact.emplace_back();
                for (std::size_t n = 0; n < field::kGridPoints; n += kEvery)
                    there.push_back(reckon_field(
                        reckoned, witness, {around.grid.x[n % 5], around.grid.y[n / 5 % 5], around.grid.z[n / 25]}));
            }
            on_every_instruction_set([&] {
                const field::ConvolutionField field = line_field_of(crooked_tree_with(centerline), one.kernel());
                const auto all = all_segments(field);
                const double isovalue = field.kernel().isovalue;
                double worst = 0.0;
                for (std::size_t place = 0; place < places.size(); ++place) {
                    const Samples samples = sample(field, all, places[place].grid);
                    for (std::size_t n = 0; n < field::kGridPoints; n += kEvery) {
                        const Reckoned& there = exact[place][n / kEvery];
                        if (!there.any) CHECK(samples.value[n] == 0.0F);
                        // Single precision holds what is subtracted, not what is left.
                        const double off = std::abs(samples.value[n] - there.value);
                        worst = std::max(worst, off / (there.largest + isovalue));
                        CHECK(samples.inside[n] == (samples.value[n] >= static_cast<float>(isovalue)));
                    }
                }
                CHECK(worst < 1e-6);
            });
        }
}

TEST_CASE("gradients of line integrals are those of the sums step by step") {
    struct Gradient {
        std::size_t segment = 0;
        double size = 0.0; // of the kernel there, and the isovalue, per radius
        glm::dvec3 exact{0.0};
    };
    for (const KernelCase& one : kKernelCases) {
        CAPTURE(field::row_of(one.kind).key);
        CAPTURE(one.width);
        const LineKernel witness(one.kind, one.kernel());
        const field::ConvolutionField field = line_field_of(crooked_tree_with(tree::Centerline::kSmooth), one.kernel());
        std::mt19937 random(4);
        std::vector<glm::dvec3> points;
        std::vector<std::vector<Gradient>> gradients; // by point
        for (int trial = 0; trial < 40; ++trial) {
            const glm::dvec3& p = points.emplace_back(near_the_vessels(field, random));
            auto& there = gradients.emplace_back();
            for (std::size_t n = 0; n < field.segments().size(); n += 7) {
                const field::FieldSegment& s = field.segments()[n];
                double rho = 0.0, ignored = 0.0;
                Gradient gradient{n, (witness.of(s, p, rho) + one.kernel().isovalue) / s.radius};
                if (rho > 0.98 * std::pow(field.support_radii(), 2.0)) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::dvec3 h(0.0);
                    h[axis] = 1e-4 * s.radius;
                    gradient.exact[axis] =
                        (witness.of(s, p + h, ignored) - witness.of(s, p - h, ignored)) / (2.0 * h[axis]);
                }
                there.push_back(gradient);
            }
        }
        on_every_instruction_set([&] {
            const field::Kernel kernel = one.kernel();
            double worst = 0.0;
            field::SegmentTerms terms;
            for (std::size_t place = 0; place < points.size(); ++place) {
                terms.clear(field.segments().size());
                for (const field::FieldSegment& s : field.segments()) terms.add(s);
                terms.see_from(points[place]);
                kernel.sum->find_terms(kernel, terms);
                for (const Gradient& gradient : gradients[place])
                    for (int axis = 0; axis < 3; ++axis) {
                        const auto row =
                            static_cast<field::SegmentTerms::Numbers>(field::SegmentTerms::kGradientX + axis);
                        const double off = std::abs(terms.row(row)[gradient.segment] - gradient.exact[axis]);
                        worst = std::max(worst, off / gradient.size);
                    }
            }
            CHECK(worst < 2e-4);
        });
    }
}

TEST_CASE("a point of a line integral has the same bits whichever brick asks, and whatever else is in its list") {
    for (const KernelCase& one : kKernelCases)
        on_every_instruction_set([&] {
            const field::Kernel kernel = one.kernel();
            CAPTURE(field::row_of(one.kind).key);
            const field::ConvolutionField field = line_field_of(crooked_tree_with(tree::Centerline::kSmooth), kernel);
            const auto all = all_segments(field);
            std::mt19937 random(2);
            for (int trial = 0; trial < 20; ++trial) {
                const PointsAround around(near_the_vessels(field, random), 0.15);
                const Samples samples = sample(field, all, around.grid);
                // All segments everywhere, as if every end were near.
                const auto brick = field.in_brick(field::Choice::kAllSegments);
                brick->enter(all, around.grid);
                field::GridGroups groups;
                brick->sample_groups(0xFF, groups);
                for (std::size_t group = 0; group < field::kGroups; ++group)
                    for (std::size_t n = 0; n < field::points_in_group(group); ++n) {
                        const field::GridPlace at = field::kGridPlaces[group][n];
                        CHECK(groups.value[group][n] == samples.value[at.x + 5 * at.y + 25 * at.z]);
                    }
                // From another corner, as a neighbouring brick sees them.
                const Samples seen = sample(field, all, two_cells_on(around.grid));
                for (std::size_t n = 0; n < field::kGridPoints; n += 5)
                    for (std::size_t i = 0; i < 3; ++i) CHECK(seen.value[n + i] == samples.value[n + 2 + i]);
            }
        });
}

TEST_CASE("bounds of line integrals hold, and segments that are culled contribute nothing" *
          doctest::test_suite("slow")) {
    struct Place {
        glm::dvec3 middle{0.0};
        double side = 0.0;
        std::array<std::array<glm::dvec3, 2>, field::kChildren> points{};
        std::array<std::array<Reckoned, 2>, field::kChildren> exact{};
    };
    for (const KernelCase& one : kKernelCases) {
        CAPTURE(field::row_of(one.kind).key);
        CAPTURE(one.width);
        const LineKernel witness(one.kind, one.kernel());
        const tree::PreparedTree prepared = crooked_tree_with(tree::Centerline::kSmooth);
        const field::ConvolutionField reckoned = line_field_of(prepared, one.kernel());
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-0.5, 0.5);
        std::vector<Place> places;
        for (int trial = 0; trial < 30; ++trial) {
            Place place{near_the_vessels(reckoned, random) + (trial % 3 == 0 ? 3.0 : 0.0),
                        0.05 * std::pow(1.5, trial % 10)};
            for (std::size_t child = 0; child < field::kChildren; ++child) {
                const glm::dvec3 corner(child & 1, child >> 1 & 1, child >> 2);
                place.points[child] = {
                    place.middle + place.side * (2.0 * corner - 1.0), // the outer corner, and anywhere
                    place.middle + place.side * (corner - 0.5 + glm::dvec3(unit(random), unit(random), unit(random)))};
                for (std::size_t n = 0; n < 2; ++n)
                    place.exact[child][n] = reckon_field(reckoned, witness, place.points[child][n]);
            }
            places.push_back(place);
        }
        on_every_instruction_set([&] {
            const field::ConvolutionField field = line_field_of(prepared, one.kernel());
            const field::Kernel& kernel = field.kernel();
            const auto all = all_segments(field);
            int proven_outside = 0, proven_inside = 0;
            double nearest_culled = 1e9;
            for (const Place& place : places) {
                std::vector<std::uint8_t> reaching(all.size());
                const field::ChildBounds bounds = field.bound_children(
                    all, {glm::vec3(place.middle - field.extent().middle()), static_cast<float>(place.side)}, reaching);
                for (std::size_t child = 0; child < field::kChildren; ++child) {
                    const bool outside = bounds.upper[child] < kernel.isovalue;
                    proven_outside += outside ? 1 : 0;
                    proven_inside += bounds.lower[child] > kernel.isovalue ? 1 : 0;
                    for (std::size_t n = 0; n < 2; ++n) {
                        const Reckoned& exact = place.exact[child][n];
                        const double slack = 1e-6 * (kernel.isovalue + exact.largest);
                        if (outside) CHECK(exact.value < bounds.upper[child] + slack);
                        CHECK(exact.value > bounds.lower[child] - slack);
                        for (const std::uint32_t index : all)
                            if ((reaching[index] >> child & 1) == 0)
                                nearest_culled =
                                    std::min(nearest_culled, LineKernel::squared_distance(field.segments()[index],
                                                                                          place.points[child][n]));
                    }
                }
            }
            CHECK(nearest_culled > 0.9999 * kernel.support_radii * kernel.support_radii);
            CHECK(proven_outside > 20); // the bounds are good for something
            CHECK(proven_inside > 3);
        });
    }
}
