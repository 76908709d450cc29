// Resections against closed forms and brute force: volumes, areas, margins, vessels cut.
#include "core/organ/resect/box_share.h"
#include "core/organ/resect/cut_vessels.h"
#include "core/organ/resect/lesion_margin.h"
#include "core/organ/resect/removal.h"
#include "tests/support/built_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

using namespace ramus;
using namespace ramus::organ;

namespace {

// The voxels whose centres are inside, on a grid that is turned and mirrored against the patient.
Organ organ_where(const std::function<bool(const glm::dvec3&)>& inside, const glm::dvec3& half, const glm::dvec3& voxel,
                  bool turned = true) {
    glm::dmat4 to_patient(1.0);
    if (turned) to_patient = glm::rotate(to_patient, 0.4, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    to_patient = glm::scale(to_patient, turned ? voxel * glm::dvec3(1, 1, -1) : voxel);
    const glm::ivec3 size(glm::ceil(2.0 * half / voxel));
    to_patient[3] = glm::dvec4(-glm::dvec3(to_patient * glm::dvec4(0.5 * glm::dvec3(size - 1), 0.0)), 1.0);
    volume::BitMask mask(size);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                if (inside(glm::dvec3(to_patient * glm::dvec4(i, j, k, 1.0)))) mask.set({i, j, k});
    return {std::move(mask), to_patient};
}

Organ ball(double radius, double voxel, const glm::dvec3& middle = glm::dvec3(0.0)) {
    return organ_where([&](const glm::dvec3& p) { return glm::distance(p, middle) < radius; },
                       glm::dvec3(radius + glm::length(middle) + 2.0 * voxel), glm::dvec3(voxel, voxel, 1.2 * voxel));
}

Removal removal_of(const Organ& organ, const std::vector<Resection>& resections) {
    Job job;
    return remove_from(organ, resections, JobRange(job, 0.0F, 1.0F)).value();
}

double removed_ml(const Organ& organ, const std::vector<Resection>& resections) {
    return removal_of(organ, resections).removed_voxels * organ.voxel_ml();
}

// A sheet of gentle or steep waves.
Sheet waves(std::mt19937_64& random, double height) {
    std::normal_distribution<double> normal;
    const auto some = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    Sheet sheet;
    sheet.u = glm::normalize(some());
    sheet.v = glm::normalize(glm::cross(sheet.u, some()));
    sheet.size = {7, 6};
    sheet.step = {15.0, 18.0};
    sheet.origin = -45.0 * sheet.u - 45.0 * sheet.v + 5.0 * some();
    for (int n = 0; n < 42; ++n) sheet.heights.push_back(height * normal(random));
    return sheet;
}

HalfSpace plane(std::mt19937_64& random, double off) {
    std::normal_distribution<double> normal;
    const glm::dvec3 along = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    return {along * off * normal(random), along};
}

} // namespace

TEST_CASE("the share of a box behind a plane is that of many samples, and exact for simple planes") {
    CHECK(share_below({0.25, {1.0, 0.0, 0.0}}) == doctest::Approx(0.25).epsilon(1e-4));
    CHECK(share_below({0.0, {0.3, -2.0, 0.7}}) == doctest::Approx(0.5));
    // A corner of legs a: a^3 / 6.
    CHECK(share_below({1.5 - 0.6, {1.0, 1.0, 1.0}}) == doctest::Approx(0.6 * 0.6 * 0.6 / 6.0));
    CHECK(share_below({-(1.5 - 0.6), {-1.0, 1.0, -1.0}}) == doctest::Approx(1.0 - 0.6 * 0.6 * 0.6 / 6.0));
    CHECK(share_below({2.0, {1.0, 1.0, 1.0}}) == 0.0);
    CHECK(share_below({-2.0, {1.0, 1.0, 1.0}}) == 1.0);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int n = 0; n < 200; ++n) {
        const Linear function{0.8 * uniform(random), {uniform(random), uniform(random), uniform(random)}};
        constexpr int kSide = 40;
        int below = 0;
        for (int s = 0; s < kSide * kSide * kSide; ++s)
            below += function.at((glm::dvec3(s % kSide, s / kSide % kSide, s / kSide / kSide) + 0.5) / double{kSide} -
                                 0.5) < 0.0;
        CHECK(share_below(function) == doctest::Approx(below / std::pow(kSide, 3)).epsilon(0.01).scale(0.2));
    }
}

TEST_CASE("planes divide a box exactly") {
    // 60 x 40 x 30 voxels of 1 x 1.5 x 2 mm.
    const Organ box = organ_where([](const glm::dvec3&) { return true; }, {30, 30, 30}, {1.0, 1.5, 2.0}, false);
    REQUIRE(box.volume_ml() == doctest::Approx(216.0));
    const auto removal = removal_of(box, {HalfSpace{{7.3, 0, 0}, {1, 0, 0}}});
    CHECK(removal.removed_voxels * box.voxel_ml() == doctest::Approx((30.0 - 7.3) * 60 * 60 / 1000).epsilon(1e-6));
    CHECK(removal.area_mm2 == doctest::Approx(3600.0).epsilon(1e-9));
    // x + y + z > 60 leaves a corner of legs 30.
    const double third = 1.0 / std::sqrt(3.0);
    const auto corner = removal_of(box, {HalfSpace{{20, 20, 20}, glm::dvec3(third)}});
    CHECK(corner.removed_voxels * box.voxel_ml() == doctest::Approx(30.0 * 30 * 30 / 6 / 1000).epsilon(1e-5));
    CHECK(corner.area_mm2 == doctest::Approx(std::sqrt(3.0) / 4 * 2 * 900).epsilon(1e-9));
    // Two planes: the union.
    const std::vector<Resection> both{HalfSpace{{10.2, 0, 0}, {1, 0, 0}}, HalfSpace{{0, -4.1, 0}, {0, -1, 0}}};
    const auto two = removal_of(box, both);
    CHECK(two.removed_voxels * box.voxel_ml() ==
          doctest::Approx((60.0 * 60 * 60 - 40.2 * 34.1 * 60) / 1000).epsilon(1e-4));
    CHECK(two.area_mm2 == doctest::Approx((40.2 + 34.1) * 60).epsilon(1e-9));
    // The same plane twice is one plane.
    const std::vector<Resection> twice{HalfSpace{{7.3, 0, 0}, {1, 0, 0}}, HalfSpace{{7.3, 0, 0}, {1, 0, 0}}};
    CHECK(removal_of(box, twice).area_mm2 == doctest::Approx(3600.0).epsilon(1e-9));
    double kept = 0.0;
    for (const float share : two.kept) kept += static_cast<double>(share);
    CHECK(kept == doctest::Approx(static_cast<double>(box.count()) - two.removed_voxels).epsilon(1e-6));
}

TEST_CASE("caps of balls and ellipsoids are within 0.1 % of their formulas") {
    // Voxels of 1 x 1 x 1.2 mm for a ball of radius 40 mm.
    const Organ organ = ball(40.0, 1.0);
    std::mt19937_64 random(3);
    for (const double at : {-25.0, -7.3, 0.0, 12.4, 20.0}) {
        const HalfSpace half = plane(random, 0.0);
        const double h = 40.0 - at;
        const auto removal = removal_of(organ, {HalfSpace{at * half.normal, half.normal}});
        const double cap = glm::pi<double>() * h * h * (3 * 40.0 - h) / 3 / 1000;
        CHECK(removal.removed_voxels * organ.voxel_ml() == doctest::Approx(cap).epsilon(1e-3));
        CHECK(removal.area_mm2 == doctest::Approx(glm::pi<double>() * (1600.0 - at * at)).epsilon(0.005));
    }
    const glm::dvec3 axes(45.0, 30.0, 25.0);
    const Organ egg = organ_where([&](const glm::dvec3& p) { return glm::length(p / axes) < 1.0; }, glm::dvec3(52.0),
                                  glm::dvec3(0.9));
    for (int n = 0; n < 4; ++n) {
        const HalfSpace half = plane(random, 8.0);
        // In the space where the ellipsoid is the unit ball.
        const double at = glm::dot(half.point, half.normal) / glm::length(half.normal * axes), h = 1.0 - at;
        const double cap = glm::pi<double>() * h * h * (3.0 - h) / 3 * axes.x * axes.y * axes.z / 1000;
        CHECK(removed_ml(egg, {half}) == doctest::Approx(cap).epsilon(1e-3));
    }
}

TEST_CASE("sheets are within 0.5 % of a fine voxelisation, and their area of a fine triangulation") {
    std::mt19937_64 random(5);
    const Organ organ = ball(35.0, 1.3);
    for (const double height : {2.0, 6.0, 10.0}) {
        const Sheet sheet = waves(random, height);
        const auto removal = removal_of(organ, {sheet});
        std::size_t fine = 0;
        constexpr int kSide = 5;
        organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            for (int s = 0; s < kSide * kSide * kSide; ++s) {
                const glm::dvec3 off =
                    (glm::dvec3(s % kSide, s / kSide % kSide, s / kSide / kSide) + 0.5) / double{kSide} - 0.5;
                const glm::dvec3 p(organ.to_patient() * glm::dvec4(glm::dvec3(voxel) + off, 1.0));
                fine += height_above(sheet, p) >= 0.0;
            }
        });
        const double expected = static_cast<double>(fine) / std::pow(kSide, 3);
        CHECK(removal.removed_voxels == doctest::Approx(expected).epsilon(5e-3));
        CHECK(removal.removed_voxels == doctest::Approx(expected).epsilon(5e-4)); // what it is
        Sheet other = sheet;
        other.removes_below = true;
        CHECK(removal_of(organ, {other}).removed_voxels + removal.removed_voxels ==
              doctest::Approx(static_cast<double>(organ.count())).epsilon(1e-6));
        // The area over the voxels that the sheet passes.
        double area = 0.0;
        constexpr double kStep = 0.15;
        for (double a = -60.0; a < 60.0; a += kStep)
            for (double b = -60.0; b < 60.0; b += kStep) {
                const glm::dvec2 at(a + 45.0, b + 45.0);
                const glm::dvec3 p =
                    sheet.origin + at.x * sheet.u + at.y * sheet.v + height_at(sheet, at) * sheet.normal();
                const glm::dvec3 index(glm::inverse(organ.to_patient()) * glm::dvec4(p, 1.0));
                if (!organ.mask().test(glm::ivec3(glm::floor(index + 0.5)))) continue;
                const double e = 1e-4;
                const double du =
                    (height_at(sheet, at + glm::dvec2(e, 0)) - height_at(sheet, at - glm::dvec2(e, 0))) / (2 * e);
                const double dv =
                    (height_at(sheet, at + glm::dvec2(0, e)) - height_at(sheet, at - glm::dvec2(0, e))) / (2 * e);
                area += kStep * kStep * std::sqrt(1 + du * du + dv * dv);
            }
        CHECK(removal.area_mm2 == doctest::Approx(area).epsilon(0.01));
    }
}

TEST_CASE("a sheet passes the contour that it is made from, and bends little within") {
    // The rim of a saddle on a cylinder.
    std::vector<glm::dvec3> contour;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, -0.3, 0.4)));
    for (int n = 0; n < 90; ++n) {
        const double angle = 2 * glm::pi<double>() * n / 90;
        const glm::dvec3 p(60 * std::cos(angle), 40 * std::sin(angle),
                           6 * std::cos(2 * angle) + 3 * std::sin(3 * angle));
        contour.push_back(glm::dvec3(turn * glm::dvec4(p, 1.0)) + glm::dvec3(10, -200, 30));
    }
    const Sheet sheet = sheet_through(contour).value();
    CHECK(check_sheet(sheet).has_value());
    double most = 0.0;
    for (const glm::dvec3& p : contour) most = std::max(most, std::abs(height_above(sheet, p)));
    CHECK(most < 0.1);
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) CHECK(std::abs(sheet.heights[sheet.index(i, j)]) < 40.0);
    // Three points: a plane. A line of points: no.
    const std::vector<glm::dvec3> three{{0, 0, 0}, {10, 0, 3}, {0, 10, -2}};
    const Sheet flat = sheet_through(three).value();
    for (const glm::dvec3& p : {glm::dvec3(3, 4, 0.9 - 0.8), glm::dvec3(50, 70, 15 - 14), glm::dvec3(-90, 20, -27 - 4)})
        CHECK(std::abs(height_above(flat, p)) < 1e-6);
    const std::vector<glm::dvec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
    CHECK_FALSE(sheet_through(line).has_value());
    CHECK_FALSE(sheet_through({}).has_value());
    // A moved control point changes the sheet near it alone.
    Sheet moved = sheet;
    moved.heights[moved.index(3, 3)] += 10.0;
    CHECK(height_at(moved, sheet.step * 3.0) - height_at(sheet, sheet.step * 3.0) == doctest::Approx(10.0 * 4 / 9));
    CHECK(height_at(moved, sheet.step * glm::dvec2(5.0, 3.0)) == height_at(sheet, sheet.step * glm::dvec2(5.0, 3.0)));
}

TEST_CASE("the vessels cut are the intersections of 1,000 planes and sheets with the centerlines") {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    // A random walk with forks, within the ball and beyond it.
    std::vector<tree::Point> points{{{0, 0, 0}, 3.0}};
    std::vector<tree::Edge> edges;
    for (std::uint32_t n = 1; n < 120; ++n) {
        const std::uint32_t from = n % 4 == 0 ? static_cast<std::uint32_t>(random() % n) : n - 1;
        points.push_back({points[from].position + 9.0 * glm::dvec3(normal(random), normal(random), normal(random)),
                          0.97 * points[from].radius});
        edges.emplace_back(from, n);
    }
    const tree::VesselTree tree = test::built_tree(points, edges);
    const Organ organ = ball(35.0, 1.5);
    std::size_t found = 0, wrong = 0, outside = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        Resection resection = plane(random, 15.0);
        if (trial % 2 == 1) resection = waves(random, 8.0);
        const std::vector<CutVessel> cut = vessels_cut(organ, tree, std::span(&resection, 1));
        // Brute force: signs at 2,000 places of each segment, then bisection.
        std::vector<glm::dvec3> expected;
        for (const tree::Branch& branch : tree.branches)
            for (std::size_t n = 1; n < branch.points.size(); ++n) {
                const glm::dvec3 a = tree.points[branch.points[n - 1]].position,
                                 b = tree.points[branch.points[n]].position;
                const int steps = trial % 2 == 0 ? 1 : 400;
                const auto value = [&](double t) {
                    const glm::dvec3 p = a + t * (b - a);
                    const auto* half = std::get_if<HalfSpace>(&resection);
                    return half != nullptr ? -glm::dot(p - half->point, half->normal)
                                           : -height_above(std::get<Sheet>(resection), p);
                };
                for (int s = 0; s < steps; ++s) {
                    double low = double(s) / steps, high = double(s + 1) / steps;
                    const bool first = value(low) > 0.0;
                    if (first == (value(high) > 0.0)) continue;
                    for (int half = 0; half < 60; ++half)
                        ((value(0.5 * (low + high)) > 0.0) == first ? low : high) = 0.5 * (low + high);
                    expected.push_back(a + low * (b - a));
                }
            }
        found += cut.size();
        if (cut.size() != expected.size()) ++wrong;
        for (const CutVessel& vessel : cut) {
            const auto same = [&](const glm::dvec3& p) { return glm::distance(p, vessel.at) < 1e-6; };
            wrong += std::ranges::none_of(expected, same);
            outside += !vessel.in_organ;
            const auto point = measure::point_on(tree, vessel.place);
            wrong += glm::distance(point.position, vessel.at) > 1e-6;
            wrong += std::abs(2 * point.radius_mm - vessel.diameter_mm) > 1e-6;
        }
        wrong += !std::ranges::is_sorted(cut, std::greater(), &CutVessel::diameter_mm);
    }
    CHECK(found > 5000);
    CHECK(outside > 0);
    CHECK(wrong == 0);
}

namespace {

// The surface of a plane or a sheet by two coordinates, mm.
struct ByTwo {
    explicit ByTwo(const Resection& resection) : sheet(std::get_if<Sheet>(&resection)) {
        if (sheet != nullptr) {
            u = sheet->u, v = sheet->v, from = sheet->origin, middle = {45.0, 45.0};
            return;
        }
        const auto& half = std::get<HalfSpace>(resection);
        u = glm::normalize(glm::cross(half.normal, glm::dvec3(0.3, 0.5, 0.9)));
        v = glm::cross(half.normal, u);
        from = half.point;
    }
    [[nodiscard]] glm::dvec3 place(const glm::dvec2& at) const {
        const glm::dvec3 p = from + at.x * u + at.y * v;
        return sheet == nullptr ? p : p + height_at(*sheet, at) * sheet->normal();
    }
    const Sheet* sheet;
    glm::dvec3 u{0.0}, v{0.0}, from{0.0};
    glm::dvec2 middle{0.0}; // near the middle of the organ
};

// The least distance of the boxes of a lesion's voxels (1 mm) from places of a surface within an organ: places every
// mm, then ever finer around the nearest ones.
double least_distance(const Organ& organ, const Organ& lesion, const ByTwo& surface) {
    struct Try {
        double distance;
        glm::dvec2 at;
    };
    const auto look = [&](const glm::dvec2& at) {
        const glm::dvec3 p = surface.place(at);
        const glm::dvec3 index(glm::inverse(organ.to_patient()) * glm::dvec4(p, 1.0));
        double least = HUGE_VAL;
        if (!organ.mask().test(glm::ivec3(glm::floor(index + 0.5)))) return Try{least, at};
        lesion.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
            const glm::dvec3 beyond = glm::max(glm::abs(p - lesion.centre_mm(voxel)) - 0.5, glm::dvec3(0.0));
            least = std::min(least, glm::length(beyond));
        });
        return Try{least, at};
    };
    std::vector<Try> tries;
    for (double a = -60.0; a < 60.0; a += 1.0)
        for (double b = -60.0; b < 60.0; b += 1.0) tries.push_back(look(surface.middle + glm::dvec2(a, b)));
    std::ranges::sort(tries, {}, &Try::distance);
    tries.resize(25);
    double step = 0.5;
    for (int level = 0; level < 22; ++level, step *= 0.6) {
        std::vector<Try> finer = tries;
        for (const Try& one : tries)
            for (int n = 0; n < 9; ++n) finer.push_back(look(one.at + step * glm::dvec2(n % 3 - 1, n / 3 - 1)));
        std::ranges::sort(finer, {}, &Try::distance);
        finer.resize(12);
        tries = finer;
    }
    return tries[0].distance;
}

} // namespace

TEST_CASE("margins are the least distances from the boxes of a lesion's voxels, to 1e-4 mm") {
    const auto in_ball = [](const glm::dvec3& middle, double radius) {
        return [=](const glm::dvec3& p) { return glm::distance(p, middle) < radius; };
    };
    const glm::dvec3 middle(6, -4, 3);
    const Organ organ = organ_where(in_ball(glm::dvec3(0.0), 35.0), glm::dvec3(37.0), glm::dvec3(1.0), false);
    const Organ lesion = organ_where(in_ball(middle, 6.0), glm::dvec3(37.0), glm::dvec3(1.0), false);
    const std::vector<VoxelLesion> lesions = lesions_of(lesion, "lesion");
    REQUIRE(lesions.size() == 1);
    CHECK(lesions[0].name == "lesion");
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 12; ++trial) {
        CAPTURE(trial);
        HalfSpace half = plane(random, 0.0);
        half.point = middle + half.normal * (trial == 0 ? 3.0 : 4.0 + 2.0 * trial);
        Sheet sheet = waves(random, 4.0);
        sheet.origin += sheet.normal() * (10.0 + trial);
        const Resection resection = trial % 2 == 0 ? Resection(half) : Resection(sheet);
        const Removal removal = removal_of(organ, {resection});
        const Margin margin = margins_of(organ, std::span(&resection, 1), removal.surface, lesions)[0];
        REQUIRE(margin.distance_mm.has_value());
        CHECK(std::abs(*margin.distance_mm - least_distance(organ, lesion, ByTwo(resection))) < 1e-4);
        CHECK(std::abs(value_at(resection, margin.on_surface)) < 1e-4);
        CHECK(glm::distance(margin.on_lesion, margin.on_surface) == doctest::Approx(*margin.distance_mm));
        if (trial % 2 == 1) continue;
        CHECK((*margin.distance_mm == 0.0) == (trial == 0));
        CHECK(margin.removed == (trial == 0 ? Removed::kPart : Removed::kNone));
        const Resection other = HalfSpace{half.point, -half.normal};
        CHECK(margins_of(organ, std::span(&other, 1), removal.surface, lesions)[0].removed ==
              (trial == 0 ? Removed::kPart : Removed::kWhole));
    }
}

TEST_CASE("a sheet is bent through places near them alone, and grows without changing") {
    std::vector<glm::dvec3> contour;
    for (int n = 0; n < 40; ++n) {
        const double angle = 2 * glm::pi<double>() * n / 40;
        contour.emplace_back(60 * std::cos(angle), 40 * std::sin(angle), 5 * std::cos(2 * angle));
    }
    const Sheet sheet = sheet_through(contour).value();
    const glm::dvec3 place(40, -7, 15);
    const Sheet bent = bent_through(sheet, {&place, 1}).value();
    CHECK(check_sheet(bent).has_value());
    CHECK(bent.size == sheet.size);
    CHECK(std::abs(height_above(sheet, place)) > 8.0);
    CHECK(std::abs(height_above(bent, place)) < 1e-3 * std::abs(height_above(sheet, place)));
    const glm::dvec3 far(-58, 10, 0);
    CHECK(height_above(bent, far) == height_above(sheet, far));
    // A line that is drawn, and a place beyond the grid.
    std::vector<glm::dvec3> line;
    for (int n = 0; n <= 20; ++n) line.emplace_back(-50 + 5 * n, 3.0, 8 * std::sin(0.1 * n));
    const Sheet drawn = bent_through(sheet, line).value();
    for (const glm::dvec3& at : line) CHECK(std::abs(height_above(drawn, at)) < 0.1);
    const glm::dvec3 outside = contour.front() + 45.0 * sheet.u;
    const Sheet wide = bent_through(sheet, {&outside, 1}).value();
    CHECK(wide.size.x > sheet.size.x);
    CHECK(std::abs(height_above(wide, outside)) < 0.05);
    CHECK(height_above(wide, far) == doctest::Approx(height_above(sheet, far)));
    const glm::dvec3 nowhere = contour.front() + 5000.0 * sheet.u;
    CHECK_FALSE(bent_through(sheet, {&nowhere, 1}).has_value());
    CHECK_FALSE(bent_through(sheet, {}).has_value());
}
