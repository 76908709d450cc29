#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/shade.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/light-inl.h"
#include "render/caster/shade.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Colours of a vector of records, one after the other: red, green, blue and `alpha`.
HWY_INLINE void Spread(V3 colour, V alpha, float* to) {
    hn::StoreInterleaved4(colour.x, colour.y, colour.z, alpha, D(), to);
}

// Nearest first: each veils what lies behind it in its sample.
void ShadePanes(const View& view, const Shading& shading, const Panes& panes, int x, int y, Colours& colours) {
    alignas(64) float found[64];
    for (std::size_t first = 0; first < panes.count; first += kN) {
        const Place place = PlaceOf(view, shading, panes.place + first, panes.id + first, panes.normal + first,
                                    panes.depth + first, x, y);
        Veil veil = Glass(shading, place);
        const auto take = [&](M which, const auto& make) {
            if (hn::AllFalse(D(), which)) return;
            const Veil made = make();
            veil = {choose(which, made.radiance, veil.radiance), hn::IfThenElse(which, made.alpha, veil.alpha)};
        };
        const M shell = any_of(place.id, kSolid), context = hn::And(shell, any_of(place.id, kContext));
        const Matter lesion{set(shading.look.lesion), set(shading.look.lesion[3])};
        take(hn::AndNot(context, shell), [&] { return Shell(shading, place, lesion); });
        if (!hn::AllFalse(D(), context)) {
            const Matter matter = ContextOf(shading, place.id);
            const M lines = hn::And(context, hn::Lt(matter.opacity, hn::Zero(D())));
            take(hn::AndNot(lines, context), [&] { return Shell(shading, place, matter); });
            take(lines, [&] { return Lines(shading, place, matter, hn::LoadU(DU(), panes.normal + first)); });
        }
        Spread(veil.radiance, veil.alpha, found);
        for (std::size_t k = 0; k < std::size_t(kN) && first + k < panes.count; ++k) {
            const std::uint32_t at = panes.place[first + k];
            const auto lay = [&](std::uint32_t sample) {
                float* front = colours.front[sample][at & kPixelMask];
                const float through = 1.0F - front[3];
                for (std::size_t c = 0; c < 4; ++c) front[c] += through * found[4 * k + c];
            };
            if ((at & kWhole) == 0)
                lay(at >> kSampleShift & 3U);
            else
                lay(0), lay(1), lay(2), lay(3);
        }
    }
}

void ShadeRecords(const View& view, const Shading& shading, const Records& records, bool glass, int x, int y,
                  const PictureArrays& picture, Colours& colours) {
    const D d;
    alignas(64) float found[64];
    for (std::size_t first = 0; first < records.count; first += kN) {
        const V value =
            shading.ramp != nullptr || shading.cut_count > 0 ? hn::LoadU(d, records.value + first) : hn::Zero(d);
        Spread(Radiance(view, shading,
                        PlaceOf(view, shading, records.place + first, records.id + first, records.normal + first,
                                records.depth + first, x, y),
                        value, picture),
               set(1.0F), found);
        for (std::size_t k = 0; k < std::size_t(kN) && first + k < records.count; ++k) {
            const std::uint32_t place = records.place[first + k], pixel = place & kPixelMask;
            float share = (place & kWhole) != 0 ? 1.0F : 0.25F;
            if (glass) {
                const auto clear = [&](std::uint32_t s) { return 0.25F * (1.0F - colours.front[s][pixel][3]); };
                share = (place & kWhole) != 0 ? clear(0) + clear(1) + clear(2) + clear(3)
                                              : clear(place >> kSampleShift & 3U);
            }
            float* sum = colours.sum[pixel];
            for (std::size_t c = 0; c < 4; ++c) sum[c] += share * found[4 * k + c];
        }
    }
}

// Share of the ring around a pixel that differs from it in being selected; as outline() of shade.frag.
HWY_INLINE V Outline(const View& view, const Shading& shading, const PictureArrays& picture, int x, int y) {
    const D d;
    const DU du;
    const DI di;
    const auto is_selected = [&](VI at) {
        const VU id = gather(picture.id, at);
        const auto branch = hn::And(hn::Ne(id, hn::Zero(du)), hn::Eq(hn::And(id, hn::Set(du, kSolid)), hn::Zero(du)));
        const VU index = hn::IfThenElseZero(branch, hn::Sub(id, hn::Set(du, 1U)));
        const VU flags = hn::ShiftRight<16>(gather(shading.branches + 1, hn::BitCast(di, hn::ShiftLeft<1>(index))));
        return hn::And(mask(branch), any_of(flags, kSelected));
    };
    const VI column = hn::Iota(di, x), row = hn::Set(di, y), stride = hn::Set(di, view.stride);
    const M inside = is_selected(index_of(row, stride, column));
    V differing = hn::Zero(d);
    for (const auto& step : shading.outline_ring) {
        VI tx = hn::Add(column, hn::Set(di, step[0])), ty = hn::Add(row, hn::Set(di, step[1]));
        tx = hn::Min(hn::Max(tx, hn::Zero(di)), hn::Set(di, view.width - 1));
        ty = hn::Min(hn::Max(ty, hn::Zero(di)), hn::Set(di, view.height - 1));
        differing =
            hn::Add(differing, hn::IfThenElseZero(hn::Xor(is_selected(index_of(ty, stride, tx)), inside), set(1.0F)));
    }
    return smooth_step(0.0F, 3.0F, differing);
}

// As encoded() of look.glsl, for premultiplied linear colours with what lies behind them already there.
void Encode(const View& view, const Shading& shading, bool lit, int x0, int y0, const PictureArrays& picture,
            const Colours& colours, std::uint32_t* rgba) {
    const D d;
    const DU du;
    const Look& look = shading.look;
    const bool transparent = look.background_top[3] > 0.5F;
    const V one = set(1.0F), zero = hn::Zero(d);
    alignas(64) std::uint32_t words[16];
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        const float up = (static_cast<float>(y) + 0.5F) / static_cast<float>(view.height);
        const float t = up * up * (3.0F - 2.0F * up);
        V3 paper{zero, zero, zero};
        if (!transparent) paper = mix(set(look.background_bottom), set(look.background_top), set(t));
        const V3 behind = to_linear(paper);
        for (int x = x0; x < x0 + kTile && x < view.width; x += kN) {
            const V px = hn::Add(hn::Iota(d, static_cast<float>(x)), set(0.5F)), py = set(static_cast<float>(y) + 0.5F);
            const V half_step = hn::Mul(hn::Sub(noise(hn::Add(py, set(17.0F)), hn::Add(px, set(17.0F))), set(0.5F)),
                                        set(1.0F / 255.0F));
            const int pixel = (y - y0) * kTile + x - x0;
            V3 bytes = transparent
                           ? paper
                           : V3{hn::Add(paper.x, half_step), hn::Add(paper.y, half_step), hn::Add(paper.z, half_step)};
            V alpha = set(transparent ? 0.0F : 1.0F);
            V3 sum{zero, zero, zero};
            V there = zero;
            if (lit) hn::LoadInterleaved4(d, colours.sum[pixel], sum.x, sum.y, sum.z, there);
            const V edge = shading.outlined ? Outline(view, shading, picture, x, y) : zero;
            const M covered = hn::Gt(hn::Max(there, edge), zero);
            if (!hn::AllFalse(d, covered)) {
                V here = clamp01(there);
                const V open = hn::Sub(one, here);
                if (!transparent) sum = sum + open * behind, here = one;
                const V share = hn::Mul(set(0.85F), edge);
                sum = mix(sum, set(look.selection), share);
                here = mix(here, one, share);
                const V inverse = hn::IfThenElseZero(hn::Gt(here, zero), hn::Div(one, hn::Max(here, set(1e-6F))));
                const auto encode = [&](V c) {
                    c = hn::Mul(c, inverse);
                    const M bright = hn::Ge(c, set(0.72F));
                    if (!hn::AllFalse(d, bright)) {
                        const V over = hn::Mul(hn::Sub(set(0.72F), c), set(1.442695F / 0.28F));
                        c = hn::IfThenElse(bright, hn::NegMulAdd(set(0.28F), power_of_two(over), one), c);
                    }
                    return hn::Mul(clamp01(hn::Add(to_srgb(clamp01(c)), half_step)), here);
                };
                bytes = choose(covered, {encode(sum.x), encode(sum.y), encode(sum.z)}, bytes);
                alpha = hn::IfThenElse(covered, here, alpha);
            }
            const V most = set(255.0F);
            const auto word = [&](V c) { return rounded(hn::Mul(clamp01(c), most)); };
            const VU packed = hn::Or(hn::Or(word(bytes.x), hn::ShiftLeft<8>(word(bytes.y))),
                                     hn::Or(hn::ShiftLeft<16>(word(bytes.z)), hn::ShiftLeft<24>(word(alpha))));
            std::uint32_t* to = rgba + std::size_t(y) * std::size_t(view.width) + std::size_t(x);
            if (x + kN <= view.width) {
                hn::StoreU(packed, du, to);
            } else {
                hn::Store(packed, du, words);
                __builtin_memcpy(to, words, 4 * std::size_t(view.width - x));
            }
        }
    }
}

void ShadeTile(const View& view, const Shading& shading, const Records& records, const Panes& panes, int x, int y,
               const PictureArrays& picture, Colours& colours, std::uint32_t* rgba) {
    const bool glass = panes.count > 0, lit = glass || records.count > 0;
    if (lit) __builtin_memset(colours.sum, 0, sizeof colours.sum);
    if (glass) {
        __builtin_memset(colours.front, 0, sizeof colours.front);
        ShadePanes(view, shading, panes, x, y, colours);
    }
    ShadeRecords(view, shading, records, glass, x, y, picture, colours);
    for (int pixel = 0; glass && pixel < kTilePixels; ++pixel)
        for (int c = 0; c < 4; ++c)
            colours.sum[pixel][c] += 0.25F * (colours.front[0][pixel][c] + colours.front[1][pixel][c] +
                                              colours.front[2][pixel][c] + colours.front[3][pixel][c]);
    Encode(view, shading, lit, x, y, picture, colours, rgba);
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(ShadeTile);

void shade_tile(const View& view, const Shading& shading, const Records& records, const Panes& panes, int x, int y,
                const PictureArrays& picture, Colours& colours, std::uint32_t* rgba) {
    HWY_DYNAMIC_DISPATCH(ShadeTile)(view, shading, records, panes, x, y, picture, colours, rgba);
}

} // namespace ramus::render::caster
#endif
