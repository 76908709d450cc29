#include "core/mesh/close_mesh.h"
#include "core/mesh/coarse_mesh.h"
#include "tests/support/icosphere.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <utility>

using namespace ramus;
using mesh::TriangleMesh;

namespace {

// Every edge is gone along as often one way as the other.
bool balanced(const TriangleMesh& mesh) {
    std::map<std::pair<unsigned, unsigned>, int> edges;
    for (const glm::uvec3& t : mesh.triangles)
        for (const auto& [a, b] : {std::pair(t.x, t.y), {t.y, t.z}, {t.z, t.x}})
            edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    for (const auto& [edge, sum] : edges)
        if (sum != 0) return false;
    return true;
}

} // namespace

TEST_CASE("a coarse mesh has about as many triangles as asked for, stays closed and near the surface") {
    const double radius = 50.0;
    const TriangleMesh sphere = test::icosphere(6, {10, -20, 30}, radius);
    REQUIRE(sphere.triangles.size() == 81920);
    for (const std::size_t requested : {20000U, 5000U, 500U}) {
        CAPTURE(requested);
        const TriangleMesh coarse = mesh::coarse_mesh(sphere, requested);
        CHECK(coarse.triangles.size() < 1.6 * double(requested));
        CHECK(coarse.triangles.size() > 0.4 * double(requested));
        CHECK(balanced(coarse));
        const double side = std::sqrt(2.0 * 4.0 * 3.14159265 * radius * radius / double(requested));
        REQUIRE(coarse.normals.size() == coarse.positions.size());
        for (std::size_t v = 0; v < coarse.positions.size(); ++v) {
            const glm::dvec3 out = glm::dvec3(coarse.positions[v]) - glm::dvec3(10, -20, 30);
            // The middle of points of the sphere in a cell lies inside it, by no more than the cell's sagitta.
            CHECK(glm::length(out) <= radius * 1.0001);
            CHECK(glm::length(out) >= radius - 3.0 * side * side / (2.0 * radius) - 0.01);
            CHECK(glm::length(coarse.normals[v]) == doctest::Approx(1.0F));
        }
    }
    CHECK(mesh::coarse_mesh(sphere, 100000) == sphere);
}

TEST_CASE("smooth normals forget steps and keep shapes") {
    // Every normal of a ball is off by up to some 30 degrees.
    TriangleMesh sphere = test::icosphere(5, {0, 0, 0}, 10.0);
    const auto true_normals = sphere.normals;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> off(-0.5F, 0.5F);
    for (glm::vec3& n : sphere.normals) n = glm::normalize(n + glm::vec3(off(random), off(random), off(random)));
    const auto mean_error = [&](const TriangleMesh& mesh) {
        double sum = 0.0;
        for (std::size_t v = 0; v < mesh.normals.size(); ++v)
            sum += std::acos(std::min(1.0F, glm::dot(mesh.normals[v], true_normals[v])));
        return sum / double(mesh.normals.size());
    };
    const double before = mean_error(sphere);
    const auto positions = sphere.positions;
    mesh::smooth_normals(sphere, 6);
    CHECK(sphere.positions == positions);
    CHECK(mean_error(sphere) < 0.25 * before);
    for (const glm::vec3& n : sphere.normals) CHECK(glm::length(n) == doctest::Approx(1.0F));
    // What is smooth already stays.
    sphere.normals = true_normals;
    mesh::smooth_normals(sphere, 6);
    CHECK(mean_error(sphere) < 0.01);
}

TEST_CASE("a surface with holes is tidied and kept, one without is turned outward") {
    TriangleMesh cube = test::cube(2.0);
    TriangleMesh open = cube;
    open.triangles.pop_back();
    const auto kept = mesh::tidy_mesh(open, "open");
    REQUIRE(kept);
    CHECK(kept->triangles.size() == 11);
    CHECK(kept->normals.size() == kept->positions.size());
    CHECK_FALSE(mesh::closed_mesh(open, "open"));
    for (glm::uvec3& t : cube.triangles) std::swap(t.y, t.z);
    const auto turned = mesh::tidy_mesh(cube, "inside out");
    REQUIRE(turned);
    for (std::size_t v = 0; v < turned->positions.size(); ++v)
        CHECK(glm::dot(turned->normals[v], turned->positions[v]) > 0.0F);
    TriangleMesh nothing;
    CHECK_FALSE(mesh::tidy_mesh(nothing, "nothing"));
}
