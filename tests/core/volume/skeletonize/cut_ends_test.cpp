#include "core/io/volumes/volume_file.h"
#include "core/mesh/surface.h"
#include "core/volume/skeletonize/skeletonize.h"
#include "tests/support/mask.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/round_trip.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

using namespace ramus;

namespace {

constexpr double kRadius = 5.0; // mm
const glm::dvec3 kSpacing(1.0, 1.0, 2.0);
const glm::ivec3 kCutSize(50, 50, 30);

tree::VesselTree tree_of_tube(const glm::dvec3& from, const glm::dvec3& to) {
    const auto mask = test::mask_of(kCutSize, [&](const glm::ivec3& v) {
        const glm::dvec3 at = kSpacing * glm::dvec3(v), way = to - from;
        const double along = std::clamp(glm::dot(at - from, way) / glm::dot(way, way), 0.0, 1.0);
        return glm::distance(at, from + along * way) < kRadius;
    });
    Job job;
    return volume::skeletonize(mask, test::voxels_of(kSpacing), {}, job).value();
}

std::vector<tree::Note> cut_ends(const tree::VesselTree& tree) {
    std::vector<tree::Note> cuts;
    for (const tree::Note& note : tree.notes)
        if (note.topic == tree::kCutEnds) cuts.push_back(note);
    return cuts;
}

double radius_at(const tree::VesselTree& tree, const glm::dvec3& place) {
    const auto point = std::ranges::min_element(tree.points, {},
                                                [&](const tree::Point& p) { return glm::distance(p.position, place); });
    return point->radius;
}

// The surface ends in a cap in the plane of each cut: the border of the volume.
void check_caps(const mesh::TriangleMesh& surface, const tree::VesselTree& tree) {
    for (const tree::Note& cut : cut_ends(tree)) {
        REQUIRE(cut.at);
        REQUIRE(cut.outward);
        const double radius = radius_at(tree, *cut.at);
        double widest = 0.0;
        int on_plane = 0, within = 0;
        for (std::size_t v = 0; v < surface.positions.size(); ++v) {
            const glm::dvec3 from_end = glm::dvec3(surface.positions[v]) - *cut.at;
            if (glm::length(from_end) > 3.0 * radius) continue;
            const double beyond = glm::dot(from_end, *cut.outward);
            CHECK(beyond < 0.01 * radius);
            if (std::abs(beyond) >= 0.01 * radius) continue;
            ++on_plane;
            if (glm::length(from_end) < 0.7 * radius) ++within;
            widest = std::max(widest, glm::length(from_end));
            if (glm::length(from_end) < 0.7 * radius)
                CHECK(glm::dot(glm::dvec3(surface.normals[v]), *cut.outward) > 0.999);
        }
        CHECK(on_plane > 16);
        CHECK(within > 4);
        CHECK(widest > 0.6 * radius); // cells are 2 pi / 16 of the radius, and cut the rim
    }
}

} // namespace

TEST_CASE("a vessel that the border of the volume cuts ends there in a flat cap, and a tip stays round") {
    struct Tube {
        const char* name;
        glm::dvec3 from, to;
    };
    for (const Tube& tube : {Tube{"straight", {25, 25, 20}, {25, 25, 90}}, Tube{"aslant", {12, 25, 16}, {70, 30, 30}},
                             Tube{"through a slice, aslant", {25, 18, 20}, {27, 40, 75}}}) {
        const std::string name = tube.name;
        CAPTURE(name);
        const tree::VesselTree tree = tree_of_tube(tube.from, tube.to);
        CHECK(tree.branches.size() == 1);
        const auto cuts = cut_ends(tree);
        REQUIRE(cuts.size() == 1);
        // In the plane of the border, which is half a voxel beyond the last centres.
        const glm::dvec3 outward = *cuts[0].outward;
        const glm::dvec3 border = (glm::dvec3(kCutSize) - 0.5) * kSpacing;
        CHECK(glm::dot(*cuts[0].at - border, outward) == doctest::Approx(0.0));
        CHECK(std::ranges::any_of(tree.points, [&](const tree::Point& p) { return p.position == *cuts[0].at; }));
        const glm::dvec3 axis = glm::normalize(tube.to - tube.from);
        const glm::dvec3 off = *cuts[0].at - tube.from;
        CHECK(glm::length(off - glm::dot(off, axis) * axis) < 0.15 * kRadius);

        Job job;
        const mesh::TriangleMesh surface = mesh::make_surface(tree, {}, job).value().mesh;
        const test::Topology topology = test::topology(surface);
        CHECK(topology.closed_manifold());
        CHECK(topology.euler == 2);
        check_caps(surface, tree);
        // The other end is a tip: the surface goes on beyond the end of its axis.
        double least = 1e9;
        for (const glm::vec3& p : surface.positions) least = std::min(least, glm::dot(glm::dvec3(p) - tube.from, axis));
        CHECK(least < -0.5 * kRadius);
    }
}

TEST_CASE("cut ends outlast files, pruning and smoothing") {
    const tree::VesselTree tree = tree_of_tube({25, 18, 20}, {27, 40, 75});
    REQUIRE(cut_ends(tree).size() == 1);
    CHECK(cut_ends(test::through_a_file(tree, ".json")) == cut_ends(tree));
    CHECK(cut_ends(test::through_a_file(tree, ".swc")).empty());
    mesh::SurfaceOptions options;
    options.prune_ratio = 0.3, options.smooth_passes = 5, options.centerline = tree::Centerline::kLines;
    Job job;
    check_caps(mesh::make_surface(tree, options, job).value().mesh, tree);
}

TEST_CASE("no end is cut within the volume, along its border, or where a tip only touches it") {
    CHECK(cut_ends(tree_of_tube({15, 25, 20}, {35, 25, 40})).empty());
    CHECK(cut_ends(tree_of_tube({10, 3, 30}, {40, 3, 30})).empty());   // half of it beyond the border all along
    CHECK(cut_ends(tree_of_tube({25, 25, 20}, {25, 25, 53})).empty()); // its tip ends with the last slice, at 58
}

TEST_CASE("cut ends of masks of patients have flat caps") {
    for (const char* name : {"aorta_dissection_lumens.nii.gz", "circle_of_willis_mr_003.nii.gz"}) {
        const auto path = test::shared_volume(name);
        if (!path) continue;
        CAPTURE(name);
        Job job;
        const auto read = io::read_volume(*path, {}, job);
        REQUIRE(read);
        const auto mask = volume::inside(*read, {}, JobRange(job, 0.0F, 1.0F));
        REQUIRE(mask);
        const auto tree = volume::skeletonize(*mask, read->to_patient, {}, job);
        REQUIRE(tree);
        MESSAGE(name << ": " << cut_ends(*tree).size() << " cut ends");
        CHECK(!cut_ends(*tree).empty());
        const auto surface = mesh::make_surface(*tree, {}, job);
        REQUIRE(surface);
        CHECK(test::topology(surface->mesh).closed_manifold());
        check_caps(surface->mesh, *tree);
    }
}
