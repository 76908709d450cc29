#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/shade.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/look-inl.h"
#include "render/caster/stages.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using SurfacePoint = LookOfPixels::SurfacePoint;

// Stores four numbers per lane, lane by lane.
HWY_INLINE void spread(Vec4 colour, float* to) {
    hn::StoreInterleaved4(colour.x.v, colour.y.v, colour.z.v, colour.w.v, D(), to);
}

// A vector of records, from `first` on.
struct ShadedPoints {
    SurfacePoint point;
    VI in_picture;
    Mask whole; // the record stands for all samples of the pixel
};

HWY_INLINE ShadedPoints points_of(LookOfPixels& look, const Shading& shading, const Records& records, std::size_t first,
                                  const ShadedTile& tile) {
    const D d;
    const DU du;
    const DI di;
    ShadedPoints found;
    SurfacePoint& p = found.point;
    const VU position = hn::LoadU(du, records.position + first), pixel = hn::And(position, hn::Set(du, kPixelMask));
    found.whole = {any_of(position, kWhole)};
    static_assert(kTile == 32);
    const VU in_row = hn::And(pixel, hn::Set(du, std::uint32_t{kTile - 1}));
    const VI column = hn::Add(hn::BitCast(di, in_row), hn::Set(di, tile.x));
    const VI row = hn::Add(hn::BitCast(di, hn::ShiftRight<5>(pixel)), hn::Set(di, tile.y));
    found.in_picture = index_of(row, hn::Set(di, shading.stride), column);

    p.id = {hn::LoadU(du, records.id + first)};
    p.fixed_colour = has(p.id, kSolid);
    const auto of_branch = hn::Eq(hn::And(p.id.v, hn::Set(du, kSolid)), hn::Zero(du));
    const VU branch = hn::IfThenElseZero(of_branch, hn::Sub(hn::AndNot(hn::Set(du, kLine), p.id.v), hn::Set(du, 1U)));
    const VI word = hn::BitCast(di, hn::ShiftLeft<1>(branch));
    const VU red_green = gather(shading.branches, word), blue_flags = gather(shading.branches + 1, word);
    p.flags = {hn::IfThenElseZero(of_branch, hn::ShiftRight<16>(blue_flags))};
    const VU low = hn::Set(du, 0xffffU);
    const auto share = [&](VU bits) { return Float(hn::ConvertTo(d, hn::BitCast(di, bits))) * (1.0F / 65535.0F); };
    p.albedo = {share(hn::And(red_green, low)), share(hn::ShiftRight<16>(red_green)), share(hn::And(blue_flags, low))};

    p.normal = unpacked_normal(hn::LoadU(du, records.normal + first));
    p.pixel = {Float(hn::ConvertTo(d, column)) + 0.5F, Float(hn::ConvertTo(d, row)) + 0.5F};
    p.position = look.eye_position(p.pixel, hn::LoadU(d, records.depth + first));
    p.towards_eye = look.way_to_eye(p.position);
    p.far = look.share_of_depth(p.position.z);
    p.value = records.value == nullptr ? hn::Zero(d) : hn::LoadU(d, records.value + first);
    return found;
}

HWY_INLINE Vec4 veil_of(LookOfPixels& look, SurfacePoint p, VU normals) {
    Vec4 veil = look.glass_veil(p);
    const Mask shell = has(p.id, kSolid);
    if (!any(shell)) return veil;
    const Vec4 mesh = look.shape_look(p.id);
    p.albedo = {mesh.x, mesh.y, mesh.z};
    const Mask lines = shell && mesh.w < 0.0F;
    veil = select(shell, look.shell_veil(p, mesh.w), veil);
    if (any(lines)) veil = select(lines, look.edge_veil(p, -mesh.w * Float(hn::BitCast(D(), normals))), veil);
    return veil;
}

// Nearest first; each fragment veils what is behind it in its sample.
void shade_glass(LookOfPixels& look, const Shading& shading, const Records& glass, const ShadedTile& tile) {
    alignas(64) float found[64];
    for (std::size_t first = 0; first < glass.count; first += kN) {
        const SurfacePoint p = points_of(look, shading, glass, first, tile).point;
        spread(veil_of(look, p, hn::LoadU(DU(), glass.normal + first)), found);
        for (std::size_t k = 0; k < std::size_t(kN) && first + k < glass.count; ++k) {
            const std::uint32_t at = glass.position[first + k];
            const auto lay = [&](std::uint32_t sample) {
                float* front = tile.colours.front[sample][at & kPixelMask];
                const float through = 1.0F - front[3];
                for (std::size_t c = 0; c < 4; ++c) front[c] += through * found[4 * k + c];
            };
            const std::uint32_t sample = at >> kSampleShift & 3U;
            if ((at & kWhole) != 0)
                lay(0), lay(1), lay(2), lay(3);
            else if ((at & kPair) != 0)
                lay(sample), lay(sample + 1);
            else
                lay(sample);
        }
    }
}

HWY_INLINE Vec3 radiance_of(LookOfPixels& look, const ShadedPoints& points, const PictureArrays& picture) {
    SurfacePoint p = points.point;
    if (any(p.fixed_colour)) {
        const Vec4 mesh = look.shape_look(p.id);
        p.albedo = select(p.fixed_colour, Vec3(mesh.x, mesh.y, mesh.z), p.albedo);
    }
    Vec2 taken(gather(picture.sky.smooth, points.in_picture), 0.0F);
    if (look.shadows()) {
        taken.y = gather(picture.key.smooth, points.in_picture);
        if (any(!points.whole)) taken = select(points.whole, taken, look.taken_beside(p.pixel, p.position.z));
    }
    Vec3 radiance = look.radiance_of(p, taken);
    const Mask line = has(p.id, kLine);
    if (any(line)) radiance = select(line, look.line_radiance(p), radiance);
    return radiance;
}

// Behind the glass, where there is any.
void shade_opaque(LookOfPixels& look, const Shading& shading, const Records& records, bool glass,
                  const ShadedTile& tile, const PictureArrays& picture) {
    alignas(64) float found[64];
    for (std::size_t first = 0; first < records.count; first += kN) {
        const ShadedPoints points = points_of(look, shading, records, first, tile);
        spread({radiance_of(look, points, picture), 1.0F}, found);
        for (std::size_t k = 0; k < std::size_t(kN) && first + k < records.count; ++k) {
            const std::uint32_t position = records.position[first + k], pixel = position & kPixelMask;
            float share = (position & kWhole) != 0 ? 1.0F : 0.25F;
            if (glass) {
                const auto clear = [&](std::uint32_t s) { return 0.25F * (1.0F - tile.colours.front[s][pixel][3]); };
                share = (position & kWhole) != 0 ? clear(0) + clear(1) + clear(2) + clear(3)
                                                 : clear(position >> kSampleShift & 3U);
            }
            float* sum = tile.colours.sum[pixel];
            for (std::size_t c = 0; c < 4; ++c) sum[c] += share * found[4 * k + c];
        }
    }
}

// As displayed: their light is what tone mapping turns into their bytes.
void add_slices(const Shading& shading, bool glass, const ShadedTile& tile) {
    for (std::size_t i = 0; i < tile.slice_count; ++i) {
        const SlicePixel& slice = tile.slices[i];
        float* sum = tile.colours.sum[slice.at];
        for (std::size_t s = 0; s < kSamples; ++s) {
            if ((slice.samples >> s & 1U) == 0) continue;
            const float share = 0.25F * (glass ? 1.0F - tile.colours.front[s][slice.at][3] : 1.0F);
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += share * shading.slice_light[slice.colour[s] >> (8 * c) & 255U];
            sum[3] += share;
        }
    }
}

// Pixels that show nothing else get the bytes of the slice.
void put_plain_slices(const Shading& shading, bool glass, const ShadedTile& tile) {
    for (std::size_t i = 0; i < tile.slice_count && !shading.outlined; ++i) {
        const SlicePixel& slice = tile.slices[i];
        bool plain = slice.samples == (1U << kSamples) - 1U;
        for (std::size_t s = 0; s < kSamples; ++s) {
            plain = plain && slice.colour[s] == slice.colour[0];
            plain = plain && (!glass || tile.colours.front[s][slice.at][3] == 0.0F);
        }
        const int x = tile.x + slice.at % kTile, y = tile.y + slice.at / kTile;
        if (plain) tile.rgba[std::size_t(y) * std::size_t(shading.width) + std::size_t(x)] = slice.colour[0];
    }
}

// Bytes of a colour, red lowest.
HWY_INLINE VU packed_bytes(Vec4 colour) {
    const auto byte = [](Float c) { return rounded((clamp(c, 0.0F, 1.0F) * 255.0F).v); };
    return hn::Or(hn::Or(byte(colour.x), hn::ShiftLeft<8>(byte(colour.y))),
                  hn::Or(hn::ShiftLeft<16>(byte(colour.z)), hn::ShiftLeft<24>(byte(colour.w))));
}

// Composes kN pixels: `sum` (premultiplied, linear) over `behind`.
HWY_INLINE Vec4 finished(LookOfPixels& look, Vec4 sum, Vec3 behind, bool transparent, Float outline, Float dither) {
    Float alpha = clamp(sum.w, 0.0F, 1.0F);
    Vec3 light(sum.x, sum.y, sum.z);
    if (!transparent) light = light + (1.0F - alpha) * behind, alpha = 1.0F;
    return look.encoded(look.outlined(Vec4(light, alpha), outline), dither);
}

// Writes the tile's bytes. `lit`: the tile is not empty.
void encode(LookOfPixels& look, const Shading& shading, bool lit, const ShadedTile& tile) {
    const D d;
    alignas(64) std::uint32_t words[16];
    const bool transparent = shading.uniforms.background_top.w > 0.5F;
    const int width = shading.width, height = shading.height;
    for (int y = tile.y; y < tile.y + kTile && y < height; ++y) {
        const float middle = static_cast<float>(y) + 0.5F;
        const Vec3 paper = transparent ? Vec3(0.0F) : look.background(middle / static_cast<float>(height));
        const Vec3 behind = look.to_linear(paper);
        for (int x = tile.x; x < tile.x + kTile && x < width; x += kN) {
            const Vec2 at(Float(hn::Iota(d, static_cast<float>(x))) + 0.5F, middle);
            const Float dither = look.half_step(at);
            Vec4 colour = transparent ? Vec4(paper, 0.0F) : Vec4(paper + Vec3(dither), 1.0F);
            Vec4 sum(Vec3(0.0F), 0.0F);
            if (lit)
                hn::LoadInterleaved4(d, tile.colours.sum[(y - tile.y) * kTile + x - tile.x], sum.x.v, sum.y.v, sum.z.v,
                                     sum.w.v);
            const Float outline = shading.outlined ? look.outline(at) : Float(0.0F);
            const Mask covered = max(sum.w, outline) > 0.0F;
            if (any(covered))
                colour = select(covered, finished(look, sum, behind, transparent, outline, dither), colour);
            std::uint32_t* to = tile.rgba + std::size_t(y) * std::size_t(width) + std::size_t(x);
            if (x + kN <= width) {
                hn::StoreU(packed_bytes(colour), DU(), to);
            } else {
                hn::Store(packed_bytes(colour), DU(), words);
                __builtin_memcpy(to, words, 4 * std::size_t(width - x));
            }
        }
    }
}

void shade_lanes(const Shading& shading, const Records& records, const Records& glass, const PictureArrays& picture,
                 const ShadedTile& tile) {
    LookOfPixels look(shading, picture);
    Colours& colours = tile.colours;
    const bool any_glass = glass.count > 0, lit = any_glass || records.count > 0 || tile.slice_count > 0;
    if (lit) __builtin_memset(colours.sum, 0, sizeof colours.sum);
    if (any_glass) {
        __builtin_memset(colours.front, 0, sizeof colours.front);
        shade_glass(look, shading, glass, tile);
    }
    shade_opaque(look, shading, records, any_glass, tile, picture);
    add_slices(shading, any_glass, tile);
    for (int pixel = 0; any_glass && pixel < kTilePixels; ++pixel)
        for (int c = 0; c < 4; ++c)
            colours.sum[pixel][c] += 0.25F * (colours.front[0][pixel][c] + colours.front[1][pixel][c] +
                                              colours.front[2][pixel][c] + colours.front[3][pixel][c]);
    encode(look, shading, lit, tile);
    put_plain_slices(shading, any_glass, tile);
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(shade_lanes);

void shade_tile(const Shading& shading, const Records& records, const Records& glass, const PictureArrays& picture,
                const ShadedTile& tile) {
    HWY_DYNAMIC_DISPATCH(shade_lanes)(shading, records, glass, picture, tile);
}

} // namespace ramus::render::caster
#endif
