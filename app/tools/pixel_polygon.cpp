#include "app/tools/pixel_polygon.h"

#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

constexpr std::size_t kMostRows = 2048;

// An edge belongs to the heights from its upper end up to, and without, its lower one: a corner is crossed once.
bool spans_height(const glm::dvec2& a, const glm::dvec2& b, double y) { return (a.y > y) != (b.y > y); }

double crossing(const glm::dvec2& a, const glm::dvec2& b, double y) {
    return (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x;
}

} // namespace

// Rows are exact although their borders are rounded: the row of a height grows with the height, so the rows from that
// of an edge's upper end to that of its lower end have all heights between the two.
std::size_t PixelPolygon::row_of(double y) const {
    const double row = (y - top_) * rows_per_pixel_;
    return row >= static_cast<double>(rows_) ? rows_ - 1 : row > 0.0 ? static_cast<std::size_t>(row) : 0;
}

PixelPolygon::PixelPolygon(std::vector<glm::dvec2> corners) : corners_(std::move(corners)) {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Edge edge{corners_[i == 0 ? corners_.size() - 1 : i - 1], corners_[i]};
        if (edge.a.y != edge.b.y) edges.push_back(edge); // a level one crosses no height
    }
    if (edges.empty()) return;
    const auto [upper, lower] =
        std::ranges::minmax_element(corners_, [](const auto& p, const auto& q) { return p.y < q.y; });
    top_ = upper->y;
    bottom_ = lower->y;
    rows_ = std::min(2 * edges.size(), kMostRows);
    rows_per_pixel_ = static_cast<double>(rows_) / (bottom_ - top_);
    if (!std::isfinite(rows_per_pixel_)) rows_per_pixel_ = 0.0; // nearly flat: one row has it all
    edges_ = Grouped<Edge>(rows_, [&](const auto& put) {
        for (const Edge& edge : edges) {
            const std::size_t last = row_of(std::max(edge.a.y, edge.b.y));
            for (std::size_t row = row_of(std::min(edge.a.y, edge.b.y)); row <= last; ++row) put(row, edge);
        }
    });
}

std::span<const PixelPolygon::Edge> PixelPolygon::edges_at(double y) const {
    if (rows_ == 0 || !(y >= top_ && y < bottom_)) return {};
    return edges_.of(row_of(y));
}

bool PixelPolygon::contains(glm::dvec2 point) const {
    bool inside = false;
    for (const Edge& edge : edges_at(point.y))
        if (spans_height(edge.a, edge.b, point.y) && point.x < crossing(edge.a, edge.b, point.y)) inside = !inside;
    return inside;
}

std::vector<std::pair<double, double>> PixelPolygon::spans(double y) const {
    std::vector<double> at;
    for (const Edge& edge : edges_at(y))
        if (spans_height(edge.a, edge.b, y)) at.push_back(crossing(edge.a, edge.b, y));
    std::ranges::sort(at);
    std::vector<std::pair<double, double>> runs;
    for (std::size_t i = 0; i + 1 < at.size(); i += 2)
        if (at[i] < at[i + 1]) runs.emplace_back(at[i], at[i + 1]);
    return runs;
}

std::vector<glm::dvec2> simplified(std::span<const glm::dvec2> line, double tolerance) {
    if (line.size() < 3) return {line.begin(), line.end()};
    const auto distance = [&](std::size_t i, std::size_t from, std::size_t to) {
        const glm::dvec2 along = line[to] - line[from], off = line[i] - line[from];
        return glm::distance(off, share_along(off, along) * along);
    };
    std::vector<char> kept(line.size(), 0);
    kept.front() = kept.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        std::size_t farthest = from;
        double most = tolerance;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double away = distance(i, from, to);
            if (away > most) {
                most = away;
                farthest = i;
            }
        }
        if (farthest == from) continue;
        kept[farthest] = 1;
        open.emplace_back(from, farthest);
        open.emplace_back(farthest, to);
    }
    std::vector<glm::dvec2> fewer;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (kept[i] != 0) fewer.push_back(line[i]);
    return fewer;
}

} // namespace ramus::app
