// A field sampled at the points of bricks, on every instruction set that this machine has.
#pragma once

#include "core/field/convolution_field.h"
#include "core/field/kernels/gaussian.h"
#include "tests/support/built_tree.h"

#include <array>
#include <cstdint>
#include <doctest/doctest.h>
#include <functional>
#include <glm/geometric.hpp>
#include <hwy/highway.h>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace ramus::test {

// A crooked vessel with short and long, widening and narrowing segments, and another one crossing it.
inline tree::PreparedTree crooked_tree() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    tree::PreparedTree prepared;
    for (int vessel = 0; vessel < 2; ++vessel) {
        std::vector<tree::Point> points;
        glm::dvec3 at(vessel == 0 ? 100.0 : 104.0, vessel == 0 ? -50.0 : -45.0, 30.0);
        for (int i = 0; i < 40; ++i) {
            points.push_back({at, 0.5 + 1.5 * unit(random)});
            const double length = i % 3 == 0 ? 4.0 * unit(random) + 1.0 : 0.3 * unit(random) + 0.05;
            at += length * glm::normalize(glm::dvec3(unit(random), unit(random) - 0.4, unit(random) - 0.5));
        }
        add_branch(prepared, points);
    }
    return prepared;
}

inline std::vector<std::uint32_t> all_segments(const field::ConvolutionField& field) {
    std::vector<std::uint32_t> all(field.segments().size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

// All points of a grid, x + 5 y + 25 z.
struct Samples {
    std::array<float, field::kGridPoints> value;
    std::array<bool, field::kGridPoints> inside;
};

inline Samples sample(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                      const field::GridAxes& axes) {
    const auto brick = field.in_brick();
    brick->enter(list, axes);
    field::GridGroups groups;
    brick->sample_groups(0xFF, groups);
    Samples samples;
    const auto take = [&](std::size_t group, std::size_t n, std::size_t x, std::size_t y, std::size_t z) {
        samples.value[x + 5 * y + 25 * z] = groups.value[group][n];
        samples.inside[x + 5 * y + 25 * z] = (groups.inside[group] >> n & 1) != 0;
    };
    for (std::size_t n = 0; n < field::kGroupPoints; ++n) {
        for (std::size_t layer = 0; layer < 4; ++layer) take(layer, n, n % 4, n / 4, layer);
        take(4, n, 4, n % 4, n / 4);
        take(5, n, n % 4, 4, n / 4);
        take(6, n, n % 4, n / 4, 4);
    }
    for (std::size_t n = 0; n < 4; ++n) take(7, n, n, 4, 4), take(7, n + 4, 4, n, 4), take(7, n + 8, 4, 4, n);
    take(7, 12, 4, 4, 4);
    return samples;
}

// A lattice of 17 points a side around a point, and the grid of every fourth.
struct PointsAround {
    field::LatticeAxes lattice;
    field::GridAxes grid;
    PointsAround(glm::dvec3 corner, double step) {
        for (std::size_t n = 0; n < field::kLatticeSide; ++n) {
            lattice.x[n] = corner.x + step * static_cast<double>(n);
            lattice.y[n] = corner.y + step * static_cast<double>(n);
            lattice.z[n] = corner.z + step * static_cast<double>(n);
        }
        for (std::size_t n = 0; n < field::kGridSide; ++n)
            grid.x[n] = lattice.x[4 * n], grid.y[n] = lattice.y[4 * n], grid.z[n] = lattice.z[4 * n];
    }
};

// The grid of a brick that begins two cells farther along x.
inline field::GridAxes two_cells_on(const field::GridAxes& grid) {
    field::GridAxes beside = grid;
    const double step = grid.x[4] - grid.x[3];
    beside.x = {grid.x[2], grid.x[3], grid.x[4], grid.x[4] + step, grid.x[4] + 2.0 * step};
    return beside;
}

inline glm::dvec3 near_the_vessels(const field::ConvolutionField& field, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const field::FieldSegment& s = field.segments()[random() % field.segments().size()];
    return glm::dvec3(s.ax, s.ay, s.az) + 2.0 * s.radius * glm::dvec3(unit(random), unit(random), unit(random));
}

inline void on_every_instruction_set(const std::function<void()>& check) {
    for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
        const std::int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        CAPTURE(std::string(field::gaussian(5.0).sum->instruction_set));
        check();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace ramus::test
