#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/sampling.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernel-inl.h"
#include "core/field/sampling.h"

#include <algorithm>
#include <cstring>
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Lanes' table indices for the 125 grid points, padded by repeating the last point.
struct GridLanes {
    alignas(64) std::int32_t i[kGridStride], j[kGridStride], k[kGridStride];
    constexpr GridLanes() : i{}, j{}, k{} {
        for (int n = 0; n < kGridStride; ++n) {
            const int p = n < kGridPoints ? n : kGridPoints - 1;
            i[n] = p % kGridSide;
            j[n] = p / kGridSide % kGridSide;
            k[n] = p / (kGridSide * kGridSide);
        }
    }
};
constexpr GridLanes kGridLanes;

template <std::size_t N, std::size_t M>
HWY_INLINE void subtract(const std::array<double, N>& axis, double start, float (&out)[M]) {
    // Rounded once from double precision: the same lattice point gives the same float in every brick.
    for (std::size_t n = 0; n < N; ++n) out[n] = static_cast<float>(axis[n] - start);
}

void SampleGrid(const ConvolutionField& field, const std::uint32_t* list, std::size_t count, const GridAxes& axes,
                float* HWY_RESTRICT values, std::uint64_t* HWY_RESTRICT inside) {
    const D d;
    [[maybe_unused]] const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const V sqrt_w = hn::Set(d, static_cast<float>(field.kernel().sqrt_w));
    const V saturated = error_function(d, hn::Set(d, 3.5F));
    const SegmentArrays& s = field.segments();
    for (std::size_t n = 0; n < kGridStride; n += lanes) hn::Store(hn::Zero(d), d, values + n);
    for (std::size_t m = 0; m < count; ++m) {
        const std::size_t index = list[m];
        const Segment segment = broadcast(d, s, index);
        alignas(64) float x[16] = {}, y[16] = {}, z[16] = {};
        subtract(axes.x, s.ax[index], x);
        subtract(axes.y, s.ay[index], y);
        subtract(axes.z, s.az[index], z);
        for (std::size_t n = 0; n < kGridStride; n += lanes) {
            V px, py, pz;
            if constexpr (HWY_MAX_BYTES >= 32) {
                px = hn::TableLookupLanes(hn::Load(d, x), hn::SetTableIndices(d, kGridLanes.i + n));
                py = hn::TableLookupLanes(hn::Load(d, y), hn::SetTableIndices(d, kGridLanes.j + n));
                pz = hn::TableLookupLanes(hn::Load(d, z), hn::SetTableIndices(d, kGridLanes.k + n));
            } else {
                px = hn::GatherIndex(d, x, hn::Load(di, kGridLanes.i + n));
                py = hn::GatherIndex(d, y, hn::Load(di, kGridLanes.j + n));
                pz = hn::GatherIndex(d, z, hn::Load(di, kGridLanes.k + n));
            }
            const Foot foot = find_foot(d, segment, sqrt_w, px, py, pz);
            if (hn::AllFalse(d, inside_support(d, foot.rho))) continue;
            hn::Store(hn::Add(hn::Load(d, values + n), kernel_value(d, segment, foot, saturated)), d, values + n);
        }
    }
    const V isovalue = hn::Set(d, static_cast<float>(field.kernel().isovalue));
    inside[0] = inside[1] = 0;
    for (std::size_t n = 0; n < kGridStride; n += lanes) {
        HWY_ALIGN std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Ge(hn::Load(d, values + n), isovalue), bits);
        std::uint64_t word = 0;
        std::memcpy(&word, bits, sizeof(word));
        inside[n / 64] |= (word & ((std::uint64_t{1} << lanes) - 1)) << (n % 64);
    }
    inside[1] &= (std::uint64_t{1} << (kGridPoints - 64)) - 1;
}

void SampleLattice(const ConvolutionField& field, const std::uint32_t* list, std::size_t count, const LatticeAxes& axes,
                   const LatticePoint* points, std::size_t point_count, float* HWY_RESTRICT values) {
    const D d;
    const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const V sqrt_w = hn::Set(d, static_cast<float>(field.kernel().sqrt_w));
    const V saturated = error_function(d, hn::Set(d, 3.5F));
    const SegmentArrays& s = field.segments();
    // A hundred points at a time keep the index arrays on the stack.
    constexpr std::size_t kBatch = 128;
    for (std::size_t first = 0; first < point_count; first += kBatch) {
        const std::size_t n_points = HWY_MIN(kBatch, point_count - first);
        alignas(64) std::int32_t pi[kBatch], pj[kBatch], pk[kBatch];
        alignas(64) float sum[kBatch];
        for (std::size_t n = 0; n < kBatch; ++n) {
            const LatticePoint p = points[first + HWY_MIN(n, n_points - 1)];
            pi[n] = p.i, pj[n] = p.j, pk[n] = p.k;
            sum[n] = 0.0F;
        }
        for (std::size_t m = 0; m < count; ++m) {
            const std::size_t index = list[m];
            const Segment segment = broadcast(d, s, index);
            alignas(64) float x[kLatticeSide], y[kLatticeSide], z[kLatticeSide];
            subtract(axes.x, s.ax[index], x);
            subtract(axes.y, s.ay[index], y);
            subtract(axes.z, s.az[index], z);
            for (std::size_t n = 0; n < n_points; n += lanes) {
                const Foot foot =
                    find_foot(d, segment, sqrt_w, hn::GatherIndex(d, x, hn::Load(di, pi + n)),
                              hn::GatherIndex(d, y, hn::Load(di, pj + n)), hn::GatherIndex(d, z, hn::Load(di, pk + n)));
                if (hn::AllFalse(d, inside_support(d, foot.rho))) continue;
                hn::Store(hn::Add(hn::Load(d, sum + n), kernel_value(d, segment, foot, saturated)), d, sum + n);
            }
        }
        for (std::size_t n = 0; n < n_points; ++n) values[first + n] = sum[n];
    }
}

// Newton's method on phi = sqrt(-ln F), which is linear in the distance from a straight vessel's axis: one step is
// exact there, and after a second 99.9 % of the vertices of real trees are within 0.2 % of their radius. The arrays of
// `points` are padded to whole vectors.
void Project(const ConvolutionField& field, const std::uint32_t* list, std::size_t count, Projection& points) {
    const D d;
    const std::size_t lanes = hn::Lanes(d);
    const Kernel& kernel = field.kernel();
    const V sqrt_w = hn::Set(d, static_cast<float>(kernel.sqrt_w));
    const V inverse_sqrt_w = hn::Set(d, static_cast<float>(1.0 / kernel.sqrt_w));
    const V target = sqrt_w; // phi on the surface: -ln(isovalue) = w
    const SegmentArrays& s = field.segments();
    const hn::RebindToSigned<D> di;
    using VI = hn::Vec<decltype(di)>;

    const float* HWY_RESTRICT lx = points.local.data();
    const float* HWY_RESTRICT ly = lx + count;
    const float* HWY_RESTRICT lz = ly + count;

    for (std::size_t n = 0; n < points.size(); n += lanes) {
        V x = hn::LoadU(d, points.x.data() + n);
        V y = hn::LoadU(d, points.y.data() + n);
        V z = hn::LoadU(d, points.z.data() + n);
        const V cx = hn::LoadU(d, points.cx.data() + n);
        const V cy = hn::LoadU(d, points.cy.data() + n);
        const V cz = hn::LoadU(d, points.cz.data() + n);
        const V reach = hn::LoadU(d, points.reach.data() + n);
        V gx, gy, gz, best, best_scale;
        VI best_segment;
        for (int step = 0; step < kProjectionSteps; ++step) {
            gx = gy = gz = hn::Zero(d);
            V sum = hn::Zero(d);
            best = hn::Set(d, -1.0F);
            best_scale = hn::Set(d, 1.0F);
            best_segment = hn::Set(di, static_cast<std::int32_t>(list[0]));
            for (std::size_t m = 0; m < count; ++m) {
                const std::size_t index = list[m];
                const Segment segment = broadcast(d, s, index);
                const Foot foot = find_foot(d, segment, sqrt_w, hn::Sub(x, hn::Set(d, lx[m])),
                                            hn::Sub(y, hn::Set(d, ly[m])), hn::Sub(z, hn::Set(d, lz[m])));
                if (hn::AllFalse(d, inside_support(d, foot.rho))) continue;
                const KernelGradient g = kernel_gradient(d, segment, foot, inverse_sqrt_w);
                sum = hn::Add(sum, g.value);
                gx = hn::MulAdd(g.radial, foot.qx, hn::MulAdd(g.axial, segment.ux, gx));
                gy = hn::MulAdd(g.radial, foot.qy, hn::MulAdd(g.axial, segment.uy, gy));
                gz = hn::MulAdd(g.radial, foot.qz, hn::MulAdd(g.axial, segment.uz, gz));
                const M stronger = hn::Gt(g.value, best);
                best = hn::IfThenElse(stronger, g.value, best);
                best_scale = hn::IfThenElse(stronger, foot.scale, best_scale);
                best_segment = hn::IfThenElse(hn::RebindMask(di, stronger),
                                              hn::Set(di, static_cast<std::int32_t>(index)), best_segment);
            }
            const V f = hn::Max(hn::Min(sum, hn::Set(d, 0.999F)), hn::Set(d, 1e-7F));
            const V phi = hn::Sqrt(hn::Neg(hn::Log(d, f)));
            // grad phi = -grad F / (2 F phi), so the Newton step is (target - phi) grad phi / |grad phi|^2.
            const V g2 = hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
            const V amount = hn::Div(hn::Mul(hn::Mul(hn::Sub(phi, target), hn::Set(d, 2.0F)), hn::Mul(f, phi)),
                                     hn::Max(g2, hn::Set(d, 1e-30F)));
            // A step never exceeds the reach: the gradient is small on the axis and says little there.
            const V length = hn::Mul(hn::Abs(amount), hn::Sqrt(g2));
            const V shrink = hn::Min(hn::Set(d, 1.0F), hn::Div(reach, hn::Max(length, hn::Set(d, 1e-30F))));
            const V move = hn::Mul(amount, shrink);
            x = hn::Max(hn::Min(hn::MulAdd(move, gx, x), hn::Add(cx, reach)), hn::Sub(cx, reach));
            y = hn::Max(hn::Min(hn::MulAdd(move, gy, y), hn::Add(cy, reach)), hn::Sub(cy, reach));
            z = hn::Max(hn::Min(hn::MulAdd(move, gz, z), hn::Add(cz, reach)), hn::Sub(cz, reach));
        }
        const V g2 = hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
        const V unit = hn::Div(hn::Set(d, -1.0F), hn::Sqrt(hn::Max(g2, hn::Set(d, 1e-30F))));
        hn::StoreU(x, d, points.x.data() + n);
        hn::StoreU(y, d, points.y.data() + n);
        hn::StoreU(z, d, points.z.data() + n);
        hn::StoreU(hn::Mul(gx, unit), d, points.nx.data() + n);
        hn::StoreU(hn::Mul(gy, unit), d, points.ny.data() + n);
        hn::StoreU(hn::Mul(gz, unit), d, points.nz.data() + n);
        hn::StoreU(hn::Div(sqrt_w, best_scale), d, points.radius.data() + n);
        hn::StoreU(best_segment, di, points.segment.data() + n);
    }
}

// Lower and upper bounds of the kernels of up to Lanes(d) segments over a ball, lanes = segments.
Bounds Cull(const ConvolutionField& field, const CullingArrays& culling, const std::uint32_t* list, std::size_t count,
            glm::vec3 centre, float ball_radius, std::uint32_t* HWY_RESTRICT kept, std::size_t& kept_count) {
    const D d;
    const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const SegmentArrays& s = field.segments();
    const V sqrt_w = hn::Set(d, static_cast<float>(field.kernel().sqrt_w));
    const V ball = hn::Set(d, ball_radius);
    const V zero = hn::Zero(d);
    V lower = zero;
    V upper = zero;
    kept_count = 0;
    HWY_ALIGN std::int32_t index_buffer[HWY_MAX_BYTES / 4];
    for (std::size_t m = 0; m < count; m += lanes) {
        const std::size_t valid = HWY_MIN(lanes, count - m);
        for (std::size_t lane = 0; lane < lanes; ++lane)
            index_buffer[lane] = static_cast<std::int32_t>(list[m + HWY_MIN(lane, valid - 1)]);
        const auto index = hn::Load(di, index_buffer);
        const M present = hn::FirstN(d, valid);
        Segment segment;
        segment.ux = hn::GatherIndex(d, s.ux.data(), index);
        segment.uy = hn::GatherIndex(d, s.uy.data(), index);
        segment.uz = hn::GatherIndex(d, s.uz.data(), index);
        segment.length = hn::GatherIndex(d, s.length.data(), index);
        segment.radius = hn::GatherIndex(d, s.radius.data(), index);
        segment.slope = hn::GatherIndex(d, s.slope.data(), index);
        const V px = hn::Sub(hn::Set(d, centre.x), hn::GatherIndex(d, culling.ax.data(), index));
        const V py = hn::Sub(hn::Set(d, centre.y), hn::GatherIndex(d, culling.ay.data(), index));
        const V pz = hn::Sub(hn::Set(d, centre.z), hn::GatherIndex(d, culling.az.data(), index));
        const V t = hn::MulAdd(pz, segment.uz, hn::MulAdd(py, segment.uy, hn::Mul(px, segment.ux)));
        const V qx = hn::NegMulAdd(t, segment.ux, px);
        const V qy = hn::NegMulAdd(t, segment.uy, py);
        const V qz = hn::NegMulAdd(t, segment.uz, pz);
        const V off_axis = hn::Sqrt(hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx))));
        const V clamped = hn::Max(hn::Min(t, segment.length), zero);
        const V beyond = hn::Sub(t, clamped);
        const V distance = hn::Sqrt(hn::MulAdd(beyond, beyond, hn::Mul(off_axis, off_axis)));
        // Radii that any point of the ball may see.
        const V t_low = hn::Sub(t, ball);
        const V t_high = hn::Add(t, ball);
        const V r1 = hn::MulAdd(segment.slope, hn::Max(hn::Min(t_low, segment.length), zero), segment.radius);
        const V r2 = hn::MulAdd(segment.slope, hn::Max(hn::Min(t_high, segment.length), zero), segment.radius);
        const V fine = hn::Div(sqrt_w, hn::Min(r1, r2));
        const V coarse = hn::Div(sqrt_w, hn::Max(r1, r2));
        const V nearest = hn::Mul(hn::Max(hn::Sub(distance, ball), zero), coarse);
        // The margin covers the rounding of single precision far from the origin.
        const M reaches =
            hn::And(present, hn::Lt(hn::Mul(nearest, nearest), hn::Set(d, static_cast<float>(kFadeEnd * 1.001))));
        HWY_ALIGN std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, reaches, bits);
        for (std::size_t lane = 0; lane < valid; ++lane)
            if (bits[lane / 8] >> (lane % 8) & 1) kept[kept_count++] = list[m + lane];
        if (hn::AllFalse(d, reaches)) continue;

        const V limit = hn::Set(d, 40.0F);
        const V half = hn::Set(d, 0.5F);
        const V q_min = hn::Mul(hn::Max(hn::Sub(off_axis, ball), zero), coarse);
        const V q_max = hn::Mul(hn::Add(off_axis, ball), fine);
        const V e_max = hn::Mul(hn::Add(hn::Abs(beyond), ball), fine);
        const V gauss_upper = exp_negative(d, hn::Min(hn::Mul(q_min, q_min), limit));
        const V gauss_lower = hn::Mul(exp_negative(d, hn::Min(hn::Mul(q_max, q_max), limit)),
                                      fade(d, hn::MulAdd(e_max, e_max, hn::Mul(q_max, q_max))));
        // The end filter is highest nearest to the segment's middle, lowest farthest from it; erf grows with its
        // argument, so each term takes the radius that bounds it.
        const V middle = hn::Mul(half, segment.length);
        const V t_best = hn::Max(hn::Min(middle, t_high), t_low);
        const V t_worst = hn::IfThenElse(hn::Gt(t, middle), t_high, t_low);
        const auto term_upper = [&](V v) {
            return error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), fine, coarse)));
        };
        const auto term_lower = [&](V v) {
            return error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), coarse, fine)));
        };
        const V filter_upper = hn::Mul(half, hn::Add(term_upper(t_best), term_upper(hn::Sub(segment.length, t_best))));
        const V filter_lower =
            hn::Max(zero, hn::Mul(half, hn::Add(term_lower(t_worst), term_lower(hn::Sub(segment.length, t_worst)))));
        upper = hn::Add(upper, hn::IfThenElseZero(reaches, hn::Mul(gauss_upper, filter_upper)));
        lower = hn::Add(lower, hn::IfThenElseZero(reaches, hn::Mul(gauss_lower, filter_lower)));
    }
    return {hn::GetLane(hn::SumOfLanes(d, lower)), hn::GetLane(hn::SumOfLanes(d, upper))};
}

const char* Name() { return hwy::TargetName(HWY_TARGET); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(SampleGrid);
HWY_EXPORT(SampleLattice);
HWY_EXPORT(Project);
HWY_EXPORT(Cull);
HWY_EXPORT(Name);

std::array<std::uint64_t, 2> sample_grid(const ConvolutionField& field, std::span<const std::uint32_t> list,
                                         const GridAxes& axes, std::span<float, kGridStride> values) {
    std::array<std::uint64_t, 2> inside{};
    HWY_DYNAMIC_DISPATCH(SampleGrid)(field, list.data(), list.size(), axes, values.data(), inside.data());
    return inside;
}

void sample_lattice(const ConvolutionField& field, std::span<const std::uint32_t> list, const LatticeAxes& axes,
                    std::span<const LatticePoint> points, std::span<float> values) {
    if (points.empty()) return;
    HWY_DYNAMIC_DISPATCH(SampleLattice)
    (field, list.data(), list.size(), axes, points.data(), points.size(), values.data());
}

void Projection::grow(std::size_t capacity) {
    for (auto* array : {&x, &y, &z, &cx, &cy, &cz, &reach, &nx, &ny, &nz, &radius}) array->resize(capacity);
    segment.resize(capacity);
}

std::uint64_t project(const ConvolutionField& field, std::span<const std::uint32_t> list, Projection& points) {
    const std::size_t count = points.size();
    if (count == 0 || list.empty()) return 0;
    constexpr std::size_t kLanes = 16; // the widest vector there is
    const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    if (points.x.size() < padded) points.grow(padded);
    for (auto* array : {&points.x, &points.y, &points.z, &points.cx, &points.cy, &points.cz, &points.reach})
        std::fill(array->begin() + static_cast<std::ptrdiff_t>(count),
                  array->begin() + static_cast<std::ptrdiff_t>(padded), (*array)[count - 1]);
    const SegmentArrays& s = field.segments();
    points.local.resize(3 * list.size());
    for (std::size_t m = 0; m < list.size(); ++m) {
        points.local[m] = static_cast<float>(s.ax[list[m]] - points.origin.x);
        points.local[list.size() + m] = static_cast<float>(s.ay[list[m]] - points.origin.y);
        points.local[2 * list.size() + m] = static_cast<float>(s.az[list[m]] - points.origin.z);
    }
    HWY_DYNAMIC_DISPATCH(Project)(field, list.data(), list.size(), points);
    return static_cast<std::uint64_t>(kProjectionSteps) * count * list.size();
}

CullingArrays::CullingArrays(const ConvolutionField& field) : origin(0.5 * (field.lower() + field.upper())) {
    const SegmentArrays& s = field.segments();
    for (std::size_t i = 0; i < s.size(); ++i) {
        ax.push_back(static_cast<float>(s.ax[i] - origin.x));
        ay.push_back(static_cast<float>(s.ay[i] - origin.y));
        az.push_back(static_cast<float>(s.az[i] - origin.z));
    }
}

Bounds cull(const ConvolutionField& field, const CullingArrays& culling, std::span<const std::uint32_t> list,
            glm::vec3 centre, float ball_radius, std::vector<std::uint32_t>& kept) {
    kept.resize(list.size());
    if (list.empty()) return {};
    std::size_t count = 0;
    const Bounds bounds =
        HWY_DYNAMIC_DISPATCH(Cull)(field, culling, list.data(), list.size(), centre, ball_radius, kept.data(), count);
    kept.resize(count);
    return bounds;
}

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(Name)(); }

} // namespace ramus::field
#endif
