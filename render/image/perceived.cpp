#include "render/image/perceived.h"

#include "render/scene/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <tbb/parallel_for.h>
#include <utility>
#include <vector>

namespace ramus::render {

namespace {

using Channel = std::vector<float>;

// One term of a channel's blur: its weight, and the angle in degrees where it has fallen to 1/e.
struct Blur {
    double share, spread;
};
constexpr std::array<std::array<Blur, 2>, 3> kBlurs{
    {{{{0.921, 0.0283}, {0.105, 0.133}}}, {{{0.531, 0.0392}, {0.330, 0.494}}}, {{{0.488, 0.0536}, {0.371, 0.386}}}}};

// Columns: contributions of X, Y and Z to luminance, red-green and blue-yellow.
const glm::dmat3 kOpponent{{0.279, -0.449, 0.086}, {0.72, 0.29, -0.59}, {-0.107, -0.077, 0.501}};
// Columns: contributions of linear red, green and blue to X, Y and Z.
const glm::dmat3 kFromRgb{{0.4124, 0.2126, 0.0193}, {0.3576, 0.7152, 0.1192}, {0.1805, 0.0722, 0.9505}};
constexpr glm::dvec3 kWhite{0.9505, 1.0, 1.0890};

std::vector<float> weights_of(double spread) {
    const int reach = std::max(1, static_cast<int>(std::ceil(3.0 * spread)));
    std::vector<float> weights;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        weights.push_back(static_cast<float>(std::exp(-(i * i) / (spread * spread))));
        sum += double(weights.back());
    }
    for (float& weight : weights) weight /= static_cast<float>(sum);
    return weights;
}

// Blurs along rows and transposes; applied twice, it blurs in both directions and restores the orientation. Edges are
// extended.
Channel blurred_and_turned(const Channel& from, int width, int height, const std::vector<float>& weights) {
    Channel to(from.size());
    const int reach = static_cast<int>(weights.size()) / 2;
    tbb::parallel_for(0, height, [&](int y) {
        const float* row = from.data() + std::ptrdiff_t{y} * width;
        for (int x = 0; x < width; ++x) {
            float sum = 0.0F;
            for (int i = -reach; i <= reach; ++i)
                sum += weights[static_cast<std::size_t>(i + reach)] * row[std::clamp(x + i, 0, width - 1)];
            to[static_cast<std::size_t>(x) * static_cast<std::size_t>(height) + static_cast<std::size_t>(y)] = sum;
        }
    });
    return to;
}

void blur(Channel& channel, int width, int height, const std::array<Blur, 2>& blurs, double pixels_per_degree) {
    Channel sum(channel.size(), 0.0F);
    for (const Blur& one : blurs) {
        const std::vector<float> weights = weights_of(one.spread * pixels_per_degree);
        const Channel found =
            blurred_and_turned(blurred_and_turned(channel, width, height, weights), height, width, weights);
        const auto share = static_cast<float>(one.share / (blurs[0].share + blurs[1].share));
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * found[i];
    }
    channel = std::move(sum);
}

std::array<Channel, 3> opponent_channels(const Image& image, double pixels_per_degree) {
    const std::size_t count = image.rgba.size() / 4;
    std::array<Channel, 3> channels{Channel(count), Channel(count), Channel(count)};
    const auto light = linear_of_bytes();
    const glm::dmat3 to_channels = kOpponent * kFromRgb;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* p = &image.rgba[4 * i];
        const double alpha = p[3] / 255.0;
        const glm::dvec3 rgb(light[p[0]], light[p[1]], light[p[2]]);
        const glm::dvec3 found = to_channels * (alpha * rgb + (1.0 - alpha) * 0.2);
        for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)][i] = static_cast<float>(found[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) blur(channels[c], image.width, image.height, kBlurs[c], pixels_per_degree);
    return channels;
}

// CIE 1976 L*a*b* of a pixel after the blur.
glm::dvec3 lab(const std::array<Channel, 3>& channels, std::size_t i, const glm::dmat3& to_xyz) {
    const glm::dvec3 xyz = to_xyz * glm::dvec3(channels[0][i], channels[1][i], channels[2][i]) / kWhite;
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f(xyz.x), y = f(xyz.y), z = f(xyz.z);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

} // namespace

Result<PerceivedDifference> perceived_difference(const Image& actual, const Image& reference,
                                                 double pixels_per_degree) {
    if (auto same = compare(actual, reference); !same) return tl::unexpected(same.error());
    PerceivedDifference difference;
    difference.pixels = actual.rgba.size() / 4;
    if (actual == reference || difference.pixels == 0) return difference;
    const auto seen = opponent_channels(actual, pixels_per_degree);
    const auto wanted = opponent_channels(reference, pixels_per_degree);
    const glm::dmat3 to_xyz = glm::inverse(kOpponent);
    for (std::size_t i = 0; i < difference.pixels; ++i) {
        const double distance = glm::distance(lab(seen, i, to_xyz), lab(wanted, i, to_xyz));
        difference.mean += distance / static_cast<double>(difference.pixels);
        difference.largest = std::max(difference.largest, distance);
        difference.noticeable += distance > kJustNoticeable ? 1 : 0;
    }
    return difference;
}

} // namespace ramus::render
