// Surfaces that are right, and surfaces made wrong on purpose: the tree that the surface is made of is changed, or the
// mesh is, and validation holds it against the tree as it was.
#include "core/io/trees/tree_file.h"
#include "core/mesh/surface.h"
#include "core/validate/validation.h"
#include "tests/support/built_tree.h"
#include "tests/support/shared_data.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <numbers>

using namespace ramus;
using tree::Point;
using tree::VesselTree;

namespace {

// A stem along z that forks twice. Runs of points, each beginning at a point that is there.
class TreeOf {
public:
    explicit TreeOf(const Point& root) : points_{root} {}
    // From a point straight to another place with a radius along the way; returns the last point.
    template <class Radius> std::uint32_t run(std::uint32_t from, const glm::dvec3& to, const Radius& radius) {
        const glm::dvec3 begin = points_[from].position;
        constexpr double kSpacing = 0.5;
        const int steps = static_cast<int>(std::ceil(glm::distance(begin, to) / kSpacing));
        std::uint32_t last = from;
        for (int i = 1; i <= steps; ++i) {
            const double share = double(i) / steps;
            points_.push_back({begin + share * (to - begin), radius(share * glm::distance(begin, to))});
            edges_.emplace_back(last, static_cast<std::uint32_t>(points_.size() - 1));
            last = static_cast<std::uint32_t>(points_.size() - 1);
        }
        return last;
    }
    std::uint32_t root(const Point& point) {
        points_.push_back(point);
        roots_.push_back(static_cast<std::uint32_t>(points_.size() - 1));
        return roots_.back();
    }
    [[nodiscard]] VesselTree tree() const { return test::built_tree(points_, edges_, roots_); }

private:
    std::vector<Point> points_;
    std::vector<tree::Edge> edges_;
    std::vector<std::uint32_t> roots_{0};
};

double constant(double /*along*/) { return 1.0; }

// A fork whose left branch may be left out, with a twig in the middle of the right one if wanted.
VesselTree fork(bool with_left, bool with_ghost) {
    TreeOf tree({{0, 0, 0}, 1.0});
    const std::uint32_t joint = tree.run(0, {0, 0, 30}, constant);
    if (with_left) tree.run(joint, {-18, 0, 54}, constant);
    const std::uint32_t middle = tree.run(joint, {12, 0, 46}, constant);
    tree.run(middle, {24, 0, 62}, constant);
    if (with_ghost) tree.run(middle, {12, 15, 46}, constant);
    return tree.tree();
}

// Straight, with a cosine-shaped stenosis over `diameters` in its middle.
VesselTree stenosed(double share, double diameters) {
    TreeOf tree({{0, 0, 0}, 2.0});
    const double half = diameters * 2.0; // half of its length: the diameter is 4
    tree.run(0, {0, 0, 60}, [&](double along) {
        const double off = (along - 30.0) / half;
        return std::abs(off) < 1.0 ? 2.0 * (1.0 - share * 0.5 * (1.0 + std::cos(std::numbers::pi * off))) : 2.0;
    });
    return tree.tree();
}

VesselTree passing(double distance) {
    TreeOf tree({{0, -15, 0}, 1.0});
    tree.run(0, {0, 15, 0}, constant);
    const std::uint32_t other = tree.root({{-15, 4, distance}, 1.0});
    tree.run(other, {15, 4, distance}, constant);
    return tree.tree();
}

mesh::TriangleMesh surface_with(const VesselTree& tree, const mesh::SurfaceOptions& options) {
    Job job;
    auto surface = mesh::make_surface(tree, options, job);
    REQUIRE_MESSAGE(surface, (surface ? "" : surface.error().message()));
    return std::move(surface->mesh);
}

mesh::TriangleMesh surface_of(const VesselTree& tree, mesh::Blend blend = mesh::Blend::kTree) {
    mesh::SurfaceOptions options;
    options.blend = blend;
    return surface_with(tree, options);
}

validate::Validation validated(const VesselTree& tree, const mesh::TriangleMesh& surface) {
    Job job;
    auto found = validate::validate(tree, surface, {tree::limits_of_gaussian(5.0), 0}, job);
    REQUIRE(found);
    return std::move(*found);
}

void check_counts(const validate::Validation& found, std::size_t lost, std::size_t false_parts, std::size_t merged,
                  std::size_t constrictions) {
    CHECK(found.lost.size() == lost);
    CHECK(found.false_parts.size() == false_parts);
    CHECK(found.merged.size() == merged);
    CHECK(found.constrictions.size() == constrictions);
    CHECK(found.widths.empty());
    CHECK(found.positions.empty());
}

// The branch whose last point is there.
int branch_to(const VesselTree& tree, const glm::dvec3& end) {
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (glm::distance(tree.points[tree.branches[id].points.back()].position, end) < 1e-9)
            return static_cast<int>(id);
    return tree::kNoBranch;
}

} // namespace

TEST_CASE("validation: nothing is wrong with the surface of the tree itself") {
    for (const VesselTree& tree : {fork(true, false), fork(true, true), stenosed(0.5, 2.0), passing(1.8), passing(0.0)})
        check_counts(validated(tree, surface_of(tree)), 0, 0, 0, 0);
}

TEST_CASE("validation: a leaf that the surface lacks is lost, no other") {
    const VesselTree tree = fork(true, false);
    const validate::Validation found = validated(tree, surface_of(fork(false, false)));
    check_counts(found, 1, 0, 0, 0);
    CHECK(found.lost[0].branch == branch_to(tree, {-18, 0, 54}));
    // 30 mm long, but for what the stem's surface covers of it.
    CHECK(found.lost[0].length_mm < 30.0);
    CHECK(found.lost[0].length_mm > 27.0);
    CHECK(glm::distance(found.lost[0].at, glm::dvec3(-9, 0, 42)) < 2.0);
}

TEST_CASE("validation: a branch that the tree lacks is false") {
    const validate::Validation found = validated(fork(true, false), surface_of(fork(true, true)));
    check_counts(found, 0, 1, 0, 0);
    CHECK(std::abs(found.false_parts[0].length_mm - 15.0) < 2.0);
    CHECK(glm::distance(found.false_parts[0].at, glm::dvec3(12, 7.5 + 0.75, 46)) < 2.0);
}

TEST_CASE("validation: vessels that pass each other and are one in the surface are merged") {
    const VesselTree tree = passing(1.8);
    const validate::Validation found = validated(tree, surface_of(tree, mesh::Blend::kPaper));
    check_counts(found, 0, 0, 1, 0);
    CHECK(found.merged[0].branches == std::array<int, 2>{0, 1});
    CHECK(found.merged[0].gap_mm == doctest::Approx(1.8 - 2.0));
    CHECK(glm::distance(found.merged[0].at, glm::dvec3(0, 4, 0.9)) < 1e-6);
}

TEST_CASE("validation: a stenosis that the surface fills is found, one that it keeps is not") {
    for (const double share : {0.2, 0.5, 0.8})
        for (const double diameters : {1.0, 3.0, 5.0}) {
            const VesselTree tree = stenosed(share, diameters);
            const validate::Validation filled = validated(tree, surface_of(stenosed(0.0, 1.0)));
            check_counts(filled, 0, 0, 0, 1);
            CHECK(filled.constrictions[0].branch == 0);
            CHECK(glm::distance(filled.constrictions[0].at, glm::dvec3(0, 0, 30)) < 2.0);
            CHECK(filled.constrictions[0].radius_mm == doctest::Approx(2.0).epsilon(0.02));
            // The field itself fills what is as short as it is wide.
            if (diameters < 3.0) continue;
            const validate::Validation kept = validated(tree, surface_of(tree));
            check_counts(kept, 0, 0, 0, 0);
            double narrowest = 1e300;
            for (const validate::RadiusPlace& place : kept.radii)
                if (place.alone) narrowest = std::min(narrowest, place.surface_mm);
            CHECK(narrowest == doctest::Approx(2.0 * (1.0 - share)).epsilon(0.02));
        }
}

TEST_CASE("validation: triangles turned inward, and a surface with open ends, are no trouble") {
    const VesselTree tree = fork(true, false);
    mesh::TriangleMesh surface = surface_of(tree);
    for (glm::uvec3& t : surface.triangles) std::swap(t.y, t.z);
    for (glm::vec3& normal : surface.normals) normal = -normal;
    check_counts(validated(tree, surface), 0, 0, 0, 0);
    surface = surface_of(tree);
    std::erase_if(surface.triangles, [&](const glm::uvec3& t) { return surface.positions[t.x].z < 0.5F; });
    const validate::Validation open = validated(tree, surface);
    check_counts(open, 0, 0, 0, 0);
    CHECK(open.radius_error.median < 0.005);
}

TEST_CASE("validation: the radius of another surface is asked for at the same places") {
    const VesselTree tree = fork(true, false);
    const mesh::TriangleMesh surface = surface_of(tree);
    const auto found = validated(tree, surface);
    mesh::SurfaceOptions of_cones;
    of_cones.method = mesh::Method::kTruncatedCones;
    of_cones.detail = 64;
    Job job;
    const auto same = validate::radii_in(surface, found.radii, {}, job);
    const auto cones = validate::radii_in(surface_with(tree, of_cones), found.radii, {}, job);
    REQUIRE(same);
    REQUIRE(cones);
    REQUIRE(cones->size() == found.radii.size());
    std::size_t alone = 0;
    for (std::size_t i = 0; i < found.radii.size(); ++i) {
        CHECK((*same)[i] == found.radii[i].surface_mm);
        if (!found.radii[i].alone) continue;
        ++alone;
        // The tree's; 64 flat sides are 0.1 % less across. Joints of cones, where two solids end at one place, too.
        CHECK(std::abs((*cones)[i] - 1.0) < 0.002);
    }
    CHECK(alone > 100);
    job.cancel();
    CHECK_FALSE(validate::radii_in(surface, found.radii, {}, job));
}

TEST_CASE("validation: real trees lose nothing and get nothing that is false" * doctest::test_suite("slow")) {
    for (const auto& path : test::shared_trees()) {
        if (path.stem().string().starts_with("kidney")) continue; // takes minutes under sanitizers
        auto tree = io::read_tree(path);
        REQUIRE(tree);
        INFO(path.string());
        // Only one tree uses the default detail. Coarser triangles lie farther from the field, and take less time.
        const bool at_default = path.filename() == "brain_BG001.swc";
        mesh::SurfaceOptions options;
        if (!at_default) options.detail = 10;
        const validate::Validation found = validated(*tree, surface_with(*tree, options));
        CHECK(found.nothing_found());
        CHECK(found.fidelity.points > 900);
        CHECK(found.fidelity.outside == 0);
        if (!path.stem().string().starts_with("brain_BG")) continue;
        const validate::RadiusError error = found.radius_error;
        CHECK(error.median < 0.01);
        CHECK(error.points > 1000);
        CHECK(error.points_median < 0.005);
        if (!at_default) continue;
        options.centerline = tree::Centerline::kLines;
        CHECK(validated(*tree, surface_with(*tree, options)).radius_error.median < 0.005);
    }
}
