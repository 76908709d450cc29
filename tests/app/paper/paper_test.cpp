// The paper's artificial vessels against their construction, and what is measured on their surfaces against closed
// forms.
#include "app/paper/bounding_volumes.h"
#include "app/paper/closed_forms.h"
#include "app/paper/exact_trees.h"
#include "app/paper/figures.h"
#include "app/paper/paper_page.h"
#include "core/base/lines.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/tree_field.h"
#include "core/tree/smooth.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

using namespace ramus;
using namespace ramus::app;
using namespace ramus::app::paper;

namespace {

double distance_to(const tree::VesselTree& tree, const tree::Branch& branch, const glm::dvec3& at) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        nearest = std::min(nearest, distance_to_line(at, tree.points[branch.points[i - 1]].position,
                                                     tree.points[branch.points[i]].position));
    return nearest;
}

std::string numbers_of(std::string_view list) {
    const auto rows = rows_in(list);
    if (!rows) return "none";
    std::string numbers;
    for (const FigureRow* row : *rows) numbers += std::string(row->number) + " ";
    return numbers;
}

} // namespace

TEST_CASE("branches of a star have one length, one radius and their directions") {
    const std::array degrees{270.0, 0.0, 90.0, 180.0};
    const tree::VesselTree tree = star(degrees, 2.0, 11.0);
    REQUIRE(tree.branches.size() == 4);
    CHECK(tree.branches.front().parent == tree::kNoBranch);
    CHECK(tree.branches.front().children.size() == 3);
    for (const tree::Branch& branch : tree.branches) CHECK(tree::length_mm(tree, branch) == doctest::Approx(11.0));
    for (const tree::Point& point : tree.points) {
        CHECK(point.radius == 2.0);
        CHECK(point.position.y == 0.0);
    }
}

TEST_CASE("the vessels of a pair have the same distance everywhere") {
    for (const tree::VesselTree& tree : {parallel_pair(3.0, 1.07, 14.0), s_shaped_pair(3.0, 1.07)}) {
        REQUIRE(tree.branches.size() == 2);
        CHECK(tree.roots.size() == 2);
        for (const std::uint32_t point : tree.branches[0].points)
            CHECK(distance_to(tree, tree.branches[1], tree.points[point].position) ==
                  doctest::Approx(3.0).epsilon(0.002)); // arcs are of straight pieces
    }
}

TEST_CASE("the centerline of a voxelised vessel steps between adjacent voxels, and smoothing approximates it") {
    const tree::VesselTree jagged = winding_vessel_of_voxels();
    REQUIRE(jagged.branches.size() == 1);
    REQUIRE(jagged.voxels.has_value());
    const auto& points = jagged.branches.front().points;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 step = glm::abs(jagged.points[points[i]].position - jagged.points[points[i - 1]].position);
        CHECK(std::max({step.x, step.y, step.z}) == 1.0);
    }
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    const double before = mean(distances_to_winding_vessel(jagged));
    CHECK(before < std::sqrt(3.0) / 2.0); // half of a voxel's diagonal
    CHECK(mean(distances_to_winding_vessel(tree::smooth(jagged, 1))) < 0.9 * before);
    CHECK(std::ranges::max(distances_to_winding_vessel(winding_vessel())) < 0.01);
}

TEST_CASE("pruning removes all spurs, and nothing else") {
    const SpurredVessel vessel = spurred_vessel();
    CHECK(vessel.tree.branches.size() == static_cast<std::size_t>(vessel.real_branches + 2 * vessel.spurs));
    mesh::SurfaceOptions options = paper_options();
    options.prune_ratio = 0.5;
    CHECK(mesh::prepare_tree(vessel.tree, options).tree.branches.size() ==
          static_cast<std::size_t>(vessel.real_branches));
}

TEST_CASE("the bulge of the surface at joints agrees with the closed form") {
    for (const double width : {1.0, 5.0})
        for (const std::vector<double>& degrees :
             {std::vector{270.0, 30.0, 150.0}, std::vector{270.0, 0.0, 180.0}, std::vector{270.0, 0.0, 90.0, 180.0}}) {
            mesh::SurfaceOptions options = paper_options(width);
            options.detail = 64;
            Job job;
            const auto surface = made_surface(star(degrees, 2.0, 20.0), options, job);
            REQUIRE(surface);
            CAPTURE(width);
            CAPTURE(degrees.size());
            CHECK(height_over_joint(surface->mesh) / 2.0 ==
                  doctest::Approx(joint_height(static_cast<int>(degrees.size()), width)).epsilon(0.005));
        }
}

TEST_CASE("two vessels merge at the radius and the gap of the paper") {
    struct Merging {
        double width, radius, gap;
    };
    for (const Merging& of : {Merging{5.0, 1.37, 0.09}, Merging{1.0, 1.07, 0.29}}) {
        const double width = of.width;
        CAPTURE(width);
        CHECK(merging_radius(3.0, width) == doctest::Approx(of.radius).epsilon(0.01));
        CHECK(merging_gap(width) == doctest::Approx(of.gap).epsilon(0.05));
        Job job;
        const auto found = found_merging_radius(3.0, width, job);
        REQUIRE(found);
        CHECK(*found == doctest::Approx(merging_radius(3.0, width)).epsilon(0.005));
    }
}

TEST_CASE("an S-shaped pair of 1.07 mm is one surface at width 1, and two at width 5 or kept apart" *
          doctest::test_suite("slow")) {
    const auto pieces = [](double width, mesh::Blend blend) {
        mesh::SurfaceOptions options = paper_options(width);
        options.detail = 64;
        options.blend = blend;
        Job job;
        const auto surface = made_surface(s_shaped_pair(3.0, 1.07), options, job);
        REQUIRE(surface);
        return mesh::component_count(surface->mesh);
    };
    CHECK(pieces(1.0, mesh::Blend::kPaper) == 1);
    CHECK(pieces(5.0, mesh::Blend::kPaper) == 2);
    CHECK(pieces(1.0, mesh::Blend::kTree) == 2);
}

TEST_CASE("bounding volumes cover as many cells as their volume says, cylinders fewer than boxes") {
    const std::vector<RoundSegment> segments = segments_of(aslant_branching(2.0));
    REQUIRE(segments.size() == 3);
    constexpr double kCell = 0.25; // the boxes end between cells
    std::vector<std::size_t> evaluations;
    for (const BoundRow& row : bounds_of_segments()) {
        double volume = 0.0;
        for (const RoundSegment& segment : segments) volume += volume_mm3(row, segment);
        const CoveredCells covered = covered_cells(row, segments, kCell);
        CHECK(static_cast<double>(covered.evaluations) == doctest::Approx(volume / std::pow(kCell, 3.0)).epsilon(0.02));
        CHECK(covered.cells.size() < covered.evaluations); // segments overlap at the joint
        evaluations.push_back(covered.evaluations);
    }
    CHECK(evaluations[1] < evaluations[0]);
    CHECK(bounds_of_segments().back().reach_radii == doctest::Approx(1.7));
}

TEST_CASE("the shapes of bounding volumes lie on the boundary of the volumes") {
    const RoundSegment segment{{1.0, 2.0, -3.0}, {7.0, -2.0, 5.0}, 1.3};
    for (const BoundRow& row : bounds_of_segments()) {
        BoundRow inside = row, outside = row;
        inside.reach_radii *= 0.999;
        outside.reach_radii *= 1.001;
        const mesh::TriangleMesh shape = shape_of(row, segment);
        CHECK(shape.triangles.size() >= 12);
        for (const glm::vec3& position : shape.positions) {
            CHECK(covers(outside, segment, glm::dvec3(position)));
            CHECK_FALSE(covers(inside, segment, glm::dvec3(position)));
        }
        for (const glm::uvec3& t : shape.triangles) { // counter-clockwise from outside
            const glm::vec3 a = shape.positions[t.x], b = shape.positions[t.y], c = shape.positions[t.z];
            CHECK(glm::dot(glm::cross(b - a, c - a), shape.normals[t.x]) >= -1e-4F);
        }
    }
}

TEST_CASE("figures are chosen by numbers and ranges of numbers") {
    CHECK(numbers_of("4,1") == "1 4 ");
    CHECK(numbers_of("5-7,III") == "5 6 7 III ");
    CHECK(numbers_of("13-I,2,2") == "2 13 I ");
    for (const char* wrong : {"", "0", "14", "IV", "7-5", "1,", ",1", "1-", "-1", "one", "1 ,2", "i"}) {
        CAPTURE(wrong);
        CHECK(numbers_of(wrong) == "none");
    }
    CHECK(all_numbers() == "1-13, I-III");
    CHECK(figure_rows().size() == 16);
}

TEST_CASE("a page shows every figure with its measurements, and never executes names as code") {
    std::vector<MadeFigure> made;
    for (const FigureRow& row : figure_rows()) {
        MadeFigure one{&row, {}};
        one.figure.measured.push_back({"height <b>", 1.25, "radii", 1.259, "1.26"});
        made.push_back(std::move(one));
    }
    const std::string page = paper_page(made, {{"Trees", "<script>alert(1)</script>"}}, "2005-04-01 16:30");
    CHECK(page.find("<script>") == std::string::npos);
    CHECK(page.find("height &lt;b&gt;") != std::string::npos);
    for (const FigureRow& row : figure_rows()) CHECK(page.find(row.name() + ": ") != std::string::npos);
    const Table table = measured_table(made);
    CHECK(table.rows.size() == figure_rows().size());
    CHECK(table.rows.front().size() == table.columns.size());
}
