// Pictures along vessels against phantoms with analytic values: a straight picture of a helix, true lengths, walls.
#include "core/slice/reformation.h"
#include "core/slice/walls.h"
#include "tests/core/slice/swept_tube.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;
using slice::Reformation;
using slice::ReformationKind;

namespace {

constexpr test::Helix kSpiral{15.0, 5.0};
constexpr double kSpiralWay = 3.0 * test::kPi;

glm::dvec3 on_spiral(double t) { return kSpiral.at(kSpiralWay * t); }

// The distance from the helix, by search and bisection in its angle.
double spiral_distance(const glm::dvec3& at) {
    const double about = std::atan2(at.y, at.x);
    double nearest = 1e9;
    for (int turn = -1; turn <= 2; ++turn) {
        double low = about + 2.0 * test::kPi * turn - 1.0, high = low + 2.0;
        for (int n = 0; n < 40; ++n) {
            const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
            (glm::distance(kSpiral.at(a), at) < glm::distance(kSpiral.at(b), at) ? high : low) =
                glm::distance(kSpiral.at(a), at) < glm::distance(kSpiral.at(b), at) ? b : a;
        }
        nearest = std::min(nearest, glm::distance(kSpiral.at(0.5 * (low + high)), at));
    }
    return nearest;
}

slice::VesselPath spiral_path(double step_mm) {
    auto path = slice::path_of_branch(test::vessel_of(on_spiral, 3000, 3.0), 0, step_mm);
    REQUIRE(path);
    return *path;
}

// A tube of radius 3 around the helix.
mesh::TriangleMesh spiral_tube() {
    return test::swept_tube(
        [&](double t, double angle) {
            const double at = kSpiralWay * t;
            const glm::dvec3 normal = test::Helix::normal(at), binormal = glm::cross(kSpiral.tangent(at), normal);
            return on_spiral(t) + 3.0 * (std::cos(angle) * normal + std::sin(angle) * binormal);
        },
        600, 128);
}

slice::LoopsOfPlane loops_of(const slice::MeshBlocks& blocks) {
    return [&blocks](const slice::Plane& plane) { return slice::section(blocks, plane); };
}

slice::PiecesOnLine pieces_of(const slice::MeshLines& lines) {
    return [&lines](const slice::RowLine& line, std::vector<slice::CutTriangle>& pieces) {
        lines.add_pieces(line, pieces);
    };
}

} // namespace

TEST_CASE("a rod along a helix is straight in the straightened picture, with the phantom's values") {
    // Trilinear interpolation is below a parabola of the distance by at most 10 * 2 * 0.5^2 / 4 = 1.25;
    // the helix bends it a little more.
    const auto value_of = [](double distance) { return 1000.0 - 10.0 * distance * distance; };
    const auto value = [&](const glm::dvec3& at) { return value_of(spiral_distance(at)); };
    const auto scan = test::scan_of({100, 100, 140}, glm::dvec3(0.5), {-25.0, -25.0, -10.0}, value);
    const auto path = spiral_path(0.5);
    for (const double angle : {0.0, 70.0}) {
        const Reformation picture = slice::reformation_along(path, ReformationKind::kStraightened, angle, 12.0);
        REQUIRE(picture.columns == 25);
        REQUIRE(picture.rows.size() == path.samples.size());
        CHECK(picture.mm_per_pixel == path.step_mm);
        const std::vector<float> values = slice::sampled(scan, picture);
        for (std::size_t row = 10; row + 10 < picture.rows.size(); ++row) {
            const float* line = values.data() + row * 25;
            CHECK(std::abs(std::max_element(line, line + 25) - line - 12) <= 1);
            for (int x = 0; x < 25; ++x) {
                const double off = std::abs(x - 12) * picture.mm_per_pixel;
                CHECK(std::abs(line[x] - value(picture.rows[row].place(x))) < 1.6);
                CHECK(std::abs(line[x] - value_of(off)) < 2.0 + 20.0 * off * 0.05); // places within 0.05 mm
            }
        }
    }
    // Pixels outside of the scan have no value.
    const Reformation wide = slice::reformation_along(path, ReformationKind::kStraightened, 0.0, 90.0);
    CHECK(std::ranges::any_of(slice::sampled(scan, wide), [](float v) { return std::isnan(v); }));
}

TEST_CASE("walls of a tube are at its radius at every angle") {
    const mesh::TriangleMesh tube = spiral_tube();
    const slice::MeshBlocks blocks(tube);
    const slice::MeshLines lines(tube);
    const auto path = spiral_path(0.5);
    const tree::VesselTree nothing;
    const auto lumens = slice::lumens_along(path.samples, loops_of(blocks), slice::OtherBranches(nothing, path));
    for (const double angle : {0.0, 33.0, 90.0, 215.0}) {
        const Reformation picture = slice::reformation_along(path, ReformationKind::kStraightened, angle, 20.0);
        const auto walls = slice::walls_of(picture, lumens);
        const auto again = slice::walls_of(picture, slice::lumens_of_rows(picture, loops_of(blocks)));
        const auto direct = slice::walls_of(picture, pieces_of(lines));
        for (std::size_t row = 12; row + 12 < walls.size(); ++row) {
            REQUIRE(walls[row]);
            CHECK((picture.rows[row].axis_column - walls[row]->left) * picture.mm_per_pixel ==
                  doctest::Approx(3.0).epsilon(0.01));
            CHECK((walls[row]->right - picture.rows[row].axis_column) * picture.mm_per_pixel ==
                  doctest::Approx(3.0).epsilon(0.01));
            CHECK(again[row]->left == doctest::Approx(walls[row]->left));
            REQUIRE(direct[row]);
            CHECK(direct[row]->left == doctest::Approx(walls[row]->left));
            CHECK(direct[row]->right == doctest::Approx(walls[row]->right));
        }
        const auto polylines = slice::wall_lines({walls.begin() + 12, walls.end() - 12}, 4.0);
        CHECK(polylines.size() == 2);
    }
}

TEST_CASE("the stretched picture keeps all lengths of the surface that its lines sweep") {
    const auto path = spiral_path(0.25);
    for (const double angle : {0.0, 40.0, 130.0}) {
        const Reformation picture = slice::reformation_along(path, ReformationKind::kStretched, angle, 20.0);
        const double mm = picture.mm_per_pixel;
        // The axis: as long in the picture as in the patient.
        double length = 0.0;
        for (std::size_t n = 1; n < picture.axis.size(); ++n)
            length += mm * glm::distance(picture.axis[n], picture.axis[n - 1]);
        CHECK(length == doctest::Approx(path.length_mm()).epsilon(1e-3));
        // All rows are parallel, and neighbouring pixels along lines on the surface are as far apart as in the picture.
        const glm::dvec3 interest = picture.rows.front().right;
        std::size_t checked = 0;
        for (std::size_t row = 0; row + 1 < picture.rows.size(); ++row) {
            const auto& a = picture.rows[row];
            const auto& b = picture.rows[row + 1];
            CHECK(glm::distance(a.right, interest) < 1e-12);
            CHECK(glm::length(a.right) == doctest::Approx(mm));
            CHECK(b.arc_mm > a.arc_mm);
            if (b.arc_mm - a.arc_mm > 6.0 * mm) continue; // the axis along the lines: the surface bends within a pixel
            ++checked;
            for (const double column : {0.0, 0.5 * picture.columns, picture.columns - 1.0}) {
                CHECK(glm::distance(a.place(column), b.place(column)) == doctest::Approx(mm).epsilon(0.01));
                CHECK(glm::distance(a.place(column), b.place(column + 3.0)) ==
                      doctest::Approx(mm * std::sqrt(10.0)).epsilon(0.01));
            }
            CHECK(a.axis_column >= 0.0);
            CHECK(a.axis_column <= picture.columns - 1.0);
        }
        CHECK(double(checked) > 0.97 * double(picture.rows.size()));
    }
}

TEST_CASE("walls of a stretched picture lie on the tube") {
    const mesh::TriangleMesh tube = spiral_tube();
    const slice::MeshBlocks blocks(tube);
    const Reformation picture = slice::reformation_along(spiral_path(0.5), ReformationKind::kStretched, 25.0, 20.0);
    const auto walls = slice::walls_of(picture, slice::lumens_of_rows(picture, loops_of(blocks)));
    std::size_t found = 0;
    for (std::size_t row = 12; row + 12 < walls.size(); ++row) {
        if (!walls[row]) continue;
        ++found;
        for (const double column : {walls[row]->left, walls[row]->right})
            CHECK(spiral_distance(picture.rows[row].place(column)) == doctest::Approx(3.0).epsilon(0.01));
    }
    CHECK(found + 24 == walls.size());
}

TEST_CASE("there are no walls where the axis is outside of the surface, by loops and without") {
    auto mesh = test::straight_tube({0, 0, -20}, {0, 0, 20}, glm::dvec2(4.0));
    auto hole = test::straight_tube({1, 0, -19}, {1, 0, 19}, glm::dvec2(2.0));
    for (auto& triangle : hole.triangles) std::swap(triangle.x, triangle.y);
    test::join(mesh, hole);
    const slice::MeshBlocks blocks(mesh);
    const slice::MeshLines lines(mesh);
    for (const double x : {1.0, 6.0, -2.5}) {
        const auto tree = test::vessel_of([&](double t) { return glm::dvec3(x, 0.0, 30.0 * t - 15.0); }, 31, 2.0);
        const auto path = slice::path_of_branch(tree, 0, 0.5);
        REQUIRE(path);
        const Reformation picture = slice::reformation_along(*path, ReformationKind::kStraightened, 10.0, 20.0);
        const auto by_loops = slice::walls_of(picture, slice::lumens_of_rows(picture, loops_of(blocks)));
        const auto direct = slice::walls_of(picture, pieces_of(lines));
        for (std::size_t row = 0; row < direct.size(); ++row) {
            CHECK(by_loops[row].has_value() == (x == -2.5));
            CHECK(direct[row].has_value() == (x == -2.5));
        }
    }
}

TEST_CASE("pixels lead to places and back") {
    const auto path = spiral_path(0.5);
    for (const auto& [kind, known] : slice::kReformations) {
        const std::string_view name = known;
        CAPTURE(name);
        CHECK(slice::reformation_named(name) == kind);
        const Reformation picture = slice::reformation_along(path, kind, 20.0, 15.0);
        for (double arc = 0.0; arc <= path.length_mm(); arc += 1.37) {
            const glm::dvec2 pixel = slice::pixel_of(picture, path, arc);
            const auto place = slice::place_of(picture, pixel);
            REQUIRE(place);
            CHECK(std::abs(place->arc_mm - arc) < 0.3);
            CHECK(glm::distance(place->at, path.at(arc).at) < 0.3);
            CHECK(std::abs(place->across_mm) < 0.3);
        }
        const auto row = picture.rows.size() / 2;
        const auto place = slice::place_of(picture, {3.25, double(row)});
        REQUIRE(place);
        CHECK(glm::distance(place->at, picture.rows[row].place(3.25)) < 1e-9);
        CHECK(place->across_mm == doctest::Approx((3.25 - picture.rows[row].axis_column) * picture.mm_per_pixel));
        CHECK_FALSE(slice::place_of(picture, {-0.6, 3.0}));
        CHECK_FALSE(slice::place_of(picture, {3.0, double(picture.rows.size())}));
    }
}

TEST_CASE("walls end where there is no lumen, and where they jump") {
    slice::Walls walls(10, slice::RowWalls{4.0, 6.0});
    walls[3].reset();
    for (std::size_t row = 7; row < 10; ++row) walls[row]->right = 12.0;
    const auto lines = slice::wall_lines(walls, 3.0);
    REQUIRE(lines.size() == 5);
    CHECK(lines[0] == slice::Outline{{4.0, 0.0}, {4.0, 1.0}, {4.0, 2.0}});
    CHECK(lines[1].size() == 6);
    CHECK(lines[4] == slice::Outline{{12.0, 7.0}, {12.0, 8.0}, {12.0, 9.0}});
}
