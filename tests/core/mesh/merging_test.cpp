// Surfaces of vessels that just merge, or just do not: closed, whatever the width, the radius and the cells, and where
// vessels are kept apart in the pieces and loops of their tree.
#include "core/mesh/surface.h"
#include "tests/support/built_tree.h"
#include "tests/support/merging_vessels.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/surface_shape.h"

#include <doctest/doctest.h>

namespace ramus::mesh {

namespace {

constexpr test::Shape kOneVessel{1, 0};

SurfaceOptions plain_options(double width, int detail) {
    SurfaceOptions options;
    options.smooth_passes = 0;
    options.width = width;
    options.detail = detail;
    return options;
}

void check_one_vessel(const tree::VesselTree& tree, const SurfaceOptions& options) {
    Job job;
    const auto surface = make_untangled_surface(tree, options, job);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    CHECK(test::topology(surface->mesh).closed_manifold());
    if (options.blend == Blend::kTree) CHECK(test::shape_of(test::pieces_of(surface->mesh)) == kOneVessel);
}

} // namespace

TEST_CASE("a surface is closed, and in one piece without loops, near the radius at which vessels merge") {
    for (const test::MergingShape& shape : test::merging_shapes())
        for (const auto centerline : {tree::Centerline::kLines, tree::Centerline::kSmooth})
            for (const Blend blend : {Blend::kTree, Blend::kPaper})
                for (const double width : {1.0, 1.5, 2.0, 3.0, 5.0})
                    for (const double factor : {0.97, 0.99, 0.999, 0.9995, 1.0, 1.01})
                        for (const int detail : {6, 8, 12, 16, 20, 24, 32, 48}) {
                            CAPTURE(shape.name);
                            CAPTURE(centerline);
                            CAPTURE(blend);
                            CAPTURE(width);
                            CAPTURE(factor);
                            CAPTURE(detail);
                            SurfaceOptions options = plain_options(width, detail);
                            options.centerline = centerline;
                            options.blend = blend;
                            check_one_vessel(shape.tree(factor * test::merging_radius(width)), options);
                        }
}

} // namespace ramus::mesh
