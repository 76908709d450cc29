// The vectorised field against the formula in double precision, on every instruction set that this machine has.
#include "core/field/convolution_field.h"
#include "core/field/kernels/gaussian.h"
#include "core/mesh/polygonize/polygonize.h"
#include "tests/support/field_samples.h"
#include "tests/support/mesh_topology.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;
using namespace ramus::test;

namespace {

struct Exact {
    double value = 0.0;
    double kernels = 0.0; // how many contribute
};

// One kernel with the fade of ConvolutionField, in double precision.
double exact_kernel(const field::FieldSegment& s, const field::Kernel& kernel, glm::dvec3 p, double& rho) {
    const glm::dvec3 u(s.ux, s.uy, s.uz);
    const glm::dvec3 offset = p - glm::dvec3(s.ax, s.ay, s.az);
    const double t = glm::dot(offset, u);
    const double clamped = std::clamp(t, 0.0, static_cast<double>(s.length));
    const double scale = std::sqrt(kernel.width * std::log(2.0)) / (s.radius + s.slope * clamped);
    const glm::dvec3 across = offset - t * u;
    const double q = glm::dot(across, across) * scale * scale;
    rho = q + std::pow((t - clamped) * scale, 2);
    const double c = std::clamp((field::kFadeEnd - rho) / (field::kFadeEnd - field::kFadeBegin), 0.0, 1.0);
    const double ends = 0.5 * (std::erf(t * scale) + std::erf((s.length - t) * scale));
    return c * c * (3.0 - 2.0 * c) * std::exp(-q) * ends;
}

Exact exact_field(const field::ConvolutionField& field, glm::dvec3 p) {
    Exact sum;
    for (const field::FieldSegment& s : field.segments()) {
        double rho = 0.0;
        sum.value += exact_kernel(s, field.kernel(), p, rho);
        if (rho < field::kFadeEnd) sum.kernels += 1.0;
    }
    return sum;
}

} // namespace

TEST_CASE("samples agree with the formula to a millionth per contributing segment") {
    for (const double width : {1.0, 5.0}) {
        on_every_instruction_set([&] {
            const field::ConvolutionField field(crooked_tree(), width);
            const auto all = all_segments(field);
            std::mt19937 random(1);
            double worst = 0.0; // millionths per segment
            for (int trial = 0; trial < 40; ++trial) {
                const PointsAround around(near_the_vessels(field, random), trial % 2 == 0 ? 0.02 : 0.2);
                const Samples samples = sample(field, all, around.grid);
                for (int n = 0; n < field::kGridPoints; ++n) {
                    const auto i = static_cast<std::size_t>(n);
                    const Exact exact =
                        exact_field(field, {around.grid.x[i % 5], around.grid.y[i / 5 % 5], around.grid.z[i / 25]});
                    const double off = std::abs(samples.value[i] - exact.value);
                    if (exact.kernels == 0.0) CHECK(samples.value[i] == 0.0F);
                    if (exact.kernels > 0.0) worst = std::max(worst, off / exact.kernels * 1e6);
                    CHECK(samples.inside[i] == (samples.value[i] >= static_cast<float>(field.kernel().isovalue)));
                }
            }
            CHECK(worst < 1.0);
        });
    }
}

TEST_CASE("a point has the same bits in every call that has its segments") {
    on_every_instruction_set([&] {
        const field::ConvolutionField field(crooked_tree(), 5.0);
        const auto all = all_segments(field);
        std::mt19937 random(2);
        for (int trial = 0; trial < 40; ++trial) {
            const PointsAround around(near_the_vessels(field, random), 0.1);
            const Samples samples = sample(field, all, around.grid);
            std::vector<field::LatticePoint> points;
            for (std::uint8_t n = 0; n < field::kGridPoints; ++n)
                points.push_back({static_cast<std::uint8_t>(4 * (n % 5)), static_cast<std::uint8_t>(4 * (n / 5 % 5)),
                                  static_cast<std::uint8_t>(4 * (n / 25))});
            // Of the segments only those with a contribution somewhere in the box.
            std::vector<std::uint32_t> needed;
            for (const std::uint32_t index : all) {
                bool reaches = false;
                for (std::size_t n = 0; n < field::kGridPoints && !reaches; ++n) {
                    double rho = 0.0;
                    exact_kernel(field.segments()[index], field.kernel(),
                                 {around.grid.x[n % 5], around.grid.y[n / 5 % 5], around.grid.z[n / 25]}, rho);
                    reaches = rho < field::kFadeEnd * 1.001;
                }
                if (reaches) needed.push_back(index);
            }
            std::vector<float> again(points.size());
            const auto brick = field.in_brick();
            brick->enter(needed, around.grid);
            brick->sample_lattice(around.lattice, points, again);
            CHECK(std::ranges::equal(again, samples.value));
            // From another corner, as a neighbouring brick sees them.
            const Samples seen = sample(field, all, two_cells_on(around.grid));
            for (std::size_t n = 0; n < field::kGridPoints; n += 5)
                for (std::size_t i = 0; i < 3; ++i) CHECK(seen.value[n + i] == samples.value[n + 2 + i]);
        }
    });
}

TEST_CASE("bounds hold, and segments that are culled contribute nothing" * doctest::test_suite("slow")) {
    on_every_instruction_set([&] {
        const field::ConvolutionField field(crooked_tree(), 5.0);
        const auto all = all_segments(field);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(-0.5, 0.5);
        int proven_outside = 0;
        int proven_inside = 0;
        for (int trial = 0; trial < 200; ++trial) {
            const glm::dvec3 middle = near_the_vessels(field, random);
            const double side = 0.05 * std::pow(1.5, trial % 10);
            std::vector<std::uint8_t> reaching(all.size());
            const field::ChildCubes cubes{glm::vec3(middle - field.extent().middle()), static_cast<float>(side)};
            const field::ChildBounds bounds = field.bound_children(all, cubes, reaching);
            for (std::size_t child = 0; child < field::kChildren; ++child) {
                const glm::dvec3 centre = middle + side * (glm::dvec3(child & 1, child >> 1 & 1, child >> 2) - 0.5);
                if (bounds.upper[child] < field.kernel().isovalue) ++proven_outside;
                if (bounds.lower[child] > field.kernel().isovalue) ++proven_inside;
                for (int n = 0; n < 30; ++n) {
                    // Corners first, then anywhere.
                    const glm::dvec3 offset = n < 8 ? glm::dvec3(n & 1, n >> 1 & 1, n >> 2) - 0.5
                                                    : glm::dvec3(unit(random), unit(random), unit(random));
                    const glm::dvec3 p = centre + side * offset;
                    const Exact exact = exact_field(field, p);
                    if (bounds.upper[child] < field.kernel().isovalue)
                        CHECK(exact.value < bounds.upper[child] + 1e-6 * (1.0 + exact.kernels));
                    CHECK(exact.value > bounds.lower[child] - 1e-6 * (1.0 + exact.kernels));
                    for (const std::uint32_t index : all) {
                        if ((reaching[index] >> child & 1) != 0) continue;
                        double rho = 0.0;
                        exact_kernel(field.segments()[index], field.kernel(), p, rho);
                        if (rho < field::kFadeEnd) FAIL("a culled segment reaches the box");
                    }
                }
            }
        }
        CHECK(proven_outside > 100); // the bounds are good for something
        CHECK(proven_inside > 10);
    });
}

TEST_CASE("projected points are on the surface, with its normal and radius" * doctest::test_suite("slow")) {
    on_every_instruction_set([&] {
        const field::ConvolutionField field(crooked_tree(), 5.0);
        const auto all = all_segments(field);
        Job job;
        const auto mesh = mesh::polygonize(field, {}, job);
        REQUIRE(mesh);
        const test::Topology topology = test::topology(*mesh);
        CHECK(topology.closed_manifold());
        CHECK(topology.volume > 0.0);
        CHECK(topology.zero_area == 0);
        std::size_t off = 0;
        std::size_t askew = 0;
        for (std::size_t v = 0; v < mesh->positions.size(); v += 7) {
            const glm::dvec3 p(mesh->positions[v]);
            glm::dvec3 gradient;
            const double step = 1e-5 * mesh->radii[v];
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 h(0.0);
                h[axis] = step;
                gradient[axis] = (exact_field(field, p + h).value - exact_field(field, p - h).value) / (2.0 * step);
            }
            const double distance =
                std::abs(exact_field(field, p).value - field.kernel().isovalue) / glm::length(gradient);
            if (distance > 0.005 * mesh->radii[v]) ++off;
            if (glm::dot(glm::normalize(-gradient), glm::dvec3(mesh->normals[v])) < std::cos(0.05)) ++askew;
        }
        const double counted = std::ceil(static_cast<double>(mesh->positions.size()) / 7.0);
        // Segments this short and this uneven have creases where the radius' slope jumps.
        CHECK(static_cast<double>(off) < 0.01 * counted);
        CHECK(static_cast<double>(askew) < 0.05 * counted);
        MESSAGE(std::string(field::gaussian(5.0).sum->instruction_set), ": ", off, " of ", counted, " off, ", askew,
                " askew");
    });
}
