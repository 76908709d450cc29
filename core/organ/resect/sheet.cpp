#include "core/organ/resect/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::organ {

namespace {

// The weights of four consecutive control points, for a place at `t` from 0 to 1 between the middle two.
std::array<double, 4> spline_weights(double t) {
    const double s = 1.0 - t;
    return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0, (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0,
            t * t * t / 6.0};
}

// The control height at (i, j), which may be beyond the grid.
double control_height(const Sheet& sheet, int i, int j) {
    const int in_i = std::clamp(i, 0, sheet.size.x - 1), in_j = std::clamp(j, 0, sheet.size.y - 1);
    double height = sheet.heights[sheet.index(in_i, in_j)];
    if (i != in_i) {
        const int inner = i < in_i ? 1 : sheet.size.x - 2;
        height += std::abs(i - in_i) * (height - sheet.heights[sheet.index(inner, in_j)]);
    }
    if (j != in_j) {
        const int inner = j < in_j ? 1 : sheet.size.y - 2;
        height +=
            std::abs(j - in_j) * (sheet.heights[sheet.index(in_i, in_j)] - sheet.heights[sheet.index(in_i, inner)]);
    }
    return height;
}

// A place in grid steps, as the control point before it and the rest. Places farther away than any patient are all one.
struct GridPlace {
    int before = 0;
    double rest = 0.0;
};
GridPlace grid_place(double steps) {
    const double whole = std::floor(std::clamp(steps, -1e6, 1e6));
    return {static_cast<int>(whole), std::clamp(steps - whole, 0.0, 1.0)};
}

// Eigenvectors of a symmetric matrix, the one with the largest value first; by Jacobi's rotations.
std::array<glm::dvec3, 3> principal_axes(std::array<glm::dvec3, 3> matrix, glm::dvec3& values) {
    std::array<glm::dvec3, 3> axes{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    constexpr std::array<std::array<int, 2>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};
    for (int sweep = 0; sweep < 50; ++sweep)
        for (const auto& [p, q] : kPairs) {
            auto &row_p = matrix[static_cast<std::size_t>(p)], &row_q = matrix[static_cast<std::size_t>(q)];
            if (row_p[q] == 0.0) continue;
            const double angle = 0.5 * std::atan2(2.0 * row_p[q], row_q[q] - row_p[p]);
            const double c = std::cos(angle), s = std::sin(angle);
            for (glm::dvec3& row : matrix) {
                const double a = row[p], b = row[q];
                row[p] = c * a - s * b;
                row[q] = s * a + c * b;
            }
            const glm::dvec3 a = row_p, b = row_q;
            row_p = c * a - s * b;
            row_q = s * a + c * b;
            const glm::dvec3 axis_p = axes[static_cast<std::size_t>(p)], axis_q = axes[static_cast<std::size_t>(q)];
            axes[static_cast<std::size_t>(p)] = c * axis_p - s * axis_q;
            axes[static_cast<std::size_t>(q)] = s * axis_p + c * axis_q;
        }
    values = {matrix[0][0], matrix[1][1], matrix[2][2]};
    for (const auto& [p, q] : kPairs)
        if (values[p] < values[q]) {
            std::swap(values[p], values[q]);
            std::swap(axes[static_cast<std::size_t>(p)], axes[static_cast<std::size_t>(q)]);
        }
    return axes;
}

// Solves a symmetric positive definite system in place, by Cholesky's factors. `matrix`: by rows.
void solve_symmetric(std::vector<double>& matrix, std::vector<double>& right) {
    const std::size_t n = right.size();
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return matrix[i * n + j]; };
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = j; i < n; ++i) {
            double sum = at(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
            at(i, j) = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / at(j, j);
        }
        for (std::size_t k = 0; k < j; ++k) right[j] -= at(j, k) * right[k];
        right[j] /= at(j, j);
    }
    for (std::size_t j = n; j-- > 0;) {
        for (std::size_t k = j + 1; k < n; ++k) right[j] -= at(k, j) * right[k];
        right[j] /= at(j, j);
    }
}

// The normal equations of the heights.
class HeightEquations {
public:
    explicit HeightEquations(const Sheet& sheet)
        : sheet_(sheet), matrix_(sheet.heights.size() * sheet.heights.size(), 0.0), right_(sheet.heights.size(), 0.0) {}

    // Adds weight * (sum of factor * height - value)^2.
    struct Term {
        int i, j;
        double factor;
    };
    void add(std::span<const Term> terms, double value, double weight) {
        for (const Term& a : terms) {
            const std::size_t row = sheet_.index(a.i, a.j);
            right_[row] += weight * a.factor * value;
            for (const Term& b : terms)
                matrix_[row * right_.size() + sheet_.index(b.i, b.j)] += weight * a.factor * b.factor;
        }
    }
    // The height of the surface at a place, in grid steps from the first control point; at least a step from the
    // border.
    void add_place(const glm::dvec2& at, double height) {
        const auto cell = [](double steps, int size) {
            const int before = std::clamp(static_cast<int>(std::floor(steps)), 1, size - 3);
            return GridPlace{before, steps - before};
        };
        const GridPlace along = cell(at.x, sheet_.size.x), across = cell(at.y, sheet_.size.y);
        const std::array<double, 4> a = spline_weights(along.rest), b = spline_weights(across.rest);
        std::array<Term, 16> terms{};
        for (int n = 0; n < 16; ++n)
            terms[static_cast<std::size_t>(n)] = {along.before - 1 + n % 4, across.before - 1 + n / 4,
                                                  a[static_cast<std::size_t>(n % 4)] *
                                                      b[static_cast<std::size_t>(n / 4)]};
        add(terms, height, 1.0);
    }
    // The size of the control heights.
    void add_size(double weight) {
        for (std::size_t n = 0; n < right_.size(); ++n) matrix_[n * right_.size() + n] += weight;
    }
    // The bending energy of the control heights.
    void add_bending(double weight) {
        const glm::ivec2 size = sheet_.size;
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                if (i + 2 < size.x) add(std::array<Term, 3>{{{i, j, 1}, {i + 1, j, -2}, {i + 2, j, 1}}}, 0.0, weight);
                if (j + 2 < size.y) add(std::array<Term, 3>{{{i, j, 1}, {i, j + 1, -2}, {i, j + 2, 1}}}, 0.0, weight);
                if (i + 1 < size.x && j + 1 < size.y)
                    add(std::array<Term, 4>{{{i, j, 1}, {i + 1, j, -1}, {i, j + 1, -1}, {i + 1, j + 1, 1}}}, 0.0,
                        2.0 * weight);
            }
    }
    [[nodiscard]] std::vector<double> solved() {
        solve_symmetric(matrix_, right_);
        return right_;
    }

private:
    const Sheet& sheet_;
    std::vector<double> matrix_, right_;
};

} // namespace

Result<void> check_sheet(const Sheet& sheet) {
    const auto unit = [](const glm::dvec3& axis) { return std::abs(glm::length(axis) - 1.0) < 1e-6; };
    if (!unit(sheet.u) || !unit(sheet.v) || !(std::abs(glm::dot(sheet.u, sheet.v)) < 1e-6))
        return fail("the axes u and v of the sheet are not of unit length and at right angles");
    if (!(sheet.step.x > 0.0 && sheet.step.y > 0.0)) return fail("the steps of the sheet's grid are not positive");
    if (sheet.size.x < 2 || sheet.size.y < 2) return fail("the sheet's grid has fewer than 2 x 2 control points");
    if (sheet.heights.size() != static_cast<std::size_t>(sheet.size.x) * static_cast<std::size_t>(sheet.size.y))
        return fail("the sheet has " + std::to_string(sheet.heights.size()) + " heights for a grid of " +
                    std::to_string(sheet.size.x) + " x " + std::to_string(sheet.size.y) + " control points");
    const auto far = [](double value) { return !(std::abs(value) < 1e6); };
    if (std::ranges::any_of(sheet.heights, far) || far(sheet.origin.x) || far(sheet.origin.y) || far(sheet.origin.z))
        return fail("the sheet lies where no patient can be");
    return {};
}

double height_at(const Sheet& sheet, const glm::dvec2& place) {
    const GridPlace along = grid_place(place.x / sheet.step.x), across = grid_place(place.y / sheet.step.y);
    const std::array<double, 4> a = spline_weights(along.rest), b = spline_weights(across.rest);
    const int i = along.before - 1, j = across.before - 1;
    double height = 0.0;
    if (i >= 0 && j >= 0 && i + 3 < sheet.size.x && j + 3 < sheet.size.y) {
        const double* row = &sheet.heights[sheet.index(i, j)];
        for (std::size_t n = 0; n < 4; ++n, row += sheet.size.x)
            height += b[n] * (a[0] * row[0] + a[1] * row[1] + a[2] * row[2] + a[3] * row[3]);
        return height;
    }
    for (int n = 0; n < 4; ++n)
        for (int m = 0; m < 4; ++m)
            height +=
                b[static_cast<std::size_t>(n)] * a[static_cast<std::size_t>(m)] * control_height(sheet, i + m, j + n);
    return height;
}

double height_above(const Sheet& sheet, const glm::dvec3& point) {
    const glm::dvec3 from_origin = point - sheet.origin;
    return glm::dot(from_origin, sheet.normal()) -
           height_at(sheet, {glm::dot(from_origin, sheet.u), glm::dot(from_origin, sheet.v)});
}

double steepest_in(const Sheet& sheet, const Bounds<glm::dvec3>& box) {
    // The slope of a B-spline along an axis is at most the steepest of its control heights.
    const glm::dvec3 middle = 0.5 * (box.least + box.most) - sheet.origin, half = 0.5 * (box.most - box.least);
    const glm::dvec2 centre(glm::dot(middle, sheet.u), glm::dot(middle, sheet.v));
    const glm::dvec2 reach(glm::dot(glm::abs(sheet.u), half), glm::dot(glm::abs(sheet.v), half));
    const glm::dvec2 least = (centre - reach) / sheet.step, most = (centre + reach) / sheet.step;
    const auto last_of = [](double end, int size) { return std::clamp(grid_place(end).before + 2, 1, 4 * size + 64); };
    const auto first_of = [](double end, int size) { return std::max(grid_place(end).before - 1, -4 * size - 64); };
    const glm::ivec2 from(first_of(least.x, sheet.size.x), first_of(least.y, sheet.size.y));
    const glm::ivec2 to(last_of(most.x, sheet.size.x), last_of(most.y, sheet.size.y));
    glm::dvec2 slope(0.0);
    for (int j = from.y; j <= to.y; ++j)
        for (int i = from.x; i <= to.x; ++i) {
            const double height = control_height(sheet, i, j);
            slope.x = std::max(slope.x, std::abs(control_height(sheet, i + 1, j) - height) / sheet.step.x);
            slope.y = std::max(slope.y, std::abs(control_height(sheet, i, j + 1) - height) / sheet.step.y);
        }
    return std::sqrt(1.0 + slope.x * slope.x + slope.y * slope.y);
}

Result<Sheet> sheet_through(std::span<const glm::dvec3> contour, const SheetFit& fit) {
    if (contour.size() < 3) return fail("a contour needs three points or more", {}, "add points");
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& point : contour) middle += point / static_cast<double>(contour.size());
    std::array<glm::dvec3, 3> spread{};
    for (const glm::dvec3& point : contour)
        for (int axis = 0; axis < 3; ++axis)
            spread[static_cast<std::size_t>(axis)] += (point - middle)[axis] * (point - middle);
    glm::dvec3 values;
    const std::array<glm::dvec3, 3> axes = principal_axes(spread, values);
    if (!(values[1] > 1e-6 * values[0]) || !(values[0] < 1e12))
        return fail("the points of the contour lie on a line", {}, "add a point next to it");
    Sheet sheet;
    sheet.u = axes[0];
    sheet.v = axes[1];
    sheet.size = glm::clamp(fit.size, glm::ivec2(4), glm::ivec2(32));
    Bounds<glm::dvec2> covered;
    const auto place_of = [&](const glm::dvec3& point) {
        return glm::dvec2(glm::dot(point - middle, sheet.u), glm::dot(point - middle, sheet.v));
    };
    for (const glm::dvec3& point : contour) covered.hold(place_of(point));
    sheet.step = (covered.most - covered.least) / glm::dvec2(sheet.size - 3); // a step more on each side
    const glm::dvec2 first = covered.least - sheet.step;
    sheet.origin = middle + first.x * sheet.u + first.y * sheet.v;
    sheet.heights.assign(static_cast<std::size_t>(sheet.size.x) * static_cast<std::size_t>(sheet.size.y), 0.0);
    HeightEquations equations(sheet);
    for (const glm::dvec3& point : contour)
        equations.add_place((place_of(point) - first) / sheet.step, glm::dot(point - middle, sheet.normal()));
    equations.add_bending(fit.smoothing);
    sheet.heights = equations.solved();
    return sheet;
}

namespace {

constexpr int kMostControls = 32; // along an axis

// A place in grid steps from the first control point.
glm::dvec2 steps_to(const Sheet& sheet, const glm::dvec3& place) {
    const glm::dvec3 from_origin = place - sheet.origin;
    return glm::dvec2(glm::dot(from_origin, sheet.u), glm::dot(from_origin, sheet.v)) / sheet.step;
}

// The same surface with more control points, so that places are at least a step from the border of the grid.
Result<Sheet> grown(const Sheet& sheet, std::span<const glm::dvec3> places) {
    glm::dvec2 least(1.0), most(glm::max(sheet.size, glm::ivec2(4)) - 2);
    for (const glm::dvec3& place : places) {
        const glm::dvec2 at = steps_to(sheet, place);
        least = glm::min(least, at);
        most = glm::max(most, at);
    }
    if (!glm::all(glm::lessThan(most - least, glm::dvec2(kMostControls - 3))))
        return fail("the place is too far from the sheet", {}, "draw a new sheet there");
    const glm::ivec2 before = 1 - glm::ivec2(glm::floor(least));
    Sheet more = sheet;
    more.size = glm::ivec2(glm::ceil(most)) + 2 + before;
    more.origin = sheet.origin - before.x * sheet.step.x * sheet.u - before.y * sheet.step.y * sheet.v;
    more.heights.clear();
    for (int j = 0; j < more.size.y; ++j)
        for (int i = 0; i < more.size.x; ++i) more.heights.push_back(control_height(sheet, i - before.x, j - before.y));
    return more;
}

} // namespace

Result<Sheet> bent_through(const Sheet& sheet, std::span<const glm::dvec3> places) {
    if (places.empty()) return fail("a sheet is bent through one place or more");
    RAMUS_TRY(bent, grown(sheet, places));
    HeightEquations equations(bent);
    for (const glm::dvec3& place : places) equations.add_place(steps_to(bent, place), height_above(bent, place));
    constexpr double kSmall = 1e-4; // prefers small changes, far below the weight of a place
    equations.add_size(kSmall);
    const std::vector<double> change = equations.solved();
    for (std::size_t n = 0; n < change.size(); ++n) bent.heights[n] += change[n];
    return bent;
}

} // namespace ramus::organ
