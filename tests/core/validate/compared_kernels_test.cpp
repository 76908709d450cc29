// Kernels compared: figures that formulas foretell.
#include "core/field/kernels/kernel_kind.h"
#include "core/validate/kernels.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using field::KernelKind;

TEST_CASE("joints have the figures that the Gaussian's formula foretells") {
    const validate::JointFigures of5 = validate::joint_figures(field::make_kernel(KernelKind::kGaussian, 5.0));
    CHECK(of5.merging == doctest::Approx(std::sqrt(1.2)).epsilon(1e-9));
    CHECK(of5.beyond_end == doctest::Approx(0.70752).epsilon(1e-3));
    CHECK(of5.straight_percent < 0.01);
    // In the crotch, far from the joint, each daughter adds half of the isovalue where both are seen along their
    // length.
    CHECK(of5.parting == doctest::Approx(std::sqrt(1.2)).epsilon(0.01));
    const validate::JointFigures of1 = validate::joint_figures(field::make_kernel(KernelKind::kGaussian, 1.0));
    CHECK(of1.beyond_end == doctest::Approx(0.0).epsilon(1e-3));
    CHECK(of1.parting > of5.parting);
    CHECK(of1.blend_reach > of5.blend_reach);
    CHECK(of1.bulge_percent > of5.bulge_percent);
}

TEST_CASE("line integrals do not bulge where a vessel is cut in two, and half of one is at a free end of width 1") {
    for (const field::KernelRow& row : field::kernel_rows()) {
        CAPTURE(row.key);
        const validate::JointFigures joints = validate::joint_figures(field::make_kernel(row.kind, 1.0));
        CHECK(joints.straight_percent < 0.01);
        CHECK(joints.bulge_percent > 1.0);
        CHECK(joints.parting > 1.0);
        // On the axis at its end a long vessel has half of the axis' value 1, the isovalue of width 1.
        if (row.most_width > 0.0) CHECK(joints.beyond_end == doctest::Approx(0.0).epsilon(1e-3));
    }
}

TEST_CASE("of a tree whose vessels come close, kernels merge more the farther they blend, and radii are off by more" *
          doctest::test_suite("slow")) {
    // A fork, and a vessel that passes it at a closeness of 1.25: 2.5 mm between the axes.
    const tree::VesselTree tree = test::built_tree({{{-20.0, 0.0, 0.0}, 1.0},
                                                    {{0.0, 0.0, 0.0}, 1.0},
                                                    {{20.0, 12.0, 0.0}, 1.0},
                                                    {{20.0, -12.0, 0.0}, 1.0},
                                                    {{-10.0, -20.0, 2.5}, 1.0},
                                                    {{-10.0, 20.0, 2.5}, 1.0}},
                                                   {{0, 1}, {1, 2}, {1, 3}, {4, 5}}, {0, 4});
    mesh::SurfaceOptions options;
    options.detail = 12;
    Job job;
    const auto compared = validate::compare_kernels(tree, options, job);
    REQUIRE(compared);
    CHECK(compared->graph_pieces == 2);
    CHECK(compared->graph_loops == 0);
    const auto of = [&](KernelKind kind, double width) {
        const auto found = std::ranges::find_if(
            compared->kernels, [&](const auto& one) { return one.kind == kind && one.width == width; });
        REQUIRE(found != compared->kernels.end());
        return *found;
    };
    for (const validate::KernelFigures& one : compared->kernels) {
        CAPTURE(field::row_of(one.kind).key);
        CAPTURE(one.width);
        CHECK(one.evaluations > 0);
        CHECK(one.radius_error.places > 0);
        // Vessels that cross merge a little later than parallel ones.
        if (one.joints.merging < 1.25) CHECK(one.pieces == 2);
        CHECK(one.merged == static_cast<std::size_t>(2 - one.pieces));
        CHECK(one.loops == 0);
    }
    CHECK(of(KernelKind::kGaussian, 5.0).pieces == 2);
    CHECK(of(KernelKind::kInverseSquare, 0.0).pieces == 1);
    CHECK(of(KernelKind::kInverseSquare, 0.0).to_cones_mean_mm > 2.0 * of(KernelKind::kGaussian, 5.0).to_cones_mean_mm);
    CHECK(of(KernelKind::kInverseSquare, 0.0).radius_error.median > of(KernelKind::kGaussian, 5.0).radius_error.median);
    Job cancelled;
    cancelled.cancel();
    CHECK_FALSE(validate::compare_kernels(tree, options, cancelled));
}
