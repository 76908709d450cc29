#include "render/scene/depth_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr int kPixelsAPlace = 2, kMostPlaces = 1024; // each way
constexpr std::size_t kMostLookedAt = 20'000;        // samples used by visible_in()
constexpr double kLeftOut = 0.02;                    // share of the samples omitted at each end

// Middle and half width of the range without the omitted ends. Reorders the values.
struct Stretch {
    double middle, half;
};
Stretch stretch_of(std::vector<float>& values) {
    const auto out = static_cast<std::ptrdiff_t>(kLeftOut * static_cast<double>(values.size()));
    const auto low = values.begin() + out, high = values.end() - 1 - out;
    std::nth_element(values.begin(), low, values.end());
    const double least = *low; // the next call may move it
    std::nth_element(low, high, values.end());
    return {0.5 * (least + double{*high}), 0.5 * (double{*high} - least)};
}

} // namespace

glm::ivec2 DepthMap::size_for(glm::ivec2 picture) {
    return glm::clamp((picture + kPixelsAPlace - 1) / kPixelsAPlace, glm::ivec2(1), glm::ivec2(kMostPlaces));
}

glm::dvec2 DepthMap::pixel_of(int x, int y) const {
    return {(x + 0.5) * picture.x / size.x, picture.y - (y + 0.5) * picture.y / size.y};
}

std::optional<glm::dvec3> DepthMap::nearest_in(glm::ivec2 from, glm::ivec2 to, glm::dvec2 pixel, double reach) const {
    double least = reach * reach;
    std::optional<glm::dvec3> found;
    glm::dvec2 at(0.0);
    float depth = kEmpty;
    for (int y = from.y; y < to.y; ++y) {
        const float* row = depths.data() + std::ptrdiff_t{y} * size.x;
        for (int x = from.x; x < to.x; ++x) {
            if (!(row[x] < kEmpty)) continue;
            const glm::dvec2 middle = pixel_of(x, y), away = middle - pixel;
            const double squared = glm::dot(away, away);
            if (squared > least) continue;
            least = squared;
            at = middle;
            depth = row[x];
        }
    }
    if (!(depth < kEmpty)) return found;
    // Exactly under the pixel if that is the same entry.
    const glm::dvec2 place = glm::dvec2(picture) / glm::dvec2(size), away = glm::abs(at - pixel);
    if (away.x <= 0.5 * place.x && away.y <= 0.5 * place.y) at = pixel;
    found = unproject(camera, picture, at, depth);
    return found;
}

std::optional<glm::dvec3> DepthMap::point_at(glm::dvec2 pixel, double reach) const {
    if (size.x < 1 || size.y < 1 || !std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return {};
    const glm::dvec2 places = glm::dvec2(size) / glm::dvec2(picture);
    const glm::dvec2 middle = glm::dvec2(pixel.x, picture.y - pixel.y) * places, around = reach * places + 1.0;
    const glm::dvec2 most(size);
    const glm::ivec2 from(glm::clamp(glm::floor(middle - around), glm::dvec2(0.0), most));
    const glm::ivec2 to(glm::clamp(glm::ceil(middle + around), glm::dvec2(0.0), most));
    return nearest_in(from, to, pixel, std::max(reach, 0.75 / std::min(places.x, places.y)));
}

std::optional<glm::dvec3> DepthMap::nearest_point(glm::dvec2 pixel) const {
    return nearest_in(glm::ivec2(0), size, pixel, 1e9);
}

std::optional<Visible> visible_in(std::span<const DepthMap> maps) {
    std::size_t seen = 0;
    for (const DepthMap& map : maps)
        seen += static_cast<std::size_t>(
            std::ranges::count_if(map.depths, [](float depth) { return depth < DepthMap::kEmpty; }));
    if (seen == 0) return {};
    const std::size_t step = 1 + seen / kMostLookedAt;
    std::vector<float> across, down, deep;
    std::size_t index = 0;
    for (const DepthMap& map : maps)
        for (int y = 0; y < map.size.y; ++y)
            for (int x = 0; x < map.size.x; ++x) {
                const float depth = map.depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size.x) +
                                               static_cast<std::size_t>(x)];
                if (!(depth < DepthMap::kEmpty) || index++ % step != 0) continue;
                across.push_back((static_cast<float>(x) + 0.5F) / static_cast<float>(map.size.x));
                down.push_back(1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(map.size.y));
                deep.push_back(depth);
            }
    const DepthMap& first = maps.front();
    const glm::dvec2 pixel = glm::dvec2(stretch_of(across).middle, stretch_of(down).middle) * glm::dvec2(first.picture);
    const Stretch depth = stretch_of(deep);
    return Visible{unproject(first.camera, first.picture, pixel, depth.middle), depth.half};
}

} // namespace ramus::render
