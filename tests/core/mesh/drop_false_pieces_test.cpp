#include "core/mesh/connectivity.h"
#include "core/mesh/loops/drop_false_pieces.h"
#include "core/mesh/systems.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"
#include "tests/support/mesh_topology.h"

#include <doctest/doctest.h>

namespace ramus::mesh {

namespace {

// Two vessels aslant, within spheres around (0, 0, 0) and (10, 0, 0).
tree::VesselTree two_vessels() {
    return test::built_tree({{{-0.5, -0.5, 0}, 0.2}, {{0.5, 0.5, 0}, 0.2}, {{9.5, 0, 0}, 0.2}, {{10.5, 0, 0}, 0.2}},
                            {{0, 1}, {2, 3}}, {0, 2});
}

TriangleMesh turned_inward(TriangleMesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    return mesh;
}

} // namespace

TEST_CASE("cavities, and pieces without an axis, are removed; all else stays as it is") {
    TriangleMesh vessels = test::icosphere(2, {0, 0, 0}, 1.0);
    const TriangleMesh second = test::icosphere(2, {10, 0, 0}, 1.0);
    TriangleMesh mesh = vessels;
    append(mesh, turned_inward(test::icosphere(1, {0, 0.6, 0}, 0.2)));
    append(mesh, second);
    append(mesh, test::icosphere(0, {0.4, -0.4, 0}, 0.01)); // beside an axis, within that one's own box
    append(vessels, second);
    REQUIRE(connectivity_of(mesh).pieces == 4);
    CHECK(drop_false_pieces(mesh, two_vessels()) == 2);
    CHECK(mesh == vessels);
    CHECK(test::topology(mesh).closed_manifold());
    CHECK(drop_false_pieces(mesh, two_vessels()) == 0);
    CHECK(mesh == vessels);
}

TEST_CASE("a surface in one piece stays as it is") {
    TriangleMesh mesh = test::icosphere(2, {5, 0, 0}, 1.0); // no axis, which is not looked for
    const TriangleMesh before = mesh;
    CHECK(drop_false_pieces(mesh, two_vessels()) == 0);
    CHECK(mesh == before);
}

} // namespace ramus::mesh
