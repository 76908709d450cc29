#include "render/scene/centerlines.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using ramus::render::Centerlines;

TEST_CASE("thinned centerlines stay near the whole ones, with their ends and branches") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> step(-1.0F, 1.0F);
    Centerlines lines;
    for (int branch = 0; branch < 40; ++branch) {
        const std::uint32_t count = branch == 7 ? 0 : branch == 8 ? 1 : 2 + static_cast<std::uint32_t>(branch) * 5;
        lines.runs.push_back({static_cast<std::uint32_t>(lines.points.size()), count});
        glm::vec3 at(10.0F * step(random), 0.0F, 0.0F), way(1.0F, 0.0F, 0.0F);
        float radius = 2.0F + step(random);
        for (std::uint32_t i = 0; i < count; ++i) {
            lines.points.emplace_back(at, float(i));
            lines.details.push_back({2.0F * radius, branch});
            way = glm::normalize(way + 0.2F * glm::vec3(step(random), step(random), step(random)));
            at += 0.5F * way;
            radius *= 1.0F + 0.02F * step(random);
        }
    }
    const double most = 0.2;
    const Centerlines fewer = lines.thinned(most);
    REQUIRE(fewer.runs.size() == lines.runs.size());
    CHECK(fewer.points.size() < lines.points.size() / 2);
    for (std::size_t branch = 0; branch < lines.runs.size(); ++branch) {
        const Centerlines::Run whole = lines.runs[branch], run = fewer.runs[branch];
        REQUIRE((run.count == 0) == (whole.count == 0));
        if (whole.count == 0) continue;
        CHECK(fewer.points[run.first] == lines.points[whole.first]);
        CHECK(fewer.points[run.first + run.count - 1] == lines.points[whole.first + whole.count - 1]);
        for (std::uint32_t i = 0; i < whole.count; ++i) {
            const glm::vec3 p(lines.points[whole.first + i]);
            double nearest = glm::distance(p, glm::vec3(fewer.points[run.first]));
            for (std::uint32_t k = 0; k + 1 < run.count; ++k) {
                const glm::vec3 a(fewer.points[run.first + k]), ab = glm::vec3(fewer.points[run.first + k + 1]) - a;
                const float t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
                nearest = std::min(nearest, double(glm::distance(p, a + t * ab)));
            }
            CHECK(nearest <= std::min(most, 0.15 * 0.5 * lines.details[whole.first + i].diameter_mm) + 1e-5);
        }
        for (std::uint32_t k = 0; k < run.count; ++k) CHECK(fewer.details[run.first + k].branch == int(branch));
    }
}
