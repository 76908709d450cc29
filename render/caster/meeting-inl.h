// Where rays through a block's pixels meet a round cone. Included once per instruction set.
#if defined(RAMUS_CASTER_MEETING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_MEETING_INL_H
#undef RAMUS_CASTER_MEETING_INL_H
#else
#define RAMUS_CASTER_MEETING_INL_H
#endif

#include "render/caster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Through a block's pixels. A place on a ray is (x, y, 1) times its depth when perspective, (x, y, depth) when flat:
// ways along rays are depths.
struct Rays {
    V x, y;
};

HWY_INLINE Rays rays_through(const View& view, V x, V y) {
    const V scale = set(view.mm_a_pixel);
    return {hn::Mul(hn::Sub(x, set(view.centre_x)), scale), hn::Mul(hn::Sub(y, set(view.centre_y)), scale)};
}

struct Meeting {
    M there;
    V depth; // where the ray goes in
    V out;   // and where it comes out; only if asked for
    V s;     // along the cone, 0 to 1
    M on_side;
    V3 from_axis; // from the axis at s to the place: not yet the normal
};

// Ways to a ball and out of it, where they are nearer and farther than those found. As seen from the ray's start, with
// the ray's squared length and its inverse: (start - centre) . ray, and |start - centre|^2 - radius^2.
template <bool Out> HWY_INLINE void meet_ball(V middle, V squared, V ray2, V inverse_ray2, V end, V& in, V& out, V& s) {
    const V inside = hn::MulSub(middle, middle, hn::Mul(squared, ray2));
    const M hit = hn::Gt(inside, hn::Zero(D()));
    const V root = root_of(hn::Max(inside, set(1e-30F)));
    const V way = hn::Mul(hn::Neg(hn::Add(middle, root)), inverse_ray2);
    const M nearer = hn::And(hit, hn::Lt(way, in));
    in = hn::IfThenElse(nearer, way, in);
    s = hn::IfThenElse(nearer, end, s);
    if constexpr (Out) out = hn::IfThenElse(hit, hn::Max(out, hn::Mul(hn::Sub(root, middle), inverse_ray2)), out);
}

// `Out`: with the way out, for what is seen through.
template <bool Flat, bool Out> HWY_INLINE Meeting meet(const Cone& cone, const Rays& rays) {
    const V zero = hn::Zero(D()), one = set(1.0F);
    // From the depth of the cone's middle: small numbers.
    const float start = cone.middle_depth, off_z = start - cone.from[2];
    const V off_x = Flat ? hn::Sub(rays.x, set(cone.from[0])) : hn::MulSub(rays.x, set(start), set(cone.from[0]));
    const V off_y = Flat ? hn::Sub(rays.y, set(cone.from[1])) : hn::MulSub(rays.y, set(start), set(cone.from[1]));
    const V ax = set(cone.axis[0]), ay = set(cone.axis[1]), az = set(cone.axis[2]);
    const V ray2 = Flat ? one : hn::MulAdd(rays.x, rays.x, hn::MulAdd(rays.y, rays.y, one));
    const V slope = Flat ? az : hn::MulAdd(rays.x, ax, hn::MulAdd(rays.y, ay, az));
    const V to_ray = Flat ? set(off_z) : hn::MulAdd(rays.x, off_x, hn::MulAdd(rays.y, off_y, set(off_z)));
    const V along = hn::MulAdd(off_x, ax, hn::MulAdd(off_y, ay, set(off_z * cone.axis[2])));
    const V squared = hn::MulAdd(off_x, off_x, hn::MulAdd(off_y, off_y, set(off_z * off_z)));
    const V shrunk = set(cone.shrunk);
    const V a = hn::Sub(squared, set(cone.first_radius * cone.first_radius));
    const V b = hn::Add(along, set(cone.first_radius * cone.growth));
    const V q2 = hn::NegMulAdd(slope, slope, hn::Mul(shrunk, ray2));
    const V q1 = hn::MulSub(shrunk, to_ray, hn::Mul(b, slope));
    const V q0 = hn::MulSub(shrunk, a, hn::Mul(b, b));
    const V inside = hn::MulSub(q1, q1, hn::Mul(q2, q0));
    const M tapers = hn::And(hn::Gt(q2, zero), hn::Gt(shrunk, zero)), real = hn::And(hn::Gt(inside, zero), tapers);
    const V root = root_of(hn::Max(inside, set(1e-30F))), inverse = inverse_of(q2);
    const V way = hn::Mul(hn::Neg(hn::Add(q1, root)), inverse);
    const V s = hn::Mul(hn::MulAdd(way, slope, b), set(cone.inverse_shrunk));
    Meeting found;
    found.on_side = hn::And(real, hn::And(hn::Ge(s, zero), hn::Le(s, one)));
    V in = hn::IfThenElse(found.on_side, way, set(kNothing));
    found.s = s;
    found.out = set(-kNothing);
    if constexpr (Out) {
        const V leaving = hn::Mul(hn::Sub(root, q1), inverse);
        const V s_out = hn::Mul(hn::MulAdd(leaving, slope, b), set(cone.inverse_shrunk));
        const M by_side = hn::And(real, hn::And(hn::Ge(s_out, zero), hn::Le(s_out, one)));
        found.out = hn::IfThenElse(by_side, leaving, found.out);
    }
    // The cone that the side goes on in holds both balls: who misses it misses them.
    const M may_meet_balls =
        Out ? hn::Or(real, hn::Not(tapers)) : hn::AndNot(found.on_side, hn::Or(real, hn::Not(tapers)));
    if (!hn::AllFalse(D(), may_meet_balls)) {
        const V inverse_ray2 = Flat ? one : inverse_of(ray2);
        V nearest = in;
        meet_ball<Out>(to_ray, a, ray2, inverse_ray2, zero, nearest, found.out, found.s);
        const V last =
            hn::Add(hn::NegMulAdd(set(2.0F), along, squared), set(cone.squared - cone.last_radius * cone.last_radius));
        meet_ball<Out>(hn::Sub(to_ray, slope), last, ray2, inverse_ray2, one, nearest, found.out, found.s);
        // Where the side is met, a ball that is met before it can only be so by rounding.
        in = hn::IfThenElse(found.on_side, in, nearest);
        found.s = hn::IfThenElse(found.on_side, s, found.s);
    }
    found.there = hn::Lt(in, set(0.5F * kNothing));
    const V x = Flat ? off_x : hn::MulAdd(in, rays.x, off_x), y = Flat ? off_y : hn::MulAdd(in, rays.y, off_y);
    found.from_axis = {hn::NegMulAdd(found.s, ax, x), hn::NegMulAdd(found.s, ay, y),
                       hn::NegMulAdd(found.s, az, hn::Add(in, set(off_z)))};
    found.depth = hn::Add(in, set(start));
    found.out = hn::Add(found.out, set(start));
    return found;
}

// Upright on the vessel's own way rather than on the segment's: the eye sees no joints. Y up, z towards the eye; not of
// unit length.
HWY_INLINE V3 normal_at(const Cone& cone, const Meeting& found) {
    const V3 way = mix(set(cone.from_way), set(cone.to_way), found.s);
    const V goes_on = mix(set(cone.from_way[3]), set(cone.to_way[3]), found.s);
    const M straightened = hn::Or(found.on_side, hn::Gt(goes_on, set(0.5F)));
    const V along = hn::IfThenElseZero(straightened, dot(found.from_axis, way));
    const V3 n = found.from_axis - along * way;
    return {n.x, n.y, hn::Neg(n.z)};
}

// Whether the cone's outline may come into the block whose middle is (x, y).
HWY_INLINE bool reaches(const Cone& cone, float x, float y) {
    constexpr float kHalf = 0.5F * kBlock;
    const float px = x - cone.pixel[0], py = y - cone.pixel[1], wx = cone.way[0], wy = cone.way[1];
    const float half = kHalf * (__builtin_fabsf(wx) + __builtin_fabsf(wy)); // of the block, as wide as it is seen along
    const float corner = cone.length > 0.0F ? half : 1.4143F * kHalf; // and across: a square is the same both ways
    const float along = px * wx + py * wy, across = __builtin_fabsf(px * wy - py * wx);
    if (cone.length > 0.0F)
        return across <= cone.reach + corner && along >= -cone.reach - half && along <= cone.length + cone.reach + half;
    return px * px + py * py <= (cone.reach + corner) * (cone.reach + corner);
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
