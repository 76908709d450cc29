#include "app/tools/lasso_tool.h"

#include "app/tools/pixel_polygon.h"
#include "core/base/bounds.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app {

namespace {

constexpr glm::vec4 kTaking{0.36F, 0.80F, 1.00F, 1.0F};
constexpr glm::vec4 kRemoving{1.00F, 0.48F, 0.40F, 1.0F};
constexpr double kStep = 1.5;      // points between those of a stroke
constexpr double kTolerance = 1.0; // points: how far the outline may be from the stroke
constexpr double kLeastSize = 4.0; // points: a smaller stroke was a click

// A tenth of a pixel is more precise than a mouse.
std::string tenths(double pixel) {
    const long long number = std::llround(10.0 * pixel);
    std::string text(number < 0 ? "-" : "");
    text += std::to_string(std::abs(number) / 10);
    if (number % 10 != 0) text.append(".").append(std::to_string(std::abs(number) % 10));
    return text;
}

} // namespace

glm::vec4 LassoBase::colour() const { return modifiers_.ctrl ? kRemoving : kTaking; }

bool LassoBase::escape() { return !std::exchange(points_, {}).empty(); }

void LassoBase::begin(const Pointing& pointing) {
    points_ = {pointing.at};
    modifiers_ = pointing.modifiers;
}

void LassoBase::finish(const Pointing& pointing, std::vector<glm::dvec2>&& drawn) {
    const std::vector<glm::dvec2> outline = std::move(drawn); // may be points_
    points_.clear();
    const Bounds<glm::dvec2> box = box_of_points(outline);
    if (outline.size() < 3 || glm::length(box.size()) < kLeastSize * pointing.pixel_ratio) return;
    CommandLine line{"lasso"};
    if (pointing.settings.lasso_any_part) line.emplace_back("--any");
    if (pointing.settings.lasso_visible) line.emplace_back("--visible");
    if (modifiers_.ctrl)
        line.emplace_back("--remove");
    else if (modifiers_.shift)
        line.emplace_back("--add");
    for (const glm::dvec2& point : outline) line.push_back(tenths(point.x) + "," + tenths(point.y));
    command(std::move(line));
}

ToolDrawing LassoBase::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (points_.empty()) return drawing;
    glm::vec4 tint = colour();
    tint.w = 0.13F;
    drawing.areas.push_back({points_, tint});
    drawing.lines.push_back({points_, colour(), 1.5F, false});
    if (modifiers_.ctrl || modifiers_.shift)
        drawing.texts.push_back({points_.front() + glm::dvec2(10.0, 10.0) * double(pointing.pixel_ratio),
                                 modifiers_.ctrl ? "Remove" : "Add", colour()});
    return drawing;
}

void LassoTool::press(const Pointing& pointing) { begin(pointing); }

void LassoTool::move(const Pointing& pointing) {
    if (pointing.held && !points_.empty() && glm::distance(points_.back(), pointing.at) >= kStep * pointing.pixel_ratio)
        points_.push_back(pointing.at);
}

void LassoTool::release(const Pointing& pointing) {
    if (points_.empty()) return; // cancelled meanwhile
    points_.push_back(pointing.at);
    finish(pointing, simplified(points_, kTolerance * pointing.pixel_ratio));
}

std::string LassoTool::hint() const {
    return points_.empty() ? "Draw around vessels.  Shift adds, Ctrl removes, Esc leaves the lasso"
                           : "Release to select what is inside, Esc to give up";
}

bool PolygonLassoTool::closes(const Pointing& pointing) const {
    return points_.size() >= 3 && glm::distance(points_.front(), pointing.at) < kClosingReach * pointing.pixel_ratio;
}

void PolygonLassoTool::close(const Pointing& pointing) {
    if (points_.size() >= 3) finish(pointing, std::move(points_));
}

void PolygonLassoTool::press(const Pointing& pointing) {
    if (points_.empty())
        begin(pointing);
    else if (closes(pointing))
        close(pointing);
    else
        points_.push_back(pointing.at);
}

// The first press has added the corner already.
void PolygonLassoTool::double_click(const Pointing& pointing) { close(pointing); }

bool PolygonLassoTool::right_click(const Pointing& pointing) {
    if (!busy()) return false;
    close(pointing);
    return true;
}

ToolDrawing PolygonLassoTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing = LassoBase::drawing(pointing);
    if (points_.empty()) return drawing;
    const bool closing = closes(pointing);
    const glm::dvec2 next = closing ? points_.front() : pointing.at;
    drawing.areas.front().outline.push_back(next);
    drawing.lines.front().points.push_back(next);
    drawing.circles.push_back({points_.front(), (closing ? 6.0 : 4.0) * pointing.pixel_ratio, colour(), 1.5F, closing});
    return drawing;
}

std::string PolygonLassoTool::hint() const {
    if (points_.empty()) return "Click the corners of a polygon.  Shift adds, Ctrl removes, Esc leaves the lasso";
    return points_.size() < 3 ? "Click the next corner, Esc to give up"
                              : "Double-click, right-click or click the first corner to close, Esc to give up";
}

} // namespace ramus::app
