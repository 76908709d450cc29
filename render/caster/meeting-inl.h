// Where rays through a block's pixels meet a round cone. Included once per instruction set.
#if defined(RAMUS_CASTER_MEETING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_MEETING_INL_H
#undef RAMUS_CASTER_MEETING_INL_H
#else
#define RAMUS_CASTER_MEETING_INL_H
#endif

#include "render/caster/normals-inl.h"
#include "render/caster/pair-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Through a block's pixels. A place on a ray is (x, y, 1) times its depth when perspective, (x, y, depth) when flat:
// ways along rays are depths. `Vec`: V or Pair.
template <class Vec> struct Rays { Vec x, y; };

// Places of a block's pixels in it.
alignas(64) constexpr float kColumn[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kRow[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// Of a place in each of the pixels from `lane` on, in the block whose lower left pixel is (x, y).
HWY_INLINE Rays<V> rays_at(const View& view, float x, float y, int lane, float right, float up) {
    const V scale = set(view.mm_a_pixel);
    const V px = hn::Add(hn::Load(D(), kColumn + lane), set(x + right - view.centre_x));
    const V py = hn::Add(hn::Load(D(), kRow + lane), set(y + up - view.centre_y));
    return {hn::Mul(px, scale), hn::Mul(py, scale)};
}
HWY_INLINE Rays<V> rays_of(const View& view, float x, float y, int lane, int sample) {
    return rays_at(view, x, y, lane, kSampleX[sample], kSampleY[sample]);
}

HWY_INLINE V3 place_on(const View& view, const Rays<V>& rays, V depth) {
    if (view.flat) return {rays.x, rays.y, depth};
    return {hn::Mul(rays.x, depth), hn::Mul(rays.y, depth), depth};
}

template <class Vec, class Mask> struct Meeting {
    Mask there;
    Vec depth; // where the ray goes in
    Vec out;   // and where it comes out; only if asked for
    Vec s;     // along the cone, 0 to 1
    Mask on_side;
    Vec off_x, off_y, off_z; // from the axis at s to the place: not yet the normal
};

// Ways to a ball and out of it, where they are nearer and farther than those found. As seen from the ray's start, with
// the ray's squared length and its inverse: (start - centre) . ray, and |start - centre|^2 - radius^2.
template <bool Out, class Vec>
HWY_INLINE void meet_ball(Vec middle, Vec squared, Vec ray2, Vec inverse_ray2, Vec end, Vec& in, Vec& out, Vec& s) {
    const Vec inside = MulSub(middle, middle, Mul(squared, ray2));
    const auto hit = Gt(inside, Splat<Vec>(0.0F));
    const Vec root = root_of(Max(inside, Splat<Vec>(1e-30F)));
    const Vec way = Mul(Neg(Add(middle, root)), inverse_ray2);
    const auto nearer = And(hit, Lt(way, in));
    in = IfThenElse(nearer, way, in);
    s = IfThenElse(nearer, end, s);
    if constexpr (Out) out = IfThenElse(hit, Max(out, Mul(Sub(root, middle), inverse_ray2)), out);
}

// `Out`: with the way out, for what is seen through.
template <bool Flat, bool Out, class Vec> HWY_INLINE auto meet(const Cone& cone, const Rays<Vec>& rays) {
    const auto S = [](float x) { return Splat<Vec>(x); };
    const Vec zero = S(0.0F), one = S(1.0F);
    // From the depth of the cone's middle: small numbers.
    const float start = cone.middle_depth, z = start - cone.from[2];
    const Vec off_x = Flat ? Sub(rays.x, S(cone.from[0])) : MulSub(rays.x, S(start), S(cone.from[0]));
    const Vec off_y = Flat ? Sub(rays.y, S(cone.from[1])) : MulSub(rays.y, S(start), S(cone.from[1]));
    const Vec ax = S(cone.axis[0]), ay = S(cone.axis[1]), az = S(cone.axis[2]), off_z = S(z);
    const Vec ray2 = Flat ? one : MulAdd(rays.x, rays.x, MulAdd(rays.y, rays.y, one));
    const Vec slope = Flat ? az : MulAdd(rays.x, ax, MulAdd(rays.y, ay, az));
    const Vec to_ray = Flat ? off_z : MulAdd(rays.x, off_x, MulAdd(rays.y, off_y, off_z));
    const Vec along = MulAdd(off_x, ax, MulAdd(off_y, ay, S(z * cone.axis[2])));
    const Vec squared = MulAdd(off_x, off_x, MulAdd(off_y, off_y, S(z * z)));
    const Vec shrunk = S(cone.shrunk);
    const Vec a = Sub(squared, S(cone.first_radius * cone.first_radius));
    const Vec b = Add(along, S(cone.first_radius * cone.growth));
    const Vec q2 = NegMulAdd(slope, slope, Mul(shrunk, ray2));
    const Vec q1 = MulSub(shrunk, to_ray, Mul(b, slope));
    const Vec q0 = MulSub(shrunk, a, Mul(b, b));
    const Vec inside = MulSub(q1, q1, Mul(q2, q0));
    const auto tapers = And(Gt(q2, zero), Gt(shrunk, zero)), real = And(Gt(inside, zero), tapers);
    const Vec root = root_of(Max(inside, S(1e-30F))), inverse = inverse_of(q2);
    const Vec way = Mul(Neg(Add(q1, root)), inverse);
    const Vec s = Mul(MulAdd(way, slope, b), S(cone.inverse_shrunk));
    const auto on_side = And(real, And(Ge(s, zero), Le(s, one)));
    Vec in = IfThenElse(on_side, way, S(kNothing)), out = S(-kNothing), at = s;
    if constexpr (Out) {
        const Vec leaving = Mul(Sub(root, q1), inverse);
        const Vec s_out = Mul(MulAdd(leaving, slope, b), S(cone.inverse_shrunk));
        out = IfThenElse(And(real, And(Ge(s_out, zero), Le(s_out, one))), leaving, out);
    }
    // The cone that the side goes on in holds both balls: who misses it misses them.
    const auto may_meet_balls = Out ? Or(real, Not(tapers)) : AndNot(on_side, Or(real, Not(tapers)));
    if (!None(may_meet_balls)) {
        const Vec inverse_ray2 = Flat ? one : inverse_of(ray2);
        Vec nearest = in;
        if (Out || !cone.follows) meet_ball<Out, Vec>(to_ray, a, ray2, inverse_ray2, zero, nearest, out, at);
        const Vec last = Add(NegMulAdd(S(2.0F), along, squared), S(cone.squared - cone.last_radius * cone.last_radius));
        meet_ball<Out, Vec>(Sub(to_ray, slope), last, ray2, inverse_ray2, one, nearest, out, at);
        // Where the side is met, a ball that is met before it can only be so by rounding.
        in = IfThenElse(on_side, in, nearest);
        at = IfThenElse(on_side, s, at);
    }
    const Vec x = Flat ? off_x : MulAdd(in, rays.x, off_x), y = Flat ? off_y : MulAdd(in, rays.y, off_y);
    return Meeting<Vec, decltype(on_side)>{Lt(in, S(0.5F * kNothing)),
                                           Add(in, S(start)),
                                           Add(out, S(start)),
                                           at,
                                           on_side,
                                           NegMulAdd(at, ax, x),
                                           NegMulAdd(at, ay, y),
                                           NegMulAdd(at, az, Add(in, off_z))};
}

// Upright on the vessel's own way rather than on the segment's: the eye sees no joints. Y up, z towards the eye; not of
// unit length.
template <class Vec> struct Normal { Vec x, y, z; };
template <class Vec, class Mask> HWY_INLINE Normal<Vec> normal_at(const Cone& cone, const Meeting<Vec, Mask>& found) {
    const auto between = [&](int i) {
        return MulAdd(found.s, Splat<Vec>(cone.to_way[i] - cone.from_way[i]), Splat<Vec>(cone.from_way[i]));
    };
    const Vec wx = between(0), wy = between(1), wz = between(2);
    const auto straightened = Or(found.on_side, Gt(between(3), Splat<Vec>(0.5F)));
    const Vec along =
        IfThenElseZero(straightened, MulAdd(found.off_x, wx, MulAdd(found.off_y, wy, Mul(found.off_z, wz))));
    return {NegMulAdd(along, wx, found.off_x), NegMulAdd(along, wy, found.off_y), MulSub(along, wz, found.off_z)};
}

// Which way the cone faces a ray that may pass it by, closely: as it does where the ray comes nearest. In the resting
// picture the samples of a pixel share their triangle's normal at the pixel's middle, wherever that lies.
template <bool Flat> HWY_INLINE V3 facing(const Cone& cone, const Rays<V>& rays) {
    const V zero = hn::Zero(D()), one = set(1.0F), tiny = set(1e-30F);
    const float start = cone.middle_depth, z = start - cone.from[2];
    const V off_x = Flat ? hn::Sub(rays.x, set(cone.from[0])) : hn::MulSub(rays.x, set(start), set(cone.from[0]));
    const V off_y = Flat ? hn::Sub(rays.y, set(cone.from[1])) : hn::MulSub(rays.y, set(start), set(cone.from[1]));
    const V off_z = set(z);
    const V3 axis = set(cone.axis), off{off_x, off_y, off_z};
    const V3 ray{Flat ? zero : rays.x, Flat ? zero : rays.y, one};
    const V ray2 = dot(ray, ray), slope = dot(ray, axis), to_ray = dot(ray, off), along = dot(off, axis);
    const V squared = dot(off, off), shrunk = set(cone.shrunk);
    const V a = hn::Sub(squared, set(cone.first_radius * cone.first_radius));
    const V b = hn::Add(along, set(cone.first_radius * cone.growth));
    const V q2 = hn::Max(hn::NegMulAdd(slope, slope, hn::Mul(shrunk, ray2)), tiny);
    const V q1 = hn::MulSub(shrunk, to_ray, hn::Mul(b, slope));
    const V q0 = hn::MulSub(shrunk, a, hn::Mul(b, b));
    const V root = root_of(hn::Max(hn::MulSub(q1, q1, hn::Mul(q2, q0)), tiny));
    const V side = hn::Mul(hn::Neg(hn::Add(q1, root)), inverse_of(q2));
    const V s = hn::Mul(hn::MulAdd(side, slope, b), set(cone.inverse_shrunk));
    // Beyond an end, the ball there.
    const M tapers = hn::And(hn::Gt(q2, tiny), hn::Gt(shrunk, zero));
    const M last = hn::Or(hn::And(tapers, hn::Gt(s, one)), hn::AndNot(tapers, hn::Lt(slope, zero))),
            on_side = hn::And(tapers, hn::And(hn::Ge(s, zero), hn::Le(s, one)));
    const V end = hn::IfThenElseZero(last, one);
    const V middle = hn::NegMulAdd(end, slope, to_ray);
    const V last_a =
        hn::Add(hn::NegMulAdd(set(2.0F), along, squared), set(cone.squared - cone.last_radius * cone.last_radius));
    const V inside = hn::NegMulAdd(hn::IfThenElse(last, last_a, a), ray2, hn::Mul(middle, middle));
    const V ball = hn::Mul(hn::Neg(hn::Add(middle, root_of(hn::Max(inside, tiny)))), inverse_of(ray2));
    const V way = hn::IfThenElse(on_side, side, ball), at = hn::IfThenElse(on_side, s, end);
    const V3 place = off + way * ray - at * axis;
    const Normal<V> normal = normal_at(cone, Meeting<V, M>{on_side, way, way, at, on_side, place.x, place.y, place.z});
    return {normal.x, normal.y, normal.z};
}

// Whether the cone may come into the block whose middle is (x, y), before `farthest`.
HWY_INLINE bool reaches(const Cone& cone, float x, float y, float farthest) {
    constexpr float kHalf = 0.5F * kBlock;
    if (cone.nearest >= farthest) return false;
    const float px = x - cone.pixel[0], py = y - cone.pixel[1], wx = cone.way[0], wy = cone.way[1];
    if (cone.length <= 0.0F) {
        const float most = cone.reach + 1.4143F * kHalf;
        return px * px + py * py <= most * most;
    }
    // Half of the block as it is seen along the cone, and across: a square is the same both ways.
    const float half = kHalf * (__builtin_fabsf(wx) + __builtin_fabsf(wy)), beside = cone.reach + half;
    const float along = px * wx + py * wy, across = __builtin_fabsf(px * wy - py * wx);
    if (across > beside || along < -beside || along > cone.length + beside) return false;
    // The part of its axis that may be seen there: depths are even in the picture when flat, else their inverse is.
    const float from = along - beside, to = along + beside, scale = 1.0F / cone.length;
    const float t0 = from <= 0.0F ? 0.0F : from * scale, t1 = to >= cone.length ? 1.0F : to * scale;
    const float d0 = cone.depth[0] + t0 * cone.depth[1], d1 = cone.depth[0] + t1 * cone.depth[1];
    if (cone.depth[2] > 0.0F) { // flat
        const float nearest = (d0 < d1 ? d0 : d1) - cone.widest;
        return nearest < farthest;
    }
    return (d0 > d1 ? d0 : d1) * (farthest + cone.widest) > 1.0F;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
