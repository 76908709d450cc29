// PixelPolygon: which pixels lie inside a polygon, by the even-odd rule: inside is from where a ray to the right
// crosses its edges an odd number of times. The polygon closes itself, may cross itself, and may be degenerate. Edges
// are sorted into rows once, so that a question looks at the few edges near its height; the answer is exactly that of
// the plain loop over all edges, rounding included.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::app {

class PixelPolygon {
public:
    explicit PixelPolygon(std::vector<glm::dvec2> corners); // finite

    [[nodiscard]] bool contains(glm::dvec2 point) const;
    // The runs inside at height y, from left to right: [first, second) each.
    [[nodiscard]] std::vector<std::pair<double, double>> spans(double y) const;
    [[nodiscard]] std::span<const glm::dvec2> corners() const { return corners_; }
    [[nodiscard]] double top() const { return top_; }
    [[nodiscard]] double bottom() const { return bottom_; }

private:
    struct Edge {
        glm::dvec2 a, b;
    };
    [[nodiscard]] std::span<const Edge> edges_at(double y) const; // at least those that cross this height
    [[nodiscard]] std::size_t row_of(double y) const;

    std::vector<glm::dvec2> corners_;
    double top_ = 0.0, bottom_ = 0.0, rows_per_pixel_ = 0.0;
    std::vector<std::uint32_t> row_starts_; // one more than there are rows; empty: no edge crosses anything
    std::vector<Edge> edges_;               // row after row
};

// A polyline with fewer points that stays within `tolerance` of it (Douglas and Peucker 1973). The ends stay.
[[nodiscard]] std::vector<glm::dvec2> simplified(std::span<const glm::dvec2> line, double tolerance);

} // namespace ramus::app
