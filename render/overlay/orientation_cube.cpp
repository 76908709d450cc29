#include "render/overlay/orientation_cube.h"

#include "render/scene/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

namespace {

constexpr int kLetterSide = 64; // texels of a face's letter
constexpr int kSubsamples = 4;  // per side: 16 rays per pixel

// The six faces in the order of AxisNames: outward normal, and right and up of its name as its standard view shows it.
struct Face {
    glm::dvec3 normal, right, up;
    glm::dvec3 colour; // linear
};
const std::array<Face, 6> kFaces{{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.155, 0.095, 0.088}},
    {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.155, 0.095, 0.088}},
    {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0.088, 0.128, 0.098}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {0.088, 0.128, 0.098}},
    {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.084, 0.108, 0.160}},
    {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {0.084, 0.108, 0.160}},
}};

Coverage name_tile(const std::string& name) {
    const Coverage drawn = draw_text(name, (name.size() > 1 ? 0.46 : 0.56) * kLetterSide);
    int left = drawn.width, right = -1, top = drawn.height, bottom = -1;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x)
            if (drawn.at(x, y) > 8)
                left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
                bottom = std::max(bottom, y);
    Coverage tile(kLetterSide, kLetterSide);
    const int dx = (left + right + 1 - kLetterSide) / 2, dy = (top + bottom + 1 - kLetterSide) / 2;
    for (int y = 0; y < kLetterSide; ++y)
        for (int x = 0; x < kLetterSide; ++x) tile.put(x, y, drawn.at(x + dx, y + dy));
    return tile;
}

double sampled(const Coverage& tile, double u, double v) { // u, v in [0, 1] from the top left, linear
    const double x = u * tile.width - 0.5, y = v * tile.height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return ((1 - fy) * ((1 - fx) * tile.at(x0, y0) + fx * tile.at(x0 + 1, y0)) +
            fy * ((1 - fx) * tile.at(x0, y0 + 1) + fx * tile.at(x0 + 1, y0 + 1))) /
           255.0;
}

struct Hit {
    int face = -1;
    glm::dvec3 colour{0.0};
};

} // namespace

OrientationCube::OrientationCube() {
    for (std::size_t i = 0; i < kFaces.size(); ++i) {
        tiles_.at(i) = name_tile(side_letters().at(i));
        tiles_.at(kFaces.size() + i) = name_tile(plain_axes().at(i));
    }
}

const Coverage& OrientationCube::tile_of(const std::string& name) const {
    const auto place = [&](const AxisNames& names) {
        return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    const std::size_t letter = place(side_letters()), axis = place(plain_axes());
    return tiles_.at(letter < kFaces.size() ? letter : kFaces.size() + std::min(axis, kFaces.size() - 1));
}

// Parallel rays of one camera: the latest entry into the three slabs is on the visible face.
class OrientationCube::Rays {
public:
    Rays(const OrientationCube& cube, const Camera& camera, int side, const AxisNames& axes)
        : side_(side), axes_(axes_of(camera)),
          light_(glm::normalize(-0.35 * axes_.right + 0.55 * axes_.up - 0.9 * axes_.forward)) {
        for (std::size_t face = 0; face < names_.size(); ++face) names_.at(face) = &cube.tile_of(axes.at(face));
        for (int k = 0; k < 3; ++k) {
            const double along = axes_.forward[k];
            ahead_[k] = std::copysign(1.0, along);
            inverse_[k] = 1.0 / (std::abs(along) < 1e-12 ? std::copysign(1e-12, along) : along);
        }
    }

    // Through a point of the picture, in pixels.
    [[nodiscard]] Hit cast(double sx, double sy) const {
        constexpr double kExtent = 1.76; // half the picture in units of half the cube: corners stay inside
        const glm::dvec3 start =
            kExtent * ((2.0 * sx / side_ - 1.0) * axes_.right + (1.0 - 2.0 * sy / side_) * axes_.up);
        double entry = -1e9, exit = 1e9;
        int face = 0;
        for (int k = 0; k < 3; ++k) {
            const double near = (-ahead_[k] - start[k]) * inverse_[k], far = (ahead_[k] - start[k]) * inverse_[k];
            if (near > entry) {
                entry = near;
                face = 2 * k + (ahead_[k] > 0.0 ? 1 : 0);
            }
            exit = std::min(exit, far);
        }
        if (entry > exit) return {};
        return {face, colour(static_cast<std::size_t>(face), start + entry * axes_.forward)};
    }

private:
    [[nodiscard]] glm::dvec3 colour(std::size_t face, const glm::dvec3& point) const {
        const Face& f = kFaces[face];
        const double u = 0.5 + 0.5 * glm::dot(point, f.right), v = 0.5 - 0.5 * glm::dot(point, f.up);
        const double edge = 2.0 * std::min(std::min(u, 1.0 - u), std::min(v, 1.0 - v));
        const double lit = 0.55 + 0.60 * std::max(0.0, glm::dot(f.normal, light_));
        glm::dvec3 colour = f.colour * lit;
        if (edge < 0.07) colour = 1.5 * colour + 0.04;
        return glm::mix(colour, glm::dvec3(0.90, 0.92, 0.95) * std::min(1.0, 0.35 + 0.7 * lit),
                        sampled(*names_[face], u, v));
    }

    std::array<const Coverage*, 6> names_{}; // by face
    int side_;
    CameraAxes axes_;
    glm::dvec3 light_;
    glm::dvec3 ahead_{0.0}, inverse_{0.0}; // direction of the rays; its reciprocal
};

void OrientationCube::paint_pixel(const Rays& rays, int px, int py, std::uint8_t* out) {
    glm::dvec3 sum(0.0);
    int hits = 0, count = 0;
    const auto add = [&](int column, int row) {
        ++count;
        const Hit hit = rays.cast(px + (column + 0.5) / kSubsamples, py + (row + 0.5) / kSubsamples);
        if (hit.face >= 0) ++hits, sum += hit.colour;
        return hit;
    };
    // If all corners of a pixel see the same plain colour, so does the rest.
    constexpr int kLast = kSubsamples - 1;
    const std::array<Hit, 4> corners{add(0, 0), add(kLast, 0), add(0, kLast), add(kLast, kLast)};
    const bool plain = std::ranges::all_of(
        corners, [&](const Hit& hit) { return hit.face == corners[0].face && hit.colour == corners[0].colour; });
    for (int s = 0; s < kSubsamples * kSubsamples && !plain; ++s) {
        const int column = s % kSubsamples, row = s / kSubsamples;
        if ((column == 0 || column == kLast) && (row == 0 || row == kLast)) continue;
        (void)add(column, row);
    }
    if (hits == 0) return;
    sum /= hits;
    for (int k = 0; k < 3; ++k) out[k] = srgb_byte(sum[k]);
    out[3] = static_cast<std::uint8_t>(std::lround(235.0 * hits / count));
}

Image OrientationCube::paint(const Camera& camera, int side, const AxisNames& axes) const {
    Image image(side, side);
    const Rays rays(*this, camera, side, axes);
    for (int py = 0; py < side; ++py)
        for (int px = 0; px < side; ++px) paint_pixel(rays, px, py, image.pixel(px, py));
    return image;
}

} // namespace ramus::render
