#include "render/caster/slices.h"

#include "render/image/image.h"
#include "render/scene/colour.h"
#include "render/scene/seen_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render::caster {

namespace {

using glm::clamp, glm::length, glm::dot, glm::max, glm::min, glm::mix, glm::vec3, std::ceil;

vec4 texel_of(const Image& image, int x, int y) {
    const std::uint8_t* at = image.pixel(x, y);
    const float alpha = float(at[3]) / 255.0F;
    return {alpha / 255.0F * vec3(at[0], at[1], at[2]), alpha};
}

// The shaders' code, with their uniforms and textures.
struct SliceCode : PlanesBlock {
    const Image* const* pictures;

    static vec2 sample_offset(int s) { return {kSampleX[s] - 0.5F, kSampleY[s] - 0.5F}; }

    [[nodiscard]] vec4 plane_texel(int plane, vec2 at, vec2 size) const {
        const Image& image = *pictures[plane];
        const vec2 texel = clamp(at * size - 0.5F, vec2(0.0F), size - 1.0F);
        const int x = static_cast<int>(texel.x), y = static_cast<int>(texel.y);
        const int right = std::min(x + 1, image.width - 1), below = std::min(y + 1, image.height - 1);
        const float across = texel.x - static_cast<float>(x), down = texel.y - static_cast<float>(y);
        return mix(mix(texel_of(image, x, y), texel_of(image, right, y), across),
                   mix(texel_of(image, x, below), texel_of(image, right, below), across), down);
    }
#include "shaders/look/slices.glsl"

    // As the shaders do, first where it is simple.
    [[nodiscard]] Slices slices_in(vec2 middle) {
        const SimpleSlice simple = simple_slice_at(middle, static_cast<int>(plane_counts.x), kNoSlice);
        const bool any = simple.plane >= 0 && !simple.mixed;
        const vec4 own = any ? slice_colour(simple.plane, simple.place, true) : vec4(0.0F);
        if (simple.mixed || (any && own.w < 1.0F)) return slices_at(middle, kSamples);
        Slices found;
        for (int s = 0; s < kSamples; ++s) {
            found.value[s] = any ? at_pixel(plane_row(simple.plane, 3), middle + sample_offset(s)) : kNoSlice;
            found.colour[s] = vec3(own);
        }
        return found;
    }
};

std::uint32_t bytes_of(const vec3& srgb) {
    const auto byte = [](float c) { return static_cast<std::uint32_t>(std::lround(255.0F * clamp(c, 0.0F, 1.0F))); };
    return byte(srgb.x) | byte(srgb.y) << 8 | byte(srgb.z) << 16 | 0xff000000U;
}

// Depth in mm of a value in the depth buffer, as in view.glsl.
float mm_of(const ViewBlock& view, float value) {
    const vec4& to_eye = view.clip_to_eye;
    return view.picture.w > 0.5F ? (value - to_eye.z) * to_eye.y : to_eye.z / (value + to_eye.y);
}

// Drops the samples in `hidden`, by pixel of the tile. What showed all samples of a pixel then shows some.
void drop_hidden(const std::array<std::uint8_t, kTilePixels>& hidden, Records& records) {
    std::size_t kept = 0, count = records.count;
    const auto put = [&](std::size_t to, std::size_t from, std::uint32_t position) {
        records.id[to] = records.id[from];
        records.normal[to] = records.normal[from];
        records.depth[to] = records.depth[from];
        if (records.value != nullptr) records.value[to] = records.value[from];
        records.position[to] = position;
    };
    for (std::size_t i = 0; i < records.count; ++i) {
        const std::uint32_t position = records.position[i], pixel = position & kPixelMask;
        const std::uint32_t mask = hidden[pixel], sample = position >> kSampleShift & 3U;
        if ((position & kWhole) == 0 || mask == 0) {
            if ((position & kWhole) != 0 || (mask >> sample & 1U) == 0) put(kept++, i, position);
            continue;
        }
        for (std::uint32_t s = 0; s < kSamples; ++s)
            if ((mask >> s & 1U) == 0) put(count++, i, pixel | s << kSampleShift);
    }
    for (std::size_t i = records.count; i < count; ++i) put(kept++, i, records.position[i]);
    records.count = kept;
}

} // namespace

Slicer::Slicer(const PlanesBlock& block, const std::vector<ScanPlane>& planes) : block_(block) {
    for (std::size_t i = 0; i < std::min(planes.size(), std::size_t{kMostPlanes}); ++i)
        pictures_[i] = picture_of(planes[i]);
}

bool Slicer::reaches(const TileTask& tile) const {
    for (int i = 0; i < static_cast<int>(block_.plane_counts.x); ++i) {
        const vec4& box = block_.plane_rows[kPlaneRows * i + 5];
        if (box.x < float(tile.x + kTile) && box.z > float(tile.x) && box.y < float(tile.y + kTile) &&
            box.w > float(tile.y))
            return true;
    }
    return false;
}

void Slicer::lay(const TileTask& tile, Samples& samples, const PictureArrays& picture, Records& records,
                 std::vector<SlicePixel>& found) const {
    found.clear();
    SliceCode code{block_, pictures_};
    const View& view = tile.view;
    std::array<std::uint8_t, kTilePixels> hidden{};
    for (int y = 0; y < std::min(kTile, view.height - tile.y); ++y)
        for (int x = 0; x < std::min(kTile, view.width - tile.x); ++x) {
            const vec2 middle(float(tile.x + x) + 0.5F, float(tile.y + y) + 0.5F);
            const SliceCode::Slices slices = code.slices_in(middle);
            const int block = y / kBlock * kBlocks + x / kBlock, lane = y % kBlock * kBlock + x % kBlock;
            SlicePixel pixel{static_cast<std::uint16_t>(y * kTile + x), 0, {}};
            float nearest = kNothing;
            for (int s = 0; s < kSamples; ++s) {
                if (slices.value[s] <= kNoSlice) continue;
                if (!samples.touched[block]) {
                    std::fill_n(&samples.depth[block][0][0], kSamples * kBlockPixels, kNothing);
                    std::fill_n(&samples.id[block][0][0], kSamples * kBlockPixels, 0U);
                    samples.farthest[block] = kNothing;
                    samples.touched[block] = true;
                }
                const float depth = mm_of(view.block, slices.value[s]);
                if (depth >= samples.depth[block][s][lane]) continue;
                samples.depth[block][s][lane] = depth;
                nearest = std::min(nearest, depth);
                pixel.samples = static_cast<std::uint8_t>(pixel.samples | 1U << unsigned(s));
                pixel.colour[s] = bytes_of(slices.colour[s]);
            }
            if (pixel.samples == 0) continue;
            found.push_back(pixel);
            hidden[pixel.at] = pixel.samples;
            const std::size_t at = std::size_t(tile.y + y) * std::size_t(view.stride) + std::size_t(tile.x + x);
            if (nearest >= picture.picked_depth[at]) continue;
            picture.picked_depth[at] = nearest;
            picture.id[at] = 0;
        }
    if (!found.empty()) drop_hidden(hidden, records);
}

const float* light_of_bytes() {
    static const std::array<float, 256> light = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            // Inverse of toned() in look/colour.glsl, which never reaches 1.
            const float c = std::min(linear(float(i) / 255.0F), 0.995F);
            made[i] = c < 0.72F ? c : 0.72F - 0.28F * std::log((1.0F - c) / 0.28F);
        }
        return made;
    }();
    return light.data();
}

} // namespace ramus::render::caster
