// Lines are drawn with as many points as a view needs: nobody sees what is left out, and nothing in the picture is.
#include "render/scene/line_levels.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

using namespace ramus::render;

namespace {

constexpr int kWriggles = 300, kWrigglePoints = 120;
constexpr glm::ivec2 kLinePicture{900, 700};

// Wriggling lines in a ball of 60 mm, traced every tenth of a millimetre.
Centerlines wriggling() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-1.0F, 1.0F);
    const auto direction = [&] { return glm::vec3(number(random), number(random), number(random)); };
    Centerlines lines;
    lines.origin = {5.0, -3.0, 2.0};
    for (int branch = 0; branch < kWriggles; ++branch) {
        lines.runs.push_back({static_cast<std::uint32_t>(lines.points.size()), kWrigglePoints});
        glm::vec3 at = 30.0F * direction(), way = glm::normalize(direction());
        for (int i = 0; i < kWrigglePoints; ++i) {
            lines.points.emplace_back(at, 0.1F * float(i));
            lines.details.push_back({0.6F, branch});
            way = glm::normalize(way + 0.05F * direction());
            at += 0.1F * way;
        }
    }
    return lines;
}

Camera line_camera(double distance_mm, bool orthographic) {
    Camera camera;
    camera.position = {0.0, distance_mm, 0.0};
    camera.orthographic = orthographic;
    camera.scale = 0.25 * distance_mm;
    return camera;
}

std::vector<Centerlines> levels_of(const Centerlines& lines) {
    std::vector<Centerlines> levels;
    for (int level = 0; level + 1 < kLineLevels; ++level)
        levels.push_back(lines.thinned(level_mm(level, lines.extent_mm()), std::numeric_limits<double>::infinity()));
    levels.push_back(lines);
    return levels;
}

// The farthest that a point of a branch is from its line with fewer points, mm.
double farthest_off(const Centerlines& lines, const Centerlines& fewer, std::size_t branch) {
    double most = 0.0;
    const Centerlines::Run whole = lines.runs[branch], run = fewer.runs[branch];
    for (std::uint32_t i = whole.first; i < whole.first + whole.count; ++i) {
        double nearest = std::numeric_limits<double>::max();
        for (std::uint32_t k = run.first; k + 1 < run.first + run.count; ++k) {
            const glm::dvec3 a(fewer.points[k]), ab = glm::dvec3(fewer.points[k + 1]) - a, p(lines.points[i]);
            const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
            nearest = std::min(nearest, glm::distance(p, a + t * ab));
        }
        most = std::max(most, nearest);
    }
    return most;
}

} // namespace

TEST_CASE("a line with fewer points is off by a quarter of a pixel at the most, wherever it is in the picture") {
    const Centerlines lines = wriggling();
    const std::vector<LineBall> balls = line_balls(lines);
    const std::vector<Centerlines> levels = levels_of(lines);
    for (const bool orthographic : {false, true}) {
        int seen = 0, left_out = 0, coarse = 0;
        for (const double distance : {2000.0, 250.0, 60.0, 15.0}) {
            CAPTURE(orthographic);
            CAPTURE(distance);
            const Camera camera = line_camera(distance, orthographic);
            const auto chosen = line_levels(balls, lines.extent_mm(), camera, kLinePicture);
            REQUIRE(chosen.size() == std::size_t(kWriggles));
            for (std::size_t branch = 0; branch < chosen.size(); ++branch) {
                const int level = chosen[branch];
                double smallest_pixel = std::numeric_limits<double>::max(); // mm, of the branch's points
                for (int i = 0; i < kWrigglePoints; ++i) {
                    const glm::dvec3 point =
                        lines.origin + glm::dvec3(lines.points[lines.runs[branch].first + std::size_t(i)]);
                    const auto at = project(camera, kLinePicture, point);
                    const double mm = mm_per_pixel(camera, kLinePicture);
                    smallest_pixel = std::min(smallest_pixel, orthographic ? mm : at ? mm * at->z / distance : 0.0);
                    const bool inside =
                        at && at->x >= 0.0 && at->y >= 0.0 && at->x <= kLinePicture.x && at->y <= kLinePicture.y;
                    if (inside) CHECK(level != kNotInPicture);
                }
                if (level == kNotInPicture) {
                    ++left_out;
                    continue;
                }
                ++seen;
                coarse += level + 1 < kLineLevels ? 1 : 0;
                const double off = farthest_off(lines, levels[std::size_t(level)], branch);
                CHECK(off <= kLinePixels * smallest_pixel + 1e-5);
            }
        }
        CHECK(seen > kWriggles);
        CHECK(left_out > 50); // near the eye most of the tree is beside the picture
        CHECK(coarse > kWriggles);
    }
}

TEST_CASE("from afar lines are drawn with few of their points") {
    const Centerlines lines = wriggling();
    const auto chosen = line_levels(line_balls(lines), lines.extent_mm(), line_camera(2000.0, false), kLinePicture);
    const std::vector<Centerlines> levels = levels_of(lines);
    std::size_t drawn = 0;
    for (std::size_t branch = 0; branch < chosen.size(); ++branch) {
        REQUIRE(chosen[branch] != kNotInPicture);
        drawn += levels[std::size_t(chosen[branch])].runs[branch].count;
    }
    CHECK(8 * drawn < lines.points.size());
}

TEST_CASE("a branch without a line is in no picture") {
    Centerlines lines = wriggling();
    lines.runs[4].count = 0;
    lines.runs[5].count = 1;
    const auto chosen = line_levels(line_balls(lines), lines.extent_mm(), line_camera(250.0, true), kLinePicture);
    CHECK(chosen[4] == kNotInPicture);
    CHECK(chosen[5] == kNotInPicture);
}
