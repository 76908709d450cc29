// Projects points onto the surface of the plain sum of one kernel, and computes normal, local radius, strongest branch
// and dominance there. Vectorised over the points. Included once per instruction set.
#if defined(RAMUS_FIELD_PROJECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_PROJECTION_INL_H
#undef RAMUS_FIELD_PROJECTION_INL_H
#else
#define RAMUS_FIELD_PROJECTION_INL_H
#endif

#include "core/field/simd/math-inl.h"
#include "core/field/sum/reaching-inl.h"

#include <algorithm>
#include <glm/common.hpp>
#include <hwy/highway.h>
#include <span>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// One vector of points, and the field there.
template <class T> struct Points {
    using V = hn::Vec<T>;
    using VI = hn::Vec<hn::RebindToSigned<T>>;
    V x, y, z;
    V sum, gx, gy, gz;
    V best, best_scale; // of the strongest segment: its value, and the scale at its foot
    V best_excess;      // of the strongest segment: the tree's radius minus the kernel's, mm
    V share;            // the sum of the current branch
    V shares[3];        // the sums of the three strongest branches, descending
    VI branches[3];
};

// Ends a branch: inserts its sum into the three largest.
template <class T> HWY_INLINE void end_branch(Points<T>& p, std::int32_t branch) {
    const T d;
    const hn::RebindToSigned<T> di;
    auto share = p.share;
    auto id = hn::Set(di, branch);
    for (int rank = 0; rank < 3; ++rank) {
        const auto there = p.shares[rank];
        const auto id_there = p.branches[rank];
        const auto more = hn::RebindMask(di, hn::Gt(share, there));
        p.shares[rank] = hn::Max(share, there);
        p.branches[rank] = hn::IfThenElse(more, id, id_there);
        share = hn::Min(share, there);
        id = hn::IfThenElse(more, id_there, id);
    }
    p.share = hn::Zero(d);
}

// The tree's radius at the foot minus the kernel's, mm.
template <class T>
HWY_INLINE hn::Vec<T> excess_at(const LocalSegments& local, std::size_t segment, const Foot<1, T>& foot) {
    const T d;
    const auto t = hn::Max(hn::Min(foot.t.v[0], hn::Set(d, local.length[segment])), hn::Zero(d));
    return hn::MulAdd(hn::Set(d, local.excess_slope[segment]), t, hn::Set(d, local.excess[segment]));
}

// Adds up the field and its gradient at a vector of points.
template <class Profile, class T>
HWY_INLINE void evaluate(T d, const Profile& profile, const LocalSegments& local,
                         std::span<const std::int32_t> reaching, Points<T>& p) {
    const hn::RebindToSigned<T> di;
    using One = Pack<1, T>;
    const PackTag<1, T> one_vector;
    const One scale = set(one_vector, profile.scale), inverse_scale = set(one_vector, 1.0F / profile.scale);
    p.sum = p.gx = p.gy = p.gz = hn::Zero(d);
    p.best = hn::Set(d, -1.0F);
    p.best_scale = hn::Set(d, 1.0F);
    p.best_excess = hn::Zero(d);
    p.share = p.shares[0] = p.shares[1] = p.shares[2] = hn::Zero(d);
    p.branches[0] = p.branches[1] = p.branches[2] = hn::Set(di, local.branch[0]);
    // The list is ascending, so the segments of a branch are consecutive.
    std::int32_t branch = !reaching.empty() ? local.branch[static_cast<std::size_t>(reaching[0] >> 1)] : 0;
    for (std::size_t r = 0; r < reaching.size(); ++r) {
        const PackIndices at = pack_indices<1>(reaching.data() + r);
        const Segments one = broadcast<T>(local, at);
        const One ax = broadcast<T>(local.x, at), ay = broadcast<T>(local.y, at), az = broadcast<T>(local.z, at);
        const std::int32_t before = std::exchange(branch, local.branch[at.m[0]]);
        for_ends(at.near_ends, [&](auto near) {
            const Foot foot =
                find_foot<near.value>(one, scale, sub(One{p.x}, ax), sub(One{p.y}, ay), sub(One{p.z}, az));
            const KernelGradient g =
                profile.template gradient<near.value>(one, foot, growth_of(one, foot, inverse_scale));
            const auto value = g.value.v[0], radial = g.radial.v[0], axial = g.axial.v[0];
            p.sum = hn::Add(p.sum, value);
            p.gx = hn::MulAdd(radial, foot.qx.v[0], hn::MulAdd(axial, one.ux.v[0], p.gx));
            p.gy = hn::MulAdd(radial, foot.qy.v[0], hn::MulAdd(axial, one.uy.v[0], p.gy));
            p.gz = hn::MulAdd(radial, foot.qz.v[0], hn::MulAdd(axial, one.uz.v[0], p.gz));
            const auto stronger = hn::Gt(value, p.best);
            p.best = hn::IfThenElse(stronger, value, p.best);
            p.best_scale = hn::IfThenElse(stronger, foot.scale.v[0], p.best_scale);
            if (local.has_excess)
                p.best_excess = hn::IfThenElse(stronger, excess_at(local, at.m[0], foot), p.best_excess);
            if (branch != before) end_branch(p, before);
            p.share = hn::Add(p.share, value);
        });
    }
    end_branch(p, branch);
}

// One Newton step onto the surface, in the kernel's measure of the field. Returns the error before the step, in this
// measure.
template <class Profile, class T, class V = hn::Vec<T>>
HWY_INLINE V step(T d, const Profile& profile, Points<T>& p, const Projection& bounds, std::size_t n) {
    const NewtonStep<T> newton = profile.newton(d, p.sum);
    // The error of the approximate reciprocal is negligible compared with the error that is left after the step.
    const V g2 = hn::Max(hn::MulAdd(p.gz, p.gz, hn::MulAdd(p.gy, p.gy, hn::Mul(p.gx, p.gx))), hn::Set(d, 1e-30F));
    const V unit = hn::ApproximateReciprocalSqrt(g2);
    const V amount = hn::Mul(newton.per_gradient, unit); // mm
    // A step never exceeds the reach, since near the axis the gradient is small and its step too long.
    const V reach = hn::LoadU(d, bounds.reach.data() + n);
    const V move = hn::Mul(hn::Max(hn::Min(amount, reach), hn::Neg(reach)), unit);
    const auto moved = [&](V at, V gradient, const std::vector<float>& centre) {
        const V middle = hn::LoadU(d, centre.data() + n);
        return hn::Max(hn::Min(hn::MulAdd(move, gradient, at), hn::Add(middle, reach)), hn::Sub(middle, reach));
    };
    p.x = moved(p.x, p.gx, bounds.cx);
    p.y = moved(p.y, p.gy, bounds.cy);
    p.z = moved(p.z, p.gz, bounds.cz);
    return hn::Abs(newton.off);
}

// The box in which a vector of points may move.
template <class T> HWY_INLINE Box box_of(T d, const Projection& projection, std::size_t n) {
    const auto reach = hn::LoadU(d, projection.reach.data() + n);
    glm::vec3 low;
    glm::vec3 high;
    const auto range = [&](const std::vector<float>& centre, float& lowest, float& highest) {
        const auto middle = hn::LoadU(d, centre.data() + n);
        lowest = hn::GetLane(hn::MinOfLanes(d, hn::Sub(middle, reach)));
        highest = hn::GetLane(hn::MaxOfLanes(d, hn::Add(middle, reach)));
    };
    range(projection.cx, low.x, high.x);
    range(projection.cy, low.y, high.y);
    range(projection.cz, low.z, high.z);
    return {0.5F * (low + high), 0.5001F * (high - low)};
}

// Writes one whole vector of points; the next call overwrites lanes beyond the last point.
template <class T, class V = hn::Vec<T>>
HWY_INLINE void write(T d, const Points<T>& p, float scale, const glm::dvec3& origin, const SurfacePoints& to,
                      std::size_t at) {
    const hn::RebindToSigned<T> di;
#if HWY_TARGET == HWY_SCALAR
    const auto located = [&](V value, double corner) {
        return hn::Set(d, static_cast<float>(static_cast<double>(hn::GetLane(value)) + corner));
    };
#else
    // Adds the corner in double precision, since it may be far from the origin.
    const hn::Repartition<double, T> dd;
    const hn::Half<T> dh;
    const auto located = [&](V value, double corner) {
        const auto from = hn::Set(dd, corner);
        const auto lower = hn::Add(hn::PromoteTo(dd, hn::LowerHalf(dh, value)), from);
        const auto upper = hn::Add(hn::PromoteTo(dd, hn::UpperHalf(dh, value)), from);
        return hn::Combine(d, hn::DemoteTo(dh, upper), hn::DemoteTo(dh, lower));
    };
#endif
    hn::StoreInterleaved3(located(p.x, origin.x), located(p.y, origin.y), located(p.z, origin.z), d,
                          &to.positions[at].x);
    const V g2 = hn::MulAdd(p.gz, p.gz, hn::MulAdd(p.gy, p.gy, hn::Mul(p.gx, p.gx)));
    const V unit = hn::Neg(reciprocal_root(d, hn::Max(g2, hn::Set(d, 1e-30F))));
    hn::StoreInterleaved3(hn::Mul(p.gx, unit), hn::Mul(p.gy, unit), hn::Mul(p.gz, unit), d, &to.normals[at].x);
    hn::StoreU(hn::Add(hn::Div(hn::Set(d, scale), p.best_scale), p.best_excess), d, to.radii + at);
    hn::StoreU(p.branches[0], di, to.branches + at);
    const hn::Rebind<std::uint8_t, T> du8;
    const V tiny = hn::Set(d, 1e-30F);
    const V first = hn::Max(p.shares[0], tiny);
    const auto dominance = [&](V share) {
        const V ratio = hn::Mul(first, hn::ApproximateReciprocal(hn::Max(share, tiny)));
        const V scaled =
            hn::Mul(log2_of(d, ratio), hn::Set(d, static_cast<float>(kNaturalLog * 255.0 / kMostDominance)));
        return hn::DemoteTo(du8, hn::NearestInt(hn::Min(scaled, hn::Set(d, 255.0F))));
    };
    const auto rival = [&](int rank) { // 0 where the branch contributes nothing
        const auto there = hn::RebindMask(di, hn::Gt(p.shares[rank], hn::Zero(d)));
        return hn::DemoteTo(du8, hn::IfThenElseZero(there, hn::And(p.branches[rank], hn::Set(di, 255))));
    };
    hn::StoreInterleaved4(dominance(p.shares[1]), dominance(p.shares[2]), rival(1), rival(2), du8,
                          to.dominance[at].over.data());
}

// Projects the vector of points that begins at the n-th. `reaching`: the segments that reach them. Returns the number
// of kernels evaluated.
template <class Profile, class T>
HWY_INLINE std::uint64_t project_vector(T d, const Profile& profile, const LocalSegments& local,
                                        std::span<const std::int32_t> reaching, const Projection& guesses,
                                        std::size_t n, const SurfacePoints& to) {
    Points<T> p;
    p.x = hn::LoadU(d, guesses.x.data() + n);
    p.y = hn::LoadU(d, guesses.y.data() + n);
    p.z = hn::LoadU(d, guesses.z.data() + n);
    std::uint64_t steps = 0;
    for (bool more = true; more && steps < kProjectionSteps; ++steps) {
        evaluate(d, profile, local, reaching, p);
        more = !hn::AllTrue(d, hn::Lt(step(d, profile, p, guesses, n), hn::Set(d, Profile::kShortStep)));
    }
    write(d, p, profile.scale, local.axes.corner(), to, n);
    return steps * reaching.size() * hn::Lanes(d);
}

// There must be at least one point and one segment.
template <class Profile>
std::uint64_t project_onto_surface(const Profile& profile, LocalSegments& local, const Projection& guesses,
                                   const SurfacePoints& to) {
    const D wide;
    const Narrow narrow;
    const std::size_t lanes = hn::Lanes(wide);
    const std::size_t size = guesses.size();
    std::uint64_t kernels = 0;
    const auto part = [&](std::size_t box, std::size_t count) {
        return std::span<const std::int32_t>(local.reaching_part(box), count);
    };
    // A narrow vector costs half, so it is used for the last one if the points fit.
    const auto last = [&](std::size_t n, std::span<const std::int32_t> reaching) {
        kernels += size - n <= hn::Lanes(narrow) ? project_vector(narrow, profile, local, reaching, guesses, n, to)
                                                 : project_vector(wide, profile, local, reaching, guesses, n, to);
    };
    std::size_t n = 0;
    for (; n + lanes < size; n += 2 * lanes) {
        std::size_t count[2];
        find_reaching(local, {box_of(wide, guesses, n), box_of(wide, guesses, n + lanes)}, count);
        kernels += project_vector(wide, profile, local, part(0, count[0]), guesses, n, to);
        last(n + lanes, part(1, count[1]));
    }
    if (n < size) {
        std::size_t count[1];
        find_reaching(local, {box_of(wide, guesses, n)}, count);
        last(n, part(0, count[0]));
    }
    return kernels;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
