// Intersects the rays of a block with a round cone; finds which samples of a block a triangle covers, with depths and
// normals. Included once per instruction set.
#if defined(RAMUS_CASTER_INTERSECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_INTERSECTION_INL_H
#undef RAMUS_CASTER_INTERSECTION_INL_H
#else
#define RAMUS_CASTER_INTERSECTION_INL_H
#endif

#include "render/caster/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// A block of a tile.
struct Block {
    const TileTask& tile;
    int index;
    float x, y; // lower left pixel of the picture
};
HWY_INLINE Block block_of(const TileTask& tile, int index) {
    const int column = index % kBlocks, row = index / kBlocks;
    return {tile, index, static_cast<float>(tile.x + column * kBlock), static_cast<float>(tile.y + row * kBlock)};
}

// A point on a ray is (x, y, 1) * depth in perspective and (x, y, depth) in orthographic views, so the parameter along
// a ray is the depth. `Number`: Float or FloatPair.
template <class Number> struct Rays { Number x, y; };

// Column and row of each pixel in its block.
alignas(64) constexpr float kColumn[kBlockPixels] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kRow[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// Rays through the pixels from `lane` on, at the offset (right, up) from their lower left corners.
HWY_INLINE Rays<Float> rays_at(const Block& block, int lane, float right, float up) {
    const View& view = block.tile.view;
    const Float x = Float(hn::Load(D(), kColumn + lane)) + (block.x + right - view.centre_x);
    const Float y = Float(hn::Load(D(), kRow + lane)) + (block.y + up - view.centre_y);
    return {x * view.mm_a_pixel, y * view.mm_a_pixel};
}
HWY_INLINE Rays<Float> sample_rays(const Block& block, int lane, int sample) {
    return rays_at(block, lane, kSampleX[sample], kSampleY[sample]);
}
HWY_INLINE Rays<Float> pixel_rays(const Block& block, int lane) { return rays_at(block, lane, 0.5F, 0.5F); }

HWY_INLINE Vec3 point_on(const View& view, const Rays<Float>& rays, Float depth) {
    if (view.flat) return {rays.x, rays.y, depth};
    return {rays.x * depth, rays.y * depth, depth};
}

// Terms of the intersection of rays with a cone. Parameters count from the depth of the cone's middle, which keeps
// numbers small. `off`: from the first ball's centre to the ray's point at that depth.
template <bool Flat, class Number> struct RaysAndCone {
    Number off_x, off_y;
    float off_z;
    Number ray_squared, slope, to_ray; // ray . ray, ray . axis, ray . off
    Number along, squared;             // off . axis, off . off
    Number to_first, to_last;          // squared distance to a ball's centre minus its squared radius
    Number along_side;                 // side_squared * (position on the axis whose side normal passes through off)
    Number quadratic, linear, discriminant; // of the parameter t of the side: quadratic t^2 + 2 linear t + ... = 0

    HWY_INLINE RaysAndCone(const RoundCone& cone, const Rays<Number>& rays) {
        const float start = cone.middle_depth;
        const Number ax = cone.axis[0], ay = cone.axis[1], az = cone.axis[2], side_squared = cone.side_squared;
        off_x = Flat ? rays.x - cone.from[0] : msub(rays.x, start, cone.from[0]);
        off_y = Flat ? rays.y - cone.from[1] : msub(rays.y, start, cone.from[1]);
        off_z = start - cone.from[2];
        ray_squared = Flat ? Number(1.0F) : mad(rays.x, rays.x, mad(rays.y, rays.y, 1.0F));
        slope = Flat ? az : mad(rays.x, ax, mad(rays.y, ay, az));
        to_ray = Flat ? Number(off_z) : mad(rays.x, off_x, mad(rays.y, off_y, off_z));
        along = mad(off_x, ax, mad(off_y, ay, off_z * cone.axis[2]));
        squared = mad(off_x, off_x, mad(off_y, off_y, off_z * off_z));
        to_first = squared - cone.first_radius * cone.first_radius;
        to_last = nmad(2.0F, along, squared) + (cone.axis_squared - cone.last_radius * cone.last_radius);
        along_side = along + cone.first_radius * cone.radius_change;
        quadratic = nmad(slope, slope, side_squared * ray_squared);
        linear = msub(side_squared, to_ray, along_side * slope);
        const Number constant = msub(side_squared, to_first, along_side * along_side);
        discriminant = msub(linear, linear, quadratic * constant);
    }
};

// Where rays enter and leave the parts found so far, and the position on the cone (0 to 1) where they enter.
template <class Number> struct Passage { Number entry, exit, along; };

// Adds a ball at `end` of the cone. `to_centre`: (start - centre) . ray; `distance`: |start - centre|^2 - radius^2.
template <bool WithExit, class Number>
HWY_INLINE void add_ball(Number to_centre, Number distance, Number ray_squared, Number inverse, float end,
                         Passage<Number>& found) {
    const Number discriminant = msub(to_centre, to_centre, distance * ray_squared);
    const auto hit = discriminant > 0.0F;
    const Number root = quick_sqrt(max(discriminant, 1e-30F));
    const Number entry = -(to_centre + root) * inverse;
    const auto nearer = hit && entry < found.entry;
    found.entry = select(nearer, entry, found.entry);
    found.along = select(nearer, end, found.along);
    if constexpr (WithExit) found.exit = select(hit, max(found.exit, (root - to_centre) * inverse), found.exit);
}

template <class Number, class MaskOf> struct Intersection {
    MaskOf hit;
    Number depth; // where the ray enters
    Number exit;  // depth where it leaves; only if asked for
    Number along; // the cone, 0 to 1
};

// `WithExit`: also computes where rays leave, for glass.
template <bool Flat, bool WithExit, class Number>
HWY_INLINE auto intersect(const RoundCone& cone, const Rays<Number>& rays) {
    const RaysAndCone<Flat, Number> of(cone, rays);
    const auto tapers = of.quadratic > 0.0F && Number(cone.side_squared) > 0.0F;
    const auto real = of.discriminant > 0.0F && tapers;
    const Number root = quick_sqrt(max(of.discriminant, 1e-30F)), inverse = reciprocal(of.quadratic);
    const Number entry = -(of.linear + root) * inverse;
    const Number along = mad(entry, of.slope, of.along_side) * cone.inverse_side_squared;
    const auto on_side = real && along >= 0.0F && along <= 1.0F;
    Passage<Number> found{select(on_side, entry, kNothing), -kNothing, along};
    if constexpr (WithExit) {
        const Number exit = (root - of.linear) * inverse;
        const Number along_exit = mad(exit, of.slope, of.along_side) * cone.inverse_side_squared;
        found.exit = select(real && along_exit >= 0.0F && along_exit <= 1.0F, exit, found.exit);
    }
    // The infinite cone through the side contains both balls: a ray that misses it misses the balls.
    const auto may_meet_balls = WithExit ? real || !tapers : (real || !tapers) && !on_side;
    if (any(may_meet_balls)) {
        const Number per_ray = Flat ? Number(1.0F) : reciprocal(of.ray_squared);
        if (WithExit || !cone.shares_first_ball)
            add_ball<WithExit>(of.to_ray, of.to_first, of.ray_squared, per_ray, 0.0F, found);
        add_ball<WithExit>(of.to_ray - of.slope, of.to_last, of.ray_squared, per_ray, 1.0F, found);
        // A ray that meets the side can only meet a ball earlier because of rounding.
        found.entry = select(on_side, entry, found.entry);
        found.along = select(on_side, along, found.along);
    }
    return Intersection<Number, decltype(on_side)>{found.entry < 0.5F * kNothing, found.entry + cone.middle_depth,
                                                   found.exit + cone.middle_depth, found.along};
}

// The normal of the cone towards a ray, also for rays that narrowly miss it: the normal at the closest point. It is
// perpendicular to the vessel's interpolated direction instead of the segment's, so that joints are invisible. Y up, z
// towards the eye; any length.
template <bool Flat> HWY_INLINE Vec3 pixel_normal(const RoundCone& cone, const Rays<Float>& rays) {
    const RaysAndCone<Flat, Float> of(cone, rays);
    const Float tiny = 1e-30F, quadratic = max(of.quadratic, tiny);
    const Float side = -(of.linear + quick_sqrt(max(of.discriminant, tiny))) * reciprocal(quadratic);
    const Float on_axis = mad(side, of.slope, of.along_side) * cone.inverse_side_squared;
    // Beyond an end, use the ball of that end.
    const Mask tapers = of.quadratic > tiny && Float(cone.side_squared) > 0.0F;
    const Mask last = (tapers && on_axis > 1.0F) || (!tapers && of.slope < 0.0F);
    const Mask on_side = tapers && on_axis >= 0.0F && on_axis <= 1.0F;
    const Float end = select(last, 1.0F, 0.0F), to_centre = nmad(end, of.slope, of.to_ray);
    const Float inside = nmad(select(last, of.to_last, of.to_first), of.ray_squared, to_centre * to_centre);
    const Float ball = -(to_centre + quick_sqrt(max(inside, tiny))) * reciprocal(of.ray_squared);
    const Float way = select(on_side, side, ball), along = select(on_side, on_axis, end);
    const Float x = nmad(along, cone.axis[0], Flat ? of.off_x : mad(way, rays.x, of.off_x));
    const Float y = nmad(along, cone.axis[1], Flat ? of.off_y : mad(way, rays.y, of.off_y));
    const Float z = nmad(along, cone.axis[2], way + of.off_z);
    const auto direction = [&](int i) {
        return mad(along, cone.to_direction[i] - cone.from_direction[i], cone.from_direction[i]);
    };
    const Float dx = direction(0), dy = direction(1), dz = direction(2);
    const Mask straightened = on_side || direction(3) > 0.5F;
    const Float slant = select(straightened, mad(x, dx, mad(y, dy, z * dz)), 0.0F);
    return {nmad(slant, dx, x), nmad(slant, dy, y), msub(slant, dz, z)};
}

// Normal of the cone at a sample, y up and z towards the eye; any length.
template <class Number> struct SampleNormal { Number x, y, z; };

// Reproduces the picture at rest, whose samples have their triangle's normal at the pixel's middle, extrapolated along
// the triangle's plane. The result is the normal where the ray through the middle meets the plane that touches the cone
// at the sample; along the outline of a vessel a few pixels wide it faces the eye more than the cone does. It is
// perpendicular to the vessel's own direction, as in pixel_normal(). `depth` and `along`: of the hit.
template <bool Flat, class Number>
HWY_INLINE SampleNormal<Number> sample_normal(const RoundCone& cone, const Rays<Number>& rays,
                                              const Rays<Number>& middle, Number depth, Number along) {
    // No visible triangle is steeper, since it spans a sixteenth of the circumference.
    constexpr float kLeastFacing = 0.1F;
    const Number x = nmad(along, cone.axis[0], Flat ? rays.x - cone.from[0] : msub(rays.x, depth, cone.from[0]));
    const Number y = nmad(along, cone.axis[1], Flat ? rays.y - cone.from[1] : msub(rays.y, depth, cone.from[1]));
    const Number z = nmad(along, cone.axis[2], depth - cone.from[2]);
    const Number dx = Flat ? middle.x - rays.x : (middle.x - rays.x) * depth;
    const Number dy = Flat ? middle.y - rays.y : (middle.y - rays.y) * depth;
    const Number against = Flat ? Number(z) : mad(middle.x, x, mad(middle.y, y, z));
    const Number radius = mad(along, cone.radius_change, cone.first_radius);
    const Number way = mad(dx, x, dy * y) * reciprocal(max(-against, kLeastFacing * radius));
    const Number px = x + (Flat ? dx : mad(way, middle.x, dx)), py = y + (Flat ? dy : mad(way, middle.y, dy)),
                 pz = z + way;
    const auto direction = [&](int i) {
        return mad(along, cone.to_direction[i] - cone.from_direction[i], cone.from_direction[i]);
    };
    const Number ux = direction(0), uy = direction(1), uz = direction(2);
    const auto straightened = (along > 0.0F && along < 1.0F) || direction(3) > 0.5F;
    const Number slant = select(straightened, mad(px, ux, mad(py, uy, pz * uz)), 0.0F);
    return {nmad(slant, ux, px), nmad(slant, uy, py), msub(slant, uz, pz)};
}

// Whether the cone may cover samples of the block at a depth less than `farthest`. Conservative.
HWY_INLINE bool reaches(const RoundCone& cone, const Block& block, float farthest) {
    constexpr float kHalf = 0.5F * kBlock;
    if (cone.nearest_depth >= farthest) return false;
    const float x = block.x + kHalf - cone.image_from[0], y = block.y + kHalf - cone.image_from[1];
    const float dx = cone.image_direction[0], dy = cone.image_direction[1], length = cone.image_length;
    if (length <= 0.0F) {
        const float most = cone.image_half_width + 1.4143F * kHalf;
        return x * x + y * y <= most * most;
    }
    // Half the extent of the block along the cone and across it; equal, since a block is square.
    const float half = kHalf * (__builtin_fabsf(dx) + __builtin_fabsf(dy)), beside = cone.image_half_width + half;
    const float along = x * dx + y * dy, across = __builtin_fabsf(x * dy - y * dx);
    if (across > beside || along < -beside || along > length + beside) return false;
    // The part of the axis that may project into the block. Depth is linear in the picture in orthographic views; in
    // perspective its inverse is.
    const float from = along - beside, to = along + beside, scale = 1.0F / length;
    const float t0 = from <= 0.0F ? 0.0F : from * scale, t1 = to >= length ? 1.0F : to * scale;
    const float d0 = cone.depth[0] + t0 * cone.depth[1], d1 = cone.depth[0] + t1 * cone.depth[1];
    if (cone.depth[2] > 0.0F) return (d0 < d1 ? d0 : d1) - cone.larger_radius < farthest; // flat
    return (d0 > d1 ? d0 : d1) * (farthest + cone.larger_radius) > 1.0F;
}

// Twice the signed areas of the triangles between a point and each edge: positive inside.
struct EdgeFunctions {
    Float of[3];
};
HWY_INLINE EdgeFunctions edge_functions(const Triangle& t, const Block& block, int lane, float right, float up) {
    const Float x = Float(hn::Load(D(), kColumn + lane)) + (block.x + right);
    const Float y = Float(hn::Load(D(), kRow + lane)) + (block.y + up);
    EdgeFunctions edges;
    for (int i = 0; i < 3; ++i) {
        const Triangle::Edge& e = t.edge[i];
        edges.of[i] = e.direction_x * (y - e.y) - e.direction_y * (x - e.x);
    }
    return edges;
}

struct Coverage {
    Mask covered;
    Float depth;
};
template <bool Flat>
HWY_INLINE Coverage coverage_at(const Triangle& t, const Block& block, int lane, float right, float up) {
    const EdgeFunctions edges = edge_functions(t, block, lane, right, up);
    Coverage found{{hn::FirstN(D(), kBlockPixels)}, 0.0F};
    for (int i = 0; i < 3; ++i) {
        found.covered = found.covered && (t.edge[i].own ? edges.of[i] >= 0.0F : edges.of[i] > 0.0F);
        found.depth = mad(edges.of[i], t.depth[i], found.depth);
    }
    if constexpr (!Flat) found.depth = reciprocal(found.depth);
    return found;
}
template <bool Flat> HWY_INLINE Coverage coverage(const Triangle& t, const Block& block, int lane, int sample) {
    return coverage_at<Flat>(t, block, lane, kSampleX[sample], kSampleY[sample]);
}

// Normals at the pixels' middles, as in fragment.frag; any length. For lines, x is the covered share of the pixel.
HWY_INLINE Vec3 pixel_normal(const Triangle& t, const Block& block, int lane) {
    const EdgeFunctions edges = edge_functions(t, block, lane, 0.5F, 0.5F);
    if (t.half_width > 0.0F) { // as line_share() of context.frag
        Float nearest = kNothing;
        for (int i = 0; i < 3; ++i) nearest = min(nearest, abs(edges.of[i]) * (t.share / t.slope[i]));
        const Float share = clamp(t.half_width + 0.5F - nearest, 0.0F, 1.0F);
        const float thin = 2.0F * t.half_width < 1.0F ? 2.0F * t.half_width : 1.0F;
        return {share * (thin * t.crowded), 0.0F, 0.0F};
    }
    Vec3 sum(0.0F);
    for (int i = 0; i < 3; ++i)
        sum = sum + edges.of[i] * t.share * Vec3(t.normal[i][0], t.normal[i][1], t.normal[i][2]);
    return sum;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
