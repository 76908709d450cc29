// Slices of scans against a search in double precision: every kind of values, oblique and mirrored volumes, slabs.
#include "core/slice/sample.h"
#include "core/slice/window.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <random>

using namespace ramus;

namespace {

constexpr glm::ivec3 kSize{17, 13, 11};

double value_of(const glm::ivec3& at) { return std::fmod(37.0 * at.x + 101.0 * at.y + 59.0 * at.z, 253.0) - 100.0; }

// Oblique, anisotropic and mirrored.
glm::dmat4 oblique() {
    glm::dmat4 affine = glm::translate(glm::dmat4(1.0), {12.5, -40.25, 7.0});
    affine = glm::rotate(affine, 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    return glm::scale(affine, {-0.7, 0.9, 2.5});
}

template <class T> volume::Volume scan_of(const glm::dmat4& to_patient, double offset = 0.0) {
    volume::Volume scan;
    scan.size = kSize;
    scan.to_patient = to_patient;
    SparseArray<T> values;
    values.resize(volume::voxel_count(kSize));
    std::size_t n = 0;
    for (int k = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 0; i < kSize.x; ++i) values[n++] = static_cast<T>(value_of({i, j, k}) + offset);
    scan.voxels = std::move(values);
    return scan;
}

// Of all eight corners, in double precision.
double interpolated(const glm::dvec3& index) {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        glm::ivec3 at(0);
        for (int axis = 0; axis < 3; ++axis) {
            const double held = std::clamp(index[axis], 0.0, kSize[axis] - 1.0);
            const int low = std::min(static_cast<int>(held), kSize[axis] - 2);
            const bool up = ((corner >> axis) & 1) != 0;
            at[axis] = low + (up ? 1 : 0);
            weight *= up ? held - low : 1.0 - (held - low);
        }
        sum += weight * value_of(at);
    }
    return sum;
}

bool is_inside(const glm::dvec3& index) {
    for (int axis = 0; axis < 3; ++axis)
        if (index[axis] < -0.5 || index[axis] > kSize[axis] - 0.5) return false;
    return true;
}

} // namespace

TEST_SUITE("slice") {
    TEST_CASE("at voxel centres every kind of values is exactly that of the file") {
        const glm::dmat4 affine = oblique();
        const auto check = [&](const volume::Volume& scan, double offset) {
            for (int k = 0; k < kSize.z; ++k)
                for (int j = 0; j < kSize.y; ++j)
                    for (int i = 0; i < kSize.x; ++i) {
                        const glm::dvec3 place(affine * glm::dvec4(i, j, k, 1.0));
                        const double expected = value_of({i, j, k}) + offset;
                        REQUIRE(static_cast<double>(slice::value_at(scan, place)) == expected);
                        const float linear = slice::value_at(scan, place, slice::Interpolation::kLinear);
                        REQUIRE(static_cast<double>(linear) == doctest::Approx(expected).epsilon(1e-6));
                    }
        };
        check(scan_of<std::uint8_t>(affine, 100.0), 100.0);
        check(scan_of<std::uint16_t>(affine, 1000.0), 1000.0);
        check(scan_of<std::int16_t>(affine), 0.0);
        check(scan_of<std::int32_t>(affine, -70000.0), -70000.0);
        check(scan_of<float>(affine, 0.5), 0.5);
    }

    TEST_CASE("a slice in any direction has the interpolated values, and nothing outside of the voxels") {
        const volume::Volume scan = scan_of<std::int16_t>(oblique());
        const glm::dmat4 to_index = glm::inverse(scan.to_patient);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        int inside = 0;
        for (int n = 0; n < 20; ++n) {
            const slice::Axes axes = slice::axes_across({unit(random), unit(random), unit(random)});
            const glm::dvec3 middle =
                slice::middle_of(scan) + 4.0 * glm::dvec3(unit(random), unit(random), unit(random));
            const slice::PixelGrid grid = slice::grid_around(axes, middle, 0.37, {61, 47});
            const std::vector<float> values = slice::sampled(scan, grid);
            for (int y = 0; y < grid.size.y; ++y)
                for (int x = 0; x < grid.size.x; ++x) {
                    const glm::dvec3 index(to_index * glm::dvec4(grid.place({x, y}), 1.0));
                    const float found = values[static_cast<std::size_t>(y * grid.size.x + x)];
                    REQUIRE(std::isnan(found) == !is_inside(index));
                    if (std::isnan(found)) continue;
                    ++inside;
                    REQUIRE(std::abs(static_cast<double>(found) - interpolated(index)) < 1e-4); // of a range of 253
                }
        }
        CHECK(inside > 5000);
    }

    TEST_CASE("a slab shows the largest, mean and least of the planes across it") {
        const volume::Volume scan = scan_of<std::int16_t>(glm::dmat4(1.0));
        const slice::PixelGrid grid =
            slice::grid_around(slice::axes_of(slice::Direction::kAxial), {8.0, 6.0, 5.0}, 1.0, {5, 5});
        for (const auto& [slab, name] : slice::kSlabs) {
            const std::vector<float> values = slice::sampled(scan, grid, {.slab = slab, .slab_mm = 4.0});
            for (int y = 0; y < 5; ++y)
                for (int x = 0; x < 5; ++x) {
                    const glm::ivec3 at(grid.place({x, y}));
                    double least = 1e9, most = -1e9, sum = 0.0;
                    for (int k = at.z - 2; k <= at.z + 2; ++k) {
                        const double value = value_of({at.x, at.y, k});
                        least = std::min(least, value), most = std::max(most, value), sum += value;
                    }
                    const double expected = slab == slice::Slab::kMaximum ? most
                                            : slab == slice::Slab::kMean  ? sum / 5.0
                                                                          : least;
                    CHECK(static_cast<double>(values[static_cast<std::size_t>(5 * y + x)]) ==
                          doctest::Approx(expected));
                }
        }
    }

    TEST_CASE("pictures are seen as radiologists see them") {
        using enum slice::Direction;
        const glm::dvec3 left(-1.0, 0.0, 0.0), anterior(0.0, 1.0, 0.0), superior(0.0, 0.0, 1.0);
        CHECK(slice::axes_of(kAxial).right == left);
        CHECK(slice::axes_of(kAxial).down == -anterior);
        CHECK(slice::axes_of(kCoronal).right == left);
        CHECK(slice::axes_of(kCoronal).down == -superior);
        CHECK(slice::axes_of(kSagittal).right == -anterior);
        CHECK(slice::axes_of(kSagittal).down == -superior);
        CHECK(slice::axes_of(kAxial).to_viewer() == -superior); // from the feet
        CHECK(slice::axes_of(kCoronal).to_viewer() == anterior);
        CHECK(slice::axes_of(kSagittal).to_viewer() == left);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        for (int n = 0; n < 1000; ++n) {
            const glm::dvec3 normal(unit(random), unit(random), unit(random));
            const slice::Axes axes = slice::axes_across(normal);
            REQUIRE(std::abs(glm::dot(axes.right, axes.down)) < 1e-12);
            REQUIRE(glm::length(axes.right) == doctest::Approx(1.0));
            REQUIRE(glm::length(glm::cross(axes.to_viewer(), glm::normalize(normal))) < 1e-9);
            REQUIRE(glm::dot(axes.right, left - anterior) > 0.0); // never mirrored from the nearest direction
        }
        for (const slice::Direction direction : {kAxial, kCoronal, kSagittal})
            CHECK(slice::axes_across(slice::axes_of(direction).to_viewer()) == slice::axes_of(direction));
    }

    TEST_CASE("the covering grid has a pixel for every voxel centre of its plane") {
        const volume::Volume scan = scan_of<std::int16_t>(glm::scale(glm::dmat4(1.0), {0.5, 0.5, 2.0}));
        const slice::PixelGrid axial =
            slice::grid_covering(scan, slice::axes_of(slice::Direction::kAxial), slice::middle_of(scan), 0.5);
        CHECK(axial.size == glm::ivec2(kSize.x, kSize.y));
        const std::vector<float> values = slice::sampled(scan, axial);
        for (int y = 0; y < axial.size.y; ++y)
            for (int x = 0; x < axial.size.x; ++x)
                CHECK(static_cast<double>(values[static_cast<std::size_t>(y * axial.size.x + x)]) ==
                      value_of({kSize.x - 1 - x, kSize.y - 1 - y, kSize.z / 2}));
        const slice::PixelGrid coronal =
            slice::grid_covering(scan, slice::axes_of(slice::Direction::kCoronal), slice::middle_of(scan), 0.5);
        CHECK(coronal.size == glm::ivec2(kSize.x, 4 * (kSize.z - 1) + 1));
    }

    TEST_CASE("windows") {
        CHECK(slice::Window{40.0, 400.0}.grey(-160.0F) == 0.0F);
        CHECK(slice::Window{40.0, 400.0}.grey(40.0F) == 0.5F);
        CHECK(slice::Window{40.0, 400.0}.grey(1000.0F) == 1.0F);
        CHECK(slice::window_named("lung") == slice::Window{-600.0, 1500.0});
        CHECK_FALSE(slice::window_named("lungs"));
        const volume::Volume scan = [] {
            volume::Volume made = scan_of<std::int16_t>(glm::dmat4(1.0));
            made.minimum = -100.0;
            return made;
        }();
        const slice::Window window = slice::automatic_window(scan);
        CHECK(window.black() == doctest::Approx(-97.0).epsilon(0.03)); // values are spread evenly over -100 to 152
        CHECK(window.black() + window.width == doctest::Approx(150.0).epsilon(0.03));
    }
}
