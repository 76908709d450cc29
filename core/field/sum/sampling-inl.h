// Values of the plain sum of one kernel at the grid points of a brick and at single lattice points, and depths from
// values. Within one instruction set a point's value has the same bits in every call, if the list contains all segments
// whose support contains the point, in ascending order. Included once per instruction set.
#if defined(RAMUS_FIELD_SAMPLING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_SAMPLING_INL_H
#undef RAMUS_FIELD_SAMPLING_INL_H
#else
#define RAMUS_FIELD_SAMPLING_INL_H
#endif

#include "core/field/sum/reaching-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <hwy/highway.h>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Grid coordinates of the points of every group.
struct GroupLanes {
    alignas(64) std::int32_t i[kGroups * kGroupPoints], j[kGroups * kGroupPoints], k[kGroups * kGroupPoints];
    constexpr GroupLanes() : i{}, j{}, k{} {
        constexpr int kLast = kGridSide - 1;
        for (int n = 0; n < 16; ++n) {
            for (int layer = 0; layer < 4; ++layer) put(16 * layer + n, n % 4, n / 4, layer);
            put(64 + n, kLast, n % 4, n / 4);
            put(80 + n, n % 4, kLast, n / 4);
            put(96 + n, n % 4, n / 4, kLast);
            put(112 + n, n / 4 == 0 ? n % 4 : kLast, n / 4 == 1 ? n % 4 : kLast, n / 4 == 2 ? n % 4 : kLast);
        }
    }

private:
    constexpr void put(int at, int x, int y, int z) { i[at] = x, j[at] = y, k[at] = z; }
};
constexpr GroupLanes kGroupLanes;

// The box around the points of each group, in cells.
struct GroupBox {
    glm::vec3 middle, half;
};
constexpr std::array<GroupBox, kGroups> kGroupBoxes{{
    {{1.5F, 1.5F, 0.0F}, {1.5F, 1.5F, 0.0F}},
    {{1.5F, 1.5F, 1.0F}, {1.5F, 1.5F, 0.0F}},
    {{1.5F, 1.5F, 2.0F}, {1.5F, 1.5F, 0.0F}},
    {{1.5F, 1.5F, 3.0F}, {1.5F, 1.5F, 0.0F}},
    {{4.0F, 1.5F, 1.5F}, {0.0F, 1.5F, 1.5F}},
    {{1.5F, 4.0F, 1.5F}, {1.5F, 0.0F, 1.5F}},
    {{1.5F, 1.5F, 4.0F}, {1.5F, 1.5F, 0.0F}},
    {{2.0F, 2.0F, 2.0F}, {2.0F, 2.0F, 2.0F}},
}};

// Looks up the coordinates of a vector of points in a segment's table.
HWY_INLINE V look_up(D d, const float* table, const std::int32_t* index) {
#if HWY_MAX_BYTES >= 32
    return hn::TableLookupLanes(hn::LoadU(d, table), hn::SetTableIndices(d, index));
#else
    return hn::GatherIndex(d, table, hn::Load(hn::RebindToSigned<D>(), index));
#endif
}

// Computes the values of one group from the segments that reach it.
template <class Profile>
HWY_INLINE void sample_group(const Profile& profile, const LocalSegments& local, std::size_t group,
                             std::span<const std::int32_t> reaching, GridGroups& samples) {
    const D d;
    const std::size_t lanes = hn::Lanes(d);
    const V isovalue = hn::Set(d, static_cast<float>(local.kernel->isovalue));
    std::uint32_t inside = 0;
    for (std::size_t n = 0; n < kGroupPoints; n += lanes) {
        const std::int32_t* i = kGroupLanes.i + kGroupPoints * group + n;
        const std::int32_t* j = kGroupLanes.j + kGroupPoints * group + n;
        const std::int32_t* k = kGroupLanes.k + kGroupPoints * group + n;
        V sum = hn::Zero(d);
        const auto add_pack = [&](auto width, std::size_t r) {
            constexpr std::size_t kPack = width.value;
            const PackIndices at = pack_indices<kPack>(reaching.data() + r);
            const Segments pack = broadcast(local, at);
            const auto coordinate = [&](std::size_t axis, const std::int32_t* index) {
                return each<kPack>([&](std::size_t s) {
                    return look_up(d, local.tables.data() + LocalSegments::kTableStride * at.m[s] + 8 * axis, index);
                });
            };
            for_ends(at.near_ends, [&](auto near) {
                const Foot foot = find_foot<near.value>(pack, set(PackTag<kPack>(), profile.scale), coordinate(0, i),
                                                        coordinate(1, j), coordinate(2, k));
                const Pack value = profile.template value<near.value>(pack, foot);
                for (const V& of : value.v) sum = hn::Add(sum, of);
            });
        };
        std::size_t r = 0;
        for (; r + 2 <= reaching.size(); r += 2) add_pack(std::integral_constant<std::size_t, 2>(), r);
        if (r < reaching.size()) add_pack(std::integral_constant<std::size_t, 1>(), r);
        hn::Store(sum, d, samples.value[group].data() + n);
        HWY_ALIGN std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Ge(sum, isovalue), bits);
        const std::uint32_t word = bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
        inside |= (word & ((std::uint32_t{1} << lanes) - 1)) << n;
    }
    samples.inside[group] = static_cast<std::uint16_t>(inside);
}

// Computes N groups, beginning with `first`. Returns the number of kernels evaluated.
template <std::size_t N, class Profile>
HWY_INLINE std::uint64_t sample_together(const Profile& profile, LocalSegments& local, std::size_t first,
                                         GridGroups& samples, Choice choice) {
    const auto cell = static_cast<float>(local.axes.x[1] - local.axes.x[0]);
    Box boxes[N];
    for (std::size_t n = 0; n < N; ++n)
        boxes[n] = {kGroupBoxes[first + n].middle * cell, kGroupBoxes[first + n].half * (cell * 1.0001F)};
    std::size_t count[N];
    if (choice == Choice::kReaching)
        find_reaching(local, boxes, count);
    else
        for (std::size_t n = 0; n < N; ++n) count[n] = list_all(local, local.reaching_part(n));
    std::uint64_t kernels = 0;
    for (std::size_t n = 0; n < N; ++n) {
        sample_group(profile, local, first + n, {local.reaching_part(n), count[n]}, samples);
        kernels += count[n] * kGroupPoints;
    }
    return kernels;
}

template <class Profile>
std::uint64_t sample_groups(const Profile& profile, LocalSegments& local, unsigned groups, GridGroups& samples,
                            Choice choice) {
    std::uint64_t kernels = 0;
    if ((groups & kOwnGroups) == kOwnGroups) {
        kernels += sample_together<4>(profile, local, 0, samples, choice);
        groups &= ~kOwnGroups;
    }
    for (; groups != 0; groups &= groups - 1)
        kernels +=
            sample_together<1>(profile, local, static_cast<std::size_t>(std::countr_zero(groups)), samples, choice);
    return kernels;
}

template <class Profile>
std::uint64_t sample_lattice(const Profile& profile, LocalSegments& local, const LatticeAxes& axes,
                             std::span<const LatticePoint> points, std::span<float> values) {
    const D d;
    const hn::RebindToSigned<D> di;
    const std::size_t lanes = hn::Lanes(d);
    const auto quarter = static_cast<float>(axes.x[1] - axes.x[0]);
    std::uint64_t kernels = 0;
    for (std::size_t first = 0; first < points.size(); first += kGroupPoints) {
        const std::size_t valid = HWY_MIN(kGroupPoints, points.size() - first);
        alignas(64) std::int32_t pi[kGroupPoints], pj[kGroupPoints], pk[kGroupPoints];
        alignas(64) float sum[kGroupPoints];
        glm::ivec3 low(kLatticeSide);
        glm::ivec3 high(0);
        for (std::size_t n = 0; n < kGroupPoints; ++n) {
            const LatticePoint p = points[first + HWY_MIN(n, valid - 1)];
            pi[n] = p.i, pj[n] = p.j, pk[n] = p.k;
            low = glm::min(low, glm::ivec3(p.i, p.j, p.k));
            high = glm::max(high, glm::ivec3(p.i, p.j, p.k));
            sum[n] = 0.0F;
        }
        const Box box{0.5F * quarter * glm::vec3(low + high), 0.5001F * quarter * glm::vec3(high - low)};
        std::size_t count[1];
        find_reaching(local, {box}, count);
        kernels += count[0] * kGroupPoints;
        for (std::size_t r = 0; r < count[0]; ++r) {
            const PackIndices at = pack_indices<1>(local.reaching_part(0) + r);
            const FieldSegment& segment = local.segments[local.list[at.m[0]]];
            alignas(64) float table[3][kLatticeStride];
            subtract(axes.x, segment.ax, table[0]);
            subtract(axes.y, segment.ay, table[1]);
            subtract(axes.z, segment.az, table[2]);
            const Segments one = broadcast(local, at);
            for_ends(at.near_ends, [&](auto near) {
                for (std::size_t n = 0; n < kGroupPoints; n += lanes) {
                    const auto coordinate = [&](std::size_t axis, const std::int32_t* index) {
                        return Pack<1>{hn::GatherIndex(d, table[axis], hn::Load(di, index + n))};
                    };
                    const Foot foot = find_foot<near.value>(one, set(PackTag<1>(), profile.scale), coordinate(0, pi),
                                                            coordinate(1, pj), coordinate(2, pk));
                    const Pack value = profile.template value<near.value>(one, foot);
                    hn::Store(hn::Add(hn::Load(d, sum + n), value.v[0]), d, sum + n);
                }
            });
        }
        std::copy_n(sum, valid, values.data() + first);
    }
    return kernels;
}

template <class Profile>
void find_depths(const Profile& profile, float isovalue, const GridValues& values, GridValues& depths) {
    const D d;
    const V iso = hn::Set(d, isovalue);
    const V surface = profile.rough_distance(d, iso);
    for (std::size_t n = 0; n < kGridStride; n += hn::Lanes(d)) {
        const V value = hn::Load(d, values.data() + n);
        const V inward = hn::Sub(surface, profile.rough_distance(d, value));
        const V inside = hn::Max(inward, hn::Zero(d));
        const V outside = hn::Min(inward, hn::Set(d, -1e-6F));
        hn::Store(hn::IfThenElse(hn::Ge(value, iso), inside, outside), d, depths.data() + n);
    }
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
