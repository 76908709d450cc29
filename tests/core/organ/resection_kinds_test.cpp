// Resections by surfaces of files and by margins around voxels, and what they cost the remnant.
#include "core/organ/resect/cut_vessels.h"
#include "core/organ/resect/lesion_margin.h"
#include "core/organ/resect/removal.h"
#include "tests/support/built_tree.h"
#include "tests/support/icosphere.h"
#include "tests/support/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <oneapi/tbb/global_control.h>

using namespace ramus;
using namespace ramus::organ;

namespace {

// Voxels of these sides (mm), the first one's centre at the origin.
template <class Rule> Organ voxels_where(const glm::ivec3& size, const glm::dvec3& spacing, const Rule& inside) {
    return {test::mask_of(size, [&](const glm::ivec3& voxel) { return inside(glm::dvec3(voxel) * spacing); }),
            test::voxels_of(spacing)};
}

Organ block(const glm::ivec3& size) {
    return voxels_where(size, glm::dvec3(1.0), [](const glm::dvec3&) { return true; });
}

// A flat rectangle of triangles.
mesh::TriangleMesh rectangle(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    mesh::TriangleMesh mesh;
    for (const glm::dvec3& at : {corner, corner + u, corner + u + v, corner + v})
        mesh.positions.push_back(glm::vec3(at));
    mesh.triangles.push_back({0, 1, 2});
    mesh.triangles.push_back({0, 2, 3});
    return mesh;
}

Result<std::shared_ptr<const DividingSurface>> dividing(mesh::TriangleMesh mesh, const Organ& organ) {
    Job job;
    return DividingSurface::of(std::move(mesh), organ, JobRange(job, 0.0F, 1.0F));
}

Removal removed_by(const Organ& organ, const std::vector<Resection>& resections) {
    Job job;
    return remove_from(organ, resections, JobRange(job, 0.0F, 1.0F)).value();
}

} // namespace

TEST_CASE("the inside of a closed mesh is removed") {
    const Organ organ = block({60, 60, 60});
    mesh::TriangleMesh sphere;
    const test::UnitSphere unit = test::make_unit_sphere(5);
    for (const glm::dvec3& p : unit.points)
        sphere.positions.push_back(glm::vec3(30.2 + 17.0 * p.x, 29.7 + 17.0 * p.y, 28.4 + 17.0 * p.z));
    for (const glm::uvec3& t : unit.triangles) sphere.triangles.push_back(t);
    const auto surface = dividing(sphere, organ).value();
    CHECK(surface->is_closed());
    const Removal removal = removed_by(organ, {SurfaceCut{surface}});
    double volume = 0.0; // of the mesh itself, which lies within the ball
    for (const glm::uvec3& t : unit.triangles)
        volume += std::pow(17.0, 3) / 6.0 * glm::dot(unit.points[t.x], glm::cross(unit.points[t.y], unit.points[t.z]));
    REQUIRE(volume == doctest::Approx(4.0 / 3.0 * glm::pi<double>() * std::pow(17.0, 3)).epsilon(5e-3));
    CHECK(removal.removed_voxels == doctest::Approx(volume).epsilon(1e-3));
    CHECK(removal.area_mm2 == doctest::Approx(4.0 * glm::pi<double>() * 17.0 * 17.0).epsilon(3e-3));
    const Removal outside = removed_by(organ, {SurfaceCut{surface, true}});
    CHECK(outside.removed_voxels + removal.removed_voxels == doctest::Approx(216000.0).epsilon(1e-9));
}

TEST_CASE("the margin of a mesh is the least distance of all of its triangles, to 1e-4 mm") {
    const Organ organ = block({60, 60, 60});
    const test::UnitSphere unit = test::make_unit_sphere(3);
    mesh::TriangleMesh sphere;
    for (const glm::dvec3& p : unit.points) sphere.positions.push_back(glm::vec3(30.2 + 17.0 * p));
    for (const glm::uvec3& t : unit.triangles) sphere.triangles.push_back(t);
    const std::vector<Resection> inside{SurfaceCut{dividing(sphere, organ).value()}};
    const Removal removal = removed_by(organ, inside);
    for (const glm::dvec3& middle : {glm::dvec3(30, 30, 30), glm::dvec3(36, 28, 31), glm::dvec3(50, 48, 40)}) {
        const Organ mask = voxels_where({60, 60, 60}, glm::dvec3(1.0),
                                        [&](const glm::dvec3& p) { return glm::distance(p, middle) < 5.0; });
        const std::vector<VoxelLesion> lesions = lesions_of(mask, "lesion");
        const Margin margin = margins_of(organ, inside, removal.surface, lesions)[0];
        double least = HUGE_VAL;
        for (const glm::uvec3& t : sphere.triangles) {
            const std::array<glm::dvec3, 3> corners{sphere.positions[t.x], sphere.positions[t.y],
                                                    sphere.positions[t.z]};
            if (const auto gap = lesions[0].solid->to_surface().triangle_gap(corners, least)) least = gap->distance_mm;
        }
        CHECK(std::abs(*margin.distance_mm - least) < 1e-4);
        CHECK(margin.removed == (middle.x < 40 ? Removed::kWhole : Removed::kNone));
    }
}

TEST_CASE("an open mesh removes the smaller part, as a plane does; also through the middles of voxels") {
    const Organ organ = block({40, 30, 20});
    for (const double x : {11.0, 11.5, 12.3, 25.25}) {
        CAPTURE(x);
        const auto surface = dividing(rectangle({x, -5, -5}, {0, 50, 0}, {0, 0, 50}), organ).value();
        CHECK_FALSE(surface->is_closed());
        const double smaller = std::min(x + 0.5, 39.5 - x) * 30 * 20;
        CHECK(removed_by(organ, {SurfaceCut{surface}}).removed_voxels == doctest::Approx(smaller).epsilon(1e-4));
        CHECK(removed_by(organ, {SurfaceCut{surface, true}}).removed_voxels ==
              doctest::Approx(24000.0 - smaller).epsilon(1e-4));
        CHECK(removed_by(organ, {SurfaceCut{surface}}).area_mm2 == doctest::Approx(600.0).epsilon(1e-6));
    }
    const glm::dvec3 normal = glm::normalize(glm::dvec3(3.0, 1.0, -2.0));
    const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1))), v = glm::cross(normal, u);
    const glm::dvec3 through(15.0, 14.0, 9.0);
    const auto slanted = dividing(rectangle(through - 60.0 * (u + v), 120.0 * u, 120.0 * v), organ).value();
    const double plane = removed_by(organ, {HalfSpace{through, normal}}).removed_voxels;
    const double mesh = removed_by(organ, {SurfaceCut{slanted}}).removed_voxels;
    CHECK(mesh == doctest::Approx(std::min(plane, 24000.0 - plane)).epsilon(1e-4));
}

TEST_CASE("an open mesh that does not divide the organ is refused") {
    const Organ organ = block({40, 30, 20});
    const auto ends = dividing(rectangle({11, -5, -5}, {0, 20, 0}, {0, 0, 50}), organ);
    REQUIRE_FALSE(ends.has_value());
    CHECK(ends.error().what.find("does not divide") != std::string::npos);
    const auto away = dividing(rectangle({-20, -5, -5}, {0, 50, 0}, {0, 0, 50}), organ);
    REQUIRE_FALSE(away.has_value());
    CHECK(away.error().what.find("on one side") != std::string::npos);
}

TEST_CASE("a mesh through one arm of an organ removes that arm alone") {
    // A horseshoe: arms along x at y < 10 and at y > 20, joined at x > 30.
    const Organ organ = voxels_where({40, 30, 10}, glm::dvec3(1.0),
                                     [](const glm::dvec3& p) { return p.x > 30 || p.y < 10 || p.y > 20; });
    const auto surface = dividing(rectangle({12.5, -5, -5}, {0, 20, 0}, {0, 0, 50}), organ).value();
    CHECK(removed_by(organ, {SurfaceCut{surface}}).removed_voxels == doctest::Approx(13.0 * 10 * 10).epsilon(1e-6));
}

TEST_CASE("a margin of 0 removes the voxels themselves; a margin around a ball removes a larger ball") {
    const Organ organ = voxels_where({70, 70, 50}, {1.0, 1.0, 1.4}, [](const glm::dvec3&) { return true; });
    const auto in_ball = [](double radius) {
        return [radius](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(34, 35, 34)) < radius; };
    };
    const Organ lesion = voxels_where({70, 70, 50}, {1.0, 1.0, 1.4}, in_ball(9.0));
    const auto solid = std::make_shared<const VoxelSolid>(lesion);
    const Removal bare = removed_by(organ, {Around{solid, 0.0}});
    CHECK(bare.removed_voxels == static_cast<double>(lesion.count()));
    const std::vector<VoxelLesion> lesions{{"lesion", solid}};
    for (const double margin : {0.4, 3.0, 10.0}) {
        CAPTURE(margin);
        const std::vector<Resection> wedge{Around{solid, margin}};
        const Removal removal = removed_by(organ, wedge);
        // Brute force: samples in each voxel, against all boxes of the lesion's surface voxels.
        double expected = 0.0;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
            if (number % 11 != 0) return;
            const glm::dvec3 centre = organ.centre_mm(voxel);
            if (std::abs(glm::distance(centre, glm::dvec3(34, 35, 34)) - 9.0 - margin) > 3.0) {
                expected += glm::distance(centre, glm::dvec3(34, 35, 34)) < 9.0 + margin;
                return;
            }
            for (int s = 0; s < 64; ++s) {
                const glm::dvec3 p = organ.centre_mm(voxel) +
                                     ((glm::dvec3(s % 4, s / 4 % 4, s / 16) + 0.5) / 4.0 - 0.5) * glm::dvec3(1, 1, 1.4);
                expected += solid->distance(p) <= margin ? 1.0 / 64 : 0.0;
            }
        });
        CHECK(removal.removed_voxels == doctest::Approx(11.0 * expected).epsilon(0.02));
        double farthest = 0.0;
        for (const glm::dvec3& place : removal.surface.places)
            farthest = std::max(farthest, std::abs(solid->distance(place) - margin));
        CHECK(farthest < 2e-4);
        const Margin found = margins_of(organ, wedge, removal.surface, lesions)[0];
        CHECK(found.removed == Removed::kWhole);
        CHECK(*found.distance_mm == doctest::Approx(margin).epsilon(0.02));
        const std::vector<float> bands = lesion_distances(removal.surface, lesions);
        CHECK(std::ranges::all_of(bands, [&](float d) { return std::abs(static_cast<double>(d) - margin) < 2e-4; }));
    }
}

TEST_CASE("what lies beyond a cut vessel loses its supply, also where it stays") {
    // A vessel along x with a side branch back into the part that stays.
    const Organ organ = block({60, 30, 20});
    const tree::VesselTree tree =
        test::built_tree({{{0, 5, 10}, 3}, {{40, 5, 10}, 2}, {{55, 5, 10}, 1}, {{40, 25, 10}, 1}, {{5, 25, 10}, 0.5}},
                         {{0, 1}, {1, 2}, {1, 3}, {3, 4}});
    const std::vector<Resection> plane{HalfSpace{{30.2, 0, 0}, {1, 0, 0}}};
    const Removal removal = removed_by(organ, plane);
    const std::vector<CutVessel> vessels = vessels_cut(organ, tree, plane);
    REQUIRE(vessels.size() == 2);
    CHECK(glm::distance(vessels[0].at, glm::dvec3(30.2, 5, 10)) < 1e-9);
    CHECK(vessels[0].diameter_mm == doctest::Approx(2 * (3 - 30.2 / 40)));
    CHECK(vessels[0].angle_deg == doctest::Approx(90.0));
    CHECK(vessels[1].at.y == doctest::Approx(25.0));
    Job job;
    const Supply supply = supply_of(organ, tree, {Rule::kAxis}, {}, JobRange(job, 0.0F, 1.0F)).value();
    const std::vector<SystemSupply> systems{{Role::kSupplies, supply.branch, supply.at}};
    const PartRemnant remnant = remnant_of(systems, measure::lost_spans(tree, cuts_of(vessels)), {}, removal.kept);
    // Halfway between the two vessels in what stays, at y = 15 (a voxel's middle, which the lower branch gets).
    double expected = 0.0, kept = 0.0;
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        kept += static_cast<double>(removal.kept[number]);
        if (voxel.y <= 15) expected += static_cast<double>(removal.kept[number]);
    });
    CHECK(kept == doctest::Approx(30.7 * 600));
    CHECK(remnant.supplied == doctest::Approx(expected).epsilon(0.01));
    CHECK(remnant.lost[0] == doctest::Approx(kept - remnant.supplied));
    CHECK(remnant.drained == doctest::Approx(kept)); // nothing drains, nothing is lost
}

TEST_CASE("a resection of all that depends on a cut goes around the vessels in front of it") {
    const Organ organ = block({60, 30, 20});
    const tree::VesselTree tree = test::built_tree(
        {{{0, 15, 10}, 3}, {{20, 15, 10}, 2}, {{55, 4, 10}, 1}, {{55, 26, 10}, 1}}, {{0, 1}, {1, 2}, {1, 3}});
    const std::vector<measure::Cut> cuts{{1, 0.25}};
    Job job;
    // As territories have it: the stem supplies nothing itself.
    const std::vector<std::uint8_t> stem{1, 0, 0};
    const Supply supply = supply_of(organ, tree, {Rule::kAxis}, stem, JobRange(job, 0.0F, 1.0F)).value();
    const std::vector<SystemSupply> systems{{Role::kSupplies, supply.branch, supply.at}};
    const std::vector<std::uint8_t> lost = lost_voxels(systems, measure::lost_spans(tree, cuts));
    const auto solid = solid_of(organ, lost);
    REQUIRE(solid != nullptr);
    CHECK(solid->voxels().count() == static_cast<std::size_t>(std::ranges::count(lost, 1)));
    const auto spared = std::make_shared<const std::vector<std::uint8_t>>(spared_by(tree, cuts));
    CHECK(*spared == std::vector<std::uint8_t>{1, 1, 0});
    // A margin that reaches the stem and the neighbour.
    const auto branches_cut = [&](const Around& around) {
        const Resection resection = around;
        std::vector<int> branches;
        for (const CutVessel& vessel : vessels_cut(organ, tree, std::span(&resection, 1)))
            branches.push_back(vessel.place.branch);
        std::ranges::sort(branches);
        return branches;
    };
    CHECK(std::ranges::count(branches_cut({solid, 10.0}), 0) > 0);
    CHECK(branches_cut({solid, 10.0, spared}) == std::vector<int>{2});
    const CutVessel vessel = vessel_at(tree, cuts[0]);
    CHECK(glm::distance(vessel.at, glm::dvec3(20 + 0.25 * 35, 15 - 0.25 * 11, 10)) < 1e-9);
    CHECK(vessel.diameter_mm == doctest::Approx(2 * 1.75));
}

TEST_CASE("lesions are the parts of a mask that do not touch by faces, the largest first") {
    const Organ mask = voxels_where({20, 20, 20}, glm::dvec3(1.0), [](const glm::dvec3& p) {
        return glm::distance(p, glm::dvec3(5, 5, 5)) < 2.5 || glm::distance(p, glm::dvec3(14, 12, 9)) < 3.5;
    });
    const std::vector<VoxelLesion> lesions = lesions_of(mask, "tumour");
    REQUIRE(lesions.size() == 2);
    CHECK(lesions[0].name == "tumour 1");
    CHECK(lesions[0].solid->voxels().count() + lesions[1].solid->voxels().count() == mask.count());
    CHECK(lesions[0].solid->contains({14, 12, 9}));
    CHECK(lesions[1].solid->contains({5, 5, 5}));
    CHECK(lesions[1].solid->distance({5, 5, 10}) == doctest::Approx(2.5)); // its last voxel ends at 7.5
    CHECK(lesions[1].solid->distance({5, 5, 7.4}) == 0.0);
}

TEST_CASE("threads change nothing") {
    const Organ organ = block({64, 48, 40});
    Sheet sheet{{-10, -10, 18}, {1, 0, 0}, {0, 1, 0}, {20.0, 17.0}, {5, 5}, std::vector<double>(25, 0.0)};
    for (int n = 0; n < 25; ++n) sheet.heights[static_cast<std::size_t>(n)] = 5.0 * std::sin(1.7 * n);
    const std::vector<Resection> both{sheet, HalfSpace{{40, 0, 0}, glm::normalize(glm::dvec3(2, 1, 1))}};
    const Removal many = removed_by(organ, both);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Removal single = removed_by(organ, both);
    CHECK(many.kept == single.kept);
    CHECK(many.removed_voxels == single.removed_voxels);
    CHECK(many.surface.places == single.surface.places);
    CHECK(many.surface.triangles == single.surface.triangles);
}
