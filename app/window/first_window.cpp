#include "app/window/first_window.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

constexpr float kLeastScale = 0.75F, kMostScale = 4.0F;
constexpr glm::ivec2 kUsualPoints{1440, 900}, kTitleBarPoints{8, 36};

} // namespace

float suggested_scale(const MonitorFacts& monitor) {
    constexpr float kSteps = 4.0F;                                        // per unit: steps of a quarter
    constexpr float kPixelsAtOne = 1440.0F, kFewestPixelsAtOne = 1080.0F; // tuned on 24 to 32 inches
    constexpr float kInchMm = 25.4F, kPointsInInch = 96.0F, kRounding = 0.02F;
    const float content = std::clamp(monitor.content_scale, kLeastScale, kMostScale);
    if (content != 1.0F) return content;
    const auto shorter = static_cast<float>(std::min(monitor.work_area.x, monitor.work_area.y));
    const float by_size = std::round(kSteps * shorter / kPixelsAtOne) / kSteps;
    const float dense = std::min(kInchMm * monitor.pixels_per_mm / kPointsInInch, shorter / kFewestPixelsAtOne);
    const float by_density = std::floor(kSteps * dense + kRounding) / kSteps;
    return std::clamp(std::max(by_size, by_density), 1.0F, kMostScale);
}

float scale_after_move(float content_scale, float usual, float usual_content_scale) {
    return content_scale == usual_content_scale ? usual : std::clamp(content_scale, kLeastScale, kMostScale);
}

glm::ivec2 window_pixels(const MonitorFacts& monitor, float scale, glm::ivec2 chosen_points) {
    constexpr float kShare = 0.7F;
    const glm::vec2 area(monitor.work_area);
    const bool chosen = chosen_points.x > 0 && chosen_points.y > 0;
    glm::vec2 size = glm::vec2(chosen ? chosen_points : kUsualPoints) * scale;
    if (!chosen) size = glm::max(size, kShare * area);
    if (area.x > 0.0F && area.y > 0.0F) {
        const glm::vec2 most = glm::max(area - scale * glm::vec2(kTitleBarPoints), glm::vec2(1.0F));
        size = glm::min(size, most);
    }
    return glm::ivec2(glm::round(size));
}

} // namespace ramus::app
