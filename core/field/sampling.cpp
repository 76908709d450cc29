#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/sampling.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/kernel-inl.h"
#include "core/field/sampling.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/vec3.hpp>
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

// Coordinates along one axis, seen from a segment's start. Rounded once from double precision: the same lattice point
// gives the same float in every brick.
template <std::size_t N>
HWY_INLINE void subtract(const std::array<double, N>& axis, double start, float* HWY_RESTRICT out) {
    const hn::CappedTag<double, 8> dd;
    const hn::Rebind<float, decltype(dd)> df;
    const auto from = hn::Set(dd, start);
    static_assert(N % 8 == 0);
    for (std::size_t n = 0; n < N; n += hn::Lanes(dd))
        hn::StoreU(hn::DemoteTo(df, hn::Sub(hn::LoadU(dd, axis.data() + n), from)), df, out + n);
}

#if HWY_MAX_BYTES >= 32
// The same as a table in a register: of a grid's few coordinates.
HWY_INLINE V subtracted(D d, const std::array<double, 8>& axis, double start) {
#if HWY_MAX_BYTES >= 64
    const hn::CappedTag<double, 8> dd;
    const hn::Rebind<float, decltype(dd)> df;
    return hn::ZeroExtendVector(d, hn::DemoteTo(df, hn::Sub(hn::LoadU(dd, axis.data()), hn::Set(dd, start))));
#else
    alignas(32) float table[8];
    subtract(axis, start, table);
    return hn::Load(d, table);
#endif
}
#endif

// A box of points: the middle and half the edges.
template <std::size_t N>
HWY_INLINE void find_box(const std::array<double, N>& x, const std::array<double, N>& y, const std::array<double, N>& z,
                         std::size_t last, glm::dvec3& middle, glm::vec3& half) {
    middle = 0.5 * (glm::dvec3(x[0], y[0], z[0]) + glm::dvec3(x[last], y[last], z[last]));
    half = glm::vec3(glm::dvec3(x[last], y[last], z[last]) - middle);
}

// What the kernel of one segment needs at a batch of points, between the two passes over them: the first finds out
// which vectors of points are inside the support, the second sums the kernel there. Two passes leave no branch in
// either that depends on the points, so that vectors overlap in the pipeline.
constexpr std::size_t kBatch = 128;
constexpr std::size_t kGroup = HWY_MAX_BYTES >= 16 ? HWY_MAX_BYTES / sizeof(float) : 4; // points for each bit
static_assert(kBatch / kGroup <= 32);
struct Feet {
    alignas(64) float q[kBatch], rho[kBatch];
    alignas(64) float a[kBatch], b[kBatch]; // scaled axial distances from the start and to the end
};

// First pass at one vector of points; 1 when some point is inside the support.
template <Ends Near>
HWY_INLINE std::uint32_t keep_foot(D d, const Segment& segment, V sqrt_w, V px, V py, V pz, std::size_t n, Feet& feet) {
    const Foot foot = find_foot(d, segment, sqrt_w, px, py, pz);
    hn::Store(foot.q, d, feet.q + n);
    hn::Store(foot.rho, d, feet.rho + n);
    if constexpr (near_start(Near)) hn::Store(hn::Mul(foot.t, foot.scale), d, feet.a + n);
    if constexpr (near_end(Near)) hn::Store(hn::Mul(hn::Sub(segment.length, foot.t), foot.scale), d, feet.b + n);
    return hn::AllFalse(d, inside_support(d, foot.rho)) ? 0 : 1;
}

// Second pass, over the groups of points that have their bits set.
template <Ends Near>
HWY_INLINE void add_kernels(D d, const Feet& feet, std::uint32_t groups, float* HWY_RESTRICT sums) {
    const V saturated = error_function(d, hn::Set(d, kErrorFunctionEnd));
    for (; groups != 0; groups &= groups - 1) {
        const std::size_t first = static_cast<std::size_t>(std::countr_zero(groups)) * kGroup;
        for (std::size_t n = first; n < first + kGroup; n += hn::Lanes(d)) {
            const V body = hn::Mul(exp_negative(d, hn::Min(hn::Load(d, feet.q + n), hn::Set(d, 40.0F))),
                                   fade(d, hn::Load(d, feet.rho + n)));
            V filter = saturated;
            if constexpr (Near != Ends::kNone) {
                const V from_start = near_start(Near) ? error_function(d, hn::Load(d, feet.a + n)) : saturated;
                const V to_end = near_end(Near) ? error_function(d, hn::Load(d, feet.b + n)) : saturated;
                filter = hn::Mul(hn::Set(d, 0.5F), hn::Add(from_start, to_end));
            }
            hn::Store(hn::MulAdd(body, filter, hn::Load(d, sums + n)), d, sums + n);
        }
    }
}

void SampleGrid(const ConvolutionField& field, const std::uint32_t* list, std::size_t count, const GridAxes& axes,
                float* HWY_RESTRICT values, std::uint64_t* HWY_RESTRICT inside) {
    const D d;
    [[maybe_unused]] const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const auto root = static_cast<float>(field.kernel().sqrt_w);
    const V sqrt_w = hn::Set(d, root);
    const FieldSegment* segments = field.segments().data();
    glm::dvec3 middle;
    glm::vec3 half;
    find_box(axes.x, axes.y, axes.z, kGridSide - 1, middle, half);
    static_assert(kGridStride == kBatch);
    for (std::size_t n = 0; n < kGridStride; n += lanes) hn::Store(hn::Zero(d), d, values + n);
    Feet feet;
    for (std::size_t m = 0; m < count; ++m) {
        const FieldSegment& s = segments[list[m]];
        const Segment segment = broadcast(d, s);
        const Ends near = ends_near(s, root, glm::vec3(middle - glm::dvec3(s.ax, s.ay, s.az)), half);
#if HWY_MAX_BYTES >= 32
        const V x = subtracted(d, axes.x, s.ax);
        const V y = subtracted(d, axes.y, s.ay);
        const V z = subtracted(d, axes.z, s.az);
        const auto place = [&](V table, const std::int32_t* index) {
            return hn::TableLookupLanes(table, hn::SetTableIndices(d, index));
        };
#else
        float x[8], y[8], z[8];
        subtract(axes.x, s.ax, x);
        subtract(axes.y, s.ay, y);
        subtract(axes.z, s.az, z);
        const auto place = [&](const float* table, const std::int32_t* index) {
            return hn::GatherIndex(d, table, hn::Load(di, index));
        };
#endif
        for_ends(near, [&](auto ends) {
            std::uint32_t wanted = 0;
            for (std::size_t n = 0; n < kGridStride; n += lanes) {
                wanted |= keep_foot<ends.value>(d, segment, sqrt_w, place(x, kGridLanes.i + n),
                                                place(y, kGridLanes.j + n), place(z, kGridLanes.k + n), n, feet)
                          << (n / kGroup);
            }
            add_kernels<ends.value>(d, feet, wanted, values);
        });
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
    const auto root = static_cast<float>(field.kernel().sqrt_w);
    const V sqrt_w = hn::Set(d, root);
    const FieldSegment* segments = field.segments().data();
    glm::dvec3 middle;
    glm::vec3 half;
    find_box(axes.x, axes.y, axes.z, kLatticeSide - 1, middle, half);
    Feet feet;
    for (std::size_t first = 0; first < point_count; first += kBatch) {
        const std::size_t n_points = HWY_MIN(kBatch, point_count - first);
        const std::size_t n_padded = (n_points + kGroup - 1) / kGroup * kGroup;
        alignas(64) std::int32_t pi[kBatch], pj[kBatch], pk[kBatch];
        alignas(64) float sum[kBatch];
        for (std::size_t n = 0; n < n_padded; ++n) {
            const LatticePoint p = points[first + HWY_MIN(n, n_points - 1)];
            pi[n] = p.i, pj[n] = p.j, pk[n] = p.k;
            sum[n] = 0.0F;
        }
        for (std::size_t m = 0; m < count; ++m) {
            const FieldSegment& s = segments[list[m]];
            const Segment segment = broadcast(d, s);
            const Ends near = ends_near(s, root, glm::vec3(middle - glm::dvec3(s.ax, s.ay, s.az)), half);
            alignas(64) float x[kLatticeStride], y[kLatticeStride], z[kLatticeStride];
            subtract(axes.x, s.ax, x);
            subtract(axes.y, s.ay, y);
            subtract(axes.z, s.az, z);
            for_ends(near, [&](auto ends) {
                std::uint32_t wanted = 0;
                for (std::size_t n = 0; n < n_padded; n += lanes)
                    wanted |= keep_foot<ends.value>(d, segment, sqrt_w, hn::GatherIndex(d, x, hn::Load(di, pi + n)),
                                                    hn::GatherIndex(d, y, hn::Load(di, pj + n)),
                                                    hn::GatherIndex(d, z, hn::Load(di, pk + n)), n, feet)
                              << (n / kGroup);
                add_kernels<ends.value>(d, feet, wanted, sum);
            });
        }
        std::copy_n(sum, n_points, values + first);
    }
}

const char* Name() { return hwy::TargetName(HWY_TARGET); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(SampleGrid);
HWY_EXPORT(SampleLattice);
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

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(Name)(); }

} // namespace ramus::field
#endif
