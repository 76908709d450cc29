// PixelPolygon: tests whether points are inside a polygon by the even-odd rule (a ray to the right crosses the edges an
// odd number of times). The polygon is closed implicitly, may cross itself and may be degenerate. Edges are sorted into
// rows once, so a query examines only edges near its height; its result equals that of the loop over all edges,
// including rounding.
#pragma once

#include "core/base/grouped.h"

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::app {

class PixelPolygon {
public:
    explicit PixelPolygon(std::vector<glm::dvec2> corners); // finite

    [[nodiscard]] bool contains(glm::dvec2 point) const;
    // The intervals inside at height y, from left to right, each [first, second).
    [[nodiscard]] std::vector<std::pair<double, double>> spans(double y) const;
    [[nodiscard]] std::span<const glm::dvec2> corners() const { return corners_; }
    [[nodiscard]] double top() const { return top_; }
    [[nodiscard]] double bottom() const { return bottom_; }

private:
    struct Edge {
        glm::dvec2 a, b;
    };
    [[nodiscard]] std::span<const Edge> edges_at(double y) const; // all that cross this height, perhaps more
    [[nodiscard]] std::size_t row_of(double y) const;

    std::vector<glm::dvec2> corners_;
    double top_ = 0.0, bottom_ = 0.0, rows_per_pixel_ = 0.0;
    std::size_t rows_ = 0; // 0: no edge crosses a height
    Grouped<Edge> edges_;  // by row
};

// Simplifies a polyline within `tolerance` (Douglas and Peucker 1973). Keeps its ends.
[[nodiscard]] std::vector<glm::dvec2> simplified(std::span<const glm::dvec2> line, double tolerance);

} // namespace ramus::app
