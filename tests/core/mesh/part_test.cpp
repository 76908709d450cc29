// The parts of a surface that several processes make are those of the surface that one process makes.
#include "core/mesh/polygonize/part.h"
#include "tests/support/grown_tree.h"
#include "tests/support/packed_trees.h"
#include "tests/support/thread_team.h"
#include "tests/support/tree_field.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <set>

using namespace ramus;

namespace {

// The corners of each triangle, from the lowest.
std::multiset<std::array<float, 9>> triangles_of(const mesh::TriangleMesh& mesh) {
    std::multiset<std::array<float, 9>> all;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<std::array<float, 3>, 3> corners{};
        for (int n = 0; n < 3; ++n) {
            const glm::vec3& p = mesh.positions[t[n]];
            corners[static_cast<std::size_t>(n)] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        std::array<float, 9> flat{};
        for (std::size_t n = 0; n < flat.size(); ++n) flat[n] = corners[n / 3][n % 3];
        all.insert(flat);
    }
    return all;
}

void check_together(const field::Field& field, const mesh::PolygonizeOptions& options) {
    Job job;
    std::vector<Bounds<glm::vec3>> walled;
    mesh::PolygonizeStatistics alone;
    const auto whole = mesh::polygonize(field, options, job, &alone, &walled);
    REQUIRE(whole);
    for (const std::size_t size : {1, 2, 3, 5}) {
        CAPTURE(size);
        test::ThreadTeam::run(size, [&](Team& team) {
            Job own;
            std::vector<Bounds<glm::vec3>> boxes;
            mesh::PartStatistics statistics;
            const auto mesh = mesh::polygonize_together(field, options, team, own, &statistics, &boxes);
            CHECK(mesh.has_value());
            CHECK(statistics.evaluations == alone.evaluations);
            if (!mesh) return;
            if (!team.leads()) CHECK(mesh->triangles.empty());
            if (!team.leads()) return;
            CHECK(*mesh == *whole);
            CHECK(std::ranges::equal(
                boxes, walled, [](const auto& a, const auto& b) { return a.least == b.least && a.most == b.most; }));
        });
    }
}

} // namespace

TEST_CASE("a surface that a team makes has the bytes of one that a process makes alone") {
    check_together(test::make_field(test::grown(150), {}, {}), {});
    check_together(test::make_field(test::packed_trees(3), {}, {}), {}); // with walls between vessels
    mesh::PolygonizeOptions coarse;
    coarse.cell_mm = 1.5;
    check_together(test::make_field(test::grown(30), {}, {}), coarse);
    mesh::PolygonizeOptions rough; // of a tree that is divided into many groups
    rough.detail = 4;
    check_together(test::make_field(test::grown(2000), {}, {}), rough);
}

TEST_CASE("the parts of a surface are its triangles, each in one part") {
    const field::Field field = test::make_field(test::grown(60), {}, {});
    Job job;
    const auto whole = mesh::polygonize(field, {}, job);
    REQUIRE(whole);
    std::multiset<std::array<float, 9>> found;
    double shares = 0.0;
    constexpr std::size_t kParts = 4;
    for (std::size_t part = 0; part < kParts; ++part) {
        mesh::PartStatistics statistics;
        const auto made = mesh::polygonize_part(field, {}, {part, kParts}, job, &statistics);
        REQUIRE(made);
        CHECK(made->positions.size() < whole->positions.size() / 2);
        CHECK(statistics.share == doctest::Approx(1.0 / kParts).epsilon(0.2));
        shares += statistics.share;
        found.merge(triangles_of(*made));
    }
    CHECK(shares == doctest::Approx(1.0));
    CHECK(found == triangles_of(*whole));
}

TEST_CASE("more parts than subtrees leave some without triangles") {
    const field::Field field = test::make_field(test::grown(1), {}, {});
    Job job;
    const auto whole = mesh::polygonize(field, {}, job);
    REQUIRE(whole);
    std::size_t triangles = 0;
    constexpr std::size_t kParts = 90;
    for (std::size_t part = 0; part < kParts; ++part) {
        const auto made = mesh::polygonize_part(field, {}, {part, kParts}, job);
        REQUIRE(made);
        triangles += made->triangles.size();
    }
    CHECK(triangles == whole->triangles.size());
}
