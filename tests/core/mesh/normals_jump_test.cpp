// How far the field's normals turn across the planes at the ends of segments, where the paper's radii have kinks.
#include "core/io/trees/tree_file.h"
#include "core/mesh/tree_field.h"
#include "tests/support/brute_force_field.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

using namespace ramus;

namespace {

// The first point of the surface on a way out of a vessel; none where it does not come out.
std::optional<glm::dvec3> way_out(const test::BruteForceField& field, glm::dvec3 from, glm::dvec3 direction,
                                  double radius) {
    if (field.value(from) < field.isovalue()) return std::nullopt;
    double inside = 0.0, outside = 0.0;
    while (outside < 2.0 * radius && field.value(from + outside * direction) >= field.isovalue())
        inside = outside, outside += 0.1 * radius;
    if (outside >= 2.0 * radius) return std::nullopt;
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (inside + outside);
        (field.value(from + middle * direction) >= field.isovalue() ? inside : outside) = middle;
    }
    return from + outside * direction;
}

double turn_deg(const test::BruteForceField& field, glm::dvec3 at, glm::dvec3 step, double radius) {
    const glm::dvec3 a = field.gradient(at - step, radius), b = field.gradient(at + step, radius);
    const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

// Degrees, ascending: eight places around each of about `ends` ends of segments, on both sides of it, `apart` radii.
std::vector<double> jumps(const tree::VesselTree& tree, const mesh::SurfaceOptions& options, std::size_t ends,
                          double apart) {
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, options);
    const test::BruteForceField whole(prepared, options.width);
    const std::size_t every = std::max<std::size_t>(prepared.tree.segment_count() / ends, 1);
    std::vector<double> found;
    std::size_t n = 0;
    for (const tree::Branch& branch : prepared.tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++n) {
            if (n % every != 0) continue;
            const tree::Point& from = prepared.tree.points[branch.points[i - 1]];
            const tree::Point& at = prepared.tree.points[branch.points[i]];
            const glm::dvec3 along = at.position - from.position;
            if (!(glm::length(along) > 0.0)) continue;
            const glm::dvec3 u = glm::normalize(along);
            const glm::dvec3 side = glm::normalize(
                glm::cross(u, std::abs(u.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
            const glm::dvec3 other = glm::cross(u, side);
            const test::BruteForceField field = whole.around(at.position);
            for (int k = 0; k < 8; ++k) {
                const double angle = k * std::numbers::pi / 4.0;
                const glm::dvec3 out = std::cos(angle) * side + std::sin(angle) * other;
                const auto on = way_out(field, at.position, out, at.radius);
                if (on) found.push_back(turn_deg(field, *on, 0.5 * apart * at.radius * u, at.radius));
            }
        }
    std::ranges::sort(found);
    return found;
}

} // namespace

TEST_CASE("normals of smooth centerlines do not jump at the ends of segments of raw voxel data" *
          doctest::test_suite("slow")) {
    constexpr std::size_t kEnds = 400;
    for (const std::string name :
         {"brain_BG001.swc", "brain_BG0002.swc", "airways_from_mask.swc", "kidney_77922_segments.swc"}) {
        CAPTURE(name);
        const auto path = test::shared_file("trees", name);
        if (!path) return;
        const auto tree = io::read_tree(*path);
        REQUIRE(tree.has_value());
        mesh::SurfaceOptions options{.smooth_passes = 0, .centerline = tree::Centerline::kLines};
        const auto most = [](const std::vector<double>& found) { return found[found.size() * 99 / 100]; };
        const double lines = most(jumps(*tree, options, kEnds, 1e-4));
        options.centerline = tree::Centerline::kSmooth;
        const double smooth = most(jumps(*tree, options, kEnds, 1e-4));
        const double near = most(jumps(*tree, options, kEnds, 0.01)); // the bend of the surface itself is part of this
        MESSAGE(name, ": 99 % of normals turn by less than ", lines, " degrees with lines, ", smooth,
                " when smooth; within a hundredth of the radius by ", near);
        CHECK(lines > 10.0);
        CHECK(smooth < 0.1);
        CHECK(near < 3.0);
    }
}
