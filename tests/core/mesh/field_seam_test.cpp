// Fields that ramus does not have, through the polygonizer that it has: another kernel in the plain sum, and a torus
// that is no sum at all.
#include "core/field/convolution_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "tests/support/built_tree.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/soft_kernel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

using namespace ramus;

namespace {

tree::PreparedTree forked_vessel() {
    tree::PreparedTree prepared;
    const glm::dvec3 joint(0.3, 0.1, 0.2);
    test::add_branch(prepared, {{{-12.0, 1.0, 0.5}, 2.0}, {joint, 1.5}});
    test::add_branch(prepared, {{joint, 1.3}, {{8.0, 6.0, 1.0}, 0.8}, {{13.0, 7.0, 3.0}, 0.7}});
    test::add_branch(prepared, {{joint, 1.2}, {{9.0, -5.0, -2.0}, 0.9}});
    return prepared;
}

// The plain sum of the soft kernel, in double precision.
double soft_sum(const field::Skeleton& skeleton, glm::dvec3 p) {
    double sum = 0.0;
    for (const field::FieldSegment& s : skeleton.segments()) {
        const glm::dvec3 u(s.ux, s.uy, s.uz);
        const glm::dvec3 offset = p - glm::dvec3(s.ax, s.ay, s.az);
        const double t = std::clamp(glm::dot(offset, u), 0.0, static_cast<double>(s.length));
        const double distance = glm::length(offset - t * u) / (s.radius + s.slope * t);
        sum += std::pow(std::max(0.0, 1.0 - std::pow(distance / test::kSoftSupport, 2.0)), 3.0);
    }
    return sum;
}

// Where point n of a group is on the grid (core/field/brick_field.h).
glm::ivec3 grid_point(std::size_t group, std::size_t point) {
    const int n = static_cast<int>(point);
    if (group < 4) return {n % 4, n / 4, static_cast<int>(group)};
    if (group == 4) return {4, n % 4, n / 4};
    if (group == 5) return {n % 4, 4, n / 4};
    if (group == 6) return {n % 4, n / 4, 4};
    return {n / 4 == 0 ? n % 4 : 4, n / 4 == 1 ? n % 4 : 4, n / 4 == 2 ? n % 4 : 4};
}

// A ring about the z axis, 2 - distance / radius: written point by point, for its own skeleton's sake only.
class Torus {
public:
    static constexpr double kRing = 10.0, kRadius = 1.25;

    Torus() : skeleton_(ring(), 2.1) {}

    static double value(glm::dvec3 p) { return std::max(0.0, 2.0 - glm::length(p - core_of(p)) / kRadius); }
    static glm::dvec3 core_of(glm::dvec3 p) {
        const double from_axis = std::max(1e-9, std::hypot(p.x, p.y));
        return {kRing * p.x / from_axis, kRing * p.y / from_axis, 0.0};
    }

    [[nodiscard]] const field::Skeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] float isovalue() const { return 1.0F; }
    [[nodiscard]] double support_radii() const { return 2.1; }
    [[nodiscard]] std::optional<field::SegmentChanges> changes_since(const Torus& before) const {
        return skeleton_.changes_since(before.skeleton_);
    }
    [[nodiscard]] Torus without(std::span<const std::uint8_t> /*hidden*/) const { return *this; } // it has no branches
    [[nodiscard]] field::ChildBounds bound_children(field::SegmentIndices list, const field::ChildCubes& cubes,
                                                    std::span<std::uint8_t> reaching) const {
        const field::ChildCentres centres(cubes);
        const double half_diagonal = 0.5 * std::sqrt(3.0) * 1.001 * cubes.side;
        field::ChildBounds bounds;
        std::ranges::fill(reaching, std::uint8_t{0});
        for (std::size_t c = 0; c < field::kChildren; ++c) {
            const glm::dvec3 centre =
                skeleton_.extent().middle() + glm::dvec3(centres.x[c], centres.y[c], centres.z[c]);
            const double middle = 2.0 - glm::length(centre - core_of(centre)) / kRadius;
            bounds.lower[c] = static_cast<float>(middle - half_diagonal / kRadius);
            bounds.upper[c] = static_cast<float>(middle + half_diagonal / kRadius);
            for (std::size_t m = 0; m < list.size(); ++m) {
                const field::FieldSegment& s = skeleton_.segments()[list[m]];
                const glm::dvec3 start(s.ax, s.ay, s.az);
                const double reach = support_radii() * kRadius + static_cast<double>(s.length) + half_diagonal;
                if (glm::distance(centre, start) < reach)
                    reaching[m] = static_cast<std::uint8_t>(reaching[m] | 1U << c);
            }
        }
        return bounds;
    }

    class InBrick final : public field::BrickField {
    public:
        void enter(field::SegmentIndices /*list*/, const field::GridAxes& axes) override { axes_ = axes; }
        std::uint64_t sample_groups(unsigned groups, field::GridGroups& samples) override {
            for (unsigned rest = groups; rest != 0; rest &= rest - 1) {
                const auto group = static_cast<std::size_t>(std::countr_zero(rest));
                samples.inside[group] = 0;
                for (std::size_t n = 0; n < field::kGroupPoints; ++n) {
                    const glm::ivec3 at = grid_point(group, n);
                    const auto v = static_cast<float>(
                        value({axes_.x[static_cast<std::size_t>(at.x)], axes_.y[static_cast<std::size_t>(at.y)],
                               axes_.z[static_cast<std::size_t>(at.z)]}));
                    samples.value[group][n] = v;
                    samples.inside[group] =
                        static_cast<std::uint16_t>(samples.inside[group] | (v >= 1.0F ? 1U : 0U) << n);
                }
            }
            return 0;
        }
        std::uint64_t sample_lattice(const field::LatticeAxes& axes, std::span<const field::LatticePoint> points,
                                     std::span<float> values) override {
            for (std::size_t n = 0; n < points.size(); ++n)
                values[n] = static_cast<float>(value({axes.x[points[n].i], axes.y[points[n].j], axes.z[points[n].k]}));
            return points.size();
        }
        std::uint64_t project(field::Projection& guesses, const field::SurfacePoints& to) override {
            for (std::size_t n = 0; n < guesses.size(); ++n) {
                const glm::dvec3 guess = axes_.corner() + glm::dvec3(guesses.x[n], guesses.y[n], guesses.z[n]);
                const glm::dvec3 core = core_of(guess);
                const glm::dvec3 normal = glm::normalize(guess - core);
                const glm::dvec3 centre = axes_.corner() + glm::dvec3(guesses.cx[n], guesses.cy[n], guesses.cz[n]);
                const glm::dvec3 reach(guesses.reach[n]);
                to.positions[n] = glm::vec3(glm::clamp(core + kRadius * normal, centre - reach, centre + reach));
                to.normals[n] = glm::vec3(normal);
                to.radii[n] = static_cast<float>(kRadius);
                to.branches[n] = 7;
                to.dominance[n] = {{255, 255}, {0, 0}};
            }
            return guesses.size();
        }
        void find_depths(const field::GridValues& values, field::GridValues& depths) const override {
            std::ranges::transform(values, depths.begin(), [](float v) { return v - 1.0F; });
        }
        [[nodiscard]] float crossing(float from, float to) const override { return (1.0F - from) / (to - from); }

    private:
        field::GridAxes axes_;
    };
    [[nodiscard]] bool keeps_apart(field::SegmentIndices /*list*/) const { return false; }
    [[nodiscard]] std::unique_ptr<field::BrickField> in_brick() const { return std::make_unique<InBrick>(); }

private:
    static tree::PreparedTree ring() {
        std::vector<tree::Point> points;
        for (int n = 0; n <= 64; ++n) {
            const double angle = 2.0 * std::numbers::pi * n / 64;
            points.push_back({{kRing * std::cos(angle), kRing * std::sin(angle), 0.0}, kRadius});
        }
        tree::PreparedTree prepared;
        test::add_branch(prepared, points);
        return prepared;
    }

    field::Skeleton skeleton_;
};
static_assert(field::FieldModel<Torus> && field::FieldModel<field::ConvolutionField>);

} // namespace

TEST_CASE("the plain sum of another kernel is polygonized as the Gaussian's is") {
    const field::Kernel kernel = test::soft_kernel();
    const field::ConvolutionField field(field::Skeleton(forked_vessel(), kernel.support_radii), kernel);
    Job job;
    mesh::PolygonizeStatistics statistics;
    const auto mesh = mesh::polygonize(field, {}, job, &statistics);
    REQUIRE(mesh);
    const test::Topology topology = test::topology(*mesh);
    CHECK(topology.closed_manifold());
    CHECK(topology.euler == 2);
    CHECK(topology.volume > 0.0);
    CHECK(statistics.evaluations > 0);
    std::size_t off = 0;
    for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
        const glm::dvec3 p(mesh->positions[v]);
        const glm::dvec3 step = 0.005 * mesh->radii[v] * glm::dvec3(mesh->normals[v]);
        // The surface crosses the normal within half a hundredth of the radius.
        const bool inward = soft_sum(field.skeleton(), p - step) >= kernel.isovalue;
        const bool outward = soft_sum(field.skeleton(), p + step) < kernel.isovalue;
        off += inward && outward ? 0 : 1;
    }
    CHECK(static_cast<double>(off) < 0.01 * static_cast<double>(mesh->positions.size()));
}

TEST_CASE("a field that is no sum is polygonized") {
    Job job;
    const auto mesh = mesh::polygonize(Torus(), {}, job);
    REQUIRE(mesh);
    const test::Topology topology = test::topology(*mesh);
    CHECK(topology.closed_manifold());
    CHECK(topology.euler == 0);
    // 2 pi^2 R r^2, less what flat triangles cut off: below (1 - cos(pi / 16)) of the tube's section, 1.9 %.
    const double exact = 2.0 * std::numbers::pi * std::numbers::pi * Torus::kRing * Torus::kRadius * Torus::kRadius;
    CHECK(topology.volume < exact);
    CHECK(topology.volume > 0.94 * exact);
    double farthest = 0.0;
    for (const glm::vec3& p : mesh->positions) farthest = std::max(farthest, std::abs(Torus::value(p) - 1.0));
    CHECK(farthest < 1e-5);
    CHECK(std::ranges::all_of(mesh->branches, [](std::int32_t branch) { return branch == 7; }));
}

TEST_CASE("a polygonizer follows from one model to another by starting anew") {
    const field::Kernel kernel = test::soft_kernel();
    const field::ConvolutionField soft(field::Skeleton(forked_vessel(), kernel.support_radii), kernel);
    Job job;
    mesh::Polygonizer polygonizer;
    REQUIRE(polygonizer.update(soft, {}, job));
    REQUIRE(polygonizer.update(Torus(), {}, job));
    CHECK(test::topology(polygonizer.compact()).euler == 0);
    const std::vector<std::uint8_t> hidden{0, 0, 1};
    REQUIRE(polygonizer.update(soft, {}, job));
    CHECK(polygonizer.take_edit().whole);
    REQUIRE(polygonizer.update(soft.without(hidden), {}, job));
    CHECK_FALSE(polygonizer.take_edit().whole);
    const auto whole = mesh::polygonize(soft.without(hidden), {}, job);
    REQUIRE(whole);
    CHECK(polygonizer.compact().positions == whole->positions);
    CHECK(polygonizer.compact().triangles == whole->triangles);
}
