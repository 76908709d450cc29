// Surfaces of masks and fields: closed, manifold, with the topology of the voxels, and where geometry says they are.
#include "core/base/memory.h"
#include "core/mesh/connectivity.h"
#include "core/volume/isosurface.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/voxel_topology.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

using namespace ramus;

namespace {

mesh::TriangleMesh surface(const volume::BitMask& mask, const glm::dmat4& to_patient = glm::dmat4(1.0),
                           int threads = 0) {
    Job job;
    auto mesh = volume::mask_surface(mask, to_patient, {0.0, threads}, job);
    REQUIRE_MESSAGE(mesh, (mesh ? "" : mesh.error().message()));
    return std::move(*mesh);
}

Result<mesh::TriangleMesh> try_surface(const volume::Volume& volume, const volume::Selection& selection) {
    Job job;
    return volume::isosurface(volume, selection, {}, job);
}

mesh::TriangleMesh surface(const volume::Volume& volume, const volume::Selection& selection) {
    auto mesh = try_surface(volume, selection);
    REQUIRE_MESSAGE(mesh, (mesh ? "" : mesh.error().message()));
    return std::move(*mesh);
}

volume::BitMask random_mask(const glm::ivec3& size, double density, unsigned seed) {
    std::mt19937 random(seed);
    volume::BitMask mask(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                if (static_cast<double>(random()) < density * 4294967296.0) mask.set({i, j, k});
    return mask;
}

// Unit normals that lie on the outer side of the triangles' mean.
void check_normals(const mesh::TriangleMesh& mesh) {
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    double worst = 0.0;
    for (const glm::vec3& normal : mesh.normals)
        worst = std::max(worst, std::abs(glm::length(glm::dvec3(normal)) - 1.0));
    CHECK(worst < 1e-6);
}

template <class T, class Value>
volume::Volume sampled(const glm::ivec3& size, const glm::dmat4& to_patient, Value value) {
    volume::Volume volume;
    volume.size = size;
    volume.to_patient = to_patient;
    SparseArray<T> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) values.push_back(static_cast<T>(value(glm::dvec3(i, j, k))));
    const auto [least, most] = std::ranges::minmax_element(values);
    volume.minimum = static_cast<double>(*least);
    volume.maximum = static_cast<double>(*most);
    volume.voxels = std::move(values);
    return volume;
}

double area(const mesh::TriangleMesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
    }
    return sum;
}

// A rotation about no axis of the volume, anisotropic voxels, an origin away from 0; mirrored, if so.
glm::dmat4 oblique(bool mirrored) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), {-120.0, 35.0, 410.0});
    m = glm::rotate(m, 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    return glm::scale(m, {mirrored ? -0.4 : 0.4, 0.5, 0.9});
}

} // namespace

TEST_CASE("every mask's surface is closed, manifold and has the pieces, tunnels and cavities of the voxels") {
    // Widths about the 64 bits of a word, heights about a slab's 16 layers.
    const glm::ivec3 sizes[] = {{1, 1, 1},  {2, 2, 2},   {3, 3, 3},    {5, 4, 6},  {61, 3, 4},  {62, 3, 4},
                                {63, 3, 4}, {64, 2, 17}, {65, 2, 3},   {7, 5, 33}, {126, 3, 3}, {127, 2, 2},
                                {9, 9, 9},  {1, 1, 40},  {20, 20, 20}, {1, 30, 1}};
    unsigned seed = 1;
    for (const glm::ivec3& size : sizes) {
        for (const double density : {0.05, 0.2, 0.5, 0.8, 0.95, 1.0}) {
            CAPTURE(size.x);
            CAPTURE(size.y);
            CAPTURE(size.z);
            CAPTURE(density);
            const volume::BitMask mask = random_mask(size, density, seed++);
            const mesh::TriangleMesh mesh = surface(mask);
            if (mask.count() == 0) {
                CHECK(mesh.triangles.empty());
                continue;
            }
            const test::Topology topology = test::topology(mesh);
            CHECK(topology.closed_manifold());
            CHECK(topology.zero_area == 0);
            CHECK(topology.volume > 0.0);
            const test::VoxelTopology voxels = test::voxel_topology(mask);
            CHECK(topology.euler == 2 * voxels.euler);
            CHECK(mesh::component_count(mesh) == voxels.pieces + voxels.cavities);
            check_normals(mesh);
        }
    }
}

TEST_CASE("each of the 256 ways a cell can be is closed and has the topology of its voxels") {
    for (unsigned inside = 1; inside < 256; ++inside) {
        CAPTURE(inside);
        volume::BitMask mask({2, 2, 2});
        for (int corner = 0; corner < 8; ++corner)
            if ((inside >> corner & 1) != 0) mask.set({corner & 1, corner >> 1 & 1, corner >> 2});
        const test::Topology topology = test::topology(surface(mask));
        CHECK(topology.closed_manifold());
        CHECK(topology.euler == 2 * test::voxel_topology(mask).euler);
    }
}

TEST_CASE("a block of voxels has the volume that geometry gives it, also at the border of the volume") {
    // The surface is the sum (Minkowski's) of the box between the outer voxel centres, L x M x N, and an octahedron of
    // radius 1/2: LMN, on each side a slab of 1/2, along each edge a quarter of a square of area 1/2, at the corners an
    // octahedron of 1/6.
    for (const glm::ivec3& size : {glm::ivec3(1, 1, 1), glm::ivec3(3, 1, 2), glm::ivec3(70, 5, 35)}) {
        const double l = size.x - 1;
        const double m = size.y - 1;
        const double n = size.z - 1;
        const double volume = l * m * n + (l * m + m * n + n * l) + 0.5 * (l + m + n) + 1.0 / 6.0;
        for (const bool mirrored : {false, true}) {
            const glm::dmat4 to_patient = oblique(mirrored);
            const test::Topology topology = test::topology(surface(random_mask(size, 1.0, 0), to_patient));
            CHECK(topology.euler == 2);
            CHECK(topology.volume ==
                  doctest::Approx(volume * volume::voxel_volume_mm3(to_patient)).epsilon(1e-4)); // positions are single
        }
    }
}

TEST_CASE("a ball is where it is, on anisotropic, rotated and mirrored voxels") {
    constexpr double kRadius = 6.0;
    constexpr double kWidest = 0.9; // mm from voxel to voxel
    for (const bool mirrored : {false, true}) {
        CAPTURE(mirrored);
        const glm::dmat4 to_patient = oblique(mirrored);
        const glm::ivec3 size(40, 32, 18);
        const glm::dvec3 centre(to_patient * glm::dvec4(19.3, 15.6, 8.4, 1.0));
        const auto field = sampled<float>(size, to_patient, [&](const glm::dvec3& voxel) {
            return kRadius - glm::distance(glm::dvec3(to_patient * glm::dvec4(voxel, 1.0)), centre);
        });
        const mesh::TriangleMesh mesh = surface(field, {{}, 0.0});
        const test::Topology topology = test::topology(mesh);
        CHECK(topology.closed_manifold());
        CHECK(topology.euler == 2);
        // Along an edge of length h the distance from the centre curves by at most 1 / (R - h), so that linear
        // interpolation is off by at most h^2 / 8 of that.
        const double most_off = kWidest * kWidest / (8.0 * (kRadius - kWidest));
        double off = 0.0;
        double least_cosine = 1.0;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 from_centre = glm::dvec3(mesh.positions[v]) - centre;
            off = std::max(off, std::abs(glm::length(from_centre) - kRadius));
            least_cosine = std::min(least_cosine, glm::dot(glm::normalize(from_centre), glm::dvec3(mesh.normals[v])));
        }
        CHECK(off < most_off + 1e-4); // single precision
        CHECK(least_cosine > std::cos(0.15));
        check_normals(mesh);
        // Chords of at most a cell's diagonal d lie inside by d^2 / (8 R) at most: 1.1 mm and 0.026 mm of 6 here.
        const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3.0);
        CHECK(topology.volume < ball * 1.001);
        CHECK(topology.volume > ball * (1.0 - 3.0 * 0.026 / kRadius));
        CHECK(area(mesh) == doctest::Approx(4.0 * std::numbers::pi * kRadius * kRadius).epsilon(0.01));
    }
}

TEST_CASE("samples at the isovalue leave no degenerate triangle") {
    // A field of few whole numbers, so that most samples are the isovalue.
    std::mt19937 random(3);
    const auto volume = sampled<std::int16_t>({24, 20, 18}, oblique(true),
                                              [&](const glm::dvec3&) { return static_cast<int>(random() % 3); });
    for (const double isovalue : {0.5, 1.0, 1.5, 2.0}) {
        CAPTURE(isovalue);
        const test::Topology topology = test::topology(surface(volume, {{}, isovalue}));
        CHECK(topology.closed_manifold());
        CHECK(topology.zero_area == 0);
    }
}

TEST_CASE("label sets are inside, all other labels outside") {
    // 1 | 2 | 3 along x, on nothing.
    const auto volume = sampled<std::uint8_t>({12, 6, 6}, glm::dmat4(1.0), [](const glm::dvec3& v) {
        return v.y < 1 || v.y > 4 || v.z < 1 || v.z > 4 ? 0 : 1 + static_cast<int>(v.x) / 4;
    });
    const auto of = [&](std::vector<volume::LabelChoice> labels) { return surface(volume, {std::move(labels), {}}); };
    const auto extent_x = [](const mesh::TriangleMesh& mesh) {
        const auto [least, most] = std::ranges::minmax_element(
            mesh.positions, [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
        return glm::vec2(least->x, most->x);
    };
    CHECK(extent_x(of({})) == glm::vec2(-0.5, 11.5));
    CHECK(extent_x(of({1})) == glm::vec2(-0.5, 3.5));
    CHECK(extent_x(of({2})) == glm::vec2(3.5, 7.5));
    CHECK(extent_x(of({2, 3})) == glm::vec2(3.5, 11.5));
    CHECK(mesh::component_count(of({1, 3})) == 2);
    CHECK(of({1, 2, 3}) == of({}));
    CHECK(of({3, 2, 2}) == of({2, 3}));

    const auto other = try_surface(volume, {{1, 9}, {}});
    REQUIRE_FALSE(other);
    CHECK(other.error().what == "no voxel has label 9");
    const auto nothing = try_surface(volume, {{}, 100.0});
    REQUIRE_FALSE(nothing);
    CHECK(nothing.error().what == "nothing is inside");
}

TEST_CASE("what is a mask is taken without a word, what is a scan is asked about") {
    const auto scan =
        sampled<std::int16_t>({4, 4, 4}, glm::dmat4(1.0), [](const glm::dvec3& v) { return 100.0 * v.x - 150.0; });
    const auto refused = try_surface(scan, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().hint.find("--isovalue") != std::string::npos);
    CHECK(try_surface(scan, {{}, 0.0}));
    CHECK(try_surface(scan, {{-50}, {}}));

    const auto fractions = sampled<float>({4, 4, 4}, glm::dmat4(1.0), [](const glm::dvec3& v) { return v.x / 4.0; });
    CHECK(surface(fractions, {}) == surface(fractions, {{}, 0.5}));
    const auto labels = try_surface(fractions, {{1}, {}});
    REQUIRE_FALSE(labels);
    CHECK(labels.error().what.find("fractions") != std::string::npos);
}

TEST_CASE("threads change nothing, and giving the voxels up neither") {
    const volume::BitMask mask = random_mask({70, 40, 90}, 0.3, 5);
    const mesh::TriangleMesh one = surface(mask, oblique(false), 1);
    for (const int threads : {2, 3, 8}) CHECK(surface(mask, oblique(false), threads) == one);

    auto volume = sampled<std::uint8_t>(mask.size(), oblique(false),
                                        [&](const glm::dvec3& v) { return mask.test(glm::ivec3(v)) ? 1 : 0; });
    CHECK(surface(volume, {}) == one);
    Job job;
    CHECK(volume::isosurface(std::move(volume), {}, {}, job) == one);
    CHECK(job.progress() == 1.0F);
}

TEST_CASE("a surface is refused when memory, precision or patience end") {
    const volume::BitMask mask = random_mask({64, 64, 64}, 0.5, 9);
    Job job;
    const auto refusal = [&](const glm::dmat4& to_patient, double memory) {
        const auto mesh = volume::mask_surface(mask, to_patient, {memory}, job);
        REQUIRE_FALSE(mesh);
        return mesh.error().what;
    };
    CHECK(refusal(glm::dmat4(1.0), 1.0).find("MB of memory") != std::string::npos);
    // Steps of 1 micron 100 m away.
    CHECK(refusal(glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(1e5)), glm::dvec3(1e-3)), 0.0)
              .find("single precision") != std::string::npos);
    job.cancel();
    CHECK(refusal(glm::dmat4(1.0), 0.0) == "cancelled");
}

TEST_CASE("zeros of a volume take no memory") {
    const double before = process_memory();
    SparseArray<float> values;
    values.resize(std::size_t{64} << 20); // 256 MB
    const std::vector<std::uint8_t> zeros(std::size_t{1} << 20);
    for (std::size_t at = 0; at < values.size(); at += zeros.size())
        copy_sparsely(zeros.data(), zeros.size(), values.data() + at);
    CHECK(values[12345678] == 0.0F);
    values[23456789] = 1.0F;
    CHECK(process_memory() - before < 16e6);
}
