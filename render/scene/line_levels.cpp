#include "render/scene/line_levels.h"

#include "core/base/bounds.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr double kCoarsest = 4e-4; // of the extent: 0.25 pixels if the tree fills 625
constexpr double kBeside = 8.0;    // pixels: lines are wider than their points

// Position of a ball in the picture, for culling and levels: depths in mm, pixels from the middle.
class BallView {
public:
    BallView(const Camera& camera, glm::ivec2 size)
        : axes_(axes_of(camera)), camera_(camera), half_(0.5 * glm::dvec2(size) + kBeside),
          mm_in_focus_(mm_per_pixel(camera, size)), focus_mm_(glm::distance(camera.position, camera.focal_point)) {}

    // Millimetres per pixel at the ball's point nearest to the eye; 0 or less if it reaches behind the eye.
    [[nodiscard]] double nearest_mm(const LineBall& ball) const { return mm_at(depth(ball) - ball.radius_mm); }
    [[nodiscard]] bool in_picture(const LineBall& ball) const {
        const double nearest = nearest_mm(ball), farthest = mm_at(depth(ball) + ball.radius_mm);
        if (!(farthest > 0.0)) return false;
        if (!(nearest > 0.0)) return true;
        const glm::dvec3 from_eye = ball.centre - camera_.position;
        const auto within = [&](double at_mm, double half) {
            // The side of the ball towards the middle of the picture.
            const double inner = std::abs(at_mm) - ball.radius_mm;
            return inner <= 0.0 || inner / farthest <= half;
        };
        return within(glm::dot(from_eye, axes_.right), half_.x) && within(glm::dot(from_eye, axes_.up), half_.y);
    }

private:
    [[nodiscard]] double depth(const LineBall& ball) const {
        return glm::dot(ball.centre - camera_.position, axes_.forward);
    }
    [[nodiscard]] double mm_at(double depth_mm) const {
        return camera_.orthographic ? mm_in_focus_ : mm_in_focus_ * depth_mm / focus_mm_;
    }

    CameraAxes axes_;
    const Camera& camera_;
    glm::dvec2 half_;
    double mm_in_focus_, focus_mm_;
};

} // namespace

double level_mm(int level, double extent_mm) {
    return level + 1 < kLineLevels ? std::ldexp(kCoarsest * extent_mm, -level) : 0.0;
}

std::vector<LineBall> line_balls(const Centerlines& lines) {
    std::vector<LineBall> balls(lines.runs.size());
    for (std::size_t branch = 0; branch < lines.runs.size(); ++branch) {
        const Centerlines::Run run = lines.runs[branch];
        if (run.count < 2) continue;
        Bounds<glm::dvec3> box;
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) box.hold(glm::dvec3(lines.points[i]));
        balls[branch] = {lines.origin + 0.5 * (box.least + box.most), 0.5 * glm::length(box.size())};
    }
    return balls;
}

std::vector<std::int8_t> line_levels(const std::vector<LineBall>& balls, double extent_mm, const Camera& camera,
                                     glm::ivec2 size) {
    const BallView view(camera, size);
    std::vector<std::int8_t> levels(balls.size(), kNotInPicture);
    for (std::size_t branch = 0; branch < balls.size(); ++branch) {
        const LineBall& ball = balls[branch];
        if (ball.radius_mm < 0.0 || !view.in_picture(ball)) continue;
        const double most_mm = kLinePixels * view.nearest_mm(ball);
        int level = 0;
        while (level + 1 < kLineLevels && level_mm(level, extent_mm) > most_mm) ++level;
        levels[branch] = static_cast<std::int8_t>(level);
    }
    return levels;
}

} // namespace ramus::render
